//! Sides of surfaces, joints, morphs, instances and the tree of nodes.

use glam::{Mat4, Vec3};
use hikage::Renderer;
use hikage::material::Material;
use hikage::motion::Pose;
use hikage::scene::{Influences, Mesh, MorphTarget, Node, Scene, Skin, Transform};

use super::{close, srgb};
use crate::support::{Shoot, cube, gpu, pixel, render, scene, sphere, square, staged, two_tone, view};

#[test]
fn double_sided_surfaces_face_the_viewer_on_both_sides() {
    let gpu = gpu();
    let mut material = two_tone();
    let mut view = view(64, 4.0);
    view.camera.eye = Vec3::Z * -4.0;
    view.lights.directional.to_light = Vec3::NEG_Z;
    let behind = |material: Material| {
        let image = render(&gpu, &scene(vec![(square([0.0, 0.0], 0.4, 0.0), material)]), &view);
        pixel(&image, 32, 32)
    };
    assert_eq!(behind(material.clone())[..3], [0x80; 3], "a single side is culled from behind");
    material.double_sided = true;
    close(&behind(material)[..3], &srgb([0.9, 0.3, 0.25]), 1, "two sides are lit from behind");
}

#[test]
fn a_mirrored_node_keeps_its_outside_outside() {
    let gpu = gpu();
    let mut mirrored = scene(vec![(sphere(0.5, 32, 64), two_tone())]);
    let plain = render(&gpu, &mirrored, &view(128, 4.0));
    mirrored.nodes[0].transform.scale = Vec3::new(-1.0, 1.0, 1.0);
    let image = render(&gpu, &mirrored, &view(128, 4.0));
    let off = plain.pixels.iter().zip(&image.pixels).filter(|(a, b)| a.abs_diff(**b) > 8).count();
    // The sphere is its own mirror image; only its tessellation differs.
    assert!(off < 200, "{off} channels differ");
}

/// A bar of two segments along +Y with as many influences a vertex as asked for.
fn skinned_bar(per_vertex: usize) -> Scene {
    let mut bar = cube(0.2);
    let count = bar.positions.len();
    bar.influences =
        Influences { per_vertex, joints: vec![0; count * per_vertex], weights: vec![0.0; count * per_vertex] };
    for (v, position) in bar.positions.iter().enumerate() {
        let joint = u16::from(position[1] > 0.0);
        // Split evenly over all slots: the sum must still be whole.
        for slot in 0..per_vertex {
            bar.influences.joints[v * per_vertex + slot] = joint;
            bar.influences.weights[v * per_vertex + slot] = 1.0 / per_vertex as f32;
        }
    }
    let mut scene = scene(vec![(bar, two_tone())]);
    scene.nodes[0].skin = Some(0);
    scene.nodes.push(Node::default());
    scene.nodes.push(Node { parent: Some(1), ..Node::default() });
    scene.skins.push(Skin { joints: vec![1, 2], joint_from_mesh: vec![Mat4::IDENTITY; 2], ..Skin::default() });
    scene
}

#[test]
fn joints_move_what_they_hold_with_any_number_of_influences() {
    let gpu = gpu();
    for per_vertex in [4, 8] {
        let scene = skinned_bar(per_vertex);
        let renderer = Renderer::new(&gpu).expect("a renderer");
        let mut uploaded = staged(renderer.upload(&scene));
        let view = view(128, 4.0);
        let rest = renderer.shoot(&mut uploaded, &view).expect("a picture");
        assert_eq!(pixel(&rest, 64, 30)[..3], [0x80; 3], "nothing above the cube at rest");
        let mut pose = Pose::rest(&scene);
        pose.locals[2].translation.y = 0.3;
        uploaded.actors[0].pose = pose.clone();
        let raised = renderer.shoot(&mut uploaded, &view).expect("a picture");
        assert_ne!(pixel(&raised, 64, 30)[..3], [0x80; 3], "the upper half is raised, {per_vertex} influences");
        assert_ne!(pixel(&raised, 64, 78)[..3], [0x80; 3], "the lower half stays, {per_vertex} influences");
    }
}

#[test]
fn morph_targets_move_only_their_vertices() {
    let gpu = gpu();
    let mut bar = cube(0.2);
    let top: Vec<u32> = (0..bar.positions.len() as u32).filter(|&v| bar.positions[v as usize][1] > 0.0).collect();
    let count = top.len();
    bar.morphs = vec![
        MorphTarget::default(),
        MorphTarget { vertices: top, positions: vec![[0.0, 0.3, 0.0]; count], normals: vec![[0.0; 3]; count] },
    ];
    let mut scene = scene(vec![(bar, two_tone())]);
    scene.meshes[0] = Mesh { morph_names: vec!["nothing".into(), "up".into()], ..scene.meshes[0].clone() };
    scene.nodes[0].morph_weights = vec![0.0, 0.0];
    let renderer = Renderer::new(&gpu).expect("a renderer");
    let mut uploaded = staged(renderer.upload(&scene));
    let view = view(128, 4.0);
    let heights: Vec<u32> = [0.0, 0.5, 1.0]
        .into_iter()
        .map(|weight| {
            let mut pose = Pose::rest(&scene);
            pose.morph_weights[0][1] = weight;
            uploaded.actors[0].pose = pose.clone();
            let image = renderer.shoot(&mut uploaded, &view).expect("a picture");
            (0..128).filter(|&y| pixel(&image, 64, y)[..3] != [0x80; 3]).count() as u32
        })
        .collect();
    assert!(heights[1] > heights[0] + 8 && heights[2] > heights[1] + 8, "growing with the weight: {heights:?}");
}

#[test]
fn an_instance_moves_like_the_camera_moves_back() {
    let gpu = gpu();
    let scene = scene(vec![(sphere(0.4, 48, 96), two_tone())]);
    let here = render(&gpu, &scene, &view(128, 4.0));
    let offset = Vec3::new(3.0, -2.0, 5.0);
    let mut moved = view(128, 4.0);
    moved.camera.eye += offset;
    moved.camera.target += offset;
    moved.instances = vec![Mat4::from_translation(offset)];
    let there = render(&gpu, &scene, &moved);
    let off = here.pixels.iter().zip(&there.pixels).filter(|(a, b)| a.abs_diff(**b) > 2).count();
    assert!(off < 40, "{off} channels differ");
    // Two instances are two characters.
    moved.instances.push(Mat4::from_translation(offset + Vec3::X * 0.5));
    assert_ne!(render(&gpu, &scene, &moved).pixels, there.pixels);
}

#[test]
fn node_transforms_chain() {
    let mut tree = scene(vec![(sphere(0.1, 16, 32), two_tone())]);
    let moved = |x| Transform { translation: Vec3::X * x, ..Transform::default() };
    let sphere_node = tree.nodes.remove(0);
    tree.nodes = vec![
        Node { transform: moved(0.1), ..Node::default() },
        Node { parent: Some(0), transform: moved(0.2), ..Node::default() },
        Node { parent: Some(1), transform: moved(0.1), ..sphere_node },
    ];
    let image = render(&gpu(), &tree, &view(128, 4.0));
    let lit: Vec<u32> = (0..128).filter(|&x| pixel(&image, x, 64)[..3] != [0x80; 3]).collect();
    let middle = (lit[0] + lit[lit.len() - 1]) as f32 / 2.0;
    let expected = 63.5 + 0.4 * 64.0 / (4.0 * 10f32.to_radians().tan());
    assert!((middle - expected).abs() < 1.0, "{middle}, expected {expected}");
}
