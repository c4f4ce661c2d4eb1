//! Keys of the face's shadow, drawn from `face.sdf.toml`: the source from which an SDF threshold map is baked.

use serde::Deserialize;
use tiny_skia::{Path, PathBuilder};

use crate::picture::{Canvas, Picture};

/// The file, for whoever wants to edit it.
pub const SOURCE: &str = include_str!("../../face.sdf.toml");

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Document {
    size: u32,
    #[allow(
        dead_code,
        reason = "for those who bake the map: light from the right is drawn, the other side mirrors it"
    )]
    mirror: bool,
    keys: Vec<f32>,
    #[serde(rename = "shape")]
    shapes: Vec<Shape>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Shape {
    name: String,
    kind: Kind,
    keys: Vec<Key>,
}

#[derive(Clone, Copy, Deserialize, PartialEq)]
#[serde(rename_all = "lowercase")]
enum Kind {
    Light,
    Shadow,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Key {
    angle: f32,
    path: String,
}

fn document() -> Document {
    toml::from_str(SOURCE).expect("face.sdf.toml is part of this crate")
}

/// Angles of the light, degrees from the front to her left, at which masks are to be drawn.
#[must_use]
pub fn angles() -> Vec<f32> {
    document().keys
}

/// The keys of the face's shadow: angle of the light, radians, side of the mask, and how much of its texels is lit, 0..=255.
#[must_use]
pub fn keys() -> Vec<(f32, u32, Vec<u8>)> {
    let key = |angle: f32| {
        let picture = mask(angle);
        (angle.to_radians(), picture.width, picture.rgba.iter().map(|p| p[0]).collect())
    };
    angles().into_iter().map(key).collect()
}

/// The mask at an angle of the light, degrees 0..=180: white where the face is lit, over its texture.
///
/// # Panics
/// Where `face.sdf.toml` has been edited into nonsense.
#[must_use]
pub fn mask(angle: f32) -> Picture {
    let document = document();
    let mut canvas = Canvas::new(document.size, document.size, Some(0x000000));
    for shape in &document.shapes {
        if let Some(path) = shape.at(angle) {
            canvas.fill(&path, if shape.kind == Kind::Light { 0xffffff } else { 0x000000 }, 1.0);
        }
    }
    canvas.finish()
}

impl Shape {
    /// The path between the two keys round an angle; none before the first and after the last.
    fn at(&self, angle: f32) -> Option<Path> {
        let after = self.keys.iter().position(|k| k.angle >= angle)?;
        let before = after.saturating_sub(usize::from(self.keys[after].angle > angle));
        let (a, b) = (&self.keys[before], &self.keys[after]);
        if angle < a.angle {
            return None;
        }
        let t = if b.angle > a.angle {
            (angle - a.angle) / (b.angle - a.angle)
        } else {
            0.0
        };
        let (a, b) = (tokens(&a.path), tokens(&b.path));
        assert!(a.len() == b.len(), "{}: keys {before} and {after} differ in their commands", self.name);
        let mut builder = PathBuilder::new();
        let mut mixed = a.iter().zip(&b).map(|(a, b)| match (a, b) {
            (Token::Command(a), Token::Command(b)) if a == b => Token::Command(*a),
            (Token::Number(a), Token::Number(b)) => Token::Number(a + (b - a) * t),
            _ => panic!("{}: keys {before} and {after} differ in their commands", self.name),
        });
        while let Some(token) = mixed.next() {
            let Token::Command(command) = token else { panic!("{}: a number without a command", self.name) };
            let mut number = || match mixed.next() {
                Some(Token::Number(n)) => n,
                _ => panic!("{}: {command} lacks a number", self.name),
            };
            match command {
                'M' => builder.move_to(number(), number()),
                'L' => builder.line_to(number(), number()),
                'C' => builder.cubic_to(number(), number(), number(), number(), number(), number()),
                'Z' => builder.close(),
                other => panic!("{}: {other} is none of M, L, C, Z", self.name),
            }
        }
        builder.finish()
    }
}

enum Token {
    Command(char),
    Number(f32),
}

fn tokens(path: &str) -> Vec<Token> {
    path.split_whitespace()
        .map(|word| match word.parse() {
            Ok(number) => Token::Number(number),
            Err(_) => Token::Command(word.chars().next().unwrap_or('?')),
        })
        .collect()
}
