//! Places along a line from which light comes to a point.

/// Most places to each side.
pub(crate) const MOST_LINE_TAPS: usize = 10;

/// How far the last of them lies in a profile of d = 1: 1 % of the light of a line come from farther.
const REACH: f32 = 10.0;

/// How much nearer they are near the point: more than the square of Jimenez et al. 2015, for colours that go less far.
const NEARER: f32 = 2.5;

/// Distances of places to one side for a profile of d = 1: of four lines, whose places lie between those of each other. Number
/// 3 - i is number i seen from the other side.
pub(crate) fn lines(taps: usize) -> [[f32; 4]; MOST_LINE_TAPS] {
    let place = |i: usize, line: usize| {
        let share = (i as f32 + 1.0 + (line as f32 - 1.5) * 0.25) / taps.max(1) as f32;
        share.powf(NEARER) * REACH
    };
    std::array::from_fn(|i| std::array::from_fn(|line| if i < taps { place(i, line) } else { 0.0 }))
}

#[cfg(test)]
mod tests {
    use serde_json::Value;

    use super::*;
    use crate::skin::gaussians::tests::six;

    fn numbers(list: &Value) -> Vec<f64> {
        list.as_array().expect("a list").iter().map(|v| v.as_f64().expect("a number")).collect()
    }

    #[test]
    fn places_of_four_lines_lie_between_each_other() {
        for taps in [1, 4, MOST_LINE_TAPS] {
            let places = lines(taps);
            let sorted = places[..taps].as_flattened();
            assert!(sorted.is_sorted_by(|a, b| a < b) && sorted[0] > 0.0, "{places:?}");
            assert!(places[taps..].as_flattened().iter().all(|x| *x == 0.0));
            let last = places[taps - 1].iter().sum::<f32>() / 4.0;
            assert!((last / REACH - 1.0).abs() < 0.25, "{last}");
        }
    }

    /// Light of a cell is what the sum of Gaussians has from border to border, half way between places.
    #[test]
    fn cells_of_a_line_follow_their_vectors() {
        let file: Value =
            serde_json::from_str(include_str!("../../tests/oracles/separable_kernel.json")).expect("vectors");
        let profile = six();
        let mut kernels = 0;
        for kernel in file["kernels"].as_array().expect("kernels") {
            if kernel["kind"] != "line_spread" {
                continue;
            }
            let offsets = numbers(&kernel["offsets"]);
            let border = |i: usize| match i {
                0 => f64::NEG_INFINITY,
                i if i == offsets.len() => f64::INFINITY,
                i => 0.5 * (offsets[i - 1] + offsets[i]),
            };
            for (i, expected) in kernel["weights"].as_array().expect("weights").iter().enumerate() {
                let (near, far) = (profile.edge(border(i)), profile.edge(border(i + 1)));
                for (c, expected) in numbers(expected).into_iter().enumerate() {
                    let found = far[c] - near[c];
                    assert!((found - expected).abs() < 1e-9, "{i} of {}: {found}, {expected}", offsets.len());
                }
            }
            kernels += 1;
        }
        assert!(kernels > 3, "{kernels}");
    }
}
