// The eye that a place belongs to.
import package::bind::varying::Varying;
import package::lib::normal::unit_from_octahedral;

// What of a row of each eye is that of one. Looked up by a number, it would be unknown to software rasterizers beside a triangle,
// and textures and normals would see a step.
fn of_eye(number: u32, first: vec4f, second: vec4f, third: vec4f, fourth: vec4f) -> vec4f {
    return select(select(first, second, number == 1u), select(third, fourth, number == 3u), number > 1u);
}

// Axes of the eye in the world: to the right as it is seen, up, and its gaze. A direction times this is one of the eye.
fn eye_axes(at: Varying) -> mat3x3f {
    let gaze = unit_from_octahedral(unpack2x16snorm(at.eye_axes.y));
    let side = unit_from_octahedral(unpack2x16snorm(at.eye_axes.z));
    let right = normalize(side - gaze * dot(side, gaze));
    return mat3x3f(right, cross(gaze, right), gaze);
}
