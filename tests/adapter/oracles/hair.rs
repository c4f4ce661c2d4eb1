//! Light on hair: Kajiya-Kay lobes, and the fibre model with its laws.

use serde_json::Value;

use super::{assert_close, cases, numbers, run, vectors};

/// The rows of cases with numbers of their own before those at the paths.
fn rows(list: &[Value], before: impl Fn(&Value) -> Vec<f32>, paths: &[&str]) -> Vec<Vec<f32>> {
    list.iter().map(|case| [before(case), numbers(case, paths)].concat()).collect()
}

fn none(_: &Value) -> Vec<f32> {
    Vec::new()
}

/// Sines and cosines of angles: drivers take those lightly, and shading has them from vectors.
fn directions(case: &Value, angles: &[&str]) -> Vec<f32> {
    numbers(case, angles).into_iter().flat_map(|a| [f64::from(a).sin() as f32, f64::from(a).cos() as f32]).collect()
}

#[test]
fn strand_highlights_follow_their_vectors() {
    let file = vectors("hair_kajiya_kay.json");
    let list = cases(&file, "cases");
    let rows = rows(list, none, &["N", "T", "L", "V", "shift1", "n1", "shift2", "n2"]);
    let body = "
        let n = input3(base); let t = input3(base + 3u); let l = input3(base + 6u); let v = input3(base + 9u);
        let h = normalize(l + v);
        let first = shifted_strand(t, n, input[base + 12u]);
        write3(out, first);
        output[out + 3u] = strand_specular(first, h, input[base + 13u]);
        output[out + 4u] = strand_specular(shifted_strand(t, n, input[base + 14u]), h, input[base + 15u]);
        output[out + 5u] = wrapped_lambert(dot(n, l), 1.0);
        output[out + 6u] = wrapped_lambert(dot(n, l), 1.0 / 3.0);
        output[out + 7u] = strand_specular(first, normalize(v + l), input[base + 13u]);";
    for (i, (case, found)) in list.iter().zip(run(&["kajiya_kay"], body, &rows, 8)).enumerate() {
        let expected = numbers(case, &["T1", "spec1", "spec2", "half_lambert", "diffuse_scheuermann", "spec1"]);
        assert_close("kajiya-kay", i, &found, &expected, 1e-4);
    }
}

/// On a sphere of 512 pixels the highlight moves by atan(shift) towards the tip, to half a pixel.
#[test]
fn highlights_move_by_the_angle_of_their_shift() {
    let file = vectors("hair_kajiya_kay.json");
    for case in cases(&file, "peak_on_sphere") {
        let [shift, theta_h, peak] = numbers(case, &["shift", "theta_H", "theta_peak"])[..] else { panic!("three") };
        // A radian of the sphere is 256 pixels.
        let px = 1.0 / 256.0;
        let rows: Vec<Vec<f32>> = (-60..=60).map(|i| vec![peak + i as f32 * px * 0.25, theta_h, shift]).collect();
        let body = "
            let at = input[base]; let half = input[base + 1u];
            let n = vec3f(sin(at), cos(at), 0.0); let t = vec3f(cos(at), -sin(at), 0.0);
            output[out] = strand_specular(shifted_strand(t, n, input[base + 2u]), vec3f(sin(half), cos(half), 0.0), 4000.0);";
        let found = run(&["kajiya_kay"], body, &rows, 1);
        let brightest = (0..rows.len()).max_by(|a, b| found[*a][0].total_cmp(&found[*b][0])).expect("some");
        let off_px = (rows[brightest][0] - peak).abs() / px;
        assert!(off_px <= 0.5, "shift {shift}: {off_px} px");
    }
}

/// Half of the peak is left at acos(0.5^(1/n)).
#[test]
fn highlights_have_the_width_of_their_exponent() {
    let rows: Vec<Vec<f32>> = [4.0f32, 20.0, 80.0, 300.0].map(|n| vec![n, 0.5f32.powf(1.0 / n).acos()]).into();
    let body = "output[out] = strand_specular(vec3f(1.0, 0.0, 0.0), vec3f(sin(input[base + 1u]), cos(input[base + 1u]), 0.0), input[base])
        / smoothstep(-1.0, 0.0, sin(input[base + 1u]));";
    for (i, found) in run(&["kajiya_kay"], body, &rows, 1).iter().enumerate() {
        assert_close("width", i, found, &[0.5], 1e-4);
    }
}

#[test]
fn longitudinal_scattering_follows_its_vectors() {
    let file = vectors("hair_mp.json");
    let list = cases(&file, "cases");
    let rows = rows(list, |c| directions(c, &["theta_i", "theta_r"]), &["v"]);
    let body = "
        let sharp = 1.0 / input[base + 4u]; let scale = sharp / (1.0 - exp(-2.0 * sharp));
        output[out] = fibre_longitudinal(sharp, scale, input[base], input[base + 1u], input[base + 2u], input[base + 3u]);";
    let found = run(&["fibre"], body, &rows, 1);
    for (i, (case, found)) in list.iter().zip(&found).enumerate() {
        let expected = numbers(case, &["M"])[0];
        assert!(found[0].is_finite(), "case {i}");
        assert!((found[0] - expected).abs() <= 2e-3 * expected.max(1e-6), "case {i}: {found:?}, expected {expected}");
    }
}

/// No energy is lost along the fibre, at any roughness and any inclination.
#[test]
fn longitudinal_scattering_conserves_energy() {
    let mut rows = Vec::new();
    for beta in [0.05f32, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0] {
        let v = (0.726 * beta + 0.812 * beta * beta + 3.7 * beta.powi(20)).powi(2);
        for degrees in [-85.0f32, -60.0, -30.0, 0.0, 15.0, 45.0, 75.0, 85.0] {
            rows.push(vec![v, degrees.to_radians().sin(), degrees.to_radians().cos()]);
        }
    }
    let body = "
        var sum = 0.0;
        let sharp = 1.0 / input[base]; let scale = sharp / (1.0 - exp(-2.0 * sharp));
        for (var k = 0; k < 8192; k++) {
            // Even steps of the sine: the cosine of the measure is in them.
            let o = (f32(k) + 0.5) / 4096.0 - 1.0;
            sum += fibre_longitudinal(sharp, scale, input[base + 1u], input[base + 2u], o, sqrt(1.0 - o * o));
        }
        output[out] = sum / 4096.0;";
    for (row, found) in rows.iter().zip(run(&["fibre"], body, &rows, 1)) {
        assert!((found[0] - 1.0).abs() <= 1e-3, "{row:?}: {}", found[0]);
    }
}

#[test]
fn attenuation_follows_its_vectors() {
    let file = vectors("hair_attenuation.json");
    let list = cases(&file, "cases");
    let rows = rows(list, |c| directions(c, &["theta"]), &["h", "eta", "sigma_a"]);
    let body = "
        let c = fibre_crossing(input[base], input[base + 1u], input[base + 2u], input[base + 3u]);
        output[out] = c.gamma_i; output[out + 1u] = c.gamma_t; output[out + 2u] = c.fresnel; output[out + 3u] = c.length;
        for (var k = 0u; k < 3u; k++) {
            let a = fibre_attenuation(c.fresnel, exp(-input[base + 4u + k] * c.length));
            output[out + 4u + k] = a.x; output[out + 7u + k] = a.y;
            output[out + 10u + k] = a.z; output[out + 13u + k] = a.w;
        }";
    let paths = ["gamma_i", "gamma_t", "fresnel", "path_length", "A0", "A1", "A2", "A3plus"];
    for (i, (case, found)) in list.iter().zip(run(&["fibre"], body, &rows, 16)).enumerate() {
        assert_close("attenuation", i, &found, &numbers(case, &paths), 1e-4);
        let sum: f32 = [4, 7, 10, 13].map(|k| found[k]).iter().sum();
        assert!(sum <= 1.0 + 1e-5, "case {i} gains energy: {sum}");
    }
}

#[test]
fn azimuthal_scattering_follows_its_vectors() {
    let file = vectors("hair_azimuthal.json");
    let list = cases(&file, "near_field");
    let near = rows(list, |c| directions(c, &["theta"]), &["p", "h", "eta", "s", "phi"]);
    let body = "
        let c = fibre_crossing(input[base], input[base + 1u], input[base + 3u], input[base + 4u]);
        let exit = fibre_exit(input[base + 2u], c.gamma_i, c.gamma_t);
        output[out] = exit;
        output[out + 1u] = trimmed_logistic(input[base + 6u] - exit, input[base + 5u]);";
    for (i, (case, found)) in list.iter().zip(run(&["fibre"], body, &near, 2)).enumerate() {
        assert_close("exit", i, &found[..1], &numbers(case, &["Phi"]), 1e-4);
        let expected = numbers(case, &["D"])[0];
        assert_close("detector", i, &found[1..], &[expected], (expected * 5e-3).max(1e-5));
    }

    let list = cases(&file, "far_field");
    let before = |c: &Value| [directions(c, &["theta"]), vec![f32::from(u8::from(c["kind"] == "gaussian"))]].concat();
    let far = rows(list, before, &["phi", "eta", "width", "p", "sigma_a"]);
    let body = "
        let d = Detector(input[base + 5u], input[base + 2u] > 0.5);
        for (var k = 0u; k < 3u; k++) {
            let n = fibre_azimuthal(
                input[base + 3u], input[base], input[base + 1u], input[base + 4u], input[base + 7u + k], d, 128u
            );
            output[out + k] = n[u32(input[base + 6u])];
        }";
    let found = run(&["fibre"], body, &far, 3);
    // Against the peak of the same lobe, as a picture would show it.
    let lobe = |c: &Value| (c["p"].clone(), c["theta"].clone(), c["kind"].clone(), c["width"].clone());
    for (i, (case, found)) in list.iter().zip(&found).enumerate() {
        let peak = list.iter().filter(|c| lobe(c) == lobe(case)).flat_map(|c| numbers(c, &["N"])).fold(0.0, f32::max);
        assert_close("far field", i, found, &numbers(case, &["N"]), peak * 1e-2);
    }
}

/// A nearly smooth fibre scatters as a smooth one, whose roots are known, away from its caustics.
#[test]
fn azimuthal_scattering_has_the_limit_of_a_smooth_fibre() {
    let file = vectors("hair_azimuthal.json");
    let list = cases(&file, "smooth");
    let rows = rows(list, |c| directions(c, &["theta"]), &["phi", "eta", "p", "sigma_a"]);
    let body = "
        for (var k = 0u; k < 3u; k++) {
            let n = fibre_azimuthal(
                input[base + 2u], input[base], input[base + 1u], input[base + 3u], input[base + 5u + k],
                Detector(0.01, true), 4096u
            );
            output[out + k] = n[u32(input[base + 4u])];
        }";
    for (i, (case, found)) in list.iter().zip(run(&["fibre"], body, &rows, 3)).enumerate() {
        let expected = numbers(case, &["N"]);
        let most = expected.iter().copied().fold(0.0, f32::max);
        assert_close("smooth limit", i, &found, &expected, (most * 0.02).max(2e-4));
    }
}

#[test]
fn the_whole_fibre_follows_its_vectors() {
    let file = vectors("hair_bcsdf.json");
    let list = cases(&file, "cases");
    let rough = |c: &Value| {
        let [m, n] = numbers(c, &["beta_m", "beta_n"])[..] else { panic!("two") };
        let v = (0.726 * m + 0.812 * m * m + 3.7 * m.powi(20)).powi(2);
        let mut row = vec![v, 0.626_657_07 * (0.265 * n + 1.194 * n * n + 5.372 * n.powi(22))];
        row.extend(directions(c, &["theta_o", "theta_i"]));
        let alpha = numbers(c, &["alpha"])[0];
        row.extend([-2.0, 1.0, 4.0].into_iter().flat_map(|tilt| [(tilt * alpha).sin(), (tilt * alpha).cos()]));
        row
    };
    let rows = rows(list, rough, &["phi", "h", "eta", "sigma_a"]);
    let body = "
        let v = input[base]; let s = input[base + 1u];
        let o = vec2f(input[base + 2u], input[base + 3u]); let i = vec2f(input[base + 4u], input[base + 5u]);
        let c = fibre_crossing(o.x, o.y, input[base + 13u], input[base + 14u]);
        let sharp = vec4f(1.0, 4.0, 0.25, 0.25) / v;
        let scales = sharp / (1.0 - exp(-2.0 * sharp));
        var m = vec4f(0.0);
        for (var p = 0u; p < 3u; p++) {
            let to = fibre_tilted(o.x, o.y, vec2f(input[base + 6u + 2u * p], input[base + 7u + 2u * p]));
            m[p] = fibre_longitudinal(sharp[p], scales[p], i.x, i.y, to.x, to.y)
                * trimmed_logistic(input[base + 12u] - fibre_exit(f32(p), c.gamma_i, c.gamma_t), s);
        }
        m.w = fibre_longitudinal(sharp.w, scales.w, i.x, i.y, o.x, o.y) / (2.0 * PI);
        for (var k = 0u; k < 3u; k++) {
            output[out + k] = dot(m, fibre_attenuation(c.fresnel, exp(-input[base + 15u + k] * c.length)));
        }";
    for (i, (case, found)) in list.iter().zip(run(&["fibre"], body, &rows, 3)).enumerate() {
        for (found, expected) in found.iter().zip(numbers(case, &["S"])) {
            let bound = (expected * 1e-2).max(1e-5);
            assert!((found - expected).abs() <= bound, "case {i}: {found}, expected {expected}");
        }
    }
}

/// A white fibre gives back all light, whatever its roughness, from any side, with tilted scales, too.
#[test]
fn a_white_fibre_in_a_furnace_vanishes() {
    let mut rows = Vec::new();
    for m in [0.1f32, 0.3, 0.5, 0.7, 0.9] {
        for n in [0.1f32, 0.3, 0.5, 0.7, 0.9] {
            for degrees in [0.0f32, 40.0, 70.0] {
                rows.push(vec![
                    (0.726 * m + 0.812 * m * m + 3.7 * m.powi(20)).powi(2),
                    0.626_657_07 * (0.265 * n + 1.194 * n * n + 5.372 * n.powi(22)),
                    degrees.to_radians().sin(),
                    degrees.to_radians().cos(),
                ]);
            }
        }
    }
    // Along: each lobe over all inclinations of the light. About: each lobe of a whole fibre over all angles. Mesa ends loops after
    // 65536 rounds in all.
    let body = "
        let v = input[base]; let d = Detector(input[base + 1u], false); let o = vec2f(input[base + 2u], input[base + 3u]);
        // Of two degrees.
        let tilts = array(vec2f(-0.06976, 0.99756), vec2f(0.0349, 0.99939), vec2f(0.13917, 0.99027), vec2f(0.0, 1.0));
        let sharp = vec4f(1.0, 4.0, 0.25, 0.25) / v;
        let scales = sharp / (1.0 - exp(-2.0 * sharp));
        var along = vec4f(0.0);
        for (var k = 0; k < 2048; k++) {
            let i = (f32(k) + 0.5) / 1024.0 - 1.0;
            for (var p = 0; p < 4; p++) {
                let to = fibre_tilted(o.x, o.y, tilts[p]);
                along[p] += fibre_longitudinal(sharp[p], scales[p], i, sqrt(1.0 - i * i), to.x, to.y) / 1024.0;
            }
        }
        var about = vec4f(0.0);
        for (var k = 0; k < 256; k++) {
            about += fibre_azimuthal((f32(k) + 0.5) / 256.0 * 2.0 * PI, o.x, o.y, 1.55, 0.0, d, 128u) * 2.0 * PI / 256.0;
        }
        output[out] = dot(along, about);";
    for (row, found) in rows.iter().zip(run(&["fibre"], body, &rows, 1)) {
        assert!((found[0] - 1.0).abs() <= 1e-2, "{row:?}: {}", found[0]);
    }
}

/// A body of hair that takes its colour from a texture has that share of the light of white hair.
#[test]
fn colours_become_absorption() {
    let rows: Vec<Vec<f32>> = (0..=100).map(|i| vec![(i as f32 / 100.0).max(0.005)]).collect();
    let body = "
        let sigma = fibre_absorption(vec3f(input[base]));
        output[out] = fibre_around(exp(-1.85 * sigma)).x / fibre_around(vec3f(1.0)).x;";
    for (row, found) in rows.iter().zip(run(&["fibre"], body, &rows, 1)) {
        assert!((found[0] - row[0]).abs() <= 0.01, "{}: {}", row[0], found[0]);
    }
}
