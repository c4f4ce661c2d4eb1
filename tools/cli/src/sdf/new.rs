//! `hikage sdf new`: a project to start from.

use std::fmt::Write as _;
use std::path::PathBuf;

use hikage::picture::{write_atomic, write_png};
use hikage::scene::{Role, Scene};
use hikage::sdf::{FaceMap, FaceStyle, Guide, LIT, Mask, wireframe};

use super::unpack::{file_name, picture};
use crate::failure::Failure;
use crate::output::print;
use crate::setup;

/// Arguments of `hikage sdf new`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Folder to make; it must not exist.
    folder: PathBuf,
    /// Model whose face is drawn from its mesh, as key drawings to paint over: .vrm, .glb or .gltf. Without one, the shapes
    /// of the built-in character's face are the start.
    #[arg(long, value_name = "MODEL")]
    from: Option<PathBuf>,
    /// How the face of a model is drawn: a small shade of the nose, a wedge, or none
    #[arg(long, value_enum, default_value_t, requires = "from")]
    style: Style,
    /// Side of the drawings, texels.
    #[arg(long, value_name = "TEXELS", default_value_t = 1024, value_parser = clap::value_parser!(u32).range(64..=4096))]
    size: u32,
}

#[derive(Clone, Copy, Default, clap::ValueEnum)]
enum Style {
    #[default]
    Soft,
    Classic,
    Minimal,
}

impl From<Style> for FaceStyle {
    fn from(style: Style) -> Self {
        match style {
            Style::Soft => Self::Soft,
            Style::Classic => Self::Classic,
            Style::Minimal => Self::Minimal,
        }
    }
}

/// Angles of the drawings, degrees.
const ANGLES: [f32; 12] = [0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0, 105.0, 120.0, 140.0, 160.0, 180.0];

pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let scene = setup::load(args.from.as_deref())?;
    let (material, guide) = face(&scene, args.style.into())?;
    let project = match args.from {
        Some(_) => None,
        None => Some(setup::built_in_project()?),
    };
    std::fs::create_dir(&args.folder).map_err(|e| Failure::input(format!("{}: {e}", args.folder.display())))?;
    let keys = args.folder.join("keys");
    std::fs::create_dir(&keys).map_err(|e| Failure::input(format!("{}: {e}", keys.display())))?;
    let text = match &project {
        Some(project) => {
            for key in &project.keys {
                write_png(keys.join(file_name(key.angle())), &picture(&project.mask(key.angle())?))?;
            }
            hikage_character::head::sdf::SOURCE.to_owned()
        }
        None => drawn(args, &guide)?,
    };
    write_atomic(args.folder.join("face.sdf.toml"), text.as_bytes())?;
    if let Some(lines) = wireframe(&scene, material, [args.size; 2]) {
        write_png(args.folder.join("wireframe.png"), &lines)?;
    }
    print(&format!(
        "{0}: face.sdf.toml, {1}, wireframe.png as an overlay\nnext: hikage sdf preview {0}/face.sdf.toml{2} -o sheet.png\n",
        args.folder.display(),
        if project.is_some() {
            "its shapes as pictures in keys/"
        } else {
            "key drawings in keys/, to paint over"
        },
        args.from.as_ref().map_or_else(String::new, |model| format!(" {}", model.display())),
    ))
}

/// The first material with a face that a map can be made for.
fn face(scene: &Scene, style: FaceStyle) -> Result<(usize, FaceMap), Failure> {
    let parts = scene.meshes.iter().flat_map(|m| &m.primitives).filter(|p| p.role == Role::Face);
    let found = parts.map(|p| p.material).find_map(|m| Some((m, Guide::new(scene, m, style)?.over_texture(scene, m)?)));
    found.ok_or_else(|| {
        Failure::input(
            "no face with texture coordinates of its own for both sides, under a head bone; expected a character whose face \
             is not mirrored in its texture (`hikage inspect` shows the roles of its parts)",
        )
    })
}

/// Writes the key drawings; gives the project's text.
fn drawn(args: &Args, guide: &FaceMap) -> Result<String, Failure> {
    let symmetric = is_symmetric(guide);
    let mut keys = String::new();
    let right = ANGLES.iter().filter(|a| !symmetric && **a > 0.0).map(|a| -a);
    let fields = [0, 1].map(|channel| Field::new(guide, channel, args.size));
    for angle in right.rev().chain(ANGLES) {
        let file = file_name(angle);
        let mut lit = fields[usize::from(angle >= 0.0)].mask(angle);
        if angle == 0.0 {
            // There both sides share one drawing, and nothing may jump: lit is what light from either finds lit later on.
            let mut other = fields[0].mask(angle).coverage;
            if symmetric {
                other = lit.coverage.chunks_exact(args.size as usize).flat_map(|r| r.iter().rev().copied()).collect();
            }
            lit.coverage.iter_mut().zip(other).for_each(|(c, o)| *c = if (*c).max(o) >= LIT { 255 } else { 0 });
        }
        write_png(args.folder.join("keys").join(&file), &picture(&lit))?;
        let _ = writeln!(keys, "    {{ angle = {angle}, file = \"keys/{file}\" }},");
    }
    Ok(format!(
        "# The shadow of a face: paint over the drawings in keys/, white where the face is lit at that angle of the light.\n\
         # What has turned dark must stay dark as the angle grows: `hikage sdf check` finds where it does not.\n\
         # Angles are degrees from the front towards the character's left (the right of the picture).\n\n\
         mirror = {symmetric}\nlayout = \"liltoon\"\nkeys = [\n{keys}]\n"
    ))
}

/// Whether the face's two sides are mirror images in the texture.
fn is_symmetric(guide: &FaceMap) -> bool {
    let width = guide.width as usize;
    let rows = guide.front.iter().flat_map(|map| map.chunks_exact(width.max(1)));
    let (mut differ, mut all) = (0usize, 0usize);
    for row in rows {
        for (x, p) in row.iter().enumerate().filter(|(_, p)| p[2] < 0x8000) {
            all += 1;
            differ += usize::from(p[1].abs_diff(row[width - 1 - x][0]) > 0x1000);
        }
    }
    differ * 20 < all
}

/// Thresholds of a guide for light from one side, at the size of the drawings.
struct Field {
    size: u32,
    values: Vec<f32>,
}

impl Field {
    /// Reads between the guide's texels, so that borders are smooth at any size.
    fn new(guide: &FaceMap, channel: usize, size: u32) -> Self {
        let (width, height) = (guide.width as usize, guide.height as usize);
        let texels = guide.front.first().map_or(&[] as &[_], Vec::as_slice);
        let texel = |x: usize, y: usize| {
            let p = texels.get(y.min(height - 1) * width + x.min(width - 1));
            p.map_or(0.0, |p| f32::from(p[channel]) / 65535.0)
        };
        let at = |i: u32| {
            let place = |p: u32, side: usize| ((p as f32 + 0.5) / size as f32 * side as f32 - 0.5).max(0.0);
            let (u, v) = (place(i % size, width), place(i / size, height));
            let (i, j, s, t) = (u as usize, v as usize, u.fract(), v.fract());
            let row = |j: usize| texel(i, j) * (1.0 - s) + texel(i + 1, j) * s;
            row(j) * (1.0 - t) + row(j + 1) * t
        };
        let mut values: Vec<f32> = (0..size * size).map(at).collect();
        // Where the mesh folds, thresholds turn over within a few texels; nobody wants to paint over such combs.
        for _ in 0..3 {
            values = blurred_and_turned(&values, size as usize);
            values = blurred_and_turned(&values, size as usize);
        }
        Self { size, values }
    }

    /// What is lit at an angle, with antialiased borders.
    fn mask(&self, angle: f32) -> Mask {
        // The guide fades out to 0 at its end, where no border could be told.
        let (side, threshold) = (self.size as usize, (angle.abs() / 180.0).max(0.01));
        let coverage = |i: usize| {
            let (x, y) = (i % side, i / side);
            let slope = |a: usize, b: usize| self.values[b] - self.values[a];
            let across = slope(i - usize::from(x > 0), i + usize::from(x + 1 < side));
            let down = slope(i - side * usize::from(y > 0), i + side * usize::from(y + 1 < side));
            let per_texel = across.hypot(down) * 0.5;
            let over = self.values[i] - threshold;
            let share = match per_texel {
                // Even, or the end of the guide: no border runs through the texel.
                0.0..1e-5 | 0.1.. => f32::from(over > 0.0),
                _ => over / per_texel + 0.5,
            };
            // What is lit at one half stays so after rounding.
            ((share.clamp(0.0, 1.0) * 256.0).ceil() - 1.0).clamp(0.0, 255.0) as u8
        };
        Mask { width: self.size, height: self.size, coverage: (0..side * side).map(coverage).collect() }
    }
}

/// The mean of each texel and a few on both sides of it in its row; rows become columns.
fn blurred_and_turned(values: &[f32], side: usize) -> Vec<f32> {
    let reach = (side / 256).max(1);
    let mut out = vec![0.0; values.len()];
    for (y, row) in values.chunks_exact(side).enumerate() {
        for x in 0..side {
            let near = &row[x.saturating_sub(reach)..(x + reach + 1).min(side)];
            out[x * side + y] = near.iter().sum::<f32>() / near.len() as f32;
        }
    }
    out
}
