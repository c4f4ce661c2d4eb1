// Eyes through hair: how near hair may hang, and from where it is seen.

// Clip z of a point that lies `window` metres nearer to the camera; depth is near / distance, w the distance. A tenth of
// the distance stays, so that nothing comes before the near plane.
fn pulled_depth(z: f32, w: f32, window: f32) -> f32 {
    return z * w / max(w - window, 0.1 * w);
}

// Share that is seen, by the direction to the viewer in the frame of the face (x to the side, y up, z forward); `yaw` and
// `pitch` are the angles to the side, and to above or below, at which it begins to fade and has gone. 1e-4: equal ones are
// a step.
fn eyes_through_fade(view: vec3f, yaw: vec2f, pitch: vec2f) -> f32 {
    // atan2(0, 0) is left to the driver.
    let side = atan2(abs(view.x), select(1e-6, view.z, abs(view.z) > 1e-6));
    let height = asin(min(abs(view.y), 1.0));
    return (1.0 - smoothstep(yaw.x, max(yaw.y, yaw.x + 1e-4), side))
        * (1.0 - smoothstep(pitch.x, max(pitch.y, pitch.x + 1e-4), height));
}
