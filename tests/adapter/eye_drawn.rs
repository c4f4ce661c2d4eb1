//! Drawn eyes: irises that have depth, shapes of pupils, and lights that move.

use glam::{DVec2, DVec3, Vec3};
use hikage::material::{EyeCard, EyeDepth, Material, PupilShape, Shading, Toon};
use hikage::scene::{Primitive, Role, Scene};

use crate::eyeballs::{Ray, ball, disc_picture, light, linear, painted, rays, seen, shown};
use crate::support::{Lent, gpu, pixel, render, scene, square, with_renderer};

/// Half of the side of an iris, and what is seen of it, mm.
const HALF: f32 = 12.0;
const SEEN: f32 = 14.0;

fn card() -> Primitive {
    Primitive { role: Role::Eye, ..square([0.0; 2], HALF * 1e-3, 0.0) }
}

/// A white iris in flat light.
fn iris(part: Primitive, eye_depth: Option<EyeDepth>) -> Scene {
    let shading = Shading::Toon(Toon { shade_color: [1.0; 3], ..Toon::default() });
    scene(vec![(part, Material { name: "Iris".to_owned(), shading, eye_depth, ..Material::default() })])
}

/// With a picture, by places of its square: x to the right, y up.
fn pictured(part: Primitive, eye_depth: Option<EyeDepth>, texel: impl Fn(DVec2) -> [u8; 4]) -> Scene {
    let mut of = iris(part, eye_depth);
    of.materials[0].base.texture = Some(disc_picture(&mut of, texel));
    of
}

/// Where a ray meets the card, and what it sees behind the cornea, shares of its half: Snell's law, and where the bent ray meets
/// the paraboloid, by halving; `None` where it looks over the rim at the far wall.
fn on_bowl(ray: &Ray, of: &EyeDepth) -> (DVec2, Option<DVec2>) {
    let flat = ray.on_plane() / f64::from(HALF);
    let [depth, bulge, ior] = [of.depth, of.bulge, of.ior].map(f64::from);
    if flat.length() >= 1.0 {
        return (flat, Some(flat));
    }
    let normal = DVec3::new(flat.x * bulge, flat.y * bulge, 1.0).normalize();
    let within = ray.along.refract(normal, 1.0 / ior);
    let slope = within.truncate() / -within.z;
    let [mut low, mut high] = [0.0, depth];
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let is_above = middle < depth * (1.0 - (flat + slope * middle).length_squared());
        (low, high) = if is_above { (middle, high) } else { (low, middle) };
    }
    (flat, (flat.dot(slope) > -0.5 / depth).then_some(flat + slope * low))
}

#[test]
fn a_flat_iris_shows_what_it_shows_without() {
    let gpu = gpu();
    let rings =
        |q: DVec2| [(128.0 + 100.0 * (6.0 * q.x).sin()) as u8, (128.0 + 100.0 * (5.0 * q.y).cos()) as u8, 90, 255];
    for yaw in [0.0, 40.0] {
        let shot = seen(96, SEEN, [yaw, 10.0], Vec3::Z);
        let flat = Some(EyeDepth { depth: 0.0, ..EyeDepth::default() });
        let [with, without] = [flat, None].map(|depth| render(&gpu, &pictured(card(), depth, rings), &shot));
        let most = with.pixels.iter().zip(&without.pixels).map(|(a, b)| a.abs_diff(*b)).max();
        assert!(most <= Some(1), "from {yaw}: {most:?}");
    }
}

#[test]
fn depth_is_that_of_a_bowl_behind_a_lens_and_the_rim_stays() {
    let gpu = gpu();
    for (yaw, pitch) in [(0.0, 0.0), (40.0, 0.0), (-60.0, 15.0), (0.0, -45.0)] {
        let of = EyeDepth::default();
        let shot = seen(96, SEEN, [yaw, pitch], Vec3::Z);
        let moved = linear(&render(&gpu, &iris(card(), Some(of)), &shown(&shot, "eye-depth")));
        let (mut worst, mut middle, mut count) = (0.0f64, DVec2::ZERO, 0);
        for (found, ray) in moved.iter().zip(rays(&shot)) {
            let (flat, seen) = on_bowl(&ray, &of);
            if flat.abs().max_element() > 0.93 {
                continue;
            }
            let found = found.truncate().as_dvec2() * 2.0 - 1.0;
            worst = worst.max(seen.map_or(0.0, |seen| (found - (seen - flat)).abs().max_element()));
            if flat.length() < 0.1 {
                (middle, count) = (middle + found, count + 1);
            }
            // Half a code of 8 bits is 0.006 there.
            assert!(flat.length() < 1.0 || found.abs().max_element() < 0.01, "the rim moves by {found} at {flat}");
            assert!(flat.length() < 0.98 || found.length() < 0.25, "next to the rim it moves by {found} at {flat}");
        }
        println!("from {yaw}, {pitch}: {worst:.4} off, the middle by {}", middle / f64::from(count));
        assert!(worst <= 0.02, "from {yaw}, {pitch}: {worst}");
        // What is deep comes forth from the side that is far from the viewer.
        let [to_right, above] = [yaw, pitch].map(f64::from);
        assert!(middle.x * to_right <= 0.0 && middle.y * above <= 0.0, "from {yaw}, {pitch}: {middle}");
        assert!((middle / f64::from(count)).length() > 0.1 || (yaw, pitch) == (0.0, 0.0));
    }
}

/// However hollow it is and from wherever: beyond the rim nothing moves, and what is seen within is of the bowl.
#[test]
fn what_is_seen_lies_within_the_rim() {
    let gpu = gpu();
    for (depth, bulge, ior) in [(0.45, 2.0, 1.376), (2.0, 0.0, 1.0), (2.0, 2.0, 3.0)] {
        for yaw in [-75.0, -30.0, 75.0] {
            let shot = seen(96, SEEN, [yaw, 0.0], Vec3::Z);
            let of = iris(card(), Some(EyeDepth { depth, bulge, ior, ..EyeDepth::default() }));
            let moved = linear(&render(&gpu, &of, &shown(&shot, "eye-depth")));
            for (found, ray) in moved.iter().zip(rays(&shot)) {
                let flat = ray.on_plane() / f64::from(HALF);
                let found = found.truncate().as_dvec2() * 2.0 - 1.0;
                // Pixels are wide from the side, and those of its edge are not covered whole.
                if flat.abs().max_element() < 0.85 {
                    let most = if flat.length() < 1.0 {
                        1.02
                    } else {
                        flat.length() + 0.01
                    };
                    assert!((flat + found).length() < most, "{depth} deep from {yaw}: moved by {found} at {flat}");
                }
            }
        }
    }
}

/// Middle of what is dark, shares of the half.
fn dark_middle(gpu: &Lent, of: &Scene, yaw: f32) -> DVec2 {
    let shot = seen(160, SEEN, [yaw, 0.0], Vec3::Z);
    let picture = render(gpu, of, &shot);
    let rays = rays(&shot);
    let dark = picture.pixels.chunks_exact(4).zip(&rays).filter(|(p, _)| p[3] == 255 && p[1] < 100);
    let places: Vec<DVec2> = dark.map(|(_, ray)| ray.on_plane() / f64::from(HALF)).collect();
    assert!(places.len() > 20, "{} px are dark", places.len());
    places.iter().sum::<DVec2>() / places.len() as f64
}

/// A dot in the middle of the picture; however that lies on the card.
#[test]
fn the_middle_of_a_picture_moves_however_it_lies() {
    let gpu = gpu();
    let dot = |q: DVec2| if q.length() < 0.15 { [0, 0, 0, 255] } else { [255; 4] };
    // What u and v are, by u, v and 1 of the plain square.
    let layouts = [
        ("as it is", [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]),
        ("mirrored", [[-1.0, 0.0, 1.0], [0.0, 1.0, 0.0]]),
        ("turned", [[0.0, 1.0, 0.0], [-1.0, 0.0, 1.0]]),
        ("a tile", [[0.5, 0.0, 0.25], [0.0, 0.5, 0.25]]),
    ];
    for yaw in [35.0, -50.0] {
        let of = EyeDepth::default();
        let shot = seen(160, SEEN, [yaw, 0.0], Vec3::Z);
        let radius = |name| if name == "a tile" { 0.3 } else { 0.15 };
        for (name, layout) in layouts {
            let mut part = card();
            part.uvs[0].iter_mut().for_each(|uv| *uv = layout.map(|[u, v, one]: [f32; 3]| u * uv[0] + v * uv[1] + one));
            let found = dark_middle(&gpu, &pictured(part, Some(of), dot), yaw);
            let seen = rays(&shot).into_iter().map(|ray| on_bowl(&ray, &of));
            let is_dot = |q: Option<DVec2>| q.is_some_and(|q| q.length() < radius(name));
            let inside: Vec<DVec2> = seen.filter(|(_, q)| is_dot(*q)).map(|(flat, _)| flat).collect();
            let expected = inside.iter().sum::<DVec2>() / inside.len() as f64;
            println!("{name} from {yaw}: {found}, expected {expected}");
            // A pixel is 0.015.
            assert!(found.distance(expected) < 0.02, "{name} from {yaw}: {found}, expected {expected}");
            assert!(found.x * f64::from(yaw) > 0.0, "{name} from {yaw}: {found}");
        }
    }
}

/// Areas in the unit disc: of two arcs that meet, of a square with two half discs, of ten triangles.
#[test]
fn pupils_have_their_shapes_and_stay_inside_of_the_rim() {
    let gpu = gpu();
    let shapes = [
        (PupilShape::Round, std::f32::consts::PI),
        (PupilShape::Slit, 0.927),
        (PupilShape::Heart, 2.401),
        (PupilShape::Star, 1.469),
    ];
    let side = 160;
    let pixel_mm = 2.0 * SEEN / side as f32;
    let black = |shape, depth| EyeDepth {
        pupil_shape: shape,
        pupil_color: [0.0, 0.0, 0.0, 1.0],
        pupil_radius: 0.55,
        depth,
        ..EyeDepth::default()
    };
    // How dark each place of the card is.
    let dark = |of: EyeDepth, yaw: f32| -> Vec<(f32, DVec2)> {
        let shot = seen(side, SEEN, [yaw, 0.0], Vec3::Z);
        let picture = linear(&render(&gpu, &iris(card(), Some(of)), &shot));
        let places = rays(&shot).into_iter().map(|ray| ray.on_plane() / f64::from(HALF));
        let on_card = picture.into_iter().zip(places).filter(|(_, q)| q.abs().max_element() < 0.97);
        on_card.map(|(c, q)| (1.0 - c.y, q)).collect()
    };
    let sum = |of: &[(f32, DVec2)]| of.iter().map(|(d, _)| d).sum::<f32>();
    for (shape, area) in shapes {
        let front = sum(&dark(black(shape, 0.0), 0.0));
        let expected = area * (0.55 * HALF / pixel_mm).powi(2);
        println!("{shape:?}: {front} px, expected {expected}");
        assert!((front / expected - 1.0).abs() < 0.03, "{shape:?}: {front} px, expected {expected}");
        for yaw in [-60.0, 60.0] {
            let aslant = dark(black(shape, EyeDepth::default().depth), yaw);
            // Half as wide as it is from the front, and narrowed by what is before it.
            let share = sum(&aslant) / front;
            println!("{shape:?} from {yaw}: {share}");
            assert!((0.2..0.8).contains(&share), "{shape:?} from {yaw}: {share}");
            let beyond = aslant.iter().filter(|(d, q)| *d > 0.05 && q.length() > 1.0).count();
            assert_eq!(beyond, 0, "{shape:?} from {yaw}: px beyond the rim");
        }
    }
}

#[test]
fn light_from_below_brightens_the_lower_half() {
    let gpu = gpu();
    let shot = seen(96, SEEN, [0.0; 2], Vec3::new(0.3, 0.3, 0.9));
    let picture = |from_below: f32, follow_light: f32| {
        let mut of = iris(card(), Some(EyeDepth { from_below, follow_light, ..EyeDepth::default() }));
        of.materials[0].base = painted(0.2);
        linear(&render(&gpu, &of, &shot))
    };
    let [plain, below, opposite] = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)].map(|(by, follow)| picture(by, follow));
    let (mut most, mut sideways) = (0.0f32, 0.0f32);
    for (i, ray) in rays(&shot).iter().enumerate() {
        let q = ray.on_plane() / f64::from(HALF);
        let more = below[i].y - plain[i].y;
        assert!(more > -1e-3 && (q.y < 0.0 || more < 1e-3), "{more} at {q}");
        most = most.max(more);
        sideways += (opposite[i].y - plain[i].y) * -q.x.signum() as f32;
    }
    // At most doubled.
    assert!((0.1..=0.2).contains(&most), "{most}");
    assert!(sideways > 10.0, "light from the right gathers on the left: {sideways}");
}

#[test]
fn lights_on_cards_move_within_bounds_and_keep_their_shape() {
    let gpu = gpu();
    let (half, by_view, by_light, within) = (1.5, [2.5, 1.5], [1.5, 1.0], 2.0);
    let metres = |mm: [f64; 2]| mm.map(|x| x as f32 * 1e-3);
    let section = EyeCard { by_view_m: metres(by_view), by_light_m: metres(by_light), within_m: within as f32 * 1e-3 };
    let card = |eye_card| {
        let material = Material { shading: Shading::Unlit, eye_card, ..Material::default() };
        scene(vec![(Primitive { role: Role::EyeHighlight, ..square([0.0; 2], half as f32 * 1e-3, 0.0) }, material)])
    };
    let mut farthest = 0.0f64;
    for (yaw, pitch) in [(0.0, 0.0), (25.0, 0.0), (-50.0, 0.0), (10.0, 30.0)] {
        for to_light in [Vec3::Z, Vec3::X, Vec3::new(-0.5, 0.7, 0.5)].map(Vec3::normalize) {
            let mut shot = seen(160, 5.0, [yaw, pitch], Vec3::Z);
            shot.lights = light(to_light);
            let rays = rays(&shot);
            let places = |of: &Scene| -> Vec<DVec2> {
                let picture = render(&gpu, of, &shot);
                let inside = (0..160 * 160u32).filter(|i| pixel(&picture, i % 160, i / 160)[3] > 127);
                inside.map(|i| rays[i as usize].on_plane()).collect()
            };
            let middle = |of: &[DVec2]| of.iter().sum::<DVec2>() / of.len() as f64;
            let extent = |of: &[DVec2]| {
                let (low, high) = of.iter().fold((DVec2::MAX, DVec2::MIN), |(l, h), p| (l.min(*p), h.max(*p)));
                high - low
            };
            let (moved, still) = (places(&card(Some(section))), places(&card(None)));
            let found = middle(&moved) - middle(&still);
            let view = shot.camera.eye.as_dvec3().normalize().truncate();
            let wanted = view * DVec2::from(by_view) + to_light.truncate().as_dvec2() * DVec2::from(by_light);
            let expected = wanted.clamp_length_max(within);
            farthest = farthest.max(found.length());
            // A pixel is 0.06 mm, and wider aslant.
            assert!(found.distance(expected) < 0.06, "from {yaw}, {pitch}, {to_light}: {found}, expected {expected}");
            assert!(found.length() <= within + 0.06, "{found}");
            let [a, b] = [extent(&moved), extent(&still)];
            assert!((a - b).abs().max_element() < 0.15, "from {yaw}, {pitch}, {to_light}: {a}, without {b}");
            assert!((moved.len() as f64 / still.len() as f64 - 1.0).abs() < 0.05, "{} {}", moved.len(), still.len());
        }
    }
    assert!(farthest > 0.95 * within, "the bound is not reached: {farthest}");
}

#[test]
fn what_no_iris_is_drawn_on_is_refused() {
    let gpu = gpu();
    let bare = Primitive { uvs: Vec::new(), ..card() };
    for (part, words) in [(ball(), "looks everywhere"), (bare, "texture coordinates")] {
        let of = iris(part, Some(EyeDepth::default()));
        let message = with_renderer(&gpu, |r| r.upload(&of).expect_err(words)).to_string();
        println!("{message}");
        assert!(message.contains("\"Iris\", eye_depth") && message.contains(words), "{message}");
        assert!(!message.contains('\n'), "{message}");
    }
}
