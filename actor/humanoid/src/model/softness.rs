//! Compliance of contacts, limits and dry friction, from MJCF's `solref` and `solimp`.
//!
//! Formulas: "Solver parameters" in the "Computation" chapter of MuJoCo's documentation.

use super::values::list_over;
use crate::error::ModelError;
use crate::model::defaults::Attribute;

/// Bounds of MuJoCo's impedances.
const IMPEDANCE_RANGE: [f64; 2] = [0.0001, 0.9999];
/// Smallest divisor in MuJoCo.
const LEAST: f64 = 1e-15;
/// Largest absolute value of an entry of `solref`, so that stiffnesses are finite.
const SOLREF_MAX: f64 = 1e12;
/// MJCF's default `solref`.
const SOLREF: [f64; 2] = [0.02, 1.0];
/// MJCF's default `solimp`.
const SOLIMP: [f64; 5] = [0.9, 0.95, 0.001, 0.5, 2.0];

/// Compliance of a constraint: it aims at the acceleration −`damping` × rate − `stiffness` × impedance × distance beyond,
/// and resists the share `impedance` of the force against it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Softness {
    /// Stiffness per mass (1/s²); MuJoCo's dry friction ignores it.
    pub stiffness: f64,
    /// Damping per mass (1/s).
    pub damping: f64,
    /// MJCF's `solimp` within MuJoCo's bounds: impedance at distance 0 and at full width, width, midpoint, power.
    pub impedance: [f64; 5],
}

impl Default for Softness {
    /// Returns the softness of MJCF's defaults: `solref` 0.02 1 and `solimp` 0.9 0.95 0.001 0.5 2.
    fn default() -> Self {
        SolverNumbers::default().softness()
    }
}

/// MJCF's `solref` and `solimp` as written; those of two geoms are mixed before MuJoCo's bounds apply.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SolverNumbers {
    solref: [f64; 2],
    solimp: [f64; 5],
}

impl Default for SolverNumbers {
    fn default() -> Self {
        Self { solref: SOLREF, solimp: SOLIMP }
    }
}

impl SolverNumbers {
    /// Reads the attributes of the given names; `names` are those of `solref` and `solimp`.
    pub(super) fn read(label: &str, attributes: &[Attribute], names: [&str; 2]) -> Result<Self, ModelError> {
        let solref = list_over(attributes, names[0], SOLREF);
        let [first, second] = solref;
        if (first > 0.0) != (second > 0.0) || first.abs().max(second.abs()) > SOLREF_MAX {
            let expected = "two numbers above 0 (time constant in s, damping ratio), or two that are not (−stiffness, \
                            −damping), up to 1e12";
            return Err(ModelError::attribute(label, names[0], &format!("{first} {second}"), expected));
        }
        Ok(Self { solref, solimp: list_over(attributes, names[1], SOLIMP) })
    }

    /// Returns the mixture of two geoms; `share` is that of the first one.
    pub(super) fn mixed(&self, other: &Self, share: f64) -> Self {
        fn mix<const N: usize>(one: &[f64; N], other: &[f64; N], mixed: impl Fn(f64, f64) -> f64) -> [f64; N] {
            std::array::from_fn(|index| mixed(one[index], other[index]))
        }
        let weighted = |one: f64, other: f64| share * one + (1.0 - share) * other;
        let solref = if self.solref[0] > 0.0 && other.solref[0] > 0.0 {
            mix(&self.solref, &other.solref, weighted)
        } else {
            mix(&self.solref, &other.solref, f64::min)
        };
        Self { solref, solimp: mix(&self.solimp, &other.solimp, weighted) }
    }

    /// Returns the softness of these numbers, within MuJoCo's bounds.
    pub(super) fn softness(&self) -> Softness {
        let [least, most] = IMPEDANCE_RANGE;
        let [start, end, width, midpoint, power] = self.solimp;
        let end = end.clamp(least, most);
        let impedance = [start.clamp(least, most), end, width.max(0.0), midpoint.clamp(least, most), power.max(1.0)];
        let [first, second] = self.solref;
        let (stiffness, damping) = if first > 0.0 {
            let period = end * first * second;
            (1.0 / (period * period).max(LEAST), 2.0 / (end * first).max(LEAST))
        } else {
            // Adding 0 turns −0 into 0.
            (-first / (end * end) + 0.0, -second / end + 0.0)
        };
        Softness { stiffness, damping, impedance }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(solref: &str, solimp: &str) -> Result<SolverNumbers, ModelError> {
        let attributes = [("solref", solref), ("solimp", solimp)].map(|(name, value)| (name.into(), value.into()));
        SolverNumbers::read("part", &attributes, ["solref", "solimp"])
    }

    #[test]
    fn the_default_is_a_critically_damped_spring() {
        let default = Softness::default();
        // 1 / (0.95 × 0.02)² and 2 / (0.95 × 0.02).
        assert!((default.stiffness - 2_770.083_102_493_075).abs() < 1e-9);
        assert!((default.damping - 105.263_157_894_736_84).abs() < 1e-9);
        assert_eq!(default.impedance, [0.9, 0.95, 0.001, 0.5, 2.0]);
    }

    #[test]
    fn mixed_numbers_have_mujocos_stiffness_and_damping() {
        let one = numbers("0.05 0.5", "0.8 0.9 0.002 0.4 3").expect("valid");
        let other = numbers("0.03 2", "0.7 0.95 0.01 0.6 1.5").expect("valid");
        let softness = one.mixed(&other, 0.75).softness();
        // MuJoCo 4.0's `efc_KBIP` of a contact between geoms with these numbers and `solmix` 3 and 1.
        assert!((softness.stiffness - 774.627_873_431_365).abs() < 1e-8);
        assert!((softness.damping - 48.706_240_487_062).abs() < 1e-10);
        let wanted = [0.775, 0.9125, 0.004, 0.45, 2.625];
        assert!(softness.impedance.iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() < 1e-12));
    }

    #[test]
    fn direct_numbers_win_and_bounds_are_mujocos() {
        let direct = numbers("-500 -20", "0.9").expect("valid");
        let softness = direct.mixed(&SolverNumbers::default(), 0.5).softness();
        // MuJoCo 4.0's `efc_KBIP` for geoms with `solref` -500 -20 and 0.02 1.
        assert!((softness.stiffness - 554.016_620_498_615).abs() < 1e-9);
        assert!((softness.damping - 21.052_631_578_947).abs() < 1e-9);
        let odd = numbers("0 0", "0.99999 -1 -1 2 0.5").expect("valid").softness();
        assert_eq!((odd.stiffness, odd.damping), (0.0, 0.0));
        assert_eq!(odd.impedance, [0.9999, 0.0001, 0.0, 0.9999, 1.0]);
    }

    #[test]
    fn mixed_formats_are_refused_by_name() {
        for wrong in ["-100", "0.02 -1", "0 1", "0.02 0", "1e13 1"] {
            let message = numbers(wrong, "0.9").expect_err(wrong).to_string();
            assert!(message.contains("`solref`") && message.contains("time constant"), "{message}");
        }
    }
}
