//! Pieces of a part: what hangs together, and a part of some of its triangles.

use std::collections::HashMap;

use super::{Influences, MorphTarget, Primitive};
use crate::sets::Sets;

/// One number for each vertex: those at the same place have the same one. The second is how many there are.
pub(crate) fn welded(positions: &[[f32; 3]]) -> (Vec<u32>, usize) {
    let mut known = HashMap::with_capacity(positions.len());
    // 0 and -0 are one place.
    let key = |p: &[f32; 3]| p.map(|x| (x + 0.0).to_bits());
    let numbers = positions
        .iter()
        .map(|p| {
            let next = known.len() as u32;
            *known.entry(key(p)).or_insert(next)
        })
        .collect();
    (numbers, known.len())
}

impl Primitive {
    /// Number of the piece that each vertex belongs to, and how many there are: pieces hang together by triangles, and where
    /// places agree.
    pub(crate) fn pieces(&self) -> (Vec<usize>, usize) {
        let mut sets = Sets::new(self.positions.len());
        let (places, count) = welded(&self.positions);
        let mut first = vec![None; count];
        for (vertex, place) in places.iter().enumerate() {
            sets.join(*first[*place as usize].get_or_insert(vertex), vertex);
        }
        for [a, b, c] in self.indices.as_chunks::<3>().0 {
            sets.join(*a as usize, *b as usize);
            sets.join(*b as usize, *c as usize);
        }
        sets.numbered()
    }

    /// The same part with these of its triangles only, and the vertices that they use.
    pub(crate) fn with_triangles(&self, mut indices: Vec<u32>) -> Self {
        let mut table = vec![u32::MAX; self.positions.len()];
        let mut used: Vec<u32> = indices.clone();
        used.sort_unstable();
        used.dedup();
        used.iter().zip(0..).for_each(|(old, new)| table[*old as usize] = new);
        indices.iter_mut().for_each(|i| *i = table[*i as usize]);
        fn of<T: Copy>(list: &[T], used: &[u32], each: usize) -> Vec<T> {
            if list.is_empty() {
                return Vec::new();
            }
            used.iter().flat_map(|v| &list[*v as usize * each..(*v as usize + 1) * each]).copied().collect()
        }
        let Influences { per_vertex, joints, weights } = &self.influences;
        let morph = |morph: &MorphTarget| {
            let mut kept = MorphTarget::default();
            for (i, vertex) in morph.vertices.iter().enumerate().filter(|(_, v)| table[**v as usize] != u32::MAX) {
                kept.vertices.push(table[*vertex as usize]);
                kept.positions.push(morph.positions[i]);
                kept.normals.push(morph.normals[i]);
            }
            kept
        };
        Self {
            material: self.material,
            role: self.role,
            positions: of(&self.positions, &used, 1),
            normals: of(&self.normals, &used, 1),
            tangents: of(&self.tangents, &used, 1),
            uvs: self.uvs.iter().map(|set| of(set, &used, 1)).collect(),
            colors: of(&self.colors, &used, 1),
            influences: Influences {
                per_vertex: *per_vertex,
                joints: of(joints, &used, *per_vertex),
                weights: of(weights, &used, *per_vertex),
            },
            morphs: self.morphs.iter().map(morph).collect(),
            outline_normals: of(&self.outline_normals, &used, 1),
            strands: of(&self.strands, &used, 1),
            root_tip: of(&self.root_tip, &used, 1),
            strip_ids: of(&self.strip_ids, &used, 1),
            indices,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_of_a_part_keeps_what_its_vertices_hold() {
        let number = |n: usize| n as f32;
        let part = Primitive {
            indices: vec![0, 1, 2, 5, 4, 3],
            positions: (0..6).map(|v| [number(v), 0.0, 1.0]).collect(),
            normals: (0..6).map(|v| [0.0, number(v), 0.0]).collect(),
            uvs: vec![(0..6).map(|v| [number(v), 0.5]).collect()],
            influences: Influences {
                per_vertex: 4,
                joints: (0..24).collect(),
                weights: (0..24).map(|w| w as f32 / 24.0).collect(),
            },
            morphs: vec![MorphTarget {
                vertices: vec![1, 4],
                positions: vec![[1.0; 3], [4.0; 3]],
                normals: vec![[0.0; 3], [0.5; 3]],
            }],
            strip_ids: (0..6).collect(),
            ..Primitive::default()
        };
        let half = part.with_triangles(vec![5, 4, 3]);
        assert_eq!(half.indices, [2, 1, 0]);
        assert_eq!(half.positions, [[3.0, 0.0, 1.0], [4.0, 0.0, 1.0], [5.0, 0.0, 1.0]]);
        assert_eq!(half.normals[0], [0.0, 3.0, 0.0]);
        assert_eq!(half.uvs[0][2], [5.0, 0.5]);
        assert_eq!(half.influences.joints, (12..24).collect::<Vec<u16>>());
        assert_eq!(half.influences.weights.len(), 12);
        let MorphTarget { vertices, positions, normals } = &half.morphs[0];
        assert_eq!((&vertices[..], &positions[..], &normals[..]), (&[1][..], &[[4.0; 3]][..], &[[0.5; 3]][..]));
        assert_eq!(half.strip_ids, [3, 4, 5]);
        assert!(half.colors.is_empty() && half.outline_normals.is_empty());
    }

    #[test]
    fn pieces_hang_together_by_triangles_and_places() {
        let place = |v: usize| [v as f32, 0.0, 0.0];
        let mut part = Primitive {
            indices: vec![0, 1, 2, 3, 4, 5, 6, 7, 8],
            positions: (0..9).map(place).collect(),
            ..Primitive::default()
        };
        assert_eq!(part.pieces(), (vec![0, 0, 0, 1, 1, 1, 2, 2, 2], 3));
        part.positions[8] = place(0);
        assert_eq!(part.pieces(), (vec![0, 0, 0, 1, 1, 1, 0, 0, 0], 2));
    }
}
