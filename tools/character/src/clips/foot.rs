//! The path of a foot over one stride: heel strike, flat foot, heel-off, toe-off, swing.

use glam::Vec3;

use super::curve::{Spline, ease, mix};
use super::posture::{Foot, turn};

/// Ankle over the ground when the foot stands flat, and from it the back edge of the heel, the joint of the toes and from
/// that the tip of the toes. Metres.
pub(super) const ANKLE: f32 = 0.083;
const HEEL: Vec3 = Vec3::new(0.0, -ANKLE, -0.052);
const TOES: Vec3 = Vec3::new(0.0, -0.061, 0.09);
const TIP: Vec3 = Vec3::new(0.0, -0.019, 0.086);

/// Measures of a stride. Phases of stance are shares of the time that the foot is on the ground.
#[derive(Clone)]
pub(super) struct Stride {
    /// Way of the body over one stride, metres.
    pub length: f32,
    /// Share of the stride that the foot is on the ground.
    pub stance: f32,
    /// How far before the body the ankle of the flat foot would be at heel strike, metres.
    pub reach: f32,
    /// Pitch of the foot at heel strike; toes are up where negative. Degrees.
    pub strike: f32,
    /// Phase of stance at which the foot lies flat.
    pub flat: f32,
    /// Phase of stance at which the heel leaves the ground, and the pitch of the foot at toe-off, degrees.
    pub heel_off: (f32, f32),
    /// Phase of stance at which the toes begin to roll, and their pitch at toe-off, degrees.
    pub toe_roll: (f32, f32),
    /// The ankle in swing: share of swing, place before the body, height (metres), pitch, bend of the toes (degrees).
    pub swing: &'static [[f32; 5]],
    /// How fast the foot leaves the ground, and how fast it meets it: metres of height over a whole stride.
    pub lift: f32,
    pub landing: f32,
    /// Distance of the ankle from the middle line in stance and in the middle of swing, metres.
    pub apart: [f32; 2],
    /// Toes out, degrees.
    pub out: f32,
    /// Knee out, degrees.
    pub knee: f32,
}

/// The path: stance by contact with the ground, swing by splines that take over its speed.
pub(super) struct Path {
    stride: Stride,
    swing: [Spline; 5],
}

impl Path {
    pub(super) fn new(stride: Stride) -> Self {
        let [first, last] = [stride.stance, 0.0].map(|phase| stride.on_ground(phase));
        // Slopes, from a short way within stance.
        const SHORT: f32 = 2e-3;
        let before = stride.on_ground(stride.stance - SHORT);
        let after = stride.on_ground(SHORT);
        let place = |share: f32| mix(stride.stance, 1.0, share);
        let swing = std::array::from_fn(|i| {
            let mut keys = vec![[stride.stance, first[i]]];
            if i < 4 {
                keys.extend(stride.swing.iter().map(|key| [place(key[0]), key[i + 1]]));
            }
            keys.push([1.0, last[i]]);
            let [lift, landing] = if i == 1 {
                [stride.lift, stride.landing]
            } else {
                [0.0; 2]
            };
            Spline::new(keys, (first[i] - before[i]) / SHORT + lift, (after[i] - last[i]) / SHORT - landing)
        });
        Self { stride, swing }
    }

    /// The foot at a phase of its stride, 0 at heel strike, in a frame that goes along with the body's mean speed.
    pub(super) fn at(&self, phase: f32) -> Foot {
        let phase = phase.rem_euclid(1.0);
        let stride = &self.stride;
        let [z, y, pitch, bend, side] = if phase <= stride.stance {
            stride.on_ground(phase)
        } else {
            std::array::from_fn(|i| self.swing[i].at(phase))
        };
        let middle = mix(stride.stance, 1.0, 0.5);
        let aside = ease(phase, stride.stance, middle) - ease(phase, middle, 1.0);
        Foot {
            ankle: Vec3::new(mix(stride.apart[0], stride.apart[1], aside) + side, y, z),
            out: stride.out,
            pitch,
            toes: pitch - bend,
            knee: stride.knee,
        }
    }
}

impl Stride {
    /// Place before the body, height, pitch, bend of the toes and way aside at a phase of the stride within stance.
    fn on_ground(&self, phase: f32) -> [f32; 5] {
        let s = phase / self.stance;
        let flat = Vec3::new(0.0, ANKLE, self.reach - self.length * phase);
        let (pitch, toes) = if s < self.flat {
            let left = 1.0 - s / self.flat;
            let pitch = self.strike * left * left;
            (pitch, pitch)
        } else {
            (rising(s, self.heel_off), rising(s, self.toe_roll))
        };
        let moved = if pitch < 0.0 {
            HEEL - turn(0.0, pitch, 0.0) * HEEL
        } else {
            // The toes lie flat and the foot turns over their joint, until they roll over their tip.
            TOES - turn(0.0, pitch, 0.0) * TOES + TIP - turn(0.0, toes, 0.0) * TIP
        };
        let ankle = flat + turn(self.out, 0.0, 0.0) * moved;
        [ankle.z, ankle.y, pitch, pitch - toes, ankle.x]
    }
}

/// A foot on the ground with its heel raised to a pitch over the toes, which stay where they are.
pub(super) fn heel_up(foot: Foot, pitch: f32) -> Foot {
    let moved = turn(foot.out, 0.0, 0.0) * (turn(0.0, foot.pitch, 0.0) * TOES - turn(0.0, pitch, 0.0) * TOES);
    Foot { ankle: foot.ankle + moved, pitch, ..foot }
}

/// From 0 at a phase of stance to a value at its end, ever faster.
fn rising(s: f32, (from, end): (f32, f32)) -> f32 {
    let u = ((s - from) / (1.0 - from)).max(0.0);
    end * u * u
}
