//! Strips of a piece of hair, from its mesh alone or with what its file says of them.

use std::fmt;

use glam::{Mat4, Vec2, Vec3};
use serde::{Deserialize, Serialize};

use super::axis::Patch;
use super::patches::patches;
use crate::scene::{Primitive, welded};

/// Strips that a piece of hair may have: more are a heap of loose triangles.
pub const MAX_STRIPS: usize = 16_384;

/// The strips of a primitive, at rest.
///
/// A strip is what hangs together by its edges: a card, a lock, a tube. Seams of texture coordinates and of normals do not
/// part it; cards that touch in a corner, or side by side with the same part of the texture on each, stay apart. What the file
/// says ([`Primitive::strip_ids`], [`Primitive::root_tip`], [`Primitive::strands`]) takes the place of what is found.
#[derive(Clone, Debug, PartialEq)]
pub struct HairStrips {
    /// Number of strips.
    pub count: usize,
    /// The strip of each triangle, below `count`.
    pub of_triangles: Vec<u32>,
    /// How far along its strip each vertex lies: 0 at the root, 1 at the tip. A vertex without a triangle has 0.
    pub along: Vec<f32>,
    /// Direction of each vertex from root to tip along the surface, mesh space, unit.
    pub directions: Vec<[f32; 3]>,
    /// Mean height of each strip, character space, metres.
    pub heights: Vec<f32>,
    /// Mean distance of each strip from the middle of the head, metres.
    pub radii: Vec<f32>,
}

/// In which order strips are drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum StripSort {
    /// The lowest first, by mean height at rest: strips flow on top of lower ones.
    #[default]
    Height,
    /// The innermost first, by mean distance from the middle of the head at rest.
    Radial,
    /// As the file has them.
    None,
}

/// Why a primitive has no strips.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoStrips {
    /// It has no triangles.
    Empty,
    /// A triangle refers to a vertex that is not there.
    Broken,
    /// It is one closed surface about as long as it is wide, which has neither a root nor a tip.
    Closed,
    /// It has more than [`MAX_STRIPS`].
    TooMany(usize),
}

impl fmt::Display for NoStrips {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => f.write_str("has no triangles"),
            Self::Broken => f.write_str("refers to vertices that are not there"),
            Self::Closed => f.write_str("is one closed surface without a root and a tip"),
            Self::TooMany(count) => {
                write!(f, "falls into {count} pieces that share no edges; at most {MAX_STRIPS} can be strips")
            }
        }
    }
}

impl HairStrips {
    /// Finds them. `rest` takes the primitive to character space; `head` is the middle of the head there, where it is known:
    /// a strip is rooted at the end that is nearer to it.
    ///
    /// # Errors
    /// What is no hair: see [`NoStrips`].
    pub fn of(primitive: &Primitive, rest: Mat4, head: Option<Vec3>) -> Result<Self, NoStrips> {
        let triangles = primitive.indices.as_chunks::<3>().0;
        if triangles.is_empty() {
            return Err(NoStrips::Empty);
        }
        let vertices = primitive.positions.len();
        if primitive.indices.iter().any(|i| *i as usize >= vertices) {
            return Err(NoStrips::Broken);
        }
        let (places, place_count) = welded(&primitive.positions);
        let uvs = primitive.uvs.first().filter(|set| set.len() == vertices).map(Vec::as_slice);
        let given = |len: usize| len == vertices;
        let (of_triangles, count) = if given(primitive.strip_ids.len()) {
            numbered(triangles, &primitive.strip_ids)
        } else {
            patches(triangles, &places, &primitive.positions, uvs)
        };
        if count > MAX_STRIPS {
            return Err(NoStrips::TooMany(count));
        }
        let mut local = vec![usize::MAX; place_count];
        if count == 1 && !given(primitive.root_tip.len()) && is_closed(triangles, &places) {
            let all: Vec<usize> = (0..triangles.len()).collect();
            if Patch::of(primitive, triangles, &all, &places, None, &mut local).is_round() {
                return Err(NoStrips::Closed);
            }
            local.fill(usize::MAX);
        }
        let world = |p: Vec3| rest.transform_point3(p);
        let head = head.unwrap_or_else(|| head_of(primitive, rest));
        let mut found = Self {
            count,
            of_triangles,
            along: vec![0.0; vertices],
            directions: vec![[0.0, -1.0, 0.0]; vertices],
            heights: Vec::with_capacity(count),
            radii: Vec::with_capacity(count),
        };
        let mut by_strip: Vec<Vec<usize>> = vec![Vec::new(); count];
        for (triangle, strip) in found.of_triangles.iter().enumerate() {
            by_strip[*strip as usize].push(triangle);
        }
        // Vertices that two strips share are the first one's.
        let mut taken = vec![false; vertices];
        for of_strip in &by_strip {
            let patch = Patch::of(primitive, triangles, of_strip, &places, uvs, &mut local);
            let mut along = patch.along().unwrap_or_else(|| vec![0.0; patch.places.len()]);
            if given(primitive.root_tip.len()) {
                for v in of_strip.iter().flat_map(|t| triangles[*t]) {
                    along[local[places[v as usize] as usize]] = primitive.root_tip[v as usize];
                }
            } else {
                turn_to_root(&patch, &mut along, |p| world(p).distance(head));
            }
            let directions = patch.directions(&along);
            for v in of_strip.iter().flat_map(|t| triangles[*t]).map(|v| v as usize) {
                if !std::mem::replace(&mut taken[v], true) {
                    let at = local[places[v] as usize];
                    found.along[v] = along[at];
                    found.directions[v] = directions[at].to_array();
                }
            }
            found.heights.push(patch.mean(|p| world(p).y));
            found.radii.push(patch.mean(|p| world(p).distance(head)));
            for t in of_strip {
                triangles[*t].iter().for_each(|v| local[places[*v as usize] as usize] = usize::MAX);
            }
        }
        if given(primitive.strands.len()) {
            found.directions.clone_from(&primitive.strands);
        }
        Ok(found)
    }

    /// Strips in the order in which they are drawn; equal ones keep the order of the file.
    #[must_use]
    pub fn order(&self, by: StripSort) -> Vec<u32> {
        let mut order: Vec<u32> = (0..self.count as u32).collect();
        let keys = match by {
            StripSort::Height => &self.heights,
            StripSort::Radial => &self.radii,
            StripSort::None => return order,
        };
        order.sort_by(|a, b| keys[*a as usize].total_cmp(&keys[*b as usize]));
        order
    }

    /// Triangles of a primitive strip by strip in this order, each strip's as the file has them.
    #[must_use]
    pub fn arranged(&self, indices: &[u32], order: &[u32]) -> Vec<u32> {
        let mut turns = vec![0; self.count];
        order.iter().enumerate().for_each(|(turn, strip)| turns[*strip as usize] = turn);
        let mut triangles: Vec<(usize, &[u32])> =
            self.of_triangles.iter().map(|strip| turns[*strip as usize]).zip(indices.chunks_exact(3)).collect();
        triangles.sort_by_key(|(turn, _)| *turn);
        triangles.into_iter().flat_map(|(_, triangle)| triangle.iter().copied()).collect()
    }
}

impl Patch {
    /// The triangles of a strip; `local` gets the number of each of its places.
    fn of(
        primitive: &Primitive,
        triangles: &[[u32; 3]],
        of_strip: &[usize],
        places: &[u32],
        uvs: Option<&[[f32; 2]]>,
        local: &mut [usize],
    ) -> Self {
        let mut patch = Self {
            triangles: Vec::with_capacity(of_strip.len()),
            places: Vec::new(),
            uvs: uvs.map(|_| Vec::with_capacity(of_strip.len())),
        };
        for triangle in of_strip {
            let corners = triangles[*triangle];
            patch.triangles.push(corners.map(|v| {
                let number = &mut local[places[v as usize] as usize];
                if *number == usize::MAX {
                    *number = patch.places.len();
                    patch.places.push(Vec3::from(primitive.positions[v as usize]));
                }
                *number
            }));
            if let (Some(uvs), Some(list)) = (uvs, &mut patch.uvs) {
                list.push(corners.map(|v| Vec2::from(uvs[v as usize])));
            }
        }
        patch
    }
}

/// Lets a way begin at the root: the end that is nearer.
fn turn_to_root(patch: &Patch, along: &mut [f32], away: impl Fn(Vec3) -> f32) {
    let end = |is_there: &dyn Fn(f32) -> bool| {
        let there = patch.places.iter().zip(&*along).filter(|(_, t)| is_there(**t)).map(|(p, _)| away(*p));
        let (sum, count) = there.fold((0.0, 0), |(sum, count), d| (sum + d, count + 1));
        sum / f32::max(count as f32, 1.0)
    };
    if end(&|t| t > 0.9) < end(&|t| t < 0.1) {
        along.iter_mut().for_each(|t| *t = 1.0 - *t);
    }
}

/// Strips by the numbers that the file has given to vertices: a triangle belongs to that of its first corner.
fn numbered(triangles: &[[u32; 3]], ids: &[u32]) -> (Vec<u32>, usize) {
    let mut known = std::collections::HashMap::new();
    let of = triangles.iter().map(|t| {
        let next = known.len() as u32;
        *known.entry(ids[t[0] as usize]).or_insert(next)
    });
    let of: Vec<u32> = of.collect();
    (of, known.len())
}

/// Whether every edge has a triangle on either side.
fn is_closed(triangles: &[[u32; 3]], places: &[u32]) -> bool {
    let mut sides = std::collections::HashMap::new();
    for corners in triangles {
        let at = corners.map(|v| places[v as usize]);
        for (a, b) in [(at[0], at[1]), (at[1], at[2]), (at[2], at[0])] {
            *sides.entry([a.min(b), a.max(b)]).or_insert(0u32) += u32::from(a != b);
        }
    }
    sides.values().all(|count| *count != 1)
}

/// About where the head is below hair of which nothing else is known: below its top, half as deep as it is narrow.
fn head_of(primitive: &Primitive, rest: Mat4) -> Vec3 {
    let places = || primitive.positions.iter().map(|p| rest.transform_point3(Vec3::from(*p)));
    let (low, high) = places().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(l, h), p| (l.min(p), h.max(p)));
    let deep = (high - low).min_element() * 0.5;
    let crown = places().filter(|p| p.y >= high.y - deep);
    let (sum, count) = crown.fold((Vec3::ZERO, 0), |(sum, count), p| (sum + p, count + 1));
    (sum / (count as f32).max(1.0)).with_y(high.y - deep)
}
