//! TensorBoard's event files: one protobuf message per record, each framed with masked checksums.
//!
//! The messages, in `proto`, are the necessary parts of TensorBoard's schemas.
//!
//! # Layout
//! - [`histogram`]: counts of values.
//! - [`texts`]: description of a run as Markdown.
//! - [`hparams`]: hyperparameters for the comparison of runs.
//! - [`layout`]: charts of the CUSTOM SCALARS tab.

pub mod histogram;
pub mod hparams;
pub mod layout;
pub mod texts;

use std::fs::{self, File, OpenOptions};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use treadmill_config::Config;
use treadmill_proto::event_file::{
    Dim, Event, HparamsData, Metadata, PluginData, SessionLog, Shape, Summary, Tensor, Value,
};

pub use histogram::Histogram;

use super::{Scalars, append_whole};

/// Content of the first record of every event file.
const FILE_VERSION: &str = "brain.Event:2";

/// Prefix of every event file's name.
const FILE_PREFIX: &str = "events.out.tfevents.";

/// Suffix of the file that holds how the run ended.
const END_SUFFIX: &str = ".end";

/// Hyperparameters are within this number of bytes from a file's beginning.
const HEAD_BYTES: u64 = 64 << 10;

/// `DT_FLOAT`, `DT_DOUBLE` and `DT_STRING` of TensorBoard's `types.proto`.
const DT_FLOAT: i32 = 1;
const DT_DOUBLE: i32 = 2;
const DT_STRING: i32 = 7;

/// `DATA_CLASS_TENSOR` and `DATA_CLASS_BLOB_SEQUENCE` of `summary.proto`.
const CLASS_TENSOR: i32 = 2;
const CLASS_BLOBS: i32 = 3;

/// `SessionLog.START` of `event.proto`.
const SESSION_START: i32 = 1;

/// Writer of one event file. A resumed run writes another one into the same folder; TensorBoard shows both as one run.
#[derive(Debug)]
pub struct EventWriter {
    file: File,
    folder: PathBuf,
    host: String,
}

impl EventWriter {
    /// Creates a new file `events.out.tfevents.{seconds}.{host}.{process}.0000` in `folder`, whose name comes after all
    /// others. Removes the file that holds how the run ended, because the run continues.
    pub fn create(folder: &Path, time_unix_s: f64, host: &str) -> io::Result<Self> {
        for ended in event_files(folder)?.iter().filter(|path| path.to_string_lossy().ends_with(END_SUFFIX)) {
            fs::remove_file(ended)?;
        }
        Self::create_named(folder, time_unix_s, host, "")
    }

    fn create_named(folder: &Path, time_unix_s: f64, host: &str, suffix: &str) -> io::Result<Self> {
        let file = create_new(folder, seconds_after_others(folder, time_unix_s as u64)?, host, suffix)?;
        let mut writer = Self { file, folder: folder.to_path_buf(), host: host.to_string() };
        writer.event(Event {
            wall_time: time_unix_s,
            file_version: Some(FILE_VERSION.to_string()),
            ..Event::default()
        })?;
        Ok(writer)
    }

    /// Begins the session of a start. On resume, TensorBoard discards the older files' data from `first_step` on, because
    /// the run will write it again: the checkpoint's step plus one. It takes no notice of the first session, so a new run
    /// has one too, from step 0.
    pub fn begin_session(&mut self, first_step: u64, time_unix_s: f64) -> io::Result<()> {
        self.event(Event {
            wall_time: time_unix_s,
            step: first_step as i64,
            session_log: Some(SessionLog { status: SESSION_START }),
            ..Event::default()
        })
    }

    /// Writes all scalars of one step as one record of 32-bit floats; omits those that are not finite.
    pub fn scalars(&mut self, step: u64, time_unix_s: f64, scalars: &Scalars) -> io::Result<()> {
        let value: Vec<Value> = scalars
            .iter()
            .filter(|(_, value)| (*value as f32).is_finite())
            .map(|(tag, value)| Value { tag: tag.clone(), simple_value: Some(*value as f32), ..Value::default() })
            .collect();
        self.values(step, time_unix_s, value)
    }

    /// Writes histograms of one step as one record. They are tensors of the plugin `histograms`, because TensorBoard
    /// would convert the older `HistogramProto` to other buckets.
    pub fn histograms(&mut self, step: u64, time_unix_s: f64, histograms: &[(String, Histogram)]) -> io::Result<()> {
        let value = histograms.iter().map(|(tag, Histogram { rows })| Value {
            tag: tag.clone(),
            tensor: Some(Tensor {
                dtype: DT_DOUBLE,
                shape: shape(&[rows.len(), 3]),
                content: rows.iter().flatten().flat_map(|entry| entry.to_le_bytes()).collect::<Vec<_>>().into(),
                ..Tensor::default()
            }),
            metadata: metadata("histograms", Vec::new()),
            ..Value::default()
        });
        self.values(step, time_unix_s, value.collect())
    }

    /// Writes a Markdown text, such as the run's configuration, for TensorBoard's TEXT tab. It applies from `step` on.
    pub fn text(&mut self, step: u64, time_unix_s: f64, tag: &str, text: &str) -> io::Result<()> {
        // A single text; TensorBoard would show a list of texts as a table.
        self.strings(step, time_unix_s, tag, shape(&[]), vec![text.into()], metadata("text", Vec::new()))
    }

    /// Writes the charts of the CUSTOM SCALARS tab.
    pub fn layout(&mut self, step: u64, time_unix_s: f64, has_commands: bool) -> io::Result<()> {
        let charts = vec![layout::charts(has_commands).to_bytes()];
        self.strings(step, time_unix_s, layout::TAG, shape(&[]), charts, metadata("custom_scalars", Vec::new()))
    }

    /// Writes a picture of `width` by `height` pixels, which may move, for the IMAGES tab; `bytes` are those of its file.
    pub fn picture(
        &mut self,
        step: u64,
        time_unix_s: f64,
        tag: &str,
        [width, height]: [u32; 2],
        bytes: Vec<u8>,
    ) -> io::Result<()> {
        let strings = vec![width.to_string().into(), height.to_string().into(), bytes];
        let of_images = metadata("images", Vec::new()).map(|metadata| Metadata { data_class: CLASS_BLOBS, ..metadata });
        self.strings(step, time_unix_s, tag, shape(&[3]), strings, of_images)
    }

    fn strings(
        &mut self,
        step: u64,
        time_unix_s: f64,
        tag: &str,
        shape: Option<Shape>,
        strings: Vec<Vec<u8>>,
        metadata: Option<Metadata>,
    ) -> io::Result<()> {
        let string_val = strings.into_iter().map(Into::into).collect();
        let tensor = Some(Tensor { dtype: DT_STRING, shape, string_val, ..Tensor::default() });
        self.values(step, time_unix_s, vec![Value { tag: tag.to_string(), tensor, metadata, ..Value::default() }])
    }

    /// Writes the run's row of the HPARAMS tab, unless a file of this folder has it: TensorBoard uses the first.
    pub fn hyperparameters(&mut self, config: &Config, time_unix_s: f64) -> io::Result<()> {
        for file in event_files(&self.folder)? {
            if has_in_head(&file, hparams::START_TAG.as_bytes())? {
                return Ok(());
            }
        }
        let value = vec![
            hparams_value(hparams::EXPERIMENT_TAG, &hparams::experiment()),
            hparams_value(hparams::START_TAG, &hparams::session_start(config, time_unix_s)),
        ];
        self.values(0, time_unix_s, value)
    }

    /// Writes how the run ended to a separate file, which is removed when the run is resumed.
    pub fn end(&self, is_success: bool, time_unix_s: f64) -> io::Result<()> {
        let mut writer = Self::create_named(&self.folder, time_unix_s, &self.host, END_SUFFIX)?;
        let ended = hparams::session_end(is_success, time_unix_s);
        writer.values(0, time_unix_s, vec![hparams_value(hparams::END_TAG, &ended)])
    }

    fn values(&mut self, step: u64, time_unix_s: f64, value: Vec<Value>) -> io::Result<()> {
        if value.is_empty() {
            return Ok(());
        }
        let summary = Some(Summary { value });
        self.event(Event { wall_time: time_unix_s, step: step as i64, summary, ..Event::default() })
    }

    fn event(&mut self, event: Event) -> io::Result<()> {
        append_whole(&mut self.file, &framed(&event.to_bytes()))
    }
}

/// Returns a value for the HPARAMS tab, which reads only its metadata; the tensor is empty.
fn hparams_value(tag: &str, data: &HparamsData) -> Value {
    Value {
        tag: tag.to_string(),
        tensor: Some(Tensor { dtype: DT_FLOAT, shape: shape(&[0]), ..Tensor::default() }),
        metadata: metadata("hparams", data.to_bytes()),
        ..Value::default()
    }
}

fn metadata(plugin: &str, content: Vec<u8>) -> Option<Metadata> {
    let plugin_data = Some(PluginData { plugin_name: plugin.to_string(), content: content.into() });
    Some(Metadata { plugin_data, data_class: CLASS_TENSOR, ..Metadata::default() })
}

fn shape(sizes: &[usize]) -> Option<Shape> {
    Some(Shape { dim: sizes.iter().map(|size| Dim { size: *size as i64 }).collect() })
}

/// Returns the event files of a folder.
fn event_files(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        if entry.file_name().to_string_lossy().starts_with(FILE_PREFIX) {
            found.push(entry.path());
        }
    }
    Ok(found)
}

/// Returns seconds for the name of a new file, which then comes after all others: TensorBoard reads files in the order
/// of their names, and a run may be resumed within a second, or after its clock was set back.
fn seconds_after_others(folder: &Path, seconds: u64) -> io::Result<u64> {
    let seconds_of = |path: &PathBuf| -> Option<u64> {
        path.file_name()?.to_str()?.strip_prefix(FILE_PREFIX)?.split('.').next()?.parse().ok()
    };
    let newest = event_files(folder)?.iter().filter_map(seconds_of).max();
    Ok(newest.map_or(seconds, |newest| seconds.max(newest.saturating_add(1))))
}

fn has_in_head(file: &Path, part: &[u8]) -> io::Result<bool> {
    let mut head = Vec::new();
    File::open(file)?.take(HEAD_BYTES).read_to_end(&mut head)?;
    Ok(head.windows(part.len()).any(|window| window == part))
}

/// Returns a TFRecord: length, checksum of the length, data, checksum of the data; all little-endian.
pub(super) fn framed(data: &[u8]) -> Vec<u8> {
    let length = (data.len() as u64).to_le_bytes();
    let mut record = Vec::with_capacity(data.len() + 16);
    record.extend_from_slice(&length);
    record.extend_from_slice(&masked_crc(&length).to_le_bytes());
    record.extend_from_slice(data);
    record.extend_from_slice(&masked_crc(data).to_le_bytes());
    record
}

/// Returns the CRC-32C, rotated and shifted, so that checksums over data with checksums stay reliable.
pub(super) fn masked_crc(data: &[u8]) -> u32 {
    crc32c::crc32c(data).rotate_right(15).wrapping_add(0xa282_ead8)
}

fn create_new(folder: &Path, seconds: u64, host: &str, suffix: &str) -> io::Result<File> {
    let allowed = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.');
    let host: String = host.chars().map(|c| if allowed(c) { c } else { '_' }).collect();
    let host = if host.is_empty() { "localhost" } else { &host };
    let process = std::process::id();
    // Leading zeros make names sort by time, the order in which TensorBoard reads them.
    let name = format!("{FILE_PREFIX}{seconds:010}.{host}.{process}.0000{suffix}");
    OpenOptions::new().append(true).create_new(true).open(folder.join(name))
}

#[cfg(test)]
mod tests;
