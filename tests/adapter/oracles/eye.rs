//! A refractive eye: the cornea's refraction, pupil, limbus, light on the iris.

use glam::{DVec2, DVec3};

use super::{assert_close, cases, numbers, run, vectors};

/// Measures of the vectors, mm: centre and radius of the cornea, plane of limbus and iris, their radius; index.
const CENTRE_Z: f64 = 5.347_441_489;
const RADIUS: f64 = 7.8;
const LIMBUS_Z: f64 = 10.449_401_897;
const IRIS_Z: f64 = 9.949_401_897;
const IRIS_RADIUS: f64 = 5.9;
const IOR: f64 = 1.376;

#[test]
fn view_rays_follow_their_vectors() {
    let file = vectors("eye.json");
    let list = cases(&file, "refraction");
    let rows: Vec<Vec<f32>> = list.iter().map(|c| numbers(c, &["position", "normal", "V", "z_iris", "ior"])).collect();
    let body = "
        let p = input3(base); let n = input3(base + 3u); let v = input3(base + 6u);
        let iris_z = input[base + 9u]; let ior = input[base + 10u];
        let radius = length(p.xy) / length(n.xy);
        let ray = cornea_refraction(v, n, ior);
        let hit = iris_place(p, ray, iris_z);
        let straight = iris_place(p, cornea_refraction(v, n, 1.0), iris_z);
        write3(out, ray);
        write3(out + 3u, vec3f(hit, length(iris_disc(hit, 5.9))));
        write3(out + 6u, vec3f(straight, 0.0));
        // A place of the mesh below or above the cornea on the same ray.
        write3(out + 9u, cornea_normal(p - 0.4 * v, v, p.z - radius * n.z, radius));
        write3(out + 12u, cornea_normal(p + 0.8 * v, v, p.z - radius * n.z, radius));";
    for (i, (case, found)) in list.iter().zip(run(&["noise", "eye"], body, &rows, 15)).enumerate() {
        assert_close("refracted", i, &found[..3], &numbers(case, &["refracted"]), 2e-6);
        assert_close("place, mm", i, &found[3..5], &numbers(case, &["hit"])[..2], 1e-4);
        assert_close("rho", i, &found[5..6], &numbers(case, &["rho"]), 2e-5);
        let normal = numbers(case, &["normal"]);
        assert_close("normal from below", i, &found[9..12], &normal, 1e-4);
        assert_close("normal from above", i, &found[12..], &normal, 1e-4);
        // Flatter rays are bounded.
        if rows[i][8] >= 0.2 {
            assert_close("straight, mm", i, &found[6..8], &numbers(case, &["straight_hit"])[..2], 1e-4);
        }
    }
}

#[test]
fn pupils_follow_their_vectors() {
    let file = vectors("eye.json");
    let list = cases(&file, "pupil");
    let rows: Vec<Vec<f32>> = list.iter().map(|c| numbers(c, &["rho", "pupil_tex", "pupil_now"])).collect();
    let body = "
        let rho = input[base]; let drawn = input[base + 1u]; let now = input[base + 2u];
        output[out] = pupil_scaled(rho, drawn, now);
        output[out + 1u] = length(pupil_place(rho * vec2f(0.6, -0.8), drawn, now));";
    for (i, (case, found)) in list.iter().zip(run(&["noise", "eye"], body, &rows, 2)).enumerate() {
        let expected = numbers(case, &["rho_tex"])[0];
        assert_close("pupil", i, &found, &[expected; 2], 1e-6);
    }
}

#[test]
fn the_limbus_follows_its_vectors() {
    let file = vectors("eye.json");
    let list = cases(&file, "limbus");
    let rows: Vec<Vec<f32>> = list.iter().map(|c| numbers(c, &["rho", "width", "dark"])).collect();
    let body = "output[out] = limbus_shade(input[base], input[base + 1u], input[base + 2u]);";
    for (i, (case, found)) in list.iter().zip(run(&["noise", "eye"], body, &rows, 1)).enumerate() {
        assert_close("limbus", i, &found, &numbers(case, &["value"]), 1e-5);
    }
}

#[test]
fn slopes_of_light_follow_their_vectors() {
    let file = vectors("eye.json");
    let list = cases(&file, "caustic");
    let rows: Vec<Vec<f32>> = list.iter().map(|c| numbers(c, &["L", "q", "k"])).collect();
    let body = "
        let light = -cornea_refraction(input3(base), vec3f(0.0, 0.0, 1.0), 1.376);
        write3(out, light);
        output[out + 3u] = caustic_slope(vec2f(input[base + 3u], input[base + 4u]), light.xy, input[base + 5u]);";
    for (i, (case, found)) in list.iter().zip(run(&["noise", "eye"], body, &rows, 4)).enumerate() {
        assert_close("refracted light", i, &found[..3], &numbers(case, &["l_in"]), 2e-6);
        assert_close("slope of light", i, &found[3..], &numbers(case, &["value"]), 2e-6);
    }
}

/// Directions over the sphere, or half of it.
fn directions(count: usize, least_z: f64) -> Vec<DVec3> {
    (0..count)
        .map(|i| {
            let z = least_z + (1.0 - least_z) * (i as f64 + 0.5) / count as f64;
            let (y, x) = (2.399_963 * i as f64).sin_cos();
            let r = (1.0 - z * z).sqrt();
            DVec3::new(r * x, r * y, z)
        })
        .collect()
}

fn floats(v: &[f64]) -> Vec<f32> {
    v.iter().map(|x| *x as f32).collect()
}

/// The part along the surface is divided by the index, at any index and any view; an index of 1, or less, changes nothing.
#[test]
fn refraction_is_snells() {
    let mut rows = Vec::new();
    for n in directions(20, -1.0) {
        for v in directions(60, -1.0).into_iter().filter(|v| v.dot(n) >= 0.0) {
            for ior in [0.5, 1.0, 1.336, 1.376, 2.5] {
                rows.push(floats(&[n.x, n.y, n.z, v.x, v.y, v.z, ior]));
            }
        }
    }
    let body = "
        let n = input3(base); let v = input3(base + 3u);
        let d = cornea_refraction(v, n, input[base + 6u]);
        write3(out, cross(n, d) * max(input[base + 6u], 1.0) + cross(n, v));
        write3(out + 3u, vec3f(length(d) - 1.0, max(dot(n, d), 0.0), select(0.0, length(d + v), input[base + 6u] <= 1.0)));";
    for (i, found) in run(&["noise", "eye"], body, &rows, 6).iter().enumerate() {
        assert_close("Snell's law, length, side, straight", i, found, &[0.0; 6], 3e-6);
    }
}

/// From the front an iris shows 1.11 to 1.13 times as large as it is, with an index of 1 as large as it is.
#[test]
fn a_cornea_magnifies() {
    let rows: Vec<Vec<f32>> = [0.05, 0.5, 1.0, 2.0].map(|x| vec![x as f32]).into();
    let body = format!(
        "let v = vec3f(0.0, 0.0, 1.0);
         let n = cornea_normal(vec3f(input[base], 0.0, 12.0), v, {CENTRE_Z}, {RADIUS});
         let p = vec3f(0.0, 0.0, {CENTRE_Z}) + {RADIUS} * n;
         output[out] = input[base] / iris_place(p, cornea_refraction(v, n, {IOR}), {IRIS_Z}).x;
         output[out + 1u] = input[base] / iris_place(p, cornea_refraction(v, n, 1.0), {IRIS_Z}).x;"
    );
    for (row, found) in rows.iter().zip(run(&["noise", "eye"], &body, &rows, 2)) {
        println!("{} mm from the axis: {}", row[0], found[0]);
        assert!((1.11..=1.13).contains(&found[0]) && (found[1] - 1.0).abs() < 1e-5, "{row:?}: {found:?}");
    }
}

/// Centre and limbus stay, the drawn edge comes to the new one, and nothing folds over; the direction is kept.
#[test]
fn pupils_scale_and_the_limbus_stays() {
    for drawn in [0.0f32, 0.2, 0.35, 0.9, 1.0] {
        for now in [0.0f32, 0.085, 0.3, 0.68, 1.0] {
            let rows: Vec<Vec<f32>> = (0..=400).map(|i| vec![i as f32 / 400.0, drawn, now]).collect();
            let body = "
                output[out] = pupil_scaled(input[base], input[base + 1u], input[base + 2u]);
                output[out + 1u] = pupil_scaled(input[base + 2u], input[base + 1u], input[base + 2u]);
                let q = pupil_place(vec2f(0.6, -0.8) * input[base], input[base + 1u], input[base + 2u]);
                output[out + 2u] = dot(q, vec2f(0.8, 0.6));";
            let found = run(&["noise", "eye"], body, &rows, 3);
            assert!(found.windows(2).all(|w| w[0][0] <= w[1][0]), "{drawn} {now}");
            assert!(found[0][0] == 0.0 && (found[400][0] - 1.0).abs() < 1e-6, "{drawn} {now}: {:?}", found[400]);
            assert!(found.iter().all(|f| f[2].abs() < 1e-6));
            if (0.01..=0.99).contains(&now) {
                assert!((found[0][1] - drawn).abs() < 1e-6, "{drawn} {now}: {:?}", found[0]);
            }
        }
    }
}

/// The slope of light takes none from the whole, and is brighter opposite the light.
#[test]
fn slopes_of_light_have_mean_one() {
    let rows: Vec<Vec<f32>> = directions(12, 0.05).iter().map(|l| floats(&l.to_array())).collect();
    let body = "
        let light = -cornea_refraction(input3(base), vec3f(0.0, 0.0, 1.0), 1.376).xy;
        var sum = 0.0;
        for (var i = 0; i < 64; i++) {
            for (var j = 0; j < 64; j++) {
                let angle = (f32(j) + 0.5) * 0.09817477;
                sum += caustic_slope(sqrt((f32(i) + 0.5) / 64.0) * vec2f(cos(angle), sin(angle)), light, 1.2);
            }
        }
        output[out] = sum / 4096.0;
        output[out + 1u] = caustic_slope(-normalize(light), light, 1.2);
        output[out + 2u] = caustic_slope(normalize(light), light, 1.2);";
    for (row, found) in rows.iter().zip(run(&["noise", "eye"], body, &rows, 3)) {
        assert!((found[0] - 1.0).abs() < 1e-4 && found[1] > 1.0 && found[2] < 1.0, "{row:?}: {found:?}");
    }
}

/// Irradiance of the iris in a grid of cells as rays bring it, each refracted on its own: light towards +x, `degrees` from the axis.
fn traced(degrees: f64, cells: usize) -> Vec<f64> {
    let (x, z) = degrees.to_radians().sin_cos();
    let light = DVec3::new(x, 0.0, z);
    let (side, up) = (DVec3::new(z, 0.0, -x), DVec3::Y);
    let mut sums = vec![0.0; cells * cells];
    let cell = 2.0 * IRIS_RADIUS / cells as f64;
    let steps = 1200;
    let step = 2.0 / f64::from(steps);
    for i in 0..steps * steps {
        let at = DVec2::new(f64::from(i % steps) + 0.5, f64::from(i / steps) + 0.5) * step - 1.0;
        let height = 1.0 - at.length_squared();
        if height <= 0.0 {
            continue;
        }
        let normal = side * at.x + up * at.y + light * height.sqrt();
        let entry = DVec3::Z * CENTRE_Z + RADIUS * normal;
        if entry.z < LIMBUS_Z {
            continue;
        }
        let ray = (-light).refract(normal, 1.0 / IOR);
        let (c, t) = (height.sqrt(), -ray.dot(normal));
        let across = (c - IOR * t) / (c + IOR * t);
        let within = (IOR * c - t) / (IOR * c + t);
        let place = entry + ray * ((IRIS_Z - entry.z) / ray.z);
        let index = ((place.truncate() + IRIS_RADIUS) / cell).floor();
        if ray.z < 0.0 && index.min_element() >= 0.0 && index.max_element() < cells as f64 {
            let share = 1.0 - 0.5 * (across * across + within * within);
            sums[index.y as usize * cells + index.x as usize] += share * (step * RADIUS / cell).powi(2);
        }
    }
    sums
}

/// Light on the iris is what rays bring that are traced one by one, wherever the light is.
#[test]
fn light_on_the_iris_is_what_rays_bring() {
    const CELLS: usize = 24;
    for degrees in [0.0f64, 30.0, 60.0, 75.0] {
        let (x, z) = degrees.to_radians().sin_cos();
        let cell = 2.0 * IRIS_RADIUS / CELLS as f64;
        let corner = |i: usize| DVec2::new((i % CELLS) as f64, (i / CELLS) as f64) * cell - IRIS_RADIUS;
        let rows: Vec<Vec<f32>> =
            (0..CELLS * CELLS).map(|i| floats(&[corner(i).x, corner(i).y, x, 0.0, z, cell])).collect();
        let body = format!(
            "var sum = 0.0;
             for (var i = 0; i < 64; i++) {{
                 let at = (vec2f(f32(i % 8), f32(i / 8)) + 0.5) / 8.0 * input[base + 5u];
                 let place = vec3f(vec2f(input[base], input[base + 1u]) + at, {IRIS_Z});
                 sum += iris_irradiance(place, input3(base + 2u), {CENTRE_Z}, {RADIUS}, {LIMBUS_Z}, {IOR});
             }}
             output[out] = sum / 64.0;"
        );
        let found = run(&["noise", "eye"], &body, &rows, 1);
        let whole = |i: &usize| (corner(*i) + 0.5 * cell).length() + 0.71 * cell < IRIS_RADIUS;
        let traced = traced(degrees, CELLS);
        let pairs: Vec<[f64; 2]> =
            (0..CELLS * CELLS).filter(whole).map(|i| [f64::from(found[i][0]), traced[i]]).collect();
        let n = pairs.len() as f64;
        let mean = [0, 1].map(|k| pairs.iter().map(|p| p[k]).sum::<f64>() / n);
        let product = |a: usize, b: usize| pairs.iter().map(|p| (p[a] - mean[a]) * (p[b] - mean[b])).sum::<f64>();
        let correlation = product(0, 1) / (product(0, 0) * product(1, 1)).sqrt();
        let off = pairs.iter().map(|p| (p[0] - p[1]).abs()).sum::<f64>() / n;
        println!(
            "{degrees} degrees: mean {:.4} of {:.4}, off {off:.4}, correlation {correlation:.4}",
            mean[0], mean[1]
        );
        assert!((mean[0] / mean[1] - 1.0).abs() < 0.01, "{degrees}: {mean:?}");
        assert!(off < 0.01 && correlation > 0.98, "{degrees}: off {off}, correlation {correlation}");
    }
}

/// A hollow iris faces inward, more so towards its rim; no hollow, no turn.
#[test]
fn a_hollow_iris_faces_its_axis() {
    let rows: Vec<Vec<f32>> = [0.0f32, 0.3, 1.0, -1.0].map(|hollow| vec![hollow]).into();
    let body = "
        let near = iris_normal(vec2f(0.3, -0.4), input[base]);
        let rim = iris_normal(vec2f(0.6, -0.8), input[base]);
        output[out] = dot(near.xy, vec2f(-0.6, 0.8)) / near.z;
        output[out + 1u] = dot(rim.xy, vec2f(-0.6, 0.8)) / rim.z;
        output[out + 2u] = max(abs(length(near) - 1.0), abs(length(rim) - 1.0));
        output[out + 3u] = iris_normal(vec2f(0.0), input[base]).z;";
    for (i, (row, found)) in rows.iter().zip(run(&["noise", "eye"], body, &rows, 4)).enumerate() {
        let slope = row[0].max(0.0);
        assert_close("slope of the iris", i, &found, &[0.5 * slope, slope, 0.0, 1.0], 1e-6);
    }
}

/// Nothing breaks at the pupil's centre, at grazing views and beyond, from behind, nor with senseless measures.
#[test]
fn eyes_are_finite_everywhere() {
    let mut rows = Vec::new();
    for place in [[0.0; 3], [0.0, 0.0, CENTRE_Z], [0.0, 0.0, 13.147], [5.9, 0.0, LIMBUS_Z], [0.0, -12.0, 0.0], [1e3; 3]]
    {
        for v in directions(40, -1.0).into_iter().chain([DVec3::Z, DVec3::NEG_Z, DVec3::X]) {
            for [radius, ior, number] in [[7.8, 1.376, 0.0], [7.8, 0.0, 1.0], [0.0, 3.0, -1.0], [-1.0, 1.0, 1e6]] {
                rows.push(floats(&[&place[..], &v.to_array(), &[radius, ior, number]].concat()));
            }
        }
    }
    let body = "
        let p = input3(base); let v = input3(base + 3u);
        let radius = input[base + 6u]; let ior = input[base + 7u]; let x = input[base + 8u];
        let n = cornea_normal(p, v, 5.3474, radius);
        let d = cornea_refraction(v, n, ior);
        let q = iris_disc(iris_place(p, d, 9.9494), radius);
        let t = pupil_place(q, x, 0.3 * x);
        write3(out, n);
        write3(out + 3u, d);
        write3(out + 6u, vec3f(q, pupil_scaled(x, x, x)));
        write3(out + 9u, vec3f(t, limbus_shade(x, x, x)));
        write3(out + 12u, iris_normal(q, x));
        write3(out + 15u, vec3f(caustic_slope(q, d.xy, x), iris_irradiance(p, v, 5.3474, radius, 10.4494, ior), 0.0));";
    for (row, found) in rows.iter().zip(run(&["noise", "eye"], body, &rows, 18)) {
        assert!(found.iter().all(|f| f.is_finite()), "{row:?}: {found:?}");
        let length = |v: &[f32]| v.iter().map(|x| x * x).sum::<f32>().sqrt();
        assert!(length(&found[6..8]) < 1.0 + 1e-5 && length(&found[9..11]) < 1.0 + 1e-5, "{row:?}: {found:?}");
        assert!([11, 15, 16].iter().all(|i| found[*i] >= 0.0), "{row:?}: {found:?}");
        assert!((length(&found[..3]) - 1.0).abs() < 1e-4 && (length(&found[3..6]) - 1.0).abs() < 1e-4, "{row:?}");
    }
}
