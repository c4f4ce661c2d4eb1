//! Standing at ease: on its feet, weight on one leg, both arms beside the body, of any humanoid.

use std::path::Path;

use hikage::glam::{Quat, Vec3};
use hikage::import::{Limits, load, load_bytes};
use hikage::motion::{Pose, Stance};
use hikage::scene::{HumanBone, Scene};

fn models() -> Vec<(String, Scene)> {
    let built_in = load_bytes("hikage.vrm", &hikage_character::file(), None, &Limits::default()).expect("built-in");
    let mut models = vec![("built-in".to_owned(), built_in)];
    let shared = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/models");
    for name in ["Seed-san_rebuilt.vrm", "Godette_vrm_v4.vrm"] {
        let file = shared.join(name);
        if file.is_file() {
            models.push((name.to_owned(), load(&file).expect("model")));
        } else {
            eprintln!("not tested: {} is absent", file.display());
        }
    }
    models
}

#[test]
fn at_ease_everybody_stands_on_one_leg_with_both_feet_on_the_ground() {
    for (name, scene) in models() {
        let mut pose = Pose::rest(&scene);
        pose.set_stance(&scene, Stance::Relaxed);
        let (rest, posed) = (scene.rest_world_from_nodes(), scene.world_from_nodes(&pose.locals));
        let at = |bone: HumanBone| {
            let node = scene.bone_node(bone).expect("bone");
            let moved = posed[node].to_scale_rotation_translation();
            let rested = rest[node].to_scale_rotation_translation();
            (rested.2, moved.2, moved.1 * rested.1.inverse())
        };
        let mut yaws = [0.0; 2];
        for (yaw, bone) in yaws.iter_mut().zip([HumanBone::LeftFoot, HumanBone::RightFoot]) {
            let (rested, moved, turn): (Vec3, Vec3, Quat) = at(bone);
            assert!((moved.y - rested.y).abs() < 0.005, "{name}: {bone:?} at {moved}, at rest {rested}");
            assert!((turn * Vec3::Y).y > 0.9999, "{name}: {bone:?} is not level");
            *yaw = (turn * Vec3::Z).x.to_degrees();
        }
        assert!((yaws[0] - yaws[1]).abs() > 10.0, "{name}: feet are parallel");
        let (rested, hips, turn) = at(HumanBone::Hips);
        assert!(hips.x - rested.x < -0.01, "{name}: {hips}");
        assert!((turn * Vec3::X).y < -0.05, "{name}: hips are level");
        let (_, _, head) = at(HumanBone::Head);
        assert!((head * Vec3::Y).x > 0.05, "{name}: the head is upright");
        let (_, left, _) = at(HumanBone::LeftHand);
        let (_, right, _) = at(HumanBone::RightHand);
        assert!((left.y - right.y).abs() > 0.02 || (left.z - right.z).abs() > 0.04, "{name}: arms are mirrored");
        let (_, left_leg, _) = at(HumanBone::LeftUpperLeg);
        let (_, right_leg, _) = at(HumanBone::RightUpperLeg);
        assert!(left.x > left_leg.x && right.x < right_leg.x, "{name}: an arm is in the body");
    }
}
