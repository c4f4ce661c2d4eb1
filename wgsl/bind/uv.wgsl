// Where textures lie on a surface.

// Affine UV transform: uv' = (dot(row_u, (uv, 1)), dot(row_v, (uv, 1))); w of row_u is the UV set, 0 or 1.
struct UvTransform {
    row_u: vec4f,
    row_v: vec4f,
}

// A texel of a surface. Vertices stand far apart: there it is one of a picture 256 texels wide.
fn surface_texel(texture: texture_2d<f32>, texture_sampler: sampler, uv: vec2f) -> vec4f {
    @if(at_vertices) {
        let level = max(textureNumLevels(texture), 9u) - 9u;
        return textureSampleLevel(texture, texture_sampler, uv, f32(level));
    }
    @if(!at_vertices) return textureSample(texture, texture_sampler, uv);
}

// UVs of one texture: animation first, then KHR_texture_transform (MToon, "Compatibility with KHR_texture_transform").
fn texture_uv(uv: vec4f, transform: UvTransform) -> vec2f {
    @if(!uv_transforms) return uv.xy;
    @if(uv_transforms) let p = vec3f(select(uv.xy, uv.zw, transform.row_u.w > 0.5), 1.0);
    @if(uv_transforms) return vec2f(dot(transform.row_u.xyz, p), dot(transform.row_v.xyz, p));
}
