//! Light on skin: highlights, wrapped light, Burley's diffusion, bumps that colours see each their own way.

use std::f64::consts::PI;

use super::{assert_close, cases, numbers, run, vectors};

/// Highlights need these files.
const SPECULAR: [&str; 2] = ["brdf", "skin_specular"];
/// Diffusion needs these.
const DIFFUSE: [&str; 2] = ["kajiya_kay", "skin"];

fn assert_relative(what: &str, case: usize, found: &[f32], expected: &[f32], relative: f32) {
    for (f, e) in found.iter().zip(expected) {
        assert_close(what, case, &[*f], &[*e], (relative * e.abs()).max(1e-12));
    }
}

/// All combinations of one number of each list.
fn grid(lists: &[&[f32]]) -> Vec<Vec<f32>> {
    lists.iter().fold(vec![vec![]], |rows, list| {
        rows.iter().flat_map(|row| list.iter().map(move |x| [row.as_slice(), &[*x]].concat())).collect()
    })
}

#[test]
fn kelemens_lobe_follows_its_vectors() {
    let file = vectors("kelemen.json");
    let list = cases(&file, "cases");
    let rows: Vec<Vec<f32>> = list.iter().map(|c| numbers(c, &["L", "V", "m", "F0"])).collect();
    let body = "
        let l = input3(base); let v = input3(base + 3u); let h = normalize(l + v);
        let f = kelemen_lobe(h.z, dot(l, h), input[base + 6u]);
        output[out] = f * schlick(vec3f(input[base + 7u]), dot(v, h)).x;
        output[out + 1u] = kelemen_lobe(h.z, dot(v, h), input[base + 6u]) / max(f, 1e-20);";
    for (i, (case, found)) in list.iter().zip(run(&SPECULAR, body, &rows, 2)).enumerate() {
        let expected = numbers(case, &["brdf"]);
        assert!(found[0].is_finite() && found[0] >= 0.0, "case {i}: {found:?}");
        if expected[0] > 1e-5 {
            assert_relative("kelemen", i, &found[..1], &expected, 1e-4);
            assert_close("kelemen, L and V exchanged", i, &found[1..], &[1.0], 1e-5);
        } else {
            assert_close("kelemen, dark", i, &found[..1], &expected, 1e-8);
        }
    }
}

#[test]
fn two_lobes_follow_their_vectors() {
    let file = vectors("dual_lobe_ggx.json");
    let list = cases(&file, "cases");
    let rows: Vec<Vec<f32>> =
        list.iter().map(|c| numbers(c, &["L", "V", "roughness0", "roughness1", "weight0", "F0"])).collect();
    let body = "
        let l = input3(base); let v = input3(base + 3u); let h = normalize(l + v);
        let sharp = input[base + 6u] * input[base + 6u]; let wide = input[base + 7u] * input[base + 7u];
        let share = input[base + 8u];
        let f = dual_ggx_lobe(h.z, l.z, v.z, sharp, wide, share);
        output[out] = f * schlick(vec3f(input[base + 9u]), dot(v, h)).x;
        output[out + 1u] = dual_ggx_lobe(h.z, v.z, l.z, sharp, wide, share) / f;
        let one = ggx_distribution(h.z, sharp) * smith_visibility(l.z, v.z, sharp);
        output[out + 2u] = dual_ggx_lobe(h.z, l.z, v.z, sharp, wide, 1.0) / one;
        output[out + 3u] = dual_ggx_lobe(h.z, l.z, v.z, sharp, sharp, share) / one;";
    for (i, (case, found)) in list.iter().zip(run(&SPECULAR, body, &rows, 4)).enumerate() {
        assert_relative("two lobes", i, &found[..1], &numbers(case, &["brdf"]), 1e-4);
        assert_close("exchanged; the sharp one; two alike", i, &found[1..], &[1.0; 3], 1e-5);
    }
}

/// Blinn and Phong's lobe against f64: no vectors exist for it.
#[test]
fn blinn_phongs_lobe_follows_its_formula() {
    let rows = grid(&[&[0.2, 0.6, 0.9, 0.99, 0.999, 1.0], &[0.05, 0.3, 1.0], &[0.05, 0.1, 0.3, 0.7, 1.0]]);
    let body = "output[out] = blinn_phong_lobe(input[base], input[base + 1u], input[base + 2u]);";
    for (i, (row, found)) in rows.iter().zip(run(&SPECULAR, body, &rows, 1)).enumerate() {
        let [n_dot_h, l_dot_h, alpha] = [0, 1, 2].map(|k| f64::from(row[k]));
        let n = 2.0 / (alpha * alpha) - 2.0;
        let expected = (n + 2.0) / (2.0 * PI) * n_dot_h.powf(n) / (4.0 * l_dot_h * l_dot_h);
        assert_close("blinn-phong", i, &found, &[expected as f32], (expected * 5e-4).max(1e-9) as f32);
    }
}

/// The microfacets of a flat piece of surface are as large as it, at any width.
#[test]
fn distributions_of_highlights_are_normalised() {
    let mut rows: Vec<Vec<f32>> =
        [2.0f32, 8.0, 32.0, 128.0, 512.0, 1024.0, 2048.0, 4096.0].map(|n| vec![0.0, (2.0 / (n + 2.0)).sqrt()]).into();
    rows.extend(grid(&[&[1.0, 2.0], &[0.03, 0.05, 0.1, 0.25, 0.5, 1.0]]));
    let body = "
        let kind = input[base]; let width = input[base + 1u];
        var sum = 0.0;
        for (var k = 0; k < 8192; k++) {
            // Dense near the peak.
            let x = (f32(k) + 0.5) / 8192.0;
            let c = 1.0 - x * x * x * x;
            var d = blinn_phong_distribution(c, width);
            if kind > 0.5 { d = beckmann_distribution(c, width); }
            if kind > 1.5 { d = ggx_distribution(c, width); }
            sum += d * c * x * x * x * 4.0 / 8192.0;
        }
        output[out] = sum * 2.0 * 3.14159265;";
    for (row, found) in rows.iter().zip(run(&SPECULAR, body, &rows, 1)) {
        assert!((found[0] - 1.0).abs() <= 1e-3, "{row:?}: {}", found[0]);
    }
}

/// What a highlight gives back of light from a view, without Fresnel: the tables' shares, never more than came.
#[test]
fn highlights_give_back_the_tables_shares() {
    let [kelemen, ggx] = ["kelemen.json", "dual_lobe_ggx.json"].map(vectors);
    let mut rows: Vec<Vec<f32>> = Vec::new();
    let mut expected = Vec::new();
    for case in cases(&kelemen, "energy_table") {
        rows.push([vec![0.0], numbers(case, &["m", "NoV"]), vec![0.0, 1.0]].concat());
        expected.push(numbers(case, &["rho_F1"])[0]);
    }
    let single = |alpha: f32, n_dot_v: f32| {
        let of = |c: &&serde_json::Value| numbers(c, &["alpha", "NoV"]) == [alpha, n_dot_v];
        numbers(cases(&ggx, "energy_table").iter().find(of).expect("in the table"), &["rho_F1"])[0]
    };
    for n_dot_v in [0.1f32, 0.3, 0.6, 1.0] {
        for [sharp, wide] in [[0.05f32, 0.05], [0.15, 0.35], [0.35, 0.7], [0.7, 0.7]] {
            rows.push(vec![1.0, sharp, n_dot_v, wide, 0.85]);
            expected.push(0.85 * single(sharp, n_dot_v) + 0.15 * single(wide, n_dot_v));
        }
    }
    // Over half vectors, as they keep the peak in place: dw = 4 (V·H) dh. Mesa ends loops after 65536 rounds in all.
    let body = "
        let rough = input[base + 1u]; let v_z = input[base + 2u];
        let v_x = sqrt((1.0 - v_z) * (1.0 + v_z));
        var sum = 0.0;
        for (var j = 0; j < 96; j++) {
            let across = cos((f32(j) + 0.5) / 96.0 * 3.14159265);
            for (var k = 0; k < 512; k++) {
                let x = (f32(k) + 0.5) / 512.0;
                let c = 1.0 - x * x * x * x;
                let v_dot_h = v_x * sqrt((1.0 - c) * (1.0 + c)) * across + v_z * c;
                let l_z = 2.0 * v_dot_h * c - v_z;
                if v_dot_h > 0.0 && l_z > 0.0 {
                    var f = kelemen_lobe(c, v_dot_h, rough);
                    if input[base] > 0.5 { f = dual_ggx_lobe(c, l_z, v_z, rough, input[base + 3u], input[base + 4u]); }
                    sum += f * l_z * 4.0 * v_dot_h * x * x * x * 4.0 / 512.0;
                }
            }
        }
        output[out] = sum * 2.0 * 3.14159265 / 96.0;";
    for (i, (found, expected)) in run(&SPECULAR, body, &rows, 1).iter().zip(expected).enumerate() {
        assert_close("share", i, found, &[expected], 3e-3);
        assert!(found[0] <= 1.0 + 1e-3, "{:?} gains energy: {}", rows[i], found[0]);
    }
}

/// Opposite directions, grazing ones, directions that are none, and widths of nothing leave no hole in a picture.
#[test]
fn highlights_are_finite_everywhere() {
    let cosines: &[f32] = &[-1.0, -1e-3, 0.0, 1e-20, 1e-4, 0.5, 1.0 - f32::EPSILON, 1.0, 1.0 + f32::EPSILON];
    let widths: &[f32] = &[0.0, 0.002, 0.05, 0.5, 1.0, 2.0];
    let rows = grid(&[cosines, cosines, cosines, widths]);
    let body = "
        let h = input[base]; let l = input[base + 1u]; let v = input[base + 2u]; let width = input[base + 3u];
        output[out] = blinn_phong_lobe(h, l, width);
        output[out + 1u] = kelemen_lobe(h, l, width);
        output[out + 2u] = dual_ggx_lobe(h, l, v, width, 1.0, 0.85);
        output[out + 3u] = dual_ggx_lobe(h, l, v, width, width, 1.0);";
    for (row, found) in rows.iter().zip(run(&SPECULAR, body, &rows, 4)) {
        assert!(found.iter().all(|f| f.is_finite() && *f >= 0.0), "{row:?}: {found:?}");
    }
}

#[test]
fn wrapped_light_follows_its_vectors() {
    let file = vectors("wrap_diffuse.json");
    let list = cases(&file, "cases");
    let rows: Vec<Vec<f32>> = list.iter().map(|c| numbers(c, &["NoL", "w"])).collect();
    let body = "
        output[out] = wrapped_diffuse_as_written(input[base], input[base + 1u]);
        output[out + 1u] = wrapped_diffuse(input[base], input[base + 1u]);";
    for (i, (case, found)) in list.iter().zip(run(&DIFFUSE, body, &rows, 2)).enumerate() {
        assert_close("wrap", i, &found, &numbers(case, &["wrap", "wrap_norm"]), 1e-6);
    }
}

/// The mean over the sphere shows what comes back of light from everywhere: normalised, as much as came.
#[test]
fn wrapped_light_keeps_its_energy() {
    let rows: Vec<Vec<f32>> = [0.0f32, 0.25, 0.5, 0.75, 1.0].map(|w| vec![w]).into();
    let body = "
        var sum = vec2f(0.0);
        for (var k = 0; k < 4096; k++) {
            let c = (f32(k) + 0.5) / 2048.0 - 1.0;
            sum += vec2f(wrapped_diffuse_as_written(c, input[base]), wrapped_diffuse(c, input[base]));
        }
        output[out] = sum.x / 1024.0;
        output[out + 1u] = sum.y / 1024.0;";
    for (i, (row, found)) in rows.iter().zip(run(&DIFFUSE, body, &rows, 2)).enumerate() {
        assert_close("energy", i, &found, &[1.0 + row[0], 1.0], 1e-4);
    }
}

#[test]
fn burleys_profile_follows_its_vectors() {
    let file = vectors("burley_profile.json");
    let list = cases(&file, "cases");
    let rows: Vec<Vec<f32>> = list.iter().map(|c| numbers(c, &["r", "d"])).collect();
    let body = "
        let r = input[base]; let d = vec3f(input[base + 1u]);
        output[out] = burley(r, d).x;
        output[out + 1u] = burley_times_r(r, d).y * 2.0 * 3.14159265;
        output[out + 2u] = burley_transmittance(r, d).z;
        output[out + 3u] = burley_cdf(r, d).x;";
    for (i, (case, found)) in list.iter().zip(run(&DIFFUSE, body, &rows, 4)).enumerate() {
        assert_relative("burley", i, &found[..3], &numbers(case, &["R", "pdf", "T"]), 1e-4);
        assert_close("burley's share", i, &found[3..], &numbers(case, &["cdf"]), 1e-6);
    }

    let list = cases(&file, "inverse");
    let rows: Vec<Vec<f32>> = list.iter().map(|c| numbers(c, &["u", "d"])).collect();
    let body = "output[out] = burley_radius(input[base], input[base + 1u]);";
    for (i, (case, found)) in list.iter().zip(run(&DIFFUSE, body, &rows, 1)).enumerate() {
        // The share itself is rounded: 0.99999 has but eight bits left to 1.
        let [u, r] = numbers(case, &["u", "r"])[..] else { panic!("two") };
        assert_close("burley's distance", i, &found, &[r], r * if u > 0.999 { 3e-4 } else { 1e-4 });
    }
}

#[test]
fn slabs_of_skin_let_through_what_their_vectors_say() {
    let file = vectors("transmittance.json");
    let list = cases(&file, "cases");
    let rows: Vec<Vec<f32>> = list.iter().map(|c| numbers(c, &["thickness_mm"])).collect();
    let body = "write3(out, burley_transmittance(input[base], vec3f(0.7568628, 0.32156864, 0.20000002)));";
    for (i, (case, found)) in list.iter().zip(run(&DIFFUSE, body, &rows, 3)).enumerate() {
        assert_relative("transmittance", i, &found, &numbers(case, &["T_burley"]), 1e-4);
    }
}

/// No light is lost on its way below the surface, and shares and distances are each other's inverse.
#[test]
fn burleys_profile_keeps_its_energy() {
    let rows = grid(&[&[0.001, 0.2, 0.757, 10.0, 1000.0]]);
    let body = "
        let d = input[base];
        var sum = vec2f(0.0);
        for (var k = 0; k < 8192; k++) {
            // Dense at 0, where half of the light is.
            let x = (f32(k) + 0.5) / 8192.0;
            let r = 60.0 * d * x * x;
            let dr = 120.0 * d * x / 8192.0;
            sum += vec2f(burley_times_r(r, vec3f(d)).x, burley(r, vec3f(d)).x * r) * dr;
        }
        output[out] = sum.x * 2.0 * 3.14159265;
        output[out + 1u] = sum.y * 2.0 * 3.14159265;";
    for (i, found) in run(&DIFFUSE, body, &rows, 2).iter().enumerate() {
        assert_close("energy of the profile", i, found, &[1.0; 2], 1e-3);
    }

    let shares: Vec<f32> = (0..=256).map(|i| i as f32 / 256.0).chain([1e-4, 1e-3, 0.9999, 0.999_999]).collect();
    let rows = grid(&[&shares, &[0.001, 0.757, 1000.0]]);
    let body = "output[out] = burley_cdf(burley_radius(input[base], input[base + 1u]), vec3f(input[base + 1u])).x;";
    for (i, (row, found)) in rows.iter().zip(run(&DIFFUSE, body, &rows, 1)).enumerate() {
        assert_close("share of the distance", i, &found, &row[..1], 2e-6);
    }
}

#[test]
fn diffusion_is_finite_everywhere() {
    let rows = grid(&[
        &[-1.0, 0.0, 1e-30, 1e-6, 0.5, 1.0, 2.0, 100.0, 1e6],
        &[0.0, 1e-3, 0.757, 1e3],
        &[-1e6, -1.0, 0.0, 1e-9, 1e3],
        &[0.0, 1e-3, 2.0, 1e3],
    ]);
    let body = "
        let r = input[base]; let d = vec3f(input[base + 1u], 0.3, 1e3); let dz = input[base + 2u]; let from_d = input[base + 3u];
        write3(out, burley(r, d));
        write3(out + 3u, burley_times_r(r, d));
        write3(out + 6u, burley_cdf(r, d));
        write3(out + 9u, burley_transmittance(r, d));
        output[out + 12u] = burley_radius(r, d.x);
        write3(out + 13u, disc_weight(r, dz, d, clamp(from_d * r, 0.0, 1e6)));
        output[out + 16u] = wrapped_diffuse(r, dz);
        output[out + 17u] = wrapped_diffuse_as_written(r, dz);
        write3(out + 18u, vec3f(detail_smoothing(dz), 0.0));
        write3(out + 21u, line_beyond(r, line_rate(d)));";
    for (row, found) in rows.iter().zip(run(&DIFFUSE, body, &rows, 24)) {
        assert!(found.iter().all(|f| f.is_finite() && *f >= 0.0), "{row:?}: {found:?}");
    }
}

#[test]
fn normals_of_colours_follow_their_vectors() {
    let file = vectors("stylized.json");
    let list = cases(&file, "detail_scatter");
    let rows: Vec<Vec<f32>> = list.iter().map(|c| numbers(c, &["n_high", "n_low", "L"])).collect();
    let body = "
        let low = input3(base + 3u); let l = input3(base + 6u);
        let smoothing = detail_smoothing(dot(low, l));
        let green = normalize(mix(input3(base), low, smoothing.x));
        let blue = normalize(mix(input3(base), low, smoothing.y));
        write3(out, green); write3(out + 3u, blue);
        write3(out + 6u, vec3f(dot(low, l), dot(green, l), dot(blue, l)));";
    for (i, (case, found)) in list.iter().zip(run(&DIFFUSE, body, &rows, 9)).enumerate() {
        assert_close("normals", i, &found, &numbers(case, &["n_g", "n_b", "NoL"]), 1e-5);
    }
}

/// Bumps are flattest for red and clearest for blue, and all flat away from the light.
#[test]
fn bumps_keep_the_order_of_colours() {
    let rows = grid(&[&[-2.0, -1.0, -0.5, 0.0, 0.3, 0.9, 1.0]]);
    let body = "
        let found = detail_smoothing(input[base]);
        output[out] = found.x; output[out + 1u] = found.y;";
    for (row, found) in rows.iter().zip(run(&DIFFUSE, body, &rows, 2)) {
        assert!(found[0] <= 1.0 && found[0] >= found[1] && found[1] >= 0.0, "{row:?}: {found:?}");
        assert!(row[0] > 0.0 || found == [1.0, 1.0], "{row:?}: {found:?}");
    }
}

/// Taps at the quantiles of the longest way give any colour all of its light, and at a depth what a slab lets through.
#[test]
fn weights_of_a_disc_have_the_profiles_mean() {
    let rows = grid(&[&[0.757, 2.0], &[0.0, 0.05, 0.3, 1.0, -1.0]]);
    let body = "
        let from_d = input[base]; let dz = input[base + 1u];
        let d = vec3f(1.0, 0.6, 0.25) * from_d;
        var sum = vec3f(0.0);
        for (var k = 0; k < 16384; k++) {
            let r = burley_radius((f32(k) + 0.5) / 16384.0, from_d);
            let drawn = burley_fall(r, vec3f(from_d)).x;
            sum += disc_weight(r, dz, d, from_d * r / (drawn * (1.0 + drawn * drawn)));
        }
        write3(out, sum / 16384.0);
        write3(out + 3u, burley_transmittance(abs(dz), d));";
    for (i, found) in run(&DIFFUSE, body, &rows, 6).iter().enumerate() {
        assert_close("mean weight", i, &found[..3], &found[3..], 1e-3);
        if rows[i][1] == 0.0 {
            assert_close("mean weight on a plane", i, &found[..3], &[1.0; 3], 1e-3);
        }
    }
}

/// Few taps, as a picture takes them, weigh exactly 1 each where their own profile drew them on a plane.
#[test]
fn weights_of_the_drawn_profile_are_one() {
    let rows: Vec<Vec<f32>> = (0..32).map(|i| vec![(i as f32 + 0.5) / 32.0]).chain([vec![0.0], vec![1.0]]).collect();
    let body = "
        let r = max(burley_radius(input[base], 0.757), 1e-6);
        let drawn = burley_fall(r, vec3f(0.757)).x;
        write3(out, disc_weight(r, 0.0, vec3f(0.757, 0.322, 0.2), 0.757 * r / (drawn * (1.0 + drawn * drawn))));";
    for (i, found) in run(&DIFFUSE, body, &rows, 3).iter().enumerate() {
        assert_close("own weight", i, &found[..1], &[1.0], 2e-6);
        assert!(found[2] >= 0.0 && found[2] <= 0.757 / 0.2 + 1e-4, "{found:?}");
    }
}

/// Within 0.005 of the integral: light goes r far and to all sides alike, so that a share of it goes farther along a line.
#[test]
fn light_along_a_line_is_the_integral_of_the_line_spread() {
    let ways: Vec<f32> = (0..60).map(|i| 0.01 * (i * i) as f32).collect();
    let rows = grid(&[&ways, &[0.2, 0.757, 3.0]]);
    let body = "
        let x = input[base]; let d = input[base + 1u];
        var sum = 0.0;
        for (var k = 0; k < 8192; k++) {
            let r = burley_radius((f32(k) + 0.5) / 8192.0, d);
            sum += select(0.0, acos(min(x / max(r, 1e-9), 1.0)) * 0.6366198, r > x);
        }
        output[out] = line_beyond(x, line_rate(vec3f(d))).x;
        output[out + 1u] = sum / 8192.0;
        output[out + 2u] = line_beyond(x + 0.01, line_rate(vec3f(d))).x;";
    for (i, found) in run(&DIFFUSE, body, &rows, 3).iter().enumerate() {
        assert_close("light beyond", i, &found[..1], &found[1..2], 5e-3);
        assert!(found[2] <= found[0] && found[2] >= 0.0, "case {i}: {found:?}");
    }
    let all = run(&DIFFUSE, "output[out] = line_beyond(0.0, line_rate(vec3f(input[base]))).x;", &[vec![0.757]], 1);
    assert_close("all of the light", 0, &all[0], &[1.0], 1e-6);
}

/// Values lie at centres of texels, and no block of rows bleeds into the next.
#[test]
fn places_in_the_table_are_texels() {
    // Which function, its two numbers, and the texel.
    let places: [[f32; 5]; 19] = [
        [0.0, -1.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 1.0, 63.0, 63.0],
        [0.0, -1.0 + 20.0 / 63.0, 10.0 / 63.0, 10.0, 10.0],
        [0.0, 7.0, 9.0, 63.0, 63.0],
        [0.0, -7.0, -9.0, 0.0, 0.0],
        [1.0, 0.0, 2.0, 0.0, 95.0],
        [1.0, 1.0, 1e9, 63.0, 64.0],
        [1.0, 9.0 / 63.0, 62.0, 9.0, 65.0],
        [1.0, 9.0 / 63.0, 6.2, 9.0, 74.0],
        [1.0, 2.0, 0.0, 63.0, 95.0],
        [1.0, -2.0, -1.0, 0.0, 95.0],
        [2.0, 0.0, 8.0, 0.0, 96.0],
        [2.0, 2.0, 8.0, 31.5, 96.0],
        [2.0, 80.0, 8.0, 63.0, 96.0],
        [2.0, 0.0, 0.0, 0.0, 96.0],
        [3.0, 2.0, 8.0, 31.5, 97.0],
        [3.0, -2.0, 8.0, 0.0, 97.0],
        [4.0, 0.0, 0.0, 0.0, 98.0],
        [4.0, 1.5, 0.0, 63.0, 98.0],
    ];
    let rows: Vec<Vec<f32>> = places.iter().map(|p| p.to_vec()).collect();
    let body = "
        let a = input[base + 1u]; let b = input[base + 2u];
        var at = diffused_place(a, b);
        if input[base] == 1.0 { at = penumbra_place(a, b); }
        if input[base] > 1.5 { at = transmittance_place(a, b, input[base] == 3.0); }
        if input[base] == 4.0 { at = albedo_place(a); }
        output[out] = at.x * f32(TABLE_COLUMNS) - 0.5;
        output[out + 1u] = at.y * f32(TABLE_ROWS) - 0.5;";
    for (i, found) in run(&DIFFUSE, body, &rows, 2).iter().enumerate() {
        assert_close("texel", i, found, &places[i][3..], 2e-5);
    }
}
