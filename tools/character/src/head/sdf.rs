//! The shadow of the face as an artist draws it: vector shapes, keyed at a few angles of the light, from which `hikage sdf`
//! bakes a threshold map.

/// The project, `face.sdf.toml`.
pub const SOURCE: &str = include_str!("../../face.sdf.toml");
