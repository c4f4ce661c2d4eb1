//! Long runs, alone in their process: memory is that of the whole of it.

#[path = "support/scene.rs"]
mod support;

use hikage::{Actor, Renderer, Stage, View};
use support::{anime_heroine, gpu, keep, scene, sphere, target, two_tone, view};

/// Memory of this process, bytes.
#[cfg(target_os = "linux")]
fn resident() -> u64 {
    let pages = std::fs::read_to_string("/proc/self/statm").expect("the kernel counts pages");
    let resident = pages.split_whitespace().nth(1).and_then(|n| n.parse::<u64>().ok());
    resident.expect("a number of pages") * 4096
}

/// A window that is dragged to another size for a thousand frames, and stages that go while their frames are drawn.
#[test]
#[cfg(target_os = "linux")]
fn a_thousand_sizes_and_stages_leave_no_memory_behind() {
    let gpu = gpu();
    let renderer = Renderer::new(&gpu).expect("a renderer");
    let ball = renderer.upload(&scene(vec![(sphere(0.4, 12, 24), two_tone())])).expect("an upload");
    let mut head = anime_heroine();
    keep(&mut head, support::HEAD);
    // Mesa's lavapipe (22.3) keeps half a megabyte of every frame in half floats; SwiftShader none.
    head.post = None;
    let head = renderer.upload(&head).expect("an upload");
    let shot = view(64, 3.0);
    let mut before = 0;
    for frame in 0..1000u32 {
        // Every tenth stage has another head; all of them are dropped before the frame is done.
        let actors = if frame % 10 == 0 {
            vec![Actor::new(&head)]
        } else {
            vec![Actor::new(&ball), Actor::new(&ball)]
        };
        let mut stage = Stage::of(actors);
        stage.casts_on_world = frame % 3 == 0;
        let size = [32 + frame % 61, 32 + frame % 47];
        let into = target(&gpu, size, wgpu::TextureFormat::Rgba8UnormSrgb, 1);
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        renderer.prepare(&mut encoder, &mut stage).expect("a stage");
        let seen = View { size, ..shot.view() };
        let color = into.create_view(&wgpu::TextureViewDescriptor::default());
        renderer.draw(&mut encoder, &stage, &seen, &color).expect("a view");
        gpu.queue.submit([encoder.finish()]);
        drop((stage, into));
        if frame % 20 == 0 {
            gpu.device.poll(wgpu::PollType::wait_indefinitely()).expect("the device answers");
        }
        if frame == 300 {
            before = resident();
        }
    }
    gpu.device.poll(wgpu::PollType::wait_indefinitely()).expect("the device answers");
    let after = resident();
    assert!(after < before + before / 20, "{} MB have become {} MB", before >> 20, after >> 20);
}
