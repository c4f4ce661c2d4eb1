//! Light from all around on the GPU: pictures of environments as rough mirrors see them, made when a stage first has one.

use std::borrow::Cow;
use std::sync::{Arc, OnceLock};

use half::f16;
use rayon::prelude::*;

use super::pass::HDR_FORMAT;
use super::shaders::Recipe;
use super::variants::Variants;
use super::{bind, targets};
use crate::scene::{Environment, MAX_RADIANCE, Radiance};
use crate::{Gpu, Result};

/// Levels of a map; the last one is that of roughness 1. `LEVELS` of wgsl/pass/environment.wgsl.
pub(crate) const LEVELS: u32 = 6;
/// Texels along a side of its cube; the shader states the same.
pub(super) const SIDE: u32 = 128;
/// Widest picture that is kept; wider ones are halved.
const MAX_WIDTH: u32 = 2048;
/// Environments that stay on the GPU.
const KEPT: usize = 4;
/// Entries along a side of the table of the split sum; `SPLIT_SUM_SIDE` of wgsl/lib/split_sum.wgsl.
pub(super) const SPLIT_SUM_SIDE: usize = 32;

/// What a stage's environment is on the GPU.
#[derive(Clone, Debug)]
pub(crate) struct EnvironmentMap {
    /// Radiance by roughness.
    pub cube: wgpu::TextureView,
    /// The picture itself.
    pub picture: wgpu::TextureView,
}

/// Environments of a renderer.
#[derive(Debug)]
pub(crate) struct Environments {
    pub sampler: wgpu::Sampler,
    pub split_sum: wgpu::Buffer,
    /// Stands where a stage has none.
    none: EnvironmentMap,
    /// The last ones that stages had, the latest last.
    kept: Vec<(Arc<Radiance>, EnvironmentMap)>,
}

impl Environments {
    pub fn new(gpu: &Gpu) -> Self {
        let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("environment"),
            address_mode_u: wgpu::AddressMode::Repeat,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        });
        let none = EnvironmentMap {
            cube: whole_cube(&cube(gpu, 1, 1)),
            picture: targets::sampled(gpu, "no environment", [1, 1], HDR_FORMAT),
        };
        let split_sum = bind::filled(gpu, "split sum", bytemuck::cast_slice(split_sum()), wgpu::BufferUsages::UNIFORM);
        Self { sampler, split_sum, none, kept: Vec::new() }
    }

    /// What stands where a stage has none.
    pub fn none(&self) -> EnvironmentMap {
        self.none.clone()
    }

    /// That of a stage, made where it is new.
    pub fn of(&mut self, variants: &Variants, of: Option<&Environment>) -> Result<EnvironmentMap> {
        let Some(of) = of else { return Ok(self.none.clone()) };
        if let Some((_, known)) = self.kept.iter().find(|(radiance, _)| Arc::ptr_eq(radiance, &of.radiance)) {
            return Ok(known.clone());
        }
        let made = make(variants, &of.radiance, &self.sampler)?;
        if self.kept.len() == KEPT {
            self.kept.remove(0);
        }
        self.kept.push((Arc::clone(&of.radiance), made.clone()));
        Ok(made)
    }
}

fn cube(gpu: &Gpu, side: u32, mip_level_count: u32) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("environment"),
        size: wgpu::Extent3d { width: side, height: side, depth_or_array_layers: 6 },
        mip_level_count,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: HDR_FORMAT,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    })
}

fn whole_cube(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::Cube),
        ..Default::default()
    })
}

/// Uploads a picture and draws every side and level of its map.
fn make(variants: &Variants, of: &Radiance, sampler: &wgpu::Sampler) -> Result<EnvironmentMap> {
    let gpu = &variants.gpu;
    let module = variants.plain_module(&Recipe::plain("environment"))?;
    let picture = picture(gpu, of);
    let map = cube(gpu, SIDE, LEVELS);
    let read = |ty| (wgpu::ShaderStages::FRAGMENT, ty);
    let layout = bind::layout(
        gpu,
        "environment",
        [
            read(bind::filtered(wgpu::TextureViewDimension::D2)),
            read(wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering)),
        ],
    );
    let resources = [wgpu::BindingResource::TextureView(&picture), wgpu::BindingResource::Sampler(sampler)];
    let group = bind::group(gpu, "environment", &layout, resources);
    let pipeline_layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("environment"),
        bind_group_layouts: &[Some(&layout)],
        immediate_size: 0,
    });
    let into = targets::PictureTarget::of(HDR_FORMAT, 1, None);
    let pipeline = targets::picture_pipeline(gpu, "environment", Some(&pipeline_layout), &module, "fs_main", into);
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("environment") });
    for which in 0..6 * LEVELS {
        let view = map.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2),
            base_mip_level: which / 6,
            mip_level_count: Some(1),
            base_array_layer: which % 6,
            array_layer_count: Some(1),
            ..Default::default()
        });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("environment"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store },
            })],
            ..Default::default()
        });
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.draw(0..3, which..which + 1);
    }
    gpu.queue.submit([encoder.finish()]);
    Ok(EnvironmentMap { cube: whole_cube(&map), picture })
}

/// The picture with its mips.
fn picture(gpu: &Gpu, of: &Radiance) -> wgpu::TextureView {
    let [mut width, mut height] = of.size();
    let mut texels = Cow::Borrowed(of.texels());
    while width > MAX_WIDTH {
        texels = Cow::Owned(halved(&texels, width, height));
        (width, height) = (half_of(width), half_of(height));
    }
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("radiance"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: width.max(height).ilog2() + 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: HDR_FORMAT,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    for mip_level in 0..texture.mip_level_count() {
        let bits: Vec<[u16; 4]> = texels
            .iter()
            .map(|t| {
                let [r, g, b] = t.map(|c| f16::from_f32(c.min(MAX_RADIANCE)).to_bits());
                [r, g, b, f16::ONE.to_bits()]
            })
            .collect();
        gpu.queue.write_texture(
            wgpu::TexelCopyTextureInfo {
                texture: &texture,
                mip_level,
                origin: wgpu::Origin3d::ZERO,
                aspect: wgpu::TextureAspect::All,
            },
            bytemuck::cast_slice(&bits),
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(width * 8), rows_per_image: None },
            wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        );
        texels = Cow::Owned(halved(&texels, width, height));
        (width, height) = (half_of(width), half_of(height));
    }
    targets::view(&texture)
}

fn half_of(side: u32) -> u32 {
    (side / 2).max(1)
}

/// Box filter to half size.
fn halved(source: &[[f32; 3]], width: u32, height: u32) -> Vec<[f32; 3]> {
    let (w, h) = (half_of(width), half_of(height));
    let at = |x: u32, y: u32| source[(y.min(height - 1) * width + x.min(width - 1)) as usize];
    let texel = |i: u32| {
        let (x, y) = (2 * (i % w), 2 * (i / w));
        let four = [at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)];
        std::array::from_fn(|c| four.iter().map(|t| t[c]).sum::<f32>() * 0.25)
    };
    (0..w * h).into_par_iter().map(texel).collect()
}

/// Scale and bias of the reflectance at normal incidence for views and roughnesses (Karis 2013): the integral of GGX over all
/// light, with Fresnel's term taken apart.
fn split_sum() -> &'static [[f32; 2]] {
    static TABLE: OnceLock<Vec<[f32; 2]>> = OnceLock::new();
    TABLE.get_or_init(|| {
        let last = (SPLIT_SUM_SIDE - 1) as f32;
        let entry = |i: usize| {
            let (x, y) = ((i % SPLIT_SUM_SIDE) as f32 / last, (i / SPLIT_SUM_SIDE) as f32 / last);
            reflected((x * x).max(1e-3), y.max(0.045))
        };
        (0..SPLIT_SUM_SIDE * SPLIT_SUM_SIDE).into_par_iter().map(entry).collect()
    })
}

fn reflected(n_dot_v: f32, roughness: f32) -> [f32; 2] {
    const SAMPLES: u32 = 512;
    let alpha = roughness * roughness;
    let a2 = alpha * alpha;
    let view = [(1.0 - n_dot_v * n_dot_v).sqrt(), n_dot_v];
    let mut sums = [0f64; 2];
    for i in 0..SAMPLES {
        let u = (i as f32 + 0.5) / SAMPLES as f32;
        let turn = std::f32::consts::TAU * (i as f32 * 0.618_034).fract();
        let cos_h = ((1.0 - u) / (1.0 + (a2 - 1.0) * u)).sqrt();
        let x_h = (1.0 - cos_h * cos_h).max(0.0).sqrt() * turn.cos();
        let v_dot_h = view[0] * x_h + view[1] * cos_h;
        let n_dot_l = 2.0 * v_dot_h * cos_h - n_dot_v;
        if n_dot_l <= 0.0 || v_dot_h <= 0.0 {
            continue;
        }
        let smith = n_dot_v * (n_dot_l * n_dot_l * (1.0 - a2) + a2).sqrt()
            + n_dot_l * (n_dot_v * n_dot_v * (1.0 - a2) + a2).sqrt();
        // Visibility over the density of the samples, and the cosine.
        let weight = f64::from(2.0 / smith * n_dot_l * v_dot_h / cos_h);
        let fresnel = f64::from((1.0 - v_dot_h).powi(5));
        sums[0] += weight * (1.0 - fresnel);
        sums[1] += weight * fresnel;
    }
    sums.map(|sum| (sum / f64::from(SAMPLES)) as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn smooth_mirrors_give_back_all_light_and_rough_ones_less() {
        for n_dot_v in [0.1, 0.5, 1.0] {
            let sums = [0.05, 0.3, 0.6, 1.0].map(|roughness| reflected(n_dot_v, roughness).iter().sum::<f32>());
            assert!((sums[0] - 1.0).abs() < 0.01, "{n_dot_v}: {sums:?}");
            assert!(sums.iter().all(|s| *s <= 1.005), "{n_dot_v}: {sums:?}");
            assert!(sums[3] < sums[0], "{n_dot_v}: {sums:?}");
        }
    }
}
