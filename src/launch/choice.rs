//! Number of environments of a new run of `train`, chosen by measuring this machine.
//!
//! With more environments a round has fewer control steps one after the other, but a goal takes more env steps. On a machine
//! of many cores, the first can save more time than the second costs.

use std::time::{Duration, Instant};

use treadmill_actor::environments::{Environments, SeedSource, StepResults};
use treadmill_config::{Config, LearnerMode, RolloutConfig};
use treadmill_humanoid::TaskRegistry;
use treadmill_learner::intake::HorizonRule;
use treadmill_policy::Networks;
use treadmill_ppo::{PpoOptions, device::Device, settings::UpdateSize};
use treadmill_runtime::machine;

use crate::{commands::bench::update, launch::prepared::actor_processes};

/// Numbers of environments to choose from, the usual one first.
const CANDIDATES: [u32; 3] = [64, 256, 1024];
/// Cores from which on it is worth a measurement: with fewer, rounds take longer in proportion to the environments.
const CORES_MIN: usize = 4;
/// Env steps to a goal grow with this power of the environments: 256 need 1.7 times those of 64, 1,024 need 2.5 times as
/// many (`experiments/learning/environments.csv`).
const STEPS_POWER: f64 = 0.35;
/// Share of the time that another number than the usual one must save.
const GAIN_MIN: f64 = 0.1;
/// Duration of a round beside simulation and update: checkpoint, announcement, receipts.
const SERIAL_S: f64 = 0.004;
/// Most environments that are measured, which take time to build. More take longer in proportion.
const SHARE_MAX: u32 = 64;
/// Most rows of the gradient steps that are measured.
const MINIBATCH_MAX: u32 = 2048;
/// Duration of the measurement of a candidate's control steps.
const MEASURE_FOR: Duration = Duration::from_millis(50);

/// Speeds of a machine with the task and networks of a run.
#[derive(Clone, Debug)]
struct Speeds {
    /// Duration of a control step of an actor's share of each candidate.
    step_s: [f64; CANDIDATES.len()],
    /// Duration of a pass of the update for each row.
    row_s: f64,
    /// Actor processes for each core, at least 1.
    actors_per_core: f64,
}

/// Measures the machine and sets the number of environments. Returns why, in one line; `None` if it is not for this machine
/// or run to choose, or nothing can be measured.
pub fn choose_environments(
    config: &mut Config,
    tasks: &TaskRegistry,
    model_xml: &str,
    networks: &Networks,
    device: &Device,
) -> Option<String> {
    let cores = machine::cores();
    let is_usual = config.rollout.envs == CANDIDATES[0]
        && config.learner.mode == LearnerMode::Sync
        && (config.rollout.actors, config.rollout.fragment_steps) == (0, 0)
        && !config.run.deterministic;
    if cores < CORES_MIN || !is_usual || networks.mirror().is_none() || matches!(device, Device::Candle) {
        return None;
    }
    let speeds = measure(config, tasks, model_xml, networks, device, cores)?;
    let size = UpdateSize::of(&config.ppo);
    let rule = HorizonRule::new(config, networks.shape().observation, networks.shape().action);
    let (index, saved) = best(&speeds, &rule, size.epochs);
    config.rollout.envs = CANDIDATES[index];
    let usual = CANDIDATES[0];
    let why = match index {
        0 => "more would not save a tenth of the time".to_string(),
        _ => format!("about {:.0} % less time to a goal than with {usual}, which --envs {usual} keeps", 100.0 * saved),
    };
    let (step_ms, pass_ms) = (1e3 * speeds.step_s[index], 1e3 * speeds.row_s * size.transitions as f64);
    Some(format!(
        "{} environments for {cores} cores: {why} (a control step takes {step_ms:.2} ms, a pass over a batch {pass_ms:.1} ms)",
        CANDIDATES[index]
    ))
}

/// Returns the index of the best candidate, and the share of the time to a goal that it saves.
fn best(speeds: &Speeds, rule: &HorizonRule, epochs: u32) -> (usize, f64) {
    let times: Vec<f64> = (0..CANDIDATES.len()).map(|index| goal_time(speeds, rule, epochs, index)).collect();
    let saved = |index: usize| 1.0 - times[index] / times[0];
    let best = (1..times.len()).filter(|index| saved(*index) > GAIN_MIN).min_by(|a, b| times[*a].total_cmp(&times[*b]));
    best.map_or((0, 0.0), |index| (index, saved(index)))
}

/// Returns the time to a goal with a candidate, in units of its env steps with the usual number of environments.
fn goal_time(speeds: &Speeds, rule: &HorizonRule, epochs: u32, index: usize) -> f64 {
    let envs = CANDIDATES[index] as usize;
    let steps = f64::from(rule.nominal(envs));
    let rows = steps * envs as f64;
    let simulation_s = steps * speeds.step_s[index] * speeds.actors_per_core;
    let round_s = simulation_s + rows * speeds.row_s * f64::from(epochs) + SERIAL_S;
    let more_steps = (envs as f64 / f64::from(CANDIDATES[0])).powf(STEPS_POWER);
    more_steps * round_s / rows
}

fn measure(
    config: &Config,
    tasks: &TaskRegistry,
    model_xml: &str,
    networks: &Networks,
    device: &Device,
    cores: usize,
) -> Option<Speeds> {
    let mut step_s = [0.0; CANDIDATES.len()];
    let mut known = (0, 0.0);
    for (duration_s, envs) in step_s.iter_mut().zip(CANDIDATES) {
        let share = envs.div_ceil(actor_processes(config.rollout.actors, envs));
        let few = share.min(SHARE_MAX);
        if known.0 != few {
            known = (few, control_step_s(config, tasks, model_xml, few as usize)?);
        }
        *duration_s = known.1 * f64::from(share) / f64::from(few);
    }
    let threads = machine::threads(config.learner.threads as usize);
    let options = PpoOptions {
        device: device.with_own_memory(),
        chunk_rows: config.learner.chunk_rows as usize,
        ..PpoOptions::on_cpu(threads).ok()?
    };
    let minibatch = UpdateSize::of(&config.ppo).minibatch.min(MINIBATCH_MAX);
    let (_, samples_per_s, _) = update::measure(options, networks.clone(), minibatch, 1).ok()?;
    let actors = f64::from(actor_processes(config.rollout.actors, RolloutConfig::default().envs));
    Some(Speeds { step_s, row_s: 1.0 / samples_per_s, actors_per_core: (actors / cores as f64).max(1.0) })
}

/// Returns the duration of a control step of so many environments on one core, after some for warm-up.
fn control_step_s(config: &Config, tasks: &TaskRegistry, model_xml: &str, envs: usize) -> Option<f64> {
    const WARM_UP: u32 = 3;
    let seeds = SeedSource { run_seed: 1, actor: "choice".to_string(), start: 0 };
    let mut environments = Environments::new(envs, tasks, &config.environment(), model_xml, seeds).ok()?;
    let (actions, mut results) = (vec![0.0; envs * environments.action_size()], StepResults::default());
    (0..WARM_UP).for_each(|_| environments.step(&actions, &mut results));
    let (begun, mut steps) = (Instant::now(), 0_u32);
    while steps == 0 || begun.elapsed() < MEASURE_FOR {
        environments.step(&actions, &mut results);
        steps += 1;
    }
    Some(begun.elapsed().as_secs_f64() / f64::from(steps))
}

#[cfg(test)]
mod tests {
    use super::*;
    use treadmill_config::ConfigSource;
    use treadmill_humanoid::HUMANOID_XML;
    use treadmill_policy::{NetworkShape, PolicyMirror};

    fn rule() -> HorizonRule {
        let mut source = ConfigSource::default();
        source.set("ppo.batch=2048").unwrap();
        HorizonRule::new(&source.build().unwrap(), 103, 29)
    }

    /// Speeds of a machine whose actors simulate 16 robots in the time of one, and whose threads share the update.
    fn speeds(cores: usize, pass_s: f64, row_s: f64, has_gpu: bool) -> Speeds {
        let share = |envs: u32| (envs as usize).div_ceil(cores.min(envs as usize));
        let step_s = CANDIDATES.map(|envs| pass_s * share(envs).div_ceil(16) as f64);
        // Small minibatches gain a factor of five at most from more threads.
        let row_s = if has_gpu { 3e-7 } else { row_s / cores.min(5) as f64 };
        Speeds { step_s, row_s, actors_per_core: 1.0 }
    }

    #[test]
    fn machines_of_1_to_256_cores_with_and_without_a_gpu_get_what_is_fastest() {
        // A control step of 29 hinges in 1.4 ms, one of the walk in 0.23 ms; a row and pass in 8 µs on one core.
        let chosen = |cores, pass_s, has_gpu| CANDIDATES[best(&speeds(cores, pass_s, 8e-6, has_gpu), &rule(), 5).0];
        for cores in [1, 2, 4] {
            assert_eq!(chosen(cores, 1.4e-3, false), 64, "{cores} cores simulate no more at a time");
        }
        for cores in [16, 64, 256] {
            assert_eq!(chosen(cores, 1.4e-3, false), 256, "{cores} cores");
            assert_ne!(chosen(cores, 1.4e-3, true), 64, "{cores} cores and a GPU");
            assert_eq!(chosen(cores, 0.23e-3, false), 64, "{cores} cores: the update takes most of a round");
        }
        for cores in 1..=256 {
            for has_gpu in [false, true] {
                let speeds = speeds(cores, 1.4e-3, 8e-6, has_gpu);
                let (index, saved) = best(&speeds, &rule(), 5);
                let times = [0, 1, 2].map(|index| goal_time(&speeds, &rule(), 5, index));
                assert!(times.iter().all(|time| time.is_finite() && *time > 0.0));
                assert!(
                    index == 0 && saved == 0.0 || saved > GAIN_MIN && times[index] < times[0],
                    "{cores}: {times:?}"
                );
            }
        }
    }

    #[test]
    fn the_time_to_a_goal_is_that_computed_by_hand() {
        // 64 environments: 32 steps of 1 ms, 2,048 rows in 5 passes of 1 µs, 4 ms: 46.24 ms for 2,048 rows.
        let speeds = Speeds { step_s: [1e-3; 3], row_s: 1e-6, actors_per_core: 1.0 };
        let time = goal_time(&speeds, &rule(), 5, 0);
        assert!((time - 0.046_24 / 2048.0).abs() < 1e-12, "{time}");
        // Twice as many processes as cores take turns.
        let crowded = Speeds { actors_per_core: 2.0, ..speeds };
        assert!((goal_time(&crowded, &rule(), 5, 0) - 0.078_24 / 2048.0).abs() < 1e-12);
    }

    #[test]
    fn a_machine_is_measured() {
        let shape = NetworkShape { observation: 45, action: 17, hidden: vec![16], privileged: 0 };
        let reversed = |size: usize| (0..size).rev().map(|entry| (entry, 1.0)).collect();
        let mirror = PolicyMirror { observation: reversed(45), action: reversed(17) };
        let networks = Networks::new(shape, Some(mirror)).unwrap();
        let (mut config, tasks) = (Config::default(), TaskRegistry::default());
        config.learner.chunk_rows = 256;
        let measured = measure(&config, &tasks, HUMANOID_XML, &networks, &Device::Cpu, 2).expect("it is measured");
        assert!(measured.step_s.iter().all(|step_s| *step_s > 0.0 && *step_s < 10.0), "{measured:?}");
        assert!(measured.row_s > 0.0 && measured.row_s < 1e-3 && measured.actors_per_core >= 1.0, "{measured:?}");
    }
}
