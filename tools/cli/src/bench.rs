//! `hikage bench`.

use std::path::PathBuf;
use std::time::Instant;

use hikage::View;
use hikage::bench::{self, BenchOptions, run as measure};

use crate::args::{self, LookName, ViewName};
use crate::clips;
use crate::failure::Failure;
use crate::output::{Table, bytes, print, print_json};
use crate::setup;
use crate::spinner::Spinner;

/// Arguments of `hikage bench`.
#[derive(clap::Args)]
#[command(after_help = "\
The floor is the same meshes with the same samples, drawn unlit with one texture: what no shading can go below.
Examples:
  hikage bench
  hikage bench girl.vrm --size 512x512 --actors 20
  hikage bench --look anime --view full --each")]
pub(crate) struct Args {
    /// Model: .vrm, .glb or .gltf [default: the built-in character].
    model: Option<PathBuf>,
    /// Size of the picture, pixels.
    #[arg(long, value_name = "WxH", default_value = "1024x1024", value_parser = args::size)]
    size: [u32; 2],
    /// Actors of the character: they walk, each from a moment of its own, blink and swing.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=4096))]
    actors: u32,
    /// Measured frames.
    #[arg(long, value_name = "N", default_value_t = 30, value_parser = clap::value_parser!(u32).range(1..=10000))]
    frames: u32,
    /// Samples a pixel.
    #[arg(long, value_name = "1|4", default_value = "4", value_parser = args::samples)]
    samples: u32,
    /// What fills the picture.
    #[arg(
        long,
        value_enum,
        value_name = "portrait|bust|full|face",
        default_value_t = ViewName::Portrait,
        hide_possible_values = true
    )]
    view: ViewName,
    #[arg(long, value_name = "plain|anime|natural|FILE.look.toml", value_parser = args::look, help = args::LOOK_HELP)]
    look: Option<LookName>,
    /// Adapter, by a part of its name (`hikage adapters`).
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
    /// What each look costs: frames with everything against frames without that look; and all of them against none.
    #[arg(long)]
    each: bool,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// What is printed as JSON.
#[derive(serde::Serialize)]
struct Timed {
    /// Reading the model, and making its look, milliseconds.
    model_ms: f64,
    look_ms: f64,
    #[serde(flatten)]
    report: bench::BenchReport,
}

fn milliseconds(since: Instant) -> f64 {
    since.elapsed().as_secs_f64() * 1e3
}

pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let spinner = Spinner::new();
    spinner.step("loading the model");
    let start = Instant::now();
    let mut scene = setup::load(args.model.as_deref())?;
    let model_ms = milliseconds(start);
    let plain = args.each.then(|| scene.clone());
    let start = Instant::now();
    setup::apply_look(args.look.as_ref(), args.model.as_deref(), &mut scene)?;
    let look_ms = milliseconds(start);
    spinner.step("opening the adapter");
    let gpu = setup::gpu(args.adapter.as_deref())?;
    spinner.step(format!("measuring {} frames", args.frames));
    let options = BenchOptions {
        view: View::framed(&scene, args.view.into(), 0.0, args.size),
        actors: args.actors as usize,
        samples: args.samples,
        frames: args.frames as usize,
        clip: clips::built_in_for("walk", &scene)?,
    };
    if let Some(plain) = &plain {
        let costs = bench::costs(&gpu, &scene, plain, &options)?;
        drop(spinner);
        return print_costs(args, gpu.info().name.as_str(), &costs);
    }
    let report = measure(&gpu, &scene, &options)?;
    drop(spinner);
    if args.json {
        return print_json(&Timed { model_ms, look_ms, report });
    }

    let mut times = Table::new(&["ms a frame", "median", "min", "p95"]);
    let rows = [
        ("frame", &report.frame_ms),
        ("floor", &report.floor_ms),
        ("update", &report.update_ms),
        ("encode", &report.encode_ms),
    ];
    for (name, ms) in rows {
        times.row([name.into(), format!("{:.3}", ms.median), format!("{:.3}", ms.min), format!("{:.3}", ms.p95)]);
    }
    let mut passes = Table::new(&["pass", "ms"]);
    for pass in &report.passes {
        passes.row([pass.name.clone(), format!("{:.3}", pass.ms.median)]);
    }
    print(&format!(
        "{}: {} x {}, {} samples, {} actors, {} frames\n  load {:.0} ms: model {model_ms:.0}, look {look_ms:.0}, upload {:.0}; then the first frame {:.0}\n{}  frame / floor {:.2}, an actor {:.3} ms of the processor, {:.3} ms a frame\n{}  {} draws, {} triangles, {} on the GPU\n",
        report.adapter.name,
        args.size[0],
        args.size[1],
        args.samples,
        args.actors,
        args.frames,
        model_ms + look_ms + report.upload_ms,
        report.upload_ms,
        report.first_frame_ms,
        times.text(),
        report.floor_ratio,
        (report.update_ms.median + report.encode_ms.median) / f64::from(args.actors),
        report.frame_ms.median / f64::from(args.actors),
        passes.text(),
        report.draws,
        report.triangles,
        bytes(report.memory.textures + report.memory.geometry),
    ))
}

fn print_costs(args: &Args, adapter: &str, costs: &[bench::Cost]) -> Result<(), Failure> {
    if args.json {
        return print_json(&costs);
    }
    let mut table = Table::new(&["look", "materials", "with, ms", "without, ms", "with / without"]);
    for cost in costs {
        let materials = if cost.materials > 0 {
            cost.materials.to_string()
        } else {
            "scene".into()
        };
        let ms = |ms: f64| format!("{ms:.1}");
        table.row([cost.look.clone(), materials, ms(cost.with_ms), ms(cost.without_ms), format!("{:.3}", cost.ratio)]);
    }
    let [width, height] = args.size;
    print(&format!("{adapter}: {width} x {height}, {} frames of each\n{}", args.frames, table.text()))
}
