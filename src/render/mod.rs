//! The renderer: a frame as one list of calls.

pub(crate) mod bind;
mod character;
pub(crate) mod check_section;
mod check_wgsl;
mod clock;
pub(crate) mod draw_list;
pub(crate) mod frame;
pub(crate) mod geometry;
pub(crate) mod layout;
pub(crate) mod looks;
pub(crate) mod made;
pub(crate) mod material;
pub(crate) mod pass;
pub(crate) mod readback;
pub mod shaders;
mod target;
mod targets;
mod textures;
mod upload;
pub(crate) mod uploads;
mod uv_metric;
mod variants;
pub(crate) mod vertex;
mod view;

#[cfg(test)]
mod tests;

use std::time::Duration;

pub use character::{Character, GpuMemory};
pub use target::Target;
pub use view::{Background, Channel, View};

pub(crate) use character::CharacterData;
pub(crate) use clock::{Clock, Timed};

use crate::color::Srgb;
use crate::gpu::MAX_TEXTURE_SIDE;
use crate::scene::{Image, Post};
use crate::stage::body::Bodies;
use crate::{Error, Gpu, Result, Stage};
use character::Shown as Drawables;
use draw_list::Actors;
use frame::{frame_numbers, put_view};
use layout::Filled;
use pass::bangs_near::BangsNearPass;
use pass::bangs_shadow::{self, BangsShadowInputs};
use pass::bloom::{BloomChain, BloomInputs, BloomPass};
use pass::deform::DeformPass;
use pass::floor::FloorPass;
use pass::glow::{self, GlowInputs};
use pass::post::{PostInputs, PostPass};
use pass::prepass::{self, PrepassInputs};
use pass::shadow::{self, ShadowInputs};
use pass::{HDR_FORMAT, Picture, Sight, eyes_through, fluff, opaque, outline, transparent};
use shaders::Shaders;
use targets::{ColorTargets, PrepassTargets};
use upload::EmptyMaps;
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
    /// Format of the depth of a host's frame ([`Target::depth`]): `Depth32Float` or `Depth24Plus`, with or without stencil;
    /// eyes through hair need one. Default: `None`, frames with a depth of their own.
    pub depth: Option<wgpu::TextureFormat>,
}

impl Output {
    /// Format of the depth of colour passes.
    pub(crate) fn depth_format(self, gpu: &Gpu) -> wgpu::TextureFormat {
        self.depth.unwrap_or_else(|| pass::color_depth_format(gpu))
    }
}

impl Default for Output {
    fn default() -> Self {
        Self { format: wgpu::TextureFormat::Rgba8UnormSrgb, samples: 4, depth: None }
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
    empty_maps: EmptyMaps,
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
    fn sight(self, stage: &Stage) -> Sight<'a> {
        let channel = match self {
            Self::Channel(channel) => Some(channel),
            Self::Picture | Self::Floor(_) => None,
        };
        Sight { channel, punctual: !stage.lights.punctual.is_empty(), hdr: self.post(stage).is_some() }
    }

    /// What is done to the whole of it.
    fn post(self, stage: &Stage) -> Option<Post> {
        stage.post.filter(|_| matches!(self, Self::Picture))
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
        if let Some(depth) = output.depth {
            use wgpu::TextureFormat as F;
            let known = [F::Depth32Float, F::Depth32FloatStencil8, F::Depth24Plus, F::Depth24PlusStencil8];
            if !known.contains(&depth) {
                let message = format!("is {depth:?}; expected one of {known:?}");
                return Err(Error::Argument { what: "output depth".to_owned(), message });
            }
        }
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
                empty_maps: EmptyMaps::new(gpu),
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

    /// What draws a character as the floor of benches.
    pub(crate) fn floor(&self, of: &Character) -> Result<FloorPass> {
        FloorPass::new(&self.variants, &Picture::new(self.gpu(), self.output, Sight::default()), of)
    }

    /// Renders a view of a stage and reads it back: sRGB, straight alpha, whatever the [`Output`]'s format.
    ///
    /// # Errors
    /// [`Error::Argument`] for a view or a stage out of its domain, a character of another device or output, and for a format
    /// that is neither RGBA nor BGRA with 8 bits nor floats; [`Error::Gpu`] where the adapter fails or does not answer.
    pub fn render(&mut self, stage: &mut Stage, view: &View) -> Result<Image> {
        view.check()?;
        readback::check(self.output.format)?;
        let gpu = self.gpu().clone();
        gpu.scoped(|| {
            let shown = match view.channel {
                Channel::Final => Shown::Picture,
                Channel::Look(channel) => Shown::Channel(channel),
                _ => return self.render_geometry(stage, view),
            };
            let texture = match self.picture_target.take() {
                Some(t) if [t.width(), t.height()] == view.size => t,
                _ => {
                    let copied = wgpu::TextureUsages::COPY_SRC;
                    targets::texture(&gpu, "picture", view.size, 1, self.output.format, copied)
                }
            };
            let mut encoder =
                gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("frame") });
            self.prepare(&mut encoder, stage)?;
            self.encode(&mut encoder, stage, view, Target::from(&targets::view(&texture)), shown, &Clock::off())?;
            gpu.queue.submit([encoder.finish()]);
            let texels = readback::read_texels(&gpu, &texture, FRAME_TIMEOUT)?;
            self.picture_target = Some(texture);
            Ok(readback::picture(view.size, self.output.format, &texels))
        })?
    }

    /// Encodes what all views of a frame share: poses, and maps of shadows; only where something has changed. Once a frame,
    /// before [`Renderer::draw`].
    ///
    /// # Errors
    /// [`Error::Argument`] for a place, a pose or a light that is none, or one of another scene, and for a character of another
    /// device or output; the message names the actor.
    pub fn prepare(&mut self, encoder: &mut wgpu::CommandEncoder, stage: &mut Stage) -> Result<()> {
        self.encode_shared(encoder, stage, true, &Clock::off())
    }

    /// Encodes a view of a stage that is prepared into a [`Target`]: a texture of the output's format for a picture of its own,
    /// or a host's colour and depth. The picture has premultiplied alpha. The application submits. The view's channel does not
    /// count.
    ///
    /// # Errors
    /// [`Error::Argument`] for a view out of its domain, a target of another size, format or number of samples than the
    /// view and the [`Output`] have, and for actors that have come or gone since the stage was prepared.
    pub fn draw<'a>(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        stage: &Stage,
        view: &View,
        target: impl Into<Target<'a>>,
    ) -> Result<()> {
        view.check()?;
        let target = target.into();
        target.check(self.output, view, stage.post.is_some())?;
        self.encode(encoder, stage, view, target, Shown::Picture, &Clock::off())
    }

    /// What views share. `clock` times its passes.
    pub(crate) fn encode_shared(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        stage: &mut Stage,
        with_maps: bool,
        clock: &Clock,
    ) -> Result<()> {
        stage.embody(self)?;
        let gpu = self.gpu().clone();
        // Maps are drawn from lights: of the frame they read the time alone.
        self.send_view(encoder, stage, &View::default());
        stage.bodies.send(&gpu, &mut self.uploads, encoder, stage.lights.directional.to_light);
        // Skinned and morphed vertices; only where the pose has changed.
        self.encode_deform(encoder, &mut stage.bodies, clock);
        if with_maps {
            // What casts on faces, from the light of that shadow, and on everybody from the key light; only where a pose, the
            // light or a place has changed.
            self.encode_maps(encoder, stage, clock)?;
        }
        Ok(())
    }

    /// The frame of a view. `clock` times its passes.
    pub(crate) fn encode(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        stage: &Stage,
        view: &View,
        target: Target<'_>,
        shown: Shown<'_>,
        clock: &Clock,
    ) -> Result<()> {
        let post = shown.post(stage);
        let pipelines = self.begin_view(encoder, stage, view, shown)?;
        if !matches!(shown, Shown::Floor(_)) {
            // Depth of all surfaces, and their normals and parts, where a material reads them.
            self.encode_prepass(encoder, stage, clock)?;
        }
        // Light that blooms, and how far it spreads.
        self.encode_glow(encoder, stage, post, clock);
        // One colour pass: opaque, outlines and transparent share their targets, so samples are resolved once.
        let mut pass = self.begin_color_pass(encoder, view, target, post, shown, clock);
        self.record_surfaces(&mut pass, stage, view, shown, &pipelines);
        drop(pass);
        // Bloom, tone curve, background, smooth edges.
        self.encode_post(encoder, view, target.color, post, clock);
        Ok(())
    }

    /// Every draw of the colour pass.
    fn record_surfaces(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        stage: &Stage,
        view: &View,
        shown: Shown<'_>,
        pipelines: &[Drawables],
    ) {
        let Some(actors) = actors(stage, self.color_frame_group(stage)) else { return };
        if let Shown::Floor(floor) = shown {
            return floor.encode(pass, &actors);
        }
        // Body, face, hair.
        opaque::encode(pass, &actors, pipelines);
        // Lines around them, hidden where a surface is nearer.
        outline::encode(pass, &actors, pipelines);
        // Coats of short hair over both.
        fluff::encode(pass, &actors, pipelines, view.px_per_m(stage.places()));
        // Eyes and brows through the bangs.
        eyes_through::encode(pass, &actors, pipelines);
        // What is seen through, far before near.
        let order = draw_list::transparent_order(&actors.bodies.list, view.camera.eye);
        transparent::encode(pass, &actors, pipelines, &order);
    }

    /// Sends the numbers of a view.
    fn send_view(&mut self, encoder: &mut wgpu::CommandEncoder, stage: &Stage, view: &View) {
        let numbers = self.frame_numbers.fill(|numbers| put_view(numbers, view, stage));
        self.uploads.write(encoder, &self.frame_uniform, 0, numbers);
    }

    /// Sends what changes with the view; makes targets of a new size, and what shows its like for the first time.
    fn begin_view(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        stage: &Stage,
        view: &View,
        shown: Shown<'_>,
    ) -> Result<Vec<Drawables>> {
        if !stage.bodies.are_of(&stage.actors) {
            let message = "has other actors than when it was prepared; please prepare it before it is drawn".to_owned();
            return Err(Error::Argument { what: "stage".to_owned(), message });
        }
        let gpu = self.gpu().clone();
        self.send_view(encoder, stage, view);
        match shown.post(stage) {
            Some(post) => self.fit_post(view.size, post)?,
            None if self.color_targets.as_ref().is_none_or(|t| t.size != view.size) => {
                self.color_targets = Some(ColorTargets::new(&gpu, view.size, self.output));
            }
            None => {}
        }
        let has_surfaces = has_surfaces(stage);
        let fits = |t: &PrepassTargets| t.size == view.size && (t.has_surfaces || !has_surfaces);
        if has_prepass(stage) && !self.prepass_targets.as_ref().is_some_and(|(t, _)| fits(t)) {
            let targets = PrepassTargets::new(&gpu, view.size, has_surfaces);
            let group = frame_group(&gpu, &self.layouts, &self.frame_uniform, &targets);
            self.prepass_targets = Some((targets, group));
        }
        let picture = Picture::new(&gpu, self.output, shown.sight(stage));
        stage.bodies.troupes.iter().map(|troupe| troupe.data().shown(&self.variants, &picture)).collect()
    }

    fn encode_deform(&self, encoder: &mut wgpu::CommandEncoder, bodies: &mut Bodies, clock: &Clock) {
        if bodies.troupes.iter().any(|troupe| !troupe.moved.is_empty()) {
            self.deform.encode(encoder, &mut bodies.troupes, clock.compute(Timed::Deform));
        }
    }

    fn encode_maps(&self, encoder: &mut wgpu::CommandEncoder, stage: &mut Stage, clock: &Clock) -> Result<()> {
        let stale = stage.bodies.stale_maps(stage.lights.directional.to_light, stage.time_s);
        let Some(actors) = actors(stage, &self.frame_group) else { return Ok(()) };
        let bodies = actors.bodies;
        for (n, t) in stale.faces.iter().enumerate() {
            // The first one's time stands for all.
            let clock = clock.render(Timed::BangsShadow).filter(|_| n == 0);
            let of = &bodies.troupes[*t];
            if let (Some(atlas), Some(reduce)) = (&of.bangs, &self.bangs_near) {
                bangs_shadow::encode(encoder, &BangsShadowInputs { actors, reduce, atlas, of }, clock);
            }
        }
        let Some(map) = &bodies.shadow else { return Ok(()) };
        for (n, i) in stale.shadows.iter().enumerate() {
            let clock = clock.render(Timed::Shadow).filter(|_| n == 0);
            let body = &bodies.list[*i];
            let Some(layer) = body.shadow_layer() else { continue };
            let drawn = &|troupe: usize, draw: usize| bodies.troupes[troupe].data().picture()[draw].shadow.as_ref();
            let casters = body.casters.iter().map(|&(troupe, at)| (troupe, at..at + 1));
            shadow::encode(encoder, ShadowInputs { actors, map, layer, drawn }, casters, clock);
        }
        if let Some(layer) = bodies.world_map.layer.filter(|_| stale.world) {
            let all = bodies.troupes.iter().map(|t| t.data().world_shadows(&self.variants));
            let all = all.collect::<Result<Vec<_>>>()?;
            let drawn = &|troupe: usize, draw: usize| all[troupe][draw].as_ref();
            let casters = bodies.troupes.iter().map(|t| t.on_world.clone()).enumerate();
            shadow::encode(encoder, ShadowInputs { actors, map, layer, drawn }, casters, None);
        }
        Ok(())
    }

    fn encode_prepass(&self, encoder: &mut wgpu::CommandEncoder, stage: &Stage, clock: &Clock) -> Result<()> {
        let Some(actors) = actors(stage, &self.frame_group).filter(|_| has_prepass(stage)) else { return Ok(()) };
        if let Some((targets, _)) = &self.prepass_targets {
            let surfaces = has_surfaces(stage);
            let depths = actors.bodies.troupes.iter().map(|t| t.data().depths(&self.variants, surfaces));
            let depths = depths.collect::<Result<Vec<_>>>()?;
            let drawn = &|troupe: usize, draw: usize| depths[troupe][draw].as_ref();
            let inputs = PrepassInputs { actors, targets, surfaces, drawn };
            prepass::encode(encoder, inputs, clock.render(Timed::Prepass));
        }
        Ok(())
    }

    fn encode_glow(&self, encoder: &mut wgpu::CommandEncoder, stage: &Stage, post: Option<Post>, clock: &Clock) {
        let targets = self.post_targets.as_ref().filter(|_| post.is_some());
        if let (Some(PostTargets { light: Some((light, chain)), .. }), Some(bloom)) = (targets, &self.bloom)
            && let Some(actors) = actors(stage, self.color_frame_group(stage))
        {
            glow::encode(encoder, &GlowInputs { actors, light }, clock.render(Timed::Glow));
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
        target: Target<'_>,
        post: Option<Post>,
        shown: Shown<'_>,
        clock: &Clock,
    ) -> wgpu::RenderPass<'a> {
        use wgpu::{LoadOp, Operations, StoreOp};
        let post = self.post_targets.as_ref().filter(|_| post.is_some());
        let own = post.map_or(self.color_targets.as_ref(), |p| Some(&p.color));
        let color = post.map_or(target.color, |p| &p.picture);
        let clear = match shown {
            // The background comes last.
            _ if post.is_some() => wgpu::Color::TRANSPARENT,
            Shown::Channel(_) => Background::Color(Srgb([0; 3])).clear_color(self.output),
            _ => view.background.clear_color(self.output),
        };
        // A host resolves its samples itself.
        let multisampled = own.filter(|_| target.depth.is_none()).and_then(|t| t.multisampled.as_ref());
        let load = if target.keeps_color {
            LoadOp::Load
        } else {
            LoadOp::Clear(clear)
        };
        // Samples that are resolved need not be kept; what is a host's is.
        let store = if multisampled.is_some() {
            StoreOp::Discard
        } else {
            StoreOp::Store
        };
        let depth = target.depth.map(|depth| (depth, LoadOp::Load, StoreOp::Store));
        let depth = depth.or_else(|| own.map(|t| (&t.depth, LoadOp::Clear(0.0), StoreOp::Discard)));
        let has_stencil = self.output.depth_format(self.gpu()).has_stencil_aspect();
        // Whatever a host's stencil holds, marks begin with none.
        let stencil = Operations { load: LoadOp::Clear(0), store: StoreOp::Discard };
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("colour"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: multisampled.unwrap_or(color),
                depth_slice: None,
                resolve_target: multisampled.map(|_| color),
                ops: Operations { load, store },
            })],
            depth_stencil_attachment: depth.map(|(view, load, store)| wgpu::RenderPassDepthStencilAttachment {
                view,
                depth_ops: Some(Operations { load, store }),
                stencil_ops: has_stencil.then_some(stencil),
            }),
            timestamp_writes: clock.render(Timed::Color),
            ..Default::default()
        })
    }

    /// Group 0 of the colour pass: with what the prepass drew where a material reads it.
    fn color_frame_group(&self, stage: &Stage) -> &wgpu::BindGroup {
        let drawn = self.prepass_targets.as_ref().filter(|_| has_prepass(stage));
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
    fn render_geometry(&mut self, stage: &mut Stage, view: &View) -> Result<Image> {
        let gpu = self.gpu().clone();
        let targets = PrepassTargets::new(&gpu, view.size, true);
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("channel") });
        self.encode_shared(&mut encoder, stage, false, &Clock::off())?;
        self.send_view(&mut encoder, stage, view);
        if let Some(actors) = actors(stage, &self.frame_group) {
            // Depth, normal and part id.
            let all = actors.bodies.troupes.iter().map(|t| t.data().geometry(&self.variants));
            let all = all.collect::<Result<Vec<_>>>()?;
            let drawn = &|troupe: usize, draw: usize| all[troupe].get(draw);
            let inputs = PrepassInputs { actors, targets: &targets, surfaces: true, drawn };
            prepass::encode(&mut encoder, inputs, None);
        }
        gpu.queue.submit([encoder.finish()]);
        let texture = match view.channel {
            Channel::Depth => &targets.depth,
            _ => &targets.surfaces,
        };
        let texels = readback::read_texels(&gpu, texture, FRAME_TIMEOUT)?;
        Ok(view.channel.picture(view, texels))
    }
}

/// What passes bind of a stage that is prepared.
fn actors<'a>(stage: &'a Stage, frame: &'a wgpu::BindGroup) -> Option<Actors<'a>> {
    let bodies = &stage.bodies;
    Some(Actors { bodies, crowd: bodies.crowd.as_ref()?, frame })
}

/// Whether something on a stage reads the depth of the picture.
fn has_prepass(stage: &Stage) -> bool {
    stage.bodies.troupes.iter().any(|troupe| troupe.data().has_prepass)
}

/// Whether something on it reads normals and parts.
fn has_surfaces(stage: &Stage) -> bool {
    stage.bodies.troupes.iter().any(|troupe| troupe.data().has_inner_lines)
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
