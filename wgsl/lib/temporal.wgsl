// Pieces of temporal antialiasing (Karis 2014; Salvi 2016 for the box of a neighbourhood).

// Light beyond white counts less in means, or single sparks would hold edges hard: up to white as it is, all beyond it up to 2.
fn pressed(color: vec4f) -> vec4f {
    let peak = max(color.r, max(color.g, color.b));
    return vec4f(color.rgb * select(1.0, (2.0 - 1.0 / max(peak, 1.0)) / max(peak, 1.0), peak > 1.0), color.a);
}

// Inverse of that.
fn unpressed(color: vec4f) -> vec4f {
    let peak = max(color.r, max(color.g, color.b));
    // 1e-4: what rounding has put at 2 stays finite.
    return vec4f(color.rgb * select(1.0, 1.0 / (max(2.0 - peak, 1e-4) * max(peak, 1.0)), peak > 1.0), color.a);
}

// Luma and two differences, in which colours of a neighbourhood lie near a line; w stays.
fn ycocg_from_rgb(c: vec4f) -> vec4f {
    return vec4f(
        dot(c.rgb, vec3f(0.25, 0.5, 0.25)), dot(c.rgb, vec3f(0.5, 0.0, -0.5)), dot(c.rgb, vec3f(-0.25, 0.5, -0.25)), c.a
    );
}

fn rgb_from_ycocg(c: vec4f) -> vec4f {
    let t = c.x - c.z;
    return vec4f(t + c.y, c.x + c.z, t - c.y, c.a);
}

// What lies outside of a box goes towards its middle until it lies on its side. 2e-3: where a channel is the same all over,
// as alpha within a shape, what rounding makes of it would draw all channels to the middle.
fn clipped_to_box(c: vec4f, middle: vec4f, half: vec4f) -> vec4f {
    let away = c - middle;
    let times = abs(away) / max(half, vec4f(2e-3));
    return middle + away / max(1.0, max(max(times.x, times.y), max(times.z, times.w)));
}

// Weights of a Catmull-Rom spline for the four texels about a place between the middle two.
fn spline_weights(t: f32) -> vec4f {
    return vec4f(
        t * (-0.5 + t * (1.0 - 0.5 * t)), 1.0 + t * t * (-2.5 + 1.5 * t), t * (0.5 + t * (2.0 - 1.5 * t)), t * t * (-0.5 + 0.5 * t)
    );
}
