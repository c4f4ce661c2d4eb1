//! Baking a threshold map of 1024 x 1024 texels from eight keys in memory, an edited key of it, and the floor: decoding the
//! keys, encoding the map, and moving 20 bytes of memory a texel. The keys are the built-in character's.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use hikage::picture::{encode_png, read_png};
use hikage::scene::Image;
use hikage::sdf::{BakeOptions, Key, Layout, Mask, MaskFile, Project, ProjectKey, Session, Sides, bake};

const ANGLES: [f32; 8] = [0.0, 25.0, 50.0, 75.0, 100.0, 125.0, 150.0, 180.0];

fn keys() -> Vec<Key> {
    let project = Project::parse("face.sdf.toml", hikage_character::head::sdf::SOURCE).expect("her project");
    let project = Project { keys: ANGLES.map(ProjectKey::Angle).to_vec(), ..project };
    let key = |angle: f32| {
        let drawn = project.mask(angle).expect("draws");
        let coverage = drawn.lit().map(|lit| if lit { 255 } else { 0 }).collect();
        Key { angle_rad: angle.to_radians(), mask: Mask { coverage, ..drawn } }
    };
    ANGLES.map(key).to_vec()
}

fn benches(c: &mut Criterion) {
    let (keys, options) = (keys(), BakeOptions::default());
    let mut group = c.benchmark_group("sdf 1024x1024x8");
    group.bench_function("bake", |b| b.iter(|| bake(&keys, &options).expect("nested keys")));

    // Two drawings by turns, so that each edit moves texels.
    let mut session = Session::new(keys.clone(), options.clone()).expect("nested keys");
    let edited = Mask {
        coverage: keys[3]
            .mask
            .coverage
            .iter()
            .zip(&keys[4].mask.coverage)
            .enumerate()
            .map(|(i, (a, b))| if i % 1024 < 540 { *b } else { *a })
            .collect(),
        ..keys[3].mask.clone()
    };
    let mut turn = 0;
    group.bench_function("one edited key", |b| {
        b.iter(|| {
            turn ^= 1;
            let mask = if turn == 1 { &edited } else { &keys[3].mask };
            session.replace(3, mask.clone()).expect("nested keys");
        });
    });

    let folder = std::env::temp_dir().join(format!("hikage-bench-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let files: Vec<MaskFile> = keys
        .iter()
        .enumerate()
        .map(|(k, key)| {
            let pixels = key.mask.coverage.iter().flat_map(|c| [*c, *c, *c, 255]).collect();
            let path = folder.join(format!("{k}.png"));
            let image = Image { width: 1024, height: 1024, pixels, ..Image::default() };
            std::fs::write(&path, encode_png(&image).expect("encodes")).expect("writes");
            assert!(read_png(&path).is_ok());
            MaskFile::new(path)
        })
        .collect();
    group.bench_function("floor: decode the keys", |b| {
        b.iter(|| files.iter().map(|f| f.load().expect("reads").coverage.len()).sum::<usize>())
    });
    std::fs::remove_dir_all(&folder).expect("removes");
    let sides = Sides { left: session.map().clone(), right: None };
    group.bench_function("floor: encode the map", |b| {
        b.iter(|| sides.encode(&Layout::Single, |_| Ok(Mask::default())).expect("encodes"))
    });
    let (from, mut to) = (vec![1u8; 10 << 20], vec![0u8; 10 << 20]);
    group
        .bench_function("floor: 20 bytes a texel", |b| b.iter(|| black_box(&mut to).copy_from_slice(black_box(&from))));
    group.finish();
}

criterion_group!(sdf, benches);
criterion_main!(sdf);
