//! Scans the top-level fields of an encoded message without allocating.
//!
//! An empty submessage of a repeated field takes three bytes encoded and dozens decoded. Decoders therefore count repeated
//! fields first.

use bytes::Buf;
use prost::encoding::{WireType, decode_key, decode_varint};

use crate::{Malformed, pieces::Cursor};

/// One encoded field.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Field<'a> {
    /// Number of the field.
    pub number: u32,
    /// Value, if it is a varint.
    pub varint: Option<u64>,
    /// Bytes, if it is a string, bytes, a submessage or packed numbers.
    pub bytes: Option<Cursor<'a>>,
    /// Whole field with its tag.
    pub encoded: Cursor<'a>,
}

/// Reads the next field; returns `None` if no valid one follows.
fn next<'a>(rest: &mut Cursor<'a>) -> Option<Field<'a>> {
    let mut encoded = *rest;
    let (number, wire_type) = decode_key(rest).ok()?;
    let (mut varint, mut bytes) = (None, None);
    match wire_type {
        WireType::Varint => varint = Some(decode_varint(rest).ok()?),
        WireType::SixtyFourBit => drop(rest.split_to(8)?),
        WireType::ThirtyTwoBit => drop(rest.split_to(4)?),
        WireType::LengthDelimited => {
            let length = usize::try_from(decode_varint(rest).ok()?).ok()?;
            bytes = Some(rest.split_to(length)?);
        }
        // Only older versions of protobuf have groups.
        WireType::StartGroup | WireType::EndGroup => return None,
    }
    let length = encoded.remaining() - rest.remaining();
    Some(Field { number, varint, bytes, encoded: encoded.split_to(length)? })
}

/// Returns the fields up to the first invalid one.
pub(crate) fn leading(bytes: &[u8]) -> impl Iterator<Item = Field<'_>> {
    let mut rest = Cursor::whole(bytes);
    std::iter::from_fn(move || next(&mut rest))
}

/// Calls `visit` with every field.
pub(crate) fn all<'a>(
    what: &'static str,
    message: Cursor<'a>,
    mut visit: impl FnMut(Field<'a>),
) -> Result<(), Malformed> {
    let mut rest = message;
    while rest.has_remaining() {
        let at = message.remaining() - rest.remaining();
        let Some(field) = next(&mut rest) else {
            return Err(Malformed::Undecodable { what, why: format!("no valid field at byte {at}") });
        };
        visit(field);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_are_found_and_errors_are_located() {
        // Field 1 is a string of two bytes, field 3 the number 150, field 4 has eight bytes.
        let bytes = [&[0x0a, 2, b'h', b'i', 0x18, 0x96, 1, 0x21][..], &[0; 8]].concat();
        let numbers: Vec<_> = leading(&bytes)
            .map(|field| {
                (field.number, field.varint, field.bytes.map(|bytes| bytes.remaining()), field.encoded.remaining())
            })
            .collect();
        assert_eq!(numbers, [(1, None, Some(2), 4), (3, Some(150), None, 3), (4, None, None, 9)]);
        let all = |bytes: &[u8]| all("message", Cursor::whole(bytes), |_| ());
        assert_eq!(all(&bytes), Ok(()));
        let cut = &bytes[..bytes.len() - 1];
        assert_eq!(leading(cut).count(), 2);
        assert!(all(cut).unwrap_err().to_string().contains("no valid field at byte 7"));
        // A length beyond the end, a length beyond all memory, a group, a field number of 0.
        for bad in [&[0x0a, 9, b'h'][..], &[0x0a, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 1], &[0x0b], &[0]] {
            assert!(all(bad).is_err(), "{bad:?}");
        }
    }
}
