//! Settings of the memory allocator.

/// Makes the allocator keep freed memory instead of returning it to the system, in a few arenas.
///
/// A gradient step allocates and frees dozens of tensors of some hundred kilobytes. By default, GNU's allocator asks the system
/// for each, and the system clears the pages. That took a tenth of an update's time on one thread, and more on several.
///
/// Each arena keeps the most that it ever held, and there would be eight per core. The threads of a new term find other arenas
/// than those before: two learners that led in turn grew by 35 MB with each takeover.
pub fn keep_freed() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    {
        const MIB: i32 = 1 << 20;
        const ARENAS: i32 = 4;
        for (parameter, value) in
            [(libc::M_MMAP_THRESHOLD, 32 * MIB), (libc::M_TRIM_THRESHOLD, 256 * MIB), (libc::M_ARENA_MAX, ARENAS)]
        {
            // SAFETY: mallopt takes two numbers and has no preconditions; a refused value changes nothing.
            unsafe { libc::mallopt(parameter, value) };
        }
    }
}
