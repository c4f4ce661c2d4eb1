//! The floor of the benches: the same triangles, unlit with one texture, in the same targets.

use super::{Drawing, Mark, Picture};
use crate::Result;
use crate::material::{Base, Options};
use crate::render::draw_list;
use crate::render::gpu_scene::GpuScene;
use crate::render::shaders::{Bound, Recipe};
use crate::render::variants::{Drawn, Request, Variants};

/// What draws each surface of a scene.
#[derive(Debug)]
pub(crate) struct FloorPass {
    drawn: Vec<Drawn>,
}

impl FloorPass {
    pub fn new(variants: &Variants, picture: &Picture<'_>, scene: &mut GpuScene) -> Result<Self> {
        let request = request(picture);
        let variant = variants.get(&request)?;
        let materials: Vec<usize> = scene.draws.iter().map(|d| d.material).collect();
        let drawn = materials.into_iter().map(|m| scene.bind(&variants.gpu, variant.clone(), m)).collect();
        Ok(Self { drawn })
    }

    /// Draws every surface.
    pub fn encode(&self, pass: &mut wgpu::RenderPass<'_>, scene: &GpuScene) {
        for (draw, drawn) in scene.draws.iter().zip(&self.drawn) {
            draw_list::record(pass, scene, draw, drawn);
        }
    }
}

/// One for everything: what has no texture reads a white one.
fn request(picture: &Picture<'_>) -> Request {
    let mut options = Options::default();
    ["uv", "base_texture"].iter().for_each(|name| options.set(*name, true));
    let recipe = Recipe {
        pass: "floor",
        sections: vec![&Base::ABOUT],
        options,
        textures: vec![Bound { name: "base_texture".to_owned(), is_array: false }],
    };
    let drawing = Drawing { cull: Some(wgpu::Face::Back), blend: false, write_depth: true, mark: Mark::None };
    picture.request(recipe, drawing)
}
