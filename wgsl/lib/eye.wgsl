// An eye behind its cornea: Snell's law into the plane of the iris, the pupil, the limbus, light on the iris. Space of the eye:
// origin at the centre of the ball, +z out of the pupil, mm of a human eye. Vectors are unit and point away from the surface.
import package::lib::noise::value_noise;

// Normal of the cornea's sphere (centre on the axis) where the view ray through a place of the mesh enters it; the place itself is
// the centre plus radius times that. A ray that misses the sphere has its nearest point.
fn cornea_normal(place: vec3f, view: vec3f, centre_z: f32, radius: f32) -> vec3f {
    let r = max(radius, 1e-3);
    let off = place - vec3f(0.0, 0.0, centre_z);
    let along = dot(off, view);
    let nearest = off - along * view;
    let inside = sqrt(max(r * r - dot(nearest, nearest), 0.0));
    return normalize(nearest + inside * view);
}

// Direction into the eye of the ray seen from `view`, unit; an index of 1 leaves it straight. Also finite where the normal is
// turned away.
fn cornea_refraction(view: vec3f, normal: vec3f, ior: f32) -> vec3f {
    let eta = 1.0 / max(ior, 1.0);
    let c = eta * dot(normal, view);
    // As 1 less a sine it would lose its digits at grazing views.
    return (c - sqrt((1.0 - eta) * (1.0 + eta) + c * c)) * normal - eta * view;
}

// Least slope of a ray towards the plane of the iris: flatter ones would meet it anywhere.
const LEAST_IRIS_SLOPE: f32 = 0.2;

// Where a ray from the cornea meets the plane of the iris, mm; negative z is into the eye.
fn iris_place(entry: vec3f, ray: vec3f, iris_z: f32) -> vec2f {
    let way = (entry.z - iris_z) / max(-ray.z, LEAST_IRIS_SLOPE);
    return entry.xy + way * ray.xy;
}

// A place of the iris plane in the unit disc of the iris; what lies outside is its rim.
fn iris_disc(place: vec2f, iris_radius: f32) -> vec2f {
    let q = place / max(iris_radius, 1e-3);
    return q / max(length(q), 1.0);
}

// Radius in a texture whose pupil was drawn with one radius and now has another; all are shares of the iris' radius. Grows with
// rho; centre and limbus stay.
fn pupil_scaled(rho: f32, drawn: f32, now: f32) -> f32 {
    let edge = clamp(drawn, 0.0, 1.0);
    let n = clamp(now, 1e-3, 0.999);
    let r = saturate(rho);
    return select(1.0 - (1.0 - r) * (1.0 - edge) / (1.0 - n), r * edge / n, r < n);
}

// The same of a place in the unit disc.
fn pupil_place(q: vec2f, drawn: f32, now: f32) -> vec2f {
    let rho = length(q);
    return q * (pupil_scaled(rho, drawn, now) / max(rho, 1e-6));
}

// What colour is multiplied by near the limbus: `dark` at rho = 1, 1 from `width` on to either side.
fn limbus_shade(rho: f32, width: f32, dark: f32) -> f32 {
    return mix(saturate(dark), 1.0, smoothstep(0.0, max(width, 1e-4), abs(rho - 1.0)));
}

// Normal of a hollow iris at a place of its unit disc; `hollow` is its slope at the rim.
fn iris_normal(q: vec2f, hollow: f32) -> vec3f {
    return normalize(vec3f(-q * max(hollow, 0.0), 1.0));
}

// Light over the iris as painters have it: a slope, brightest opposite the light, with mean 1. `light` is the refracted direction
// to the light in the plane.
fn caustic_slope(q: vec2f, light: vec2f, strength: f32) -> f32 {
    return max(1.0 - max(strength, 0.0) * dot(q, light), 0.0);
}

// Half of the width over which the sclera's shadow begins, mm.
const LIMBUS_SOFTNESS: f32 = 0.1;
// Rays that miss the place by more are none, mm: no light gets there.
const MOST_MISS: f32 = 0.2;

// Irradiance of the iris by a parallel light through the cornea, where 1 is that of the light straight on: Snell, Fresnel, how rays
// gather, and the sclera's shadow. The beam is symmetric about the line through the cornea's centre, so that one number is
// sought: the distance of the ray from that line.
fn iris_irradiance(place: vec3f, to_light: vec3f, centre_z: f32, radius: f32, limbus_z: f32, ior: f32) -> f32 {
    let r = max(radius, 1e-3);
    let n = max(ior, 1.0);
    let off = (place - vec3f(0.0, 0.0, centre_z)) / r;
    let along = dot(off, to_light);
    let aside = off - along * to_light;
    let distance = length(aside);
    let outward = aside / max(distance, 1e-6);
    var ray = cornea_ray(min(distance, MOST_ASIDE), along, n);
    for (var i = 0; i < 4; i++) {
        // Newton's.
        let aim = ray.x - (ray.x * ray.share - distance) / ray.spread;
        ray = cornea_ray(clamp(aim, 0.0, MOST_ASIDE), along, n);
    }
    let miss = abs(ray.x * ray.share - distance) * r;
    let entry_z = centre_z + r * (ray.x * outward.z + ray.c * to_light.z);
    let lit_share = smoothstep(-LIMBUS_SOFTNESS, LIMBUS_SOFTNESS, entry_z - limbus_z) * saturate(1.0 - miss / MOST_MISS);
    let down = ray.bent.x * to_light.z + ray.bent.y * outward.z;
    return lit_share * ray.transmitted * max(down, 0.0) / (ray.bent.x * ray.share * ray.spread);
}

// Farthest that rays may enter from the line through the cornea's centre, shares of its radius: beyond, next to nothing enters.
const MOST_ASIDE: f32 = 0.995;

struct CorneaRay {
    // Distance from the line at which it enters, shares of the radius.
    x: f32,
    // Cosine there.
    c: f32,
    // Cosine and sine of how far it is bent.
    bent: vec2f,
    // Its distance from the line over x, at the height of the iris, and the derivative of that distance.
    share: f32,
    spread: f32,
    // Share of unpolarised light that enters (Fresnel).
    transmitted: f32,
}

// A ray parallel to a line through the centre of a unit sphere, at the height `along` that line.
fn cornea_ray(x: f32, along: f32, ior: f32) -> CorneaRay {
    let c = sqrt((1.0 - x) * (1.0 + x));
    let sine = x / ior;
    let cosine = sqrt((1.0 - sine) * (1.0 + sine));
    let bent = vec2f(c * cosine + x * sine, x * cosine - c * sine);
    let fall = (c - along) / bent.x;
    let share = 1.0 - fall * (cosine - c / ior);
    let spread = 1.0 + x * bent.y / (c * bent.x) - fall / bent.x * (1.0 / c - 1.0 / (ior * cosine));
    let across = (c - ior * cosine) / (c + ior * cosine);
    let within = (ior * c - cosine) / (ior * c + cosine);
    let transmitted = 1.0 - 0.5 * (across * across + within * within);
    // Where rays cross, the bounds keep light finite.
    return CorneaRay(x, c, bent, max(share, 0.1), max(spread, 0.1), transmitted);
}

// Where the view ray through a place of the mesh enters the cornea's sphere, mm, and whether it does: of a ray that misses, the
// nearest place of the sphere.
fn cornea_entry(place: vec3f, view: vec3f, centre_z: f32, radius: f32) -> vec4f {
    let normal = cornea_normal(place, view, centre_z, radius);
    let off = place - vec3f(0.0, 0.0, centre_z);
    let nearest = off - dot(off, view) * view;
    // Over a tenth of a millimetre.
    let hit = saturate((radius - length(nearest)) * 10.0 + 0.5);
    return vec4f(vec3f(0.0, 0.0, centre_z) + radius * normal, hit);
}

// Edge of a lid, a parabola over longitude, at a direction from the middle of the ball.
fn lid_edge(lid: vec3f, longitude: f32) -> f32 {
    return lid.x + longitude * (lid.y + longitude * lid.z);
}

// What lids and lashes leave of light on a place of the ball, whose direction is given by the axes of the face; numbers of the lids
// as the upload found them, radians.
fn lid_shade(place: vec3f, upper: vec3f, lower: vec3f, reach: f32, lids: f32, lashes: f32) -> f32 {
    let d = normalize(place);
    let longitude = atan2(d.x, max(d.z, 1e-3));
    let elevation = asin(clamp(d.y, -1.0, 1.0));
    let below = lid_edge(upper, longitude) - elevation;
    let above = elevation - lid_edge(lower, longitude);
    let of_upper = 1.0 - lids * (1.0 - smoothstep(0.0, reach, below));
    let of_lower = 1.0 - 0.5 * lids * (1.0 - smoothstep(0.0, 0.6 * reach, above));
    // Lashes stand before the lid: their shade ends where its own is half gone.
    let of_lashes = 1.0 - lashes * (1.0 - smoothstep(0.2 * reach, 0.65 * reach, below));
    return of_upper * of_lower * of_lashes;
}

// Share of the wet line along the lower lid.
fn wet_line(place: vec3f, lower: vec3f, width: f32) -> f32 {
    let d = normalize(place);
    let above = asin(clamp(d.y, -1.0, 1.0)) - lid_edge(lower, atan2(d.x, max(d.z, 1e-3)));
    return (1.0 - smoothstep(0.35, 1.0, above / max(width, 1e-4))) * f32(width > 0.0);
}

// Share of veins at a place of the white; `rho` is its distance from the axis in radii of the limbus. They run from the corners to
// the iris and thin out before it.
fn sclera_veins(place: vec3f, rho: f32) -> f32 {
    let turn = atan2(place.y, place.x) / 6.28318531;
    let way = length(place.xy) * 0.35;
    let bend = value_noise(vec2f(turn * 14.0, way * 1.7), vec2i(14, 64), 3) - 0.5;
    var sum = 0.0;
    for (var i = 0; i < 2; i++) {
        let fine = f32(1 + i);
        let lines = 24.0 * fine;
        let noise = value_noise(vec2f((turn + 0.03 * bend) * lines, way * fine), vec2i(i32(lines), 64), i);
        let width = 0.08 * fine;
        sum += smoothstep(1.0 - width, 1.0, 1.0 - abs(2.0 * noise - 1.0)) / fine;
    }
    let corner = abs(place.x) / max(length(place.xy), 1e-3);
    let far = smoothstep(1.1, 2.0, rho);
    return saturate(saturate(sum) * far * (0.3 + 0.7 * corner) + 0.25 * far * far * corner);
}

// Share of a painted light at a place of the cornea, mm from its centre, eye space. `axes` are those of the eye and `screen` those of
// the view (right, up, to the viewer) in the world; `radii` of cornea and iris; `shape` is round, follow and within.
fn catch_light(
    entry: vec3f, axes: mat3x3f, screen: mat3x3f, to_light: vec3f, radii: vec2f, half_size: vec2f, from_rad: vec2f, shape: vec3f
) -> f32 {
    let c = cos(from_rad);
    let s = sin(from_rad);
    let from_view = screen * vec3f(s.x * c.y, s.y, c.x * c.y);
    let from_here = normalize(mix(from_view, to_light, shape.y) + screen[2] * 1e-3);
    let h = normalize(screen[2] + from_here) * axes;
    // Where the cornea would mirror it, within its bound.
    var middle = h.xy * radii.x / radii.y;
    middle *= min(1.0, shape.z / max(length(middle), 1e-4));
    let flat = middle * radii.y;
    let on = vec3f(flat, sqrt(max(radii.x * radii.x - dot(flat, flat), 0.0)));
    let away = (axes * (entry - on)) * screen;
    // From far aside it would hide the iris, which is narrow there.
    let aside = mix(0.5, 1.0, smoothstep(0.2, 0.7, dot(axes[2], screen[2])));
    let share = abs(away.xy) / (max(half_size * aside, vec2f(1e-3)) * radii.y);
    let power = mix(6.0, 2.0, shape.x);
    let round = pow(pow(max(share.x, 1e-4), power) + pow(max(share.y, 1e-4), power), 1.0 / power);
    let edge = clamp(fwidth(round), 0.02, 0.5);
    return (1.0 - smoothstep(1.0 - edge, 1.0 + edge, round)) * smoothstep(0.0, 0.2, h.z);
}

// Where a ray from a place of the unit disc into the eye meets a bowl that is `depth` deep in the middle and has its rim there; what
// lies outside stays, and so does the rim where a view would look over it at the far wall. Unit: the disc's radius.
fn bowl_place(q: vec2f, ray: vec3f, depth: f32) -> vec2f {
    let slope = ray.xy / max(-ray.z, LEAST_IRIS_SLOPE);
    // |q + slope d|² = 1 - d / depth.
    let a = dot(slope, slope);
    let b = max(2.0 * dot(q, slope) + 1.0 / max(depth, 1e-4), 0.0);
    let c = max(1.0 - dot(q, q), 0.0);
    return q + slope * (2.0 * c / (b + sqrt(max(b * b + 4.0 * a * c, 1e-12))));
}
