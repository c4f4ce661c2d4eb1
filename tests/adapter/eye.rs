//! Eyes behind a cornea: where views and light meet the iris, whose eye it is, pupil and limbus.

use glam::{DVec2, EulerRot, Mat4, Quat, Vec3};
use hikage::eye::EyeDimensions;
use hikage::material::Eye;
use hikage::motion::Pose;
use hikage::scene::{Influences, Node, Primitive, Scene, Skin, Transform};

use crate::eyeballs::{
    apart, bulged, colors, difference, eyeball, eyes, from_yaw, linear, matt, mirrored, open_ball, rays, seen, shown,
    with_iris,
};
use crate::support::{Lent, Shoot, Shot, gpu, render, staged, texture, with_renderer};

/// The iris and a little of the white, mm to either side.
const IRIS: f32 = 7.0;
const ALL: f32 = 14.0;
const FRONT: [f32; 2] = [0.0; 2];

/// Places of the iris by the channel, and where nothing but iris is.
fn places(gpu: &Lent, of: &Scene, shot: &Shot) -> Vec<Option<DVec2>> {
    let place = |p: Vec3| (p.z < 0.01 && p != Vec3::ZERO).then(|| p.truncate().as_dvec2() * 2.0 - 1.0);
    linear(&render(gpu, of, &shown(shot, "eye-place"))).into_iter().map(place).collect()
}

fn mean(of: impl Iterator<Item = f32>) -> f32 {
    let (sum, count) = of.fold((0.0, 0usize), |(sum, count), x| (sum + x, count + 1));
    sum / count.max(1) as f32
}

#[test]
fn a_ball_a_bulge_and_parts_show_the_same_iris() {
    let gpu = gpu();
    for yaw in [0.0, 35.0] {
        let shot = seen(96, IRIS, [yaw, 0.0], Vec3::Z);
        let of = |scene: Scene| places(&gpu, &scene, &shot);
        let first = of(eyeball(matt()));
        let count = first.iter().flatten().count();
        assert!(count > 2500, "{count} px of iris");
        for (name, parts) in [("open", vec![open_ball()]), ("bulged", vec![bulged()]), ("apart", apart())] {
            let found = of(eyes(parts, matt()));
            let both: Vec<f64> = first
                .iter()
                .zip(&found)
                .filter_map(|(a, b)| Some((((*a)? - (*b)?).abs()).element_sum() / 2.0))
                .collect();
            let off = both.iter().sum::<f64>() / both.len() as f64;
            println!("{name} at {yaw}: {off:.4} off over {} of {count} px", both.len());
            assert!(off <= 0.02, "{name} at {yaw}: {off}");
            assert!(both.len() * 20 > count * 19, "{name} at {yaw}: {} of {count}", both.len());
        }
    }
}

/// Half a code of 8 bits is up to 0.009 there.
#[test]
fn views_meet_the_iris_where_snells_law_has_it() {
    let gpu = gpu();
    for (ior, yaw, pitch) in
        [(1.376, 0.0, 0.0), (1.376, 25.0, 10.0), (1.376, 55.0, -15.0), (1.0, 0.0, 0.0), (1.0, 40.0, 20.0)]
    {
        let dimensions = EyeDimensions { ior, ..EyeDimensions::default() };
        let shot = seen(96, IRIS, [yaw, pitch], Vec3::Z);
        let found = places(&gpu, &eyes(vec![open_ball()], Eye { dimensions, ..matt() }), &shot);
        let expected: Vec<Option<DVec2>> = rays(&shot).iter().map(|ray| ray.on_iris(&dimensions)).collect();
        let of =
            |(found, expected): (&Option<DVec2>, &Option<DVec2>)| Some(((*expected)? - (*found)?).abs().max_element());
        let off: Vec<f64> = found.iter().zip(&expected).filter_map(of).collect();
        let worst = off.iter().copied().fold(0.0, f64::max);
        let missed = found.iter().zip(&expected).filter(|(f, e)| f.is_none() && e.is_some()).count();
        println!("index {ior} from {yaw}, {pitch}: {worst:.4} over {} px, {missed} missed", off.len());
        assert!(off.len() > 300 && missed == 0, "{} px, {missed} missed", off.len());
        assert!(worst <= 0.01, "index {ior} from {yaw}, {pitch}: {worst}");
    }
}

/// Of a human eye by 1.11 to 1.13, seen from the front.
#[test]
fn a_cornea_magnifies_what_is_behind_it() {
    let gpu = gpu();
    let magnified = |ior: f32| {
        let dimensions = EyeDimensions { ior, ..EyeDimensions::default() };
        let shot = seen(96, 1.5, FRONT, Vec3::Z);
        let found = places(&gpu, &eyes(vec![open_ball()], Eye { dimensions, ..matt() }), &shot);
        // The slope through the middle, by least squares, in mm of the plane of the iris.
        let (mut over, mut under) = (0.0, 0.0);
        for (place, ray) in found.iter().zip(rays(&shot)) {
            let from = ray.on_plane() * (1.0 - f64::from(dimensions.iris_z_mm()) / 2000.0);
            let place = place.expect("nothing but iris") * f64::from(dimensions.iris_radius_mm);
            (over, under) = (over + from.dot(place), under + from.length_squared());
        }
        under / over
    };
    let [human, none] = [1.376, 1.0].map(magnified);
    println!("{human:.4}, with an index of 1 {none:.4}");
    assert!((1.11..=1.13).contains(&human) && (none - 1.0).abs() < 2e-3, "{human} {none}");
}

/// An eye to the character's left that looks a little outward.
fn left() -> Primitive {
    let mut of = open_ball();
    let place = Mat4::from_rotation_translation(Quat::from_rotation_y(0.09), Vec3::new(0.03, 0.0, 0.0));
    of.positions.iter_mut().for_each(|p| *p = place.transform_point3(Vec3::from(*p)).to_array());
    of
}

/// The eye to the other side: with its vertices in the mesh, or by a node that mirrors.
fn pair(by_node: bool) -> Scene {
    let mut part = left();
    let count = part.positions.len() as u32;
    let mut uv_of_both = part.uvs[0].clone();
    if !by_node {
        let flipped: Vec<[f32; 3]> = part.positions.iter().map(|[x, y, z]| [-x, *y, *z]).collect();
        part.positions.extend(flipped);
        uv_of_both.extend(part.uvs[0].clone());
        let turned: Vec<u32> =
            part.indices.chunks_exact(3).flat_map(|t| [t[0], t[2], t[1]].map(|i| i + count)).collect();
        part.indices.extend(turned);
    }
    part.uvs[0] = uv_of_both;
    let mut of = eyes(vec![part], Eye::default());
    let picture =
        texture(&mut of, 128, 128, |x, y| colors(DVec2::new(f64::from(x) / 64.0 - 1.0, 1.0 - f64::from(y) / 64.0)));
    of.materials[0].base.texture = Some(picture);
    if by_node {
        let transform = Transform { scale: Vec3::new(-1.0, 1.0, 1.0), ..Transform::default() };
        of.nodes.push(Node { mesh: Some(0), transform, ..Node::default() });
    }
    of
}

#[test]
fn both_eyes_show_mirrored_pictures() {
    let gpu = gpu();
    let flip = Vec3::new(-1.0, 1.0, 1.0);
    for by_node in [false, true] {
        let both = pair(by_node);
        let shot = seen(96, ALL, [25.0, 10.0], Vec3::new(0.5, 0.4, 0.8));
        let of_side = |side: Vec3| {
            let mut shot = shot.clone();
            let moved = Vec3::new(0.03, 0.0, 0.0);
            (shot.camera.eye, shot.camera.target) = ((shot.camera.eye + moved) * side, moved * side);
            shot.camera.up *= side;
            shot.lights.directional.to_light *= side;
            render(&gpu, &both, &shot)
        };
        let [mean, block] = difference(&of_side(Vec3::ONE), &mirrored(&of_side(flip)));
        println!("by a node {by_node}: {mean:.3}, block {block:.3}");
        assert!(mean < 0.5 && block < 12.0, "by a node {by_node}: {mean}, block {block}");
    }
}

/// Whether a node or a joint turns it: as if camera and light had turned the other way.
#[test]
fn an_eye_turns_with_what_moves_it() {
    let gpu = gpu();
    let turn = Quat::from_euler(EulerRot::YXZ, 20f32.to_radians(), -0.15, 0.1);
    let of = || with_iris(eyeball(Eye { scatter: 0.0, ..Eye::portrait() }), colors);
    let mut skinned = of();
    let count = skinned.meshes[0].primitives[0].positions.len();
    skinned.meshes[0].primitives[0].influences =
        Influences { per_vertex: 4, joints: vec![0; 4 * count], weights: [1.0, 0.0, 0.0, 0.0].repeat(count) };
    skinned.nodes[0].mesh = None;
    skinned.nodes.push(Node { mesh: Some(0), skin: Some(0), ..Node::default() });
    skinned.skins = vec![Skin { joints: vec![0], joint_from_mesh: vec![Mat4::IDENTITY], ..Skin::default() }];
    for (name, scene) in [("a node", of()), ("a joint", skinned)] {
        let shot = seen(96, ALL, FRONT, Vec3::new(-0.4, 0.5, 0.8));
        let [turned, still] = with_renderer(&gpu, |renderer| {
            let mut stage = staged(renderer.upload(&scene));
            let mut pose = Pose::rest(&scene);
            pose.locals[0].rotation = turn;
            stage.actors[0].pose = pose;
            let turned = renderer.shoot(&mut stage, &shot).expect("a picture");
            stage.actors[0].pose = Pose::rest(&scene);
            let mut other = shot.clone();
            let back = turn.inverse();
            other.camera.eye = back * other.camera.eye;
            other.camera.up = back * other.camera.up;
            other.lights.directional.to_light = back * other.lights.directional.to_light;
            let rest = renderer.shoot(&mut stage, &shot).expect("a picture");
            assert!(difference(&turned, &rest)[0] > 5.0, "{name}: nothing has turned");
            [turned, renderer.shoot(&mut stage, &other).expect("a picture")]
        });
        let [mean, block] = difference(&turned, &still);
        println!("{name}: {mean:.3}, block {block:.3}");
        // Vertices are rounded otherwise.
        assert!(mean < 0.3 && block < 4.0, "{name}: {mean}, block {block}");
    }
}

/// White with a black pupil, as it is painted.
fn pupil(q: DVec2) -> [u8; 4] {
    if q.length() < 0.35 { [0, 0, 0, 255] } else { [255; 4] }
}

#[test]
fn pupils_widen_and_the_limbus_stays() {
    let gpu = gpu();
    let shot = seen(128, IRIS, FRONT, Vec3::Z);
    let of = |pupil_mm: f32| with_iris(eyes(vec![open_ball()], Eye { pupil_mm, caustic: 0.0, ..matt() }), pupil);
    let radii: Vec<f64> =
        rays(&shot).iter().map(|ray| ray.on_iris(&EyeDimensions::default()).map_or(2.0, DVec2::length)).collect();
    let limbus = |of: &Scene| render(&gpu, of, &shown(&shot, "eye-limbus"));
    let first = limbus(&of(1.0));
    let mut last = 0;
    for mm in 1..=8u8 {
        let wide = of(f32::from(mm));
        let dark: Vec<bool> = linear(&render(&gpu, &wide, &shot)).iter().map(|c| c.y < 0.5).collect();
        let found = dark.iter().zip(&radii).filter(|(dark, q)| **dark && **q < 0.9).count();
        let expected = radii.iter().filter(|q| **q < f64::from(mm) / 11.8).count();
        println!("{mm} mm: {found} px, expected {expected}");
        assert!(found > last, "{mm} mm: {found} px, before {last}");
        // The picture's edge is as wide as a texel.
        assert!(found.abs_diff(expected) * 30 < expected + 300, "{mm} mm: {found} px, expected {expected}");
        assert!(limbus(&wide) == first, "{mm} mm: the limbus has changed");
        last = found;
    }
}

/// As much light as enters falls on the iris, whose rim is hidden: a little less than 1 enters, 0.975 of the radius are seen, so that
/// the mean of light straight on is next to 1 with and without the gathering. From the side, rays are bent to the far half, but not
/// as far as its rim.
#[test]
fn light_gathers_opposite_of_the_lamp() {
    let gpu = gpu();
    let on_iris = |caustic: f32, degrees: f32| {
        let shot = seen(96, IRIS, FRONT, from_yaw(degrees));
        let of = eyes(vec![open_ball()], Eye { caustic, ..matt() });
        let places = places(&gpu, &of, &shot);
        let light = linear(&render(&gpu, &of, &shown(&shot, "eye-caustic")));
        places.iter().zip(light).filter_map(|(q, l)| Some(((*q)?, 2.0 * l.y))).collect::<Vec<(DVec2, f32)>>()
    };
    let [straight, even] = [1.0, 0.0].map(|caustic| mean(on_iris(caustic, 0.0).iter().map(|(_, l)| *l)));
    println!("straight on: {straight:.4}, {even:.4} without gathering");
    assert!((0.9..=1.1).contains(&(straight / even)), "{straight} {even}");
    for degrees in [30.0, 45.0, 60.0] {
        let [gathered, even] = [1.0, 0.0].map(|caustic| {
            let light = on_iris(caustic, degrees);
            let of = |side: f64, reach: f64| {
                let half = light.iter().filter(|(q, _)| (0.0..reach).contains(&(q.x * side)) && q.y.abs() < 0.6);
                mean(half.map(|(_, l)| *l))
            };
            [of(-1.0, 0.6), of(1.0, 0.6), of(-1.0, 1.0), of(1.0, 1.0)]
        });
        println!("from {degrees}: {gathered:.3?}, {even:.3?} without gathering");
        assert!(gathered[0] / gathered[1] > 1.02 * even[0] / even[1], "from {degrees}: {gathered:?}, {even:?}");
        assert!(gathered[0] > 1.05 * gathered[1] && gathered[2] > gathered[3], "from {degrees}: {gathered:?}");
    }
}

#[test]
fn the_limbus_darkens_as_it_is_told() {
    let gpu = gpu();
    let shot = seen(96, ALL, FRONT, Vec3::Z);
    let of = |limbus_width: f32, limbus_strength: f32| {
        let shown = shown(&shot, "eye-limbus");
        let picture = render(&gpu, &eyeball(Eye { limbus_width, limbus_strength, ..matt() }), &shown);
        let of_ball = picture.pixels.chunks_exact(4).zip(rays(&shot)).filter(|(_, ray)| ray.is_on_ball());
        of_ball.map(|(p, _)| p[1]).collect::<Vec<u8>>()
    };
    assert!(of(0.3, 0.0).iter().all(|c| *c == 255));
    let mean = |pixels: Vec<u8>| mean(pixels.iter().map(|c| f32::from(*c)));
    let darker = |list: [[f32; 2]; 3]| list.map(|[width, strength]| mean(of(width, strength)));
    for list in [darker([[0.14, 0.2], [0.14, 0.6], [0.14, 1.0]]), darker([[0.05, 0.8], [0.2, 0.8], [0.4, 0.8]])] {
        assert!(list[0] < 255.0 && list[0] > list[1] + 0.5 && list[1] > list[2] + 0.5, "{list:?}");
    }
    // Only round the iris, and on its side darker than half, which is the most on the white's.
    let ring = of(0.14, 1.0);
    let white = ring.iter().filter(|c| **c == 255).count();
    let least = ring.iter().min();
    assert!(least < Some(&188) && white * 10 > ring.len() * 6, "{least:?}, {white} of {} px", ring.len());
}
