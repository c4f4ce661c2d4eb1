//! Exact Euclidean distances in linear time: vertical distances first, then along each row the lower envelope of one
//! parabola a column (Meijster et al. 2000; Felzenszwalb and Huttenlocher 2012).
//!
//! Masks of a threshold map are nested, so that one number a texel says all: its level, the count of keys at which it is
//! lit. What stands between two keys needs the distances to the nearest lower and to the nearest higher level only.

use std::ops::Range;

use rayon::prelude::*;

use super::Mask;
use super::columns::{Columns, FAR, MAX_SIDE, Nearest, Sweep};

/// The distance where there is no such texel.
pub const NEVER: u32 = u32::MAX;

/// Squared distance from the centre of every texel to the centre of the nearest one that is lit (`to` true) or dark,
/// texels². [`NEVER`] where there is none. Nothing lies outside the mask.
///
/// # Panics
/// Where the mask holds another number of texels than its sides say, or a side is over [`MAX_SIDE`].
#[must_use]
pub fn distance_squared(mask: &Mask, to: bool) -> Vec<u32> {
    let (width, height) = (mask.width as usize, mask.height as usize);
    assert!(mask.coverage.len() == width * height, "a mask of {width} x {height} with {} texels", mask.coverage.len());
    assert!(mask.width.max(mask.height) <= MAX_SIDE, "a side is over {MAX_SIDE} texels");
    let levels: Vec<u8> = mask.lit().map(u8::from).collect();
    let mut squared = vec![0; levels.len()];
    let from = u8::from(!to);
    for_each_row(&levels, width, 2, &mut squared, |y, row, sweep, scratch, out| {
        let set = if to { &sweep.above[0] } else { &sweep.below[1] };
        for group in scratch.find_runs(row) {
            if scratch.runs(&group)[0].level == from {
                scratch.measure(&group, y, set);
                for run in scratch.runs(&group) {
                    out[run.start..run.end].copy_from_slice(&scratch.found.squared[run.start..run.end]);
                }
            }
        }
    });
    squared
}

/// Calls back for every row with its levels, the vertical distances at it, and its part of `out`, on all cores.
pub(super) fn for_each_row<T: Send>(
    levels: &[u8],
    width: usize,
    count: usize,
    out: &mut [T],
    each: impl Fn(i16, &[u8], &Sweep, &mut Scratch, &mut [T]) + Sync,
) {
    if levels.is_empty() {
        return;
    }
    let columns = Columns::new(levels, width);
    let height = levels.len() / width;
    // Each band looks up where it begins: few bands, but enough for uneven ones to even out.
    let rows = height.div_ceil(rayon::current_num_threads() * 4).max(32);
    out.par_chunks_mut(rows * width).zip(levels.par_chunks(rows * width)).enumerate().for_each(|(band, (out, own))| {
        let top = band * rows;
        let mut sweep = Sweep::new(&columns, count, top);
        let mut scratch = Scratch::new(width);
        for (y, (out, row)) in out.chunks_exact_mut(width).zip(own.chunks_exact(width)).enumerate() {
            if y > 0 {
                sweep.advance(&own[(y - 1) * width..y * width], row);
            }
            each((top + y) as i16, row, &sweep, &mut scratch, out);
        }
    });
}

/// Memory for one row at a time.
pub(super) struct Scratch {
    /// What was measured last.
    pub(super) found: Found,
    /// Room for what was measured before, and before that.
    pub(super) before: Found,
    pub(super) next_but_one: [Found; 2],
    vertical: Vec<i16>,
    /// Runs of the row: by level, then from the left.
    runs: Vec<Run>,
    /// Columns whose parabola is lowest somewhere: column, height plus square of the column, and where it begins to be.
    sites: Vec<(i32, i32, f64)>,
    /// 1 / (2 d): a multiplication is faster than a division, and a rounding error matters where two sites tie only.
    halves: Vec<f64>,
}

/// Distances of the texels of a row to a set.
pub(super) struct Found {
    /// Squared, texels²; [`NEVER`] for none.
    pub(super) squared: Vec<u32>,
    /// Columns of the texels at that distance.
    pub(super) nearest: Vec<u16>,
}

/// Texels of a row that have one level.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    pub(super) level: u8,
    pub(super) start: usize,
    /// The column after the last one.
    pub(super) end: usize,
}

impl Found {
    fn new(width: usize) -> Self {
        Self { squared: vec![NEVER; width], nearest: vec![0; width] }
    }
}

impl Scratch {
    fn new(width: usize) -> Self {
        Self {
            found: Found::new(width),
            before: Found::new(width),
            next_but_one: [Found::new(width), Found::new(width)],
            vertical: vec![0; width],
            runs: Vec::new(),
            sites: Vec::with_capacity(width),
            halves: (0..width).map(|d| 0.5 / (d as f64)).collect(),
        }
    }

    /// Splits a row into runs and gives, for each level in it, where its runs stand.
    pub(super) fn find_runs(&mut self, row: &[u8]) -> Vec<Range<usize>> {
        self.runs.clear();
        let mut start = 0;
        while let Some(&level) = row.get(start) {
            let mut end = start + 1;
            while row.get(end..end + 16).is_some_and(|block| block.iter().all(|l| *l == level)) {
                end += 16;
            }
            while row.get(end) == Some(&level) {
                end += 1;
            }
            self.runs.push(Run { level, start, end });
            start = end;
        }
        self.runs.sort_by_key(|r| r.level);
        let mut end = 0;
        let groups = self.runs.chunk_by(|a, b| a.level == b.level);
        groups
            .map(|group| {
                end += group.len();
                end - group.len()..end
            })
            .collect()
    }

    /// Runs of one level.
    pub(super) fn runs(&self, group: &Range<usize>) -> &[Run] {
        &self.runs[group.clone()]
    }

    /// Finds the distances of the texels of a group of runs to a set that they are not in.
    pub(super) fn measure(&mut self, group: &Range<usize>, y: i16, set: &Nearest) {
        // Columns that runs reach; runs whose columns overlap share one envelope, so that no column is visited twice.
        let (mut first, mut columns) = (group.start, 0..0);
        for index in group.clone() {
            let reach = self.reach(self.runs[index], y, set);
            if reach.start < columns.end {
                columns = columns.start.min(reach.start)..columns.end.max(reach.end);
            } else {
                self.envelope(columns, first..index, y, set);
                (first, columns) = (index, reach);
            }
        }
        self.envelope(columns, first..group.end, y, set);
    }

    /// First and last column in which the nearest texel of the set can be, for any texel of a run: not farther than the
    /// nearest in the own column, nor than the run's ends where the set begins there.
    fn reach(&self, run: Run, y: i16, set: &Nearest) -> Range<usize> {
        let width = self.vertical.len();
        let in_set = |x: usize| set.distance(x, y) == 0;
        let left = if run.start > 0 && in_set(run.start - 1) {
            run.start as i16 - 1
        } else {
            -FAR
        };
        let right = if run.end < width && in_set(run.end) {
            run.end as i16
        } else {
            i16::MAX
        };
        let (mut low, mut high) = (i16::MAX, 0i16);
        let texels = run.start..run.end;
        for (i, (last, next)) in set.last[texels.clone()].iter().zip(&set.next[texels]).enumerate() {
            let x = (run.start + i) as i16;
            let vertical = (y - last).min(next - y).clamp(0, FAR - 1);
            let bound = vertical.min(x.saturating_sub(left)).min(right - x);
            (low, high) = (low.min(x - bound), high.max(x.saturating_add(bound)));
        }
        low.max(0) as usize..(high as usize + 1).min(width)
    }

    /// Lower envelope over some columns, read off at runs that stand in them.
    fn envelope(&mut self, columns: Range<usize>, runs: Range<usize>, y: i16, set: &Nearest) {
        let Self { found: Found { squared, nearest }, vertical, runs: all, sites, halves, .. } = self;
        let both = set.last[columns.clone()].iter().zip(&set.next[columns.clone()]);
        for (v, (last, next)) in vertical[columns.clone()].iter_mut().zip(both) {
            *v = (y - last).min(next - y).clamp(0, FAR);
        }
        sites.clear();
        for (x, v) in columns.clone().zip(&vertical[columns]).filter(|(_, v)| **v < FAR) {
            let (x, v) = (x as i32, i32::from(*v));
            let height = v * v + x * x;
            let start = loop {
                let Some(&(site, lower, start)) = sites.last() else { break f64::NEG_INFINITY };
                // Where the new parabola begins to lie below the last one.
                let crossing = f64::from(height - lower) * halves[(x - site) as usize];
                if crossing > start {
                    break crossing;
                }
                sites.pop();
            };
            sites.push((x, height, start));
        }
        let mut at = 0;
        for run in &all[runs] {
            let mut x = run.start;
            while x < run.end {
                while sites.get(at + 1).is_some_and(|s| s.2 < x as f64) {
                    at += 1;
                }
                let Some(&(site, height, _)) = sites.get(at) else {
                    squared[x..run.end].fill(NEVER);
                    break;
                };
                let until = sites.get(at + 1).map_or(run.end, |next| (next.2 as usize + 1).clamp(x + 1, run.end));
                nearest[x..until].fill(site as u16);
                let vertical = height - site * site;
                for (p, out) in (x as i32..).zip(&mut squared[x..until]) {
                    *out = ((p - site) * (p - site) + vertical) as u32;
                }
                x = until;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn brute(mask: &Mask, to: bool) -> Vec<u32> {
        let lit: Vec<bool> = mask.lit().collect();
        let places = |i: usize| (i as i64 % i64::from(mask.width), i as i64 / i64::from(mask.width));
        (0..lit.len())
            .map(|i| {
                let (x, y) = places(i);
                let found = (0..lit.len()).filter(|j| lit[*j] == to).map(places);
                found.map(|(a, b)| ((a - x).pow(2) + (b - y).pow(2)) as u32).min().unwrap_or(NEVER)
            })
            .collect()
    }

    fn check(mask: &Mask) {
        for to in [false, true] {
            assert_eq!(distance_squared(mask, to), brute(mask, to), "{mask:?}");
        }
    }

    #[test]
    fn hard_shapes_match_brute_force() {
        for (w, h) in [(1, 1), (1, 9), (9, 1), (1, 80), (2, 2), (13, 7), (16, 16), (40, 70)] {
            check(&Mask::from_fn(w, h, |_, _| true));
            check(&Mask::from_fn(w, h, |_, _| false));
            check(&Mask::from_fn(w, h, |x, y| (x + y) % 2 == 0));
            check(&Mask::from_fn(w, h, |x, y| x == w / 2 && y == h / 2));
            check(&Mask::from_fn(w, h, |x, y| x != 0 || y != h - 1));
            check(&Mask::from_fn(w, h, |_, y| y == h / 2));
            check(&Mask::from_fn(w, h, |x, _| x == w - 1));
            check(&Mask::from_fn(w, h, |x, y| 3 * x > 2 * y + 5));
        }
        assert!(distance_squared(&Mask::default(), true).is_empty());
    }

    proptest! {
        #[test]
        fn random_masks_match_brute_force(w in 1u32..40, h in 1u32..90, bits in prop::collection::vec(0u8..100, 3600), share in 0u8..=100) {
            check(&Mask::from_fn(w, h, |x, y| bits[(y * 40 + x) as usize] < share));
        }

        /// Levels as nested keys have them, against one mask for every set.
        #[test]
        fn sets_of_all_levels_match_brute_force(w in 1usize..24, h in 1usize..80, noise in prop::collection::vec(0u8..5, 1920)) {
            let levels: Vec<u8> = noise[..w * h].to_vec();
            for level in 0..5u8 {
                for above in [false, true] {
                    let mut found = vec![0; w * h];
                    for_each_row(&levels, w, 5, &mut found, |y, row, sweep, scratch, out| {
                        let set = if above { &sweep.above } else { &sweep.below };
                        for group in scratch.find_runs(row) {
                            if scratch.runs(&group)[0].level == level {
                                scratch.measure(&group, y, &set[usize::from(level)]);
                                for run in scratch.runs(&group) {
                                    out[run.start..run.end].copy_from_slice(&scratch.found.squared[run.start..run.end]);
                                }
                            }
                        }
                    });
                    let in_set = |l: u8| if above { l > level } else { l < level };
                    let mask = Mask::from_fn(w as u32, h as u32, |x, y| in_set(levels[y as usize * w + x as usize]));
                    let expected = brute(&mask, true);
                    for i in (0..w * h).filter(|i| levels[*i] == level) {
                        prop_assert_eq!(found[i], expected[i], "level {} above {} at {}", level, above, i);
                    }
                }
            }
        }
    }
}
