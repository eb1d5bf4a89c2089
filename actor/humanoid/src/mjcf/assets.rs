//! Meshes and height fields whose numbers are in the text.

use std::cell::OnceCell;
use std::collections::BTreeMap;

use nalgebra::{Matrix3, Point3, Quaternion, UnitQuaternion, Vector3};
use roxmltree::Node;

use super::defaults::Classes;
use super::element::{self, Element};
use super::vocabulary;
use super::xml::{elements, sections};
use crate::error::ModelError;
use crate::model::moments::{Moments, Sum};
use crate::model::{HEIGHT_FIELD_SIDE_MAX, HeightField, hull, length};

/// Assets of a text, by name.
#[derive(Debug, Default)]
pub(super) struct Assets {
    /// Meshes with vertices in the text.
    meshes: BTreeMap<String, Mesh>,
    height_fields: BTreeMap<String, Element>,
    /// Moments of mesh files, in the frame of the geom.
    of_files: BTreeMap<String, Moments>,
}

#[derive(Debug)]
struct Mesh {
    vertices: Vec<Point3<f64>>,
    /// Corners of its convex hull, once a geom needs them.
    hull: OnceCell<Option<Vec<Point3<f64>>>>,
    /// Element, and its triangles in the text, if any.
    element: Element,
    faces: Vec<[usize; 3]>,
}

/// Beginning of the name of a `<numeric>` with the moments of a mesh file.
pub(super) const MOMENTS: &str = "treadmill_moments_";

/// Returns whether a node has the moments of a mesh file.
pub(super) fn is_moments(node: &Node<'_, '_>) -> bool {
    node.attribute("name").is_some_and(|name| name.starts_with(MOMENTS))
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

    /// Reads the moments of mesh files in the `<custom>` sections of a text.
    pub(super) fn read_moments(&mut self, root: Node<'_, '_>) -> Result<(), ModelError> {
        for node in sections(root, "custom").flat_map(elements) {
            let Some(mesh) = node.attribute("name").and_then(|name| name.strip_prefix(MOMENTS)) else { continue };
            let numbers = node.attribute("data").and_then(element::numbers).unwrap_or_default();
            let moments = Moments::from_numbers(&numbers).ok_or_else(|| {
                ModelError::unsupported(&format!("mesh `{mesh}`"), "its moments must be ten numbers, the first above 0")
            })?;
            self.of_files.insert(mesh.to_owned(), moments);
        }
        Ok(())
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

    /// Returns the moments of a mesh in the frame of its geom; `None` if they are those of its hull.
    pub(super) fn moments(&self, name: &str) -> Result<Option<Moments>, ModelError> {
        let of_text = |mesh: &Mesh| match (mesh.element.get("inertia"), mesh.faces.is_empty()) {
            (Some("convex"), _) | (Some("exact" | "legacy") | None, true) => Ok(None),
            _ => moments(&mesh.element, &vertices(&mesh.element), &mesh.faces).map(Some),
        };
        match self.of_files.get(name) {
            Some(moments) => Ok(Some(*moments)),
            None => self.meshes.get(name).map_or(Ok(None), of_text),
        }
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
    let (linear, shift_m) = placement(mesh)?;
    let placed = |vertex: &Point3<f64>| Point3::from(linear * vertex.coords + shift_m);
    let vertices: Vec<Point3<f64>> = vertices(mesh).iter().map(placed).collect();
    if !vertices.iter().flat_map(|vertex| vertex.iter()).all(|entry| entry.abs() < 1e6) {
        return Err(mesh.refused("its vertices are more than 1000 km away; check `scale`"));
    }
    let corner = |number: &f64| Some(*number as usize).filter(|corner| *corner < vertices.len());
    let corners = mesh.list("face").unwrap_or_default().iter().map(corner).collect::<Option<Vec<usize>>>();
    let corners = corners.filter(|corners| corners.len().is_multiple_of(3)).ok_or_else(|| {
        mesh.refused(format!("`face` must be three indices below {} for each triangle", vertices.len()))
    })?;
    Ok(Mesh { vertices, hull: OnceCell::new(), element: mesh.clone(), faces: corners.as_chunks().0.to_vec() })
}

/// Returns the vertices in the text, in the frame of the text.
fn vertices(mesh: &Element) -> Vec<Point3<f64>> {
    mesh.list("vertex")
        .unwrap_or_default()
        .as_chunks()
        .0
        .iter()
        .map(|vertex: &[f64; 3]| Point3::from(*vertex))
        .collect()
}

/// Returns the motion from the frame of a text or file to that of the geom: `x → linear x + shift`.
fn placement(mesh: &Element) -> Result<(Matrix3<f64>, Vector3<f64>), ModelError> {
    let [w, x, y, z] = mesh.list_over("refquat", [1.0, 0.0, 0.0, 0.0]);
    let turn = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-9)
        .ok_or_else(|| mesh.refused("`refquat` must not be zero"))?;
    let scale = Vector3::from(mesh.list_over("scale", [1.0; 3]));
    let linear = Matrix3::from_diagonal(&scale) * turn.inverse().to_rotation_matrix();
    Ok((linear, -(linear * Vector3::from(mesh.list_over("refpos", [0.0; 3])))))
}

/// Returns the moments of a mesh by its `inertia`, in the frame of its geom; `points` are in that of its text or file.
pub(super) fn moments(mesh: &Element, points: &[Point3<f64>], faces: &[[usize; 3]]) -> Result<Moments, ModelError> {
    let (linear, shift_m) = placement(mesh)?;
    let placed: Vec<Point3<f64>> = points.iter().map(|point| Point3::from(linear * point.coords + shift_m)).collect();
    // A mirror image has its faces inside out.
    let is_mirrored = linear.determinant() < 0.0;
    let turned = |[a, b, c]: &[usize; 3]| if is_mirrored { [*c, *b, *a] } else { [*a, *b, *c] };
    let faces: Vec<[usize; 3]> = faces.iter().map(turned).collect();
    let found = match mesh.get("inertia") {
        Some("convex") => Moments::of_hull(&placed),
        Some("shell") if faces.is_empty() => hull::faces(&placed).map(|faces| Moments::of_shell(&placed, &faces)),
        Some("shell") => Some(Moments::of_shell(&placed, &faces)),
        _ if placed.iter().flat_map(|point| point.iter()).any(|entry| !entry.is_finite()) => None,
        kind => {
            // As in MuJoCo, absolute sums take faces as they are, also where they leave holes.
            let sum = if kind == Some("exact") { Sum::Signed } else { Sum::Absolute };
            (sum == Sum::Absolute || is_closed(points, &faces)).then(|| Moments::of_faces(&placed, &faces, sum))
        }
    };
    found.filter(|moments| moments.volume() > 0.0).ok_or_else(|| {
        mesh.refused(
            "its mass is unknown, because its faces leave holes or are turned inside out; set inertia=\"convex\" in <mesh>, \
             or give the body an <inertial>",
        )
    })
}

/// Returns whether two faces share each edge, in opposite directions.
fn is_closed(points: &[Point3<f64>], faces: &[[usize; 3]]) -> bool {
    // Faces along each edge in its two directions.
    let mut edges: BTreeMap<[[u64; 3]; 2], [u32; 2]> = BTreeMap::new();
    // Files repeat a vertex for every triangle, and may write 0 as −0.
    let key = |corner: usize| [0, 1, 2].map(|axis| (points[corner][axis] + 0.0).to_bits());
    for [a, b, c] in faces {
        if key(*a) == key(*b) || key(*b) == key(*c) || key(*c) == key(*a) {
            continue;
        }
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let (from, to) = (key(*from), key(*to));
            let is_ascending = from < to;
            let edge = if is_ascending { [from, to] } else { [to, from] };
            edges.entry(edge).or_default()[usize::from(is_ascending)] += 1;
        }
    }
    edges.values().all(|directions| *directions == [1, 1])
}

/// Returns elevations as heights from 0 to `top_m`. The first row of the text is that of the greatest y.
fn scaled(elevation: &[f64], columns: usize, top_m: f64) -> Vec<f64> {
    let least = elevation.iter().copied().fold(f64::INFINITY, f64::min);
    let most = elevation.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let factor = if most > least { top_m / (most - least) } else { 0.0 };
    elevation.chunks_exact(columns).rev().flatten().map(|entry| (entry - least) * factor).collect()
}
