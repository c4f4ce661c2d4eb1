//! Which things belong together.

use std::collections::HashMap;

/// Sets of numbers from 0 on that grow together.
#[derive(Clone)]
pub(crate) struct Sets(Vec<usize>);

impl Sets {
    /// Each number alone.
    pub(crate) fn new(count: usize) -> Self {
        Self((0..count).collect())
    }

    /// The number that stands for the set of one.
    pub(crate) fn root(&mut self, mut of: usize) -> usize {
        while self.0[of] != of {
            self.0[of] = self.0[self.0[of]];
            of = self.0[of];
        }
        of
    }

    /// The sets of two numbers are one from now on.
    pub(crate) fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b)] = a.min(b);
    }

    /// The set of each number, counted in the order in which they first come, and how many there are.
    pub(crate) fn numbered(mut self) -> (Vec<usize>, usize) {
        let mut known = HashMap::new();
        let numbers = (0..self.0.len()).map(|of| {
            let next = known.len();
            *known.entry(self.root(of)).or_insert(next)
        });
        let numbers = numbers.collect();
        (numbers, known.len())
    }
}
