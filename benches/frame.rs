//! Import, upload and frames, with the floor that a frame is measured against: the same triangles in the same targets,
//! unlit with one texture.
//!
//! The model is the one that `HIKAGE_BENCH_MODEL` names, else the largest VRM file in `../shared/models`.

use std::{path::PathBuf, time::Duration};

use criterion::{Criterion, criterion_group, criterion_main};
use hikage::{
    Gpu, Renderer, View,
    bench::{BenchOptions, Stage},
    import,
    scene::Framing,
};

fn model() -> PathBuf {
    if let Some(path) = std::env::var_os("HIKAGE_BENCH_MODEL") {
        return path.into();
    }
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/models");
    let files = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|e| e.path());
    let vrm = files.filter(|p| p.extension().is_some_and(|e| e == "vrm"));
    let size = |p: &PathBuf| std::fs::metadata(p).map_or(0, |m| m.len());
    vrm.max_by_key(size).expect("a model: set HIKAGE_BENCH_MODEL to a VRM file")
}

fn benches(c: &mut Criterion) {
    let path = model();
    let scene = import::load(&path).expect("a model that loads");
    let gpu = Gpu::headless(None).expect("an adapter");
    println!("{} on {}", path.display(), gpu.info().name);
    c.bench_function("import", |b| b.iter(|| import::load(&path).expect("loads")));
    c.bench_function("upload", |b| {
        b.iter(|| Renderer::new(&gpu).and_then(|mut r| r.upload(&scene)).expect("uploads"));
    });
    for side in [512, 1024] {
        let view = View::framed(&scene, Framing::Portrait, 0.0, [side; 2]);
        let mut stage = Stage::new(&gpu, &scene, &BenchOptions { view, ..BenchOptions::default() }).expect("uploads");
        let mut group = c.benchmark_group(format!("{side}x{side}"));
        group.bench_function("frame", |b| b.iter(|| stage.frame().expect("draws")));
        group.bench_function("floor", |b| b.iter(|| stage.floor().expect("draws")));
    }
}

criterion_group! {
    name = all;
    config = Criterion::default().sample_size(10).warm_up_time(Duration::from_secs(1));
    targets = benches
}
criterion_main!(all);
