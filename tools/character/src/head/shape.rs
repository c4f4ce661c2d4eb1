//! Shape of the head that other parts rely on: the skull under the hair, and landmarks of the face.

use glam::Vec3;

/// Centre of the ellipsoid that the head follows above the brows and at the back.
pub const SKULL_CENTER: Vec3 = Vec3::new(0.0, 1.442, -0.012);
/// Its radii, metres.
pub const SKULL_RADII: Vec3 = Vec3::new(0.083, 0.108, 0.098);
/// Height of the chin.
pub const CHIN_Y: f32 = 1.315;
/// Height of the middle of the eyes.
pub const EYE_Y: f32 = 1.412;
/// Height of the brows.
pub const BROW_Y: f32 = 1.45;
/// Height of the hairline above the forehead.
pub const HAIRLINE_Y: f32 = 1.497;
/// Middle of the left ear; it stands 12 mm out from the skull and is 50 mm tall.
pub const EAR: Vec3 = Vec3::new(0.083, 1.4, -0.018);

/// Point of the skull's ellipsoid in this direction from its centre, moved outwards by `lift` metres.
#[must_use]
pub fn skull(direction: Vec3, lift: f32) -> Vec3 {
    let d = direction.normalize_or(Vec3::Y);
    let on = d / (d / SKULL_RADII).length();
    SKULL_CENTER + on + (on / (SKULL_RADII * SKULL_RADII)).normalize() * lift
}
