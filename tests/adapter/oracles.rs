//! The functions of `wgsl/lib` on the adapter against float64 vectors.
//!
//! Vectors are read from `tests/oracles`, or from the folder that `HIKAGE_ORACLES` names; `HIKAGE_ADAPTER` names
//! another adapter than the default.

use std::path::PathBuf;

use serde_json::Value;
use wgpu::util::DeviceExt;

/// Runs `body`, which may read `input[base + k]` and must write `output[out + k]`, once for each row of numbers.
fn run(library: &[&str], body: &str, rows: &[Vec<f32>], outputs: usize) -> Vec<Vec<f32>> {
    let adapter = std::env::var("HIKAGE_ADAPTER").ok();
    let gpu = hikage::Gpu::headless(adapter.as_deref()).unwrap_or_else(|e| panic!("{e}"));
    let stride = rows[0].len();
    assert!(rows.iter().all(|r| r.len() == stride));
    let mut text = String::new();
    for file in library {
        let path = format!("{}/wgsl/lib/{file}.wgsl", env!("CARGO_MANIFEST_DIR"));
        let source = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path}: {e}"));
        // Library functions have unique names, so their files may simply stand behind each other.
        text.extend(source.lines().filter(|l| !l.starts_with("import ")).flat_map(|l| [l, "\n"]));
    }
    text += &format!(
        "@group(0) @binding(0) var<storage, read> input: array<f32>;
         @group(0) @binding(1) var<storage, read_write> output: array<f32>;
         fn input3(i: u32) -> vec3f {{ return vec3f(input[i], input[i + 1u], input[i + 2u]); }}
         fn write3(i: u32, v: vec3f) {{ output[i] = v.x; output[i + 1u] = v.y; output[i + 2u] = v.z; }}
         @compute @workgroup_size(1) fn main(@builtin(workgroup_id) id: vec3u) {{
             let base = id.x * {stride}u;
             let out = id.x * {outputs}u;
             {body}
         }}"
    );
    let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(text.into()),
    });
    let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: None,
        layout: None,
        module: &module,
        entry_point: Some("main"),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    });
    let flat: Vec<f32> = rows.concat();
    let input = gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: None,
        contents: bytemuck::cast_slice(&flat),
        usage: wgpu::BufferUsages::STORAGE,
    });
    let bytes = (rows.len() * outputs * 4) as u64;
    let buffer = |usage| {
        gpu.device.create_buffer(&wgpu::BufferDescriptor { label: None, size: bytes, usage, mapped_at_creation: false })
    };
    let output = buffer(wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
    let read = buffer(wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ);
    let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[
            wgpu::BindGroupEntry { binding: 0, resource: input.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 1, resource: output.as_entire_binding() },
        ],
    });
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(rows.len() as u32, 1, 1);
    }
    encoder.copy_buffer_to_buffer(&output, 0, &read, 0, bytes);
    gpu.queue.submit([encoder.finish()]);
    read.slice(..).map_async(wgpu::MapMode::Read, |r| r.expect("mapped"));
    let timeout = Some(std::time::Duration::from_secs(60));
    gpu.device.poll(wgpu::PollType::Wait { submission_index: None, timeout }).expect("the adapter answers");
    let mapped = read.slice(..).get_mapped_range().expect("mapped");
    bytemuck::pod_collect_to_vec::<u8, f32>(&mapped).chunks_exact(outputs).map(<[f32]>::to_vec).collect()
}

fn vectors(name: &str) -> Value {
    let own = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/oracles");
    let folder = std::env::var_os("HIKAGE_ORACLES").map_or(own, PathBuf::from);
    let path = folder.join(name);
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    serde_json::from_str(&text).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

fn cases<'a>(file: &'a Value, list: &str) -> &'a Vec<Value> {
    let cases = file[list].as_array().unwrap_or_else(|| panic!("no list {list}"));
    assert!(!cases.is_empty(), "{list} is empty");
    cases
}

/// Numbers at the given paths (`params.base`), vectors laid out one component after the other.
fn numbers(case: &Value, paths: &[&str]) -> Vec<f32> {
    let mut row = Vec::new();
    for path in paths {
        let value = path.split('.').fold(case, |v, key| &v[key]);
        match value {
            Value::Array(list) => row.extend(list.iter().map(|x| x.as_f64().expect(path) as f32)),
            other => row.push(other.as_f64().unwrap_or_else(|| panic!("no number at {path}")) as f32),
        }
    }
    row
}

fn assert_close(what: &str, case: usize, found: &[f32], expected: &[f32], tolerance: f32) {
    assert_eq!(found.len(), expected.len());
    for (i, (f, e)) in found.iter().zip(expected).enumerate() {
        assert!((f - e).abs() <= tolerance, "{what}, case {case}, number {i}: {f}, expected {e} ± {tolerance}");
    }
}

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

/// A ramp of bands begins with the shade and ends with the light, exactly, and passes the terminator between.
#[test]
fn bands_of_a_ramp_end_in_shade_and_light() {
    let rows: Vec<Vec<f32>> = [0.0f32, 0.3, 0.48, 0.6, 1.0].map(|p| vec![p]).into();
    let body = "write3(out, ramp_bands(vec3f(0.9, 0.8, 0.7), vec3f(0.2, 0.1, 0.3), vec3f(0.8, 0.4, 0.3),
        vec4f(0.4, 0.46, 0.5, 0.56), input[base]));";
    let found = run(&["shade_ramp"], body, &rows, 3);
    assert_eq!(found, [[0.2, 0.1, 0.3], [0.2, 0.1, 0.3], [0.8, 0.4, 0.3], [0.9, 0.8, 0.7], [0.9, 0.8, 0.7]]);
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
    // One shell a pixel, within bounds.
    let rows = vec![vec![0.008, 100.0, 16.0], vec![0.008, 990.0, 16.0], vec![0.008, 1e5, 16.0]];
    let body = "output[out] = fluff_shells(input[base], input[base + 1u], input[base + 2u]);";
    assert_eq!(run(&["noise", "fluff"], body, &rows, 1), [[4.0], [8.0], [16.0]]);
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
