//! Files that a model names, written into its text: convex hulls of meshes, and height fields.
//!
//! A text without files is all that another machine needs. Meshes that neither collide nor give mass stay as they are: the
//! simulation ignores them.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::path::{Path, PathBuf};

use mesh_loader::Loader;
use nalgebra::Point3;
use png::{BitDepth, ColorType, Transformations};
use roxmltree::Node;

use super::defaults::{Attribute, Classes, attributes_of, get};
use super::file::read_bytes;
use super::values::number;
use super::xml::{self, elements, sections};
use super::{HEIGHT_FIELD_SIDE_MAX, hull};
use crate::error::ModelError;

/// Largest file of a mesh or of heights.
pub(super) const FILE_BYTES_MAX: u64 = 64 << 20;

/// Returns the text with the numbers of all files that motion depends on; `folder` is that of the outermost model file.
///
/// # Errors
/// [`ModelError`] names the file that is missing, too long, or of another format.
pub(super) fn embed(text: &str, folder: &Path) -> Result<String, ModelError> {
    let document = xml::parse(text)?;
    let root = document.root_element();
    let mut classes = Classes::default();
    for node in sections(root, "default") {
        classes.read_main(node)?;
    }
    let wanted = wanted(root, &classes)?;
    let folder = AssetFolder::new(folder, root);
    let mut replaced: Vec<(Range<usize>, &str, Vec<Attribute>)> = Vec::new();
    for asset in sections(root, "asset").flat_map(elements) {
        let tag = asset.tag_name().name();
        let attributes = match tag {
            "mesh" => classes.with_defaults(asset, None, tag)?,
            "hfield" => attributes_of(asset),
            _ => continue,
        };
        let Some(file) = get(&attributes, "file").filter(|file| !file.is_empty()) else { continue };
        let stem = || Path::new(file).file_stem().map(|stem| stem.to_string_lossy().into_owned());
        let Some(name) = get(&attributes, "name").map(str::to_owned).or_else(stem) else { continue };
        let Some(is_mass) = wanted.get(&(tag, name.clone())) else { continue };
        let path = folder.file(file);
        let numbers = if tag == "mesh" { mesh(&name, &path, &attributes, *is_mass)? } else { heights(&name, &path)? };
        let mut own = attributes_of(asset);
        own.retain(|(attribute, _)| !["name", "file", "nrow", "ncol", "content_type"].contains(&attribute.as_str()));
        own.insert(0, ("name".to_owned(), name));
        own.extend(numbers);
        replaced.push((asset.range(), tag, own));
    }
    let (mut whole, mut done) = (String::with_capacity(text.len()), 0);
    for (range, tag, attributes) in replaced {
        whole.push_str(&text[done..range.start]);
        xml::open(&mut whole, tag, &attributes);
        xml::close(&mut whole, tag);
        done = range.end;
    }
    whole.push_str(&text[done..]);
    Ok(whole)
}

/// Assets that geoms need, by tag and name, and whether they give mass.
type Needs = BTreeMap<(&'static str, String), bool>;

/// Returns the meshes that collide or give mass, and the height fields.
fn wanted(root: Node<'_, '_>, classes: &Classes) -> Result<Needs, ModelError> {
    let pairs = sections(root, "contact").flat_map(elements);
    let paired: BTreeSet<&str> =
        pairs.flat_map(|pair| [pair.attribute("geom1"), pair.attribute("geom2")]).flatten().collect();
    let mut found = Needs::new();
    for world in sections(root, "worldbody") {
        collect_needs(world, None, true, &mut |geom, class, has_inertia| {
            let attributes = classes.with_defaults(geom, class, geom.attribute("name").unwrap_or("geom"))?;
            let is_zero = |name: &str| number(&attributes, name).is_some_and(|value| value == 0.0);
            let is_paired = geom.attribute("name").is_some_and(|name| paired.contains(name));
            let collides = is_paired || !(is_zero("contype") && is_zero("conaffinity"));
            let is_mass =
                !(has_inertia || is_zero("mass") || (get(&attributes, "mass").is_none() && is_zero("density")));
            for (tag, is_needed) in [("mesh", collides || is_mass), ("hfield", collides)] {
                if let Some(asset) = get(&attributes, tag).filter(|_| is_needed) {
                    *found.entry((tag, asset.to_owned())).or_default() |= is_mass;
                }
            }
            Ok(())
        })?;
    }
    Ok(found)
}

/// Visits every geom below a node with its class; `has_inertia` is whether the geom's mass is given or irrelevant.
fn collect_needs<'a>(
    node: Node<'a, '_>,
    class: Option<&'a str>,
    has_inertia: bool,
    visit: &mut impl FnMut(Node<'_, '_>, Option<&str>, bool) -> Result<(), ModelError>,
) -> Result<(), ModelError> {
    for child in elements(node) {
        let class_within = child.attribute("childclass").or(class);
        match child.tag_name().name() {
            "geom" => visit(child, class, has_inertia)?,
            "body" => {
                let has_inertia = elements(child).any(|part| part.has_tag_name("inertial"));
                collect_needs(child, class_within, has_inertia, visit)?;
            }
            "frame" => collect_needs(child, class_within, has_inertia, visit)?,
            _ => {}
        }
    }
    Ok(())
}

/// Folder of a model's meshes and height fields.
pub(super) struct AssetFolder {
    path: PathBuf,
    are_paths_stripped: bool,
}

impl AssetFolder {
    pub(super) fn new(model: &Path, root: Node<'_, '_>) -> Self {
        let setting = |name: &str| sections(root, "compiler").filter_map(|compiler| compiler.attribute(name)).last();
        // As in MuJoCo 4.0, `meshdir` is that of height fields, too, and precedes `assetdir`.
        let folder = setting("meshdir").or(setting("assetdir")).unwrap_or_default();
        Self { path: model.join(folder), are_paths_stripped: setting("strippath") == Some("true") }
    }

    pub(super) fn file(&self, name: &str) -> PathBuf {
        let given = Path::new(name);
        self.path.join(given.file_name().filter(|_| self.are_paths_stripped).map_or(given, Path::new))
    }
}

/// Returns the corners of a mesh's convex hull as attributes.
fn mesh(name: &str, path: &Path, attributes: &[Attribute], is_mass: bool) -> Result<Vec<Attribute>, ModelError> {
    let label = format!("mesh `{name}`");
    let is_known =
        path.extension().is_some_and(|kind| kind.eq_ignore_ascii_case("stl") || kind.eq_ignore_ascii_case("obj"));
    if !is_known {
        let problem =
            format!("`{}` is neither STL nor OBJ; convert it, or collide with primitive shapes", path.display());
        return Err(ModelError::unsupported(&label, problem));
    }
    let bytes = read_bytes(path, FILE_BYTES_MAX)?;
    let scene = Loader::default()
        .load_from_slice(&bytes, path)
        .map_err(|why| ModelError::unsupported(&label, format!("`{}` cannot be read: {why}", path.display())))?;
    let vertices = scene.meshes.iter().flat_map(|mesh| &mesh.vertices);
    let mut points: Vec<[f32; 3]> =
        vertices.copied().filter(|vertex| vertex.iter().all(|entry| entry.is_finite())).collect();
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
    let mut found = vec![("vertex".to_owned(), numbers.join(" "))];
    if is_mass && get(attributes, "inertia") != Some("convex") {
        // Marks that the mass is not that of the hull.
        found.push(("face".to_owned(), "0 1 2".to_owned()));
    }
    Ok(found)
}

/// Returns the heights of a grey PNG file as attributes; its first row is that of the greatest y.
fn heights(name: &str, path: &Path) -> Result<Vec<Attribute>, ModelError> {
    let label = format!("height field `{name}`");
    let refuse = |why: String| ModelError::unsupported(&label, format!("`{}`: {why}", path.display()));
    let bytes = read_bytes(path, FILE_BYTES_MAX)?;
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
