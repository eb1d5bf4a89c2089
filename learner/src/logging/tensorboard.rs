//! TensorBoard's event files: one protobuf message per record, each record framed with masked checksums.
//!
//! The messages are the parts of TensorFlow's `event.proto`, `summary.proto` and `tensor.proto` that scalars and text
//! need; like everything that is serialised, they stand in `proto`.

use std::fs::{File, OpenOptions};
use std::io;
use std::path::Path;

use treadmill_proto::event_file::{Dim, Event, Metadata, PluginData, SessionLog, Shape, Summary, Tensor, Value};

use super::{Scalars, append_whole};

/// What the first record of every event file says.
const FILE_VERSION: &str = "brain.Event:2";

/// `DT_STRING` of TensorFlow's `types.proto`.
const DT_STRING: i32 = 7;

/// `SessionLog.START` of `event.proto`.
const SESSION_START: i32 = 1;

/// How many names are tried until one is free.
const NAMES_MAX: u32 = 10_000;

/// Writes one event file. A resumed run writes another one into the same folder; TensorBoard shows both as one.
#[derive(Debug)]
pub struct EventWriter {
    file: File,
    created_unix_s: f64,
}

impl EventWriter {
    /// Makes `events.out.tfevents.{seconds}.{host}.{process}.{count}` in `folder`, always a new file.
    pub fn create(folder: &Path, time_unix_s: f64, host: &str) -> io::Result<Self> {
        let file = create_new(folder, time_unix_s as u64, host)?;
        let mut writer = Self { file, created_unix_s: time_unix_s };
        writer.event(Event {
            wall_time: time_unix_s,
            file_version: Some(FILE_VERSION.to_string()),
            ..Event::default()
        })?;
        Ok(writer)
    }

    /// On resume: TensorBoard forgets what older files of this folder hold from `first_step` on, because the run is
    /// about to make it again. Give the first step that may be written, the checkpoint's plus one.
    pub fn resume(&mut self, first_step: u64, time_unix_s: f64) -> io::Result<()> {
        self.event(Event {
            wall_time: time_unix_s,
            step: first_step as i64,
            session_log: Some(SessionLog { status: SESSION_START }),
            ..Event::default()
        })
    }

    /// Writes all scalars of one step as one record. What is not finite as a 32-bit float, TensorBoard's kind of
    /// number, is left out.
    pub fn scalars(&mut self, step: u64, time_unix_s: f64, scalars: &Scalars) -> io::Result<()> {
        let value: Vec<Value> = scalars
            .iter()
            .filter(|(_, value)| (*value as f32).is_finite())
            .map(|(tag, value)| Value { tag: tag.clone(), simple_value: Some(*value as f32), ..Value::default() })
            .collect();
        if value.is_empty() {
            return Ok(());
        }
        let summary = Some(Summary { value });
        self.event(Event { wall_time: time_unix_s, step: step as i64, summary, ..Event::default() })
    }

    /// Writes a text, such as the run's config, for TensorBoard's TEXT tab, which understands Markdown. It stands at
    /// step 0 and at the time the file was made.
    pub fn text(&mut self, tag: &str, text: &str) -> io::Result<()> {
        let value = Value {
            tag: tag.to_string(),
            tensor: Some(Tensor {
                dtype: DT_STRING,
                shape: Some(Shape { dim: vec![Dim { size: 1 }] }),
                string_val: vec![text.as_bytes().to_vec()],
            }),
            metadata: Some(Metadata { plugin_data: Some(PluginData { plugin_name: "text".to_string() }) }),
            ..Value::default()
        };
        let summary = Some(Summary { value: vec![value] });
        self.event(Event { wall_time: self.created_unix_s, summary, ..Event::default() })
    }

    fn event(&mut self, event: Event) -> io::Result<()> {
        append_whole(&mut self.file, &framed(&event.to_bytes()))
    }
}

/// TFRecord: length, checksum of the length, data, checksum of the data; all little-endian.
pub(super) fn framed(data: &[u8]) -> Vec<u8> {
    let length = (data.len() as u64).to_le_bytes();
    let mut record = Vec::with_capacity(data.len() + 16);
    record.extend_from_slice(&length);
    record.extend_from_slice(&masked_crc(&length).to_le_bytes());
    record.extend_from_slice(data);
    record.extend_from_slice(&masked_crc(data).to_le_bytes());
    record
}

/// A CRC-32C, rotated and shifted so that a checksum over data that holds checksums stays a good one.
pub(super) fn masked_crc(data: &[u8]) -> u32 {
    crc32c::crc32c(data).rotate_right(15).wrapping_add(0xa282_ead8)
}

fn create_new(folder: &Path, seconds: u64, host: &str) -> io::Result<File> {
    let allowed = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.');
    let host: String = host.chars().map(|c| if allowed(c) { c } else { '_' }).collect();
    let host = if host.is_empty() { "localhost" } else { &host };
    let process = std::process::id();
    // Names sort by time, the order in which TensorBoard reads them; hence the leading zeros.
    let path = |count: u32| folder.join(format!("events.out.tfevents.{seconds:010}.{host}.{process}.{count:04}"));
    for count in 0..NAMES_MAX {
        match OpenOptions::new().append(true).create_new(true).open(path(count)) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            opened => return opened,
        }
    }
    Err(io::Error::new(io::ErrorKind::AlreadyExists, format!("no free name for an event file in {}", folder.display())))
}
