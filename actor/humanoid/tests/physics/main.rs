//! Motion of the humanoid, of small bodies with a closed form, and of other models.

mod batch;
mod body;
mod boxes;
mod coordinates;
mod dynamics;
mod equalities;
mod ground;
mod hinge;
mod invariance;
mod joints;
mod model_motion;
mod places;
mod rest;
mod rolling;
mod variation;

use treadmill_humanoid::{EnvConfig, HUMANOID_XML, Model, Physics};

/// Control step of the default settings (s).
const CONTROL_STEP_S: f64 = 0.015;

/// Hinge and motor that every model needs, with a link of negligible mass.
const SPARE_HINGE: &str = r#"<body><joint name="spare" damping="0.01"/>
    <inertial pos="0 0 0" mass="1e-6" diaginertia="1e-9 1e-9 1e-9"/></body>"#;
const SPARE_MOTOR: &str = r#"<actuator><motor joint="spare"/></actuator>"#;

const WEIGHTLESS: (&str, &str) = ("<option ", "<option gravity=\"0 0 0\" ");
/// Controls of the humanoid, and its velocity vector, at rest.
const IDLE: [f32; 17] = [0.0; 17];
const STILL: [f64; 23] = [0.0; 23];

/// Physics of a text with the default settings.
fn simulation(text: &str) -> Physics {
    with_settings(text, &EnvConfig::default())
}

fn with_settings(text: &str, settings: &EnvConfig) -> Physics {
    Physics::new(Model::from_mjcf(text).expect("valid"), settings).expect("valid")
}

fn with_substeps(text: &str, substeps: u32) -> Physics {
    with_settings(text, &EnvConfig { substeps, ..EnvConfig::default() })
}

/// Returns the text of the built-in humanoid with all changes applied; each must match.
fn humanoid_text(changes: &[(&str, &str)]) -> String {
    changes.iter().fold(HUMANOID_XML.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "{from}");
        text.replace(from, to)
    })
}

/// Simulates control steps with the same controls.
fn advance(physics: &mut Physics, steps: u32, controls: &[f32]) {
    for _ in 0..steps {
        physics.step_only(controls).expect("finite");
    }
}

/// Sum of all contact forces on all links along z (N), means over the last control step.
fn lift_n(physics: &Physics) -> f64 {
    (0..physics.model().links.len()).map(|link| physics.contact_wrench(link).0.z).sum()
}
