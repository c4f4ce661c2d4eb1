//! Distances and threshold maps against float64 vectors; the built-in character's face keys through the same code.

use hikage::sdf::{BakeOptions, Key, Mask, Project, ProjectKey, bake, check, distance_squared};
use serde_json::Value;

fn vectors() -> Value {
    let folder =
        std::env::var("HIKAGE_ORACLES").unwrap_or(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/oracles").into());
    let path = format!("{folder}/sdf_edt.json");
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path}: {e}"));
    serde_json::from_str(&text).unwrap_or_else(|e| panic!("{path}: {e}"))
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

fn mask(rows: &Value) -> Mask {
    let rows: Vec<&str> = list(rows).iter().map(|r| r.as_str().expect("a row")).collect();
    Mask::from_fn(rows[0].len() as u32, rows.len() as u32, |x, y| rows[y as usize].as_bytes()[x as usize] == b'1')
}

fn numbers(rows: &Value) -> Vec<f64> {
    list(rows).iter().flat_map(list).map(|n| n.as_f64().expect("a number")).collect()
}

#[test]
fn distances_are_exact() {
    let vectors = vectors();
    let cases = list(&vectors["cases"]);
    assert!(!cases.is_empty());
    for case in cases {
        let mask = mask(&case["mask"]);
        for (to, expected) in [(true, "dist2_to_set"), (false, "dist2_to_clear")] {
            let found: Vec<f64> = distance_squared(&mask, to).into_iter().map(f64::from).collect();
            assert_eq!(found, numbers(&case[expected]), "{expected}");
        }
    }
}

#[test]
fn thresholds_match_the_vectors() {
    let vectors = vectors();
    let face = &vectors["face"];
    let angles = list(&face["angles"]).iter().map(|a| a.as_f64().expect("an angle") as f32);
    let keys: Vec<Key> =
        angles.zip(list(&face["masks"])).map(|(angle_rad, rows)| Key { angle_rad, mask: mask(rows) }).collect();
    let map = bake(&keys, &BakeOptions::default()).expect("nested keys").map;
    for (i, expected) in numbers(&face["tau"]).into_iter().enumerate() {
        // Half a code.
        let found = map.value(i);
        assert!((found - expected).abs() < 0.5001 / 65535.0, "texel {i}: {found} for {expected}");
    }
}

#[test]
fn the_built_in_face_keys_bake_and_come_back() {
    let project = Project::parse("face.sdf.toml", hikage_character::head::sdf::SOURCE).expect("her project");
    for bits in [8, 16] {
        let project = Project { bits, ..project.clone() };
        let baked = project.bake(false).expect("her keys are nested");
        for key in &project.keys {
            let drawn = project.mask(key.angle()).expect("draws");
            let found = baked.left.map.mask(key.angle().to_radians());
            let wrong = found.lit().zip(drawn.lit()).filter(|(a, b)| a != b).count();
            assert_eq!(wrong, 0, "texels at {} degrees, {bits} bits", key.angle());
        }
        let remarks = check(&project, &baked).expect("checks");
        assert!(remarks.is_empty(), "{remarks:?}");
    }
}

/// Between the keys too, shapes never light up again what they have left dark.
#[test]
fn the_lit_part_of_the_built_in_face_only_shrinks() {
    let project = Project::parse("face.sdf.toml", hikage_character::head::sdf::SOURCE).expect("her project");
    let every_second = (0..=180).step_by(2).map(|angle| ProjectKey::Angle(angle as f32)).collect();
    let baked = Project { keys: every_second, ..project }.bake(false).expect("nested at every angle");
    let all = baked.left.map.codes.len();
    let lit = |degrees: f32| baked.left.map.mask(degrees.to_radians()).lit().filter(|l| *l).count();
    assert!(lit(0.0) > all * 9 / 10, "light from the front leaves the face dark");
    assert_eq!(lit(180.0), 0, "light from behind reaches the face");
}
