//! The floor of the benches: the same triangles, unlit with one texture, in the same targets.

use super::{Drawing, Mark, Picture};
use crate::material::{Base, Options};
use crate::render::draw_list::{self, Actors};
use crate::render::shaders::{Bound, Recipe};
use crate::render::variants::{Drawn, Request, Variants};
use crate::{Actor, Result, Stage};

/// What draws each surface of each actor.
#[derive(Debug)]
pub(crate) struct FloorPass {
    drawn: Vec<Vec<Drawn>>,
}

impl FloorPass {
    pub fn new(variants: &Variants, picture: &Picture<'_>, stage: &Stage) -> Result<Self> {
        let variant = variants.get(&request(picture))?;
        let of_actor = |actor: &Actor| {
            let data = &actor.character.0;
            data.draws.iter().map(|d| data.bind(&variants.gpu, variant.clone(), d.material)).collect()
        };
        Ok(Self { drawn: stage.actors.iter().map(of_actor).collect() })
    }

    /// Draws every surface.
    pub fn encode(&self, pass: &mut wgpu::RenderPass<'_>, actors: &Actors<'_>) {
        for (body, drawn) in actors.bodies.iter().zip(&self.drawn) {
            actors.bind(pass, body);
            for (draw, drawn) in body.data().draws.iter().zip(drawn) {
                draw_list::record(pass, body, draw, drawn, body.instance());
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
        textures: vec![Bound { name: "base_texture".to_owned(), is_array: false }],
    };
    let drawing = Drawing { cull: Some(wgpu::Face::Back), blend: false, write_depth: true, mark: Mark::None };
    picture.request(recipe, drawing)
}
