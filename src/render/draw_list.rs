//! Draws of a scene: made at upload in drawing order; only transparent ones are sorted by distance for each view.

use std::ops::Range;

use glam::Vec3;

use super::character::Shown;
use super::geometry::{Geometry, Part};
use super::material::Composition;
use super::pass::transparent::Layer;
use super::pass::{
    DEPTH_STENCIL_FORMAT, Mark, Picture, Sight, bangs_shadow, eyes_through, fluff, glow, opaque, outline, prepass,
    shadow, transparent, weighted,
};
use super::shaders::{Recipe, Shaders};
use super::variants::{Drawn, Request};
use super::vertex::Instance;
use super::{Output, uv_metric};
use crate::eye::Eyes;
use crate::material::{AlphaMode, Blending, Material, Surroundings};
use crate::motion::Driven;
use crate::scene::{Role, Scene};
use crate::stage::bodies::Bodies;
use crate::stage::body::Body;
use crate::stage::troupe::Troupe;

/// One draw: a range of indices under one material.
#[derive(Debug)]
pub(crate) struct Draw {
    pub material: usize,
    pub indices: Range<u32>,
    /// What of it the character sees of itself, in the indices for that.
    pub first_person: Range<u32>,
    /// Middle of the part at rest, character space.
    pub center: Vec3,
    pub has_vertex_colors: bool,
    pub blend: bool,
    /// Whether it is blended in layers over itself, and not sorted.
    pub layered: bool,
    /// Whether the opaque part of what is blended is drawn for itself.
    pub core: bool,
    /// Whether what is blended is weighted instead of sorted.
    pub weighted: bool,
    pub write_depth: bool,
    pub queue_offset: i32,
    /// Whether it casts on its own face, and whether its lids cast on its eyes.
    pub casts_on_face: bool,
    pub casts_lids: bool,
    pub mark: Mark,
}

/// Triangles of a draw, as others see them and as the character sees itself.
#[derive(Clone, Debug)]
pub(crate) struct Triangles {
    pub third: Range<u32>,
    pub first: Range<u32>,
}

impl Triangles {
    /// For what no view looks at.
    pub fn third(indices: Range<u32>) -> Self {
        Self { third: indices, first: 0..0 }
    }
}

impl Draw {
    /// Whether some of it is solid: has depth, and casts.
    pub fn is_solid(&self) -> bool {
        !self.blend || self.core
    }

    pub fn triangles(&self) -> Triangles {
        Triangles { third: self.indices.clone(), first: self.first_person.clone() }
    }
}

/// What shows a draw, pass by pass: requests at first, then what was made of them.
#[derive(Debug)]
pub(crate) struct Pipelines<P> {
    pub surface: P,
    /// Draws the opaque part of what is blended.
    pub core: Option<P>,
    /// Draws back faces of what is blended before its front faces.
    pub back: Option<P>,
    pub outline: Option<P>,
    /// Draws the shells of its coat.
    pub fluff: Option<P>,
    /// Draws its light that blooms.
    pub glow: Option<P>,
    /// Draws an eye over the hair before it.
    pub through: Option<P>,
    /// Draws it into the map of the bangs.
    pub bangs: Option<P>,
    /// Draws it into the shadow maps of characters.
    pub shadow: Option<P>,
    /// Draws its depth before the picture; nothing does where nothing reads that.
    pub prepass: Option<P>,
}

impl<P> Pipelines<P> {
    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = &P> {
        let Self { surface, core, back, outline, fluff, glow, through, bangs, shadow, prepass } = self;
        let others = [core, back, outline, fluff, glow, through, bangs, shadow, prepass];
        std::iter::once(surface).chain(others.into_iter().flatten())
    }

    /// The same with each made into something else.
    pub fn map<Q, E>(self, mut make: impl FnMut(P) -> Result<Q, E>) -> Result<Pipelines<Q>, E> {
        Ok(Pipelines {
            surface: make(self.surface)?,
            core: self.core.map(&mut make).transpose()?,
            back: self.back.map(&mut make).transpose()?,
            outline: self.outline.map(&mut make).transpose()?,
            fluff: self.fluff.map(&mut make).transpose()?,
            glow: self.glow.map(&mut make).transpose()?,
            through: self.through.map(&mut make).transpose()?,
            bangs: self.bangs.map(&mut make).transpose()?,
            shadow: self.shadow.map(&mut make).transpose()?,
            prepass: self.prepass.map(&mut make).transpose()?,
        })
    }
}

/// One draw for each opaque material, one for each transparent part, in the order in which they are drawn.
pub(super) fn draws(scene: &Scene, parts: &[Part], has_stencil: bool) -> Vec<Draw> {
    let has_marks = scene.eyes_through.is_some() && has_stencil;
    let has_lids = scene.bangs.is_some() && scene.materials.iter().any(|m| m.bangs_shadow.is_some_and(|b| b.lids));
    let mut draws: Vec<Draw> = Vec::new();
    for part in parts {
        let Some(material) = scene.materials.get(part.material) else { continue };
        let blend = material.drawn_mode() == AlphaMode::Blend;
        let core = material.has_core();
        let casts_on_face = scene.bangs.is_some() && (!blend || core) && casts_on_face(part.role);
        let casts_lids = has_lids && matches!(part.role, Role::Face | Role::Lash) && (!blend || core);
        let mark = match mark(part.role) {
            // What is drawn through hair is drawn whole.
            mark if has_marks && (!blend || core && mark == Mark::Hair) => mark,
            _ => Mark::None,
        };
        // Parts are sorted by material, so that those of one material follow each other in the index buffer.
        if let Some(last) = draws.last_mut()
            && !blend
            && last.material == part.material
            && last.indices.end == part.indices.start
            && (last.casts_on_face, last.casts_lids, last.mark) == (casts_on_face, casts_lids, mark)
        {
            last.indices.end = part.indices.end;
            last.first_person.end = part.first_person.end;
            continue;
        }
        draws.push(Draw {
            material: part.material,
            indices: part.indices.clone(),
            first_person: part.first_person.clone(),
            center: part.center,
            has_vertex_colors: part.has_vertex_colors,
            blend,
            layered: material.blending() != Blending::Sorted,
            core,
            weighted: material.blending() == Blending::Weighted,
            write_depth: material.alpha.write_depth,
            queue_offset: material.alpha.queue_offset,
            casts_on_face,
            casts_lids,
            mark,
        });
    }
    // Hair marks what it hides last; cards of a stack follow each other. The sort is stable and leaves blended draws at
    // the end.
    let layer = |d: &Draw| scene.materials[d.material].layer.map_or(0, |l| l.index);
    draws.sort_by_key(|d| (d.blend, has_marks.then_some(d.mark), if d.blend { 0 } else { layer(d) }));
    draws
}

/// What shows each draw. `compositions` are those of the scene's materials.
pub(super) fn requests(
    scene: &Scene,
    draws: &[Draw],
    compositions: &[Composition],
    picture: &Picture<'_>,
) -> Vec<Pipelines<Request>> {
    let blooms = scene.post.is_some_and(|p| p.bloom.is_some());
    let glows = |draw: &Draw| blooms && compositions[draw.material].has("glow");
    let reads = |what| draws.iter().any(|d| compositions[d.material].needs(what));
    let has_surfaces = reads("prepass_surfaces");
    let has_prepass = reads("prepass") || draws.iter().any(glows);
    let request = |draw: &Draw| {
        let (of, material) = (&compositions[draw.material], &scene.materials[draw.material]);
        let colors = draw.has_vertex_colors;
        let casts = scene.self_shadow.is_some() && draw.is_solid() && material.cast_shadow.is_some_and(|s| s.casts);
        Pipelines {
            glow: glows(draw).then(|| glow::request(of, material, colors)),
            bangs: (scene.bangs.is_some() && draw.is_solid()).then(|| bangs_shadow::request(of, colors)),
            shadow: casts.then(|| shadow::request(of, colors)),
            prepass: (has_prepass && draw.is_solid()).then(|| prepass::request(of, material, colors, has_surfaces)),
            ..surface_requests(draw, of, material, picture)
        }
    };
    draws.iter().map(request).collect()
}

/// What a material of a scene is drawn with, in every pass.
pub(super) fn recipes_of(shaders: &Shaders, scene: &Scene, material: usize) -> Vec<Recipe> {
    // What is wrong with them the upload says.
    let eyes = Eyes::of(scene).unwrap_or_default();
    let compositions: Vec<Composition> = Surroundings::of_scene(
        scene,
        &Driven::of(scene),
        &uv_metric::metres_per_uv(scene),
        &uv_metric::uv_boxes(scene),
        &eyes.rows,
    )
    .map(|of| Composition::new(shaders, &of))
    .collect();
    let picture = Picture { output: Output::default(), depth_format: DEPTH_STENCIL_FORMAT, sight: Sight::default() };
    let draws = draws(scene, &Geometry::gather(scene, &eyes).parts, true);
    let all = requests(scene, &draws, &compositions, &picture);
    let of_material = draws.iter().zip(&all).filter(|(draw, _)| draw.material == material);
    of_material.flat_map(|(_, pipelines)| pipelines.iter().map(|r| r.recipe.clone())).collect()
}

/// What shows a draw in the colour pass; debug channels have no lines.
pub(super) fn surface_requests(
    draw: &Draw,
    of: &Composition,
    material: &Material,
    picture: &Picture<'_>,
) -> Pipelines<Request> {
    let colors = draw.has_vertex_colors;
    Pipelines {
        surface: if draw.weighted {
            weighted::request(picture, of, material, colors)
        } else if draw.blend {
            transparent::request(picture, of, material, colors, Layer::Front)
        } else {
            opaque::request(picture, of, material, colors, draw.mark)
        },
        core: draw.core.then(|| transparent::core_request(picture, of, material, colors, draw.mark)),
        back: (material.blending() == Blending::ThreePass)
            .then(|| transparent::request(picture, of, material, colors, Layer::Back)),
        outline: outline::request(picture, of, material, colors).filter(|_| picture.sight.channel.is_none()),
        fluff: (of.has("fluff") && !draw.blend).then(|| fluff::request(picture, of, colors)),
        glow: None,
        through: (draw.mark == Mark::Eyes).then(|| eyes_through::request(picture, of, material, colors)),
        bangs: None,
        shadow: None,
        prepass: None,
    }
}

/// Whether a part of this role casts the shadow on its own face. Skin of the face and what lies on it do not.
pub(super) fn casts_on_face(role: Role) -> bool {
    matches!(role, Role::HairFront | Role::Skin | Role::Cloth | Role::Accessory)
}

/// What a part of this role has to do with eyes through hair.
pub(super) fn mark(role: Role) -> Mark {
    match role {
        Role::Eye | Role::EyeHighlight | Role::EyeWhite | Role::Lash | Role::Brow => Mark::Eyes,
        Role::HairFront | Role::Hair => Mark::Hair,
        _ => Mark::None,
    }
}

/// Eyes and brows, the foremost first: characters face +Z.
pub(super) fn through_order(draws: &[Draw]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..draws.len()).filter(|i| draws[*i].mark == Mark::Eyes).collect();
    order.sort_by(|a, b| draws[*b].center.z.total_cmp(&draws[*a].center.z));
    order
}

/// What every pass over surfaces binds and draws.
#[derive(Clone, Copy)]
pub(crate) struct Actors<'a> {
    pub bodies: &'a Bodies,
    /// What instances stand for.
    pub list: &'a [Instance],
    pub instances: &'a wgpu::Buffer,
    /// Group 0.
    pub frame: &'a wgpu::BindGroup,
    /// Who looks, where it is one of them.
    pub first_person: Option<usize>,
}

impl<'a> Actors<'a> {
    /// All troupes, with what shows their draws.
    pub fn shown(self, shown: &'a [Shown]) -> impl Iterator<Item = (&'a Troupe, &'a Shown)> {
        self.bodies.troupes.iter().zip(shown)
    }

    /// Binds what the draws of a troupe read.
    pub fn bind(&self, pass: &mut wgpu::RenderPass<'_>, troupe: &Troupe) {
        self.bind_group(pass, troupe, 0);
    }

    /// The same while maps of shadows are drawn.
    pub fn bind_without_maps(&self, pass: &mut wgpu::RenderPass<'_>, troupe: &Troupe) {
        self.bind_group(pass, troupe, 1);
    }

    fn bind_group(&self, pass: &mut wgpu::RenderPass<'_>, troupe: &Troupe, which: usize) {
        pass.set_bind_group(0, self.frame, &[]);
        if let Some(groups) = &troupe.groups {
            pass.set_bind_group(1, &groups[which], &[]);
        }
        let data = troupe.data();
        pass.set_vertex_buffer(0, data.static_vertices.slice(..));
        pass.set_vertex_buffer(1, self.instances.slice(..));
        pass.set_index_buffer(data.indices.slice(..), wgpu::IndexFormat::Uint32);
    }

    /// The body that an instance stands for.
    pub fn body(self, instance: u32) -> &'a Body {
        &self.bodies.list[self.list[instance as usize].actor as usize]
    }

    /// Draws triangles of a troupe for all these instances; whoever looks sees its own body without what would be before its
    /// eyes.
    pub fn record(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        troupe: &Troupe,
        triangles: Triangles,
        drawn: &Drawn,
        instances: Range<u32>,
    ) {
        if instances.is_empty() {
            return;
        }
        pass.set_pipeline(&drawn.pipeline);
        let looks = |at: &u32| Some(self.list[*at as usize].actor as usize) == self.first_person;
        let looking = self.first_person.and_then(|_| instances.clone().find(looks));
        let (Some(own), Some(of_first)) = (looking, &troupe.data().first_person) else {
            return self.record_runs(pass, troupe, &triangles.third, drawn, instances);
        };
        self.record_runs(pass, troupe, &triangles.third, drawn, instances.start..own);
        if !triangles.first.is_empty() {
            pass.set_index_buffer(of_first.slice(..), wgpu::IndexFormat::Uint32);
            self.record_runs(pass, troupe, &triangles.first, drawn, own..own + 1);
            pass.set_index_buffer(troupe.data().indices.slice(..), wgpu::IndexFormat::Uint32);
        }
        // Of the shells of a coat there are several.
        self.record(pass, troupe, triangles, drawn, own + 1..instances.end);
    }

    /// Draws instances together but for those whose actor has changed the material.
    fn record_runs(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        troupe: &Troupe,
        indices: &Range<u32>,
        drawn: &Drawn,
        instances: Range<u32>,
    ) {
        if instances.is_empty() || indices.is_empty() {
            return;
        }
        let Some(bound) = &drawn.bound else { return pass.draw_indexed(indices.clone(), 0, instances) };
        let data = troupe.data();
        let edited = |instance: u32| {
            let edits = self.body(instance).edits();
            edits.group(&data.made_by.0, &data.looks, bound)
        };
        let mut first = instances.start;
        while first < instances.end {
            let group = edited(first);
            let mut last = first + 1;
            while group.is_none() && last < instances.end && edited(last).is_none() {
                last += 1;
            }
            pass.set_bind_group(2, group.as_ref().unwrap_or(&bound.group), &[]);
            pass.draw_indexed(indices.clone(), 0, first..last);
            first = last;
        }
    }
}
