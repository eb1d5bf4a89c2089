//! Training runs from start to end: determinism, resuming, warm starts, full disks, sweeps, evaluation, TensorBoard, GPUs.

mod each_key;
mod evaluation;
mod full_disk;
mod gpu;
mod own_task;
mod resume;
#[path = "../support/mod.rs"]
mod support;
mod sweep;
mod tensorboard;
mod train;
mod warm_start;
