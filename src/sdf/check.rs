//! What will look wrong in a finished map, though it is well-formed.

use super::{BakedSides, Depth, Mask, Project, ProjectKey, ThresholdMap};
use crate::Result;

/// A remark on keys or a map.
#[derive(Clone, Debug, PartialEq)]
pub struct Remark {
    /// Whether it spoils the map: keys that contradict each other.
    pub is_fault: bool,
    /// Place, what was found, and the remedy.
    pub message: String,
}

/// Least codes between two keys: with fewer, the border moves in visible steps.
const FEWEST_CODES: f64 = 8.0;
/// Largest part of a map that may turn dark within a degree, beyond which it is seen as a jump.
const LARGEST_STEP: f64 = 0.05;
/// Texels that may differ between the sides at a seam, as a part of the map.
const SEAM: f64 = 0.001;

/// Checks a project and what it was baked to.
///
/// # Errors
/// Those of the drawings.
pub fn check(project: &Project, baked: &BakedSides) -> Result<Vec<Remark>> {
    let mut remarks = Vec::new();
    let sides = [Some(("left", &baked.left)), baked.right.as_ref().map(|r| ("right", r))];
    for (name, side) in sides.into_iter().flatten() {
        for c in &side.contradictions {
            let [dark, lit] = [c.dark_rad, c.lit_rad].map(|a| (a.to_degrees() * 100.0).round() / 100.0);
            let ([x, y], [left, top, right, bottom]) = (c.first, c.bounds);
            let message = format!(
                "{name}: {} texels are dark at {dark} and lit again at {lit} degrees, from {left}, {top} to {right}, {bottom}, \
                 first at {x}, {y}; shrink the lit part of the later key, or repair the map (--repair)",
                c.texels
            );
            remarks.push(Remark { is_fault: true, message });
        }
        remarks.extend(on_map(&side.map).into_iter().map(|m| hint(format!("{name}: {m}"))));
    }
    remarks.extend(coarse_steps(project).map(hint));
    remarks.extend(on_seams(baked).map(hint));
    for key in &project.keys {
        remarks.extend(on_mask(key.angle(), &project.mask(key.angle())?).map(hint));
    }
    Ok(remarks)
}

fn hint(message: String) -> Remark {
    Remark { is_fault: false, message }
}

/// Remarks on the sweep of the light over a map: jumps, and light that never goes.
fn on_map(map: &ThresholdMap) -> Vec<String> {
    let mut remarks = Vec::new();
    let max = map.depth.max();
    let mut counts = vec![0u64; usize::from(max) + 1];
    map.codes.iter().for_each(|c| counts[usize::from(*c)] += 1);
    let all = map.codes.len().max(1) as f64;
    // Texels that turn dark in each degree.
    let mut steps = [0u64; 181];
    for (code, count) in counts.iter().enumerate().take(usize::from(max)).skip(1) {
        let angle = map.profile.angle_rad(code as f64 / f64::from(max)).to_degrees();
        steps[(angle.floor() as usize).min(180)] += count;
    }
    if let Some((degree, step)) = steps.iter().enumerate().max_by_key(|(_, s)| **s) {
        let share = *step as f64 / all;
        if share > LARGEST_STEP {
            remarks.push(format!(
                "{:.1} % of the map turns dark between {degree} and {} degrees; a key on the way slows it down",
                share * 100.0,
                degree + 1
            ));
        }
    }
    let always = counts[usize::from(max)] as f64 / all;
    if always > SEAM {
        remarks.push(format!(
            "{:.1} % of the map is lit at the last key and stays lit behind; add a key that is dark there",
            always * 100.0
        ));
    }
    remarks
}

/// Neighbouring keys with too few codes between them.
fn coarse_steps(project: &Project) -> impl Iterator<Item = String> {
    let max = f64::from(project.depth().max());
    let mut angles: Vec<f32> = project.keys.iter().map(ProjectKey::angle).collect();
    angles.sort_by(f32::total_cmp);
    let codes = |angle: f32| project.profile.threshold(f64::from(angle.abs()).to_radians()).clamp(0.0, 1.0) * max;
    let found: Vec<String> = angles
        .windows(2)
        .filter_map(|pair| {
            let between = (codes(pair[1]) - codes(pair[0])).abs();
            let remedy = if project.depth() == Depth::Eight {
                "bits = 16, or dither = true"
            } else {
                "keys farther apart"
            };
            (between > 0.0 && between < FEWEST_CODES && (pair[0] >= 0.0 || pair[1] <= 0.0)).then(|| {
                format!(
                    "only {between:.1} codes lie between {} and {} degrees: the border moves in steps; {remedy}",
                    pair[0], pair[1]
                )
            })
        })
        .collect();
    found.into_iter()
}

/// Where the shader changes over from one side to the other, both must say the same: in front and behind.
fn on_seams(baked: &BakedSides) -> impl Iterator<Item = String> {
    let left = &baked.left.map;
    let right = baked.right.as_ref().map_or_else(|| left.flipped(), |r| r.map.clone());
    let all = left.codes.len().max(1) as f64;
    let seams = [("in front (0 degrees)", 0.0f32), ("behind (180 degrees)", std::f32::consts::PI)];
    let found = seams.map(|(place, angle)| {
        let differ = left.mask(angle).lit().zip(right.mask(angle).lit()).filter(|(a, b)| a != b).count() as f64 / all;
        (differ > SEAM).then(|| {
            format!(
                "left and right differ in {:.1} % of the map {place}: the shadow jumps as the light passes; make the key there symmetric",
                differ * 100.0
            )
        })
    });
    found.into_iter().flatten()
}

/// Remarks on one drawing: nothing in it, or edges that were mixed in another colour space.
fn on_mask(angle: f32, mask: &Mask) -> Option<String> {
    let soft: Vec<u64> = mask.coverage.iter().filter(|c| !matches!(c, 0 | 255)).map(|c| u64::from(*c)).collect();
    let mean = soft.iter().sum::<u64>() as f64 / (soft.len().max(1) as f64 * 255.0);
    if soft.len() * 4 > mask.coverage.len() {
        return Some(format!(
            "the key at {angle} degrees is grey in {:.0} % of its texels, as a soft brush leaves it; only where it crosses one \
             half counts",
            soft.len() as f64 / mask.coverage.len() as f64 * 100.0
        ));
    }
    // Coverage is spread evenly over 0..1; encoded as sRGB, its mean becomes 0.66.
    (soft.len() >= 500 && mean > 0.6).then(|| {
        format!(
            "the edges of the key at {angle} degrees are too bright (mean {mean:.2}, expected 0.5): wrong colour space, they were \
             mixed linearly and stored as sRGB; export the mask as data, or set threshold = 0.73"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn remarks(text: &str) -> Vec<Remark> {
        let project = Project::parse("face.sdf.toml", text).expect("a project");
        check(&project, &project.bake(true).expect("bakes")).expect("checks")
    }

    fn shape(kind: &str, name: &str, keys: &[(f32, [f32; 4])]) -> String {
        let key = |(angle, [l, t, r, b]): &(f32, [f32; 4])| {
            format!(
                "{{ angle = {angle:?}, polygon = [[{l:?}, {t:?}], [{r:?}, {t:?}], [{r:?}, {b:?}], [{l:?}, {b:?}]] }}"
            )
        };
        let keys: Vec<String> = keys.iter().map(key).collect();
        format!("[[shape]]\nname = \"{name}\"\nkind = \"{kind}\"\nkeys = [{}]\n", keys.join(", "))
    }

    #[test]
    fn a_clean_project_has_no_remarks() {
        let band = shape("light", "band", &[(0.0, [-0.1, -0.1, 1.1, 1.1]), (180.0, [1.05, -0.1, 1.1, 1.1])]);
        let text = format!("size = 200\nkeys = [0, 45, 90, 135, 180]\n{band}");
        assert_eq!(remarks(&text), []);
    }

    #[test]
    fn each_trouble_is_named() {
        let all = |texts: &[&str], kind: bool, text: String| {
            let found = remarks(&text);
            for words in texts {
                assert!(found.iter().any(|r| r.message.contains(words) && r.is_fault == kind), "{words}: {found:?}");
            }
        };
        let band = |to: f32| shape("light", "band", &[(0.0, [-0.1, -0.1, 1.1, 1.1]), (180.0, [to, -0.1, 1.1, 1.1])]);
        let island = shape("light", "island", &[(90.0, [0.05, 0.1, 0.15, 0.2]), (100.0, [0.05, 0.1, 0.15, 0.2])]);
        all(
            &["left: 100 texels are dark at 45 and lit again at 90 degrees, from 5, 10 to 14, 19, first at 5, 10"],
            true,
            format!("size = 100\nkeys = [0, 45, 90, 180]\n{}{island}", band(1.05)),
        );
        all(
            &["stays lit behind", "behind (180 degrees)"],
            false,
            format!("size = 100\nkeys = [0, 180]\n{}", band(0.8)),
        );
        all(
            &["turns dark between"],
            false,
            format!("size = 100\nkeys = [0, 89, 90, 180]\n{}", {
                shape(
                    "light",
                    "band",
                    &[
                        (0.0, [-0.1, -0.1, 1.1, 1.1]),
                        (89.0, [0.0, -0.1, 1.1, 1.1]),
                        (90.0, [0.9, -0.1, 1.1, 1.1]),
                        (180.0, [1.05, -0.1, 1.1, 1.1]),
                    ],
                )
            }),
        );
        all(&["only 2.8 codes"], false, format!("size = 100\nbits = 8\nkeys = [0, 2, 180]\n{}", band(1.05)));
    }

    #[test]
    fn edges_of_another_colour_space_are_found() {
        // A slanting edge, its coverage as it is and as sRGB.
        let coverage = |x: u32, y: u32| (f64::from(x) - f64::from(y) * 0.31 - 8.0).clamp(0.0, 1.0);
        let mask = |encode: fn(f64) -> f64| Mask {
            width: 800,
            height: 600,
            coverage: (0..600 * 800u32).map(|i| (encode(coverage(i % 800, i / 800)) * 255.0).round() as u8).collect(),
        };
        assert_eq!(on_mask(0.0, &mask(|c| c)), None);
        let srgb = |c: f64| {
            if c < 0.003_130_8 {
                c * 12.92
            } else {
                1.055 * c.powf(1.0 / 2.4) - 0.055
            }
        };
        assert!(on_mask(0.0, &mask(srgb)).is_some_and(|m| m.contains("colour space")));
        let brush = Mask { width: 16, height: 16, coverage: (0..=255).collect() };
        assert!(on_mask(0.0, &brush).is_some_and(|m| m.contains("soft brush")));
    }
}
