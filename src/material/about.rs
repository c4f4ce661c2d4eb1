//! What a declaration says of a section: keys, fields with ranges, textures and how they are read, presets.

use std::fmt;

/// What is known of a section before any material has it.
#[derive(Clone, Copy, Debug)]
pub struct About {
    /// Key in look files, stem of its file in `wgsl/look`, and member of `Material` in shaders: `sparkle`.
    pub key: &'static str,
    /// Name of its struct in Rust and WGSL: `Sparkle`.
    pub name: &'static str,
    /// Its documentation.
    pub doc: &'static str,
    /// Its fields, with their defaults; what is off at first has none.
    pub inner: &'static Inner,
    /// Sets of numbers by name.
    pub presets: &'static [Preset],
    /// Parts of the varying that its shader reads: `tangent`, `shadow`. Default: none.
    pub needs: &'static [&'static str],
    /// Debug channel: name and what it shows. Default: none.
    pub channel: Option<(&'static str, &'static str)>,
    /// Further debug channels. Default: none.
    pub more_channels: &'static [(&'static str, &'static str)],
    /// Whether it is a shading model of its own, in `wgsl/model`. Default: false.
    pub is_model: bool,
    /// Whether it works on surfaces without light, too. Default: false.
    pub unlit: bool,
    /// Whether the line round a surface takes its colour. Default: false.
    pub on_line: bool,
    /// Whether it says what model files say, and not what a look adds: templates leave it out. Default: false.
    pub of_file: bool,
    /// WGSL of a section that stands outside of this library. Default: none.
    pub wgsl: Option<&'static str>,
}

impl About {
    /// All its debug channels.
    pub fn channels(&self) -> impl Iterator<Item = (&'static str, &'static str)> {
        self.channel.into_iter().chain(self.more_channels.iter().copied())
    }

    /// A section that needs and shows nothing.
    pub const NONE: Self = Self {
        key: "",
        name: "",
        doc: "",
        inner: &Inner { fields: &[], defaults: toml::Table::new },
        presets: &[],
        needs: &[],
        channel: None,
        more_channels: &[],
        is_model: false,
        unlit: false,
        on_line: false,
        of_file: false,
        wgsl: None,
    };
}

/// One field of a section.
#[derive(Clone, Copy, Debug)]
pub struct Field {
    /// Its name.
    pub name: &'static str,
    /// Its documentation.
    pub doc: &'static str,
    /// What it holds.
    pub kind: Kind,
}

/// What a field holds.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    /// One or several numbers within a range.
    Number {
        /// Least.
        low: f64,
        /// Greatest.
        high: f64,
    },
    /// A texture.
    Texture(Read),
    /// Fields of its own.
    Part(&'static Inner),
    /// Anything else: a switch, a name.
    Plain,
}

/// Fields that stand together.
#[derive(Clone, Copy, Debug)]
pub struct Inner {
    /// The fields.
    pub fields: &'static [Field],
    /// Their defaults as a look file would write them.
    pub defaults: fn() -> toml::Table,
}

impl Inner {
    /// Names of the textures in it and in what it holds.
    pub(crate) fn textures(&self) -> Vec<&'static str> {
        let of = |field: &Field| match field.kind {
            Kind::Texture(_) => vec![field.name],
            Kind::Part(inner) => inner.textures(),
            _ => Vec::new(),
        };
        self.fields.iter().flat_map(of).collect()
    }

    /// Names of the numbers in it, after those of the parts that hold them: `blink_low`.
    pub(crate) fn numbers(&self) -> Vec<String> {
        let of = |field: &Field| match field.kind {
            Kind::Number { .. } => vec![field.name.to_owned()],
            Kind::Part(inner) => inner.numbers().iter().map(|n| format!("{}_{n}", field.name)).collect(),
            _ => Vec::new(),
        };
        self.fields.iter().flat_map(of).collect()
    }
}

impl Kind {
    /// What the tail of a field in [`section!`](crate::section) says.
    #[must_use]
    pub const fn of(range: Option<[f64; 2]>, read: Option<Read>, part: Option<&'static Inner>) -> Self {
        match (range, read, part) {
            (Some([low, high]), ..) => Self::Number { low, high },
            (_, Some(read), _) => Self::Texture(read),
            (.., Some(inner)) => Self::Part(inner),
            _ => Self::Plain,
        }
    }
}

/// How the numbers of a picture are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Read {
    /// What its numbers mean.
    pub encoding: Encoding,
    /// Whether a picture that a look file names repeats; else it is clamped at its border.
    pub repeats: bool,
    /// Whether it is clamped whatever its own sampler says.
    pub clamped: bool,
    /// Whether it lies on the surface by texture coordinates, which its transform and animations move.
    pub by_uv: bool,
}

/// What the numbers of a picture mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Encoding {
    /// sRGB colour with straight alpha.
    Srgb,
    /// Plain numbers: masks, normal maps.
    Linear,
}

impl Read {
    /// A colour on the surface.
    pub const SRGB: Self = Self { encoding: Encoding::Srgb, repeats: false, clamped: false, by_uv: true };
    /// Numbers on the surface.
    pub const LINEAR: Self = Self { encoding: Encoding::Linear, ..Self::SRGB };
    /// A colour that repeats.
    pub const SRGB_REPEAT: Self = Self { repeats: true, ..Self::SRGB };
    /// Numbers that repeat.
    pub const LINEAR_REPEAT: Self = Self { repeats: true, ..Self::LINEAR };
    /// A colour that is looked up by something else than texture coordinates.
    pub const LOOKUP: Self = Self { by_uv: false, ..Self::SRGB };
    /// The same, clamped at its border.
    pub const RAMP: Self = Self { clamped: true, ..Self::LOOKUP };
    /// The threshold maps of a face.
    pub const FACE: Self = Self { encoding: Encoding::Linear, ..Self::RAMP };
}

/// A set of numbers by name.
#[derive(Clone, Copy)]
pub struct Preset {
    /// Its name in look files.
    pub name: &'static str,
    /// What it looks like.
    pub doc: &'static str,
    /// Its values as a look file would write them.
    pub values: fn() -> toml::Table,
}

impl fmt::Debug for Preset {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}
