//! Runs a router with encrypted links on one core.
//!
//! Zenoh lets two threads use one TLS connection without a lock (eclipse-zenoh/zenoh#2557). If both run at the same time,
//! links break or stall several times a minute while actors come and go. Other roles read and write on one thread
//! ([`super::threads`]). A router cannot, but its threads can take turns: on one core, scheduled as a batch job, so that a
//! waking thread does not preempt another.
//!
//! Delete when Zenoh locks the connection, and the dependency on `libc` with it.

/// Restricts this thread, and all threads it starts later, to one of its allowed cores, without preemption among them.
pub fn keep_to_one_core() {
    #[cfg(target_os = "linux")]
    if let Err(error) = linux::keep_to_one_core() {
        tracing::info!(%error, "the router runs on all cores; encrypted links may break now and then");
    }
}

#[cfg(target_os = "linux")]
mod linux {
    use std::{io, mem, process};

    pub(super) fn keep_to_one_core() -> io::Result<()> {
        // SAFETY: an empty set of cores is all zeros.
        let (mut allowed, mut one): (libc::cpu_set_t, libc::cpu_set_t) = unsafe { (mem::zeroed(), mem::zeroed()) };
        let size = mem::size_of::<libc::cpu_set_t>();
        // SAFETY: the set has the size that is passed, and lives until the call returns.
        succeeded(unsafe { libc::sched_getaffinity(0, size, &mut allowed) })?;
        // SAFETY: the numbers are below the size of the set.
        let cores = (0..libc::CPU_SETSIZE as usize).filter(|core| unsafe { libc::CPU_ISSET(*core, &allowed) });
        let cores: Vec<usize> = cores.collect();
        // The process id spreads several routers on one machine over its cores.
        let Some(core) = cores.get(process::id() as usize % cores.len().max(1)) else { return Ok(()) };
        let priority = libc::sched_param { sched_priority: 0 };
        // SAFETY: as above; a batch job has priority 0.
        unsafe {
            libc::CPU_SET(*core, &mut one);
            succeeded(libc::sched_setaffinity(0, size, &one))?;
            succeeded(libc::sched_setscheduler(0, libc::SCHED_BATCH, &priority))
        }
    }

    fn succeeded(status: libc::c_int) -> io::Result<()> {
        if status == 0 { Ok(()) } else { Err(io::Error::last_os_error()) }
    }
}
