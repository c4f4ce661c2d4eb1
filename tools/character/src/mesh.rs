//! Meshes while they are built: vertices with weights, triangles, morph targets; and the few tools that every part uses.

use std::collections::BTreeMap;

use glam::{Vec2, Vec3, Vec4};

use crate::skeleton::{Skeleton, Weights};

/// One vertex. Metres; the character stands at the origin, faces +Z, her left is +X.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vertex {
    /// Position at rest.
    pub position: Vec3,
    /// Unit normal.
    pub normal: Vec3,
    /// Texture coordinates; (0, 0) is the upper left corner of the picture.
    pub uv: Vec2,
    /// Bones that move it; the weights sum to 1.
    pub weights: Weights,
}

/// A morph target: the vertices that it moves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Morph {
    /// Name, shared by all parts that move together (`blinkLeft`, `aa`, …).
    pub name: &'static str,
    /// Vertex and offset of its position, metres.
    pub offsets: Vec<(u32, Vec3)>,
}

/// A mesh of one material. Becomes one node, one mesh and one primitive of the file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Part {
    /// Name of node and mesh.
    pub name: String,
    /// Name of its material.
    pub material: &'static str,
    /// Vertices.
    pub vertices: Vec<Vertex>,
    /// Triangles, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Morph targets.
    pub morphs: Vec<Morph>,
    /// Tangents (glTF), one a vertex, or empty. On hair they point from root to tip.
    pub tangents: Vec<Vec4>,
}

impl Part {
    /// An empty part.
    #[must_use]
    pub fn new(name: impl Into<String>, material: &'static str) -> Self {
        Self { name: name.into(), material, ..Self::default() }
    }

    /// Adds a vertex without a normal (see [`Part::smooth_normals`]) and returns its index.
    pub fn vertex(&mut self, position: Vec3, uv: Vec2, weights: Weights) -> u32 {
        self.vertices.push(Vertex { position, normal: Vec3::ZERO, uv, weights });
        (self.vertices.len() - 1) as u32
    }

    /// Adds a quad whose corners run counter-clockwise seen from outside, split along its shorter diagonal.
    pub fn quad(&mut self, a: u32, b: u32, c: u32, d: u32) {
        let p = |i: u32| self.vertices[i as usize].position;
        if p(a).distance_squared(p(c)) <= p(b).distance_squared(p(d)) {
            self.triangles.extend([[a, b, c], [a, c, d]]);
        } else {
            self.triangles.extend([[a, b, d], [b, c, d]]);
        }
    }

    /// Adds a grid of quads over vertices that stand row by row from `first`. Outside is where a row runs to the right
    /// and the next row lies below it. `closed` joins the last column to the first.
    pub fn quads(&mut self, first: u32, rows: u32, columns: u32, closed: bool) {
        for r in 0..rows - 1 {
            for c in 0..if closed { columns } else { columns - 1 } {
                let (upper, lower) = (first + r * columns, first + (r + 1) * columns);
                let next = (c + 1) % columns;
                self.quad(upper + c, lower + c, lower + next, upper + next);
            }
        }
    }

    /// Closes a loop of vertices with a fan around a new vertex in their middle. The loop runs counter-clockwise seen
    /// from outside.
    pub fn cap(&mut self, ring: &[u32], uv: Vec2, weights: Weights) {
        let middle = ring.iter().map(|i| self.vertices[*i as usize].position).sum::<Vec3>() / ring.len() as f32;
        let center = self.vertex(middle, uv, weights);
        for (i, a) in ring.iter().enumerate() {
            self.triangles.push([*a, ring[(i + 1) % ring.len()], center]);
        }
    }

    /// Appends another part of the same material; morphs of the same name are joined.
    pub fn append(&mut self, other: &Self) {
        let base = self.vertices.len() as u32;
        self.vertices.extend_from_slice(&other.vertices);
        self.tangents.extend_from_slice(&other.tangents);
        self.triangles.extend(other.triangles.iter().map(|t| t.map(|i| i + base)));
        for morph in &other.morphs {
            for (vertex, offset) in &morph.offsets {
                self.offset(morph.name, vertex + base, *offset);
            }
        }
    }

    /// Adds an offset of one vertex to the morph of this name.
    pub fn offset(&mut self, name: &'static str, vertex: u32, offset: Vec3) {
        let index = self.morphs.iter().position(|m| m.name == name).unwrap_or_else(|| {
            self.morphs.push(Morph { name, offsets: Vec::new() });
            self.morphs.len() - 1
        });
        self.morphs[index].offsets.push((vertex, offset));
    }

    /// The mirror image in the plane x = 0: bones, winding and sided morph names change sides; UVs stay.
    #[must_use]
    pub fn mirrored(&self, skeleton: &Skeleton) -> Self {
        let flip = |v: Vec3| Vec3::new(-v.x, v.y, v.z);
        Self {
            name: swap_sides(&self.name),
            material: self.material,
            vertices: self
                .vertices
                .iter()
                .map(|v| Vertex {
                    position: flip(v.position),
                    normal: flip(v.normal),
                    uv: v.uv,
                    weights: skeleton.mirrored(v.weights),
                })
                .collect(),
            triangles: self.triangles.iter().map(|[a, b, c]| [*a, *c, *b]).collect(),
            morphs: self
                .morphs
                .iter()
                .map(|m| Morph {
                    name: mirrored_morph(m.name),
                    offsets: m.offsets.iter().map(|(i, o)| (*i, flip(*o))).collect(),
                })
                .collect(),
            tangents: self.tangents.iter().map(|t| Vec4::new(-t.x, t.y, t.z, -t.w)).collect(),
        }
    }

    /// Normals by the angles of the triangles around each place; vertices at the same place share one normal.
    pub fn smooth_normals(&mut self) {
        let key = |p: Vec3| (p * 1e5).round().as_ivec3().to_array();
        let mut sums: BTreeMap<[i32; 3], Vec3> = BTreeMap::new();
        for t in &self.triangles {
            let p = t.map(|i| self.vertices[i as usize].position);
            let normal = (p[1] - p[0]).cross(p[2] - p[0]).normalize_or_zero();
            for k in 0..3 {
                let (a, b) = (p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
                *sums.entry(key(p[k])).or_default() += normal * a.angle_between(b).clamp(0.0, 3.2);
            }
        }
        for v in &mut self.vertices {
            v.normal = sums.get(&key(v.position)).copied().unwrap_or_default().normalize_or(Vec3::Y);
        }
    }
}

/// `Left…` for `Right…` and the other way round, at the end or the start of a name.
fn swap_sides(name: &str) -> String {
    if name.contains("Left") {
        name.replace("Left", "Right")
    } else if name.contains("Right") {
        name.replace("Right", "Left")
    } else {
        name.to_owned()
    }
}

/// The morph that does on the other side what this one does here.
fn mirrored_morph(name: &'static str) -> &'static str {
    match name {
        "blinkLeft" => "blinkRight",
        "blinkRight" => "blinkLeft",
        "lookLeft" => "lookRight",
        "lookRight" => "lookLeft",
        other => other,
    }
}
