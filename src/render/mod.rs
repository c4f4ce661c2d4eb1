//! The renderer: what it is made of, and what may be asked of it.

mod accumulate;
pub(crate) mod bind;
mod blended;
mod canvas;
mod character;
pub(crate) mod check_section;
mod check_wgsl;
mod clock;
pub(crate) mod draw_list;
pub(crate) mod environment;
mod finish;
mod frame;
pub(crate) mod geometry;
mod layers;
pub(crate) mod layout;
pub(crate) mod looks;
pub(crate) mod made;
pub(crate) mod material;
pub(crate) mod numbers;
pub(crate) mod pass;
pub(crate) mod readback;
mod scattering;
pub mod shaders;
pub(crate) mod skin_layers;
mod take;
mod target;
mod targets;
mod temporal;
mod textures;
mod upload;
pub(crate) mod uploads;
mod uv_metric;
mod variants;
pub(crate) mod vertex;
mod view;
mod wgsl_files;

#[cfg(test)]
mod tests;

use std::sync::{Mutex, OnceLock};
use std::time::Duration;

pub use accumulate::MOST_ACCUMULATED;
pub use character::{Character, GpuMemory};
pub use target::Target;
pub use view::{Background, Channel, View};

pub(crate) use character::CharacterData;
pub(crate) use clock::{Clock, Timed};
pub(crate) use take::Shown;

use crate::gpu::MAX_TEXTURE_SIDE;
use crate::scene::Image;
use crate::{Error, Gpu, Result, Stage};
use frame::Frame;
use made::lock;
use numbers::frame_numbers;
use pass::background::BackgroundPass;
use pass::bangs_near::BangsNearPass;
use pass::deform::DeformPass;
use pass::floor::FloorPass;
use pass::ground::GroundPass;
use pass::{Picture, Sight};
use shaders::Shaders;
use take::Take;
use upload::EmptyMaps;
use variants::Variants;

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
    /// The depth of a host's frame ([`Target::depth`]). Default: `None`, frames with a depth of their own.
    pub depth: Option<HostDepth>,
}

/// The depth of a host's frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HostDepth {
    /// `Depth32Float` or `Depth24Plus`, with or without stencil; eyes through hair need one, and nothing is seen through
    /// without.
    pub format: wgpu::TextureFormat,
    /// Where the far plane lies.
    pub far: Far,
}

/// Where the far plane of a depth lies, or infinity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Far {
    /// At 0: reversed, what is nearer is greater.
    #[default]
    Zero,
    /// At 1: what is nearer is less.
    One,
}

impl Output {
    /// Format of the depth of colour passes.
    pub(crate) fn depth_format(self, gpu: &Gpu) -> wgpu::TextureFormat {
        self.depth.map_or_else(|| pass::color_depth_format(gpu), |depth| depth.format)
    }

    /// Share of a pixel over which pictures are moved that are averaged. Four samples lie within a pixel already: places that
    /// fill all of it would blur.
    pub(crate) fn reach(self) -> f32 {
        if self.samples == 4 { 0.4 } else { 1.0 }
    }
}

impl Default for Output {
    fn default() -> Self {
        Self { format: wgpu::TextureFormat::Rgba8UnormSrgb, samples: 4, depth: None }
    }
}

/// Draws stages. One for each device and output. Any number of threads may use it together: one draws frames while another
/// uploads the next character.
#[derive(Debug)]
pub struct Renderer {
    output: Output,
    pub(crate) variants: Variants,
    layouts: Layouts,
    deform: DeformPass,
    // Made when a stage needs it.
    bangs_near: OnceLock<BangsNearPass>,
    ground: OnceLock<GroundPass>,
    background: OnceLock<BackgroundPass>,
    empty_maps: EmptyMaps,
    frame: Mutex<Frame>,
}

/// Bind group layouts of what all materials share.
#[derive(Debug)]
struct Layouts {
    /// Group 0.
    frame: wgpu::BindGroupLayout,
    /// Group 1.
    character: wgpu::BindGroupLayout,
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
            if !known.contains(&depth.format) {
                let message = format!("is {:?}; expected one of {known:?}", depth.format);
                return Err(Error::Argument { what: "output depth".to_owned(), message });
            }
        }
        if output.samples != 1 && output.samples != 4 {
            let message = format!("is {}; expected 1 or 4", output.samples);
            return Err(Error::Argument { what: "samples".to_owned(), message });
        }
        gpu.scoped(|| {
            let numbers = frame_numbers();
            let layouts = Layouts::new(gpu, numbers.size());
            let variants = Variants::new(gpu, Shaders::new()?, layouts.frame.clone(), layouts.character.clone());
            Ok(Self {
                output,
                deform: DeformPass::new(&variants)?,
                variants,
                frame: Mutex::new(Frame::new(gpu, &layouts, numbers)),
                layouts,
                bangs_near: OnceLock::new(),
                ground: OnceLock::new(),
                background: OnceLock::new(),
                empty_maps: EmptyMaps::new(gpu),
            })
        })?
    }

    pub(crate) fn gpu(&self) -> &Gpu {
        &self.variants.gpu
    }

    /// Makes the pass of nearest depths where a character needs it.
    fn make_bangs_near(&self) -> Result<()> {
        if self.bangs_near.get().is_none() {
            // Another thread may have made the same meanwhile.
            let _ = self.bangs_near.set(BangsNearPass::new(&self.variants)?);
        }
        Ok(())
    }

    /// What draws grounds.
    pub(crate) fn ground(&self) -> &GroundPass {
        self.ground.get_or_init(|| GroundPass::new(self.gpu(), &self.layouts.frame))
    }

    /// What draws environments behind everything.
    pub(crate) fn background(&self) -> &BackgroundPass {
        self.background.get_or_init(|| BackgroundPass::new(self.gpu(), &self.layouts.frame))
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
    pub fn render(&self, stage: &mut Stage, view: &View) -> Result<Image> {
        view.check()?;
        readback::check(self.output.format)?;
        self.gpu().scoped(|| {
            let shown = match view.channel {
                Channel::Final => Shown::Still,
                Channel::Look(channel) => Shown::Channel(channel),
                _ => return lock(&self.frame).render_geometry(self, stage, view),
            };
            Ok(readback::picture(view.size, self.output.format, &self.texels(stage, view, shown)?))
        })?
    }

    /// Texels of a view that is drawn into a picture of its own.
    fn texels(&self, stage: &mut Stage, view: &View, shown: Shown<'_>) -> Result<Vec<u8>> {
        let gpu = self.gpu();
        let kept = lock(&self.frame).picture.take().filter(|t| [t.width(), t.height()] == view.size);
        let texture = kept.unwrap_or_else(|| {
            targets::texture(gpu, "picture", view.size, 1, self.output.format, wgpu::TextureUsages::COPY_SRC)
        });
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("frame") });
        self.prepare(&mut encoder, stage)?;
        self.encode(&mut encoder, stage, view, Target::from(&targets::view(&texture)), shown, &Clock::off())?;
        gpu.queue.submit([encoder.finish()]);
        let texels = readback::read_texels(gpu, &texture, FRAME_TIMEOUT)?;
        lock(&self.frame).picture = Some(texture);
        Ok(texels)
    }

    /// Encodes what all views of a frame share: poses, and maps of shadows; only where something has changed. Once a frame,
    /// before [`Renderer::draw`].
    ///
    /// # Errors
    /// [`Error::Argument`] for a place, a pose or a light that is none, or one of another scene, and for a character of another
    /// device or output; the message names the actor.
    pub fn prepare(&self, encoder: &mut wgpu::CommandEncoder, stage: &mut Stage) -> Result<()> {
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
        &self,
        encoder: &mut wgpu::CommandEncoder,
        stage: &Stage,
        view: &View,
        target: impl Into<Target<'a>>,
    ) -> Result<()> {
        view.check()?;
        let target = target.into();
        target.check(self.output, view)?;
        self.encode(encoder, stage, view, target, Shown::Picture, &Clock::off())
    }

    /// What views share. `clock` times its passes.
    pub(crate) fn encode_shared(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        stage: &mut Stage,
        with_maps: bool,
        clock: &Clock,
    ) -> Result<()> {
        lock(&self.frame).encode_shared(self, encoder, stage, with_maps, clock)
    }

    /// The frame of a view. `clock` times its passes.
    pub(crate) fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        stage: &Stage,
        view: &View,
        target: Target<'_>,
        shown: Shown<'_>,
        clock: &Clock,
    ) -> Result<()> {
        let take = Take::new(self, stage, view, &target, shown);
        lock(&self.frame).encode(self, encoder, stage, &take, clock)
    }
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
            read(bind::filtered(D::Cube)),
            read(Sampler(SamplerBindingType::Filtering)),
            read(bind::uniform(None)),
            read(bind::filtered(D::D2)),
            read(bind::filtered(D::D2Array)),
        ];
        let numbers = bind::texture(T::Float { filterable: false }, D::D2Array);
        let character = [
            (both, bind::storage()),
            (wgpu::ShaderStages::VERTEX, bind::storage()),
            read(numbers),
            read(numbers),
            read(Sampler(SamplerBindingType::NonFiltering)),
            (both, bind::texture(T::Depth, D::D2Array)),
            (both, Sampler(SamplerBindingType::Comparison)),
        ];
        Self { frame: bind::layout(gpu, "frame", frame), character: bind::layout(gpu, "character", character) }
    }
}

/// A target that a frame of `size` can be drawn into and read back from.
pub(crate) fn color_target(gpu: &Gpu, size: [u32; 2], output: Output) -> wgpu::TextureView {
    targets::view(&targets::texture(gpu, "target", size, 1, output.format, wgpu::TextureUsages::COPY_SRC))
}
