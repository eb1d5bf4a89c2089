//! Mirror images of observations and actions, as they are sent: for each entry the number from 1 of the entry that it holds,
//! negative if with its sign changed.

use crate::Malformed;

/// Checks that a mirror image is empty, or has `size` entries and is its own inverse.
pub(crate) fn check(field: &'static str, mirror: &[i32], size: usize) -> Result<(), Malformed> {
    if !mirror.is_empty() && mirror.len() != size {
        return Err(Malformed::length(field, mirror.len(), format!("0 or {size}")));
    }
    if let Some(wrong) = mirror.iter().find(|number| !(1..=size).contains(&(number.unsigned_abs() as usize))) {
        return Err(Malformed::field(field, wrong, format!("1 to {size}, or the same below 0")));
    }
    let image = |number: i32| mirror[number.unsigned_abs() as usize - 1] * number.signum();
    let own = 1..=size as i32;
    match own.zip(mirror).find(|(entry, number)| image(**number) != *entry) {
        None => Ok(()),
        Some((entry, number)) => {
            let value = format!("{number} at entry {entry}, and {} there", mirror[number.unsigned_abs() as usize - 1]);
            Err(Malformed::field(field, value, "a mirror image whose mirror image is the original"))
        }
    }
}
