//! A character file in, a picture out, without a window: `cargo run --example hello MODEL.vrm OUT.png`.

use hikage::{Gpu, Renderer, View, import, scene::Framing};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut args = std::env::args().skip(1);
    let (Some(model), Some(out)) = (args.next(), args.next()) else {
        return Err("usage: hello MODEL.vrm OUT.png".into());
    };
    let gpu = Gpu::headless(None)?;
    let t=std::time::Instant::now();
    let scene = import::load(std::path::Path::new(&model))?;
    println!("load {:?}",t.elapsed());
    let t=std::time::Instant::now();
    let mut renderer = Renderer::new(&gpu)?;
    let mut character = renderer.upload(&scene)?;
    println!("upload {:?}",t.elapsed());
    let view = View::framed(&scene, Framing::Portrait, 0.4, [1024, 1024]);
    let t=std::time::Instant::now();
    let picture = renderer.render(&mut character, &view)?;
    println!("render {:?}",t.elapsed());
    let t=std::time::Instant::now();
    let _ = renderer.render(&mut character, &view)?;
    println!("render {:?}",t.elapsed());
    image::save_buffer(&out, &picture.pixels, picture.width, picture.height, image::ColorType::Rgba8)?;
    println!("{:?}", scene.warnings.len());
    if let Ok(r) = hikage::bench::run(&gpu, &scene, &hikage::bench::BenchOptions{view, samples:std::env::var("S").map_or(4,|s|s.parse().unwrap()), frames:5}) { println!("{r:#?}"); }
    Ok(())
}
