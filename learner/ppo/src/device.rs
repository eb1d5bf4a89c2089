//! Device that computes updates.

use std::sync::{Arc, Mutex};

pub use treadmill_gpu::GpuError;
use treadmill_gpu::{Gpu, Session};

/// Kind of device, as a user names it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DeviceKind {
    /// The processor.
    #[default]
    Cpu,
    /// The first NVIDIA GPU.
    Cuda,
    /// The processor, by Candle's tensors and automatic differentiation.
    Candle,
}

/// A device, opened.
#[derive(Clone, Debug, Default)]
pub enum Device {
    /// The processor.
    #[default]
    Cpu,
    /// A GPU, and the memory that updates use there from the first one on.
    Cuda(Gpu, Arc<Mutex<Option<Session>>>),
    /// Candle's operations: slow, and what the others are compared with.
    Candle,
}

impl std::str::FromStr for DeviceKind {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "cpu" => Ok(Self::Cpu),
            "cuda" => Ok(Self::Cuda),
            "candle" => Ok(Self::Candle),
            _ => Err(format!("unknown device `{text}`; allowed: cpu, cuda, candle")),
        }
    }
}

impl Device {
    /// Returns the same device, which takes memory of its own for updates and frees it when it is dropped.
    #[must_use]
    pub fn with_own_memory(&self) -> Self {
        match self {
            Self::Cuda(gpu, _) => Self::Cuda(gpu.clone(), Arc::default()),
            other => other.clone(),
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
            Self::Candle => "candle",
        }
    }

    /// Opens the device.
    ///
    /// # Errors
    /// If the machine lacks it.
    pub fn open(self) -> Result<Device, GpuError> {
        match self {
            Self::Cpu => Ok(Device::Cpu),
            Self::Cuda => Ok(Device::Cuda(Gpu::open()?, Arc::default())),
            Self::Candle => Ok(Device::Candle),
        }
    }
}
