//! Weighted layers: weights, sums and what they become.

use serde_json::Value;

use super::{assert_close, cases, numbers, run, vectors};

const MOST: usize = 12;

/// Layers of a pixel, with what weights them: a number each, or where `given` is none our own, over a sphere of 12 cm.
fn composite(list: &[Value], given: Option<&dyn Fn(f64, f64) -> f64>) -> Vec<Vec<f32>> {
    let row = |case: &Value| {
        let (z, alpha) = (numbers(case, &["z"]), numbers(case, &["alpha"]));
        let colors: Vec<f32> = case["color"]
            .as_array()
            .expect("colours")
            .iter()
            .flat_map(|c| numbers(&serde_json::json!({"c": c}), &["c"]))
            .collect();
        let mut row = vec![z.len() as f32];
        row.extend(numbers(case, &["z_center", "background"]));
        let weights = |f: &dyn Fn(f64, f64) -> f64| -> Vec<f32> {
            z.iter().zip(&alpha).map(|(z, a)| f(f64::from(*z), f64::from(*a)) as f32).collect()
        };
        for (mut values, len) in [
            (given.map(weights).unwrap_or_default(), MOST),
            (z.clone(), MOST),
            (alpha.clone(), MOST),
            (colors, 3 * MOST),
        ] {
            values.resize(len, 0.0);
            row.extend(values);
        }
        row
    };
    let rows: Vec<Vec<f32>> = list.iter().map(row).collect();
    let ours = if given.is_some() {
        "input[at]"
    } else {
        "weighted_weight(input[at + 24u], weighted_place(input[at + 12u], input[base + 1u], 0.12))"
    };
    let body = format!(
        "var sums = vec4f(0.0);
         var left = 1.0;
         for (var i = 0u; i < u32(input[base]); i++) {{
             let at = base + 5u + i;
             let alpha = input[at + 24u];
             sums += weighted_layer(input3(base + 41u + 3u * i), alpha, {ours});
             left *= 1.0 - alpha;
         }}
         let all = weighted_resolved(sums, left);
         write3(out, all.rgb * all.a + input3(base + 2u) * (1.0 - all.a));
         output[out + 3u] = left;"
    );
    run(&["weighted"], &body, &rows, 4)
}

/// Every weight of the paper, by its equation.
fn weight(name: &str) -> Box<dyn Fn(f64, f64) -> f64> {
    match name {
        "eq7" => Box::new(|z, a| a * (10.0 / (1e-5 + (z / 5.0).powi(2) + (z / 200.0).powi(6))).clamp(1e-2, 3e3)),
        "eq8" => Box::new(|z, a| a * (10.0 / (1e-5 + (z / 10.0).powi(3) + (z / 200.0).powi(6))).clamp(1e-2, 3e3)),
        "eq9" => Box::new(|z, a| a * (0.03 / (1e-5 + (z / 200.0).powi(4))).clamp(1e-2, 3e3)),
        "eq10" => Box::new(|z, a| {
            let depth = ((0.1 * 500.0) / z - 500.0) / (0.1 - 500.0);
            a * (3e3 * (1.0 - depth).powi(3)).max(1e-2)
        }),
        _ => Box::new(|_, a| a),
    }
}

#[test]
fn layers_become_what_their_weights_make_of_them() {
    let file = vectors("wboit.json");
    for name in ["eq7", "eq8", "eq9", "eq10", "uniform"] {
        let weight = weight(name);
        for case in cases(&file, "weights") {
            let at = |key: &str| case[key].as_f64().expect(key);
            let found = weight(at("z"), at("alpha"));
            assert!((found - at(name)).abs() <= 1e-6 * at(name), "{name}: {found}, expected {}", at(name));
        }
        let list = cases(&file, "pixels");
        for (i, (case, found)) in list.iter().zip(composite(list, Some(&*weight))).enumerate() {
            assert_close(name, i, &found[..3], &numbers(&case["wboit"], &[name]), 1e-4);
            assert_close("left", i, &found[3..], &numbers(case, &["revealage"]), 1e-5);
        }
    }
}

#[test]
fn layers_of_a_head_are_weighed_over_it() {
    let file = vectors("wboit.json");
    let list = cases(&file, "pixels");
    let (mut errors, mut hair) = (Vec::new(), Vec::new());
    for (i, (case, found)) in list.iter().zip(composite(list, None)).enumerate() {
        assert_close("weighed", i, &found[..3], &numbers(case, &["wboit_head_k6"]), 1e-4);
        let sorted = numbers(case, &["sorted"]);
        let error = found.iter().zip(&sorted).map(|(a, b)| (a - b).abs()).sum::<f32>() / 3.0;
        match case["kind"].as_str() {
            // What has one layer or one colour is exact.
            Some("single" | "equal_colour") => assert_close("sorted", i, &found[..3], &sorted, 1e-4),
            Some("hair") => hair.push(error),
            _ => errors.push(error),
        }
    }
    let mean = |of: &[f32]| of.iter().sum::<f32>() / of.len() as f32;
    println!("against sorted layers: hair {:.4}, others {:.4}", mean(&hair), mean(&errors));
    assert!(mean(&hair) <= 0.03, "{hair:?}");
}

/// Of those who are farther away layers weigh less, down to what halves tell apart.
#[test]
fn the_nearest_weighs_most() {
    let rows: Vec<Vec<f32>> = [1.0, 1.05, 2.0, 50.0, 0.0].map(|middle| vec![middle]).into();
    let found = run(&["weighted"], "output[out] = weighted_nearness(1.0, input[base]);", &rows, 1);
    for (i, (found, expected)) in found.iter().zip([1.0, 0.676_839, 0.018_316, 0.018_316, 1.0]).enumerate() {
        assert_close("nearness", i, found, &[expected], 1e-4);
    }
}
