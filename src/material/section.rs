//! How a section is declared: once, from which everything else is derived. Bytes of the uniform, texture bindings, keys and
//! ranges of look files, tables, templates and walks over textures read [`About`] and [`Walk`], and know no section by name.

use std::fmt;

use super::skin::SkinTable;
use super::walk::ROOT;
use super::{About, Material, Part, Walk};
use crate::eye::EyeRow;
use crate::motion::Driven;
use crate::render::layout::Block;
use crate::scene::Scene;
use crate::sdf::FaceMap;

/// What a section may look at beside itself.
#[derive(Clone, Copy, Debug)]
pub struct Surroundings<'a> {
    /// The material that it is part of.
    pub material: &'a Material,
    /// Threshold maps of the scene's faces; their texels may be missing.
    pub face_maps: &'a [FaceMap],
    /// Size of the surface's texture coordinates, metres along u and v.
    pub metres_per_uv: [f32; 2],
    /// Least texture coordinates on it, and how far the others go beyond them.
    pub uv_box: [[f32; 2]; 2],
    /// The eyes of the scene, where the material shades some.
    pub eyes: &'a [EyeRow],
    /// Its place among the materials of its scene whose light is spread over texture coordinates.
    pub skin_layer: u32,
    /// What expressions change: that must be there even where it is off at rest.
    pub driven: &'a Driven,
    /// Whether characters cast shadows on themselves.
    pub self_shadow: bool,
}

impl<'a> Surroundings<'a> {
    /// Those of a material without a scene.
    pub(crate) fn alone(material: &'a Material) -> Self {
        Self {
            material,
            face_maps: &[],
            metres_per_uv: [1.0; 2],
            uv_box: [[0.0; 2], [1.0; 2]],
            eyes: &[],
            skin_layer: 0,
            driven: Driven::NONE,
            self_shadow: false,
        }
    }

    /// Those of every material of a scene.
    pub(crate) fn of_scene(
        scene: &'a Scene,
        driven: &'a [Driven],
        metres_per_uv: &'a [[f32; 2]],
        uv_boxes: &'a [[[f32; 2]; 2]],
        eyes: &'a [Vec<EyeRow>],
    ) -> impl Iterator<Item = Self> {
        let measured = metres_per_uv.iter().zip(uv_boxes);
        scene.materials.iter().zip(driven).zip(measured).enumerate().map(
            move |(i, ((material, driven), (metres, uv_box)))| Self {
                material,
                face_maps: &scene.face_maps,
                metres_per_uv: *metres,
                uv_box: *uv_box,
                eyes: eyes.get(i).map_or(&[], Vec::as_slice),
                skin_layer: skin_layer(&scene.materials, i),
                driven,
                self_shadow: scene.self_shadow.is_some(),
            },
        )
    }
}

/// Place of a material among those whose light is spread over texture coordinates.
pub(crate) fn skin_layer(materials: &[Material], index: usize) -> u32 {
    materials.iter().take(index).filter(|m| m.scatters_over_uv()).count() as u32
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

/// A texture that is made of numbers; floats by their bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Generated {
    /// Azimuthal scattering of fibres.
    Fibre {
        /// Width of the detector, radians.
        width: u32,
        /// Index of refraction.
        ior: u32,
        /// Whether the detector is Gaussian.
        is_gaussian: bool,
    },
    /// How light scatters in skin, and what it mirrors.
    Skin(SkinTable),
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

/// A section: what its declaration cannot say.
pub trait Section: Fields {
    /// Writes what its WGSL struct has beside its fields, by name: what is derived from them. Members that are named as fields
    /// (`width_px`; `blink_low` for `low` in the part `blink`) hold them already, and `map_uv` the transform of the texture
    /// `map`.
    fn put(&self, gpu: &mut Block<'_>, of: &Surroundings<'_>) {
        let _ = (gpu, of);
    }

    /// Switches options of its shader on, beside those of its textures.
    fn options(&self, on: &mut Options, of: &Surroundings<'_>) {
        let _ = (on, of);
    }

    /// A texture that is made of its numbers, by name; shaders read it as `SECTION_NAME`.
    fn generated(&self, of: &Surroundings<'_>) -> Option<(&'static str, Generated)> {
        let _ = of;
        None
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
    /// Of the section, or of each that may stand in its place.
    const ABOUTS: &'static [&'static About];
    fn held(&self) -> Option<&dyn Section>;
    fn held_mut(&mut self) -> Option<&mut dyn Section>;
    /// Takes it away; whether it was there.
    fn remove(&mut self) -> bool {
        false
    }
}

impl<S: Section + Declared> Held for Option<S> {
    const ABOUTS: &'static [&'static About] = &[S::ABOUT];
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
    const ABOUTS: &'static [&'static About] = &[S::ABOUT];
    fn held(&self) -> Option<&dyn Section> {
        Some(self)
    }
    fn held_mut(&mut self) -> Option<&mut dyn Section> {
        Some(self)
    }
}

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
            pub const INNER: &'static $crate::material::Inner = &$crate::material::Inner {
                defaults: || $crate::__private::table(&Self::default()),
                fields: &[
                $($crate::material::Field {
                    name: stringify!($field),
                    doc: concat!($($field_doc),*),
                    kind: $crate::material::Kind::of(
                        $crate::__optional!($([$low as f64, $high as f64])?),
                        $crate::__optional!($($crate::material::Read::$read)?),
                        $crate::__optional!($($part::INNER)?),
                    ),
                },)*
                ],
            };
        }

        impl $crate::material::Part for $name {
            fn walk(&mut self, _: &'static $crate::material::Field, walk: &mut $crate::material::Walk<'_>) {
                let mut fields = Self::INNER.fields.iter();
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

/// How many sections stand in lists.
pub(crate) const fn count(lists: &[&[&About]]) -> usize {
    let (mut sum, mut i) = (0, 0);
    while i < lists.len() {
        sum += lists[i].len();
        i += 1;
    }
    sum
}

/// Lists of sections as one.
pub(crate) const fn joined<const N: usize>(lists: &[&[&'static About]]) -> [&'static About; N] {
    let mut all = [&About::NONE; N];
    let (mut at, mut i) = (0, 0);
    while i < lists.len() {
        let mut j = 0;
        while j < lists[i].len() {
            all[at] = lists[i][j];
            (at, j) = (at + 1, j + 1);
        }
        i += 1;
    }
    all
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
        pub(crate) const LISTED: &[&About] =
            &$crate::material::section::joined::<{ $crate::material::section::count(PLACES) }>(PLACES);

        const PLACES: &[&[&About]] = &[$(<$type as Held>::ABOUTS),+];

        impl Material {
            fn listed(&self) -> [Option<&dyn Section>; PLACES.len()] {
                [$(self.$field.held()),+]
            }

            fn listed_mut(&mut self) -> ([Option<&mut dyn Section>; PLACES.len()], &mut Vec<OwnSection>) {
                let Self { $($field,)+ own, .. } = self;
                ([$($field.held_mut()),+], own)
            }

            /// Takes a section away; whether it was there. Those that every material has stay.
            pub(crate) fn remove(&mut self, key: &str) -> bool {
                $(if <$type as Held>::ABOUTS.iter().any(|about| about.key == key) {
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
