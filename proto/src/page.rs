//! Messages of the page in the browser, see `schema/page.proto`.

use prost::Message;

pub use crate::wire::{
    FromPage, PageBody, PageCommand, PageCurve, PageCurves, PageFoot, PageFrame, PageHinge, PageMesh, PagePush,
    PageRobot, PageScene, PageStatus, PageSteerer, PageWorld, ToPage, from_page::Kind as FromPageKind,
    to_page::Kind as ToPageKind,
};
use crate::{Malformed, check_size, planes::check_finite};

/// Longest message of a page, in bytes.
pub const FROM_PAGE_BYTES_MAX: usize = 256;
/// Units of [`PageFrame::bodies`] per metre and per radian: π is within an int16.
const POSITION_UNITS_PER_M: f32 = 10_000.0;
const ROTATION_UNITS_PER_RAD: f32 = 10_000.0;
/// Force units of [`PageFrame::contacts`] per newton.
const FORCE_UNITS_PER_N: f32 = 10.0;

impl ToPageKind {
    /// Encodes as one message.
    #[must_use]
    pub fn to_bytes(self) -> Vec<u8> {
        ToPage { kind: Some(self) }.encode_to_vec()
    }
}

impl ToPage {
    /// Decodes protobuf bytes of the server.
    ///
    /// # Errors
    /// [`Malformed`] if they are none.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Malformed> {
        Self::decode(bytes).map_err(Malformed::undecodable("message to the page"))
    }
}

impl FromPage {
    /// Decodes and checks an untrusted message.
    ///
    /// # Errors
    /// [`Malformed`] names the field.
    pub fn decode_checked(bytes: &[u8]) -> Result<FromPageKind, Malformed> {
        check_size("message of the page", bytes.len(), FROM_PAGE_BYTES_MAX)?;
        let message = Self::decode(bytes).map_err(Malformed::undecodable("message of the page"))?;
        let kind = message.kind.ok_or_else(|| Malformed::field("kind", "missing", "a command, a push or a world"))?;
        let numbers = match &kind {
            FromPageKind::Command(of) => [of.forward_mps, of.left_mps, of.yaw_radps],
            FromPageKind::Push(of) => [of.forward_mps, of.left_mps, 0.0],
            FromPageKind::World(of) => [of.mass_scale, of.friction_scale, of.motor_scale],
        };
        check_finite("numbers of the page", &numbers)?;
        Ok(kind)
    }
}

/// Appends a pose as [`PageFrame::bodies`] has it: position x, y, z (m) and rotation w, x, y, z.
pub fn append_body(bodies: &mut Vec<u8>, base_m: [f32; 3], pose: &[f32; 7]) {
    let (position_m, rotation) = pose.split_at(3);
    append_point(bodies, base_m, position_m);
    append(bodies, rotation_vector(rotation).into_iter().map(|part| part * ROTATION_UNITS_PER_RAD));
}

/// Appends a contact as [`PageFrame::contacts`] has it: position x, y, z (m) and force x, y, z (N).
pub fn append_contact(contacts: &mut Vec<u8>, base_m: [f32; 3], contact: &[f32; 6]) {
    let (position_m, force_n) = contact.split_at(3);
    append_point(contacts, base_m, position_m);
    append(contacts, force_n.iter().map(|part| part * FORCE_UNITS_PER_N));
}

/// Returns axis times angle (rad) of a unit quaternion w, x, y, z, by the shorter way.
fn rotation_vector(rotation: &[f32]) -> [f32; 3] {
    let &[w, x, y, z] = rotation else { unreachable!("a pose has seven numbers") };
    let sine = (x * x + y * y + z * z).sqrt();
    let angle_rad = 2.0 * sine.atan2(w.abs());
    // For small angles the axis is not known well, but its product with the angle is.
    let scale = if sine > 1e-6 { angle_rad / sine } else { 2.0 } * w.signum();
    [x * scale, y * scale, z * scale]
}

fn append_point(to: &mut Vec<u8>, base_m: [f32; 3], position_m: &[f32]) {
    append(to, position_m.iter().zip(base_m).map(|(at, base)| (at - base) * POSITION_UNITS_PER_M));
}

/// Rounds, and saturates at the ends of an int16.
fn append(to: &mut Vec<u8>, numbers: impl Iterator<Item = f32>) {
    to.extend(numbers.flat_map(|number| (number.round() as i16).to_le_bytes()));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn poses_and_contacts_are_rounded_and_saturate() {
        let (mut bodies, mut contacts) = (Vec::new(), Vec::new());
        // A quarter turn about −y, as a quaternion with either sign, and a half turn about x.
        let half = std::f32::consts::FRAC_1_SQRT_2;
        for rotation in [[half, 0.0, -half, 0.0], [-half, 0.0, half, 0.0], [0.0, 1.0, 0.0, 0.0], [1.0, 0.0, 0.0, 5e-4]]
        {
            let [w, x, y, z] = rotation;
            append_body(&mut bodies, [100.0, 0.0, 0.8], &[100.5, -0.25, 0.8, w, x, y, z]);
        }
        append_contact(&mut contacts, [100.0, 0.0, 0.8], &[100.0, 9.0, 0.0, 1.04, -0.06, 1e9]);
        let numbers = |bytes: &[u8]| -> Vec<i16> {
            bytes.as_chunks::<2>().0.iter().map(|pair| i16::from_le_bytes(*pair)).collect()
        };
        let quarter = [0, -15_708, 0];
        let rotations = [quarter, quarter, [31_416, 0, 0], [0, 0, 10]];
        assert_eq!(numbers(&bodies), rotations.map(|[x, y, z]| [5000, -2500, 0, x, y, z]).concat());
        assert_eq!(numbers(&contacts), [0, i16::MAX, -8000, 10, -1, i16::MAX]);
    }

    #[test]
    fn hostile_messages_are_refused() {
        let push = |forward_mps| FromPage { kind: Some(FromPageKind::Push(PagePush { forward_mps, left_mps: 0.0 })) };
        assert!(FromPage::decode_checked(&push(0.5).encode_to_vec()).is_ok());
        let refused = |bytes: &[u8]| FromPage::decode_checked(bytes).unwrap_err().to_string();
        assert!(refused(&push(f32::NAN).encode_to_vec()).contains("numbers of the page"));
        assert!(refused(&[]).contains("kind"));
        assert!(refused(&[0; FROM_PAGE_BYTES_MAX + 1]).contains("message of the page"));
        assert!(refused(&[0xff; 7]).contains("message of the page"));
    }
}
