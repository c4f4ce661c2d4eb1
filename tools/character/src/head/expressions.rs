//! The morph targets of the face, as states, and the expressions made of them.

use glam::Vec2;

use super::state::{Brow, Eye, Face, MOUTH_WIDTH, Mouth};
use crate::model::Expression;

/// Makes a state.
pub(super) type State = fn() -> Face;

/// Every morph target of the face and the state that it stands for.
pub(super) const STATES: &[(&str, State)] = &[
    ("blinkLeft", || Face { eyes: [SHUT, Eye::default()], ..Face::default() }),
    ("blinkRight", || Face { eyes: [Eye::default(), SHUT], ..Face::default() }),
    ("aa", || mouth(Mouth { width: 0.0126, up: 0.0042, down: 0.0148, corner: 0.0, roundness: 0.52, jaw: 0.0075 })),
    ("ih", || mouth(Mouth { width: 0.0098, up: 0.0008, down: 0.0024, corner: 0.0008, roundness: 0.6, jaw: 0.0014 })),
    ("ou", || mouth(Mouth { width: 0.0044, up: 0.0034, down: 0.0036, corner: -0.001, roundness: 0.5, jaw: 0.0016 })),
    ("ee", || mouth(Mouth { width: 0.0148, up: 0.0018, down: 0.0058, corner: 0.0012, roundness: 0.42, jaw: 0.0024 })),
    ("oh", || mouth(Mouth { width: 0.0064, up: 0.0074, down: 0.0084, corner: -0.001, roundness: 0.5, jaw: 0.005 })),
    ("happy", || Face {
        eyes: [Eye { shut: 1.0, arch: 1.0, ..Eye::default() }; 2],
        mouth: Mouth { width: 0.0148, up: 0.001, down: 0.0108, corner: 0.0034, roundness: 0.62, jaw: 0.003 },
        brow: Brow { lift: [0.003, 0.005, 0.0036], frown: 0.0 },
    }),
    ("angry", || Face {
        eyes: [Eye { upper: [-0.0078, -0.005, 0.0002], lower: 0.0026, iris: -0.1, ..Eye::default() }; 2],
        mouth: Mouth { width: 0.0112, up: 0.0014, down: 0.0012, corner: -0.0046, ..Mouth::default() },
        brow: Brow { lift: [-0.0072, -0.0042, 0.0044], frown: 0.003 },
    }),
    ("sad", || Face {
        eyes: [Eye {
            upper: [0.0004, -0.0054, -0.0096],
            lower: 0.0012,
            gaze: Vec2::new(0.0, -0.0012),
            ..Eye::default()
        }; 2],
        mouth: Mouth { width: 0.0102, up: 0.0008, down: 0.0004, corner: -0.0044, ..Mouth::default() },
        brow: Brow { lift: [0.0066, 0.0002, -0.0048], frown: 0.0014 },
    }),
    ("relaxed", || Face {
        eyes: [Eye { shut: 0.3, arch: 0.85, lower: 0.001, ..Eye::default() }; 2],
        mouth: Mouth { width: 0.0124, up: 0.0, down: 0.0002, corner: 0.0024, ..Mouth::default() },
        brow: Brow { lift: [0.001, 0.0006, -0.0012], frown: 0.0 },
    }),
    ("surprised", || Face {
        eyes: [Eye { upper: [0.0016, 0.0028, 0.0024], lower: -0.0014, iris: -0.2, ..Eye::default() }; 2],
        mouth: Mouth { width: 0.0056, up: 0.005, down: 0.0058, corner: -0.001, roundness: 0.5, jaw: 0.0034 },
        brow: Brow { lift: [0.0085, 0.0098, 0.0082], frown: 0.0 },
    }),
    ("lookUp", || gaze(0.0, 0.0042)),
    ("lookDown", || Face {
        eyes: [Eye { gaze: Vec2::new(0.0, -0.006), upper: [-0.0008, -0.0062, -0.0044], ..Eye::default() }; 2],
        ..Face::default()
    }),
    ("lookLeft", || gaze(0.0066, 0.0)),
    ("lookRight", || gaze(-0.0066, 0.0)),
];

const SHUT: Eye = Eye { shut: 1.0, arch: 0.0, upper: [0.0; 3], lower: 0.0, gaze: Vec2::ZERO, iris: 0.0 };

fn mouth(mouth: Mouth) -> Face {
    debug_assert!(mouth.width < 2.0 * MOUTH_WIDTH, "lips would leave the face");
    Face { mouth, ..Face::default() }
}

fn gaze(left: f32, up: f32) -> Face {
    Face { eyes: [Eye { gaze: Vec2::new(left, up), ..Eye::default() }; 2], ..Face::default() }
}

/// The expressions of VRM 1.0 and our own.
pub(super) fn all() -> Vec<Expression> {
    let plain =
        |name: &'static str| Expression { name, preset: true, morphs: vec![(name, 1.0)], ..Expression::default() };
    let mut list = vec![Expression {
        name: "blink",
        preset: true,
        morphs: vec![("blinkLeft", 1.0), ("blinkRight", 1.0)],
        ..Expression::default()
    }];
    list.extend(STATES.iter().map(|(name, _)| match *name {
        "happy" => Expression { blocks_blink: true, blends_look: true, ..plain("happy") },
        other => plain(other),
    }));
    list.push(Expression { name: "neutral", preset: true, ..Expression::default() });
    list.push(Expression { name: "eyeballs", preset: false, morphs: vec![("eyeballs", 1.0)], ..Expression::default() });
    list
}
