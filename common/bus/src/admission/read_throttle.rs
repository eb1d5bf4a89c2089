//! A throttle on floods: whoever sends more than anybody honest would is read more slowly, by the bus itself.
//!
//! Callbacks run where a link is read. While one naps, nothing more is read from that link, its sender's buffers fill, and
//! the sender has to wait: what it does not send costs nobody anything. Others go on, because the runtime moves them to
//! another thread before the nap begins.
//!
//! That other thread may then write to the link of whoever naps, and where links are encrypted nobody may read from it at the
//! same time (see `threads`). Hence whatever reads a link gives way after a nap before it reads on: its turn comes again where
//! all other work is done. It gives way because its budget is spent, by which tokio's tasks share their threads
//! ([`tokio::task::coop`]).

use std::{
    cell::Cell,
    pin::pin,
    sync::Mutex,
    task::{Context, Waker},
    time::{Duration, Instant},
};

use tokio::{
    runtime::{Handle, RuntimeFlavor},
    task::{block_in_place, consume_budget, coop::has_budget_remaining},
};

/// One nap. A waking thread disturbs others for far longer than a message costs, so naps are few and long.
const NAP: Duration = Duration::from_millis(25);
/// Naps during one read of a link, which may bring a thousand messages: together much shorter than the silence after which
/// a link is given up, as others behind a router share it.
const NAPS_PER_READ: u32 = 40;

/// Lets so many messages a second pass at full speed.
#[derive(Debug)]
pub(crate) struct ReadThrottle {
    per_s: f64,
    state: Mutex<Option<(f64, Instant)>>,
}

impl ReadThrottle {
    /// So many a second, and as many at once after a silence of a second.
    pub(crate) fn new(per_s: f64) -> Self {
        Self { per_s, state: Mutex::default() }
    }

    /// One message more: naps where they are too many.
    pub(crate) fn pass(&self) {
        if !self.spend(Instant::now()) {
            nap();
        }
    }

    fn spend(&self, now: Instant) -> bool {
        let mut state = self.state.lock().expect("no holder of this lock panics");
        let (left, since) = state.unwrap_or((self.per_s, now));
        let left = (left + now.saturating_duration_since(since).as_secs_f64() * self.per_s).min(self.per_s);
        let enough = left >= 1.0;
        *state = Some((if enough { left - 1.0 } else { left }, now));
        enough
    }
}

/// Whether it napped.
fn nap() -> bool {
    thread_local! {
        static NAPS: Cell<u32> = const { Cell::new(0) };
    }
    // Each time that a task is looked at it has a fresh budget, so a spent one says that this read has seen naps.
    let naps = if has_budget_remaining() { 0 } else { NAPS.get() };
    // In a runtime of one thread a nap would be everybody's. The bus does not use such a one.
    let is_alone = Handle::try_current().is_ok_and(|runtime| runtime.runtime_flavor() == RuntimeFlavor::CurrentThread);
    if naps >= NAPS_PER_READ || is_alone {
        return false;
    }
    block_in_place(|| std::thread::sleep(NAP));
    spend_budget();
    NAPS.set(naps + 1);
    true
}

/// Leaves the task that calls no budget: it gives way as soon as it waits for anything.
fn spend_budget() {
    // Outside of a task there is no budget to be spent, so this must not go on until it is.
    for _ in 0..=u8::MAX {
        if pin!(consume_budget()).poll(&mut Context::from_waker(Waker::noop())).is_pending() {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    };

    use super::*;

    #[test]
    fn what_is_beyond_the_rate_naps() {
        let (throttle, now) = (ReadThrottle::new(100.0), Instant::now());
        let passed = |count, now| (0..count).filter(|_| throttle.spend(now)).count();
        assert_eq!(passed(1000, now), 100);
        assert_eq!(passed(1000, now + Duration::from_millis(500)), 50);
        assert_eq!(passed(1000, now + Duration::from_secs(60)), 100, "a long silence is worth a second");
    }

    fn one_worker() -> tokio::runtime::Runtime {
        tokio::runtime::Builder::new_multi_thread().worker_threads(1).enable_time().build().unwrap()
    }

    #[test]
    fn while_one_naps_others_go_on_and_it_reads_on_only_in_its_turn() {
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
        // As the bus reads a link: whatever can be read is, again and again, or the link is given up.
        let reader = runtime.spawn(async {
            let throttle = ReadThrottle::new(0.0);
            for _ in 0..3 {
                tokio::select! {
                    () = std::future::ready(()) => assert!(has_budget_remaining(), "it was not its turn"),
                    () = std::future::pending() => {}
                }
                throttle.pass();
                assert!(!has_budget_remaining(), "it might read on in a thread that is not the runtime's any more");
            }
        });
        runtime.block_on(reader).unwrap();
        is_over.store(true, Ordering::Relaxed);
        runtime.block_on(others).unwrap();
    }

    #[test]
    fn naps_of_one_read_are_bounded_and_nobody_needs_a_runtime() {
        assert!(nap());
        let taken = one_worker().block_on(async {
            tokio::spawn(async { (0..3 * NAPS_PER_READ).filter(|_| nap()).count() }).await.unwrap()
        });
        assert_eq!(taken, NAPS_PER_READ as usize);
    }
}
