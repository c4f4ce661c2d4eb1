//! Keys laid on one another: for each texel the number of keys at which it is lit, and where they contradict each other.

use rayon::prelude::*;

use super::LIT;
use super::border::{Border, BorderFinder};
use super::columns::MAX_SIDE;
use super::source::Source;
use crate::{Error, Result};

/// Most keys of one side of the face: counts fit a byte.
pub const MAX_KEYS: usize = 255;

/// Rows that are read of all keys at a time: they stay in the cache.
const ROWS: usize = 64;

/// Texels that are dark at a key and lit again at the next one, though one number can hold one border only.
#[derive(Clone, Debug, PartialEq)]
pub struct Contradiction {
    /// Angle of the key at which they are dark, radians.
    pub dark_rad: f32,
    /// Angle of the next key, at which they are lit, radians.
    pub lit_rad: f32,
    /// How many there are.
    pub texels: usize,
    /// Least column and row, greatest column and row.
    pub bounds: [u32; 4],
    /// Column and row of the first one, in reading order.
    pub first: [u32; 2],
}

/// Nested keys.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Stack {
    pub(super) width: usize,
    pub(super) height: usize,
    /// For each texel the number of keys, from the first, at which it is lit. Where keys contradict each other, the count
    /// that the fewest of them gainsay; of equal ones the lowest.
    pub(super) counts: Vec<u8>,
    /// Of each key that has grey texels along its border.
    pub(super) borders: Vec<Option<Border>>,
    pub(super) contradictions: Vec<Contradiction>,
    /// Texels at which keys contradict each other, in reading order.
    pub(super) wrong: Vec<u32>,
}

/// What one row of texels says against itself: column, and bit `k` set where key `k` and the next one contradict.
type Wrong = Vec<(usize, Vec<usize>)>;

impl Stack {
    /// Reads keys in the order of their angles, all at once and a few rows at a time, so that memory does not grow with
    /// their number.
    ///
    /// # Errors
    /// [`Error::Argument`] for a picture without texels or over [`MAX_SIDE`], and for too many keys; those of the
    /// sources.
    pub(super) fn read([width, height]: [u32; 2], angles_rad: &[f32], sources: &mut [Source]) -> Result<Self> {
        let fault = |message: String| Err(Error::Argument { what: "keys of a threshold map".into(), message });
        if width.min(height) == 0 || width.max(height) > MAX_SIDE {
            return fault(format!("have {width} x {height} texels; expected 1 to {MAX_SIDE} a side"));
        }
        if sources.len() > MAX_KEYS {
            return fault(format!("are {}; expected at most {MAX_KEYS}", sources.len()));
        }
        let (width, height) = (width as usize, height as usize);
        let mut stack = Self { width, height, counts: vec![0; width * height], ..Self::default() };
        // Shapes are drawn in tiles: small bands would draw each tile many times.
        let rows = if sources.iter().any(Source::is_drawn) {
            (4 * height).div_ceil(sources.len()).max(ROWS)
        } else {
            ROWS
        };
        let rows = rows.min(height);
        // A byte of every eighth texel for all keys together, but enough for the edges of small masks.
        let most = (width * height / (8 * sources.len().max(1))).max(16 * (width + height));
        let mut bands: Vec<(Vec<u8>, BorderFinder)> =
            sources.iter().map(|_| (vec![0; rows * width], BorderFinder::new(width, most))).collect();
        for top in (0..height).step_by(rows) {
            let texels = rows.min(height - top) * width;
            sources.par_iter_mut().zip(&mut bands).try_for_each(|(source, (band, border))| {
                source.read(&mut band[..texels])?;
                border.add(&band[..texels]);
                Ok(())
            })?;
            let counts = &mut stack.counts[top * width..][..texels];
            let wrong: Vec<Wrong> = counts
                .par_chunks_exact_mut(width)
                .enumerate()
                .map(|(y, counts)| {
                    let keys: Vec<&[u8]> = bands.iter().map(|(band, _)| &band[y * width..(y + 1) * width]).collect();
                    count(&keys, counts)
                })
                .collect();
            for (y, row) in wrong.into_iter().enumerate() {
                stack.report(top + y, row, angles_rad);
            }
        }
        stack.borders = bands.into_par_iter().map(|(_, border)| border.finish()).collect();
        Ok(stack)
    }

    fn report(&mut self, y: usize, row: Wrong, angles_rad: &[f32]) {
        for (x, pairs) in row {
            self.wrong.push((y * self.width + x) as u32);
            let [x, y] = [x as u32, y as u32];
            for key in pairs {
                let (dark_rad, lit_rad) = (angles_rad[key], angles_rad[key + 1]);
                let at = self.contradictions.partition_point(|c| c.dark_rad < dark_rad);
                if self.contradictions.get(at).is_none_or(|c| c.dark_rad != dark_rad) {
                    let new = Contradiction { dark_rad, lit_rad, texels: 0, bounds: [x, y, x, y], first: [x, y] };
                    self.contradictions.insert(at, new);
                }
                let c = &mut self.contradictions[at];
                c.texels += 1;
                let [left, top, right, bottom] = c.bounds;
                c.bounds = [left.min(x), top.min(y), right.max(x), bottom.max(y)];
            }
        }
    }
}

/// Counts the keys of one row of texels, each at its place in the order of angles.
fn count(keys: &[&[u8]], counts: &mut [u8]) -> Wrong {
    let mut again = 0u8;
    for (key, coverage) in keys.iter().enumerate() {
        let key = key as u8;
        for (count, coverage) in counts.iter_mut().zip(*coverage) {
            let lit = u8::from(*coverage >= LIT);
            let follows = u8::from(*count == key);
            again |= lit & (1 - follows);
            *count += lit & follows;
        }
    }
    if again == 0 {
        return Wrong::new();
    }
    let mut wrong = Wrong::new();
    for (x, count) in counts.iter_mut().enumerate() {
        let lit = |k: usize| keys[k][x] >= LIT;
        let pairs: Vec<usize> = (0..keys.len() - 1).filter(|k| !lit(*k) && lit(k + 1)).collect();
        if pairs.is_empty() {
            continue;
        }
        // Dark keys below the count gainsay it, and lit ones from it on: the sum changes by one a step.
        let (mut sum, mut best) = (0i32, (0i32, 0u8));
        for k in 0..keys.len() {
            sum += if lit(k) { -1 } else { 1 };
            if sum < best.0 {
                best = (sum, k as u8 + 1);
            }
        }
        *count = best.1;
        wrong.push((x, pairs));
    }
    wrong
}

#[cfg(test)]
mod tests {
    use super::super::Mask;
    use super::*;

    /// A row of keys for every column: `1` lit, `0` dark.
    fn stack(columns: &[&str]) -> Stack {
        let keys = columns[0].len();
        let lit = |k: usize, x: u32| columns[x as usize].as_bytes()[k] == b'1';
        let masks: Vec<Mask> = (0..keys).map(|k| Mask::from_fn(columns.len() as u32, 1, |x, _| lit(k, x))).collect();
        let mut sources: Vec<Source> = masks.iter().map(Source::mask).collect();
        let angles: Vec<f32> = (0..keys).map(|k| k as f32 * 0.1).collect();
        Stack::read([columns.len() as u32, 1], &angles, &mut sources).expect("a stack")
    }

    #[test]
    fn nested_keys_are_counted() {
        let stack = stack(&["0000", "1000", "1100", "1110", "1111"]);
        assert_eq!(stack.counts, [0, 1, 2, 3, 4]);
        assert!(stack.contradictions.is_empty() && stack.wrong.is_empty());
    }

    #[test]
    fn contradictions_are_named_and_mended_with_the_fewest_changes() {
        // A speck of light, a speck of dark, one of each: of equals the darker.
        let stack = stack(&["1110", "0010", "1101", "1011", "0101", "1010"]);
        assert_eq!(stack.counts, [3, 0, 2, 4, 0, 1]);
        assert_eq!(stack.wrong, [1, 2, 3, 4, 5]);
        let found: Vec<_> = stack.contradictions.iter().map(|c| (c.dark_rad, c.texels, c.first, c.bounds)).collect();
        assert_eq!(
            found,
            [(0.0, 1, [4, 0], [4, 0, 4, 0]), (0.1, 3, [1, 0], [1, 0, 5, 0]), (0.2, 2, [2, 0], [2, 0, 4, 0])]
        );
    }
}
