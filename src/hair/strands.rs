//! Which way strands run at each vertex, in the place of tangents.

use glam::{Vec2, Vec3};

use super::{HairStrips, NoStrips};
use crate::material::{Hair, StrandDirection};
use crate::scene::Primitive;

/// Directions from root to tip in mesh space, unit, with the sign of a bitangent, for the vertices of a primitive; those of its
/// texture where a flow map is read in them. `strips` finds its strips.
///
/// # Errors
/// It is to go by its shape, and that has no strips.
pub(crate) fn tangents<'a>(
    of: &Hair,
    primitive: &Primitive,
    strips: impl FnOnce() -> Result<&'a HairStrips, NoStrips>,
) -> Result<Vec<[f32; 4]>, NoStrips> {
    let by_texture = |along: Vec2| gradients(primitive, of.flow_map.map_or(0, |t| t.uv_set as usize), along);
    let directions = match of.direction {
        StrandDirection::Auto if of.flow_map.is_some() => return Ok(in_texture(primitive, by_texture(Vec2::X))),
        StrandDirection::Auto if !primitive.strands.is_empty() => primitive.strands.clone(),
        StrandDirection::Auto | StrandDirection::UvV => by_texture(Vec2::Y),
        StrandDirection::UvU => by_texture(Vec2::X),
        StrandDirection::Mesh => strips()?.directions.clone(),
    };
    Ok(directions.into_iter().map(|[x, y, z]| [x, y, z, 1.0]).collect())
}

/// Tangents of the texture: the file's, else the given ones, with the sign that makes the bitangent run upwards in it.
fn in_texture(primitive: &Primitive, along_u: Vec<[f32; 3]>) -> Vec<[f32; 4]> {
    if !primitive.tangents.is_empty() {
        return primitive.tangents.clone();
    }
    let upwards = gradients(primitive, 0, Vec2::NEG_Y);
    let signed = |((u, v), normal): (([f32; 3], [f32; 3]), &[f32; 3])| {
        let sign = Vec3::from(*normal).cross(u.into()).dot(v.into());
        [u[0], u[1], u[2], if sign < 0.0 { -1.0 } else { 1.0 }]
    };
    along_u.into_iter().zip(upwards).zip(&primitive.normals).map(signed).collect()
}

/// Directions on the surface in which texture coordinates grow along `along`, by the area of the triangles at each vertex.
fn gradients(primitive: &Primitive, uv_set: usize, along: Vec2) -> Vec<[f32; 3]> {
    let mut sums = vec![Vec3::ZERO; primitive.positions.len()];
    let Some(uvs) = primitive.uvs.get(uv_set).or(primitive.uvs.first()) else {
        return sums.iter().map(|s| s.to_array()).collect();
    };
    for corners in primitive.indices.as_chunks::<3>().0 {
        let [a, b, c] = corners.map(|i| Vec3::from(primitive.positions[i as usize]));
        let [ta, tb, tc] = corners.map(|i| Vec2::from(uvs[i as usize]));
        let (e1, e2, t1, t2) = (b - a, c - a, tb - ta, tc - ta);
        let area = t1.perp_dot(t2);
        // What is not unfolded in the texture has no direction there.
        let grows = (e1 * t2.perp_dot(along) - e2 * t1.perp_dot(along)) * -area.signum();
        let grows = grows.normalize_or_zero() * e1.cross(e2).length();
        if area != 0.0 {
            corners.iter().for_each(|i| sums[*i as usize] += grows);
        }
    }
    sums.into_iter().map(|s| s.normalize_or_zero().to_array()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quad() -> Primitive {
        // In the plane of x and y: u to the right, v downwards.
        Primitive {
            positions: vec![[0.0, 1.0, 0.0], [2.0, 1.0, 0.0], [0.0, 0.0, 0.0], [2.0, 0.0, 0.0]],
            normals: vec![[0.0, 0.0, 1.0]; 4],
            uvs: vec![vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]],
            indices: vec![0, 2, 1, 1, 2, 3],
            ..Primitive::default()
        }
    }

    /// Without strips.
    fn found(hair: &Hair, primitive: &Primitive) -> Vec<[f32; 4]> {
        tangents(hair, primitive, || Err(NoStrips::Empty)).expect("directions")
    }

    #[test]
    fn strands_follow_the_texture() {
        let of = |direction| found(&Hair { direction, ..Hair::default() }, &quad());
        assert_eq!(of(StrandDirection::UvV), [[0.0, -1.0, 0.0, 1.0]; 4]);
        assert_eq!(of(StrandDirection::UvU), [[1.0, 0.0, 0.0, 1.0]; 4]);
        // Mirrored in the texture.
        let mut mirrored = quad();
        mirrored.uvs[0].iter_mut().for_each(|uv| uv[0] = 1.0 - uv[0]);
        let hair = Hair { direction: StrandDirection::UvU, ..Hair::default() };
        assert_eq!(found(&hair, &mirrored), [[-1.0, 0.0, 0.0, 1.0]; 4]);
    }

    #[test]
    fn a_flow_map_is_read_in_the_axes_of_the_texture() {
        let hair = Hair { flow_map: Some(Default::default()), ..Hair::default() };
        assert_eq!(found(&hair, &quad()), [[1.0, 0.0, 0.0, 1.0]; 4]);
        let mut mirrored = quad();
        mirrored.uvs[0].iter_mut().for_each(|uv| uv[0] = 1.0 - uv[0]);
        assert_eq!(found(&hair, &mirrored), [[-1.0, 0.0, 0.0, -1.0]; 4]);
    }

    #[test]
    fn what_the_file_says_comes_first() {
        let file = Primitive { strands: vec![[0.0, 0.6, 0.8]; 4], ..quad() };
        assert_eq!(found(&Hair::default(), &file), [[0.0, 0.6, 0.8, 1.0]; 4]);
    }
}
