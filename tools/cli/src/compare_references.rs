//! `hikage compare-references`: our pictures beside those of another renderer, with the numbers that tell them apart.
//!
//! `DIR/reference/**/NAME.json` states model, camera, light and background of `NAME.png`; the model lies in `DIR` under
//! the same sub-folder. Silhouettes differ between renderers by how edges are covered, so a band along them is left
//! out of the counts of wrong pixels. Parts that come from a plain PBR material are shaded as toon on purpose; the
//! second set of numbers leaves them out.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use glam::Vec3;
use hikage::color::{LinearRgb, Srgb};
use hikage::golden::{Blob, Tolerance, compare, largest_blob, sheet};
use hikage::material::Origin;
use hikage::picture::{read_png, write_png};
use hikage::scene::{Ambient, Camera, DirectionalLight, Image, Lights, Scene};
use hikage::{Background, Channel, Gpu, GpuScene, Output, Renderer, View};
use serde::{Deserialize, Serialize};

use crate::failure::Failure;
use crate::output::{Table, print, print_json};
use crate::spinner::Spinner;
use crate::{args, setup};

/// A pixel is off where a channel differs by more than this.
const OFF: u8 = 8;
/// Half the width of the band along silhouettes, pixels.
const BAND: usize = 2;

/// Arguments of `hikage compare-references`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Folder of models with a folder `reference` in it.
    dir: PathBuf,
    /// Write `reference | ours | difference` of every picture into this folder.
    #[arg(long, value_name = "OUTDIR")]
    write: Option<PathBuf>,
    /// Only references whose path contains this.
    #[arg(long, value_name = "TEXT")]
    only: Option<String>,
    /// Blend and resolve samples in linear light, as `hikage render` does, not in encoded values as the references.
    #[arg(long)]
    linear: bool,
    /// Adapter, by a part of its name.
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// The part of a reference's description that we need.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Reference {
    model: String,
    width: u32,
    height: u32,
    camera: ReferenceCamera,
    light: ReferenceLight,
    ambient: ReferenceAmbient,
    background: String,
    expressions: Option<std::collections::BTreeMap<String, f32>>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct ReferenceCamera {
    eye: [f32; 3],
    target: [f32; 3],
    up: [f32; 3],
    fov_y_deg: f32,
    near: f32,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct ReferenceLight {
    dir_to_light: [f32; 3],
    color_linear: [f32; 3],
    unit_intensity: f32,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct ReferenceAmbient {
    color_linear: [f32; 3],
    unit_intensity: f32,
}

/// Numbers over a set of pixels.
#[derive(Clone, Copy, Default, Serialize)]
struct Figures {
    /// Pixels in the set, without the band.
    pixels: u32,
    /// Mean absolute difference over RGB of all pixels of the set, band included. Range 0..255.
    mean_abs: f64,
    /// Share of the pixels outside the band that are off. Range 0..1.
    off_share: f64,
    /// Largest group of them.
    largest_blob: Option<Blob>,
}

#[derive(Serialize)]
struct Row {
    name: String,
    all: Figures,
    /// Without parts that come from a PBR material; `None` where no other part is seen.
    toon: Option<Figures>,
}

#[derive(Serialize)]
struct Outcome {
    adapter: String,
    rows: Vec<Row>,
    failed: Vec<(String, String)>,
}

pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let root = args.dir.join("reference");
    let mut files = json_files(&root)?;
    files.retain(|f| args.only.as_ref().is_none_or(|text| f.to_string_lossy().contains(text.as_str())));
    if files.is_empty() {
        return Err(Failure::input(format!("{}: has no reference pictures", root.display())));
    }
    if let Some(out) = &args.write {
        std::fs::create_dir_all(out).map_err(|e| Failure::input(format!("{}: {e}", out.display())))?;
    }

    let spinner = Spinner::new();
    let gpu = setup::gpu(args.adapter.as_deref())?;
    // The references blend and resolve encoded values.
    let encoded = Output { format: Output::default().format.remove_srgb_suffix(), ..Output::default() };
    let output = if args.linear { Output::default() } else { encoded };
    let mut studio = Studio { renderer: Renderer::with_output(&gpu, output)?, gpu, loaded: None };
    let mut outcome = Outcome { adapter: studio.gpu.info().name.clone(), rows: Vec::new(), failed: Vec::new() };
    for (index, file) in files.iter().enumerate() {
        let name = file.strip_prefix(&root).unwrap_or(file).with_extension("").display().to_string();
        spinner.step(format!("{} of {}: {name}", index + 1, files.len()));
        match studio.compare_one(args, &root, file, &name) {
            Ok(row) => outcome.rows.push(row),
            Err(failure) => outcome.failed.push((name, failure.to_string())),
        }
    }
    drop(spinner);
    let off = |row: &Row| row.toon.map_or(-1.0, |t| t.off_share);
    outcome.rows.sort_by(|a, b| off(b).total_cmp(&off(a)).then(a.name.cmp(&b.name)));

    if args.json {
        print_json(&outcome)?
    } else {
        print(&text(&outcome))?
    }
    match outcome.failed.len() {
        0 => Ok(()),
        n => Err(Failure::input(format!("{n} of {} references could not be compared", files.len()))),
    }
}

/// The renderer with the model that was used last: references of one model follow each other.
struct Studio {
    gpu: Gpu,
    renderer: Renderer,
    loaded: Option<(PathBuf, Scene, GpuScene)>,
}

impl Studio {
    fn compare_one(&mut self, args: &Args, root: &Path, file: &Path, name: &str) -> Result<Row, Failure> {
        let fail = |what: &dyn std::fmt::Display| Failure::input(format!("{}: {what}", file.display()));
        let reference: Reference = serde_json::from_slice(&setup::read_small(file)?).map_err(|e| fail(&e))?;
        let folder = file.parent().and_then(|f| f.strip_prefix(root).ok()).unwrap_or(Path::new(""));
        let model = args.dir.join(folder).join(&reference.model);
        let theirs = read_png(file.with_extension("png"))?;
        let view = view(&reference).map_err(|e| fail(&e))?;

        if self.loaded.as_ref().is_none_or(|(path, ..)| *path != model) {
            self.loaded = None;
            let scene = hikage::import::load(&model)?;
            let gpu_scene = self.renderer.upload(&scene)?;
            self.loaded = Some((model, scene, gpu_scene));
        }
        let Some((_, scene, gpu_scene)) = &mut self.loaded else { return Err(fail(&"no model")) };
        let expressions: Vec<_> = reference.expressions.into_iter().flatten().collect();
        setup::pose(&self.gpu, gpu_scene, scene, &expressions)?;
        let ours = self.renderer.render(gpu_scene, &view)?;
        let id_view = View { channel: Channel::PartId, background: Background::Transparent, ..view.clone() };
        let ids = part_ids(&self.renderer.render(gpu_scene, &id_view)?);

        // Also refuses other sizes.
        let report = compare(&theirs, &ours, &Tolerance { channel: OFF, ..Tolerance::default() })?;
        let in_band = band(&ids, ours.width as usize);
        let is_toon = |id: u16| {
            id == 0
                || gpu_scene
                    .part_material(usize::from(id) - 1)
                    .and_then(|m| scene.materials.get(m))
                    .is_some_and(|m| matches!(m.origin, Origin::Mtoon0 | Origin::Mtoon1 | Origin::Unlit))
        };
        let mut toon_ids = vec![None; usize::from(u16::MAX) + 1];
        let toon: Vec<bool> =
            ids.iter().map(|id| *toon_ids[usize::from(*id)].get_or_insert_with(|| is_toon(*id))).collect();

        let differences = differences(&theirs, &ours);
        let all = figures(&differences, ours.width, &in_band, |_| true);
        if let Some(out) = &args.write {
            let report = hikage::golden::Report { largest_blob: all.largest_blob, ..report };
            let file_name = format!("{}.png", name.replace(['/', '\\'], "_"));
            write_png(out.join(file_name), &sheet(&theirs, &ours, Some(&report))?)?;
        }
        let shows_toon = ids.iter().zip(&toon).any(|(id, toon)| *id != 0 && *toon);
        let toon = shows_toon.then(|| figures(&differences, ours.width, &in_band, |i| toon[i]));
        Ok(Row { name: name.to_owned(), all, toon })
    }
}

fn view(reference: &Reference) -> Result<View, String> {
    if !(1..=args::MAX_SIDE).contains(&reference.width) || !(1..=args::MAX_SIDE).contains(&reference.height) {
        return Err(format!("size {} x {}", reference.width, reference.height));
    }
    let background = match reference.background.as_str() {
        "transparent" => Background::Transparent,
        color => Background::Color(Srgb::from_hex(color).ok_or_else(|| format!("background {color:?}"))?),
    };
    let scaled = |color: [f32; 3], factor: f32| LinearRgb(color).scaled(factor);
    Ok(View {
        size: [reference.width, reference.height],
        camera: Camera {
            eye: reference.camera.eye.into(),
            target: reference.camera.target.into(),
            up: reference.camera.up.into(),
            fov_y_rad: reference.camera.fov_y_deg.to_radians(),
            near: reference.camera.near,
        },
        lights: Lights {
            directional: DirectionalLight {
                to_light: Vec3::from(reference.light.dir_to_light).normalize_or(Vec3::Z),
                color: LinearRgb(reference.light.color_linear),
                intensity: reference.light.unit_intensity,
            },
            ambient: Ambient::uniform(scaled(reference.ambient.color_linear, reference.ambient.unit_intensity)),
            ..Lights::default()
        },
        background,
        ..View::default()
    })
}

/// Part number + 1 of every pixel, 0 for background.
fn part_ids(picture: &Image) -> Vec<u16> {
    picture.pixels.chunks_exact(4).map(|p| u16::from_le_bytes([p[0], p[1]])).collect()
}

/// Which pixels have another part within [`BAND`] pixels, diagonals included.
fn band(ids: &[u16], width: usize) -> Vec<bool> {
    // The square window is taken as a row, then a column of the row's extremes.
    let height = ids.len() / width.max(1);
    let span = |at: usize, end: usize| at.saturating_sub(BAND)..(at + BAND + 1).min(end);
    let mut rows = Vec::with_capacity(ids.len());
    for row in ids.chunks_exact(width.max(1)) {
        for x in 0..width {
            let near = &row[span(x, width)];
            rows.push(near.iter().fold((u16::MAX, 0), |(low, high), id| (low.min(*id), high.max(*id))));
        }
    }
    (0..ids.len())
        .map(|i| {
            let (x, y) = (i % width, i / width);
            let near = span(y, height).map(|y| rows[y * width + x]);
            let (low, high) = near.fold((u16::MAX, 0), |a: (u16, u16), b| (a.0.min(b.0), a.1.max(b.1)));
            low != high
        })
        .collect()
}

/// Sum over RGB, and largest over RGBA, of the absolute differences of every pixel, both laid on mid grey.
fn differences(theirs: &Image, ours: &Image) -> Vec<(u16, u8)> {
    let on_grey = |p: &[u8], i: usize| {
        let alpha = u32::from(p[3]);
        ((u32::from(p[i]) * alpha + 128 * (255 - alpha) + 127) / 255) as u8
    };
    let pairs = theirs.pixels.chunks_exact(4).zip(ours.pixels.chunks_exact(4));
    pairs
        .map(|(a, b)| {
            let rgb = [0, 1, 2].map(|i| on_grey(a, i).abs_diff(on_grey(b, i)));
            let largest = rgb.iter().fold(a[3].abs_diff(b[3]), |m, d| m.max(*d));
            (rgb.iter().map(|d| u16::from(*d)).sum(), largest)
        })
        .collect()
}

fn figures(differences: &[(u16, u8)], width: u32, in_band: &[bool], counts: impl Fn(usize) -> bool) -> Figures {
    let (mut sum, mut members, mut pixels, mut off_pixels) = (0u64, 0u64, 0u32, 0u32);
    let mut off = vec![false; differences.len()];
    for (i, (rgb, largest)) in differences.iter().enumerate().filter(|(i, _)| counts(*i)) {
        sum += u64::from(*rgb);
        members += 1;
        if !in_band[i] {
            pixels += 1;
            off[i] = *largest > OFF;
            off_pixels += u32::from(off[i]);
        }
    }
    Figures {
        pixels,
        mean_abs: sum as f64 / (members.max(1) * 3) as f64,
        off_share: f64::from(off_pixels) / f64::from(pixels.max(1)),
        largest_blob: largest_blob(&off, width),
    }
}

fn blob(figures: &Figures) -> String {
    figures.largest_blob.map_or(0, |b| b.pixels).to_string()
}

/// Upper left corner of the largest group.
fn at(figures: &Figures) -> String {
    figures.largest_blob.map_or(String::new(), |b| format!("{},{}", b.min[0], b.min[1]))
}

fn text(outcome: &Outcome) -> String {
    let mut table = Table::new(&["reference", "off %", "blob px", "at", "mean", "all: off %", "blob px", "mean"]);
    for row in &outcome.rows {
        let toon = |text: fn(&Figures) -> String| row.toon.as_ref().map_or("-".into(), text);
        table.row([
            row.name.clone(),
            toon(|f| format!("{:.3}", f.off_share * 100.0)),
            toon(blob),
            toon(at),
            toon(|f| format!("{:.3}", f.mean_abs)),
            format!("{:.3}", row.all.off_share * 100.0),
            blob(&row.all),
            format!("{:.3}", row.all.mean_abs),
        ]);
    }
    let mut out = table.text();
    let toon: Vec<&Figures> = outcome.rows.iter().filter_map(|r| r.toon.as_ref()).collect();
    let mean = |sum: f64, count: usize| sum / count.max(1) as f64;
    let _ = writeln!(
        out,
        "{} pictures on {}, {} with parts not from PBR: mean off {:.3} %, mean difference {:.3}/255, {} under 0.5 %; all materials: mean off {:.3} %",
        outcome.rows.len(),
        outcome.adapter,
        toon.len(),
        mean(toon.iter().map(|f| f.off_share * 100.0).sum(), toon.len()),
        mean(toon.iter().map(|f| f.mean_abs).sum(), toon.len()),
        toon.iter().filter(|f| f.off_share < 0.005).count(),
        mean(outcome.rows.iter().map(|r| r.all.off_share * 100.0).sum(), outcome.rows.len()),
    );
    let _ = writeln!(
        out,
        "off: a channel over {OFF}/255, outside {BAND} px along silhouettes; left: without parts made from PBR materials"
    );
    for (name, why) in &outcome.failed {
        let _ = writeln!(out, "failed: {name}: {}", crate::failure::printable(why));
    }
    out
}

/// All `.json` files below a folder, sorted.
fn json_files(root: &Path) -> Result<Vec<PathBuf>, Failure> {
    let mut found = Vec::new();
    let mut open = vec![root.to_path_buf()];
    while let Some(folder) = open.pop() {
        let entries = std::fs::read_dir(&folder).map_err(|e| Failure::input(format!("{}: {e}", folder.display())))?;
        for entry in entries.flatten() {
            let path = entry.path();
            // Links to folders are not followed: they may lead round in circles.
            match entry.file_type() {
                Ok(kind) if kind.is_dir() => open.push(path),
                _ if path.extension().is_some_and(|e| e == "json") => found.push(path),
                _ => {}
            }
        }
    }
    found.sort();
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_band_reaches_two_pixels_to_each_side_and_over_corners() {
        let mut ids = vec![1u16; 81];
        ids[4 * 9 + 4] = 2;
        let band = band(&ids, 9);
        let inside = |x: usize, y: usize| x.abs_diff(4) <= 2 && y.abs_diff(4) <= 2;
        for (i, found) in band.iter().enumerate() {
            assert_eq!(*found, inside(i % 9, i / 9), "{i}");
        }
    }

    #[test]
    fn colour_under_alpha_0_does_not_count_and_alpha_does() {
        let one = |pixel: [u8; 4]| Image { width: 1, height: 1, pixels: pixel.to_vec(), ..Image::default() };
        assert_eq!(differences(&one([9, 9, 9, 0]), &one([200, 0, 0, 0])), [(0, 0)]);
        assert_eq!(differences(&one([128, 128, 128, 0]), &one([128, 128, 128, 20])), [(0, 20)]);
    }
}
