//! Compliance of contacts, limits and dry friction, from the numbers of MJCF's `solref` and `solimp`.
//!
//! Formulas: "Solver parameters" in the "Computation" chapter of MuJoCo's documentation.

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
pub(crate) struct SolverNumbers {
    pub(crate) solref: [f64; 2],
    pub(crate) solimp: [f64; 5],
}

impl Default for SolverNumbers {
    fn default() -> Self {
        Self { solref: SOLREF, solimp: SOLIMP }
    }
}

impl SolverNumbers {
    /// Returns whether `solref` has one of its two formats: time constant and damping ratio above 0, or neither above 0.
    pub(crate) fn is_consistent(&self) -> bool {
        let [first, second] = self.solref;
        (first > 0.0) == (second > 0.0) && first.abs().max(second.abs()) <= SOLREF_MAX
    }

    /// Returns the mixture of two geoms; `share` is that of the first one.
    pub(crate) fn mixed(&self, other: &Self, share: f64) -> Self {
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
    pub(crate) fn softness(&self) -> Softness {
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
        let one = SolverNumbers { solref: [0.05, 0.5], solimp: [0.8, 0.9, 0.002, 0.4, 3.0] };
        let other = SolverNumbers { solref: [0.03, 2.0], solimp: [0.7, 0.95, 0.01, 0.6, 1.5] };
        let softness = one.mixed(&other, 0.75).softness();
        // MuJoCo 4.0's `efc_KBIP` of a contact between geoms with these numbers and `solmix` 3 and 1.
        assert!((softness.stiffness - 774.627_873_431_365).abs() < 1e-8);
        assert!((softness.damping - 48.706_240_487_062).abs() < 1e-10);
        let wanted = [0.775, 0.9125, 0.004, 0.45, 2.625];
        assert!(softness.impedance.iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() < 1e-12));
    }

    #[test]
    fn direct_numbers_win_and_bounds_are_mujocos() {
        let direct = SolverNumbers { solref: [-500.0, -20.0], ..SolverNumbers::default() };
        let softness = direct.mixed(&SolverNumbers::default(), 0.5).softness();
        // MuJoCo 4.0's `efc_KBIP` for geoms with `solref` -500 -20 and 0.02 1.
        assert!((softness.stiffness - 554.016_620_498_615).abs() < 1e-9);
        assert!((softness.damping - 21.052_631_578_947).abs() < 1e-9);
        let odd = SolverNumbers { solref: [0.0; 2], solimp: [0.999_99, -1.0, -1.0, 2.0, 0.5] }.softness();
        assert_eq!((odd.stiffness, odd.damping), (0.0, 0.0));
        assert_eq!(odd.impedance, [0.9999, 0.0001, 0.0, 0.9999, 1.0]);
    }
}
