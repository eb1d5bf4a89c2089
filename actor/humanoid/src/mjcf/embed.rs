//! Files that a model names, written into its text: included texts, convex hulls of meshes, and height fields.
//!
//! A text without files is all that another machine needs. Meshes that neither collide nor give mass stay as they are: the
//! simulation ignores them.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use nalgebra::Point3;
use png::{BitDepth, ColorType, Transformations};
use roxmltree::{Document, Node};

use super::assets::{self, MOMENTS};
use super::card_text::with_card;
use super::compose;
use super::defaults::Classes;
use super::element::{self, Attribute, Element};
use super::files::{self, AssetFiles};
use super::notices;
use super::urdf::{self, ModelFiles};
use super::xml::{self, elements, sections};
use crate::clearance;
use crate::config::PhysicsSettings;
use crate::error::ModelError;
use crate::model::{HEIGHT_FIELD_SIDE_MAX, Model, hull, moments::Moments};
use crate::physics::Physics;

/// Reads a model file and replaces each `<include>` by the content of its file.
///
/// As in MuJoCo, paths of included files are relative to the outermost file, and no file is included twice. Of the
/// other files that the model names, those that motion depends on are written into the text: hulls of meshes, and
/// height fields.
///
/// A URDF becomes MJCF, with the robot on the ground. A robot card, a file that ends in `.toml`, gives the text of its model
/// with the card in it.
///
/// # Errors
/// [`ModelError`] names the file that is missing or too long, or the text that is not XML, or what in a URDF cannot be
/// simulated.
pub fn read_model_file(path: &Path, files: &ModelFiles) -> Result<String, ModelError> {
    let model = files::model_of(path)?;
    let folder = files::folder_of(&model);
    let text = compose::whole_text(&model)?;
    let document = xml::parse(&text)?;
    let embedded = if urdf::is_urdf(&document) {
        let text = urdf::to_mjcf(&document, &model, files, false)?;
        on_ground(&embed(&xml::parse(&text)?, folder)?)?
    } else if document.descendants().any(|node| node.has_attribute("file")) {
        embed(&document, folder)?
    } else {
        text
    };
    let whole = if files::is_card(path) { with_card(&embedded, &files::read_text(path)?)? } else { embedded };
    files::check_length(whole.len() as u64)?;
    Ok(whole)
}

/// Returns the text of a robot at height 0 with its lowest shape on the ground; a URDF has no height.
fn on_ground(text: &str) -> Result<String, ModelError> {
    let physics = Physics::new(Model::without_motors(text)?, PhysicsSettings::default())?;
    let lowest_m = clearance::of_robot_m(&physics, |_, _| 0.0);
    Ok(lowest_m.map_or_else(|| text.to_owned(), |lowest_m| urdf::raised(text, -lowest_m)))
}

/// Returns the text with the numbers of all files that motion depends on; `folder` is that of the outermost model file.
fn embed(document: &Document<'_>, folder: &Path) -> Result<String, ModelError> {
    let text = document.input_text();
    let found = AssetFiles::of(document, folder)?;
    let wanted = wanted(document.root_element(), &found.classes)?;
    let (mut whole, mut done) = (String::with_capacity(text.len()), 0);
    let (mut custom, mut notes) = (String::new(), Vec::new());
    for (node, asset) in &found.assets {
        let (tag, name) = (node.tag_name().name(), &asset.label);
        let Some(path) = found.path_of(asset) else { continue };
        let Some(is_mass) = wanted.get(&(tag, name.clone())) else { continue };
        let numbers = if tag == "mesh" { mesh(asset, &path)? } else { heights(name, &path)? };
        if let Some(kind) = files::unknown_to_mujoco(&path)? {
            notes.push(format!("MuJoCo 4.0 does not read the file of mesh `{name}`, which is {kind}"));
        }
        if *is_mass {
            let moments: Vec<String> = moments(asset, &path)?.numbers().iter().map(f64::to_string).collect();
            let data = [("name".to_owned(), format!("{MOMENTS}{name}")), ("data".to_owned(), moments.join(" "))];
            xml::write(&mut custom, "numeric", &data);
        }
        let mut own = Element::of(*node, tag).attributes;
        own.retain(|(attribute, _)| !["name", "file", "nrow", "ncol", "content_type"].contains(&attribute.as_str()));
        own.insert(0, ("name".to_owned(), name.clone()));
        own.extend(numbers);
        whole.push_str(&text[done..node.range().start]);
        xml::write(&mut whole, tag, &own);
        done = node.range().end;
    }
    whole.push_str(&text[done..]);
    notices::write(&mut custom, "mesh", &notes);
    if custom.is_empty() { Ok(whole) } else { xml::with_custom(&whole, &custom) }
}

/// Assets that geoms need, by tag and name, and whether they give mass.
type Needs = BTreeMap<(&'static str, String), bool>;

/// Returns the meshes that collide or give mass, and the height fields.
fn wanted(root: Node<'_, '_>, classes: &Classes) -> Result<Needs, ModelError> {
    let setting = |name: &str| sections(root, "compiler").filter_map(|compiler| compiler.attribute(name)).last();
    let groups = setting("inertiagrouprange").and_then(element::numbers).filter(|groups| groups.len() == 2);
    let groups = groups.map_or(0.0..=5.0, |groups| groups[0]..=groups[1]);
    let from_geoms = setting("inertiafromgeom");
    let pairs = sections(root, "contact").flat_map(elements);
    let paired: BTreeSet<&str> =
        pairs.flat_map(|pair| [pair.attribute("geom1"), pair.attribute("geom2")]).flatten().collect();
    let mut found = Needs::new();
    for world in sections(root, "worldbody") {
        collect_needs(world, None, false, from_geoms, &mut |geom, class, counts| {
            let element = classes.with_defaults(geom, class, geom.attribute("name").unwrap_or("geom"))?;
            let is_zero = |name: &str| element.number(name).is_some_and(|value| value == 0.0);
            let is_paired = geom.attribute("name").is_some_and(|name| paired.contains(name));
            let collides = is_paired || !(is_zero("contype") && is_zero("conaffinity"));
            let is_counted = counts && groups.contains(&element.number("group").unwrap_or(0.0));
            let is_weightless = is_zero("mass") || (element.get("mass").is_none() && is_zero("density"));
            let is_mass = is_counted && !is_weightless;
            for (tag, is_needed) in [("mesh", collides || is_mass), ("hfield", collides)] {
                if let Some(asset) = element.get(tag).filter(|_| is_needed) {
                    *found.entry((tag, asset.to_owned())).or_default() |= is_mass;
                }
            }
            Ok(())
        })?;
    }
    Ok(found)
}

/// Visits every geom below a node with its class, and with whether it may count for a mass; `counts` is that of the node's
/// own geoms, and `from_geoms` the compiler's `inertiafromgeom`.
fn collect_needs<'a>(
    node: Node<'a, '_>,
    class: Option<&'a str>,
    counts: bool,
    from_geoms: Option<&str>,
    visit: &mut impl FnMut(Node<'_, '_>, Option<&str>, bool) -> Result<(), ModelError>,
) -> Result<(), ModelError> {
    for child in elements(node) {
        let class_within = child.attribute("childclass").or(class);
        match child.tag_name().name() {
            "geom" => visit(child, class, counts)?,
            "body" => {
                let counts = match from_geoms {
                    Some("true") => true,
                    Some("false") => false,
                    _ => !elements(child).any(|part| part.has_tag_name("inertial")),
                };
                collect_needs(child, class_within, counts, from_geoms, visit)?;
            }
            "frame" => collect_needs(child, class_within, counts, from_geoms, visit)?,
            _ => {}
        }
    }
    Ok(())
}

/// Returns the corners of a mesh's convex hull as attributes.
fn mesh(asset: &Element, path: &Path) -> Result<Vec<Attribute>, ModelError> {
    let label = format!("mesh `{}`", asset.label);
    if !files::is_mesh(path) {
        let problem =
            format!("`{}` is neither STL, OBJ nor DAE; convert it, or collide with primitive shapes", path.display());
        return Err(ModelError::unsupported(&label, problem));
    }
    let (mut points, _) = files::triangles(&asset.label, path)?;
    points.retain(|vertex| vertex.iter().all(|entry| entry.is_finite()));
    // Files repeat a vertex for every triangle.
    points.sort_unstable_by(|one, other| {
        one.iter().map(|entry| entry.to_bits()).cmp(other.iter().map(|entry| entry.to_bits()))
    });
    points.dedup();
    let points: Vec<Point3<f64>> = points.into_iter().map(|point| Point3::from(point.map(f64::from))).collect();
    let Some(corners) = hull::simplified(&points) else {
        let problem = format!("the vertices of `{}` lie in a plane or nearly coincide; use a thin box", path.display());
        return Err(ModelError::unsupported(&label, problem));
    };
    let numbers: Vec<String> =
        corners.iter().flat_map(|corner| corner.iter()).map(|entry| (*entry as f32).to_string()).collect();
    Ok(vec![("vertex".to_owned(), numbers.join(" "))])
}

/// Returns the moments of a mesh file: its hull has at most 64 corners, its mass is that of the whole.
fn moments(asset: &Element, path: &Path) -> Result<Moments, ModelError> {
    let (vertices, faces) = files::triangles(&asset.label, path)?;
    let points: Vec<Point3<f64>> = vertices.into_iter().map(|vertex| Point3::from(vertex.map(f64::from))).collect();
    let labelled = Element { label: format!("mesh `{}`", asset.label), ..asset.clone() };
    assets::moments(&labelled, &points, &faces)
}

/// Returns the heights of a grey PNG file as attributes; its first row is that of the greatest y.
fn heights(name: &str, path: &Path) -> Result<Vec<Attribute>, ModelError> {
    let label = format!("height field `{name}`");
    let refuse = |why: String| ModelError::unsupported(&label, format!("`{}`: {why}", path.display()));
    let bytes = files::read_bytes(path)?;
    let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
    decoder.set_transformations(Transformations::EXPAND | Transformations::STRIP_16);
    let mut reader = decoder.read_info().map_err(|why| refuse(format!("it is not a PNG file: {why}")))?;
    let (columns, rows) = (reader.info().width as usize, reader.info().height as usize);
    if columns.max(rows) > HEIGHT_FIELD_SIDE_MAX || columns.min(rows) < 2 {
        return Err(refuse(format!(
            "it has {columns} × {rows} points, but needs 2 to {HEIGHT_FIELD_SIDE_MAX} on each side"
        )));
    }
    let mut pixels = vec![0; reader.output_buffer_size().ok_or_else(|| refuse("it is too large".to_owned()))?];
    let info = reader.next_frame(&mut pixels).map_err(|why| refuse(why.to_string()))?;
    let channels = match (info.color_type, info.bit_depth) {
        (ColorType::Grayscale, BitDepth::Eight) => 1,
        (ColorType::GrayscaleAlpha, BitDepth::Eight) => 2,
        (ColorType::Rgb, BitDepth::Eight) => 3,
        (ColorType::Rgba, BitDepth::Eight) => 4,
        (kind, depth) => return Err(refuse(format!("images of type {kind:?} and depth {depth:?} are not read"))),
    };
    // Like MuJoCo, the first channel counts.
    let elevation: Vec<String> =
        pixels[..info.buffer_size()].iter().step_by(channels).map(|grey| grey.to_string()).collect();
    Ok(vec![
        ("nrow".to_owned(), rows.to_string()),
        ("ncol".to_owned(), columns.to_string()),
        ("elevation".to_owned(), elevation.join(" ")),
    ])
}
