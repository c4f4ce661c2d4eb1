//! What is seen through, and in which order.

use glam::Mat4;
use hikage::Background;
use hikage::color::Srgb;
use hikage::material::{Alpha, AlphaMode, Base, Material, Shading};

use super::{close, srgb};
use crate::support::{gpu, pixel, render, scene, square, texture, two_tone, view};

#[test]
fn transparent_pictures_have_straight_alpha() {
    let mut material = two_tone();
    material.base.color[3] = 0.5;
    material.alpha = Alpha { mode: AlphaMode::Blend, ..Alpha::default() };
    let scene = scene(vec![(square([0.0, 0.0], 0.4, 0.0), material)]);
    let mut view = view(64, 4.0);
    view.background = Background::Transparent;
    let image = render(&gpu(), &scene, &view);
    assert_eq!(pixel(&image, 1, 1), [0; 4], "nothing is there");
    let [r, g, b] = srgb([0.9, 0.3, 0.25]);
    close(&pixel(&image, 32, 32), &[r, g, b, 128], 2, "half of it is there");
}

#[test]
fn far_transparent_parts_show_through_near_ones_unless_depth_is_written() {
    let gpu = gpu();
    let glass = |color: [f32; 3], write_depth| Material {
        base: Base { color: [color[0], color[1], color[2], 0.5], texture: None },
        shading: Shading::Unlit,
        alpha: Alpha { mode: AlphaMode::Blend, write_depth, ..Alpha::default() },
        ..Material::default()
    };
    let mut view = view(64, 4.0);
    view.background = Background::Color(Srgb([0; 3]));
    // Near before far in the file: the order must come from the distance.
    let parts = |w| {
        vec![
            (square([0.0, 0.0], 0.3, 0.2), glass([1.0, 0.0, 0.0], w)),
            (square([0.0, 0.0], 0.3, -0.2), glass([0.0, 1.0, 0.0], w)),
        ]
    };
    let sorted = pixel(&render(&gpu, &scene(parts(false)), &view), 32, 32);
    close(&sorted[..3], &srgb([0.5, 0.25, 0.0]), 1, "red over green");
    // The queue offset is stronger than the distance.
    let mut forced = parts(false);
    forced[0].1.alpha.queue_offset = -1;
    let forced = pixel(&render(&gpu, &scene(forced), &view), 32, 32);
    close(&forced[..3], &srgb([0.25, 0.5, 0.0]), 1, "green over red by queue offset");
    // What writes depth comes first, whatever the distance, and hides the rest behind it.
    let mut writing = parts(false);
    writing[0].1.alpha.write_depth = true;
    let writing = pixel(&render(&gpu, &scene(writing), &view), 32, 32);
    close(&writing[..3], &srgb([0.5, 0.0, 0.0]), 1, "the writer hides what is behind");
}

#[test]
fn masked_alpha_cuts_at_its_cutoff() {
    let mut scene = scene(vec![(square([0.0, 0.0], 0.5, 0.0), two_tone())]);
    let holes = texture(&mut scene, 2, 1, |x, _| [255, 255, 255, if x == 0 { 100 } else { 160 }]);
    let material = &mut scene.materials[0];
    material.base.texture = Some(holes);
    material.alpha = Alpha { mode: AlphaMode::Mask, cutoff: 0.5, ..Alpha::default() };
    let image = render(&gpu(), &scene, &view(128, 4.0));
    assert_eq!(pixel(&image, 50, 64)[..3], [0x80; 3], "below the cutoff is open");
    close(&pixel(&image, 78, 64)[..3], &srgb([0.9, 0.3, 0.25]), 1, "above it is shut");
}

#[test]
fn a_turned_character_is_sorted_as_it_stands() {
    let glass = |color: [f32; 3]| Material {
        base: Base { color: [color[0], color[1], color[2], 0.5], texture: None },
        shading: Shading::Unlit,
        alpha: Alpha { mode: AlphaMode::Blend, ..Alpha::default() },
        double_sided: true,
        ..Material::default()
    };
    let scene = scene(vec![
        (square([0.0, 0.0], 0.3, 0.2), glass([1.0, 0.0, 0.0])),
        (square([0.0, 0.0], 0.3, -0.2), glass([0.0, 1.0, 0.0])),
    ]);
    let mut view = view(64, 4.0);
    view.background = Background::Color(Srgb([0; 3]));
    view.instances = vec![Mat4::from_rotation_y(std::f32::consts::PI)];
    let turned = pixel(&render(&gpu(), &scene, &view), 32, 32);
    close(&turned[..3], &srgb([0.25, 0.5, 0.0]), 1, "green, now near, over red");
}
