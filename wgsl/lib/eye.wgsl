// An eye behind its cornea: Snell's law into the plane of the iris, the pupil, the limbus, light on the iris. Space of the eye:
// origin at the centre of the ball, +z out of the pupil, mm of a human eye. Vectors are unit and point away from the surface.

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
