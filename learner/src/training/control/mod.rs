//! Control of a run: status requests and commands.
//!
//! A separate thread answers status requests at once. Commands are queued for the training thread, which applies them
//! several times a second, also while it waits for fragments.

mod roster;

use std::{
    io,
    sync::{
        Arc, Mutex, MutexGuard,
        atomic::{AtomicBool, Ordering},
        mpsc::{Receiver, SyncSender, TrySendError, sync_channel},
    },
    time::{Duration, Instant},
};

use treadmill_bus::{
    Bus, BusError,
    learner::{AliveView, ControlServer, PendingRequest, StatsFeed},
};
use treadmill_proto::{Command, ControlReply, RunStatus};
use treadmill_runtime::machine;

use crate::waiting::PendingWrites;
use roster::Roster;

/// Commands that may be queued for the training thread.
const COMMANDS_MAX: usize = 16;
/// Longest wait for a request between two checks for the end of the run.
const TICK: Duration = Duration::from_millis(50);

/// Newest status of the training thread, and the actors' statistics.
struct StatusBoard {
    run: String,
    status: RunStatus,
    updated: Instant,
    quarantined: Vec<String>,
    roster: Roster,
    pending: PendingWrites,
    /// Command that starts an actor, unless this process starts them itself.
    actor_command: Option<String>,
}

/// The training thread's end of the control flow.
pub struct ControlChannel {
    board: Arc<Mutex<StatusBoard>>,
    commands: Receiver<PendingRequest>,
    /// Command that [`Self::has_command`] took from the queue.
    next: Option<PendingRequest>,
    closed: Arc<AtomicBool>,
    status_set: Instant,
}

impl ControlChannel {
    /// Starts the thread that answers requests.
    ///
    /// # Errors
    /// If the bus refuses, or the thread cannot be started.
    pub fn open(
        bus: &Bus,
        status: RunStatus,
        alive: AliveView,
        actor_command: Option<String>,
        pending: PendingWrites,
    ) -> Result<Self, BusError> {
        let run = status.run.clone();
        let (server, feed) = (ControlServer::open(bus, &run)?, StatsFeed::open(bus, &run, alive.clone())?);
        let roster = Roster::new(alive);
        let (updated, quarantined) = (Instant::now(), Vec::new());
        let board = StatusBoard { run, status, updated, quarantined, roster, pending, actor_command };
        let board = Arc::new(Mutex::new(board));
        let (sender, commands) = sync_channel(COMMANDS_MAX);
        let closed = Arc::new(AtomicBool::new(false));
        std::thread::Builder::new()
            .name("control-server".to_string())
            .spawn({
                let (board, closed) = (board.clone(), closed.clone());
                move || serve(&server, &feed, &board, &sender, &closed)
            })
            .map_err(|why: io::Error| BusError::Flow {
                what: "starting the control thread".into(),
                why: why.to_string(),
            })?;
        Ok(Self { board, commands, next: None, closed, status_set: Instant::now() })
    }

    /// Whether a command is queued.
    pub fn has_command(&mut self) -> bool {
        if self.next.is_none() {
            self.next = self.commands.try_recv().ok();
        }
        self.next.is_some()
    }

    /// Returns the next command, if one comes within `timeout`.
    pub fn next(&mut self, timeout: Duration) -> Option<PendingRequest> {
        self.next.take().or_else(|| self.commands.recv_timeout(timeout).ok())
    }

    /// Answers a command with its outcome: a message, or an error.
    pub fn answer(&self, pending: PendingRequest, outcome: Result<String, String>) {
        let board = lock(&self.board);
        let is_done = outcome.is_ok();
        pending.answer(&board.run, &board.reply(is_done, outcome.unwrap_or_else(|why| why)));
    }

    /// Time since the last call of [`Self::set_status`].
    pub fn since_status(&self) -> Duration {
        self.status_set.elapsed()
    }

    /// Sets the status for later requests; `is_update` right after an update.
    pub fn set_status(&mut self, status: RunStatus, quarantined: Vec<String>, is_update: bool) {
        self.status_set = Instant::now();
        let mut board = lock(&self.board);
        if is_update {
            board.updated = self.status_set;
        }
        (board.status, board.quarantined) = (status, quarantined);
    }
}

impl Drop for ControlChannel {
    fn drop(&mut self) {
        self.closed.store(true, Ordering::Relaxed);
    }
}

/// Answers status requests and queues commands until `closed` is set.
fn serve(
    server: &ControlServer,
    feed: &StatsFeed,
    board: &Mutex<StatusBoard>,
    commands: &SyncSender<PendingRequest>,
    closed: &AtomicBool,
) {
    while !closed.load(Ordering::Relaxed) {
        let pending = server.next(TICK);
        let mut board = lock(board);
        let newest = board.status.version.unwrap_or_default();
        board.roster.update(feed, newest, Instant::now());
        let Some(pending) = pending else { continue };
        if pending.request.command() == Command::Status {
            pending.answer(&board.run, &board.reply(true, String::new()));
        } else if let Err(TrySendError::Full(pending) | TrySendError::Disconnected(pending)) =
            commands.try_send(pending)
        {
            let why = format!("{COMMANDS_MAX} commands are queued already; try again");
            pending.answer(&board.run, &board.reply(false, why));
        }
    }
}

fn lock(board: &Mutex<StatusBoard>) -> MutexGuard<'_, StatusBoard> {
    board.lock().expect("no holder of this lock panics")
}

impl StatusBoard {
    /// Returns a reply with the present status.
    fn reply(&self, done: bool, text: String) -> ControlReply {
        let mut status = RunStatus {
            time_unix_s: machine::time_unix_s(),
            since_update_s: self.updated.elapsed().as_secs_f64(),
            actors: self.roster.actors(&self.quarantined, Instant::now()),
            ..self.status.clone()
        };
        if let Some(alarm) = self.pending.alarm(Instant::now()) {
            status.waits_for_storage = true;
            status.alarms.insert(0, alarm);
        }
        if !status.actors.iter().any(|actor| actor.alive) {
            status.env_steps_per_s = 0.0;
            let command = self.actor_command.as_ref().map(|command| format!("; start one: {command}"));
            status.alarms.insert(0, format!("no actor is connected{}", command.unwrap_or_default()));
        }
        ControlReply { done, text, status: Some(status) }
    }
}
