//! The exponential shadow map of the bangs.

use super::{assert_close, cases, numbers, run, vectors};

#[test]
fn esm_taps_and_composition_match_the_vectors() {
    let file = vectors("esm.json");
    for (i, case) in cases(&file, "cases").iter().enumerate() {
        let flat = |name: &str| -> Vec<f32> {
            case[name]
                .as_array()
                .expect(name)
                .iter()
                .flat_map(|r| r.as_array().expect(name))
                .map(|x| x.as_f64().expect(name) as f32)
                .collect()
        };
        let common = numbers(case, &["receiver", "c", "bias"]);
        let rows: Vec<Vec<f32>> = flat("depths").into_iter().map(|d| [&[d], &common[..]].concat()).collect();
        let taps = run(
            &["bangs"],
            "output[out] = esm_taps(vec4f(input[base]), input[base + 1u], input[base + 2u], input[base + 3u]).x;",
            &rows,
            1,
        );
        let lit: f32 = taps.iter().zip(flat("weights")).map(|(tap, weight)| tap[0] * weight).sum();
        assert_close("taps", i, &[lit], &numbers(case, &["lit_tap"]), 1e-3 * (common[1] / 600.0).max(1.0));
    }
    let list = cases(&file, "compose");
    let rows: Vec<Vec<f32>> =
        list.iter().map(|c| numbers(c, &["lit", "edge0", "edge1", "strength", "shadow_color"])).collect();
    let body = "
        let share = bangs_share(input[base], vec2f(input[base + 1u], input[base + 2u]), input[base + 3u]);
        write3(out, mix(vec3f(1.0), input3(base + 4u), share));";
    for (i, (case, found)) in list.iter().zip(run(&["bangs"], body, &rows, 3)).enumerate() {
        assert_close("composition", i, &found, &numbers(case, &["factor"]), 1e-5);
    }
}

/// A caster farther than ln(100)/c before the receiver lets at most 1 % through; one behind it lets all through; the
/// weights of the box sum to 1 wherever it stands.
#[test]
fn esm_leaks_at_most_a_hundredth() {
    let rows: Vec<Vec<f32>> = [200.0, 600.0, 1500.0, 5000.0].iter().map(|c: &f32| vec![*c, 100f32.ln() / c]).collect();
    let body = "
        let c = input[base]; let gap = input[base + 1u];
        let taps = esm_taps(vec4f(0.5 - gap, 0.5 - 2.0 * gap, 0.5 + gap, 0.5), 0.5, c, 0.0);
        write3(out, taps.xyz);
        var sum = 0.0;
        for (var i = 0; i < BANGS_TAPS; i++) { sum += bangs_weight(i, fract(c * 0.0137)); }
        output[out + 3u] = sum;";
    for (row, found) in rows.iter().zip(run(&["bangs"], body, &rows, 4)) {
        assert!(found[0] <= 0.010_01 && found[1] <= 0.000_11 && found[2] == 1.0, "{row:?}: {found:?}");
        assert!((found[3] - 1.0).abs() < 1e-6, "{row:?}: weights sum to {}", found[3]);
    }
}

/// A surface that casts on itself gets no shadow from it, up to 45 degrees aslant: with the default edges, hardness and bias
/// on a map of a head, where a texel is 1 mm.
#[test]
fn a_caster_has_no_acne() {
    // Millimetres of depth a texel, and place in the texel.
    let rows: Vec<Vec<f32>> = [-1.0, -0.5, 0.0, 0.3, 1.0]
        .iter()
        .flat_map(|slope: &f32| [0.0, 0.3, 0.5, 0.9].map(|f| vec![*slope, f]))
        .collect();
    let body = "
        let range = 0.8; let slope = input[base] * 0.001 / range; let f = input[base + 1u];
        var lit = 0.0;
        for (var i = 0; i < BANGS_TAPS; i++) {
            let tap = esm_taps(vec4f(0.5 + (f32(i) - 1.0 - f) * slope), 0.5, 1500.0, 0.001 / range).x;
            lit += bangs_weight(i, f) * tap;
        }
        output[out] = 1.0 - bangs_share(lit, vec2f(0.3, 0.7), 1.0);";
    for (row, found) in rows.iter().zip(run(&["bangs"], body, &rows, 1)) {
        assert_eq!(found[0], 1.0, "{row:?}");
    }
}
