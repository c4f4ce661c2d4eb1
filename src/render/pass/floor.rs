//! The floor of the benches: the same triangles, unlit with one texture, in the same targets.

use super::{Drawing, Mark, Picture};
use crate::Result;
use crate::material::{Base, Options};
use crate::render::Character;
use crate::render::draw_list::{Actors, Draw};
use crate::render::shaders::{Bound, Recipe, Shape};
use crate::render::variants::{Drawn, Request, Variants};

/// What draws each surface of a character.
#[derive(Debug)]
pub(crate) struct FloorPass {
    drawn: Vec<Drawn>,
}

impl FloorPass {
    pub fn new(variants: &Variants, picture: &Picture<'_>, of: &Character) -> Result<Self> {
        let variant = variants.get(&request(picture))?;
        let drawn = |draw: &Draw| of.0.bind(&variants.gpu, variant.clone(), draw.material);
        Ok(Self { drawn: of.0.draws.iter().map(drawn).collect() })
    }

    /// Draws every surface of all actors, who are of that character.
    pub fn encode(&self, pass: &mut wgpu::RenderPass<'_>, actors: &Actors<'_>) {
        for troupe in &actors.bodies.troupes {
            actors.bind(pass, troupe);
            for (draw, drawn) in troupe.data().draws.iter().zip(&self.drawn) {
                actors.record(pass, troupe, draw.triangles(), drawn, troupe.instances.clone());
            }
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
        textures: vec![Bound { name: "base_texture".to_owned(), shape: Shape::Flat }],
    };
    let drawing = Drawing { cull: Some(wgpu::Face::Back), blend: false, write_depth: true, mark: Mark::None };
    picture.request(recipe, drawing)
}
