//! `hikage sdf bake`.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use cpu_time::ProcessTime;
use hikage::picture::write_atomic;

use super::input::Input;
use crate::failure::{Failure, warn};
use crate::output::print;
use crate::render::png_path;
use crate::spinner::Spinner;

/// Arguments of `hikage sdf bake`.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    input: Input,
    /// Map to write; its folder must exist.
    #[arg(short, long, value_name = "MAP.png", value_parser = png_path)]
    output: PathBuf,
    /// Where keys contradict each other, take what the fewest of them gainsay. The drawings stay as they are.
    #[arg(long)]
    repair: bool,
    /// Threads [default: as many as the machine has].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
    /// Print the time of each step, the time of the processor and the memory.
    #[arg(long)]
    time: bool,
}

pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    if let Some(jobs) = args.jobs {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(jobs.into()).build_global();
        pool.map_err(|e| Failure::input(format!("--jobs: {e}")))?;
    }
    let project = args.input.project()?;
    let spinner = Spinner::new();
    spinner.step("reading keys and measuring distances");
    let start = Instant::now();
    let baked = project.bake(args.repair)?;
    let measured = start.elapsed();
    let repaired = baked.repaired();
    if repaired > 0 {
        warn(&format!("{repaired} texels of contradicting keys repaired (`hikage sdf check` names them)"));
    }
    spinner.step("encoding");
    let sides = baked.into_sides();
    let (width, height) = (sides.left.width, sides.left.height);
    let png = project.encode(&sides)?;
    let encoded = start.elapsed();
    write_atomic(&args.output, &png)?;
    drop(spinner);
    if args.time {
        let ms = |d: Duration| d.as_secs_f64() * 1e3;
        let peak = peak_bytes().map_or_else(String::new, |bytes| {
            let texels = f64::from(width) * f64::from(height);
            format!(
                "  peak memory          {:8.1} MiB, {:.1} B/texel\n",
                bytes as f64 / 1048576.0,
                bytes as f64 / texels
            )
        });
        print(&format!(
            "{width} x {height}, {} keys\n  keys to thresholds   {:8.1} ms\n  encoding             {:8.1} ms\n  \
             processor, all cores {:8.1} ms, whole process\n{peak}",
            project.keys.len(),
            ms(measured),
            ms(encoded - measured),
            ms(ProcessTime::now().as_duration()),
        ))?;
    }
    Ok(())
}

/// Most memory that this process has held, where the system tells.
fn peak_bytes() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|l| l.strip_prefix("VmHWM:"))?;
    Some(line.trim().trim_end_matches("kB").trim().parse::<u64>().ok()? * 1024)
}
