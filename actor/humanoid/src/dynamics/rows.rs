//! Dense rows over the degrees of freedom, padded to whole blocks.

/// Length of a block.
const LANES: usize = 4;

/// Returns the padded length of a row.
pub(super) fn stride(dofs: usize) -> usize {
    dofs.next_multiple_of(LANES)
}

/// Returns the scalar product of two rows.
///
/// It adds four independent sums, so that one addition need not wait for the one before.
#[inline]
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; LANES];
    for (a, b) in a.as_chunks::<LANES>().0.iter().zip(b.as_chunks::<LANES>().0) {
        for lane in 0..LANES {
            sums[lane] += a[lane] * b[lane];
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3])
}

/// Adds `factor` times the row `what` to the row `to`.
#[inline]
pub(super) fn add_scaled(to: &mut [f64], what: &[f64], factor: f64) {
    for (to, what) in to.iter_mut().zip(what) {
        *to += what * factor;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dot_and_add_scaled_use_every_entry_once() {
        for dofs in [1, 4, 23, 35] {
            let mut a = vec![0.0; stride(dofs)];
            let mut b = a.clone();
            for index in 0..dofs {
                a[index] = index as f64 + 1.0;
                b[index] = 2.0;
            }
            assert_eq!(dot(&a, &b), (dofs * (dofs + 1)) as f64);
            add_scaled(&mut b, &a, -3.0);
            assert_eq!(b[dofs - 1], 2.0 - 3.0 * dofs as f64);
        }
        assert_eq!((stride(23), stride(24), stride(25)), (24, 24, 28));
    }
}
