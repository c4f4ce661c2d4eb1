//! The shadow of a face and what is drawn on it; highlights of hair and face; eyes through hair.

use super::{assert_close, cases, numbers, run, vectors};

#[test]
fn face_light_angle_matches_the_vectors() {
    let file = vectors("sdf_edt.json");
    let list = cases(&file, "yaw_cases");
    let rows: Vec<Vec<f32>> = list.iter().map(|c| numbers(c, &["L", "forward", "up"])).collect();
    let body = "
        let l = input3(base); let forward = input3(base + 3u); let up = input3(base + 6u);
        let local = vec3f(dot(l, cross(up, forward)), dot(l, up), dot(l, forward));
        output[out] = face_light_angle(local, 0.0);
        output[out + 1u] = select(0.0, 1.0, local.x < 0.0);";
    let found = run(&["face_shadow"], body, &rows, 2);
    for (i, (case, found)) in list.iter().zip(&found).enumerate() {
        let mirror = f32::from(u8::from(case["mirror"].as_bool().expect("a side")));
        // Drivers approximate atan2.
        assert_close("angle of the light", i, found, &[numbers(case, &["threshold"])[0], mirror], 5e-5);
    }
}

/// Thresholds × angles of the light in steps of 1 degree: what is lit only shrinks, sides mirror to the bit, the reserved
/// codes hold at any softness, and half is reached at the threshold.
#[test]
fn a_face_darkens_once_and_the_same_on_both_sides() {
    const THRESHOLDS: usize = 33;
    let rows: Vec<Vec<f32>> = (0..THRESHOLDS)
        .flat_map(|t| (0..=180).map(move |degrees| (t as f32 / (THRESHOLDS - 1) as f32, degrees as f32)))
        .flat_map(|(tau, degrees)| [0.002, 0.02, 0.2].map(|softness| vec![tau, degrees.to_radians(), softness]))
        .collect();
    let body = "
        let tau = input[base]; let yaw = input[base + 1u]; let softness = input[base + 2u];
        let l = vec3f(max(sin(yaw), 1e-9), 0.0, cos(yaw));
        let measure = face_measure(face_light_angle(l, 0.35), 0.0);
        let mirrored = face_measure(face_light_angle(vec3f(-l.x, 0.0, l.z), 0.35), 0.0);
        output[out] = face_lit(face_side(vec2f(0.37, tau), l.x), measure, softness);
        output[out + 1u] = face_lit(face_side(vec2f(tau, 0.37), -l.x), mirrored, softness);";
    let found = run(&["face_shadow"], body, &rows, 2);
    let mut before: std::collections::HashMap<(u32, u32), f32> = std::collections::HashMap::new();
    for (row, found) in rows.iter().zip(&found) {
        let [tau, yaw, softness] = [row[0], row[1], row[2]];
        assert!(found[0].to_bits() == found[1].to_bits(), "sides differ at {row:?}: {found:?}");
        let lit = found[0];
        assert!((0.0..=1.0).contains(&lit), "{row:?}: {lit}");
        let last = before.insert((tau.to_bits(), softness.to_bits()), lit);
        assert!(last.is_none_or(|last| lit <= last), "{row:?} lights up again: {last:?} to {lit}");
        if tau == 0.0 || tau == 1.0 {
            assert_eq!(lit, tau, "a reserved code at {row:?}");
        } else if (yaw / std::f32::consts::PI - tau).abs() < 1e-6 {
            assert!((lit - 0.5).abs() < 1e-3, "{row:?}: {lit} at the threshold");
        }
    }
}

#[test]
fn face_light_from_above_has_no_side() {
    // Heights of the light over the horizon, 0..=90 degrees, from behind: the angle falls to that of the front.
    let rows: Vec<Vec<f32>> = (0..=90).map(|d| vec![(d as f32).to_radians()]).collect();
    let body = "
        let l = vec3f(1e-4, sin(input[base]), -cos(input[base]));
        output[out] = face_light_angle(normalize(l), 0.35);
        output[out + 1u] = face_light_angle(vec3f(0.0, 1.0, 0.0), 0.35);";
    let found = run(&["face_shadow"], body, &rows, 2);
    assert!((found[0][0] - 1.0).abs() < 1e-3, "from behind: {}", found[0][0]);
    assert!(found.windows(2).all(|w| w[1][0] <= w[0][0] + 1e-5), "it only fades");
    assert!(found[90][0] < 1e-3 && found.iter().all(|f| f[1] == 0.0), "straight above: {:?}", found[90]);
}

/// Between two maps of a stack the threshold is interpolated; below the first and above the last nothing more happens.
#[test]
fn a_stack_interpolates_over_the_height_of_the_light() {
    let pitches = [-30f32, 0.0, 60.0];
    let rows: Vec<Vec<f32>> =
        [-90f32, -30.0, -15.0, 0.0, 15.0, 60.0, 90.0].iter().map(|p| vec![p.to_radians()]).collect();
    let [a, b, c] = pitches.map(f32::to_radians);
    let body = format!(
        "let at = face_stack_place(input[base], vec4f({a}, {b}, {c}, 0.0), 3u);
        output[out] = at.x + at.y;
        output[out + 1u] = face_stack_place(input[base], vec4f({b}, 0.0, 0.0, 0.0), 1u).y;"
    );
    let found = run(&["face_shadow"], &body, &rows, 2);
    for (i, (found, expected)) in found.iter().zip([0.0, 0.0, 0.5, 1.0, 1.25, 2.0, 2.0]).enumerate() {
        assert_close("stack", i, found, &[expected, 0.0], 1e-5);
    }
}

/// The second maps take over round 90 degrees; masks act in their sector alone and only darken.
#[test]
fn second_maps_and_masks_keep_to_their_sectors() {
    let rows: Vec<Vec<f32>> = (0..=180).map(|d| vec![d as f32 / 180.0]).collect();
    let body = "
        let angle = input[base];
        output[out] = face_back_share(angle);
        output[out + 1u] = face_masked(1.0, 0.0, 1.0, angle);
        output[out + 2u] = face_masked(1.0, 1.0, 0.0, angle);
        output[out + 3u] = face_masked(1.0, 1.0, 1.0, angle);
        output[out + 4u] = face_measure(angle, 1.0);";
    let found = run(&["face_shadow"], body, &rows, 5);
    for (degrees, found) in found.iter().enumerate() {
        let [share, side, back, open, cosine] = [found[0], found[1], found[2], found[3], found[4]];
        assert!((share == 0.0) == (degrees <= 80) && (share == 1.0) == (degrees >= 100), "{degrees}: {share}");
        assert!((side == 1.0) == (degrees <= 45 || degrees >= 135), "{degrees}: side {side}");
        assert!((back == 1.0) == (degrees <= 115), "{degrees}: back {back}");
        assert!(side >= 0.0 && back >= 0.0 && (open - 1.0).abs() < 1e-6, "{degrees}: {found:?}");
        let expected = (1.0 - (degrees as f32).to_radians().cos()) / 2.0;
        // Drivers approximate cosines.
        assert!((cosine - expected).abs() < 1e-4, "{degrees}: {cosine} for {expected}");
    }
}

/// Only what lies low and looks down is the underside of a jaw: neither nose and lips, nor its sides.
#[test]
fn the_underside_of_a_jaw_is_low_and_looks_down() {
    let rows = vec![vec![-0.9, -0.9], vec![-0.9, -0.35], vec![-0.5, -1.0], vec![0.8, 0.8], vec![-0.7, -1.0]];
    let found = run(&["face_shadow"], "output[out] = face_underside(input[base], input[base + 1u]);", &rows, 1);
    for (i, (found, expected)) in found.iter().zip([1.0, 0.0, 0.0, 0.0, 0.5]).enumerate() {
        assert_close("underside", i, found, &[expected], 1e-5);
    }
}

/// A receiver that faces the light of the bangs stays where it is; the more it is grazed, the farther it is moved.
#[test]
fn grazed_receivers_are_moved_towards_the_light() {
    let rows: Vec<Vec<f32>> = (-10..=10).map(|i| vec![i as f32 / 10.0]).collect();
    let found = run(&["bangs"], "output[out] = bangs_grazed(input[base]);", &rows, 1);
    assert!(found.windows(2).all(|w| w[0][0] >= w[1][0]), "{found:?}");
    assert!(found[..=10].iter().all(|f| f[0] == 0.05) && found[14..].iter().all(|f| f[0] == 0.0), "{found:?}");
}

/// The tint is whole at the border, gone where the band ends, and grows between.
#[test]
fn transition_goes_from_its_colour_to_white() {
    let rows: Vec<Vec<f32>> = (0..=20).map(|i| vec![i as f32 / 20.0]).collect();
    let body = "write3(out, transition_tint(input[base], vec3f(1.0, 0.8, 0.6), 1.0));
        output[out + 3u] = transition_tint(input[base], vec3f(0.1), 0.0).x;";
    let found = run(&["transition"], body, &rows, 4);
    for (found, expected) in [(&found[0], [1.0, 0.8, 0.6]), (&found[10], [1.0, 0.8, 0.6]), (&found[20], [1.0; 3])] {
        assert_close("tint", 0, &found[..3], &expected, 1e-6);
    }
    assert!(found.windows(2).all(|w| w[0][1] <= w[1][1]) && found.iter().all(|f| f[3] == 1.0));
}

/// Lines show in shade alone, that of the nose with its share, blush always; nothing drawn changes nothing.
#[test]
fn face_paint_multiplies_where_it_should() {
    let rows = vec![
        vec![0.0, 0.0, 0.0, 1.0, 1.0],
        vec![1.0, 0.0, 0.0, 0.0, 0.0],
        vec![0.0, 1.0, 0.0, 0.0, 1.0],
        vec![0.0, 1.0, 0.0, 1.0, 0.0],
        vec![0.0, 0.0, 1.0, 0.0, 0.5],
    ];
    let body = "write3(out, face_paint_factor(input3(base), input[base + 3u], input[base + 4u], vec3f(0.5), 0.5,
        vec3f(0.2), 0.5));";
    let found = run(&["face_paint"], body, &rows, 3);
    for (i, (found, expected)) in found.iter().zip([1.0, 0.75, 1.0, 0.6, 0.6]).enumerate() {
        assert_close("face paint", i, found, &[expected; 3], 1e-6);
    }
}

/// Strands cut nothing at a breakup of 0, and only where a layer is not above them.
#[test]
fn strands_break_a_highlight() {
    let rows =
        vec![vec![0.6, 0.9, 0.0], vec![1.0, 1.0, 0.5], vec![0.4, 1.0, 0.5], vec![0.4, 0.0, 0.5], vec![0.0, 0.3, 1.0]];
    let body = "output[out] = highlight_broken(input[base], input[base + 1u], input[base + 2u]);";
    let found = run(&["highlight"], body, &rows, 1);
    for (i, (found, expected)) in found.iter().zip([0.6, 1.0, 0.0, 0.8, 0.0]).enumerate() {
        assert_close("strands", i, found, &[expected], 1e-6);
    }
}

#[test]
fn region_and_strength_blend_into_normal_shading() {
    let rows =
        vec![vec![0.2, 0.9, 0.0, 1.0], vec![0.2, 0.9, 1.0, 1.0], vec![0.2, 0.9, 0.0, 0.0], vec![0.2, 0.9, 0.5, 0.5]];
    let body = "output[out] = face_shading(input[base], input[base + 1u], input[base + 2u], input[base + 3u]);";
    let found = run(&["face_shadow"], body, &rows, 1);
    for (i, (found, expected)) in found.iter().zip([0.9, 0.2, 0.2, 0.375]).enumerate() {
        assert_close("face shading", i, found, &[expected], 1e-6);
    }
}

#[test]
fn highlights_move_by_view_light_and_turn() {
    let file = vectors("stylized.json");
    let list = cases(&file, "highlight_offsets");
    let rows: Vec<Vec<f32>> =
        list.iter().map(|c| numbers(c, &["V", "L", "F", "U", "k", "k_light", "k_face"])).collect();
    let body = "
        let moved = highlight_offset(input3(base), input3(base + 3u), input3(base + 6u), input3(base + 9u),
            input[base + 12u], input[base + 13u], input[base + 14u]);
        output[out] = moved.x; output[out + 1u] = moved.y;";
    for (i, (case, found)) in list.iter().zip(run(&["highlight"], body, &rows, 2)).enumerate() {
        assert_close("highlight", i, &found, &numbers(case, &["uv_dx", "uv_dy"]), 1e-5);
    }
    // A head that turns to the right of the picture moves it along +u, odd and growing up to a quarter turn.
    let list = cases(&file, "head_turn");
    // Drivers approximate sines; those of the head's turn are not what is tested.
    let forward = |yaw: f32| vec![yaw.sin(), yaw.cos()];
    let rows: Vec<Vec<f32>> = list.iter().map(|c| forward(numbers(c, &["head_yaw_to_screen_right"])[0])).collect();
    let body = "
        let f = vec3f(input[base], 0.0, input[base + 1u]);
        let v = vec3f(0.0, 0.0, 1.0);
        output[out] = highlight_offset(v, v, f, vec3f(0.0, 1.0, 0.0), 1.0, 0.0, 0.0).x;";
    for (i, (case, found)) in list.iter().zip(run(&["highlight"], body, &rows, 1)).enumerate() {
        assert_close("turn", i, &found, &numbers(case, &["uv_dx_over_k"]), 1e-5);
    }
    let rows: Vec<Vec<f32>> = (-90..=90).map(|d| forward((d as f32).to_radians())).collect();
    let found = run(&["highlight"], body, &rows, 1);
    assert!(found.windows(2).all(|w| w[1][0] > w[0][0] - 1e-6), "it grows with the turn");
    assert!((0..=90).all(|d| (found[90 + d][0] + found[90 - d][0]).abs() < 1e-6), "it is odd");
    // It fades with light from behind and where the head turns away, and stays on hair.
    let rows = vec![vec![1.0, 1.0, 0.35], vec![1.0, -1.0, 0.35], vec![0.3, 1.0, 0.35], vec![-1.0, 1.0, -2.0]];
    let body = "output[out] = highlight_fade(input[base], input[base + 1u], input[base + 2u]);";
    for (found, expected) in run(&["highlight"], body, &rows, 1).iter().zip([1.0, 0.0, 0.0, 1.0]) {
        assert_eq!(found[0], expected);
    }
}

/// A point that is pulled nearer has the depth of one that stands there; the fade falls from 1 to 0 between its angles.
#[test]
fn eyes_are_pulled_by_metres_and_fade_to_the_side() {
    let rows: Vec<Vec<f32>> =
        [0.3, 1.0, 5.0, 20.0].iter().flat_map(|d: &f32| [0.0, 0.05, 0.2].map(|window| vec![*d, window])).collect();
    let body = "
        let near = 0.07; let w = input[base]; let window = input[base + 1u];
        output[out] = pulled_depth(near, w, window) / w;
        output[out + 1u] = near / (w - window);";
    for (row, found) in rows.iter().zip(run(&["eyes_through"], body, &rows, 2)) {
        assert!((found[0] / found[1] - 1.0).abs() < 1e-5, "{row:?}: {found:?}");
    }
    let rows: Vec<Vec<f32>> = (0..=90).map(|d| vec![(d as f32).to_radians()]).collect();
    let body = "
        let s = sin(input[base]); let c = cos(input[base]);
        let yaw = radians(vec2f(50.0, 80.0)); let pitch = radians(vec2f(30.0, 60.0));
        output[out] = eyes_through_fade(vec3f(s, 0.0, c), yaw, pitch);
        output[out + 1u] = eyes_through_fade(vec3f(0.0, s, c), yaw, pitch);
        output[out + 2u] = eyes_through_fade(vec3f(-s, 0.0, c), yaw, pitch);
        output[out + 3u] = eyes_through_fade(vec3f(0.0, -s, c), yaw, pitch);
        output[out + 4u] = eyes_through_fade(vec3f(s, 0.0, -c), yaw, pitch);";
    let found = run(&["eyes_through"], body, &rows, 5);
    assert!(found.windows(2).all(|w| w[1][0] <= w[0][0] && w[1][1] <= w[0][1]), "it only fades");
    assert!(found[..50].iter().all(|f| f[0] == 1.0) && found[81..].iter().all(|f| f[0] == 0.0), "to the side");
    assert!(found[..30].iter().all(|f| f[1] == 1.0) && found[61..].iter().all(|f| f[1] == 0.0), "to above");
    assert!(found.iter().all(|f| f[0] == f[2] && f[1] == f[3]), "sides are alike");
    assert!(found[..90].iter().all(|f| f[4] == 0.0), "from behind");
}

/// Turning view, light and head alike moves no highlight.
#[test]
fn highlights_do_not_move_with_everything() {
    use glam::{Quat, Vec3};
    let vectors = [Vec3::new(0.3, 0.2, 0.9), Vec3::new(-0.6, 0.7, 0.4), Vec3::Z, Vec3::Y].map(Vec3::normalize);
    let rows: Vec<Vec<f32>> = (0..64)
        .map(|i| Quat::from_euler(glam::EulerRot::YXZ, i as f32 * 0.61, i as f32 * 0.37, i as f32 * 0.23))
        .map(|turn| vectors.iter().flat_map(|v| (turn * *v).to_array()).collect())
        .collect();
    let body = "
        let moved = highlight_offset(input3(base), input3(base + 3u), input3(base + 6u), input3(base + 9u), 0.1, 0.1, 0.1);
        output[out] = moved.x; output[out + 1u] = moved.y;";
    let found = run(&["highlight"], body, &rows, 2);
    for (i, turned) in found.iter().enumerate() {
        assert_close("turned", i, turned, &found[0], 1e-6);
    }
}
