//! Times frames against a floor: the same triangles in the same targets, unlit with one texture.
//!
//! Frames and floor frames take turns, so that a machine that slows down slows both; the ratio of medians is what counts.

mod costs;

pub use costs::{Cost, costs};

use std::time::{Duration, Instant};

use serde::Serialize;

use crate::{
    AdapterInfo, Error, Gpu, GpuMemory, GpuScene, Output, Renderer, Result, View,
    motion::Pose,
    render::{Clock, Shown, Timed, color_target, pass::floor::FloorPass},
    scene::Scene,
};

/// What is timed.
#[derive(Clone, Debug)]
pub struct BenchOptions {
    /// The picture.
    pub view: View,
    /// Samples a pixel: 1 or 4. Default: 4.
    pub samples: u32,
    /// Frames that count; as many floor frames are timed between them. Range 1... Default: 20.
    pub frames: usize,
}

impl Default for BenchOptions {
    fn default() -> Self {
        Self { view: View::default(), samples: 4, frames: 20 }
    }
}

/// Spread of one figure over all frames, milliseconds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Spread {
    /// Shortest.
    pub min: f64,
    /// Middle.
    pub median: f64,
    /// Exceeded by one frame in twenty.
    pub p95: f64,
}

/// Time of one pass by the adapter's own clock.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PassTime {
    /// Pass.
    pub name: String,
    /// Time, milliseconds.
    pub ms: Spread,
}

/// What [`run`] found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BenchReport {
    /// Adapter.
    pub adapter: AdapterInfo,
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// Samples a pixel.
    pub samples: u32,
    /// Characters.
    pub instances: usize,
    /// Frames that count.
    pub frames: usize,
    /// A whole frame: pose, deform, passes, until the adapter is done.
    pub frame_ms: Spread,
    /// The same for the floor.
    pub floor_ms: Spread,
    /// Median frame over median floor.
    pub floor_ratio: f64,
    /// Time of each pass where the adapter has timestamps; empty elsewhere.
    pub passes: Vec<PassTime>,
    /// Draw calls a frame.
    pub draws: usize,
    /// Triangles a frame, outlines not counted.
    pub triangles: usize,
    /// Bytes on the adapter.
    pub memory: GpuMemory,
    /// Upload of the scene, pipelines included, milliseconds.
    pub upload_ms: f64,
    /// First frame, milliseconds; drivers compile late.
    pub first_frame_ms: f64,
}

const TIMEOUT: Duration = Duration::from_secs(120);
/// A scene that is ready to be timed: frames and floor frames with the same triangles, targets and pose.
pub struct Stage<'a> {
    gpu: Gpu,
    renderer: Renderer,
    uploaded: GpuScene,
    scene: &'a Scene,
    /// Two poses that take turns; nobody could tell them apart.
    poses: [Pose; 2],
    view: View,
    target: wgpu::TextureView,
    floor: FloorPass,
    clock: Clock,
}

impl<'a> Stage<'a> {
    /// Uploads a scene.
    ///
    /// # Errors
    /// [`Error::Argument`] for options out of their domain; [`Error::Gpu`] where the adapter fails.
    pub fn new(gpu: &Gpu, scene: &'a Scene, options: &BenchOptions) -> Result<Self> {
        options.view.check()?;
        if options.frames == 0 {
            return Err(Error::Argument { what: "frames".to_owned(), message: "is 0; expected at least 1".to_owned() });
        }
        let output = Output { samples: options.samples, ..Output::default() };
        let mut renderer = Renderer::with_output(gpu, output)?;
        let mut uploaded = renderer.upload(scene)?;
        gpu.wait(TIMEOUT)?;
        let rest = Pose::rest(scene);
        let mut other = rest.clone();
        for local in &mut other.locals {
            local.translation.x += 1e-6;
        }
        Ok(Self {
            gpu: gpu.clone(),
            floor: renderer.floor(&mut uploaded)?,
            target: color_target(gpu, options.view.size, output),
            clock: Clock::new(gpu),
            poses: [rest, other],
            view: options.view.clone(),
            renderer,
            uploaded,
            scene,
        })
    }

    /// Poses, deforms and draws a frame, and waits until the adapter is done.
    ///
    /// # Errors
    /// [`Error::Gpu`] where the adapter fails.
    pub fn frame(&mut self) -> Result<()> {
        self.draw(true)
    }

    /// The same with every triangle drawn once, unlit, with one texture.
    ///
    /// # Errors
    /// [`Error::Gpu`] where the adapter fails.
    pub fn floor(&mut self) -> Result<()> {
        self.draw(false)
    }

    fn draw(&mut self, is_frame: bool) -> Result<()> {
        let Self { gpu, renderer, uploaded, scene, poses, view, target, floor, clock } = self;
        poses.swap(0, 1);
        uploaded.set_pose(scene, &poses[0])?;
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("bench") });
        let shown = if is_frame { Shown::Picture } else { Shown::Floor(floor) };
        renderer.encode(&mut encoder, uploaded, view, target, shown, clock)?;
        clock.resolve(&mut encoder);
        gpu.queue.submit([encoder.finish()]);
        gpu.wait(TIMEOUT)
    }
}

/// Times a scene. Every frame sets the pose anew, as an animated character would.
///
/// # Errors
/// [`Error::Argument`] for options out of their domain; [`Error::Gpu`] where the adapter fails.
pub fn run(gpu: &Gpu, scene: &Scene, options: &BenchOptions) -> Result<BenchReport> {
    let start = Instant::now();
    let mut stage = Stage::new(gpu, scene, options)?;
    let upload_ms = milliseconds(start);
    let start = Instant::now();
    stage.frame()?;
    let first_frame_ms = milliseconds(start);
    // Warms the floor up as the frame was.
    stage.floor()?;

    let (mut frames, mut floors) = (Vec::new(), Vec::new());
    let mut passes = vec![Vec::new(); Timed::ALL.len()];
    for _ in 0..options.frames {
        let start = Instant::now();
        stage.frame()?;
        frames.push(milliseconds(start));
        for (list, ms) in passes.iter_mut().zip(stage.clock.read(gpu)?) {
            list.extend(ms);
        }
        let start = Instant::now();
        stage.floor()?;
        floors.push(milliseconds(start));
        stage.clock.read(gpu)?;
    }
    let (frame_ms, floor_ms) = (spread(frames), spread(floors));
    Ok(BenchReport {
        adapter: gpu.info().clone(),
        size: options.view.size,
        samples: options.samples,
        instances: options.view.instances.len(),
        frames: options.frames,
        frame_ms,
        floor_ms,
        floor_ratio: frame_ms.median / floor_ms.median.max(1e-9),
        passes: Timed::ALL
            .iter()
            .zip(passes)
            .filter(|(_, list)| !list.is_empty())
            .map(|(pass, list)| PassTime { name: pass.name().to_owned(), ms: spread(list) })
            .collect(),
        draws: stage.uploaded.draw_count(),
        triangles: stage.uploaded.triangle_count() * options.view.instances.len(),
        memory: stage.uploaded.memory(),
        upload_ms,
        first_frame_ms,
    })
}

fn milliseconds(start: Instant) -> f64 {
    start.elapsed().as_secs_f64() * 1e3
}

fn spread(mut values: Vec<f64>) -> Spread {
    values.sort_by(f64::total_cmp);
    let at = |share: f64| values.get(((values.len() - 1) as f64 * share).round() as usize).copied().unwrap_or(0.0);
    Spread { min: at(0.0), median: at(0.5), p95: at(0.95) }
}
