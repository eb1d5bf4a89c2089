//! The page in the browser: robots that move, steering, and curves of a run.
//!
//! One thread simulates, or listens to an actor, while a page is open; without one it costs nothing. Each page has bounded
//! queues: a slow one loses frames, and the run never waits for it.
//!
//! # Layout
//! - [`flags`]: where the page is served.
//! - [`doors`]: who may open it.
//! - [`hub`]: what pages see and ask, between their connections and the thread that shows something.
//! - [`server`]: HTTP and WebSockets.
//! - [`show`]: policies that are played for the page.
//! - [`player`]: one policy and its environment.
//! - [`recorded`]: steps of an evaluation's trace.
//! - [`live`]: poses of a training actor, from the bus.
//! - [`fleet`]: how runs are, asked of their learners.
//! - [`scene`]: meshes of robots and ground.
//! - [`curves`]: metrics of runs, from their logs.

pub mod curves;
pub mod doors;
pub mod flags;
pub mod fleet;
pub mod hub;
pub mod live;
pub mod player;
pub mod recorded;
pub mod scene;
pub mod server;
pub mod show;

use std::{
    net::{SocketAddr, TcpListener},
    sync::mpsc::Receiver,
    thread,
};

use anyhow::Context;
use treadmill_proto::page::FromPageKind;
use treadmill_runtime::{error_chain, shutdown::Shutdown};

use self::{doors::Door, hub::Hub, recorded::Recorded, show::Show};

/// Niceness of the thread that shows something.
#[cfg(target_os = "linux")]
const NICENESS: i32 = 10;

/// Socket of the page, before it is served.
pub struct Served {
    listener: TcpListener,
    door: Door,
    hub: Hub,
    requests: Receiver<FromPageKind>,
    /// Address for the browser.
    pub link: String,
    /// Address of the socket.
    pub address: SocketAddr,
}

impl Served {
    /// Serves the page in a thread of its own until the stop.
    ///
    /// # Errors
    /// If the thread cannot be started.
    pub fn serve(self, shutdown: &Shutdown) -> anyhow::Result<OpenPage> {
        let Self { listener, door, hub, requests, .. } = self;
        let (served, shutdown) = (hub.clone(), shutdown.clone());
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().context("no runtime")?;
        let serve = move || {
            if let Err(why) = runtime.block_on(server::serve(listener, door, served, shutdown)) {
                tracing::warn!(error = %error_chain(&*why), "the page ended");
            }
        };
        thread::Builder::new().name("page".to_string()).spawn(serve).context("no thread for the page")?;
        Ok(OpenPage { hub, requests })
    }
}

/// Page that is served, and shows nothing yet.
pub struct OpenPage {
    /// What pages see.
    pub hub: Hub,
    requests: Receiver<FromPageKind>,
}

impl OpenPage {
    /// Plays what is shown in a thread of its own until the stop.
    ///
    /// # Errors
    /// If the thread cannot be started.
    pub fn play(self, show: Show, shutdown: &Shutdown) -> anyhow::Result<()> {
        let (Self { hub, requests }, shutdown) = (self, shutdown.clone());
        begin(move || show.run(&hub, &requests, &shutdown))
    }

    /// Plays a trace in a thread of its own until the stop.
    ///
    /// # Errors
    /// If the thread cannot be started.
    pub fn replay(self, recorded: Recorded, shutdown: &Shutdown) -> anyhow::Result<()> {
        let (hub, shutdown) = (self.hub, shutdown.clone());
        begin(move || recorded.run(&hub, &shutdown))
    }
}

/// Begins the thread that shows something. Threads of training go first.
fn begin(show: impl FnOnce() + Send + 'static) -> anyhow::Result<()> {
    let show = move || {
        // On other systems than Linux, this would slow the whole process.
        #[cfg(target_os = "linux")]
        // SAFETY: the call has no preconditions. On Linux it acts on the calling thread alone.
        unsafe {
            libc::nice(NICENESS);
        }
        show();
    };
    thread::Builder::new().name("show".to_string()).spawn(show).context("no thread for the page")?;
    Ok(())
}
