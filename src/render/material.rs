//! A material for the GPU: which sections are on, their bytes, their textures, and the recipes of its shaders.

use std::collections::BTreeMap;

use super::layout::Block;
use super::shaders::{Bound, Places, Recipe, Shaders, Shape, file};
use crate::material::{
    About, AlphaMode, Generated, Kind, Leaf, Options, Read, Surroundings, TextureRef, UvTransform, Walk,
};
use crate::{Error, Result};

/// Textures that WebGPU promises to one shader stage; 5 are read of the frame and 3 of the character at most.
const MAX_TEXTURES: usize = 16 - 8;

/// Sections that have the places of eyes in what goes from vertex to fragment.
pub(super) const NOT_OF_EYES: &[&str] = &["skin", "face_shadow", "face_paint"];

/// A texture that a material binds.
#[derive(Clone, Debug)]
pub(crate) struct Slot {
    /// Section and field: `gem_inclusions`.
    pub name: String,
    pub read: Read,
    pub source: Source,
}

/// Where a [`Slot`] has its texels from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Source {
    Texture(TextureRef),
    FaceMap(usize),
    Generated(Generated),
}

impl Source {
    fn shape(self) -> Shape {
        match self {
            Self::Texture(_) | Self::Generated(_) => Shape::Flat,
            Self::FaceMap(_) => Shape::Array,
        }
    }

    /// The same without its place on the surface.
    fn unplaced(self) -> Self {
        match self {
            Self::Texture(t) => Self::Texture(TextureRef { transform: UvTransform::default(), ..t }),
            other => other,
        }
    }
}

/// One section of a material that is on.
#[derive(Clone, Debug)]
pub(crate) struct Component {
    pub about: &'static About,
    /// Stages in which it takes part.
    hooks: Vec<&'static str>,
    options: Options,
    slots: Vec<Slot>,
}

impl Component {
    /// Whether it takes part in a stage.
    pub fn takes_part(&self, stage: &str) -> bool {
        self.hooks.contains(&stage)
    }

    /// Whether nothing but a pass of its own reads it.
    fn has_own_pass(&self) -> bool {
        self.hooks.is_empty() && !file(&format!("pass/{}", self.about.key)).is_empty()
    }
}

/// What the shaders of a material are made of.
#[derive(Clone, Debug)]
pub(crate) struct Composition {
    components: Vec<Component>,
    pub alpha: AlphaMode,
    /// Whether expressions move its textures.
    driven_uvs: bool,
}

impl Composition {
    /// Of a material whose numbers are within their ranges.
    pub fn new(shaders: &Shaders, of: &Surroundings<'_>) -> Self {
        let mut material = of.material.clone();
        let has_light = material.shading.is_lit() && !material.burns();
        let mut components = Vec::new();
        for section in material.sections_mut() {
            let about = section.about();
            if !section.is_on(of) || !(has_light || about.unlit) {
                continue;
            }
            let mut options = Options::default();
            section.options(&mut options, of);
            let mut slots = Vec::new();
            section.walk_fields(&mut Walk::new(&mut |path, field, leaf| {
                let source = match leaf {
                    Leaf::Texture(texture) => Source::Texture(*texture),
                    Leaf::FaceMap(map) => Source::FaceMap(*map),
                    _ => return,
                };
                if let (Kind::Texture(read), Some(last)) = (field.kind, path.last()) {
                    slots.push(Slot { name: format!("{}_{last}", about.key), read, source });
                }
            }));
            if let Some((name, generated)) = section.generated(of) {
                let name = format!("{}_{name}", about.key);
                slots.push(Slot { name, read: Read::RAMP, source: Source::Generated(generated) });
            }
            components.push(Component { about, hooks: shaders.hooks(about).to_vec(), options, slots });
        }
        Self { components, alpha: material.drawn_mode(), driven_uvs: of.driven.uvs }
    }

    /// Why shaders of this composition cannot draw a changed material, whose own composition is `other`. What is off in it
    /// but still there is drawn with its numbers.
    pub fn difference(&self, other: &Self, sections: &[&str]) -> Option<String> {
        let find = |of: &Self, key: &str| of.components.iter().find(|c| c.about.key == key).cloned();
        let gone = self.components.iter().find(|c| !sections.contains(&c.about.key));
        if let Some(gone) = gone {
            return Some(format!("{} is none; it was some", gone.about.key));
        }
        for new in &other.components {
            let key = new.about.key;
            let Some(old) = find(self, key) else { return Some(format!("{key} is on; it was off")) };
            if let Some(option) = new.options.iter().find(|option| !old.options.has(option)) {
                return Some(format!("{key} asks for {option}; it did not"));
            }
            let textures =
                |of: &Component| of.slots.iter().map(|s| (s.name.clone(), s.source.unplaced())).collect::<Vec<_>>();
            if textures(new) != textures(&old) {
                return Some(format!("{key} has other textures"));
            }
            let moves =
                |slot: &Slot| matches!(slot.source, Source::Texture(t) if t.transform != UvTransform::default());
            let stood = new.slots.iter().zip(&old.slots).find(|(new, old)| moves(new) && !moves(old));
            if let Some((slot, _)) = stood.filter(|_| !self.driven_uvs) {
                return Some(format!("{} is moved over the surface; it was not", slot.name));
            }
        }
        None
    }

    /// Whether this section is on.
    pub fn has(&self, key: &str) -> bool {
        self.components.iter().any(|c| c.about.key == key)
    }

    /// Whether a section takes part in a stage.
    pub fn takes_part(&self, stage: &str) -> bool {
        self.components.iter().any(|c| c.takes_part(stage))
    }

    /// Whether any of its sections is so.
    pub fn any(&self, is_so: impl Fn(&Component) -> bool) -> bool {
        self.components.iter().any(is_so)
    }

    /// Whether an option or a texture of a section is on.
    pub fn is_on(&self, option: &str) -> bool {
        self.components.iter().any(|c| c.options.has(option) || c.slots.iter().any(|s| s.name == option))
    }

    /// Whether a section asks for this part of the varying or of the frame.
    pub fn needs(&self, what: &str) -> bool {
        self.components.iter().any(|c| c.about.needs.contains(&what))
    }

    /// Textures that it binds.
    pub fn slots(&self) -> impl Iterator<Item = &Slot> {
        self.components.iter().flat_map(|c| &c.slots)
    }

    /// The recipe of a pass that keeps some of its sections.
    pub fn recipe(&self, pass: &'static str, vertex_colors: bool, keep: impl Fn(&Component) -> bool) -> Recipe {
        let is_read = |c: &Component| !c.has_own_pass() || c.about.key == pass;
        let kept: Vec<&Component> = self.components.iter().filter(|c| keep(c) && is_read(c)).collect();
        let mut options = Options::default();
        for component in &kept {
            component.options.iter().for_each(|name| options.set(name, true));
            component.about.needs.iter().for_each(|name| options.set(*name, true));
            component.slots.iter().for_each(|slot| options.set(slot.name.as_str(), true));
        }
        let slots = || kept.iter().flat_map(|c| &c.slots);
        let moved = |slot: &Slot| match slot.source {
            Source::Texture(t) => slot.read.by_uv && (t.uv_set != 0 || t.transform != UvTransform::default()),
            Source::FaceMap(_) | Source::Generated(_) => false,
        };
        let is_lit = kept.iter().any(|c| c.about.is_model && !c.about.unlit);
        // What only a pass of its own reads brings nothing to a surface.
        let is_surface = kept.iter().any(|c| !c.hooks.is_empty());
        options.set("lit", is_lit);
        options.set("normal", is_lit);
        options.set("world", is_lit);
        options.set("uv", is_surface);
        // Those of strips of hair mean something else.
        let has_strips = self.has("strips");
        options.set("vertex_color", is_surface && vertex_colors && !has_strips);
        options.set("strip_colors", is_surface && vertex_colors && has_strips);
        options.set("uv_transforms", is_surface && (self.driven_uvs || slots().any(moved)));
        Recipe {
            pass,
            sections: kept.iter().map(|c| c.about).collect(),
            options,
            textures: slots().map(|s| Bound { name: s.name.clone(), shape: s.source.shape() }).collect(),
        }
    }

    /// The recipe of a pass that draws depth alone: what decides which pixels are there, and nothing where all of them are,
    /// so that one pipeline serves all such materials. `fades`: a surface that fades counts where it covers half.
    pub fn cut(&self, pass: &'static str, vertex_colors: bool, fades: bool) -> Recipe {
        let counts = |c: &Component| fades || !c.takes_part("samples");
        // The base colour's alpha cuts by the material's mode.
        let cuts = |c: &Component| c.about.key != "base" && c.takes_part("gone") && counts(c);
        let is_cut = self.alpha != AlphaMode::Opaque || self.any(cuts);
        let keep = |c: &Component| is_cut && counts(c) && (c.takes_part("gone") || c.takes_part("uv"));
        self.recipe(pass, vertex_colors, keep).with("cut", is_cut)
    }

    /// Refuses what a device with WebGPU's default limits cannot bind.
    pub fn check(&self, name: &str) -> Result<()> {
        if let (true, Some(other)) = (self.needs("eye_vertex"), NOT_OF_EYES.iter().find(|key| self.has(key))) {
            let message = format!("has {other} beside an eye or iris; please give the eyes a material of their own");
            return Err(Error::Argument { what: format!("material {name:?}"), message });
        }
        let count = self.slots().count();
        if count <= MAX_TEXTURES {
            return Ok(());
        }
        let sections: Vec<String> = self
            .components
            .iter()
            .filter(|c| !c.slots.is_empty())
            .map(|c| format!("{} ({})", c.about.key, c.slots.len()))
            .collect();
        let message = format!(
            "binds {count} textures, more than the {MAX_TEXTURES} that every device has room for; please leave some of these \
             sections out: {}",
            sections.join(", ")
        );
        Err(Error::Argument { what: format!("material {name:?}"), message })
    }
}

/// Bytes of all numbers of a material.
///
/// # Errors
/// [`Error::Input`] where a section of an application and its WGSL do not agree.
pub(crate) fn bytes(places: &Places, of: &Surroundings<'_>) -> Result<Vec<u8>> {
    let mut bytes = vec![0; places.size];
    let mut material = of.material.clone();
    for section in material.sections_mut() {
        let about = section.about();
        let Some((offset, layout)) = places.of(about.key) else { continue };
        let names = about.inner.textures();
        let mut transforms = vec![TextureRef::default(); names.len()];
        // Those of parts that are missing stay 0.
        let mut numbers: BTreeMap<String, Vec<u8>> =
            about.inner.numbers().into_iter().map(|n| (n, Vec::new())).collect();
        section.walk_fields(&mut Walk::new(&mut |path, _, leaf| {
            let mut number = |value: [u8; 4]| numbers.entry(path.join("_")).or_default().extend(value);
            match leaf {
                Leaf::F32(x) => number(x.to_ne_bytes()),
                Leaf::U32(x) => number(x.to_ne_bytes()),
                Leaf::I32(x) => number(x.to_ne_bytes()),
                Leaf::Texture(texture) => {
                    if let Some(i) = names.iter().position(|n| path.last() == Some(n)) {
                        transforms[i] = *texture;
                    }
                }
                Leaf::FaceMap(_) => {}
            }
        }));
        let mut block = Block::new(layout, &mut bytes[offset..offset + layout.size]);
        numbers.iter().for_each(|(field, value)| block.take(field, value));
        for (name, texture) in names.iter().zip(&transforms) {
            let member = format!("{name}_uv");
            if layout.has(&member) {
                block.put(&member, rows(texture));
            }
        }
        section.put(&mut block, of);
        if let Some(message) = block.faults().into_iter().next() {
            let (path, pointer) = (format!("{}.wgsl", about.key), format!("struct {}", about.name));
            let message = format!("{message}; its fields are {}", about.inner.numbers().join(", "));
            return Err(Error::Input { path, pointer, message });
        }
    }
    Ok(bytes)
}

/// Rows of the transform of a texture (`KHR_texture_transform`: translation * rotation * scale, v downwards); the last number
/// of the first one is its UV set.
fn rows(texture: &TextureRef) -> [[f32; 4]; 2] {
    let UvTransform { offset, rotation_rad, scale } = texture.transform;
    let (sin, cos) = rotation_rad.sin_cos();
    [
        [cos * scale[0], sin * scale[1], offset[0], texture.uv_set as f32],
        [-sin * scale[0], cos * scale[1], offset[1], 0.0],
    ]
}
