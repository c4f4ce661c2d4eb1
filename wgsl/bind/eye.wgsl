// The eye that a place belongs to.
import package::bind::varying::Varying;
import package::lib::normal::unit_from_octahedral;

// Axes of the eye in the world: to the right as it is seen, up, and its gaze. A direction times this is one of the eye.
fn eye_axes(at: Varying) -> mat3x3f {
    let gaze = unit_from_octahedral(unpack2x16snorm(at.eye_axes.y));
    let side = unit_from_octahedral(unpack2x16snorm(at.eye_axes.z));
    let right = normalize(side - gaze * dot(side, gaze));
    return mat3x3f(right, cross(gaze, right), gaze);
}
