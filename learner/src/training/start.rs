//! From a state to a trainer that is ready for its first batch.

use std::{
    sync::Arc,
    time::{Duration, Instant},
};

use treadmill_bus::{Alive, Bus, PolicyServer, RolloutCopies, RolloutIntake, StatsFeed, admission::Admission};
use treadmill_runtime::{machine, shutdown::Shutdown};

use super::{Trainer, TrainingError, TrainingOptions, commands};
use crate::{
    checkpoint::{Saver, TrainingState},
    control::Control,
    intake::{BusMailbox, Expected, Intake, Judge},
    logging::History,
    pace::Pace,
    ppo::Updater,
    report::Report,
    room::wait_for_room,
    scalars::Speed,
    trial::Trial,
};

impl Trainer {
    pub(super) fn start(
        bus: &Bus,
        state: TrainingState,
        options: &TrainingOptions,
        shutdown: &Shutdown,
    ) -> Result<Self, TrainingError> {
        let wrong = |why: String| TrainingError::State { why };
        let config = state.config().map_err(wrong)?;
        let mut bundle = state.bundle().map_err(wrong)?;
        // Only until the next version: an actor that joins later would do once more what was learnt from.
        bundle.actor_state = state.actor_state.clone();
        let expected = Expected {
            run: state.run.clone(),
            config_hash: bundle.config_hash,
            observation_size: bundle.observation_size,
            action_size: bundle.action_size,
            max_policy_lag: config.policy_lag_allowed().into(),
        };
        let capacity = config.learner.intake_fragments as usize;
        let gate = Arc::new(Admission::new(config.learner.quarantine_after, capacity));
        let judge = Judge::new(expected, gate.clone(), state.ledger.clone(), state.tally);
        let threads = match config.learner.threads {
            0 => machine::cores(),
            threads => threads as usize,
        };
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .thread_name(|index| format!("update-{index}"))
            .build()
            .map_err(|why| wrong(why.to_string()))?;
        let parameters = state.parameters.clone();
        let mut updater = Updater::on(&options.device, state.shape.clone(), parameters, &config.ppo, Arc::new(pool))
            .map_err(|why| wrong(why.to_string()))?;
        updater.restore(state.optimiser.clone(), state.learning_rate).map_err(|why| wrong(why.to_string()))?;
        let saver = Saver::new(
            &options.folder,
            config.learner.checkpoint_every_updates.into(),
            config.learner.keep_checkpoints as usize,
        );
        // Before any actor can hold this version, it is on disk: a learner that dies now is resumed from it.
        wait_for_room(shutdown, || saver.save(&state))?;
        let encoded = bundle.encode().map_err(|why| wrong(why.to_string()))?;
        let report = Report::open(bus, &state, &config, options)?;
        // After what lies beyond the checkpoint was taken out.
        let history = History::read(&options.folder.metrics())?;
        let copies = RolloutCopies::open(bus, &state.run)?;
        let queue = RolloutIntake::open(bus, &state.run, capacity, gate, &copies)?;
        let alive = Alive::watch(bus, &state.run)?;
        let control = Control::open(bus, commands::first_status(&state, config.run.steps), alive.view())?;
        let stats = StatsFeed::open(bus, &state.run, alive.view())?;
        let mailbox = BusMailbox::new(queue, alive, copies, options.pulse.clone());
        let intake = Intake::new(mailbox, config.learner.mode, judge);
        Ok(Self {
            intake,
            mirror: options.mirror.clone(),
            stats,
            accounts: options.folder.accounts(),
            shutdown: shutdown.clone(),
            trial: match config.evaluates() {
                false => None,
                true => Some(Trial::open(bus, &state.run, config.eval.every_steps, state.counters.env_steps)?),
            },
            shelf: PolicyServer::open(bus, &state.run, encoded.into())?,
            speed: Speed::new(state.counters.env_steps),
            waited: Duration::ZERO,
            exposition: options.exposition.clone(),
            pulse: options.pulse.clone(),
            restarts: options.restarts.clone(),
            restarts_before: state.counters.restarts,
            begun: Instant::now(),
            wall_before_s: state.counters.wall_s,
            undone_in_a_row: 0,
            learn: Duration::ZERO,
            env_steps_per_s: 0.0,
            lag_mean: 0.0,
            control,
            paused: false,
            pace: Pace::new(&config),
            saver,
            report,
            history,
            action_names: options.action_names.clone(),
            updater,
            config,
            state,
        })
    }
}
