//! Precision of observations on the wire.

use bytes::Bytes;
use half::{
    f16,
    slice::{HalfBitsSliceExt, HalfFloatSliceExt},
};

use crate::{Malformed, pieces::Cursor, planes, wire};

/// Precision of observations on the wire.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// Single precision, unchanged.
    #[default]
    F32,
    /// Half precision (IEEE 754 binary16): eleven significant bits, at most 65 504.
    F16,
}

/// Largest number in half precision.
const F16_MAX: f32 = 65_504.0;

impl Precision {
    /// Rounds numbers to this precision. An actor rounds before its policy sees them, so that the learner receives the same
    /// numbers. Larger numbers become the largest one of the precision; NaN stays.
    pub fn round(self, numbers: &mut [f32]) {
        match self {
            Self::F32 => {}
            Self::F16 => {
                for number in numbers {
                    *number = f16::from_f32(number.clamp(-F16_MAX, F16_MAX)).to_f32();
                }
            }
        }
    }

    /// Encodes numbers as little-endian bytes; they must already be rounded.
    pub(crate) fn to_bytes(self, field: &'static str, numbers: &[f32]) -> Result<Bytes, Malformed> {
        if self == Self::F32 {
            return Ok(planes::to_bytes(numbers));
        }
        let mut halves = vec![f16::ZERO; numbers.len()];
        halves.convert_from_f32_slice(numbers);
        let changed = |(index, (half, number)): (usize, (&f16, &f32))| (half.to_f32() != *number).then_some(index);
        if let Some(index) = halves.iter().zip(numbers).enumerate().find_map(changed) {
            let value = format!("{} at index {index}", numbers[index]);
            return Err(Malformed::field(field, value, "numbers that half precision holds exactly"));
        }
        Ok(halves.iter().flat_map(|half| half.to_le_bytes()).collect())
    }

    /// Decodes exactly `count` little-endian numbers, without checking their values.
    pub(crate) fn read(self, field: &'static str, bytes: Cursor<'_>, count: usize) -> Result<Vec<f32>, Malformed> {
        if self == Self::F32 {
            return planes::read(field, bytes, count);
        }
        planes::check_bytes(field, bytes, count, self.bytes())?;
        let mut numbers = vec![0.0; count];
        bytes.numbers(u16::from_le_bytes).reinterpret_cast::<f16>().convert_to_f32_slice(&mut numbers);
        Ok(numbers)
    }

    /// Returns the bytes of one number.
    pub(crate) fn bytes(self) -> usize {
        match self {
            Self::F32 => 4,
            Self::F16 => 2,
        }
    }
}

impl From<Precision> for wire::Precision {
    fn from(precision: Precision) -> Self {
        match precision {
            Precision::F32 => Self::Float32,
            Precision::F16 => Self::Float16,
        }
    }
}

impl TryFrom<i32> for Precision {
    type Error = Malformed;

    fn try_from(number: i32) -> Result<Self, Malformed> {
        match wire::Precision::try_from(number) {
            Ok(wire::Precision::Float32) => Ok(Self::F32),
            Ok(wire::Precision::Float16) => Ok(Self::F16),
            Err(_) => Err(Malformed::field("observation_precision", number, "0 (float32) or 1 (float16)")),
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn rounding_goes_to_the_nearest_finite_number() {
        // 2049 lies between 2048 and 2050; ties go to even. The smallest number above 0 is 6e-8.
        let mut numbers = [1.0, 0.1, 2049.0, 1e6, -f32::INFINITY, 1e-9];
        Precision::F16.round(&mut numbers);
        assert_eq!(numbers, [1.0, 0.099_975_586, 2048.0, 65_504.0, -65_504.0, 0.0]);
        let mut exact = [0.1];
        Precision::F32.round(&mut exact);
        assert_eq!(exact, [0.1]);
    }

    #[test]
    fn unrounded_numbers_are_refused() {
        let refused = Precision::F16.to_bytes("observations", &[1.0, 0.1]).unwrap_err().to_string();
        assert!(refused.contains("`observations` is 0.1 at index 1"), "{refused}");
        let refused = Precision::F16.read("observations", Cursor::whole(&[0; 3]), 2).unwrap_err().to_string();
        assert!(refused.contains("3 bytes long") && refused.contains("2 numbers of 2 bytes"), "{refused}");
    }

    proptest! {
        #[test]
        fn rounded_numbers_round_trip(mut numbers in prop::collection::vec(-1e5f32..1e5, 0..40)) {
            Precision::F16.round(&mut numbers);
            let bytes = Precision::F16.to_bytes("x", &numbers).unwrap();
            prop_assert_eq!(bytes.len(), 2 * numbers.len());
            prop_assert_eq!(Precision::F16.read("x", Cursor::whole(&bytes), numbers.len()).unwrap(), numbers);
        }
    }
}
