//! Passes: one file each, with the shader of the same stem in `wgsl/pass/`; what they share stands here.

pub(crate) mod bangs_near;
pub(crate) mod bangs_shadow;
pub(crate) mod bloom;
pub(crate) mod deform;
pub(crate) mod eyes_through;
pub(crate) mod floor;
pub(crate) mod fluff;
pub(crate) mod glow;
pub(crate) mod opaque;
pub(crate) mod outline;
pub(crate) mod post;
pub(crate) mod prepass;
pub(crate) mod shadow;
pub(crate) mod transparent;

use super::{Layouts, Output};
use crate::{
    Gpu,
    material::{AlphaMode, Material, Shading, TextureRef, UvTransform},
    scene::{ColorTarget, Scene},
    sdf::FaceMap,
};

/// What expressions change of a material: pipelines must keep it even where it is off at rest.
#[derive(Clone, Debug, Default)]
pub(crate) struct Driven {
    pub colors: Vec<ColorTarget>,
    pub uvs: bool,
}

impl Driven {
    /// What the expressions of a scene drive, for each material.
    pub fn of(scene: &Scene) -> Vec<Self> {
        let mut driven = vec![Self::default(); scene.materials.len()];
        for expression in scene.character.iter().flat_map(|c| &c.expressions) {
            for bind in &expression.colors {
                if let Some(material) = driven.get_mut(bind.material) {
                    material.colors.push(bind.target);
                }
            }
            for bind in &expression.uv_transforms {
                if let Some(material) = driven.get_mut(bind.material) {
                    material.uvs = true;
                }
            }
        }
        driven
    }
}

/// Depth format of the prepass; of the colour pass where the device has no stencil beside 32 bits of depth.
pub(crate) const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Colour of frames that are finished by [`post`], and of light.
pub(crate) const HDR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

/// Depth format of the colour pass.
pub(crate) fn color_depth_format(gpu: &Gpu) -> wgpu::TextureFormat {
    if gpu.device.features().contains(wgpu::Features::DEPTH32FLOAT_STENCIL8) {
        wgpu::TextureFormat::Depth32FloatStencil8
    } else {
        DEPTH_FORMAT
    }
}

/// What a draw has to do with eyes through hair.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum Mark {
    /// Nothing.
    #[default]
    None,
    /// Is an eye or a brow: marks where it is seen.
    Eyes,
    /// Is hair: marks where it is seen.
    Hair,
    /// Draws eyes where both marks are, and takes that of hair away, so that each sample is drawn to once.
    Through,
}

const EYES_BIT: u32 = 0x80;
const HAIR_BIT: u32 = 0x40;
const NUMBER_BITS: u32 = 0x3f;

impl Mark {
    /// How many characters have a number of their own.
    pub const NUMBERS: u32 = NUMBER_BITS + 1;

    /// Whether it belongs to one character: hair is marked with her number, and shows her eyes alone.
    pub fn is_numbered(self) -> bool {
        matches!(self, Self::Hair | Self::Through)
    }

    /// Reference value of the stencil for the character of this number.
    pub fn reference(self, number: u32) -> u32 {
        match self {
            Self::None => 0,
            Self::Eyes => EYES_BIT,
            Self::Hair => HAIR_BIT | number,
            Self::Through => EYES_BIT | HAIR_BIT | number,
        }
    }

    fn stencil(self) -> wgpu::StencilState {
        let (compare, pass_op, read_mask, write_mask) = match self {
            Self::None => return wgpu::StencilState::default(),
            Self::Eyes => (wgpu::CompareFunction::Always, wgpu::StencilOperation::Replace, 0, EYES_BIT),
            Self::Hair => (wgpu::CompareFunction::Always, wgpu::StencilOperation::Replace, 0, HAIR_BIT | NUMBER_BITS),
            Self::Through => (wgpu::CompareFunction::Equal, wgpu::StencilOperation::Zero, 0xff, HAIR_BIT),
        };
        let face = wgpu::StencilFaceState {
            compare,
            fail_op: wgpu::StencilOperation::Keep,
            depth_fail_op: wgpu::StencilOperation::Keep,
            pass_op,
        };
        wgpu::StencilState { front: face, back: face, read_mask, write_mask }
    }
}

/// Parts of a surface that a pipeline includes: the overrides of `wgsl/bind/options.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub(crate) struct SurfaceFlags {
    pub unlit: bool,
    pub base_texture: bool,
    pub shade_texture: bool,
    pub shade_is_base: bool,
    pub shift_texture: bool,
    pub normal_map: bool,
    pub emission_texture: bool,
    pub matcap: bool,
    pub rim: bool,
    pub rim_mask: bool,
    pub uv_transforms: bool,
    pub uv_animation: bool,
    pub uv_animation_mask: bool,
    pub vertex_color: bool,
    pub alpha_mask: bool,
    pub alpha_coverage: bool,
    pub face_shadow: bool,
    pub face_stack: bool,
    pub face_back: bool,
    pub face_masks: bool,
    pub transition: bool,
    pub face_paint: bool,
    pub bangs_shadow: bool,
    pub lid_shadow: bool,
    pub highlight: bool,
    pub highlight_second: bool,
    pub highlight_apart: bool,
    pub highlight_breakup: bool,
    pub layered: bool,
    pub cast_shadow: bool,
    pub shade_ramp: bool,
    pub ramp_maps: bool,
    pub ramp_parts: bool,
    pub shade_shift: bool,
    pub light_response: bool,
    pub fur_detail: bool,
    pub fur_color: bool,
    pub depth_rim: bool,
    pub shaped_highlight: bool,
    pub shaped_map: bool,
    pub shaped_brushed: bool,
    pub sparkle: bool,
    pub gem: bool,
    pub gem_inclusions: bool,
    pub diamond: bool,
    pub fire: bool,
    pub fire_map: bool,
    pub emission_scroll: bool,
    pub emission_blink: bool,
    pub stocking: bool,
    pub decals: bool,
    pub dissolve: bool,
    pub dither_fade: bool,
    /// Fades sample by sample.
    pub dither_samples: bool,
    pub rim_width: bool,
    pub rim_shade: bool,
    pub inner_lines: bool,
    /// Draws into half floats, which [`post`] finishes; no override.
    pub hdr: bool,
    /// [`Channel::shader_code`](super::Channel::shader_code).
    pub channel: u32,
}

impl SurfaceFlags {
    /// What a material uses, at rest or under any expression; `face_maps` are those of its scene.
    pub fn of(material: &Material, driven: &Driven, has_vertex_colors: bool, face_maps: &[FaceMap]) -> Self {
        let toon = match &material.shading {
            Shading::Toon(toon) => Some(toon),
            Shading::Unlit => None,
        };
        let visible = |color: [f32; 3], target| color != [0.0; 3] || driven.colors.contains(&target);
        let rim = toon.is_some() && visible(material.rim.color, ColorTarget::RimColor);
        let matcap = material.matcap.filter(|m| toon.is_some() && visible(m.color, ColorTarget::MatcapColor));
        let shade_texture = toon.and_then(|t| t.shade_texture);
        let shade_is_base = shade_texture.is_some() && shade_texture == material.base.texture;
        let shift_texture = toon.and_then(|t| t.shift_texture);
        let normal_map = material.normal_map.filter(|_| toon.is_some());
        let emission_texture =
            material.emission.texture.filter(|_| visible(material.emission.color, ColorTarget::EmissionColor));
        let rim_mask = material.rim.mask.filter(|_| rim || matcap.is_some());
        let outline_mask = material.outline.and_then(|o| o.width_mask);
        let uv_animation = material.uv_animation.is_active();
        let animation_mask = material.uv_animation.mask.filter(|_| uv_animation);
        let face_map = material.face_shadow.filter(|_| toon.is_some()).and_then(|f| face_maps.get(f.map));
        let face_paint = material.face_paint.filter(|_| toon.is_some());
        let highlight = material.highlight.filter(|_| toon.is_some());
        let ramp = material.shade_ramp.filter(|_| toon.is_some());
        let ramp_maps = ramp.and_then(|r| r.maps);
        let part_ids = ramp_maps.and_then(|m| m.part_ids);
        let fur = material.fur_detail.filter(|_| toon.is_some());
        let shaped = material.shaped_highlight.filter(|_| toon.is_some());
        let gem = material.gem.filter(|_| toon.is_some());
        let used = [
            material.base.texture,
            shade_texture,
            shift_texture,
            normal_map.map(|n| n.texture),
            emission_texture,
            rim_mask,
            outline_mask,
            animation_mask,
            material.painted_highlight(),
            material.depth_rim.and_then(|r| r.width_mask),
            face_paint.map(|p| p.map),
            material.part_ids(),
            fur.map(|f| f.detail_normal),
            fur.and_then(|f| f.detail_color),
        ];
        let moved = |t: &TextureRef| t.uv_set != 0 || t.transform != UvTransform::default();
        Self {
            unlit: toon.is_none(),
            base_texture: material.base.texture.is_some(),
            shade_texture: shade_texture.is_some() && !shade_is_base,
            shade_is_base,
            shift_texture: shift_texture.is_some(),
            normal_map: normal_map.is_some(),
            emission_texture: emission_texture.is_some(),
            matcap: matcap.is_some(),
            rim,
            rim_mask: rim_mask.is_some(),
            uv_transforms: driven.uvs || used.iter().flatten().any(moved),
            uv_animation,
            uv_animation_mask: animation_mask.is_some(),
            vertex_color: has_vertex_colors,
            alpha_mask: material.alpha.mode == AlphaMode::Mask,
            alpha_coverage: false,
            face_shadow: face_map.is_some(),
            face_stack: face_map.is_some_and(|m| m.pitches_rad.len() > 1),
            face_back: face_map.is_some_and(|m| !m.back.is_empty()),
            face_masks: face_map.is_some_and(|m| !m.masks.is_empty()),
            transition: toon.is_some() && ramp.is_none() && material.transition.is_some_and(|t| t.strength > 0.0),
            face_paint: face_paint.is_some(),
            bangs_shadow: toon.is_some() && material.bangs_shadow.is_some(),
            lid_shadow: toon.is_some() && material.bangs_shadow.is_some_and(|b| b.lids),
            highlight: highlight.is_some(),
            highlight_second: highlight.is_some_and(|h| h.second_strength > 0.0),
            highlight_apart: highlight.is_some_and(|h| h.second_strength > 0.0 && h.second_motion != 1.0),
            highlight_breakup: highlight.is_some_and(|h| h.breakup > 0.0),
            layered: material.layer.is_some(),
            cast_shadow: toon.is_some() && material.cast_shadow.is_some_and(|s| s.received > 0.0),
            shade_ramp: ramp.is_some(),
            ramp_maps: ramp_maps.is_some(),
            ramp_parts: part_ids.is_some(),
            shade_shift: ramp.is_some_and(|r| r.maps.is_none() && r.shifts_shade()),
            light_response: toon.is_some() && material.light_response.is_some(),
            fur_detail: fur.is_some(),
            fur_color: fur.is_some_and(|f| f.detail_color.is_some()),
            depth_rim: toon.is_some() && material.depth_rim.is_some_and(|r| r.strength > 0.0),
            shaped_highlight: shaped.is_some(),
            shaped_map: shaped.is_some_and(|s| s.map.is_some()) && highlight.is_none(),
            shaped_brushed: shaped.is_some_and(|s| s.anisotropy > 0.0),
            sparkle: toon.is_some() && material.sparkle.is_some(),
            gem: gem.is_some(),
            gem_inclusions: gem.is_some_and(|g| g.inclusions.is_some()) && fur.is_none(),
            diamond: toon.is_some() && gem.is_none() && material.diamond.is_some(),
            fire: material.is_fire(),
            fire_map: material.is_fire() && material.fire.is_some_and(|f| f.heat.is_some()),
            emission_scroll: emission_texture.is_some() && material.emission.scroll_per_s != [0.0; 2],
            emission_blink: material.emission.blink.is_some(),
            stocking: toon.is_some() && material.stocking.is_some(),
            decals: toon.is_some() && material.decals.as_ref().is_some_and(|d| d.map.is_some() && !d.placed.is_empty()),
            dissolve: material.dissolve.is_some(),
            dither_fade: material.dither_fade.is_some(),
            dither_samples: false,
            rim_width: material.depth_rim.is_some_and(|r| r.width_mask.is_some()),
            rim_shade: material.depth_rim.is_some_and(|r| r.shade_color != [0.0; 3]),
            inner_lines: toon.is_some() && material.inner_lines.is_some(),
            hdr: false,
            channel: 0,
        }
    }

    /// Of passes that draw depth alone: what decides which pixels are there; `None` where all of them are, so that one
    /// pipeline serves all such materials.
    pub fn cut(&self, material: &Material) -> Option<Self> {
        let Self { base_texture, uv_transforms, uv_animation, uv_animation_mask, vertex_color, .. } = *self;
        let Self { dissolve, dither_fade, .. } = *self;
        let is_cut = material.alpha.mode != AlphaMode::Opaque || dissolve || dither_fade;
        is_cut.then(|| Self {
            base_texture,
            uv_transforms,
            uv_animation,
            uv_animation_mask,
            vertex_color,
            dissolve,
            dither_fade,
            ..Self::default()
        })
    }

    /// Values of the overrides of a pass that draws depth alone, by [`SurfaceFlags::cut`].
    pub fn cut_constants(cut: Option<Self>) -> Vec<(&'static str, f64)> {
        let mut constants = cut.unwrap_or_default().constants();
        constants.push(("ALPHA_TEST", f64::from(u8::from(cut.is_some()))));
        constants
    }

    /// What a pipeline with these draws into, if pictures go to `output`.
    pub fn output(&self, output: Output) -> Output {
        let format = if self.hdr { HDR_FORMAT } else { output.format };
        Output { format, ..output }
    }

    /// Values of the overrides of `wgsl/bind/options.wgsl`.
    pub fn constants(&self) -> Vec<(&'static str, f64)> {
        [
            ("UNLIT", self.unlit),
            ("BASE_TEXTURE", self.base_texture),
            ("SHADE_TEXTURE", self.shade_texture),
            ("SHADE_IS_BASE", self.shade_is_base),
            ("SHIFT_TEXTURE", self.shift_texture),
            ("NORMAL_MAP", self.normal_map),
            ("EMISSION_TEXTURE", self.emission_texture),
            ("MATCAP", self.matcap),
            ("RIM", self.rim),
            ("RIM_MASK", self.rim_mask),
            ("UV_TRANSFORMS", self.uv_transforms),
            ("UV_ANIMATION", self.uv_animation),
            ("UV_ANIMATION_MASK", self.uv_animation_mask),
            ("VERTEX_COLOR", self.vertex_color),
            ("ALPHA_MASK", self.alpha_mask),
            ("ALPHA_COVERAGE", self.alpha_coverage),
            ("FACE_SHADOW", self.face_shadow),
            ("FACE_STACK", self.face_stack),
            ("FACE_BACK", self.face_back),
            ("FACE_MASKS", self.face_masks),
            ("TRANSITION", self.transition),
            ("FACE_PAINT", self.face_paint),
            ("BANGS_SHADOW", self.bangs_shadow),
            ("LID_SHADOW", self.lid_shadow),
            ("HIGHLIGHT", self.highlight),
            ("HIGHLIGHT_SECOND", self.highlight_second),
            ("HIGHLIGHT_APART", self.highlight_apart),
            ("HIGHLIGHT_BREAKUP", self.highlight_breakup),
            ("LAYERED", self.layered),
            ("CAST_SHADOW", self.cast_shadow),
            ("SHADE_RAMP", self.shade_ramp),
            ("RAMP_MAPS", self.ramp_maps),
            ("RAMP_PARTS", self.ramp_parts),
            ("SHADE_SHIFT", self.shade_shift),
            ("LIGHT_RESPONSE", self.light_response),
            ("FUR_DETAIL", self.fur_detail),
            ("FUR_COLOR", self.fur_color),
            ("DEPTH_RIM", self.depth_rim),
            ("SHAPED_HIGHLIGHT", self.shaped_highlight),
            ("SHAPED_MAP", self.shaped_map),
            ("SHAPED_BRUSHED", self.shaped_brushed),
            ("SPARKLE", self.sparkle),
            ("GEM", self.gem),
            ("GEM_INCLUSIONS", self.gem_inclusions),
            ("DIAMOND", self.diamond),
            ("FIRE", self.fire),
            ("FIRE_MAP", self.fire_map),
            ("EMISSION_SCROLL", self.emission_scroll),
            ("EMISSION_BLINK", self.emission_blink),
            ("STOCKING", self.stocking),
            ("DECALS", self.decals),
            ("DISSOLVE", self.dissolve),
            ("DITHER_FADE", self.dither_fade),
            ("DITHER_SAMPLES", self.dither_samples),
            ("RIM_WIDTH", self.rim_width),
            ("RIM_SHADE", self.rim_shade),
            ("INNER_LINES", self.inner_lines),
        ]
        .map(|(name, on)| (name, f64::from(u8::from(on))))
        .into_iter()
        .chain([("CHANNEL", f64::from(self.channel))])
        .collect()
    }
}

/// Vertex streams, as `wgsl/bind/vertex.wgsl` reads them.
fn vertex_buffers() -> [Option<wgpu::VertexBufferLayout<'static>>; 3] {
    const DEFORMED: &[wgpu::VertexAttribute] = &wgpu::vertex_attr_array![0 => Float32x3, 1 => Uint32x3];
    const STATIC: &[wgpu::VertexAttribute] = &wgpu::vertex_attr_array![2 => Float32x4, 3 => Unorm8x4, 4 => Uint32];
    const INSTANCE: &[wgpu::VertexAttribute] =
        &wgpu::vertex_attr_array![5 => Float32x4, 6 => Float32x4, 7 => Float32x4];
    let layout =
        |array_stride, step_mode, attributes| Some(wgpu::VertexBufferLayout { array_stride, step_mode, attributes });
    [
        layout(24, wgpu::VertexStepMode::Vertex, DEFORMED),
        layout(24, wgpu::VertexStepMode::Vertex, STATIC),
        layout(48, wgpu::VertexStepMode::Instance, INSTANCE),
    ]
}

/// What differs between the pipelines that draw surfaces.
pub(crate) struct SurfacePipeline<'a> {
    pub label: &'a str,
    pub module: &'a wgpu::ShaderModule,
    pub vertex: &'a str,
    /// Entry point; `None` draws depth alone.
    pub fragment: Option<&'a str>,
    pub constants: &'a [(&'a str, f64)],
    pub cull: Option<wgpu::Face>,
    pub depth: Option<wgpu::DepthStencilState>,
    pub samples: u32,
    pub targets: &'a [Option<wgpu::ColorTargetState>],
}

/// Pipeline of a pass that draws surfaces.
pub(crate) fn surface_pipeline(gpu: &Gpu, layouts: &Layouts, desc: &SurfacePipeline<'_>) -> wgpu::RenderPipeline {
    let options = || wgpu::PipelineCompilationOptions { constants: desc.constants, ..Default::default() };
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(desc.label),
        layout: Some(&layouts.surface),
        vertex: wgpu::VertexState {
            module: desc.module,
            entry_point: Some(desc.vertex),
            compilation_options: options(),
            buffers: &vertex_buffers(),
        },
        primitive: wgpu::PrimitiveState { cull_mode: desc.cull, ..Default::default() },
        depth_stencil: desc.depth.clone(),
        multisample: wgpu::MultisampleState { count: desc.samples, ..Default::default() },
        fragment: desc.fragment.map(|entry| wgpu::FragmentState {
            module: desc.module,
            entry_point: Some(entry),
            compilation_options: options(),
            targets: desc.targets,
        }),
        multiview_mask: None,
        cache: None,
    })
}

/// What differs between the pipelines that draw surfaces into the colour target.
pub(crate) struct ColorPipeline<'a> {
    pub label: &'a str,
    pub module: &'a wgpu::ShaderModule,
    pub fragment: &'a str,
    pub constants: &'a [(&'a str, f64)],
    pub cull: Option<wgpu::Face>,
    pub blend: bool,
    pub write_depth: bool,
    pub mark: Mark,
}

/// Pipeline of a pass that draws into the colour target.
pub(crate) fn color_pipeline(
    gpu: &Gpu,
    layouts: &Layouts,
    output: Output,
    desc: &ColorPipeline<'_>,
) -> wgpu::RenderPipeline {
    let depth = wgpu::DepthStencilState {
        format: color_depth_format(gpu),
        stencil: desc.mark.stencil(),
        ..depth_state(desc.write_depth)
    };
    surface_pipeline(
        gpu,
        layouts,
        &SurfacePipeline {
            label: desc.label,
            module: desc.module,
            vertex: "vs_main",
            fragment: Some(desc.fragment),
            constants: desc.constants,
            cull: desc.cull,
            depth: Some(depth),
            samples: output.samples,
            targets: &[Some(wgpu::ColorTargetState {
                format: output.format,
                blend: desc.blend.then_some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING),
                write_mask: wgpu::ColorWrites::ALL,
            })],
        },
    )
}

/// Adds to what is there.
pub(crate) const ADD: wgpu::BlendState = {
    let add = wgpu::BlendComponent {
        src_factor: wgpu::BlendFactor::One,
        dst_factor: wgpu::BlendFactor::One,
        operation: wgpu::BlendOperation::Add,
    };
    wgpu::BlendState { color: add, alpha: add }
};

/// Depth test of maps that are drawn from a light.
pub(crate) fn map_depth_state(slope_scale: f32) -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format: DEPTH_FORMAT,
        depth_write_enabled: Some(true),
        depth_compare: Some(wgpu::CompareFunction::Less),
        stencil: wgpu::StencilState::default(),
        bias: wgpu::DepthBiasState { constant: 0, slope_scale, clamp: 0.0 },
    }
}

/// Reverse-Z depth test.
pub(crate) fn depth_state(write: bool) -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format: DEPTH_FORMAT,
        depth_write_enabled: Some(write),
        depth_compare: Some(wgpu::CompareFunction::GreaterEqual),
        stencil: wgpu::StencilState::default(),
        bias: wgpu::DepthBiasState::default(),
    }
}

/// Culling of a surface.
pub(crate) fn surface_cull(material: &Material) -> Option<wgpu::Face> {
    (!material.double_sided).then_some(wgpu::Face::Back)
}

/// Whether the shader must encode sRGB because the target does not.
pub(crate) fn encode_constant(output: Output) -> (&'static str, f64) {
    let holds_linear = output.format.is_srgb() || output.format == HDR_FORMAT;
    ("ENCODE_SRGB", if holds_linear { 0.0 } else { 1.0 })
}
