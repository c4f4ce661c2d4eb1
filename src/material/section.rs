//! How a section is declared: once, from which everything else is derived. Bytes of the uniform, texture bindings, keys and
//! ranges of look files, tables, templates and walks over textures read [`About`] and [`Walk`], and know no section by name.

use std::fmt;

use super::{Material, TextureRef};
use crate::motion::Driven;
use crate::render::layout::Block;
use crate::scene::Scene;
use crate::sdf::FaceMap;

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
    /// Whether it is a shading model of its own, in `wgsl/model`. Default: false.
    pub is_model: bool,
    /// Whether it works on surfaces without light, too. Default: false.
    pub unlit: bool,
    /// Whether the line round a surface takes its colour. Default: false.
    pub on_line: bool,
    /// What colour a surface has: light takes part in it, or blooms, but nobody asked for a look. Left out of templates.
    /// Default: false.
    pub of_file: bool,
    /// WGSL of a section that stands outside of this library. Default: none.
    pub wgsl: Option<&'static str>,
}

impl About {
    /// A section that needs and shows nothing.
    pub const NONE: Self = Self {
        key: "",
        name: "",
        doc: "",
        inner: &Inner { fields: &[], defaults: toml::Table::new },
        presets: &[],
        needs: &[],
        channel: None,
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

/// Fields that a field holds together.
#[derive(Clone, Copy, Debug)]
pub struct Inner {
    /// They.
    pub fields: &'static [Field],
    /// Their defaults as a look file would write them.
    pub defaults: fn() -> toml::Table,
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
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
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

/// What a section may look at beside itself.
#[derive(Clone, Copy, Debug)]
pub struct Surroundings<'a> {
    /// The material that it is part of.
    pub material: &'a Material,
    /// Threshold maps of the scene's faces; their texels may be missing.
    pub face_maps: &'a [FaceMap],
    /// Size of the surface's texture coordinates, metres along u and v.
    pub metres_per_uv: [f32; 2],
    /// What expressions change: that must be there even where it is off at rest.
    pub driven: &'a Driven,
    /// Whether characters cast shadows on themselves.
    pub self_shadow: bool,
}

impl<'a> Surroundings<'a> {
    /// Those of a material without a scene.
    pub(crate) fn alone(material: &'a Material) -> Self {
        Self { material, face_maps: &[], metres_per_uv: [1.0; 2], driven: Driven::NONE, self_shadow: false }
    }

    /// Those of every material of a scene.
    pub(crate) fn of_scene(
        scene: &'a Scene,
        driven: &'a [Driven],
        metres_per_uv: &'a [[f32; 2]],
    ) -> impl Iterator<Item = Self> {
        scene.materials.iter().zip(driven).zip(metres_per_uv).map(|((material, driven), metres_per_uv)| Self {
            material,
            face_maps: &scene.face_maps,
            metres_per_uv: *metres_per_uv,
            driven,
            self_shadow: scene.self_shadow.is_some(),
        })
    }
}

/// What is on in a shader: names of sections, of their textures, and of what they ask for, as `@if(name)` reads them.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Options(std::collections::BTreeSet<String>);

impl Options {
    /// Switches a name on where `is_on`; what is on stays so.
    pub fn set(&mut self, name: impl Into<String>, is_on: bool) {
        if is_on {
            self.0.insert(name.into());
        }
    }

    pub(crate) fn has(&self, name: &str) -> bool {
        self.0.contains(name)
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(String::as_str)
    }
}

/// What [`section!`](crate::section) makes of a declaration.
pub trait Fields: Part + fmt::Debug + Send + Sync + 'static {
    /// What is known of it.
    fn about(&self) -> &'static About;
    /// Visits its numbers and textures.
    fn walk_fields(&mut self, walk: &mut Walk<'_>) {
        self.walk(ROOT, walk);
    }
}

/// What holds all fields of a section.
const ROOT: &Field = &Field { name: "", doc: "", kind: Kind::Plain };

/// A section: what its declaration cannot say.
pub trait Section: Fields {
    /// Writes every member of its WGSL struct, by name. Transforms of textures (`map_uv` of `map`) are written already.
    fn put(&self, gpu: &mut Block<'_>, of: &Surroundings<'_>);

    /// Switches options of its shader on, beside those of its textures.
    fn options(&self, on: &mut Options, of: &Surroundings<'_>) {
        let _ = (on, of);
    }

    /// Whether it does anything to this material.
    fn is_on(&self, of: &Surroundings<'_>) -> bool {
        let _ = of;
        true
    }
}

/// That a type is declared as a section.
pub trait Declared {
    /// What is known of it.
    const ABOUT: &'static About;
}

/// A section, or the place of one that may be missing.
pub(crate) trait Held {
    const ABOUT: &'static About;
    fn held(&self) -> Option<&dyn Section>;
    fn held_mut(&mut self) -> Option<&mut dyn Section>;
    /// Takes it away; whether it was there.
    fn remove(&mut self) -> bool {
        false
    }
}

impl<S: Section + Declared> Held for Option<S> {
    const ABOUT: &'static About = S::ABOUT;
    fn remove(&mut self) -> bool {
        self.take().is_some()
    }
    fn held(&self) -> Option<&dyn Section> {
        self.as_ref().map(|s| s as &dyn Section)
    }
    fn held_mut(&mut self) -> Option<&mut dyn Section> {
        self.as_mut().map(|s| s as &mut dyn Section)
    }
}

impl<S: Section + Declared> Held for S {
    const ABOUT: &'static About = S::ABOUT;
    fn held(&self) -> Option<&dyn Section> {
        Some(self)
    }
    fn held_mut(&mut self) -> Option<&mut dyn Section> {
        Some(self)
    }
}

/// A number or a texture of a section.
#[derive(Debug)]
pub enum Leaf<'a> {
    /// A number.
    F32(&'a mut f32),
    /// A count.
    U32(&'a mut u32),
    /// A place in an order.
    I32(&'a mut i32),
    /// A texture.
    Texture(&'a mut TextureRef),
    /// Number of a face's threshold maps.
    FaceMap(&'a mut usize),
}

/// A walk over the numbers and textures of a section: path, field, value.
pub struct Walk<'w> {
    path: Vec<&'static str>,
    visit: &'w mut dyn FnMut(&[&'static str], &'static Field, Leaf<'_>),
}

impl<'w> Walk<'w> {
    pub(crate) fn new(visit: &'w mut dyn FnMut(&[&'static str], &'static Field, Leaf<'_>)) -> Self {
        Self { path: Vec::new(), visit }
    }

    /// Goes through what a field holds.
    pub fn field(&mut self, field: &'static Field, value: &mut dyn Part) {
        self.path.push(field.name);
        value.walk(field, self);
        self.path.pop();
    }

    fn leaf(&mut self, field: &'static Field, leaf: Leaf<'_>) {
        (self.visit)(&self.path, field, leaf);
    }
}

/// What a field may be made of.
pub trait Part {
    /// Visits the numbers and textures in it.
    fn walk(&mut self, field: &'static Field, walk: &mut Walk<'_>);
}

macro_rules! leaves {
    ($($type:ty => $leaf:ident),+) => {
        $(impl Part for $type {
            fn walk(&mut self, field: &'static Field, walk: &mut Walk<'_>) {
                walk.leaf(field, Leaf::$leaf(self));
            }
        })+
    };
}
leaves!(f32 => F32, u32 => U32, i32 => I32, usize => FaceMap, TextureRef => Texture);

/// Types that hold neither numbers nor textures.
macro_rules! plain_parts {
    ($($type:ty),+) => {
        $(impl $crate::material::Part for $type {
            fn walk(&mut self, _: &'static $crate::material::Field, _: &mut $crate::material::Walk<'_>) {}
        })+
    };
}
pub(crate) use plain_parts;
plain_parts!(bool);

impl<T: Part, const N: usize> Part for [T; N] {
    fn walk(&mut self, field: &'static Field, walk: &mut Walk<'_>) {
        self.iter_mut().for_each(|value| value.walk(field, walk));
    }
}

impl<T: Part> Part for Vec<T> {
    fn walk(&mut self, field: &'static Field, walk: &mut Walk<'_>) {
        self.iter_mut().for_each(|value| value.walk(field, walk));
    }
}

impl<T: Part> Part for Option<T> {
    fn walk(&mut self, field: &'static Field, walk: &mut Walk<'_>) {
        self.iter_mut().for_each(|value| value.walk(field, walk));
    }
}

/// A number that is out of its range, or none at all: its key and what is wrong with it.
pub(crate) fn out_of_range(part: &mut dyn Part) -> Option<(String, String)> {
    let mut found = None;
    each_number(part, &mut |path, field, [low, high], value| {
        if !(low..=high).contains(&value) && found.is_none() {
            found =
                Some((path.join("."), format!("{} is {value}; its range is {}", field.name, shown_range(low, high))));
        }
        value
    });
    found
}

/// Moves every number into its range; what is no number becomes the range's lower end.
pub(crate) fn clamp(part: &mut dyn Part) {
    each_number(part, &mut |_, _, [low, high], value| if value.is_nan() { low } else { value.clamp(low, high) });
}

/// What a number becomes, by its path, its field and its range.
type MapNumber<'m> = &'m mut dyn FnMut(&[&'static str], &'static Field, [f64; 2], f64) -> f64;

fn each_number(part: &mut dyn Part, map: MapNumber<'_>) {
    let mut visit = |path: &[&'static str], field: &'static Field, leaf: Leaf<'_>| {
        let Kind::Number { low, high } = field.kind else { return };
        let range = [low, high];
        match leaf {
            // Ranges are written in decimals: what is equal in 32 bits is within.
            Leaf::F32(x) if (low as f32..=high as f32).contains(x) => {}
            Leaf::F32(x) => *x = map(path, field, range, f64::from(*x)) as f32,
            Leaf::U32(x) => *x = map(path, field, range, f64::from(*x)) as u32,
            Leaf::I32(x) => *x = map(path, field, range, f64::from(*x)) as i32,
            Leaf::Texture(_) | Leaf::FaceMap(_) => {}
        }
    };
    part.walk(ROOT, &mut Walk::new(&mut visit));
}

/// Ends of a range as tables and messages show them; what is beyond any use counts as no end.
#[must_use]
pub fn shown_range(low: f64, high: f64) -> String {
    let end = |x: f64| {
        if x.abs() >= UNBOUNDED {
            String::new()
        } else {
            x.to_string()
        }
    };
    format!("{}..{}", end(low), end(high))
}

/// From here on an end of a range is none.
pub const UNBOUNDED: f64 = 1e6;

/// Declares a section of a material: its struct with documentation, defaults, ranges, textures and presets.
///
/// ```
/// hikage::section! {
///     /// Ice that grows from below.
///     #[derive(Copy)]
///     Frost = "frost" { channel: Some(("frost", "Share of ice.")), wgsl: Some("struct Frost { height_m: f32 }") }
///     {
///         /// Height up to which it has grown, metres.
///         height_m: f32 = 0.4, in 0.0..=10.0;
///     }
///     presets {
///         /// Nothing is left bare.
///         whole { height_m: 10.0 }
///     }
/// }
/// assert_eq!(Frost::whole().height_m, 10.0);
/// ```
///
/// The braces after its key set members of [`About`](crate::material::About). A field ends in `, in LOW..=HIGH` where it
/// holds numbers, in `, read HOW` where it holds a texture ([`Read`](crate::material::Read)), and in `, part TYPE` where it
/// holds fields of its own ([`part!`](crate::part)).
#[macro_export]
macro_rules! section {
    (
        $(#[doc = $doc:expr])*
        $(#[derive($derive:ident)])?
        $name:ident = $key:literal { $($about:ident : $value:expr),* $(,)? }
        { $($fields:tt)* }
        $(presets { $($(#[doc = $preset_doc:expr])* $preset:ident { $($preset_field:ident : $preset_value:expr),* $(,)? })* })?
    ) => {
        $crate::part! {
            $(#[doc = $doc])*
            $(#[derive($derive)])?
            $name { $($fields)* }
        }

        impl $name {
            /// What is known of the section.
            pub const ABOUT: $crate::material::About = $crate::material::About {
                key: $key,
                name: stringify!($name),
                doc: concat!($($doc, "\n"),*),
                inner: Self::INNER,
                presets: &[$($($crate::material::Preset {
                    name: stringify!($preset),
                    doc: concat!($($preset_doc),*),
                    values: || $crate::__private::table(&Self::$preset()),
                }),*)?],
                $($about: $value,)*
                ..$crate::material::About::NONE
            };

            $($(
                $(#[doc = $preset_doc])*
                #[must_use]
                #[allow(clippy::needless_update, reason = "a preset may set every field")]
                pub fn $preset() -> Self {
                    Self { $($preset_field: $preset_value,)* ..Self::default() }
                }
            )*)?
        }

        impl $crate::material::Declared for $name {
            const ABOUT: &'static $crate::material::About = &Self::ABOUT;
        }

        impl $crate::material::Fields for $name {
            fn about(&self) -> &'static $crate::material::About {
                &Self::ABOUT
            }
        }
    };
}

/// Declares fields that a section holds together; see [`section!`](crate::section).
#[macro_export]
macro_rules! part {
    (
        $(#[doc = $doc:expr])*
        $(#[derive($derive:ident)])?
        $name:ident {
            $(
                $(#[doc = $field_doc:expr])*
                $field:ident : $type:ty = $default:expr
                $(, in $low:literal ..= $high:literal)?
                $(, read $read:ident)?
                $(, part $part:ident)?
                ;
            )*
        }
    ) => {
        $(#[doc = $doc])*
        #[derive(Clone, Debug, PartialEq, $crate::__private::serde::Serialize, $crate::__private::serde::Deserialize)]
        $(#[derive($derive)])?
        #[serde(crate = "hikage::__private::serde", default, deny_unknown_fields)]
        pub struct $name {
            $(
                $(#[doc = $field_doc])*
                $(#[doc = concat!(" Range ", stringify!($low), " to ", stringify!($high), ".")])?
                #[doc = concat!(" Default: `", stringify!($default), "`.")]
                pub $field: $type,
            )*
        }

        impl Default for $name {
            fn default() -> Self {
                Self { $($field: $default,)* }
            }
        }

        impl $name {
            /// Its fields with their defaults.
            #[allow(dead_code, reason = "what no section holds is asked for its ranges alone")]
            pub const INNER: &'static $crate::material::Inner = &$crate::material::Inner {
                fields: Self::FIELDS,
                defaults: || $crate::__private::table(&Self::default()),
            };

            /// Its fields.
            pub const FIELDS: &'static [$crate::material::Field] = &[
                $($crate::material::Field {
                    name: stringify!($field),
                    doc: concat!($($field_doc),*),
                    kind: $crate::material::Kind::of(
                        $crate::__optional!($([$low as f64, $high as f64])?),
                        $crate::__optional!($($crate::material::Read::$read)?),
                        $crate::__optional!($($part::INNER)?),
                    ),
                },)*
            ];

        }

        impl $crate::material::Part for $name {
            fn walk(&mut self, _: &'static $crate::material::Field, walk: &mut $crate::material::Walk<'_>) {
                let mut fields = Self::FIELDS.iter();
                $(
                    if let Some(field) = fields.next() {
                        walk.field(field, &mut self.$field);
                    }
                )*
                let _ = fields;
            }
        }
    };
}

/// `Some` of what is there.
#[doc(hidden)]
#[macro_export]
macro_rules! __optional {
    () => {
        None
    };
    ($value:expr) => {
        Some($value)
    };
}

/// Makes [`Material`] of the list of its sections.
macro_rules! sections {
    ($($(#[doc = $doc:expr])* $field:ident : $type:ty $(=> $module:ident)?),+ $(,)?) => {
        $($crate::material::section::section_module! { $field $($module)? })+

        /// A material.
        #[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
        #[serde(default, deny_unknown_fields)]
        pub struct Material {
            /// Name in the file; may be empty.
            pub name: String,
            /// Which description in the file it was made from.
            pub origin: Origin,
            /// Opacity and draw order.
            pub alpha: Alpha,
            /// Draws back faces too, with their normals turned. Default: false.
            pub double_sided: bool,
            /// What the file carries for looks that use it.
            pub authored: Authored,
            $($(#[doc = $doc])* pub $field: $type,)+
            /// Sections of the application ([`register`]). Default: none.
            #[serde(skip)]
            pub own: Vec<OwnSection>,
        }

        /// Every section of the library.
        pub(crate) const LISTED: &[&About] = &[$(<$type as Held>::ABOUT),+];

        impl Material {
            fn listed(&self) -> [Option<&dyn Section>; LISTED.len()] {
                [$(self.$field.held()),+]
            }

            fn listed_mut(&mut self) -> ([Option<&mut dyn Section>; LISTED.len()], &mut Vec<OwnSection>) {
                let Self { $($field,)+ own, .. } = self;
                ([$($field.held_mut()),+], own)
            }

            /// Takes a section away; whether it was there. Those that every material has stay.
            pub(crate) fn remove(&mut self, key: &str) -> bool {
                $(if <$type as Held>::ABOUT.key == key {
                    return Held::remove(&mut self.$field);
                })+
                let before = self.own.len();
                self.own.retain(|o| o.section().about().key != key);
                self.own.len() < before
            }
        }
    };
}
pub(crate) use sections;

/// The module of a section, named as its field where nothing else is said.
macro_rules! section_module {
    ($field:ident) => {
        mod $field;
        pub use $field::*;
    };
    ($field:ident $module:ident) => {
        mod $module;
        pub use $module::*;
    };
}
pub(crate) use section_module;
