//! The check of a section of an application: whether its WGSL, its numbers and its declaration agree.

use super::material::bytes;
use super::shaders::{Bound, Recipe, STAGES, Shaders, Shape, Stage, file, hooks_of};
use crate::material::{About, Declared, Kind, LISTED, Material, Section, Surroundings, out_of_range, registered};
use crate::{Error, Result};

/// The front end's error, at the line of the section that wrote it.
pub(crate) fn fault_in(sections: &[&'static About], text: &str, error: &naga::front::wgsl::ParseError) -> Error {
    let line = error.location(text).and_then(|l| text.lines().nth(l.line_number as usize - 1)).unwrap_or_default();
    located(sections, text, line, error.message())
}

/// Where a line of a linked text comes from.
fn located(sections: &[&'static About], text: &str, line: &str, message: &str) -> Error {
    let bare = |s: &str| s.chars().filter(|c| !c.is_whitespace() && !"();,".contains(*c)).collect::<String>();
    let wanted = bare(line);
    let found = sections.iter().filter(|a| a.wgsl.is_some()).find_map(|about| {
        let source = about.wgsl?;
        let starting = |name: &str| source.lines().position(|l| l.starts_with(name));
        let at = source.lines().position(|l| !wanted.is_empty() && bare(l) == wanted);
        // The linker writes statements anew: the function is near enough.
        let around = || {
            let before = &text[..text.find(line)?];
            let function = &before[before.rfind("\nfn ")? + 1..];
            starting(function.split('(').next()?)
        };
        // A hook that takes other things than its stage gives.
        let called = || {
            let is_called = |s: &&Stage| line.contains(&format!("fn stage_{}(", s.name));
            STAGES.iter().filter(is_called).find_map(|s| starting(&format!("fn {}_{}(", about.key, s.name)))
        };
        let at = at.or_else(around).or_else(called);
        Some((format!("{}.wgsl", about.key), format!("line {}", at? + 1)))
    });
    let (path, pointer) = found.unwrap_or_else(|| ("wgsl".to_owned(), "linked text".to_owned()));
    Error::Input { path, pointer, message: format!("{message}: {}", line.trim()) }
}

/// What a section may ask for: members of the varying, and what the prepass draws.
fn known_needs() -> Vec<&'static str> {
    let members = file("bind/varying").lines().filter_map(|line| {
        let (option, member) = line.trim().strip_prefix("@if(")?.split_once(") ")?;
        member.starts_with("@location").then_some(option)
    });
    members.chain(["prepass", "prepass_surfaces"]).collect()
}

/// Links and validates a section of an application in a toon surface, with every option off and with its textures.
pub(crate) fn check_section<S: Section + Declared + Clone + Default + PartialEq>() -> Result<()> {
    let about = S::ABOUT;
    let refuse = |message: String| {
        let (path, pointer) = (format!("{}.wgsl", about.key), format!("section {}", about.key));
        Err(Error::Input { path, pointer, message })
    };
    let known = known_needs();
    if let Some(need) = about.needs.iter().find(|n| !known.contains(n)) {
        return refuse(format!("needs {need:?}, which there is not; there are: {}", known.join(", ")));
    }
    if let Some((key, message)) = out_of_range(&mut S::default()) {
        return refuse(format!("the default of {key}: {message}"));
    }
    if hooks_of(about).is_empty() {
        let names: Vec<String> = STAGES.iter().map(|s| format!("{}_{}", about.key, s.name)).collect();
        return refuse(format!("no function of it is hooked into a stage; expected one of: {}", names.join(", ")));
    }
    let shaders = Shaders::with(registered().into_iter().map(|r| r.about).chain([about]).collect())?;
    let base = LISTED.iter().copied().filter(|a| ["base", "toon"].contains(&a.key));
    let mut recipe = Recipe { sections: base.chain([about]).collect(), ..Recipe::plain("opaque") };
    for option in ["lit", "normal", "world", "uv"].iter().chain(about.needs) {
        recipe.options.set(*option, true);
    }
    for field in about.inner.fields.iter().filter(|f| matches!(f.kind, Kind::Texture(_))) {
        let name = format!("{}_{}", about.key, field.name);
        recipe.options.set(name.clone(), true);
        recipe.textures.push(Bound { name, shape: Shape::Flat });
    }
    let mut material = Material::default();
    material.set_own(Some(S::default()));
    bytes(&shaders.places, &Surroundings::alone(&material))?;
    let linked = shaders.linked(&recipe)?;
    let module =
        naga::front::wgsl::parse_str(&linked.text).map_err(|e| fault_in(&recipe.sections, &linked.text, &e))?;
    let mut validator =
        naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::empty());
    validator.validate(&module).map(|_| ()).map_err(|e| {
        // Of the function, the statement and the expression at fault, the last one is the shortest.
        let spans = e.spans().map(|(span, _)| *span).filter(naga::Span::is_defined);
        let at = spans.min_by_key(|s| s.to_range().map_or(usize::MAX, |r| r.len()));
        let line = at.and_then(|s| linked.text.lines().nth(s.location(&linked.text).line_number as usize - 1));
        let mut reason: &dyn std::error::Error = e.as_inner();
        while let Some(inner) = reason.source() {
            reason = inner;
        }
        located(&recipe.sections, &linked.text, line.unwrap_or_default(), &reason.to_string())
    })
}
