//! One bit a node.

/// A fixed number of bits.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Mask {
    words: Vec<u64>,
}

impl Mask {
    /// `bits` zeros.
    pub(crate) fn zeros(bits: usize) -> Self {
        Self {
            words: vec![0; bits.div_ceil(64)],
        }
    }

    /// The bit at `k`; false beyond the end.
    #[inline]
    pub(crate) fn get(&self, k: usize) -> bool {
        self.words
            .get(k / 64)
            .is_some_and(|w| w >> (k % 64) & 1 == 1)
    }

    /// Sets the bit at `k` to one, if there is such a bit.
    #[inline]
    pub(crate) fn set(&mut self, k: usize) {
        if let Some(w) = self.words.get_mut(k / 64) {
            *w |= 1 << (k % 64);
        }
    }

    /// Sets the bit at `k` to `value`.
    #[inline]
    pub(crate) fn assign(&mut self, k: usize, value: bool) {
        if value {
            self.set(k);
        }
    }

    /// Sets the bits of `other` too, whose first word is this one's number `first`.
    pub(crate) fn add_words(&mut self, first: usize, other: &Self) {
        for (word, more) in self.words.iter_mut().skip(first).zip(&other.words) {
            *word |= more;
        }
    }

    /// Bytes held.
    pub(crate) fn bytes(&self) -> usize {
        self.words.len() * 8
    }
}
