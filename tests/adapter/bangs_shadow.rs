//! The shadow that front hair casts on the face, on whole characters.

use glam::{Mat4, Vec3};
use hikage::Channel;
use hikage::color::LinearRgb;
use hikage::material::BangsShadow;
use hikage::scene::{Ambient, Bangs, Framing, Image, Role, Scene};

use crate::support::{self, Shot, anime_heroine, gpu, render};

/// Her face, lit from above and a little from the left.
fn face(scene: &Scene, side: u32) -> Shot {
    let mut view = Shot::framed(scene, Framing::Face, 0.0, [side, side]);
    view.lights.ambient = Ambient::uniform(LinearRgb::BLACK);
    view.lights.directional.to_light = Vec3::new(0.3, 0.6, 0.75).normalize();
    view
}

/// Share of pixels that the shadow darkens.
fn shadowed(with: &Image, without: &Image) -> f64 {
    let darker = |(a, b): &(&[u8], &[u8])| a.iter().zip(*b).any(|(a, b)| b.saturating_sub(*a) > 6);
    let count = with.pixels.chunks(4).zip(without.pixels.chunks(4)).filter(darker).count();
    count as f64 / (with.pixels.len() / 4) as f64
}

fn without(scene: &Scene) -> Scene {
    Scene {
        bangs: None,
        materials: scene
            .materials
            .iter()
            .map(|m| {
                // What the section makes of white stays.
                let off = m.bangs_shadow.map(|b| BangsShadow { strength: 0.0, ..b });
                hikage::material::Material { bangs_shadow: off, ..m.clone() }
            })
            .collect(),
        ..scene.clone()
    }
}

/// Her without ramps, where a terminator may be darker than shade, and without other shadows.
fn heroine_without_ramps() -> Scene {
    let mut scene = anime_heroine();
    scene.materials.iter_mut().for_each(|m| m.shade_ramp = None);
    scene.self_shadow = None;
    // How much of an eye hair lets through goes by its brightness.
    scene.eyes_through = None;
    scene
}

#[test]
fn bangs_darken_the_forehead_and_nothing_gets_lighter() {
    let (gpu, scene) = (gpu(), heroine_without_ramps());
    let view = face(&scene, 256);
    let (with, bare) = (render(&gpu, &scene, &view), render(&gpu, &without(&scene), &view));
    let share = shadowed(&with, &bare);
    assert!((0.005..0.2).contains(&share), "{share}");
    assert!(with.pixels.iter().zip(&bare.pixels).all(|(a, b)| a.saturating_sub(*b) <= 1), "a shadow that lights");
    // Light from below casts no shadow upwards: it is held over the face.
    let mut low = view.clone();
    low.lights.directional.to_light = Vec3::new(0.0, -0.6, 0.8).normalize();
    assert!(shadowed(&render(&gpu, &scene, &low), &render(&gpu, &without(&scene), &low)) < share);
}

/// On a ramp, received shadow has exactly the colour of full shade: place 0 wherever no light arrives.
#[test]
fn received_shadow_is_the_dark_end_of_the_ramp() {
    let (gpu, mut scene) = (gpu(), anime_heroine());
    let faces: Vec<usize> = (0..scene.materials.len()).filter(|m| scene.materials[*m].face_shadow.is_some()).collect();
    for face in &faces {
        let shadow = scene.materials[*face].bangs_shadow.as_mut().expect("the face gets shadow");
        shadow.strength = 1.0;
    }
    // Nothing is left to normal shading.
    for texel in scene.face_maps.iter_mut().flat_map(|m| &mut m.front).flatten() {
        texel[2] = 0;
    }
    let view = face(&scene, 256);
    let channel = |channel| render(&gpu, &scene, &Shot { channel, ..view.clone() });
    let (arrived, place) = (channel(Channel::Look("bangs-shadow")), channel(Channel::Look("shade-ramp")));
    let of_face = channel(Channel::Look("face-shadow"));
    let (mut dark, mut lit) = (0, 0);
    for ((arrived, place), face) in arrived.pixels.chunks(4).zip(place.pixels.chunks(4)).zip(of_face.pixels.chunks(4)) {
        // Inside of the face, away from edges that samples share: full light of the map, and no light through the bangs.
        if face[0] == 255 && arrived[0] == 0 {
            assert!(place[0] <= 1, "place {} in full shadow", place[0]);
            dark += 1;
        }
        lit += usize::from(face[0] == 255 && arrived[0] == 255 && place[0] > 128);
    }
    assert!(dark > 20 && lit > 1000, "{dark} dark and {lit} lit pixels");
}

/// Moving the whole character, or coming nearer, leaves the shadow on the same places of the face.
#[test]
fn the_shadow_depends_on_head_and_light_alone() {
    let (gpu, scene) = (gpu(), anime_heroine());
    let view = face(&scene, 256);
    let reference = render(&gpu, &scene, &view);
    let mut moved = view.clone();
    let by = Vec3::new(40.0, -3.0, 17.0);
    moved.instances = vec![Mat4::from_translation(by)];
    moved.camera.eye += by;
    moved.camera.target += by;
    let picture = render(&gpu, &scene, &moved);
    let wrong = reference
        .pixels
        .chunks(4)
        .zip(picture.pixels.chunks(4))
        .filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 12))
        .count();
    // Edges of hair fall on other samples by the rounding of 40 m.
    assert!(wrong * 100 < reference.pixels.len() / 4, "{wrong} pixels");

    // Twice as far with half the angle of view: the same face, but for perspective.
    let mut far = view.clone();
    far.camera.eye = far.camera.target + (far.camera.eye - far.camera.target) * 2.0;
    far.camera.fov_y_rad = 2.0 * ((far.camera.fov_y_rad * 0.5).tan() * 0.5).atan();
    let share = |view: &Shot| shadowed(&render(&gpu, &scene, view), &render(&gpu, &without(&scene), view));
    let (near, far) = (share(&view), share(&far));
    assert!((near / far - 1.0).abs() < 0.15, "{near} of the picture near, {far} far");
}

#[test]
fn an_artists_direction_overrides_the_light_and_softness_widens_the_edge() {
    let (gpu, mut scene) = (gpu(), heroine_without_ramps());
    let view = face(&scene, 320);
    let picture = |scene: &Scene, view: &Shot| render(&gpu, scene, view);
    scene.bangs = Some(Bangs { direction_rad: Some([0.4, 0.5]), ..Bangs::default() });
    let mut turned = view.clone();
    turned.lights.directional.to_light = Vec3::new(-0.25, 0.6, 0.75).normalize();
    for material in &mut scene.materials {
        material.face_shadow = None;
        // Eyes and mouth receive softer ones.
        material.bangs_shadow = material.bangs_shadow.filter(|_| material.name == "Face");
        // As wide as it is filtered.
        material.bangs_shadow = material.bangs_shadow.map(|b| BangsShadow { edges: [0.3, 0.7], ..b });
    }
    let bare = without(&scene);
    // Where both lights show the same bare face, both show the same shadow on it.
    let [(a, bare_a), (b, bare_b)] = [&view, &turned].map(|view| (picture(&scene, view), picture(&bare, view)));
    let pixels = |image: &Image| -> Vec<[u8; 3]> { image.pixels.chunks(4).map(|p| [p[0], p[1], p[2]]).collect() };
    let [a, bare_a, b, bare_b] = [&a, &bare_a, &b, &bare_b].map(pixels);
    let apart = |a: &[u8; 3], b: &[u8; 3]| a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0);
    let alike: Vec<usize> = (0..a.len()).filter(|i| apart(&bare_a[*i], &bare_b[*i]) <= 1).collect();
    let dark = alike.iter().filter(|i| apart(&a[**i], &bare_a[**i]) > 20).count();
    let differ = alike.iter().filter(|i| apart(&a[**i], &b[**i]) > 2).count();
    assert!(dark > 100 && differ * 50 < dark, "{differ} pixels follow the light, {dark} lie in shadow");

    let half_shadow = |soft_width_m: f32| {
        let soft = Scene { bangs: Some(Bangs { soft_width_m, ..Bangs::default() }), ..scene.clone() };
        let (with, bare) = (picture(&soft, &view), picture(&bare, &view));
        let partly = |(a, b): &(&[u8], &[u8])| (8..30).contains(&b[1].saturating_sub(a[1]));
        with.pixels.chunks(4).zip(bare.pixels.chunks(4)).filter(partly).count()
    };
    let (hard, soft) = (half_shadow(0.0005), half_shadow(0.03));
    assert!(soft > 2 * hard, "{hard} pixels of half shadow, {soft} with a soft edge");
}

/// Hands, clothes and other characters cast on the face too, and a face before which nothing stands is as without a map.
#[test]
fn others_cast_on_the_face_and_the_face_not_on_itself() {
    let (gpu, mut scene) = (gpu(), heroine_without_ramps());
    for part in scene.meshes.iter_mut().flat_map(|m| &mut m.primitives) {
        if !matches!(part.role, Role::Face | Role::Lash | Role::Eye | Role::EyeWhite) {
            part.role = Role::Other;
        }
    }
    for material in &mut scene.materials {
        material.bangs_shadow = material.bangs_shadow.map(|b| hikage::material::BangsShadow { lids: false, ..b });
    }
    let view = face(&scene, 192);
    let bare = render(&gpu, &without(&scene), &view);
    // Something else must cast, or there is no map at all: a card far below.
    let card = |scene: &Scene, at: Vec3, half: f32, role: Role| {
        let mut scene = scene.clone();
        let mut square = support::square([at.x, at.y], half, at.z);
        (square.role, square.material) = (role, scene.materials.len());
        scene.materials.push(hikage::material::Material { double_sided: true, ..Default::default() });
        scene.meshes.push(hikage::scene::Mesh { primitives: vec![square], ..Default::default() });
        let mesh = Some(scene.meshes.len() - 1);
        scene.nodes.push(hikage::scene::Node { mesh, ..Default::default() });
        scene
    };
    let away = card(&scene, Vec3::new(0.0, -5.0, 0.0), 0.01, Role::Cloth);
    assert!(render(&gpu, &away, &view).pixels == bare.pixels, "the face casts on itself");

    // A hand before the forehead, out of the picture's way: above and nearer to the light.
    let head = scene.bone_node(hikage::scene::HumanBone::Head).expect("a head");
    let head = scene.rest_world_from_nodes()[head].w_axis.truncate();
    let toward = Vec3::new(0.3, 0.6, 0.75).normalize() * 0.35;
    for role in [Role::Skin, Role::Cloth, Role::Accessory] {
        let hand = card(&scene, head + Vec3::new(0.0, 0.08, 0.06) + toward, 0.05, role);
        let share = shadowed(&render(&gpu, &hand, &view), &bare);
        assert!(share > 0.01, "{role:?} darkens {share} of the picture");
    }

    // Another character between the first one and the light.
    let pair = |scene: &Scene| {
        let mut view = view.clone();
        view.instances = vec![Mat4::IDENTITY, Mat4::from_translation(Vec3::new(0.12, 0.12, 0.5))];
        // Seen from below the other one's hair, past her.
        view.camera.eye = head + Vec3::new(-0.5, 0.0, 0.5);
        render(&gpu, scene, &view)
    };
    let share = shadowed(&pair(&away), &pair(&without(&away)));
    assert!(share > 0.005, "another character darkens {share} of the picture");
}
