//! Robot cards: what a controller needs to know of a robot beside its model file.
//!
//! A card is a TOML file:
//!
//! ```toml
//! model = "scene.xml"           # relative to the card
//! feet = ["left_foot", "right_foot"]
//! height_m = 0.76               # of the root in the default pose
//!
//! [[hinges]]
//! names = "*_knee_joint"        # `*` stands for any letters; later entries complete or replace earlier ones
//! kp = 99.1                     # N·m/rad
//! kd = 6.31                     # N·m·s/rad
//! effort_nm = 139.0
//! armature_kgm2 = 0.025
//! default_rad = 0.3
//! ```
//!
//! [`RobotCard::apply`] replaces the motors of a model by servos with these gains. A model text may hold its card, see
//! [`crate::mjcf`].

mod apply;
mod automatic;

use serde::Deserialize;

pub use self::automatic::{BodySize, Proposal};
use crate::error::ModelError;
use crate::model::BaseAxis;

/// Robot card as written.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RobotCard {
    /// Path of the model file, relative to the card; empty if the card is read with a model.
    #[serde(default)]
    pub model: String,
    /// Body of the free joint, if it must be checked.
    pub base: Option<String>,
    /// Axis of the base's frame that points forward; that frame is turned so that it becomes x.
    #[serde(default)]
    pub forward: BaseAxis,
    /// Bodies that carry the robot.
    #[serde(default)]
    pub feet: Vec<String>,
    /// Pairs of bodies that do not touch each other, such as parts whose shapes overlap in the default pose.
    #[serde(default)]
    pub exclude: Vec<[String; 2]>,
    /// Which bodies of the robot touch each other.
    #[serde(default)]
    pub self_contacts: SelfContacts,
    /// Keyframe of the default pose; without it all hinges are at zero where no rule says otherwise.
    pub keyframe: Option<String>,
    /// Height of the root in the default pose (m); replaces that of the keyframe or text.
    pub height_m: Option<f64>,
    /// Names of a left and a right hinge, in which one `*` may stand for the letters that both share; for robots whose
    /// names do not follow left and right.
    #[serde(default)]
    pub symmetry: Vec<[String; 2]>,
    /// Hinges in the order in which the robot's own software counts its motors, all of them, and `""` for a number without a
    /// hinge; needed where that differs from the order of the model file.
    #[serde(default)]
    pub motors: Vec<String>,
    /// Rules about hinges.
    #[serde(default, rename = "hinges")]
    pub rules: Vec<HingeRule>,
}

/// Contacts of a robot with itself.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SelfContacts {
    /// Those of the file.
    #[default]
    All,
    /// Of those only the ones between the left and the right leg, since contacts of meshes take time.
    Legs,
}

/// Properties of all hinges whose name matches.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HingeRule {
    /// Name, in which `*` stands for any letters.
    pub names: String,
    /// Stiffness of the servo (N·m/rad).
    pub kp: Option<f64>,
    /// Damping of the servo (N·m·s/rad).
    pub kd: Option<f64>,
    /// Greatest torque (N·m).
    pub effort_nm: Option<f64>,
    /// Rotor inertia as seen at the hinge (kg·m²); replaces the model's.
    pub armature_kgm2: Option<f64>,
    /// Angle in the default pose (rad); replaces the keyframe's.
    pub default_rad: Option<f64>,
    /// Offset of the target per unit of an action (rad), at most four of which count; by default a quarter of effort ÷ kp.
    pub action_scale_rad: Option<f64>,
    /// Whether the hinge keeps its default angle, by its gains, and belongs to no action.
    pub held: Option<bool>,
}

impl RobotCard {
    /// Reads a card.
    ///
    /// # Errors
    /// [`ModelError::Card`] with the line of the first mistake.
    pub fn parse(text: &str) -> Result<Self, ModelError> {
        toml::from_str(text).map_err(|why| ModelError::Card(why.to_string().trim_end().to_owned()))
    }
}

/// Cards that come along, by name.
pub const BUILT_IN: &[(&str, &str)] = &[
    ("g1", include_str!("../../assets/robots/g1.toml")),
    ("g1-29", include_str!("../../assets/robots/g1-29.toml")),
    ("h1", include_str!("../../assets/robots/h1.toml")),
    ("t1", include_str!("../../assets/robots/t1.toml")),
];

/// Returns the built-in card of a name.
///
/// # Errors
/// [`ModelError::Card`] names the cards that there are.
pub fn built_in(name: &str) -> Result<&'static str, ModelError> {
    let found = BUILT_IN.iter().find(|(known, _)| *known == name);
    found.map(|(_, card)| *card).ok_or_else(|| {
        let known = BUILT_IN.iter().map(|(known, _)| *known).collect::<Vec<_>>().join(", ");
        ModelError::Card(format!("there is no card `{name}`; allowed: {known}, or none"))
    })
}
