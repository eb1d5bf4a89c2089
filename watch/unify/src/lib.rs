//! Nothing but features, for the sake of build times.
//!
//! Rerun asks more of some small crates than the trainer does: of `serde` the feature `rc`, of `proc-macro2` `span-locations`.
//! Cargo compiles a crate anew for other features, and with it all that depends on it, so that a viewer that is built after
//! the trainer would compile the bus, the tensors and the physics once more. `Cargo.toml` lists what the viewer asks; built
//! beside the trainer, this crate makes both ask the same. Nothing depends on it, and nothing breaks without it.
//!
//! After `cargo build --release`, `cargo build --release -p treadmill-watch` should compile no `zenoh` and no `candle-core`. When
//! it does after an update of Rerun, the features of both sides tell what is missing here:
//!
//! ```sh
//! features() { cargo tree --prefix none -e normal,build -f '{p} {f}' "$@" | sed 's/ (\*)$//' | grep . | sort -u; }
//! comm -13 <(features) <(features -p treadmill-watch) | grep -Ff <(features | cut -d' ' -f1,2)
//! ```
