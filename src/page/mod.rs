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
//! - [`live`]: poses of a training actor, from the bus.
//! - [`scene`]: meshes of robots and ground.
//! - [`curves`]: metrics of runs, from their logs.

pub mod curves;
pub mod doors;
pub mod flags;
pub mod hub;
pub mod live;
pub mod player;
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

use self::{doors::Door, hub::Hub, show::Show};

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
        let play = move || show.run(&hub, &requests, &shutdown);
        thread::Builder::new().name("show".to_string()).spawn(play).context("no thread for the page")?;
        Ok(())
    }
}
