//! MJCF text → [`Model`], and URDF → MJCF text.
//!
//! A text is all that another machine needs: [`read_model_file`] writes included files, hulls of meshes and height
//! fields into it. docs/guide/robots.md lists the accepted MJCF. Any other element or attribute that motion depends on
//! is refused by name.
//!
//! - `xml`: parsing with bounds, and writing.
//! - `element`, `vocabulary`, `defaults`, `pose`: attributes, their allowed values, default classes, and orientations.
//! - `tree`: the whole text, checked, with defaults filled in.
//! - `reader`: tree → model, with a file for each part: `geoms`, `floor`, `joints`, `mass`, `pairs`, `tendons`, `motors`,
//!   `equalities`, `keyframes`, and `assets`.
//! - `files`, `embed`, `visual`: files that a model names.
//! - `compose`: `<replicate>` and `<attach>`.
//! - `urdf`: URDF → MJCF text.
//! - `notices`: what was read differently, what MuJoCo refuses, and what is ignored.
//! - `card_text`, `motion_text`: a robot card and motions within a text.

mod assets;
pub(crate) mod card_text;
mod compose;
mod defaults;
mod element;
mod embed;
mod equalities;
mod files;
mod floor;
mod geoms;
mod joints;
mod keyframes;
mod mass;
mod motion_text;
mod motors;
mod notices;
mod order;
mod pairs;
mod pose;
mod reader;
mod tendons;
mod tree;
mod urdf;
mod visual;
mod vocabulary;
mod xml;

use std::collections::BTreeMap;

pub use self::card_text::{card_of, with_built_in, with_card};
pub use self::embed::read_model_file;
pub use self::motion_text::{motions_of, with_motions};
pub use self::order::in_order_of;
pub use self::urdf::ModelFiles;
pub use self::visual::{VisualMesh, visual_meshes};
pub use self::xml::MODEL_BYTES_MAX;
use crate::error::ModelError;
use crate::model::Model;

/// MJCF text of the built-in humanoid: 17 hinges, about 42 kg, masses and sizes of Humanoid-v5.
pub const HUMANOID_XML: &str = include_str!("../../assets/humanoid.xml");

impl Model {
    /// Reads a model from MJCF text, and applies the card in it. Opens no file.
    ///
    /// # Errors
    /// [`ModelError`] names the first element that cannot be simulated.
    pub fn from_mjcf(text: &str) -> Result<Self, ModelError> {
        let model = Self::without_motors(text)?;
        if model.motors.is_empty() {
            let problem = "the model needs at least one motor; a robot card gives it servos, and `treadmill robot FILE` \
                           drafts that card";
            return Err(ModelError::unsupported("actuator", problem));
        }
        Ok(model)
    }

    /// Reads a model that may have no motors, because a card is to add them.
    ///
    /// # Errors
    /// [`ModelError`] names the first element that cannot be simulated.
    pub fn without_motors(text: &str) -> Result<Self, ModelError> {
        reader::read(text)
    }

    /// Returns the kinds of elements of a text that no motion depends on, with their counts: of those within each other only
    /// the outermost. Empty if the text is not XML.
    #[must_use]
    pub fn ignored_elements(text: &str) -> BTreeMap<String, usize> {
        let document = xml::parse(text);
        document.map(|document| notices::ignored(document.root_element())).unwrap_or_default()
    }
}
