//! Meshes and height fields whose numbers are in the text.

use std::cell::OnceCell;
use std::collections::BTreeMap;

use nalgebra::{Isometry3, Point3, Quaternion, UnitQuaternion, Vector3};
use roxmltree::Node;

use super::defaults::Classes;
use super::element::Element;
use super::vocabulary;
use crate::error::ModelError;
use crate::model::{HEIGHT_FIELD_SIDE_MAX, HeightField, hull, length};

/// Assets of a text, by name.
#[derive(Debug, Default)]
pub(super) struct Assets {
    /// Meshes with vertices in the text.
    meshes: BTreeMap<String, Mesh>,
    height_fields: BTreeMap<String, Element>,
}

#[derive(Debug)]
struct Mesh {
    vertices: Vec<Point3<f64>>,
    /// Corners of its convex hull, once a geom needs them.
    hull: OnceCell<Option<Vec<Point3<f64>>>>,
    /// Whether its mass is that of its convex hull.
    is_convex: bool,
}

impl Assets {
    /// Reads a `<mesh>` or a `<hfield>`. A mesh without vertices is ignored: a geom that needs it is refused.
    pub(super) fn read(&mut self, node: Node<'_, '_>, classes: &Classes) -> Result<(), ModelError> {
        let tag = node.tag_name().name();
        let Some(name) = node.attribute("name") else { return Ok(()) };
        let label = format!("{} `{name}`", if tag == "mesh" { tag } else { "height field" });
        let is_new = if tag == "mesh" {
            let element = classes.with_defaults(node, None, label.as_str())?;
            if element.get("vertex").is_none() {
                return Ok(());
            }
            vocabulary::check(tag, &element)?;
            self.meshes.insert(name.to_owned(), read_mesh(&element)?).is_none()
        } else {
            let element = Element::of(node, label.as_str());
            vocabulary::check(tag, &element)?;
            self.height_fields.insert(name.to_owned(), element).is_none()
        };
        if is_new { Ok(()) } else { Err(ModelError::unsupported(&label, "there are two of this name")) }
    }

    /// Returns the vertices of a mesh's convex hull in the frame of its geom; `None` if the text has no vertices.
    pub(super) fn hull(&self, name: &str) -> Result<Option<Vec<Point3<f64>>>, ModelError> {
        let Some(mesh) = self.meshes.get(name) else { return Ok(None) };
        let flat = || {
            let problem =
                "its vertices lie in a plane or nearly coincide, so that it has no convex hull; use a thin box";
            ModelError::unsupported(&format!("mesh `{name}`"), problem)
        };
        let hull = mesh.hull.get_or_init(|| hull::vertices(&mesh.vertices));
        hull.clone().ok_or_else(flat).map(Some)
    }

    /// Returns whether the mass of a mesh is that of its convex hull.
    pub(super) fn is_convex(&self, name: &str) -> bool {
        self.meshes.get(name).is_none_or(|mesh| mesh.is_convex)
    }

    /// Returns the height field of a level geom at `centre_m`.
    pub(super) fn height_field(&self, name: &str, centre_m: Point3<f64>) -> Result<HeightField, ModelError> {
        let field = self
            .height_fields
            .get(name)
            .ok_or_else(|| ModelError::unsupported(&format!("height field `{name}`"), "there is no such <hfield>"))?;
        if field.get("file").is_some() {
            let problem = "the numbers of its file are missing: they are read with a model file, but not from a text; write \
                           them into `elevation`";
            return Err(field.refused(problem));
        }
        let count = |side: &str| {
            let count = field.number(side).unwrap_or(0.0);
            if (2.0..=HEIGHT_FIELD_SIDE_MAX as f64).contains(&count) {
                return Ok(count as usize);
            }
            let expected = format!("a whole number from 2 to {HEIGHT_FIELD_SIDE_MAX}");
            Err(ModelError::attribute(&field.label, side, &count.to_string(), expected))
        };
        let (rows, columns) = (count("nrow")?, count("ncol")?);
        let [half_x_m, half_y_m, top_m, base_m] = field.list_over("size", [0.0; 4]);
        for (what, size_m) in [
            ("half length along x (m)", half_x_m),
            ("half length along y (m)", half_y_m),
            ("greatest height (m)", top_m),
            ("depth of the base (m)", base_m),
        ] {
            length(&field.label, what, size_m)?;
        }
        let heights_m = match field.list("elevation") {
            None => vec![0.0; rows * columns],
            Some(given) if given.len() == rows * columns => scaled(&given, columns, top_m),
            Some(given) => {
                let problem = format!("`elevation` has {} numbers instead of {rows} × {columns}", given.len());
                return Err(field.refused(problem));
            }
        };
        let field = HeightField { rows, columns, half_x_m, half_y_m, centre_m, heights_m };
        field.check()?;
        Ok(field)
    }
}

fn read_mesh(mesh: &Element) -> Result<Mesh, ModelError> {
    let given = mesh.list("vertex").unwrap_or_default();
    if !given.len().is_multiple_of(3) {
        let problem = format!("`vertex` has {} numbers, but needs three for each vertex", given.len());
        return Err(mesh.refused(problem));
    }
    let [w, x, y, z] = mesh.list_over("refquat", [1.0, 0.0, 0.0, 0.0]);
    let turn = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-9)
        .ok_or_else(|| mesh.refused("`refquat` must not be zero"))?;
    let place = Vector3::from(mesh.list_over("refpos", [0.0; 3]));
    let reference = Isometry3::from_parts(place.into(), turn);
    let scale = Vector3::from(mesh.list_over("scale", [1.0; 3]));
    let placed = |vertex: &[f64]| {
        let vertex = Point3::new(vertex[0], vertex[1], vertex[2]);
        Point3::from(reference.inverse_transform_point(&vertex).coords.component_mul(&scale))
    };
    let vertices: Vec<Point3<f64>> = given.chunks_exact(3).map(placed).collect();
    if !vertices.iter().flat_map(|vertex| vertex.iter()).all(|entry| entry.abs() < 1e6) {
        return Err(mesh.refused("its vertices are more than 1000 km away; check `scale`"));
    }
    let is_convex = mesh.get("face").is_none() || mesh.get("inertia") == Some("convex");
    Ok(Mesh { vertices, hull: OnceCell::new(), is_convex })
}

/// Returns elevations as heights from 0 to `top_m`. The first row of the text is that of the greatest y.
fn scaled(elevation: &[f64], columns: usize, top_m: f64) -> Vec<f64> {
    let least = elevation.iter().copied().fold(f64::INFINITY, f64::min);
    let most = elevation.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let factor = if most > least { top_m / (most - least) } else { 0.0 };
    elevation.chunks_exact(columns).rev().flatten().map(|entry| (entry - least) * factor).collect()
}
