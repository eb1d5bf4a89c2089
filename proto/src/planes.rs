//! Number planes: raw little-endian bytes, checked for length and finiteness.

use bytes::Bytes;

use crate::Malformed;

/// Numbers as little-endian bytes.
pub(crate) fn to_bytes(numbers: &[f32]) -> Bytes {
    if cfg!(target_endian = "little") {
        return Bytes::copy_from_slice(bytemuck::cast_slice(numbers));
    }
    numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
}

/// Little-endian bytes as exactly `count` finite numbers.
pub(crate) fn from_bytes(field: &'static str, bytes: &[u8], count: usize) -> Result<Vec<f32>, Malformed> {
    if Some(bytes.len()) != count.checked_mul(4) {
        return Err(Malformed::field(
            field,
            format!("{} bytes long", bytes.len()),
            format!("{count} numbers of 4 bytes"),
        ));
    }
    let numbers: Vec<f32> = bytes.chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
    all_finite(field, &numbers)?;
    Ok(numbers)
}

/// Refuses infinities and NaN, naming the first.
pub(crate) fn all_finite(field: &'static str, numbers: &[f32]) -> Result<(), Malformed> {
    // The sum of products with zero is NaN exactly if one factor is not finite: one pass without branches.
    if numbers.iter().map(|number| number * 0.0).sum::<f32>() == 0.0 {
        return Ok(());
    }
    let index = numbers.iter().position(|number| !number.is_finite()).unwrap_or(0);
    Err(Malformed::NotFinite { field, index, value: numbers[index].to_string() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_survive_and_order_is_little_endian() {
        let bytes = to_bytes(&[1.0, -2.5]);
        assert_eq!(&bytes[..4], &[0, 0, 0x80, 0x3f]);
        assert_eq!(from_bytes("x", &bytes, 2).unwrap(), vec![1.0, -2.5]);
    }

    #[test]
    fn wrong_length_and_nan_are_named() {
        assert!(from_bytes("x", &[0; 7], 2).unwrap_err().to_string().contains("7 bytes"));
        let bad = to_bytes(&[1.0, f32::NAN]);
        assert!(from_bytes("x", &bad, 2).unwrap_err().to_string().contains("index 1"));
        let bad = to_bytes(&[f32::INFINITY]);
        assert!(from_bytes("x", &bad, 1).is_err());
    }
}
