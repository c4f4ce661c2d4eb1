//! Import, upload and frames, with the floor that a frame is measured against: the same triangles in the same targets,
//! unlit with one texture.
//!
//! The model is the one file (VRM, GLB) that `HIKAGE_BENCH_MODEL` names, else the built-in character.

use std::{path::PathBuf, time::Duration};

use criterion::{Criterion, criterion_group, criterion_main};
use hikage::{
    Gpu, Renderer, View,
    bench::{Bench, BenchOptions},
    import,
    scene::Framing,
};

/// Name and bytes of the model.
fn model() -> (String, Vec<u8>) {
    match std::env::var_os("HIKAGE_BENCH_MODEL").map(PathBuf::from) {
        Some(path) => (path.display().to_string(), std::fs::read(&path).expect("HIKAGE_BENCH_MODEL names a file")),
        None => ("hikage.vrm".into(), hikage_character::file()),
    }
}

fn benches(c: &mut Criterion) {
    let (name, bytes) = model();
    let load = || import::load_bytes(&name, &bytes, None, &import::Limits::default()).expect("a model that loads");
    let scene = load();
    let gpu = Gpu::headless(None).expect("an adapter");
    println!("{name} on {}", gpu.info().name);
    c.bench_function("import", |b| b.iter(load));
    c.bench_function("upload", |b| {
        b.iter(|| Renderer::new(&gpu).and_then(|r| r.upload(&scene)).expect("uploads"));
    });
    for side in [512, 1024] {
        let view = View::framed(&scene, Framing::Portrait, 0.0, [side; 2]);
        let mut bench = Bench::new(&gpu, &scene, &BenchOptions { view, ..BenchOptions::default() }).expect("uploads");
        let mut group = c.benchmark_group(format!("{side}x{side}"));
        group.bench_function("frame", |b| b.iter(|| bench.frame().expect("draws")));
        group.bench_function("floor", |b| b.iter(|| bench.floor().expect("draws")));
    }
}

criterion_group! {
    name = all;
    config = Criterion::default().sample_size(10).warm_up_time(Duration::from_secs(1));
    targets = benches
}
criterion_main!(all);
