// Where textures lie on a surface.

// Affine UV transform: uv' = (dot(row_u, (uv, 1)), dot(row_v, (uv, 1))); w of row_u is the UV set, 0 or 1.
struct UvTransform {
    row_u: vec4f,
    row_v: vec4f,
}

// UVs of one texture: animation first, then KHR_texture_transform (MToon, "Compatibility with KHR_texture_transform").
fn texture_uv(uv: vec4f, transform: UvTransform) -> vec2f {
    @if(!uv_transforms) return uv.xy;
    @if(uv_transforms) let p = vec3f(select(uv.xy, uv.zw, transform.row_u.w > 0.5), 1.0);
    @if(uv_transforms) return vec2f(dot(transform.row_u.xyz, p), dot(transform.row_v.xyz, p));
}
