//! One way to ask every part to stop.

use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
};

use tokio::sync::Notify;

/// Shared by whoever asks and whoever must stop; asking twice is asking once.
#[derive(Clone, Debug, Default)]
pub struct Shutdown {
    inner: Arc<Inner>,
}

#[derive(Debug, Default)]
struct Inner {
    asked: AtomicBool,
    bell: Notify,
}

impl Shutdown {
    /// Asks everybody to stop.
    pub fn ask(&self) {
        self.inner.asked.store(true, Ordering::SeqCst);
        self.inner.bell.notify_waiters();
    }

    /// Whether somebody asked.
    pub fn asked(&self) -> bool {
        self.inner.asked.load(Ordering::SeqCst)
    }

    /// Resolves once somebody asked.
    pub async fn wait(&self) {
        loop {
            // Registered before the flag is read, so that a call between the two is not missed.
            let bell = self.inner.bell.notified();
            tokio::pin!(bell);
            bell.as_mut().enable();
            if self.asked() {
                return;
            }
            bell.await;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[tokio::test(flavor = "multi_thread")]
    async fn every_waiter_wakes_also_those_who_come_late() {
        let shutdown = Shutdown::default();
        let early = tokio::spawn({
            let shutdown = shutdown.clone();
            async move { shutdown.wait().await }
        });
        shutdown.ask();
        early.await.unwrap();
        shutdown.wait().await;
        assert!(shutdown.asked());
    }
}
