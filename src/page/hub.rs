//! What pages see and ask, between their connections and the thread that shows something.

use std::{
    sync::{
        Arc, Condvar, Mutex, MutexGuard,
        atomic::{AtomicU64, Ordering},
        mpsc::{Receiver, SyncSender, sync_channel},
    },
    time::Duration,
};

use bytes::Bytes;
use tokio::sync::{broadcast, watch};
use treadmill_proto::{
    RunStatus,
    page::{FromPageKind, PageCommand, PageCurves, PageFrame, PageScene, ToPageKind},
};

use super::curves::CurveStore;

/// Most pages at a time.
pub const PAGES_MAX: usize = 8;
/// Frames that wait for a page: 2 s of one robot. A page that is slower goes on with the newest.
const FRAMES_MAX: usize = 64;
/// Points of curves and notices that wait for a page. A page that is slower has to connect again.
const NEWS_MAX: usize = 256;
/// Requests of pages that wait; further ones are dropped.
const ASKED_MAX: usize = 64;
/// Most actors of a status.
const ACTORS_MAX: usize = 256;

/// Shared by the connections of all pages and by what is shown.
#[derive(Clone)]
pub struct Hub {
    shared: Arc<Shared>,
    asked: SyncSender<FromPageKind>,
}

struct Shared {
    scene: watch::Sender<Bytes>,
    frames: broadcast::Sender<Bytes>,
    news: broadcast::Sender<Bytes>,
    pages: Mutex<usize>,
    pages_changed: Condvar,
    curves: Mutex<CurveStore>,
    notice: Mutex<Bytes>,
    /// Counts how often curves were replaced.
    generation: watch::Sender<u64>,
    steers: bool,
    /// Numbers of the pages that were opened.
    opened: AtomicU64,
    /// Number of the page whose command the robots follow; 0 without any.
    steerer: watch::Sender<u64>,
}

/// Place of an open page, which is free again when it is dropped.
pub struct Seat {
    hub: Hub,
    number: u64,
}

/// What a page that opens receives.
pub struct PageView {
    /// Newest scene; empty until there is one.
    pub scene: watch::Receiver<Bytes>,
    /// Frames.
    pub frames: broadcast::Receiver<Bytes>,
    /// Notices and points of curves.
    pub news: broadcast::Receiver<Bytes>,
    /// All curves so far.
    pub curves: Bytes,
    /// Newest notice; empty without any.
    pub notice: Bytes,
    /// Changes when curves are replaced.
    pub generation: watch::Receiver<u64>,
    /// Number of the page whose command the robots follow, see [`Seat::number`]; 0 without any.
    pub steerer: watch::Receiver<u64>,
}

impl Hub {
    /// Creates a hub and the requests of its pages; they may ask for something only if it `steers`.
    #[must_use]
    pub fn new(steers: bool) -> (Self, Receiver<FromPageKind>) {
        let (asked, requests) = sync_channel(ASKED_MAX);
        let shared = Shared {
            scene: watch::Sender::new(Bytes::new()),
            frames: broadcast::Sender::new(FRAMES_MAX),
            news: broadcast::Sender::new(NEWS_MAX),
            pages: Mutex::new(0),
            pages_changed: Condvar::new(),
            curves: Mutex::default(),
            notice: Mutex::default(),
            generation: watch::Sender::new(0),
            steers,
            opened: AtomicU64::new(0),
            steerer: watch::Sender::new(0),
        };
        (Self { shared: Arc::new(shared), asked }, requests)
    }

    /// Whether pages may ask for something.
    #[must_use]
    pub fn steers(&self) -> bool {
        self.shared.steers
    }

    /// Takes a place for a page; `None` if there are too many.
    #[must_use]
    pub fn seat(&self) -> Option<Seat> {
        let mut pages = self.pages();
        if *pages >= PAGES_MAX {
            return None;
        }
        *pages += 1;
        self.shared.pages_changed.notify_all();
        let number = 1 + self.shared.opened.fetch_add(1, Ordering::Relaxed);
        Some(Seat { hub: self.clone(), number })
    }

    /// Returns what a page that opens receives. No point of a curve is lost or comes twice.
    #[must_use]
    pub fn view(&self) -> PageView {
        let curves = self.curves();
        PageView {
            scene: self.shared.scene.subscribe(),
            frames: self.shared.frames.subscribe(),
            news: self.shared.news.subscribe(),
            curves: ToPageKind::Curves(curves.whole()).to_bytes().into(),
            notice: self.notices().clone(),
            generation: self.shared.generation.subscribe(),
            steerer: self.shared.steerer.subscribe(),
        }
    }

    /// Whether a page is open.
    #[must_use]
    pub fn has_pages(&self) -> bool {
        *self.pages() > 0
    }

    /// Waits until a page is open; returns false if none is after `timeout`.
    #[must_use]
    pub fn wait_for_page(&self, timeout: Duration) -> bool {
        let waited = self.shared.pages_changed.wait_timeout_while(self.pages(), timeout, |pages| *pages == 0);
        *waited.expect("no holder of this lock panics").0 > 0
    }

    /// Shows a scene.
    pub fn show_scene(&self, scene: PageScene) {
        self.shared.scene.send_replace(ToPageKind::Scene(scene).to_bytes().into());
    }

    /// Shows a frame.
    pub fn show_frame(&self, frame: PageFrame) {
        // Without pages there is no receiver.
        let _ = self.shared.frames.send(ToPageKind::Frame(frame).to_bytes().into());
    }

    /// Shows how a run is.
    pub fn show_status(&self, mut status: RunStatus) {
        status.actors.truncate(ACTORS_MAX);
        let _ = self.shared.news.send(ToPageKind::Status(status).to_bytes().into());
    }

    /// Shows a line of text.
    pub fn notice(&self, text: impl Into<String>) {
        let message = Bytes::from(ToPageKind::Notice(text.into()).to_bytes());
        self.notices().clone_from(&message);
        let _ = self.shared.news.send(message);
    }

    /// Adds points to the curves of a run, or replaces its curves where the points begin `anew`.
    pub fn add_points(&self, run: &str, points: PageCurves, anew: bool) {
        if points.curves.is_empty() {
            return;
        }
        let mut curves = self.curves();
        if anew && curves.remove(run) {
            curves.add(&points);
            self.shared.generation.send_modify(|generation| *generation += 1);
            return;
        }
        curves.add(&points);
        // The log of a long run is thinned.
        let news = if anew { curves.of_run(run) } else { points };
        let _ = self.shared.news.send(ToPageKind::Curves(news).to_bytes().into());
    }

    fn pages(&self) -> MutexGuard<'_, usize> {
        self.shared.pages.lock().expect("no holder of this lock panics")
    }

    fn notices(&self) -> MutexGuard<'_, Bytes> {
        self.shared.notice.lock().expect("no holder of this lock panics")
    }

    fn curves(&self) -> MutexGuard<'_, CurveStore> {
        self.shared.curves.lock().expect("no holder of this lock panics")
    }
}

impl Seat {
    /// Number of the page, from 1.
    #[must_use]
    pub fn number(&self) -> u64 {
        self.number
    }

    /// Passes on a request of the page; drops it if too many wait.
    pub fn ask(&self, request: FromPageKind) {
        let Hub { shared, asked } = &self.hub;
        if !shared.steers {
            return;
        }
        let commands = match &request {
            FromPageKind::Command(command) => Some(command.follows),
            FromPageKind::Push(_) | FromPageKind::World(_) => None,
        };
        if asked.try_send(request).is_ok()
            && let Some(follows) = commands
        {
            let steerer = if follows { self.number } else { 0 };
            shared.steerer.send_if_modified(|known| std::mem::replace(known, steerer) != steerer);
        }
    }
}

impl Drop for Seat {
    fn drop(&mut self) {
        // Its command ends with it, also while other pages are open.
        if *self.hub.shared.steerer.borrow() == self.number {
            self.ask(FromPageKind::Command(PageCommand::default()));
        }
        *self.hub.pages() -= 1;
        self.hub.shared.pages_changed.notify_all();
    }
}
