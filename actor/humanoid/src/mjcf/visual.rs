//! Visual meshes of a model file, for viewers on the machine that has the files. The simulation does without them.

use std::path::Path;

use nalgebra::{Isometry3, Quaternion, UnitQuaternion, Vector3};
use roxmltree::Node;

use super::compose;
use super::files::{self, AssetFiles};
use super::urdf::{self, ModelFiles};
use super::xml::{self, elements, sections};
use crate::error::ModelError;

/// Most visual meshes of a file.
const MESHES_MAX: usize = 1024;
const GREY: [f64; 4] = [0.7, 0.7, 0.7, 1.0];

/// Mesh that is seen but does not touch.
#[derive(Clone, Debug, PartialEq)]
pub struct VisualMesh {
    /// Name of the body that it belongs to, as [`crate::model::Link::name`].
    pub link: String,
    /// Pose in the frame of that body (m).
    pub pose: Isometry3<f64>,
    /// Corners in the mesh's frame (m).
    pub vertices_m: Vec<[f32; 3]>,
    /// Corners of each triangle.
    pub faces: Vec<[u32; 3]>,
    /// Red, green, blue and opacity, 0 to 1.
    pub colour: [f64; 4],
}

/// Reads the visual meshes of an MJCF or URDF file, or of a robot card. Meshes that are turned by other attributes than
/// `quat`, or whose file has another format than STL, OBJ and DAE, are left out.
///
/// # Errors
/// [`ModelError`] names the file that is missing or unreadable.
pub fn visual_meshes(path: &Path, files: &ModelFiles) -> Result<Vec<VisualMesh>, ModelError> {
    let path = files::model_of(path)?;
    let mut text = compose::whole_text(&path)?;
    let document = xml::parse(&text)?;
    if urdf::is_urdf(&document) {
        text = urdf::to_mjcf(&document, &path, files, true)?;
    }
    let document = xml::parse(&text)?;
    let files = AssetFiles::of(&document, files::folder_of(&path))?;
    let mut found = Vec::new();
    for world in sections(document.root_element(), "worldbody") {
        collect(world, "world", None, &files, &mut found)?;
    }
    Ok(found)
}

/// Returns the mesh of a geom; `None` if it collides, or cannot be shown.
fn visual(
    files: &AssetFiles<'_>,
    geom: Node<'_, '_>,
    class: Option<&str>,
    link: &str,
) -> Result<Option<VisualMesh>, ModelError> {
    let geom = files.classes.with_defaults(geom, class, "geom")?;
    let collides = ["contype", "conaffinity"].iter().any(|bits| geom.number(bits).is_none_or(|value| value != 0.0));
    let is_turned = ["euler", "axisangle", "xyaxes", "zaxis"].iter().any(|turn| geom.get(turn).is_some());
    // Of two assets of one name the last one counts.
    let asset = |tag: &str, name: &str| {
        files.assets.iter().rev().map(|(_, asset)| asset).find(|asset| asset.tag == tag && asset.label == name)
    };
    let name = geom.get("mesh").filter(|_| !collides && !is_turned);
    let Some(mesh) = name.and_then(|name| asset("mesh", name)) else { return Ok(None) };
    let Some(path) = files.path_of(mesh).filter(|path| files::is_mesh(path)) else { return Ok(None) };
    let scene = files::read_mesh(&mesh.label, &path)?;
    let scale = mesh.list_over("scale", [1.0; 3]);
    let (mut vertices_m, mut faces) = (Vec::new(), Vec::new());
    for part in &scene.meshes {
        let first = vertices_m.len() as u32;
        let scaled = |vertex: &[f32; 3]| std::array::from_fn(|axis| (f64::from(vertex[axis]) * scale[axis]) as f32);
        vertices_m.extend(part.vertices.iter().map(scaled));
        faces.extend(part.faces.iter().map(|face| face.map(|corner| first + corner)));
    }
    let material = geom.get("material").and_then(|name| asset("material", name));
    let colour = material.map_or(GREY, |material| material.list_over("rgba", GREY));
    let [w, x, y, z] = geom.list_over("quat", [1.0, 0.0, 0.0, 0.0]);
    let place = Vector3::from(geom.list_over("pos", [0.0; 3]));
    Ok(Some(VisualMesh {
        link: link.to_owned(),
        pose: Isometry3::from_parts(place.into(), UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z))),
        vertices_m,
        faces,
        colour: geom.list_over("rgba", colour),
    }))
}

fn collect<'a>(
    node: Node<'a, '_>,
    link: &str,
    class: Option<&'a str>,
    files: &AssetFiles<'_>,
    found: &mut Vec<VisualMesh>,
) -> Result<(), ModelError> {
    for child in elements(node) {
        let within = child.attribute("childclass").or(class);
        match child.tag_name().name() {
            "geom" if found.len() < MESHES_MAX => found.extend(visual(files, child, class, link)?),
            "body" => collect(child, child.attribute("name").unwrap_or(link), within, files, found)?,
            _ => {}
        }
    }
    Ok(())
}
