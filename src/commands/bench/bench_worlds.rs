//! Humanoids stepped on several threads.

use std::thread;

use treadmill_humanoid::{Environment, EnvironmentConfig, Physics, TaskRegistry, task, worlds_per_pass};
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

/// Returns whether the humanoid of one of Gymnasium's tasks fell.
pub fn fell(config: &EnvironmentConfig, world: &BenchWorld) -> bool {
    config.env.terminate_when_unhealthy && !task::is_healthy(&config.env, world.environment.physics().torso_height_m())
}

/// [`WORLDS`] humanoids, each with a `T`.
pub struct BenchWorlds<T> {
    worlds: Vec<(BenchWorld, T)>,
    threads: usize,
}

impl<T: Send> BenchWorlds<T> {
    /// Creates and resets all; `state` creates the `T` of a world.
    pub fn new(
        tasks: &TaskRegistry,
        config: &EnvironmentConfig,
        model_xml: &str,
        threads: usize,
        state: impl Fn(usize) -> T,
    ) -> anyhow::Result<Self> {
        let world = |index| -> anyhow::Result<(BenchWorld, T)> {
            let environment = Environment::with_tasks(config, model_xml, tasks)?;
            let observation = vec![0.0; environment.observation_size()];
            let mut world = BenchWorld { index, environment, resets: 0, faults: 0, observation };
            world.reset();
            Ok((world, state(index)))
        };
        let worlds = (0..WORLDS).map(world).collect::<anyhow::Result<_>>()?;
        Ok(Self { worlds, threads })
    }

    /// Steps the physics of all worlds `rounds` times, each thread a share of them. `begin` sets the controls of a
    /// world in a round; `end`
    /// learns whether its physics failed.
    pub fn step(
        &mut self,
        rounds: u64,
        begin: impl Fn(u64, &mut BenchWorld, &mut T) + Sync,
        end: impl Fn(&mut BenchWorld, &mut T, bool) + Sync,
    ) {
        let (begin, end, pass) = (&begin, &end, worlds_per_pass());
        let share = worlds_per_thread(self.threads);
        let step_share = |share: &mut [(BenchWorld, T)]| {
            for round in 0..rounds {
                for chunk in share.chunks_mut(pass) {
                    for (world, state) in &mut *chunk {
                        begin(round, world, state);
                    }
                    Physics::step_together(&mut chunk.iter_mut().map(|(world, _)| world.environment.physics_mut()));
                    for (world, state) in chunk {
                        let failed = world.environment.physics_mut().check_step().is_err();
                        world.faults += u64::from(failed);
                        end(world, state, failed);
                    }
                }
            }
        };
        thread::scope(|scope| {
            for share in self.worlds.chunks_mut(share) {
                scope.spawn(|| step_share(share));
            }
        });
    }
}

fn worlds_per_thread(threads: usize) -> usize {
    WORLDS.div_ceil(threads).next_multiple_of(worlds_per_pass())
}

/// Returns how many of this many threads have worlds to step: each steps whole passes.
pub fn busy_threads(threads: usize) -> usize {
    WORLDS.div_ceil(worlds_per_thread(threads))
}

/// Returns the number of threads for a flag's value; 0 means one per core.
pub fn threads(wanted: usize) -> usize {
    if wanted == 0 { machine::cores() } else { wanted }
}
