//! Depth of what casts on the face, seen from the light of the bangs' shadow.

use glam::{Mat4, Vec3, Vec4};

use super::bangs_near::{self, BangsNearInputs, BangsNearPass};
use super::{DEPTH_FORMAT, map_request};
use crate::Gpu;
use crate::render::draw_list::{self, Actors, Draw};
use crate::render::material::Composition;
use crate::render::targets;
use crate::render::variants::Request;
use crate::scene::Bangs;
use crate::stage::body::Body;

/// Depth of the nearest hair, 0..1 over the range.
pub(crate) const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R32Float;

/// How the map of a character fits its head.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BangsFit {
    pub bangs: Bangs,
    /// Middle and half width of the camera's picture at rest, character space, metres.
    pub middle: Vec3,
    pub half: f32,
    /// Whether something receives the shadow of lids and lashes.
    pub lids: bool,
}

/// The map of one actor and the camera that draws it.
#[derive(Debug)]
pub(crate) struct BangsMap {
    fit: BangsFit,
    /// The map as shaders read it: what casts on the face, then lids and lashes where something receives their shadow.
    pub view: wgpu::TextureView,
    /// Nearest depths of its blocks.
    pub near: wgpu::TextureView,
    layers: Vec<Layer>,
    depth: wgpu::TextureView,
}

/// One layer of the map as passes draw it.
#[derive(Debug)]
struct Layer {
    map: wgpu::TextureView,
    near: wgpu::TextureView,
    near_input: wgpu::BindGroup,
}

/// What the pass reads and writes: the map of a body.
pub(crate) struct BangsShadowInputs<'a> {
    pub actors: Actors<'a>,
    pub reduce: &'a BangsNearPass,
    pub map: &'a BangsMap,
    pub of: &'a Body,
}

impl BangsMap {
    /// A map for a head of this place and size. A texel is a third of the soft edge; the shader's box is three wide.
    pub fn new(gpu: &Gpu, reduce: &BangsNearPass, fit: BangsFit) -> Self {
        let BangsFit { bangs, half, lids, .. } = fit;
        let texel = bangs.soft_width_m / 3.0;
        let side = ((2.0 * half / texel).ceil() as u32).clamp(32, 1024);
        let count = if lids { 2 } else { 1 };
        let view = map_texture(gpu, side, count);
        let near = map_texture(gpu, side.div_ceil(bangs_near::BLOCK), count);
        let layers = (0..count)
            .map(|i| {
                let map = targets::layer(&view, i);
                Layer { near_input: reduce.group(gpu, &map), map, near: targets::layer(&near, i) }
            })
            .collect();
        Self { fit, layers, near, view, depth: targets::layers(gpu, "bangs depth", side, 1, DEPTH_FORMAT) }
    }

    /// Rows of the map from character space. `head` moves the head from its rest; `to_light` is in character space.
    pub fn rows(&self, head: Mat4, to_light: Vec3) -> [Vec4; 3] {
        let turned = |axis: Vec3| head.transform_vector3(axis).normalize_or(axis);
        let (left, up, forward) = (turned(Vec3::X), turned(Vec3::Y), turned(Vec3::Z));
        let [yaw, pitch] = self.fit.bangs.direction_rad.unwrap_or_else(|| {
            let light = to_light.normalize_or(forward);
            let (x, y, z) = (light.dot(left), light.dot(up), light.dot(forward));
            let held = |angle: f32, low: f32, high: f32| angle.clamp(low.to_radians(), high.to_radians());
            [held(x.atan2(z), -35.0, 35.0), held(y.clamp(-1.0, 1.0).asin(), 10.0, 40.0)]
        });
        let direction = left * (yaw.sin() * pitch.cos()) + up * pitch.sin() + forward * (yaw.cos() * pitch.cos());
        let right = up.cross(direction).normalize_or(left);
        let top = direction.cross(right);
        let middle = head.transform_point3(self.fit.middle);
        let width = 2.0 * self.fit.half;
        let row = |axis: Vec3, scale: f32| (axis * scale).extend(0.5 - axis.dot(middle) * scale);
        // The camera stands one width before the middle; its range is twice its width.
        [row(right, 1.0 / width), row(top, -1.0 / width), row(direction, -0.5 / width)]
    }

    /// Hardness and bias, per unit of depth and in units of depth.
    pub fn test(&self) -> [f32; 2] {
        [self.fit.bangs.hardness, self.fit.bangs.bias_m / (4.0 * self.fit.half)]
    }
}

/// A map without hair, for characters that have none; [`BangsMap`] makes those that are drawn.
pub(crate) fn map_texture(gpu: &Gpu, side: u32, layers: u32) -> wgpu::TextureView {
    targets::layers(gpu, "bangs", side, layers, FORMAT)
}

/// What draws a material.
pub(crate) fn request(of: &Composition, colors: bool) -> Request {
    map_request(of.cut("bangs_shadow", colors, false).with("depth", true), 0.0, Some(FORMAT))
}

/// Draws what casts on the face of an actor: front hair, clothes, hands, and all of others; then its lids and lashes.
pub(crate) fn encode(
    encoder: &mut wgpu::CommandEncoder,
    inputs: &BangsShadowInputs<'_>,
    timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
) {
    let last = inputs.map.layers.len() - 1;
    for (i, layer) in inputs.map.layers.iter().enumerate() {
        // From the beginning of the first pass to the end of the last.
        let begin = timestamps.clone().filter(|_| i == 0);
        let end = timestamps.clone().filter(|_| i == last);
        let begin = begin.map(|t| wgpu::RenderPassTimestampWrites { end_of_pass_write_index: None, ..t });
        let end = end.map(|t| wgpu::RenderPassTimestampWrites { beginning_of_pass_write_index: None, ..t });
        encode_layer(encoder, inputs, &layer.map, i > 0, begin);
        inputs.reduce.encode(encoder, &BangsNearInputs { map: &layer.near_input, near: &layer.near }, end);
    }
}

/// `lids`: what casts on the eyes instead of on the face.
fn encode_layer(
    encoder: &mut wgpu::CommandEncoder,
    inputs: &BangsShadowInputs<'_>,
    layer: &wgpu::TextureView,
    lids: bool,
    timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
) {
    let BangsShadowInputs { actors, of, .. } = inputs;
    // No hair: behind everything.
    let map = targets::color(layer, wgpu::LoadOp::Clear(wgpu::Color::WHITE));
    let depth = targets::depth(&inputs.map.depth, 1.0, wgpu::StoreOp::Discard);
    let mut pass = targets::begin(encoder, "bangs shadow", Some(map), Some(depth), timestamps);
    let casts = |draw: &Draw| if lids { draw.casts_lids } else { draw.casts_on_face };
    let others = of.casters.iter().filter(|_| !lids);
    let others = others.map(|&(other, instance)| (&actors.bodies[other], instance..instance + 1, false));
    for (body, instances, is_own) in std::iter::once((*of, of.instance(), true)).chain(others) {
        // The map itself cannot be read while it is drawn.
        actors.bind_without_maps(&mut pass, body);
        let data = body.data();
        for (draw, pipelines) in data.draws.iter().zip(data.picture()).filter(|(draw, _)| !is_own || casts(draw)) {
            if let Some(bangs) = &pipelines.bangs {
                draw_list::record(&mut pass, body, draw, bangs, instances.clone());
            }
        }
    }
}
