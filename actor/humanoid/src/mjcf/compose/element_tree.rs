//! XML elements that can be changed.

use roxmltree::Node as XmlNode;

use super::super::element::{Attribute, Element};
use super::super::notices;
use super::super::pose::Pose;
use super::super::xml;
use crate::error::ModelError;

/// Element with its content; text and comments are left out.
#[derive(Clone, Debug, Default)]
pub(super) struct Piece {
    pub(super) tag: String,
    pub(super) attributes: Vec<Attribute>,
    pub(super) children: Vec<Self>,
}

impl Piece {
    pub(super) fn of(node: XmlNode<'_, '_>) -> Self {
        let Element { tag, attributes, .. } = Element::of(node, "");
        Self { tag, attributes, children: xml::elements(node).map(Self::of).collect() }
    }

    fn section(tag: &str, children: Vec<Self>) -> Self {
        Self { tag: tag.to_owned(), attributes: Vec::new(), children }
    }

    /// Returns a frame of this pose.
    pub(super) fn frame(pose: &Pose) -> Self {
        Self { tag: "frame".to_owned(), attributes: pose.attributes(), children: Vec::new() }
    }

    /// Returns a `<custom>` with a note.
    pub(super) fn note(kind: &str, note: String) -> Self {
        let mut text = Self::section("text", Vec::new());
        text.attributes = notices::attributes(kind, note);
        Self::section("custom", vec![text])
    }

    /// Returns the element without content, with a label for messages.
    pub(super) fn element(&self, label: &str) -> Element {
        let name = ["name", "body", "frame", "model"].into_iter().find_map(|name| self.get(name)).unwrap_or(label);
        Element { tag: self.tag.clone(), label: name.to_owned(), attributes: self.attributes.clone() }
    }

    pub(super) fn get(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(found, _)| found == name).map(|(_, value)| value.as_str())
    }

    pub(super) fn set(&mut self, name: &str, value: &str) {
        match self.attributes.iter_mut().find(|(found, _)| found == name) {
            Some((_, found)) => value.clone_into(found),
            None => self.attributes.push((name.to_owned(), value.to_owned())),
        }
    }

    /// Returns an attribute that several sections of a kind may have: that of the last one.
    pub(super) fn setting(&self, tag: &str, name: &str) -> Option<&str> {
        self.children.iter().filter(|section| section.tag == tag).filter_map(|section| section.get(name)).next_back()
    }

    /// Removes and returns all sections of a kind.
    pub(super) fn take_all(&mut self, tag: &str) -> Vec<Self> {
        let (taken, rest) = std::mem::take(&mut self.children).into_iter().partition(|section| section.tag == tag);
        self.children = rest;
        taken
    }

    /// Adds sections with these elements.
    pub(super) fn add_all(&mut self, sections: Vec<(&str, Vec<Self>)>) {
        let filled = sections.into_iter().filter(|(_, elements)| !elements.is_empty());
        self.children.extend(filled.map(|(tag, elements)| Self::section(tag, elements)));
    }

    pub(super) fn has_below(&self, wanted: &dyn Fn(&Self) -> bool) -> bool {
        self.children.iter().any(|child| wanted(child) || child.has_below(wanted))
    }

    /// Returns the first element below this one that is wanted, and the class of what is in its parent.
    pub(super) fn find(&self, wanted: &dyn Fn(&Self) -> bool, class: Option<&str>) -> Option<(Self, Option<String>)> {
        let class = self.get("childclass").or(class);
        self.children.iter().find_map(|child| match wanted(child) {
            true => Some((child.clone(), class.map(str::to_owned))),
            false => child.find(wanted, class),
        })
    }

    /// Refuses several outermost `<default>`s, which would have to become one: classes of the first inherit nothing from the
    /// second.
    pub(super) fn check_defaults(&self) -> Result<(), ModelError> {
        let count = self.children.iter().filter(|section| section.tag == "default").count();
        let own = self.children.iter().filter(|section| section.tag == "default" && section.get("class").is_none());
        if count > 1 && own.flat_map(|section| &section.children).any(|child| child.tag != "default") {
            let problem =
                "a text with attached models, or one that is attached, may have one outermost <default>; join them";
            return Err(ModelError::unsupported("default", problem));
        }
        Ok(())
    }

    /// Gives the defaults of the text a class of their own, so that those of an attached model inherit nothing from them.
    pub(super) fn isolate(&mut self, class: &str) {
        let defaults = self.take_all("default");
        let mut nested = Self::section("default", defaults.into_iter().flat_map(|section| section.children).collect());
        nested.set("class", class);
        self.children.push(Self::section("default", vec![nested]));
        self.use_class(class);
    }

    /// Replaces the class `main`, where an element names it.
    fn replace_main(&mut self, class: &str) {
        for (name, value) in &mut self.attributes {
            if ["class", "childclass"].contains(&&**name) && value == "main" {
                class.clone_into(value);
            }
        }
        self.children.iter_mut().for_each(|child| child.replace_main(class));
    }

    /// Lets all elements without a class have this one.
    fn use_class(&mut self, class: &str) {
        self.children
            .iter_mut()
            .filter(|section| section.tag != "default")
            .for_each(|section| section.replace_main(class));
        for section in &mut self.children {
            match section.tag.as_str() {
                "worldbody" => {
                    let mut frame = Self::frame(&Pose::IDENTITY);
                    frame.set("childclass", class);
                    frame.children = std::mem::take(&mut section.children);
                    section.children.push(frame);
                }
                "asset" | "contact" | "equality" | "tendon" | "actuator" => {
                    let with_class =
                        |element: &&mut Self| !["exclude", "hfield", "texture", "model"].contains(&&*element.tag);
                    for element in
                        section.children.iter_mut().filter(with_class).filter(|element| element.get("class").is_none())
                    {
                        element.set("class", class);
                    }
                }
                _ => {}
            }
        }
    }

    /// Puts a prefix before all names of a whole text, and nests its defaults in a class of the name `main` with the prefix.
    pub(super) fn rename_all(&mut self, prefix: &str) {
        self.isolate("main");
        self.children
            .iter_mut()
            .filter(|section| section.tag != "custom")
            .for_each(|section| section.prefix_names(prefix));
    }

    fn prefix_names(&mut self, prefix: &str) {
        let is_name = |name: &str| name == "name" || super::names::is_reference(name);
        for (name, value) in &mut self.attributes {
            if is_name(name) && value != "world" {
                value.insert_str(0, prefix);
            }
        }
        // A file without a name is named after it.
        let stem = |file: &str| std::path::Path::new(file).file_stem().map(|stem| stem.to_string_lossy().into_owned());
        if ["mesh", "material", "texture", "hfield"].contains(&&*self.tag)
            && self.get("name").is_none()
            && let Some(stem) = self.get("file").and_then(stem)
        {
            self.set("name", &format!("{prefix}{stem}"));
        }
        self.children.iter_mut().for_each(|child| child.prefix_names(prefix));
    }

    /// Returns about how long the text is (bytes).
    pub(super) fn length(&self) -> u64 {
        let own: usize = self.attributes.iter().map(|(name, value)| name.len() + value.len() + 4).sum();
        (own + 2 * self.tag.len() + 5) as u64 + self.children.iter().map(Self::length).sum::<u64>()
    }

    pub(super) fn to_text(&self) -> String {
        let mut text = String::new();
        self.write(&mut text);
        text
    }

    fn write(&self, text: &mut String) {
        xml::open(text, &self.tag, &self.attributes);
        if !self.children.is_empty() {
            text.push('\n');
        }
        self.children.iter().for_each(|child| child.write(text));
        text.push_str("</");
        text.push_str(&self.tag);
        text.push_str(">\n");
    }
}
