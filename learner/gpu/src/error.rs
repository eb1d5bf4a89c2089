//! Errors of a GPU.

/// Why a GPU cannot be used, or no longer.
#[derive(Clone, Debug, thiserror::Error)]
pub enum GpuError {
    /// The driver's library is not there.
    #[error(
        "no CUDA device can be used: the driver's library libcuda.so.1 cannot be loaded; install NVIDIA's driver (check \
         `nvidia-smi`), or use --device cpu"
    )]
    NoDriver,
    /// The driver is older than the kernels.
    #[error(
        "no CUDA device can be used: the driver supports CUDA {found}, and 12.0 is needed; install a driver from 525 on, \
         or use --device cpu"
    )]
    OldDriver {
        /// Newest version of CUDA that the driver supports.
        found: String,
    },
    /// The machine has no usable GPU.
    #[error("no CUDA device can be used: {why}; check `nvidia-smi` and CUDA_VISIBLE_DEVICES, or use --device cpu")]
    Absent {
        /// The driver's error.
        why: String,
    },
    /// The memory of the GPU is too small.
    #[error(
        "the GPU has {usable_mb} MB of usable memory, and updates with ppo.batch_max = {batch_max} need {needed_mb} MB; \
         {remedy}, or use --device cpu"
    )]
    Memory {
        /// Free memory that kernels can use, in MB.
        usable_mb: u64,
        /// Memory that updates need in MB.
        needed_mb: u64,
        /// Largest batch, in transitions.
        batch_max: usize,
        /// A batch that fits.
        remedy: String,
    },
    /// The driver failed during an update.
    #[error("the GPU failed while it {what}: {why}; continue on the processor with `--resume RUN --device cpu`")]
    Failed {
        /// What it was doing.
        what: &'static str,
        /// The driver's error.
        why: String,
    },
}
