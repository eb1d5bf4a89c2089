//! Throttle on floods: reads a link more slowly while it brings more messages than an honest peer sends.
//!
//! Callbacks run on the thread that reads a link. While a callback sleeps, nothing is read from that link, the sender's
//! buffers fill, and the sender must wait. Other links continue, because the runtime first moves them to another thread.

use std::{
    cell::Cell,
    sync::Mutex,
    time::{Duration, Instant},
};

use tokio::{
    runtime::{Handle, RuntimeFlavor},
    task::{block_in_place, coop::has_budget_remaining},
};

use super::Budget;
use crate::workarounds::yield_read::yield_read;

/// One pause. Waking a thread disturbs the others for far longer than a message costs, so pauses are few and long.
const PAUSE: Duration = Duration::from_millis(25);
/// Pauses during one read of a link, which may bring a thousand messages. Together they are much shorter than the lease of a
/// link, because others behind a router share it.
const PAUSES_PER_READ: u32 = 40;

/// Allows a number of messages per second, then pauses after each.
#[derive(Debug)]
pub(crate) struct ReadThrottle {
    per_s: f64,
    budget: Mutex<Budget>,
}

impl ReadThrottle {
    /// Allows `per_s` messages per second, and as many at once after a silence of a second.
    pub(crate) fn new(per_s: f64) -> Self {
        Self { per_s, budget: Mutex::default() }
    }

    /// Counts one message; pauses if the budget is spent.
    pub(crate) fn pass(&self) {
        if !self.spend(Instant::now()) {
            pause();
        }
    }

    fn spend(&self, now: Instant) -> bool {
        self.budget.lock().expect("no holder of this lock panics").spend(1.0, self.per_s, self.per_s, now)
    }
}

/// Pauses this thread, at most [`PAUSES_PER_READ`] times per read. Returns whether it paused.
fn pause() -> bool {
    thread_local! {
        static PAUSES: Cell<u32> = const { Cell::new(0) };
    }
    // Each poll of a task begins with a fresh budget, so a spent one means that this read has paused before.
    let pauses = if has_budget_remaining() { 0 } else { PAUSES.get() };
    // In a single-threaded runtime a pause would stop all links. Zenoh does not use one.
    let is_alone = Handle::try_current().is_ok_and(|runtime| runtime.runtime_flavor() == RuntimeFlavor::CurrentThread);
    if pauses >= PAUSES_PER_READ || is_alone {
        return false;
    }
    block_in_place(|| std::thread::sleep(PAUSE));
    yield_read();
    PAUSES.set(pauses + 1);
    true
}

#[cfg(test)]
mod tests {
    use std::sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    };

    use super::*;

    #[test]
    fn messages_beyond_the_rate_exceed_the_budget() {
        let (throttle, now) = (ReadThrottle::new(100.0), Instant::now());
        let passed = |count, now| (0..count).filter(|_| throttle.spend(now)).count();
        assert_eq!(passed(1000, now), 100);
        assert_eq!(passed(1000, now + Duration::from_millis(500)), 50);
        assert_eq!(passed(1000, now + Duration::from_secs(60)), 100, "a long silence earns one second's budget");
    }

    fn one_worker() -> tokio::runtime::Runtime {
        tokio::runtime::Builder::new_multi_thread().worker_threads(1).enable_time().build().unwrap()
    }

    #[test]
    fn other_tasks_run_during_a_pause_and_the_reader_yields_after_it() {
        let runtime = one_worker();
        let is_over = Arc::new(AtomicBool::new(false));
        let others = runtime.spawn({
            let is_over = is_over.clone();
            async move {
                while !is_over.load(Ordering::Relaxed) {
                    tokio::task::yield_now().await;
                }
            }
        });
        // Reads like Zenoh: whatever is ready, again and again, until the lease expires.
        let reader = runtime.spawn(async {
            let throttle = ReadThrottle::new(0.0);
            for _ in 0..3 {
                tokio::select! {
                    () = std::future::ready(()) => assert!(has_budget_remaining(), "it read before its turn"),
                    () = std::future::pending() => {}
                }
                throttle.pass();
                assert!(!has_budget_remaining(), "it could read on in a thread that left the runtime");
            }
        });
        runtime.block_on(reader).unwrap();
        is_over.store(true, Ordering::Relaxed);
        runtime.block_on(others).unwrap();
    }

    #[test]
    fn pauses_of_one_read_are_bounded_and_need_no_runtime() {
        assert!(pause());
        let pauses = one_worker().block_on(async {
            tokio::spawn(async { (0..3 * PAUSES_PER_READ).filter(|_| pause()).count() }).await.unwrap()
        });
        assert_eq!(pauses, PAUSES_PER_READ as usize);
    }
}
