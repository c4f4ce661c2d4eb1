//! Keys to a threshold map.

use std::f64::consts::PI;
use std::sync::atomic::{AtomicU32, Ordering};

use super::band::{Band, bands, bayer, distance, zero_of_cubic};
use super::border::{Around, HALF};
use super::columns::Nearest;
use super::distance::{Found, Scratch, for_each_row};
use super::source::Source;
use super::stack::{Contradiction, Stack};
use super::{Mask, Profile};
use crate::{Error, Result};

/// What is lit at one angle of the light.
#[derive(Clone, Debug, PartialEq)]
pub struct Key {
    /// Angle between the light and the front of the face, about its up axis, radians. Range 0..=π.
    pub angle_rad: f32,
    /// The lit part.
    pub mask: Mask,
}

/// How keys become a map.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BakeOptions {
    /// What the consumer compares the map with. Default: linear.
    pub profile: Profile,
    /// Bits of a value. Default: 16.
    pub depth: Depth,
    /// With 8 bits, spreads the rounding over an ordered pattern of 8 x 8 texels: errors of up to a code instead of half
    /// a code, but no steps. Default: false.
    pub dither: bool,
    /// How the border moves through a key. Default: linear.
    pub blend: Blend,
    /// Where keys contradict each other, takes what the fewest of them gainsay instead of failing. Default: false.
    pub repair: bool,
}

/// How the border moves through a key.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Blend {
    /// At even speed between two keys, so that its speed changes at once at a key.
    #[default]
    Linear,
    /// Without a change of speed at a key: the distances to the borders of four keys are laid through by a monotone cubic
    /// (Fritsch and Butland 1984) over the thresholds. About three times the time.
    Smooth,
}

/// Bits of a value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Depth {
    /// 0..=255.
    Eight,
    /// 0..=65535.
    #[default]
    Sixteen,
}

impl Depth {
    /// The greatest code.
    #[must_use]
    pub const fn max(self) -> u16 {
        match self {
            Self::Eight => 255,
            Self::Sixteen => u16::MAX,
        }
    }
}

/// For every texel the angle of the light at which it turns dark.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ThresholdMap {
    /// Width, texels.
    pub width: u32,
    /// Height, texels.
    pub height: u32,
    /// Thresholds in codes of 0 to [`Depth::max`], rows from the top: lit while greater than that of the light. The
    /// lowest is never lit, the greatest always; in between, a texel is never nearer than a quarter of a code to the
    /// threshold of a key.
    pub codes: Vec<u16>,
    /// Bits of a code.
    pub depth: Depth,
    /// Measure of the thresholds.
    pub profile: Profile,
}

/// A map, and what is wrong with its keys.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Baked {
    /// The map.
    pub map: ThresholdMap,
    /// Contradictions between keys, which have been repaired.
    pub contradictions: Vec<Contradiction>,
    /// Texels that they concern, as indices in reading order.
    pub wrong: Vec<u32>,
}

/// Finds the threshold of every texel.
///
/// Between two keys it is divided by the distances to their borders (half a texel from the centres on either side; where
/// grey texels lie along a border, they say where it runs), so that each key comes back exactly when the map is cut at its angle. Where the first of two keys has no border, what is
/// farthest from the second one goes first; where the second is empty, what is deepest goes last.
///
/// # Errors
/// [`Error::Argument`] for fewer than two keys, angles that are out of range or do not grow, masks of other sizes than
/// the first or over [`MAX_SIDE`](super::MAX_SIDE), keys that are too close for the bits of a code, and, without
/// [`repair`](BakeOptions::repair), texels that light up again: one number can hold one border only. The message names
/// the place.
pub fn bake(keys: &[Key], options: &BakeOptions) -> Result<Baked> {
    for Mask { width, height, coverage } in keys.iter().map(|k| &k.mask) {
        if coverage.len() as u64 != u64::from(*width) * u64::from(*height) {
            return Err(fault(format!("have a mask of {width} x {height} with {} texels", coverage.len())));
        }
    }
    let angles: Vec<f32> = keys.iter().map(|k| k.angle_rad).collect();
    bake_sources(&angles, &mut keys.iter().map(|k| Source::mask(&k.mask)).collect::<Vec<_>>(), options)
}

/// The same for keys that are read row by row.
pub(super) fn bake_sources(angles_rad: &[f32], sources: &mut [Source], options: &BakeOptions) -> Result<Baked> {
    check(angles_rad, sources)?;
    options.profile.check()?;
    let bands = bands(angles_rad, options)?;
    let mut stack = Stack::read(sources[0].size, angles_rad, sources)?;
    check_nested(&stack, options)?;
    let mut codes = vec![0u16; stack.counts.len()];
    find_codes(&stack, &bands, options, &[true; 256], &mut codes);
    Ok(Baked {
        map: ThresholdMap {
            width: stack.width as u32,
            height: stack.height as u32,
            codes,
            depth: options.depth,
            profile: options.profile.clone(),
        },
        contradictions: std::mem::take(&mut stack.contradictions),
        wrong: std::mem::take(&mut stack.wrong),
    })
}

pub(super) fn fault(message: impl Into<String>) -> Error {
    Error::Argument { what: "keys of a threshold map".into(), message: message.into() }
}

/// Refuses keys that contradict each other, unless they are to be repaired.
pub(super) fn check_nested(stack: &Stack, options: &BakeOptions) -> Result<()> {
    let (Some(c), false) = (stack.contradictions.first(), options.repair) else { return Ok(()) };
    let texels: usize = stack.contradictions.iter().map(|c| c.texels).sum();
    let [from, to] = [c.dark_rad, c.lit_rad].map(degrees);
    Err(fault(format!(
        "light up again: {texels} texels, between {from} and {to} degrees {} of them, first at {}, {}; expected lit parts \
         that only shrink, or a repair (--repair)",
        c.texels, c.first[0], c.first[1]
    )))
}

/// For messages.
pub(super) fn degrees(angle_rad: f32) -> f32 {
    (angle_rad.to_degrees() * 1000.0).round() / 1000.0
}

fn check(angles_rad: &[f32], sources: &[Source]) -> Result<()> {
    if sources.len() < 2 {
        return Err(fault("are fewer than two"));
    }
    for angle in angles_rad {
        // The angle 180 degrees may be rounded up on its way to radians.
        if !(0.0..=PI + 1e-6).contains(&f64::from(*angle)) {
            return Err(fault(format!("have the angle {} degrees; expected 0 to 180", degrees(*angle))));
        }
    }
    for pair in angles_rad.windows(2) {
        let [a, b] = [pair[0], pair[1]].map(degrees);
        if a >= b {
            return Err(fault(format!("stand at {a} and then at {b} degrees; expected growing angles")));
        }
    }
    let first = sources[0].size;
    if let Some(other) = sources.iter().map(|s| s.size).find(|s| *s != first) {
        let [[w, h], [v, g]] = [first, other];
        return Err(fault(format!("have masks of {w} x {h} and {v} x {g}; expected one size")));
    }
    Ok(())
}

/// Finds the codes of the texels of all wanted levels.
pub(super) fn find_codes(
    stack: &Stack,
    bands: &[Band],
    options: &BakeOptions,
    wanted: &[bool; 256],
    codes: &mut [u16],
) {
    let keys = bands.len() + 1;
    let seen = seen(&stack.counts);
    let (lowest, highest) = (seen.iter().position(|s| *s).unwrap_or(0), seen.iter().rposition(|s| *s).unwrap_or(0));
    let deepest = Deepest::of(stack, keys, lowest, highest);
    let smooth = options.blend == Blend::Smooth;
    for_each_row(&stack.counts, stack.width, keys + 1, codes, |y, row, sweep, scratch, out| {
        for group in scratch.find_runs(row) {
            let level = usize::from(scratch.runs(&group)[0].level);
            if !wanted[level] {
                continue;
            }
            if level == 0 || level == keys {
                let code = if level == 0 { 0 } else { options.depth.max() };
                scratch.runs(&group).iter().for_each(|run| out[run.start..run.end].fill(code));
                continue;
            }
            if level > lowest {
                scratch.measure(&group, y, &sweep.below[level]);
            }
            std::mem::swap(&mut scratch.found, &mut scratch.before);
            // The keys before and after: those sets are there where a level lies beyond them.
            let (before, after) = (smooth && level > lowest + 1, smooth && level + 1 < highest);
            if before {
                scratch.measure(&group, y, &sweep.below[level - 1]);
                let Scratch { found, next_but_one: [before, _], .. } = scratch;
                std::mem::swap(found, before);
            }
            if after {
                scratch.measure(&group, y, &sweep.above[level + 1]);
                let Scratch { found, next_but_one: [_, after], .. } = scratch;
                std::mem::swap(found, after);
            }
            if level < highest {
                scratch.measure(&group, y, &sweep.above[level]);
            }
            let band = &bands[level - 1];
            let is_hard = stack.borders[level - 1].is_none() && stack.borders[level].is_none();
            let dithers = options.dither && options.depth == Depth::Eight;
            let shift = |x: usize| if dithers { bayer(x, y) } else { 0.0 };
            for run in scratch.runs(&group) {
                let texels = run.start..run.end;
                let both = level > lowest && level < highest;
                let plain = both && is_hard && !dithers && !smooth;
                if plain {
                    let (inside, outside) =
                        (&scratch.before.squared[texels.clone()], &scratch.found.squared[texels.clone()]);
                    band.between(inside, outside, &mut out[texels]);
                    continue;
                }
                let border = |key: usize| stack.borders.get(key).and_then(|b| b.as_ref()).map(Around::new);
                let (mut inner, mut outer) = (border(level - 1), border(level));
                let (mut far, mut beyond) = (border(level.wrapping_sub(2)), border(level + 1));
                let mut inside = |x: usize| to_border(&scratch.before, x, y, &sweep.below[level], &mut inner);
                let mut outside = |x: usize| to_border(&scratch.found, x, y, &sweep.above[level], &mut outer);
                for x in texels {
                    let share = match (level > lowest, level < highest) {
                        (true, true) if smooth => {
                            let [first, last] = &scratch.next_but_one;
                            let far = before.then(|| {
                                let inside = to_border(first, x, y, &sweep.below[level - 1], &mut far);
                                (bands[level - 2].from, inside)
                            });
                            let beyond = after.then(|| {
                                let outside = to_border(last, x, y, &sweep.above[level + 1], &mut beyond);
                                (bands[level].to, -outside)
                            });
                            zero_of_cubic(far, (band.from, inside(x)), (band.to, -outside(x)), beyond)
                        }
                        (true, true) => {
                            let inside = inside(x);
                            inside / (inside + outside(x))
                        }
                        (true, false) => inside(x) / deepest.inside,
                        (false, true) => 1.0 - outside(x) / deepest.outside,
                        (false, false) => 0.5,
                    };
                    out[x] = band.code(share, shift(x));
                }
            }
        }
    });
}

/// Distance from a texel to the border beyond it, which runs half a texel before the nearest centre or where an
/// antialiased border says.
fn to_border(found: &Found, x: usize, y: i16, set: &Nearest, border: &mut Option<Around>) -> f64 {
    let Some(border) = border else { return distance(found.squared[x]) };
    let nearest = usize::from(found.nearest[x]);
    border.distance([x, y as usize], [nearest, set.row(nearest, y)])
}

fn seen(counts: &[u8]) -> [bool; 256] {
    let mut seen = [false; 256];
    counts.iter().for_each(|c| seen[usize::from(*c)] = true);
    seen
}

/// Distances of what is farthest from the only border that its band has, and half a texel more.
struct Deepest {
    inside: f64,
    outside: f64,
}

impl Deepest {
    fn of(stack: &Stack, keys: usize, lowest: usize, highest: usize) -> Self {
        let greatest = [AtomicU32::new(0), AtomicU32::new(0)];
        // Only where all texels are lit at a key, or all dark.
        if lowest > 0 || highest < keys {
            let mut nothing = vec![(); stack.counts.len()];
            for_each_row(&stack.counts, stack.width, keys + 1, &mut nothing, |y, row, sweep, scratch, _| {
                for group in scratch.find_runs(row) {
                    let level = usize::from(scratch.runs(&group)[0].level);
                    let (side, set) = match level {
                        _ if level == 0 || level == keys || lowest == highest => continue,
                        _ if level == highest => (0, &sweep.below[level]),
                        _ if level == lowest => (1, &sweep.above[level]),
                        _ => continue,
                    };
                    scratch.measure(&group, y, set);
                    let found = scratch.runs(&group).iter().flat_map(|r| &scratch.found.squared[r.start..r.end]).max();
                    greatest[side].fetch_max(found.copied().unwrap_or(0), Ordering::Relaxed);
                }
            });
        }
        let [inside, outside] = greatest.map(|g| distance(g.into_inner()) + f64::from(HALF));
        Self { inside, outside }
    }
}

impl ThresholdMap {
    /// Threshold of a texel, 0..=1.
    #[must_use]
    pub fn value(&self, texel: usize) -> f64 {
        f64::from(self.codes[texel]) / f64::from(self.depth.max())
    }

    /// What is lit at an angle of the light, radians.
    #[must_use]
    pub fn mask(&self, angle_rad: f32) -> Mask {
        let max = self.depth.max();
        let threshold = self.profile.threshold(f64::from(angle_rad)) * f64::from(max);
        let lit = |code: &u16| *code == max || *code > 0 && f64::from(*code) > threshold;
        let coverage = self.codes.iter().map(|code| if lit(code) { 255 } else { 0 }).collect();
        Mask { width: self.width, height: self.height, coverage }
    }
}

#[cfg(test)]
mod tests {
    use std::f32::consts::PI;

    use proptest::prelude::*;

    use super::super::{NEVER, distance_squared};
    use super::*;

    /// A border that moves from left to right, with a bump.
    fn keys() -> Vec<Key> {
        (0..=6)
            .map(|k| {
                let edge = |y: u32| f64::from(k) * 8.0 - 4.0 + 3.0 * (f64::from(y) * 0.3).sin();
                let mask = Mask::from_fn(40, 24, |x, y| f64::from(x) >= edge(y) && k < 6);
                Key { angle_rad: PI * k as f32 / 6.0, mask }
            })
            .collect()
    }

    fn map(keys: &[Key], options: &BakeOptions) -> ThresholdMap {
        bake(keys, options).expect("nested keys").map
    }

    /// Every mixture of bits and dither.
    fn depths() -> [BakeOptions; 3] {
        let eight = BakeOptions { depth: Depth::Eight, ..BakeOptions::default() };
        [BakeOptions::default(), eight.clone(), BakeOptions { dither: true, ..eight }]
    }

    /// The blend in double precision from distances of single masks, in codes; the least and greatest code allowed.
    fn blend(keys: &[Key], options: &BakeOptions) -> Vec<f64> {
        let max = f64::from(options.depth.max());
        let mut out = vec![0.0; keys[0].mask.coverage.len()];
        let lit: Vec<Vec<bool>> = keys.iter().map(|k| k.mask.lit().collect()).collect();
        for k in 1..keys.len() {
            let (to_dark, to_lit) = (distance_squared(&keys[k - 1].mask, false), distance_squared(&keys[k].mask, true));
            let t = |k: usize| options.profile.threshold(f64::from(keys[k].angle_rad)) * max;
            let band: Vec<usize> = (0..out.len()).filter(|i| lit[k - 1][*i] && !lit[k][*i]).collect();
            let deepest = |d: &[u32]| band.iter().map(|i| f64::from(d[*i]).sqrt()).fold(0.0, f64::max);
            for &i in &band {
                let share = match (to_dark[i], to_lit[i]) {
                    (NEVER, NEVER) => 0.5,
                    (NEVER, b) => 1.0 - distance(b) / deepest(&to_lit),
                    (a, NEVER) => distance(a) / deepest(&to_dark),
                    (a, b) => distance(a) / (distance(a) + distance(b)),
                };
                out[i] = t(k - 1) + (t(k) - t(k - 1)) * share;
            }
        }
        for (out, _) in out.iter_mut().zip(&lit[keys.len() - 1]).filter(|(_, lit)| **lit) {
            *out = max;
        }
        out
    }

    fn check(keys: &[Key], options: &BakeOptions) {
        let map = map(keys, options);
        for key in keys {
            assert!(map.mask(key.angle_rad) == key.mask, "{} rad, {options:?}", key.angle_rad);
        }
        for (i, exact) in blend(keys, options).into_iter().enumerate() {
            let code = f64::from(map.codes[i]);
            // Where the nearest code ties with a key, the next one stands.
            let key = |k: &Key| options.profile.threshold(f64::from(k.angle_rad)) * f64::from(options.depth.max());
            let ends = keys.iter().any(|k| (exact.round() - key(k)).abs() < 0.25 || (exact - key(k)).abs() < 0.5);
            let bound = if options.dither || ends { 1.0 } else { 0.5 };
            assert!((code - exact).abs() <= bound + 1e-9, "texel {i}: {code} for {exact}, {options:?}");
        }
    }

    #[test]
    fn keys_come_back_and_codes_are_those_of_the_exact_blend() {
        for options in depths() {
            check(&keys(), &options);
            check(&keys(), &BakeOptions { profile: Profile::Genshin, ..options.clone() });
            let points = vec![[0.0, 0.0], [40.0, 0.4], [180.0, 1.0]];
            check(&keys(), &BakeOptions { profile: Profile::Points(points), ..options });
        }
    }

    #[test]
    fn ends_without_a_border_grow() {
        let full = Key { angle_rad: 0.0, mask: Mask::from_fn(40, 24, |_, _| true) };
        let mut ends = keys()[1..].to_vec();
        ends.insert(0, full.clone());
        for options in depths() {
            check(&ends, &options);
            check(&[full.clone(), keys()[6].clone()], &options);
        }
        // Grows from the farthest corner on: texels farther from the second key's light turn dark no later.
        let map = map(&ends, &BakeOptions::default());
        let row: Vec<u16> = (0..4).map(|x| map.codes[x]).collect();
        assert!(row.is_sorted() && row[0] < row[3], "{row:?}");
    }

    #[test]
    fn the_lit_part_only_shrinks() {
        for options in depths() {
            let map = map(&keys(), &options);
            for step in 0..180 {
                let [now, next] = [step, step + 1].map(|d| map.mask((d as f32).to_radians()));
                assert!(now.lit().zip(next.lit()).all(|(a, b)| a || !b), "at {step} degrees");
            }
        }
    }

    /// lilToon tells angles of 60 to 120 degrees apart: what the keys draw there comes back, the rest is before or after.
    #[test]
    fn keys_beyond_a_profile_are_held_at_its_ends() {
        let options = BakeOptions { profile: Profile::Liltoon, ..BakeOptions::default() };
        let (keys, map) = (keys(), map(&keys(), &options));
        for key in &keys[3..4] {
            assert!(map.mask(key.angle_rad) == key.mask);
        }
        let value = |x: usize| map.codes[12 * 40 + x];
        assert_eq!((value(6), value(39)), (1, 65534));
    }

    #[test]
    fn dither_keeps_the_mean() {
        let ramp = |k: u32| Mask::from_fn(512, 64, |x, _| k == 0 || k == 1 && x > 510);
        let keys = [(0.0, 0), (PI / 60.0, 1)].map(|(angle_rad, k)| Key { angle_rad, mask: ramp(k) });
        let [_, plain, dithered] = depths().map(|options| map(&keys, &options).codes);
        let exact = blend(&keys, &depths()[1]);
        let off = |codes: &[u16]| {
            let block = |x: usize| (0..64).map(move |i| (i / 8) * 512 + x + i % 8);
            let mean = |x: usize| block(x).map(|i| f64::from(codes[i]) - exact[i]).sum::<f64>().abs() / 64.0;
            (152..360).step_by(8).map(mean).fold(0.0, f64::max)
        };
        assert!(off(&dithered) < 0.05 && off(&plain) > 0.3, "{} and {}", off(&dithered), off(&plain));
    }

    #[test]
    fn faults_name_place_and_reason() {
        let message = |keys: &[Key]| bake(keys, &BakeOptions::default()).map(|_| ()).unwrap_err().to_string();
        let good = keys();
        assert!(message(&good[..1]).contains("fewer than two"));
        let mut wrong = good.clone();
        wrong[2].angle_rad = f32::NAN;
        assert!(message(&wrong).contains("NaN"));
        wrong[2].angle_rad = 0.1;
        assert!(message(&wrong).contains("growing"));
        let mut wrong = good.clone();
        wrong[3].mask.coverage[5] = 255;
        assert!(
            message(&wrong).contains("1 texels, between 60 and 90 degrees 1 of them, first at 5, 0"),
            "{}",
            message(&wrong)
        );
        let repaired = bake(&wrong, &BakeOptions { repair: true, ..BakeOptions::default() }).expect("repaired");
        assert_eq!((repaired.map, repaired.wrong), (map(&good, &BakeOptions::default()), vec![5]));
        wrong[3].mask = Mask::from_fn(3, 3, |_, _| false);
        assert!(message(&wrong).contains("3 x 3"));
        let close = [0.0, 0.002, 0.004].map(|angle_rad| Key { angle_rad, mask: Mask::from_fn(4, 4, |_, _| false) });
        let options = BakeOptions { depth: Depth::Eight, ..BakeOptions::default() };
        let fault = bake(&close, &options).unwrap_err().to_string();
        assert!(fault.contains("too close for 8 bits") && bake(&close, &BakeOptions::default()).is_ok(), "{fault}");
    }

    #[test]
    fn a_smooth_blend_keeps_its_speed_at_keys() {
        // A border that hurries between two keys: 100, 300 and 100 texels.
        let at = [40u32, 140, 440, 540];
        let keys: Vec<Key> = (0..4)
            .map(|k| Key { angle_rad: 0.5 + k as f32 * 0.6, mask: Mask::from_fn(600, 3, |x, _| x >= at[k as usize]) })
            .collect();
        let speed_ratio = |blend: Blend| {
            let map = map(&keys, &BakeOptions { blend, ..BakeOptions::default() });
            for key in &keys {
                assert!(map.mask(key.angle_rad) == key.mask, "{blend:?}");
            }
            // Codes that a texel takes, on both sides of the second key.
            let step = |x: usize| f64::from(map.codes[x + 1]) - f64::from(map.codes[x]);
            step(138) / step(140)
        };
        let [linear, smooth] = [Blend::Linear, Blend::Smooth].map(speed_ratio);
        assert!((linear - 3.0).abs() < 0.1 && (smooth - 1.0).abs() < 0.1, "{linear} and {smooth}");
    }

    /// Two circles: the border between them is a circle, too.
    #[test]
    fn grey_edges_place_borders_within_the_texel() {
        let size = 96u32;
        let disc = |radius: f64, smooth: bool| {
            let coverage = |i: u32| {
                let (x, y) = (f64::from(i % size), f64::from(i / size));
                let inside = |s: u32| {
                    let (u, v) = (f64::from(s % 16) + 0.5, f64::from(s / 16) + 0.5);
                    (x + u / 16.0 - 48.2).hypot(y + v / 16.0 - 47.7) < radius
                };
                let share = (0..256).filter(|s| inside(*s)).count();
                if smooth {
                    (share * 255 / 256) as u8
                } else {
                    255 * u8::from(share >= 128)
                }
            };
            Mask { width: size, height: size, coverage: (0..size * size).map(coverage).collect() }
        };
        let mean_error = |smooth: bool| {
            let keys = [(0.3, 40.3), (1.3, 24.9)].map(|(angle_rad, r)| Key { angle_rad, mask: disc(r, smooth) });
            let map = map(&keys, &BakeOptions::default());
            for key in &keys {
                assert!(map.mask(key.angle_rad).lit().eq(key.mask.lit()), "{smooth}");
            }
            let errors = (0..map.codes.len()).filter_map(|i| {
                let (x, y) = ((i as u32 % size) as f64 + 0.5, (i as u32 / size) as f64 + 0.5);
                let radius = (x - 48.2).hypot(y - 47.7);
                let exact = (40.3 - radius) / (40.3 - 24.9);
                let found = (map.value(i) * std::f64::consts::PI - 0.3) / 1.0;
                // In texels of the border's way.
                (0.0..1.0).contains(&exact).then_some((found - exact).abs() * (40.3 - 24.9))
            });
            let (sum, count) = errors.fold((0.0, 0), |(sum, count), e| (sum + e, count + 1));
            sum / f64::from(count)
        };
        let [hard, smooth] = [false, true].map(mean_error);
        assert!(smooth < 0.04 && smooth * 3.0 < hard, "{smooth} and {hard} texels");
    }

    proptest! {
        /// Nested keys of any shape, among them empty, full and equal ones.
        #[test]
        fn any_nested_keys_come_back(w in 1u32..24, h in 1u32..40, noise in prop::collection::vec(0usize..9, 960), count in 2usize..8, coarse in 1u32..6) {
            let level = |x: u32, y: u32| noise[((y / coarse) * 24 + x / coarse) as usize];
            let keys: Vec<Key> = (0..count)
                .map(|k| Key { angle_rad: 0.05 + k as f32 * 0.4, mask: Mask::from_fn(w, h, |x, y| level(x, y) > k) })
                .collect();
            for options in depths() {
                check(&keys, &options);
            }
        }
    }
}
