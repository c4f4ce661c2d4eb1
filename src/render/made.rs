//! State that lags, and state that threads share.

use std::sync::{Mutex, MutexGuard, PoisonError};

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

/// What a mutex holds; a panic elsewhere has not made it worse.
pub(crate) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
