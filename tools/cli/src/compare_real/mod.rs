//! `hikage compare-real`: our pictures of real assets beside those of a path tracer, with the figures of its scorer.
//!
//! `DIR/reference/NAME.json` states model, camera, light and material of `NAME.npz`; models lie in `DIR/models`. Our pictures are
//! written as linear `NAME.npy`, and `DIR/compare_real.py` scores them.

mod eye;
mod hair;
mod scorer;
mod skin;
mod strands;

use std::collections::HashSet;
use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};

use hikage::color::LinearRgb;
use hikage::material::SkinDiffuse;
use hikage::picture::read_linear;
use hikage::scene::{Ambient, Camera, DirectionalLight, Lights, Scene};
use hikage::skin::Transmission;
use hikage::{Actor, Background, Gpu, Output, Renderer, Stage, View, wgpu};
use npyz::WriterBuilder as _;
use serde::{Deserialize, Serialize};

use crate::failure::Failure;
use crate::output::{make_folder, print, print_json};
use crate::reference::{ReferenceCamera, ReferenceLight};
use crate::setup;
use crate::spinner::Spinner;

/// Arguments of `hikage compare-real`.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  hikage compare-real hair ../shared/real
  hikage compare-real hair ../shared/real --only 'hair_arch_*' --json
  hikage compare-real skin ../shared/real --only 'skin_close_*' --method screen-space
  hikage compare-real eye ../shared/real --only 'eye_grid_*' --write eyes

The scorer is Python and needs numpy, scipy and pillow (Debian: apt install python3-numpy python3-scipy python3-pil).")]
pub(crate) struct Args {
    /// What is compared.
    #[arg(value_enum)]
    what: What,
    /// Folder with models/, reference/ and compare_real.py.
    dir: PathBuf,
    /// Only references whose name fits; * stands for anything.
    #[arg(long, value_name = "GLOB")]
    only: Option<String>,
    /// Skin by this method alone: lambert, wrapped, pre-integrated, screen-space, screen-space-disc or
    /// texture-space.
    #[arg(long, value_name = "NAME", value_parser = word::<SkinDiffuse>)]
    method: Option<SkinDiffuse>,
    /// How light comes through skin: thin or thick [default: thick for ears and wedges].
    #[arg(long, value_name = "NAME", value_parser = word::<Transmission>)]
    transmission: Option<Transmission>,
    /// Where our pictures are written [default: a folder hikage-compare-real among temporary files].
    #[arg(long, value_name = "OUTDIR")]
    write: Option<PathBuf>,
    /// Adapter, by a part of its name.
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
    /// Print JSON: all figures of the scorer.
    #[arg(long)]
    json: bool,
}

/// What is compared.
#[derive(Clone, Copy, clap::ValueEnum)]
enum What {
    /// Scenes hair_arch, hair_sphere and those of hairstyles that have cards.
    Hair,
    /// Scenes skin_head, skin_close, skin_sphere, skin_ear and skin_wedge, by every method.
    Skin,
    /// Scenes eye_grid, eye_caustic and eye_lit.
    Eye,
}

/// What is drawn of a reference.
struct Shot {
    scenes: Vec<Scene>,
    /// How many times as large.
    scale: u32,
    window: Window,
    size: [u32; 2],
    camera: Camera,
    lights: Lights,
}

/// What texels of a larger picture count for in a pixel.
#[derive(Clone, Copy)]
enum Window {
    /// The same.
    Even,
    /// Most in the middle, as the path tracer of the references has it: the window of Blackman and Harris over a pixel.
    BlackmanHarris,
}

impl Window {
    /// Of so many texels along a pixel; their sum is 1.
    fn weights(self, count: u32) -> Vec<f64> {
        let of = |i: u32| {
            let turn = (f64::from(i) + 0.5) / f64::from(count) * std::f64::consts::TAU;
            match self {
                Self::Even => 1.0,
                // Harris 1978, four terms.
                Self::BlackmanHarris => {
                    0.35875 - 0.48829 * turn.cos() + 0.14128 * (2.0 * turn).cos() - 0.01168 * (3.0 * turn).cos()
                }
            }
        };
        let sum: f64 = (0..count).map(of).sum();
        (0..count).map(|i| of(i) / sum).collect()
    }
}

impl Shot {
    /// As a reference is seen, in its light and no other.
    fn of(of: &Reference, scenes: Vec<Scene>, scale: u32) -> Self {
        let none = DirectionalLight { intensity: 0.0, ..DirectionalLight::default() };
        let lights = Lights {
            directional: of.light.as_ref().map_or(none, DirectionalLight::from),
            ambient: Ambient::uniform(LinearRgb::BLACK),
            ..Lights::default()
        };
        Self { scenes, scale, window: Window::Even, size: [of.width, of.height], camera: (&of.camera).into(), lights }
    }
}

/// A picture of ours and the reference that it is compared with.
struct Pair {
    reference: String,
    /// Of skin.
    method: Option<SkinDiffuse>,
    /// Name of the picture, which other references may share.
    picture: String,
}

/// The part of a reference's description that all kinds have.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Reference {
    model: String,
    width: u32,
    height: u32,
    camera: ReferenceCamera,
    light: Option<ReferenceLight>,
    core: Option<String>,
    material: serde_json::Value,
    /// Of an eye.
    #[serde(default)]
    eye: serde_json::Value,
    #[serde(default)]
    bounces: Bounces,
}

#[derive(Default, Deserialize)]
struct Bounces {
    max: u32,
}

#[derive(Serialize)]
struct Row {
    name: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    method: Option<SkinDiffuse>,
    figures: serde_json::Value,
}

#[derive(Serialize)]
struct Outcome {
    adapter: String,
    rows: Vec<Row>,
    failed: Vec<(String, String)>,
}

pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let root = args.dir.join("reference");
    let pairs = pairs(&root, args)?;
    let out = args.write.clone().unwrap_or_else(|| std::env::temp_dir().join("hikage-compare-real"));
    make_folder(&out)?;
    let scorer = scorer::Scorer::find(&args.dir)?;
    let spinner = Spinner::new();
    let gpu = setup::gpu(args.adapter.as_deref())?;
    let mut outcome = Outcome { adapter: gpu.info().name.clone(), rows: Vec::new(), failed: Vec::new() };
    let mut made = HashSet::new();
    for (index, pair) in pairs.iter().enumerate() {
        let Pair { reference: name, method, .. } = pair;
        let title = title(name, *method);
        spinner.step(format!("{} of {}: {title}", index + 1, pairs.len()));
        let mut compared = || -> Result<serde_json::Value, Failure> {
            let picture = out.join(format!("{}.npy", pair.picture));
            if let Some(kind) = eye::Kind::of(name) {
                return eye::figures(&gpu, &scorer, &args.dir, kind, &root.join(name), &picture);
            }
            if !made.contains(&pair.picture) {
                let of: Reference = described(&root.join(name))?;
                let fail = |what: String| Failure::input(format!("{}: {what}", root.join(name).display()));
                let texels = drawn(&gpu, pair.shot(args, &of).map_err(fail)?)?;
                write_npy(&picture, [of.width, of.height], &texels)?;
                made.insert(&pair.picture);
            }
            match skin::Name::of(name) {
                Some(skin) => {
                    let lambert = root.join(skin.lambert());
                    let is_there = root.join(format!("{}.npz", skin.lambert())).is_file();
                    scorer.skin(&root.join(name), &picture, is_there.then_some(&lambert))
                }
                None => scorer.hair(&root.join(name), &picture),
            }
        };
        match compared() {
            Ok(figures) => outcome.rows.push(Row { name: name.clone(), method: *method, figures }),
            Err(failure) => outcome.failed.push((title, failure.to_string())),
        }
    }
    drop(spinner);
    if args.json {
        print_json(&outcome)?;
    } else {
        let lines = outcome.rows.iter().map(|row| match args.what {
            What::Hair => scorer::hair_line(&row.name, &row.figures),
            What::Skin => scorer::skin_line(&title(&row.name, row.method), &row.figures),
            What::Eye => scorer::eye_line(&row.name, &row.figures),
        });
        let failed = outcome.failed.iter().map(|(name, why)| format!("{name}: {why}\n"));
        print(&lines.chain(failed).collect::<String>())?;
    }
    match outcome.failed.len() {
        0 => Ok(()),
        n => Err(Failure::input(format!("{n} of {} pictures could not be compared", pairs.len()))),
    }
}

/// A reference and a method.
fn title(reference: &str, method: Option<SkinDiffuse>) -> String {
    reference.to_owned() + &method.map_or(String::new(), |m| format!(" {}", skin::word(m)))
}

impl Pair {
    fn shot(&self, args: &Args, of: &Reference) -> Result<Shot, String> {
        match (skin::Name::of(&self.reference), self.method) {
            (Some(name), Some(method)) => skin::shot(&args.dir, of, &name, method, args.transmission),
            _ => hair::shot(&args.dir, of),
        }
    }
}

/// What is asked for, sorted by reference.
fn pairs(root: &Path, args: &Args) -> Result<Vec<Pair>, Failure> {
    let glob = args.only.as_deref().unwrap_or("*");
    let listed = std::fs::read_dir(root).map_err(|e| Failure::input(format!("{}: {e}", root.display())))?;
    let mut names: Vec<String> = listed
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .filter_map(|file| Some(file.strip_suffix(".npz")?.to_owned()))
        .filter(|name| fits(glob, name))
        .collect();
    names.sort();
    let pair = |name: String| Pair { picture: name.clone(), reference: name, method: None };
    let (what, pairs): (&str, Vec<Pair>) = match args.what {
        What::Hair => ("hair", names.into_iter().filter(|name| hair::is_scene(name)).map(pair).collect()),
        What::Eye => ("eye", names.into_iter().filter(|name| eye::Kind::of(name).is_some()).map(pair).collect()),
        What::Skin => {
            let is_asked = |method: &SkinDiffuse| args.method.is_none_or(|asked| asked == *method);
            let of = |name: &String| {
                let skin = skin::Name::of(name)?;
                let methods = skin::METHODS.into_iter().filter(is_asked).filter(|method| skin.is_for(*method));
                let pair =
                    |method| Pair { picture: skin.picture(method), reference: name.clone(), method: Some(method) };
                Some(methods.map(pair).collect::<Vec<_>>())
            };
            ("skin", names.iter().filter_map(of).flatten().collect())
        }
    };
    if pairs.is_empty() {
        return Err(Failure::input(format!("{}: has no reference of {what} whose name fits {glob:?}", root.display())));
    }
    Ok(pairs)
}

/// A word as look files write it.
fn word<T: serde::de::DeserializeOwned>(text: &str) -> Result<T, String> {
    serde_json::from_value(text.into()).map_err(|e| e.to_string())
}

/// Whether a name fits a pattern in which `*` stands for anything.
fn fits(glob: &str, name: &str) -> bool {
    match glob.split_once('*') {
        None => glob == name,
        Some((before, rest)) => name.strip_prefix(before).is_some_and(|tail| {
            (0..=tail.len()).filter(|at| tail.is_char_boundary(*at)).any(|at| fits(rest, &tail[at..]))
        }),
    }
}

/// What a file beside a reference says of it.
fn described<T: serde::de::DeserializeOwned>(reference: &Path) -> Result<T, Failure> {
    let file = reference.with_extension("json");
    let fail = |e: serde_json::Error| Failure::input(format!("{}: {e}", file.display()));
    serde_json::from_slice(&setup::read_small(&file)?).map_err(fail)
}

/// Our picture of a reference: linear, premultiplied. It is drawn `scale` times as large.
fn drawn(gpu: &Gpu, shot: Shot) -> Result<Vec<[f32; 4]>, Failure> {
    let Shot { scenes, scale, window, size, camera, lights } = shot;
    let output = Output { format: wgpu::TextureFormat::Rgba16Float, ..Output::default() };
    let renderer = Renderer::with_output(gpu, output)?;
    let mut actors = Vec::new();
    for mut scene in scenes {
        scene.post = None;
        actors.push(Actor::new(&renderer.upload(&scene)?));
    }
    let mut stage = Stage::of(actors);
    stage.lights = lights;
    let size = size.map(|side| side * scale);
    let view = View { size, camera, background: Background::Transparent, ..View::default() };
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("picture"),
        size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: output.format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    renderer.prepare(&mut encoder, &mut stage)?;
    renderer.draw(&mut encoder, &stage, &view, &texture.create_view(&wgpu::TextureViewDescriptor::default()))?;
    gpu.queue.submit([encoder.finish()]);
    Ok(averaged(&read_linear(gpu, &texture)?, size, &window.weights(scale)))
}

/// Means of squares of texels, which count by the product of the weights of their row and column.
fn averaged(texels: &[[f32; 4]], size: [u32; 2], weights: &[f64]) -> Vec<[f32; 4]> {
    let scale = weights.len();
    let (width, height) = (size[0] as usize / scale, size[1] as usize / scale);
    let mean = |x: usize, y: usize| {
        let mut sum = [0f64; 4];
        for dy in 0..scale {
            let first = (y * scale + dy) * width * scale + x * scale;
            for (texel, weight) in texels[first..first + scale].iter().zip(weights) {
                sum.iter_mut().zip(texel).for_each(|(sum, x)| *sum += f64::from(*x) * weight * weights[dy]);
            }
        }
        sum.map(|s| s as f32)
    };
    (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| mean(x, y)).collect()
}

fn write_npy(path: &Path, [width, height]: [u32; 2], texels: &[[f32; 4]]) -> Result<(), Failure> {
    let fail = |e: std::io::Error| Failure::input(format!("{}: {e}", path.display()));
    let file = File::create(path).map_err(fail)?;
    let shape = [u64::from(height), u64::from(width), 4];
    let mut writer = npyz::WriteOptions::new()
        .default_dtype()
        .shape(&shape)
        .writer(BufWriter::new(file))
        .begin_nd()
        .map_err(fail)?;
    writer.extend(texels.iter().flatten().copied()).map_err(fail)?;
    writer.finish().map_err(fail)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stars_stand_for_anything() {
        assert!(fits("*", "hair_arch") && fits("hair_*_back", "hair_arch_brown_back") && fits("hair", "hair"));
        assert!(!fits("hair_*_back", "hair_arch_front") && !fits("hair", "hairs"));
    }

    #[test]
    fn pictures_are_averaged_by_squares() {
        let texels: Vec<[f32; 4]> = (0..8u8).map(|i| [f32::from(i); 4]).collect();
        assert_eq!(averaged(&texels, [4, 2], &Window::Even.weights(2)), [[2.5; 4], [4.5; 4]]);
        let weights = Window::BlackmanHarris.weights(8);
        assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        assert!(weights[3] > 30.0 * weights[0] && weights[3] == weights[4], "{weights:?}");
    }
}
