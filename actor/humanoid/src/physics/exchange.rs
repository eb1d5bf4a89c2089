//! What goes to Rapier before a physics step, and what is taken from it afterwards.
//!
//! Rapier's world travels with the robot: its origin is always the point of the floor below the root, so that single
//! precision is as good after a kilometre as at the start.

use nalgebra::{Rotation3, UnitQuaternion, Vector3};

use super::convert::{from_rotation, from_vector, to_rotation, to_vector};
use super::world::World;
use crate::dynamics::{Disturbance, Flight, Momentum, Motion, Posture, Projection, Tree, integrate};

/// Workspace of the exchange.
pub(super) struct Exchange {
    projection: Projection,
    /// Velocities handed to Rapier: straight from the start to the end of the flight.
    sent: Vec<Disturbance>,
    /// Where the flight ends: centre of mass (m) in Rapier's world, and orientation.
    ends: Vec<(Vector3<f64>, UnitQuaternion<f64>)>,
    velocity_changes: Vec<Disturbance>,
    displacements: Vec<Disturbance>,
    change: Vec<f64>,
    velocities: Vec<Motion>,
}

impl Exchange {
    pub(super) fn new(tree: &Tree) -> Self {
        let bodies = tree.nodes.len();
        Self {
            projection: Projection::new(tree),
            sent: vec![Disturbance::default(); bodies],
            ends: vec![(Vector3::zeros(), UnitQuaternion::identity()); bodies],
            velocity_changes: vec![Disturbance::default(); bodies],
            displacements: vec![Disturbance::default(); bodies],
            change: vec![0.0; tree.dofs()],
            velocities: vec![Motion::default(); bodies],
        }
    }

    /// Puts the bodies at the start of the flight, with the velocities that lead to its end.
    pub(super) fn send(&mut self, world: &mut World, position: &[f64], start: &Posture, flight: &Flight, step_s: f64) {
        let start_root = Vector3::new(0.0, 0.0, position[2]);
        let end_root =
            Vector3::new(flight.position[0] - position[0], flight.position[1] - position[1], flight.position[2]);
        for (index, handle) in world.bodies.iter().enumerate() {
            let start_rotation = quaternion(start, index);
            let end_rotation = quaternion(&flight.end, index);
            let end_centre = end_root + flight.end.centres_m[index];
            let sent = Disturbance {
                linear: (end_centre - start_root - start.centres_m[index]) / step_s,
                angular: (end_rotation * start_rotation.inverse()).scaled_axis() / step_s,
            };
            let body = &mut world.rapier.bodies[*handle];
            let pose = rapier3d::math::Pose::from_parts(
                to_vector(&(start_root + start.origins_m[index])),
                to_rotation(&start_rotation),
            );
            body.set_position(pose, false);
            body.set_linvel(to_vector(&sent.linear), false);
            body.set_angvel(to_vector(&sent.angular), false);
            self.sent[index] = sent;
            self.ends[index] = (end_centre, end_rotation);
        }
    }

    /// Takes over what contacts did: the flight's end, changed by it, becomes the state with its posture.
    pub(super) fn receive(
        &mut self,
        tree: &Tree,
        world: &World,
        flight: &Flight,
        position: &mut [f64],
        velocity: &mut [f64],
        posture: &mut Posture,
    ) {
        for (index, handle) in world.bodies.iter().enumerate() {
            let body = &world.rapier.bodies[*handle];
            let (end_centre, end_rotation) = &self.ends[index];
            self.velocity_changes[index] = Disturbance {
                linear: from_vector(body.linvel()) - self.sent[index].linear,
                angular: from_vector(body.angvel()) - self.sent[index].angular,
            };
            let rotation = from_rotation(body.rotation());
            let centre = from_vector(body.translation()) + rotation * tree.nodes[index].centre_m;
            self.displacements[index] =
                Disturbance { linear: centre - end_centre, angular: (rotation * end_rotation.inverse()).scaled_axis() };
        }
        self.projection.project(tree, flight, &self.velocity_changes, &mut self.change);
        for (new, (flown, change)) in velocity.iter_mut().zip(flight.velocity.iter().zip(&self.change)) {
            *new = flown + change;
        }
        self.projection.project(tree, flight, &self.displacements, &mut self.change);
        integrate(&flight.position, &self.change, 1.0, position);
        posture.lay(tree, position);
        posture.weigh(tree);
        // The projection is linear about the middle of the step; the whole body's momentum is made exact.
        posture.velocities(tree, velocity, &mut self.velocities);
        let now = Momentum::of(posture, &self.velocities);
        let wanted = flight.momentum + Projection::momentum(tree, posture, &self.velocity_changes, &now.centre_m);
        now.restore(posture, &wanted, velocity);
    }
}

fn quaternion(posture: &Posture, body: usize) -> UnitQuaternion<f64> {
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(posture.rotations[body]))
}
