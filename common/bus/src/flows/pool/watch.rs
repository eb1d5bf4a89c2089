//! What the runs of a bus want of a pool.

use std::{
    collections::BTreeMap,
    sync::{Arc, Mutex, PoisonError},
    time::Instant,
};

use treadmill_proto::{PoolDemand, limits::SMALL_BYTES_MAX, pool::DEMAND_LASTS};
use zenoh::{Wait, pubsub::Subscriber, sample::Sample};

use super::{RUNS_MAX, demand_key};
use crate::{error::BusError, session::Bus};

type Demands = BTreeMap<String, (PoolDemand, Instant)>;

/// Demands of all runs, as their learners publish them.
pub struct PoolWatch {
    demands: Arc<Mutex<Demands>>,
    _subscriber: Subscriber<()>,
}

impl PoolWatch {
    /// Subscribes to the demands.
    ///
    /// # Errors
    /// If the bus fails.
    pub fn open(bus: &Bus) -> Result<Self, BusError> {
        let demands = Arc::<Mutex<Demands>>::default();
        let heard = Arc::clone(&demands);
        let subscriber = bus
            .session
            .declare_subscriber(demand_key("*"))
            .callback(move |sample: Sample| {
                if sample.payload().len() > SMALL_BYTES_MAX {
                    return;
                }
                let Ok(demand) = PoolDemand::decode_checked(&sample.payload().to_bytes()) else { return };
                if sample.key_expr().as_str() != demand_key(&demand.run) {
                    return;
                }
                let (mut heard, now) = (heard.lock().unwrap_or_else(PoisonError::into_inner), Instant::now());
                heard.retain(|_, (_, at)| now.duration_since(*at) < DEMAND_LASTS);
                if heard.len() < RUNS_MAX || heard.contains_key(&demand.run) {
                    heard.insert(demand.run.clone(), (demand, now));
                }
            })
            .wait()
            .map_err(BusError::flow("listening to the demands of runs"))?;
        Ok(Self { demands, _subscriber: subscriber })
    }

    /// Returns the demands of the runs that were heard lately.
    #[must_use]
    pub fn demands(&self) -> Vec<PoolDemand> {
        let demands = self.demands.lock().unwrap_or_else(PoisonError::into_inner);
        demands.values().filter(|(_, at)| at.elapsed() < DEMAND_LASTS).map(|(demand, _)| demand.clone()).collect()
    }
}
