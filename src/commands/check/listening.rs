//! Whether a learner could listen where it is to.

use treadmill_bus::{BusError, endpoint};

use super::finding::Finding;

const NAME: &str = "listen";

/// Of one endpoint.
pub fn diagnose(given: &str, insecure: bool) -> Finding {
    let free = endpoint::check(given, insecure).and_then(|()| endpoint::check_free(given));
    match free {
        Ok(()) => Finding::ok(NAME, format!("{given} is free")),
        Err(why @ BusError::Listen { .. }) => Finding::problem(
            NAME,
            why.to_string(),
            "see who has it (ss -ltnp), end that, or choose another address or port by --listen",
        ),
        Err(why) => {
            Finding::problem(NAME, why.to_string(), "write tcp/127.0.0.1:PORT, or tls/HOST:PORT with --tls DIR")
        }
    }
}
