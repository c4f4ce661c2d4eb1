//! A device with WebGPU's default limits suffices.

use std::path::Path;

use hikage::scene::Framing;
use hikage::{Anime, Gpu, Look, Renderer, import};

use crate::support::{Shoot, Shot, anime_heroine, gpu, render, staged};

/// The adapter of the tests with no limit above the defaults.
fn default_device(name: &str, features: wgpu::Features) -> Gpu {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY));
    let adapter = adapters.into_iter().find(|a| a.get_info().name == name).expect("the adapter of the tests");
    let features = adapter.features() & features;
    let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
        required_features: features,
        required_limits: wgpu::Limits::default(),
        ..Default::default()
    }))
    .expect("a device with the default limits");
    Gpu::from_parts(&adapter, device, queue)
}

#[test]
fn the_anime_look_draws_the_same_on_a_device_with_the_default_limits() {
    let lent = gpu();
    let scene = anime_heroine();
    let view = Shot::framed(&scene, Framing::Portrait, 0.4, [128, 128]);
    let least = default_device(&lent.info().name, wgpu::Features::DEPTH32FLOAT_STENCIL8);
    let renderer = Renderer::new(&least).expect("a renderer");
    let mut uploaded = staged(renderer.upload(&scene));
    let picture = renderer.shoot(&mut uploaded, &view).expect("a picture");
    assert!(picture.pixels == render(&lent, &scene, &view).pixels, "another picture");
}

#[test]
fn without_a_stencil_nothing_is_seen_through_hair_and_the_rest_is_the_same() {
    let lent = gpu();
    let mut scene = anime_heroine();
    let view = Shot::framed(&scene, Framing::Face, 0.2, [128, 128]);
    let least = default_device(&lent.info().name, wgpu::Features::empty());
    let renderer = Renderer::new(&least).expect("a renderer");
    let mut uploaded = staged(renderer.upload(&scene));
    let picture = renderer.shoot(&mut uploaded, &view).expect("a picture");
    assert!(picture.pixels != render(&lent, &scene, &view).pixels, "eyes are seen through hair");
    scene.eyes_through = None;
    assert!(picture.pixels == render(&lent, &scene, &view).pixels, "more than the eyes differs");
}

#[test]
fn every_shared_model_in_the_anime_look_fits_the_default_limits() {
    let folder = Path::new("../shared/models");
    let Ok(entries) = std::fs::read_dir(folder) else {
        eprintln!("NOT RUN: there is no folder {} with models", folder.display());
        return;
    };
    let gpu = default_device(&gpu().info().name, wgpu::Features::DEPTH32FLOAT_STENCIL8);
    let renderer = Renderer::new(&gpu).expect("a renderer");
    let mut count = 0;
    for path in entries.map(|e| e.expect("an entry").path()) {
        if !path.extension().is_some_and(|e| e == "vrm" || e == "glb") {
            continue;
        }
        let mut scene = import::load(&path).expect("a model");
        Look::Anime(Anime::default()).apply(&mut scene);
        renderer.upload_and_empty_images(&mut scene).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        count += 1;
    }
    assert!(count > 0, "no model in {}", folder.display());
}

#[test]
fn no_limit_but_the_size_of_buffers_is_above_the_defaults() {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    for adapter in pollster::block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY)) {
        let asked = Gpu::required_limits(&adapter);
        let (default, asks) = (wgpu::Limits::default(), asked.clone());
        let same = wgpu::Limits {
            max_buffer_size: default.max_buffer_size,
            max_storage_buffer_binding_size: default.max_storage_buffer_binding_size,
            ..asks
        };
        assert_eq!(same, default);
    }
}
