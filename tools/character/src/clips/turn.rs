//! A turn to her left with a small step, then a look to her right.

use glam::Vec3;

use super::clip::{Clip, Source};
use super::curve::{blink, ease, hold, mix};
use super::foot::heel_up;
use super::idle::{breath, stand};
use super::posture::{Foot, Posture, turn as turned};
use crate::skeleton::Skeleton;

/// Seconds.
const LENGTH: f32 = 4.6;
/// Starts of the three moves: to the left, to the right, back.
const MOVES: [f32; 3] = [0.15, 1.65, 3.2];

/// A direction that goes to 1, to -1 and back to 0, `late` seconds after the eyes, each way taking these seconds, and
/// `beyond` too far before it settles.
fn course(time: f32, late: f32, takes: [f32; 3], beyond: f32) -> f32 {
    let way = |i: usize| {
        let end = MOVES[i] + late + takes[i];
        ease(time, end - takes[i], end) + beyond * hold(time, [end - 0.45 * takes[i], end, end, end + 0.36])
    };
    way(0) - 2.0 * way(1) + way(2)
}

/// The left foot steps aside with the look to her left, and back with the look to her right.
fn step(foot: Foot, time: f32) -> Foot {
    let [away, back] = [0.42, MOVES[1] + 0.35];
    let heel: f32 = [away, back].map(|t| hold(time, [t, t + 0.16, t + 0.3, t + 0.52])).iter().sum();
    let high: f32 = [away, back].map(|t| hold(time, [t + 0.06, t + 0.24, t + 0.26, t + 0.5])).iter().sum();
    let open = hold(time, [away + 0.12, away + 0.42, back + 0.12, back + 0.42]);
    let ankle = foot.ankle + Vec3::new(0.02, 0.0, -0.02) * open;
    let aside = Foot { ankle, out: foot.out + 20.0 * open, knee: foot.knee + 14.0 * open, ..foot };
    let foot = heel_up(aside, foot.pitch + 14.0 * heel);
    Foot { ankle: foot.ankle + Vec3::Y * 0.022 * high, ..foot }
}

fn posture(time: f32) -> Posture {
    // The look to her right is from the left leg; the right heel comes up.
    let side = 0.9 * hold(time, [MOVES[1] + 0.3, MOVES[1] + 1.25, MOVES[2], MOVES[2] + 1.1]);
    let mut posture = stand(breath(time / LENGTH), side);
    let eyes = course(time, 0.0, [0.14, 0.18, 0.14], 0.0);
    let head = course(time, 0.12, [0.7, 0.9, 0.76], 0.05);
    let chest = course(time, 0.2, [0.78, 1.0, 0.78], 0.07);
    let hips = course(time, 0.26, [0.76, 1.0, 0.72], 0.06);
    // In the middle of a move the chin goes down: a head turns in an arc.
    let arc: f32 = MOVES.iter().map(|m| hold(time, [m + 0.14, m + 0.48, m + 0.48, m + 0.98])).sum();
    posture.pelvis *= turned(10.0 * hips, 0.0, 0.0);
    posture.hips.y -= 0.002 * arc;
    posture.chest *= turned(22.0 * chest, 1.5 * arc, 1.5 * chest);
    // Over a shoulder she looks a little upwards, with the head a little aside.
    posture.head *= turned(40.0 * head, 5.0 * arc - 2.0 * head.abs(), 3.5 * head);
    for (arm, sign) in posture.arms.iter_mut().zip([1.0, -1.0]) {
        // Arms are dragged along and swing out behind the chest.
        let late = course(time, 0.4, [0.8, 1.0, 0.62], 0.25);
        arm.swing -= sign * (9.0 * chest - 5.0 * (late - chest));
        arm.elbow += 6.0 * arc + 3.0 * chest.abs();
        arm.abduct += 4.0 * arc;
        arm.flex += 4.0 * sign * (late - chest);
    }
    posture.feet[0] = step(posture.feet[0], time);
    // Where the eyes want to look, less what the head has turned already.
    let yaw = (58.0 * eyes - 40.0 * head).clamp(-30.0, 30.0);
    posture.gaze = [yaw, mix(0.0, 2.0, arc)];
    posture
}

/// She looks to her left, waits, looks to her right, waits, and looks ahead again.
pub(super) fn turn(skeleton: &Skeleton) -> Clip {
    let mut blinks = vec![(0.0, 0.0)];
    blinks.extend([MOVES[0] + 0.14, MOVES[1] + 0.2, MOVES[2] + 0.16].into_iter().flat_map(blink));
    let expressions = vec![("blink", blinks)];
    Source { name: "turn", length: LENGTH, rate: 30.0, looped: false, travel: 0.0, posture: &posture, expressions }
        .clip(skeleton)
}
