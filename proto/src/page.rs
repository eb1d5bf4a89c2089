//! Messages of the page in the browser, see `schema/page.proto`.

use std::collections::HashMap;

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

impl PageMesh {
    /// Packs triangles, which name corners by their index. Corners that are equal after rounding become one, and triangles
    /// that have one twice are left out.
    ///
    /// # Panics
    /// If a triangle has a corner that there is not.
    #[must_use]
    pub fn packed(corners_m: &[[f32; 3]], triangles: &[[u32; 3]]) -> Self {
        /// Steps between the lowest and the highest corner.
        const STEPS: f32 = u16::MAX as f32;
        let extreme = |axis: usize, of: fn(f32, f32) -> f32| corners_m.iter().map(|corner| corner[axis]).reduce(of);
        let low_m: [f32; 3] = std::array::from_fn(|axis| extreme(axis, f32::min).unwrap_or(0.0));
        let unit_m: [f32; 3] =
            std::array::from_fn(|axis| (extreme(axis, f32::max).unwrap_or(0.0) - low_m[axis]) / STEPS);
        let mut places = HashMap::new();
        let mut corners: Vec<u8> = Vec::new();
        let mut place_of = |corner: &[f32; 3]| {
            let steps: [u16; 3] = std::array::from_fn(|axis| match unit_m[axis] {
                unit_m if unit_m > 0.0 => ((corner[axis] - low_m[axis]) / unit_m).round() as u16,
                _ => 0,
            });
            let count = places.len() as u32;
            *places.entry(steps).or_insert_with(|| {
                corners.extend(steps.into_iter().flat_map(u16::to_le_bytes));
                count
            })
        };
        let placed: Vec<u32> = corners_m.iter().map(&mut place_of).collect();
        let renamed = triangles.iter().map(|triangle| triangle.map(|corner| placed[corner as usize]));
        let renamed = renamed.filter(|[a, b, c]| a != b && b != c && c != a).flatten();
        let triangles: Vec<u8> = match places.len() <= 1 << 16 {
            true => renamed.flat_map(|corner| (corner as u16).to_le_bytes()).collect(),
            false => renamed.flat_map(u32::to_le_bytes).collect(),
        };
        Self {
            corners: corners.into(),
            triangles: triangles.into(),
            low_m: low_m.to_vec(),
            unit_m: unit_m.to_vec(),
            ..Self::default()
        }
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
    fn a_packed_mesh_has_each_corner_once() {
        // A square of two triangles that share no corner, 2 m wide, 1 m high and 7 m up, and a triangle without an area.
        let corners = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 0.0], [2.0, 1.0], [0.0, 1.0]];
        let corners = corners.map(|[x, y]| [x, y, 7.0]);
        let mesh = PageMesh::packed(&corners, &[[0, 1, 2], [3, 4, 5], [0, 3, 1]]);
        let numbers = |bytes: &[u8]| -> Vec<u16> {
            bytes.as_chunks::<2>().0.iter().map(|pair| u16::from_le_bytes(*pair)).collect()
        };
        const MOST: u16 = u16::MAX;
        assert_eq!(numbers(&mesh.corners), [[0, 0, 0], [MOST, 0, 0], [MOST, MOST, 0], [0, MOST, 0]].concat());
        assert_eq!(numbers(&mesh.triangles), [0, 1, 2, 0, 2, 3]);
        assert_eq!((mesh.low_m, mesh.unit_m), (vec![0.0, 0.0, 7.0], vec![2.0 / 65_535.0, 1.0 / 65_535.0, 0.0]));
        let many: Vec<[f32; 3]> = (0..65_537).map(|i| [(i % 300) as f32, (i / 300) as f32, 0.0]).collect();
        let mesh = PageMesh::packed(&many, &[[0, 1, 65_536]]);
        assert_eq!((mesh.corners.len(), &mesh.triangles[8..]), (6 * 65_537, &65_536_u32.to_le_bytes()[..]));
        let mesh = PageMesh::packed(&many[..65_536], &[[0, 1, 65_535]]);
        assert_eq!(numbers(&mesh.triangles), [0, 1, 65_535]);
        assert_eq!(PageMesh::packed(&[], &[]).corners.len(), 0);
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
