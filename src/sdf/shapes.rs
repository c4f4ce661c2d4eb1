//! The lit part of a face as an artist draws it: vector shapes, keyed at a few angles of the light and tweened between.
//!
//! Coordinates are UV: (0, 0) upper left, (1, 1) lower right of the mask; they may lie outside, within -16..=16.

use serde::{Deserialize, Serialize};
use tiny_skia::{FillRule, Mask, Path, PathBuilder, Transform};

use super::svg_path::{MAX_COORDINATE, MAX_SEGMENTS, Point, Segment, Verb, outside, segments, too_far};

const MAX_SHAPES: usize = 256;
const MAX_KEYS: usize = 256;
const MAX_TURN: f32 = 3600.0;
/// Texels that are rasterised at once: 2048 x 2048, so that usual masks are drawn in one piece.
const TILE_TEXELS: u32 = 1 << 22;
/// Distance of a quarter circle's control points from its ends, in radii.
const KAPPA: f32 = 0.552_284_8;

/// A shape that grows, moves and fades with the light. It is there from the angle of its first key to that of its last,
/// both included, and nowhere else.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Shape {
    /// What the artist calls it; faults name it.
    pub name: String,
    /// Whether it adds to the lit part or takes from it.
    pub kind: ShapeKind,
    /// How it moves between its keys; linear where the file does not say.
    #[serde(default)]
    pub tween: Tween,
    /// The shape at 1..=256 angles, which strictly grow. All outlines are of one sort; paths have the same sequence of
    /// segments, where a line may become a curve.
    pub keys: Vec<ShapeKey>,
}

/// What a shape does to the lit part. Shapes work in the order of their list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum ShapeKind {
    /// Adds to what is lit.
    Light,
    /// Takes from what is lit.
    Shadow,
}

/// How the numbers of an outline move between two keys.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Tween {
    /// In a straight line with the angle.
    #[default]
    Linear,
    /// In a monotone cubic (PCHIP) over the angle: without a kink at a key, and never past the two keys' numbers.
    Smooth,
}

/// A shape's outline at an angle of the light: exactly one of `path`, `ellipse` and `polygon`.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ShapeKey {
    /// Angle of the light, degrees -180..=180.
    pub angle: f32,
    /// SVG path data of at most 4096 segments: the commands M, L, H, V, C, S, Q, T and Z, absolute or relative. Open
    /// subpaths are filled as if closed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub path: Option<String>,
    /// An ellipse.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ellipse: Option<Ellipse>,
    /// Corners of a closed polygon, 3..=4095 of them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub polygon: Option<Vec<[f32; 2]>>,
}

/// An ellipse in UV units.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Ellipse {
    /// Its middle.
    pub center: [f32; 2],
    /// Half its width and height before the turn, 0..=16.
    pub radii: [f32; 2],
    /// Turn round its middle, degrees -3600..=3600, clockwise on screen; 0 where the file does not say.
    #[serde(default)]
    pub turn_deg: f32,
}

/// A list of shapes whose keys have been checked and parsed once.
#[derive(Clone, Debug, Default)]
pub struct Drawing {
    tracks: Vec<Track>,
}

impl Drawing {
    /// Checks and parses shapes, at most 256.
    ///
    /// # Errors
    /// One line that names the shape, the angle of the key, what was found there and what was expected.
    pub fn new(shapes: &[Shape]) -> Result<Self, String> {
        if shapes.len() > MAX_SHAPES {
            return Err(format!("found {} shapes, expected at most {MAX_SHAPES}", shapes.len()));
        }
        Ok(Self { tracks: shapes.iter().map(Track::new).collect::<Result<_, _>>()? })
    }

    /// Whether there is no shape at any angle.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.tracks.is_empty()
    }

    /// Rows that [`Self::draw`] rasterises together in a mask of this width, texels: all of them up to 2048 x 2048. Bands
    /// that begin and end at multiples of it are drawn without waste.
    #[must_use]
    pub fn tile_rows(width: u32) -> u32 {
        (TILE_TEXELS / width.max(1)).max(1)
    }

    /// Draws over rows of a mask of `width` x `height` texels, up to 16384 x 16384, at an angle of the light in degrees.
    ///
    /// `coverage` holds the rows from `top` on, `width` bytes each, 0 dark to 255 lit, and is changed in place; what lies
    /// below the mask, or is no whole row, stays as it is. The bytes do not depend on how the mask is cut into bands.
    pub fn draw(&self, angle: f32, width: u32, height: u32, top: u32, coverage: &mut [u8]) {
        let row = width as usize;
        let rows = coverage.len().checked_div(row).and_then(|rows| u32::try_from(rows).ok()).unwrap_or(0);
        let end = top.saturating_add(rows).min(height);
        let outlines: Vec<_> = self.tracks.iter().filter_map(|t| Some((t.kind, t.at(angle)?))).collect();
        if top >= end || outlines.is_empty() {
            return;
        }
        // tiny-skia rounds a curve differently where it clips it, so that a texel depends on where the mask begins and
        // ends: those are always the same for a row, whatever rows are asked for.
        let tile_rows = Self::tile_rows(width).min(height);
        let Some(mut mask) = Mask::new(width, tile_rows) else { return };
        for tile in top / tile_rows..=(end - 1) / tile_rows {
            let tile_top = tile * tile_rows;
            let (first, last) = (tile_top.max(top), tile_top.saturating_add(tile_rows).min(end));
            let drawn = (first - tile_top) as usize * row..(last - tile_top) as usize * row;
            let band = &mut coverage[(first - top) as usize * row..(last - top) as usize * row];
            let to_tile = Transform::from_row(width as f32, 0.0, 0.0, height as f32, 0.0, -(tile_top as f32));
            for (kind, path) in &outlines {
                let [begin, end] = [path.bounds().top(), path.bounds().bottom()].map(|y| y * height as f32);
                if end < first as f32 - 1.0 || begin > last as f32 + 1.0 {
                    continue;
                }
                // Only these rows are read; the others may hold what earlier shapes left.
                mask.data_mut()[drawn.clone()].fill(0);
                mask.fill_path(path, FillRule::Winding, true, to_tile);
                for (c, a) in band.iter_mut().zip(&mask.data()[drawn.clone()]) {
                    *c = match kind {
                        ShapeKind::Light => 255 - times(255 - *c, 255 - a),
                        ShapeKind::Shadow => times(*c, 255 - a),
                    };
                }
            }
        }
    }
}

/// The product of two numbers that stand for 0..1, rounded.
fn times(a: u8, b: u8) -> u8 {
    ((u32::from(a) * u32::from(b) + 127) / 255) as u8
}

/// A shape ready to be tweened: each key a row of numbers that mean the same in all of them.
#[derive(Clone, Debug)]
struct Track {
    kind: ShapeKind,
    tween: Tween,
    form: Form,
    angles: Vec<f32>,
    numbers: Vec<Vec<f32>>,
}

/// What a track's numbers are.
#[derive(Clone, Debug)]
enum Form {
    /// Centre, radii and turn.
    Ellipse,
    /// The points of these segments.
    Path(Vec<Verb>),
}

/// A key's outline, checked.
enum Outline {
    Path(Vec<Segment>),
    Ellipse([f32; 5]),
    Polygon(Vec<Segment>),
}

impl Track {
    fn new(shape: &Shape) -> Result<Self, String> {
        let count = shape.keys.len();
        if !(1..=MAX_KEYS).contains(&count) {
            return Err(format!("shape {:?}: found {count} keys, expected 1..={MAX_KEYS}", shape.name));
        }
        let angles: Vec<f32> = shape.keys.iter().map(|key| key.angle).collect();
        let mut outlines = Vec::with_capacity(count);
        let mut verbs = Vec::new();
        for (i, key) in shape.keys.iter().enumerate() {
            let angle = key.angle;
            let fault = |what: String| format!("shape {:?}, key at {angle}°: {what}", shape.name);
            if !(-180.0..=180.0).contains(&angle) {
                return Err(fault("found an angle outside of the expected -180..=180".to_owned()));
            }
            if i > 0 && angle <= angles[i - 1] {
                let before = angles[i - 1];
                return Err(fault(format!("found it after the key at {before}°, expected angles that strictly grow")));
            }
            let outline = Outline::new(key).map_err(fault)?;
            if i == 0 {
                verbs = outline.segments().iter().map(|s| s.verb).collect();
            }
            outline
                .join(&mut verbs, outlines.first().unwrap_or(&outline))
                .map_err(|what| format!("shape {:?}, keys at {}° and {angle}°: {what}", shape.name, angles[0]))?;
            outlines.push(outline);
        }
        let numbers = outlines.iter().map(|outline| outline.numbers(&verbs)).collect();
        let form = match outlines.first() {
            Some(Outline::Ellipse(_)) => Form::Ellipse,
            _ => Form::Path(verbs),
        };
        Ok(Self { kind: shape.kind, tween: shape.tween, form, angles, numbers })
    }

    /// The outline at an angle; none where the shape is not there or has no area.
    fn at(&self, angle: f32) -> Option<Path> {
        let path = self.form.path(&self.numbers_at(angle)?)?;
        (path.bounds().width() > 0.0 && path.bounds().height() > 0.0).then_some(path)
    }

    fn numbers_at(&self, angle: f32) -> Option<Vec<f32>> {
        let after = self.angles.iter().position(|a| *a >= angle)?;
        if self.angles[after] == angle {
            return Some(self.numbers[after].clone());
        }
        let before = after.checked_sub(1)?;
        let t = (angle - self.angles[before]) / (self.angles[after] - self.angles[before]);
        let tween = |i: usize| {
            let (a, b) = (self.numbers[before][i], self.numbers[after][i]);
            match self.tween {
                Tween::Linear => a + (b - a) * t,
                Tween::Smooth => smooth(&self.angles, before, angle, |key| self.numbers[key][i]),
            }
        };
        Some((0..self.numbers[before].len()).map(tween).collect())
    }
}

/// The monotone cubic of Fritsch and Carlson with the slopes of Fritsch and Butland, between `before` and the key after.
fn smooth(angles: &[f32], before: usize, angle: f32, value: impl Fn(usize) -> f32) -> f32 {
    let step = |i: usize| f64::from(angles[i + 1]) - f64::from(angles[i]);
    let rise = |i: usize| (f64::from(value(i + 1)) - f64::from(value(i))) / step(i);
    // The slope of a parabola through an end and its two neighbours, held back where it would overshoot.
    let end = |near: usize, far: usize| {
        let (h0, h1, d0, d1) = (step(near), step(far), rise(near), rise(far));
        let slope = ((2.0 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
        if slope * d0 <= 0.0 {
            0.0
        } else if d0 * d1 <= 0.0 && slope.abs() > 3.0 * d0.abs() {
            3.0 * d0
        } else {
            slope
        }
    };
    let slope = |i: usize| match (i, angles.len() - 1) {
        (_, 1) => rise(0),
        (0, _) => end(0, 1),
        (i, last) if i == last => end(i - 1, i - 2),
        (i, _) if rise(i - 1) * rise(i) <= 0.0 => 0.0,
        (i, _) => {
            let (w0, w1) = (2.0 * step(i) + step(i - 1), step(i) + 2.0 * step(i - 1));
            (w0 + w1) / (w0 / rise(i - 1) + w1 / rise(i))
        }
    };
    let (a, b) = (value(before), value(before + 1));
    let h = step(before);
    let t = (f64::from(angle) - f64::from(angles[before])) / h;
    let s = 1.0 - t;
    let y = f64::from(a) * s * s * (1.0 + 2.0 * t)
        + f64::from(b) * t * t * (1.0 + 2.0 * s)
        + h * s * t * (slope(before) * s - slope(before + 1) * t);
    (y as f32).clamp(a.min(b), a.max(b))
}

impl Form {
    fn path(&self, numbers: &[f32]) -> Option<Path> {
        let mut builder = PathBuilder::new();
        match self {
            Self::Ellipse => {
                let [x, y, rx, ry, turn] = *numbers.first_chunk()?;
                let (sin, cos) = turn.to_radians().sin_cos();
                let to = |u: f32, v: f32| (x + rx * u * cos - ry * v * sin, y + rx * u * sin + ry * v * cos);
                let (x0, y0) = to(1.0, 0.0);
                builder.move_to(x0, y0);
                for (c, s) in [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)] {
                    let (x1, y1) = to(c - KAPPA * s, s + KAPPA * c);
                    let (x2, y2) = to(KAPPA * c - s, KAPPA * s + c);
                    let (x3, y3) = to(-s, c);
                    builder.cubic_to(x1, y1, x2, y2, x3, y3);
                }
                builder.close();
            }
            Self::Path(verbs) => {
                let mut points = numbers.as_chunks().0.iter();
                for verb in verbs {
                    match verb {
                        Verb::Close => builder.close(),
                        Verb::Move => {
                            let [x, y] = *points.next()?;
                            builder.move_to(x, y);
                        }
                        Verb::Line => {
                            let [x, y] = *points.next()?;
                            builder.line_to(x, y);
                        }
                        Verb::Curve => {
                            let ([x1, y1], [x2, y2], [x, y]) = (*points.next()?, *points.next()?, *points.next()?);
                            builder.cubic_to(x1, y1, x2, y2, x, y);
                        }
                    }
                }
            }
        }
        builder.finish()
    }
}

impl Outline {
    fn new(key: &ShapeKey) -> Result<Self, String> {
        match (&key.path, &key.ellipse, &key.polygon) {
            (Some(path), None, None) => segments(path).map(Self::Path).map_err(|what| format!("path: {what}")),
            (None, Some(ellipse), None) => {
                let Ellipse { center: [x, y], radii: [rx, ry], turn_deg } = *ellipse;
                let fault =
                    |what, found, least, most| Err(format!("ellipse: found {what} {found}, expected {least}..={most}"));
                if let Some(bad) = [x, y].into_iter().find(|n| outside(*n)) {
                    return fault("the coordinate", bad, -MAX_COORDINATE, MAX_COORDINATE);
                }
                if let Some(bad) = [rx, ry].into_iter().find(|n| outside(*n) || *n < 0.0) {
                    return fault("the radius", bad, 0.0, MAX_COORDINATE);
                }
                if !(-MAX_TURN..=MAX_TURN).contains(&turn_deg) {
                    return fault("the turn", turn_deg, -MAX_TURN, MAX_TURN);
                }
                Ok(Self::Ellipse([x, y, rx, ry, turn_deg]))
            }
            (None, None, Some(points)) => {
                // A move for the first corner, a line to each of the others, a close: one segment more than corners.
                if !(3..MAX_SEGMENTS).contains(&points.len()) {
                    let most = MAX_SEGMENTS - 1;
                    return Err(format!("polygon: found {} points, expected 3..={most}", points.len()));
                }
                if let Some(bad) = points.as_flattened().iter().find(|n| outside(**n)) {
                    return Err(format!("polygon: {}", too_far(*bad)));
                }
                let corner = |(i, to): (usize, &Point)| Segment {
                    verb: if i == 0 { Verb::Move } else { Verb::Line },
                    points: [*to; 3],
                };
                let close = Segment { verb: Verb::Close, points: [points[0]; 3] };
                Ok(Self::Polygon(points.iter().enumerate().map(corner).chain([close]).collect()))
            }
            (path, ellipse, polygon) => {
                let given = [("path", path.is_some()), ("ellipse", ellipse.is_some()), ("polygon", polygon.is_some())];
                let given: Vec<_> = given.iter().filter(|(_, given)| *given).map(|(name, _)| *name).collect();
                let found = if given.is_empty() {
                    "none".to_owned()
                } else {
                    given.join(" and ")
                };
                Err(format!("found {found}, expected exactly one of path, ellipse and polygon"))
            }
        }
    }

    fn sort(&self) -> &'static str {
        match self {
            Self::Path(_) => "a path",
            Self::Ellipse(_) => "an ellipse",
            Self::Polygon(_) => "a polygon",
        }
    }

    fn segments(&self) -> &[Segment] {
        match self {
            Self::Path(segments) | Self::Polygon(segments) => segments,
            Self::Ellipse(_) => &[],
        }
    }

    /// Checks that the outline can be tweened with its shape's first; lines of `verbs` that it bends become curves.
    fn join(&self, verbs: &mut [Verb], first: &Self) -> Result<(), String> {
        if self.sort() != first.sort() {
            return Err(format!("found {} and {}, expected outlines of one sort", first.sort(), self.sort()));
        }
        let (own, first) = (self.segments(), first.segments());
        for i in 0..own.len().max(first.len()) {
            match (verbs.get(i).copied(), own.get(i).map(|s| s.verb)) {
                (Some(Verb::Line), Some(Verb::Curve)) => verbs[i] = Verb::Curve,
                (Some(Verb::Curve), Some(Verb::Line)) => {}
                (a, b) if a == b => {}
                (_, b) => {
                    let (a, b) = (name(first.get(i).map(|s| s.verb)), name(b));
                    return Err(format!("segment {} is {a} and {b}, expected the same sequence of segments", i + 1));
                }
            }
        }
        Ok(())
    }

    fn numbers(&self, verbs: &[Verb]) -> Vec<f32> {
        if let Self::Ellipse(numbers) = self {
            return numbers.to_vec();
        }
        let mut points = Vec::new();
        for (segment, verb) in self.segments().iter().zip(verbs) {
            match verb {
                Verb::Move | Verb::Line => points.push(segment.points[2]),
                Verb::Curve => points.extend(segment.points),
                Verb::Close => {}
            }
        }
        points.into_flattened()
    }
}

fn name(verb: Option<Verb>) -> &'static str {
    match verb {
        Some(Verb::Move) => "a move (M)",
        Some(Verb::Line) => "a line",
        Some(Verb::Curve) => "a curve",
        Some(Verb::Close) => "a close (Z)",
        None => "nothing",
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[derive(Deserialize)]
    struct Document {
        shape: Vec<Shape>,
    }

    fn face() -> Document {
        toml::from_str(hikage_character::head::sdf::SOURCE).unwrap()
    }

    fn shapes(toml: &str) -> Vec<Shape> {
        toml::from_str::<Document>(toml).unwrap().shape
    }

    /// A shape of light, named "a".
    fn light(keys: &str) -> Vec<Shape> {
        shapes(&format!("[[shape]]\nname = \"a\"\nkind = \"light\"\nkeys = [{keys}]"))
    }

    fn fault(keys: &str) -> String {
        let fault = Drawing::new(&light(keys)).unwrap_err();
        assert!(!fault.contains('\n'));
        fault
    }

    fn draw(shapes: &[Shape], angle: f32, size: u32, band: u32) -> Vec<u8> {
        let drawing = Drawing::new(shapes).unwrap();
        let mut coverage = vec![0; (size * size) as usize];
        for (i, rows) in coverage.chunks_mut((size * band) as usize).enumerate() {
            drawing.draw(angle, size, size, i as u32 * band, rows);
        }
        coverage
    }

    /// Lit part of the mask, 0..=1.
    fn area(keys: &str) -> f64 {
        let sum: u64 = draw(&light(keys), 0.0, 256, 256).iter().map(|c| u64::from(*c)).sum();
        sum as f64 / (255.0 * 256.0 * 256.0)
    }

    fn near(a: f64, b: f64) {
        assert!((a / b - 1.0).abs() < 0.005, "{a} is not near {b}");
    }

    #[test]
    fn faults_of_keys() {
        assert_eq!(fault(""), "shape \"a\": found 0 keys, expected 1..=256");
        assert_eq!(
            fault("{ angle = 5 }"),
            "shape \"a\", key at 5°: found none, expected exactly one of path, ellipse and polygon"
        );
        assert!(fault("{ angle = 5, path = '', polygon = [] }").contains("found path and polygon"));
        assert!(fault("{ angle = 5, path = '' }, { angle = 5, path = '' }").contains("found it after the key at 5°"));
        for angle in ["nan", "inf", "-180.1", "1e9"] {
            assert!(fault(&format!("{{ angle = {angle}, path = '' }}")).contains("expected -180..=180"));
        }
        assert_eq!(
            fault("{ angle = 5, path = 'M' }"),
            "shape \"a\", key at 5°: path: found its end, expected a number for M"
        );
        assert_eq!(
            fault("{ angle = 5, polygon = [[0, 0], [1, 1]] }"),
            "shape \"a\", key at 5°: polygon: found 2 points, expected 3..=4095"
        );
        assert!(fault("{ angle = 5, polygon = [[0, 0], [1, nan], [1, 1]] }").contains("found the coordinate NaN"));
        let ellipse = |rest: &str| fault(&format!("{{ angle = 5, ellipse = {{ {rest} }} }}"));
        assert!(ellipse("center = [0, 17], radii = [1, 1]").contains("found the coordinate 17, expected -16..=16"));
        assert!(ellipse("center = [0, 0], radii = [1, -1]").contains("found the radius -1, expected 0..=16"));
        assert!(ellipse("center = [0, 0], radii = [1, inf]").contains("found the radius inf"));
        assert!(ellipse("center = [0, 0], radii = [1, 1], turn_deg = nan").contains("found the turn NaN"));
        assert_eq!(
            fault("{ angle = 5, path = '' }, { angle = 9, polygon = [[0, 0], [1, 0], [1, 1]] }"),
            "shape \"a\", keys at 5° and 9°: found a path and a polygon, expected outlines of one sort"
        );
        let pair = |a: &str, b: &str| fault(&format!("{{ angle = 5, path = '{a}' }}, {{ angle = 9, path = '{b}' }}"));
        assert_eq!(
            pair("M0 0 L1 1 Z", "M0 0 Z"),
            "shape \"a\", keys at 5° and 9°: segment 2 is a line and a close (Z), expected the same sequence of segments"
        );
        assert!(pair("M0 0", "M0 0 h1").contains("segment 2 is nothing and a line"));
        assert!(pair("M0 0 h1", "M0 0").contains("segment 2 is a line and nothing"));
        let many = vec![light("{ angle = 0, path = '' }").remove(0); 257];
        assert_eq!(Drawing::new(&many).unwrap_err(), "found 257 shapes, expected at most 256");
        let keys: String = (0..257).map(|i| format!("{{ angle = {}, path = '' }},", i as f32 / 2.0)).collect();
        assert!(fault(&keys).contains("found 257 keys, expected 1..=256"));
    }

    #[test]
    fn files() {
        let toml = "[[shape]]\nname = 'a'\nkind = 'shadow'\ntween = 'smooth'\nkeys = \
            [{ angle = 1, ellipse = { center = [0.5, 0.5], radii = [0.25, 1] } }]";
        let read = shapes(toml);
        assert_eq!((read[0].kind, read[0].tween), (ShapeKind::Shadow, Tween::Smooth));
        assert_eq!(toml::from_str::<Shape>(&toml::to_string(&read[0]).unwrap()).unwrap(), read[0]);
        let unknown = format!("keys = []\n{}", toml.replace("angle", "extra = 1, angle"));
        assert!(toml::from_str::<Document>(&unknown).is_err());
        assert!(Drawing::new(&[]).unwrap().is_empty());
        assert!(!Drawing::new(&read).unwrap().is_empty());
    }

    #[test]
    fn areas() {
        use std::f64::consts::PI;
        near(area("{ angle = 0, ellipse = { center = [0.5, 0.4], radii = [0.2, 0.3] } }"), PI * 0.06);
        near(area("{ angle = 0, ellipse = { center = [0.5, 0.4], radii = [0.3, 0.1], turn_deg = 30 } }"), PI * 0.03);
        near(area("{ angle = 0, polygon = [[0.1, 0.1], [0.9, 0.1], [0.1, 0.6]] }"), 0.2);
        near(area("{ angle = 0, path = 'M .1.1 .9.1 .1.6' }"), 0.2);
        assert_eq!(area("{ angle = 1, polygon = [[0.1, 0.1], [0.9, 0.1], [0.1, 0.6]] }"), 0.0);
        assert_eq!(area("{ angle = 0, polygon = [[0.5, 0.5], [0.5, 0.5], [0.5, 0.5]] }"), 0.0);
        assert_eq!(area("{ angle = 0, ellipse = { center = [0.5, 0.5], radii = [0, 0.2] } }"), 0.0);
        assert_eq!(area("{ angle = 0, path = '' }, { angle = 1, path = '' }"), 0.0);
        // A quarter turn stands it up; an eighth, clockwise on screen, points its right end down.
        let turned = |turn: f32| {
            let keys =
                format!("{{ angle = 0, ellipse = {{ center = [0.5, 0.5], radii = [0.4, 0.1], turn_deg = {turn} }} }}");
            draw(&light(&keys), 0.0, 64, 64)
        };
        assert_eq!((turned(90.0)[10 * 64 + 32], turned(90.0)[32 * 64 + 10]), (255, 0));
        assert_eq!((turned(45.0)[48 * 64 + 48], turned(45.0)[16 * 64 + 48]), (255, 0));
    }

    #[test]
    fn order() {
        let shape = |kind: &str, x: f32| {
            let points = format!("[{x}, 0], [{}, 0], [{}, 1], [{x}, 1]", x + 0.5, x + 0.5);
            shapes(&format!("[[shape]]\nname=''\nkind='{kind}'\nkeys=[{{ angle = 0, polygon = [{points}] }}]"))
                .remove(0)
        };
        let (a, b, c) = (shape("light", 0.0), shape("shadow", 0.25), shape("light", 0.375));
        let row = |shapes: &[Shape]| draw(shapes, 0.0, 8, 8)[..8].iter().map(|c| *c / 255).collect::<Vec<_>>();
        assert_eq!(row(&[a.clone(), b.clone(), c.clone()]), [1, 1, 0, 1, 1, 1, 1, 0]);
        assert_eq!(row(&[a, c, b]), [1, 1, 0, 0, 0, 0, 1, 0]);
        for (a, b, product) in [(255, 255, 255), (255, 7, 7), (128, 128, 64), (0, 255, 0), (3, 100, 1)] {
            assert_eq!(times(a, b), product);
        }
    }

    #[test]
    fn tweens() {
        let angles = [0.0, 10.0, 15.0, 40.0, 50.0, 60.0];
        let heights = [0.1, 0.2, 0.9, 0.9, 0.3, 0.35];
        let key =
            |(a, y): (&f32, &f32)| format!("{{ angle = {a}, ellipse = {{ center = [0, {y}], radii = [1, 1] }} }}");
        let keys: Vec<_> = angles.iter().zip(&heights).map(key).collect();
        let mut shape = light(&keys.join(",")).remove(0);
        for tween in [Tween::Linear, Tween::Smooth] {
            shape.tween = tween;
            let track = Track::new(&shape).unwrap();
            let y = |angle: f32| track.numbers_at(angle).unwrap()[1];
            for (i, pair) in angles.windows(2).enumerate() {
                assert_eq!((y(pair[0]), y(pair[1])), (heights[i], heights[i + 1]));
                let sign = (heights[i + 1] - heights[i]).signum();
                let samples: Vec<f32> =
                    (0..=100).map(|k| y(pair[0] + (pair[1] - pair[0]) * k as f32 / 100.0)).collect();
                assert!(samples.windows(2).all(|s| (s[1] - s[0]) * sign >= -1e-6), "not monotone after {}", pair[0]);
                assert!(samples.iter().all(|s| (*s - heights[i]) * (*s - heights[i + 1]) <= 0.0));
            }
            let kink = |angle: f32| ((y(angle + 0.05) - y(angle)) - (y(angle) - y(angle - 0.05))).abs() / 0.05;
            let worst = angles[1..5].iter().map(|a| kink(*a)).fold(0.0, f32::max);
            assert!(
                if tween == Tween::Smooth {
                    worst < 0.01
                } else {
                    worst > 0.1
                },
                "{tween:?} {worst}"
            );
            assert!([-0.01, 60.01, f32::NAN, f32::INFINITY].iter().all(|a| track.numbers_at(*a).is_none()));
        }
        assert_eq!(Track::new(&shape).unwrap().numbers_at(12.5).unwrap()[2], 1.0);
        // Two keys are a straight line, and a line bends into a curve.
        let keys = "{ angle = 0, path = 'M 0 0 L 3 0' }, { angle = 10, path = 'M 0 0 C 1 3 2 3 3 0' }";
        let mut shape = light(keys).remove(0);
        for tween in [Tween::Linear, Tween::Smooth] {
            shape.tween = tween;
            let track = Track::new(&shape).unwrap();
            assert_eq!(track.numbers_at(0.0).unwrap(), [0.0, 0.0, 1.0, 0.0, 2.0, 0.0, 3.0, 0.0]);
            assert_eq!(track.numbers_at(5.0).unwrap(), [0.0, 0.0, 1.0, 1.5, 2.0, 1.5, 3.0, 0.0]);
        }
    }

    #[test]
    fn bands() {
        let face = face();
        for angle in [0.0, 22.0, 45.0, 66.0, 79.0, 95.0, 130.0] {
            let whole = draw(&face.shape, angle, 512, 512);
            assert!(draw(&face.shape, angle, 512, 64) == whole, "bands of 64 at {angle}°");
            assert!(draw(&face.shape, angle, 512, 7) == whole, "bands of 7 at {angle}°");
        }
    }

    /// A mask that is drawn in several tiles.
    #[test]
    fn bands_of_a_wide_mask() {
        let drawing = Drawing::new(&face().shape).unwrap();
        let (width, height, top, rows) = (16384, 16384, 8100, 200);
        assert!(top / Drawing::tile_rows(width) != (top + rows) / Drawing::tile_rows(width));
        let mut whole = vec![0; (width * rows) as usize];
        drawing.draw(66.0, width, height, top, &mut whole);
        assert!(whole.contains(&0) && whole.contains(&255));
        let mut bands = vec![0; whole.len()];
        for (i, band) in bands.chunks_mut((width * 67) as usize).enumerate() {
            drawing.draw(66.0, width, height, top + i as u32 * 67, band);
        }
        assert!(whole == bands);
    }

    #[test]
    fn far_and_odd() {
        let far = "{ angle = 0, ellipse = { center = [0, 0], radii = [16, 16] } }";
        let drawing = Drawing::new(&light(far)).unwrap();
        for top in [0, 1000, 16383] {
            let mut coverage = vec![0; 16384];
            drawing.draw(0.0, 16384, 16384, top, &mut coverage);
            assert!(coverage.iter().all(|c| *c == 255), "row {top}");
        }
        let corner = "{ angle = 0, polygon = [[-16, -16], [16, -15], [-15, 16]] }";
        let mut coverage = vec![0; 16384];
        Drawing::new(&light(corner)).unwrap().draw(0.0, 16384, 16384, 4, &mut coverage);
        let lit = coverage.iter().filter(|c| **c > 127).count();
        assert!((16378..=16381).contains(&lit), "{lit}");
        for (width, height, top, len) in [(0, 8, 0, 8), (8, 0, 0, 8), (8, 8, 8, 8), (8, 8, u32::MAX, 8), (8, 8, 0, 7)] {
            let mut coverage = vec![9; len];
            drawing.draw(0.0, width, height, top, &mut coverage);
            assert_eq!(coverage, vec![9; len]);
        }
        let mut coverage = vec![0; 20];
        drawing.draw(0.0, 4, 6, 2, &mut coverage);
        assert_eq!(coverage, [[255; 16].as_slice(), &[0; 4]].concat());
        for size in [1 << 20, u32::MAX] {
            drawing.draw(0.0, 1, size, size - 2, &mut [0; 9]);
        }
    }

    proptest! {
        #[test]
        fn any_path(text in "\\PC*", path in "[MmLlHhVvCcSsQqTtZzAa0-9eE+., -]{0,64}") {
            for path in [text, format!("M0 0{path}")] {
                let key = ShapeKey { path: Some(path), ..ShapeKey::default() };
                let shape = Shape { name: String::new(), kind: ShapeKind::Light, tween: Tween::Linear, keys: vec![key] };
                match Drawing::new(&[shape]) {
                    Ok(drawing) => drawing.draw(0.0, 16, 16, 3, &mut [0; 64]),
                    Err(fault) => prop_assert!(fault.contains("expected") && !fault.contains('\n')),
                }
            }
        }

        #[test]
        fn any_curve(numbers in prop::collection::vec(-16.0f32..=16.0, 26), size in 1u32..20000, row in 0.0f32..1.0) {
            let path = format!("M{} {} C{:?} Z", numbers[0], numbers[1], &numbers[2..]).replace(['[', ']'], " ");
            let key = ShapeKey { path: Some(path), ..ShapeKey::default() };
            let shape = Shape { name: String::new(), kind: ShapeKind::Light, tween: Tween::Linear, keys: vec![key] };
            let mut rows = vec![0; size as usize * 3];
            Drawing::new(&[shape]).unwrap().draw(0.0, size, size, (size as f32 * row) as u32, &mut rows);
        }
    }
}
