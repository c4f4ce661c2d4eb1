//! What makes a frame a finished picture: bloom, tone curve, background, smooth edges. The frame is drawn apart for that.

use super::draw_list::Actors;
use super::pass::HDR_FORMAT;
use super::pass::bloom::{BloomChain, BloomInputs, BloomPass};
use super::pass::glow::{self, GlowInputs};
use super::pass::post::{PostInputs, PostPass};
use super::take::Take;
use super::targets::{self, ColorTargets};
use super::temporal::{Following, Temporal};
use super::uploads::Uploads;
use super::{Background, Clock, Output, Renderer, Target, Timed};
use crate::Result;
use crate::scene::Post;

/// Its passes and what they read, made when a picture needs them.
#[derive(Debug, Default)]
pub(super) struct Finish {
    post: Option<PostPass>,
    bloom: Option<BloomPass>,
    targets: Option<PostTargets>,
}

/// What a frame that is finished by [`PostPass`] is drawn into; settings that are numbers do not count.
#[derive(Debug)]
pub(super) struct PostTargets {
    pub color: ColorTargets,
    pub picture: wgpu::TextureView,
    /// Length of the chain below the light that blooms.
    levels: Option<usize>,
    light: Option<(wgpu::TextureView, BloomChain)>,
    group: wgpu::BindGroup,
}

impl Finish {
    /// Makes what a picture is drawn into, where there is none of this size and kind.
    pub fn fit(&mut self, r: &Renderer, size: [u32; 2], post: Post, target: &Target<'_>) -> Result<()> {
        let gpu = r.gpu();
        let pass = match &mut self.post {
            Some(pass) => pass,
            none => none.insert(PostPass::new(&r.variants, r.output)?),
        };
        if post.bloom.is_some() && self.bloom.is_none() {
            self.bloom = Some(BloomPass::new(&r.variants)?);
        }
        pass.fit(&r.variants, post, target)?;
        let levels = post.bloom.map(|b| b.levels(size[1]));
        if self.targets.as_ref().is_some_and(|t| t.color.size == size && t.levels == levels) {
            return Ok(());
        }
        let picture = targets::sampled(gpu, "picture", size, HDR_FORMAT);
        let light = levels.zip(self.bloom.as_ref()).map(|(levels, bloom)| {
            let glow = glow::target(gpu, size);
            let chain = bloom.chain(gpu, &glow, levels);
            (glow, chain)
        });
        let spread = spread(&picture, light.as_ref());
        self.targets = Some(PostTargets {
            color: ColorTargets::new(gpu, size, Output { format: HDR_FORMAT, ..r.output }),
            group: pass.group(gpu, &picture, spread),
            levels,
            picture,
            light,
        });
        Ok(())
    }

    /// What a view is drawn into that is finished this way.
    pub fn targets(&self, take: &Take<'_>) -> Option<&PostTargets> {
        self.targets.as_ref().filter(|_| take.post.is_some())
    }

    /// Draws light that blooms, and spreads it.
    pub fn encode_glow(
        &self,
        r: &Renderer,
        encoder: &mut wgpu::CommandEncoder,
        take: &Take<'_>,
        actors: Actors<'_>,
        clock: &Clock,
    ) -> Result<()> {
        if let (Some(PostTargets { light: Some((light, chain)), .. }), Some(bloom)) = (self.targets(take), &self.bloom)
        {
            let all = actors.bodies.troupes.iter().map(|t| t.data().glows(&r.variants)).collect::<Result<Vec<_>>>()?;
            let drawn = &|troupe: usize, draw: usize| all[troupe][draw].as_ref();
            glow::encode(encoder, &GlowInputs { actors, drawn, light }, clock.render(Timed::Glow));
            bloom.encode(encoder, &BloomInputs { chain });
        }
        Ok(())
    }

    /// Draws the finished picture of a view. `following` mixes it with what was seen before.
    pub fn encode(
        &mut self,
        r: &Renderer,
        uploads: &mut Uploads,
        encoder: &mut wgpu::CommandEncoder,
        take: &Take<'_>,
        following: Option<(&Following, &mut Temporal)>,
        clock: &Clock,
    ) {
        let Take { view, target, post, .. } = *take;
        if let (Some(post), Some(targets), Some(pass)) = (post, &self.targets, &mut self.post) {
            let mean = following.and_then(|(following, temporal)| {
                let read = [&targets.picture, spread(&targets.picture, targets.light.as_ref())];
                temporal.encode(r.gpu(), uploads, encoder, &following.step, pass, read)
            });
            // What is kept is behind it.
            let background = if target.keeps_color {
                Background::Transparent
            } else {
                view.background
            };
            let group = mean.as_ref().unwrap_or(&targets.group);
            let inputs = PostInputs { post, background, group, target: target.color };
            pass.encode(uploads, encoder, &inputs, clock.render(Timed::Post));
        }
    }
}

/// Light that blooms. Without bloom its strength is 0, and any picture will do.
fn spread<'a>(
    picture: &'a wgpu::TextureView,
    light: Option<&'a (wgpu::TextureView, BloomChain)>,
) -> &'a wgpu::TextureView {
    light.map_or(picture, |(glow, _)| glow)
}
