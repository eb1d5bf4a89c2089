//! Mirror images of positions, velocities, actions and observations, with left and right exchanged.

use nalgebra::Vector3;

use super::Model;

/// For each entry of a mirrored vector, the index and the sign of the original entry that it holds.
pub type SignedPermutation = Vec<(usize, f32)>;

/// Reflection in the plane y = 0 of a model whose hinges come in pairs `left_…` and `right_…` or lie in the plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Mirror {
    /// Reflection of the position vector.
    pub position: SignedPermutation,
    /// Reflection of the velocity vector.
    pub velocity: SignedPermutation,
    /// Reflection of an action.
    pub action: SignedPermutation,
}

impl Mirror {
    /// Returns the reflection of a model. Masses and shapes are not compared.
    ///
    /// # Errors
    /// A message that names the first hinge or motor without a mirror image.
    pub fn of(model: &Model) -> Result<Self, String> {
        let mut hinges = Vec::new();
        for hinge in &model.hinges {
            let name = image_name(&hinge.name);
            // An axis is a pseudo-vector: a reflection inverts its components in the plane and keeps the one across.
            let axis = hinge.axis.component_mul(&Vector3::new(-1.0, 1.0, -1.0));
            let image = model.hinges.iter().position(|other| other.name == name);
            let image = image.filter(|image| model.hinges[*image].axis.dot(&axis).abs() > 1.0 - 1e-9);
            let image = image.ok_or_else(|| format!("hinge `{}` has no mirror image `{name}`", hinge.name))?;
            hinges.push((image, model.hinges[image].axis.dot(&axis).signum() as f32));
        }
        let mut action = Vec::new();
        for motor in &model.motors {
            let (hinge, sign) = hinges[motor.hinge];
            let alike = |gear: f64| (gear.abs() - motor.gear_nm.abs()).abs() < 1e-9;
            let image = model.motors.iter().position(|other| other.hinge == hinge && alike(other.gear_nm));
            let image = image.ok_or_else(|| format!("motor `{}` has no mirror image", motor.name))?;
            action.push((image, sign * (model.motors[image].gear_nm * motor.gear_nm).signum() as f32));
        }
        // Position x, y, z, then quaternion w, x, y, z, whose vector part is a pseudo-vector.
        let root_position = [1.0, -1.0, 1.0, 1.0, -1.0, 1.0, -1.0];
        let root_velocity = [1.0, -1.0, 1.0, -1.0, 1.0, -1.0];
        Ok(Self { position: with_root(&root_position, &hinges), velocity: with_root(&root_velocity, &hinges), action })
    }

    /// Returns the reflection of a [`crate::ObservationKind::Compact`] observation with `size` entries: positions, possibly
    /// without the first ones, then velocities.
    #[must_use]
    pub fn observation(&self, size: usize) -> SignedPermutation {
        let skipped = self.position.len() + self.velocity.len() - size;
        let positions = self.position[skipped..].iter().map(|(at, sign)| (at - skipped, *sign));
        let seen = self.position.len() - skipped;
        positions.chain(self.velocity.iter().map(|(at, sign)| (seen + at, *sign))).collect()
    }
}

fn with_root(root: &[f32], hinges: &[(usize, f32)]) -> SignedPermutation {
    let own = root.iter().copied().enumerate();
    own.chain(hinges.iter().map(|(image, sign)| (root.len() + image, *sign))).collect()
}

/// Returns the name with `left_` and `right_` exchanged.
fn image_name(name: &str) -> String {
    match name.split_once('_') {
        Some(("left", rest)) => format!("right_{rest}"),
        Some(("right", rest)) => format!("left_{rest}"),
        _ => name.to_string(),
    }
}
