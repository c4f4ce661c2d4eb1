//! Two characters on a ground, without a window: each with a place, a pose and shadows of its own, one casting on the other.
//!
//! `cargo run --release --example stage [MODEL.vrm [MODEL.vrm]]`

use hikage::motion::{Pose, Stance};
use hikage::{Actor, Anime, Error, Gpu, Grid, Ground, Look, Renderer, Stage, View, import, picture, scene::Framing};

fn main() -> Result<(), Error> {
    let gpu = Gpu::headless(None)?;
    let renderer = Renderer::new(&gpu)?;
    let mut characters = Vec::new();
    for model in std::env::args().skip(1) {
        let mut scene = import::load(model)?;
        Look::Anime(Anime::default()).apply(&mut scene);
        characters.push(renderer.upload_and_empty_images(&mut scene)?);
    }
    if characters.is_empty() {
        let file = hikage_character::file();
        let mut scene = import::load_bytes("hikage.vrm", &file, None, &import::Limits::default())?;
        Look::Anime(Anime::default()).apply(&mut scene);
        characters.push(renderer.upload_and_empty_images(&mut scene)?);
    }
    // Of one character, the second actor shares everything with the first one but its pose.
    let cast = [(0.0, [-0.28, 0.0, 0.0], 0.4, Stance::Relaxed), (0.7, [0.28, 0.0, -0.15], -0.6, Stance::Offer)];
    let actors = cast.iter().zip(characters.iter().cycle()).map(|((smile, place, yaw, stance), character)| {
        let mut pose = Pose::rest(character.scene());
        pose.set_stance(character.scene(), *stance);
        pose.express(character.scene(), &[("happy", *smile)]);
        Actor::new(character).at(*place, *yaw).posed(pose)
    });
    let mut stage = Stage::of(actors);
    stage.ground = Some(Ground { grid: Some(Grid::default()), ..Ground::default() });
    let view = View::framed_stage(&stage, Framing::Full, 0.1, [1024, 768]);
    picture::write_png("stage.png", &renderer.render(&mut stage, &view)?)
}
