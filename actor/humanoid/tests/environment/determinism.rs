//! The same seed and actions give the same episode bit for bit, on any thread, in any process, after any other episode.

use std::{env, fs, path::Path, process::Command, thread};

use treadmill_humanoid::{EnvConfig, EnvObservation, Environment, EnvironmentConfig};

use crate::support;

const STEPS: u32 = 500;
/// File to which the child process of a test writes its checksum.
const CHECKSUM_FILE: &str = "TREADMILL_TEST_CHECKSUM_FILE";

fn environment() -> Environment {
    support::environment(&EnvironmentConfig::from(EnvConfig {
        observation: EnvObservation::GymnasiumV5,
        terminate_when_unhealthy: false,
        ..EnvConfig::default()
    }))
}

/// Episode that falls and flails on the floor, one step at a time.
struct Episode {
    environment: Environment,
    observation: Vec<f32>,
    steps: u32,
    contact_steps: u32,
    checksum: u64,
}

impl Episode {
    fn begin(mut environment: Environment, seed: u64) -> Self {
        let observation = support::reset(&mut environment, seed);
        let mut episode =
            Self { environment, observation, steps: 0, contact_steps: 0, checksum: 0xcbf2_9ce4_8422_2325 };
        episode.add(0.0);
        episode
    }

    fn step(&mut self) {
        let action: [f32; 17] = std::array::from_fn(|motor| 0.4 * ((self.steps * 29 + motor as u32 * 13) as f32).sin());
        let step = self.environment.step(&action, &mut self.observation);
        assert!(!step.fault);
        self.steps += 1;
        self.contact_steps += u32::from(self.environment.physics().squared_contact_wrenches() > 0.0);
        self.add(step.reward);
    }

    /// Updates the FNV-1a hash, over numbers instead of bytes.
    fn add(&mut self, reward: f32) {
        for number in self.observation.iter().chain([&reward]) {
            self.checksum = (self.checksum ^ u64::from(number.to_bits())).wrapping_mul(0x0100_0000_01b3);
        }
    }

    fn checksum(mut self) -> u64 {
        while self.steps < STEPS {
            self.step();
        }
        assert!(self.contact_steps > STEPS / 2, "too few steps with contacts");
        self.checksum
    }
}

fn checksum() -> u64 {
    Episode::begin(environment(), 21).checksum()
}

#[test]
fn after_another_episode_and_between_other_environments() {
    let wanted = checksum();
    assert_ne!(wanted, Episode::begin(environment(), 22).checksum(), "the checksum must depend on the episode");

    let mut used = Episode::begin(environment(), 3);
    (0..90).for_each(|_| used.step());
    assert_eq!(wanted, Episode::begin(used.environment, 21).checksum());

    let mut episodes = [21, 4, 21, 5].map(|seed| Episode::begin(environment(), seed));
    for step in 0..STEPS as usize {
        // The environments advance in turn, some ahead of others.
        episodes[step % 2].step();
        episodes[3 - step % 2].step();
        if step % 3 == 0 {
            episodes[1].step();
        }
    }
    let [first, _, second, _] = episodes;
    assert_eq!([wanted; 2], [first.checksum(), second.checksum()]);
}

#[test]
fn on_other_threads() {
    let wanted = checksum();
    thread::scope(|scope| {
        let runs = [(); 2].map(|()| scope.spawn(checksum));
        for run in runs {
            assert_eq!(wanted, run.join().expect("no panic"));
        }
    });
    // An environment may move to another thread in the middle of an episode.
    let mut begun = Episode::begin(environment(), 21);
    (0..200).for_each(|_| begun.step());
    assert_eq!(wanted, thread::spawn(move || begun.checksum()).join().expect("no panic"));
}

#[test]
fn in_another_process() {
    if let Ok(file) = env::var(CHECKSUM_FILE) {
        fs::write(file, checksum().to_string()).expect("the folder exists");
        return;
    }
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("checksum-{}", std::process::id()));
    let status = Command::new(env::current_exe().expect("the path of this test"))
        .args(["--exact", "determinism::in_another_process", "--test-threads", "1", "--quiet"])
        .env(CHECKSUM_FILE, &file)
        .status()
        .expect("the child process starts");
    assert!(status.success());
    let found = fs::read_to_string(&file).expect("the child process wrote it");
    fs::remove_file(&file).expect("the file exists");
    assert_eq!(found, checksum().to_string());
}
