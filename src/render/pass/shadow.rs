//! Depth of characters from the key light, for the shadows of each on itself and of those beside it.

use std::ops::Range;

use glam::Vec3;

use super::{DEPTH_FORMAT, map_request};
use crate::Gpu;
use crate::render::draw_list::Actors;
use crate::render::material::Composition;
use crate::render::targets;
use crate::render::variants::{Drawn, Request};
use crate::scene::SelfShadow;

/// How a character's map fits it.
#[derive(Debug)]
pub(crate) struct ShadowFit {
    pub settings: SelfShadow,
    /// Middle and radius of the sphere round it at rest, character space, metres.
    pub middle: Vec3,
    pub radius: f32,
}

/// The maps of a stage, a layer for each actor that has one.
#[derive(Debug)]
pub(crate) struct ShadowMap {
    /// As shaders read it.
    pub view: wgpu::TextureView,
    layers: Vec<wgpu::TextureView>,
}

/// How shaders find their place in the maps.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ShadowRows {
    /// World axes, unit.
    pub right: Vec3,
    pub up: Vec3,
    pub to_light: Vec3,
    /// One over the width, metres.
    pub scale: f32,
    /// Shares of the width.
    pub bias: f32,
    pub spread: f32,
    /// World space.
    pub middle: Vec3,
    /// Layer of the map, where there is one.
    pub layer: Option<u32>,
}

/// What the pass reads and writes: a layer of the map.
pub(crate) struct ShadowInputs<'a> {
    pub actors: Actors<'a>,
    pub map: &'a ShadowMap,
    pub layer: u32,
    /// By troupe and draw; `None` leaves it out.
    pub drawn: &'a dyn Fn(usize, usize) -> Option<&'a Drawn>,
}

/// Radius beyond which a map has twice the texels along a side, so that long arms do not coarsen the face, metres.
const WIDE_M: f32 = 1.2;

impl ShadowFit {
    /// Texels along a side that it asks for.
    pub fn side(&self) -> u32 {
        let settings = self.settings.side;
        if self.radius > WIDE_M {
            (2 * settings).min(4096)
        } else {
            settings
        }
    }

    /// Places in a map while the middle stands there and the light so, in the world; `scale` is that of the actor.
    pub fn rows(&self, side: u32, middle: Vec3, scale: f32, to_light: Vec3) -> ShadowRows {
        let to_light = to_light.normalize_or(Vec3::Z);
        // The camera's up is the world's, unless the light comes from there.
        let right = Vec3::Y.cross(to_light).try_normalize().filter(|r| r.is_finite()).unwrap_or(Vec3::X);
        let texel = 1.0 / side as f32;
        let width = 2.0 * self.radius;
        ShadowRows {
            right,
            up: to_light.cross(right),
            to_light,
            scale: 1.0 / width / scale,
            bias: self.settings.bias_texels / self.settings.side as f32,
            // The shader weighs eight texels along a side.
            spread: (self.settings.soft_width_m / width).clamp(3.0 * texel, 5.0 * texel),
            middle,
            layer: None,
        }
    }
}

impl ShadowRows {
    /// `StageShadow` of `wgsl/lib/shadow.wgsl`.
    pub fn numbers(&self) -> [[f32; 4]; 4] {
        let row = |v: Vec3, n: f32| v.extend(n).to_array();
        let layer = self.layer.map_or(-1.0, |layer| layer as f32);
        [row(self.right, self.scale), row(self.up, self.bias), row(self.to_light, self.spread), row(self.middle, layer)]
    }
}

impl ShadowMap {
    /// Makes room for so many layers; whether there are other ones now.
    pub fn fit(map: &mut Option<Self>, gpu: &Gpu, side: u32, wanted: u32) -> bool {
        if map.as_ref().is_some_and(|m| m.side() == side && m.layers.len() as u32 >= wanted) {
            return false;
        }
        let view = map_texture(gpu, side, wanted);
        let layers = (0..wanted).map(|i| targets::layer(&view, i)).collect();
        *map = Some(Self { view, layers });
        true
    }

    /// How many there are.
    pub fn layers(&self) -> usize {
        self.layers.len()
    }

    /// Texels along a side.
    pub fn side(&self) -> u32 {
        self.view.texture().width()
    }
}

/// Maps without a character.
pub(crate) fn map_texture(gpu: &Gpu, side: u32, layers: u32) -> wgpu::TextureView {
    targets::layers(gpu, "shadow", [side; 2], layers, DEPTH_FORMAT)
}

/// Compares a receiver with the map: lit where nothing is nearer to the light.
pub(crate) fn sampler(gpu: &Gpu) -> wgpu::Sampler {
    gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("shadow"),
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        compare: Some(wgpu::CompareFunction::LessEqual),
        ..Default::default()
    })
}

/// What draws a material that casts. Surfaces along the light are moved by their own slope.
pub(crate) fn request(of: &Composition, colors: bool) -> Request {
    map_request(of.cut("shadow", colors, false), 1.5, None)
}

/// Draws what casts into a layer: instances of troupes.
pub(crate) fn encode(
    encoder: &mut wgpu::CommandEncoder,
    inputs: ShadowInputs<'_>,
    casters: impl Iterator<Item = (usize, Range<u32>)>,
    timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
) {
    let ShadowInputs { actors, map, layer, drawn } = inputs;
    let depth = targets::depth(&map.layers[layer as usize], 1.0, wgpu::StoreOp::Store);
    let mut pass = targets::begin(encoder, "shadow", None, Some(depth), timestamps);
    for (of, instances) in casters {
        let troupe = &actors.bodies.troupes[of];
        // The map itself cannot be read while it is drawn.
        actors.bind_without_maps(&mut pass, troupe);
        for (i, draw) in troupe.data().draws.iter().enumerate() {
            if let Some(shadow) = drawn(of, i) {
                actors.record(&mut pass, troupe, draw.triangles(), shadow, instances.clone());
            }
        }
    }
}
