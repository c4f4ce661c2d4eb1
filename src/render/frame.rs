//! A frame: its passes in their order, and what they draw into.

use wgpu::BindingResource;

use super::blended::BlendedList;
use super::canvas::Canvas;
use super::character::Shown as Drawables;
use super::draw_list::Actors;
use super::environment::{EnvironmentMap, Environments};
use super::finish::Finish;
use super::layers::Layers;
use super::layout::Filled;
use super::numbers::put_view;
use super::pass::background::BackgroundInputs;
use super::pass::bangs_shadow::{self, BangsShadowInputs};
use super::pass::ground::GroundInputs;
use super::pass::prepass::{self, PrepassInputs};
use super::pass::shadow::{self, ShadowInputs};
use super::pass::velocity::{self, VelocityInputs};
use super::pass::{HDR_FORMAT, Sight};
use super::pass::{eyes_through, fluff, opaque, outline, transparent};
use super::scattering::Scattering;
use super::skin_layers::{self, SkinPainter};
use super::take::{Shown, Take};
use super::targets::{self, ColorTargets, PrepassTargets};
use super::temporal::{Following, Temporal};
use super::uploads::Uploads;
use super::{Background, Channel, Clock, FRAME_TIMEOUT, Layouts, Renderer, Timed, View, bind, readback};
use crate::color::Srgb;
use crate::scene::{Antialias, Image, Post};
use crate::stage::bodies::Bodies;
use crate::{Error, Gpu, Result, Stage};

/// Depth, normals and parts, and light that has scattered in skin: over the picture, and over texture coordinates.
type ReadByColor = [wgpu::TextureView; 4];

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
    /// Stands for what a prepass draws where none does.
    no_prepass: PrepassTargets,
    // What few pictures need is made when one does.
    color_targets: Option<ColorTargets>,
    prepass_targets: Option<PrepassTargets>,
    scattering: Option<Scattering>,
    /// Stands for what scatters where nothing does.
    no_scattered: wgpu::TextureView,
    no_skin: wgpu::TextureView,
    skin_painter: Option<SkinPainter>,
    /// Group 0 of the colour pass, with what it reads of other passes, where it reads any.
    color_group: Option<(ReadByColor, wgpu::BindGroup)>,
    layers: Option<Layers>,
    temporal: Option<Temporal>,
    finish: Finish,
    /// Of pictures that are read back.
    pub picture: Option<wgpu::Texture>,
}

impl Frame {
    pub fn new(gpu: &Gpu, layouts: &Layouts, numbers: Filled) -> Self {
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let uniform = bind::buffer(gpu, "frame", numbers.size(), usage);
        let environments = Environments::new(gpu);
        let environment = environments.none();
        let no_prepass = PrepassTargets::new(gpu, [1, 1], false);
        let no_scattered = targets::sampled(gpu, "none", [1, 1], HDR_FORMAT);
        let no_skin = skin_layers::none(gpu);
        let nothing = [&no_prepass.depth_view, &no_prepass.surfaces_view, &no_scattered, &no_skin].map(Clone::clone);
        Self {
            uploads: Uploads::new(gpu),
            blended: BlendedList::new(gpu),
            group: frame_group(gpu, layouts, (&uniform, &environments, &environment), &nothing),
            environments,
            environment,
            numbers,
            uniform,
            no_prepass,
            color_targets: None,
            prepass_targets: None,
            scattering: None,
            no_scattered,
            no_skin,
            skin_painter: None,
            color_group: None,
            layers: None,
            temporal: None,
            finish: Finish::default(),
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
        stage.bodies.adapt(&stage.lights, stage.time_s);
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
            self.encode_skin(r, encoder, stage)?;
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
        // Light that falls on skin, and spreads in it.
        self.encode_scattering(r, encoder, stage, take, clock)?;
        // How far surfaces have moved, where a picture follows another.
        self.encode_velocity(r, encoder, stage, take)?;
        // Light that blooms, and how far it spreads.
        if let Some(actors) = self.color_actors(stage, take) {
            self.finish.encode_glow(r, encoder, take, actors, clock)?;
        }
        // One colour pass: opaque, outlines and transparent share their targets, so samples are resolved once.
        let has_weighted = has_weighted(stage, take);
        let mut pass = self.begin_color_pass(r, encoder, take, has_weighted, clock);
        self.record_surfaces(r, &mut pass, stage, take, &pipelines)?;
        drop(pass);
        // Layers that need no order, over all of it.
        if has_weighted {
            self.encode_layers(encoder, stage, take, &pipelines);
        }
        // With what was seen before; bloom, tone curve, background, smooth edges.
        let following = following.as_ref().zip(self.temporal.as_mut());
        self.finish.encode(r, &mut self.uploads, encoder, take, following, clock);
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
        let frame = self.color_frame_group();
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
            Some(post) => self.finish.fit(r, view.size, *post, target)?,
            None if self.color_targets.as_ref().is_none_or(|t| t.size != view.size) => {
                self.color_targets = Some(ColorTargets::new(&gpu, view.size, r.output));
            }
            None => {}
        }
        if has_weighted(stage, take) {
            Layers::fit(&mut self.layers, r, view.size, picture.output)?;
        }
        let has_surfaces = has_surfaces(stage);
        let fits = |t: &PrepassTargets| t.size == view.size && (t.has_surfaces || !has_surfaces);
        if has_prepass(stage, *post) && !self.prepass_targets.as_ref().is_some_and(fits) {
            self.prepass_targets = Some(PrepassTargets::new(&gpu, view.size, has_surfaces));
        }
        if scatters(stage, take) {
            Scattering::fit(&mut self.scattering, r, view.size)?;
        }
        self.fit_color_group(r, has_prepass(stage, *post), scatters(stage, take), stage.bodies.skin.view());
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
            self.group = frame_group(r.gpu(), &r.layouts, self.shared(), &self.read(false, false, None));
            self.color_group = None;
        }
        Ok(())
    }

    /// What the colour pass reads of other passes.
    fn read(&self, prepass: bool, scattered: bool, skin: Option<&wgpu::TextureView>) -> ReadByColor {
        let drawn = self.prepass_targets.as_ref().filter(|_| prepass).unwrap_or(&self.no_prepass);
        let scattered = self.scattering.as_ref().filter(|_| scattered).map_or(&self.no_scattered, |s| &s.scattered);
        [&drawn.depth_view, &drawn.surfaces_view, scattered, skin.unwrap_or(&self.no_skin)].map(Clone::clone)
    }

    /// Makes group 0 of the colour pass, where it is another than that of other passes and of the last picture.
    fn fit_color_group(&mut self, r: &Renderer, prepass: bool, scattered: bool, skin: Option<&wgpu::TextureView>) {
        let read = self.read(prepass, scattered, skin);
        if !prepass && !scattered && skin.is_none() {
            self.color_group = None;
        } else if self.color_group.as_ref().is_none_or(|(known, _)| *known != read) {
            let group = frame_group(r.gpu(), &r.layouts, self.shared(), &read);
            self.color_group = Some((read, group));
        }
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

    /// Light that falls on skin and spreads over its texture coordinates; only where something has changed that it shows.
    fn encode_skin(&mut self, r: &Renderer, encoder: &mut wgpu::CommandEncoder, stage: &mut Stage) -> Result<()> {
        let has_skin = stage.bodies.list.iter().any(|body| body.skin_layers().next().is_some());
        if !has_skin || !stage.bodies.stale_skin(&stage.lights, stage.time_s) {
            return Ok(());
        }
        let Some(actors) = actors(stage, &self.group, None) else { return Ok(()) };
        let painter = match &mut self.skin_painter {
            Some(painter) => painter,
            none => none.insert(SkinPainter::new(r)?),
        };
        let lights = &stage.lights;
        let (punctual, environment) = (!lights.punctual.is_empty(), lights.environment.is_some());
        painter.encode(r, &mut self.uploads, encoder, actors, Sight { punctual, environment, ..Sight::default() })
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
        if let Some(targets) = &self.prepass_targets {
            let surfaces = has_surfaces(stage);
            let depths = actors.bodies.troupes.iter().map(|t| t.data().depths(&r.variants, surfaces));
            let depths = depths.collect::<Result<Vec<_>>>()?;
            let drawn = &|troupe: usize, draw: usize| depths[troupe][draw].as_ref();
            let inputs = PrepassInputs { actors, targets, surfaces, drawn };
            prepass::encode(encoder, inputs, clock.render(Timed::Prepass));
        }
        Ok(())
    }

    fn encode_scattering(
        &mut self,
        r: &Renderer,
        encoder: &mut wgpu::CommandEncoder,
        stage: &Stage,
        take: &Take<'_>,
        clock: &Clock,
    ) -> Result<()> {
        let actors = actors(stage, &self.group, take.view.first_person).filter(|_| scatters(stage, take));
        if let (Some(actors), Some(scattering)) = (actors, &self.scattering) {
            scattering.encode(r, &mut self.uploads, encoder, actors, (take.view, take.picture.sight), clock)?;
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
        use wgpu::LoadOp;
        let Take { view, target, shown, post, .. } = *take;
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
        let canvas = self.canvas(take);
        let color = canvas.color_attachment(load, goes_on);
        let load = if canvas.keeps_depth {
            LoadOp::Load
        } else {
            LoadOp::Clear(0.0)
        };
        let depth = canvas.depth_attachment(load, goes_on);
        targets::begin(encoder, "colour", Some(color), depth, clock.render(Timed::Color))
    }

    /// What the colour pass of a view draws into.
    fn canvas<'a>(&'a self, take: &Take<'a>) -> Canvas<'a> {
        let target = take.target;
        let apart = self.finish.targets(take);
        let own = apart.map_or(self.color_targets.as_ref(), |a| Some(&a.color));
        // A host resolves its samples itself.
        let resolves = target.depth.is_none() || apart.is_some();
        Canvas {
            color: apart.map_or(target.color, |a| &a.picture),
            multisampled: own.filter(|_| resolves).and_then(|t| t.multisampled.as_ref()),
            depth: target.depth.or_else(|| own.map(|t| &t.depth)),
            keeps_depth: target.depth.is_some(),
        }
    }

    fn encode_layers(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        stage: &Stage,
        take: &Take<'_>,
        pipelines: &[Drawables],
    ) {
        if let (Some(actors), Some(layers)) = (self.color_actors(stage, take), &self.layers) {
            let BlendedList { draws, list, instances } = &self.blended;
            layers.encode(encoder, self.canvas(take), &Actors { list, instances, ..actors }, pipelines, draws);
        }
    }

    /// What passes bind that draw the colour of a view.
    fn color_actors<'a>(&'a self, stage: &'a Stage, take: &Take<'_>) -> Option<Actors<'a>> {
        actors(stage, self.color_frame_group(), take.view.first_person)
    }

    /// Group 0 of the colour pass.
    fn color_frame_group(&self) -> &wgpu::BindGroup {
        self.color_group.as_ref().map_or(&self.group, |(_, group)| group)
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

/// Whether light scatters in something on it over the picture.
fn scatters(stage: &Stage, take: &Take<'_>) -> bool {
    let is_floor = matches!(take.shown, Shown::Floor(_));
    !is_floor && stage.bodies.troupes.iter().any(|troupe| troupe.data().scatter.is_any())
}

/// Whether something on it is weighted.
fn has_weighted(stage: &Stage, take: &Take<'_>) -> bool {
    let is_floor = matches!(take.shown, Shown::Floor(_));
    !is_floor && stage.bodies.troupes.iter().any(|troupe| troupe.data().has_weighted)
}

fn frame_group(
    gpu: &Gpu,
    layouts: &Layouts,
    (uniform, environments, environment): (&wgpu::Buffer, &Environments, &EnvironmentMap),
    [depth, surfaces, scattered, skin]: &ReadByColor,
) -> wgpu::BindGroup {
    let resources = [
        uniform.as_entire_binding(),
        BindingResource::TextureView(depth),
        BindingResource::TextureView(surfaces),
        BindingResource::TextureView(&environment.cube),
        BindingResource::Sampler(&environments.sampler),
        environments.split_sum.as_entire_binding(),
        BindingResource::TextureView(scattered),
        BindingResource::TextureView(skin),
    ];
    bind::group(gpu, "frame", &layouts.frame, resources)
}
