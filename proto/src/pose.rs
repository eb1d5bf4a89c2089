//! Poses of an actor's body, for observers.

use prost::Message;

use crate::{Malformed, check_size, ident::check_ident, limits::POSE_BYTES_MAX, planes::check_finite, version, wire};

pub use wire::Pose;

/// Numbers of one body in [`Pose::bodies`]: a position and a unit quaternion.
pub const BODY_NUMBERS: usize = 7;
/// Numbers of one contact in [`Pose::contacts`]: a position and a force.
pub const CONTACT_NUMBERS: usize = 6;
/// Numbers of [`Pose::command`], [`Pose::base_velocity`] and [`Pose::centre_of_mass_m`], if there are any.
pub const VECTOR_NUMBERS: usize = 3;
/// Longest episode (s), more than eleven days.
const TIME_MAX_S: f64 = 1e6;
/// Tolerance of a quaternion's length, larger than any rounding error.
const LENGTH_TOLERANCE: f32 = 1e-3;

impl Pose {
    /// Checks the pose and encodes it as protobuf.
    pub fn to_bytes(&self) -> Result<Vec<u8>, Malformed> {
        self.check()?;
        check_size("pose", self.encoded_len(), POSE_BYTES_MAX)?;
        Ok(self.encode_to_vec())
    }

    /// Decodes and checks untrusted protobuf bytes.
    pub fn decode_checked(bytes: &[u8]) -> Result<Self, Malformed> {
        check_size("pose", bytes.len(), POSE_BYTES_MAX)?;
        let pose = Self::decode(bytes).map_err(Malformed::undecodable("pose"))?;
        pose.check()?;
        Ok(pose)
    }

    fn check(&self) -> Result<(), Malformed> {
        check_ident("run", &self.run)?;
        check_ident("actor", &self.actor)?;
        version::required(self.version)?;
        if self.bodies.is_empty() || !self.bodies.len().is_multiple_of(BODY_NUMBERS) {
            let expected = format!("{BODY_NUMBERS} numbers for each body");
            return Err(Malformed::length("bodies", self.bodies.len(), expected));
        }
        if !self.contacts.len().is_multiple_of(CONTACT_NUMBERS) {
            let expected = format!("{CONTACT_NUMBERS} numbers for each contact");
            return Err(Malformed::length("contacts", self.contacts.len(), expected));
        }
        let vectors = [
            ("command", &self.command),
            ("base_velocity", &self.base_velocity),
            ("centre_of_mass_m", &self.centre_of_mass_m),
        ];
        for (field, numbers) in vectors {
            if !numbers.is_empty() && numbers.len() != VECTOR_NUMBERS {
                return Err(Malformed::length(field, numbers.len(), format!("none or {VECTOR_NUMBERS}")));
            }
            check_finite(field, numbers)?;
        }
        let scalars = [
            ("reward_survive", self.reward_survive),
            ("reward_forward", self.reward_forward),
            ("reward_ctrl", self.reward_ctrl),
            ("reward_contact", self.reward_contact),
            ("velocity_mps", self.velocity_mps),
            ("distance_m", self.distance_m),
        ];
        scalars.iter().try_for_each(|(field, value)| check_finite(field, std::slice::from_ref(value)))?;
        check_finite("bodies", &self.bodies)?;
        check_finite("contacts", &self.contacts)?;
        check_finite("joint_torques_nm", &self.joint_torques_nm)?;
        check_finite("joint_angles_rad", &self.joint_angles_rad)?;
        check_finite("joint_controls", &self.joint_controls)?;
        if !(0.0..=TIME_MAX_S).contains(&self.time_s) {
            return Err(Malformed::field("time_s", self.time_s, format!("0 to {TIME_MAX_S}")));
        }
        for (body, numbers) in self.bodies.as_chunks::<BODY_NUMBERS>().0.iter().enumerate() {
            let length = numbers[3..].iter().map(|part| part * part).sum::<f32>().sqrt();
            if (length - 1.0).abs() > LENGTH_TOLERANCE {
                let found = format!("a quaternion of length {length} for body {body}");
                return Err(Malformed::field("bodies", found, "quaternions of length 1"));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> Pose {
        Pose {
            run: "walk-1".into(),
            actor: "actor-0".into(),
            version: Some(crate::PolicyVersion { incarnation: 3, number: 4, epoch: 5 }),
            episode: 5,
            step: 6,
            time_s: 0.09,
            bodies: vec![1.0, 2.0, 1.4, 1.0, 0.0, 0.0, 0.0, 1.0, 2.0, 1.2, 0.6, 0.0, -0.8, 0.0],
            contacts: vec![1.0, 2.0, 0.0, 0.0, 0.0, 400.0],
            joint_torques_nm: vec![-40.0],
            reward_survive: 5.0,
            velocity_mps: 1.5,
            command: vec![0.5, 0.0, -0.2],
            base_velocity: vec![0.4, 0.1, -0.1],
            joint_angles_rad: vec![0.3],
            joint_controls: vec![0.4],
            centre_of_mass_m: vec![1.0, 2.0, 1.0],
            ..Pose::default()
        }
    }

    #[test]
    fn poses_round_trip() {
        let pose = sample();
        assert_eq!(Pose::decode_checked(&pose.to_bytes().unwrap()), Ok(pose));
    }

    #[test]
    fn encoding_and_decoding_name_the_bad_field() {
        type Corrupt = fn(&mut Pose);
        let cases: [(&str, Corrupt); 18] = [
            ("run", |pose| pose.run = "a/b".into()),
            ("actor", |pose| pose.actor.clear()),
            ("version", |pose| pose.version = None),
            ("`bodies` is 0 numbers", |pose| pose.bodies.clear()),
            ("`bodies` is 13 numbers", |pose| pose.bodies.truncate(13)),
            ("length 0 for body 1", |pose| pose.bodies[7..].fill(0.0)),
            ("`bodies` holds NaN at index 2", |pose| pose.bodies[2] = f32::NAN),
            ("contacts", |pose| pose.contacts.push(0.0)),
            ("`contacts` holds inf at index 5", |pose| pose.contacts[5] = f32::INFINITY),
            ("joint_torques_nm", |pose| pose.joint_torques_nm[0] = f32::NAN),
            ("reward_ctrl", |pose| pose.reward_ctrl = f32::NEG_INFINITY),
            ("`command` is 2 numbers", |pose| pose.command.truncate(2)),
            ("`base_velocity` holds NaN at index 1", |pose| pose.base_velocity[1] = f32::NAN),
            ("`joint_angles_rad` holds NaN at index 0", |pose| pose.joint_angles_rad[0] = f32::NAN),
            ("`joint_controls` holds NaN at index 0", |pose| pose.joint_controls[0] = f32::NAN),
            ("`centre_of_mass_m` is 4 numbers", |pose| pose.centre_of_mass_m.push(0.0)),
            ("time_s", |pose| pose.time_s = -1.0),
            ("pose has", |pose| pose.joint_torques_nm = vec![0.0; POSE_BYTES_MAX / 4]),
        ];
        for (part, corrupt) in cases {
            let mut pose = sample();
            corrupt(&mut pose);
            let error = pose.to_bytes().expect_err(part).to_string();
            assert!(error.contains(part), "{error}");
            let error = Pose::decode_checked(&pose.encode_to_vec()).expect_err(part).to_string();
            assert!(error.contains(part), "{error}");
        }
        assert!(Pose::decode_checked(b"no protobuf").is_err());
    }
}
