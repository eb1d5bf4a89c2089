//! Page of a process whose part of a training is to be linked to others: an actor, an evaluator or a router.

use std::sync::{Mutex, PoisonError};

use treadmill_bus::Bus;
use treadmill_learner::metrics::{PrometheusMetrics, prometheus::PageFormat};

use super::metrics_page::PageContent;

/// Content of the page.
#[derive(Default)]
pub struct LinkPage {
    run: String,
    /// Endpoints that it dials. Without any it is healthy alone.
    connect: Vec<String>,
    /// Newest session; `None` while the first one is dialled.
    bus: Mutex<Option<Bus>>,
}

impl LinkPage {
    /// Returns the page of a router with this session.
    pub fn of(bus: &Bus, connect: &[String]) -> Self {
        let page = Self::dialling("", connect);
        page.set(bus);
        page
    }

    /// Returns the page of a process that dials these endpoints for a run.
    pub fn dialling(run: &str, connect: &[String]) -> Self {
        Self { run: run.to_string(), connect: connect.to_vec(), bus: Mutex::default() }
    }

    /// Sets the newest session.
    pub fn set(&self, bus: &Bus) {
        *self.bus.lock().unwrap_or_else(PoisonError::into_inner) = Some(bus.clone());
    }
}

impl PageContent for LinkPage {
    fn metrics(&self, format: PageFormat) -> String {
        PrometheusMetrics::default().page(&self.run, &[], format)
    }

    fn liveness(&self) -> Result<(), String> {
        Ok(())
    }

    fn health(&self) -> Result<(), String> {
        let bus = self.bus.lock().unwrap_or_else(PoisonError::into_inner);
        if self.connect.is_empty() || bus.as_ref().is_some_and(Bus::is_linked) {
            return Ok(());
        }
        Err(format!("no link to {}", self.connect.join(", ")))
    }
}
