//! The look file: a text beside a model that corrects what was guessed and sets any number of any section.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize, de::DeserializeOwned};
use toml::{Table, Value};

use super::{
    Anime, BandStyle, Look, ProfileFile,
    anime::materials_of,
    presets,
    values::{merge, nearest, no_such, not_finite, units},
};
use crate::color::LinearRgb;
use crate::import::{Limits, image, load_radiance};
use crate::material::{About, AlphaMode, Field, Kind, Material, Part, Read, all, out_of_range, registered};
use crate::scene::{Ambient, DirectionalLight, Environment, Image, Lights, Role, Sampler, Scene, Texture, Wrap};
use crate::sdf::{FaceLayout, FaceMap, FaceStyle, Texels};
use crate::skin::DiffusionProfile;
use crate::{Error, Result};

/// Largest look file or profile file, bytes.
const MAX_BYTES: u64 = 1 << 20;

/// A look in a file: `MODEL.look.toml`.
///
/// ```toml
/// base = "anime"                      # what it starts from: anime (default), natural or plain
///
/// [anime]                             # styles of that base
/// face = "classic"                    # soft, classic (a wedge along the nose) or minimal
/// band = "ring"                       # on hair: broken (a mark on each lock), ring or w
///
/// [parts]                             # roles that were guessed wrong, by the name of a mesh or a material
/// Hair_mae = "hair-front"
///
/// [light]                             # lights of pictures that name none
/// direction_deg = [-40, 30]           # to the character's left, and height
/// color = "#fff4e8"
/// coolness = 0.2                      # of shade ramps: 0 warm, 1 cool; by the light's colour where it is missing
///
/// [environment]                       # light from all around; false for none
/// source = "studio"                   # studio, sky, or an equirectangular .hdr beside this file
/// turn_deg = 30                       # to the character's left
/// strength = 1
///
/// [bangs]                             # sections of the scene; false switches one off
/// soft_width_mm = 4
/// [self_shadow]
/// side = 2048
/// [eyes_through]
/// opacity = 0.4
/// [pupils]                            # follow light, and expressions
/// expressions = { surprised = 0.7 }
/// [post]
/// tone = "filmic"                     # none, filmic or neutral
/// bloom = { strength = 0.6, radius = 0.04 }
///
/// [role.face.face_shadow]             # sections of every material that has a part of this role
/// map = "face.png"                    # or: stack = [{ pitch_deg = 0, front = "a.png", back = "b.png" }], masks = "c.png"
/// softness = 0.02
/// [role.hair]
/// highlight = false
///
/// [material.Brooch]
/// gem = "ruby"                        # a section by the name of a preset, or by numbers over one: { preset = "ruby", depth_mm = 4 }
/// [material.Nose]
/// skin = { profile = "jade" }         # a diffusion profile by name, or by a file beside this one: "nose.profile.toml"
///
/// [material."Face skin".outline]      # sections of one material; these come last
/// color = "#8c4a44"
/// ```
///
/// Sections and keys are those of [`Material`](crate::material::Material), [`Bangs`](crate::scene::Bangs),
/// [`SelfShadow`](crate::scene::SelfShadow), [`EyesThrough`](crate::scene::EyesThrough), [`Pupils`](crate::scene::Pupils) and
/// [`Post`](crate::scene::Post). What a file does not name stays as it is. Instead of `_rad` a key may end in `_deg`, instead of
/// `_m` in `_cm` or `_mm`; a colour may be `"#rrggbb"` (sRGB) or linear numbers; a texture is a file beside the look file, and
/// so is a [`ProfileFile`]. A name or key that does not exist is an error with the nearest one that does.
#[derive(Clone, Debug, Default)]
pub struct LookFile {
    path: PathBuf,
    document: Document,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct Document {
    base: BaseName,
    anime: Option<Value>,
    parts: BTreeMap<String, Role>,
    light: Option<Value>,
    bangs: Option<Value>,
    self_shadow: Option<Value>,
    eyes_through: Option<Value>,
    pupils: Option<Value>,
    post: Option<Value>,
    environment: Option<Value>,
    role: BTreeMap<Role, Table>,
    material: BTreeMap<String, Table>,
}

#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq)]
#[serde(rename_all = "kebab-case")]
enum BaseName {
    Plain,
    #[default]
    Anime,
    Natural,
}

crate::part! {
    /// Lights of pictures that name none.
    #[derive(Copy)]
    LightSection {
        /// Where the directional light stands: angle to the character's left, and height, radians; none is the default light.
        direction_rad: Option<[f32; 2]> = None, in -6.3..=6.3;
        /// Its colour, linear.
        color: [f32; 3] = [1.0; 3], in 0.0..=100.0;
        /// What its colour is multiplied by.
        intensity: f32 = 1.0, in 0.0..=1000.0;
        /// Light from all around, linear.
        ambient: [f32; 3] = Ambient::default().sky.0, in 0.0..=100.0;
        /// Of shade ramps: 0 warm, 1 cool; none goes by the light's colour.
        coolness: Option<f32> = None, in 0.0..=1.0;
    }
}

crate::part! {
    /// Light from all around, in the place of `light.ambient`.
    EnvironmentSection {
        /// Where it comes from: `studio`, `sky`, or an equirectangular picture of radiance (`.hdr`) beside the look file.
        source: String = "studio".to_owned();
        /// How far it is turned to the character's left, radians.
        turn_rad: f32 = 0.0, in -6.3..=6.3;
        /// What its light is multiplied by.
        strength: f32 = 1.0, in 0.0..=1000.0;
    }
}

crate::part! {
    /// Styles of the anime look.
    #[derive(Copy)]
    AnimeSection {
        /// Of shadows of faces that are made from a mesh.
        face: FaceStyle = FaceStyle::Soft;
        /// Of bands of light on hair.
        band: BandStyle = BandStyle::Broken;
    }
}

/// The maps of a face as a look file names them.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FaceMaps {
    #[serde(default)]
    layout: FaceLayout,
    map: Option<PathBuf>,
    #[serde(default)]
    stack: Vec<PitchMaps>,
    masks: Option<PathBuf>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PitchMaps {
    #[serde(default)]
    pitch_rad: f32,
    front: PathBuf,
    back: Option<PathBuf>,
}

impl LookFile {
    /// Where the look of a model would stand: `girl.look.toml` beside `girl.vrm`.
    #[must_use]
    pub fn beside(model: &Path) -> PathBuf {
        model.with_extension("look.toml")
    }

    /// Reads a look file. Sections of materials and textures are checked when it is applied.
    ///
    /// # Errors
    /// The file cannot be read, is over 1 MiB, is not TOML, or has a key that does not exist.
    pub fn read(path: impl AsRef<Path>) -> Result<Self> {
        let path = path.as_ref();
        Self::parse(path, &read_text(path)?)
    }

    /// Reads the text of a look file; textures are looked for beside `path`.
    ///
    /// # Errors
    /// The text is not TOML, or has a key that does not exist.
    pub fn parse(path: impl AsRef<Path>, text: &str) -> Result<Self> {
        let path = path.as_ref().to_owned();
        let fault = |pointer: String, message: &str| Error::Input {
            path: path.display().to_string(),
            pointer,
            message: nearest(message),
        };
        let document: Document = toml::from_str(text).map_err(|e| fault(line_of(text, e.span()), e.message()))?;
        Ok(Self { path, document })
    }

    /// Changes a scene: roles first, then the base look, then the sections. `face` are the painted thresholds of a
    /// character that has some ([`Look::Anime`]).
    ///
    /// # Errors
    /// [`Error::Input`] for a part, a material or a key that does not exist, a value out of its domain, or a texture that
    /// cannot be read; the scene may be changed in part then.
    pub fn apply(&self, scene: &mut Scene, face: Option<&crate::sdf::Sides>) -> Result<()> {
        for (name, role) in &self.document.parts {
            self.correct(scene, name, *role)?;
        }
        match self.document.base {
            BaseName::Plain => Look::Plain,
            BaseName::Natural => Look::Natural,
            BaseName::Anime => Look::Anime(Anime { face: face.cloned(), ..self.anime()? }),
        }
        .apply(scene);
        if self.document.light.is_some() {
            let light = self.section("light", self.document.light.as_ref(), None::<LightSection>)?;
            let environment = scene.lights.take().and_then(|l| l.environment);
            scene.lights = light.as_ref().map(|section| Lights { environment, ..lights(section) });
        }
        self.environment(scene)?;
        scene.bangs = self.section("bangs", self.document.bangs.as_ref(), scene.bangs)?;
        scene.self_shadow = self.section("self_shadow", self.document.self_shadow.as_ref(), scene.self_shadow)?;
        scene.eyes_through = self.section("eyes_through", self.document.eyes_through.as_ref(), scene.eyes_through)?;
        self.pupils(scene)?;
        scene.post = self.section("post", self.document.post.as_ref(), scene.post)?;
        for (role, table) in &self.document.role {
            let name = format!("role.{}", role_name(*role));
            for material in materials_of(scene, *role) {
                self.change(scene, material, table, &name)?;
            }
        }
        for (name, table) in &self.document.material {
            let pointer = format!("material.{name:?}");
            let found: Vec<usize> = (0..scene.materials.len()).filter(|i| scene.materials[*i].name == *name).collect();
            if found.is_empty() {
                let names = scene.materials.iter().map(|m| m.name.as_str());
                return Err(self.fault(&pointer, no_such("material", name, names)));
            }
            for material in found {
                self.change(scene, material, table, &pointer)?;
            }
        }
        Ok(())
    }

    /// The styles of the anime look that the file asks for.
    fn anime(&self) -> Result<Anime> {
        let Some(AnimeSection { face, band }) = self.section("anime", self.document.anime.as_ref(), None)? else {
            return Ok(Anime::default());
        };
        Ok(Anime { face: None, face_style: face, band })
    }

    /// The anime look of a scene that has it as a look file, for artists to start from: every number of every section that
    /// it adds.
    #[must_use]
    pub fn template(scene: &Scene) -> String {
        let mut root = Table::new();
        root.insert("base".to_owned(), "anime".into());
        let sections = [
            ("self_shadow", scene.self_shadow.and_then(table_of)),
            ("post", scene.post.and_then(table_of)),
            ("bangs", scene.bangs.and_then(table_of)),
            ("eyes_through", scene.eyes_through.and_then(table_of)),
            ("pupils", scene.pupils.as_ref().and_then(table_of)),
        ];
        root.extend(sections.into_iter().filter_map(|(name, table)| Some((name.to_owned(), Value::Table(table?)))));
        let (mut roles, mut materials) = (Table::new(), Table::new());
        let used: BTreeSet<Role> = scene.meshes.iter().flat_map(|m| &m.primitives).map(|p| p.role).collect();
        for role in used {
            let of_role: Vec<(usize, Table)> =
                materials_of(scene, role).into_iter().map(|m| (m, look_sections(&scene.materials[m]))).collect();
            let Some((_, first)) = of_role.first() else { continue };
            // One section for all of them where they agree.
            if of_role.iter().all(|(_, table)| table == first) {
                roles.insert(role_name(role), Value::Table(first.clone()));
            } else {
                let named =
                    of_role.into_iter().map(|(m, table)| (scene.materials[m].name.clone(), Value::Table(table)));
                materials.extend(named);
            }
        }
        for (name, mut tables) in [("role", roles), ("material", materials)] {
            tables.retain(|_, table| table.as_table().is_some_and(|t| !t.is_empty()));
            root.insert(name.to_owned(), Value::Table(tables));
        }
        toml::to_string_pretty(&root).unwrap_or_default()
    }

    /// Sets the role of parts by the name of their mesh or material.
    fn correct(&self, scene: &mut Scene, name: &str, role: Role) -> Result<()> {
        let Scene { meshes, materials, .. } = scene;
        let is_named = |material: usize| materials.get(material).is_some_and(|m| m.name == name);
        let mut found = false;
        for mesh in meshes.iter_mut() {
            let whole = mesh.name == name;
            for part in mesh.primitives.iter_mut().filter(|p| whole || is_named(p.material)) {
                part.role = role;
                found = true;
            }
        }
        if found {
            return Ok(());
        }
        let names = meshes.iter().map(|m| m.name.as_str()).chain(materials.iter().map(|m| m.name.as_str()));
        Err(self.fault("parts", no_such("mesh or material", name, names)))
    }

    /// The environment of the lights.
    fn environment(&self, scene: &mut Scene) -> Result<()> {
        let Some(section) = &self.document.environment else { return Ok(()) };
        let section = self.section("environment", Some(section), None::<EnvironmentSection>)?;
        let environment = match section {
            None => None,
            Some(EnvironmentSection { source, turn_rad, strength }) => {
                let made = match source.as_str() {
                    "studio" => Environment::studio(),
                    "sky" => Environment::sky(),
                    name if !name.contains('.') => {
                        let known = ["studio", "sky"].into_iter();
                        let message = no_such("environment", name, known);
                        return Err(self.fault("environment.source", format!("{message}; or name an .hdr file")));
                    }
                    file => Environment::new(load_radiance(self.beside_this(Path::new(file), "environment.source")?)?),
                };
                Some(Environment { turn_rad, strength, ..made })
            }
        };
        scene.lights.get_or_insert_default().environment = environment;
        Ok(())
    }

    /// Pupils, whose expressions are those of the character.
    fn pupils(&self, scene: &mut Scene) -> Result<()> {
        scene.pupils = self.section("pupils", self.document.pupils.as_ref(), scene.pupils.take())?;
        let character = scene.character.as_ref();
        let Some(name) = scene.pupils.as_ref().and_then(|p| p.unknown(character)) else { return Ok(()) };
        let names = character.iter().flat_map(|c| &c.expressions).map(|e| e.name.as_str());
        Err(self.fault("pupils.expressions", no_such("expression", name, names)))
    }

    /// A section of the scene with what the file says over it.
    fn section<T: Serialize + DeserializeOwned + Default + Part>(
        &self,
        name: &str,
        over: Option<&Value>,
        current: Option<T>,
    ) -> Result<Option<T>> {
        match over {
            None => Ok(current),
            Some(Value::Boolean(false)) => Ok(None),
            Some(Value::Table(over)) => {
                let mut over = over.clone();
                units(&mut over, false).map_err(|message| self.fault(name, message))?;
                let mut section: T = self.merged(&current.unwrap_or_default(), &over, name)?;
                match out_of_range(&mut section) {
                    Some((key, message)) => Err(self.fault(&format!("{name}.{key}"), message)),
                    None => Ok(Some(section)),
                }
            }
            Some(_) => Err(self.fault(name, "expected a table, or false to switch it off".to_owned())),
        }
    }

    /// Lays the sections of a table over a material.
    fn change(&self, scene: &mut Scene, material: usize, over: &Table, pointer: &str) -> Result<()> {
        let known: Vec<&str> = ["alpha", "double_sided", "shading"].into_iter().chain(all().map(|a| a.key)).collect();
        if let Some((key, _)) = over.iter().find(|(key, _)| !known.contains(&key.as_str())) {
            let known = known.iter().copied().filter(|k| !["toon", "standard"].contains(k));
            return Err(self.fault(pointer, no_such("section", key, known)));
        }
        let mut over = over.clone();
        if let Some(Value::Table(shadow)) = over.get_mut("face_shadow") {
            self.face_maps(scene, shadow, &format!("{pointer}.face_shadow"))?;
        }
        presets::expand(&mut over).map_err(|message| self.fault(pointer, message))?;
        for key in ["skin", "eye"] {
            if let Some(Value::Table(section)) = over.get_mut(key) {
                self.profile(section, &format!("{pointer}.{key}.profile"))?;
            }
        }
        self.textures(scene, &mut over, pointer)?;
        units(&mut over, false).map_err(|message| self.fault(pointer, message))?;
        let own: Vec<_> = registered().into_iter().filter_map(|r| Some((r, over.remove(r.about.key)?))).collect();
        let mut changed: Material = self.merged(&scene.materials[material], &over, pointer)?;
        // What cannot be written in a file.
        changed.own.clone_from(&scene.materials[material].own);
        for (registered, value) in own {
            let set = match value {
                Value::Boolean(false) => (registered.set)(&mut changed, None),
                Value::Table(over) => {
                    let mut whole = (registered.table)(&changed);
                    merge(&mut whole, &over);
                    (registered.set)(&mut changed, Some(whole))
                }
                _ => Err("expected a table, or false to switch it off".to_owned()),
            };
            set.map_err(|m| self.fault(&format!("{pointer}.{}", registered.about.key), nearest(&m)))?;
        }
        if let Some((key, message)) = changed.out_of_range() {
            return Err(self.fault(&format!("{pointer}.{key}"), message));
        }
        if let Some(fire) = &mut changed.fire {
            fire.heat = fire.heat.or(changed.authored.heat);
            if over.contains_key("fire") && changed.alpha.mode != AlphaMode::Blend {
                let message = "fire: the material is not blended and would not burn; add alpha = { mode = \"blend\" }";
                return Err(self.fault(pointer, message.to_owned()));
            }
        }
        if changed.decals.as_ref().is_some_and(|d| d.map.is_none()) {
            return Err(self.fault(pointer, "decals: there is no map; expected the picture of the sheet".to_owned()));
        }
        scene.materials[material] = changed;
        Ok(())
    }

    fn merged<T: Serialize + DeserializeOwned>(&self, current: &T, over: &Table, pointer: &str) -> Result<T> {
        let mut value = table_of(current).unwrap_or_default();
        merge(&mut value, over);
        if let Some(bad) = not_finite(&value) {
            return Err(self.fault(pointer, format!("{bad} is not finite; expected a number")));
        }
        Value::Table(value).try_into().map_err(|e: toml::de::Error| self.fault(pointer, nearest(e.message())))
    }

    /// Reads the maps that a section of a face's shadow names, and puts the number of the face map in their place.
    fn face_maps(&self, scene: &mut Scene, section: &mut Table, pointer: &str) -> Result<()> {
        let mut named = Table::new();
        for key in ["map", "stack", "masks", "layout"] {
            // A number is that of a map that is there.
            if !section.get(key).is_some_and(Value::is_integer) {
                named.extend(section.remove_entry(key));
            }
        }
        if named.is_empty() {
            return Ok(());
        }
        for step in named.get_mut("stack").and_then(Value::as_array_mut).into_iter().flatten() {
            if let Some(step) = step.as_table_mut() {
                units(step, false).map_err(|message| self.fault(pointer, message))?;
            }
        }
        let maps: FaceMaps =
            Value::Table(named).try_into().map_err(|e: toml::de::Error| self.fault(pointer, nearest(e.message())))?;
        let read = |path: &PathBuf| -> Result<Texels> {
            Ok(image::load_texels(self.beside_this(path, pointer)?)?.laid_out(maps.layout))
        };
        let stack = match (&maps.map, maps.stack.as_slice()) {
            (Some(front), []) => vec![PitchMaps { pitch_rad: 0.0, front: front.clone(), back: None }],
            (None, [_, ..]) => maps.stack,
            _ => return Err(self.fault(pointer, "expected either map or stack".to_owned())),
        };
        let mut face: Option<FaceMap> = None;
        for step in &stack {
            let front = read(&step.front)?;
            let back = step.back.as_ref().map(&read).transpose()?;
            let face = face.get_or_insert_with(|| FaceMap {
                name: step.front.display().to_string(),
                width: front.width,
                height: front.height,
                is_8_bit: true,
                ..FaceMap::default()
            });
            face.pitches_rad.push(step.pitch_rad);
            face.is_8_bit &= front.is_8_bit && back.as_ref().is_none_or(|b| b.is_8_bit);
            face.front.push(front.rgba);
            face.back.extend(back.map(|b| b.rgba));
        }
        let mut face = face.unwrap_or_default();
        if let Some(masks) = &maps.masks {
            let masks = image::load_texels(self.beside_this(masks, pointer)?)?;
            face.is_8_bit &= masks.is_8_bit;
            face.masks = masks.rgba;
        }
        face.check().map_err(|e| self.fault(pointer, e.to_string()))?;
        scene.face_maps.push(face);
        section.insert("map".to_owned(), Value::Integer(scene.face_maps.len() as i64 - 1));
        Ok(())
    }

    /// Puts the numbers of a diffusion profile in the place of its name or of its file.
    fn profile(&self, section: &mut Table, pointer: &str) -> Result<()> {
        let name = match section.get("profile") {
            Some(Value::String(name)) => name,
            None | Some(Value::Table(_) | Value::Boolean(false)) => return Ok(()),
            Some(_) => {
                let message = "expected a table, or the name of a profile or of a .profile.toml file";
                return Err(self.fault(pointer, message.to_owned()));
            }
        };
        let profile = if name.ends_with(".toml") {
            ProfileFile::read(self.beside_this(Path::new(name), pointer)?)?.profile
        } else {
            let known = DiffusionProfile::presets();
            DiffusionProfile::named(name).ok_or_else(|| {
                let message = no_such("diffusion profile", name, known.iter().map(|p| p.name));
                self.fault(pointer, format!("{message}; or name a .profile.toml file"))
            })?
        };
        section.insert("profile".to_owned(), Value::Table(table_of(profile).unwrap_or_default()));
        Ok(())
    }

    /// Loads every texture that sections name and puts its number in place of the name.
    fn textures(&self, scene: &mut Scene, sections: &mut Table, pointer: &str) -> Result<()> {
        for about in all() {
            let section = match about.key {
                key @ ("toon" | "standard") => sections.get_mut("shading").and_then(|s| s.get_mut(key)),
                key => sections.get_mut(key),
            };
            if let Some(Value::Table(section)) = section {
                self.textures_of(scene, about.inner.fields, section, pointer)?;
            }
        }
        Ok(())
    }

    fn textures_of(&self, scene: &mut Scene, fields: &[Field], table: &mut Table, pointer: &str) -> Result<()> {
        for field in fields {
            match (field.kind, table.get_mut(field.name)) {
                (Kind::Part(inner), Some(Value::Table(table))) => {
                    self.textures_of(scene, inner.fields, table, pointer)?
                }
                (Kind::Texture(read), Some(value)) if value.is_str() => {
                    let file = self.beside_this(Path::new(value.as_str().unwrap_or_default()), pointer)?;
                    let texture = add_texture(scene, image::load(file)?, read);
                    *value = Value::Table(Table::from_iter([("texture".to_owned(), Value::Integer(texture as i64))]));
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// A file beside the look file, or below its folder.
    fn beside_this(&self, name: &Path, pointer: &str) -> Result<PathBuf> {
        let inside = name.components().all(|c| matches!(c, std::path::Component::Normal(_)));
        if !inside {
            let message = format!("{:?} leads out of the folder; expected a file beside the look file", name.display());
            return Err(self.fault(pointer, message));
        }
        Ok(self.path.parent().unwrap_or(Path::new("")).join(name))
    }

    fn fault(&self, pointer: &str, message: String) -> Error {
        Error::Input { path: self.path.display().to_string(), pointer: pointer.to_owned(), message }
    }
}

fn add_texture(scene: &mut Scene, image: Image, read: Read) -> usize {
    scene.images.push(image);
    // Highlights that move out of their map must not come in on the other side; skins and clothes stay within.
    let wrap = if read.repeats { Wrap::Repeat } else { Wrap::Clamp };
    let sampler = Sampler { wrap_u: wrap, wrap_v: wrap, ..Sampler::default() };
    scene.textures.push(Texture { image: scene.images.len() - 1, sampler });
    scene.textures.len() - 1
}

fn lights(section: &LightSection) -> Lights {
    let towards =
        |[yaw, pitch]: [f32; 2]| glam::Vec3::new(yaw.sin() * pitch.cos(), pitch.sin(), yaw.cos() * pitch.cos());
    Lights {
        directional: DirectionalLight {
            to_light: section.direction_rad.map_or(DirectionalLight::default().to_light, towards),
            color: LinearRgb(section.color),
            intensity: section.intensity,
        },
        ambient: Ambient::uniform(LinearRgb(section.ambient)),
        environment: None,
        punctual: Vec::new(),
        coolness: section.coolness,
    }
}

fn table_of<T: Serialize>(value: T) -> Option<Table> {
    Table::try_from(value).ok()
}

fn role_name(role: Role) -> String {
    Value::try_from(role).ok().and_then(|v| Some(v.as_str()?.to_owned())).unwrap_or_default()
}

/// What looks add to a material, without its textures.
fn look_sections(material: &Material) -> Table {
    let whole = table_of(material).unwrap_or_default();
    let of_look = |about: &&'static About| !about.of_file;
    let mut table = Table::new();
    for about in all().filter(of_look) {
        if let Some(Value::Table(section)) = whole.get(about.key) {
            let mut section = section.clone();
            strip_textures(about.inner.fields, &mut section);
            table.insert(about.key.to_owned(), Value::Table(section));
        }
    }
    table
}

/// Removes what refers to textures by number: a look file names files.
fn strip_textures(fields: &[Field], table: &mut Table) {
    for field in fields {
        match (field.kind, table.get_mut(field.name)) {
            (Kind::Texture(_), Some(_)) => {
                table.remove(field.name);
            }
            (Kind::Part(inner), Some(Value::Table(table))) => strip_textures(inner.fields, table),
            _ => {}
        }
    }
}

/// The text of a file of at most a MiB.
pub(super) fn read_text(path: &Path) -> Result<String> {
    let bytes = image::read(path, &Limits { file_bytes: MAX_BYTES, ..Limits::default() })?;
    String::from_utf8(bytes).map_err(|e| Error::Input {
        path: path.display().to_string(),
        pointer: format!("byte {}", e.utf8_error().valid_up_to()),
        message: "is not UTF-8; TOML is UTF-8 text".to_owned(),
    })
}

/// The line that a fault of TOML begins in.
pub(super) fn line_of(text: &str, span: Option<std::ops::Range<usize>>) -> String {
    let before = span.and_then(|s| text.get(..s.start));
    before.map_or("file".to_owned(), |b| format!("line {}", b.matches('\n').count() + 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_material_comes_back_from_its_table() {
        let material = Material {
            outline: Some(crate::material::Outline::default()),
            face_shadow: Some(crate::material::FaceShadow::default()),
            layer: Some(crate::material::Layer::default()),
            matcap: Some(crate::material::Matcap::default()),
            ..Material::default()
        };
        let back: Material = Value::Table(table_of(&material).expect("a table")).try_into().expect("a material");
        assert_eq!(back, material);
    }
}
