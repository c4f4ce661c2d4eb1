//! The renderer: a frame as one list of calls.

pub(crate) mod draw_list;
mod geometry;
pub(crate) mod pass;
mod readback;
pub mod shaders;
mod targets;
mod textures;
#[doc(hidden)]
pub mod uniforms;
mod upload;
mod uv_metric;
mod view;

use std::time::Duration;

pub use upload::{GpuMemory, GpuScene};
pub use view::{Background, Channel, View};

use crate::{
    Error, Gpu, Result,
    color::Srgb,
    gpu::MAX_TEXTURE_SIDE,
    scene::{Image, Post},
};
use pass::{
    HDR_FORMAT,
    bangs_near::BangsNearPass,
    bangs_shadow::{BangsShadowInputs, BangsShadowPass},
    bloom::{BloomChain, BloomInputs, BloomPass},
    deform::{DeformInputs, DeformPass},
    eyes_through::{EyesThroughInputs, EyesThroughPass},
    fluff::{FluffInputs, FluffPass},
    glow::{self, GlowInputs, GlowPass},
    opaque::{OpaqueInputs, OpaquePass},
    outline::{OutlineInputs, OutlinePass},
    post::{PostInputs, PostPass},
    prepass::{PrepassInputs, PrepassPass},
    shadow::{ShadowInputs, ShadowPass},
    transparent::{TransparentInputs, TransparentPass},
};
use targets::{ColorTargets, PrepassTargets};
use uniforms::{AffineRows, FrameUniform};

/// What a [`Renderer`] draws into.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Output {
    /// Format of the target. Default: 8-bit sRGB, in which blending and the resolve of samples happen in linear light.
    ///
    /// A format without `Srgb` in its name is encoded by the shaders; blending and resolve then happen on encoded
    /// values, as in WebGL renderers.
    pub format: wgpu::TextureFormat,
    /// Samples a pixel: 1 or 4. Default: 4.
    pub samples: u32,
}

impl Default for Output {
    fn default() -> Self {
        Self { format: wgpu::TextureFormat::Rgba8UnormSrgb, samples: 4 }
    }
}

/// Bind group layouts, by rate of change.
#[derive(Debug)]
pub(crate) struct Layouts {
    /// Group 0.
    pub frame: wgpu::BindGroupLayout,
    /// Group 1.
    pub character: wgpu::BindGroupLayout,
    /// Group 2.
    pub material: wgpu::BindGroupLayout,
    /// Of every pass that draws surfaces.
    pub surface: wgpu::PipelineLayout,
}

/// Draws scenes. One for each device and output format.
#[derive(Debug)]
pub struct Renderer {
    pub(crate) gpu: Gpu,
    output: Output,
    pub(crate) layouts: Layouts,
    deform: DeformPass,
    bangs_near: BangsNearPass,
    bangs_shadow: BangsShadowPass,
    prepass: PrepassPass,
    shadow: ShadowPass,
    opaque: OpaquePass,
    outline: OutlinePass,
    fluff: FluffPass,
    glow: GlowPass,
    bloom: BloomPass,
    post: PostPass,
    eyes_through: EyesThroughPass,
    transparent: TransparentPass,
    frame_uniform: wgpu::Buffer,
    frame_group: wgpu::BindGroup,
    color_targets: Option<ColorTargets>,
    post_targets: Option<PostTargets>,
    /// With the group 0 that reads them.
    prepass_targets: Option<(PrepassTargets, wgpu::BindGroup)>,
    picture_target: Option<wgpu::Texture>,
}

/// Longest wait for a frame before [`Error::Gpu`].
const FRAME_TIMEOUT: Duration = Duration::from_secs(120);

impl Renderer {
    /// Makes a renderer with the default [`Output`].
    ///
    /// # Errors
    /// [`Error::Gpu`] where the adapter refuses a resource.
    pub fn new(gpu: &Gpu) -> Result<Self> {
        Self::with_output(gpu, Output::default())
    }

    /// Makes a renderer for targets of a given format and number of samples.
    ///
    /// # Errors
    /// [`Error::Argument`] for a number of samples other than 1 and 4; [`Error::Gpu`] where the adapter refuses a resource.
    pub fn with_output(gpu: &Gpu, output: Output) -> Result<Self> {
        if output.samples != 1 && output.samples != 4 {
            let message = format!("is {}; expected 1 or 4", output.samples);
            return Err(Error::Argument { what: "samples".to_owned(), message });
        }
        gpu.scoped(|| {
            let layouts = Layouts::new(gpu);
            let frame_uniform = gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("frame"),
                size: size_of::<FrameUniform>() as u64,
                usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            });
            let frame_group = frame_group(gpu, &layouts, &frame_uniform, &PrepassTargets::new(gpu, [1, 1], false));
            Self {
                gpu: gpu.clone(),
                output,
                layouts,
                deform: DeformPass::new(gpu),
                bangs_near: BangsNearPass::new(gpu),
                bangs_shadow: BangsShadowPass::new(gpu),
                prepass: PrepassPass::new(gpu),
                shadow: ShadowPass::new(gpu),
                opaque: OpaquePass::new(gpu, output),
                outline: OutlinePass::new(gpu, output),
                fluff: FluffPass::new(gpu, output),
                glow: GlowPass::new(gpu),
                bloom: BloomPass::new(gpu),
                post: PostPass::new(gpu, output),
                eyes_through: EyesThroughPass::new(gpu, output),
                transparent: TransparentPass::new(gpu, output),
                frame_uniform,
                frame_group,
                color_targets: None,
                post_targets: None,
                prepass_targets: None,
                picture_target: None,
            }
        })
    }

    /// Renders a view and reads it back: sRGB, straight alpha.
    ///
    /// # Errors
    /// [`Error::Argument`] for a view out of its domain; [`Error::Gpu`] where the adapter fails or does not answer.
    pub fn render(&mut self, scene: &mut GpuScene, view: &View) -> Result<Image> {
        view.check()?;
        let gpu = self.gpu.clone();
        gpu.scoped(|| {
            if view.channel.is_geometry() {
                return self.render_channel(scene, view);
            }
            if let Some(code) = view.channel.shader_code() {
                let shaded = scene.show_channel(self, code);
                let post = scene.post.take();
                let view =
                    View { channel: Channel::Final, background: Background::Color(Srgb([0; 3])), ..view.clone() };
                let picture = self.render(scene, &view);
                scene.show_again(shaded);
                scene.post = post;
                return picture;
            }
            let texture = match self.picture_target.take() {
                Some(t) if [t.width(), t.height()] == view.size => t,
                _ => targets::target(&self.gpu, "picture", view.size, 1, self.output.format, true),
            };
            self.submit_frame(scene, view, &targets::view(&texture))?;
            let texels = readback::read_texels(&self.gpu, &texture, FRAME_TIMEOUT)?;
            self.picture_target = Some(texture);
            Ok(readback::picture(view.size, texels))
        })?
    }

    fn submit_frame(&mut self, scene: &mut GpuScene, view: &View, target: &wgpu::TextureView) -> Result<()> {
        let mut encoder =
            self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("frame") });
        self.encode_frame(&mut encoder, scene, view, target)?;
        self.gpu.queue.submit([encoder.finish()]);
        Ok(())
    }

    /// Encodes a view into `target`, which has the format of this renderer's [`Output`], the size of the view, and one
    /// sample a pixel. The application submits.
    ///
    /// # Errors
    /// [`Error::Argument`] for a view out of its domain.
    pub fn encode_frame(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        scene: &mut GpuScene,
        view: &View,
        target: &wgpu::TextureView,
    ) -> Result<()> {
        view.check()?;
        self.begin_frame(scene, view);
        // Skinned and morphed vertices; only where the pose has changed.
        self.encode_deform(encoder, scene, None);
        // What casts on the face, from the light of that shadow, and each character from the key light; only where the
        // pose, the light or a place has changed.
        if std::mem::take(&mut scene.maps_pending) {
            self.encode_bangs_shadow(encoder, scene, None);
            self.encode_shadow(encoder, scene, None);
        }
        // Depth of all surfaces, and their normals and parts, where a material reads them.
        self.encode_prepass(encoder, scene, None);
        // Light that blooms, and how far it spreads.
        self.encode_glow(encoder, scene, None);
        // One colour pass: opaque, outlines and transparent share their targets, so samples are resolved once.
        let mut pass = self.begin_color_pass(encoder, view, target, scene.post.is_some(), None);
        draw_list::bind_scene(&mut pass, scene, self.color_frame_group(scene), &scene.character_group);
        self.record_surfaces(&mut pass, scene, view);
        drop(pass);
        // Bloom, tone curve, background, smooth edges.
        self.encode_post(encoder, scene, view, target, None);
        Ok(())
    }

    /// Every draw of the colour pass.
    pub(crate) fn record_surfaces(&self, pass: &mut wgpu::RenderPass<'_>, scene: &GpuScene, view: &View) {
        // Body, face, hair.
        self.opaque.encode(pass, &OpaqueInputs { scene });
        // Lines around them, hidden where a surface is nearer.
        self.outline.encode(pass, &OutlineInputs { scene });
        // Coats of short hair over both.
        self.fluff.encode(pass, &FluffInputs { scene, px_per_m: view.px_per_m() });
        // Eyes and brows through the bangs.
        self.eyes_through.encode(pass, &EyesThroughInputs { scene });
        // What is seen through, far before near.
        self.transparent.encode(pass, &TransparentInputs { scene });
    }

    /// Writes what changes with the view: uniforms, instances, order of transparent draws, targets of a new size.
    pub(crate) fn begin_frame(&mut self, scene: &mut GpuScene, view: &View) {
        self.gpu.queue.write_buffer(&self.frame_uniform, 0, bytemuck::bytes_of(&FrameUniform::new(view)));
        let rows = view.instances.iter().map(|m| AffineRows::from(*m));
        let changed = scene.instance_rows.len() != view.instances.len()
            || rows.clone().zip(&scene.instance_rows).any(|(a, b)| bytemuck::bytes_of(&a) != bytemuck::bytes_of(b));
        if changed {
            scene.maps_pending = true;
            scene.instance_rows.clear();
            scene.instance_rows.extend(rows);
            // A copy for the surfaces, and one for each shell of a coat.
            let copied = scene.instance_rows.repeat(scene.instance_copies);
            if copied.len() > scene.instance_capacity {
                scene.instance_capacity = copied.len().next_power_of_two();
                scene.instances = upload::instance_buffer(&self.gpu, scene.instance_capacity);
            }
            self.gpu.queue.write_buffer(&scene.instances, 0, bytemuck::cast_slice(&copied));
        }
        scene.fit_shadow(self);
        scene.light(&self.gpu, view);
        // Draws of a crowd share one order: that of its first character.
        let eye = view.instances.first().map_or(view.camera.eye, |m| m.inverse().transform_point3(view.camera.eye));
        scene.sort_transparent(eye);
        if self.color_targets.as_ref().is_none_or(|t| t.size != view.size) && view.channel == Channel::Final {
            self.color_targets = Some(ColorTargets::new(&self.gpu, view.size, self.output));
        }
        if let Some(post) = scene.post
            && view.channel == Channel::Final
            && self.post_targets.as_ref().is_none_or(|t| t.color.size != view.size || t.post != post)
        {
            self.post_targets = Some(PostTargets::new(self, view.size, post));
        }
        let fits = |t: &PrepassTargets| t.size == view.size && (t.has_surfaces || !scene.has_inner_lines);
        if !scene.prepass.is_empty() && !self.prepass_targets.as_ref().is_some_and(|(t, _)| fits(t)) {
            let targets = PrepassTargets::new(&self.gpu, view.size, scene.has_inner_lines);
            let group = frame_group(&self.gpu, &self.layouts, &self.frame_uniform, &targets);
            self.prepass_targets = Some((targets, group));
        }
    }

    pub(crate) fn encode_deform(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        scene: &mut GpuScene,
        timestamps: Option<wgpu::ComputePassTimestampWrites<'_>>,
    ) {
        if std::mem::take(&mut scene.deform_pending) {
            self.deform.encode(encoder, &DeformInputs { scene }, timestamps);
        }
    }

    pub(crate) fn encode_bangs_shadow(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        scene: &GpuScene,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) {
        if let Some(map) = &scene.bangs {
            let inputs = BangsShadowInputs { scene, frame: &self.frame_group, reduce: &self.bangs_near, map };
            self.bangs_shadow.encode(encoder, &inputs, timestamps);
        }
    }

    pub(crate) fn encode_shadow(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        scene: &GpuScene,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) {
        if let Some(map) = &scene.shadow {
            self.shadow.encode(encoder, &ShadowInputs { scene, frame: &self.frame_group, map }, timestamps);
        }
    }

    pub(crate) fn encode_prepass(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        scene: &GpuScene,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) {
        if let (false, Some((targets, _))) = (scene.prepass.is_empty(), &self.prepass_targets) {
            let inputs = PrepassInputs {
                scene,
                frame: &self.frame_group,
                targets,
                surfaces: scene.has_inner_lines,
                pipelines: &scene.prepass,
            };
            self.prepass.encode(encoder, &inputs, timestamps);
        }
    }

    pub(crate) fn encode_glow(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        scene: &GpuScene,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) {
        let targets = self.post_targets.as_ref().filter(|_| scene.post.is_some());
        if let Some(PostTargets { light: Some((light, chain)), .. }) = targets {
            let inputs = GlowInputs { scene, frame: self.color_frame_group(scene), light };
            self.glow.encode(encoder, &inputs, timestamps);
            self.bloom.encode(encoder, &BloomInputs { chain });
        }
    }

    pub(crate) fn encode_post(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        scene: &GpuScene,
        view: &View,
        target: &wgpu::TextureView,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) {
        if let (Some(post), Some(targets)) = (scene.post, &self.post_targets) {
            let PostTargets { group, pipeline, .. } = targets;
            let inputs = PostInputs { post, background: view.background, group, pipeline, target };
            self.post.encode(&self.gpu, encoder, &inputs, timestamps);
        }
    }

    /// `posts`: it is finished by [`Renderer::encode_post`].
    pub(crate) fn begin_color_pass<'a>(
        &self,
        encoder: &'a mut wgpu::CommandEncoder,
        view: &View,
        target: &wgpu::TextureView,
        posts: bool,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) -> wgpu::RenderPass<'a> {
        let post = self.post_targets.as_ref().filter(|_| posts);
        let targets = post.map_or(self.color_targets.as_ref(), |p| Some(&p.color));
        let target = post.map_or(target, |p| &p.picture);
        let clear = if post.is_some() {
            // The background comes last.
            wgpu::Color::TRANSPARENT
        } else {
            view.background.clear_color(self.output)
        };
        let multisampled = targets.and_then(|t| t.multisampled.as_ref());
        // Samples that are resolved need not be kept.
        let store = if multisampled.is_some() {
            wgpu::StoreOp::Discard
        } else {
            wgpu::StoreOp::Store
        };
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("colour"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: multisampled.unwrap_or(target),
                depth_slice: None,
                resolve_target: multisampled.map(|_| target),
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(clear), store },
            })],
            depth_stencil_attachment: targets.map(|t| wgpu::RenderPassDepthStencilAttachment {
                view: &t.depth,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Discard }),
                stencil_ops: pass::color_depth_format(&self.gpu)
                    .has_stencil_aspect()
                    .then_some(wgpu::Operations { load: wgpu::LoadOp::Clear(0), store: wgpu::StoreOp::Discard }),
            }),
            timestamp_writes: timestamps,
            ..Default::default()
        })
    }

    /// Group 0 of the colour pass: with what the prepass drew where a material reads it.
    pub(crate) fn color_frame_group(&self, scene: &GpuScene) -> &wgpu::BindGroup {
        let drawn = self.prepass_targets.as_ref().filter(|_| !scene.prepass.is_empty());
        drawn.map_or(&self.frame_group, |(_, group)| group)
    }

    /// Renders one of the prepass's channels as a picture.
    fn render_channel(&mut self, scene: &mut GpuScene, view: &View) -> Result<Image> {
        self.begin_frame(scene, view);
        let targets = PrepassTargets::new(&self.gpu, view.size, true);
        let mut encoder =
            self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("channel") });
        self.encode_deform(&mut encoder, scene, None);
        // Made here and not at upload: few scenes are ever looked at in these channels.
        let Self { gpu, layouts, prepass, frame_group, .. } = self;
        let pipelines: Vec<_> = scene
            .draws
            .iter()
            .map(|d| Some(prepass.pipeline(gpu, layouts, d.flags, scene.material(d), false)))
            .collect();
        // Depth, normal and part id.
        let inputs =
            PrepassInputs { scene, frame: frame_group, targets: &targets, surfaces: true, pipelines: &pipelines };
        prepass.encode(&mut encoder, &inputs, None);
        self.gpu.queue.submit([encoder.finish()]);
        let texture = match view.channel {
            Channel::Depth => &targets.depth,
            _ => &targets.surfaces,
        };
        let texels = readback::read_texels(&self.gpu, texture, FRAME_TIMEOUT)?;
        Ok(view.channel.picture(view, texels))
    }
}

/// What a frame that is finished by [`PostPass`] is drawn into.
#[derive(Debug)]
struct PostTargets {
    post: Post,
    color: ColorTargets,
    picture: wgpu::TextureView,
    light: Option<(wgpu::TextureView, BloomChain)>,
    group: wgpu::BindGroup,
    pipeline: wgpu::RenderPipeline,
}

impl PostTargets {
    fn new(renderer: &mut Renderer, size: [u32; 2], post: Post) -> Self {
        let Renderer { gpu, output, bloom, post: pass, .. } = renderer;
        let picture = targets::sampled(gpu, "picture", size, HDR_FORMAT);
        let light = post.bloom.map(|settings| {
            let glow = glow::target(gpu, size);
            let chain = bloom.chain(gpu, &glow, size[1], settings);
            (glow, chain)
        });
        // Without bloom its strength is 0, and any picture will do.
        let spread = light.as_ref().map_or(&picture, |(glow, _)| glow);
        Self {
            post,
            color: ColorTargets::new(gpu, size, Output { format: HDR_FORMAT, ..*output }),
            group: pass.group(gpu, &picture, spread),
            pipeline: pass.pipeline(gpu, post),
            picture,
            light,
        }
    }
}

fn frame_group(gpu: &Gpu, layouts: &Layouts, uniform: &wgpu::Buffer, read: &PrepassTargets) -> wgpu::BindGroup {
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("frame"),
        layout: &layouts.frame,
        entries: &[
            wgpu::BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::TextureView(&read.depth_view) },
            wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::TextureView(&read.surfaces_view) },
        ],
    })
}

impl Layouts {
    fn new(gpu: &Gpu) -> Self {
        let uniform = |size| wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: false,
            min_binding_size: wgpu::BufferSize::new(size),
        };
        let both = wgpu::ShaderStages::VERTEX_FRAGMENT;
        let entry = |binding, visibility, ty| wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None };
        let frame = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("frame"),
            entries: &[
                entry(0, both, uniform(size_of::<FrameUniform>() as u64)),
                entry(
                    1,
                    wgpu::ShaderStages::FRAGMENT,
                    wgpu::BindingType::Texture {
                        sample_type: wgpu::TextureSampleType::Depth,
                        view_dimension: wgpu::TextureViewDimension::D2,
                        multisampled: false,
                    },
                ),
                entry(
                    2,
                    wgpu::ShaderStages::FRAGMENT,
                    wgpu::BindingType::Texture {
                        sample_type: wgpu::TextureSampleType::Uint,
                        view_dimension: wgpu::TextureViewDimension::D2,
                        multisampled: false,
                    },
                ),
            ],
        });
        let mut entries = vec![entry(0, both, uniform(size_of::<uniforms::MaterialUniform>() as u64))];
        for slot in 0..upload::TEXTURE_SLOTS as u32 {
            // The width mask of the outline and the mask of the UV animation that moves it are read by vertices.
            let stages = if matches!(slot, 7 | 8) {
                both
            } else {
                wgpu::ShaderStages::FRAGMENT
            };
            entries.push(entry(
                1 + 2 * slot,
                stages,
                wgpu::BindingType::Texture {
                    sample_type: wgpu::TextureSampleType::Float { filterable: true },
                    view_dimension: if slot == upload::FACE_SLOT as u32 {
                        wgpu::TextureViewDimension::D2Array
                    } else {
                        wgpu::TextureViewDimension::D2
                    },
                    multisampled: false,
                },
            ));
            if slot < upload::SAMPLER_SLOTS as u32 {
                let ty = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
                entries.push(entry(2 + 2 * slot, stages, ty));
            }
        }
        let material = gpu
            .device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some("material"), entries: &entries });
        let numbers = wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Float { filterable: false },
            view_dimension: wgpu::TextureViewDimension::D2Array,
            multisampled: false,
        };
        let character = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("character"),
            entries: &[
                entry(0, both, uniform(size_of::<uniforms::CharacterUniform>() as u64)),
                entry(1, wgpu::ShaderStages::FRAGMENT, numbers),
                entry(2, wgpu::ShaderStages::FRAGMENT, numbers),
                entry(
                    3,
                    wgpu::ShaderStages::FRAGMENT,
                    wgpu::BindingType::Sampler(wgpu::SamplerBindingType::NonFiltering),
                ),
                entry(
                    4,
                    wgpu::ShaderStages::FRAGMENT,
                    wgpu::BindingType::Texture {
                        sample_type: wgpu::TextureSampleType::Depth,
                        view_dimension: wgpu::TextureViewDimension::D2Array,
                        multisampled: false,
                    },
                ),
                entry(
                    5,
                    wgpu::ShaderStages::FRAGMENT,
                    wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Comparison),
                ),
            ],
        });
        let surface = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("surface"),
            bind_group_layouts: &[Some(&frame), Some(&character), Some(&material)],
            immediate_size: 0,
        });
        Self { frame, character, material, surface }
    }
}

/// A target that a frame of `size` can be drawn into and read back from.
pub(crate) fn color_target(gpu: &Gpu, size: [u32; 2], output: Output) -> wgpu::TextureView {
    targets::view(&targets::target(gpu, "target", size, 1, output.format, true))
}
