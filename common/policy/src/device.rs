//! Where the networks are computed.

pub use candle_core::Device;

/// A kind of device, as a user names it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DeviceKind {
    /// The processor.
    #[default]
    Cpu,
    /// The first NVIDIA GPU.
    Cuda,
}

/// Why there is no such device.
#[derive(Debug, thiserror::Error)]
pub enum DeviceError {
    /// This program cannot use it.
    #[error(
        "this treadmill was built without CUDA, so --device cuda is not there; build it where nvcc is installed by \
         `cargo build --release --features cuda`, or use --device cpu"
    )]
    NotBuilt,
    /// The machine does not have it.
    #[error("no CUDA device can be used: {why}; check `nvidia-smi`, or use --device cpu")]
    Absent {
        /// What the driver said.
        why: String,
    },
}

impl std::str::FromStr for DeviceKind {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "cpu" => Ok(Self::Cpu),
            "cuda" => Ok(Self::Cuda),
            _ => Err(format!("`{text}` is no device; allowed: cpu, cuda")),
        }
    }
}

impl DeviceKind {
    /// The device itself.
    ///
    /// # Errors
    /// [`DeviceError`] says what is missing.
    pub fn open(self) -> Result<Device, DeviceError> {
        match self {
            Self::Cpu => Ok(Device::Cpu),
            Self::Cuda if cfg!(feature = "cuda") => {
                Device::new_cuda(0).map_err(|why| DeviceError::Absent { why: why.to_string() })
            }
            Self::Cuda => Err(DeviceError::NotBuilt),
        }
    }
}
