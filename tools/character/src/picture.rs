//! Pictures for textures: painted with tiny-skia or per pixel, written as PNG.

use glam::{Vec2, Vec3};
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder as _};
use rayon::prelude::*;
use tiny_skia::{
    BlendMode, Color, FillRule, GradientStop, LinearGradient, Paint, Path, PathBuilder, Pixmap, Point,
    PremultipliedColorU8, RadialGradient, Shader, SpreadMode, Stroke, Transform,
};

/// An RGBA picture of 8 bits, straight alpha, rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Width, pixels.
    pub width: u32,
    /// Height, pixels.
    pub height: u32,
    /// Pixels.
    pub rgba: Vec<[u8; 4]>,
}

impl Picture {
    /// Evaluates a function at the centre of each pixel; it takes UVs and gives sRGB colour and alpha, 0..1.
    #[must_use]
    pub fn from_fn(width: u32, height: u32, f: impl Fn(Vec2) -> [f32; 4] + Sync) -> Self {
        let size = Vec2::new(width as f32, height as f32);
        let rgba = (0..height)
            .into_par_iter()
            .flat_map_iter(|y| {
                let f = &f;
                (0..width).map(move |x| {
                    f((Vec2::new(x as f32, y as f32) + 0.5) / size).map(|c| (c.clamp(0.0, 1.0) * 255.0 + 0.5) as u8)
                })
            })
            .collect();
        Self { width, height, rgba }
    }

    /// Takes over what tiny-skia painted.
    #[must_use]
    pub fn from_pixmap(pixmap: &Pixmap) -> Self {
        let straight = |p: &PremultipliedColorU8| {
            let c = p.demultiply();
            [c.red(), c.green(), c.blue(), c.alpha()]
        };
        Self { width: pixmap.width(), height: pixmap.height(), rgba: pixmap.pixels().iter().map(straight).collect() }
    }

    /// Changes each pixel: UVs and colour in, colour out, 0..1.
    pub fn map(&mut self, f: impl Fn(Vec2, [f32; 4]) -> [f32; 4] + Sync) {
        let (width, size) = (self.width as usize, Vec2::new(self.width as f32, self.height as f32));
        self.rgba.par_chunks_mut(width).enumerate().for_each(|(y, row)| {
            for (x, pixel) in row.iter_mut().enumerate() {
                let uv = (Vec2::new(x as f32, y as f32) + 0.5) / size;
                *pixel = f(uv, pixel.map(|c| f32::from(c) / 255.0)).map(|c| (c.clamp(0.0, 1.0) * 255.0 + 0.5) as u8);
            }
        });
    }

    /// The PNG file: RGB where every pixel is opaque.
    ///
    /// # Panics
    /// Never: the buffer has the size that is stated.
    #[must_use]
    pub fn png(&self) -> Vec<u8> {
        let mut png = Vec::new();
        let encoder = PngEncoder::new_with_quality(&mut png, CompressionType::Fast, FilterType::Adaptive);
        if self.rgba.iter().all(|p| p[3] == 255) {
            let rgb: Vec<u8> = self.rgba.iter().flat_map(|p| [p[0], p[1], p[2]]).collect();
            encoder.write_image(&rgb, self.width, self.height, ExtendedColorType::Rgb8)
        } else {
            encoder.write_image(self.rgba.as_flattened(), self.width, self.height, ExtendedColorType::Rgba8)
        }
        .expect("the buffer has the stated size");
        png
    }
}

/// A map of part numbers in the red channel: 1, and the number of each shape inside it. Its edges are hard, because
/// numbers do not mix.
#[must_use]
pub fn part_ids(shapes: &[(Path, u8)]) -> Picture {
    const SIZE: u32 = 512;
    let mut c = Canvas::new(SIZE, SIZE, Some(0x010000));
    for (path, number) in shapes {
        let paint = Paint {
            shader: Shader::SolidColor(Color::from_rgba8(*number, 0, 0, 255)),
            anti_alias: false,
            ..Paint::default()
        };
        c.pixmap.fill_path(path, &paint, FillRule::Winding, c.scale, None);
    }
    c.finish()
}

/// A canvas in UV units: (0, 0) upper left, (1, 1) lower right, whatever the size in pixels. Colours are sRGB
/// `0xRRGGBB`; widths are UV units of the picture's width.
pub struct Canvas {
    pixmap: Pixmap,
    scale: Transform,
}

impl Canvas {
    /// A canvas of one colour; `None` for a transparent one.
    ///
    /// # Panics
    /// Where a side is 0.
    #[must_use]
    pub fn new(width: u32, height: u32, color: Option<u32>) -> Self {
        let mut pixmap = Pixmap::new(width, height).expect("a canvas has pixels");
        if let Some(hex) = color {
            pixmap.fill(skia_color(hex, 1.0));
        }
        Self { pixmap, scale: Transform::from_scale(width as f32, height as f32) }
    }

    fn draw(&mut self, path: &Path, shader: Shader<'_>, stroke: Option<&Stroke>, mode: BlendMode) {
        let paint = Paint { shader, anti_alias: true, blend_mode: mode, ..Paint::default() };
        match stroke {
            Some(stroke) => self.pixmap.stroke_path(path, &paint, stroke, self.scale, None),
            None => self.pixmap.fill_path(path, &paint, FillRule::Winding, self.scale, None),
        }
    }

    /// Fills a path.
    pub fn fill(&mut self, path: &Path, hex: u32, alpha: f32) {
        self.draw(path, Shader::SolidColor(skia_color(hex, alpha)), None, BlendMode::SourceOver);
    }

    /// Strokes a path with round ends.
    pub fn stroke(&mut self, path: &Path, hex: u32, alpha: f32, width: f32) {
        let stroke = Stroke {
            width,
            line_cap: tiny_skia::LineCap::Round,
            line_join: tiny_skia::LineJoin::Round,
            ..Stroke::default()
        };
        self.draw(path, Shader::SolidColor(skia_color(hex, alpha)), Some(&stroke), BlendMode::SourceOver);
    }

    /// Fills a path with a gradient from `a` to `b`; stops are position, colour, alpha.
    pub fn linear(&mut self, path: &Path, a: Vec2, b: Vec2, stops: &[(f32, u32, f32)]) {
        let gradient =
            LinearGradient::new(point(a), point(b), skia_stops(stops), SpreadMode::Pad, Transform::identity());
        if let Some(shader) = gradient {
            self.draw(path, shader, None, BlendMode::SourceOver);
        }
    }

    /// Fills a path with a gradient round `center`.
    pub fn radial(&mut self, path: &Path, center: Vec2, radius: f32, stops: &[(f32, u32, f32)]) {
        let c = point(center);
        let gradient =
            RadialGradient::new(c, 0.0, c, radius, skia_stops(stops), SpreadMode::Pad, Transform::identity());
        if let Some(shader) = gradient {
            self.draw(path, shader, None, BlendMode::SourceOver);
        }
    }

    /// A soft round spot, full in the middle.
    pub fn glow(&mut self, center: Vec2, radii: Vec2, hex: u32, alpha: f32) {
        let stops = [(0.0, hex, alpha), (0.35, hex, alpha * 0.72), (0.7, hex, alpha * 0.2), (1.0, hex, 0.0)];
        let squeeze =
            Transform::from_row(1.0, 0.0, 0.0, radii.y / radii.x, 0.0, center.y - center.y * radii.y / radii.x);
        let c = point(center);
        let gradient = RadialGradient::new(c, 0.0, c, radii.x, skia_stops(&stops), SpreadMode::Pad, squeeze);
        if let Some(shader) = gradient {
            self.draw(&ellipse(center, radii), shader, None, BlendMode::SourceOver);
        }
    }

    /// The finished picture.
    #[must_use]
    pub fn finish(self) -> Picture {
        Picture::from_pixmap(&self.pixmap)
    }
}

/// An ellipse.
///
/// # Panics
/// Where a radius is not positive.
#[must_use]
pub fn ellipse(center: Vec2, radii: Vec2) -> Path {
    let rect =
        tiny_skia::Rect::from_ltrb(center.x - radii.x, center.y - radii.y, center.x + radii.x, center.y + radii.y);
    PathBuilder::from_oval(rect.expect("radii are positive")).expect("an ellipse is a path")
}

/// A closed polygon, or an open line, through points.
///
/// # Panics
/// With fewer than two points.
#[must_use]
pub fn polyline(points: &[Vec2], closed: bool) -> Path {
    let mut builder = PathBuilder::new();
    for (i, p) in points.iter().enumerate() {
        if i == 0 {
            builder.move_to(p.x, p.y);
        } else {
            builder.line_to(p.x, p.y);
        }
    }
    if closed {
        builder.close();
    }
    builder.finish().expect("two points or more")
}

/// A smooth closed or open curve through points (Catmull-Rom).
#[must_use]
pub fn curve(points: &[Vec2], closed: bool) -> Path {
    const STEPS: usize = 12;
    let n = points.len();
    let at = |i: isize| {
        let i = if closed {
            i.rem_euclid(n as isize)
        } else {
            i.clamp(0, n as isize - 1)
        };
        points[i as usize]
    };
    let mut dense = Vec::new();
    for i in 0..if closed { n } else { n - 1 } {
        let i = i as isize;
        for s in 0..STEPS {
            dense.push(catmull_rom(at(i - 1), at(i), at(i + 1), at(i + 2), s as f32 / STEPS as f32));
        }
    }
    if !closed {
        dense.push(points[n - 1]);
    }
    polyline(&dense, closed)
}

/// Point of the uniform Catmull-Rom curve between `b` and `c`.
#[must_use]
pub fn catmull_rom(a: Vec2, b: Vec2, c: Vec2, d: Vec2, t: f32) -> Vec2 {
    0.5 * (2.0 * b + (c - a) * t + (2.0 * a - 5.0 * b + 4.0 * c - d) * t * t + (3.0 * b - a - 3.0 * c + d) * t * t * t)
}

fn point(p: Vec2) -> Point {
    Point::from_xy(p.x, p.y)
}

fn skia_color(hex: u32, alpha: f32) -> Color {
    let [_, r, g, b] = hex.to_be_bytes();
    Color::from_rgba8(r, g, b, (alpha.clamp(0.0, 1.0) * 255.0 + 0.5) as u8)
}

fn skia_stops(stops: &[(f32, u32, f32)]) -> Vec<GradientStop> {
    stops.iter().map(|(at, hex, alpha)| GradientStop::new(*at, skia_color(*hex, *alpha))).collect()
}

/// sRGB colour 0..1 of `0xRRGGBB`.
#[must_use]
pub fn rgb(hex: u32) -> Vec3 {
    let [_, r, g, b] = hex.to_be_bytes();
    Vec3::new(f32::from(r), f32::from(g), f32::from(b)) / 255.0
}

/// Smooth value noise in 0..1 that repeats every `period` cells in x and y.
#[must_use]
pub fn noise(p: Vec2, period: [i32; 2], seed: u32) -> f32 {
    let cell = p.floor();
    let f = p - cell;
    let s = f * f * (3.0 - 2.0 * f);
    let corner = |dx: i32, dy: i32| {
        let x = (cell.x as i32 + dx).rem_euclid(period[0]) as u32;
        let y = (cell.y as i32 + dy).rem_euclid(period[1]) as u32;
        hash(x, y, seed)
    };
    let top = corner(0, 0) + (corner(1, 0) - corner(0, 0)) * s.x;
    let bottom = corner(0, 1) + (corner(1, 1) - corner(0, 1)) * s.x;
    top + (bottom - top) * s.y
}

/// A number in 0..1 that depends on all three in no visible way.
#[must_use]
pub fn hash(x: u32, y: u32, seed: u32) -> f32 {
    let mut h = x.wrapping_mul(0x9E37_79B1) ^ y.wrapping_mul(0x85EB_CA77) ^ seed.wrapping_mul(0xC2B2_AE3D);
    h = (h ^ (h >> 15)).wrapping_mul(0x2C1B_3C6D);
    h = (h ^ (h >> 12)).wrapping_mul(0x297A_2D39);
    ((h ^ (h >> 15)) >> 8) as f32 / 16_777_216.0
}

/// 0 below `a`, 1 above `b`, smooth between.
#[must_use]
pub fn smoothstep(a: f32, b: f32, x: f32) -> f32 {
    let t = ((x - a) / (b - a)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
