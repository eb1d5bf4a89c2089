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
    ActorStatus, RunStatus,
    page::{FromPageKind, PageCommand, PageCurves, PageFrame, PageScene, PageStatus, PageSteerer, ToPageKind},
};

use super::curves::CurveStore;

/// Most pages at a time.
pub const PAGES_MAX: usize = 8;
/// Frames that wait for a page: 2 s of one robot. A page that is slower goes on with the newest.
const FRAMES_MAX: usize = 64;
/// Points of curves and notices that wait for a page. A page that is slower has to connect again.
const NEWS_MAX: usize = 256;
/// Pushes and worlds that wait; further ones are dropped.
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
    /// Newest command that the robots have not got yet. Unlike a push it may not be lost.
    command: Mutex<Option<PageCommand>>,
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
    /// Number of the page whose command the robots follow, see [`Seat::sees`]; 0 without any.
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
            command: Mutex::default(),
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

    /// Takes the newest command of the pages, if it is new.
    #[must_use]
    pub fn take_command(&self) -> Option<PageCommand> {
        self.commands().take()
    }

    /// Shows how a run is.
    pub fn show_status(&self, mut status: RunStatus) {
        let alive = status.actors.iter().filter(|actor| actor.alive).count() as u32;
        let actors = status.actors.len() as u32;
        let speed = |actor: &ActorStatus| actor.stats.as_ref().map_or(0.0, |stats| stats.env_steps_per_s);
        status.actors.sort_by(|one, other| {
            let rank = |actor: &ActorStatus| (!actor.quarantined, actor.alive);
            rank(one).cmp(&rank(other)).then(speed(one).total_cmp(&speed(other)))
        });
        status.actors.truncate(ACTORS_MAX);
        let shown = PageStatus { status: Some(status), actors, alive };
        let _ = self.shared.news.send(ToPageKind::Status(shown).to_bytes().into());
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

    fn commands(&self) -> MutexGuard<'_, Option<PageCommand>> {
        self.shared.command.lock().expect("no holder of this lock panics")
    }

    fn curves(&self) -> MutexGuard<'_, CurveStore> {
        self.shared.curves.lock().expect("no holder of this lock panics")
    }
}

impl Seat {
    /// Returns whose command the robots follow, seen from this page; `steerer` is [`PageView::steerer`].
    #[must_use]
    pub fn sees(&self, steerer: u64) -> PageSteerer {
        match steerer {
            0 => PageSteerer::Free,
            own if own == self.number => PageSteerer::You,
            _ => PageSteerer::Another,
        }
    }

    /// Passes on a request of the page. A newer command replaces one that waits; a push or a world is dropped if too many
    /// wait.
    pub fn ask(&self, request: FromPageKind) {
        let Hub { shared, asked } = &self.hub;
        if !shared.steers {
            return;
        }
        match request {
            FromPageKind::Command(command) => {
                let steerer = if command.follows { self.number } else { 0 };
                *self.hub.commands() = Some(command);
                shared.steerer.send_if_modified(|known| std::mem::replace(known, steerer) != steerer);
            }
            FromPageKind::Push(_) | FromPageKind::World(_) => drop(asked.try_send(request)),
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

#[cfg(test)]
mod tests {
    use treadmill_proto::{
        ActorStats,
        page::{PagePush, ToPage},
    };

    use super::*;

    fn command(follows: bool) -> FromPageKind {
        FromPageKind::Command(PageCommand { follows, ..PageCommand::default() })
    }

    #[test]
    fn the_newest_command_is_never_lost_and_ends_with_its_page() {
        let (hub, requests) = Hub::new(true);
        let [one, other] = [hub.seat().unwrap(), hub.seat().unwrap()];
        let steerer = hub.view().steerer;
        for _ in 0..2 * ASKED_MAX {
            one.ask(FromPageKind::Push(PagePush::default()));
        }
        one.ask(command(true));
        assert_eq!(
            (one.sees(*steerer.borrow()), other.sees(*steerer.borrow())),
            (PageSteerer::You, PageSteerer::Another)
        );
        drop(one);
        assert_eq!(hub.take_command(), Some(PageCommand::default()), "the robots are free again");
        assert_eq!((other.sees(*steerer.borrow()), hub.take_command()), (PageSteerer::Free, None));
        assert_eq!(requests.try_iter().count(), ASKED_MAX);
        let (read_only, _requests) = Hub::new(false);
        read_only.seat().unwrap().ask(command(true));
        assert_eq!(read_only.take_command(), None);
    }

    #[test]
    fn of_many_actors_those_with_trouble_are_shown() {
        let (hub, _requests) = Hub::new(false);
        let mut news = hub.view().news;
        let actor = |number: usize| ActorStatus {
            name: format!("actor-{number:03}"),
            alive: number != 298,
            quarantined: number == 299,
            stats: Some(ActorStats { env_steps_per_s: 1000.0 - number as f64, ..ActorStats::default() }),
            ..ActorStatus::default()
        };
        hub.show_status(RunStatus { actors: (0..300).map(actor).collect(), ..RunStatus::default() });
        let sent = ToPage::from_bytes(&news.try_recv().unwrap()).unwrap();
        let Some(ToPageKind::Status(PageStatus { status: Some(status), actors: 300, alive: 299 })) = sent.kind else {
            panic!("not the status of 300 actors")
        };
        let first: Vec<&str> = status.actors.iter().take(3).map(|actor| &actor.name[..]).collect();
        assert_eq!((status.actors.len(), &first[..]), (ACTORS_MAX, &["actor-299", "actor-298", "actor-297"][..]));
    }
}
