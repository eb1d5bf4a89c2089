//! Planes of numbers: raw little-endian bytes. Reading checks their length, [`check_finite`] checks the numbers.

use bytes::{Buf, Bytes};

use crate::{Malformed, pieces::Cursor};

/// Encodes numbers as little-endian bytes.
pub(crate) fn to_bytes(numbers: &[f32]) -> Bytes {
    if cfg!(target_endian = "little") {
        return Bytes::copy_from_slice(bytemuck::cast_slice(numbers));
    }
    numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
}

/// Decodes exactly `count` little-endian numbers, without checking their values.
pub(crate) fn from_bytes(field: &'static str, bytes: &[u8], count: usize) -> Result<Vec<f32>, Malformed> {
    read(field, Cursor::whole(bytes), count)
}

/// Decodes exactly `count` little-endian numbers from a cursor, without checking their values.
pub(crate) fn read(field: &'static str, bytes: Cursor<'_>, count: usize) -> Result<Vec<f32>, Malformed> {
    check_bytes(field, bytes, count, 4)?;
    Ok(bytes.numbers(f32::from_le_bytes))
}

/// Checks that the bytes are exactly `count` numbers of `size` bytes.
pub(crate) fn check_bytes(field: &'static str, bytes: Cursor<'_>, count: usize, size: usize) -> Result<(), Malformed> {
    let found = bytes.remaining();
    if Some(found) == count.checked_mul(size) {
        return Ok(());
    }
    Err(Malformed::field(field, format!("{found} bytes long"), format!("{count} numbers of {size} bytes")))
}

/// Refuses infinities and NaN; the error names the first.
pub(crate) fn check_finite(field: &'static str, numbers: &[f32]) -> Result<(), Malformed> {
    // Exactly infinities and NaN have an exponent of all ones. Comparing bits needs no branches and no order, so the
    // compiler vectorises it.
    const EXPONENT: u32 = 0x7f80_0000;
    let bad = |number: &f32| u32::from(number.to_bits() & EXPONENT == EXPONENT);
    if numbers.iter().fold(0, |found, number| found | bad(number)) == 0 {
        return Ok(());
    }
    let index = numbers.iter().position(|number| !number.is_finite()).unwrap_or(0);
    Err(Malformed::NotFinite { field, index, value: numbers[index].to_string() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_round_trip_in_little_endian() {
        let bytes = to_bytes(&[1.0, -2.5]);
        assert_eq!(&bytes[..4], &[0, 0, 0x80, 0x3f]);
        assert_eq!(from_bytes("x", &bytes, 2).unwrap(), vec![1.0, -2.5]);
    }

    #[test]
    fn the_error_names_wrong_lengths_and_infinite_numbers() {
        assert!(from_bytes("x", &[0; 7], 2).unwrap_err().to_string().contains("7 bytes"));
        for bad in [f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            assert!(check_finite("x", &[1.0, bad]).unwrap_err().to_string().contains("index 1"), "{bad}");
        }
        assert!(check_finite("x", &[f32::MAX, f32::MIN, -0.0, 1e-42]).is_ok());
    }
}
