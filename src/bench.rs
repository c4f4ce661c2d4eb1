//! Times frames against a floor: the same triangles in the same targets, unlit with one texture.
//!
//! Frames and floor frames take turns, so that a machine that slows down slows both; the ratio of medians is what counts.

use std::time::{Duration, Instant};

use serde::Serialize;

use crate::{
    AdapterInfo, Error, Gpu, GpuMemory, GpuScene, Output, Renderer, Result, View,
    motion::Pose,
    render::{
        draw_list,
        pass::floor::{FloorInputs, FloorPass},
        pass::opaque::OpaqueInputs,
        pass::outline::OutlineInputs,
        pass::transparent::TransparentInputs,
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
const TIMED_PASSES: [&str; 2] = ["deform", "colour"];

/// Times a scene. Every frame sets the pose anew, as an animated character would.
///
/// # Errors
/// [`Error::Argument`] for options out of their domain; [`Error::Gpu`] where the adapter fails.
pub fn run(gpu: &Gpu, scene: &Scene, options: &BenchOptions) -> Result<BenchReport> {
    if options.frames == 0 {
        return Err(Error::Argument { what: "frames".to_owned(), message: "is 0; expected at least 1".to_owned() });
    }
    let output = Output { samples: options.samples, ..Output::default() };
    let mut renderer = Renderer::with_output(gpu, output)?;
    let start = Instant::now();
    let mut uploaded = renderer.upload(scene)?;
    gpu.wait(TIMEOUT)?;
    let upload_ms = milliseconds(start);
    let start = Instant::now();
    renderer.render(&mut uploaded, &options.view)?;
    let first_frame_ms = milliseconds(start);

    let floor = FloorPass::new(gpu, &renderer.layouts, output);
    let target = crate::render::color_target(gpu, options.view.size, output);
    let clock = Clock::new(gpu);
    let pose = Pose::rest(scene);
    let (mut frames, mut floors) = (Vec::new(), Vec::new());
    let mut passes = vec![Vec::new(); TIMED_PASSES.len()];
    // The first round warms both up and does not count.
    for round in 0..=options.frames {
        let start = Instant::now();
        frame(&mut renderer, &mut uploaded, scene, &pose, &options.view, &target, Some(&clock), None);
        gpu.wait(TIMEOUT)?;
        let frame_ms = milliseconds(start);
        let times = clock.read(gpu)?;
        let start = Instant::now();
        frame(&mut renderer, &mut uploaded, scene, &pose, &options.view, &target, None, Some(&floor));
        gpu.wait(TIMEOUT)?;
        if round > 0 {
            frames.push(frame_ms);
            floors.push(milliseconds(start));
            for (list, ms) in passes.iter_mut().zip(times) {
                list.push(ms);
            }
        }
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
        draws: uploaded.draw_count(),
        triangles: uploaded.triangle_count() * options.view.instances.len(),
        memory: uploaded.memory(),
        upload_ms,
        first_frame_ms,
    })
}

/// Poses, deforms and draws once: the frame, or the floor in its place.
#[allow(clippy::too_many_arguments, reason = "one private call site pair; a struct would only rename them")]
fn frame(
    renderer: &mut Renderer,
    uploaded: &mut GpuScene,
    scene: &Scene,
    pose: &Pose,
    view: &View,
    target: &wgpu::TextureView,
    clock: Option<&Clock>,
    floor: Option<&FloorPass>,
) {
    let gpu = renderer.gpu.clone();
    uploaded.set_pose(&gpu, scene, pose);
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("bench") });
    renderer.begin_frame(uploaded, view);
    renderer.encode_deform(&mut encoder, uploaded, clock.and_then(Clock::compute_writes));
    {
        let writes = clock.and_then(Clock::render_writes);
        let mut pass = renderer.begin_color_pass(&mut encoder, view, target, writes);
        draw_list::bind_scene(&mut pass, uploaded, renderer.frame_group());
        if let Some(floor) = floor {
            floor.encode(&mut pass, &FloorInputs { scene: uploaded });
        } else {
            renderer.opaque.encode(&mut pass, &OpaqueInputs { scene: uploaded });
            renderer.outline.encode(&mut pass, &OutlineInputs { scene: uploaded });
            renderer.transparent.encode(&mut pass, &TransparentInputs { scene: uploaded });
        }
    }
    if let Some(clock) = clock {
        clock.resolve(&mut encoder);
    }
    gpu.queue.submit([encoder.finish()]);
}

/// Timestamps of the adapter; `None` inside where it has none.
struct Clock {
    queries: Option<(wgpu::QuerySet, wgpu::Buffer, wgpu::Buffer)>,
    period_ns: f64,
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
                    size: u64::from(QUERIES) * 8,
                    usage,
                    mapped_at_creation: false,
                })
            };
            let resolved = buffer(wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC);
            (set, resolved, buffer(wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ))
        });
        Self { queries, period_ns: f64::from(gpu.queue.get_timestamp_period()) }
    }

    fn compute_writes(&self) -> Option<wgpu::ComputePassTimestampWrites<'_>> {
        let (query_set, ..) = self.queries.as_ref()?;
        Some(wgpu::ComputePassTimestampWrites {
            query_set,
            beginning_of_pass_write_index: Some(0),
            end_of_pass_write_index: Some(1),
        })
    }

    fn render_writes(&self) -> Option<wgpu::RenderPassTimestampWrites<'_>> {
        let (query_set, ..) = self.queries.as_ref()?;
        Some(wgpu::RenderPassTimestampWrites {
            query_set,
            beginning_of_pass_write_index: Some(2),
            end_of_pass_write_index: Some(3),
        })
    }

    fn resolve(&self, encoder: &mut wgpu::CommandEncoder) {
        if let Some((set, resolved, read)) = &self.queries {
            encoder.resolve_query_set(set, 0..QUERIES, resolved, 0);
            encoder.copy_buffer_to_buffer(resolved, 0, read, 0, resolved.size());
        }
    }

    /// Milliseconds of each pass.
    fn read(&self, gpu: &Gpu) -> Result<Vec<f64>> {
        let Some((_, _, read)) = &self.queries else { return Ok(Vec::new()) };
        read.slice(..).map_async(wgpu::MapMode::Read, |_| ());
        gpu.wait(TIMEOUT)?;
        let ticks: Vec<u64> = {
            let mapped =
                read.slice(..).get_mapped_range().map_err(|e| Error::Gpu(format!("reading timestamps: {e}")))?;
            bytemuck::pod_collect_to_vec(&mapped)
        };
        read.unmap();
        Ok(ticks.chunks_exact(2).map(|t| t[1].saturating_sub(t[0]) as f64 * self.period_ns * 1e-6).collect())
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
