//! Keys that are edited one at a time.

use super::band::{Band, bands};
use super::source::Source;
use super::stack::Stack;
use super::threshold::{check_nested, fault, find_codes};
use super::{BakeOptions, Blend, Key, Mask, ThresholdMap, bake};
use crate::Result;

/// Keys in memory and their map, for an editor: where one key changes, only what lies between it and its neighbours is
/// found anew.
pub struct Session {
    keys: Vec<Key>,
    options: BakeOptions,
    stack: Stack,
    bands: Vec<Band>,
    map: ThresholdMap,
}

impl Session {
    /// Bakes keys and keeps them.
    ///
    /// # Errors
    /// Those of [`bake`].
    pub fn new(keys: Vec<Key>, options: BakeOptions) -> Result<Self> {
        let map = bake(&keys, &options)?.map;
        let angles: Vec<f32> = keys.iter().map(|k| k.angle_rad).collect();
        let stack = Self::stack(&keys)?;
        Ok(Self { bands: bands(&angles, &options)?, stack, map, keys, options })
    }

    fn stack(keys: &[Key]) -> Result<Stack> {
        let angles: Vec<f32> = keys.iter().map(|k| k.angle_rad).collect();
        let mut sources: Vec<Source> = keys.iter().map(|k| Source::mask(&k.mask)).collect();
        Stack::read(sources[0].size, &angles, &mut sources)
    }

    /// The map of the present keys.
    #[must_use]
    pub fn map(&self) -> &ThresholdMap {
        &self.map
    }

    /// Takes another mask for a key; the map is that of [`bake`]. After an error all is as it was before.
    ///
    /// # Errors
    /// [`Error::Argument`](crate::Error::Argument) for a key that does not exist, a mask of another size, and, without
    /// [`repair`](BakeOptions::repair), texels that light up again.
    pub fn replace(&mut self, key: usize, mut mask: Mask) -> Result<()> {
        let Some(own) = self.keys.get_mut(key) else {
            return Err(fault(format!("are {}; expected one of them, not number {key}", self.keys.len())));
        };
        let sizes = [&own.mask, &mask].map(|m| (m.width, m.height, m.coverage.len()));
        if sizes[0] != sizes[1] {
            return Err(fault(format!("have masks of {:?} and {:?}; expected one size", sizes[0], sizes[1])));
        }
        std::mem::swap(&mut own.mask, &mut mask);
        let stack = Self::stack(&self.keys).and_then(|stack| check_nested(&stack, &self.options).map(|()| stack));
        let stack = match stack {
            Ok(stack) => stack,
            Err(e) => {
                self.keys[key].mask = mask;
                return Err(e);
            }
        };
        // Levels that have the key as a border, and those whose sets have won or lost a texel.
        let mut wanted = [false; 256];
        wanted[key..(key + 2).min(256)].fill(true);
        for (was, is) in self.stack.counts.iter().zip(&stack.counts).filter(|(was, is)| was != is) {
            wanted[usize::from(*was.min(is))..=usize::from(*was.max(is))].fill(true);
        }
        if self.options.blend == Blend::Smooth {
            // There the next border but one counts, too.
            let near = |i: usize| (i.saturating_sub(1)..=(i + 1).min(255)).any(|j| wanted[j]);
            wanted = std::array::from_fn(near);
        }
        find_codes(&stack, &self.bands, &self.options, &wanted, &mut self.map.codes);
        self.stack = stack;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::super::Depth;
    use super::*;

    #[test]
    fn an_edited_key_gives_the_map_of_a_whole_bake() {
        let edits = [(3usize, 1.5f64), (3, -2.0), (1, 2.5), (5, -3.0), (0, 1.0)];
        for options in [
            BakeOptions::default(),
            BakeOptions { blend: Blend::Smooth, ..BakeOptions::default() },
            BakeOptions { repair: true, depth: Depth::Eight, ..BakeOptions::default() },
        ] {
            let edge = |k: usize, shift: f64, y: u32| k as f64 * 8.0 - 4.0 + shift + 3.0 * (f64::from(y) * 0.3).sin();
            let mut keys: Vec<Key> = (0..=6)
                .map(|k| Key {
                    angle_rad: std::f32::consts::PI * k as f32 / 6.0,
                    mask: Mask::from_fn(40, 24, |x, y| f64::from(x) >= edge(k, 0.0, y) && k < 6),
                })
                .collect();
            let mut session = Session::new(keys.clone(), options.clone()).expect("bakes");
            for (key, shift) in edits {
                keys[key].mask = Mask::from_fn(40, 24, |x, y| f64::from(x) >= edge(key, shift, y) && (x, y) != (38, 3));
                let whole = bake(&keys, &options).map(|b| b.map);
                let edited = session.replace(key, keys[key].mask.clone());
                match whole {
                    Ok(whole) => assert!(session.map() == &whole, "key {key}, {options:?}"),
                    Err(_) => {
                        assert!(edited.is_err());
                        keys[key] = session.keys[key].clone();
                    }
                }
            }
            assert!(session.replace(9, Mask::default()).is_err() && session.replace(1, Mask::default()).is_err());
        }
    }
}
