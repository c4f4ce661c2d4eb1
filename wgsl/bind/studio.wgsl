// The studio in which polished stones stand.
import package::bind::frame::frame;
import package::lib::studio::studio;

// What is seen of it along d, in the light of the scene.
fn studio_light(d: vec3f, light: vec3f, ambient: vec3f, lamps: f32, key: f32) -> vec3f {
    let seen = studio(d, frame.to_light);
    // Cold from above, violet from below.
    let around = (ambient + light * 0.25) * (vec3f(0.72, 0.9, 1.0) * seen.x + vec3f(0.42, 0.38, 0.66) * seen.y);
    return around + light * max(seen.z * lamps, seen.w * key);
}
