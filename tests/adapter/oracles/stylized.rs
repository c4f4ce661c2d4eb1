//! Looks of the body: ramps, fur, rims, highlights, stones, fire, fluff, what vanishes, tones.

use super::{assert_close, cases, numbers, run, vectors};

#[test]
fn fur_shows_its_strokes_by_region() {
    let file = vectors("stylized.json");
    let list = cases(&file, "fur");
    let rows: Vec<Vec<f32>> =
        list.iter().map(|c| numbers(c, &["NoL", "t_back", "t_lit", "soft", "flat", "detail"])).collect();
    let body = "
        let masks = fur_masks(input[base], vec2f(input[base + 1u], input[base + 2u]), input[base + 3u]);
        write3(out, masks);
        write3(out + 3u, fur_color(masks, vec3f(0.2, 0.8, 0.5), input3(base + 4u), input3(base + 7u)));";
    for (i, (case, found)) in list.iter().zip(run(&["fur"], body, &rows, 6)).enumerate() {
        assert_close("fur", i, &found, &numbers(case, &["lit", "terminator", "back", "color"]), 1e-5);
    }
}

/// Regions of fur sum to 1 and none is negative, up to the softest borders that are allowed; a flat colour that is the mean
/// of the detail keeps that mean.
#[test]
fn fur_masks_partition_unity() {
    let rows: Vec<Vec<f32>> =
        (-100..=100).flat_map(|x| [0.0f32, 0.05, 0.225].map(|soft| vec![x as f32 / 100.0, soft.max(1e-4)])).collect();
    let body = "
        let masks = fur_masks(input[base], vec2f(-0.15, 0.3), input[base + 1u]);
        let shares = vec3f(0.2, 0.8, 0.5);
        let light = fur_color(masks, shares, vec3f(0.5), vec3f(0.9));
        let dark = fur_color(masks, shares, vec3f(0.5), vec3f(0.1));
        write3(out, masks);
        output[out + 3u] = (light.x + dark.x) * 0.5;";
    for (row, found) in rows.iter().zip(run(&["fur"], body, &rows, 4)) {
        assert!((found[..3].iter().sum::<f32>() - 1.0).abs() < 1e-6, "{row:?}: {found:?}");
        assert!(found[..3].iter().all(|m| *m >= -1e-6) && (found[3] - 0.5).abs() < 1e-6, "{row:?}: {found:?}");
    }
}

#[test]
fn strips_are_dark_at_their_roots() {
    let file = vectors("stylized.json");
    let list = cases(&file, "strip_ao");
    let rows: Vec<Vec<f32>> = list.iter().map(|c| numbers(c, &["t", "k"])).collect();
    let body = "write3(out, strip_occlusion(input[base], vec3f(0.0, input[base + 1u], 2.0 * input[base + 1u])));";
    for (i, (case, found)) in list.iter().zip(run(&["strips"], body, &rows, 3)).enumerate() {
        let ao = numbers(case, &["ao"])[0];
        assert_close("strip", i, &found, &[1.0, ao, ao * ao], 1e-6);
    }
}

/// 16 bits of a place go through a colour of 8 bits a number, and between two vertices.
#[test]
fn places_along_a_strip_go_through_colours() {
    let bytes = |t: f32| ((t * 65535.0).round() as u16).to_be_bytes().map(|b| f32::from(b) / 255.0);
    let pairs = [(0.0, 1.0), (0.2, 0.2039), (0.4999, 0.5001)];
    let rows: Vec<Vec<f32>> = pairs.map(|(a, b)| [bytes(a), bytes(b)].concat()).into();
    let body = "
        let a = vec4f(input[base], input[base + 1u], 0.0, 0.0);
        let b = vec4f(input[base + 2u], input[base + 3u], 0.0, 0.0);
        write3(out, vec3f(strip_place(a), strip_place(b), strip_place(mix(a, b, 0.25))));";
    for (i, ((a, b), found)) in pairs.iter().zip(run(&["strips"], body, &rows, 3)).enumerate() {
        assert_close("place", i, &found, &[*a, *b, a + (b - a) * 0.25], 2e-5);
    }
}

/// A ramp of bands begins with the shade and ends with the light, exactly, and passes the terminator between.
#[test]
fn bands_of_a_ramp_end_in_shade_and_light() {
    let rows: Vec<Vec<f32>> = [0.0f32, 0.3, 0.48, 0.6, 1.0].map(|p| vec![p]).into();
    let body = "write3(out, ramp_bands(vec3f(0.9, 0.8, 0.7), vec3f(0.2, 0.1, 0.3), vec3f(0.8, 0.4, 0.3),
        vec4f(0.4, 0.46, 0.5, 0.56), input[base]));";
    let found = run(&["shade_ramp"], body, &rows, 3);
    assert_eq!(found, [[0.2, 0.1, 0.3], [0.2, 0.1, 0.3], [0.8, 0.4, 0.3], [0.9, 0.8, 0.7], [0.9, 0.8, 0.7]]);
}

/// The rim's place lies as many pixels along the normal as asked, at any height of the picture; creases below the threshold
/// have none, and neither has the side away from the light.
#[test]
fn depth_rims_have_a_width_a_threshold_and_a_side() {
    let rows = vec![vec![1.0, 0.0], vec![0.0, 0.2], vec![-0.3, 0.4], vec![0.0, 0.0]];
    let body = "
        let moved = depth_rim_offset(vec2f(input[base], input[base + 1u]), 4.0, 2048.0);
        output[out] = moved.x; output[out + 1u] = moved.y;";
    let found = run(&["depth_rim"], body, &rows, 2);
    for (i, (found, expected)) in found.iter().zip([[8.0, 0.0], [0.0, -8.0], [-4.8, -6.4], [0.0, 0.0]]).enumerate() {
        assert_close("rim", i, found, &expected, 1e-5);
    }
    let rows =
        vec![vec![0.02, 0.5], vec![0.04, 0.5], vec![0.05, 0.5], vec![1e9, 0.5], vec![1.0, -0.01], vec![1.0, 0.15]];
    let body =
        "output[out] = depth_rim_step(input[base], 0.04) * depth_rim_side(input[base + 1u], 1.0, vec2f(0.0, 0.3));";
    let found = run(&["depth_rim"], body, &rows, 1);
    for (i, (found, expected)) in found.iter().zip([0.0, 0.0, 1.0, 1.0, 0.0, 0.5]).enumerate() {
        assert_close("rim", i, found, &[expected], 1e-5);
    }
}

/// Operators of shaped highlights follow the vectors and are the identity at 0; a moved one is found at atan of the movement.
#[test]
fn shaped_highlights_follow_their_operators() {
    let file = vectors("stylized.json");
    let list = cases(&file, "metal_highlight");
    let rows: Vec<Vec<f32>> =
        list.iter().map(|c| numbers(c, &["N", "X", "Y", "H", "dx", "dy", "sx", "split_x", "split_y"])).collect();
    let body = "
        let x = input3(base + 3u); let y = input3(base + 6u); let h = input3(base + 9u);
        let i = base + 12u;
        write3(out, highlight_moved(h, x, y, vec2f(input[i], input[i + 1u]), input[i + 2u],
            vec2f(input[i + 3u], input[i + 4u])));
        write3(out + 3u, highlight_moved(h, x, y, vec2f(0.0), 0.0, vec2f(0.0)) - h);
        // The normal that a moved H meets: it leans by atan of the movement from the H that came in along it.
        let n = cross(x, y);
        let moved = highlight_moved(n, x, y, vec2f(input[i], 0.0), 0.0, vec2f(0.0));
        output[out + 6u] = atan2(dot(moved, x), dot(moved, n)) - atan(input[i]);";
    for (i, (case, found)) in list.iter().zip(run(&["shaped_highlight"], body, &rows, 7)).enumerate() {
        assert_close("highlight", i, &found[..3], &numbers(case, &["H_out"]), 1e-5);
        assert_close("identity and movement", i, &found[3..], &[0.0; 4], 2e-4);
    }
    // Borders: half a pixel to both sides; a square reaches its corner where the disc does not.
    let rows = vec![vec![0.2, 0.2, 0.0], vec![0.21, 0.0, 0.0], vec![0.19, 0.19, 1.0], vec![0.2, 0.0, 1.0]];
    let body = "output[out] = highlight_inside(highlight_distance(input[base], input[base + 1u], input[base + 2u]), 0.2, 0.01);";
    let found = run(&["shaped_highlight"], body, &rows, 1);
    for (found, expected) in found.iter().zip([0.0, 0.0, 1.0, 0.5]) {
        assert!((found[0] - expected).abs() < 1e-3, "{found:?}, expected {expected}");
    }
}

/// Refraction, Fresnel and absorption in stones follow the vectors; what is mirrored and what goes through sum to 1, and past
/// the critical angle all is mirrored.
#[test]
fn stones_refract_mirror_and_absorb() {
    let file = vectors("stylized.json");
    let list = cases(&file, "gem");
    let rows: Vec<Vec<f32>> = list
        .iter()
        .map(|c| {
            let [ior, theta] = numbers(c, &["ior", "theta"])[..] else { panic!("two numbers") };
            vec![ior, theta.sin(), theta.cos()]
        })
        .collect();
    let body = "
        let ior = input[base];
        let r = refract(-vec3f(input[base + 1u], 0.0, input[base + 2u]), vec3f(0.0, 0.0, 1.0), 1.0 / ior);
        output[out] = atan2(length(r.xy), -r.z);
        output[out + 1u] = length(parallax(r, 1.0));
        // e^-2 a millimetre, one of them down.
        output[out + 2u] = absorbed(vec3f(0.1353352832), r, 1.0).x;
        output[out + 3u] = fresnel(1.0, ior);";
    for (i, (case, found)) in list.iter().zip(run(&["gem"], body, &rows, 4)).enumerate() {
        let expected = numbers(case, &["theta_t", "parallax_per_depth", "beer_1mm_2", "F0"]);
        assert_close("gem", i, &found, &expected, 1e-3);
    }
    let rows: Vec<Vec<f32>> = [0.6f32, 1.0 / 2.417, 1.0, 1.54, 2.417]
        .iter()
        .flat_map(|ior| (0..=50).map(|i| vec![*ior, i as f32 / 50.0]))
        .collect();
    let body = "output[out] = fresnel(input[base + 1u], input[base]);";
    for (row, found) in rows.iter().zip(run(&["gem"], body, &rows, 1)) {
        let through = transmittance(f64::from(row[1]), f64::from(row[0]));
        let mirrored = f64::from(found[0]);
        let sin = (1.0 - row[1] * row[1]).sqrt();
        // Away from the very edge of the critical angle, where the share rises without bound.
        if (sin - row[0]).abs() < 1e-3 {
            continue;
        }
        assert!((mirrored + through - 1.0).abs() < 2e-5 && (0.0..=1.000_01).contains(&mirrored), "{row:?}: {found:?}");
        if sin > row[0] {
            assert_eq!(found[0], 1.0, "{row:?} is past the critical angle");
        }
    }
}

/// Share of light that goes through from index 1 into `n`, by the amplitudes that are let through and the beam's change in
/// width (Fresnel), both polarisations alike.
fn transmittance(cos_i: f64, n: f64) -> f64 {
    let sin_sq = (1.0 - cos_i * cos_i) / (n * n);
    if sin_sq >= 1.0 || cos_i == 0.0 {
        return 0.0;
    }
    let cos_t = (1.0 - sin_sq).sqrt();
    let s = 2.0 * cos_i / (cos_i + n * cos_t);
    let p = 2.0 * cos_i / (n * cos_i + cos_t);
    n * cos_t / cos_i * 0.5 * (s * s + p * p)
}

/// Rays in a brilliant keep their light or share it with what leaves: never more than 1; directions stay unit; a
/// stone that is turned by half is the same stone, and other indices leave apart.
#[test]
fn rays_in_a_diamond_leave_with_what_they_brought() {
    let rows: Vec<Vec<f32>> = (0..200)
        .map(|i| {
            let (a, t) = (i as f32 * 2.399_963, (i as f32 + 0.5) / 200.0);
            let r = t.sqrt() * 0.4;
            vec![a.cos() * r, a.sin() * r, a.sin() * 0.35, a.cos() * 0.35]
        })
        .collect();
    let body = "
        let start = vec3f(input[base], input[base + 1u], 0.2);
        let d = normalize(vec3f(input[base + 2u], input[base + 3u], -1.0));
        let one = diamond_path(start, d, 2.417, 3u, 8.0);
        let turned = diamond_path(start * vec3f(-1.0, -1.0, 1.0), d * vec3f(-1.0, -1.0, 1.0), 2.417, 3u, 8.0);
        let other = diamond_path(start, d, 2.44, 3u, 8.0);
        output[out] = one.share;
        output[out + 1u] = length(one.direction);
        output[out + 2u] = distance(one.direction, turned.direction * vec3f(-1.0, -1.0, 1.0));
        output[out + 3u] = distance(one.direction, other.direction);";
    let found = run(&["gem", "diamond"], body, &rows, 4);
    for (row, f) in rows.iter().zip(&found) {
        assert!((0.0..=1.000_01).contains(&f[0]) && (f[1] - 1.0).abs() < 1e-3, "{row:?}: {f:?}");
    }
    // Where two facets are as near as each other either may be taken.
    let symmetric = found.iter().filter(|f| f[2] < 1e-3).count();
    assert!(symmetric > 190, "{symmetric} of 200 rays go the same way in a stone that is turned by half");
    let apart = found.iter().filter(|f| f[3] > 1e-3).count();
    assert!(apart > 40, "{apart} of 200 rays are dispersed");
    let bright = found.iter().filter(|f| f[0] > 0.5).count();
    assert!(bright > 120, "{bright} of 200 rays come back");
}

/// Noise of fire is the same after a period, and elsewhere between; what is left falls with erosion, from all to nothing.
#[test]
fn fire_repeats_and_erodes() {
    let rows: Vec<Vec<f32>> = (0..400).map(|i| vec![(i % 20) as f32 / 20.0 + 0.013, (i / 20) as f32 / 20.0]).collect();
    let body = "
        let uv = vec2f(input[base], input[base + 1u]);
        output[out] = abs(fire_noise(uv, 0.0, 4) - fire_noise(uv, 1.0, 4)) + abs(fire_sway(uv, 0.0, 4, 0.1) - fire_sway(uv, 1.0, 4, 0.1));
        output[out + 1u] = abs(fire_noise(uv, 0.0, 4) - fire_noise(uv, 0.5, 4));
        output[out + 2u] = fire_noise(uv, 0.3, 4);";
    let found = run(&["noise", "fire"], body, &rows, 3);
    assert!(found.iter().all(|f| f[0] < 1e-5 && (0.0..=1.0).contains(&f[2])), "it repeats");
    assert!(found.iter().map(|f| f[1]).sum::<f32>() > 20.0, "it moves");
    let rows: Vec<Vec<f32>> = (0..=20).flat_map(|e| [0.0, 0.3, 1.0].map(|h| vec![e as f32 / 20.0, h])).collect();
    let body = "output[out] = fire_cover(input[base + 1u], input[base], 0.05);";
    let found = run(&["noise", "fire"], body, &rows, 1);
    for heat in 0..3 {
        let cover: Vec<f32> = found.iter().skip(heat).step_by(3).map(|f| f[0]).collect();
        assert!(cover.windows(2).all(|w| w[1] <= w[0]), "{cover:?} grows with erosion");
        assert!(cover[0] == 1.0 && cover[20] < 1e-6, "{cover:?} is whole at 0 and gone at 1");
    }
}

/// Noise is smooth, repeats after its period, and fills its range.
#[test]
fn noise_repeats_without_a_seam() {
    let rows: Vec<Vec<f32>> =
        (0..900).map(|i| vec![(i % 30) as f32 * 0.37 - 5.0, (i / 30) as f32 * 0.41 - 6.0]).collect();
    let body = "
        let p = vec2f(input[base], input[base + 1u]);
        let n = value_noise(p, vec2i(5, 7), 3);
        output[out] = n;
        output[out + 1u] = abs(n - value_noise(p + vec2f(5.0, -14.0), vec2i(5, 7), 3));
        output[out + 2u] = abs(n - value_noise(p + vec2f(0.001), vec2i(5, 7), 3));";
    let found = run(&["noise"], body, &rows, 3);
    assert!(found.iter().all(|f| f[1] < 1e-4 && f[2] < 0.01), "it repeats and is smooth");
    let (low, high) = found.iter().fold((1.0f32, 0.0f32), |(l, h), f| (l.min(f[0]), h.max(f[0])));
    assert!((0.0..0.15).contains(&low) && (0.85..=1.0).contains(&high), "{low}..{high}");
}

/// A shell covers less the higher it is; no strand reaches over the length, and the skin is covered where strands stand.
#[test]
fn shells_of_fluff_grow_thin() {
    let rows: Vec<Vec<f32>> = (0..400).map(|i| vec![(i % 20) as f32 * 0.33, (i / 20) as f32 * 0.29]).collect();
    let body = "
        let height = fluff_strand(vec2f(input[base], input[base + 1u])).w;
        output[out] = height;
        for (var i = 0u; i <= 8u; i++) { output[out + 1u + i] = fluff_cover(height, f32(i) / 8.0, 0.35); }";
    let found = run(&["noise", "fluff"], body, &rows, 10);
    assert!(found.iter().all(|f| (-0.1..=1.0).contains(&f[0])), "heights are shares of the length");
    let cover: Vec<f32> = (1..10).map(|k| found.iter().map(|f| f[k]).sum::<f32>() / 400.0).collect();
    assert!(cover.windows(2).all(|w| w[1] < w[0]), "{cover:?} falls with the level");
    assert!(cover[0] > 0.95 && cover[8] < 0.05, "{cover:?}");
    // One shell in a pixel and a half, within bounds.
    let rows = vec![vec![0.008, 100.0, 16.0], vec![0.008, 990.0, 16.0], vec![0.008, 1e5, 16.0]];
    let body = "output[out] = fluff_shells(input[base], input[base + 1u], input[base + 2u]);";
    assert_eq!(run(&["noise", "fluff"], body, &rows, 1), [[4.0], [6.0], [16.0]]);
}

/// What burns is whole at 0 and gone at 1, and goes in order; each pixel of the dither pattern has its own threshold.
#[test]
fn surfaces_vanish_from_whole_to_nothing() {
    let rows: Vec<Vec<f32>> = (0..=20).flat_map(|a| [0.0f32, 0.4, 1.0].map(|t| vec![a as f32 / 20.0, t])).collect();
    let body = "output[out] = dissolve_place(input[base + 1u], input[base], 0.1);";
    let found = run(&["noise", "dissolve"], body, &rows, 1);
    for time in 0..3 {
        let place: Vec<f32> = found.iter().skip(time).step_by(3).map(|f| f[0]).collect();
        assert!(place.windows(2).all(|w| w[1] < w[0]), "{place:?} burns on");
        assert!(place[0] >= 1.0 - 1e-5 && place[20] <= 1e-5, "{place:?} is whole at 0, gone at 1");
    }
    let rows: Vec<Vec<f32>> = (0..64).map(|i| vec![(i % 8) as f32, (i / 8) as f32]).collect();
    let body = "output[out] = dither_threshold(vec2u(u32(input[base]), u32(input[base + 1u])));";
    let mut found: Vec<f32> = run(&["noise", "dissolve"], body, &rows, 1).concat();
    found.sort_by(f32::total_cmp);
    assert!(found.iter().enumerate().all(|(i, t)| (t - (i as f32 + 0.5) / 64.0).abs() < 1e-6), "{found:?}");
    // Of the samples of 8 x 8 pixels as many are left as should be, and of each of the four alike.
    for left in [0.0f32, 0.125, 0.3, 0.5, 0.9, 1.0] {
        let rows: Vec<Vec<f32>> = (0..64).map(|i| vec![(i % 8) as f32, (i / 8) as f32, left]).collect();
        let body =
            "output[out] = f32(dither_samples(input[base + 2u], vec2u(u32(input[base]), u32(input[base + 1u]))));";
        let found = run(&["noise", "dissolve"], body, &rows, 1);
        let counts = [0, 1, 2, 3].map(|bit| found.iter().filter(|f| f[0] as u32 >> bit & 1 == 1).count());
        let share = counts.iter().sum::<usize>() as f32 / 256.0;
        assert!((share - left).abs() < 1.0 / 128.0, "{share} of {left}");
        assert!(counts.iter().all(|c| (*c as f32 / 64.0 - left).abs() < 0.13), "{counts:?} of {left}");
    }
}

/// A stocking covers its share face on, more aslant, and all at the contour; a blink begins at its peak and reaches its low.
#[test]
fn stockings_and_blinks_have_their_shares() {
    let rows: Vec<Vec<f32>> = (1..=20).map(|i| vec![i as f32 / 20.0]).collect();
    let body =
        "output[out] = stocking_cover(0.55, input[base]); output[out + 1u] = blink(input[base] - 0.05, 0.2, 0.5);";
    let found = run(&["stocking", "emission"], body, &rows, 2);
    assert!((found[19][0] - 0.55).abs() < 1e-5 && found[0][0] > 0.999, "{found:?}");
    assert!(found.windows(2).all(|w| w[1][0] <= w[0][0] + 1e-6), "it thins towards the viewer");
    assert!((found[0][1] - 1.0).abs() < 1e-5 && (found[10][1] - 0.2).abs() < 1e-5, "{found:?}");
}

/// Tone curves leave what is painted, keep order and hue, and end at white.
#[test]
fn tone_curves_leave_painted_colours() {
    let rows: Vec<Vec<f32>> = (0..=100).map(|i| vec![i as f32 * 0.05]).collect();
    let body = "
        let c = vec3f(input[base], input[base] * 0.5, input[base] * 0.1);
        write3(out, toned(c, TONE_FILMIC)); write3(out + 3u, toned(c, TONE_NEUTRAL)); write3(out + 6u, toned(c, 0u));";
    let found = run(&["tone"], body, &rows, 9);
    for (row, f) in rows.iter().zip(&found) {
        let painted = [row[0], row[0] * 0.5, row[0] * 0.1];
        assert_eq!(f[6..9], painted);
        if row[0] <= 0.75 {
            assert_eq!(f[0..3], painted, "filmic");
            assert_eq!(f[3..6], painted, "neutral");
        }
        assert!(f[..6].iter().all(|c| (0.0..=1.0).contains(c)), "{row:?}: {f:?}");
        assert!(
            f[0] >= f[1] && f[1] >= f[2] && f[3] >= f[4] && f[4] >= f[5],
            "{row:?}: {f:?} keeps the order of channels"
        );
    }
    assert!(found.windows(2).all(|w| w[1][0] >= w[0][0] - 1e-5 && w[1][3] >= w[0][3] - 1e-5), "they keep order");
}
