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
    render::{
        color_target, draw_list,
        pass::floor::{FloorInputs, FloorPass},
    },
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
const TIMED_PASSES: [&str; 7] = ["deform", "bangs shadow", "shadow", "depth", "glow", "colour", "post"];

/// A scene that is ready to be timed: frames and floor frames with the same triangles, targets and pose.
pub struct Stage<'a> {
    gpu: Gpu,
    renderer: Renderer,
    uploaded: GpuScene,
    scene: &'a Scene,
    pose: Pose,
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
        let uploaded = renderer.upload(scene)?;
        gpu.wait(TIMEOUT)?;
        Ok(Self {
            gpu: gpu.clone(),
            floor: FloorPass::new(gpu, &renderer.layouts, output),
            target: color_target(gpu, options.view.size, output),
            clock: Clock::new(gpu),
            pose: Pose::rest(scene),
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
        self.draw(true, |pass, stage| stage.renderer.record_surfaces(pass, &stage.uploaded, &stage.view))
    }

    /// The same with every triangle drawn once, unlit, with one texture.
    ///
    /// # Errors
    /// [`Error::Gpu`] where the adapter fails.
    pub fn floor(&mut self) -> Result<()> {
        self.draw(false, |pass, stage| stage.floor.encode(pass, &FloorInputs { scene: &stage.uploaded }))
    }

    /// `prepare` says whether the passes before the colour pass are drawn and timed.
    fn draw(&mut self, prepare: bool, record: impl FnOnce(&mut wgpu::RenderPass<'_>, &Self)) -> Result<()> {
        self.uploaded.set_pose(&self.gpu, self.scene, &self.pose);
        self.renderer.begin_frame(&mut self.uploaded, &self.view);
        let mut encoder =
            self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("bench") });
        let of_frame = |is_there: bool| prepare && is_there;
        let timed = [
            true,
            of_frame(self.uploaded.bangs.is_some()),
            of_frame(self.uploaded.shadow.is_some()),
            of_frame(!self.uploaded.prepass.is_empty()),
            of_frame(self.uploaded.post.is_some_and(|p| p.bloom.is_some())),
            true,
            of_frame(self.uploaded.post.is_some()),
        ];
        self.renderer.encode_deform(&mut encoder, &mut self.uploaded, self.clock.compute_writes());
        if prepare {
            self.renderer.encode_bangs_shadow(&mut encoder, &self.uploaded, self.clock.render_writes(1));
            self.renderer.encode_shadow(&mut encoder, &self.uploaded, self.clock.render_writes(2));
            self.renderer.encode_prepass(&mut encoder, &self.uploaded, self.clock.render_writes(3));
            self.renderer.encode_glow(&mut encoder, &self.uploaded, self.clock.render_writes(4));
        }
        {
            let writes = self.clock.render_writes(5);
            let posts = of_frame(self.uploaded.post.is_some());
            let mut pass = self.renderer.begin_color_pass(&mut encoder, &self.view, &self.target, posts, writes);
            let scene = &self.uploaded;
            draw_list::bind_scene(&mut pass, scene, self.renderer.color_frame_group(scene), &scene.character_group);
            record(&mut pass, self);
        }
        if prepare {
            let writes = self.clock.render_writes(6);
            self.renderer.encode_post(&mut encoder, &self.uploaded, &self.view, &self.target, writes);
        }
        self.clock.resolve(&mut encoder, timed);
        self.gpu.queue.submit([encoder.finish()]);
        self.gpu.wait(TIMEOUT)
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
    let mut passes = vec![Vec::new(); TIMED_PASSES.len()];
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
        passes: TIMED_PASSES
            .iter()
            .zip(passes)
            .filter(|(_, list)| !list.is_empty())
            .map(|(name, list)| PassTime { name: (*name).to_owned(), ms: spread(list) })
            .collect(),
        draws: stage.uploaded.draw_count(),
        triangles: stage.uploaded.triangle_count() * options.view.instances.len(),
        memory: stage.uploaded.memory(),
        upload_ms,
        first_frame_ms,
    })
}

/// Timestamps of the adapter; `None` inside where it has none.
struct Clock {
    queries: Option<(wgpu::QuerySet, wgpu::Buffer, wgpu::Buffer)>,
    period_ns: f64,
    /// Which passes the last frame had.
    timed: [bool; TIMED_PASSES.len()],
}

const QUERIES: u32 = 2 * TIMED_PASSES.len() as u32;

impl Clock {
    fn new(gpu: &Gpu) -> Self {
        let queries = gpu.device.features().contains(wgpu::Features::TIMESTAMP_QUERY).then(|| {
            let set = gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("bench"),
                ty: wgpu::QueryType::Timestamp,
                count: QUERIES,
            });
            let buffer = |usage| {
                gpu.device.create_buffer(&wgpu::BufferDescriptor {
                    label: Some("bench"),
                    size: TIMED_PASSES.len() as u64 * wgpu::QUERY_RESOLVE_BUFFER_ALIGNMENT,
                    usage,
                    mapped_at_creation: false,
                })
            };
            let resolved = buffer(wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC);
            (set, resolved, buffer(wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ))
        });
        Self { queries, period_ns: f64::from(gpu.queue.get_timestamp_period()), timed: [false; TIMED_PASSES.len()] }
    }

    fn compute_writes(&self) -> Option<wgpu::ComputePassTimestampWrites<'_>> {
        let (query_set, ..) = self.queries.as_ref()?;
        Some(wgpu::ComputePassTimestampWrites {
            query_set,
            beginning_of_pass_write_index: Some(0),
            end_of_pass_write_index: Some(1),
        })
    }

    /// Timestamps of a pass, by its place in [`TIMED_PASSES`].
    fn render_writes(&self, pass: u32) -> Option<wgpu::RenderPassTimestampWrites<'_>> {
        let (query_set, ..) = self.queries.as_ref()?;
        Some(wgpu::RenderPassTimestampWrites {
            query_set,
            beginning_of_pass_write_index: Some(2 * pass),
            end_of_pass_write_index: Some(2 * pass + 1),
        })
    }

    /// Reads the timestamps of the passes that were drawn; those of others must not be waited for.
    fn resolve(&mut self, encoder: &mut wgpu::CommandEncoder, timed: [bool; TIMED_PASSES.len()]) {
        self.timed = timed;
        if let Some((set, resolved, read)) = &self.queries {
            for (pass, _) in (0u32..).zip(timed).filter(|(_, timed)| *timed) {
                let at = u64::from(pass) * wgpu::QUERY_RESOLVE_BUFFER_ALIGNMENT;
                encoder.resolve_query_set(set, 2 * pass..2 * pass + 2, resolved, at);
            }
            encoder.copy_buffer_to_buffer(resolved, 0, read, 0, resolved.size());
        }
    }

    /// Milliseconds of each pass that was drawn.
    fn read(&self, gpu: &Gpu) -> Result<Vec<Option<f64>>> {
        let Some((_, _, read)) = &self.queries else { return Ok(Vec::new()) };
        read.slice(..).map_async(wgpu::MapMode::Read, |_| ());
        gpu.wait(TIMEOUT)?;
        let ticks: Vec<u64> = {
            let mapped =
                read.slice(..).get_mapped_range().map_err(|e| Error::Gpu(format!("reading timestamps: {e}")))?;
            bytemuck::pod_collect_to_vec(&mapped)
        };
        read.unmap();
        let milliseconds = |t: &[u64]| t[1].saturating_sub(t[0]) as f64 * self.period_ns * 1e-6;
        let of_passes = ticks.chunks_exact(wgpu::QUERY_RESOLVE_BUFFER_ALIGNMENT as usize / 8).zip(self.timed);
        Ok(of_passes.map(|(t, timed)| timed.then(|| milliseconds(t))).collect())
    }
}

fn milliseconds(start: Instant) -> f64 {
    start.elapsed().as_secs_f64() * 1e3
}

fn spread(mut values: Vec<f64>) -> Spread {
    values.sort_by(f64::total_cmp);
    let at = |share: f64| values.get(((values.len() - 1) as f64 * share).round() as usize).copied().unwrap_or(0.0);
    Spread { min: at(0.0), median: at(0.5), p95: at(0.95) }
}
