// Eyes through hair: how near hair may hang, and from where it is seen.

// Clip z of a point that lies `window` metres nearer to the camera; depth is near / distance, w the distance. A tenth of
// the distance stays, so that nothing comes before the near plane.
fn pulled_depth(z: f32, w: f32, window: f32) -> f32 {
    return z * w / max(w - window, 0.1 * w);
}

// Share that is seen, by the cosine of the angle between the view and the front of the face; `fade` are the cosines at
// which it begins to fade and has gone. 1e-4: equal ones are a step.
fn eyes_through_fade(facing: f32, fade: vec2f) -> f32 {
    return smoothstep(fade.y, max(fade.x, fade.y + 1e-4), facing);
}
