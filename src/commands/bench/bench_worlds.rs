//! Humanoids by themselves, spread over threads.

use rayon::{ThreadPool, ThreadPoolBuilder, prelude::*};
use treadmill_humanoid::{Environment, EnvironmentConfig};
use treadmill_runtime::{machine, seeds};

/// Humanoids that are stepped in turn, as an actor has them: one alone would stay in the cache.
pub const WORLDS: usize = 64;

/// One humanoid whose physics is stepped without a task.
pub struct BenchWorld {
    /// Its number.
    pub index: usize,
    /// The humanoid.
    pub environment: Environment,
    /// Times that it was put on its feet.
    pub resets: u64,
    /// Times that its physics failed.
    pub faults: u64,
    observation: Vec<f32>,
}

impl BenchWorld {
    /// Begins anew; the seeds are this world's own.
    pub fn reset(&mut self) {
        let seed = seeds::derive(1, "bench-reset", &[self.index as u64, self.resets]);
        self.resets += 1;
        self.environment.reset(seed, &mut self.observation);
    }
}

/// [`WORLDS`] humanoids, each with `T` beside it.
pub struct BenchWorlds<T> {
    worlds: Vec<(BenchWorld, T)>,
    pool: ThreadPool,
}

impl<T: Send> BenchWorlds<T> {
    /// Makes and resets all; `beside` makes what each world has with it.
    pub fn new(
        config: &EnvironmentConfig,
        model_xml: &str,
        threads: usize,
        beside: impl Fn(usize) -> T,
    ) -> anyhow::Result<Self> {
        let world = |index| -> anyhow::Result<(BenchWorld, T)> {
            let environment = Environment::new(config, model_xml)?;
            let observation = vec![0.0; environment.observation_size()];
            let mut world = BenchWorld { index, environment, resets: 0, faults: 0, observation };
            world.reset();
            Ok((world, beside(index)))
        };
        let worlds = (0..WORLDS).map(world).collect::<anyhow::Result<_>>()?;
        Ok(Self { worlds, pool: ThreadPoolBuilder::new().num_threads(threads).build()? })
    }

    /// Does something once with each world.
    pub fn each(&mut self, work: impl Fn(&mut BenchWorld, &mut T) + Sync) {
        let worlds = &mut self.worlds;
        self.pool.install(|| worlds.par_iter_mut().with_max_len(1).for_each(|(world, beside)| work(world, beside)));
    }

    /// All of them, in their order.
    pub fn iter(&self) -> impl Iterator<Item = &(BenchWorld, T)> {
        self.worlds.iter()
    }
}

/// Threads that a flag asks for: 0 means one per core.
pub fn threads(wanted: usize) -> usize {
    if wanted == 0 { machine::cores() } else { wanted }
}
