//! Draws of a scene: made at upload in drawing order; only transparent ones are sorted by distance for each view.

use glam::Vec3;

use super::{
    pass::{Mark, SurfaceFlags},
    upload::GpuScene,
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
    pub prepass: wgpu::RenderPipeline,
    /// Writes its depth for rims.
    pub depth: Option<wgpu::RenderPipeline>,
    pub flags: SurfaceFlags,
    /// Draws it into the map of the bangs: always where it belongs to another character, for its own face if it casts on
    /// that.
    pub bangs: Option<wgpu::RenderPipeline>,
    pub casts_on_face: bool,
    /// Where it casts the shadow of lids and lashes.
    pub lids: Option<wgpu::RenderPipeline>,
    pub mark: Mark,
    /// Draws an eye over the hair before it.
    pub through: Option<wgpu::RenderPipeline>,
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
