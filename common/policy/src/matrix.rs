//! Products of matrices in plain slices.

use gemm::{Parallelism, gemm};

/// Writes the transposed matrix of one with so many columns.
pub(crate) fn transpose(matrix: &[f32], columns: usize, transposed: &mut [f32]) {
    /// Rows at once: their numbers fill a cache line of the result.
    const ROWS: usize = 16;
    let rows = matrix.len() / columns.max(1);
    for start in (0..rows).step_by(ROWS) {
        let count = ROWS.min(rows - start);
        for column in 0..columns {
            let target = &mut transposed[column * rows + start..][..count];
            for (row, number) in target.iter_mut().enumerate() {
                *number = matrix[(start + row) * columns + column];
            }
        }
    }
}

/// View of a matrix: element `(i, j)` is at `i · row_stride + j · column_stride`.
#[derive(Clone, Copy)]
pub(crate) struct Matrix<'a> {
    data: &'a [f32],
    row_stride: usize,
    column_stride: usize,
}

impl<'a> Matrix<'a> {
    /// Returns a matrix whose rows follow each other.
    pub(crate) fn row_major(data: &'a [f32], columns: usize) -> Self {
        Self { data, row_stride: columns, column_stride: 1 }
    }

    /// Returns the matrix without its first columns.
    pub(crate) fn skip_columns(self, column: usize) -> Self {
        Self { data: &self.data[column.min(self.data.len())..], ..self }
    }

    pub(crate) fn transposed(self) -> Self {
        Self { data: self.data, row_stride: self.column_stride, column_stride: self.row_stride }
    }

    /// Returns whether all of `rows × columns` is inside the data.
    fn covers(&self, rows: usize, columns: usize) -> bool {
        rows == 0 || columns == 0 || (rows - 1) * self.row_stride + (columns - 1) * self.column_stride < self.data.len()
    }
}

/// Computes `product = left · right`, or `product += left · right`: `[m, k] · [k, n]` into `[m, n]`, whose rows begin every
/// `stride` numbers.
pub(crate) fn multiply(
    [m, n, k]: [usize; 3],
    left: Matrix,
    right: Matrix,
    product: &mut [f32],
    stride: usize,
    accumulate: bool,
) {
    if m == 0 || n == 0 {
        return;
    }
    let reach = (m - 1) * stride + n;
    assert!(left.covers(m, k) && right.covers(k, n) && product.len() >= reach, "matrix sizes do not fit");
    if k == 0 {
        let rows = product.chunks_mut(stride).take(if accumulate { 0 } else { m });
        return rows.for_each(|row| row[..n].fill(0.0));
    }
    let kept = if accumulate { 1.0 } else { 0.0 };
    // SAFETY: by the assertion, sizes and strides reach only indices inside the three slices, and the mutable slice cannot
    // overlap the others.
    unsafe {
        gemm(
            m,
            n,
            k,
            product.as_mut_ptr(),
            1,
            stride as isize,
            accumulate,
            left.data.as_ptr(),
            left.column_stride as isize,
            left.row_stride as isize,
            right.data.as_ptr(),
            right.column_stride as isize,
            right.row_stride as isize,
            kept,
            1.0,
            false,
            false,
            false,
            Parallelism::None,
        );
    }
}
