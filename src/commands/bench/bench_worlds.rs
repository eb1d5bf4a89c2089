//! Humanoids stepped on several threads.

use rayon::{ThreadPool, ThreadPoolBuilder, prelude::*};
use treadmill_humanoid::{Environment, EnvironmentConfig};
use treadmill_runtime::{machine, seeds};

/// Number of humanoids, as many as an actor has: one alone would stay in the cache.
pub const WORLDS: usize = 64;

/// Humanoid whose physics is stepped without a task.
pub struct BenchWorld {
    /// Index of this world.
    pub index: usize,
    /// Environment that owns the physics.
    pub environment: Environment,
    /// Number of resets.
    pub resets: u64,
    /// Number of failures of the physics.
    pub faults: u64,
    observation: Vec<f32>,
}

impl BenchWorld {
    /// Resets the humanoid, with a seed of this world.
    pub fn reset(&mut self) {
        let seed = seeds::derive(1, "bench-reset", &[self.index as u64, self.resets]);
        self.resets += 1;
        self.environment.reset(seed, &mut self.observation);
    }
}

/// [`WORLDS`] humanoids, each with a `T`.
pub struct BenchWorlds<T> {
    worlds: Vec<(BenchWorld, T)>,
    pool: ThreadPool,
}

impl<T: Send> BenchWorlds<T> {
    /// Creates and resets all; `state` creates the `T` of a world.
    pub fn new(
        config: &EnvironmentConfig,
        model_xml: &str,
        threads: usize,
        state: impl Fn(usize) -> T,
    ) -> anyhow::Result<Self> {
        let world = |index| -> anyhow::Result<(BenchWorld, T)> {
            let environment = Environment::new(config, model_xml)?;
            let observation = vec![0.0; environment.observation_size()];
            let mut world = BenchWorld { index, environment, resets: 0, faults: 0, observation };
            world.reset();
            Ok((world, state(index)))
        };
        let worlds = (0..WORLDS).map(world).collect::<anyhow::Result<_>>()?;
        Ok(Self { worlds, pool: ThreadPoolBuilder::new().num_threads(threads).build()? })
    }

    /// Calls `work` once for each world, in parallel.
    pub fn each(&mut self, work: impl Fn(&mut BenchWorld, &mut T) + Sync) {
        let worlds = &mut self.worlds;
        self.pool.install(|| worlds.par_iter_mut().with_max_len(1).for_each(|(world, state)| work(world, state)));
    }

    /// Iterates over all worlds in order.
    pub fn iter(&self) -> impl Iterator<Item = &(BenchWorld, T)> {
        self.worlds.iter()
    }
}

/// Returns the number of threads for a flag's value; 0 means one per core.
pub fn threads(wanted: usize) -> usize {
    if wanted == 0 { machine::cores() } else { wanted }
}
