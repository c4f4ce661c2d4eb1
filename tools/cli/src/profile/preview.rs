//! The picture of a profile: light round a point, light through a slab, and the curves of both.

use std::f32::consts::{PI, TAU};

use hikage::scene::Image;
use hikage::skin::DiffusionProfile;
use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster_width};
use tiny_skia::{Color, Paint, PathBuilder, Pixmap, Stroke, StrokeDash, Transform};

use super::{digits, distances};
use crate::sheet::{paper, write};

/// Size of the picture, its margin and the height of a line of text, pixels.
const SIZE: [u32; 2] = [1200, 800];
const MARGIN: u32 = 32;
const LINE: u32 = 20;
/// Top of what stands below the title.
const TOP: u32 = 92;
/// Side of the disc, and height of the slab.
const DISC: u32 = 400;
const SLAB: u32 = 160;
/// Left edge, width, height and distance of the curves.
const LEFT: u32 = 520;
const WIDTH: u32 = SIZE[0] - LEFT - MARGIN;
const HEIGHT: u32 = 160;
const PITCH: u32 = 232;
/// Of the lines of red, green and blue, sRGB.
const INKS: [[u8; 3]; 3] = [[0xd6, 0x40, 0x3a], [0x2c, 0x9a, 0x55], [0x39, 0x70, 0xd8]];
const GRID: [u8; 3] = [0xd8, 0xdc, 0xe2];
const AXIS: [u8; 3] = [0x8a, 0x92, 0x9e];

/// One or two sets of curves over an axis from 0.
struct Chart<'a> {
    title: &'a str,
    unit: &'a str,
    /// End of the axis.
    end: f32,
    /// End of the values; none is that of the curves.
    highest: Option<f32>,
    curve: &'a dyn Fn(f32) -> [f32; 3],
    dashed: Option<&'a dyn Fn(f32) -> [f32; 3]>,
}

/// Draws the preview of a profile.
pub(super) fn draw(name: &str, of: &DiffusionProfile) -> Image {
    let radius = of.max_radius_mm();
    let [from, to] = of.thickness_remap_mm;
    let mut image = paper(SIZE[0], SIZE[1]);
    let slab_top = TOP + LINE + DISC + 56;
    disc(&mut image, of, [MARGIN, TOP + LINE + 4]);
    slab(&mut image, of, [MARGIN, slab_top + LINE + 4]);

    // 1/(2 d) in the middle, where the profile itself has a pole.
    let density = |r: f32| {
        let r = r.max(radius * 5e-4);
        of.reflectance(r).map(|x| TAU * r * x)
    };
    let (cdf, volume, plain) =
        (|r: f32| of.cdf(r), |t: f32| of.transmittance_of_volume(t), |t: f32| of.transmittance(t));
    let thickest = [from.max(to), radius][usize::from(from.max(to) <= 0.0)];
    let base = Chart { title: "", unit: "mm", end: radius, highest: None, curve: &density, dashed: None };
    let charts = [
        Chart { title: "light that leaves at a radius r, 2 pi r R(r), 1/mm", ..base },
        Chart { title: "light that leaves within a radius (CDF)", highest: Some(1.0), curve: &cdf, ..base },
        Chart {
            title: "light through a thickness; dashed: 1 - CDF, the profile alone",
            end: thickest,
            highest: Some(1.0),
            curve: &volume,
            dashed: Some(&plain),
            ..base
        },
    ];
    for (index, of) in charts.iter().enumerate() {
        chart(&mut image, of, TOP + index as u32 * PITCH);
    }

    write(&mut image, name, MARGIN, 24);
    let facts = format!(
        "d {} mm (red, green, blue)   largest radius {} mm   index of refraction {}",
        distances(of),
        digits(radius),
        of.ior
    );
    write(&mut image, &facts, MARGIN, 48);
    write(&mut image, &format!("light round a point; ring: {} mm", digits(radius)), MARGIN, TOP);
    write(&mut image, "light through a slab, from the left", MARGIN, slab_top);
    let below = slab_top + LINE + 4 + SLAB + 6;
    write(&mut image, &format!("{from} mm"), MARGIN, below);
    right(&mut image, &format!("{to} mm"), MARGIN + DISC, below);
    image
}

/// Linear light as HDRP's inspector shows it: its root.
fn shown(light: [f32; 3]) -> [u8; 4] {
    let [r, g, b] = light.map(|x| (x.max(0.0).sqrt() * 255.0 + 0.5).min(255.0) as u8);
    [r, g, b, 255]
}

fn put(image: &mut Image, x: u32, y: u32, pixel: [u8; 4]) {
    let at = ((y * image.width + x) * 4) as usize;
    image.pixels[at..at + 4].copy_from_slice(&pixel);
}

/// What leaves round a point, as bright whatever its size, with a ring at the largest radius.
fn disc(image: &mut Image, of: &DiffusionProfile, [left, top]: [u32; 2]) {
    /// Shows light skin as bright as HDRP's inspector, which goes by the largest radius in mm, does.
    const GAIN: f32 = 0.125;
    let radius = of.max_radius_mm();
    let middle = DISC as f32 * 0.5;
    let ring = middle - 6.0;
    for y in 0..DISC {
        for x in 0..DISC {
            let [dx, dy] = [x, y].map(|i| i as f32 + 0.5 - middle);
            let r = dx.hypot(dy) / ring * radius;
            // The middle, which has no end, turns white without an edge.
            let light = of.reflectance(r).map(|x| 1.0 - (-x * radius * radius * GAIN).exp());
            put(image, left + x, top + y, shown(light));
        }
    }
    let center = [left, top].map(|i| i as f32 + middle);
    over(image, |canvas| {
        let Some(path) = PathBuilder::from_circle(center[0], center[1], ring) else { return };
        // Dashes that close: a hundred round the ring.
        let dash = StrokeDash::new(vec![ring * PI / 50.0; 2], 0.0);
        let stroke = Stroke { width: 1.5, dash, ..Stroke::default() };
        canvas.stroke_path(&path, &ink([0xc8, 0xcc, 0xd4]), &stroke, Transform::identity(), None);
    });
}

/// What comes through a slab that is as thick at its sides as the remap says.
fn slab(image: &mut Image, of: &DiffusionProfile, [left, top]: [u32; 2]) {
    let [from, to] = of.thickness_remap_mm;
    for x in 0..DISC {
        let thickness = from + (to - from) * (x as f32 + 0.5) / DISC as f32;
        let through = of.transmittance_of_volume(thickness);
        let pixel = shown(std::array::from_fn(|c| through[c] * of.transmission_tint[c]));
        (0..SLAB).for_each(|y| put(image, left + x, top + y, pixel));
    }
}

fn chart(image: &mut Image, of: &Chart<'_>, top: u32) {
    let samples = WIDTH as usize;
    let at = |i: usize| of.end * i as f32 / samples as f32;
    let values: Vec<[f32; 3]> = (0..=samples).map(|i| (of.curve)(at(i))).collect();
    let most = values.as_flattened().iter().copied().fold(f32::MIN_POSITIVE, f32::max);
    let y_step = step(of.highest.unwrap_or(most), 4.0);
    let highest = of.highest.unwrap_or((most / y_step).ceil() * y_step);
    let x_step = step(of.end, 8.0);
    let (left, upper) = (LEFT as f32, (top + LINE + 6) as f32);
    let place = |x: f32, y: f32| (left + x / of.end * WIDTH as f32, upper + (1.0 - y / highest) * HEIGHT as f32);
    let xs: Vec<f32> = (0..).map(|i| i as f32 * x_step).take_while(|x| *x <= of.end * 1.0001).collect();
    let ys: Vec<f32> = (0..).map(|i| i as f32 * y_step).take_while(|y| *y <= highest * 1.0001).collect();

    over(image, |canvas| {
        let mut line = |from: (f32, f32), to: (f32, f32), color: [u8; 3]| {
            let mut path = PathBuilder::new();
            // On the middles of pixels lines are sharp.
            path.move_to(from.0.round() + 0.5, from.1.round() + 0.5);
            path.line_to(to.0.round() + 0.5, to.1.round() + 0.5);
            if let Some(path) = path.finish() {
                canvas.stroke_path(&path, &ink(color), &Stroke::default(), Transform::identity(), None);
            }
        };
        xs.iter().for_each(|x| line(place(*x, 0.0), place(*x, highest), GRID));
        ys.iter().for_each(|y| line(place(0.0, *y), place(of.end, *y), GRID));
        line(place(0.0, 0.0), place(of.end, 0.0), AXIS);
        line(place(0.0, 0.0), place(0.0, highest), AXIS);
        let dashed: Option<Vec<[f32; 3]>> = of.dashed.map(|curve| (0..=samples).map(|i| curve(at(i))).collect());
        let curves = dashed.iter().map(|values| (values, StrokeDash::new(vec![6.0, 5.0], 0.0), 1.5));
        for (values, dash, width) in curves.chain([(&values, None, 2.25)]) {
            let stroke = Stroke { width, dash, ..Stroke::default() };
            for (channel, color) in INKS.iter().enumerate().rev() {
                let mut path = PathBuilder::new();
                for (i, value) in values.iter().enumerate() {
                    let (x, y) = place(at(i), value[channel]);
                    if i == 0 {
                        path.move_to(x, y);
                    } else {
                        path.line_to(x, y);
                    }
                }
                if let Some(path) = path.finish() {
                    canvas.stroke_path(&path, &ink(*color), &stroke, Transform::identity(), None);
                }
            }
        }
    });

    write(image, of.title, LEFT, top);
    for (i, x) in xs.iter().enumerate() {
        let text = if i == 0 {
            format!("0 {}", of.unit)
        } else {
            number(*x, x_step)
        };
        let middle = place(*x, 0.0).0 as u32;
        write(image, &text, middle - width_of(&number(*x, x_step)) / 2, top + LINE + 6 + HEIGHT + 6);
    }
    for y in &ys {
        right(image, &number(*y, y_step), LEFT - 8, place(0.0, *y).1 as u32 - 8);
    }
}

/// Distance of the marks of an axis: 1, 2 or 5 and zeros, at most `most` to its end.
fn step(end: f32, most: f32) -> f32 {
    let least = end / most;
    let unit = 10f32.powf(least.log10().floor());
    [1.0, 2.0, 5.0].map(|k| k * unit).into_iter().find(|s| *s >= least * 0.999).unwrap_or(10.0 * unit)
}

/// A mark of an axis with no more digits than its step needs.
fn number(x: f32, step: f32) -> String {
    format!("{x:.*}", (-(step * 1.001).log10().floor()).max(0.0) as usize)
}

/// Draws over a picture that is opaque.
fn over(image: &mut Image, draw: impl FnOnce(&mut Pixmap)) {
    let size = tiny_skia::IntSize::from_wh(image.width, image.height);
    let pixels = std::mem::take(&mut image.pixels);
    // What has a size and all its pixels is never refused.
    if let Some(mut canvas) = size.and_then(|size| Pixmap::from_vec(pixels, size)) {
        draw(&mut canvas);
        image.pixels = canvas.take();
    }
}

fn ink([r, g, b]: [u8; 3]) -> Paint<'static> {
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color(Color::from_rgba8(r, g, b, 255));
    paint
}

fn width_of(text: &str) -> u32 {
    (get_raster_width(FontWeight::Regular, RasterHeight::Size16) * text.chars().count()) as u32
}

/// Writes a line that ends at a place.
fn right(image: &mut Image, text: &str, end: u32, top: u32) {
    write(image, text, end.saturating_sub(width_of(text)), top);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_round_and_few() {
        for (end, expected) in [(7.83, "1"), (1.0, "0.2"), (15.0, "2"), (0.011, "0.002"), (10_400.0, "2000")] {
            let step = step(end, 8.0);
            assert_eq!(number(step, step), expected, "{end}");
        }
    }

    #[test]
    fn extremes_of_what_is_valid_are_drawn() {
        let least = DiffusionProfile {
            scattering_distance_mm: [0.001; 3],
            thickness_remap_mm: [0.0; 2],
            ..DiffusionProfile::default()
        };
        let most = DiffusionProfile {
            scattering_distance_mm: [1000.0; 3],
            thickness_remap_mm: [1000.0, 0.0],
            ..DiffusionProfile::default()
        };
        for of in [least, most] {
            let image = draw("extreme \u{5f71}", &of);
            assert_eq!(image.pixels.len(), (SIZE[0] * SIZE[1] * 4) as usize);
        }
    }

    #[test]
    fn light_is_brightest_in_the_middle_and_red_goes_farthest() {
        let image = draw("skin", &DiffusionProfile::default());
        let at = |x: u32, y: u32| &image.pixels[((y * image.width + x) * 4) as usize..][..3];
        let (x, y) = (MARGIN + DISC / 2, TOP + LINE + 4 + DISC / 2);
        let [near, far] = [at(x + 4, y), at(x + DISC / 3, y)];
        assert!(near.iter().all(|c| *c > 200), "{near:?}");
        assert!(far[0] > 2 * far[1] && far[1] > far[2], "{far:?}");
    }
}
