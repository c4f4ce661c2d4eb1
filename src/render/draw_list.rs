//! Draws of a scene: made at upload in drawing order; only transparent ones are sorted by distance for each view.

use glam::Vec3;

use super::{
    Renderer,
    geometry::Part,
    pass::{Driven, Mark, SurfaceFlags, color_depth_format},
    upload::GpuScene,
};
use crate::{
    material::AlphaMode,
    scene::{Role, Scene},
};

/// One draw: a range of indices under one material, with the pipelines that show it.
#[derive(Debug)]
pub(crate) struct Draw {
    pub material: usize,
    pub indices: std::ops::Range<u32>,
    /// Middle of the part at rest, character space.
    pub center: Vec3,
    pub blend: bool,
    pub write_depth: bool,
    pub queue_offset: i32,
    pub surface: wgpu::RenderPipeline,
    pub outline: Option<wgpu::RenderPipeline>,
    /// Draws the shells of its coat.
    pub fluff: Option<wgpu::RenderPipeline>,
    /// Draws its light that blooms.
    pub glow: Option<wgpu::RenderPipeline>,
    pub flags: SurfaceFlags,
    /// Draws it into the map of the bangs: always where it belongs to another character, for its own face if it casts on
    /// that.
    pub bangs: Option<wgpu::RenderPipeline>,
    pub casts_on_face: bool,
    /// Draws it into the shadow maps of characters.
    pub shadow: Option<wgpu::RenderPipeline>,
    /// Where it casts the shadow of lids and lashes.
    pub lids: Option<wgpu::RenderPipeline>,
    pub mark: Mark,
    /// Draws an eye over the hair before it.
    pub through: Option<wgpu::RenderPipeline>,
}

impl Renderer {
    /// One draw for each opaque material, one for each transparent part; outlines likewise.
    pub(super) fn make_draws(&mut self, scene: &Scene, parts: &[Part]) -> Vec<Draw> {
        let driven = Driven::of(scene);
        let has_stencil = color_depth_format(&self.gpu).has_stencil_aspect();
        let has_marks = scene.eyes_through.is_some() && has_stencil;
        let has_lids = scene.bangs.is_some() && scene.materials.iter().any(|m| m.bangs_shadow.is_some_and(|b| b.lids));
        let blooms = scene.post.is_some_and(|p| p.bloom.is_some());
        let mut draws: Vec<Draw> = Vec::new();
        for part in parts {
            let Some(material) = scene.materials.get(part.material) else { continue };
            let blend = material.alpha.mode == AlphaMode::Blend;
            let in_map = scene.bangs.is_some() && !blend;
            let casts_on_face = in_map && casts_on_face(part.role);
            let casts_lids = has_lids && matches!(part.role, Role::Face | Role::Lash) && !blend;
            let mark = if has_marks && !blend {
                mark(part.role)
            } else {
                Mark::None
            };
            // Parts are sorted by material, so that those of one material follow each other in the index buffer.
            if let Some(last) = draws.last_mut()
                && !blend
                && last.material == part.material
                && last.indices.end == part.indices.start
                && last.casts_on_face == casts_on_face
                && last.lids.is_some() == casts_lids
                && last.mark == mark
            {
                last.indices.end = part.indices.end;
                continue;
            }
            let mut flags =
                SurfaceFlags::of(material, &driven[part.material], part.has_vertex_colors, &scene.face_maps);
            flags.cast_shadow &= scene.self_shadow.is_some();
            flags.hdr = scene.post.is_some();
            let casts = scene.self_shadow.is_some() && !blend && material.cast_shadow.is_some_and(|s| s.casts);
            draws.push(Draw {
                material: part.material,
                indices: part.indices.clone(),
                center: part.center,
                blend,
                write_depth: material.alpha.write_depth,
                queue_offset: material.alpha.queue_offset,
                surface: if blend {
                    self.transparent.pipeline(&self.gpu, &self.layouts, flags, material)
                } else {
                    self.opaque.pipeline(&self.gpu, &self.layouts, flags, material, mark)
                },
                outline: self.outline.pipeline(&self.gpu, &self.layouts, flags, material, &driven[part.material]),
                fluff: (material.fluff.is_some() && !blend && !flags.unlit).then(|| {
                    // A coat has no contour of its own, and its holes are strands.
                    let flags = SurfaceFlags { depth_rim: false, inner_lines: false, alpha_mask: false, ..flags };
                    self.fluff.pipeline(&self.gpu, &self.layouts, flags)
                }),
                glow: (blooms && material.glow.is_some())
                    .then(|| self.glow.pipeline(&self.gpu, &self.layouts, flags, material)),
                flags,
                mark,
                through: (mark == Mark::Eyes)
                    .then(|| self.eyes_through.pipeline(&self.gpu, &self.layouts, flags, material)),
                casts_on_face,
                bangs: in_map.then(|| self.bangs_shadow.pipeline(&self.gpu, &self.layouts, flags, material)),
                shadow: casts.then(|| self.shadow.pipeline(&self.gpu, &self.layouts, flags, material)),
                lids: casts_lids.then(|| self.bangs_shadow.pipeline(&self.gpu, &self.layouts, flags, material)),
            });
        }
        // Hair marks what it hides last; cards of a stack follow each other. The sort is stable and leaves blended draws at
        // the end.
        let layer = |d: &Draw| scene.materials[d.material].layer.map_or(0, |l| l.index);
        draws.sort_by_key(|d| (d.blend, has_marks.then_some(d.mark), if d.blend { 0 } else { layer(d) }));
        draws
    }
}

/// Whether a part of this role casts the shadow on its own face. Skin of the face and what lies on it do not.
pub(super) fn casts_on_face(role: Role) -> bool {
    matches!(role, Role::HairFront | Role::Skin | Role::Cloth | Role::Accessory)
}

/// What a part of this role has to do with eyes through hair.
fn mark(role: Role) -> Mark {
    match role {
        Role::Eye | Role::EyeHighlight | Role::EyeWhite | Role::Lash | Role::Brow => Mark::Eyes,
        Role::HairFront | Role::Hair => Mark::Hair,
        _ => Mark::None,
    }
}

/// Eyes and brows, the foremost first: characters face +Z.
pub(super) fn through_order(draws: &[Draw]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..draws.len()).filter(|i| draws[*i].through.is_some()).collect();
    order.sort_by(|a, b| draws[*b].center.z.total_cmp(&draws[*a].center.z));
    order
}

impl GpuScene {
    /// Sorts the blended draws: those that write depth first, then by queue offset, then far before near (MToon,
    /// "Render Queue"); equal ones keep the order of the file. `eye` is in character space.
    pub(crate) fn sort_transparent(&mut self, eye: Vec3) {
        let Self { draws, transparent_order, .. } = self;
        transparent_order.clear();
        transparent_order.extend((0..draws.len()).filter(|&i| draws[i].blend));
        let depth = |i: usize| draws[i].center.distance_squared(eye);
        transparent_order.sort_unstable_by(|&a, &b| {
            let (x, y) = (&draws[a], &draws[b]);
            let order = (!x.write_depth, x.queue_offset).cmp(&(!y.write_depth, y.queue_offset));
            order.then(depth(b).total_cmp(&depth(a))).then(a.cmp(&b))
        });
    }
}

/// What every geometry pass binds before it draws.
pub(crate) fn bind_scene(
    pass: &mut wgpu::RenderPass<'_>,
    scene: &GpuScene,
    frame: &wgpu::BindGroup,
    character: &wgpu::BindGroup,
) {
    pass.set_bind_group(0, frame, &[]);
    pass.set_bind_group(1, character, &[]);
    pass.set_vertex_buffer(0, scene.deform.deformed.slice(..));
    pass.set_vertex_buffer(1, scene.static_vertices.slice(..));
    pass.set_vertex_buffer(2, scene.instances.slice(..));
    pass.set_index_buffer(scene.indices.slice(..), wgpu::IndexFormat::Uint32);
}

/// Draws `draw` with `pipeline`, once for each instance.
pub(crate) fn record(pass: &mut wgpu::RenderPass<'_>, scene: &GpuScene, draw: &Draw, pipeline: &wgpu::RenderPipeline) {
    pass.set_pipeline(pipeline);
    pass.set_bind_group(2, &scene.material_groups[draw.material], &[]);
    pass.draw_indexed(draw.indices.clone(), 0, 0..scene.instance_rows.len() as u32);
}

/// [`record`] with the stencil's reference for `mark`, which holds the number of the character. A crowd larger than there
/// are numbers shares each among neighbours.
pub(crate) fn record_marked(
    pass: &mut wgpu::RenderPass<'_>,
    scene: &GpuScene,
    draw: &Draw,
    pipeline: &wgpu::RenderPipeline,
    mark: Mark,
) {
    pass.set_pipeline(pipeline);
    pass.set_bind_group(2, &scene.material_groups[draw.material], &[]);
    let instances = scene.instance_rows.len() as u32;
    let block = if mark.is_numbered() {
        instances.div_ceil(Mark::NUMBERS).max(1)
    } else {
        instances.max(1)
    };
    for number in 0..instances.div_ceil(block) {
        pass.set_stencil_reference(mark.reference(number));
        let first = number * block;
        pass.draw_indexed(draw.indices.clone(), 0, first..(first + block).min(instances));
    }
}
