//! Standing: the posture from which all clips start, and the life in it.

use glam::Vec3;

use super::clip::{Clip, Source};
use super::curve::{blink, hold, mix, swing};
use super::foot::{ANKLE, heel_up};
use super::posture::{Arm, Foot, Posture, turn};
use crate::skeleton::Skeleton;

/// An arm at ease beside the skirt.
const ARM: Arm = Arm {
    raise: -2.0,
    protract: 0.0,
    swing: -3.0,
    abduct: 18.0,
    twist: 16.0,
    elbow: 21.0,
    pronate: 14.0,
    flex: 5.0,
    deviate: 0.0,
    curl: 1.2,
    spread: 0.0,
};

/// Standing at ease, `breath` 0 (out) to 1 (in) and `side` 0 (weight on the right leg) to 1 (on the left).
pub(super) fn stand(breath: f32, side: f32) -> Posture {
    let foot =
        |x: f32, z: f32, out: f32| Foot { ankle: Vec3::new(x, ANKLE, z), out, knee: out * 0.5, ..Foot::default() };
    // Hips go to the leg that carries and are higher there, its free neighbour comes forward; shoulders lean against them.
    let lean = mix(-1.0, 1.0, side);
    // Between the legs the hips pass with soft knees.
    let low = 4.0 * side * (1.0 - side);
    let arm = |sign: f32| Arm {
        raise: ARM.raise + 3.0 * breath,
        swing: ARM.swing - 4.0 * sign * lean,
        abduct: ARM.abduct + 6.0 * sign * lean + 0.8 * breath,
        elbow: ARM.elbow - 6.0 * sign * lean,
        ..ARM
    };
    Posture {
        hips: Vec3::new(0.042 * lean, 0.8503 - 0.006 * low + 0.0008 * breath, -0.004 * low),
        pelvis: turn(5.5 * lean, 1.5 + low, 7.5 * lean),
        chest: turn(-3.0 * lean, -0.5 - 2.6 * breath + 0.8 * low, -5.5 * lean),
        head: turn(-1.5 * lean, 1.5 - 0.6 * breath + 0.5 * low, 3.0 * lean),
        arms: [arm(1.0), arm(-1.0)],
        feet: [heel_up(foot(0.095, 0.055, 20.0), 6.0 * (1.0 - side)), heel_up(foot(0.052, -0.02, 6.0), 10.0 * side)],
        gaze: [0.0; 2],
    }
}

/// Breath at a phase counted in breaths: in faster than out, 0 at whole numbers.
pub(super) fn breath(phase: f32) -> f32 {
    let phase = phase.rem_euclid(1.0);
    // A warped cosine: the peak comes at two fifths.
    let warped = phase + 0.03 * (std::f32::consts::TAU * phase).sin();
    0.5 - 0.5 * swing(warped, 0.0)
}

/// Seconds of the loop.
const LENGTH: f32 = 10.0;
/// Looks aside: when the eyes set out and when they come back, and where they go, degrees: yaw to her left, pitch down.
const LOOKS: [([f32; 2], [f32; 2]); 2] = [([1.9, 4.4], [24.0, 3.0]), ([5.4, 8.0], [-19.0, -4.0])];

fn posture(time: f32) -> Posture {
    let phase = time / LENGTH;
    let side = hold(time, [1.4, 3.3, 6.1, 8.2]);
    let mut posture = stand(breath(3.0 * phase), side);
    // Whole numbers of turns a loop. Each starts at its own rest, so that the loop starts standing.
    let drift = |turns: f32, late: f32| swing(turns * phase, late) - swing(0.0, late);
    // The eyes go first, then the head takes most of the way, and the chest a little of it.
    let toward = |late: f32, takes: f32, axis: usize| -> f32 {
        let way = |[from, back]: [f32; 2]| hold(time, [from, from + takes, back, back + takes].map(|t| t + late));
        LOOKS.iter().map(|(times, to)| to[axis] * way(*times)).sum()
    };
    let [eyes, head] = [(0.0, 0.14), (0.1, 0.75)].map(|(late, takes)| [0, 1].map(|axis| toward(late, takes, axis)));
    let head = head.map(|angle| 0.72 * angle);
    posture.chest *= turn(0.16 * toward(0.3, 1.0, 0), 0.0, 0.0);
    posture.head *= turn(
        head[0] + 1.2 * drift(1.0, 0.3) + 0.5 * drift(3.0, 0.1),
        head[1] + 0.6 * drift(2.0, 0.35),
        0.12 * head[0] + 0.8 * drift(1.0, 0.55),
    );
    for (arm, [a, b]) in posture.arms.iter_mut().zip([[0.12, 0.4], [0.5, 0.85]]) {
        arm.swing += 1.2 * drift(1.0, a);
        arm.elbow += 2.0 * drift(2.0, b);
        arm.pronate += 2.0 * drift(1.0, b);
        arm.flex += 2.5 * drift(2.0, a);
        arm.curl += 0.16 * drift(3.0, a) + 0.1 * drift(2.0, b);
        arm.spread += 0.8 * drift(3.0, b);
    }
    // The left hand comes in before the belt, its fingers close and open.
    let upper = hold(time, [2.6, 4.0, 7.2, 8.9]);
    let fore = hold(time, [2.75, 4.25, 7.05, 8.75]);
    let fingers = hold(time, [3.1, 4.5, 5.0, 5.7]) + hold(time, [5.6, 6.2, 7.4, 8.4]);
    let hand = &mut posture.arms[0];
    hand.swing += 14.0 * upper;
    hand.abduct += 3.0 * upper;
    hand.twist += 22.0 * fore;
    hand.elbow += 50.0 * fore;
    hand.flex += 10.0 * fore - 5.0 * fingers;
    hand.curl += 0.7 * fingers;
    posture.gaze = [eyes[0] - head[0] + 0.8 * drift(2.0, 0.2), eyes[1] - head[1] + 0.4 * drift(1.0, 0.7)];
    posture
}

/// Standing, breathing, shifting the weight from one leg to the other and back.
pub(super) fn idle(skeleton: &Skeleton) -> Clip {
    let mut blinks = vec![(0.0, 0.0)];
    blinks.extend([0.6, 1.95, 4.45, 4.85, 8.05].into_iter().flat_map(blink));
    let expressions = vec![("blink", blinks)];
    Source { name: "idle", length: LENGTH, rate: 30.0, looped: true, travel: 0.0, posture: &posture, expressions }
        .clip(skeleton)
}
