//! Device on which the networks are computed.

pub use candle_core::Device;

/// Kind of device, as a user names it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DeviceKind {
    /// The processor.
    #[default]
    Cpu,
    /// The first NVIDIA GPU.
    Cuda,
}

/// Error of opening a device.
#[derive(Debug, thiserror::Error)]
pub enum DeviceError {
    /// The program was built without CUDA.
    #[error(
        "this treadmill was built without CUDA, which --device cuda needs; build it with `cargo build --release \
         --features cuda` where nvcc is installed, or use --device cpu"
    )]
    NotBuilt,
    /// The machine has no usable CUDA device.
    #[error("no CUDA device can be used: {why}; check `nvidia-smi`, or use --device cpu")]
    Absent {
        /// The driver's error.
        why: String,
    },
}

impl std::str::FromStr for DeviceKind {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "cpu" => Ok(Self::Cpu),
            "cuda" => Ok(Self::Cuda),
            _ => Err(format!("unknown device `{text}`; allowed: cpu, cuda")),
        }
    }
}

impl DeviceKind {
    /// Returns the name that a user gives.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Cpu => "cpu",
            Self::Cuda => "cuda",
        }
    }

    /// Opens the device.
    ///
    /// # Errors
    /// [`DeviceError`] if the program or the machine lacks it.
    pub fn open(self) -> Result<Device, DeviceError> {
        match self {
            Self::Cpu => Ok(Device::Cpu),
            Self::Cuda if cfg!(feature = "cuda") => {
                Device::new_cuda(0).map_err(|error| DeviceError::Absent { why: error.to_string() })
            }
            Self::Cuda => Err(DeviceError::NotBuilt),
        }
    }
}
