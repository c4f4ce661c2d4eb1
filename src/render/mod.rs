//! The renderer: a frame as one list of calls.

mod bind;
pub(crate) mod check_section;
mod check_wgsl;
mod clock;
pub(crate) mod draw_list;
mod frame;
mod geometry;
mod gpu_scene;
pub(crate) mod layout;
mod looks;
mod made;
pub(crate) mod material;
pub(crate) mod pass;
mod readback;
pub mod shaders;
mod targets;
mod textures;
mod upload;
mod uploads;
mod uv_metric;
mod variants;
mod vertex;
mod view;

#[cfg(test)]
mod tests;

use std::time::Duration;

pub use gpu_scene::{GpuMemory, GpuScene};
pub use view::{Background, Channel, View};

pub(crate) use clock::{Clock, Timed};

use crate::color::Srgb;
use crate::gpu::MAX_TEXTURE_SIDE;
use crate::scene::{Image, Post};
use crate::{Error, Gpu, Result};
use frame::{frame_numbers, put_view};
use layout::Filled;
use pass::bangs_near::BangsNearPass;
use pass::bangs_shadow::{self, BangsShadowInputs};
use pass::bloom::{BloomChain, BloomInputs, BloomPass};
use pass::deform::{DeformInputs, DeformPass};
use pass::floor::FloorPass;
use pass::glow::{self, GlowInputs};
use pass::post::{PostInputs, PostPass};
use pass::prepass::{self, PrepassInputs};
use pass::shadow::{self, ShadowInputs};
use pass::{HDR_FORMAT, Picture, Sight, eyes_through, fluff, opaque, outline, transparent};
use shaders::Shaders;
use targets::{ColorTargets, PrepassTargets};
use uploads::Uploads;
use variants::Variants;
use wgpu::BindingResource;

/// What a [`Renderer`] draws into.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Output {
    /// Format of the target. Default: 8-bit sRGB, in which blending and the resolve of samples happen in linear light.
    ///
    /// A format of 8 bits without `Srgb` in its name is encoded by the shaders; blending and resolve then happen on encoded
    /// values, as in WebGL renderers. Floats stay linear.
    pub format: wgpu::TextureFormat,
    /// Samples a pixel: 1 or 4. Default: 4.
    pub samples: u32,
}

impl Default for Output {
    fn default() -> Self {
        Self { format: wgpu::TextureFormat::Rgba8UnormSrgb, samples: 4 }
    }
}

/// Draws scenes. One for each device and output format.
#[derive(Debug)]
pub struct Renderer {
    output: Output,
    pub(crate) variants: Variants,
    layouts: Layouts,
    deform: DeformPass,
    // What few pictures need is made when one does.
    bangs_near: Option<BangsNearPass>,
    bloom: Option<BloomPass>,
    post: Option<PostPass>,
    uploads: Uploads,
    frame_numbers: Filled,
    frame_uniform: wgpu::Buffer,
    frame_group: wgpu::BindGroup,
    color_targets: Option<ColorTargets>,
    post_targets: Option<PostTargets>,
    /// With the group 0 that reads them.
    prepass_targets: Option<(PrepassTargets, wgpu::BindGroup)>,
    picture_target: Option<wgpu::Texture>,
}

/// Bind group layouts of what all materials share.
#[derive(Debug)]
struct Layouts {
    /// Group 0.
    frame: wgpu::BindGroupLayout,
    /// Group 1.
    character: wgpu::BindGroupLayout,
}

/// What a frame shows.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Shown<'a> {
    /// The finished picture.
    Picture,
    /// A debug channel of shading.
    Channel(&'a str),
    /// The floor of benches.
    Floor(&'a FloorPass),
}

impl<'a> Shown<'a> {
    /// What its shaders are made for.
    fn sight(self, view: &View) -> Sight<'a> {
        let channel = match self {
            Self::Channel(channel) => Some(channel),
            Self::Picture | Self::Floor(_) => None,
        };
        Sight { channel, punctual: !view.lights.punctual.is_empty() }
    }
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
    /// [`Error::Argument`] for a number of samples other than 1 and 4; [`Error::Gpu`] where the device has smaller limits than
    /// [`Gpu::required_limits`], or the adapter refuses a resource.
    pub fn with_output(gpu: &Gpu, output: Output) -> Result<Self> {
        gpu.check_limits()?;
        if output.samples != 1 && output.samples != 4 {
            let message = format!("is {}; expected 1 or 4", output.samples);
            return Err(Error::Argument { what: "samples".to_owned(), message });
        }
        gpu.scoped(|| {
            let frame_numbers = frame_numbers();
            let layouts = Layouts::new(gpu, frame_numbers.size());
            let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
            let frame_uniform = bind::buffer(gpu, "frame", frame_numbers.size(), usage);
            let frame_group = frame_group(gpu, &layouts, &frame_uniform, &PrepassTargets::new(gpu, [1, 1], false));
            let variants = Variants::new(gpu, Shaders::new()?, layouts.frame.clone(), layouts.character.clone());
            Ok(Self {
                output,
                deform: DeformPass::new(&variants)?,
                variants,
                layouts,
                bangs_near: None,
                bloom: None,
                post: None,
                uploads: Uploads::new(gpu),
                frame_numbers,
                frame_uniform,
                frame_group,
                color_targets: None,
                post_targets: None,
                prepass_targets: None,
                picture_target: None,
            })
        })?
    }

    pub(crate) fn gpu(&self) -> &Gpu {
        &self.variants.gpu
    }

    fn bangs_near(&mut self) -> Result<&BangsNearPass> {
        if self.bangs_near.is_none() {
            self.bangs_near = Some(BangsNearPass::new(&self.variants)?);
        }
        self.bangs_near.as_ref().ok_or_else(|| Error::Gpu("the pass of nearest depths is missing".to_owned()))
    }

    /// What draws the floor of benches.
    pub(crate) fn floor(&self, scene: &mut GpuScene) -> Result<FloorPass> {
        FloorPass::new(&self.variants, &Picture::new(self.gpu(), self.output, false, Sight::default()), scene)
    }

    /// Renders a view and reads it back: sRGB, straight alpha, whatever the [`Output`]'s format.
    ///
    /// # Errors
    /// [`Error::Argument`] for a view out of its domain, a scene of another device or output, and for a format that is neither
    /// RGBA nor BGRA with 8 bits nor floats; [`Error::Gpu`] where the adapter fails or does not answer.
    pub fn render(&mut self, scene: &mut GpuScene, view: &View) -> Result<Image> {
        view.check()?;
        self.owns(scene)?;
        readback::check(self.output.format)?;
        let gpu = self.gpu().clone();
        gpu.scoped(|| {
            let shown = match view.channel {
                Channel::Final => Shown::Picture,
                Channel::Look(channel) => Shown::Channel(channel),
                _ => return self.render_geometry(scene, view),
            };
            let texture = match self.picture_target.take() {
                Some(t) if [t.width(), t.height()] == view.size => t,
                _ => targets::texture(&gpu, "picture", view.size, 1, self.output.format, wgpu::TextureUsages::COPY_SRC),
            };
            let mut encoder =
                gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("frame") });
            self.encode(&mut encoder, scene, view, &targets::view(&texture), shown, &Clock::off())?;
            gpu.queue.submit([encoder.finish()]);
            let texels = readback::read_texels(&gpu, &texture, FRAME_TIMEOUT)?;
            self.picture_target = Some(texture);
            Ok(readback::picture(view.size, self.output.format, &texels))
        })?
    }

    /// Encodes a view into `target`, which has the format of this renderer's [`Output`], the size of the view, and one
    /// sample a pixel. The picture has premultiplied alpha. The application submits. The view's channel does not count.
    ///
    /// # Errors
    /// [`Error::Argument`] for a view out of its domain, a target of another size, format or number of samples than the
    /// view and the [`Output`] have, and a scene of another device or output.
    pub fn encode_frame(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        scene: &mut GpuScene,
        view: &View,
        target: &wgpu::TextureView,
    ) -> Result<()> {
        view.check()?;
        self.owns(scene)?;
        self.fits(view, target.texture())?;
        self.encode(encoder, scene, view, target, Shown::Picture, &Clock::off())
    }

    /// Refuses a scene of another device or output.
    fn owns(&self, scene: &GpuScene) -> Result<()> {
        let (gpu, output) = &scene.made_by;
        let fault = |message: &str| {
            Err(Error::Argument {
                what: "scene".to_owned(),
                message: format!("{message}; please upload it by this one"),
            })
        };
        if !gpu.is(self.gpu()) {
            return fault("was uploaded by a renderer of another device");
        }
        if *output != self.output {
            return fault("was uploaded by a renderer of another output");
        }
        Ok(())
    }

    /// Refuses a target that the pipelines do not draw into.
    fn fits(&self, view: &View, target: &wgpu::Texture) -> Result<()> {
        let fault = |what: &str, found: String, expected: String| {
            let message = format!("has {found}; expected {expected}");
            Err(Error::Argument { what: format!("target: {what}"), message })
        };
        let (found, wanted) = ([target.width(), target.height()], view.size);
        if found != wanted {
            return fault("size", format!("{} x {}", found[0], found[1]), format!("{} x {}", wanted[0], wanted[1]));
        }
        if target.format() != self.output.format {
            return fault("format", format!("{:?}", target.format()), format!("{:?}", self.output.format));
        }
        if target.sample_count() != 1 {
            return fault("samples", target.sample_count().to_string(), "1: the frame resolves its own".to_owned());
        }
        if !target.usage().contains(wgpu::TextureUsages::RENDER_ATTACHMENT) {
            return fault("usage", format!("{:?}", target.usage()), "RENDER_ATTACHMENT".to_owned());
        }
        Ok(())
    }

    /// The frame. `clock` times its passes.
    pub(crate) fn encode(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        scene: &mut GpuScene,
        view: &View,
        target: &wgpu::TextureView,
        shown: Shown<'_>,
        clock: &Clock,
    ) -> Result<()> {
        let post = scene.post.filter(|_| matches!(shown, Shown::Picture));
        self.begin_frame(encoder, scene, view, post, shown)?;
        // Skinned and morphed vertices; only where the pose has changed.
        self.encode_deform(encoder, scene, clock);
        if !matches!(shown, Shown::Floor(_)) {
            // What casts on the face, from the light of that shadow, and each character from the key light; only where the
            // pose, the light or a place has changed.
            self.encode_maps(encoder, scene, view, clock);
            // Depth of all surfaces, and their normals and parts, where a material reads them.
            self.encode_prepass(encoder, scene, clock);
        }
        // Light that blooms, and how far it spreads.
        self.encode_glow(encoder, scene, post, clock);
        // One colour pass: opaque, outlines and transparent share their targets, so samples are resolved once.
        let mut pass = self.begin_color_pass(encoder, view, target, post, shown, clock);
        draw_list::bind_scene(&mut pass, scene, self.color_frame_group(scene), &scene.character_group);
        self.record_surfaces(&mut pass, scene, view, shown);
        drop(pass);
        // Bloom, tone curve, background, smooth edges.
        self.encode_post(encoder, view, target, post, clock);
        Ok(())
    }

    /// Every draw of the colour pass.
    fn record_surfaces(&self, pass: &mut wgpu::RenderPass<'_>, scene: &GpuScene, view: &View, shown: Shown<'_>) {
        if let Shown::Floor(floor) = shown {
            return floor.encode(pass, scene);
        }
        let pipelines = scene.shown(shown.sight(view));
        // Body, face, hair.
        opaque::encode(pass, scene, pipelines);
        // Lines around them, hidden where a surface is nearer.
        outline::encode(pass, scene, pipelines);
        // Coats of short hair over both.
        fluff::encode(pass, scene, pipelines, view.px_per_m());
        // Eyes and brows through the bangs.
        eyes_through::encode(pass, scene, pipelines);
        // What is seen through, far before near.
        transparent::encode(pass, scene, pipelines);
    }

    /// Writes what changes with the view: numbers, places, order of transparent draws; makes targets of a new size, and what
    /// shows a channel.
    fn begin_frame(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        scene: &mut GpuScene,
        view: &View,
        post: Option<Post>,
        shown: Shown<'_>,
    ) -> Result<()> {
        let gpu = self.gpu().clone();
        let numbers = self.frame_numbers.fill(|numbers| put_view(numbers, view));
        self.uploads.write(encoder, &self.frame_uniform, 0, numbers);
        scene.place(view);
        scene.fit(self);
        scene.send(&mut self.uploads, encoder, view);
        // Draws of a crowd share one order: that of its first character.
        let eye = view.instances.first().map_or(view.camera.eye, |m| m.inverse().transform_point3(view.camera.eye));
        scene.sort_transparent(eye);
        scene.look(&self.variants, &Picture::new(&gpu, self.output, post.is_some(), shown.sight(view)))?;
        match post {
            Some(post) => self.fit_post(view.size, post)?,
            None if self.color_targets.as_ref().is_none_or(|t| t.size != view.size) => {
                self.color_targets = Some(ColorTargets::new(&gpu, view.size, self.output));
            }
            None => {}
        }
        let has_surfaces = scene.has_inner_lines;
        let fits = |t: &PrepassTargets| t.size == view.size && (t.has_surfaces || !has_surfaces);
        if scene.has_prepass && !self.prepass_targets.as_ref().is_some_and(|(t, _)| fits(t)) {
            let targets = PrepassTargets::new(&gpu, view.size, has_surfaces);
            let group = frame_group(&gpu, &self.layouts, &self.frame_uniform, &targets);
            self.prepass_targets = Some((targets, group));
        }
        Ok(())
    }

    fn encode_deform(&self, encoder: &mut wgpu::CommandEncoder, scene: &mut GpuScene, clock: &Clock) {
        if scene.deformed.stale(scene.pose_revision()).is_some() {
            self.deform.encode(encoder, &DeformInputs { scene }, clock.compute(Timed::Deform));
        }
    }

    fn encode_maps(&self, encoder: &mut wgpu::CommandEncoder, scene: &mut GpuScene, view: &View, clock: &Clock) {
        let key = scene.maps_key(view);
        if scene.maps.stale(key).is_none() {
            return;
        }
        if let (Some(map), Some(reduce)) = (&scene.bangs, &self.bangs_near) {
            let inputs = BangsShadowInputs { scene, frame: &self.frame_group, reduce, map };
            bangs_shadow::encode(encoder, &inputs, clock.render(Timed::BangsShadow));
        }
        if let Some(map) = &scene.shadow {
            let inputs = ShadowInputs { scene, frame: &self.frame_group, map };
            shadow::encode(encoder, &inputs, clock.render(Timed::Shadow));
        }
    }

    fn encode_prepass(&self, encoder: &mut wgpu::CommandEncoder, scene: &GpuScene, clock: &Clock) {
        if let (true, Some((targets, _))) = (scene.has_prepass, &self.prepass_targets) {
            let surfaces = scene.has_inner_lines;
            let drawn = &mut scene.picture.iter().map(|p| p.prepass.as_ref());
            let inputs = PrepassInputs { scene, frame: &self.frame_group, targets, surfaces, drawn };
            prepass::encode(encoder, inputs, clock.render(Timed::Prepass));
        }
    }

    fn encode_glow(&self, encoder: &mut wgpu::CommandEncoder, scene: &GpuScene, post: Option<Post>, clock: &Clock) {
        let targets = self.post_targets.as_ref().filter(|_| post.is_some());
        if let (Some(PostTargets { light: Some((light, chain)), .. }), Some(bloom)) = (targets, &self.bloom) {
            let inputs = GlowInputs { scene, frame: self.color_frame_group(scene), light };
            glow::encode(encoder, &inputs, clock.render(Timed::Glow));
            bloom.encode(encoder, &BloomInputs { chain });
        }
    }

    fn encode_post(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        view: &View,
        target: &wgpu::TextureView,
        post: Option<Post>,
        clock: &Clock,
    ) {
        let Self { uploads, post: pass, post_targets, .. } = self;
        if let (Some(post), Some(targets), Some(pass)) = (post, post_targets, pass) {
            let inputs = PostInputs { post, background: view.background, group: &targets.group, target };
            pass.encode(uploads, encoder, &inputs, clock.render(Timed::Post));
        }
    }

    /// `post`: it is finished by [`Renderer::encode_post`].
    fn begin_color_pass<'a>(
        &self,
        encoder: &'a mut wgpu::CommandEncoder,
        view: &View,
        target: &wgpu::TextureView,
        post: Option<Post>,
        shown: Shown<'_>,
        clock: &Clock,
    ) -> wgpu::RenderPass<'a> {
        let post = self.post_targets.as_ref().filter(|_| post.is_some());
        let targets = post.map_or(self.color_targets.as_ref(), |p| Some(&p.color));
        let target = post.map_or(target, |p| &p.picture);
        let clear = match shown {
            // The background comes last.
            _ if post.is_some() => wgpu::Color::TRANSPARENT,
            Shown::Channel(_) => Background::Color(Srgb([0; 3])).clear_color(self.output),
            _ => view.background.clear_color(self.output),
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
                stencil_ops: pass::color_depth_format(self.gpu())
                    .has_stencil_aspect()
                    .then_some(wgpu::Operations { load: wgpu::LoadOp::Clear(0), store: wgpu::StoreOp::Discard }),
            }),
            timestamp_writes: clock.render(Timed::Color),
            ..Default::default()
        })
    }

    /// Group 0 of the colour pass: with what the prepass drew where a material reads it.
    fn color_frame_group(&self, scene: &GpuScene) -> &wgpu::BindGroup {
        let drawn = self.prepass_targets.as_ref().filter(|_| scene.has_prepass);
        drawn.map_or(&self.frame_group, |(_, group)| group)
    }

    /// Makes what a picture that is finished by [`PostPass`] is drawn into, where there is none of this size and kind.
    fn fit_post(&mut self, size: [u32; 2], post: Post) -> Result<()> {
        let gpu = self.gpu().clone();
        if self.post.is_none() {
            self.post = Some(PostPass::new(&self.variants, self.output)?);
        }
        if post.bloom.is_some() && self.bloom.is_none() {
            self.bloom = Some(BloomPass::new(&self.variants)?);
        }
        let Self { variants, output, bloom, post: Some(pass), post_targets, .. } = self else { return Ok(()) };
        pass.fit(variants, post)?;
        let levels = post.bloom.map(|b| b.levels(size[1]));
        if post_targets.as_ref().is_some_and(|t| t.color.size == size && t.levels == levels) {
            return Ok(());
        }
        let picture = targets::sampled(&gpu, "picture", size, HDR_FORMAT);
        let light = levels.zip(bloom.as_ref()).map(|(levels, bloom)| {
            let glow = glow::target(&gpu, size);
            let chain = bloom.chain(&gpu, &glow, levels);
            (glow, chain)
        });
        // Without bloom its strength is 0, and any picture will do.
        let spread = light.as_ref().map_or(&picture, |(glow, _)| glow);
        *post_targets = Some(PostTargets {
            color: ColorTargets::new(&gpu, size, Output { format: HDR_FORMAT, ..*output }),
            group: pass.group(&gpu, &picture, spread),
            levels,
            picture,
            light,
        });
        Ok(())
    }

    /// Renders one of the prepass's channels as a picture.
    fn render_geometry(&mut self, scene: &mut GpuScene, view: &View) -> Result<Image> {
        let gpu = self.gpu().clone();
        let targets = PrepassTargets::new(&gpu, view.size, true);
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("channel") });
        self.begin_frame(&mut encoder, scene, view, None, Shown::Picture)?;
        self.encode_deform(&mut encoder, scene, &Clock::off());
        // Depth, normal and part id.
        scene.make_geometry(&self.variants)?;
        let drawn = &mut scene.geometry.iter().map(Some);
        let inputs = PrepassInputs { scene, frame: &self.frame_group, targets: &targets, surfaces: true, drawn };
        prepass::encode(&mut encoder, inputs, None);
        gpu.queue.submit([encoder.finish()]);
        let texture = match view.channel {
            Channel::Depth => &targets.depth,
            _ => &targets.surfaces,
        };
        let texels = readback::read_texels(&gpu, texture, FRAME_TIMEOUT)?;
        Ok(view.channel.picture(view, texels))
    }
}

/// What a frame that is finished by [`PostPass`] is drawn into; settings that are numbers do not count.
#[derive(Debug)]
struct PostTargets {
    color: ColorTargets,
    picture: wgpu::TextureView,
    /// Length of the chain below the light that blooms.
    levels: Option<usize>,
    light: Option<(wgpu::TextureView, BloomChain)>,
    group: wgpu::BindGroup,
}

fn frame_group(gpu: &Gpu, layouts: &Layouts, uniform: &wgpu::Buffer, read: &PrepassTargets) -> wgpu::BindGroup {
    let read = [&read.depth_view, &read.surfaces_view].map(BindingResource::TextureView);
    bind::group(gpu, "frame", &layouts.frame, std::iter::once(uniform.as_entire_binding()).chain(read))
}

impl Layouts {
    fn new(gpu: &Gpu, frame_bytes: u64) -> Self {
        use wgpu::{BindingType::Sampler, SamplerBindingType, TextureSampleType as T, TextureViewDimension as D};
        let both = wgpu::ShaderStages::VERTEX_FRAGMENT;
        let read = |ty| (wgpu::ShaderStages::FRAGMENT, ty);
        let frame = [
            (both, bind::uniform(Some(frame_bytes))),
            read(bind::texture(T::Depth, D::D2)),
            read(bind::texture(T::Uint, D::D2)),
        ];
        let numbers = bind::texture(T::Float { filterable: false }, D::D2Array);
        let character = [
            (both, bind::storage()),
            (wgpu::ShaderStages::VERTEX, bind::storage()),
            read(numbers),
            read(numbers),
            read(Sampler(SamplerBindingType::NonFiltering)),
            read(bind::texture(T::Depth, D::D2Array)),
            read(Sampler(SamplerBindingType::Comparison)),
        ];
        Self { frame: bind::layout(gpu, "frame", frame), character: bind::layout(gpu, "character", character) }
    }
}

/// A target that a frame of `size` can be drawn into and read back from.
pub(crate) fn color_target(gpu: &Gpu, size: [u32; 2], output: Output) -> wgpu::TextureView {
    targets::view(&targets::texture(gpu, "target", size, 1, output.format, wgpu::TextureUsages::COPY_SRC))
}
