//! Settings of the memory allocator.

/// Makes the allocator keep freed memory instead of returning it to the system.
///
/// A gradient step allocates and frees dozens of tensors of some hundred kilobytes. By default, GNU's allocator asks the system
/// for each, and the system clears the pages. That took a tenth of an update's time on one thread, and more on several.
pub fn keep_freed() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    {
        const MIB: i32 = 1 << 20;
        for (parameter, value) in [(libc::M_MMAP_THRESHOLD, 32 * MIB), (libc::M_TRIM_THRESHOLD, 256 * MIB)] {
            // SAFETY: mallopt takes two numbers and has no preconditions; a refused value changes nothing.
            unsafe { libc::mallopt(parameter, value) };
        }
    }
}
