//! URDF text → MJCF text, which is what a run carries.
//!
//! What ROS's description of a joint or link means is kept; what has no counterpart here is refused, or held still with a
//! notice in the text. (<http://wiki.ros.org/urdf/XML>, and urdfdom's schema for versions 1.1 and 1.2.)
//!
//! - `check`: numbers and names of the text, before `urdf_rs` reads it.
//! - `tree`: links below each other, and the joint that holds each.
//! - `meshes`: files of meshes, by package.
//! - `write`: tree → MJCF.

mod check;
mod meshes;
mod tree;
mod write;

use std::path::{Path, PathBuf};

use roxmltree::Document;

use crate::error::ModelError;
use crate::mjcf::xml::sections;

/// How the files of a model are read.
#[derive(Clone, Debug, Default)]
pub struct ModelFiles {
    /// Folders of ROS packages, by name. Others are looked for in `ROS_PACKAGE_PATH`, then upward from the file.
    pub packages: Vec<(String, PathBuf)>,
    /// Whether prismatic joints of a URDF are held still; otherwise they are refused.
    pub holds_slides: bool,
}

/// Returns whether a text is a URDF: its outermost element is `<robot>`.
pub(in crate::mjcf) fn is_urdf(document: &Document<'_>) -> bool {
    document.root_element().has_tag_name("robot")
}

/// Returns a URDF as MJCF whose meshes have the paths of their files; visual ones are left out unless `has_visuals`, since
/// they lie elsewhere on another machine. The robot is at height 0.
///
/// # Errors
/// [`ModelError`] names the first link or joint that cannot be simulated.
pub(in crate::mjcf) fn to_mjcf(
    document: &Document<'_>,
    file: &Path,
    files: &ModelFiles,
    has_visuals: bool,
) -> Result<String, ModelError> {
    check::check(document, file)?;
    let robot = urdf_rs::read_from_string(&check::needed_text(document, has_visuals))
        .map_err(|why| ModelError::unsupported("robot", format!("the URDF cannot be read: {why}")))?;
    let compiler = sections(document.root_element(), "mujoco").flat_map(|mujoco| sections(mujoco, "compiler")).next();
    let setting = |name: &str| compiler.and_then(|node| node.attribute(name));
    // Otherwise only <inertial> gives mass.
    let has_other_masses =
        setting("boundmass").is_some() || matches!(setting("inertiafromgeom"), Some("true" | "auto"));
    let mut notices = check::unused(document);
    let tree = tree::LinkTree::of(&robot, files.holds_slides, has_other_masses, &mut notices)?;
    let folder = file.parent().unwrap_or(Path::new(""));
    let meshes = meshes::Search { folder, packages: &files.packages, meshdir: setting("meshdir") };
    write::mjcf(&robot, &tree, &meshes, compiler, notices)
}

/// Returns a text of [`to_mjcf`] whose robot is higher by `height_m`.
pub(in crate::mjcf) fn raised(text: &str, height_m: f64) -> String {
    text.replacen(&write::root_place(0.0), &write::root_place(height_m), 1)
}
