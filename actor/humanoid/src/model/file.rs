//! Model files, with their `<include>`s inserted.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use super::xml::{self, MODEL_BYTES_MAX};
use crate::error::ModelError;

/// Reads a model file and replaces each `<include>` by the content of its file.
///
/// As in MuJoCo, paths of included files are relative to the outermost file, and no file is included twice. Mesh and
/// texture files are not read.
///
/// # Errors
/// [`ModelError`] names the file that is missing or too long, or the text that is not XML.
pub fn read_model_file(path: &Path) -> Result<String, ModelError> {
    let mut reader = Reader { folder: path.parent().unwrap_or(Path::new("")).to_path_buf(), seen: Vec::new() };
    reader.read(path.to_path_buf())
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
    let failed = |source| ModelError::File { path: path.to_path_buf(), source };
    let file = File::open(path).map_err(failed)?;
    check_length(file.metadata().map_err(failed)?.len())?;
    let mut text = String::new();
    // The length of a pipe is unknown before it is read.
    file.take(MODEL_BYTES_MAX as u64 + 1).read_to_string(&mut text).map_err(failed)?;
    check_length(text.len() as u64)?;
    Ok(text)
}

fn check_length(bytes: u64) -> Result<(), ModelError> {
    if bytes > MODEL_BYTES_MAX as u64 {
        return Err(ModelError::TooLarge { bytes, limit: MODEL_BYTES_MAX as u64 });
    }
    Ok(())
}
