//! Files that a model names: reading with bounds, included texts, and the assets with their paths.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::{self, Read};
use std::panic;
use std::path::{Path, PathBuf};

use mesh_loader::{Loader, Scene};
use roxmltree::{Document, Node};

use super::defaults::Classes;
use super::element::Element;
use super::xml::{self, MODEL_BYTES_MAX, elements, sections};
use crate::card::RobotCard;
use crate::error::ModelError;

/// Largest file of a mesh or of heights.
const FILE_BYTES_MAX: u64 = 64 << 20;
/// Bytes before the number of triangles in a binary STL file.
const STL_HEADER: usize = 80;

/// Returns whether a file has one of these extensions, in any case.
pub(super) fn has_extension(path: &Path, allowed: &[&str]) -> bool {
    path.extension().is_some_and(|kind| allowed.iter().any(|allowed| kind.eq_ignore_ascii_case(allowed)))
}

/// Returns whether a file is a robot card.
pub(super) fn is_card(path: &Path) -> bool {
    has_extension(path, &["toml"])
}

/// Returns the model file that a robot card names, or that `path` is.
pub(super) fn model_of(path: &Path) -> Result<PathBuf, ModelError> {
    if !is_card(path) {
        return Ok(path.to_path_buf());
    }
    let name = RobotCard::parse(&read_text(path)?)?.model;
    if name.is_empty() {
        return Err(ModelError::Card("`model`, the path of the model file, is missing".to_owned()));
    }
    let model = folder_of(path).join(name);
    match is_card(&model) {
        true => Err(ModelError::Card(format!("`model` is `{}`, but must be an MJCF or URDF file", model.display()))),
        false => Ok(model),
    }
}

/// Returns the folder of a file.
pub(super) fn folder_of(path: &Path) -> &Path {
    path.parent().unwrap_or(Path::new(""))
}

/// Returns the text of an MJCF file in which each `<include>` is replaced.
pub(super) fn text_with_includes(path: &Path) -> Result<String, ModelError> {
    Includes { folder: folder_of(path), seen: vec![path.to_path_buf()] }.read(path)
}

struct Includes<'a> {
    folder: &'a Path,
    seen: Vec<PathBuf>,
}

impl Includes<'_> {
    fn read(&mut self, path: &Path) -> Result<String, ModelError> {
        let text = read_text(path)?;
        let document = xml::parse(&text)?;
        let (mut whole, mut done) = (String::new(), 0);
        for include in document.descendants().filter(|node| node.has_tag_name("include")) {
            let inner = self.read_included(include.attribute("file").unwrap_or_default())?;
            let range = include.range();
            whole.push_str(&text[done..range.start]);
            whole.push_str(&inner);
            done = range.end;
            check_length(whole.len() as u64)?;
        }
        whole.push_str(&text[done..]);
        check_length(whole.len() as u64)?;
        Ok(whole)
    }

    /// Returns the content of an included file's outermost element.
    fn read_included(&mut self, name: &str) -> Result<String, ModelError> {
        let path = self.folder.join(name);
        if name.is_empty() {
            return Err(ModelError::unsupported("include", "`file` is missing"));
        }
        if self.seen.contains(&path) {
            return Err(ModelError::unsupported("include", format!("`{name}` is included twice")));
        }
        self.seen.push(path.clone());
        let text = self.read(&path)?;
        let document = xml::parse(&text)?;
        let root = document.root_element();
        if !matches!(root.tag_name().name(), "mujoco" | "mujocoinclude") {
            return Err(ModelError::unsupported(name, "the outermost element must be <mujoco> or <mujocoinclude>"));
        }
        let inside = root.first_child().zip(root.last_child());
        Ok(inside.map_or(String::new(), |(first, last)| text[first.range().start..last.range().end].to_owned()))
    }
}

/// Elements of a text that may name files, with defaults, and the folder of these files.
pub(super) struct AssetFiles<'a> {
    pub(super) classes: Classes,
    folder: PathBuf,
    are_paths_stripped: bool,
    /// Nodes of meshes, height fields and materials, with their elements; the label is the name.
    pub(super) assets: Vec<(Node<'a, 'a>, Element)>,
}

impl<'a> AssetFiles<'a> {
    /// Reads the assets of a text; `folder` is that of the outermost model file.
    pub(super) fn of(document: &'a Document<'a>, folder: &Path) -> Result<Self, ModelError> {
        let root = document.root_element();
        let classes = Classes::of(root)?;
        let mut assets = Vec::new();
        for node in sections(root, "asset").flat_map(elements) {
            let mut element = match node.tag_name().name() {
                tag @ ("mesh" | "material") => classes.with_defaults(node, None, tag)?,
                "hfield" => Element::of(node, "hfield"),
                _ => continue,
            };
            let stem = element.get("file").and_then(|file| Path::new(file).file_stem());
            let stem = stem.map(|stem| stem.to_string_lossy().into_owned());
            if let Some(name) = element.get("name").map(str::to_owned).or(stem) {
                element.label = name;
                assets.push((node, element));
            }
        }
        let setting = |name: &str| sections(root, "compiler").filter_map(|compiler| compiler.attribute(name)).last();
        // As in MuJoCo 4.0, `meshdir` is that of height fields, too; within one element it precedes `assetdir`.
        let folder_of = |compiler: Node<'a, 'a>| compiler.attribute("meshdir").or(compiler.attribute("assetdir"));
        let subfolder = sections(root, "compiler").filter_map(folder_of).last().unwrap_or_default();
        let are_paths_stripped = setting("strippath") == Some("true");
        Ok(Self { classes, folder: folder.join(subfolder), are_paths_stripped, assets })
    }

    /// Returns the path of an asset's file.
    pub(super) fn path_of(&self, asset: &Element) -> Option<PathBuf> {
        let given = Path::new(asset.get("file").filter(|file| !file.is_empty())?);
        // The files of attached models have whole paths.
        let is_stripped = self.are_paths_stripped && given.is_relative();
        Some(self.folder.join(given.file_name().filter(|_| is_stripped).map_or(given, Path::new)))
    }
}

/// Returns whether a mesh file has a format that is read.
pub(super) fn is_mesh(path: &Path) -> bool {
    has_extension(path, &["stl", "obj", "dae"])
}

/// Reads an STL, OBJ or DAE file.
pub(super) fn read_mesh(name: &str, path: &Path) -> Result<Scene, ModelError> {
    let mut bytes = read_bytes(path)?;
    if has_extension(path, &["stl"]) && is_binary_stl(&bytes) {
        // The loader takes a header that begins like a text for one.
        bytes[..STL_HEADER].fill(0);
    }
    let refuse = |why: String| {
        ModelError::unsupported(&format!("mesh `{name}`"), format!("`{}` cannot be read: {why}", path.display()))
    };
    if has_extension(path, &["dae"]) {
        check_collada(&bytes).map_err(refuse)?;
    }
    // The loader indexes what a COLLADA file says without a check.
    let loaded = panic::catch_unwind(|| Loader::default().load_from_slice(&bytes, path));
    loaded.map_err(|_| refuse("its indices and arrays do not fit".to_owned()))?.map_err(|why| refuse(why.to_string()))
}

/// Refuses COLLADA files of which the loader would leave out a part.
fn check_collada(bytes: &[u8]) -> Result<(), String> {
    let text = std::str::from_utf8(bytes).map_err(|why| why.to_string())?;
    let document = Document::parse(text).map_err(|why| why.to_string())?;
    let mut placed = BTreeSet::new();
    for node in document.descendants().filter(Node::is_element) {
        match node.tag_name().name() {
            tag @ ("instance_node" | "instance_controller") => {
                return Err(format!("<{tag}> is not read; convert it to STL"));
            }
            "instance_geometry" if !placed.insert(node.attribute("url")) => {
                return Err("it places a geometry twice; convert it to STL".to_owned());
            }
            _ => {}
        }
    }
    Ok(())
}

/// Vertices, and the three of each triangle.
pub(super) type Triangles = (Vec<[f32; 3]>, Vec<[usize; 3]>);

/// Returns vertices and triangles of a mesh file. As in MuJoCo, the vertices of an OBJ file count whether a face names them
/// or not, by their first three numbers.
pub(super) fn triangles(name: &str, path: &Path) -> Result<Triangles, ModelError> {
    let scene = read_mesh(name, path)?;
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    if has_extension(path, &["obj"]) {
        let text = read_bytes(path)?;
        for line in String::from_utf8_lossy(&text).lines() {
            let mut words = line.split_whitespace();
            match words.next() {
                Some("v") => {
                    let mut number = || words.next().and_then(|word| word.parse().ok()).unwrap_or(f32::NAN);
                    vertices.push([number(), number(), number()]);
                }
                Some("f") => {
                    let corners: Vec<usize> = words.filter_map(|word| corner(word, vertices.len())).collect();
                    faces.extend(corners.windows(2).skip(1).map(|pair| [corners[0], pair[0], pair[1]]));
                }
                _ => {}
            }
        }
        return Ok((vertices, faces));
    }
    for part in scene.meshes {
        let first = vertices.len();
        vertices.extend(part.vertices);
        faces.extend(part.faces.iter().map(|face| face.map(|corner| first + corner as usize)));
    }
    Ok((vertices, faces))
}

/// Returns the index of a vertex that a face of an OBJ file names: from 1, or backwards from the last one, as in `7/2/3`.
fn corner(word: &str, vertices: usize) -> Option<usize> {
    let number: isize = word.split('/').next()?.parse().ok()?;
    let index = if number < 0 { vertices.checked_add_signed(number)? } else { usize::try_from(number - 1).ok()? };
    Some(index).filter(|index| *index < vertices)
}

/// Returns what kind of mesh file MuJoCo does not read, if it is one.
pub(super) fn unknown_to_mujoco(path: &Path) -> Result<Option<&'static str>, ModelError> {
    Ok(match () {
        () if has_extension(path, &["dae"]) => Some("Collada"),
        () if has_extension(path, &["stl"]) && !is_binary_stl(&read_bytes(path)?) => Some("an STL of text"),
        () => None,
    })
}

/// Returns whether a file is as long as the number of triangles after its header says (50 bytes each).
fn is_binary_stl(bytes: &[u8]) -> bool {
    let count = bytes.get(STL_HEADER..).and_then(|rest| rest.first_chunk::<4>()).copied().map(u32::from_le_bytes);
    count.is_some_and(|count| bytes.len() as u64 == STL_HEADER as u64 + 4 + 50 * u64::from(count))
}

/// Reads a text file of at most [`MODEL_BYTES_MAX`] bytes.
pub(super) fn read_text(path: &Path) -> Result<String, ModelError> {
    String::from_utf8(read_at_most(path, MODEL_BYTES_MAX as u64)?).map_err(|why| {
        let source = io::Error::new(io::ErrorKind::InvalidData, why.utf8_error());
        ModelError::File { path: path.to_path_buf(), source }
    })
}

/// Reads a file of a mesh or of heights.
pub(super) fn read_bytes(path: &Path) -> Result<Vec<u8>, ModelError> {
    read_at_most(path, FILE_BYTES_MAX)
}

fn read_at_most(path: &Path, limit: u64) -> Result<Vec<u8>, ModelError> {
    let failed = |source| ModelError::File { path: path.to_path_buf(), source };
    let file = File::open(path).map_err(failed)?;
    check(file.metadata().map_err(failed)?.len(), limit)?;
    let mut bytes = Vec::new();
    // The length of a pipe is unknown before it is read.
    file.take(limit + 1).read_to_end(&mut bytes).map_err(failed)?;
    check(bytes.len() as u64, limit)?;
    Ok(bytes)
}

/// Refuses a text of more than [`MODEL_BYTES_MAX`] bytes.
pub(super) fn check_length(bytes: u64) -> Result<(), ModelError> {
    check(bytes, MODEL_BYTES_MAX as u64)
}

fn check(bytes: u64, limit: u64) -> Result<(), ModelError> {
    if bytes > limit { Err(ModelError::TooLarge { bytes, limit }) } else { Ok(()) }
}
