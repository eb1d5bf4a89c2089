//! Page of a process whose part of a training is to be linked to others: an actor, an evaluator or a router.

use std::sync::{Mutex, PoisonError};

use treadmill_bus::{Bus, BusError, learner::PoolWatch};
use treadmill_learner::metrics::{PrometheusMetrics, prometheus::PageFormat};
use treadmill_proto::PoolDemand;

use super::metrics_page::PageContent;

/// Content of the page.
#[derive(Default)]
pub struct LinkPage {
    run: String,
    /// Endpoints that it dials. Without any it is healthy alone.
    connect: Vec<String>,
    /// What the runs of a router want of a pool.
    pool: Option<PoolWatch>,
    /// Newest session; `None` while the first one is dialled.
    bus: Mutex<Option<Bus>>,
}

impl LinkPage {
    /// Returns the page of a router with this session.
    ///
    /// # Errors
    /// If the bus fails.
    pub fn of(bus: &Bus, connect: &[String]) -> Result<Self, BusError> {
        let page = Self { pool: Some(PoolWatch::open(bus)?), ..Self::dialling("", connect) };
        page.set(bus);
        Ok(page)
    }

    /// Returns the page of a process that dials these endpoints for a run.
    pub fn dialling(run: &str, connect: &[String]) -> Self {
        Self { run: run.to_string(), connect: connect.to_vec(), ..Self::default() }
    }

    /// Sets the newest session.
    pub fn set(&self, bus: &Bus) {
        *self.bus.lock().unwrap_or_else(PoisonError::into_inner) = Some(bus.clone());
    }
}

impl PageContent for LinkPage {
    fn metrics(&self, format: PageFormat) -> String {
        let demands = self.pool.as_ref().map(PoolWatch::demands);
        let sum = |of: fn(&PoolDemand) -> u32| demands.iter().flatten().map(|demand| f64::from(of(demand))).sum();
        let pool = [("pool/envs_wanted", sum(PoolDemand::envs_wanted)), ("pool/envs", sum(|demand| demand.envs))];
        let shown = if demands.is_some() { &pool[..] } else { &[] };
        PrometheusMetrics::default().page(&self.run, shown, format)
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
