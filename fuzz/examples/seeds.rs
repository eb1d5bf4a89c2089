//! Writes a valid message of each kind as initial corpus of libFuzzer: `seeds FOLDER`.

use std::{fs, path::PathBuf};

use treadmill_fuzz::TARGETS;

fn main() -> std::io::Result<()> {
    let root = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| "fuzz/corpus".to_string()));
    for (name, _, sample, _) in TARGETS {
        let folder = root.join(name);
        fs::create_dir_all(&folder)?;
        fs::write(folder.join("valid"), sample())?;
    }
    Ok(())
}
