//! The state of a face: how open the eyes are, how the mouth is shaped, where brows and gaze are. Every vertex of the
//! face is a function of it, so that a morph target is the difference of two states.

use glam::Vec2;

/// Inner and outer corner of the left eye, x and y.
pub const CORNERS: [Vec2; 2] = [Vec2::new(0.0166, 1.402), Vec2::new(0.0592, 1.4078)];
/// Middle of the left iris.
pub const IRIS: Vec2 = Vec2::new(0.0375, 1.4137);
/// Half axes of the iris.
pub const IRIS_RADII: Vec2 = Vec2::new(0.0154, 0.0182);
/// Height of the mouth's line in its middle.
pub const MOUTH_Y: f32 = 1.3454;
/// Half width of the closed mouth.
pub const MOUTH_WIDTH: f32 = 0.0102;

/// One eye. Lengths in metres.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Eye {
    /// 0 open .. 1 shut.
    pub shut: f32,
    /// Where the lids meet when shut: 0 low, curved down (asleep) .. 1 high, arched (laughing).
    pub arch: f32,
    /// Moves the upper lid at the inner corner, in the middle, at the outer corner.
    pub upper: [f32; 3],
    /// Moves the lower lid up.
    pub lower: f32,
    /// Moves the iris to the left of the character, and up.
    pub gaze: Vec2,
    /// Size of the iris, minus 1.
    pub iris: f32,
}

/// The mouth. Lengths in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mouth {
    /// Half width.
    pub width: f32,
    /// Upper lip above its place at rest.
    pub up: f32,
    /// Lower lip below its place at rest.
    pub down: f32,
    /// Corners above their place at rest.
    pub corner: f32,
    /// How round the opening is: 1 like a lens, 0.5 like an ellipse.
    pub roundness: f32,
    /// How far the jaw drops.
    pub jaw: f32,
}

impl Default for Mouth {
    fn default() -> Self {
        Self { width: MOUTH_WIDTH, up: 0.0, down: 0.0, corner: 0.0, roundness: 0.75, jaw: 0.0 }
    }
}

/// One brow: what it adds to its place at the inner end, in the middle, at the outer end.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Brow {
    /// Heights.
    pub lift: [f32; 3],
    /// Inner end moved towards the middle of the face.
    pub frown: f32,
}

/// The whole face. Left and right are the character's.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Face {
    /// Left and right eye.
    pub eyes: [Eye; 2],
    /// Mouth.
    pub mouth: Mouth,
    /// Brows.
    pub brow: Brow,
}

/// Height of the open upper lid over the line between the corners, at `s` from the inner (0) to the outer corner (1).
fn upper_rest(s: f32) -> f32 {
    // Rises fast at the inner corner, flat on top, falls to the outer corner in a long line.
    let s = s.clamp(0.0, 1.0);
    0.0248 * (1.0 - (1.0 - s).powf(3.4)).powf(0.72) * (1.0 - s.powf(3.0)).powf(0.78) * (1.08 - 0.12 * s)
}

/// Depth of the open lower lid under the same line.
fn lower_rest(s: f32) -> f32 {
    let s = s.clamp(0.0, 1.0);
    0.0114 * (1.0 - (1.0 - s).powf(2.2)).powf(0.8) * (1.0 - s.powf(4.0)).powf(0.8)
}

fn three(values: [f32; 3], s: f32) -> f32 {
    let [a, b, c] = values;
    let (l0, l1, l2) = (2.0 * (s - 0.5) * (s - 1.0), -4.0 * s * (s - 1.0), 2.0 * s * (s - 0.5));
    a * l0 + b * l1 + c * l2
}

impl Eye {
    /// Heights of the upper and the lower lid at `s`, 0 at the inner and 1 at the outer corner.
    #[must_use]
    pub fn lids(&self, s: f32) -> [f32; 2] {
        let s = s.clamp(0.0, 1.0);
        let line = CORNERS[0].y + (CORNERS[1].y - CORNERS[0].y) * s;
        let (up, low) = (upper_rest(s), -lower_rest(s));
        // Where nothing opens, nothing moves: the corners stay.
        let free = (4.0 * s * (1.0 - s)).sqrt();
        let upper = line + up + three(self.upper, s) * free;
        let lower = line + low + self.lower * free;
        let asleep = line + low * 0.62 + up * 0.02;
        let laughing = line + up * 0.34 + low * 0.05;
        let meet = asleep + (laughing - asleep) * self.arch;
        // Lids meet with a hair's breadth between them, so that no triangle folds over.
        let gap = 0.00015 * free;
        [upper + (meet + gap - upper) * self.shut, lower + (meet - gap - lower) * self.shut]
    }
}

impl Mouth {
    /// Upper and lower lip at `q`, 0 in the middle and 1 at the corner: x, upper y, lower y.
    #[must_use]
    pub fn lips(&self, q: f32) -> [f32; 3] {
        let q = q.clamp(0.0, 1.0);
        let bulge = (1.0 - q * q).max(0.0).powf(self.roundness);
        let line = mouth_line(q) + self.corner * q * q;
        let gap = 0.00012;
        [self.width * q, line + gap + self.up * bulge, line - gap - self.down * bulge]
    }
}

/// Height of the closed mouth's line.
fn mouth_line(q: f32) -> f32 {
    MOUTH_Y + 0.002 * q * q - 0.0002 * (1.0 - q)
}

/// Smooth fall from 1 at 0 to 0 at `reach`.
fn fade(distance: f32, reach: f32) -> f32 {
    let t = (1.0 - distance / reach).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

impl Face {
    /// Where the skin at (x, y) of the resting face goes.
    #[must_use]
    pub fn skin(&self, x: f32, y: f32) -> Vec2 {
        let eye = &self.eyes[usize::from(x < 0.0)];
        let mut to = Vec2::new(x.abs(), y);
        to.y += eye_pull(eye, x.abs(), y);
        to += self.mouth_pull(x.abs(), y);
        Vec2::new(if x < 0.0 { -to.x } else { to.x }, to.y)
    }

    fn mouth_pull(&self, x: f32, y: f32) -> Vec2 {
        let (rest, now) = (Mouth::default(), self.mouth);
        let q = (x / rest.width).min(1.0);
        let ([rx, ru, rl], [nx, nu, nl]) = (rest.lips(q), now.lips(q));
        let beside = (x - rx).max(0.0);
        let (dy, above) = if y >= mouth_line(q) {
            (nu - ru, (y - ru).max(0.0))
        } else {
            (nl - rl, (rl - y).max(0.0))
        };
        let reach = if y >= ru { 0.0165 } else { 0.02 };
        let near = fade(above.hypot(beside), reach);
        let mut pull = Vec2::new(nx - rx, dy) * near;
        // The jaw takes the chin along.
        let under = fade(((y - 1.318) / 0.03).clamp(0.0, 1.0), 1.0) * fade((x / 0.062).min(1.0), 1.0);
        pull.y -= now.jaw * under * (1.0 - near);
        pull
    }
}

fn eye_pull(eye: &Eye, x: f32, y: f32) -> f32 {
    let rest = Eye::default();
    let s = (x - CORNERS[0].x) / (CORNERS[1].x - CORNERS[0].x);
    let beside = (CORNERS[0].x - x).max(x - CORNERS[1].x).max(0.0);
    let ([ru, rl], [nu, nl]) = (rest.lids(s), eye.lids(s));
    let (pull, away) = if y >= (ru + rl) * 0.5 {
        (nu - ru, (y - ru).max(0.0))
    } else {
        (nl - rl, (rl - y).max(0.0))
    };
    let reach = if y >= ru { 0.0145 } else { 0.011 };
    pull * fade(away, reach) * fade(beside, 0.004)
}
