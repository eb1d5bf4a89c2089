//! What pages see and ask, between their connections and the thread that shows something.

use std::{
    sync::{
        Arc, Condvar, Mutex, MutexGuard,
        mpsc::{Receiver, SyncSender, sync_channel},
    },
    time::Duration,
};

use bytes::Bytes;
use tokio::sync::{broadcast, watch};
use treadmill_proto::page::{FromPageKind, PageCurves, PageFrame, PageScene, ToPageKind};

use super::curves::CurveStore;

/// Most pages at a time.
pub const PAGES_MAX: usize = 8;
/// Frames that wait for a page: 2 s of one robot. A page that is slower goes on with the newest.
const FRAMES_MAX: usize = 64;
/// Points of curves and notices that wait for a page. A page that is slower has to connect again.
const NEWS_MAX: usize = 256;
/// Requests of pages that wait; further ones are dropped.
const ASKED_MAX: usize = 64;

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
}

/// Place of an open page, which is free again when it is dropped.
pub struct Seat(Hub);

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
        Some(Seat(self.clone()))
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
        }
    }

    /// Passes on a request of a page; drops it if too many wait.
    pub fn ask(&self, request: FromPageKind) {
        if self.steers() {
            let _ = self.asked.try_send(request);
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

impl Drop for Seat {
    fn drop(&mut self) {
        *self.0.pages() -= 1;
        self.0.shared.pages_changed.notify_all();
    }
}
