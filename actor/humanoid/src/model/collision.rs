//! Which shapes may touch each other: MuJoCo's bits, and exclusions between bodies.

/// Indices of two MJCF bodies that never touch; 0 is the world.
pub(super) type Exclusion = [usize; 2];

/// MuJoCo's rule: the `contype` of one shape shares a bit with the `conaffinity` of the other.
pub(super) fn filters_match([contype, conaffinity]: [u32; 2], [other_type, other_affinity]: [u32; 2]) -> bool {
    contype & other_affinity != 0 || other_type & conaffinity != 0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn either_shapes_affinity_is_enough() {
        assert!(filters_match([1, 1], [1, 1]));
        assert!(filters_match([1, 0], [0, 1]) && filters_match([0, 1], [1, 0]));
        assert!(!filters_match([1, 0], [1, 0]));
        assert!(!filters_match([0, 0], [3, 3]));
        assert!(filters_match([2, 1], [4, 6]));
    }
}
