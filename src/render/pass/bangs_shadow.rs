//! Depth of what casts on the face, seen from the light of the bangs' shadow.

use std::ops::Range;

use glam::{Mat4, Vec3, Vec4};

use super::bangs_near::{self, BangsNearInputs, BangsNearPass};
use super::{DEPTH_FORMAT, map_request};
use crate::Gpu;
use crate::gpu::MAX_TEXTURE_SIDE;
use crate::render::draw_list::{Actors, Draw, Triangles};
use crate::render::material::Composition;
use crate::render::targets;
use crate::render::variants::{Drawn, Request};
use crate::scene::Bangs;
use crate::stage::troupe::Troupe;

/// Depth of the nearest hair, 0..1 over the range.
pub(crate) const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R32Float;

/// Heads of one character that have a page each, where their maps are what they would be alone; more share one.
const MOST_PAGES: usize = 8;

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

/// The maps of several actors of a character: a tile for each.
#[derive(Debug)]
pub(crate) struct BangsAtlas {
    /// Texels along a tile, and between two.
    side: u32,
    stride: u32,
    columns: u32,
    tiles: usize,
    /// Tiles of a page.
    on_page: usize,
    /// Maps of a tile: what casts on the face, and lids where something receives their shadow.
    kinds: usize,
    /// The maps as shaders read them: what casts on the face, then lids and lashes where something receives their shadow.
    pub view: wgpu::TextureView,
    /// Nearest depths of their blocks.
    pub near: wgpu::TextureView,
    layers: Vec<Layer>,
    depth: wgpu::TextureView,
}

/// Where the tile of an actor lies.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct BangsTile {
    /// First texel, and texels along a side.
    pub origin: [f32; 2],
    pub side: f32,
    /// First layer of its page.
    pub layer: f32,
}

/// One layer of the maps as passes draw them.
#[derive(Debug)]
struct Layer {
    map: wgpu::TextureView,
    near: wgpu::TextureView,
    near_input: wgpu::BindGroup,
}

/// What the pass reads and writes: the maps of a troupe.
pub(crate) struct BangsShadowInputs<'a> {
    pub actors: Actors<'a>,
    pub reduce: &'a BangsNearPass,
    pub atlas: &'a BangsAtlas,
    pub of: &'a Troupe,
}

impl BangsFit {
    /// Texels along a side: one is a third of the soft edge; the shader's box is three wide.
    fn side(&self) -> u32 {
        let texel = self.bangs.soft_width_m / 3.0;
        ((2.0 * self.half / texel).ceil() as u32).clamp(32, 1024)
    }

    /// Texels from one tile to the next: whole blocks, two at least between tiles.
    fn stride(&self) -> u32 {
        (self.side() + 2).next_multiple_of(bangs_near::BLOCK)
    }

    /// Tiles that an atlas may have.
    pub fn most_tiles(&self) -> usize {
        (MAX_TEXTURE_SIDE / self.stride()).pow(2) as usize
    }

    /// Axes of the head in the pose: left, up, forward. `head` moves it from its rest.
    fn axes(head: Mat4) -> [Vec3; 3] {
        [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| head.transform_vector3(axis).normalize_or(axis))
    }

    /// Where the light of the shadow stands, character space; `to_light` is the key light.
    pub fn light_direction(&self, head: Mat4, to_light: Vec3) -> Vec3 {
        let [left, up, forward] = Self::axes(head);
        let [yaw, pitch] = self.bangs.direction_rad.unwrap_or_else(|| {
            let light = to_light.normalize_or(forward);
            let (x, y, z) = (light.dot(left), light.dot(up), light.dot(forward));
            let held = |angle: f32, low: f32, high: f32| angle.clamp(low.to_radians(), high.to_radians());
            [held(x.atan2(z), -25.0, 25.0), held(y.clamp(-1.0, 1.0).asin(), 25.0, 40.0)]
        });
        left * (yaw.sin() * pitch.cos()) + up * pitch.sin() + forward * (yaw.cos() * pitch.cos())
    }

    /// Rows of the map from character space.
    pub fn rows(&self, head: Mat4, to_light: Vec3) -> [Vec4; 3] {
        let [left, up, _] = Self::axes(head);
        let direction = self.light_direction(head, to_light);
        let right = up.cross(direction).normalize_or(left);
        let top = direction.cross(right);
        let middle = head.transform_point3(self.middle);
        let width = 2.0 * self.half;
        let row = |axis: Vec3, scale: f32| (axis * scale).extend(0.5 - axis.dot(middle) * scale);
        // The camera stands one width before the middle; its range is twice its width.
        [row(right, 1.0 / width), row(top, -1.0 / width), row(direction, -0.5 / width)]
    }

    /// Hardness and bias, per unit of depth and in units of depth.
    pub fn test(&self) -> [f32; 2] {
        [self.bangs.hardness, self.bangs.bias_m / (4.0 * self.half)]
    }
}

impl BangsAtlas {
    /// Room for the maps of so many heads.
    pub fn new(gpu: &Gpu, reduce: &BangsNearPass, fit: &BangsFit, tiles: usize) -> Self {
        let (side, stride) = (fit.side(), fit.stride());
        let on_page = if tiles > MOST_PAGES { tiles } else { 1 };
        let pages = tiles.div_ceil(on_page) as u32;
        let columns = ((on_page as f64).sqrt().ceil() as u32).clamp(1, MAX_TEXTURE_SIDE / stride);
        let rows = (on_page as u32).div_ceil(columns).max(1);
        // Of a single tile, its border is that of the texture.
        let size = [columns, rows].map(|n| (n - 1) * stride + side);
        let kinds = if fit.lids { 2 } else { 1 };
        let count = kinds * pages;
        let view = targets::layers(gpu, "bangs", size, count, FORMAT);
        let near = targets::layers(gpu, "bangs near", size.map(|s| s.div_ceil(bangs_near::BLOCK)), count, FORMAT);
        let layers = (0..count)
            .map(|i| {
                let map = targets::layer(&view, i);
                Layer { near_input: reduce.group(gpu, &map), map, near: targets::layer(&near, i) }
            })
            .collect();
        let depth = targets::layers(gpu, "bangs depth", size, 1, DEPTH_FORMAT);
        let kinds = kinds as usize;
        Self { side, stride, columns, tiles, on_page, kinds, layers, near, view, depth }
    }

    /// How many tiles it has room for.
    pub fn tiles(&self) -> usize {
        self.tiles
    }

    /// Where the tile of a slot lies.
    pub fn place(&self, slot: u32) -> BangsTile {
        let (page, tile) = (self.page(slot), slot % self.on_page as u32);
        let origin = [tile % self.columns, tile / self.columns].map(|n| (n * self.stride) as f32);
        BangsTile { origin, side: self.side as f32, layer: (page * self.kinds) as f32 }
    }

    /// The page of a slot.
    fn page(&self, slot: u32) -> usize {
        slot as usize / self.on_page
    }
}

/// A map without hair, for characters that have none; [`BangsAtlas`] makes those that are drawn.
pub(crate) fn map_texture(gpu: &Gpu, side: u32, layers: u32) -> wgpu::TextureView {
    targets::layers(gpu, "bangs", [side; 2], layers, FORMAT)
}

/// What draws a material.
pub(crate) fn request(of: &Composition, colors: bool) -> Request {
    map_request(of.cut("bangs_shadow", colors, false).with("depth", true), 0.0, Some(FORMAT))
}

/// Draws what casts on the faces of a troupe: front hair, clothes, hands, and all of others; then their lids and lashes.
pub(crate) fn encode(
    encoder: &mut wgpu::CommandEncoder,
    inputs: &BangsShadowInputs<'_>,
    timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
) {
    let last = inputs.atlas.layers.len() - 1;
    for (i, layer) in inputs.atlas.layers.iter().enumerate() {
        // From the beginning of the first pass to the end of the last.
        let begin = timestamps.clone().filter(|_| i == 0);
        let end = timestamps.clone().filter(|_| i == last);
        let begin = begin.map(|t| wgpu::RenderPassTimestampWrites { end_of_pass_write_index: None, ..t });
        let end = end.map(|t| wgpu::RenderPassTimestampWrites { beginning_of_pass_write_index: None, ..t });
        encode_layer(encoder, inputs, i, begin);
        inputs.reduce.encode(encoder, &BangsNearInputs { map: &layer.near_input, near: &layer.near }, end);
    }
}

/// The second map of a tile holds what casts on the eyes instead of on the face.
fn encode_layer(
    encoder: &mut wgpu::CommandEncoder,
    inputs: &BangsShadowInputs<'_>,
    index: usize,
    timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
) {
    let BangsShadowInputs { actors, of, atlas, .. } = inputs;
    let (page, lids) = (index / atlas.kinds, !index.is_multiple_of(atlas.kinds));
    // No hair: behind everything.
    let map = targets::color(&atlas.layers[index].map, wgpu::LoadOp::Clear(wgpu::Color::WHITE));
    let depth = targets::depth(&inputs.atlas.depth, 1.0, wgpu::StoreOp::Discard);
    let mut pass = targets::begin(encoder, "bangs shadow", Some(map), Some(depth), timestamps);
    let casts = |draw: &Draw| if lids { draw.casts_lids } else { draw.casts_on_face };
    let all: Vec<Vec<Merged<'_>>> = actors.bodies.troupes.iter().map(|t| merged(t, |_| true)).collect();
    let own = merged(of, casts);
    let mut bound: *const Troupe = std::ptr::null();
    let mut bind = |pass: &mut wgpu::RenderPass<'_>, troupe: &Troupe| {
        if !std::ptr::eq(bound, troupe) {
            // The map itself cannot be read while it is drawn.
            actors.bind_without_maps(pass, troupe);
            bound = troupe;
        }
    };
    let on_page = of.instances.clone().map(|at| actors.body(at)).filter(|body| atlas.page(body.slot()) == page);
    for body in on_page {
        let BangsTile { origin: [x, y], side, .. } = atlas.place(body.slot());
        pass.set_viewport(x, y, side, side, 0.0, 1.0);
        pass.set_scissor_rect(x as u32, y as u32, side as u32, side as u32);
        bind(&mut pass, of);
        for draw in &own {
            actors.record(
                &mut pass,
                of,
                Triangles::third(draw.indices.clone()),
                draw.drawn,
                body.instance..body.instance + 1,
            );
        }
        for &(other, instance) in body.face_casters.iter().filter(|_| !lids) {
            let troupe = &actors.bodies.troupes[other];
            bind(&mut pass, troupe);
            for draw in &all[other] {
                actors.record(
                    &mut pass,
                    troupe,
                    Triangles::third(draw.indices.clone()),
                    draw.drawn,
                    instance..instance + 1,
                );
            }
        }
    }
}

/// Draws that one pipeline draws together.
struct Merged<'a> {
    indices: Range<u32>,
    drawn: &'a Drawn,
}

/// What of a character casts.
fn merged(troupe: &Troupe, casts: impl Fn(&Draw) -> bool) -> Vec<Merged<'_>> {
    let data = troupe.data();
    let draws = data.draws.iter().zip(data.picture()).filter(|(draw, _)| casts(draw));
    let mut draws: Vec<_> = draws.filter_map(|(draw, p)| Some((draw, p.bangs.as_ref()?))).collect();
    draws.sort_by_key(|(draw, drawn)| (drawn.bound.is_some(), draw.indices.start));
    let mut list: Vec<Merged<'_>> = Vec::new();
    for (draw, drawn) in draws {
        match list.last_mut() {
            // What is not cut reads nothing of its material.
            Some(last)
                if last.indices.end == draw.indices.start
                    && last.drawn.bound.is_none()
                    && drawn.bound.is_none()
                    && last.drawn.pipeline == drawn.pipeline =>
            {
                last.indices.end = draw.indices.end;
            }
            _ => list.push(Merged { indices: draw.indices.clone(), drawn }),
        }
    }
    list
}
