//! A character on the GPU: what all actors of it share.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, OnceLock};

use super::Output;
use super::blended::MOST_APART;
use super::draw_list::{self, Draw, Pipelines};
use super::geometry::Rig;
use super::looks::Looks;
use super::made::lock;
use super::pass::bangs_shadow::BangsFit;
use super::pass::deform::DeformSource;
use super::pass::scatter::ScatterTaps;
use super::pass::shadow::{self, ShadowFit};
use super::pass::{Picture, Sight};
use super::pass::{glow, irradiance, irradiance_uv, prepass, velocity};
use super::skin_layers::SkinPart;
use super::variants::{Bound, Drawn, Request, Variant, Variants};
use crate::material::Material;
use crate::motion::Skeleton;
use crate::scene::Scene;
use crate::{Gpu, Result};

/// A character on the GPU. Made by [`Renderer::upload`](crate::Renderer::upload); clones are the same one, and any number of
/// [`Actor`](crate::Actor)s may be of it.
#[derive(Clone, Debug)]
pub struct Character(pub(crate) Arc<CharacterData>);

/// What [`Character`] holds.
#[derive(Debug)]
pub(crate) struct CharacterData {
    /// The device and the output of the renderer that has uploaded it.
    pub made_by: (Gpu, Output),
    /// Without images, and of the meshes with what measures them alone.
    pub scene: Scene,
    pub skeleton: Skeleton,
    pub static_vertices: wgpu::Buffer,
    pub indices: wgpu::Buffer,
    /// What it sees of itself.
    pub first_person: Option<wgpu::Buffer>,
    pub source: DeformSource,
    pub rig: Rig,
    pub looks: Looks,
    pub draws: Vec<Draw>,
    pub has_blended: bool,
    /// Whether some of that is weighted.
    pub has_weighted: bool,
    /// What shows each draw in the picture that the upload has made ready.
    pub picture: OnceLock<Shown>,
    /// The same by what the shaders were made for.
    pub shown: Mutex<BTreeMap<Seen, Shown>>,
    /// Groups of materials, by what shaders bind of them.
    pub groups: Mutex<Vec<Bound>>,
    /// Depth of every draw that is not blended; with normals and parts, and without.
    pub depths: Mutex<[Option<Depths>; 2]>,
    /// What draws each into the shadow map of a whole stage.
    pub world_shadows: OnceLock<Depths>,
    /// What draws the light of each that blooms.
    pub glows: OnceLock<Depths>,
    /// What draws the movement of each draw that is not blended.
    pub velocities: OnceLock<Depths>,
    /// What draws the light on skin, by whether lamps and an environment shine.
    pub irradiances: Mutex<BTreeMap<[bool; 2], Depths>>,
    /// The same of skin whose light is spread over texture coordinates.
    pub uv_irradiances: Mutex<BTreeMap<[bool; 2], Depths>>,
    /// Depth, normal and part of every draw, for the channels that show these.
    pub geometry: OnceLock<Vec<Drawn>>,
    /// Eyes and brows that are seen through hair, the foremost first.
    pub through_order: Vec<usize>,
    pub bangs: Option<BangsFit>,
    pub shadow: Option<ShadowFit>,
    /// Whether a material reads the depth of the picture, and its normals and parts.
    pub has_prepass: bool,
    pub has_inner_lines: bool,
    /// Whether time moves what is cut out of a material.
    pub cuts_move: bool,
    /// Most taps that are asked for, of light that spreads over the picture.
    pub scatter: ScatterTaps,
    /// Skin whose light is spread over texture coordinates, a layer for each.
    pub skin_layers: Vec<SkinPart>,
    /// Most shells of a coat.
    pub shells: u32,
    pub part_materials: Vec<usize>,
    pub triangles: usize,
    pub texture_bytes: u64,
}

/// What shows each draw.
pub(crate) type Shown = Arc<[Pipelines<Drawn>]>;
/// What draws the depth of each.
pub(crate) type Depths = Arc<[Option<Drawn>]>;
/// What a picture's shaders were made for: channel; point and spot lights, an environment, half floats.
pub(crate) type Seen = (Option<String>, [bool; 3]);

pub(crate) fn seen(sight: Sight<'_>) -> Seen {
    let Sight { channel, punctual, environment, hdr } = sight;
    (channel.map(str::to_owned), [punctual, environment, hdr])
}

/// Bytes that a [`Character`] takes on the GPU.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct GpuMemory {
    /// Textures with their mips.
    pub textures: u64,
    /// Vertices, indices, morphs, influences, uniforms.
    pub geometry: u64,
}

impl std::iter::Sum for GpuMemory {
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        all.fold(Self::default(), |a, b| Self { textures: a.textures + b.textures, geometry: a.geometry + b.geometry })
    }
}

impl Character {
    /// The scene that it was made of, without its images and with positions and influences alone of its meshes: nodes, bones,
    /// materials and expressions for poses, and what [`View::framed`](crate::View::framed) measures.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.0.scene
    }

    /// What moves of it.
    #[must_use]
    pub fn skeleton(&self) -> &Skeleton {
        &self.0.skeleton
    }

    /// Draw calls of the colour pass with everything in view, outlines and coats of fluff included.
    #[must_use]
    pub fn draw_count(&self) -> usize {
        self.draw_count_of(1)
    }

    /// The same of so many actors: what is not blended is drawn for all of them together, and what is for those of a crowd.
    pub(crate) fn draw_count_of(&self, actors: usize) -> usize {
        let has = |p: &Option<Drawn>| usize::from(p.is_some());
        let count = |p: &Pipelines<Drawn>| 1 + has(&p.outline) + has(&p.fluff) + has(&p.back);
        let apart = if actors > MOST_APART { 1 } else { actors };
        let times = |draw: &Draw| if draw.blend { apart } else { 1 };
        self.0.draws.iter().zip(self.0.picture()).map(|(draw, p)| times(draw) * count(p) + has(&p.core)).sum()
    }

    /// Whether they are the same one.
    pub(crate) fn is(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }

    /// Triangles, outlines not counted.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        self.0.triangles
    }

    /// Material of a part; parts are what [`Channel::PartId`](super::Channel::PartId) numbers.
    #[must_use]
    pub fn part_material(&self, part: usize) -> Option<usize> {
        self.0.part_materials.get(part).copied()
    }

    /// Bytes on the GPU; those of its actors' vertices and maps come on top.
    #[must_use]
    pub fn memory(&self) -> GpuMemory {
        let data = &self.0;
        let buffers = [&data.static_vertices, &data.indices, &data.looks.numbers].map(wgpu::Buffer::size);
        GpuMemory { textures: data.texture_bytes, geometry: data.source.bytes() + buffers.iter().sum::<u64>() }
    }
}

impl CharacterData {
    /// What shows each draw in the picture that the upload has made ready.
    pub fn picture(&self) -> &[Pipelines<Drawn>] {
        self.picture.get().map_or(&[], |shown| shown)
    }

    /// The material of a draw as it was uploaded.
    pub fn material(&self, draw: &Draw) -> &Material {
        &self.looks.sources[draw.material]
    }

    /// What a variant draws a material with; groups of the same layout are shared.
    pub fn bind(&self, gpu: &Gpu, variant: Variant, material: usize) -> Drawn {
        let bound = variant.bound.map(|layout| {
            let mut groups = lock(&self.groups);
            let known = groups.iter().find(|g| g.material == material && Arc::ptr_eq(&g.layout, &layout));
            known.cloned().unwrap_or_else(|| {
                let group = self.looks.group(gpu, material, &layout, &self.looks.numbers, None);
                let bound = Bound { material, layout, group };
                groups.push(bound.clone());
                bound
            })
        });
        Drawn { pipeline: variant.pipeline, bound }
    }

    /// What is drawn with, of what was asked for.
    pub fn made(&self, variants: &Variants, requests: Vec<Pipelines<Request>>) -> Result<Shown> {
        variants.get_all(requests.iter().flat_map(Pipelines::iter))?;
        let draws = requests.into_iter().zip(&self.draws);
        draws.map(|(r, draw)| r.map(|r| Ok(self.bind(&variants.gpu, variants.get(&r)?, draw.material)))).collect()
    }

    /// What shows each draw of a picture, made when somebody first looks at its like.
    pub fn shown(&self, variants: &Variants, picture: &Picture<'_>) -> Result<Shown> {
        let seen = seen(picture.sight);
        if let Some(shown) = lock(&self.shown).get(&seen) {
            return Ok(Arc::clone(shown));
        }
        let request = |draw: &Draw| {
            let (of, material) = (&self.looks.compositions[draw.material], self.material(draw));
            draw_list::surface_requests(draw, of, material, picture)
        };
        let made = self.made(variants, self.draws.iter().map(request).collect())?;
        lock(&self.shown).insert(seen, Arc::clone(&made));
        Ok(made)
    }

    fn depth(&self, variants: &Variants, draw: &Draw, surfaces: bool) -> Result<Drawn> {
        let (of, material) = (&self.looks.compositions[draw.material], self.material(draw));
        let request = prepass::request(of, material, draw.has_vertex_colors, surfaces);
        Ok(self.bind(&variants.gpu, variants.get(&request)?, draw.material))
    }

    /// What draws the depth of each draw that is not blended.
    pub fn depths(&self, variants: &Variants, surfaces: bool) -> Result<Depths> {
        if let Some(depths) = &lock(&self.depths)[usize::from(surfaces)] {
            return Ok(Arc::clone(depths));
        }
        let depth = |draw: &Draw| draw.is_solid().then(|| self.depth(variants, draw, surfaces)).transpose();
        let made: Depths = self.draws.iter().map(depth).collect::<Result<_>>()?;
        lock(&self.depths)[usize::from(surfaces)] = Some(Arc::clone(&made));
        Ok(made)
    }

    /// What draws into the shadow map of a whole stage: all that is not blended, but for what casts nothing.
    pub fn world_shadows(&self, variants: &Variants) -> Result<Depths> {
        if let Some(known) = self.world_shadows.get() {
            return Ok(Arc::clone(known));
        }
        let casts = |draw: &Draw| draw.is_solid() && self.material(draw).cast_shadow.is_none_or(|s| s.casts);
        let drawn = |draw: &Draw| {
            let request = shadow::request(&self.looks.compositions[draw.material], draw.has_vertex_colors);
            Ok(self.bind(&variants.gpu, variants.get(&request)?, draw.material))
        };
        let made = self.draws.iter().map(|draw| casts(draw).then(|| drawn(draw)).transpose()).collect::<Result<_>>()?;
        Ok(Arc::clone(self.world_shadows.get_or_init(|| made)))
    }

    /// Whether some of it blooms where a picture does.
    pub fn has_glow(&self) -> bool {
        self.draws.iter().any(|draw| self.looks.compositions[draw.material].has("glow"))
    }

    /// What draws the light that blooms.
    pub fn glows(&self, variants: &Variants) -> Result<Depths> {
        if let Some(known) = self.glows.get() {
            return Ok(Arc::clone(known));
        }
        let drawn = |draw: &Draw| {
            let (of, material) = (&self.looks.compositions[draw.material], self.material(draw));
            let glows = of.has("glow").then(|| glow::request(of, material, draw.has_vertex_colors));
            glows.map(|request| Ok(self.bind(&variants.gpu, variants.get(&request)?, draw.material))).transpose()
        };
        let made = self.draws.iter().map(drawn).collect::<Result<_>>()?;
        Ok(Arc::clone(self.glows.get_or_init(|| made)))
    }

    /// What draws the movement of each draw that is not blended.
    pub fn velocities(&self, variants: &Variants) -> Result<Depths> {
        if let Some(known) = self.velocities.get() {
            return Ok(Arc::clone(known));
        }
        let drawn = |draw: &Draw| {
            let (of, material) = (&self.looks.compositions[draw.material], self.material(draw));
            let request = velocity::request(of, material, draw.has_vertex_colors);
            Ok(self.bind(&variants.gpu, variants.get(&request)?, draw.material))
        };
        let made =
            self.draws.iter().map(|draw| (!draw.blend).then(|| drawn(draw)).transpose()).collect::<Result<_>>()?;
        Ok(Arc::clone(self.velocities.get_or_init(|| made)))
    }

    /// What draws the light on skin that spreads over the picture.
    pub fn irradiances(&self, variants: &Variants, sight: Sight<'_>) -> Result<Depths> {
        let by = [sight.punctual, sight.environment];
        if let Some(known) = lock(&self.irradiances).get(&by) {
            return Ok(Arc::clone(known));
        }
        let drawn = |draw: &Draw| {
            let (of, material) = (&self.looks.compositions[draw.material], self.material(draw));
            let is_skin = of.is_on("skin_screen_space");
            let request = is_skin.then(|| irradiance::request(of, material, draw.has_vertex_colors, sight));
            request.map(|request| Ok(self.bind(&variants.gpu, variants.get(&request)?, draw.material))).transpose()
        };
        let made: Depths = self.draws.iter().map(drawn).collect::<Result<_>>()?;
        lock(&self.irradiances).insert(by, Arc::clone(&made));
        Ok(made)
    }

    /// What draws the light on skin that spreads over texture coordinates.
    pub fn uv_irradiances(&self, variants: &Variants, sight: Sight<'_>) -> Result<Depths> {
        let by = [sight.punctual, sight.environment];
        if let Some(known) = lock(&self.uv_irradiances).get(&by) {
            return Ok(Arc::clone(known));
        }
        let drawn = |draw: &Draw| {
            let of = &self.looks.compositions[draw.material];
            let is_skin = of.is_on("skin_texture_space");
            let request = is_skin.then(|| irradiance_uv::request(of, draw.has_vertex_colors, sight));
            request.map(|request| Ok(self.bind(&variants.gpu, variants.get(&request)?, draw.material))).transpose()
        };
        let made: Depths = self.draws.iter().map(drawn).collect::<Result<_>>()?;
        lock(&self.uv_irradiances).insert(by, Arc::clone(&made));
        Ok(made)
    }

    /// What draws depth, normal and part of every draw.
    pub fn geometry(&self, variants: &Variants) -> Result<&[Drawn]> {
        if self.geometry.get().is_none() {
            let made = self.draws.iter().map(|draw| self.depth(variants, draw, true)).collect::<Result<_>>()?;
            // Another thread may have made the same meanwhile.
            let _ = self.geometry.set(made);
        }
        Ok(self.geometry.get().map_or(&[], Vec::as_slice))
    }
}
