//! Output of the viewer: a page for a browser, or a file.

use std::{
    net::{IpAddr, SocketAddr, TcpListener},
    path::PathBuf,
};

use anyhow::Context;
use rerun::{MemoryLimit, RecordingStream, RecordingStreamBuilder, ServerOptions, web_viewer::WebViewerConfig};
use treadmill_rl::{
    launch::{exit_code::Usage, output::say, signals},
    shared::viewer_args::ViewerOutputArgs,
};
use treadmill_runtime::{machine, shutdown::Shutdown};

/// Rerun's application id, under which it keeps recordings and layouts.
const APPLICATION: &str = "treadmill";

/// Recording and its destination.
pub struct ViewerOutput {
    recording: RecordingStream,
    /// File that the recording is written to, if it is not served.
    file: Option<PathBuf>,
}

impl ViewerOutput {
    /// Opens the output; `name` is the name of the recording.
    pub fn open(args: &ViewerOutputArgs, name: &str, is_insecure: bool) -> anyhow::Result<Self> {
        let builder = RecordingStreamBuilder::new(APPLICATION).recording_name(name);
        if let Some(file) = &args.rrd {
            let recording =
                builder.save(file).with_context(|| format!("--rrd {}: the file cannot be written", file.display()))?;
            return Ok(ViewerOutput { recording, file: Some(file.clone()) });
        }
        Self::serve(args, builder, is_insecure)
    }

    fn serve(args: &ViewerOutputArgs, builder: RecordingStreamBuilder, is_insecure: bool) -> anyhow::Result<Self> {
        let bind = args.bind;
        if !bind.is_loopback() && !is_insecure {
            return Err(Usage(format!(
                "--bind {bind}: page and data have neither encryption nor authentication; forward the ports by ssh instead \
                 (see docs/guide/watch.md), or pass --insecure in a trusted network"
            ))
            .into());
        }
        let web_port = free_port(bind, args.web_port, "--web-port")?;
        let data_port = free_port(bind, args.data_port, "--data-port")?;
        let address = match bind {
            IpAddr::V6(bind) => format!("[{bind}]"),
            IpAddr::V4(bind) => bind.to_string(),
        };
        let host = if bind.is_unspecified() { machine::host_name() } else { address.clone() };
        let options = ServerOptions {
            memory_limit: MemoryLimit::from_bytes(args.memory_max_mb << 20),
            // Page and data have different ports.
            cors_allowed_origins: vec![format!("http://{host}:{web_port}"), format!("http://*:{web_port}")],
            ..ServerOptions::default()
        };
        let recording = builder.serve_grpc_opts(&address, data_port, options).context("the data cannot be served")?;
        let page = WebViewerConfig {
            bind_ip: bind.to_string(),
            web_port: web_port.into(),
            open_browser: false,
            ..WebViewerConfig::default()
        };
        page.host_web_viewer().context("the page cannot be served")?.detach();
        say(&format!("watch at http://{host}:{web_port}/?url=rerun%2Bhttp%3A%2F%2F{host}%3A{data_port}%2Fproxy"));
        Ok(ViewerOutput { recording, file: None })
    }

    /// Returns the stream to log to.
    pub fn recording(&self) -> &RecordingStream {
        &self.recording
    }

    /// Waits until everything is written. Serves a page until Ctrl-C.
    pub fn finish(self, shutdown: &Shutdown) -> anyhow::Result<()> {
        self.recording.flush_blocking().context("the recording could not be written completely")?;
        if let Some(file) = &self.file {
            // Closing the file writes its end.
            self.recording.disconnect();
            let bytes = std::fs::metadata(file).with_context(|| format!("cannot read `{}`", file.display()))?.len();
            say(&format!("written: {} ({} kB)", file.display(), bytes / 1000));
            return Ok(());
        }
        if shutdown.asked() {
            return Ok(());
        }
        say("all is shown; press Ctrl-C to end");
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().context("no runtime")?;
        runtime.block_on(async {
            signals::listen(shutdown.clone(), "").context("signals cannot be caught")?;
            shutdown.wait().await;
            anyhow::Ok(())
        })
    }
}

/// Returns the given port if it is free, or any free port for 0.
fn free_port(bind: IpAddr, port: u16, flag: &str) -> anyhow::Result<u16> {
    let bound =
        TcpListener::bind(SocketAddr::new(bind, port)).and_then(|listener| listener.local_addr()).map_err(|why| {
            Usage(format!("{flag} {port}: cannot listen on {bind}:{port}: {why}; choose another port, or 0"))
        })?;
    Ok(bound.port())
}
