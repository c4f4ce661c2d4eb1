//! Collects warnings: few and useful, the same kind of thing counted together.

use crate::scene::Warning;

use super::fault::shown;

/// Most warnings kept; a broken file must not flood the caller.
const MOST: usize = 100;

/// Warnings in the order in which they were found.
#[derive(Debug, Default)]
pub(super) struct Warnings {
    list: Vec<(Warning, usize)>,
}

impl Warnings {
    /// Adds a warning. The same message again is only counted, and the first place kept.
    pub(super) fn add(&mut self, pointer: impl AsRef<str>, message: impl AsRef<str>) {
        let message = shown(message.as_ref());
        if let Some((_, count)) = self.list.iter_mut().find(|(w, _)| w.message == message) {
            *count = count.saturating_add(1);
        } else if self.list.len() < MOST {
            self.list.push((Warning { pointer: shown(pointer.as_ref()), message }, 1));
        }
    }

    /// The warnings, with their counts in the text.
    pub(super) fn finish(self) -> Vec<Warning> {
        self.list
            .into_iter()
            .map(|(mut warning, count)| {
                if count > 1 {
                    warning.message = format!("{} ({count} times, here first)", warning.message);
                }
                warning
            })
            .collect()
    }
}
