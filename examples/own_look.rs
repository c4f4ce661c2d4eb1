//! A look of one's own: one declaration, one WGSL file, one call that makes it known.
//!
//! ```text
//! cargo run --example own_look [MODEL.vrm]
//! ```

use hikage::material::{Section, TextureRef, register};
use hikage::scene::Framing;
use hikage::{Actor, Anime, Channel, Error, Gpu, Look, Renderer, Stage, View, import, picture};

hikage::section! {
    /// Ice that grows from below.
    #[derive(Copy)]
    Frost = "frost" {
        needs: &["world"],
        channel: Some(("frost", "Share of ice.")),
        wgsl: Some(include_str!("frost.wgsl")),
    }
    {
        /// Colour of the ice in light, linear.
        color: [f32; 3] = [0.72, 0.86, 1.0], in 0.0..=1.0;
        /// Height up to which it has grown, metres.
        height_m: f32 = 1.2, in -1.0..=10.0;
        /// Softness of its border, metres.
        softness_m: f32 = 0.05, in 0.001..=1.0;
        /// Shape of its border, red channel, linear.
        flakes: Option<TextureRef> = None, read LINEAR_REPEAT;
    }
    presets {
        /// Nothing is left bare.
        whole { height_m: 10.0 }
    }
}

impl Section for Frost {}

fn main() -> Result<(), Error> {
    // From now on look files know it: `[role.cloth.frost]`.
    register::<Frost>()?;
    let mut scene = match std::env::args().nth(1) {
        Some(model) => import::load(model)?,
        None => import::load_bytes("hikage.vrm", &hikage_character::file(), None, &import::Limits::default())?,
    };
    Look::Anime(Anime::default()).apply(&mut scene);
    for material in &mut scene.materials {
        material.set_own(Some(Frost::default()));
    }
    let gpu = Gpu::headless(None)?;
    let renderer = Renderer::new(&gpu)?;
    let mut stage = Stage::of([Actor::new(&renderer.upload(&scene)?)]);
    let view = View::framed(&scene, Framing::Full, 0.4, [768, 768]);
    picture::write_png("frost.png", &renderer.render(&mut stage, &view)?)?;
    let channel = View { channel: Channel::Look("frost"), ..view };
    picture::write_png("frost-channel.png", &renderer.render(&mut stage, &channel)?)
}
