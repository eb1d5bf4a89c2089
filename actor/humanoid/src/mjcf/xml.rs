//! XML: parsing with bounds on length and depth, and writing.

use std::fmt::Write;

use roxmltree::{Document, Node};

use super::element::Attribute;
use crate::error::ModelError;

/// Longest model text (bytes); a humanoid of primitive shapes takes a few thousand bytes.
pub const MODEL_BYTES_MAX: usize = 16 << 20;
/// Deepest nesting of elements: XML readers recurse, and the stack is finite.
const DEPTH_MAX: usize = 100;

/// Parses a model text, whose outermost element must be `<mujoco>`.
pub(super) fn parse_model(text: &str) -> Result<Document<'_>, ModelError> {
    let document = parse(text)?;
    let root = document.root_element().tag_name().name();
    if root != "mujoco" {
        return Err(ModelError::unsupported(root, "the outermost element must be <mujoco>"));
    }
    Ok(document)
}

/// Parses any XML text.
pub(super) fn parse(text: &str) -> Result<Document<'_>, ModelError> {
    if text.len() > MODEL_BYTES_MAX {
        return Err(ModelError::TooLarge { bytes: text.len() as u64, limit: MODEL_BYTES_MAX as u64 });
    }
    if text.trim().is_empty() {
        return Err(ModelError::unsupported("mujoco", "the text is empty"));
    }
    if nesting(text) > DEPTH_MAX {
        return Err(ModelError::unsupported("mujoco", format!("elements are nested more than {DEPTH_MAX} deep")));
    }
    Document::parse(text).map_err(ModelError::Parse)
}

/// Returns the outermost sections of a kind.
pub(super) fn sections<'a, 'text>(root: Node<'a, 'text>, tag: &'static str) -> impl Iterator<Item = Node<'a, 'text>> {
    elements(root).filter(move |node| node.has_tag_name(tag))
}

/// Returns the elements within another.
pub(super) fn elements<'a, 'text>(node: Node<'a, 'text>) -> impl Iterator<Item = Node<'a, 'text>> {
    node.children().filter(Node::is_element)
}

/// Returns a model text with more elements in a `<custom>`, which MuJoCo ignores.
pub(super) fn with_custom(text: &str, elements: &str) -> Result<String, ModelError> {
    let root = parse_model(text)?.root_element().range();
    let end = text[..root.end].rfind("</").unwrap_or(root.end);
    Ok(format!("{}<custom>{elements}</custom>\n{}", &text[..end], &text[end..]))
}

/// Writes an element without content.
pub(super) fn write(text: &mut String, tag: &str, attributes: &[Attribute]) {
    open(text, tag, attributes);
    let _ = writeln!(text, "</{tag}>");
}

/// Writes the beginning of an element.
pub(super) fn open(text: &mut String, tag: &str, attributes: &[Attribute]) {
    let _ = write!(text, "<{tag}");
    for (name, value) in attributes {
        let _ = write!(text, " {name}=\"");
        escape(text, value);
        text.push('"');
    }
    text.push('>');
}

/// Writes the value of an attribute.
pub(super) fn escape(text: &mut String, value: &str) {
    for letter in value.chars() {
        match letter {
            '&' => text.push_str("&amp;"),
            '<' => text.push_str("&lt;"),
            '"' => text.push_str("&quot;"),
            '\'' => text.push_str("&apos;"),
            // A reader would turn these into spaces.
            '\n' => text.push_str("&#10;"),
            '\t' => text.push_str("&#9;"),
            _ => text.push(letter),
        }
    }
}

/// Returns the nesting depth of elements; meaningless for a text that is not well-formed.
fn nesting(text: &str) -> usize {
    let (mut rest, mut depth, mut deepest) = (text, 0usize, 0);
    while let Some(start) = rest.find('<') {
        rest = &rest[start..];
        let skipped = [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>")]
            .into_iter()
            .find(|(opening, _)| rest.starts_with(opening))
            .map(|(_, closing)| rest.find(closing).map_or(rest.len(), |end| end + closing.len()));
        if let Some(end) = skipped {
            rest = &rest[end..];
            continue;
        }
        let end = tag_end(rest);
        if rest.starts_with("</") {
            depth = depth.saturating_sub(1);
        } else if !rest[..end].ends_with("/>") {
            depth += 1;
            deepest = deepest.max(depth);
        }
        rest = &rest[end..];
    }
    deepest
}

/// Returns the length of the tag at the beginning of a text; a `>` within quotes does not end it.
fn tag_end(text: &str) -> usize {
    let mut quote = None;
    for (index, byte) in text.bytes().enumerate() {
        match (quote, byte) {
            (None, b'>') => return index + 1,
            (None, b'"' | b'\'') => quote = Some(byte),
            (Some(open), _) if open == byte => quote = None,
            _ => {}
        }
    }
    text.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nesting_counts_open_elements_only() {
        assert_eq!(nesting("<a><b/><c><d x='>'/></c></a>"), 2);
        assert_eq!(nesting("<a><!-- <b><c><d> --><?x <e> ?><![CDATA[<f><g>]]></a>"), 1);
        assert_eq!(nesting("no tags"), 0);
        assert_eq!(nesting("<a"), 1);
    }

    #[test]
    fn texts_that_are_not_models_are_refused() {
        let problem = |text: &str| parse_model(text).expect_err("no model").to_string();
        assert!(problem(" \n").contains("empty"));
        assert!(problem("<robot/>").contains("`robot`"));
        assert!(problem(&format!("<mujoco>{}", "<body>".repeat(200_000))).contains("nested"));
        assert!(problem(&" ".repeat(MODEL_BYTES_MAX + 1)).contains("16777217 bytes"));
        assert!(matches!(parse("mass = 3"), Err(ModelError::Parse(_))));
    }
}
