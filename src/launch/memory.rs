//! Settings of the memory allocator.

/// Makes the allocator use one arena.
///
/// Each arena of GNU's allocator keeps the most that it ever held, and by default there are eight per core. Dozens of
/// threads find ever other ones: actors and routers kept growing, and two learners that led in turn by 35 MB with each
/// takeover. Training is as fast with one, because each thread has a cache of small pieces.
pub fn use_one_arena() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    set(libc::M_ARENA_MAX, 1);
}

/// Makes the allocator keep freed memory instead of returning it to the system, in one arena.
///
/// A gradient step allocates and frees dozens of tensors of some hundred kilobytes. By default, GNU's allocator asks
/// the system for each, and the system clears the pages. That took a tenth of an update's time on one thread, and more
/// on several.
pub fn keep_freed() {
    use_one_arena();
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    for (parameter, mebibytes) in [(libc::M_MMAP_THRESHOLD, 32), (libc::M_TRIM_THRESHOLD, 256)] {
        set(parameter, mebibytes << 20);
    }
}

#[cfg(all(target_os = "linux", target_env = "gnu"))]
fn set(parameter: i32, value: i32) {
    // SAFETY: mallopt takes two numbers and has no preconditions; a refused value changes nothing.
    unsafe { libc::mallopt(parameter, value) };
}
