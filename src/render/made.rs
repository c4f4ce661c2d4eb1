//! State that lags.

/// A value with what it was made from: its consumer compares, and nobody has to say that something has changed.
#[derive(Debug)]
pub(crate) struct Made<K, T> {
    from: Option<K>,
    pub value: T,
}

impl<K: PartialEq, T> Made<K, T> {
    /// A value that was made from nothing yet.
    pub fn not_yet(value: T) -> Self {
        Self { from: None, value }
    }

    /// What must be made anew, where it was made from something else.
    pub fn stale(&mut self, from: K) -> Option<&mut T> {
        if self.from.as_ref() == Some(&from) {
            return None;
        }
        self.from = Some(from);
        Some(&mut self.value)
    }
}
