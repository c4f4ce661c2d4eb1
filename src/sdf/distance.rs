//! Exact Euclidean distances in linear time (Felzenszwalb and Huttenlocher 2012; Meijster et al. 2000).

use rayon::prelude::*;

use super::Mask;

/// The distance where there is no such texel.
pub const NEVER: u32 = u32::MAX;

/// Squared distance from the centre of every texel to the centre of the nearest one that is lit (`to` true) or dark,
/// texels². [`NEVER`] where there is none. Nothing lies outside the mask.
///
/// # Panics
/// Where the mask holds another number of texels than its sides say, or a side is over 32768.
#[must_use]
pub fn distance_squared(mask: &Mask, to: bool) -> Vec<u32> {
    let (width, height) = (mask.width as usize, mask.height as usize);
    assert!(mask.lit.len() == width * height, "a mask of {width} x {height} with {} texels", mask.lit.len());
    assert!(width.max(height) <= 1 << 15, "squared distances would not fit 32 bits");
    let columns = along_columns(mask, to);
    let mut squared = vec![NEVER; columns.len()];
    squared.par_chunks_mut(width.max(1)).zip(columns.par_chunks(width.max(1))).for_each_init(
        || Envelope { sites: Vec::with_capacity(width), starts: Vec::with_capacity(width) },
        |envelope, (out, column)| envelope.row(column, out),
    );
    squared
}

/// Distance to the nearest such texel of the same column; [`NEVER`] where there is none.
fn along_columns(mask: &Mask, to: bool) -> Vec<u32> {
    let width = mask.width as usize;
    let mut down = vec![NEVER; mask.lit.len()];
    let next = |of: u32| if of == NEVER { NEVER } else { of + 1 };
    for i in 0..down.len() {
        down[i] = if mask.lit[i] == to {
            0
        } else if i >= width {
            next(down[i - width])
        } else {
            NEVER
        };
    }
    for i in (0..down.len().saturating_sub(width)).rev() {
        down[i] = down[i].min(next(down[i + width]));
    }
    down
}

/// Lower envelope of parabolas over one row.
struct Envelope {
    /// Columns whose parabola is lowest somewhere, from the left.
    sites: Vec<usize>,
    /// First column at which each of them is.
    starts: Vec<i64>,
}

impl Envelope {
    fn row(&mut self, column: &[u32], out: &mut [u32]) {
        let Self { sites, starts } = self;
        sites.clear();
        starts.clear();
        let height = |q: usize| i64::from(column[q]) * i64::from(column[q]);
        for q in (0..column.len()).filter(|q| column[*q] != NEVER) {
            let start = loop {
                let Some(&last) = sites.last() else { break 0 };
                // The first whole column at which the new parabola lies below the last one.
                let (a, b) = (last as i64, q as i64);
                let crossing = (height(q) - height(last) + b * b - a * a).div_euclid(2 * (b - a)) + 1;
                if crossing > starts[starts.len() - 1] {
                    break crossing;
                }
                sites.pop();
                starts.pop();
            };
            if start < column.len() as i64 {
                sites.push(q);
                starts.push(start.max(0));
            }
        }
        let mut k = 0;
        for (p, out) in out.iter_mut().enumerate() {
            while k + 1 < sites.len() && starts[k + 1] <= p as i64 {
                k += 1;
            }
            if let Some(&site) = sites.get(k) {
                let across = p.abs_diff(site) as i64;
                *out = (across * across + height(site)) as u32;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn brute(mask: &Mask, to: bool) -> Vec<u32> {
        let places = |i: usize| (i as i64 % i64::from(mask.width), i as i64 / i64::from(mask.width));
        (0..mask.lit.len())
            .map(|i| {
                let (x, y) = places(i);
                let found = (0..mask.lit.len()).filter(|j| mask.lit[*j] == to).map(places);
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
        for (w, h) in [(1, 1), (1, 9), (9, 1), (2, 2), (13, 7), (16, 16)] {
            check(&Mask::from_fn(w, h, |_, _| true));
            check(&Mask::from_fn(w, h, |_, _| false));
            check(&Mask::from_fn(w, h, |x, y| (x + y) % 2 == 0));
            check(&Mask::from_fn(w, h, |x, y| x == w / 2 && y == h / 2));
            check(&Mask::from_fn(w, h, |_, y| y == h / 2));
            check(&Mask::from_fn(w, h, |x, _| x == w - 1));
        }
        assert!(distance_squared(&Mask::default(), true).is_empty());
    }

    proptest! {
        #[test]
        fn random_masks_match_brute_force(w in 1u32..20, h in 1u32..20, bits in prop::collection::vec(0u8..8, 400), share in 0u8..8) {
            check(&Mask::from_fn(w, h, |x, y| bits[(y * 20 + x) as usize] < share));
        }
    }
}
