//! Spreads the light on skin over the picture, as far as its profile says: along lines, or over discs.

use super::irradiance::{IrradianceTargets, SKIN_LIGHT_FORMAT};
use super::{DEPTH_FORMAT, HDR_FORMAT};
use crate::material::{Skin, SkinDiffuse};
use crate::render::clock::{Clock, Timed};
use crate::render::shaders::Recipe;
use crate::render::targets::{self, PictureTarget};
use crate::render::uploads::Uploads;
use crate::render::variants::Variants;
use crate::render::{View, bind};
use crate::scene::Camera;
use crate::skin::{MOST_LINE_TAPS, MOST_TAPS, discs, lines};
use crate::{Gpu, Result};

/// Taps that characters ask for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct ScatterTaps {
    /// To each side of a line; 0 where nothing spreads along lines.
    pub line: usize,
    /// Of a disc; 0 where nothing spreads over discs.
    pub disc: usize,
}

impl ScatterTaps {
    /// Of a skin whose light spreads over the picture.
    pub fn of(skin: &Skin) -> Self {
        let taps = skin.taps as usize;
        match skin.diffuse {
            SkinDiffuse::ScreenSpaceDisc => Self { line: 0, disc: taps },
            // To both sides of two lines.
            _ => Self { line: (taps + 1) / 4, disc: 0 },
        }
    }

    /// As many as any of them asks for.
    pub fn most(all: impl Iterator<Item = Self>) -> Self {
        all.fold(Self::default(), |a, b| Self { line: a.line.max(b.line), disc: a.disc.max(b.disc) })
    }

    pub fn is_any(self) -> bool {
        self != Self::default()
    }
}

/// A pass over the picture and its numbers.
#[derive(Debug)]
struct Spread {
    pipeline: wgpu::RenderPipeline,
    numbers: wgpu::Buffer,
}

/// The passes.
#[derive(Debug)]
pub(crate) struct ScatterPass {
    layout: wgpu::BindGroupLayout,
    across: Spread,
    down: Spread,
    disc: Spread,
}

/// What each pass reads.
#[derive(Debug)]
pub(crate) struct ScatterGroups {
    across: wgpu::BindGroup,
    down: wgpu::BindGroup,
    disc: wgpu::BindGroup,
}

/// `LineNumbers` of `wgsl/pass/scatter_line.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
struct LineNumbers {
    /// At a distance of a metre.
    mm_per_px: f32,
    count: u32,
    unused: [u32; 2],
    /// As [`lines`] gives them, of each pixel of two by two.
    taps: [[f32; 4]; MOST_LINE_TAPS],
}

/// `DiscNumbers` of `wgsl/pass/scatter_disc.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
struct DiscNumbers {
    /// At a distance of a metre.
    mm_per_px: f32,
    count: u32,
    unused: [u32; 2],
    /// As [`discs`] gives them, of each pixel of two by two.
    taps: [[[f32; 4]; MOST_TAPS]; 4],
}

/// Where light goes.
pub(crate) struct ScatterTargets<'a> {
    /// Of skin.
    pub depth: &'a wgpu::TextureView,
    /// Along rows, packed.
    pub across: &'a wgpu::TextureView,
    /// What skin reads.
    pub scattered: &'a wgpu::TextureView,
}

impl ScatterPass {
    pub fn new(variants: &Variants) -> Result<Self> {
        let gpu = &variants.gpu;
        use wgpu::{TextureSampleType as T, TextureViewDimension as D};
        let read = |ty| (wgpu::ShaderStages::FRAGMENT, ty);
        let list = [
            read(bind::uniform(None)),
            read(bind::texture(T::Uint, D::D2)),
            read(bind::texture(T::Float { filterable: false }, D::D2)),
        ];
        let layout = bind::layout(gpu, "scatter", list);
        let pipeline_layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("scatter"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let spread = |name, entry, format, size| -> Result<Spread> {
            let module = variants.plain_module(&Recipe::plain(name))?;
            let into = PictureTarget { depth: Some(where_skin_is()), ..PictureTarget::of(format, 1, None) };
            let pipeline = targets::picture_pipeline(gpu, name, Some(&pipeline_layout), &module, entry, into);
            Ok(Spread { pipeline, numbers: bind::buffer(gpu, name, size as u64, usage) })
        };
        Ok(Self {
            across: spread("scatter_line", "fs_across", SKIN_LIGHT_FORMAT, size_of::<LineNumbers>())?,
            down: spread("scatter_line", "fs_down", HDR_FORMAT, size_of::<LineNumbers>())?,
            disc: spread("scatter_disc", "fs_main", HDR_FORMAT, size_of::<DiscNumbers>())?,
            layout,
        })
    }

    /// Groups that read the light on skin, and that light along rows.
    pub fn groups(&self, gpu: &Gpu, read: &IrradianceTargets, across: &wgpu::TextureView) -> ScatterGroups {
        let view = wgpu::BindingResource::TextureView;
        let group = |spread: &Spread, light| {
            let resources = [spread.numbers.as_entire_binding(), view(light), view(&read.distance)];
            bind::group(gpu, "scatter", &self.layout, resources)
        };
        ScatterGroups {
            across: group(&self.across, &read.light),
            down: group(&self.down, across),
            disc: group(&self.disc, &read.light),
        }
    }

    /// Spreads it, by so many taps.
    pub fn encode(
        &self,
        uploads: &mut Uploads,
        encoder: &mut wgpu::CommandEncoder,
        groups: &ScatterGroups,
        (view, taps): (&View, ScatterTaps),
        into: &ScatterTargets<'_>,
        clock: &Clock,
    ) {
        let Camera { fov_y_rad, .. } = view.camera;
        let mm_per_px = 2000.0 * (fov_y_rad * 0.5).tan() / view.size[1] as f32;
        let (has_lines, has_discs) = (taps.line > 0, taps.disc > 0);
        // Of all passes together: the first begins, the last ends.
        let time = |is_first: bool, is_last: bool| {
            let mut writes = clock.render(Timed::Scatter)?;
            writes.beginning_of_pass_write_index = writes.beginning_of_pass_write_index.filter(|_| is_first);
            writes.end_of_pass_write_index = writes.end_of_pass_write_index.filter(|_| is_last);
            Some(writes).filter(|_| is_first || is_last)
        };
        let mut spread = |of: &Spread, group, bytes: &[u8], target, clear, times| {
            uploads.write(encoder, &of.numbers, 0, bytes);
            let load = if clear {
                wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT)
            } else {
                wgpu::LoadOp::Load
            };
            let depth = wgpu::RenderPassDepthStencilAttachment { view: into.depth, depth_ops: None, stencil_ops: None };
            let mut pass = targets::begin(encoder, "scatter", Some(targets::color(target, load)), Some(depth), times);
            pass.set_pipeline(&of.pipeline);
            pass.set_bind_group(0, group, &[]);
            pass.draw(0..3, 0..1);
        };
        if has_lines {
            let numbers = LineNumbers { mm_per_px, count: taps.line as u32, unused: [0; 2], taps: lines(taps.line) };
            let bytes = bytemuck::bytes_of(&numbers);
            spread(&self.across, &groups.across, bytes, into.across, true, time(true, false));
            spread(&self.down, &groups.down, bytes, into.scattered, true, time(false, !has_discs));
        }
        if has_discs {
            let numbers = DiscNumbers { mm_per_px, count: taps.disc as u32, unused: [0; 2], taps: discs(taps.disc) };
            let bytes = bytemuck::bytes_of(&numbers);
            spread(&self.disc, &groups.disc, bytes, into.scattered, !has_lines, time(!has_lines, true));
        }
    }
}

/// Passes over the picture lie at depth 0: what is as far is no skin.
fn where_skin_is() -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format: DEPTH_FORMAT,
        depth_write_enabled: Some(false),
        depth_compare: Some(wgpu::CompareFunction::Less),
        stencil: wgpu::StencilState::default(),
        bias: wgpu::DepthBiasState::default(),
    }
}
