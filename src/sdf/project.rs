//! A project: the drawings of one face, and what is to be made of them.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::source::Source;
use super::threshold::bake_sources;
use super::{BakeOptions, Baked, Blend, Depth, Drawing, Layout, Mask, MaskChannel, MaskFile, Profile, Shape, Sides};
use crate::import::{Limits, image};
use crate::{Error, Result};

/// What `face.sdf.toml` holds. A key is what lies under the shapes of its angle: a drawing in a file, or shade.
///
/// ```toml
/// size = 1024                         # texels, or [width, height]; that of the drawings, where there are any
/// mirror = true                       # light from the right is the mirror image; default: true
/// bits = 16                           # or 8; dither = true spreads the rounding of 8 bits
/// blend = "linear"                    # smooth: without a change of speed at a key
/// profile = "linear"                  # liltoon, genshin or [[angle, value], ...]
/// layout = "liltoon"                  # single or ["left", "right", "area.png", "1"]
/// cap_front = "lit"                   # "none": what is dark at the first key is dark at any angle
/// keys = [0, 30, { angle = 60, file = "060.png", channel = "alpha", threshold = 0.5 }, 120, 180]
///
/// [[shape]]                           # shapes are tweened between their own keys
/// name = "cheek"
/// kind = "light"                      # or shadow
/// keys = [{ angle = 30, ellipse = { center = [0.4, 0.5], radii = [0.1, 0.08] } },
///         { angle = 90, ellipse = { center = [0.45, 0.5], radii = [0.01, 0.01] } }]
/// ```
///
/// Angles are degrees from the front of the face towards the character's left, 0 to 180; negative ones are for light
/// from the right and take the place of `mirror`. Files stand beside the project or below.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Project {
    /// Width and height, texels; `None`: those of the drawings.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size: Option<Size>,
    /// Whether light from the right is the mirror image across the middle of the texture. Default: true.
    #[serde(default = "yes")]
    pub mirror: bool,
    /// 8 or 16. Default: 16.
    #[serde(default = "sixteen")]
    pub bits: u8,
    /// See [`BakeOptions::dither`]. Default: false.
    #[serde(default)]
    pub dither: bool,
    /// See [`Blend`]. Default: linear.
    #[serde(default)]
    pub blend: Blend,
    /// See [`Profile`]. Default: linear.
    #[serde(default)]
    pub profile: Profile,
    /// See [`Layout`]. Default: lilToon's.
    #[serde(default)]
    pub layout: Layout,
    /// What lies before the first key. Default: lit.
    #[serde(default)]
    pub cap_front: CapFront,
    /// Angles and drawings.
    pub keys: Vec<ProjectKey>,
    /// Shapes, in the order in which they are drawn.
    #[serde(default, rename = "shape", skip_serializing_if = "Vec::is_empty")]
    pub shapes: Vec<Shape>,
    /// Its own file; drawings stand beside it. Empty for a project that was made in code.
    #[serde(skip)]
    pub path: PathBuf,
}

const fn yes() -> bool {
    true
}

const fn sixteen() -> u8 {
    16
}

impl Default for Project {
    /// No keys, and the defaults of all else.
    fn default() -> Self {
        Self {
            size: None,
            mirror: true,
            bits: 16,
            dither: false,
            blend: Blend::default(),
            profile: Profile::default(),
            layout: Layout::default(),
            cap_front: CapFront::default(),
            keys: Vec::new(),
            shapes: Vec::new(),
            path: PathBuf::new(),
        }
    }
}

/// Sides of a mask, texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Size {
    /// Both.
    Square(u32),
    /// Width, height.
    Sides([u32; 2]),
}

/// What lies before the first key, where that stands at another angle than 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum CapFront {
    /// Light from the front reaches everything: what is dark at the first key has turned dark on the way to it.
    #[default]
    Lit,
    /// What is dark at the first key is dark at any angle.
    None,
}

/// A key of a project.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum ProjectKey {
    /// An angle, degrees, at which there are shapes only.
    Angle(f32),
    /// A drawing.
    Drawn(DrawnKey),
}

/// A key with a drawing of its own.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DrawnKey {
    /// Angle of the light, degrees -180..=180.
    pub angle: f32,
    /// PNG or WebP, white where the face is lit; beside the project.
    pub file: PathBuf,
    /// See [`MaskFile::channel`].
    #[serde(default)]
    pub channel: MaskChannel,
    /// See [`MaskFile::threshold`]. Default: 0.5.
    #[serde(default = "half")]
    pub threshold: f32,
}

const fn half() -> f32 {
    0.5
}

impl ProjectKey {
    /// Angle of the light, degrees.
    #[must_use]
    pub const fn angle(&self) -> f32 {
        match self {
            Self::Angle(angle) => *angle,
            Self::Drawn(key) => key.angle,
        }
    }
}

/// Both sides of a face as [`Baked`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BakedSides {
    /// For light from the character's left.
    pub left: Baked,
    /// For light from the right; `None` for the mirror image.
    pub right: Option<Baked>,
}

impl BakedSides {
    /// Texels of contradicting keys that were repaired.
    #[must_use]
    pub fn repaired(&self) -> usize {
        self.left.wrong.len() + self.right.as_ref().map_or(0, |r| r.wrong.len())
    }

    /// The maps.
    #[must_use]
    pub fn into_sides(self) -> Sides {
        Sides { left: self.left.map, right: self.right.map(|r| r.map) }
    }
}

impl Project {
    /// Reads a project's text. `path` stands in errors, and drawings are looked for beside it.
    ///
    /// # Errors
    /// [`Error::Input`] with line, reason and what was expected.
    pub fn parse(path: impl Into<PathBuf>, text: &str) -> Result<Self> {
        let path = path.into();
        let fault =
            |message: String| Error::Input { path: path.display().to_string(), pointer: "project".into(), message };
        let project: Self = toml::from_str(text).map_err(|e| {
            let line = e.span().map_or(0, |span| text[..span.start.min(text.len())].matches('\n').count() + 1);
            fault(format!("line {line}: {}", e.message().replace('\n', " ")))
        })?;
        let project = Self { path: path.clone(), ..project };
        project.check()?;
        Ok(project)
    }

    /// Reads a project file of at most a MiB.
    ///
    /// # Errors
    /// [`Error::Io`] where it cannot be read; those of [`Self::parse`].
    pub fn read(path: impl AsRef<Path>) -> Result<Self> {
        let path = path.as_ref();
        let limits = Limits { file_bytes: 1 << 20, ..Limits::default() };
        let text = String::from_utf8(image::read(path, &limits)?).map_err(|_| Error::Input {
            path: path.display().to_string(),
            pointer: "project".into(),
            message: "is no text in UTF-8".into(),
        })?;
        Self::parse(path, &text)
    }

    /// Refuses what cannot be baked, as far as it shows without the drawings.
    ///
    /// # Errors
    /// [`Error::Input`] that names the fault.
    pub fn check(&self) -> Result<()> {
        self.first_fault().map_err(|message| self.fault(message))
    }

    fn fault(&self, message: impl Into<String>) -> Error {
        // A project that was made in code has no file.
        let path = if self.path.as_os_str().is_empty() {
            "keys".into()
        } else {
            self.path.display().to_string()
        };
        Error::Input { path, pointer: "project".into(), message: message.into() }
    }

    fn first_fault(&self) -> Result<(), String> {
        if !matches!(self.bits, 8 | 16) {
            return Err(format!("bits = {}; expected 8 or 16", self.bits));
        }
        for angle in self.keys.iter().map(ProjectKey::angle) {
            if !(-180.0..=180.0).contains(&angle) {
                return Err(format!("a key has the angle {angle}; expected -180 to 180 degrees"));
            }
        }
        let mut angles: Vec<f32> = self.keys.iter().map(ProjectKey::angle).collect();
        angles.sort_by(f32::total_cmp);
        if let Some(pair) = angles.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(format!("two keys have the angle {}; expected one", pair[0]));
        }
        if angles.iter().filter(|a| **a >= 0.0).count() == 0 {
            return Err("has no key at an angle from 0 on; expected keys for light from the left".into());
        }
        self.profile.check().map_err(|e| e.to_string())?;
        Drawing::new(&self.shapes).map(|_| ())
    }

    /// A file that the project names: beside it, or below. Those of a project that was made in code are taken as they are.
    ///
    /// # Errors
    /// [`Error::Input`] for a path that leads elsewhere.
    fn beside(&self, file: &Path) -> Result<PathBuf> {
        let inside =
            file.components().all(|c| matches!(c, std::path::Component::Normal(_) | std::path::Component::CurDir));
        if self.path.as_os_str().is_empty() {
            return Ok(file.to_owned());
        }
        if inside {
            return Ok(self.path.parent().unwrap_or(Path::new("")).join(file));
        }
        Err(self.fault(format!("names the file {}; expected one beside the project or below", file.display())))
    }

    /// Whether keys stand at negative angles.
    #[must_use]
    pub fn has_right(&self) -> bool {
        self.keys.iter().any(|k| k.angle() < 0.0)
    }

    /// Bits of a code.
    #[must_use]
    pub const fn depth(&self) -> Depth {
        if self.bits == 8 { Depth::Eight } else { Depth::Sixteen }
    }

    /// Angles of the keys of a side, degrees from the front, growing, with its number in [`keys`](Self::keys); `None` for
    /// the lit one that `cap_front` sets before them.
    fn side(&self, right: bool) -> Vec<(f32, Option<usize>)> {
        let sign = if right { -1.0 } else { 1.0 };
        let keys = self.keys.iter().enumerate().map(|(i, k)| (k.angle() * sign, Some(i)));
        let mut keys: Vec<_> = keys.filter(|(angle, _)| *angle >= 0.0).map(|(angle, i)| (angle.abs(), i)).collect();
        keys.sort_by(|a, b| a.0.total_cmp(&b.0));
        if self.cap_front == CapFront::Lit && keys.first().is_some_and(|k| k.0 > 0.0) {
            keys.insert(0, (0.0, None));
        }
        keys
    }

    /// Width and height of the map, texels.
    ///
    /// # Errors
    /// [`Error::Input`] where neither the project nor a drawing says it; those of [`MaskFile::load`].
    pub fn size(&self) -> Result<[u32; 2]> {
        if let Some(size) = self.size {
            return Ok(match size {
                Size::Square(side) => [side; 2],
                Size::Sides(sides) => sides,
            });
        }
        let drawn = self.keys.iter().find_map(|k| {
            if let ProjectKey::Drawn(key) = k {
                Some(key)
            } else {
                None
            }
        });
        let key = drawn.ok_or_else(|| self.fault("has no drawing and no size; expected size = 1024 or the like"))?;
        Ok(Source::file(&self.file_of(key)?)?.size)
    }

    fn file_of(&self, key: &DrawnKey) -> Result<MaskFile> {
        Ok(MaskFile { path: self.beside(&key.file)?, channel: key.channel, threshold: key.threshold })
    }

    fn source<'a>(&self, key: Option<usize>, drawing: &'a Drawing, size: [u32; 2]) -> Result<Source<'a>> {
        let source = match key.map(|k| &self.keys[k]) {
            None => return Ok(Source::even(true, size)),
            Some(ProjectKey::Angle(_)) => Source::even(false, size),
            Some(ProjectKey::Drawn(key)) => {
                let file = self.file_of(key)?;
                let source = Source::file(&file)?;
                let [[w, h], [v, g]] = [source.size, size];
                if source.size != size {
                    return Err(Error::Input {
                        path: file.path.display().to_string(),
                        pointer: "image".into(),
                        message: format!("has {w} x {h} texels; expected {v} x {g}, as the others have"),
                    });
                }
                source
            }
        };
        let angle = key.map_or(0.0, |k| self.keys[k].angle());
        Ok(if drawing.is_empty() {
            source
        } else {
            source.with(drawing, angle)
        })
    }

    fn drawing(&self) -> Result<Drawing> {
        Drawing::new(&self.shapes).map_err(|message| self.fault(message))
    }

    /// Bakes both sides.
    ///
    /// # Errors
    /// Those of [`bake`](super::bake) and of the drawings; [`Error::Input`] where the layout wants a side that is neither
    /// drawn nor mirrored.
    pub fn bake(&self, repair: bool) -> Result<BakedSides> {
        if !self.has_right() && !self.mirror && self.layout.has_right() {
            return Err(self.fault(
                "the layout has a channel for light from the right, which no key is for; expected mirror = true \
                 (--mirror), keys at negative angles, or another layout",
            ));
        }
        let size = self.size()?;
        let drawing = self.drawing()?;
        let options = BakeOptions {
            profile: self.profile.clone(),
            depth: self.depth(),
            dither: self.dither,
            blend: self.blend,
            repair,
        };
        let side = |right: bool| {
            let keys = self.side(right);
            let angles: Vec<f32> = keys.iter().map(|k| k.0.to_radians()).collect();
            let mut sources: Vec<Source> =
                keys.iter().map(|k| self.source(k.1, &drawing, size)).collect::<Result<_>>()?;
            bake_sources(&angles, &mut sources, &options).map_err(|e| match e {
                Error::Argument { message, .. } => {
                    self.fault(format!("keys for light from the {} {message}", if right { "right" } else { "left" }))
                }
                other => other,
            })
        };
        Ok(BakedSides { left: side(false)?, right: if self.has_right() { Some(side(true)?) } else { None } })
    }

    /// What is drawn at an angle, degrees: shapes over the drawing of the key that stands there.
    ///
    /// # Errors
    /// Those of the drawings.
    pub fn mask(&self, angle_deg: f32) -> Result<Mask> {
        let size = self.size()?;
        let drawing = self.drawing()?;
        let key = self.keys.iter().position(|k| k.angle() == angle_deg);
        let source = match key {
            Some(_) => self.source(key, &drawing, size)?,
            None => Source::even(false, size),
        };
        let mut source = source.with(&drawing, angle_deg);
        let mut coverage = vec![0; size[0] as usize * size[1] as usize];
        source.read(&mut coverage)?;
        Ok(Mask { width: size[0], height: size[1], coverage })
    }

    /// Encodes what [`Self::bake`] made, in the project's layout.
    ///
    /// # Errors
    /// Those of [`Sides::encode`].
    pub fn encode(&self, sides: &Sides) -> Result<Vec<u8>> {
        sides.encode(&self.layout, |file| MaskFile::new(self.beside(file)?).load())
    }

    /// Files that it is made of: its own and its drawings.
    ///
    /// # Errors
    /// [`Error::Input`] for a path that leads elsewhere.
    pub fn files(&self) -> Result<Vec<PathBuf>> {
        let drawn = self.keys.iter().filter_map(|k| {
            if let ProjectKey::Drawn(key) = k {
                Some(&key.file)
            } else {
                None
            }
        });
        let channels = self.layout.channels();
        let areas = channels.iter().filter_map(|c| {
            if let super::ChannelSource::File(file) = c {
                Some(file)
            } else {
                None
            }
        });
        let own = (!self.path.as_os_str().is_empty()).then(|| self.path.clone());
        own.into_iter().map(Ok).chain(drawn.chain(areas).map(|file| self.beside(file))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fault(text: &str) -> String {
        Project::parse("face.sdf.toml", text).unwrap_err().to_string()
    }

    #[test]
    fn faults_name_file_line_and_reason() {
        for (text, words) in [
            ("keys = [0, nan]", "NaN"),
            ("keys = [0, 181]", "181"),
            ("keys = [0, 30, 30]", "two keys have the angle 30"),
            ("keys = [-30]", "no key at an angle from 0"),
            ("keys = [0, 90]\nbits = 12", "bits = 12"),
            ("keys = [0, 90]\nsise = 12", "line 2: unknown field `sise`"),
            ("keys = [0, 90]\nlayout = \"rgb\"", "line 2"),
            ("keys = [0, 90]\nprofile = [[0, 0]]", "1 points"),
            ("keys = [0, 90]\n[[shape]]\nname = \"a\"\nkind = \"light\"\nkeys = [{ angle = nan, path = \"Z\" }]", "a"),
        ] {
            let fault = fault(text);
            assert!(fault.starts_with("face.sdf.toml: project: ") && fault.contains(words), "{text}: {fault}");
            assert!(!fault.contains('\n'), "{fault:?}");
        }
        let sizeless = Project::parse("face.sdf.toml", "keys = [0, 90]").expect("a project");
        assert!(sizeless.bake(false).unwrap_err().to_string().contains("no size"));
        let outside =
            Project::parse("a/face.sdf.toml", "keys = [0, { angle = 3, file = \"../b.png\" }]").expect("a project");
        assert!(outside.bake(false).unwrap_err().to_string().contains("beside the project"));
        let oneside = "size = 8\nmirror = false\nkeys = [0, 90]";
        let oneside = Project::parse("face.sdf.toml", oneside).expect("a project");
        assert!(oneside.bake(false).unwrap_err().to_string().contains("--mirror"));
    }

    #[test]
    fn sides_have_keys_of_their_own_and_light_before_them() {
        let shape = |angle: &str| format!("{{ angle = {angle}, polygon = [[0, 0], [1, 0], [1, 1], [0, 1]] }}");
        let text = format!(
            "size = 8\nkeys = [-90, -45, 30, 60]\n[[shape]]\nname = \"a\"\nkind = \"light\"\nkeys = [{}, {}]",
            shape("-60"),
            shape("45")
        );
        let project = Project::parse("face.sdf.toml", &text).expect("a project");
        let baked = project.bake(false).expect("nested keys");
        let right = baked.right.expect("a right side").map;
        let dark_from = |map: &super::super::ThresholdMap| {
            (0..180).position(|a| map.mask((a as f32).to_radians()).lit().all(|l| !l))
        };
        let (left, right) = (dark_from(&baked.left.map), dark_from(&right));
        assert!(
            left.is_some_and(|a| (30..=60).contains(&a)) && right.is_some_and(|a| (45..=90).contains(&a)),
            "{left:?} {right:?}"
        );
    }
}
