//! How a run goes, for whoever asks, and commands for whoever may give them.
//!
//! Questions are answered at once, by a thread of their own; commands wait for a moment at which the training thread can
//! heed them, which comes several times a second even while it waits for experience.

mod roster;

use std::{
    io,
    sync::{
        Arc, Mutex, MutexGuard,
        atomic::{AtomicBool, Ordering},
        mpsc::{Receiver, TrySendError, sync_channel},
    },
    time::{Duration, Instant},
};

use treadmill_bus::{AliveView, Bus, BusError, ControlServer, PendingRequest, StatsFeed};
use treadmill_runtime::machine;
use treadmill_proto::{Command, ControlReply, RunStatus};

use roster::Roster;

/// Commands that may wait for the training thread.
const COMMANDS: usize = 16;
/// How often the desk looks up from waiting.
const TICK: Duration = Duration::from_millis(50);

/// What the training thread tells, and who was heard of.
struct Board {
    run: String,
    status: RunStatus,
    updated: Instant,
    quarantined: Vec<String>,
    roster: Roster,
}

/// The training thread's end.
pub struct Control {
    board: Arc<Mutex<Board>>,
    commands: Receiver<PendingRequest>,
    /// One that was seen to wait.
    next: Option<PendingRequest>,
    closed: Arc<AtomicBool>,
    told: Instant,
}

impl Control {
    /// Opens the desk and begins to answer.
    ///
    /// # Errors
    /// If the bus refuses, or the thread cannot be started.
    pub fn open(bus: &Bus, status: RunStatus, alive: AliveView) -> Result<Self, BusError> {
        let run = status.run.clone();
        let (desk, feed) = (ControlServer::open(bus, &run)?, StatsFeed::open(bus, &run, alive.clone())?);
        let roster = Roster::new(alive);
        let board =
            Arc::new(Mutex::new(Board { run, status, updated: Instant::now(), quarantined: Vec::new(), roster }));
        let (sender, commands) = sync_channel(COMMANDS);
        let closed = Arc::new(AtomicBool::new(false));
        std::thread::Builder::new()
            .name("control-desk".to_string())
            .spawn({
                let (board, closed) = (board.clone(), closed.clone());
                move || {
                    while !closed.load(Ordering::Relaxed) {
                        let inquiry = desk.next(TICK);
                        let mut board = lock(&board);
                        board.roster.hear(&feed, Instant::now());
                        let Some(inquiry) = inquiry else { continue };
                        if inquiry.request.command() == Command::Status {
                            let reply = board.reply(true, String::new());
                            inquiry.answer(&board.run, &reply);
                        } else if let Err(TrySendError::Full(inquiry) | TrySendError::Disconnected(inquiry)) =
                            sender.try_send(inquiry)
                        {
                            let why = format!("{COMMANDS} commands wait already; ask again");
                            let reply = board.reply(false, why);
                            inquiry.answer(&board.run, &reply);
                        }
                    }
                }
            })
            .map_err(|why: io::Error| BusError::Flow {
                what: "starting the control desk".into(),
                why: why.to_string(),
            })?;
        Ok(Self { board, commands, next: None, closed, told: Instant::now() })
    }

    /// Whether a command waits.
    pub fn is_asked(&mut self) -> bool {
        if self.next.is_none() {
            self.next = self.commands.try_recv().ok();
        }
        self.next.is_some()
    }

    /// The next command, if one comes within `patience`.
    pub fn next(&mut self, patience: Duration) -> Option<PendingRequest> {
        self.next.take().or_else(|| self.commands.recv_timeout(patience).ok())
    }

    /// Tells what was done about a command, or why nothing was.
    pub fn answer(&self, inquiry: PendingRequest, outcome: Result<String, String>) {
        let board = lock(&self.board);
        let reply = match outcome {
            Ok(text) => board.reply(true, text),
            Err(text) => board.reply(false, text),
        };
        inquiry.answer(&board.run, &reply);
    }

    /// How long ago [`Self::tell`] was called.
    pub fn since_told(&self) -> Duration {
        self.told.elapsed()
    }

    /// Takes down how it goes; `is_update` where an update is just done.
    pub fn tell(&mut self, status: RunStatus, quarantined: Vec<String>, is_update: bool) {
        self.told = Instant::now();
        let mut board = lock(&self.board);
        if is_update {
            board.updated = self.told;
        }
        (board.status, board.quarantined) = (status, quarantined);
    }
}

impl Drop for Control {
    fn drop(&mut self) {
        self.closed.store(true, Ordering::Relaxed);
    }
}

fn lock(board: &Mutex<Board>) -> MutexGuard<'_, Board> {
    board.lock().expect("no holder of this lock panics")
}

impl Board {
    fn reply(&self, done: bool, text: String) -> ControlReply {
        let newest = self.status.version.unwrap_or_default();
        let status = RunStatus {
            time_unix_s: machine::time_unix_s(),
            since_update_s: self.updated.elapsed().as_secs_f64(),
            actors: self.roster.actors(newest, &self.quarantined, Instant::now()),
            ..self.status.clone()
        };
        ControlReply { done, text, status: Some(status) }
    }
}
