//! The only place that knows how WGSL is linked: what a material needs and nothing else, from the files of `wgsl/` and one
//! generated module, `package::material`, that calls each section's functions by name at fixed stages.

use std::collections::{BTreeMap, HashMap};
use std::fmt::{self, Write};
use std::sync::{Arc, Mutex};

use wesl::{CompileOptions, ModulePath, NoMangler};

use super::check_section::fault_in;
pub use super::check_wgsl::{MAX_WGSL_BYTES, ShaderSummary, check};
use super::draw_list::recipes_of;
use super::layout::{Layout, struct_texts};
use super::made::lock;
pub(crate) use super::wgsl_files::file;
pub use super::wgsl_files::{FOLDER_VARIABLE, tree};
use super::wgsl_files::{Parsed, Tree};
use crate::material::{About, LISTED, Material, Options, registered};
use crate::scene::Scene;
use crate::{Error, Result};

/// How the results of several sections become one.
enum Fold {
    /// Each is called.
    Each,
    /// The last argument goes through all of them.
    Chain,
    /// One operator between all of them, over this value where there is none.
    Of(&'static str, &'static str),
    /// The last one counts; this value where there is none.
    Last(&'static str),
}

/// A stage of shading: what a function `SECTION_STAGE` takes and gives.
pub(crate) struct Stage {
    pub name: &'static str,
    takes: &'static str,
    gives: &'static str,
    fold: Fold,
}

const fn stage(name: &'static str, takes: &'static str, gives: &'static str, fold: Fold) -> Stage {
    Stage { name, takes, gives, fold }
}

/// All stages; the first ones are of vertices.
pub(crate) const STAGES: &[Stage] = &[
    stage("place", "clip: vec4f", "vec4f", Fold::Chain),
    stage("vary", "v: Vertex, out: ptr<function, Varying>", "", Fold::Each),
    stage("vertex_uv", "uv: vec4f", "vec4f", Fold::Chain),
    stage("line", "width: f32", "f32", Fold::Chain),
    stage("uv", "uv: vec4f", "vec4f", Fold::Chain),
    // Whether and how much of a surface is there: as pixels, as depth, as alpha, as samples.
    stage("vanish", "at: Varying", "", Fold::Each),
    stage("gone", "at: Varying", "bool", Fold::Of("||", "false")),
    stage("left", "at: Varying", "f32", Fold::Of("*", "1.0")),
    stage("samples", "at: Varying", "u32", Fold::Of("&", "15u")),
    stage("surface", "s: ptr<function, Surface>", "", Fold::Each),
    stage("bend", "s: ptr<function, Surface>", "", Fold::Each),
    stage("lamps", "s: ptr<function, Surface>", "", Fold::Each),
    stage("paint", "s: ptr<function, Surface>", "", Fold::Each),
    stage("shade", "s: ptr<function, Surface>, b: ptr<function, Border>", "", Fold::Each),
    stage("model", "s: ptr<function, Surface>", "Shaded", Fold::Last("unlit_model(s)")),
    stage("shine", "s: ptr<function, Surface>, l: ptr<function, Shaded>", "", Fold::Each),
    stage("contour", "s: ptr<function, Surface>, l: ptr<function, Shaded>, color: vec3f", "vec3f", Fold::Chain),
    // Light of its own that blooms, and that of highlights.
    stage("emitted", "s: ptr<function, Surface>", "vec3f", Fold::Last("s.emission")),
    stage("glow", "s: ptr<function, Surface>, b: ptr<function, Border>", "vec3f", Fold::Of("+", "vec3f(0.0)")),
];

/// A texture that a section binds.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct Bound {
    /// Section and field: `gem_inclusions`.
    pub name: String,
    pub shape: Shape,
}

/// How a texture is laid out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Shape {
    Flat,
    /// Layers.
    Array,
}

/// What a shader is linked from.
#[derive(Clone)]
pub(crate) struct Recipe {
    /// Stem of the entry file in `wgsl/pass`.
    pub pass: &'static str,
    /// Sections, in the order of the list.
    pub sections: Vec<&'static About>,
    /// What `@if` asks for.
    pub options: Options,
    /// Textures of the sections.
    pub textures: Vec<Bound>,
}

impl fmt::Debug for Recipe {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.key())
    }
}

impl Recipe {
    /// Of a pass that draws no material.
    pub fn plain(pass: &'static str) -> Self {
        Self { pass, sections: Vec::new(), options: Options::default(), textures: Vec::new() }
    }

    /// The same with an option on where `is_on`.
    pub fn with(mut self, option: &str, is_on: bool) -> Self {
        self.options.set(option, is_on);
        self
    }

    /// Recipes that are linked to the same have the same.
    pub fn key(&self) -> String {
        let mut key = self.pass.to_owned();
        let sections = self.sections.iter().map(|a| a.key);
        for word in sections.chain(["with"]).chain(self.options.iter()).chain(self.textures.iter().map(|t| &*t.name)) {
            key.push(' ');
            key.push_str(word);
        }
        key
    }
}

/// A text that is ready for the device.
#[derive(Debug)]
pub(crate) struct Linked {
    pub text: Arc<str>,
    /// The same as the device takes it.
    pub module: naga::Module,
    pub has_fragment: bool,
    /// Whether it reads where actors were in the last picture.
    pub reads_past: bool,
    /// What it binds of its material.
    pub bindings: Vec<Binding>,
}

/// A binding of group 2.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct Binding {
    pub index: u32,
    /// `material`, a texture, or a texture with `_sampler` behind.
    pub name: String,
    pub kind: BindingKind,
}

/// What a [`Binding`] holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum BindingKind {
    Numbers,
    Texture,
    TextureArray,
    Sampler,
}

/// Where the numbers of every section stand in a material's bytes: the same in all shaders.
#[derive(Debug)]
pub(crate) struct Places {
    sections: BTreeMap<&'static str, (usize, Layout)>,
    /// Bytes of all of them.
    pub size: usize,
}

impl Places {
    fn new(sections: &[&'static About]) -> Result<Self> {
        let mut text: String = struct_texts(file("bind/uv")).collect();
        for about in sections {
            text.extend(struct_texts(look_text(about)));
        }
        let mut structs = Layout::of_structs(&text).map_err(|e| fault_in(sections, &text, &e))?;
        let mut places = Self { sections: BTreeMap::new(), size: 0 };
        for about in sections {
            if let Some(layout) = structs.remove(about.name) {
                let size = layout.size.next_multiple_of(16);
                places.sections.insert(about.key, (places.size, layout));
                places.size += size;
            }
        }
        Ok(places)
    }

    /// Offset and layout of a section that has numbers.
    pub fn of(&self, key: &str) -> Option<(usize, &Layout)> {
        self.sections.get(key).map(|(offset, layout)| (*offset, layout))
    }
}

/// Links shaders and keeps what it has linked.
#[derive(Debug)]
pub(crate) struct Shaders {
    pub places: Arc<Places>,
    hooks: HashMap<&'static str, Vec<&'static str>>,
    own: Vec<&'static About>,
    texts: Mutex<HashMap<String, Arc<Linked>>>,
    parsed: Parsed,
}

impl Shaders {
    /// Of all sections that are known by now.
    pub fn new() -> Result<Self> {
        Self::with(registered().into_iter().map(|r| r.about).collect())
    }

    pub fn with(own: Vec<&'static About>) -> Result<Self> {
        let sections: Vec<&'static About> = LISTED.iter().copied().chain(own.iter().copied()).collect();
        let hooks = sections.iter().map(|about| (about.key, hooks_of(about))).collect();
        Ok(Self {
            places: Arc::new(Places::new(&sections)?),
            hooks,
            own,
            texts: Mutex::default(),
            parsed: Parsed::default(),
        })
    }

    /// Refuses a material with a section that was not known when this was made.
    pub fn check(&self, material: &Material) -> Result<()> {
        match material.sections().find(|s| !self.hooks.contains_key(s.about().key)) {
            None => Ok(()),
            Some(section) => {
                let key = section.about().key;
                let message = format!(
                    "has the section {key}, which this renderer does not know; call material::register before making the renderer"
                );
                Err(Error::Argument { what: format!("material {:?}", material.name), message })
            }
        }
    }

    /// Stages in which a section takes part.
    pub fn hooks(&self, about: &About) -> &[&'static str] {
        self.hooks.get(about.key).map_or(&[], Vec::as_slice)
    }

    /// The linked text of a recipe, made once.
    ///
    /// # Errors
    /// [`Error::Input`] with file and line for a fault in the WGSL of a section.
    pub fn linked(&self, recipe: &Recipe) -> Result<Arc<Linked>> {
        let key = recipe.key();
        if let Some(found) = lock(&self.texts).get(&key) {
            return Ok(Arc::clone(found));
        }
        let linked = Arc::new(self.link(recipe)?);
        lock(&self.texts).insert(key, Arc::clone(&linked));
        Ok(linked)
    }

    fn link(&self, recipe: &Recipe) -> Result<Linked> {
        let tree = Tree { page: self.page(recipe), own: &self.own, parsed: &self.parsed };
        let mut options = CompileOptions { validate: false, ..CompileOptions::default() };
        let on = recipe.options.iter().map(str::to_owned).chain(recipe.sections.iter().map(|a| a.key.to_owned()));
        options.features.flags = on.map(|name| (name, true.into())).collect();
        let root = module_path(&["pass", recipe.pass]);
        let text = wesl::compile(&root, &tree, &NoMangler, &options).map_err(linking)?.to_string();
        let module = naga::front::wgsl::parse_str(&text).map_err(|e| fault_in(&recipe.sections, &text, &e))?;
        let has_fragment = module.entry_points.iter().any(|e| e.stage == naga::ShaderStage::Fragment);
        let of_past = |v: &naga::GlobalVariable| v.binding.as_ref().is_some_and(|b| b.group == 3);
        let reads_past = module.global_variables.iter().any(|(_, v)| of_past(v));
        Ok(Linked { bindings: bindings(&module), text: text.into(), module, has_fragment, reads_past })
    }

    /// The module `package::material` of a recipe.
    pub fn page(&self, recipe: &Recipe) -> String {
        let mut page = String::new();
        let names: Vec<&str> = recipe.sections.iter().map(|a| a.key).collect();
        // Writing to a string cannot fail.
        let _ = writeln!(page, "// Made for {}.", names.join(", "));
        page.push_str(
            "import package::bind::surface::{Border, Shaded, Surface};\nimport package::bind::varying::Varying;\n\
             import package::bind::vertex::Vertex;\nimport package::model::unlit::unlit_model;\n",
        );
        for about in &recipe.sections {
            let key = about.key;
            for stage in self.hooks(about) {
                let folder = if *stage == "model" || !has_function(look_text(about), key, stage) {
                    "model"
                } else {
                    "look"
                };
                let _ = writeln!(page, "import package::{folder}::{key}::{key}_{stage};");
            }
            if self.places.of(key).is_some() {
                let _ = writeln!(page, "import package::look::{key}::{};", about.name);
            }
        }
        self.numbers(recipe, &mut page);
        let mut index = 1;
        for Bound { name, shape } in &recipe.textures {
            let ty = match shape {
                Shape::Flat => "texture_2d<f32>",
                Shape::Array => "texture_2d_array<f32>",
            };
            let _ = writeln!(page, "@group(2) @binding({index}) var {name}: {ty};");
            let _ = writeln!(page, "@group(2) @binding({}) var {name}_sampler: sampler;", index + 1);
            index += 2;
        }
        for stage in STAGES {
            let calls: Vec<&str> =
                recipe.sections.iter().filter(|a| self.hooks(a).contains(&stage.name)).map(|a| a.key).collect();
            stage.write(&calls, &mut page);
        }
        page
    }

    /// The struct of all numbers, with those of the sections that are on at their places.
    fn numbers(&self, recipe: &Recipe, page: &mut String) {
        let placed: Vec<(&About, usize)> =
            recipe.sections.iter().filter_map(|a| Some((*a, self.places.of(a.key)?.0))).collect();
        let Some((_, first)) = placed.first() else { return };
        page.push_str("struct Material {\n");
        if *first > 0 {
            let _ = writeln!(page, "    @align(16) @size({first}) before: vec4f,");
        }
        for (i, (about, offset)) in placed.iter().enumerate() {
            let size = placed.get(i + 1).map_or(String::new(), |(_, next)| format!("@size({}) ", next - offset));
            let _ = writeln!(page, "    @align(16) {size}{}: {},", about.key, about.name);
        }
        page.push_str("}\n@group(2) @binding(0) var<uniform> material: Material;\n");
    }
}

/// The error of the linker, with file and line.
fn linking(error: wesl::Error) -> Error {
    let wesl::Diagnostic { mut error, detail } = wesl::Diagnostic::from(error);
    while let wesl::Error::Error(inner) = *error {
        error = inner.error;
    }
    let module = detail.module_path.map_or_else(|| "wgsl".to_owned(), |m| format!("{}.wgsl", m.components.join("/")));
    let line = detail.source.zip(detail.span).map(|(text, span)| text[..span.start].matches('\n').count() + 1);
    Error::Input {
        // A section of an application stands where its author put it.
        path: module.trim_start_matches("look/").to_owned(),
        pointer: line.map_or_else(|| "file".to_owned(), |line| format!("line {line}")),
        message: error.to_string(),
    }
}

impl Stage {
    /// Its function, which calls those of the sections.
    fn write(&self, sections: &[&str], page: &mut String) {
        let Self { name, takes, gives, fold } = self;
        // A type may hold a comma, but no colon.
        let passed: Vec<&str> = takes.split(": ").filter_map(|t| t.rsplit(", ").next()).collect();
        let passed = &passed[..passed.len() - 1];
        let last = passed.last().copied().unwrap_or_default();
        let call = |section: &str, last: &str| {
            let before = passed[..passed.len() - 1].iter().map(|p| format!("{p}, ")).collect::<String>();
            format!("{section}_{name}({before}{last})")
        };
        let arrow = if gives.is_empty() {
            String::new()
        } else {
            format!(" -> {gives}")
        };
        let mut body = String::new();
        match fold {
            Fold::Each => sections.iter().for_each(|s| body.push_str(&format!("    {};\n", call(s, last)))),
            Fold::Chain => {
                let value = sections.iter().fold(last.to_owned(), |value, s| call(s, &value));
                body.push_str(&format!("    return {value};\n"));
            }
            Fold::Of(operator, none) => {
                body.push_str(&format!("    var value = {none};\n"));
                for s in sections {
                    // Each is called, whatever the others say: textures are read by neighbours together.
                    body.push_str(&format!(
                        "    let of_{s} = {};\n    value = value {operator} of_{s};\n",
                        call(s, last)
                    ));
                }
                body.push_str("    return value;\n");
            }
            Fold::Last(none) => {
                let value = sections.last().map_or_else(|| (*none).to_owned(), |s| call(s, last));
                body.push_str(&format!("    return {value};\n"));
            }
        }
        let _ = writeln!(page, "fn stage_{name}({takes}){arrow} {{\n{body}}}");
    }
}

/// A shader that draws a material.
#[derive(Clone, Debug)]
pub struct MaterialShader {
    /// The pass: stem of its file in `wgsl/pass`.
    pub pass: &'static str,
    /// The generated module `package::material`: which sections take part, stage by stage, and what they bind.
    pub page: String,
    /// The whole text, as the driver gets it.
    pub text: String,
}

/// Every shader that draws a material of a scene with four samples a pixel, in the order of the frame. No adapter is needed.
///
/// # Errors
/// [`Error::Input`] for a fault in the WGSL of an application's section.
pub fn of_material(scene: &Scene, material: usize) -> Result<Vec<MaterialShader>> {
    let shaders = Shaders::new()?;
    let mut list: Vec<MaterialShader> = Vec::new();
    for recipe in recipes_of(&shaders, scene, material) {
        let text = shaders.linked(&recipe)?.text.to_string();
        if !list.iter().any(|s| s.text == text) {
            list.push(MaterialShader { pass: recipe.pass, page: shaders.page(&recipe), text });
        }
    }
    Ok(list)
}

/// Text of a section's file.
fn look_text(about: &About) -> &'static str {
    about.wgsl.unwrap_or_else(|| file(&format!("look/{}", about.key)))
}

fn has_function(text: &str, key: &str, stage: &str) -> bool {
    text.contains(&format!("fn {key}_{stage}("))
}

pub(crate) fn hooks_of(about: &About) -> Vec<&'static str> {
    let model = file(&format!("model/{}", about.key));
    let has = |stage: &&Stage| {
        has_function(look_text(about), about.key, stage.name)
            || (about.is_model && has_function(model, about.key, stage.name))
    };
    STAGES.iter().filter(has).map(|s| s.name).collect()
}

fn module_path(parts: &[&str]) -> ModulePath {
    ModulePath::new(wesl::syntax::PathOrigin::Absolute, parts.iter().map(|p| (*p).to_owned()).collect())
}

/// What a text binds of its material, by number.
fn bindings(module: &naga::Module) -> Vec<Binding> {
    let mut list: Vec<Binding> = module
        .global_variables
        .iter()
        .filter_map(|(_, variable)| {
            let at = variable.binding.as_ref().filter(|b| b.group == 2)?;
            let kind = match module.types[variable.ty].inner {
                naga::TypeInner::Image { arrayed: true, .. } => BindingKind::TextureArray,
                naga::TypeInner::Image { .. } => BindingKind::Texture,
                naga::TypeInner::Sampler { .. } => BindingKind::Sampler,
                _ => BindingKind::Numbers,
            };
            Some(Binding { index: at.binding, name: variable.name.clone().unwrap_or_default(), kind })
        })
        .collect();
    list.sort();
    list
}
