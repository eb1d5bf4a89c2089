//! Reference: what is compared, and where it is at each control step.

use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError, Weak};

use nalgebra::{Isometry3, Vector3};

use super::links::Compared;
use crate::config::{EnvironmentConfig, MotionConfig};
use crate::error::ModelError;
use crate::model::Model;
use crate::motion::SampledMotion;
use crate::physics::{LinkMotion, Physics};

/// Most control steps of all motions: they are kept in memory.
const STEPS_MAX: f64 = 400_000.0;

/// Pose and velocities of a link, in single precision: a motion of 20 minutes has 60,000 control steps.
#[derive(Clone, Copy, Debug)]
struct Row {
    pose: Isometry3<f32>,
    linear_mps: Vector3<f32>,
    angular_radps: Vector3<f32>,
}

/// Motions of a robot, control step by control step.
pub(super) struct Reference {
    /// Links that are compared.
    pub compared: Compared,
    /// Control steps of each motion.
    pub motions: Vec<Range<usize>>,
    /// Position and velocity vector of each control step.
    pub positions: Vec<Vec<f64>>,
    pub velocities: Vec<Vec<f64>>,
    /// Of each control step, the anchor and then the compared links.
    rows: Vec<Row>,
    /// What it was built from.
    model: Model,
    config: MotionConfig,
    step_s: f64,
}

/// The last reference: environments of a process share it.
static SHARED: Mutex<Weak<Reference>> = Mutex::new(Weak::new());

impl Reference {
    /// Returns the reference of a model's motions, which environments with the same settings share.
    ///
    /// # Errors
    /// [`ModelError`] if there is no motion, or a link does not exist.
    pub fn shared(config: &EnvironmentConfig, physics: &Physics) -> Result<Arc<Self>, ModelError> {
        let step_s = config.env.control_step_s;
        let mut shared = SHARED.lock().unwrap_or_else(PoisonError::into_inner);
        let is_same =
            |known: &Self| known.step_s == step_s && known.config == config.motion && known.model == *physics.model();
        if let Some(known) = shared.upgrade().filter(|known| is_same(known)) {
            return Ok(known);
        }
        let new = Arc::new(Self::new(config, physics)?);
        *shared = Arc::downgrade(&new);
        Ok(new)
    }

    fn new(config: &EnvironmentConfig, physics: &Physics) -> Result<Self, ModelError> {
        let model = physics.model().clone();
        if model.motions.is_empty() {
            return Err(ModelError::Task("the motion task needs a motion; give one: --motion FILE".to_owned()));
        }
        let compared = Compared::of(&config.motion, physics)?;
        let step_s = config.env.control_step_s;
        // Contacts and torques do not count, only where bodies are.
        let mut pose = Physics::new(model.clone(), config)?;
        let mut reference = Self {
            compared,
            motions: Vec::new(),
            positions: Vec::new(),
            velocities: Vec::new(),
            rows: Vec::new(),
            config: config.motion.clone(),
            step_s,
            model,
        };
        let steps: f64 = reference.model.motions.iter().map(|motion| motion.duration_s() / step_s + 1.0).sum();
        if steps > STEPS_MAX {
            return Err(ModelError::Motion(format!(
                "the motions have {steps:.0} control steps; allowed: {STEPS_MAX:.0}, so give fewer, or a longer \
                 env.control_step_s"
            )));
        }
        for motion in reference.model.motions.clone().iter() {
            let start = reference.positions.len();
            let sampled = SampledMotion::new(motion, step_s);
            for (position, velocity) in sampled.positions.iter().zip(&sampled.velocities) {
                pose.set_state(position, velocity);
                let row = |link: usize| {
                    let LinkMotion { pose, linear_mps, angular_radps } = pose.link_motion(link);
                    Row { pose: pose.cast(), linear_mps: linear_mps.cast(), angular_radps: angular_radps.cast() }
                };
                let Compared { anchor, links, .. } = &reference.compared;
                reference.rows.extend(std::iter::once(anchor).chain(links).map(|link| row(*link)));
            }
            reference.positions.extend(sampled.positions);
            reference.velocities.extend(sampled.velocities);
            if reference.positions.len() - start < 2 {
                return Err(ModelError::Motion(format!(
                    "`{}` lasts {:.3} s, less than a control step of {step_s} s",
                    motion.name,
                    motion.duration_s()
                )));
            }
            reference.motions.push(start..reference.positions.len());
        }
        Ok(reference)
    }

    /// Returns the anchor at a control step.
    pub fn anchor(&self, step: usize) -> LinkMotion {
        self.row(step * (self.compared.links.len() + 1))
    }

    /// Returns the compared links at a control step.
    pub fn links(&self, step: usize) -> impl Iterator<Item = LinkMotion> {
        let first = step * (self.compared.links.len() + 1) + 1;
        (first..first + self.compared.links.len()).map(|row| self.row(row))
    }

    fn row(&self, row: usize) -> LinkMotion {
        let Row { pose, linear_mps, angular_radps } = self.rows[row];
        LinkMotion { pose: pose.cast(), linear_mps: linear_mps.cast(), angular_radps: angular_radps.cast() }
    }

    /// Returns the duration of a control step (s).
    pub fn step_s(&self) -> f64 {
        self.step_s
    }

    /// Moves angles into the ranges of their hinges.
    pub fn clamp_to_ranges(&self, angles_rad: &mut [f64]) {
        for (angle, hinge) in angles_rad.iter_mut().zip(&self.model.hinges) {
            *angle = angle.clamp(hinge.min_rad, hinge.max_rad);
        }
    }

    /// Returns the motion of a control step.
    pub fn motion_of(&self, step: usize) -> &Range<usize> {
        let found = self.motions.iter().find(|motion| motion.contains(&step));
        found.unwrap_or(&self.motions[0])
    }
}
