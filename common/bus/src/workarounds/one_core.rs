//! A router whose links are encrypted works on one core.
//!
//! The bus's TLS lets two threads use one connection without a lock (eclipse-zenoh/zenoh#2557). Where both run at the same
//! time links break off, or stand still until they are given up, several times a minute while actors come and go. Other parts
//! read and write with one thread (see `common/src/bus/threads.rs`); a router cannot, but its threads can take turns: on one
//! core, and as a batch job, whose threads are not interrupted whenever another one wakes up.

/// Keeps this thread, and those that it will start, to one of the cores that it may use, without interrupting each other.
pub fn keep_to_one_core() {
    #[cfg(target_os = "linux")]
    if let Err(why) = linux::keep_to_one_core() {
        tracing::info!("the router works on all cores, where encrypted links may break off now and then: {why}");
    }
}

#[cfg(target_os = "linux")]
mod linux {
    use std::{io, mem, process};

    pub(super) fn keep_to_one_core() -> io::Result<()> {
        // SAFETY: an empty set of cores is all zeros.
        let (mut allowed, mut one): (libc::cpu_set_t, libc::cpu_set_t) = unsafe { (mem::zeroed(), mem::zeroed()) };
        let size = mem::size_of::<libc::cpu_set_t>();
        // SAFETY: the set is as large as is said, and lives until the call is over.
        succeeded(unsafe { libc::sched_getaffinity(0, size, &mut allowed) })?;
        // SAFETY: the numbers are below the size of the set.
        let cores = (0..libc::CPU_SETSIZE as usize).filter(|core| unsafe { libc::CPU_ISSET(*core, &allowed) });
        let cores: Vec<usize> = cores.collect();
        // Several routers on one machine should not all have the same one.
        let Some(core) = cores.get(process::id() as usize % cores.len().max(1)) else { return Ok(()) };
        let priority = libc::sched_param { sched_priority: 0 };
        // SAFETY: as above; a batch job has priority 0.
        unsafe {
            libc::CPU_SET(*core, &mut one);
            succeeded(libc::sched_setaffinity(0, size, &one))?;
            succeeded(libc::sched_setscheduler(0, libc::SCHED_BATCH, &priority))
        }
    }

    fn succeeded(outcome: libc::c_int) -> io::Result<()> {
        if outcome == 0 { Ok(()) } else { Err(io::Error::last_os_error()) }
    }
}
