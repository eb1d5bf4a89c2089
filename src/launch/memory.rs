//! Settings of the memory allocator.

/// Keeps what is freed for the next allocation instead of giving it back to the system.
///
/// A gradient step takes and frees tensors of some hundred kilobytes, dozens of times. GNU's allocator asks the system for
/// each of them until it has seen larger ones go, and the system hands out cleared pages: on one thread a tenth of an
/// update's time, and more on several, because the calls are not spread over them.
pub fn keep_freed() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    {
        const MIB: i32 = 1 << 20;
        for (parameter, value) in [(libc::M_MMAP_THRESHOLD, 32 * MIB), (libc::M_TRIM_THRESHOLD, 256 * MIB)] {
            // SAFETY: mallopt takes two numbers and has no preconditions; a value that it refuses changes nothing.
            unsafe { libc::mallopt(parameter, value) };
        }
    }
}
