//! Replaces port 0 before Zenoh listens.
//!
//! Zenoh does not report which port the system assigned for port 0, and actors need to know it. No upstream issue is known.
//! Delete when a session reports the endpoints it listens on.

use std::net::TcpListener;

use crate::error::BusError;

/// Replaces port 0 of an endpoint with a port that is free now; returns other endpoints unchanged.
pub(crate) fn with_free_port(endpoint: &str) -> Result<String, BusError> {
    let (address, options) = without_options(endpoint);
    let Some(prefix) = address.strip_suffix(":0") else {
        return Ok(endpoint.to_string());
    };
    let host = prefix.split_once('/').map_or(prefix, |(_, host)| host);
    let port = TcpListener::bind(format!("{host}:0"))
        .and_then(|listener| listener.local_addr())
        .map_err(|error| BusError::Endpoint { endpoint: endpoint.to_string(), why: error.to_string() })?
        .port();
    Ok(format!("{prefix}:{port}{options}"))
}

/// Splits Zenoh's options, from `?` or `#` on, off an endpoint.
pub(crate) fn without_options(endpoint: &str) -> (&str, &str) {
    endpoint.split_at(endpoint.find(['?', '#']).unwrap_or(endpoint.len()))
}
