//! Model files, with their `<include>`s, meshes and height fields inserted.

use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use super::embed;
use super::xml::{self, MODEL_BYTES_MAX};
use crate::card::{self, RobotCard};
use crate::error::ModelError;

/// Reads a model file and replaces each `<include>` by the content of its file.
///
/// As in MuJoCo, paths of included files are relative to the outermost file, and no file is included twice. Of the other files
/// that the model names, those that motion depends on are written into the text: hulls of meshes, and height fields.
///
/// A robot card, a file that ends in `.toml`, gives the text of its model with the card in it.
///
/// # Errors
/// [`ModelError`] names the file that is missing or too long, or the text that is not XML.
pub fn read_model_file(path: &Path) -> Result<String, ModelError> {
    if path.extension().is_some_and(|kind| kind.eq_ignore_ascii_case("toml")) {
        return read_card_file(path);
    }
    read_mjcf_file(path)
}

fn read_card_file(path: &Path) -> Result<String, ModelError> {
    let whole = card::with_card(&read_mjcf_file(&mjcf_of(path)?)?, &read_text(path)?)?;
    check_length(whole.len() as u64)?;
    Ok(whole)
}

/// Returns the MJCF file that a robot card names, or that `path` is.
pub(super) fn mjcf_of(path: &Path) -> Result<PathBuf, ModelError> {
    let is_card = |path: &Path| path.extension().is_some_and(|kind| kind.eq_ignore_ascii_case("toml"));
    if !is_card(path) {
        return Ok(path.to_path_buf());
    }
    let name = RobotCard::parse(&read_text(path)?)?.model;
    if name.is_empty() {
        return Err(ModelError::Card("`model`, the path of the model file, is missing".to_owned()));
    }
    let model = path.parent().unwrap_or(Path::new("")).join(name);
    match is_card(&model) {
        true => Err(ModelError::Card(format!("`model` is `{}`, but must be an MJCF file", model.display()))),
        false => Ok(model),
    }
}

/// Returns the text of an MJCF file in which each `<include>` is replaced.
pub(super) fn text_with_includes(path: &Path) -> Result<String, ModelError> {
    let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
    Reader { folder, seen: Vec::new() }.read(path.to_path_buf())
}

fn read_mjcf_file(path: &Path) -> Result<String, ModelError> {
    let text = text_with_includes(path)?;
    // The reader of the whole model reports other errors better.
    if !text.contains("file=") && !text.contains("file =") {
        return Ok(text);
    }
    let text = embed::embed(&text, path.parent().unwrap_or(Path::new("")))?;
    check_length(text.len() as u64)?;
    Ok(text)
}

struct Reader {
    folder: PathBuf,
    seen: Vec<PathBuf>,
}

impl Reader {
    fn read(&mut self, path: PathBuf) -> Result<String, ModelError> {
        let text = read_text(&path)?;
        // The reader of the whole model reports other errors better.
        if !text.contains("<include") {
            return Ok(text);
        }
        self.seen.push(path);
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
        let text = self.read(path)?;
        let document = xml::parse(&text)?;
        let root = document.root_element();
        if !matches!(root.tag_name().name(), "mujoco" | "mujocoinclude") {
            return Err(ModelError::unsupported(name, "the outermost element must be <mujoco> or <mujocoinclude>"));
        }
        let inside = root.first_child().zip(root.last_child());
        Ok(inside.map_or(String::new(), |(first, last)| text[first.range().start..last.range().end].to_owned()))
    }
}

fn read_text(path: &Path) -> Result<String, ModelError> {
    let bytes = read_bytes(path, MODEL_BYTES_MAX as u64)?;
    String::from_utf8(bytes).map_err(|why| {
        let source = io::Error::new(io::ErrorKind::InvalidData, why.utf8_error());
        ModelError::File { path: path.to_path_buf(), source }
    })
}

/// Reads a file of at most `limit` bytes.
pub(super) fn read_bytes(path: &Path, limit: u64) -> Result<Vec<u8>, ModelError> {
    let failed = |source| ModelError::File { path: path.to_path_buf(), source };
    let file = File::open(path).map_err(failed)?;
    check(file.metadata().map_err(failed)?.len(), limit)?;
    let mut bytes = Vec::new();
    // The length of a pipe is unknown before it is read.
    file.take(limit + 1).read_to_end(&mut bytes).map_err(failed)?;
    check(bytes.len() as u64, limit)?;
    Ok(bytes)
}

fn check_length(bytes: u64) -> Result<(), ModelError> {
    check(bytes, MODEL_BYTES_MAX as u64)
}

fn check(bytes: u64, limit: u64) -> Result<(), ModelError> {
    if bytes > limit { Err(ModelError::TooLarge { bytes, limit }) } else { Ok(()) }
}
