//! Mirror image of an observation, with left and right exchanged.

use super::FEET;
use super::scan::{SCAN_POINTS, opposite_point};
use crate::model::mirror::{Mirror, SignedPermutation};
use crate::task::ObservationTerm;

/// Returns the reflection of an observation with these terms, for a robot with this reflection.
pub(super) fn reflection(terms: &[ObservationTerm], mirror: &Mirror) -> SignedPermutation {
    terms.iter().flat_map(|term| of_term(term, mirror)).collect()
}

fn of_term(term: &ObservationTerm, mirror: &Mirror) -> SignedPermutation {
    let start = term.range.start;
    let signs = |signs: &[f32]| signs.iter().enumerate().map(|(at, sign)| (start + at, *sign)).collect();
    match &term.name[..] {
        // Angular velocities are pseudo-vectors.
        "base_ang_vel" => signs(&[-1.0, 1.0, -1.0]),
        "projected_gravity" | "base_lin_vel" => signs(&[1.0, -1.0, 1.0]),
        "velocity_commands" => signs(&[1.0, -1.0, -1.0]),
        "joint_pos_rel" | "joint_vel_rel" | "last_action" => {
            mirror.action.iter().map(|(at, sign)| (start + at, *sign)).collect()
        }
        "height_scan" => (0..SCAN_POINTS).map(|point| (start + opposite_point(point), 1.0)).collect(),
        // Half a period later, each foot does what the other one did.
        "gait_phase" => signs(&[-1.0, -1.0]),
        "feet_contact" | "feet_air_time" | "feet_lift" => (0..FEET).rev().map(|foot| (start + foot, 1.0)).collect(),
        _ => signs(&vec![1.0; term.range.len()]),
    }
}
