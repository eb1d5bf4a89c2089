//! A look at an encoded message's outermost fields, before anything is allocated for them.
//!
//! Protobuf lets a sender buy much memory for few bytes: an empty submessage of a repeated field takes three, and dozens
//! once it is decoded. So what repeats is counted first.

use prost::encoding::{WireType, decode_key, decode_varint};

use crate::Malformed;

/// One field as it stands in the bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Field<'a> {
    /// Its number.
    pub number: u32,
    /// Its value where that is an integer of variable length.
    pub varint: Option<u64>,
    /// Its bytes where it is a text, bytes, a submessage or packed numbers.
    pub bytes: &'a [u8],
}

/// The next field and what follows it; `None` where nothing sound follows.
fn next(mut rest: &[u8]) -> Option<(Field<'_>, &[u8])> {
    let (number, wire_type) = decode_key(&mut rest).ok()?;
    let mut field = Field { number, varint: None, bytes: &[] };
    match wire_type {
        WireType::Varint => field.varint = Some(decode_varint(&mut rest).ok()?),
        WireType::SixtyFourBit => rest = rest.get(8..)?,
        WireType::ThirtyTwoBit => rest = rest.get(4..)?,
        WireType::LengthDelimited => {
            let length = usize::try_from(decode_varint(&mut rest).ok()?).ok()?;
            field.bytes = rest.get(..length)?;
            rest = &rest[length..];
        }
        // Groups are of an older protobuf; none of our schemas has one.
        WireType::StartGroup | WireType::EndGroup => return None,
    }
    Some((field, rest))
}

/// The fields up to the first byte that is no protobuf.
pub(crate) fn leading(bytes: &[u8]) -> impl Iterator<Item = Field<'_>> {
    let mut rest = bytes;
    std::iter::from_fn(move || {
        let (field, after) = next(rest)?;
        rest = after;
        Some(field)
    })
}

/// Calls `look` with every field.
pub(crate) fn all(what: &'static str, bytes: &[u8], mut look: impl FnMut(Field<'_>)) -> Result<(), Malformed> {
    let mut rest = bytes;
    while !rest.is_empty() {
        let Some((field, after)) = next(rest) else {
            let why = format!("byte {} begins no field", bytes.len() - rest.len());
            return Err(Malformed::Undecodable { what, why });
        };
        look(field);
        rest = after;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_are_found_and_nonsense_is_placed() {
        // Field 1 is a text of two bytes, field 3 the number 150, field 4 has eight bytes.
        let bytes = [&[0x0a, 2, b'h', b'i', 0x18, 0x96, 1, 0x21][..], &[0; 8]].concat();
        let numbers: Vec<_> = leading(&bytes).map(|field| (field.number, field.varint, field.bytes.len())).collect();
        assert_eq!(numbers, [(1, None, 2), (3, Some(150), 0), (4, None, 0)]);
        assert_eq!(all("it", &bytes, |_| ()), Ok(()));
        let cut = &bytes[..bytes.len() - 1];
        assert_eq!(leading(cut).count(), 2);
        assert!(all("it", cut, |_| ()).unwrap_err().to_string().contains("byte 7 begins no field"));
        // A length beyond the end, a length beyond all memory, a group, a field without a number.
        for bad in [&[0x0a, 9, b'h'][..], &[0x0a, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 1], &[0x0b], &[0]] {
            assert!(all("it", bad, |_| ()).is_err(), "{bad:?}");
        }
    }
}
