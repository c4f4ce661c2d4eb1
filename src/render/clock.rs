//! Timestamps of the passes of a frame.

use std::cell::Cell;
use std::time::Duration;

use crate::{Error, Gpu, Result};

/// A pass that is timed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Timed {
    Deform,
    BangsShadow,
    Shadow,
    Prepass,
    Irradiance,
    Scatter,
    Glow,
    Color,
    Post,
}

impl Timed {
    /// All of them, in the order of the frame.
    pub const ALL: [Self; 9] = [
        Self::Deform,
        Self::BangsShadow,
        Self::Shadow,
        Self::Prepass,
        Self::Irradiance,
        Self::Scatter,
        Self::Glow,
        Self::Color,
        Self::Post,
    ];

    /// Its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Deform => "deform",
            Self::BangsShadow => "bangs shadow",
            Self::Shadow => "shadow",
            Self::Prepass => "depth",
            Self::Irradiance => "light on skin",
            Self::Scatter => "scattering",
            Self::Glow => "glow",
            Self::Color => "colour",
            Self::Post => "post",
        }
    }
}

const PASSES: usize = Timed::ALL.len();
const QUERIES: u32 = 2 * PASSES as u32;
const TIMEOUT: Duration = Duration::from_secs(120);

/// The adapter's own clock; off where it has none, or nobody asks.
#[derive(Debug)]
pub(crate) struct Clock {
    queries: Option<(wgpu::QuerySet, wgpu::Buffer, wgpu::Buffer)>,
    period_ns: f64,
    /// Which passes the frame has.
    timed: [Cell<bool>; PASSES],
}

impl Clock {
    /// Times nothing.
    pub fn off() -> Self {
        Self { queries: None, period_ns: 0.0, timed: Default::default() }
    }

    /// Times every pass, where the adapter can.
    pub fn new(gpu: &Gpu) -> Self {
        let queries = gpu.device.features().contains(wgpu::Features::TIMESTAMP_QUERY).then(|| {
            let set = gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("bench"),
                ty: wgpu::QueryType::Timestamp,
                count: QUERIES,
            });
            let buffer = |usage| {
                gpu.device.create_buffer(&wgpu::BufferDescriptor {
                    label: Some("bench"),
                    size: PASSES as u64 * wgpu::QUERY_RESOLVE_BUFFER_ALIGNMENT,
                    usage,
                    mapped_at_creation: false,
                })
            };
            let resolved = buffer(wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC);
            (set, resolved, buffer(wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ))
        });
        Self { queries, period_ns: f64::from(gpu.queue.get_timestamp_period()), timed: Default::default() }
    }

    /// Timestamps of a compute pass.
    pub fn compute(&self, pass: Timed) -> Option<wgpu::ComputePassTimestampWrites<'_>> {
        let (query_set, begin, end) = self.writes(pass)?;
        Some(wgpu::ComputePassTimestampWrites {
            query_set,
            beginning_of_pass_write_index: Some(begin),
            end_of_pass_write_index: Some(end),
        })
    }

    /// Timestamps of a render pass.
    pub fn render(&self, pass: Timed) -> Option<wgpu::RenderPassTimestampWrites<'_>> {
        let (query_set, begin, end) = self.writes(pass)?;
        Some(wgpu::RenderPassTimestampWrites {
            query_set,
            beginning_of_pass_write_index: Some(begin),
            end_of_pass_write_index: Some(end),
        })
    }

    fn writes(&self, pass: Timed) -> Option<(&wgpu::QuerySet, u32, u32)> {
        let (query_set, ..) = self.queries.as_ref()?;
        self.timed[pass as usize].set(true);
        Some((query_set, 2 * pass as u32, 2 * pass as u32 + 1))
    }

    /// Takes the timestamps of the passes that were encoded; those of others must not be waited for.
    pub fn resolve(&self, encoder: &mut wgpu::CommandEncoder) {
        let Some((set, resolved, read)) = &self.queries else { return };
        for (pass, _) in (0u32..).zip(&self.timed).filter(|(_, timed)| timed.get()) {
            let at = u64::from(pass) * wgpu::QUERY_RESOLVE_BUFFER_ALIGNMENT;
            encoder.resolve_query_set(set, 2 * pass..2 * pass + 2, resolved, at);
        }
        encoder.copy_buffer_to_buffer(resolved, 0, read, 0, resolved.size());
    }

    /// Milliseconds of each pass of the frame that is done; the next one begins anew.
    pub fn read(&self, gpu: &Gpu) -> Result<Vec<Option<f64>>> {
        let timed = self.timed.each_ref().map(|t| t.replace(false));
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
        let of_passes = ticks.chunks_exact(wgpu::QUERY_RESOLVE_BUFFER_ALIGNMENT as usize / 8).zip(timed);
        Ok(of_passes.map(|(t, timed)| timed.then(|| milliseconds(t))).collect())
    }
}
