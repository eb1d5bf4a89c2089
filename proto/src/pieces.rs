//! Messages that lie in several pieces of memory, as a bus received them: what is large in them is read where it lies.

use bytes::Buf;

/// A part of such a message, read from front to back.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cursor<'a> {
    first: &'a [u8],
    others: &'a [&'a [u8]],
    /// Bytes to be read, of what `first` and `others` hold.
    left: usize,
}

impl<'a> Cursor<'a> {
    /// A whole message.
    pub(crate) fn new(pieces: &'a [&'a [u8]]) -> Self {
        let mut cursor = Self { first: &[], others: pieces, left: pieces.iter().map(|piece| piece.len()).sum() };
        cursor.skip_empty();
        cursor
    }

    /// A message in one piece.
    pub(crate) fn whole(bytes: &'a [u8]) -> Self {
        Self { first: bytes, others: &[], left: bytes.len() }
    }

    /// The next `length` bytes, and goes on behind them; `None` where there are not so many.
    pub(crate) fn split_to(&mut self, length: usize) -> Option<Self> {
        let part = Self { left: length, ..*self };
        (length <= self.left).then(|| self.advance(length))?;
        Some(part)
    }

    /// What is left, as numbers of N little-endian bytes each.
    ///
    /// # Panics
    /// Panics if it is not a multiple of N bytes long.
    pub(crate) fn numbers<const N: usize, T>(mut self, read: impl Fn([u8; N]) -> T) -> Vec<T> {
        assert_eq!(self.left % N, 0, "numbers of {N} bytes");
        let mut numbers = Vec::with_capacity(self.left / N);
        while self.has_remaining() {
            let (whole, beginning) = self.chunk().as_chunks::<N>();
            numbers.extend(whole.iter().map(|number| read(*number)));
            let cut = !beginning.is_empty();
            self.advance(N * whole.len());
            if cut {
                // It goes on in the next piece.
                let mut number = [0; N];
                self.copy_to_slice(&mut number);
                numbers.push(read(number));
            }
        }
        numbers
    }

    fn skip_empty(&mut self) {
        while self.first.is_empty()
            && let [next, others @ ..] = self.others
        {
            (self.first, self.others) = (next, others);
        }
    }
}

impl Buf for Cursor<'_> {
    fn remaining(&self) -> usize {
        self.left
    }

    fn chunk(&self) -> &[u8] {
        &self.first[..self.first.len().min(self.left)]
    }

    fn advance(&mut self, mut count: usize) {
        assert!(count <= self.left, "{count} bytes further, of {} that are left", self.left);
        self.left -= count;
        while count > 0 {
            let here = count.min(self.first.len());
            (self.first, count) = (&self.first[here..], count - here);
            self.skip_empty();
        }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use proptest::prelude::*;

    use super::*;

    /// The bytes, cut at these places.
    pub(crate) fn cut(bytes: &[u8], places: Vec<usize>) -> Vec<&[u8]> {
        let mut places: Vec<usize> = places.into_iter().map(|place| place % (bytes.len() + 1)).collect();
        places.sort_unstable();
        let ends = places.iter().copied().chain([bytes.len()]);
        [0].into_iter().chain(places.iter().copied()).zip(ends).map(|(from, to)| &bytes[from..to]).collect()
    }

    proptest! {
        #[test]
        fn cuts_make_no_difference(
            bytes in prop::collection::vec(any::<u8>(), 0..64),
            places in prop::collection::vec(any::<usize>(), 0..8),
            length in 0usize..80,
        ) {
            let pieces = cut(&bytes, places);
            let mut cursor = Cursor::new(&pieces);
            prop_assert_eq!(cursor.remaining(), bytes.len());
            let begun = cursor.split_to(length);
            prop_assert_eq!(begun.is_some(), length <= bytes.len());
            let (left, right) = bytes.split_at(if begun.is_some() { length } else { 0 });
            if let Some(begun) = begun {
                prop_assert_eq!(begun.numbers(|[byte]: [u8; 1]| byte), left);
            }
            let even = right.len() / 4 * 4;
            let numbers = cursor.split_to(even).unwrap().numbers(u32::from_le_bytes);
            let expected: Vec<_> = right[..even].as_chunks().0.iter().map(|four| u32::from_le_bytes(*four)).collect();
            prop_assert_eq!(numbers, expected);
            prop_assert_eq!(cursor.remaining(), right.len() - even);
        }
    }
}
