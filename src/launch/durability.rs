//! Runs the learner of a command. If its state is in a store: begins the run, or follows it and leads once its leader is
//! gone.

use std::time::Duration;

use anyhow::Context;
use tokio::task::block_in_place;
use treadmill_bus::learner::StandbyMark;
use treadmill_learner::{
    checkpoint,
    leadership::{
        Leadership, LeadershipError, Manifest,
        follower::{LoadedState, newest_state},
        read_manifest,
    },
    training::TrainingError,
};
use treadmill_runtime::{error_chain, numbers::thousands, run_folder::RunFolder, run_lock::RunLock, words::quoted};
use treadmill_store::{Store, StoreError, Tag};

use crate::launch::{
    async_runtime, begin,
    exit_code::Usage,
    host::{self, Host, HostOptions},
    memory,
    output::{say, say_error},
    prepared::{Launcher, RunCommand, Start},
    resumption,
    run_args::{AnyRunArgs, NewRunArgs},
    standby::{NextMove, Standby, StoreWarnings},
    startup,
};

/// Interval of reading the manifest and of looking for tokens.
const POLL: Duration = Duration::from_millis(500);

/// Learner that a command starts.
pub struct LearnerRun<'a> {
    /// This process.
    pub launcher: Launcher<'a>,
    /// Flags of new runs.
    pub new: &'a NewRunArgs,
    /// Flags of new and resumed runs.
    pub any: &'a AnyRunArgs,
    /// Keys set by further flags.
    pub changes: &'a [(&'static str, toml::Value)],
    /// Name of a new run on the bus; by default that of its folder.
    pub name: Option<String>,
    /// Whether this process never begins a run.
    pub is_standby: bool,
}

impl LearnerRun<'_> {
    /// Runs until the run is complete or stopped.
    ///
    /// # Errors
    /// If flags are refused, or the store or the training fails.
    pub fn run(&self, options: HostOptions<'_>) -> anyhow::Result<()> {
        let Some(url) = &self.any.store else {
            let mut start = startup::prepare(self.launcher, self.new, self.any, self.changes)?;
            self.name.clone().map_or(Ok(()), |name| start.set_name(name))?;
            return host::run(start, options);
        };
        let store = Store::open(url).map_err(|why| Usage(error_chain(&why)))?;
        memory::keep_freed();
        async_runtime::run(async {
            let host = Host::open(options).await?;
            let outcome = self.serve(&store, &host).await;
            host.bus.close();
            outcome
        })
    }

    /// Reads the manifest, if there is one. A learner that may follow waits for a store that fails, as it would later.
    async fn read_first(&self, store: &Store, host: &Host<'_>) -> Result<Option<(Manifest, Tag)>, LeadershipError> {
        let mut warnings = StoreWarnings::default();
        loop {
            host.heartbeat.beat();
            match block_in_place(|| read_manifest(store)) {
                Err(LeadershipError::Store(why @ StoreError::Failed { .. }))
                    if self.follows() && !host.shutdown.asked() =>
                {
                    warnings.warn(&why);
                }
                read => return read,
            }
            host.pause(POLL).await;
        }
    }

    /// Whether this process waits for the present leader to end.
    fn follows(&self) -> bool {
        self.is_standby || self.any.resume_or_start
    }

    /// Begins a new run, unless the store holds one or this process only follows.
    ///
    /// # Errors
    /// If the store holds a run, and this process may not follow.
    async fn begin(&self, store: &Store, host: &Host<'_>) -> anyhow::Result<Option<Start>> {
        match self.read_first(store, host).await? {
            None if self.is_standby => Ok(None),
            None => block_in_place(|| self.begin_new(store)).map(Some),
            Some((manifest, _)) if self.follows() => {
                // Found now rather than when it is to lead.
                let folder = RunFolder::of_stored(self.new.run_dir.as_deref(), &manifest.run, &store.to_string())?;
                drop(RunLock::take(&folder)?);
                folder.discard();
                // A store that fails now is waited for later.
                if let Ok(Some(found)) = block_in_place(|| newest_state(store)) {
                    let state = checkpoint::read(&found.manifest.state, &found.state)?;
                    resumption::agreed_config(self.launcher, &state, self.new, self.any, self.changes)?;
                }
                Ok(None)
            }
            Some((manifest, _)) => Err(Usage(format!(
                "--store {store}: it holds run `{}` at {} env steps already; continue it with --resume-or-start, follow \
                 it with `treadmill learner --store {} --standby`, or choose another URL",
                manifest.run,
                thousands(manifest.env_steps),
                quoted(&store.to_string())
            ))
            .into()),
        }
    }

    fn begin_new(&self, store: &Store) -> anyhow::Result<Start> {
        let mut start = begin::begin(self.launcher, self.new, self.any, self.changes)?;
        if let Start::Ready(prepared, _) = &mut start {
            prepared.setup.store = Some(store.to_string());
            prepared.setup.folder.set_store(&store.to_string())?;
        }
        self.name.clone().map_or(Ok(()), |name| start.set_name(name))?;
        startup::write_files(self.launcher, self.new, self.any, &start)?;
        Ok(start)
    }

    /// Begins the run or follows it, then leads. A learner that was overtaken starts anew.
    async fn serve(&self, store: &Store, host: &Host<'_>) -> anyhow::Result<()> {
        let led = match self.begin(store, host).await? {
            Some(Start::Ready(prepared, mut lock)) => {
                let folder = prepared.setup.folder.clone();
                let leadership = Leadership::prepare(store, None)?;
                let led = host.lead(*prepared, &mut lock, Some(leadership)).await;
                if led.is_err() {
                    folder.discard();
                }
                led
            }
            _ => self.follow_and_lead(store, host).await,
        };
        // Restarting would forget a request to stop.
        match !host.shutdown.asked() && self.goes_on_after(&led) {
            true => Err(host.restart()).context("the learner cannot start anew"),
            false => led,
        }
    }

    async fn follow_and_lead(&self, store: &Store, host: &Host<'_>) -> anyhow::Result<()> {
        let Some(loaded) = self.follow(store, host).await? else { return Ok(()) };
        let (prepared, mut lock) = match block_in_place(|| self.resume(store, &loaded))? {
            Start::Ready(prepared, lock) => (*prepared, lock),
            Start::Finished(folder, state) => {
                host::print_finished(&folder, *state, &host.options);
                return Ok(());
            }
        };
        let leadership = Leadership::prepare(store, Some(&(loaded.manifest, loaded.tag)))?;
        host.lead(prepared, &mut lock, Some(leadership)).await
    }

    /// Returns whether this process follows again after it has led.
    fn goes_on_after(&self, led: &anyhow::Result<()>) -> bool {
        let Err(why) = led else { return false };
        let is_overtaken = matches!(
            why.downcast_ref::<TrainingError>(),
            Some(TrainingError::Leadership(LeadershipError::Overtaken { .. }))
        );
        let goes_on = is_overtaken && self.follows() && self.launcher.command == RunCommand::Learner;
        if goes_on {
            say_error(&format!("{why}; following it from now on"));
        }
        goes_on
    }

    /// Follows the run until it is time to lead. Returns `None` if the run has ended or this process is to stop.
    async fn follow(&self, store: &Store, host: &Host<'_>) -> anyhow::Result<Option<LoadedState>> {
        let mut standby = Standby::new(store, self.is_standby);
        let _mark = StandbyMark::open(&host.bus)?;
        say(&format!("following {store}, listening {}", host.endpoints.join(", ")));
        while !host.shutdown.asked() {
            match standby.poll(host).await? {
                NextMove::Wait => host.pause(POLL).await,
                NextMove::Lead => return Ok(standby.into_loaded()),
                NextMove::End => return Ok(None),
            }
        }
        Ok(None)
    }

    /// Prepares to go on from a state of the store.
    fn resume(&self, store: &Store, loaded: &LoadedState) -> anyhow::Result<Start> {
        let name = format!("{store}/{}", loaded.manifest.state);
        let mut state = checkpoint::read(&name, &loaded.state)?;
        // Its leader may have been lost between the best policy and the next state.
        let best = checkpoint::object(None);
        if let Ok((bytes, _)) = store.get(&best)
            && let Ok(best) = checkpoint::read(&best, &bytes)
        {
            state.adopt_best(&best);
        }
        let folder = RunFolder::of_stored(self.new.run_dir.as_deref(), &state.run, &store.to_string())?;
        let lock = RunLock::take(&folder)?;
        let mut start = resumption::go_on(self.launcher, (folder, lock), state, self.new, self.any, self.changes)?;
        self.name.clone().map_or(Ok(()), |name| start.set_name(name))?;
        startup::write_files(self.launcher, self.new, self.any, &start)?;
        Ok(start)
    }
}
