//! How far each pixel of a surface has moved since the last picture, with depth; for [`temporal`](super::temporal).

use super::{DEPTH_FORMAT, depth_state, surface_cull};
use crate::Gpu;
use crate::material::Material;
use crate::render::draw_list::Actors;
use crate::render::material::Composition;
use crate::render::targets;
use crate::render::variants::{Drawn, Request, State};

/// Pixels to the right and down.
pub(crate) const VELOCITY_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rg16Float;

/// What it draws into.
#[derive(Debug)]
pub(crate) struct VelocityTargets {
    pub size: [u32; 2],
    pub texture: wgpu::Texture,
    pub velocity: wgpu::TextureView,
    pub depth: wgpu::TextureView,
}

impl VelocityTargets {
    pub fn new(gpu: &Gpu, size: [u32; 2]) -> Self {
        let read = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC;
        let texture = targets::texture(gpu, "velocity", size, 1, VELOCITY_FORMAT, read);
        let velocity = targets::view(&texture);
        Self { size, texture, velocity, depth: targets::sampled(gpu, "velocity depth", size, DEPTH_FORMAT) }
    }
}

/// What the pass reads and writes.
pub(crate) struct VelocityInputs<'a> {
    pub actors: Actors<'a>,
    pub targets: &'a VelocityTargets,
    /// By troupe and draw; `None` leaves it out.
    pub drawn: &'a dyn Fn(usize, usize) -> Option<&'a Drawn>,
}

/// What draws the movement of a material.
pub(crate) fn request(of: &Composition, material: &Material, colors: bool) -> Request {
    let recipe = of.cut("velocity", colors, true).with("seen", true).with("world", true).with("before", true);
    let targets = vec![VELOCITY_FORMAT.into()];
    Request {
        recipe,
        state: State { cull: surface_cull(material), depth: Some(depth_state(true)), samples: 1, targets },
    }
}

/// Draws surfaces; where there is none, depth is 0.
pub(crate) fn encode(encoder: &mut wgpu::CommandEncoder, inputs: &VelocityInputs<'_>) {
    let VelocityInputs { actors, targets, drawn } = inputs;
    let color = targets::color(&targets.velocity, wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT));
    let depth = targets::depth(&targets.depth, 0.0, wgpu::StoreOp::Store);
    let mut pass = targets::begin(encoder, "velocity", Some(color), Some(depth), None);
    for (of, troupe) in actors.bodies.troupes.iter().enumerate() {
        let Some(past) = &troupe.past else { continue };
        actors.bind(&mut pass, troupe);
        pass.set_bind_group(3, &past.group, &[]);
        for (index, draw) in troupe.data().draws.iter().enumerate() {
            if let Some(drawn) = drawn(of, index) {
                actors.record(&mut pass, troupe, draw.triangles(), drawn, troupe.instances.clone());
            }
        }
    }
}
