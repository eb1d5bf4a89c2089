//! A change of the simulation requires another `PHYSICS_VERSION`.

use treadmill_humanoid::config::{GroundConfig, GroundKind, VelocityConfig};
use treadmill_humanoid::{
    EnvConfig, EnvObservation, EnvTask, Environment, EnvironmentConfig, HUMANOID_XML, PHYSICS_VERSION,
    RandomisationConfig,
};

use crate::motion;
use crate::support::{randomised, reset};
use crate::velocity::{CARD, with_card};

/// Control steps of a scene: enough for contacts, too few for rounding errors of other processors to grow.
const STEPS: u32 = 12;
/// Largest relative difference that counts as rounding.
const TOLERANCE: f64 = 1e-4;

/// Version, and the results of [`scenes`] under it. A change of the simulation replaces the results and raises the version.
const GOLDEN: (u32, [[f64; 3]; 7]) = (
    12,
    [
        [419.8150055322105, -941.2645233565358, -953.9224064321461],
        [431.13002421389746, -868.7995418611531, 32300.997049951202],
        [419.3773203936113, -815.6065101351941, 58921.685475538434],
        [431.2218417564549, -1046.5182923722227, 83260.81483881873],
        [438.87380699999846, -866.4511989083557, -768.6207712459145],
        [721.6291548374284, 312.4454068164341, 660.0323257495147],
        [395.0662243589898, 221.11714187078178, 395.14427875164256],
    ],
);

/// The same of a robot that imitates a motion, whose start does not depend on the noise of the reset.
const GOLDEN_MOTION: [f64; 3] = [455.07379672575973, 268.02176603581756, 4379.739671083248];

/// Settings, seed and model.
pub(crate) type Scene = (EnvironmentConfig, u64, String);

fn scenes() -> [Scene; 7] {
    let v4 = EnvironmentConfig::from(EnvConfig {
        task: EnvTask::HumanoidV4,
        observation: EnvObservation::GymnasiumV4,
        ..EnvConfig::default()
    });
    let v5 = EnvironmentConfig::from(EnvConfig { observation: EnvObservation::GymnasiumV5, ..EnvConfig::default() });
    let default = EnvironmentConfig::default();
    // Newton's method solves for the forces of constraints, dry friction among them.
    let by_newton = HUMANOID_XML
        .replace("PGS", "Newton")
        .replace("<joint type=\"hinge\"", "<joint type=\"hinge\" frictionloss=\"1\"");
    assert_ne!(by_newton, HUMANOID_XML);
    let ground =
        GroundConfig { kinds: vec![GroundKind::Stairs], curriculum: false, start_level: 9, ..GroundConfig::default() };
    let velocity = VelocityConfig { height_scan: true, ..VelocityConfig::default() };
    let env = EnvConfig { task: EnvTask::Velocity, ..EnvConfig::default() };
    let walking = EnvironmentConfig { env: env.clone(), velocity, ground, ..EnvironmentConfig::default() };
    // Its gait rests from the fourth observation on, unless it is woken.
    let velocity =
        VelocityConfig { gait_rests: true, gait_rests_after_s: 0.06, standing_share: 1.0, ..VelocityConfig::default() };
    let standing = EnvironmentConfig { env, velocity, ..EnvironmentConfig::default() };
    let humanoid = || HUMANOID_XML.to_owned();
    [
        (default.clone(), 1, humanoid()),
        (v4, 2, humanoid()),
        (v5, 3, humanoid()),
        (randomised(), 4, humanoid()),
        (default, 5, by_newton),
        (walking, 7, with_card(CARD)),
        (standing, 7, with_card(CARD)),
    ]
}

/// Returns weighted sums of positions, of velocities, and of observations and rewards over all steps of a scene.
fn sums((config, seed, text): &Scene) -> [f64; 3] {
    // Different weights, so that an exchange of two numbers changes the sum.
    let sum = |numbers: &mut dyn Iterator<Item = f64>| -> f64 {
        numbers.enumerate().map(|(index, number)| number * (1.0 + (index * 37 % 19) as f64)).sum()
    };
    let mut environment = Environment::new(config, text).expect("valid");
    let mut observation = reset(&mut environment, *seed);
    let (mut sums, mut contact_steps) = ([0.0; 3], 0);
    for step in 0..STEPS {
        let action: Vec<f32> = (0..environment.physics().model().motors.len())
            .map(|motor| 0.4 * ((step * 29 + motor as u32 * 13) as f32).sin())
            .collect();
        let result = environment.step(&action, &mut observation);
        assert!(!result.fault);
        let physics = environment.physics();
        contact_steps += u32::from(physics.squared_contact_wrenches() > 0.0);
        sums[0] += sum(&mut physics.position().iter().copied());
        sums[1] += sum(&mut physics.velocity().iter().copied());
        let end = [result.reward, f32::from(u8::from(result.terminated)), f32::from(u8::from(result.truncated))];
        sums[2] += sum(&mut end.iter().chain(&observation).map(|number| f64::from(*number)));
    }
    assert!(contact_steps > 0, "seed {seed}: no contacts");
    sums
}

fn is_close(found: &[f64; 3], golden: &[f64; 3]) -> bool {
    found.iter().zip(golden).all(|(found, golden)| (found - golden).abs() <= TOLERANCE * (1.0 + golden.abs()))
}

#[test]
fn another_simulation_has_another_version() {
    let found = scenes().map(|scene| sums(&scene));
    let (version, golden) = GOLDEN;
    assert_eq!(version, PHYSICS_VERSION, "replace the golden results together with the version");
    let imitating = sums(&motion::scene());
    assert!(is_close(&imitating, &GOLDEN_MOTION), "the same for the motion task: {imitating:?}");
    assert!(
        found.iter().zip(&golden).all(|(found, golden)| is_close(found, golden)),
        "the simulation has changed: raise PHYSICS_VERSION, and replace the golden results by {found:?}"
    );
}

#[test]
fn rounding_errors_stay_within_the_tolerance() {
    for (config, seed, text) in scenes() {
        // Rounding errors of single precision are of the size of 1e-7, and this moves the start by about as much.
        let moved = EnvironmentConfig {
            env: EnvConfig { reset_noise_scale: config.env.reset_noise_scale + 1e-7, ..config.env.clone() },
            ..config.clone()
        };
        let (before, after) = (sums(&(config, seed, text.clone())), sums(&(moved, seed, text)));
        assert!(before != after && is_close(&after, &before), "{before:?}, {after:?}");
    }
}

#[test]
fn small_changes_of_the_simulation_exceed_the_tolerance() {
    let scene = |config: EnvironmentConfig| (config, 1, HUMANOID_XML.to_owned());
    let before = sums(&scene(EnvironmentConfig::default()));
    assert!(is_close(&before, &before));
    let gravity = RandomisationConfig { gravity_scale: [1.002; 2], ..RandomisationConfig::default() };
    let damping = RandomisationConfig { damping_scale: [1.02; 2], ..RandomisationConfig::default() };
    let changed = [
        EnvironmentConfig::from(EnvConfig { substeps: 3, ..EnvConfig::default() }),
        EnvironmentConfig::from(EnvConfig { healthy_reward: 5.01, ..EnvConfig::default() }),
        EnvironmentConfig { randomisation: gravity, ..EnvironmentConfig::default() },
        EnvironmentConfig { randomisation: damping, ..EnvironmentConfig::default() },
    ];
    for config in changed {
        let after = sums(&scene(config.clone()));
        assert!(!is_close(&after, &before), "{config:?}: {before:?}, {after:?}");
    }
}
