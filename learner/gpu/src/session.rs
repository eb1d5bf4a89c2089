//! Passes over a batch.

use std::{collections::HashMap, fmt};

use treadmill_policy::{NetworkStructure, Networks, SignedPair};

use crate::{
    driver::{Gpu, Graph, Memory},
    error::GpuError,
    layout::{CONTROLS, Control, MemoryLayout, Room},
    program::{Program, StepPlan},
};

/// Free entries for fields below which graphs are forgotten: room for the two numbers of rows of a pass.
const FIELDS_MIN: usize = 1 << 14;
/// Most memory of a session: kernels count numbers in 32 bits.
const BYTES_MAX: u64 = 4 * u32::MAX as u64;
/// How far Adam's running means are kept in a step; see `treadmill_ppo::optimiser`.
const KEPT: [f64; 2] = [0.9, 0.999];

/// Batch of one update, see `treadmill_ppo::Batch`; observations are as the networks read them.
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "as in treadmill_ppo::Batch")]
pub struct GpuBatch<'a> {
    pub inputs: &'a [f32],
    pub actions: &'a [f32],
    pub log_probs: &'a [f32],
    /// Normalised advantages, times their weights.
    pub advantages: &'a [f32],
    pub returns: &'a [f32],
    /// Rows that the divergence is measured on.
    pub measured: &'a [u32],
    /// Means of the old policy in them, `[measured, action]`.
    pub old_means: &'a [f32],
    /// Logarithm of the old policy's standard deviation of each action.
    pub old_log_std: &'a [f32],
}

/// Coefficients of a pass.
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "as in the section [ppo]")]
pub struct PassSettings {
    pub learning_rate: f64,
    pub max_grad_norm: f64,
    pub clip_range: f64,
    pub value_coefficient: f64,
    pub entropy_coefficient: f64,
    pub bounds_coefficient: f64,
    pub bounds_limit: f64,
}

/// Sums over the rows of a pass, and its divergence.
#[derive(Clone, Copy, Debug, Default)]
#[allow(missing_docs, reason = "as in treadmill_ppo::UpdateStats, before the division by rows")]
pub struct PassSums {
    pub policy: f64,
    pub value: f64,
    pub bounds: f64,
    pub clipped: f64,
    pub entropy: f64,
    pub grad_norm: f64,
    /// Mean divergence from the old policy in nats.
    pub divergence: f64,
    /// Quantity that was not finite.
    pub failure: Option<&'static str>,
}

/// State of learning on a GPU, and graphs of its gradient steps.
pub struct Session {
    // Dropped before the memory that they use.
    steps: HashMap<usize, Graph>,
    divergences: HashMap<usize, Graph>,
    memory: Memory,
    networks: Networks,
    structure: NetworkStructure,
    room: Room,
    layout: MemoryLayout,
    /// First free entry for fields of launches.
    fields: usize,
    /// Steps of Adam.
    taken: u64,
    rows: usize,
    measured: usize,
}

impl fmt::Debug for Session {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_struct("Session").field("room", &self.room).finish_non_exhaustive()
    }
}

/// Returns the memory in bytes of updates with such networks, batches, rows of a gradient step, and rows of the divergence.
pub fn memory_bytes(networks: &Networks, batch: usize, minibatch: usize, measured: usize) -> u64 {
    MemoryLayout::new(&networks.structure(), &room(networks, batch, minibatch, measured)).bytes()
}

fn room(networks: &Networks, batch: usize, minibatch: usize, measured: usize) -> Room {
    let (observation, parameters) = (networks.shape().observation, networks.parameter_count());
    Room { batch, minibatch, measured, observation, parameters }
}

impl Drop for Session {
    fn drop(&mut self) {
        // Freeing needs the context to be this thread's. After an error of the driver nothing is left to wait for.
        let _ = self.memory.settle();
    }
}

impl Session {
    /// Allocates memory for batches, rows of a gradient step, and rows of the divergence.
    ///
    /// # Errors
    /// If the memory of the GPU is too small.
    pub fn new(
        gpu: &Gpu,
        networks: &Networks,
        batch: usize,
        minibatch: usize,
        measured: usize,
    ) -> Result<Self, GpuError> {
        let (structure, room) = (networks.structure(), room(networks, batch, minibatch, measured));
        let layout = MemoryLayout::new(&structure, &room);
        let [free, _] = gpu.memory_bytes()?;
        let usable = free.min(BYTES_MAX);
        if layout.bytes() > usable {
            return Err(too_large(networks, &room, usable));
        }
        let mut memory = Memory::new(gpu, &layout)?;
        let sign = |sign: i8| if sign < 0 { 2 } else { sign as u32 };
        let table = |pairs: &[SignedPair]| -> Vec<u32> {
            pairs.iter().flatten().flat_map(|(at, code)| [*at as u32, sign(*code)]).collect()
        };
        let entries: Vec<u32> = structure.log_std.iter().map(|entry| *entry as u32).collect();
        memory.write_integers(layout.log_std, &entries)?;
        memory.write_integers(layout.joins, &table(&structure.joins))?;
        memory.write_integers(layout.splits, &table(&structure.splits))?;
        // The tables that are copied end here.
        memory.settle()?;
        Ok(Self {
            steps: HashMap::new(),
            divergences: HashMap::new(),
            memory,
            networks: networks.clone(),
            structure,
            fields: layout.fields.start,
            room,
            layout,
            taken: 0,
            rows: 0,
            measured: 0,
        })
    }

    /// Returns the memory of the session in bytes.
    pub fn memory_bytes(&self) -> u64 {
        self.layout.bytes()
    }

    /// Returns whether the session is for such networks and has room for such a batch.
    pub fn fits(&self, networks: &Networks, batch: usize, minibatch: usize, measured: usize) -> bool {
        let Room { batch: most, minibatch: most_rows, measured: most_measured, .. } = self.room;
        *networks == self.networks && batch <= most && minibatch <= most_rows && measured <= most_measured
    }

    /// Begins an update: uploads a batch, and parameters and moments after so many steps of Adam.
    ///
    /// # Errors
    /// If the driver fails.
    ///
    /// # Panics
    /// If the batch does not fit.
    pub fn begin(
        &mut self,
        batch: &GpuBatch,
        [parameters, first, second]: [&[f32]; 3],
        taken: u64,
    ) -> Result<(), GpuError> {
        let Self { memory, layout, .. } = self;
        (self.rows, self.measured, self.taken) = (batch.returns.len(), batch.measured.len(), taken);
        assert!(self.rows <= self.room.batch && self.measured <= self.room.measured, "a batch of the session's size");
        let count = self.room.parameters;
        for (index, part) in [parameters, first, second].into_iter().enumerate() {
            assert_eq!(part.len(), count, "parameters of the session's networks");
            memory.write(layout.state.start + index * count, part)?;
        }
        memory.write(layout.inputs, batch.inputs)?;
        memory.write(layout.actions, batch.actions)?;
        memory.write(layout.log_probs, batch.log_probs)?;
        memory.write(layout.advantages, batch.advantages)?;
        memory.write(layout.returns, batch.returns)?;
        memory.write(layout.old_means, batch.old_means)?;
        memory.write(layout.old_log_std, batch.old_log_std)?;
        memory.write_integers(layout.measured, batch.measured)?;
        memory.settle()
    }

    /// Takes a gradient step on the first of `sizes` rows of `order`, on the next, and so on. Keeps what was before for
    /// [`Self::undo`].
    ///
    /// # Errors
    /// If the driver fails.
    pub fn pass(&mut self, order: &[u32], sizes: &[usize], settings: &PassSettings) -> Result<PassSums, GpuError> {
        assert!(order.len() == self.rows && sizes.iter().sum::<usize>() == self.rows, "all rows of the batch");
        self.memory.save(&self.layout)?;
        self.memory.write_integers(self.layout.order, order)?;
        if self.fields + FIELDS_MIN > self.layout.fields.end {
            self.forget_graphs();
        }
        for size in sizes {
            self.prepare(*size)?;
        }
        let kept = KEPT.map(|kept| kept.powi(i32::try_from(self.taken).unwrap_or(i32::MAX)));
        let mut controls = [0.0; CONTROLS];
        for (control, number) in [
            (Control::KeptFirst, kept[0]),
            (Control::KeptSecond, kept[1]),
            (Control::LearningRate, settings.learning_rate),
            (Control::MaxGradNorm, settings.max_grad_norm),
            (Control::ClipRange, settings.clip_range),
            (Control::ValueCoefficient, settings.value_coefficient),
            (Control::EntropyCoefficient, settings.entropy_coefficient),
            (Control::BoundsCoefficient, settings.bounds_coefficient),
            (Control::BoundsLimit, settings.bounds_limit),
        ] {
            controls[control as usize] = number;
        }
        self.memory.write_controls(&controls)?;
        for size in sizes {
            self.steps[size].run()?;
            self.taken += 1;
        }
        self.divergences[&self.measured].run()?;
        let start = self.layout.divergences;
        let divergences = self.memory.read_controls(start..start + self.measured)?;
        let sums = self.memory.read_controls(0..CONTROLS)?;
        let of = |control: Control| sums[control as usize];
        Ok(PassSums {
            policy: of(Control::Policy),
            value: of(Control::Value),
            bounds: of(Control::Bounds),
            clipped: of(Control::Clipped),
            entropy: of(Control::Entropy),
            grad_norm: of(Control::Norm),
            divergence: divergences.iter().sum::<f64>() / self.measured.max(1) as f64,
            failure: match of(Control::Failure) {
                0.0 => None,
                1.0 => Some("loss"),
                2.0 => Some("gradient"),
                _ => Some("parameter vector"),
            },
        })
    }

    /// Restores what was before the last pass, which took so many steps.
    ///
    /// # Errors
    /// If the driver fails.
    pub fn undo(&mut self, steps: u64) -> Result<(), GpuError> {
        self.taken -= steps;
        self.memory.restore(&self.layout)
    }

    /// Returns the steps of Adam, parameters, first and second moments.
    ///
    /// # Errors
    /// If the driver fails.
    pub fn state(&self) -> Result<(u64, [Vec<f32>; 3]), GpuError> {
        let (start, count) = (self.layout.state.start, self.room.parameters);
        let part = |index: usize| self.memory.read(start + index * count..start + (index + 1) * count);
        Ok((self.taken, [part(0)?, part(1)?, part(2)?]))
    }

    /// Captures the graphs of steps on so many rows, and of the divergence.
    fn prepare(&mut self, rows: usize) -> Result<(), GpuError> {
        let Self { structure, layout, room, .. } = self;
        let plan = StepPlan { structure, layout, observation: room.observation, parameters: room.parameters };
        let step = (!self.steps.contains_key(&rows)).then(|| plan.step(rows, self.fields));
        let begin = self.fields + step.as_ref().map_or(0, |step| step.fields.len());
        let measured = self.measured;
        let divergence = (!self.divergences.contains_key(&measured)).then(|| plan.divergence(measured, begin));
        if let Some(step) = step {
            let graph = self.capture(&step)?;
            self.steps.insert(rows, graph);
        }
        if let Some(divergence) = divergence {
            let graph = self.capture(&divergence)?;
            self.divergences.insert(measured, graph);
        }
        Ok(())
    }

    fn forget_graphs(&mut self) {
        self.steps.clear();
        self.divergences.clear();
        self.fields = self.layout.fields.start;
    }

    fn capture(&mut self, program: &Program) -> Result<Graph, GpuError> {
        let fields: Vec<u32> = program.fields.iter().map(|field| *field as u32).collect();
        assert!(program.begin + fields.len() <= self.layout.fields.end, "networks have fewer layers");
        self.memory.write_integers(program.begin, &fields)?;
        self.fields += fields.len();
        self.memory.settle()?;
        self.memory.capture(&program.launches)
    }
}

/// Returns the error for a batch that does not fit, with one that does.
fn too_large(networks: &Networks, wanted: &Room, usable: u64) -> GpuError {
    let bytes = |batch: usize| memory_bytes(networks, batch, wanted.minibatch.min(batch.max(1)), wanted.measured);
    let powers = (0..=wanted.batch.ilog2()).rev().map(|power| 1_usize << power);
    let fitting = powers.filter(|batch| *batch < wanted.batch).find(|batch| bytes(*batch) <= usable);
    let remedy = match fitting {
        Some(batch) => format!("--set ppo.batch_max={batch} fits unless ppo.batch is larger"),
        None => "no batch fits: free its memory (check `nvidia-smi`)".to_string(),
    };
    let mb = |bytes: u64| bytes.div_ceil(1_000_000);
    GpuError::Memory {
        usable_mb: usable / 1_000_000,
        needed_mb: mb(bytes(wanted.batch)),
        batch_max: wanted.batch,
        remedy,
    }
}
