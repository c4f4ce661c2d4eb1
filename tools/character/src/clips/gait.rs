//! Walk and run: the feet lead, the body answers.

use glam::Vec3;

use super::clip::{Clip, Source};
use super::curve::swing;
use super::foot::{Path, Stride};
use super::posture::{Arm, Posture, turn};
use crate::skeleton::Skeleton;

/// A value that swings once (or twice) a stride: mean, half range and the phase of its peak in the stride of the left
/// foot, whose heel strikes at 0.
type Wave = (f32, f32, f32);

/// Once a stride.
fn once((mean, range, peak): Wave, phase: f32) -> f32 {
    mean + range * swing(phase, peak)
}

/// Once a step; the peak is in the left foot's step.
fn twice((mean, range, peak): Wave, phase: f32) -> f32 {
    mean + range * swing(2.0 * phase, 2.0 * peak)
}

/// Measures of a gait. Angles in degrees, lengths in metres.
struct Gait {
    name: &'static str,
    /// Seconds of a stride, two steps.
    length: f32,
    stride: Stride,
    /// Hips: aside, up, and before the mean.
    aside: Wave,
    up: Wave,
    ahead: Wave,
    /// Pelvis: turn to her left, lean, lift of the left side.
    pelvis: [Wave; 3],
    /// The same of the chest.
    chest: [Wave; 3],
    /// The same of the head.
    head: [Wave; 3],
    /// The left arm: shoulder blade up (twice a stride) and forward, upper arm forward, elbow, hand to the palm.
    raise: Wave,
    protract: Wave,
    swing: Wave,
    elbow: Wave,
    flex: Wave,
    /// Abduction and twist of the upper arm, most when it is before the body.
    abduct: Wave,
    twist: Wave,
    /// Gaze against the head: yaw once, pitch twice a stride.
    gaze: [Wave; 2],
    /// What else the arm does.
    arm: Arm,
}

fn walk_gait() -> Gait {
    Gait {
        name: "walk",
        length: 28.0 / 30.0,
        stride: Stride {
            length: 1.24,
            stance: 0.61,
            reach: 0.284,
            strike: -15.0,
            flat: 0.16,
            heel_off: (0.42, 64.0),
            toe_roll: (0.8, 24.0),
            swing: &[
                [0.28, -0.15, 0.192, 46.0, 18.0],
                [0.58, 0.115, 0.114, 6.0, -6.0],
                [0.84, 0.25, 0.107, -13.0, -6.0],
            ],
            lift: 0.26,
            landing: 0.5,
            apart: [0.052, 0.066],
            out: 4.0,
            knee: 3.0,
        },
        aside: (0.0, 0.02, 0.3),
        up: (0.8385, 0.0165, 0.29),
        ahead: (0.0, 0.006, 0.15),
        pelvis: [(0.0, -7.5, 0.0), (3.0, 1.2, 0.02), (0.0, 4.6, 0.2)],
        chest: [(0.0, 5.5, 0.03), (1.5, 1.0, 0.06), (0.0, -2.2, 0.24)],
        head: [(0.0, 2.6, 0.12), (0.5, -1.8, 0.1), (0.0, -2.2, 0.32)],
        raise: (-2.0, 0.8, 0.12),
        protract: (0.0, -4.0, 0.03),
        swing: (-3.0, -19.0, 0.03),
        elbow: (29.0, -11.0, 0.1),
        flex: (2.0, 7.0, 0.22),
        abduct: (19.5, 1.0, 0.05),
        twist: (10.0, -8.0, 0.05),
        gaze: [(0.0, -3.0, 0.1), (-1.5, 1.2, 0.1)],
        arm: Arm { pronate: 14.0, curl: 1.35, ..Arm::default() },
    }
}

fn run_gait() -> Gait {
    Gait {
        name: "run",
        length: 20.0 / 30.0,
        stride: Stride {
            length: 2.36,
            stance: 0.3,
            reach: 0.195,
            strike: -5.0,
            flat: 0.18,
            heel_off: (0.4, 66.0),
            toe_roll: (0.72, 26.0),
            swing: &[
                [0.18, -0.49, 0.345, 98.0, 8.0],
                [0.4, -0.29, 0.43, 92.0, 4.0],
                [0.6, 0.04, 0.35, 48.0, -4.0],
                [0.8, 0.27, 0.2, 10.0, -6.0],
            ],
            lift: 0.2,
            landing: 0.5,
            apart: [0.034, 0.066],
            out: 3.0,
            knee: 0.0,
        },
        aside: (0.0, 0.01, 0.15),
        up: (0.824, 0.025, 0.385),
        ahead: (0.0, 0.004, 0.4),
        pelvis: [(0.0, -8.0, 0.02), (11.0, 2.5, 0.24), (0.0, 3.5, 0.12)],
        chest: [(0.0, 11.0, 0.03), (19.0, 2.0, 0.27), (0.0, -2.0, 0.16)],
        head: [(0.0, 1.5, 0.08), (7.0, -1.5, 0.28), (0.0, -1.0, 0.2)],
        raise: (0.0, 1.6, 0.22),
        protract: (2.0, -7.0, 0.03),
        swing: (-10.0, -36.0, 0.02),
        elbow: (106.0, -9.0, 0.08),
        flex: (2.0, 6.0, 0.16),
        abduct: (22.0, 4.0, 0.52),
        twist: (2.0, -12.0, 0.04),
        gaze: [(0.0, -1.5, 0.08), (-3.0, 1.5, 0.28)],
        arm: Arm { pronate: -6.0, curl: 3.1, ..Arm::default() },
    }
}

impl Gait {
    fn left_arm(&self, phase: f32) -> Arm {
        Arm {
            raise: twice(self.raise, phase),
            protract: once(self.protract, phase),
            swing: once(self.swing, phase),
            abduct: once(self.abduct, phase),
            twist: once(self.twist, phase),
            elbow: once(self.elbow, phase),
            flex: once(self.flex, phase),
            ..self.arm
        }
    }

    fn posture(&self, path: &Path, time: f32) -> Posture {
        let phase = time / self.length;
        let way = Vec3::Z * self.stride.length * phase;
        let direction = |[yaw, pitch, roll]: [Wave; 3]| turn(once(yaw, phase), twice(pitch, phase), once(roll, phase));
        Posture {
            hips: Vec3::new(once(self.aside, phase), twice(self.up, phase), twice(self.ahead, phase)),
            pelvis: direction(self.pelvis),
            chest: direction(self.chest),
            head: direction(self.head),
            arms: [phase, phase + 0.5].map(|p| self.left_arm(p)),
            feet: [phase, phase + 0.5].map(|p| path.at(p)),
            gaze: [once(self.gaze[0], phase), twice(self.gaze[1], phase)],
        }
        .moved(way)
    }

    fn clip(self, skeleton: &Skeleton) -> Clip {
        let (name, length, travel) = (self.name, self.length, self.stride.length);
        let path = Path::new(self.stride.clone());
        let posture = |time: f32| self.posture(&path, time);
        // Legs turn fast; at half the usual rate of keys the planted foot would shiver between them.
        Source { name, length, rate: 60.0, looped: true, travel, posture: &posture, expressions: Vec::new() }
            .clip(skeleton)
    }
}

/// Walk.
pub(super) fn walk(skeleton: &Skeleton) -> Clip {
    walk_gait().clip(skeleton)
}

/// Run.
pub(super) fn run(skeleton: &Skeleton) -> Clip {
    run_gait().clip(skeleton)
}
