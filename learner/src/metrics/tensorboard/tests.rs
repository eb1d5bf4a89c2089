//! Event files, read back by a separate reader.

use std::fs;
use std::path::Path;

use treadmill_config::Config;
use treadmill_proto::event_file::Event;

use super::{EventWriter, Histogram, framed, masked_crc};

/// Returns every event of a file, and checks the checksums.
fn read(path: &Path) -> Vec<Event> {
    let bytes = fs::read(path).unwrap();
    let mut rest = bytes.as_slice();
    let mut take = |count: usize| {
        let (taken, left) = rest.split_at_checked(count)?;
        rest = left;
        Some(taken)
    };
    let mut events = Vec::new();
    while let Some(length) = take(8) {
        assert_eq!(take(4).unwrap(), masked_crc(length).to_le_bytes());
        let data = take(u64::from_le_bytes(length.try_into().unwrap()) as usize).unwrap();
        assert_eq!(take(4).unwrap(), masked_crc(data).to_le_bytes());
        events.push(Event::from_bytes(data).unwrap());
    }
    events
}

fn files(folder: &Path) -> Vec<std::path::PathBuf> {
    let mut files: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files
}

fn scalars(values: &[(&str, f64)]) -> Vec<(String, f64)> {
    values.iter().map(|(tag, value)| (tag.to_string(), *value)).collect()
}

#[test]
fn a_picture_is_a_tensor_of_its_size_and_its_file() {
    let folder = tempfile::tempdir().unwrap();
    let mut writer = EventWriter::create(folder.path(), 1.0, "box").unwrap();
    writer.picture(7, 2.0, "film", [320, 240], b"GIF89a".to_vec()).unwrap();
    let events = read(&files(folder.path())[0]);
    let [value] = &events[1].summary.as_ref().unwrap().value[..] else { panic!("one value") };
    assert_eq!((events[1].step, &*value.tag), (7, "film"));
    let tensor = value.tensor.as_ref().unwrap();
    assert_eq!(tensor.string_val, [&b"320"[..], b"240", b"GIF89a"]);
    assert_eq!(tensor.shape.as_ref().unwrap().dim[0].size, 3);
    let metadata = value.metadata.as_ref().unwrap();
    assert_eq!((&*metadata.plugin_data.as_ref().unwrap().plugin_name, metadata.data_class), ("images", 3));
}

#[test]
fn a_record_is_framed_as_documented() {
    // The CRC-32C of "123456789" is e3069283 in published tables. Rotated right by 15 bits it is
    // 2507c60d: e3069283 >> 15 = 0001c60d, e3069283 << 17 = 25060000. Plus a282ead8 is c78ab0e5.
    assert_eq!(masked_crc(b"123456789"), 0xc78a_b0e5);
    let record = framed(b"123456789");
    assert_eq!(record.len(), 8 + 4 + 9 + 4);
    assert_eq!(record[..8], [9, 0, 0, 0, 0, 0, 0, 0]);
    assert_eq!(record[12..21], *b"123456789");
    assert_eq!(record[21..], [0xe5, 0xb0, 0x8a, 0xc7]);
}

#[test]
fn the_first_record_equals_that_of_tensorflow() {
    // wall_time = 1.0: field 1, 64 bit, 3ff0000000000000; file_version: field 3, 13 bytes.
    let event = Event { wall_time: 1.0, file_version: Some("brain.Event:2".into()), ..Event::default() };
    let expected = [&[0x09, 0, 0, 0, 0, 0, 0, 0xf0, 0x3f, 0x1a, 13][..], b"brain.Event:2"].concat();
    assert_eq!(event.to_bytes(), expected);

    let folder = tempfile::tempdir().unwrap();
    EventWriter::create(folder.path(), 1.0, "box").unwrap();
    assert_eq!(fs::read(&files(folder.path())[0]).unwrap(), framed(&expected));
}

#[test]
fn scalars_and_text_are_read_back() {
    let folder = tempfile::tempdir().unwrap();
    let mut writer = EventWriter::create(folder.path(), 1_700_000_000.9, "a box/1").unwrap();
    writer.text(0, 1_700_000_000.9, "config", "# *ä*").unwrap();
    writer.scalars(8192, 2.5, &scalars(&[("rollout/ep_rew_mean", 0.0), ("train/std", f64::NAN), ("x", 1e39)])).unwrap();
    writer.scalars(9000, 3.5, &scalars(&[("train/std", f64::NEG_INFINITY)])).unwrap();
    writer.begin_session(8193, 4.5).unwrap();

    let [file] = &files(folder.path())[..] else { panic!("one file") };
    let name = file.file_name().unwrap().to_str().unwrap();
    assert!(name.starts_with("events.out.tfevents.1700000000.a_box_1."), "{name}");

    let events = read(file);
    assert_eq!(events.len(), 4, "a step without a finite scalar has no event");
    let text = &events[1].summary.as_ref().unwrap().value[0];
    assert_eq!((text.tag.as_str(), text.simple_value), ("config", None));
    assert_eq!(text.tensor.as_ref().unwrap().string_val, ["# *ä*".as_bytes()]);
    assert_eq!(events[1].wall_time, 1_700_000_000.9);
    let values = &events[2].summary.as_ref().unwrap().value;
    assert_eq!((events[2].step, events[2].wall_time, values.len()), (8192, 2.5, 1));
    assert_eq!((values[0].tag.as_str(), values[0].simple_value), ("rollout/ep_rew_mean", Some(0.0)));
    assert_eq!((events[3].step, events[3].session_log.is_some()), (8193, true));
}

#[test]
fn a_new_file_comes_last_whatever_its_clock_and_process() {
    let folder = tempfile::tempdir().unwrap();
    for time in [5.25, 5.75, 5.0] {
        EventWriter::create(folder.path(), time, "").unwrap();
    }
    let three = files(folder.path());
    assert_eq!(three.iter().map(|file| read(file)[0].wall_time).collect::<Vec<_>>(), [5.25, 5.75, 5.0]);
    assert!(three[0].to_str().unwrap().contains("/events.out.tfevents.0000000005.localhost."));
    fs::write(folder.path().join("events.out.tfevents.0000000009.zebra.9.0000"), "").unwrap();
    EventWriter::create(folder.path(), 6.0, "ant").unwrap();
    let files = files(folder.path());
    assert!(files[4].to_str().unwrap().contains(".0000000010.ant."), "{files:?}");
}

#[test]
fn a_missing_folder_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    assert!(EventWriter::create(&folder.path().join("gone"), 1.0, "box").is_err());
}

#[test]
fn histograms_are_tensors_of_three_columns() {
    let folder = tempfile::tempdir().unwrap();
    let mut writer = EventWriter::create(folder.path(), 1.0, "box").unwrap();
    let histogram = Histogram { rows: vec![[0.0, 0.5, 3.0], [0.5, 1.0, 4.0]] };
    writer.histograms(512, 2.0, &[("actions/all".to_string(), histogram)]).unwrap();
    let events = read(&files(folder.path())[0]);
    let value = &events[1].summary.as_ref().unwrap().value[0];
    let tensor = value.tensor.as_ref().unwrap();
    assert_eq!(tensor.shape.as_ref().unwrap().dim.iter().map(|dim| dim.size).collect::<Vec<_>>(), [2, 3]);
    let entries = tensor.content.chunks_exact(8).map(|bytes| f64::from_le_bytes(bytes.try_into().unwrap()));
    assert_eq!(entries.collect::<Vec<_>>(), [0.0, 0.5, 3.0, 0.5, 1.0, 4.0]);
    assert_eq!(value.metadata.as_ref().unwrap().plugin_data.as_ref().unwrap().plugin_name, "histograms");
}

#[test]
fn a_resumed_run_keeps_its_row_and_removes_its_end() {
    let tags = |folder: &Path| {
        let mut tags: Vec<String> = files(folder)
            .iter()
            .flat_map(|file| read(file))
            .filter_map(|event| event.summary)
            .flat_map(|summary| summary.value)
            .map(|value| value.tag)
            .collect();
        tags.sort();
        tags
    };
    let folder = tempfile::tempdir().unwrap();
    let config = Config::default();
    let mut first = EventWriter::create(folder.path(), 1.0, "box").unwrap();
    first.hyperparameters(&config, 1.0).unwrap();
    first.end(false, 2.0).unwrap();
    let begun = ["_hparams_/experiment", "_hparams_/session_start_info"];
    assert_eq!(tags(folder.path()), [begun[0], "_hparams_/session_end_info", begun[1]]);
    let mut second = EventWriter::create(folder.path(), 3.0, "box").unwrap();
    second.hyperparameters(&config, 3.0).unwrap();
    assert_eq!(tags(folder.path()), begun);
}
