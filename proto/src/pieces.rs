//! Reads a message in several pieces of memory, as the bus received it, without joining them.

use bytes::Buf;

/// Unread part of a message.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cursor<'a> {
    first: &'a [u8],
    others: &'a [&'a [u8]],
    /// Unread bytes; `first` and `others` may hold more.
    left: usize,
}

impl<'a> Cursor<'a> {
    /// Returns a cursor over a message in pieces.
    pub(crate) fn new(pieces: &'a [&'a [u8]]) -> Self {
        let mut cursor = Self { first: &[], others: pieces, left: pieces.iter().map(|piece| piece.len()).sum() };
        cursor.skip_empty();
        cursor
    }

    /// Returns a cursor over a message in one piece.
    pub(crate) fn whole(bytes: &'a [u8]) -> Self {
        Self { first: bytes, others: &[], left: bytes.len() }
    }

    /// Splits off the next `length` bytes; returns `None` if fewer are left.
    pub(crate) fn split_to(&mut self, length: usize) -> Option<Self> {
        let part = Self { left: length, ..*self };
        (length <= self.left).then(|| self.advance(length))?;
        Some(part)
    }

    /// Reads the rest as numbers of N bytes each.
    ///
    /// # Panics
    /// If the length is no multiple of N.
    pub(crate) fn numbers<const N: usize, T>(mut self, read: impl Fn([u8; N]) -> T) -> Vec<T> {
        assert_eq!(self.left % N, 0, "numbers of {N} bytes");
        let mut numbers = Vec::with_capacity(self.left / N);
        while self.has_remaining() {
            let (whole, rest) = self.chunk().as_chunks::<N>();
            numbers.extend(whole.iter().map(|number| read(*number)));
            let is_split = !rest.is_empty();
            self.advance(N * whole.len());
            if is_split {
                // The number continues in the next piece.
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
        assert!(count <= self.left, "cannot advance {count} bytes, {} are left", self.left);
        self.left -= count;
        while count > 0 {
            let step = count.min(self.first.len());
            (self.first, count) = (&self.first[step..], count - step);
            self.skip_empty();
        }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Cuts the bytes at these positions.
    pub(crate) fn cut(bytes: &[u8], positions: Vec<usize>) -> Vec<&[u8]> {
        let mut positions: Vec<usize> = positions.into_iter().map(|position| position % (bytes.len() + 1)).collect();
        positions.sort_unstable();
        let ends = positions.iter().copied().chain([bytes.len()]);
        [0].into_iter().chain(positions.iter().copied()).zip(ends).map(|(from, to)| &bytes[from..to]).collect()
    }

    proptest! {
        #[test]
        fn reading_does_not_depend_on_pieces(
            bytes in prop::collection::vec(any::<u8>(), 0..64),
            positions in prop::collection::vec(any::<usize>(), 0..8),
            length in 0usize..80,
        ) {
            let pieces = cut(&bytes, positions);
            let mut cursor = Cursor::new(&pieces);
            prop_assert_eq!(cursor.remaining(), bytes.len());
            let head = cursor.split_to(length);
            prop_assert_eq!(head.is_some(), length <= bytes.len());
            let (left, right) = bytes.split_at(if head.is_some() { length } else { 0 });
            if let Some(head) = head {
                prop_assert_eq!(head.numbers(|[byte]: [u8; 1]| byte), left);
            }
            let even = right.len() / 4 * 4;
            let numbers = cursor.split_to(even).unwrap().numbers(u32::from_le_bytes);
            let expected: Vec<_> = right[..even].as_chunks().0.iter().map(|four| u32::from_le_bytes(*four)).collect();
            prop_assert_eq!(numbers, expected);
            prop_assert_eq!(cursor.remaining(), right.len() - even);
        }
    }
}
