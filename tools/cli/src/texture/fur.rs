//! `hikage texture fur`: strands of painted fur that repeat without a seam.

use std::f32::consts::TAU;
use std::path::PathBuf;

use glam::{Vec2, Vec3};
use hikage::color::Srgb;
use hikage::picture::write_png;
use hikage::scene::Image;
use tiny_skia::{
    Color, FillRule, GradientStop, LinearGradient, Paint, Path, PathBuilder, Pixmap, Point, Shader, SpreadMode, Stroke,
    Transform,
};

use crate::args;
use crate::failure::Failure;
use crate::output::{make_folder, print};

/// Arguments of `hikage texture fur`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Folder for fur.png (sRGB) and fur_normal.png (linear, +Y up).
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Side of the maps, texels.
    #[arg(long, value_name = "TEXELS", default_value_t = 1024, value_parser = clap::value_parser!(u32).range(64..=4096))]
    size: u32,
    /// Strands along a side; their square is painted.
    #[arg(long, value_name = "N", default_value_t = 36, value_parser = clap::value_parser!(u32).range(4..=128))]
    density: u32,
    /// Mean length of a strand, share of the side.
    #[arg(long, value_name = "0.02..0.5", default_value = "0.14", value_parser = length)]
    length: f32,
    /// Where strands point: 0 to the right, 90 down.
    #[arg(long, value_name = "DEG", default_value = "90", allow_hyphen_values = true, value_parser = args::yaw)]
    flow: f32,
    /// How far strands leave the flow and bend.
    #[arg(long, value_name = "0..1", default_value = "0.35", value_parser = args::share)]
    curl: f32,
    /// Another number, another fur.
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u32,
    /// Colour at the root.
    #[arg(long, value_name = "#RRGGBB", default_value = "#d9c9de", value_parser = color)]
    root: Srgb,
    /// Colour at the tip.
    #[arg(long, value_name = "#RRGGBB", default_value = "#fffaf6", value_parser = color)]
    tip: Srgb,
    /// Colour of the lines between strands.
    #[arg(long, value_name = "#RRGGBB", default_value = "#b9a3c6", value_parser = color)]
    line: Srgb,
}

fn length(text: &str) -> Result<f32, String> {
    let found = text.trim().parse().ok().filter(|l| (0.02..=0.5).contains(l));
    found.ok_or_else(|| "expected a number from 0.02 to 0.5".into())
}

fn color(text: &str) -> Result<Srgb, String> {
    Srgb::from_hex(text).ok_or_else(|| "expected a colour, as #d9c9de".into())
}

pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    make_folder(&args.output)?;
    let [colors, normals] = paint(args);
    let names = ["fur.png", "fur_normal.png"].map(|name| args.output.join(name));
    write_png(&names[0], &colors)?;
    write_png(&names[1], &normals)?;
    print(&format!(
        "{}, {}: sections fur_detail.detail_color and fur_detail.detail_normal of a look file\n",
        names[0].display(),
        names[1].display()
    ))
}

/// Steps along a strand.
const STEPS: usize = 10;
/// Width of a strand at its widest, share of its length.
const WIDTH: f32 = 0.2;
/// How steeply a strand falls off to its sides, and rises towards its tip.
const ROUND: f32 = 0.85;
const RISE: f32 = 0.3;

/// A strand: middles and half widths from root to tip, texels.
struct Strand {
    middles: [Vec2; STEPS + 1],
    halves: [f32; STEPS + 1],
    /// Brightness, about 1.
    shade: f32,
}

/// Numbers from 0 to 1 by a seed.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f32 {
        // SplitMix64 (Steele et al. 2014).
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 40) as f32 / (1u64 << 24) as f32
    }
}

fn strands(args: &Args) -> Vec<Strand> {
    let mut random = Random(u64::from(args.seed));
    let side = args.size as f32;
    let cell = side / args.density as f32;
    let mut all = Vec::new();
    for i in 0..args.density * args.density {
        let at = Vec2::new((i % args.density) as f32, (i / args.density) as f32);
        let root = (at + Vec2::new(random.next(), random.next())) * cell;
        let long = side * args.length * (0.6 + 0.7 * random.next());
        // Neighbours lean together, by waves that repeat with the picture.
        let wave = (root / side * TAU * 2.0 + Vec2::splat(args.seed as f32)).to_array().map(f32::sin);
        let lean = args.curl * (0.5 * (wave[0] + wave[1]) + random.next() - 0.5);
        let bend = args.curl * 1.6 * (random.next() - 0.5);
        let heading = args.flow.to_radians() + lean;
        let mut middles = [root; STEPS + 1];
        for step in 0..STEPS {
            let angle = heading + bend * step as f32 / STEPS as f32;
            middles[step + 1] = middles[step] + Vec2::from_angle(angle) * long / STEPS as f32;
        }
        let widest = long * WIDTH * 0.5 * (0.7 + 0.6 * random.next());
        let halves = std::array::from_fn(|step| {
            let t = step as f32 / STEPS as f32;
            widest * (1.0 - t).powf(0.8) * (t * 5.0 + 0.35).min(1.0)
        });
        let shade = 0.94 + 0.1 * random.next();
        all.push(Strand { middles, halves, shade });
    }
    all
}

/// Strands with the shifts by whole pictures at which a part of them shows, in the order of painting: each lies over the
/// roots of those that it points to. As copies are sorted one by one, the picture repeats without a seam.
fn copies(strands: &[Strand], args: &Args) -> Vec<(usize, Vec2)> {
    let side = args.size as f32;
    let flow = Vec2::from_angle(args.flow.to_radians());
    let mut copies: Vec<(usize, Vec2)> =
        strands.iter().enumerate().flat_map(|(i, strand)| strand.shifts(side).map(move |shift| (i, shift))).collect();
    let along = |(i, shift): &(usize, Vec2)| flow.dot(strands[*i].middles[0] + *shift);
    copies.sort_by(|a, b| along(b).total_cmp(&along(a)).then(a.0.cmp(&b.0)));
    copies
}

impl Strand {
    fn side(&self, step: usize) -> Vec2 {
        let along = self.middles[(step + 1).min(STEPS)] - self.middles[step.saturating_sub(usize::from(step == STEPS))];
        along.normalize_or(Vec2::X).perp()
    }

    fn edge(&self, step: usize, sign: f32) -> Vec2 {
        self.middles[step] + self.side(step) * self.halves[step] * sign
    }

    fn outline(&self) -> Option<Path> {
        let right = (0..=STEPS).map(|s| self.edge(s, 1.0));
        closed(right.chain((0..STEPS).rev().map(|s| self.edge(s, -1.0))))
    }

    /// A piece between two steps, and a little of the next one, so that no gap shows.
    fn piece(&self, step: usize) -> Option<Path> {
        let over = |sign: f32| self.edge(step + 1, sign) + (self.edge(step + 1, sign) - self.edge(step, sign)) * 0.2;
        let last = if step + 1 == STEPS {
            self.edge(STEPS, 1.0)
        } else {
            over(1.0)
        };
        let first = if step + 1 == STEPS {
            self.edge(STEPS, -1.0)
        } else {
            over(-1.0)
        };
        closed([self.edge(step, -1.0), self.edge(step, 1.0), last, first].into_iter())
    }

    /// By which whole pictures a copy is shifted that lies on this one.
    fn shifts(&self, side: f32) -> impl Iterator<Item = Vec2> + use<> {
        let reach = self.halves.iter().copied().fold(0.0, f32::max) + 2.0;
        let (low, high) = self
            .middles
            .iter()
            .fold((Vec2::INFINITY, Vec2::NEG_INFINITY), |(low, high), m| (low.min(*m), high.max(*m)));
        let (low, high) = (low - reach, high + reach);
        (0..9).filter_map(move |i| {
            let shift = Vec2::new((i % 3) as f32 - 1.0, (i / 3) as f32 - 1.0) * side;
            let inside = (low + shift).cmplt(Vec2::splat(side)).all() && (high + shift).cmpgt(Vec2::ZERO).all();
            inside.then_some(shift)
        })
    }
}

fn closed(mut points: impl Iterator<Item = Vec2>) -> Option<Path> {
    let mut path = PathBuilder::new();
    let first = points.next()?;
    path.move_to(first.x, first.y);
    points.for_each(|p| path.line_to(p.x, p.y));
    path.close();
    path.finish()
}

/// The colours and the normals.
fn paint(args: &Args) -> [Image; 2] {
    let side = args.size as f32;
    let rgb = |c: Srgb| Vec3::from(c.0.map(f32::from)) / 255.0;
    let [root, tip, line] = [args.root, args.tip, args.line].map(rgb);
    let canvas = || Pixmap::new(args.size, args.size);
    // The sizes that the arguments allow are never refused.
    let (Some(mut colors), Some(mut normals)) = (canvas(), canvas()) else { return Default::default() };
    colors.fill(solid(root.lerp(line, 0.4)));
    normals.fill(solid(encoded(Vec3::Z)));
    let strands = strands(args);
    for (i, shift) in copies(&strands, args) {
        let (strand, shift) = (&strands[i], Transform::from_translate(shift.x, shift.y));
        let Some(outline) = strand.outline() else { continue };
        let stroke = Stroke { width: (side / 900.0).max(1.0), ..Stroke::default() };
        let stop = |at: f32| {
            let color = root.lerp(tip, at.powf(0.8)) * strand.shade;
            GradientStop::new(at, solid(color))
        };
        let [first, last] = [strand.middles[0], strand.middles[STEPS]].map(|p| Point::from_xy(p.x, p.y));
        let stops = [0.0, 0.25, 0.5, 0.75, 1.0].map(stop).to_vec();
        let along = LinearGradient::new(first, last, stops, SpreadMode::Pad, Transform::identity());
        let Some(along) = along else { continue };
        colors.fill_path(&outline, &plain(along), FillRule::Winding, shift, None);
        colors.stroke_path(&outline, &plain(Shader::SolidColor(solid(line))), &stroke, shift, None);
        for step in 0..STEPS {
            if let (Some(piece), Some(shader)) = (strand.piece(step), round(strand, step)) {
                normals.fill_path(&piece, &plain(shader), FillRule::Winding, shift, None);
            }
        }
    }
    let normalized = |p: [u8; 4]| {
        let n = Vec3::new(f32::from(p[0]), f32::from(p[1]), f32::from(p[2])) / 127.5 - 1.0;
        let [r, g, b] = (encoded(n.normalize_or(Vec3::Z)) * 255.0 + 0.5).to_array().map(|c| c as u8);
        [r, g, b, 255]
    };
    [picture(&colors, |p| p), picture(&normals, normalized)]
}

/// Normals across a piece: away from its middle on both sides, and a little back to the root.
fn round(strand: &Strand, step: usize) -> Option<Shader<'static>> {
    let (left, right) = (strand.edge(step, -1.0), strand.edge(step, 1.0));
    let side = strand.side(step);
    let along = side.perp() * -1.0;
    let stop = |at: f32| {
        let flat = side * (at * 2.0 - 1.0) * ROUND - along * RISE;
        // Pictures have y downwards, normal maps upwards.
        GradientStop::new(at, solid(encoded(Vec3::new(flat.x, -flat.y, 1.0).normalize())))
    };
    let point = |p: Vec2| Point::from_xy(p.x, p.y);
    let stops = [0.0, 0.25, 0.5, 0.75, 1.0].map(stop).to_vec();
    LinearGradient::new(point(left), point(right), stops, SpreadMode::Pad, Transform::identity())
}

fn encoded(n: Vec3) -> Vec3 {
    n * 0.5 + 0.5
}

fn solid(c: Vec3) -> Color {
    Color::from_rgba(c.x.clamp(0.0, 1.0), c.y.clamp(0.0, 1.0), c.z.clamp(0.0, 1.0), 1.0).unwrap_or(Color::BLACK)
}

fn plain(shader: Shader<'_>) -> Paint<'_> {
    Paint { shader, anti_alias: true, ..Paint::default() }
}

fn picture(pixmap: &Pixmap, texel: impl Fn([u8; 4]) -> [u8; 4]) -> Image {
    let pixels = pixmap.pixels().iter().flat_map(|p| texel([p.red(), p.green(), p.blue(), p.alpha()])).collect();
    Image { width: pixmap.width(), height: pixmap.height(), pixels, ..Image::default() }
}

#[cfg(test)]
mod tests {
    use clap::Parser as _;

    use super::*;

    #[derive(clap::Parser)]
    struct Line {
        #[command(flatten)]
        args: Args,
    }

    fn painted(options: &[&str]) -> [Image; 2] {
        paint(&Line::parse_from(["fur", "-o", "."].iter().chain(options)).args)
    }

    /// Mean step between two columns, or two rows.
    fn step(image: &Image, a: u32, b: u32, rows: bool) -> f32 {
        let at = |i: u32, j: u32| {
            let (x, y) = if rows { (j, i) } else { (i, j) };
            &image.pixels[((y * image.width + x) * 4) as usize..][..3]
        };
        let apart = |j: u32| at(a, j).iter().zip(at(b, j)).map(|(a, b)| f32::from(a.abs_diff(*b))).sum::<f32>();
        (0..image.width).map(apart).sum::<f32>() / image.width as f32
    }

    #[test]
    fn maps_repeat_without_a_seam() {
        for image in painted(&["--size", "256", "--density", "14"]) {
            for rows in [false, true] {
                let inside = (20..236).map(|i| step(&image, i, i + 1, rows)).sum::<f32>() / 216.0;
                let seam = step(&image, 255, 0, rows);
                assert!(seam < inside * 1.6, "{seam} at the seam, {inside} inside");
            }
        }
    }

    #[test]
    fn one_seed_is_one_fur_and_normals_are_unit() {
        let [colors, normals] = painted(&["--size", "128", "--density", "8"]);
        assert!([colors.clone(), normals.clone()] == painted(&["--size", "128", "--density", "8"]));
        assert!(colors != painted(&["--size", "128", "--density", "8", "--seed", "2"])[0]);
        let mut sum = Vec3::ZERO;
        for p in normals.pixels.chunks(4) {
            let n = Vec3::new(f32::from(p[0]), f32::from(p[1]), f32::from(p[2])) / 127.5 - 1.0;
            assert!((n.length() - 1.0).abs() < 0.02 && n.z > 0.3, "{n}");
            sum += n;
        }
        // Strands look back against the flow, which goes down: up in a normal map.
        let mean = sum / (normals.pixels.len() / 4) as f32;
        assert!(mean.x.abs() < 0.1 && mean.y > 0.02, "{mean}");
    }
}
