//! A frame: its passes in their order, and what they draw into.

use wgpu::BindingResource;

use super::blended::BlendedList;
use super::character::Shown as Drawables;
use super::draw_list::Actors;
use super::environment::{EnvironmentMap, Environments};
use super::layout::Filled;
use super::numbers::put_view;
use super::pass::background::BackgroundInputs;
use super::pass::bangs_shadow::{self, BangsShadowInputs};
use super::pass::bloom::{BloomChain, BloomInputs, BloomPass};
use super::pass::floor::FloorPass;
use super::pass::glow::{self, GlowInputs};
use super::pass::ground::GroundInputs;
use super::pass::post::{PostInputs, PostPass};
use super::pass::prepass::{self, PrepassInputs};
use super::pass::resolve::ResolvePass;
use super::pass::shadow::{self, ShadowInputs};
use super::pass::velocity::{self, VelocityInputs};
use super::pass::weighted::{self, WeightedTargets};
use super::pass::{HDR_FORMAT, Picture, Sight, eyes_through, fluff, opaque, outline, transparent};
use super::targets::{self, ColorTargets, PrepassTargets};
use super::temporal::{Following, Temporal};
use super::uploads::Uploads;
use super::{
    Background, Channel, Clock, FRAME_TIMEOUT, Layouts, Output, Renderer, Target, Timed, View, bind, readback,
};
use crate::color::Srgb;
use crate::scene::{Antialias, Image, Post, ToneCurve};
use crate::stage::bodies::Bodies;
use crate::{Error, Gpu, Result, Stage};

/// What frames are drawn with, and into.
#[derive(Debug)]
pub(super) struct Frame {
    uploads: Uploads,
    blended: BlendedList,
    numbers: Filled,
    uniform: wgpu::Buffer,
    environments: Environments,
    /// That of the stage that is drawn.
    environment: EnvironmentMap,
    /// Group 0 without what a prepass draws.
    group: wgpu::BindGroup,
    // What few pictures need is made when one does.
    bloom: Option<BloomPass>,
    post: Option<PostPass>,
    temporal: Option<Temporal>,
    color_targets: Option<ColorTargets>,
    weighted: Option<Weighted>,
    post_targets: Option<PostTargets>,
    /// With the group 0 that reads them.
    prepass_targets: Option<(PrepassTargets, wgpu::BindGroup)>,
    /// Of pictures that are read back.
    pub picture: Option<wgpu::Texture>,
}

/// What a frame shows.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Shown<'a> {
    /// The finished picture, one of those that follow each other in a window.
    Picture,
    /// The finished picture by itself.
    Still,
    /// One of many finished pictures of which the mean is taken.
    Sample,
    /// A debug channel of shading.
    Channel(&'a str),
    /// The floor of benches.
    Floor(&'a FloorPass),
}

/// A view that is drawn.
pub(super) struct Take<'a> {
    view: &'a View,
    target: &'a Target<'a>,
    shown: Shown<'a>,
    /// It is finished by [`Frame::encode_post`].
    post: Option<Post>,
    picture: Picture<'a>,
}

impl<'a> Take<'a> {
    pub fn new(r: &Renderer, stage: &Stage, view: &'a View, target: &'a Target<'a>, shown: Shown<'a>) -> Self {
        let post = shown.post(stage, target, r.output);
        let picture = Picture::new(r.gpu(), r.output, shown.sight(stage, post));
        Self { view, target, shown, post, picture }
    }
}

impl<'a> Shown<'a> {
    /// What its shaders are made for.
    fn sight(self, stage: &Stage, post: Option<Post>) -> Sight<'a> {
        let channel = match self {
            Self::Channel(channel) => Some(channel),
            _ => None,
        };
        Sight { channel, punctual: !stage.lights.punctual.is_empty(), hdr: post.is_some() }
    }

    /// What is done to the whole of it: what is laid over something goes the same way.
    fn post(self, stage: &Stage, target: &Target<'_>, output: Output) -> Option<Post> {
        let post = stage.post.filter(|_| self.is_finished());
        let post = post.map(|p| Post { antialias: self.antialias(p.antialias), ..p });
        let plain = Post { bloom: None, exposure_ev: 0.0, tone: ToneCurve::None, antialias: Antialias::None };
        post.or_else(|| target.is_laid_over(output).then_some(plain))
    }

    /// Whether it is a picture as a whole.
    fn is_finished(self) -> bool {
        matches!(self, Self::Picture | Self::Still | Self::Sample)
    }

    /// How edges are smoothed, where the stage asks for this.
    fn antialias(self, asked: Antialias) -> Antialias {
        match (self, asked) {
            // What is by itself follows nothing.
            (Self::Sample, _) | (Self::Still, Antialias::Temporal) => Antialias::None,
            _ => asked,
        }
    }
}

impl Frame {
    pub fn new(gpu: &Gpu, layouts: &Layouts, numbers: Filled) -> Self {
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let uniform = bind::buffer(gpu, "frame", numbers.size(), usage);
        let environments = Environments::new(gpu);
        let environment = environments.none();
        let shared = (&uniform, &environments, &environment);
        Self {
            uploads: Uploads::new(gpu),
            blended: BlendedList::new(gpu),
            group: frame_group(gpu, layouts, shared, &PrepassTargets::new(gpu, [1, 1], false)),
            environments,
            environment,
            numbers,
            uniform,
            bloom: None,
            post: None,
            temporal: None,
            color_targets: None,
            weighted: None,
            post_targets: None,
            prepass_targets: None,
            picture: None,
        }
    }

    /// What views share. `clock` times its passes.
    pub fn encode_shared(
        &mut self,
        r: &Renderer,
        encoder: &mut wgpu::CommandEncoder,
        stage: &mut Stage,
        with_maps: bool,
        clock: &Clock,
    ) -> Result<()> {
        stage.embody(r)?;
        let gpu = r.gpu().clone();
        self.fit_environment(r, stage)?;
        // Maps are drawn from lights: of the frame they read the time alone.
        self.send_view(encoder, stage, &View::default(), None);
        let to_light = stage.lights.directional.to_light;
        stage.bodies.send(&gpu, &mut self.uploads, encoder, to_light, stage.ground.as_ref());
        // Where everybody was, for what moves in a window.
        let is_asked = stage.post.is_some_and(|post| post.antialias == Antialias::Temporal);
        stage.bodies.remember(r, &mut self.uploads, encoder, is_asked);
        // Skinned and morphed vertices; only where the pose has changed.
        self.encode_deform(r, encoder, &mut stage.bodies, clock);
        stage.bodies.settle(encoder);
        if with_maps {
            // What casts on faces, from the light of that shadow, and on everybody from the key light; only where a pose, the
            // light or a place has changed.
            self.encode_maps(r, encoder, stage, clock)?;
        }
        Ok(())
    }

    /// The frame of a view. `clock` times its passes.
    pub fn encode(
        &mut self,
        r: &Renderer,
        encoder: &mut wgpu::CommandEncoder,
        stage: &Stage,
        take: &Take<'_>,
        clock: &Clock,
    ) -> Result<()> {
        let (pipelines, following) = self.begin_view(r, encoder, stage, take)?;
        if !matches!(take.shown, Shown::Floor(_)) {
            // Depth of all surfaces, and their normals and parts, where a material reads them.
            self.encode_prepass(r, encoder, stage, take, clock)?;
        }
        // How far surfaces have moved, where a picture follows another.
        self.encode_velocity(r, encoder, stage, take)?;
        // Light that blooms, and how far it spreads.
        self.encode_glow(r, encoder, stage, take, clock)?;
        // One colour pass: opaque, outlines and transparent share their targets, so samples are resolved once.
        let has_weighted = has_weighted(stage, take);
        let mut pass = self.begin_color_pass(r, encoder, take, has_weighted, clock);
        self.record_surfaces(r, &mut pass, stage, take, &pipelines)?;
        drop(pass);
        // Layers that need no order, over all of it.
        if has_weighted {
            self.encode_weighted(r, encoder, stage, take, &pipelines);
        }
        // With what was seen before; bloom, tone curve, background, smooth edges.
        self.encode_post(r, encoder, take, following.as_ref(), clock);
        Ok(())
    }

    /// Every draw of the colour pass.
    fn record_surfaces(
        &self,
        r: &Renderer,
        pass: &mut wgpu::RenderPass<'_>,
        stage: &Stage,
        take: &Take<'_>,
        pipelines: &[Drawables],
    ) -> Result<()> {
        let frame = self.color_frame_group(stage, take.post);
        // What is behind everything.
        if let (true, Background::Environment, Some(_), false) =
            (take.shown.is_finished(), take.view.background, &stage.lights.environment, take.target.keeps_color)
        {
            let map = &self.environment;
            let inputs = BackgroundInputs { variants: &r.variants, picture: &take.picture, map, frame };
            r.background().encode(pass, &inputs)?;
        }
        let Some(actors) = actors(stage, frame, take.view.first_person) else { return Ok(()) };
        if let Shown::Floor(floor) = take.shown {
            floor.encode(pass, &actors);
            return Ok(());
        }
        // Body, face, hair.
        opaque::encode(pass, &actors, pipelines);
        // Lines around them, hidden where a surface is nearer.
        outline::encode(pass, &actors, pipelines);
        // Coats of short hair over both.
        fluff::encode(pass, &actors, pipelines, take.view.px_per_m(stage.places()));
        // Eyes and brows through the bangs.
        eyes_through::encode(pass, &actors, pipelines);
        // What they stand on.
        if let (true, Some(ground), Some(body)) = (take.shown.is_finished(), &stage.ground, &stage.bodies.ground) {
            let inputs = GroundInputs { variants: &r.variants, picture: &take.picture, ground, body, frame };
            r.ground().encode(pass, &inputs)?;
        }
        // What is seen through, far before near.
        let BlendedList { draws, list, instances } = &self.blended;
        transparent::encode(pass, &Actors { list, instances, ..actors }, pipelines, draws);
        Ok(())
    }

    /// Sends the numbers of a view.
    fn send_view(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        stage: &Stage,
        view: &View,
        following: Option<&Following>,
    ) {
        let (view, before) = following.map_or((view, None), |f| (&f.view, Some(f.step.clip_before)));
        let before = before.unwrap_or_else(|| view.clip_from_world());
        let numbers = self.numbers.fill(|numbers| put_view(numbers, view, stage, before));
        self.uploads.write(encoder, &self.uniform, 0, numbers);
    }

    /// Sends what changes with the view; makes targets of a new size, and what shows its like for the first time.
    fn begin_view(
        &mut self,
        r: &Renderer,
        encoder: &mut wgpu::CommandEncoder,
        stage: &Stage,
        take: &Take<'_>,
    ) -> Result<(Vec<Drawables>, Option<Following>)> {
        let Take { view, target, post, picture, shown } = take;
        if !stage.bodies.are_of(&stage.actors) {
            let message = "has other actors than when it was prepared; please prepare it before it is drawn".to_owned();
            return Err(Error::Argument { what: "stage".to_owned(), message });
        }
        if let Some(at) = view.first_person.filter(|at| *at >= stage.actors.len()) {
            let message = format!("is {at}; there are {} actors", stage.actors.len());
            return Err(Error::Argument { what: "first_person".to_owned(), message });
        }
        let gpu = r.gpu().clone();
        self.fit_environment(r, stage)?;
        let following = match post {
            Some(Post { antialias: Antialias::Temporal, .. }) => Some(self.follow(r, stage, view)?),
            _ => None,
        };
        if let (Shown::Picture, None, Some(temporal)) = (shown, &following, &mut self.temporal) {
            temporal.forget(view.history);
        }
        self.send_view(encoder, stage, view, following.as_ref());
        if let Some(crowd) = &stage.bodies.crowd {
            self.blended.arrange(&stage.bodies, crowd, view.camera.eye);
            self.blended.send(&gpu, &mut self.uploads, encoder);
        }
        match post {
            Some(post) => self.fit_post(r, view.size, *post, target)?,
            None if self.color_targets.as_ref().is_none_or(|t| t.size != view.size) => {
                self.color_targets = Some(ColorTargets::new(&gpu, view.size, r.output));
            }
            None => {}
        }
        if has_weighted(stage, take) {
            Weighted::fit(&mut self.weighted, r, view.size, picture.output)?;
        }
        let has_surfaces = has_surfaces(stage);
        let fits = |t: &PrepassTargets| t.size == view.size && (t.has_surfaces || !has_surfaces);
        if has_prepass(stage, *post) && !self.prepass_targets.as_ref().is_some_and(|(t, _)| fits(t)) {
            let targets = PrepassTargets::new(&gpu, view.size, has_surfaces);
            let group = frame_group(&gpu, &r.layouts, self.shared(), &targets);
            self.prepass_targets = Some((targets, group));
        }
        let pipelines = stage.bodies.troupes.iter().map(|troupe| troupe.data().shown(&r.variants, picture));
        Ok((pipelines.collect::<Result<_>>()?, following))
    }

    /// What a picture of a window follows.
    fn follow(&mut self, r: &Renderer, stage: &Stage, view: &View) -> Result<Following> {
        let temporal = match &mut self.temporal {
            Some(temporal) => temporal,
            none => none.insert(Temporal::new(&r.variants)?),
        };
        let ground_y = stage.ground.as_ref().map(|ground| ground.middle.y);
        Ok(temporal.begin(r.gpu(), view, &stage.bodies.past, ground_y, r.output.reach()))
    }

    /// What moved in the last picture that followed another.
    pub fn motion(&self) -> Option<wgpu::Texture> {
        Some(self.temporal.as_ref()?.moved()?.texture.clone())
    }

    fn encode_velocity(
        &self,
        r: &Renderer,
        encoder: &mut wgpu::CommandEncoder,
        stage: &Stage,
        take: &Take<'_>,
    ) -> Result<()> {
        let follows = take.post.is_some_and(|post| post.antialias == Antialias::Temporal);
        let actors = actors(stage, &self.group, take.view.first_person).filter(|_| follows);
        if let (Some(actors), Some(targets)) = (actors, self.temporal.as_ref().and_then(Temporal::moved)) {
            let all = actors.bodies.troupes.iter().map(|t| t.data().velocities(&r.variants));
            let all = all.collect::<Result<Vec<_>>>()?;
            let drawn = &|troupe: usize, draw: usize| all[troupe][draw].as_ref();
            velocity::encode(encoder, &VelocityInputs { actors, targets, drawn });
        }
        Ok(())
    }

    /// Takes the environment of a stage, where it is another than that of the last one.
    fn fit_environment(&mut self, r: &Renderer, stage: &Stage) -> Result<()> {
        let map = self.environments.of(&r.variants, stage.lights.environment.as_ref())?;
        if map.cube != self.environment.cube {
            self.environment = map;
            let gpu = r.gpu();
            self.group = frame_group(gpu, &r.layouts, self.shared(), &PrepassTargets::new(gpu, [1, 1], false));
            if let Some((targets, _)) = self.prepass_targets.take() {
                let group = frame_group(gpu, &r.layouts, self.shared(), &targets);
                self.prepass_targets = Some((targets, group));
            }
        }
        Ok(())
    }

    /// What group 0 holds beside what a prepass draws.
    fn shared(&self) -> (&wgpu::Buffer, &Environments, &EnvironmentMap) {
        (&self.uniform, &self.environments, &self.environment)
    }

    fn encode_deform(&self, r: &Renderer, encoder: &mut wgpu::CommandEncoder, bodies: &mut Bodies, clock: &Clock) {
        if bodies.troupes.iter().any(|troupe| !troupe.moved.is_empty()) {
            r.deform.encode(encoder, &mut bodies.troupes, clock.compute(Timed::Deform));
        }
    }

    fn encode_maps(
        &self,
        r: &Renderer,
        encoder: &mut wgpu::CommandEncoder,
        stage: &mut Stage,
        clock: &Clock,
    ) -> Result<()> {
        let stale = stage.bodies.stale_maps(stage.lights.directional.to_light, stage.time_s);
        let Some(actors) = actors(stage, &self.group, None) else { return Ok(()) };
        let bodies = actors.bodies;
        for (n, t) in stale.faces.iter().enumerate() {
            // The first one's time stands for all.
            let clock = clock.render(Timed::BangsShadow).filter(|_| n == 0);
            let of = &bodies.troupes[*t];
            if let (Some(atlas), Some(reduce)) = (&of.bangs, r.bangs_near.get()) {
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
            let all = bodies.troupes.iter().map(|t| t.data().world_shadows(&r.variants));
            let all = all.collect::<Result<Vec<_>>>()?;
            let drawn = &|troupe: usize, draw: usize| all[troupe][draw].as_ref();
            let casters = bodies.troupes.iter().map(|t| t.on_world.clone()).enumerate();
            shadow::encode(encoder, ShadowInputs { actors, map, layer, drawn }, casters, None);
        }
        Ok(())
    }

    fn encode_prepass(
        &self,
        r: &Renderer,
        encoder: &mut wgpu::CommandEncoder,
        stage: &Stage,
        take: &Take<'_>,
        clock: &Clock,
    ) -> Result<()> {
        let looking = take.view.first_person;
        let Some(actors) = actors(stage, &self.group, looking).filter(|_| has_prepass(stage, take.post)) else {
            return Ok(());
        };
        if let Some((targets, _)) = &self.prepass_targets {
            let surfaces = has_surfaces(stage);
            let depths = actors.bodies.troupes.iter().map(|t| t.data().depths(&r.variants, surfaces));
            let depths = depths.collect::<Result<Vec<_>>>()?;
            let drawn = &|troupe: usize, draw: usize| depths[troupe][draw].as_ref();
            let inputs = PrepassInputs { actors, targets, surfaces, drawn };
            prepass::encode(encoder, inputs, clock.render(Timed::Prepass));
        }
        Ok(())
    }

    fn encode_glow(
        &self,
        r: &Renderer,
        encoder: &mut wgpu::CommandEncoder,
        stage: &Stage,
        take: &Take<'_>,
        clock: &Clock,
    ) -> Result<()> {
        let Take { view, post, .. } = *take;
        let targets = self.post_targets.as_ref().filter(|_| post.is_some());
        if let (Some(PostTargets { light: Some((light, chain)), .. }), Some(bloom)) = (targets, &self.bloom)
            && let Some(actors) = actors(stage, self.color_frame_group(stage, post), view.first_person)
        {
            let all = actors.bodies.troupes.iter().map(|t| t.data().glows(&r.variants)).collect::<Result<Vec<_>>>()?;
            let drawn = &|troupe: usize, draw: usize| all[troupe][draw].as_ref();
            glow::encode(encoder, &GlowInputs { actors, drawn, light }, clock.render(Timed::Glow));
            bloom.encode(encoder, &BloomInputs { chain });
        }
        Ok(())
    }

    fn begin_color_pass<'a>(
        &self,
        r: &Renderer,
        encoder: &'a mut wgpu::CommandEncoder,
        take: &Take<'_>,
        goes_on: bool,
        clock: &Clock,
    ) -> wgpu::RenderPass<'a> {
        let Take { view, target, shown, post, .. } = *take;
        use wgpu::{LoadOp, Operations, StoreOp};
        let post = self.post_targets.as_ref().filter(|_| post.is_some());
        let Into { color, multisampled, depth, keeps_depth } = self.into(take);
        let clear = match shown {
            // The background comes last.
            _ if post.is_some() => wgpu::Color::TRANSPARENT,
            Shown::Channel(_) => Background::Color(Srgb([0; 3])).clear_color(r.output),
            _ => view.background.clear_color(r.output),
        };
        let load = if target.keeps_color && post.is_none() {
            LoadOp::Load
        } else {
            LoadOp::Clear(clear)
        };
        // Samples that are resolved need not be kept; what is a host's is, and what another pass goes on with.
        let kept = |is_kept| {
            if is_kept || goes_on {
                StoreOp::Store
            } else {
                StoreOp::Discard
            }
        };
        let store = kept(multisampled.is_none());
        let depth = depth.map(|depth| {
            let load = if keeps_depth { LoadOp::Load } else { LoadOp::Clear(0.0) };
            depth_attachment(r, depth, load, kept(keeps_depth))
        });
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("colour"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: multisampled.unwrap_or(color),
                depth_slice: None,
                resolve_target: multisampled.filter(|_| !goes_on).map(|_| color),
                ops: Operations { load, store },
            })],
            depth_stencil_attachment: depth,
            timestamp_writes: clock.render(Timed::Color),
            ..Default::default()
        })
    }

    /// What the colour pass of a view draws into.
    fn into<'a>(&'a self, take: &Take<'a>) -> Into<'a> {
        let Take { target, post, .. } = *take;
        let post = self.post_targets.as_ref().filter(|_| post.is_some());
        let own = post.map_or(self.color_targets.as_ref(), |p| Some(&p.color));
        // A host resolves its samples itself.
        let resolves = target.depth.is_none() || post.is_some();
        Into {
            color: post.map_or(target.color, |p| &p.picture),
            multisampled: own.filter(|_| resolves).and_then(|t| t.multisampled.as_ref()),
            depth: target.depth.or_else(|| own.map(|t| &t.depth)),
            keeps_depth: target.depth.is_some(),
        }
    }

    /// Sums weighted layers and lays them over the picture.
    fn encode_weighted(
        &self,
        r: &Renderer,
        encoder: &mut wgpu::CommandEncoder,
        stage: &Stage,
        take: &Take<'_>,
        pipelines: &[Drawables],
    ) {
        use wgpu::{LoadOp, Operations, StoreOp};
        let frame = self.color_frame_group(stage, take.post);
        let (Some(actors), Some(weighted)) = (actors(stage, frame, take.view.first_person), &self.weighted) else {
            return;
        };
        let Into { color, multisampled, depth, .. } = self.into(take);
        let depth = depth.map(|depth| depth_attachment(r, depth, LoadOp::Load, StoreOp::Store));
        let BlendedList { draws, list, instances } = &self.blended;
        let actors = Actors { list, instances, ..actors };
        weighted::encode(encoder, &weighted.targets, depth, &actors, pipelines, draws);
        let store = if multisampled.is_some() {
            StoreOp::Discard
        } else {
            StoreOp::Store
        };
        let over = wgpu::RenderPassColorAttachment {
            view: multisampled.unwrap_or(color),
            depth_slice: None,
            resolve_target: multisampled.map(|_| color),
            ops: Operations { load: LoadOp::Load, store },
        };
        let mut pass = targets::begin(encoder, "resolve", Some(over), None, None);
        weighted.resolve.encode(&mut pass, &weighted.group);
    }

    /// Group 0 of the colour pass: with what the prepass drew where a material reads it.
    fn color_frame_group(&self, stage: &Stage, post: Option<Post>) -> &wgpu::BindGroup {
        let drawn = self.prepass_targets.as_ref().filter(|_| has_prepass(stage, post));
        drawn.map_or(&self.group, |(_, group)| group)
    }

    fn encode_post(
        &mut self,
        r: &Renderer,
        encoder: &mut wgpu::CommandEncoder,
        take: &Take<'_>,
        following: Option<&Following>,
        clock: &Clock,
    ) {
        let Take { view, target, post, .. } = *take;
        let Self { uploads, post: pass, post_targets, temporal, .. } = self;
        if let (Some(post), Some(targets), Some(pass)) = (post, post_targets, pass) {
            let mean = following.zip(temporal.as_mut()).and_then(|(following, temporal)| {
                let read = [&targets.picture, targets.spread()];
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

    /// Makes what a picture that is finished by [`PostPass`] is drawn into, where there is none of this size and kind.
    fn fit_post(&mut self, r: &Renderer, size: [u32; 2], post: Post, target: &Target<'_>) -> Result<()> {
        let gpu = r.gpu().clone();
        if self.post.is_none() {
            self.post = Some(PostPass::new(&r.variants, r.output)?);
        }
        if post.bloom.is_some() && self.bloom.is_none() {
            self.bloom = Some(BloomPass::new(&r.variants)?);
        }
        let Self { bloom, post: Some(pass), post_targets, .. } = self else { return Ok(()) };
        pass.fit(&r.variants, post, target)?;
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
        let spread = spread(&picture, light.as_ref());
        *post_targets = Some(PostTargets {
            color: ColorTargets::new(&gpu, size, Output { format: HDR_FORMAT, ..r.output }),
            group: pass.group(&gpu, &picture, spread),
            levels,
            picture,
            light,
        });
        Ok(())
    }

    /// Renders one of the prepass's channels as a picture.
    pub fn render_geometry(&mut self, r: &Renderer, stage: &mut Stage, view: &View) -> Result<Image> {
        let gpu = r.gpu().clone();
        let targets = PrepassTargets::new(&gpu, view.size, true);
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("channel") });
        self.encode_shared(r, &mut encoder, stage, false, &Clock::off())?;
        self.send_view(&mut encoder, stage, view, None);
        if let Some(actors) = actors(stage, &self.group, view.first_person) {
            // Depth, normal and part id.
            let all = actors.bodies.troupes.iter().map(|t| t.data().geometry(&r.variants));
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
fn actors<'a>(stage: &'a Stage, frame: &'a wgpu::BindGroup, first_person: Option<usize>) -> Option<Actors<'a>> {
    let bodies = &stage.bodies;
    let crowd = bodies.crowd.as_ref()?;
    Some(Actors { bodies, list: &crowd.list, instances: &crowd.instances, frame, first_person })
}

/// Whether something on a stage reads the depth of the picture.
fn has_prepass(stage: &Stage, post: Option<Post>) -> bool {
    let blooms = post.is_some_and(|p| p.bloom.is_some());
    stage.bodies.troupes.iter().any(|troupe| troupe.data().has_prepass || (blooms && troupe.data().has_glow()))
}

/// Whether something on it reads normals and parts.
fn has_surfaces(stage: &Stage) -> bool {
    stage.bodies.troupes.iter().any(|troupe| troupe.data().has_inner_lines)
}

/// Whether something on it is weighted.
fn has_weighted(stage: &Stage, take: &Take<'_>) -> bool {
    let is_floor = matches!(take.shown, Shown::Floor(_));
    !is_floor && stage.bodies.troupes.iter().any(|troupe| troupe.data().has_weighted)
}

/// Depth and stencil of passes of the picture. Whatever a host's stencil holds, marks begin with none.
fn depth_attachment<'a>(
    r: &Renderer,
    view: &'a wgpu::TextureView,
    load: wgpu::LoadOp<f32>,
    store: wgpu::StoreOp,
) -> wgpu::RenderPassDepthStencilAttachment<'a> {
    let stencil = wgpu::Operations { load: wgpu::LoadOp::Clear(0), store: wgpu::StoreOp::Discard };
    let has_stencil = r.output.depth_format(r.gpu()).has_stencil_aspect();
    wgpu::RenderPassDepthStencilAttachment {
        view,
        depth_ops: Some(wgpu::Operations { load, store }),
        stencil_ops: has_stencil.then_some(stencil),
    }
}

/// What a colour pass draws into.
struct Into<'a> {
    color: &'a wgpu::TextureView,
    /// Samples that are resolved into the colour.
    multisampled: Option<&'a wgpu::TextureView>,
    depth: Option<&'a wgpu::TextureView>,
    /// Whether the depth is a host's.
    keeps_depth: bool,
}

/// What weighted layers of a frame are drawn into, and how they get into the picture.
#[derive(Debug)]
struct Weighted {
    targets: WeightedTargets,
    resolve: ResolvePass,
    group: wgpu::BindGroup,
}

impl Weighted {
    /// Makes it where there is none of this size and format.
    fn fit(made: &mut Option<Self>, r: &Renderer, size: [u32; 2], output: Output) -> Result<()> {
        if made.as_ref().is_some_and(|w| w.targets.size == size && w.resolve.is_for(output.format)) {
            return Ok(());
        }
        let resolve = match made.take() {
            Some(known) if known.resolve.is_for(output.format) => known.resolve,
            _ => ResolvePass::new(&r.variants, output)?,
        };
        let targets = WeightedTargets::new(r.gpu(), size, output.samples);
        *made = Some(Self { group: resolve.group(r.gpu(), &targets), targets, resolve });
        Ok(())
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

fn frame_group(
    gpu: &Gpu,
    layouts: &Layouts,
    (uniform, environments, environment): (&wgpu::Buffer, &Environments, &EnvironmentMap),
    read: &PrepassTargets,
) -> wgpu::BindGroup {
    let resources = [
        uniform.as_entire_binding(),
        BindingResource::TextureView(&read.depth_view),
        BindingResource::TextureView(&read.surfaces_view),
        BindingResource::TextureView(&environment.cube),
        BindingResource::Sampler(&environments.sampler),
        environments.split_sum.as_entire_binding(),
    ];
    bind::group(gpu, "frame", &layouts.frame, resources)
}

impl PostTargets {
    /// Light that blooms.
    fn spread(&self) -> &wgpu::TextureView {
        spread(&self.picture, self.light.as_ref())
    }
}

/// Without bloom its strength is 0, and any picture will do.
fn spread<'a>(
    picture: &'a wgpu::TextureView,
    light: Option<&'a (wgpu::TextureView, BloomChain)>,
) -> &'a wgpu::TextureView {
    light.map_or(picture, |(glow, _)| glow)
}
