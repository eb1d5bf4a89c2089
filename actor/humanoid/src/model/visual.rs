//! Visual meshes of a model file, for viewers on the machine that has the files. The simulation does without them.

use std::collections::BTreeMap;
use std::path::Path;

use mesh_loader::Loader;
use nalgebra::{Isometry3, Quaternion, UnitQuaternion, Vector3};
use roxmltree::Node;

use super::defaults::{Attribute, Classes, get};
use super::embed::{AssetFolder, FILE_BYTES_MAX};
use super::file::{mjcf_of, read_bytes, text_with_includes};
use super::values::{list_over, number};
use super::xml::{self, elements, sections};
use crate::error::ModelError;

/// Most visual meshes of a file.
const MESHES_MAX: usize = 1024;
const GREY: [f64; 4] = [0.7, 0.7, 0.7, 1.0];

/// Mesh that is seen but does not touch.
#[derive(Clone, Debug, PartialEq)]
pub struct VisualMesh {
    /// Name of the body that it belongs to, as [`super::Link::name`].
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

/// Reads the visual meshes of an MJCF file or a robot card. Meshes that are turned by other attributes than `quat`, or whose file
/// has another format than STL and OBJ, are left out.
///
/// # Errors
/// [`ModelError`] names the file that is missing or unreadable.
pub fn visual_meshes(path: &Path) -> Result<Vec<VisualMesh>, ModelError> {
    let path = mjcf_of(path)?;
    let text = text_with_includes(&path)?;
    let document = xml::parse(&text)?;
    let root = document.root_element();
    let mut files = Files::new(root, path.parent().unwrap_or(Path::new("")))?;
    let mut found = Vec::new();
    for world in sections(root, "worldbody") {
        collect(world, "world", None, &mut files, &mut found)?;
    }
    Ok(found)
}

/// Meshes and materials of a model file.
struct Files<'a> {
    classes: Classes,
    folder: AssetFolder,
    meshes: BTreeMap<String, Vec<Attribute>>,
    materials: BTreeMap<&'a str, Vec<Attribute>>,
}

impl<'a> Files<'a> {
    fn new(root: Node<'a, '_>, folder: &Path) -> Result<Self, ModelError> {
        let mut classes = Classes::default();
        for node in sections(root, "default") {
            classes.read_main(node)?;
        }
        let (mut meshes, mut materials) = (BTreeMap::new(), BTreeMap::new());
        for asset in sections(root, "asset").flat_map(elements) {
            match asset.tag_name().name() {
                "mesh" => {
                    let attributes = classes.with_defaults(asset, None, "mesh")?;
                    let stem = get(&attributes, "file").and_then(|file| Path::new(file).file_stem());
                    let stem = stem.map(|stem| stem.to_string_lossy().into_owned());
                    if let Some(name) = get(&attributes, "name").map(str::to_owned).or(stem) {
                        meshes.insert(name, attributes);
                    }
                }
                "material" => {
                    let attributes = classes.with_defaults(asset, None, "material")?;
                    asset.attribute("name").map(|name| materials.insert(name, attributes));
                }
                _ => {}
            }
        }
        Ok(Self { classes, folder: AssetFolder::new(folder, root), meshes, materials })
    }

    /// Returns the mesh of a geom; `None` if it collides, or cannot be shown.
    fn visual(&self, geom: Node<'_, '_>, class: Option<&str>, link: &str) -> Result<Option<VisualMesh>, ModelError> {
        let attributes = self.classes.with_defaults(geom, class, "geom")?;
        let collides =
            ["contype", "conaffinity"].iter().any(|bits| number(&attributes, bits).is_none_or(|value| value != 0.0));
        let is_turned = ["euler", "axisangle", "xyaxes", "zaxis"].iter().any(|turn| get(&attributes, turn).is_some());
        let Some(name) = get(&attributes, "mesh").filter(|_| !collides && !is_turned) else { return Ok(None) };
        let Some(mesh) = self.meshes.get(name) else { return Ok(None) };
        let Some(path) = get(mesh, "file").map(|file| self.folder.file(file)) else { return Ok(None) };
        if !path.extension().is_some_and(|kind| kind.eq_ignore_ascii_case("stl") || kind.eq_ignore_ascii_case("obj")) {
            return Ok(None);
        }
        let bytes = read_bytes(&path, FILE_BYTES_MAX)?;
        let scene = Loader::default().load_from_slice(&bytes, &path).map_err(|why| {
            ModelError::unsupported(&format!("mesh `{name}`"), format!("`{}` cannot be read: {why}", path.display()))
        })?;
        let scale = list_over(mesh, "scale", [1.0; 3]);
        let (mut vertices_m, mut faces) = (Vec::new(), Vec::new());
        for part in &scene.meshes {
            let first = vertices_m.len() as u32;
            vertices_m.extend(
                part.vertices.iter().map(|vertex| {
                    std::array::from_fn::<f32, 3, _>(|axis| (f64::from(vertex[axis]) * scale[axis]) as f32)
                }),
            );
            faces.extend(part.faces.iter().map(|face| face.map(|corner| first + corner)));
        }
        let material = get(&attributes, "material").and_then(|name| self.materials.get(name));
        let colour = list_over(material.map_or(&[][..], Vec::as_slice), "rgba", GREY);
        let [w, x, y, z] = list_over(&attributes, "quat", [1.0, 0.0, 0.0, 0.0]);
        let place = Vector3::from(list_over(&attributes, "pos", [0.0; 3]));
        Ok(Some(VisualMesh {
            link: link.to_owned(),
            pose: Isometry3::from_parts(place.into(), UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z))),
            vertices_m,
            faces,
            colour: list_over(&attributes, "rgba", colour),
        }))
    }
}

fn collect<'a>(
    node: Node<'a, '_>,
    link: &str,
    class: Option<&'a str>,
    files: &mut Files<'_>,
    found: &mut Vec<VisualMesh>,
) -> Result<(), ModelError> {
    for child in elements(node) {
        let within = child.attribute("childclass").or(class);
        match child.tag_name().name() {
            "geom" if found.len() < MESHES_MAX => found.extend(files.visual(child, class, link)?),
            "body" => collect(child, child.attribute("name").unwrap_or(link), within, files, found)?,
            _ => {}
        }
    }
    Ok(())
}
