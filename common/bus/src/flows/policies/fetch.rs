//! Fetches policies: asks the nearest server for what is new, and puts the pieces together.

use std::time::Duration;

use bytes::Bytes;
use tokio::time::Instant;
use treadmill_proto::{PolicyBundle, PolicyPiece, PolicyRequest, PolicyVersion};
use zenoh::{Wait, handlers::FifoChannelHandler, qos::Priority, query::Reply};

use super::pieces;
use crate::{
    error::BusError,
    flows::{
        presence::live_runs,
        shared::{ask, next_valid},
    },
    session::Bus,
};

/// Pieces that a requester asks for at once. The bus has space for them on an idle link, however slow it is.
const WINDOW: usize = 8;
/// Longest wait for the first piece. A router may have to fetch the policy.
const FIRST_TIMEOUT: Duration = Duration::from_secs(5);
/// Longest wait for each further piece. A lost one is asked for again.
const PIECE_TIMEOUT: Duration = Duration::from_secs(3);
/// Pause before a lost piece is asked for again.
const RETRY: Duration = Duration::from_millis(50);

/// Answer to a request for a newer policy.
#[derive(Clone, Debug, PartialEq)]
pub enum FetchedPolicy {
    /// The known version is the newest.
    Unchanged,
    /// A newer policy. It has configuration and model only if the request named another configuration.
    Newer(Box<PolicyBundle>),
}

/// Fetches the newest policy of `run`, or of the first live run that answers, with configuration and model but without the
/// critic. `None` if no answer came; the learner may still be running.
pub async fn fetch_policy(bus: &Bus, run: Option<&str>, timeout: Duration) -> Result<Option<PolicyBundle>, BusError> {
    // The token names the run. A router answers questions to one run, and notices if a learner does not.
    let runs = match run {
        Some(run) => vec![run.to_string()],
        None => live_runs(bus, timeout).await?,
    };
    for run in runs {
        let fetched = fetch_newer_policy(bus, &run, &PolicyRequest::default(), timeout).await?;
        if let Some(FetchedPolicy::Newer(bundle)) = fetched {
            return Ok(Some(*bundle));
        }
    }
    Ok(None)
}

/// Fetches the policy of `run` if it is newer than the one in `request`: from the router that this client dialled, or
/// else from the learner. `None` if no answer came.
pub async fn fetch_newer_policy(
    bus: &Bus,
    run: &str,
    request: &PolicyRequest,
    timeout: Duration,
) -> Result<Option<FetchedPolicy>, BusError> {
    let nodes: Vec<String> = bus.session.info().routers_zid().wait().map(|node| node.to_string()).collect();
    for node in nodes {
        let fetched = fetch_pieces(bus, pieces::key_of(run, &node), request, timeout).await?;
        if fetched.is_some() {
            return Ok(fetched);
        }
    }
    fetch_pieces(bus, pieces::key(run), request, timeout).await
}

/// Fetches all pieces from the server of `key`. `None` if it does not answer in time.
pub(super) async fn fetch_pieces(
    bus: &Bus,
    key: String,
    request: &PolicyRequest,
    timeout: Duration,
) -> Result<Option<FetchedPolicy>, BusError> {
    let deadline = Instant::now() + timeout;
    let mut partial = PartialPolicy::default();
    loop {
        let mut asked = Vec::new();
        let longest_wait = if partial.run.is_empty() { FIRST_TIMEOUT.min(timeout) } else { PIECE_TIMEOUT };
        for offset in partial.missing().take(WINDOW) {
            let request = PolicyRequest { offset: offset as u64, ..*request };
            let what = "asking for the policy";
            asked.push(ask(bus, key.clone(), request.encode(), longest_wait, Priority::DataHigh, what)?);
        }
        let mut is_lost = false;
        for replies in asked {
            match next_piece(&replies, request).await {
                Some(piece) if piece.is_unchanged() => return Ok(Some(FetchedPolicy::Unchanged)),
                Some(piece) => is_lost |= !partial.add(piece),
                None if partial.run.is_empty() => return Ok(None),
                None => is_lost = true,
            }
        }
        if let Some(bundle) = partial.whole() {
            return Ok(decode(&partial, bundle).map(|bundle| FetchedPolicy::Newer(Box::new(bundle))));
        }
        if Instant::now() >= deadline {
            return Ok(None);
        }
        if is_lost {
            tokio::time::sleep(RETRY).await;
        }
    }
}

/// Returns the next piece that is not of a learner which the requester knows as overtaken.
async fn next_piece(replies: &FifoChannelHandler<Reply>, request: &PolicyRequest) -> Option<PolicyPiece> {
    let epoch = [request.known, request.announced].into_iter().flatten().map(|version| version.epoch).max();
    loop {
        let piece = next_valid(replies, "piece of a policy", PolicyPiece::decode).await?;
        if piece.version.epoch == 0 || Some(piece.version.epoch) >= epoch {
            return Some(piece);
        }
    }
}

/// Decodes a complete bundle and compares it with its pieces. Logs why it is rejected.
fn decode(partial: &PartialPolicy, bundle: Bytes) -> Option<PolicyBundle> {
    let run = &partial.run;
    match PolicyBundle::decode(bundle) {
        Ok(bundle) if bundle.run == *run && partial.is_of(bundle.version) => return Some(bundle),
        Ok(_) => tracing::warn!(run, "policy rejected: it is not the one that its pieces name"),
        Err(error) => tracing::warn!(run, %error, "policy rejected"),
    }
    None
}

/// Pieces of a policy so far, in order.
#[derive(Debug, Default)]
struct PartialPolicy {
    run: String,
    version: Option<PolicyVersion>,
    total: usize,
    /// Size of the first piece, which the server chose.
    piece: usize,
    bytes: Vec<u8>,
}

impl PartialPolicy {
    fn is_of(&self, version: PolicyVersion) -> bool {
        self.version.is_some_and(|own| own.names_same_policy(version))
    }

    /// Returns where the missing pieces begin; only the beginning, as long as nothing is there.
    fn missing(&self) -> impl Iterator<Item = usize> + use<> {
        let (start, end) = (self.bytes.len(), self.total.max(1));
        (start..end).step_by(self.piece.max(1))
    }

    /// Appends a piece. Returns whether it was the next one. If the server has a newer version by now, begins again.
    fn add(&mut self, piece: PolicyPiece) -> bool {
        let is_first = self.version.is_none();
        if !is_first && !self.is_of(piece.version) {
            *self = Self { run: piece.run, version: None, ..Self::default() };
            return false;
        }
        let is_next = piece.offset == self.bytes.len() as u64 && !piece.data.is_empty();
        let agrees = is_first || piece.run == self.run && piece.total_bytes == self.total as u64;
        if !is_next || !agrees {
            return false;
        }
        if is_first {
            (self.run, self.version) = (piece.run, Some(piece.version));
            (self.total, self.piece) = (piece.total_bytes as usize, piece.data.len());
        }
        self.bytes.extend_from_slice(&piece.data);
        true
    }

    /// Takes the bundle out once all pieces are there.
    fn whole(&mut self) -> Option<Bytes> {
        let is_whole = self.version.is_some() && self.bytes.len() == self.total;
        is_whole.then(|| std::mem::take(&mut self.bytes).into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const OLD: PolicyVersion = PolicyVersion::new(7, 3);
    const NEW: PolicyVersion = PolicyVersion::new(7, 4);

    fn bundle(length: u32) -> Bytes {
        (0..length).map(|byte| byte as u8).collect::<Vec<_>>().into()
    }

    fn missing(partial: &PartialPolicy) -> Vec<usize> {
        partial.missing().take(WINDOW).collect()
    }

    #[test]
    fn pieces_are_asked_for_in_windows_and_put_together() {
        let (bundle, mut partial) = (bundle(75_000), PartialPolicy::default());
        assert_eq!(missing(&partial), [0]);
        assert!(partial.add(PolicyPiece::cut("walk", OLD, &bundle, 0)));
        assert_eq!((missing(&partial), partial.whole()), (vec![30_000, 60_000], None));
        // The second piece is lost, so the third does not fit.
        assert!(!partial.add(PolicyPiece::cut("walk", OLD, &bundle, 60_000)));
        assert!(partial.add(PolicyPiece::cut("walk", OLD, &bundle, 30_000)));
        assert_eq!(missing(&partial), [60_000]);
        assert!(partial.add(PolicyPiece::cut("walk", OLD, &bundle, 60_000)));
        assert_eq!(partial.whole(), Some(bundle));
    }

    #[test]
    fn a_newer_version_begins_again() {
        let (old, new, mut partial) = (bundle(50_000), bundle(35_000), PartialPolicy::default());
        assert!(partial.add(PolicyPiece::cut("walk", OLD, &old, 0)));
        assert!(!partial.add(PolicyPiece::cut("walk", NEW, &new, 30_000)));
        assert_eq!(missing(&partial), [0]);
        assert!(partial.add(PolicyPiece::cut("walk", NEW, &new, 0)));
        assert!(partial.add(PolicyPiece::cut("walk", NEW, &new, 30_000)));
        assert_eq!((partial.version, partial.whole()), (Some(NEW), Some(new)));
    }

    #[test]
    fn pieces_that_do_not_fit_are_dropped() {
        let (bundle, mut partial) = (bundle(50_000), PartialPolicy::default());
        assert!(!partial.add(PolicyPiece::cut("walk", OLD, &bundle, 30_000)), "not the beginning");
        assert!(!partial.add(PolicyPiece { data: Bytes::new(), ..PolicyPiece::cut("walk", OLD, &bundle, 0) }), "empty");
        assert!(partial.add(PolicyPiece::cut("walk", OLD, &bundle, 0)));
        assert!(!partial.add(PolicyPiece::cut("run", OLD, &bundle, 30_000)), "another run");
        let other_size = PolicyPiece { total_bytes: 49_999, ..PolicyPiece::cut("walk", OLD, &bundle, 30_000) };
        assert!(!partial.add(other_size));
        assert_eq!((missing(&partial), partial.whole()), (vec![30_000], None));
    }
}
