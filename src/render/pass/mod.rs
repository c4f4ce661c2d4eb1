//! Passes: one file each, with the shader of the same stem in `wgsl/pass/`; what they share stands here.

pub(crate) mod background;
pub(crate) mod bangs_near;
pub(crate) mod bangs_shadow;
pub(crate) mod bloom;
pub(crate) mod deform;
pub(crate) mod eyes_through;
pub(crate) mod fibre;
pub(crate) mod floor;
pub(crate) mod fluff;
pub(crate) mod glow;
pub(crate) mod ground;
pub(crate) mod irradiance;
pub(crate) mod irradiance_uv;
pub(crate) mod opaque;
pub(crate) mod outline;
pub(crate) mod post;
pub(crate) mod prepass;
pub(crate) mod resolve;
pub(crate) mod scatter;
pub(crate) mod scatter_uv;
pub(crate) mod shadow;
pub(crate) mod temporal;
pub(crate) mod transparent;
pub(crate) mod velocity;
pub(crate) mod weighted;

use super::shaders::Recipe;
use super::variants::{Request, State};
use super::{Far, Output};
use crate::Gpu;
use crate::material::{Blending, Material};

/// Depth format of the prepass; of the colour pass where the device has no stencil beside 32 bits of depth.
pub(crate) const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Colour of frames that are finished by [`post`], and of light.
pub(crate) const HDR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

/// Depth format of the colour pass where the device has it.
pub(crate) const DEPTH_STENCIL_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32FloatStencil8;

/// Depth format of the colour pass.
pub(crate) fn color_depth_format(gpu: &Gpu) -> wgpu::TextureFormat {
    if gpu.device.features().contains(wgpu::Features::DEPTH32FLOAT_STENCIL8) {
        DEPTH_STENCIL_FORMAT
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

    /// Reference value of the stencil for the actor of this number: hair is marked with it, and shows its own eyes alone.
    /// On a stage larger than there are numbers, some share one.
    pub fn reference(self, number: u32) -> u32 {
        match self {
            Self::None => 0,
            Self::Eyes => EYES_BIT,
            Self::Hair => HAIR_BIT | (number % Self::NUMBERS),
            Self::Through => EYES_BIT | HAIR_BIT | (number % Self::NUMBERS),
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

/// What the passes of a picture draw into, and what it shows.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Picture<'a> {
    /// That of the application, or half floats that [`post`] finishes.
    pub output: Output,
    pub depth_format: wgpu::TextureFormat,
    pub sight: Sight<'a>,
}

/// What of a picture its shaders are made for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct Sight<'a> {
    /// Debug channel in place of the colour.
    pub channel: Option<&'a str>,
    /// Whether point and spot lights may shine; drivers without jumps pay for lights that are not there.
    pub punctual: bool,
    /// Whether light comes from a picture all around; the same drivers would read it where there is none.
    pub environment: bool,
    /// Whether it is drawn in half floats, which [`post`] finishes.
    pub hdr: bool,
}

impl<'a> Picture<'a> {
    pub fn new(gpu: &Gpu, output: Output, sight: Sight<'a>) -> Self {
        let format = if sight.hdr { HDR_FORMAT } else { output.format };
        Self { output: Output { format, ..output }, depth_format: output.depth_format(gpu), sight }
    }

    /// The request of a pass that draws surfaces into it.
    pub fn request(&self, recipe: Recipe, drawn: Drawing) -> Request {
        let mut recipe = recipe
            .with("encode_srgb", encodes_srgb(self.output.format))
            .with("punctual", self.sight.punctual)
            .with("environment", self.sight.environment)
            .with("host_depth", self.output.depth.is_some());
        if let Some(channel) = self.sight.channel {
            recipe = recipe.with("channel", true).with(&format!("channel_{}", channel.replace('-', "_")), true);
        }
        let Drawing { cull, blend, write_depth, mark } = drawn;
        let depth = wgpu::DepthStencilState {
            format: self.depth_format,
            depth_compare: Some(self.nearer(false)),
            stencil: mark.stencil(),
            ..depth_state(write_depth)
        };
        let target = wgpu::ColorTargetState {
            format: self.output.format,
            blend: blend.then_some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING),
            write_mask: wgpu::ColorWrites::ALL,
        };
        let state = State { cull, depth: Some(depth), samples: self.output.samples, targets: vec![target] };
        Request { recipe, state }
    }

    /// The depth test; a strict one leaves what is as near.
    fn nearer(&self, strict: bool) -> wgpu::CompareFunction {
        use wgpu::CompareFunction as C;
        match (self.output.depth.map_or(Far::Zero, |depth| depth.far), strict) {
            (Far::Zero, false) => C::GreaterEqual,
            (Far::Zero, true) => C::Greater,
            (Far::One, false) => C::LessEqual,
            (Far::One, true) => C::Less,
        }
    }

    /// The request of a pass that draws surfaces only where they are nearer than what is there.
    pub fn strict_request(&self, recipe: Recipe, drawn: Drawing) -> Request {
        let mut request = self.request(recipe, drawn);
        if let Some(depth) = &mut request.state.depth {
            depth.depth_compare = Some(self.nearer(true));
        }
        request
    }

    /// Whether a cut or a fade can cover part of a pixel.
    pub fn has_samples(&self) -> bool {
        self.output.samples == 4
    }
}

/// How a pass draws into a [`Picture`].
pub(crate) struct Drawing {
    pub cull: Option<wgpu::Face>,
    pub blend: bool,
    pub write_depth: bool,
    pub mark: Mark,
}

/// A request of a pass that draws depth from a light.
pub(crate) fn map_request(recipe: Recipe, slope_scale: f32, target: Option<wgpu::TextureFormat>) -> Request {
    // Cards have no back.
    let targets = target.map(Into::into).into_iter().collect();
    let state = State { cull: None, depth: Some(map_depth_state(slope_scale)), samples: 1, targets };
    Request { recipe, state }
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
fn map_depth_state(slope_scale: f32) -> wgpu::DepthStencilState {
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
    let has_back = material.double_sided || material.blending() == Blending::ThreePass;
    (!has_back).then_some(wgpu::Face::Back)
}

/// Whether the shader must encode sRGB because the target does not. Floats stay linear.
pub(crate) fn encodes_srgb(format: wgpu::TextureFormat) -> bool {
    use wgpu::TextureFormat as F;
    !(format.is_srgb() || matches!(format, F::Rgba16Float | F::Rgba32Float | F::Rg11b10Ufloat))
}
