//! Walks over the numbers and textures of a section, and the check of its ranges.

use super::{Field, Kind, TextureRef};

/// What holds all fields of a section.
pub(crate) const ROOT: &Field = &Field { name: "", doc: "", kind: Kind::Plain };

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
plain_parts!(bool, String);

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
            found = Some((
                path.join("."),
                format!("{} is {}; its range is {}", field.name, value as f32, shown_range(low, high)),
            ));
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
