//! What the anime look makes of parts that a file says little about.

use hikage::material::{Material, Outline, Shading, TextureRef};
use hikage::scene::{Image, Mesh, Node, Primitive, Role, Sampler, Scene, Texture};
use hikage::{Anime, Look};

/// Middle of the head of [`doll`].
const HEAD: [f32; 3] = [0.0, 1.5, 0.0];
/// Its radius, metres.
const RADIUS: f32 = 0.1;

/// A ball for a face under a node named as heads are, and one part more.
fn doll(part: Primitive) -> Scene {
    let mut face = Primitive { role: Role::Face, ..Primitive::default() };
    for i in 0..=8 {
        for k in 0..16 {
            let (down, around) = (i as f32 / 8.0 * std::f32::consts::PI, k as f32 / 8.0 * std::f32::consts::PI);
            let n = [down.sin() * around.sin(), down.cos(), down.sin() * around.cos()];
            face.normals.push(n);
            face.positions.push(std::array::from_fn(|c| HEAD[c] + RADIUS * n[c]));
            if i < 8 {
                let (a, b) = (i * 16 + k, i * 16 + (k + 1) % 16);
                face.indices.extend([a, a + 16, b, b, a + 16, b + 16]);
            }
        }
    }
    let mesh = |primitive| Mesh { primitives: vec![primitive], ..Mesh::default() };
    let lined = |name: &str| Material { name: name.into(), outline: Some(Outline::default()), ..Material::default() };
    Scene {
        nodes: vec![
            Node { name: "Head".into(), ..Node::default() },
            Node { name: "Face".into(), mesh: Some(0), parent: Some(0), ..Node::default() },
            Node { name: "Part".into(), mesh: Some(1), ..Node::default() },
        ],
        meshes: vec![mesh(face), mesh(Primitive { material: 1, ..part })],
        materials: vec![lined("face"), lined("part")],
        ..Scene::default()
    }
}

fn anime(mut scene: Scene) -> Scene {
    Look::Anime(Anime::default()).apply(&mut scene);
    scene
}

/// A strip of squares through pairs of points to the left and to the right.
fn strip(role: Role, rows: &[([f32; 2], [f32; 3])], half_width: f32, columns: u32) -> Primitive {
    let mut part = Primitive { role, ..Primitive::default() };
    for (i, ([y, z], normal)) in rows.iter().enumerate() {
        for k in 0..=columns {
            let x = (k as f32 / columns as f32 * 2.0 - 1.0) * half_width;
            part.positions.push([HEAD[0] + x, HEAD[1] + y, HEAD[2] + z]);
            part.normals.push(*normal);
            if i > 0 && k > 0 {
                let b = i as u32 * (columns + 1) + k;
                let a = b - columns - 1;
                part.indices.extend([a - 1, b - 1, a, a, b - 1, b]);
            }
        }
    }
    part
}

/// Cloth goes to its shade through a half-tone, but where a picture of the file's own paints that shade.
#[test]
fn clothes_have_a_half_tone() {
    let mut scene = doll(strip(Role::Cloth, &[([0.0, 0.2], [0.0, 0.0, 1.0]), ([-0.2, 0.2], [0.0, 0.0, 1.0])], 0.1, 1));
    let transition = anime(scene.clone()).materials[1].transition.expect("a half-tone");
    let Shading::Toon(toon) = anime(scene.clone()).materials[1].shading else { panic!("no toon surface") };
    for (tint, shade) in transition.color.iter().zip(toon.shade_color) {
        assert!(shade < *tint && *tint < 1.0, "{tint} is not between light and {shade}");
    }
    scene.images.push(Image { width: 1, height: 1, pixels: vec![255; 4], ..Image::default() });
    scene.textures.push(Texture { image: 0, sampler: Sampler::default() });
    if let Shading::Toon(toon) = &mut scene.materials[1].shading {
        toon.shade_texture = Some(TextureRef::default());
    }
    assert!(anime(scene).materials[1].transition.is_none());
}

/// From afar lines of what is worn stay a pixel wide; those of faces, which would cross them, fade.
#[test]
fn lines_of_what_is_worn_stay_a_pixel_wide() {
    let rows = [([0.0, 0.2], [0.0, 0.0, 1.0]), ([-0.2, 0.2], [0.0, 0.0, 1.0])];
    for role in [Role::Hair, Role::HairFront, Role::Cloth, Role::Accessory, Role::Other] {
        let scene = anime(doll(strip(role, &rows, 0.1, 1)));
        let least =
            |material: usize| scene.materials[material].outline.and_then(|o| o.clamp_px).map(|[least, _]| least);
        assert_eq!((least(0), least(1)), (Some(0.0), Some(1.0)), "{role:?}");
    }
}

/// Light on two locks at the same place turns dark at different angles: the border steps from one to the other, round the
/// upright axis and by little.
#[test]
fn light_steps_from_lock_to_lock() {
    let out = [0.0, 0.0, 1.0];
    let mut locks = strip(Role::Hair, &[([0.0, 0.12], out), ([-0.001, 0.12], out)], 0.001, 1);
    let second = strip(Role::Hair, &[([0.0, 0.1201], out), ([-0.001, 0.1201], out)], 0.001, 1);
    locks.indices.extend(second.indices.iter().map(|i| i + 4));
    locks.positions.extend(second.positions);
    locks.normals.extend(second.normals);
    let turned = anime(doll(locks)).meshes[1].primitives[0].normals.clone();
    let (first, second) = (glam::Vec3::from(turned[0]), glam::Vec3::from(turned[4]));
    let angle = first.angle_between(second);
    assert!((0.02..0.3).contains(&angle), "{angle}");
    assert!((first.y - second.y).abs() < 1e-3 && first.z > 0.9 && second.z > 0.9, "{first} {second}");
}

/// On a fringe that lies on the head and then hangs down, the band is on what hangs.
#[test]
fn a_band_lies_below_where_a_fringe_bends() {
    let bend = ([0.06, 0.11], [0.0, 1.0, 0.0]);
    let lying = (0..=20).map(|i| ([0.06, 0.11 * i as f32 / 20.0], bend.1));
    let hanging = (1..=20).map(|i| ([0.06 - 0.008 * i as f32, 0.11], [0.0, 0.0, 1.0]));
    let rows: Vec<_> = lying.chain(hanging).collect();
    let scene = anime(doll(strip(Role::HairFront, &rows, 0.03, 6)));
    let highlight = scene.materials[1].highlight.expect("a band");
    let part = &scene.meshes[1].primitives[0];
    // The band has its middle at half the height of its picture; that grows downwards.
    let place = |vertex: usize| part.uvs[1][vertex][1] + highlight.light_v + highlight.view_v;
    let (lying, hanging): (Vec<usize>, Vec<usize>) =
        (0..part.positions.len()).partition(|v| part.positions[*v][1] > 1.559);
    assert!(lying.iter().all(|v| place(*v) < 0.5), "the band is on the top");
    assert!(hanging.iter().any(|v| place(*v) > 0.5), "the band is below the hair");
}

/// What is as bright in shade as in light receives no cast shadow, which would not show; it goes on casting.
#[test]
fn what_shows_no_shade_receives_none() {
    let rows = [([0.0, 0.2], [0.0, 0.0, 1.0]), ([-0.2, 0.2], [0.0, 0.0, 1.0])];
    let received = |shade: f32| {
        let mut scene = doll(strip(Role::Accessory, &rows, 0.1, 1));
        if let Shading::Toon(toon) = &mut scene.materials[1].shading {
            toon.shade_color = [shade; 3];
        }
        let shadow = anime(scene).materials[1].cast_shadow.expect("a part in cast shadows");
        (shadow.casts, shadow.received)
    };
    assert_eq!((received(1.0), received(0.5)), ((true, 0.0), (true, 1.0)));
}
