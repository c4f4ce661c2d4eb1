//! Which triangles belong together: surfaces that hang together by their edges.

use std::collections::{BTreeMap, HashMap};

use crate::sets::Sets;

/// Share of the border of a patch along which it meets another one to be the same strip, as the two sides of a lock do. Cards
/// that touch with one side, or at their roots, share less.
const SEAM: f32 = 0.6;

/// Share of the area in texture coordinates that two patches have in common from which on they show the same picture twice, as
/// cards do that lie side by side.
const SAME_PICTURE: f32 = 0.5;

/// The patch of each triangle, numbered in the order of the triangles, and how many there are. `triangles` are indices;
/// `places` says which of them stand at the same place.
pub(super) fn patches(
    triangles: &[[u32; 3]],
    places: &[u32],
    positions: &[[f32; 3]],
    uvs: Option<&[[f32; 2]]>,
) -> (Vec<u32>, usize) {
    let edges = edges(triangles, places, uvs);
    let mut islands = Sets::new(triangles.len());
    // Sides of one edge that have the same texture coordinates are one surface, however many meet there.
    for pair in edges.values().flat_map(|sides| sides.windows(2)) {
        if pair[0].uv == pair[1].uv {
            islands.join(pair[0].triangle, pair[1].triangle);
        }
    }
    let mut all = islands.clone();
    for [a, b] in seams(&edges, &mut islands, triangles, positions, uvs) {
        all.join(a, b);
    }
    let (of, count) = all.numbered();
    (of.into_iter().map(|n| n as u32).collect(), count)
}

/// One triangle's side of an edge.
struct Side {
    triangle: usize,
    /// Texture coordinates of its ends, in the order of their places.
    uv: [[u32; 2]; 2],
    /// Which way it runs.
    forward: bool,
    ends: [u32; 2],
}

/// Edges by the places of their ends, each with its sides by their texture coordinates.
type Edges = BTreeMap<[u32; 2], Vec<Side>>;

fn edges(triangles: &[[u32; 3]], places: &[u32], uvs: Option<&[[f32; 2]]>) -> Edges {
    let uv = |v: u32| uvs.and_then(|uvs| uvs.get(v as usize)).map_or([0; 2], |uv| uv.map(|x| (x + 0.0).to_bits()));
    let mut edges = Edges::new();
    for (triangle, corners) in triangles.iter().enumerate() {
        for (a, b) in [(0, 1), (1, 2), (2, 0)] {
            let (a, b) = (corners[a], corners[b]);
            let (p, q) = (places[a as usize], places[b as usize]);
            if p == q {
                continue;
            }
            let forward = p < q;
            let (ends, low, high) = if forward { ([p, q], a, b) } else { ([q, p], b, a) };
            let side = Side { triangle, uv: [uv(low), uv(high)], forward, ends: [low, high] };
            edges.entry(ends).or_default().push(side);
        }
    }
    edges.values_mut().for_each(|sides| sides.sort_by_key(|side| side.uv));
    edges
}

/// Pairs of triangles across seams of one surface: where two islands meet along most of their border, or show other parts of
/// the texture.
fn seams(
    edges: &Edges,
    islands: &mut Sets,
    triangles: &[[u32; 3]],
    positions: &[[f32; 3]],
    uvs: Option<&[[f32; 2]]>,
) -> Vec<[usize; 2]> {
    let Some(uvs) = uvs else { return Vec::new() };
    let length = |ends: [u32; 2]| {
        let [a, b] = ends.map(|v| glam::Vec3::from(positions[v as usize]));
        a.distance(b)
    };
    let mut borders: HashMap<usize, f32> = HashMap::new();
    let mut shared: BTreeMap<[usize; 2], (f32, [usize; 2])> = BTreeMap::new();
    for sides in edges.values() {
        for same in sides.chunk_by(|a, b| a.uv == b.uv) {
            if let [side] = same {
                *borders.entry(islands.root(side.triangle)).or_default() += length(side.ends);
            }
        }
        // Where three meet, one hangs on the others.
        let [a, b] = &sides[..] else { continue };
        let (of_a, of_b) = (islands.root(a.triangle), islands.root(b.triangle));
        if of_a != of_b && a.forward != b.forward {
            let key = [of_a.min(of_b), of_a.max(of_b)];
            shared.entry(key).or_insert((0.0, [a.triangle, b.triangle])).0 += length(a.ends);
        }
    }
    if shared.is_empty() {
        return Vec::new();
    }
    let mut boxes: HashMap<usize, [[f32; 2]; 2]> = HashMap::new();
    for (triangle, corners) in triangles.iter().enumerate() {
        let bounds = boxes.entry(islands.root(triangle)).or_insert([[f32::INFINITY; 2], [f32::NEG_INFINITY; 2]]);
        for uv in corners.iter().filter_map(|v| uvs.get(*v as usize)) {
            for axis in 0..2 {
                bounds[0][axis] = bounds[0][axis].min(uv[axis]);
                bounds[1][axis] = bounds[1][axis].max(uv[axis]);
            }
        }
    }
    let one = |(pair, (seam, across)): ([usize; 2], (f32, [usize; 2]))| {
        let [a, b] = pair;
        let border = |of: &usize| borders.get(of).copied().unwrap_or(0.0);
        let along = seam >= SEAM * border(&a).min(border(&b));
        (along || overlap(boxes.get(&a)?, boxes.get(&b)?) < SAME_PICTURE).then_some(across)
    };
    shared.into_iter().filter_map(one).collect()
}

/// Share of the smaller of two boxes that lies in the other.
fn overlap(a: &[[f32; 2]; 2], b: &[[f32; 2]; 2]) -> f32 {
    let share = |axis: usize| {
        let common = a[1][axis].min(b[1][axis]) - a[0][axis].max(b[0][axis]);
        let smaller = (a[1][axis] - a[0][axis]).min(b[1][axis] - b[0][axis]);
        (common.max(0.0) / smaller.max(1e-9)).min(1.0)
    };
    share(0) * share(1)
}
