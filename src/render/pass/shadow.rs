//! Depth of characters from the key light, for the shadow of each on itself.

use glam::Vec3;

use super::{DEPTH_FORMAT, map_request};
use crate::Gpu;
use crate::render::draw_list;
use crate::render::gpu_scene::GpuScene;
use crate::render::material::Composition;
use crate::render::targets;
use crate::render::variants::Request;
use crate::scene::{MOST_SHADOWED, SelfShadow};

/// The maps of a scene's characters, a layer for each.
#[derive(Debug)]
pub(crate) struct ShadowMap {
    settings: SelfShadow,
    /// Middle and radius of the sphere round a character at rest, character space, metres.
    pub middle: Vec3,
    radius: f32,
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
    /// Character space.
    pub middle: Vec3,
}

/// What the pass reads and writes.
pub(crate) struct ShadowInputs<'a> {
    pub scene: &'a GpuScene,
    pub frame: &'a wgpu::BindGroup,
    pub map: &'a ShadowMap,
}

impl ShadowMap {
    /// Maps of a character that fills a sphere.
    pub fn new(gpu: &Gpu, settings: SelfShadow, middle: Vec3, radius: f32) -> Self {
        let mut map = Self { settings, middle, radius, view: map_texture(gpu, 1, 1), layers: Vec::new() };
        map.fit(gpu, 1);
        map
    }

    /// Whether a crowd of so many needs more layers; they are made then.
    pub fn fit(&mut self, gpu: &Gpu, characters: usize) -> bool {
        let wanted = (characters as u32).clamp(1, MOST_SHADOWED);
        if self.layers.len() as u32 >= wanted {
            return false;
        }
        self.view = map_texture(gpu, self.settings.side, wanted);
        self.layers = (0..wanted).map(|i| targets::layer(&self.view, i)).collect();
        true
    }

    /// The layer of a character, where there is one.
    pub fn layer(&self, character: usize) -> Option<u32> {
        (character < self.layers.len()).then_some(character as u32)
    }

    /// Places in the maps while the middle stands there and the light so, in the world.
    pub fn rows(&self, middle: Vec3, to_light: Vec3) -> ShadowRows {
        let to_light = to_light.normalize_or(Vec3::Z);
        // The camera's up is the world's, unless the light comes from there.
        let right = Vec3::Y.cross(to_light).try_normalize().filter(|r| r.is_finite()).unwrap_or(Vec3::X);
        let texel = 1.0 / self.view.texture().width() as f32;
        let width = 2.0 * self.radius;
        ShadowRows {
            right,
            up: to_light.cross(right),
            to_light,
            scale: 1.0 / width,
            bias: self.settings.bias_texels * texel,
            // Three taps of a texel each span the edge.
            spread: (self.settings.soft_width_m / (3.0 * width)).max(texel),
            middle,
        }
    }
}

/// Maps without a character.
pub(crate) fn map_texture(gpu: &Gpu, side: u32, layers: u32) -> wgpu::TextureView {
    targets::layers(gpu, "shadow", side, layers, DEPTH_FORMAT)
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

/// Draws each character that has a map into its own.
pub(crate) fn encode(
    encoder: &mut wgpu::CommandEncoder,
    inputs: &ShadowInputs<'_>,
    timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
) {
    let count = inputs.map.layers.len().min(inputs.scene.instance_rows.len());
    for (i, layer) in inputs.map.layers.iter().take(count).enumerate() {
        // From the beginning of the first pass to the end of the last.
        let writes = timestamps.clone().map(|t| wgpu::RenderPassTimestampWrites {
            beginning_of_pass_write_index: t.beginning_of_pass_write_index.filter(|_| i == 0),
            end_of_pass_write_index: t.end_of_pass_write_index.filter(|_| i + 1 == count),
            ..t
        });
        let writes =
            writes.filter(|w| w.beginning_of_pass_write_index.is_some() || w.end_of_pass_write_index.is_some());
        let depth = targets::depth(layer, 1.0, wgpu::StoreOp::Store);
        let mut pass = targets::begin(encoder, "shadow", None, Some(depth), writes);
        // The map itself cannot be read while it is drawn.
        draw_list::bind_scene(&mut pass, inputs.scene, inputs.frame, &inputs.scene.character_group_without_map);
        for (draw, pipelines) in inputs.scene.draws.iter().zip(&inputs.scene.picture) {
            if let Some(shadow) = &pipelines.shadow {
                draw_list::record_instances(&mut pass, inputs.scene, draw, shadow, i as u32..i as u32 + 1);
            }
        }
    }
}
