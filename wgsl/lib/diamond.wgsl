// The way of a ray through a round brilliant that stands at the origin with its table towards +z.
import package::lib::gem::fresnel;

// Sines and cosines of the tilt of crown and pavilion (Tolkowsky 1919: 34.5 and 40.75 degrees), and distances of table,
// crown and pavilion from the middle, in radii.
const CROWN: vec2f = vec2f(0.5664, 0.8241);
const PAVILION: vec2f = vec2f(0.6528, 0.7576);
const TABLE_AWAY: f32 = 0.3;
const CROWN_AWAY: f32 = 0.55;
const PAVILION_AWAY: f32 = 0.5;

// Plane that a ray from p along d meets first: its outward normal, and how far away.
fn facet_ahead(p: vec3f, d: vec3f, facets: f32) -> vec4f {
    var nearest = vec4f(0.0, 0.0, 1.0, select(1e9, (TABLE_AWAY - p.z) / max(d.z, 1e-6), d.z > 1e-6));
    let step = 6.2831853 / facets;
    for (var i = 0.0; i < facets; i += 1.0) {
        let side = vec2f(cos(i * step), sin(i * step));
        // Pavilion facets stand between those of the crown.
        let below = vec2f(cos((i + 0.5) * step), sin((i + 0.5) * step));
        let crown = vec3f(side * CROWN.x, CROWN.y);
        let pavilion = vec3f(below * PAVILION.x, -PAVILION.y);
        let towards = vec2f(dot(crown, d), dot(pavilion, d));
        let away = vec2f(CROWN_AWAY - dot(crown, p), PAVILION_AWAY - dot(pavilion, p));
        let t = select(vec2f(1e9), away / max(towards, vec2f(1e-6)), towards > vec2f(1e-6));
        if t.x < nearest.w {
            nearest = vec4f(crown, t.x);
        }
        if t.y < nearest.w {
            nearest = vec4f(pavilion, t.y);
        }
    }
    return nearest;
}

struct Exit {
    // Where it leaves to, unit.
    direction: vec3f,
    // Share of light that came through.
    share: f32,
}

// Follows a ray that is inside; after `bounces` reflections it is let out in the direction that it has.
fn diamond_path(start: vec3f, into: vec3f, ior: f32, bounces: u32, facets: f32) -> Exit {
    var p = start;
    var d = into;
    var share = 1.0;
    for (var i = 0u; i < bounces; i++) {
        let facet = facet_ahead(p, d, facets);
        let n = facet.xyz;
        p += d * max(facet.w, 0.0);
        // From inside the index is 1 / ior: past the critical angle nothing goes through.
        let mirrored = fresnel(saturate(dot(d, n)), 1.0 / ior);
        if mirrored < 0.5 {
            return Exit(normalize(refract(d, -n, ior)), share * (1.0 - mirrored));
        }
        share *= mirrored;
        d = reflect(d, -n);
    }
    return Exit(d, share);
}
