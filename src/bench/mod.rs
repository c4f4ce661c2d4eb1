//! Times frames against a floor: the same triangles in the same targets, unlit with one texture.
//!
//! Frames and floor frames take turns, so that a machine that slows down slows both; the ratio of medians is what counts.

mod costs;

pub use costs::{Cost, costs};

use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::Vec3;
use serde::Serialize;

use crate::{
    Actor, AdapterInfo, Character, Error, Gpu, GpuMemory, Output, Renderer, Result, Stage, View,
    motion::{Blink, Clip, Play, RootMotion},
    render::{Clock, Shown, Target, Timed, color_target, pass::floor::FloorPass},
    scene::Scene,
};

/// What is timed.
#[derive(Clone, Debug)]
pub struct BenchOptions {
    /// The picture.
    pub view: View,
    /// Characters, side by side, each in a pose of its own. Range 1... Default: 1.
    pub actors: usize,
    /// Samples a pixel: 1 or 4. Default: 4.
    pub samples: u32,
    /// Frames that count; as many floor frames are timed between them. Range 1... Default: 20.
    pub frames: usize,
    /// What they play, each from a moment of its own. Default: nothing but springs and blinking.
    pub clip: Option<Arc<Clip>>,
}

impl Default for BenchOptions {
    fn default() -> Self {
        Self { view: View::default(), actors: 1, samples: 4, frames: 20, clip: None }
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
    pub actors: usize,
    /// Frames that count.
    pub frames: usize,
    /// A whole frame: move, pose, deform, passes, until the adapter is done.
    pub frame_ms: Spread,
    /// The same for the floor.
    pub floor_ms: Spread,
    /// Median frame over median floor.
    pub floor_ratio: f64,
    /// What moves them: clips, springs ([`Stage::update`]), milliseconds.
    pub update_ms: Spread,
    /// The rest of the processor's share: poses to matrices, lists and commands until they are submitted, milliseconds.
    pub encode_ms: Spread,
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
/// Time that goes by in a frame, seconds.
const FRAME_S: f32 = 1.0 / 60.0;

/// A scene that is ready to be timed: frames and floor frames with the same triangles, targets and poses.
pub struct Bench {
    gpu: Gpu,
    renderer: Renderer,
    character: Character,
    stage: Stage,
    view: View,
    target: wgpu::TextureView,
    floor: FloorPass,
    clock: Clock,
    /// Of the last frame.
    update_ms: f64,
    encode_ms: f64,
}

impl Bench {
    /// Uploads a scene.
    ///
    /// # Errors
    /// [`Error::Argument`] for options out of their domain; [`Error::Gpu`] where the adapter fails.
    pub fn new(gpu: &Gpu, scene: &Scene, options: &BenchOptions) -> Result<Self> {
        options.view.check()?;
        for (what, count) in [("frames", options.frames), ("actors", options.actors)] {
            if count == 0 {
                return Err(Error::Argument { what: what.to_owned(), message: "is 0; expected at least 1".to_owned() });
            }
        }
        let output = Output { samples: options.samples, ..Output::default() };
        let renderer = Renderer::with_output(gpu, output)?;
        let character = renderer.upload(scene)?;
        gpu.wait(TIMEOUT)?;
        // In rows behind each other, a metre apart.
        let columns = (options.actors as f64).sqrt().ceil() as usize;
        let place = |i: usize| {
            let (column, row) = (i % columns, i / columns);
            Vec3::new(column as f32 - ((columns - 1) / 2) as f32, 0.0, -(row as f32))
        };
        let actor = |i: usize| {
            let mut actor = Actor::new(&character).at(place(i), 0.0);
            actor.animator.blink = Some(Blink { seed: i as u64, ..Blink::default() });
            if let Some(clip) = &options.clip {
                let time_s = i as f64 * 0.37;
                let play = Play { time_s, root_motion: RootMotion::InPlace, ..Play::new(clip) };
                actor.animator.player.base().plays.push(play);
            }
            actor
        };
        let stage = Stage::of((0..options.actors).map(actor));
        Ok(Self {
            gpu: gpu.clone(),
            floor: renderer.floor(&character)?,
            target: color_target(gpu, options.view.size, output),
            clock: Clock::new(gpu),
            view: options.view.clone(),
            update_ms: 0.0,
            encode_ms: 0.0,
            renderer,
            character,
            stage,
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
        let Self { gpu, renderer, stage, view, target, floor, clock, update_ms, encode_ms, .. } = self;
        let start = Instant::now();
        stage.update(FRAME_S);
        *update_ms = milliseconds(start);
        let start = Instant::now();
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("bench") });
        let shown = if is_frame { Shown::Picture } else { Shown::Floor(floor) };
        renderer.encode_shared(&mut encoder, stage, is_frame, clock)?;
        renderer.encode(&mut encoder, stage, view, Target::from(&*target), shown, clock)?;
        clock.resolve(&mut encoder);
        let commands = encoder.finish();
        *encode_ms = milliseconds(start);
        gpu.queue.submit([commands]);
        gpu.wait(TIMEOUT)
    }
}

/// Times a scene. Every frame sets the pose anew, as an animated character would.
///
/// # Errors
/// [`Error::Argument`] for options out of their domain; [`Error::Gpu`] where the adapter fails.
pub fn run(gpu: &Gpu, scene: &Scene, options: &BenchOptions) -> Result<BenchReport> {
    let start = Instant::now();
    let mut bench = Bench::new(gpu, scene, options)?;
    let upload_ms = milliseconds(start);
    let start = Instant::now();
    bench.frame()?;
    let first_frame_ms = milliseconds(start);
    // Warms the floor up as the frame was.
    bench.floor()?;

    let [mut frames, mut floors, mut updates, mut encodes] = [const { Vec::new() }; 4];
    let mut passes = vec![Vec::new(); Timed::ALL.len()];
    for _ in 0..options.frames {
        let start = Instant::now();
        bench.frame()?;
        frames.push(milliseconds(start));
        updates.push(bench.update_ms);
        encodes.push(bench.encode_ms);
        for (list, ms) in passes.iter_mut().zip(bench.clock.read(gpu)?) {
            list.extend(ms);
        }
        let start = Instant::now();
        bench.floor()?;
        floors.push(milliseconds(start));
        bench.clock.read(gpu)?;
    }
    let (frame_ms, floor_ms) = (spread(frames), spread(floors));
    Ok(BenchReport {
        adapter: gpu.info().clone(),
        size: options.view.size,
        samples: options.samples,
        actors: options.actors,
        frames: options.frames,
        frame_ms,
        floor_ms,
        update_ms: spread(updates),
        encode_ms: spread(encodes),
        floor_ratio: frame_ms.median / floor_ms.median.max(1e-9),
        passes: Timed::ALL
            .iter()
            .zip(passes)
            .filter(|(_, list)| !list.is_empty())
            .map(|(pass, list)| PassTime { name: pass.name().to_owned(), ms: spread(list) })
            .collect(),
        draws: bench.stage.draw_count(),
        triangles: bench.character.triangle_count() * options.actors,
        memory: bench.character.memory(),
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
