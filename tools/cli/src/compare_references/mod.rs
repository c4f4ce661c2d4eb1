//! `hikage compare-references`: our pictures beside those of another renderer, with the numbers that tell them apart.
//!
//! `DIR/reference/**/NAME.json` states model, camera, light and background of `NAME.png`; the model lies in `DIR` under
//! the same sub-folder. Silhouettes differ between renderers by how edges are covered, so a band along them is left
//! out of the counts of wrong pixels. Parts that come from a plain PBR material are shaded as toon on purpose; the
//! second set of numbers leaves them out. The third does so too and has the known faults of the other renderer
//! reproduced: what it does not explain is ours.

mod figures;
mod known;

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use hikage::color::{LinearRgb, Srgb};
use hikage::golden::{Tolerance, compare, sheet};
use hikage::material::{Material, Origin};
use hikage::picture::{read_png, write_png};
use hikage::scene::{Ambient, Image, Lights, Scene};
use hikage::{Actor, Background, Channel, Character, Gpu, Output, Renderer, Stage, View};
use serde::{Deserialize, Serialize};

use self::figures::{BAND, Figures, OFF, band, differences, figures, part_ids};
use self::known::Known;
use crate::failure::Failure;
use crate::output::{Table, make_folder, print, print_json};
use crate::reference::{ReferenceCamera, ReferenceLight};
use crate::spinner::Spinner;
use crate::{args, setup};

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
struct ReferenceAmbient {
    color_linear: [f32; 3],
    unit_intensity: f32,
}

#[derive(Serialize)]
struct Row {
    name: String,
    all: Figures,
    /// Without parts that come from a PBR material; `None` where no other part is seen.
    toon: Option<Figures>,
    /// The same with the known departures of the references' renderer.
    explained: Option<Explained>,
}

#[derive(Serialize)]
struct Explained {
    /// Departures that materials in view have.
    known: BTreeSet<Known>,
    figures: Figures,
    /// Share of the parts' pixels that is left out of the figures. Range 0..1.
    left_out: f64,
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
        make_folder(out)?;
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
    loaded: Option<(PathBuf, Scene, Character)>,
}

impl Studio {
    fn compare_one(&mut self, args: &Args, root: &Path, file: &Path, name: &str) -> Result<Row, Failure> {
        let fail = |what: &dyn std::fmt::Display| Failure::input(format!("{}: {what}", file.display()));
        let reference: Reference = serde_json::from_slice(&setup::read_small(file)?).map_err(|e| fail(&e))?;
        let folder = file.parent().and_then(|f| f.strip_prefix(root).ok()).unwrap_or(Path::new(""));
        let model = args.dir.join(folder).join(&reference.model);
        let theirs = read_png(file.with_extension("png"))?;
        let (view, lights) = seen(&reference).map_err(|e| fail(&e))?;

        if self.loaded.as_ref().is_none_or(|(path, ..)| *path != model) {
            self.loaded = None;
            let scene = hikage::import::load(&model)?;
            let character = self.renderer.upload(&scene)?;
            self.loaded = Some((model, scene, character));
        }
        let Some((_, scene, character)) = &self.loaded else { return Err(fail(&"no model")) };
        let expressions: Vec<_> = reference.expressions.into_iter().flatten().collect();
        let staged = |character: &Character| -> Result<Stage, Failure> {
            let pose = setup::pose(character.scene(), hikage::motion::Stance::Rest, &expressions)?;
            let mut stage = Stage::of([Actor::new(character).posed(pose)]);
            stage.lights.clone_from(&lights);
            Ok(stage)
        };
        let mut stage = staged(character)?;
        let ours = self.renderer.render(&mut stage, &view)?;
        let plain = |channel| View { channel, background: Background::Transparent, ..view.clone() };
        let ids = part_ids(&self.renderer.render(&mut stage, &plain(Channel::PartId))?);
        let depth = self.renderer.render(&mut stage, &plain(Channel::Depth))?;

        // Also refuses other sizes.
        let report = compare(&theirs, &ours, &Tolerance { channel: OFF, ..Tolerance::default() })?;
        let write = |ending: &str, ours: &Image, figures: &Figures| -> Result<(), Failure> {
            let Some(out) = &args.write else { return Ok(()) };
            let report = hikage::golden::Report { largest_blob: figures.largest_blob, ..report.clone() };
            let file_name = format!("{}{ending}.png", name.replace(['/', '\\'], "_"));
            Ok(write_png(out.join(file_name), &sheet(&theirs, ours, Some(&report))?)?)
        };
        let in_band = band(&ids, &depth);
        let compared = differences(&theirs, &ours);
        let all = figures(&compared, ours.width, &in_band, |_| true);
        write("", &ours, &all)?;

        let material = |id: u16| scene.materials.get(character.part_material(usize::from(id).checked_sub(1)?)?);
        let materials: Vec<Option<&Material>> = ids.iter().map(|id| material(*id)).collect();
        let toon_materials: Vec<&Material> =
            BTreeSet::from_iter(&ids).into_iter().filter_map(|id| material(*id)).filter(|m| !is_pbr(m)).collect();
        if toon_materials.is_empty() {
            return Ok(Row { name: name.to_owned(), all, toon: None, explained: None });
        }
        let in_toon = |i: usize| !materials[i].is_some_and(is_pbr);
        let toon = figures(&compared, ours.width, &in_band, in_toon);

        let known: BTreeSet<Known> = toon_materials.iter().flat_map(|m| Known::of(m)).collect();
        let has_normal_map = |m: &Option<&Material>| m.is_some_and(|m| m.normal_map.is_some() && !is_pbr(m));
        let left_out =
            known::with_outlines(&materials.iter().map(has_normal_map).collect::<Vec<_>>(), ours.width as usize);
        let parts = (0..ids.len()).filter(|i| materials[*i].is_some() && in_toon(*i));
        let (shown, hidden) = parts.fold((0u32, 0u32), |(all, out), i| (all + 1, out + u32::from(left_out[i])));
        let like_theirs = if known.iter().any(|k| *k != Known::Normal) {
            let scene = known::reproduce(scene, view.camera.eye.distance(view.camera.target));
            let character = self.renderer.upload(&scene)?;
            self.renderer.render(&mut staged(&character)?, &view)?
        } else {
            ours
        };
        let compared = differences(&theirs, &like_theirs);
        let explained = figures(&compared, like_theirs.width, &in_band, |i| in_toon(i) && !left_out[i]);
        if !known.is_empty() {
            write(".explained", &like_theirs, &explained)?;
        }
        let left_out = f64::from(hidden) / f64::from(shown.max(1));
        let explained = Some(Explained { known, figures: explained, left_out });
        Ok(Row { name: name.to_owned(), all, toon: Some(toon), explained })
    }
}

/// Whether the file has no toon description of it; we shade it as toon all the same.
fn is_pbr(material: &Material) -> bool {
    !matches!(material.origin, Origin::Mtoon0 | Origin::Mtoon1 | Origin::Unlit)
}

fn seen(reference: &Reference) -> Result<(View, Lights), String> {
    if !(1..=args::MAX_SIDE).contains(&reference.width) || !(1..=args::MAX_SIDE).contains(&reference.height) {
        return Err(format!("size {} x {}", reference.width, reference.height));
    }
    let background = match reference.background.as_str() {
        "transparent" => Background::Transparent,
        color => Background::Color(Srgb::from_hex(color).ok_or_else(|| format!("background {color:?}"))?),
    };
    let ambient = &reference.ambient;
    let lights = Lights {
        directional: (&reference.light).into(),
        ambient: Ambient::uniform(LinearRgb(ambient.color_linear).scaled(ambient.unit_intensity)),
        ..Lights::default()
    };
    let view = View {
        size: [reference.width, reference.height],
        camera: (&reference.camera).into(),
        background,
        ..View::default()
    };
    Ok((view, lights))
}

fn blob(figures: &Figures) -> String {
    figures.largest_blob.map_or(0, |b| b.pixels).to_string()
}

/// Upper left corner of the largest group.
fn at(figures: &Figures) -> String {
    figures.largest_blob.map_or(String::new(), |b| format!("{},{}", b.min[0], b.min[1]))
}

fn percent(share: f64) -> String {
    format!("{:.3}", share * 100.0)
}

fn text(outcome: &Outcome) -> String {
    let mut table = Table::new(&[
        "reference", "off %", "blob px", "at", "mean", "explained", "blob px", "left out %", "known", "all: off %",
        "blob px", "mean",
    ]);
    for row in &outcome.rows {
        let toon = |text: fn(&Figures) -> String| row.toon.as_ref().map_or("-".into(), text);
        let explained = |text: fn(&Explained) -> String| row.explained.as_ref().map_or("-".into(), text);
        table.row([
            row.name.clone(),
            toon(|f| percent(f.off_share)),
            toon(blob),
            toon(at),
            toon(|f| format!("{:.3}", f.mean_abs)),
            explained(|e| percent(e.figures.off_share)),
            explained(|e| blob(&e.figures)),
            explained(|e| format!("{:.1}", e.left_out * 100.0)),
            explained(|e| e.known.iter().map(|k| k.name()).collect::<Vec<_>>().join(" ")),
            percent(row.all.off_share),
            blob(&row.all),
            format!("{:.3}", row.all.mean_abs),
        ]);
    }
    let mut out = table.text();
    let toon: Vec<&Figures> = outcome.rows.iter().filter_map(|r| r.toon.as_ref()).collect();
    let explained: Vec<&Figures> = outcome.rows.iter().filter_map(|r| Some(&r.explained.as_ref()?.figures)).collect();
    let off = |of: &[&Figures]| {
        let mean = of.iter().map(|f| f.off_share).sum::<f64>() / of.len().max(1) as f64;
        let near = of.iter().filter(|f| f.off_share < 0.005).count();
        format!("mean off {} %, {near} under 0.5 %", percent(mean))
    };
    let _ = writeln!(out, "{} pictures on {}", outcome.rows.len(), outcome.adapter);
    let _ = writeln!(
        out,
        "{} with parts not from PBR: {}, mean difference {:.3}/255",
        toon.len(),
        off(&toon),
        toon.iter().map(|f| f.mean_abs).sum::<f64>() / toon.len().max(1) as f64,
    );
    let _ = writeln!(out, "explained: {}", off(&explained));
    let _ = writeln!(out, "all materials: {}", off(&outcome.rows.iter().map(|r| &r.all).collect::<Vec<_>>()));
    let _ = writeln!(
        out,
        "off: a channel over {OFF}/255, outside {BAND} px along silhouettes; left: without parts made from PBR materials"
    );
    out += known::LEGEND;
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
