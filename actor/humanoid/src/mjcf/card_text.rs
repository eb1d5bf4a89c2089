//! A robot card within a model text: the `data` of a `<text>` in `<custom>`.

use roxmltree::{Document, Node};

use super::xml;
use crate::card::{self, RobotCard};
use crate::error::ModelError;

/// Name of the `<text>`.
const CARD_TEXT: &str = "treadmill_robot_card";

/// Returns a model text with the built-in card `name` in it.
///
/// # Errors
/// [`ModelError::Card`] if there is no such card, or if the text has one.
pub fn with_built_in(text: &str, name: &str) -> Result<String, ModelError> {
    let card = card::built_in(name)?;
    if text.contains(CARD_TEXT) {
        return Err(ModelError::Card(format!(
            "the model has a card of its own beside the card `{name}`; use one of them: a plain model file, or \
             --set 'env.robot=\"\"'"
        )));
    }
    with_card(text, card)
}

/// Returns the text of the card in a model text; `None` without one, or if the text is no model.
#[must_use]
pub fn card_of(text: &str) -> Option<String> {
    let document = xml::parse(text).ok()?;
    let mut texts = xml::sections(document.root_element(), "custom").flat_map(|custom| custom.children());
    texts.find(is_card)?.attribute("data").map(str::to_owned)
}

/// Returns a model text with a card in it.
///
/// # Errors
/// [`ModelError`] if the text is not XML.
pub fn with_card(text: &str, card: &str) -> Result<String, ModelError> {
    let attributes = [("name", CARD_TEXT), ("data", card)].map(|(name, value)| (name.to_owned(), value.to_owned()));
    let mut element = String::new();
    xml::write(&mut element, "text", &attributes);
    xml::with_custom(text, &element)
}

/// Returns the card in a model text, if there is one.
pub(super) fn in_document(document: &Document<'_>) -> Result<Option<RobotCard>, ModelError> {
    let mut texts = xml::sections(document.root_element(), "custom").flat_map(|custom| custom.children());
    texts.find(is_card).map(|node| RobotCard::parse(node.attribute("data").unwrap_or_default())).transpose()
}

/// Returns whether a node is the `<text>` of a card.
pub(super) fn is_card(node: &Node<'_, '_>) -> bool {
    node.attribute("name") == Some(CARD_TEXT)
}
