//! Animation that is written picture by picture: a GIF by this program, or an MP4 by `ffmpeg`.

use std::{
    fs,
    io::{self, BufWriter, Read, Seek, Write},
    os::unix::fs::PermissionsExt,
    path::{Path, PathBuf},
    process::{Child, Command, Stdio},
};

use anyhow::{Context, bail};
use tempfile::{NamedTempFile, TempPath};
use treadmill_render::{Gif, Picture};
use treadmill_runtime::atomic_file::{Destination, destination};

use crate::launch::exit_code::Usage;

/// Longest part of ffmpeg's messages that is shown.
const MESSAGE_BYTES_MAX: u64 = 2000;

/// Bytes that are written, and removed again, when the film is opened.
const FIRST_BYTES: usize = 64 << 10;

/// Reads width and height of a picture, in pixels.
pub fn size(text: &str) -> Result<(u32, u32), String> {
    let sides =
        text.split_once(['x', 'X', '×']).and_then(|(width, height)| Some((width.parse().ok()?, height.parse().ok()?)));
    let is_allowed = |(width, height): &(u32, u32)| (16..=4096).contains(width) && (16..=4096).contains(height);
    let expected = "expected width and height of 16 to 4096 pixels each, as in 640x480";
    sides.filter(is_allowed).ok_or_else(|| expected.to_string())
}

/// Animation under way. It gets its name when it is complete.
pub struct Film {
    path: PathBuf,
    encoder: Encoder,
}

enum Encoder {
    Gif(Box<Gif<BufWriter<NamedTempFile>>>),
    Mp4 { process: Child, messages: NamedTempFile, file: TempPath },
}

impl Film {
    /// Opens the animation `path`; its extension chooses the format.
    ///
    /// # Errors
    /// If the extension is unknown, the folder is not writable, or `ffmpeg` is missing.
    pub fn open(path: &Path, size: (u32, u32), fps: u32) -> anyhow::Result<Self> {
        let extension = path.extension().map(|end| end.to_string_lossy().to_lowercase()).unwrap_or_default();
        let is_mp4 = match extension.as_str() {
            "gif" => false,
            "mp4" => true,
            _ => return Err(Usage(format!("--film {}: the name must end in .gif or .mp4", path.display())).into()),
        };
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        if !folder.is_dir() {
            anyhow::bail!("--film {}: the folder `{}` does not exist", path.display(), folder.display());
        }
        let mut file = NamedTempFile::new_in(folder)
            .with_context(|| format!("--film {}: the folder is not writable", path.display()))?;
        // On a full disk the first bytes fail, before an episode is played in vain.
        let written = file.write_all(&[0; FIRST_BYTES]).and_then(|()| file.as_file().sync_all());
        written
            .and_then(|()| file.as_file().set_len(0))
            .and_then(|()| file.rewind())
            .with_context(|| format!("--film {}: the file cannot be written", path.display()))?;
        let encoder = match is_mp4 {
            false => Encoder::Gif(Box::new(Gif::new(BufWriter::new(file), f64::from(fps)))),
            true => open_ffmpeg(path, file.into_temp_path(), size, fps)?,
        };
        Ok(Self { path: path.to_path_buf(), encoder })
    }

    /// Appends a picture.
    pub fn add(&mut self, picture: &Picture) -> anyhow::Result<()> {
        let context = || format!("--film {}", self.path.display());
        match &mut self.encoder {
            Encoder::Gif(gif) => gif.add(picture).with_context(context),
            Encoder::Mp4 { process, messages, .. } => {
                let input = process.stdin.as_mut().context("ffmpeg has no input")?;
                let written = input.write_all(&picture.rgb);
                written.with_context(|| format!("{}: ffmpeg ended early: {}", context(), text_of(messages)))
            }
        }
    }

    /// Completes the animation and returns its name and size.
    pub fn finish(self) -> anyhow::Result<String> {
        let Self { path, encoder } = self;
        let context = || format!("--film {}", path.display());
        let file = match encoder {
            Encoder::Gif(gif) => {
                let written = gif.finish().with_context(context)?.into_inner().map_err(|why| why.into_error());
                written.with_context(context)?.into_temp_path()
            }
            Encoder::Mp4 { mut process, mut messages, file } => {
                drop(process.stdin.take());
                let status = process.wait().with_context(context)?;
                if !status.success() {
                    bail!("{}: ffmpeg failed: {}", context(), text_of(&mut messages));
                }
                file
            }
        };
        let bytes = fs::metadata(&file).with_context(context)?.len();
        keep(file, &path).with_context(context)?;
        Ok(format!("{} ({:.1} MB)", path.display(), bytes as f64 / 1e6))
    }
}

fn open_ffmpeg(path: &Path, file: TempPath, size: (u32, u32), fps: u32) -> anyhow::Result<Encoder> {
    let messages = NamedTempFile::new()?;
    let mut command = Command::new("ffmpeg");
    command.args(["-loglevel", "error", "-y", "-f", "rawvideo", "-pixel_format", "rgb24"]);
    command.args(["-video_size", &format!("{}x{}", size.0, size.1), "-framerate", &fps.to_string(), "-i", "-"]);
    // Most players show only this pixel format, which needs even sides.
    command.args(["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", "-f", "mp4"]);
    command.arg(&*file).stdin(Stdio::piped()).stdout(Stdio::null()).stderr(messages.reopen()?);
    match command.spawn() {
        Ok(process) => Ok(Encoder::Mp4 { process, messages, file }),
        Err(why) if why.kind() == io::ErrorKind::NotFound => {
            let why =
                "an MP4 needs the program ffmpeg, which is not installed; install it, or name a file that ends in .gif";
            Err(Usage(format!("--film {}: {why}", path.display())).into())
        }
        Err(why) => Err(why).context("ffmpeg cannot be started"),
    }
}

fn text_of(messages: &mut NamedTempFile) -> String {
    let mut text = String::new();
    let read = messages.rewind().and_then(|()| messages.take(MESSAGE_BYTES_MAX).read_to_string(&mut text));
    if read.is_err() || text.trim().is_empty() { "it gave no reason".to_string() } else { text.trim().to_string() }
}

/// Gives a temporary file its name and permissions 0644, or writes it to a device or a pipe of this name.
fn keep(file: TempPath, path: &Path) -> anyhow::Result<()> {
    let path = match destination(path) {
        Destination::File(path) => path,
        Destination::Stream(mut stream) => {
            io::copy(&mut fs::File::open(&file)?, &mut stream)?;
            return Ok(());
        }
    };
    fs::set_permissions(&file, fs::Permissions::from_mode(0o644))?;
    file.persist(path)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_size_has_two_numbers_in_bounds() {
        assert_eq!(size("640x480"), Ok((640, 480)));
        for wrong in ["640", "640x", "x480", "0x100", "5000x100", "-1x100", "640x480x3", "1e2x100"] {
            assert!(size(wrong).unwrap_err().contains("640x480"), "{wrong}");
        }
    }
}
