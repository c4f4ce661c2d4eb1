//! What moves characters allocates nothing in a frame, once its lists have their sizes. Alone in its process: allocations are
//! those of the whole of it.

use std::path::Path;
use std::sync::Arc;

use hikage::glam::{Mat4, Vec3};
use hikage::motion::{Animator, Blink, Clip, Gaze, Layer, Play, Pose, SPRING_STEP_S, Skeleton, Wind};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};

#[global_allocator]
static ALLOCATOR: &StatsAlloc<std::alloc::System> = &INSTRUMENTED_SYSTEM;

#[test]
fn a_frame_of_motion_allocates_nothing() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/oracles/motion/models");
    let load = |name: &str| hikage::import::load(folder.join(name)).expect("a model");
    let (scene, moves) = (load("everything.vrm"), load("moves.vrma"));
    let clip = Arc::new(Clip::of(&moves, 0, &scene).expect("a clip"));
    let (skeleton, mut pose) = (Skeleton::of(&scene), Pose::rest(&scene));
    let mut animator = Animator::default();
    animator.player.play(&clip);
    let mut on_top = Layer::additive();
    on_top.plays.push(Play { weight: 0.3, ..Play::new(&clip) });
    animator.player.layers.push(on_top);
    animator.gaze = Gaze::at([0.5, 1.2, 2.0]).with_head(0.4);
    animator.blink = Some(Blink::default());
    animator.springs.wind = Some(Wind { force: Vec3::X, ..Wind::default() });
    animator.set_expression(&skeleton, "happy", 0.5).expect("known");
    let mut world = Mat4::IDENTITY;
    let mut frame = |i: usize| {
        world.w_axis.x = (i as f32 * 0.1).sin() * 0.2;
        animator.update(&skeleton, &mut world, &mut pose, SPRING_STEP_S * 1.3);
    };
    // Two loops of everything that comes and goes.
    (0..400).for_each(&mut frame);
    let region = Region::new(ALLOCATOR);
    (400..800).for_each(&mut frame);
    let change = region.change();
    assert_eq!((change.allocations, change.reallocations), (0, 0), "{change:?}");
}
