//! Motions within a model text: the `data` of `<text>`s in `<custom>`, so that they travel, are hashed and saved with it.

use base64::{Engine, engine::general_purpose::STANDARD};
use roxmltree::{Document, Node};

use super::xml;
use crate::error::ModelError;
use crate::model::{MotionClip, MotionError};

/// Beginning of the names of the `<text>`s.
const MOTION_TEXT: &str = "treadmill_motion_";

/// Most hinges of a motion, more than any robot has.
const HINGES_MAX: usize = 1000;

/// Returns whether a node is the `<text>` of a motion.
pub(super) fn is_motion(node: &Node<'_, '_>) -> bool {
    node.attribute("name").is_some_and(|name| name.starts_with(MOTION_TEXT))
}

/// Returns a model text with these motions, in place of those that it has.
///
/// # Errors
/// [`ModelError`] if the text is not XML.
pub fn with_motions(text: &str, motions: &[MotionClip]) -> Result<String, ModelError> {
    let document = xml::parse(text)?;
    let mut whole = text.to_owned();
    // With a section that holds nothing else.
    let section = |node: Node<'_, '_>| {
        let parent = node.parent().filter(|parent| xml::elements(*parent).all(|part| is_motion(&part)));
        parent.map_or_else(|| node.range(), |parent| parent.range())
    };
    let mut present: Vec<_> = nodes(&document).map(section).collect();
    present.dedup();
    // From the back, so that the places before stay.
    for range in present.into_iter().rev() {
        let line_end = usize::from(whole[range.end..].starts_with('\n'));
        whole.replace_range(range.start..range.end + line_end, "");
    }
    let mut elements = String::new();
    for (number, motion) in motions.iter().enumerate() {
        let attributes = [("name", format!("{MOTION_TEXT}{number}")), ("data", written(motion))];
        xml::write(&mut elements, "text", &attributes.map(|(name, value)| (name.to_owned(), value)));
    }
    if elements.is_empty() { Ok(whole) } else { xml::with_custom(&whole, &elements) }
}

/// Returns the motions in a model text.
///
/// # Errors
/// [`ModelError`] if the text is not XML, or a motion in it is damaged.
pub fn motions_of(text: &str) -> Result<Vec<MotionClip>, ModelError> {
    in_document(&xml::parse(text)?)
}

/// Returns the motions in a document.
///
/// # Errors
/// [`ModelError::Motion`] if one is damaged.
pub(super) fn in_document(document: &Document<'_>) -> Result<Vec<MotionClip>, ModelError> {
    let read = |node: Node<'_, '_>| read(node.attribute("data").unwrap_or_default());
    nodes(document).map(read).collect::<Result<_, MotionError>>().map_err(|why| ModelError::Motion(why.to_string()))
}

fn nodes<'a, 'i>(document: &'a Document<'i>) -> impl Iterator<Item = Node<'a, 'i>> {
    let texts = xml::sections(document.root_element(), "custom").flat_map(|custom| custom.children());
    texts.filter(is_motion)
}

/// Writes name, rate, number of hinges, their names, and the frames in base64, each in a line.
fn written(motion: &MotionClip) -> String {
    let bytes: Vec<u8> = motion.frames().flatten().flat_map(|number| number.to_le_bytes()).collect();
    let mut lines = vec![motion.name.clone(), motion.rate_hz.to_string(), motion.hinges.len().to_string()];
    lines.extend(motion.hinges.iter().cloned());
    lines.push(STANDARD.encode(bytes));
    lines.join("\n")
}

fn read(data: &str) -> Result<MotionClip, MotionError> {
    let damaged = || MotionError("a motion in the model text is damaged".to_owned());
    let mut lines = data.lines();
    let mut next = || lines.next().ok_or_else(damaged);
    let name = next()?;
    let rate_hz = next()?.parse().map_err(|_| damaged())?;
    let count: usize = next()?.parse().map_err(|_| damaged())?;
    if count > HINGES_MAX {
        return Err(damaged());
    }
    let mut hinges = Vec::new();
    for _ in 0..count {
        hinges.push(next()?.to_owned());
    }
    let bytes = STANDARD.decode(next()?).map_err(|_| damaged())?;
    let (numbers, rest) = bytes.as_chunks::<4>();
    if !rest.is_empty() {
        return Err(damaged());
    }
    MotionClip::new(name, rate_hz, hinges, numbers.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect())
}
