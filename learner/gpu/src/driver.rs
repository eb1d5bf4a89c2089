//! The driver: a GPU, its memory, launches, and graphs of launches.

use std::{collections::HashMap, fmt, ops::Range, sync::Arc};

use cudarc::{
    driver::{
        CudaContext, CudaFunction, CudaGraph, CudaSlice, CudaStream, DriverError, LaunchConfig, PushKernelArg,
        sys::{self, CUgraphInstantiate_flags, CUstreamCaptureMode},
    },
    nvrtc::Ptx,
};

use crate::{
    error::GpuError,
    layout::MemoryLayout,
    program::{KERNELS, Kernel, Launch},
};

/// Kernels as an assembler's text, which the driver compiles for its GPU. `compile.py` makes it.
const PTX: &str = include_str!("kernels.ptx");
/// Oldest version of CUDA whose drivers read the text, as the driver counts.
const VERSION_MIN: i32 = 12_000;

/// An NVIDIA GPU, opened.
#[derive(Clone)]
pub struct Gpu {
    context: Arc<CudaContext>,
    stream: Arc<CudaStream>,
    kernels: Arc<HashMap<Kernel, CudaFunction>>,
    name: String,
    version: String,
}

impl fmt::Debug for Gpu {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_struct("Gpu").field("name", &self.name).finish_non_exhaustive()
    }
}

impl fmt::Display for Gpu {
    /// Writes the name, and the newest version of CUDA that the driver supports.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}, driver for CUDA {}", self.name, self.version)
    }
}

impl Gpu {
    /// Opens the first GPU and loads the kernels.
    ///
    /// # Errors
    /// If the machine has no driver, an old one, or no usable GPU.
    pub fn open() -> Result<Self, GpuError> {
        // SAFETY: loading the driver's library runs its initialisation, as any use of a GPU does.
        if !unsafe { sys::is_culib_present() } {
            return Err(GpuError::NoDriver);
        }
        let absent = |why: DriverError| GpuError::Absent { why: explained(why) };
        cudarc::driver::result::init().map_err(absent)?;
        let version = driver_version().map_err(absent)?;
        let shown = format!("{}.{}", version / 1000, version % 1000 / 10);
        if version < VERSION_MIN {
            return Err(GpuError::OldDriver { found: shown });
        }
        let context = CudaContext::new(0).map_err(absent)?;
        // SAFETY: everything runs on one stream, so that nothing needs to wait for events of another.
        unsafe { context.disable_event_tracking() };
        let stream = context.new_stream().map_err(absent)?;
        let module = context.load_module(Ptx::from_src(PTX)).map_err(absent)?;
        let load = |name: &Kernel| {
            let kernel = module.load_function(name)?;
            // A question about it makes the driver load it now, and not in a capture.
            kernel.num_regs()?;
            Ok((*name, kernel))
        };
        let kernels: Result<_, _> = KERNELS.iter().map(load).collect();
        let name = context.name().map_err(absent)?;
        Ok(Self { kernels: Arc::new(kernels.map_err(absent)?), context, stream, name, version: shown })
    }

    /// Waits until the GPU has done all that it was asked, and makes it that of this thread, as freeing its memory needs.
    ///
    /// # Errors
    /// If the driver fails.
    pub fn synchronize(&self) -> Result<(), GpuError> {
        let failed = failed("computed an update");
        self.context.bind_to_thread().map_err(&failed)?;
        self.stream.synchronize().map_err(failed)
    }

    /// Returns free and whole memory in bytes.
    ///
    /// # Errors
    /// If the driver fails.
    pub fn memory_bytes(&self) -> Result<[u64; 2], GpuError> {
        let (free, all) = self.context.mem_get_info().map_err(failed("asked for free memory"))?;
        Ok([free as u64, all as u64])
    }
}

/// Returns the newest version of CUDA that the driver supports: 12040 is 12.4.
fn driver_version() -> Result<i32, DriverError> {
    let mut version = 0;
    // SAFETY: the driver writes one number to the pointer.
    unsafe { sys::cuDriverGetVersion(&mut version) }.result()?;
    Ok(version)
}

/// Returns a conversion of the driver's errors.
pub(crate) fn failed(what: &'static str) -> impl Fn(DriverError) -> GpuError {
    move |why| GpuError::Failed { what, why: explained(why) }
}

/// Returns the driver's own words for an error.
fn explained(why: DriverError) -> String {
    let [words, name] = [why.error_string(), why.error_name()].map(|text| text.unwrap_or(c"unknown").to_string_lossy());
    format!("{words} ({name})")
}

/// Arrays on a GPU, and what runs on them.
pub(crate) struct Memory {
    gpu: Gpu,
    numbers: CudaSlice<f32>,
    integers: CudaSlice<u32>,
    controls: CudaSlice<f64>,
}

impl Memory {
    /// Allocates the arrays, filled with zeros.
    pub(crate) fn new(gpu: &Gpu, layout: &MemoryLayout) -> Result<Self, GpuError> {
        let failed = failed("allocated memory");
        gpu.context.bind_to_thread().map_err(&failed)?;
        Ok(Self {
            numbers: gpu.stream.alloc_zeros(layout.numbers).map_err(&failed)?,
            integers: gpu.stream.alloc_zeros(layout.fields.end).map_err(&failed)?,
            controls: gpu.stream.alloc_zeros(layout.controls).map_err(&failed)?,
            gpu: gpu.clone(),
        })
    }

    /// Waits until all copies have arrived: the host's memory may change again.
    pub(crate) fn settle(&self) -> Result<(), GpuError> {
        self.gpu.synchronize()
    }

    /// Copies numbers to the array, from an offset on; see [`Self::settle`].
    pub(crate) fn write(&mut self, at: usize, numbers: &[f32]) -> Result<(), GpuError> {
        let mut part = self.numbers.slice_mut(at..at + numbers.len());
        self.gpu.stream.memcpy_htod(numbers, &mut part).map_err(failed("received a batch"))
    }

    /// Copies integers to their array, from an offset on.
    pub(crate) fn write_integers(&mut self, at: usize, integers: &[u32]) -> Result<(), GpuError> {
        let mut part = self.integers.slice_mut(at..at + integers.len());
        self.gpu.stream.memcpy_htod(integers, &mut part).map_err(failed("received the order of rows"))
    }

    /// Copies the first control numbers to their array.
    pub(crate) fn write_controls(&mut self, controls: &[f64]) -> Result<(), GpuError> {
        let mut part = self.controls.slice_mut(..controls.len());
        self.gpu.stream.memcpy_htod(controls, &mut part).map_err(failed("received settings"))
    }

    /// Returns numbers, after all launches before.
    pub(crate) fn read(&self, range: Range<usize>) -> Result<Vec<f32>, GpuError> {
        let numbers = self.gpu.stream.clone_dtoh(&self.numbers.slice(range)).map_err(failed("computed a pass"))?;
        self.gpu.synchronize().map(|()| numbers)
    }

    /// Returns control numbers, after all launches before.
    pub(crate) fn read_controls(&self, range: Range<usize>) -> Result<Vec<f64>, GpuError> {
        let controls = self.gpu.stream.clone_dtoh(&self.controls.slice(range)).map_err(failed("computed a pass"))?;
        self.gpu.synchronize().map(|()| controls)
    }

    /// Copies the state to its backup.
    pub(crate) fn save(&mut self, layout: &MemoryLayout) -> Result<(), GpuError> {
        let (mut below, mut above) = self.numbers.split_at_mut(layout.backup.start);
        let (state, mut backup) = (below.slice_mut(layout.state.clone()), above.slice_mut(..layout.backup.len()));
        self.gpu.stream.memcpy_dtod(&state, &mut backup).map_err(failed("copied parameters"))
    }

    /// Copies the backup to the state.
    pub(crate) fn restore(&mut self, layout: &MemoryLayout) -> Result<(), GpuError> {
        let (mut below, mut above) = self.numbers.split_at_mut(layout.backup.start);
        let (mut state, backup) = (below.slice_mut(layout.state.clone()), above.slice_mut(..layout.backup.len()));
        self.gpu.stream.memcpy_dtod(&backup, &mut state).map_err(failed("copied parameters"))
    }

    /// Captures launches as a graph, which runs them without a call of the driver for each.
    pub(crate) fn capture(&self, launches: &[Launch]) -> Result<Graph, GpuError> {
        let failed = failed("captured a gradient step");
        let stream = &self.gpu.stream;
        stream.begin_capture(CUstreamCaptureMode::CU_STREAM_CAPTURE_MODE_THREAD_LOCAL).map_err(&failed)?;
        let launched = launches.iter().try_for_each(|launch| self.launch(launch));
        // Ended in any case, so that the stream can be used again.
        let graph = stream.end_capture(CUgraphInstantiate_flags(0));
        launched.map_err(&failed)?;
        let graph = graph.map_err(&failed)?.ok_or(DriverError(sys::CUresult::CUDA_ERROR_UNKNOWN));
        graph.map(Graph).map_err(failed)
    }

    fn launch(&self, launch: &Launch) -> Result<(), DriverError> {
        let [x, y, z] = launch.grid.map(|blocks| blocks as u32);
        let (config, at) = (
            LaunchConfig { grid_dim: (x, y, z), block_dim: (launch.block as u32, 1, 1), shared_mem_bytes: 0 },
            launch.at as u32,
        );
        let mut builder = self.gpu.stream.launch_builder(&self.gpu.kernels[launch.kernel]);
        builder.arg(&self.numbers).arg(&self.integers).arg(&self.controls).arg(&at);
        // SAFETY: each kernel takes these arguments, and a layout's fields lead it to offsets inside the arrays, which its
        // threads write to without two of them writing to the same, but for one flag that all set to the same.
        unsafe { builder.launch(config) }.map(drop)
    }
}

/// Launches that the driver has captured.
pub(crate) struct Graph(CudaGraph);

// SAFETY: the driver allows any thread to use a graph if no two do at once. A graph is not `Sync`, and the driver itself
// serialises its stream's use of it.
unsafe impl Send for Graph {}

impl Graph {
    /// Runs the launches, after those before.
    pub(crate) fn run(&self) -> Result<(), GpuError> {
        self.0.launch().map_err(failed("began a gradient step"))
    }
}
