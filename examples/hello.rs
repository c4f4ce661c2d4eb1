//! A character file in, a picture out, without a window: `cargo run --example hello MODEL.vrm OUT.png`.

use std::{error::Error, path::Path};

use hikage::{Actor, Gpu, Renderer, Stage, View, import, picture, scene::Framing};

fn main() -> Result<(), Box<dyn Error>> {
    let args: Vec<String> = std::env::args().collect();
    let [_, model, out] = args.as_slice() else { return Err("usage: hello MODEL.vrm OUT.png".into()) };
    let scene = import::load(Path::new(model))?;
    let gpu = Gpu::headless(None)?;
    let renderer = Renderer::new(&gpu)?;
    let mut stage = Stage::of([Actor::new(&renderer.upload(&scene)?)]);
    let view = View::framed(&scene, Framing::Portrait, 0.4, [1024, 1024]);
    let picture = renderer.render(&mut stage, &view)?;
    picture::write_png(Path::new(out), &picture)?;
    Ok(())
}
