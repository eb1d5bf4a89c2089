//! Flags about the page, and the socket that it is served on.

use std::{
    net::{IpAddr, Ipv4Addr, SocketAddr, TcpListener},
    path::Path,
};

use anyhow::Context;
use clap::Args;

use super::{Served, doors::Door, hub::Hub};
use crate::launch::{exit_code::Usage, restart};

/// Port unless another program has it.
const PORT: u16 = 7448;

/// Flags about the page.
#[derive(Args, Clone, Debug, Default)]
pub struct ServeArgs {
    /// Address of the page in the browser; by default 127.0.0.1:7448, or a free port if that is in use. Beyond loopback it
    /// needs --tls with a certificate of a learner or router, and the printed link has a token.
    #[arg(long, value_name = "ADDRESS")]
    page_listen: Option<SocketAddr>,
    /// Let the page steer the robot, push it and change its world.
    #[arg(long)]
    pub steer: bool,
}

/// Flags of processes that train about the page.
#[derive(Args, Clone, Debug, Default)]
pub struct TrainPageArgs {
    #[command(flatten)]
    serve: ServeArgs,
    /// Serve no page in the browser.
    #[arg(long, conflicts_with_all = ["page_listen", "steer"])]
    no_page: bool,
}

impl TrainPageArgs {
    /// Opens the socket of the page if there is to be one. Called before anything is written.
    ///
    /// # Errors
    /// See [`ServeArgs::open`].
    pub fn open(&self, tls: Option<&Path>) -> anyhow::Result<Option<Served>> {
        (!self.no_page).then(|| self.serve.open(tls)).transpose()
    }
}

impl ServeArgs {
    /// Opens the socket; `tls` is the folder of certificates.
    ///
    /// # Errors
    /// If the address is in use, or beyond loopback without a certificate.
    pub fn open(&self, tls: Option<&Path>) -> anyhow::Result<Served> {
        let is_local = self.page_listen.is_none_or(|address| address.ip().is_loopback());
        let door = match (is_local, tls) {
            (true, _) => Door::Loopback,
            (false, Some(folder)) => Door::with_tls(folder)?,
            (false, None) => {
                let address = self.page_listen.expect("it is not local");
                let port = address.port();
                return Err(Usage(format!(
                    "--page-listen {address}: beyond loopback the page needs encryption; pass --tls DIR (certificates: \
                     `treadmill certs DIR`), or listen on 127.0.0.1:{port} and forward it: ssh -L {port}:127.0.0.1:{port} SERVER"
                ))
                .into());
            }
        };
        let listener = self.listen()?;
        let address = listener.local_addr()?;
        let host = match address.ip().is_unspecified() {
            true => format!("{}:{}", door.host(), address.port()),
            false => address.to_string(),
        };
        listener.set_nonblocking(true)?;
        let (hub, requests) = Hub::new(self.steer);
        Ok(Served { listener, link: door.link(&host), address, door, hub, requests })
    }

    fn listen(&self) -> anyhow::Result<TcpListener> {
        let Some(address) = self.page_listen else {
            let local = |port| SocketAddr::new(IpAddr::V4(Ipv4Addr::LOCALHOST), port);
            return TcpListener::bind(local(PORT))
                .or_else(|_| TcpListener::bind(local(0)))
                .context("the page has no port");
        };
        let why = |why| Usage(format!("--page-listen {address}: cannot listen: {why}; choose another port, or 0"));
        let bound = TcpListener::bind(address).or_else(|why| {
            // Another process may have taken the port in the pause of a restart, which must not end the run.
            let is_free_to_choose = restart::is_restarted() && address.ip().is_loopback();
            if is_free_to_choose { TcpListener::bind(SocketAddr::new(address.ip(), 0)) } else { Err(why) }
        });
        Ok(bound.map_err(why)?)
    }
}
