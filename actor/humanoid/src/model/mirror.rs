//! Left and right exchanged: what a mirror makes of a body's numbers.

use nalgebra::Vector3;

use super::Model;

/// For each number of a row, which number stands in its place in the mirror, and with which sign.
pub type Exchange = Vec<(usize, f32)>;

/// A mirror between left and right, the plane y = 0, for a model whose hinges come in pairs `left_…` and `right_…` or lie in
/// the plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Mirror {
    /// Of the position vector.
    pub position: Exchange,
    /// Of the velocity vector.
    pub velocity: Exchange,
    /// Of an action.
    pub action: Exchange,
}

impl Mirror {
    /// The mirror of a model.
    ///
    /// # Errors
    /// In words, which hinge or motor has no image. Masses and shapes are not compared.
    pub fn of(model: &Model) -> Result<Self, String> {
        let mut hinges = Vec::new();
        for hinge in &model.hinges {
            let name = image_name(&hinge.name);
            // An axis is a pseudo-vector: a mirror turns round what lies in it, and leaves what stands across.
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
        // Positions: x, y, z, then a quaternion w, x, y, z; its vector is a pseudo-vector like an axis.
        let root_position = [1.0, -1.0, 1.0, 1.0, -1.0, 1.0, -1.0];
        let root_velocity = [1.0, -1.0, 1.0, -1.0, 1.0, -1.0];
        Ok(Self { position: with_root(&root_position, &hinges), velocity: with_root(&root_velocity, &hinges), action })
    }

    /// Of the observation [`crate::ObservationKind::Compact`] with `size` numbers: positions, of which the first may be left
    /// out, then velocities.
    #[must_use]
    pub fn observation(&self, size: usize) -> Exchange {
        let skipped = self.position.len() + self.velocity.len() - size;
        let positions = self.position[skipped..].iter().map(|(at, sign)| (at - skipped, *sign));
        let seen = self.position.len() - skipped;
        positions.chain(self.velocity.iter().map(|(at, sign)| (seen + at, *sign))).collect()
    }
}

fn with_root(root: &[f32], hinges: &[(usize, f32)]) -> Exchange {
    let own = root.iter().copied().enumerate();
    own.chain(hinges.iter().map(|(image, sign)| (root.len() + image, *sign))).collect()
}

/// The other side's name.
fn image_name(name: &str) -> String {
    match name.split_once('_') {
        Some(("left", rest)) => format!("right_{rest}"),
        Some(("right", rest)) => format!("left_{rest}"),
        _ => name.to_string(),
    }
}
