//! Outlines of opaque surfaces: back faces pushed outwards.

use std::collections::HashMap;

use super::{ColorPipeline, Driven, Mark, SurfaceFlags, color_pipeline, encode_constant};
use crate::{
    Gpu,
    material::{AlphaMode, Material, OutlineWidth, TintSource},
    render::{Layouts, Output, draw_list, shaders, upload::GpuScene},
    scene::ColorTarget,
};

/// Pipelines by what a material uses.
#[derive(Debug)]
pub(crate) struct OutlinePass {
    output: Output,
    module: wgpu::ShaderModule,
    pipelines: HashMap<OutlineKey, wgpu::RenderPipeline>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct OutlineKey {
    flags: SurfaceFlags,
    screen_width: bool,
    width_mask: bool,
    shaded: bool,
    blend: bool,
    write_depth: bool,
    tint: bool,
    from_shade: bool,
    parts: bool,
    vertex_width: bool,
    bounds: bool,
    push: bool,
}

/// What the pass reads.
pub(crate) struct OutlineInputs<'a> {
    pub scene: &'a GpuScene,
}

/// What of a surface counts for its line: what it is made of and its own light and shade, but neither what is drawn on it
/// nor what glows or falls on it.
fn of_line(flags: SurfaceFlags) -> SurfaceFlags {
    SurfaceFlags {
        face_paint: false,
        bangs_shadow: false,
        lid_shadow: false,
        cast_shadow: false,
        highlight: false,
        highlight_second: false,
        highlight_apart: false,
        highlight_breakup: false,
        shaped_highlight: false,
        shaped_map: false,
        shaped_brushed: false,
        sparkle: false,
        gem: false,
        gem_inclusions: false,
        diamond: false,
        fur_detail: false,
        fur_color: false,
        stocking: false,
        decals: false,
        depth_rim: false,
        rim_width: false,
        rim_shade: false,
        inner_lines: false,
        ..flags
    }
}

impl OutlinePass {
    pub fn new(gpu: &Gpu, output: Output) -> Self {
        Self { output, module: shaders::module(&gpu.device, "outline"), pipelines: HashMap::new() }
    }

    /// The pipeline for a material, made on first use; `None` where it has no outline.
    pub fn pipeline(
        &mut self,
        gpu: &Gpu,
        layouts: &Layouts,
        flags: SurfaceFlags,
        material: &Material,
        driven: &Driven,
    ) -> Option<wgpu::RenderPipeline> {
        let outline = material.outline?;
        let (width, screen_width) = match outline.width {
            OutlineWidth::World { metres } => (metres, false),
            OutlineWidth::Screen { height_ratio } => (height_ratio, true),
        };
        if width <= 0.0 {
            return None;
        }
        let blend = material.alpha.mode == AlphaMode::Blend;
        // Black stays black whatever the light.
        let colored = outline.color != [0.0; 3] || driven.colors.contains(&ColorTarget::OutlineColor);
        let mixed = outline.tint.is_none() && outline.lighting_mix > 0.0 && colored;
        let dither_samples = flags.dither_fade && !blend && self.output.samples == 4;
        let vanishes = flags.dissolve || (flags.dither_fade && !dither_samples);
        let shaded = mixed || vanishes || material.alpha.mode != AlphaMode::Opaque;
        let mut key = OutlineKey {
            flags: SurfaceFlags { dither_samples, ..of_line(flags) },
            screen_width,
            width_mask: outline.width_mask.is_some(),
            shaded,
            blend,
            write_depth: !blend || material.alpha.write_depth,
            tint: outline.tint.is_some(),
            from_shade: outline.tint.is_some_and(|t| t.from == TintSource::Shade),
            parts: outline.tint.is_some_and(|t| t.parts.is_some()),
            vertex_width: outline.vertex_width,
            bounds: outline.clamp_px.is_some() && !screen_width,
            push: outline.push_m > 0.0,
        };
        if !shaded && !key.tint {
            // A plain colour needs nothing of the surface but the UVs of its mask: fewer pipelines.
            let SurfaceFlags { uv_transforms, uv_animation, uv_animation_mask, hdr, .. } = flags;
            let plain = SurfaceFlags { hdr, dither_samples, ..SurfaceFlags::default() };
            key.flags = if key.width_mask {
                SurfaceFlags { uv_transforms, uv_animation, uv_animation_mask, ..plain }
            } else {
                plain
            };
        }
        let make = || {
            let mut constants = key.flags.constants();
            let flag = |on: bool| f64::from(u8::from(on));
            constants.extend([
                encode_constant(key.flags.output(self.output)),
                ("SCREEN_WIDTH", flag(key.screen_width)),
                ("WIDTH_MASK", flag(key.width_mask)),
                ("OUTLINE_SHADED", flag(key.shaded)),
                ("OUTLINE_BLEND", flag(key.blend)),
                ("OUTLINE_TINT", flag(key.tint)),
                ("OUTLINE_FROM_SHADE", flag(key.from_shade)),
                ("OUTLINE_PARTS", flag(key.parts)),
                ("VERTEX_WIDTH", flag(key.vertex_width)),
                ("WIDTH_BOUNDS", flag(key.bounds)),
                ("OUTLINE_PUSH", flag(key.push)),
            ]);
            color_pipeline(
                gpu,
                layouts,
                key.flags.output(self.output),
                &ColorPipeline {
                    label: "outline",
                    module: &self.module,
                    fragment: if dither_samples { "fs_dithered" } else { "fs_main" },
                    constants: &constants,
                    cull: Some(wgpu::Face::Front),
                    blend: key.blend,
                    write_depth: key.write_depth,
                    mark: Mark::None,
                },
            )
        };
        Some(self.pipelines.entry(key).or_insert_with(make).clone())
    }

    /// Draws the outlines of all opaque surfaces.
    pub fn encode(&self, pass: &mut wgpu::RenderPass<'_>, inputs: &OutlineInputs<'_>) {
        for draw in inputs.scene.draws.iter().filter(|d| !d.blend) {
            if let Some(outline) = &draw.outline {
                draw_list::record(pass, inputs.scene, draw, outline);
            }
        }
    }
}
