// Stones that are seen into, and those that throw light back.
import package::bind::frame::frame;
import package::bind::material::{material, detail_color_texture, detail_sampler};
import package::lib::diamond::diamond_path;
import package::lib::gem::{absorbed, far_normal, fresnel, gathered, parallax};
import package::lib::studio::studio;

// Where a stone is shaded.
struct StonePoint {
    // Unit, world: to the viewer, and the frame of the surface.
    view: vec3f,
    normal: vec3f,
    tangent: vec3f,
    bitangent: vec3f,
    uv: vec2f,
    // Key light that arrives, and light from all around.
    light: vec3f,
    ambient: vec3f,
}

struct Stone {
    color: vec3f,
    // Of the debug channel: gathered or returned light, what is enclosed, what is mirrored.
    parts: vec3f,
}

fn studio_light(d: vec3f, p: StonePoint, lamps: f32, key: f32) -> vec3f {
    let seen = studio(d, frame.to_light);
    // Cold from above, violet from below.
    let around = (p.ambient + p.light * 0.25) * (vec3f(0.72, 0.9, 1.0) * seen.x + vec3f(0.42, 0.38, 0.66) * seen.y);
    return around + p.light * max(seen.z * lamps, seen.w * key);
}

fn gem_surface(p: StonePoint, has_inclusions: bool) -> Stone {
    let r = refract(-p.view, p.normal, 1.0 / material.gem_ior);
    let inside = vec3f(dot(r, p.tangent), dot(r, p.bitangent), dot(r, p.normal));
    let glow = gathered(far_normal(p.normal, r), frame.to_light, material.gem_focus);
    let around = p.ambient * 0.8 + p.light * 0.4;
    let through = (around + p.light * material.gem_caustic * glow) * absorbed(material.gem_color, inside, 1.0);
    // Scattered light comes from a little below the surface, and from around the border of light; where it has come far, it
    // is deeper in colour. Thin borders let it through.
    let wrapped = saturate(dot(p.normal, frame.to_light) * 0.6 + 0.4);
    let far = pow(max(material.gem_color, vec3f(1e-3)), vec3f(1.7 - 0.7 * wrapped));
    let thin = pow(1.0 - saturate(dot(p.normal, p.view)), 3.0);
    let milk = far * (p.light * (max(wrapped, 0.35) + 0.5 * thin) + p.ambient)
        + material.gem_color * p.light * (0.2 * material.gem_caustic * glow);
    var body = mix(through, milk, material.gem_cloudiness);
    var enclosed = 0.0;
    if has_inclusions {
        for (var i = material.gem_layers; i >= 1.0; i -= 1.0) {
            let depth = i / material.gem_layers;
            let moved = parallax(inside, depth * material.gem_depth_uv) * vec2f(1.0, -1.0);
            // Deeper layers show other parts of the picture.
            let at = p.uv + moved + vec2f(0.37, 0.61) * (i - 1.0);
            let found = textureSample(detail_color_texture, detail_sampler, at);
            let lit = p.light * (0.35 + 0.65 * wrapped + glow) + p.ambient;
            body = mix(body, found.rgb * lit * absorbed(material.gem_color, inside, depth), found.a);
            enclosed = mix(enclosed, depth, found.a);
        }
    }
    let mirrored = fresnel(saturate(dot(p.normal, p.view)), material.gem_ior) * material.gem_polish;
    let sky = studio_light(reflect(-p.view, p.normal), p, 0.0, 24.0);
    return Stone(mix(body, sky, mirrored), vec3f(glow, enclosed, mirrored));
}

fn diamond_surface(p: StonePoint) -> Stone {
    // Texture coordinates run across the stone.
    let start = vec3f(clamp((p.uv - 0.5) * vec2f(0.9, -0.9), vec2f(-0.4), vec2f(0.4)), 0.2);
    var inner = vec3f(0.0);
    for (var c = 0; c < 3; c++) {
        let r = refract(-p.view, p.normal, 1.0 / material.diamond_ior[c]);
        let inside = normalize(vec3f(dot(r, p.tangent), dot(r, p.bitangent), dot(r, p.normal)));
        let exit = diamond_path(
            start, inside, material.diamond_ior[c], material.diamond_bounces, material.diamond_facets
        );
        let d = p.tangent * exit.direction.x + p.bitangent * exit.direction.y + p.normal * exit.direction.z;
        inner[c] = studio_light(d, p, material.diamond_brilliance * 0.5, material.diamond_brilliance)[c] * exit.share;
    }
    let mirrored = fresnel(saturate(dot(p.normal, p.view)), material.diamond_ior.y);
    let sky = studio_light(reflect(-p.view, p.normal), p, material.diamond_brilliance * 0.5, material.diamond_brilliance);
    return Stone(mix(inner * material.diamond_color, sky, mirrored), vec3f(inner.y, 0.0, mirrored));
}
