//! Eyes made in code: a ball, a ball with a bulge, cornea, iris and sclera apart, a flat iris; lids; and pictures of them.

use std::f32::consts::{PI, TAU};

use glam::{DVec2, DVec3, Quat, Vec3};
use hikage::color::{LinearRgb, linear_from_srgb};
use hikage::eye::EyeDimensions;
use hikage::material::{Base, Eye, Material, TextureRef};
use hikage::scene::{Ambient, Camera, Character, DirectionalLight, HumanBone, Image, Lights, Primitive, Role, Scene};
use hikage::{Background, Channel};

use crate::support::{Shot, scene, texture};

/// Radius of balls, mm: that of the measures, so that places of meshes are those of the eye.
const BALL: f32 = 12.0;
/// Where the limbus is, radians from the front.
const LIMBUS: f32 = 0.513_9;
/// Distance of the camera, metres: rays are next to parallel.
const DISTANCE: f32 = 2.0;

/// A surface of revolution about +z through rings of radius and height, mm; its picture reaches over the ball as it is seen.
pub fn lathe(rings: &[[f32; 2]]) -> Primitive {
    const STEPS: u32 = 64;
    let mut made = Primitive { role: Role::Eye, uvs: vec![Vec::new()], ..Primitive::default() };
    for [radius, height] in rings {
        for s in 0..STEPS {
            let (sin, cos) = (s as f32 / STEPS as f32 * TAU).sin_cos();
            let [x, y] = [radius * cos, radius * sin];
            made.positions.push([x, y, *height].map(|mm| mm * 1e-3));
            made.uvs[0].push([0.5 + x / (2.0 * BALL), 0.5 - y / (2.0 * BALL)]);
        }
    }
    for r in 0..rings.len() as u32 - 1 {
        for s in 0..STEPS {
            let [a, b] = [s, (s + 1) % STEPS].map(|s| r * STEPS + s);
            made.indices.extend([a, a + STEPS, b + STEPS, a, b + STEPS, b]);
        }
    }
    made
}

/// Rings of a ball between two angles from the front.
fn arc(low: f32, high: f32) -> Vec<[f32; 2]> {
    (0..=40)
        .map(|i| (low + (high - low) * i as f32 / 40.0).sin_cos().into())
        .map(|p: [f32; 2]| p.map(|x| x * BALL))
        .collect()
}

fn cornea() -> Vec<[f32; 2]> {
    let human = EyeDimensions::default();
    let widest = (human.limbus_radius_mm / human.cornea_radius_mm).asin();
    let ring = |i: i32| (widest * i as f32 / 24.0).sin_cos();
    let placed = |(sin, cos): (f32, f32)| [sin, cos].map(|x| x * human.cornea_radius_mm);
    (0..=24).map(|i| placed(ring(i))).map(|[r, h]| [r, h + human.cornea_centre_z_mm()]).collect()
}

/// Closed all around: where it looks, only a bone says.
pub fn ball() -> Primitive {
    lathe(&arc(0.0, PI))
}

/// Open behind.
pub fn open_ball() -> Primitive {
    lathe(&arc(0.0, 1.9))
}

pub fn bulged() -> Primitive {
    lathe(&[cornea(), arc(LIMBUS, PI)].concat())
}

/// Cornea, iris and sclera.
pub fn apart() -> Vec<Primitive> {
    let human = EyeDimensions::default();
    let iris: Vec<[f32; 2]> = (0..=8).map(|i| [5.8 * i as f32 / 8.0, human.iris_z_mm()]).collect();
    vec![lathe(&cornea()), lathe(&iris), lathe(&arc(LIMBUS, 2.8))]
}

/// A shell round the ball that is open where `is_open` says, by longitude and elevation, radians.
pub fn lids(is_open: impl Fn(f32, f32) -> bool) -> Primitive {
    let mut made = Primitive { role: Role::Face, ..Primitive::default() };
    let place = |l: i32, e: i32| {
        let (l, e) = ((l as f32).to_radians(), (e as f32).to_radians());
        (Vec3::new(l.sin() * e.cos(), e.sin(), l.cos() * e.cos()) * 0.0124).to_array()
    };
    for (l, e) in (-80..80).step_by(2).flat_map(|l| (-80..80).step_by(2).map(move |e| (l, e))) {
        if !is_open((l as f32 + 1.0).to_radians(), (e as f32 + 1.0).to_radians()) {
            let first = made.positions.len() as u32;
            made.positions.extend([place(l, e), place(l + 2, e), place(l + 2, e + 2), place(l, e + 2)]);
            made.indices.extend([0, 1, 2, 0, 2, 3].map(|i| first + i));
        }
    }
    made
}

/// Eyes that neither scatter nor mirror light: what they show is the iris and flat white.
pub fn matt() -> Eye {
    Eye { scatter: 0.0, specular_strength: 0.0, ..Eye::default() }
}

/// Parts of white eyes.
pub fn eyes(parts: Vec<Primitive>, eye: Eye) -> Scene {
    let white = || Material { name: "Eyes".to_owned(), eye: Some(eye), ..Material::default() };
    scene(parts.into_iter().map(|part| (part, white())).collect())
}

/// A closed ball, whose bone looks ahead.
pub fn eyeball(eye: Eye) -> Scene {
    let character = Character { bones: [(HumanBone::LeftEye, 0)].into(), ..Character::default() };
    Scene { character: Some(character), ..eyes(vec![ball()], eye) }
}

/// Gives all eyes of a scene a picture of the iris, by places of its unit disc: x to the right, y up.
pub fn with_iris(mut of: Scene, texel: impl Fn(DVec2) -> [u8; 4]) -> Scene {
    let map = disc_picture(&mut of, texel);
    of.materials.iter_mut().filter_map(|m| m.eye.as_mut()).for_each(|eye| eye.iris_map = Some(map));
    of
}

/// A square picture about a unit disc.
pub fn disc_picture(of: &mut Scene, texel: impl Fn(DVec2) -> [u8; 4]) -> TextureRef {
    const SIDE: u32 = 128;
    let place = |i: u32| (f64::from(i) + 0.5) / f64::from(SIDE) * 2.0 - 1.0;
    texture(of, SIDE, SIDE, |x, y| texel(DVec2::new(place(x), -place(y))))
}

/// Other colours in each direction, without an edge.
pub fn colors(q: DVec2) -> [u8; 4] {
    let code = |x: f64| (128.0 + 90.0 * x.sin()) as u8;
    [code(2.0 * q.x), code(1.5 * q.y + 1.0), code(2.0 * (q.x - q.y)), 255]
}

/// From far away, yaw to +x and pitch to above, degrees, with so many mm to either side, in a light of strength 1 alone.
pub fn seen(side: u32, half_mm: f32, [yaw, pitch]: [f32; 2], to_light: Vec3) -> Shot {
    let turn = Quat::from_rotation_y(yaw.to_radians()) * Quat::from_rotation_x(-pitch.to_radians());
    Shot {
        size: [side; 2],
        camera: Camera {
            eye: turn * Vec3::Z * DISTANCE,
            target: Vec3::ZERO,
            up: turn * Vec3::Y,
            fov_y_rad: 2.0 * (half_mm * 1e-3 / DISTANCE).atan(),
            ..Camera::default()
        },
        lights: light(to_light),
        background: Background::Transparent,
        ..Shot::default()
    }
}

/// A key light of strength 1, nothing else.
pub fn light(to_light: Vec3) -> Lights {
    Lights {
        directional: DirectionalLight { to_light: to_light.normalize(), ..DirectionalLight::default() },
        ambient: Ambient::uniform(LinearRgb::BLACK),
        ..Lights::default()
    }
}

/// The light that stands so many degrees to +x of the front.
pub fn from_yaw(degrees: f32) -> Vec3 {
    Quat::from_rotation_y(degrees.to_radians()) * Vec3::Z
}

pub fn shown(shot: &Shot, channel: &'static str) -> Shot {
    Shot { channel: Channel::Look(channel), ..shot.clone() }
}

/// A ray of the camera through the middle of a pixel: where it begins, mm, and its direction, unit.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    pub from: DVec3,
    pub along: DVec3,
}

/// The rays of all pixels, row by row.
pub fn rays(shot: &Shot) -> Vec<Ray> {
    let Camera { eye, target, up, fov_y_rad, .. } = shot.camera;
    let ahead = (target - eye).as_dvec3().normalize();
    let right = ahead.cross(up.as_dvec3()).normalize();
    let above = right.cross(ahead);
    let [width, height] = shot.size.map(f64::from);
    let tangent = (0.5 * f64::from(fov_y_rad)).tan();
    let at = |i: u32, of: f64| (f64::from(i) + 0.5) / of * 2.0 - 1.0;
    let along = |x, y| ahead + (right * at(x, width) * width / height - above * at(y, height)) * tangent;
    let of = |(x, y)| Ray { from: eye.as_dvec3() * 1e3, along: along(x, y).normalize() };
    (0..shot.size[1]).flat_map(|y| (0..shot.size[0]).map(move |x| (x, y))).map(of).collect()
}

impl Ray {
    /// Where it meets the plane z = 0, mm.
    pub fn on_plane(&self) -> DVec2 {
        (self.from - self.along * (self.from.z / self.along.z)).truncate()
    }

    /// Whether it meets the ball, and no edge of it.
    pub fn is_on_ball(&self) -> bool {
        (self.from - self.along * self.from.dot(self.along)).length() < f64::from(BALL) - 0.6
    }

    /// Where it meets the iris of an eye about the origin that looks to +z, by Snell's law at the cornea's sphere, radii of the
    /// iris; `None` beside its inner part, and within a fortieth of the limbus.
    pub fn on_iris(&self, of: &EyeDimensions) -> Option<DVec2> {
        let [radius, centre_z, limbus_z, iris_z, iris_radius, ior] =
            [of.cornea_radius_mm, of.cornea_centre_z_mm(), of.limbus_z_mm(), of.iris_z_mm(), of.iris_radius_mm, of.ior]
                .map(f64::from);
        let off = self.from - DVec3::Z * centre_z;
        let half = off.dot(self.along);
        let inside = half * half - off.length_squared() + radius * radius;
        let entry = self.from + self.along * (-half - (inside > 0.0).then(|| inside.sqrt())?);
        let normal = (entry - DVec3::Z * centre_z) / radius;
        let within = self.along.refract(normal, 1.0 / ior);
        let q = (entry + within * ((iris_z - entry.z) / within.z)).truncate() / iris_radius;
        // The shader bounds rays that are flatter than 0.2.
        (entry.z > limbus_z + 0.3 && within.z < -0.25 && q.length() < 0.975).then_some(q)
    }
}

/// The colours of a picture, linear, row by row, black where nothing is.
pub fn linear(image: &Image) -> Vec<Vec3> {
    let of = |p: &[u8]| {
        if p[3] == 0 {
            Vec3::ZERO
        } else {
            Vec3::from([p[0], p[1], p[2]].map(to_linear))
        }
    };
    image.pixels.chunks_exact(4).map(of).collect()
}

fn to_linear(code: u8) -> f32 {
    linear_from_srgb(f32::from(code) / 255.0)
}

/// How far two pictures differ where both are covered whole, codes of 8 bits: in the mean of all pixels, and in that block of 4 x 4
/// where it is most.
pub fn difference(a: &Image, b: &Image) -> [f32; 2] {
    let of = |(a, b): (&[u8], &[u8])| match (a[3], b[3]) {
        (255, 255) => (0..3).map(|c| f32::from(a[c].abs_diff(b[c]))).sum::<f32>() / 3.0,
        _ => 0.0,
    };
    let off: Vec<f32> = a.pixels.chunks_exact(4).zip(b.pixels.chunks_exact(4)).map(of).collect();
    let [columns, rows] = [a.width as usize / 4, a.height as usize / 4];
    let block = |i: usize| {
        let first = i / columns * 4 * a.width as usize + i % columns * 4;
        let rows = (0..4).map(|y| first + y * a.width as usize);
        rows.flat_map(|row| &off[row..row + 4]).sum::<f32>() / 16.0
    };
    [off.iter().sum::<f32>() / off.len() as f32, (0..columns * rows).map(block).fold(0.0, f32::max)]
}

/// The picture as a mirror shows it.
pub fn mirrored(image: &Image) -> Image {
    let row = |row: &[u8]| row.chunks_exact(4).rev().flatten().copied().collect::<Vec<u8>>();
    let pixels = image.pixels.chunks_exact(4 * image.width as usize).flat_map(row).collect();
    Image { pixels, ..image.clone() }
}

/// A material of one flat colour, linear.
pub fn painted(color: f32) -> Base {
    Base { color: [color, color, color, 1.0], texture: None }
}
