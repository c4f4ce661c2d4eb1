//! What an actor sees of itself.

use std::collections::BTreeSet;

use glam::{Quat, Vec3};
use hikage::scene::{Character, FirstPerson, Framing, HumanBone, Mesh, Node, Role, Scene, Transform};
use hikage::{Actor, Channel, Renderer, Stage, View};

use crate::support::{anime_heroine, cube, gpu, scene, two_tone, view, with_renderer};

/// Parts by number that a view shows, for each actor by the half of the picture that it stands in.
fn parts(renderer: &Renderer, stage: &mut Stage, view: &View) -> [BTreeSet<usize>; 2] {
    let image = renderer.render(stage, &View { channel: Channel::PartId, ..view.clone() }).expect("a channel");
    let mut found = [BTreeSet::new(), BTreeSet::new()];
    for (i, p) in image.pixels.chunks_exact(4).enumerate() {
        let part = usize::from(p[0]) | usize::from(p[1]) << 8;
        if part > 0 {
            found[usize::from(i as u32 % image.width >= image.width / 2)].insert(part - 1);
        }
    }
    found
}

#[test]
fn an_actor_sees_neither_its_head_nor_its_hair() {
    let gpu = gpu();
    let heroine = anime_heroine();
    with_renderer(&gpu, |renderer| {
        let character = renderer.upload(&heroine).expect("an upload");
        let places = [[-0.6, 0.0, 0.0], [0.6, 0.0, 0.0]];
        let mut stage = Stage::of(places.map(|p| Actor::new(&character).at(p, 0.0)));
        let view = View::framed_stage(&stage, Framing::Full, 0.0, [256, 160]);
        let roles: Vec<Role> = heroine.mesh_nodes().flat_map(|(_, m)| m.primitives.iter().map(|p| p.role)).collect();
        let shows = |found: &BTreeSet<usize>, role: Role| found.iter().any(|part| roles[*part] == role);
        for (looking, other) in [(0, 1), (1, 0)] {
            let seen = parts(renderer, &mut stage, &View { first_person: Some(looking), ..view.clone() });
            for role in [Role::Face, Role::HairFront, Role::Hair, Role::Eye] {
                assert!(!shows(&seen[looking], role), "actor {looking} sees its own {role:?}");
                assert!(shows(&seen[other], role), "actor {looking} does not see the other's {role:?}");
            }
            assert!(shows(&seen[looking], Role::Cloth) && shows(&seen[looking], Role::Skin), "its body has gone");
        }
        let error =
            renderer.render(&mut stage, &View { first_person: Some(2), ..view }).expect_err("nobody").to_string();
        assert!(error.contains("first_person: is 2; there are 2 actors"), "{error}");
    });
}

/// A body with a head on it, each a cube on a node of its own, and a third one beside them.
fn figure(of: [Option<FirstPerson>; 3]) -> Scene {
    let mut figure = scene(vec![(cube(0.12), two_tone())]);
    let mesh = |mesh, parent, at: Vec3| Node {
        mesh: Some(mesh),
        parent,
        transform: Transform { translation: at, rotation: Quat::IDENTITY, scale: Vec3::ONE },
        morph_weights: Vec::new(),
        ..Node::default()
    };
    figure.meshes = vec![Mesh { ..figure.meshes[0].clone() }];
    figure.nodes = vec![mesh(0, None, Vec3::ZERO), mesh(0, Some(0), Vec3::Y * 0.3), mesh(0, Some(0), Vec3::Y * -0.3)];
    let first_person = of.into_iter().enumerate().filter_map(|(node, of)| Some((node, of?))).collect();
    let bones = [(HumanBone::Hips, 0), (HumanBone::Head, 1)].into();
    figure.character = Some(Character { bones, first_person, ..Character::default() });
    figure
}

#[test]
fn annotations_say_who_sees_a_part() {
    let gpu = gpu();
    use FirstPerson::{Both, FirstPersonOnly, ThirdPersonOnly};
    with_renderer(&gpu, |renderer| {
        for (of, others, own) in [
            ([None; 3], vec![0, 1, 2], vec![0, 2]),
            ([None, Some(Both), None], vec![0, 1, 2], vec![0, 1, 2]),
            ([Some(ThirdPersonOnly), None, Some(FirstPersonOnly)], vec![0, 1], vec![2]),
        ] {
            let character = renderer.upload(&figure(of)).expect("an upload");
            let mut stage = Stage::of([Actor::new(&character)]);
            let shot = view(64, 3.0).view();
            let [left, right] = parts(renderer, &mut stage, &shot);
            assert_eq!((&left, left == right), (&others.into_iter().collect(), true), "{of:?} for others");
            let [left, _] = parts(renderer, &mut stage, &View { first_person: Some(0), ..shot });
            assert_eq!(left, own.into_iter().collect(), "{of:?} for itself");
        }
    });
}
