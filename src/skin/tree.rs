//! Triangles that rays are cast into.

use glam::Vec3;

/// Most triangles in a leaf of the tree.
const LEAF: usize = 4;

/// Triangles in a tree of boxes, each node cut at the median of its centres.
pub(crate) struct Tree {
    /// A node's first child stands right behind it.
    nodes: Vec<TreeNode>,
    triangles: Vec<Triangle>,
}

struct TreeNode {
    low: Vec3,
    high: Vec3,
    /// Of a leaf the first triangle, else the second child.
    first: u32,
    /// Triangles of a leaf, else 0.
    count: u32,
}

/// A corner and the edges from it to the others.
#[derive(Clone, Copy)]
struct Triangle {
    corner: Vec3,
    edges: [Vec3; 2],
}

impl Triangle {
    fn bounds(&self) -> (Vec3, Vec3) {
        let [b, c] = self.edges.map(|edge| self.corner + edge);
        (self.corner.min(b).min(c), self.corner.max(b).max(c))
    }

    /// Twice the centre of the box.
    fn centre(&self) -> Vec3 {
        let (low, high) = self.bounds();
        low + high
    }

    /// Where along a ray, in lengths of `direction`, the triangle lies (Möller and Trumbore 1997).
    fn meets(&self, at: Vec3, direction: Vec3) -> Option<f32> {
        // Neighbours overlap by this, so that no ray slips between them.
        const SLACK: f32 = 1e-5;
        let [b, c] = self.edges;
        let across = direction.cross(c);
        let volume = b.dot(across);
        let offset = at - self.corner;
        let turned = offset.cross(b);
        let (u, v) = (offset.dot(across) / volume, direction.dot(turned) / volume);
        // A ray in the plane of the triangle gives infinity or NaN, which fail.
        (u >= -SLACK && v >= -SLACK && u + v <= 1.0 + SLACK).then(|| c.dot(turned) / volume)
    }
}

impl Tree {
    /// Triangles without area or not finite are left out.
    pub(crate) fn new(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Self {
        let triangle = |corners: &[u32; 3]| {
            let [a, b, c] = corners.map(|c| positions.get(c as usize).copied().map(Vec3::from_array));
            let (a, b, c) = (a?, b?, c?);
            let area = (b - a).as_dvec3().cross((c - a).as_dvec3()).length_squared();
            (area > 0.0 && area.is_finite()).then_some(Triangle { corner: a, edges: [b - a, c - a] })
        };
        let mut triangles: Vec<Triangle> = triangles.iter().filter_map(triangle).collect();
        let mut nodes = Vec::with_capacity(triangles.len());
        if !triangles.is_empty() {
            grow(&mut nodes, &mut triangles, 0);
        }
        Self { nodes, triangles }
    }

    /// Length of the ray to the first triangle that is nearer than `most`.
    pub(crate) fn first_hit(&self, at: Vec3, direction: Vec3, most: f32) -> Option<f32> {
        // No component is 0, so that none of the box test's numbers is NaN.
        let inverse = direction.to_array().map(|v| 1.0 / if v.abs() < 1e-12 { 1e-12 } else { v });
        let inverse = Vec3::from_array(inverse);
        let mut nearest = most;
        let mut found = None;
        // Halving 2^32 triangles takes fewer levels than this.
        let mut stack = [(0, 0.0); 40];
        let mut height = 0;
        let mut next = self.nodes.first().and_then(|root| root.enters(at, inverse, nearest)).map(|_| 0);
        loop {
            let Some(index) = next.take() else {
                if height == 0 {
                    return found;
                }
                height -= 1;
                let (index, enters) = stack[height];
                next = (enters < nearest).then_some(index);
                continue;
            };
            let node = &self.nodes[index];
            let first = node.first as usize;
            if node.count > 0 {
                for triangle in &self.triangles[first..first + node.count as usize] {
                    if let Some(length) = triangle.meets(at, direction).filter(|l| *l > 0.0 && *l < nearest) {
                        nearest = length;
                        found = Some(length);
                    }
                }
                continue;
            }
            let enters = |child: usize| self.nodes[child].enters(at, inverse, nearest).map(|length| (child, length));
            next = match (enters(index + 1), enters(first)) {
                (Some(a), Some(b)) => {
                    let (near, far) = if b.1 < a.1 { (b, a) } else { (a, b) };
                    stack[height] = far;
                    height += 1;
                    Some(near.0)
                }
                (a, b) => a.or(b).map(|child| child.0),
            };
        }
    }
}

impl TreeNode {
    /// Where a ray enters the box, if nearer than `most`.
    fn enters(&self, at: Vec3, inverse: Vec3, most: f32) -> Option<f32> {
        let (a, b) = ((self.low - at) * inverse, (self.high - at) * inverse);
        let enters = a.min(b).max_element().max(0.0);
        let leaves = a.max(b).min_element().min(most);
        (enters <= leaves).then_some(enters)
    }
}

/// Adds the node of some triangles, and its children, and orders the triangles. `first` is where they begin in the
/// whole list.
fn grow(nodes: &mut Vec<TreeNode>, triangles: &mut [Triangle], first: usize) {
    let far = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let join = |(low, high): (Vec3, Vec3), (l, h): (Vec3, Vec3)| (low.min(l), high.max(h));
    let (low, high) = triangles.iter().map(Triangle::bounds).fold(far, join);
    let own = nodes.len();
    let count = if triangles.len() <= LEAF { triangles.len() } else { 0 };
    // Wider by what rounding may take away.
    let margin = 2.0 * f32::EPSILON * low.abs().max(high.abs());
    let [low, high] = [low - margin, high + margin];
    nodes.push(TreeNode { low, high, first: first as u32, count: count as u32 });
    if count > 0 {
        return;
    }
    let centres = triangles.iter().map(Triangle::centre).map(|c| (c, c));
    let (least, most) = centres.fold(far, join);
    let axis = (most - least).max_position();
    let half = triangles.len() / 2;
    triangles.select_nth_unstable_by(half, |a, b| a.centre()[axis].total_cmp(&b.centre()[axis]));
    let (left, right) = triangles.split_at_mut(half);
    grow(nodes, left, first);
    nodes[own].first = nodes.len() as u32;
    grow(nodes, right, first + half);
}

#[cfg(test)]
mod tests {
    use super::super::curvature::shapes::{ball, globe, together};
    use super::*;

    const MOST: f32 = 0.05;

    #[test]
    fn the_tree_finds_what_a_look_at_all_triangles_finds() {
        let mesh = together(&[ball(0.01, 3), ball(0.015, 3), globe(0.03, 24)]);
        let tree = Tree::new(&mesh.positions, mesh.indices.as_chunks::<3>().0);
        let mut hits = 0;
        for ray in 0..3000_u32 {
            // Numbers of no order in [-1, 1).
            let number = |k: u32| ((ray * 6 + k).wrapping_mul(2_654_435_761) >> 8) as f32 / 8_388_608.0 - 1.0;
            let at = 0.03 * Vec3::from_array([0, 1, 2].map(number));
            // Some lie in the planes of boxes.
            let way = Vec3::from_array([3, 4, 5].map(|k| if ray % 5 == 0 && k != 4 { 0.0 } else { number(k) }));
            let Some(way) = way.try_normalize() else { continue };
            let all = tree.triangles.iter().filter_map(|t| t.meets(at, way)).filter(|l| *l > 0.0 && *l < MOST);
            let nearest = all.fold(f32::INFINITY, f32::min);
            let found = tree.first_hit(at, way, MOST).unwrap_or(f32::INFINITY);
            assert_eq!(found, nearest, "from {at} along {way}");
            hits += u32::from(found.is_finite());
        }
        assert!(hits > 1500, "{hits}");
    }
}
