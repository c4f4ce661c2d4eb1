//! Scenes of an eye: a grid of dots on the iris seen through the cornea, the light that the cornea gathers on the iris, and both.

use std::fs::File;
use std::path::Path;

use glam::Vec3;
use hikage::Gpu;
use hikage::color::{LinearRgb, linear_from_srgb, srgb_from_linear};
use hikage::eye::EyeDimensions;
use hikage::material::{Base, Eye, Material, Shading, TextureRef};
use hikage::scene::{Ambient, Camera, DirectionalLight, Image, Lights, Sampler, Scene, Texture, Wrap};
use serde::Deserialize;
use serde_json::{Value, json};
use zip::ZipArchive;

use super::scorer::Scorer;
use super::strands::array;
use super::{Reference, Shot, Window, described, drawn, write_npy};
use crate::failure::Failure;

/// Pixels of ours along a side of one of the reference.
const SCALE: u32 = 8;

/// What a reference shows.
#[derive(Clone, Copy)]
pub(super) enum Kind {
    /// An iris that shines by itself, with dots whose places are known.
    Grid,
    /// Irradiance over the plane of the iris.
    Caustic,
    /// An eye in the light of a wide sun.
    Lit,
}

impl Kind {
    /// Of what is compared; others have no refraction, or are there for their noise.
    pub(super) fn of(name: &str) -> Option<Self> {
        match name.split('_').collect::<Vec<_>>()[..] {
            ["eye", "grid", _, _] => Some(Self::Grid),
            ["eye", "caustic", _] => Some(Self::Caustic),
            ["eye", "lit", _, _] => Some(Self::Lit),
            _ => None,
        }
    }
}

/// Draws what a reference shows, writes it, and compares the two.
pub(super) fn figures(
    gpu: &Gpu,
    scorer: &Scorer,
    dir: &Path,
    kind: Kind,
    reference: &Path,
    picture: &Path,
) -> Result<Value, Failure> {
    let fail = |what: String| Failure::input(format!("{}: {what}", reference.display()));
    if let Kind::Caustic = kind {
        let ours = caustic(gpu, dir, &described(reference)?)?;
        write_npy(picture, [SIDE as u32; 2], &ours)?;
        return against_irradiance(reference, &ours).map_err(fail);
    }
    let of: Reference = described(reference)?;
    let ours = drawn(gpu, shot(dir, &of, kind).map_err(fail)?)?;
    write_npy(picture, [of.width, of.height], &ours)?;
    match kind {
        Kind::Grid => scorer.eye(reference, picture),
        _ => against_picture(reference, &ours).map_err(fail),
    }
}

/// The eye of a reference, mm.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Measures {
    eyeball_radius: f32,
    cornea_radius: f32,
    limbus_radius: f32,
    limbus_z: f32,
    iris_plane_z: f32,
    ior: f32,
    pupil_diameter_mm: f32,
    pupil_tex: f32,
}

/// What is drawn of a grid or of a lit eye. The iris of a grid shines by itself: ours lies in white light from everywhere.
fn shot(dir: &Path, of: &Reference, kind: Kind) -> Result<Shot, String> {
    let measures = Measures::deserialize(&of.eye).map_err(|e| format!("eye: {e}"))?;
    let mut scene = model(dir)?;
    let eye = Eye {
        dimensions: EyeDimensions {
            eyeball_radius_mm: measures.eyeball_radius,
            cornea_radius_mm: measures.cornea_radius,
            limbus_radius_mm: measures.limbus_radius,
            iris_radius_mm: measures.limbus_radius,
            iris_depth_mm: measures.limbus_z - measures.iris_plane_z,
            ior: measures.ior,
        },
        iris_map: scene.materials.iter().find_map(|m| m.base.texture),
        pupil_mm: measures.pupil_diameter_mm,
        pupil_drawn: measures.pupil_tex,
        ..bare()
    };
    let white = if let Kind::Grid = kind {
        [0.05; 3]
    } else {
        [0.8, 0.76, 0.72]
    };
    wear(&mut scene, eye, white);
    let mut shot = Shot { window: Window::BlackmanHarris, ..Shot::of(of, vec![scene], SCALE) };
    if of.light.is_none() {
        shot.lights.ambient = Ambient::uniform(LinearRgb::WHITE);
    }
    Ok(shot)
}

/// The eye of all references, in parts.
fn model(dir: &Path) -> Result<Scene, String> {
    hikage::import::load(dir.join("models/eye_gen.glb")).map_err(|e| e.to_string())
}

/// An eye without all that the references lack.
fn bare() -> Eye {
    Eye {
        limbus_strength: 0.0,
        hollow: 0.0,
        specular_strength: 0.0,
        scatter: 0.0,
        veins: 0.0,
        lid_shadow: 0.0,
        lash_shadow: 0.0,
        wet_line_rad: 0.0,
        ..Eye::default()
    }
}

/// Gives cornea and white the eye. The iris behind them stays for its texture coordinates, which tell how the picture lies.
fn wear(scene: &mut Scene, eye: Eye, white: [f32; 3]) {
    for material in &mut scene.materials {
        let name = std::mem::take(&mut material.name);
        let [r, g, b] = white;
        *material = match material.base.texture {
            Some(_) => Material {
                name,
                shading: Shading::Unlit,
                base: Base { color: [0.0, 0.0, 0.0, 1.0], ..material.base },
                ..Material::default()
            },
            None => Material {
                name,
                base: Base { color: [r, g, b, 1.0], texture: None },
                eye: Some(eye),
                ..Material::default()
            },
        };
    }
}

/// The light of a caustic.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Beam {
    light_elevation_from_axis_deg: f32,
}

/// Texels along a side of the irradiance.
const SIDE: usize = 128;
/// Pixels along a side of our pictures: five in each texel.
const PIXELS: u32 = 1024;

/// Irradiance that our eye shows at places of its iris, in the order of the reference; alpha is 0 where nothing shows.
///
/// Two pictures: one of an iris whose colour says where it is seen, one of a white iris in the beam. Debug channels show both, but
/// with 8 bits.
fn caustic(gpu: &Gpu, dir: &Path, beam: &Beam) -> Result<Vec<[f32; 4]>, Failure> {
    let angle = beam.light_elevation_from_axis_deg.to_radians();
    let to_light = Vec3::new(angle.sin(), 0.0, angle.cos());
    let seen = |shows_place: bool| {
        let mut scene = model(dir).map_err(Failure::input)?;
        let iris_map = shows_place.then(|| add_places(&mut scene));
        let white = if shows_place { [0.0; 3] } else { [1.0; 3] };
        wear(&mut scene, Eye { iris_map, pupil_drawn: 0.0, ..bare() }, white);
        let (intensity, ambient) = if shows_place {
            (0.0, LinearRgb::WHITE)
        } else {
            (1.0, LinearRgb::BLACK)
        };
        let lights = Lights {
            directional: DirectionalLight { to_light, intensity, ..DirectionalLight::default() },
            ambient: Ambient::uniform(ambient),
            ..Lights::default()
        };
        let camera = Camera {
            eye: Vec3::new(0.0, 0.0, 0.11),
            target: Vec3::new(0.0, 0.0, 0.01),
            up: Vec3::Y,
            fov_y_rad: 8f32.to_radians(),
            near: 0.001,
            matrices: None,
        };
        drawn(gpu, Shot { scenes: vec![scene], scale: 1, window: Window::Even, size: [PIXELS; 2], camera, lights })
    };
    Ok(gathered(&seen(true)?, &seen(false)?))
}

/// Adds a picture whose colours say where on the iris they are, for [`place_of`].
fn add_places(scene: &mut Scene) -> TextureRef {
    let texel = |i: u32| [(i % 256) as u8, 255 - (i / 256) as u8, 255, 255];
    let pixels = (0..256 * 256).flat_map(texel).collect();
    scene.images.push(Image { width: 256, height: 256, pixels, format: "png", source_bits: 8, ..Image::default() });
    let sampler = Sampler { wrap_u: Wrap::Clamp, wrap_v: Wrap::Clamp, ..Sampler::default() };
    scene.textures.push(Texture { image: scene.images.len() - 1, sampler });
    TextureRef { texture: scene.textures.len() - 1, ..TextureRef::default() }
}

/// The place in the unit disc that a colour of the iris says. Its blue is that of white.
fn place_of([r, g, b, _]: [f32; 4]) -> [f32; 2] {
    [r, g].map(|c| (2.0 * srgb_from_linear(c / b) - 1.0) * 255.0 / 256.0)
}

/// Least blue of a place that nothing but the iris shows at, of the 0.96 that the cornea lets through.
const WHOLLY_IRIS: f32 = 0.95;

/// Means of the light in each texel.
fn gathered(places: &[[f32; 4]], light: &[[f32; 4]]) -> Vec<[f32; 4]> {
    let mut sums = vec![(0f64, 0u32); SIDE * SIDE];
    for (place, light) in places.iter().zip(light).filter(|(place, _)| place[2] > WHOLLY_IRIS) {
        let [x, y] = place_of(*place);
        let [column, row] = [x, -y].map(|at| (((at + 1.0) * 0.5 * SIDE as f32) as usize).min(SIDE - 1));
        let (sum, count) = &mut sums[row * SIDE + column];
        *sum += f64::from(light[1]);
        *count += 1;
    }
    let mean = |(sum, count): (f64, u32)| (sum / f64::from(count.max(1))) as f32;
    sums.into_iter().map(|of| [mean(of), mean(of), mean(of), f32::from(u8::from(of.1 > 0))]).collect()
}

/// Nearer to the rim no texel is compared, share of the radius.
const RIM: f32 = 0.97;

fn against_irradiance(reference: &Path, ours: &[[f32; 4]]) -> Result<Value, String> {
    let theirs: Vec<f32> = array(&mut archive(reference)?, "irradiance")?;
    if theirs.len() != ours.len() {
        return Err(format!("irradiance has {} texels; expected {}", theirs.len(), ours.len()));
    }
    let at = |i: usize| (i as f32 + 0.5) / SIDE as f32 * 2.0 - 1.0;
    let is_compared = |i: &usize| at(i % SIDE).hypot(at(i / SIDE)) < RIM && ours[*i][3] > 0.0;
    let pairs: Vec<[f64; 2]> =
        (0..ours.len()).filter(is_compared).map(|i| [f64::from(theirs[i]), f64::from(ours[i][1])]).collect();
    let [theirs, ours] = means(&pairs);
    Ok(json!({
        "kind": "caustic",
        "texels": pairs.len(),
        "correlation": correlation(&pairs),
        "ratioOfMeans": ours / theirs,
    }))
}

/// Against the reference's picture with 8 bits, which says enough where the light is another one: what is drawn has a sharp sun
/// that nothing mirrors.
fn against_picture(reference: &Path, ours: &[[f32; 4]]) -> Result<Value, String> {
    let theirs = hikage::picture::read_png(reference.with_extension("png")).map_err(|e| e.to_string())?;
    let alpha: Vec<u8> = array(&mut archive(reference)?, "alpha")?;
    let both = theirs.pixels.as_chunks::<4>().0.iter().zip(&alpha).zip(ours);
    let pairs: Vec<[f64; 2]> = both
        .filter(|((_, alpha), ours)| **alpha == 255 && ours[3] > 0.99)
        .flat_map(|((theirs, _), ours)| {
            let theirs = theirs.map(|c| f64::from(linear_from_srgb(f32::from(c) / 255.0)));
            (0..3).map(move |c| [theirs[c], f64::from(ours[c])])
        })
        .collect();
    let difference = pairs.iter().map(|[t, o]| (t - o).abs()).sum::<f64>() / pairs.len() as f64;
    let [their_mean, our_mean] = means(&pairs);
    Ok(json!({
        "kind": "lit",
        "pixels": pairs.len() / 3,
        "meanAbsDifference": difference,
        "correlation": correlation(&pairs),
        "ratioOfMeans": our_mean / their_mean,
    }))
}

fn archive(reference: &Path) -> Result<ZipArchive<File>, String> {
    let file = File::open(reference.with_extension("npz")).map_err(|e| e.to_string())?;
    ZipArchive::new(file).map_err(|e| e.to_string())
}

fn means(pairs: &[[f64; 2]]) -> [f64; 2] {
    [0, 1].map(|i| pairs.iter().map(|pair| pair[i]).sum::<f64>() / pairs.len() as f64)
}

/// Pearson's.
fn correlation(pairs: &[[f64; 2]]) -> f64 {
    let [a, b] = means(pairs);
    let sum = |of: &dyn Fn(f64, f64) -> f64| pairs.iter().map(|[x, y]| of(x - a, y - b)).sum::<f64>();
    sum(&|x, y| x * y) / (sum(&|x, _| x * x) * sum(&|_, y| y * y)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn references_that_show_something_else_are_left_out() {
        for name in ["eye_grid_v30_p2", "eye_caustic_l30", "eye_lit_v00_p4"] {
            assert!(Kind::of(name).is_some(), "{name}");
        }
        for name in ["eye_grid_v30_p2_seed2", "eye_grid_v30_p2_norefract", "skin_head_rw_yaw060", "eye_grid"] {
            assert!(Kind::of(name).is_none(), "{name}");
        }
    }

    #[test]
    fn colours_of_places_lead_back_to_them() {
        let mut scene = Scene::default();
        let texture = scene.textures.len();
        assert_eq!(add_places(&mut scene).texture, texture);
        for (column, row) in [(0, 0), (13, 200), (255, 128)] {
            let texel = scene.images[0].pixels.as_chunks::<4>().0[row * 256 + column];
            let [x, y] = place_of(texel.map(|c| 0.96 * linear_from_srgb(f32::from(c) / 255.0)));
            let expected = [(column as f32 + 0.5) / 128.0 - 1.0, 1.0 - (row as f32 + 0.5) / 128.0];
            assert!((x - expected[0]).abs() < 1e-4 && (y - expected[1]).abs() < 1e-4, "{x} {y} {expected:?}");
        }
    }

    #[test]
    fn light_is_gathered_with_up_in_the_first_row() {
        let colour = |x: f32, y: f32| {
            let [r, g] = [x, y].map(|c| 0.96 * linear_from_srgb((c * 256.0 / 255.0 + 1.0) * 0.5));
            [r, g, 0.96, 1.0]
        };
        let places = [colour(-0.99, 0.99), colour(-0.99, 0.99), colour(0.99, 0.51), [0.0; 4]];
        let found = gathered(&places, &[[0.5; 4], [1.5; 4], [0.25; 4], [9.0; 4]]);
        assert_eq!(found[0], [1.0; 4]);
        assert_eq!(found[32 * SIDE - 1], [0.25, 0.25, 0.25, 1.0]);
        assert_eq!(found.iter().filter(|texel| texel[3] > 0.0).count(), 2);
    }

    #[test]
    fn correlation_is_that_of_a_line() {
        let line: Vec<[f64; 2]> = (0..9).map(|i| [f64::from(i), 3.0 - 2.0 * f64::from(i)]).collect();
        assert!((correlation(&line) + 1.0).abs() < 1e-12);
    }
}
