//! MToon, its lines and its light.

use super::{assert_close, cases, numbers, run, vectors};

#[test]
fn mtoon_shading_gi_matcap_and_rim() {
    let file = vectors("mtoon.json");
    let list = cases(&file, "cases");
    let p = |s: &str| format!("params.{s}");
    let names = [
        "base",
        "shade",
        "light",
        "shading_shift",
        "shift_tex",
        "shift_tex_scale",
        "toony",
        "gi_n",
        "gi_up",
        "gi_down",
        "gi_equalization",
        "matcap_factor",
        "matcap_texel",
        "rim_color",
        "rim_lift",
        "rim_power",
        "rim_mask",
        "rim_lighting_mix",
    ]
    .map(p);
    let paths: Vec<&str> = ["N", "L", "V"].into_iter().chain(names.iter().map(String::as_str)).collect();
    let rows: Vec<Vec<f32>> = list.iter().map(|c| numbers(c, &paths)).collect();
    let body = "
        let n = input3(base); let l = input3(base + 3u); let v = input3(base + 6u);
        let lit = input3(base + 9u); let shade = input3(base + 12u); let light = input3(base + 15u);
        let shift = input[base + 18u] + input[base + 19u] * input[base + 20u];
        let shading = mtoon_shading(dot(n, l), shift, input[base + 21u]);
        let direct = mtoon_direct(lit, shade, shading, light);
        let gi = mtoon_gi(input3(base + 22u), input3(base + 25u), input3(base + 28u), input[base + 31u]);
        let uv = mtoon_matcap_uv(n, v);
        let matcap = input3(base + 32u) * input3(base + 35u);
        let parametric = mtoon_parametric_rim(dot(n, v), input[base + 41u], input[base + 42u]);
        let rim = mtoon_rim(matcap, parametric * input3(base + 38u), input3(base + 43u), light + gi, input[base + 46u]);
        output[out] = shading;
        write3(out + 1u, direct);
        write3(out + 4u, gi);
        output[out + 7u] = uv.x; output[out + 8u] = uv.y;
        output[out + 9u] = parametric;
        write3(out + 10u, rim);
        write3(out + 13u, direct + gi * lit + rim);";
    let found = run(&["mtoon"], body, &rows, 16);
    let expected = ["shading", "direct", "gi", "matcap_uv", "parametric_rim", "rim", "color"];
    for (i, (case, found)) in list.iter().zip(&found).enumerate() {
        // Inside the ramp of toony 0.999 a rounding error of N.L is magnified 500 times.
        let tolerance = 2e-3;
        assert_close("mtoon", i, found, &numbers(&case["expect"], &expected), tolerance);
    }
}

#[test]
fn mtoon_ramp() {
    let file = vectors("mtoon.json");
    let list = cases(&file, "ramp");
    let rows: Vec<Vec<f32>> = list.iter().map(|c| numbers(c, &["NoL", "shift", "toony"])).collect();
    let found =
        run(&["mtoon"], "output[out] = mtoon_shading(input[base], input[base + 1u], input[base + 2u]);", &rows, 1);
    for (i, (case, found)) in list.iter().zip(&found).enumerate() {
        assert_close("ramp", i, found, &numbers(case, &["shading"]), 2e-5);
    }
}

#[test]
fn mtoon_uv_animation() {
    let file = vectors("mtoon.json");
    let list = cases(&file, "uv_animation");
    let paths = ["uv", "scroll_x", "scroll_y", "rotation", "mask"];
    let rows: Vec<Vec<f32>> = list.iter().map(|c| numbers(c, &paths)).collect();
    let body = "
        let uv = mtoon_animate_uv(vec2f(input[base], input[base + 1u]), vec2f(input[base + 2u], input[base + 3u]),
            input[base + 4u], input[base + 5u]);
        output[out] = uv.x; output[out + 1u] = uv.y;";
    let found = run(&["mtoon"], body, &rows, 2);
    for (i, (case, found)) in list.iter().zip(&found).enumerate() {
        assert_close("uv animation", i, found, &numbers(case, &["uv_out"]), 2e-3);
    }
}

#[test]
fn outline_moves_by_pixels() {
    let file = vectors("stylized.json");
    let list = cases(&file, "outline");
    let rows: Vec<Vec<f32>> = list.iter().map(|c| numbers(c, &["clip", "n_clip", "px", "width", "height"])).collect();
    let body = "
        let clip = vec4f(input3(base), input[base + 3u]);
        let size = vec2f(input[base + 7u], input[base + 8u]);
        let moved = outline_clip(clip, vec2f(input[base + 4u], input[base + 5u]), input[base + 6u] / size.y, size.x / size.y);
        write3(out, moved.xyz); output[out + 3u] = moved.w;";
    let found = run(&["normal", "outline"], body, &rows, 4);
    for (i, (case, found)) in list.iter().zip(&found).enumerate() {
        assert_close("outline", i, found, &numbers(case, &["clip_out"]), 1e-3);
    }
}

/// Bounds of light leave what lies between them alone, keep the hue of what does not, and know a light that is black.
#[test]
fn light_is_taken_between_its_bounds() {
    let rows: Vec<Vec<f32>> =
        [[0.0f32, 0.0, 0.0], [0.5, 0.4, 0.3], [4.0, 2.0, 1.0], [0.02, 0.01, 0.0]].map(|l| l.to_vec()).into();
    let body = "
        write3(out, light_response(input3(base), 0.1, 1.0, 0.0));
        write3(out + 3u, light_response(input3(base), 0.1, 1.0, 1.0));
        write3(out + 6u, light_response(input3(base), 0.0, 10.0, 0.0));";
    let luminance = |c: &[f32]| 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
    for (row, found) in rows.iter().zip(run(&["light"], body, &rows, 9)) {
        let wanted = luminance(row).clamp(0.1, 1.0);
        assert!((luminance(&found[..3]) - wanted).abs() < 1e-5, "{row:?}: {found:?}");
        assert!(found[3..6].iter().all(|c| (c - wanted).abs() < 1e-5), "{row:?}: {found:?}");
        assert!(found[6..].iter().zip(row).all(|(f, r)| (f - r).abs() < 1e-6), "{row:?}: {found:?}");
        if luminance(row) > 0.0 {
            let ratio = found[0] / row[0];
            assert!(found[..3].iter().zip(row).all(|(f, r)| (f - r * ratio).abs() < 1e-5), "{row:?}: {found:?}");
        }
    }
}

#[test]
fn octahedral_pairs_keep_unit_vectors() {
    let mut rows = Vec::new();
    for i in 0..500 {
        let t = i as f32 * 2.399_963; // golden angle
        let z = 1.0 - (2 * i + 1) as f32 / 500.0;
        let r = (1.0 - z * z).sqrt();
        rows.push(vec![r * t.cos(), r * t.sin(), z]);
    }
    rows.extend([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0]].map(|v| v.to_vec()));
    let body = "write3(out, unit_from_octahedral(unpack2x16snorm(pack2x16snorm(octahedral_from_unit(input3(base))))));";
    for (i, (row, found)) in rows.iter().zip(run(&["normal"], body, &rows, 3)).enumerate() {
        assert_close("octahedral", i, &found, row, 1e-4);
    }
}

#[test]
fn punctual_light_attenuation() {
    // Distance², range, cos, spot scale, spot offset -> inverse square inside a window, and the cone.
    let rows = vec![
        vec![1.0, 0.0, 1.0, 0.0, 1.0],
        vec![4.0, 0.0, 0.3, 0.0, 1.0],
        vec![4.0, 2.0, 0.5, 2.0, -1.0],
        vec![1.0, 2.0, 0.75, 2.0, -1.0],
    ];
    let body = "output[out] = distance_attenuation(input[base], input[base + 1u]);
        output[out + 1u] = spot_attenuation(input[base + 2u], input[base + 3u], input[base + 4u]);";
    let found = run(&["light"], body, &rows, 2);
    let expected = [[1.0, 1.0], [0.25, 1.0], [0.0, 0.0], [15.0 / 16.0, 0.25]];
    for (i, (found, expected)) in found.iter().zip(&expected).enumerate() {
        assert_close("attenuation", i, found, expected, 1e-5);
    }
}
