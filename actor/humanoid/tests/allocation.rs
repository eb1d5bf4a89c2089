//! What happens at every step without asking for memory.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use treadmill_humanoid::{Environment, EnvironmentConfig, HUMANOID_XML, InfoValue, ObservationKind, Task};

thread_local! {
    static REQUESTS: Cell<u64> = const { Cell::new(0) };
}

/// The system's allocator, counting what each thread asks for.
struct Counting;

// SAFETY: every call is passed on to the system's allocator as it came.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let _ = REQUESTS.try_with(|requests| requests.set(requests.get() + 1));
        // SAFETY: the caller keeps the contract of `alloc`.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the pointer came from `alloc` above, that is from the system.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

#[test]
fn observing_and_telling_allocate_nothing() {
    let config = EnvironmentConfig { observation: ObservationKind::GymnasiumV4, ..EnvironmentConfig::default() };
    let mut environment = Environment::new(&config, HUMANOID_XML).expect("valid");
    let before_buffer = REQUESTS.get();
    let mut observation = vec![0.0; environment.observation_size()];
    assert!(REQUESTS.get() > before_buffer, "requests are counted");
    environment.reset(1, &mut observation);
    environment.step(&[0.1; 17], &mut observation);
    let before = REQUESTS.get();
    environment.observe(&mut observation).expect("the length is right");
    let mut sum = 0.0;
    for task in [Task::HumanoidV5, Task::HumanoidV4] {
        for (_, value) in environment.info().entries(task) {
            sum += match value {
                InfoValue::Number(number) => number,
                InfoValue::Numbers(numbers) => numbers.iter().sum(),
            };
        }
    }
    assert_eq!(REQUESTS.get(), before);
    assert!(sum.is_finite() && sum != 0.0);
}
