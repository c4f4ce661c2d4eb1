// Blush and lines drawn over a face.

// What its colour is multiplied by. `paint`: blush, lines in shade, line of the nose. `shade` is the share of shade, `nose`
// how far the line of the nose shows.
fn face_paint_factor(
    paint: vec3f, shade: f32, nose: f32, blush_color: vec3f, blush_strength: f32, line_color: vec3f, line_strength: f32
) -> vec3f {
    let line = saturate(paint.y * shade * line_strength + paint.z * nose);
    return mix(vec3f(1.0), blush_color, paint.x * blush_strength) * mix(vec3f(1.0), line_color, line);
}
