//! The loop: collect, update, save, publish, log.

mod commands;
mod error;
mod start;

use std::{
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
    },
    time::{Duration, Instant},
};

use treadmill_bus::{Bus, PolicyServer, StatsFeed};
use treadmill_config::Config;
use treadmill_policy::normaliser::Normaliser;
use treadmill_runtime::{run_folder::RunFolder, shutdown::Shutdown};
use treadmill_proto::PolicyAnnouncement;

pub use self::commands::is_changeable;
pub use self::error::TrainingError;
use crate::{
    accounts,
    checkpoint::{Saver, TrainingState},
    control::Control,
    experience, histograms,
    intake::{Accepted, BusMailbox, Collected, Gathered, Intake},
    logging::{Exposition, History},
    mirror::Mirror,
    pace::Pace,
    ppo::{UpdateError, UpdateStats, Updater},
    pulse::Pulse,
    report::Report,
    room::wait_for_room,
    scalars::{Durations, Lag, Round, Speed},
    trial::{Trial, Verdict},
};

/// What training needs beside the state it begins with.
pub struct TrainingOptions {
    /// Where files go.
    pub folder: RunFolder,
    /// Where the networks are computed.
    pub device: candle_core::Device,
    /// The mirror that `ppo.symmetry` asks for.
    pub mirror: Option<Mirror>,
    /// Whether a bar is drawn on a terminal.
    pub show_progress: bool,
    /// Actor processes that were started again, counted by whoever starts them.
    pub restarts: Arc<AtomicU64>,
    /// Where the newest values are for whoever asks.
    pub exposition: Exposition,
    /// Where training shows that it goes on.
    pub pulse: Pulse,
    /// The command line of this start, and what versions and machine it runs with, for those who look at the run later.
    pub command: String,
    /// Names and values.
    pub versions: Vec<(String, String)>,
    /// What the entries of an action are called; their numbers where there are too few names.
    pub action_names: Vec<String>,
}

/// What came of a run.
#[derive(Clone, Debug)]
pub struct Summary {
    /// The state at the end.
    pub state: TrainingState,
    /// Seconds of this start.
    pub wall_s: f64,
    /// Environment steps of this start.
    pub env_steps: u64,
    /// Whether somebody asked to stop before the last step.
    pub stopped: bool,
    /// The greatest mean distance, of an evaluation or in training, in metres.
    pub farthest_m: Option<f64>,
}

/// Trains until the run has its steps or somebody asks to stop. Blocks: give it a thread of its own.
pub fn train(
    bus: &Bus,
    state: TrainingState,
    options: &TrainingOptions,
    shutdown: &Shutdown,
) -> Result<Summary, TrainingError> {
    let (begun, steps_before) = (Instant::now(), state.counters.env_steps);
    let mut trainer = Trainer::start(bus, state, options, shutdown)?;
    let outcome = go_on(&mut trainer, shutdown);
    trainer.report.end(outcome.as_ref().ok().copied());
    let stopped = outcome?;
    trainer.finish()?;
    Ok(Summary {
        wall_s: begun.elapsed().as_secs_f64(),
        env_steps: trainer.state.counters.env_steps - steps_before,
        stopped,
        farthest_m: trainer.history.farthest_m(),
        state: trainer.state,
    })
}

/// Round after round; whether somebody asked to stop before the last step.
fn go_on(trainer: &mut Trainer, shutdown: &Shutdown) -> Result<bool, TrainingError> {
    while trainer.state.counters.env_steps < trainer.config.run.steps {
        let round_begun = Instant::now();
        let Some(gathered) = trainer.collect(shutdown) else { return Ok(true) };
        let collect = round_begun.elapsed();
        let batch = &gathered.fragments;
        let update = trainer.update(batch)?;
        trainer.pulse.beat();
        let update_time = round_begun.elapsed() - collect;
        trainer.account(batch);
        let verdict = trainer.heed_verdict()?;
        let saved = trainer.save()?;
        trainer.pulse.beat();
        let checkpoint = round_begun.elapsed() - collect - update_time;
        trainer.publish(saved)?;
        let durations = Durations { collect, update: update_time, learn: trainer.learn, checkpoint };
        trainer.log(update.as_ref(), batch, durations, verdict.as_ref())?;
        trainer.pace.heed(&gathered);
        trainer.tell(shutdown, true);
    }
    Ok(false)
}

struct Trainer {
    state: TrainingState,
    config: Config,
    updater: Updater,
    mirror: Option<Mirror>,
    intake: Intake<BusMailbox>,
    pace: Pace,
    shelf: PolicyServer,
    stats: StatsFeed,
    accounts: std::path::PathBuf,
    shutdown: Shutdown,
    /// Where policies are evaluated while training goes on.
    trial: Option<Trial>,
    control: Control,
    /// Whether somebody asked to learn from nothing for now.
    paused: bool,
    saver: Saver,
    report: Report,
    /// What the run has reached so far.
    history: History,
    action_names: Vec<String>,
    speed: Speed,
    /// For how long the present batch was waited for.
    waited: Duration,
    exposition: Exposition,
    pulse: Pulse,
    restarts: Arc<AtomicU64>,
    restarts_before: u64,
    begun: Instant,
    wall_before_s: f64,
    undone_in_a_row: u32,
    /// How long the last update proper took.
    learn: Duration,
    /// Environment steps per second, and mean lag of the last batch.
    env_steps_per_s: f64,
    lag_mean: f64,
}

impl Trainer {
    fn collect(&mut self, shutdown: &Shutdown) -> Option<Gathered> {
        self.waited = Duration::ZERO;
        loop {
            self.heed_commands(shutdown);
            let begun = Instant::now();
            let control = &mut self.control;
            let interrupt = || control.is_asked() || control.since_told() >= commands::TELL_EVERY;
            let collected = self.intake.collect(self.pace.wanted(), &self.state.lineage, shutdown, interrupt);
            // A pause is no demand for rollouts.
            self.waited += begun.elapsed();
            match collected {
                Collected::Batch(gathered) => return Some(gathered),
                Collected::Interrupted => {
                    self.tell_if_due(shutdown);
                    self.report.waiting(self.waited, self.intake.alive().len());
                }
                Collected::Stopped => return None,
            }
        }
    }

    fn update(&mut self, accepted: &[Accepted]) -> Result<Option<UpdateStats>, TrainingError> {
        let state = &mut self.state;
        let policy = self.updater.policy().map_err(|why| TrainingError::State { why: why.to_string() })?;
        let clip = self.config.policy.observation_clip as f32;
        let normaliser = Normaliser::from_moments(&state.observation_moments, clip);
        let mut value_moments = state.value_moments.clone();
        let batch = experience::prepare(
            accepted,
            &policy,
            &normaliser,
            &mut value_moments,
            self.mirror.as_ref(),
            &self.config.ppo,
        )?;
        let mut observation_moments = state.observation_moments.clone();
        for Accepted { fragment, .. } in accepted {
            observation_moments.update(&fragment.observations, state.shape.observation);
        }
        let begun = Instant::now();
        let updated = if observation_moments.is_finite() && value_moments.is_finite() {
            self.updater.update_in(self.pace.epochs(), &batch, &mut state.shuffle)
        } else {
            Err(UpdateError::NonFinite { what: "running statistic" })
        };
        self.learn = begun.elapsed();
        match updated {
            Ok(stats) => {
                self.undone_in_a_row = 0;
                state.value_moments = value_moments;
                state.observation_moments = observation_moments;
                state.counters.gradient_steps += stats.minibatches;
                Ok(Some(stats))
            }
            Err(why) => {
                tracing::warn!("an update was undone: {why}");
                self.undone_in_a_row += 1;
                state.counters.undone_updates += 1;
                if self.undone_in_a_row >= self.config.learner.undone_max {
                    return Err(TrainingError::NotFinite { updates: self.undone_in_a_row, why });
                }
                Ok(None)
            }
        }
    }

    /// Brings the state up to date with what was learnt and from what.
    fn account(&mut self, batch: &[Accepted]) {
        let state = &mut self.state;
        state.parameters = self.updater.parameters();
        state.optimiser = self.updater.optimiser().clone();
        state.learning_rate = self.updater.learning_rate();
        state.lineage.advance();
        state.counters.updates += 1;
        for Accepted { fragment, .. } in batch {
            state.counters.env_steps += fragment.transitions() as u64;
            state.episodes.extend(&fragment.episodes);
        }
        state.actor_state = batch.last().and_then(|accepted| accepted.fragment.actor_state.clone());
        state.counters.wall_s = self.wall_before_s + self.begun.elapsed().as_secs_f64();
        state.counters.restarts = self.restarts_before + self.restarts.load(Ordering::Relaxed);
    }

    /// Writes the checkpoint, and returns it as it was written.
    fn save(&mut self) -> Result<Vec<u8>, TrainingError> {
        self.intake.count_unread();
        let judge = self.intake.judge();
        self.state.tally = judge.tally;
        self.state.ledger = judge.ledger.clone();
        // In the state that is written, everything taken so far is durable by being written.
        self.state.ledger.mark_durable();
        let best = self.best_in_training();
        self.state.best_return = best.or(self.state.best_return);
        let saved = wait_for_room(&self.shutdown, || self.saver.save(&self.state))?;
        if best.is_some() {
            wait_for_room(&self.shutdown, || self.saver.save_best(&saved))?;
        }
        self.intake.mark_durable();
        Ok(saved)
    }

    /// The mean return in training where it is the best so far and no policy was evaluated yet.
    fn best_in_training(&self) -> Option<f64> {
        let is_known = self.state.best_is_evaluated;
        let episodes = (!is_known).then_some(&self.state.episodes).filter(|episodes| episodes.is_full())?;
        let return_mean = episodes.means()?.return_mean;
        self.state.best_return.is_none_or(|best| return_mean > best).then_some(return_mean)
    }

    /// Hands out the new policy, also to be evaluated where that is due; `saved` is the checkpoint that it is part of.
    fn publish(&mut self, saved: Vec<u8>) -> Result<(), TrainingError> {
        let wrong = |why: String| TrainingError::State { why };
        let bundle = self.state.bundle().map_err(wrong)?;
        let announcement = PolicyAnnouncement { version: bundle.version, checksum: bundle.checksum };
        let encoded: bytes::Bytes = bundle.encode().map_err(|why| wrong(why.to_string()))?.into();
        self.shelf.publish(encoded.clone(), &announcement);
        self.intake.answer_held(&self.state.lineage);
        let env_steps = self.state.counters.env_steps;
        if let Some(trial) = &mut self.trial
            && trial.is_due(env_steps)
        {
            trial.put(bundle.version, encoded, env_steps, saved);
        }
        Ok(())
    }

    /// Takes the next verdict on a policy that was on trial; the best policy by verdict is kept.
    fn heed_verdict(&mut self) -> Result<Option<Verdict>, TrainingError> {
        let Some(verdict) = self.trial.as_mut().and_then(Trial::verdict) else { return Ok(None) };
        let return_mean = verdict.report.return_mean;
        let state = &mut self.state;
        if !state.best_is_evaluated || state.best_return.is_none_or(|best| return_mean > best) {
            (state.best_return, state.best_is_evaluated) = (Some(return_mean), true);
            wait_for_room(&self.shutdown, || self.saver.save_best(&verdict.checkpoint))?;
        }
        Ok(Some(verdict))
    }

    fn log(
        &mut self,
        update: Option<&UpdateStats>,
        batch: &[Accepted],
        durations: Durations,
        verdict: Option<&Verdict>,
    ) -> Result<(), TrainingError> {
        let alive = self.intake.alive();
        let env_steps = self.state.counters.env_steps;
        let (throughput, lag) = (self.speed.mark(env_steps, self.waited), Lag::of(batch));
        (self.env_steps_per_s, self.lag_mean) = (throughput.env_steps_per_s, lag.mean);
        let stats = self.stats.newest();
        self.exposition.take_actors(stats, self.state.lineage.newest());
        let means = self.state.episodes.means();
        let (return_mean, distance_m) =
            (means.as_ref().map(|m| m.return_mean), means.as_ref().map(|m| m.distance_mean_m));
        self.history.take(return_mean, distance_m, verdict.map(|verdict| verdict.report.distance_mean_m));
        let round = Round {
            state: &self.state,
            config: &self.config,
            update,
            lag,
            epochs: self.pace.epochs(),
            durations,
            verdict,
            history: &self.history,
            throughput,
            stats,
            alive: &alive,
            quarantined: self.intake.judge().quarantined(Instant::now()).len(),
            turned_away: self.intake.judge().turned_away(),
            accepted_bytes: self.intake.judge().accepted_bytes(),
        };
        let scalars = round.scalars();
        let updates = self.state.counters.updates;
        if histograms::is_due(updates) {
            let histograms = histograms::of(batch, &self.action_names);
            self.report.log_histograms(env_steps, &histograms, &self.shutdown)?;
        }
        Ok(self.report.log(env_steps, updates, &scalars, &self.history, &self.shutdown)?)
    }

    fn finish(&mut self) -> Result<(), TrainingError> {
        self.intake.stop(&self.state.lineage);
        // The state's own ledger: what the last checkpoint holds, and not what was taken since.
        accounts::write(&self.accounts, &self.state.ledger)?;
        self.report.finish(&self.history)?;
        Ok(())
    }
}
