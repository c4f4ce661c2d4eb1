//! Laws that the meshes of the character keep.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

use glam::Vec3;
use hikage_character::head::lids;
use hikage_character::mesh::{Part, Vertex};
use hikage_character::model::Model;

static MODEL: LazyLock<Model> = LazyLock::new(hikage_character::build);

/// A place, to a hundredth of a millimetre.
fn key(p: Vec3) -> [i32; 3] {
    (p * 1e5).round().as_ivec3().to_array()
}

fn corners(part: &Part, triangle: [u32; 3]) -> [&Vertex; 3] {
    triangle.map(|i| &part.vertices[i as usize])
}

fn part(name: &str) -> &'static Part {
    MODEL.part(name).unwrap_or_else(|| panic!("no part {name}"))
}

#[test]
fn triangles_are_few_and_every_number_is_finite() {
    let count: usize = MODEL.parts.iter().map(|p| p.triangles.len()).sum();
    assert!((20_000..70_000).contains(&count), "{count} triangles");
    for part in &MODEL.parts {
        assert!(part.vertices.iter().all(|v| v.position.is_finite() && v.uv.is_finite()), "{}", part.name);
        for v in &part.vertices {
            assert!((v.normal.length() - 1.0).abs() < 1e-3, "{}: normal {} at {}", part.name, v.normal, v.position);
        }
        assert!(part.tangents.is_empty() || part.tangents.len() == part.vertices.len(), "{}", part.name);
    }
}

#[test]
fn no_triangle_is_degenerate() {
    let mut faults = Vec::new();
    for part in &MODEL.parts {
        for t in &part.triangles {
            let [a, b, c] = corners(part, *t).map(|v| v.position);
            if (b - a).cross(c - a).length() * 0.5 < 1e-10 {
                faults.push(format!("{} {t:?} at {a}", part.name));
            }
        }
    }
    assert!(faults.is_empty(), "{} of them: {:#?}", faults.len(), &faults[..faults.len().min(20)]);
}

/// A triangle that faces away from the normals of all its corners is turned over. Normals of the face are edited and
/// those of tips are shared, so only a clear contradiction counts.
#[test]
fn no_triangle_is_flipped() {
    let mut faults = Vec::new();
    for part in &MODEL.parts {
        let two_sided = MODEL.materials.iter().any(|m| m.name == part.material && m.double_sided);
        for t in part.triangles.iter().filter(|_| !two_sided) {
            let v = corners(part, *t);
            let [a, b, c] = v.map(|v| v.position);
            let face = (b - a).cross(c - a).normalize();
            if v.iter().all(|v| v.normal.dot(face) < -0.1) {
                faults.push(format!("{} {t:?} at {a}", part.name));
            }
        }
    }
    assert!(faults.is_empty(), "{} of them: {:#?}", faults.len(), &faults[..faults.len().min(20)]);
}

#[test]
fn weights_sum_to_one_and_name_bones() {
    for part in &MODEL.parts {
        for v in &part.vertices {
            let sum: f32 = v.weights.iter().map(|(_, w)| w).sum();
            assert!((sum - 1.0).abs() < 1e-5, "{}: {sum} at {}", part.name, v.position);
            assert!(v.weights.iter().all(|(b, w)| *w >= 0.0 && usize::from(*b) < MODEL.skeleton.bones.len()));
        }
    }
}

/// Edges of the head, welded by place: each has two sides, and they run against each other.
#[test]
fn the_head_is_closed() {
    let mut edges: BTreeMap<([i32; 3], [i32; 3]), i32> = BTreeMap::new();
    let mouth = part("Mouth");
    // The pocket of the mouth closes the lips; teeth and tongue lie loose in it.
    let pocket = mouth.triangles.iter().filter(|t| t.iter().all(|i| mouth.vertices[*i as usize].uv.y <= 0.5 + 1e-6));
    let face = part("Face");
    let all = face.triangles.iter().map(|t| corners(face, *t)).chain(pocket.map(|t| corners(mouth, *t)));
    for v in all {
        let k = v.map(|v| key(v.position));
        for i in 0..3 {
            let (a, b) = (k[i], k[(i + 1) % 3]);
            if a != b {
                let (edge, way) = if a < b { ((a, b), 1) } else { ((b, a), -1) };
                *edges.entry(edge).or_default() += way;
            }
        }
    }
    let open: Vec<_> = edges.iter().filter(|(_, n)| **n != 0).collect();
    assert!(open.is_empty(), "{} open edges: {:?}", open.len(), &open[..open.len().min(12)]);
}

/// Parts that are the same left and right.
const SYMMETRIC: &[&str] =
    &["Face", "Mouth", "EyeWhite", "EyeIris", "EyelashUpper", "EyelashLower", "Brow", "Stockings", "Boots"];

#[test]
fn symmetric_parts_mirror_exactly() {
    for name in SYMMETRIC {
        let part = part(name);
        let places: BTreeSet<[u32; 3]> =
            part.vertices.iter().map(|v| (v.position + Vec3::ZERO).to_array().map(f32::to_bits)).collect();
        for v in &part.vertices {
            let mirrored = (v.position * Vec3::new(-1.0, 1.0, 1.0) + Vec3::ZERO).to_array().map(f32::to_bits);
            assert!(places.contains(&mirrored), "{name}: {} has no mirror image", v.position);
        }
    }
}

#[test]
fn the_face_unwraps_symmetrically_and_front_on() {
    let face = part("Face");
    let uv: BTreeMap<[i32; 3], Vec<[f32; 2]>> = face.vertices.iter().fold(BTreeMap::new(), |mut map, v| {
        map.entry(key(v.position)).or_insert_with(Vec::new).push(v.uv.to_array());
        map
    });
    for v in &face.vertices {
        assert!((0.0..=1.0).contains(&v.uv.x) && (0.0..=1.0).contains(&v.uv.y), "{}", v.uv);
        let mirror = key(v.position * Vec3::new(-1.0, 1.0, 1.0));
        let there = uv.get(&mirror).map(Vec::as_slice).unwrap_or_default();
        let found = there.iter().any(|[u, t]| (u + v.uv.x - 1.0).abs() < 1e-5 && (t - v.uv.y).abs() < 1e-5);
        assert!(found, "{}: {} against {there:?}", v.position, v.uv);
    }
    // On the front of the face u and v are x and y. The walls of the eye sockets lie behind it.
    let is_skin = |p: Vec3| p.z > hikage_character::head::shape::front(p.x, p.y).z - 0.005;
    let front = |p: Vec3| p.z > 0.07 && p.y > 1.33 && p.y < 1.48 && is_skin(p);
    for v in face.vertices.iter().filter(|v| front(v.position)) {
        let expected = [
            0.5 + v.position.x / hikage_character::head::UV_METRES,
            (hikage_character::head::UV_TOP - v.position.y) / hikage_character::head::UV_METRES,
        ];
        assert!(v.uv.distance(expected.into()) < 1e-4, "{}: {} for {expected:?}", v.position, v.uv);
    }
}

/// Every lock is a piece of its own; along its triangles v only grows from root to tip, which the tangents point to.
#[test]
fn locks_run_from_root_to_tip() {
    let mut locks = 0;
    for name in ["HairFront", "HairSide", "HairBack"] {
        let part = part(name);
        assert_eq!(part.tangents.len(), part.vertices.len(), "{name} has no tangents");
        for t in &part.triangles {
            for i in 0..3 {
                let (a, b) = (t[i] as usize, t[(i + 1) % 3] as usize);
                let (va, vb) = (&part.vertices[a], &part.vertices[b]);
                let along = vb.position - va.position;
                let rise = vb.uv.y - va.uv.y;
                let tangent = (part.tangents[a] + part.tangents[b]).truncate();
                // Edges that run along the lock, not across it.
                if along.normalize_or_zero().dot(tangent.normalize_or_zero()) > 0.8 {
                    assert!(rise > 0.0, "{name}: v falls along the lock at {}", va.position);
                }
            }
        }
        locks += pieces(part);
    }
    assert!((60..=120).contains(&locks), "{locks} locks");
}

/// Number of connected pieces.
fn pieces(part: &Part) -> usize {
    let mut parent: Vec<usize> = (0..part.vertices.len()).collect();
    fn root(parent: &mut [usize], mut i: usize) -> usize {
        while parent[i] != i {
            parent[i] = parent[parent[i]];
            i = parent[i];
        }
        i
    }
    for t in &part.triangles {
        for pair in [[t[0], t[1]], [t[1], t[2]]] {
            let [a, b] = pair.map(|i| root(&mut parent, i as usize));
            parent[a] = b;
        }
    }
    (0..parent.len()).map(|i| root(&mut parent, i)).collect::<BTreeSet<_>>().len()
}

/// With any expression at any weight the upper lid stays above the lower one.
#[test]
fn lids_do_not_cross() {
    for (name, [upper, lower]) in lids() {
        for (u, l) in upper.iter().zip(&lower) {
            for step in 0..=10 {
                let w = step as f32 / 10.0;
                let (a, b) = (u[0] + (u[1] - u[0]) * w, l[0] + (l[1] - l[0]) * w);
                assert!(a - b >= 0.0, "{name} at {w}: the lids cross by {} mm", (b - a) * 1e3);
            }
        }
    }
}

/// Shut eyes leave no gap: the lids of a blink meet within a third of a millimetre, on the mesh itself.
#[test]
fn shut_eyes_are_shut() {
    let face = part("Face");
    for (name, side) in [("blinkLeft", 1.0), ("blinkRight", -1.0)] {
        let morph = face.morphs.iter().find(|m| m.name == name).expect("the face blinks");
        let mut moved: Vec<Vec3> = face.vertices.iter().map(|v| v.position).collect();
        for (i, offset) in &morph.offsets {
            moved[*i as usize] += *offset;
        }
        // Lid vertices stand in pairs at the same x.
        let rims = lids();
        let (_, [upper, lower]) = rims.iter().find(|(n, _)| *n == name).expect("lids are listed");
        for (u, l) in upper.iter().zip(lower) {
            assert!(u[1] - l[1] < 0.000_33, "{name}: {} mm stay open", (u[1] - l[1]) * 1e3);
            let near = |y: f32| moved.iter().any(|p| p.x * side > 0.0 && (p.y - y).abs() < 2e-5);
            assert!(near(u[1]) && near(l[1]), "{name}: no vertex of the face stands on its lid");
        }
    }
}

#[test]
fn the_same_bytes_each_time() {
    let (a, b) = (hikage_character::file(), hikage_character::file());
    assert!(a == b, "two builds differ");
    assert!(a.len() < 40 << 20, "{} MiB", a.len() >> 20);
}

#[test]
fn all_bones_of_the_humanoid_are_there() {
    let human = MODEL.skeleton.bones.iter().filter(|b| b.human).count();
    assert_eq!(human, 55, "VRM 1.0 knows 55 humanoid bones");
    for (i, bone) in MODEL.skeleton.bones.iter().enumerate() {
        assert!(bone.parent.is_none_or(|p| p < i), "{} stands before its parent", bone.name);
    }
}

#[test]
fn the_presets_of_vrm_are_there() {
    let names: BTreeSet<&str> = MODEL.expressions.iter().filter(|e| e.preset).map(|e| e.name).collect();
    for name in [
        "happy", "angry", "sad", "relaxed", "surprised", "aa", "ih", "ou", "ee", "oh", "blink", "blinkLeft",
        "blinkRight", "lookUp", "lookDown", "lookLeft", "lookRight", "neutral",
    ] {
        assert!(names.contains(name), "{name} is missing");
    }
}

#[test]
fn every_texture_is_used_and_every_name_known() {
    let known: BTreeSet<&str> = MODEL.textures.iter().map(|t| t.name).collect();
    assert_eq!(known.len(), MODEL.textures.len(), "two textures share a name");
    let mut used = BTreeSet::new();
    for m in &MODEL.materials {
        let matcap = m.matcap.map(|(name, _)| name);
        used.extend(
            [m.texture, m.shade_texture, m.normal_map, m.emission_texture, m.outline_mask, matcap]
                .into_iter()
                .flatten(),
        );
        used.extend(m.extras.values().copied());
        assert!(MODEL.parts.iter().any(|p| p.material == m.name), "no part has the material {}", m.name);
    }
    assert_eq!(used, known);
    for part in &MODEL.parts {
        assert!(
            MODEL.materials.iter().any(|m| m.name == part.material),
            "{}: no material {}",
            part.name,
            part.material
        );
    }
}
