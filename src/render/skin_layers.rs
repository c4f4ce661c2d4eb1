//! Light that scatters in skin, over its texture coordinates: a layer for each material of each actor, read by the
//! colour of skin.

use glam::Vec2;

use super::draw_list::Actors;
use super::made::Made;
use super::pass::irradiance_uv::{self, LAYER_SIDE, UvTargets, layer_uv};
use super::pass::scatter_uv::ScatterUvPass;
use super::pass::{HDR_FORMAT, Sight};
use super::uploads::Uploads;
use super::{Renderer, bind, targets};
use crate::scene::Scene;
use crate::skin::Seams;
use crate::stage::maps::SkinKey;
use crate::{Gpu, Result};

/// Layers of a stage.
pub(crate) const MOST_LAYERS: u32 = 16;
/// Texels from a seam over which it is looked for.
const MOST_REACH: f32 = 256.0;

/// Those of a stage.
#[derive(Debug)]
pub(crate) struct SkinLayers {
    /// As shaders read them, and one by one.
    made: Option<(wgpu::TextureView, Vec<wgpu::TextureView>)>,
    /// Whether there are too few.
    pub lacks: bool,
    /// What they were drawn from.
    pub drawn: Made<SkinKey, ()>,
}

impl Default for SkinLayers {
    fn default() -> Self {
        Self { made: None, lacks: false, drawn: Made::not_yet(()) }
    }
}

impl SkinLayers {
    /// Makes room for so many.
    pub fn fit(&mut self, gpu: &Gpu, wanted: u32) {
        if wanted as usize > self.made.as_ref().map_or(0, |(_, layers)| layers.len()) {
            let count = wanted.next_power_of_two().min(MOST_LAYERS);
            let view = array(gpu, LAYER_SIDE, count);
            let layers = (0..count).map(|i| targets::layer(&view, i)).collect();
            self.made = Some((view, layers));
            self.drawn = Made::not_yet(());
        }
    }

    pub fn view(&self) -> Option<&wgpu::TextureView> {
        self.made.as_ref().map(|(view, _)| view)
    }
}

/// Stands for them where there are none.
pub(super) fn none(gpu: &Gpu) -> wgpu::TextureView {
    array(gpu, 1, 1)
}

fn array(gpu: &Gpu, side: u32, count: u32) -> wgpu::TextureView {
    targets::layers(gpu, "scattered over uv", [side; 2], count, HDR_FORMAT)
}

/// A material of a character whose light has a layer.
#[derive(Debug)]
pub(crate) struct SkinPart {
    pub material: usize,
    /// Places that are read for each.
    pub taps: usize,
    /// Steps over the borders of its charts, and the nearest of each texel.
    pub seams: wgpu::Buffer,
    pub nearest_seams: wgpu::TextureView,
}

impl SkinPart {
    pub fn new(gpu: &Gpu, scene: &Scene, material: usize, uv_box: [[f32; 2]; 2], metres_per_uv: [f32; 2]) -> Self {
        let skin = scene.materials[material].skin.unwrap_or_default();
        let [sx, sy, x, y] = layer_uv(uv_box);
        let side = LAYER_SIDE as f32;
        let texel_of = |uv: Vec2| (uv * Vec2::new(sx, sy) + Vec2::new(x, y)) * side;
        let mm = 1000.0 * skin.profile.world_scale * metres_per_uv[0].min(metres_per_uv[1]) / (sx.max(sy) * side);
        // A little beyond the farthest tap.
        let reach = (1.5 * skin.profile.max_radius_mm() / mm.max(1e-6)).clamp(2.0, MOST_REACH);
        let rest = scene.rest_world_from_nodes();
        let parts = scene.mesh_nodes().flat_map(|(node, mesh)| mesh.primitives.iter().map(move |p| (p, node)));
        let parts = parts.filter(|(p, _)| p.material == material).map(|(p, node)| (p, rest[node]));
        let Seams { list, nearest } = Seams::of(parts, texel_of, LAYER_SIDE, reach);
        let side = if list.is_empty() { 1 } else { LAYER_SIDE };
        let size = wgpu::Extent3d { width: side, height: side, depth_or_array_layers: 1 };
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("seams"),
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::R16Uint,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let layout =
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(side * 2), rows_per_image: Some(side) };
        gpu.queue.write_texture(texture.as_image_copy(), bytemuck::cast_slice(&nearest), layout, size);
        Self {
            material,
            taps: skin.taps as usize,
            seams: bind::filled(gpu, "seams", bytemuck::cast_slice(&list), wgpu::BufferUsages::STORAGE),
            nearest_seams: targets::view(&texture),
        }
    }
}

/// What draws them.
#[derive(Debug)]
pub(super) struct SkinPainter {
    targets: UvTargets,
    scatter: ScatterUvPass,
}

impl SkinPainter {
    pub fn new(r: &Renderer) -> Result<Self> {
        let targets = UvTargets::new(r.gpu());
        Ok(Self { scatter: ScatterUvPass::new(&r.variants)?, targets })
    }

    /// Draws the light that falls on skin, and spreads it.
    pub fn encode(
        &self,
        r: &Renderer,
        uploads: &mut Uploads,
        encoder: &mut wgpu::CommandEncoder,
        actors: Actors<'_>,
        sight: Sight<'_>,
    ) -> Result<()> {
        let Some((_, layers)) = &actors.bodies.skin.made else { return Ok(()) };
        for body in &actors.bodies.list {
            let data = body.data();
            for (layer, part) in body.skin_layers() {
                let drawn = data.uv_irradiances(&r.variants, sight)?;
                irradiance_uv::encode(encoder, actors, (body, part.material), &drawn, &self.targets);
                let group = self.scatter.group(r.gpu(), &self.targets, part);
                self.scatter.encode(uploads, encoder, (&group, part.taps), &layers[layer as usize]);
            }
        }
        Ok(())
    }
}
