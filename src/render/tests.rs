//! Every section alone and all that go together: each number is written once, each shader links and is valid. No adapter is
//! needed.

use std::collections::HashSet;

use naga::valid::{Capabilities, ValidationFlags, Validator};
use rayon::prelude::*;
use toml::{Table, Value};

use super::Output;
use super::draw_list::surface_requests;
use super::environment::{LEVELS, SIDE, SPLIT_SUM_SIDE};
use super::layout::Layout;
use super::material::{Composition, NOT_OF_EYES, bytes};
use super::pass::{DEPTH_FORMAT, Mark, Picture, Sight, bangs_shadow, fibre, glow, prepass, shadow, velocity};
use super::shaders::{Recipe, Shaders, file};
use super::variants::Request;
use crate::material::{About, Alpha, AlphaMode, Blending, Field, Kind, LISTED, Material, Shading, Surroundings};
use crate::sdf::FaceMap;

/// Values of fields that hold all that they can: every texture, every part.
fn whole(fields: &[Field]) -> Table {
    let value = |field: &Field| match field.kind {
        Kind::Texture(_) if field.name == "map" && fields.iter().any(|f| f.name == "overhead_fade") => None,
        Kind::Texture(_) => Some(Value::Table(Table::from_iter([("texture".to_owned(), Value::Integer(0))]))),
        Kind::Part(inner) if field.name == "placed" => Some(Value::Array(vec![Value::Table(whole(inner.fields))])),
        Kind::Part(inner) => Some(Value::Table(whole(inner.fields))),
        _ => None,
    };
    fields.iter().filter_map(|f| Some((f.name.to_owned(), value(f)?))).collect()
}

/// A material with these sections, whole or at their defaults.
fn material_with(sections: &[&About], is_whole: bool, mode: AlphaMode) -> Material {
    let mut table = Table::new();
    for about in sections {
        let section = if is_whole {
            whole(about.inner.fields)
        } else {
            needed(about.inner.fields)
        };
        if ["toon", "standard"].contains(&about.key) {
            let shading = Table::from_iter([(about.key.to_owned(), Value::Table(section))]);
            table.insert("shading".to_owned(), Value::Table(shading));
        } else {
            table.insert(about.key.to_owned(), Value::Table(section));
        }
    }
    let mut material: Material = Value::Table(table).try_into().expect("sections");
    material.alpha = Alpha { mode, ..Alpha::default() };
    // What is black or without width is off.
    material.emission.color = [1.0; 3];
    material.rim.color = [1.0; 3];
    if let Some(outline) = &mut material.outline {
        outline.width = crate::material::OutlineWidth::World { metres: 0.01 };
    }
    material
}

/// Values without which a section says nothing.
fn needed(fields: &[Field]) -> Table {
    let mut table = whole(fields);
    table.retain(|key, _| ["placed", "map"].contains(&key));
    table
}

fn surroundings<'a>(material: &'a Material, face_maps: &'a [FaceMap]) -> Surroundings<'a> {
    Surroundings { face_maps, self_shadow: true, ..Surroundings::alone(material) }
}

fn face_maps() -> Vec<FaceMap> {
    let texels = vec![[0u16; 4]; 4];
    let layers = || vec![texels.clone(), texels.clone()];
    vec![FaceMap {
        width: 2,
        height: 2,
        pitches_rad: vec![-0.5, 0.5],
        front: layers(),
        back: layers(),
        masks: texels.clone(),
        ..FaceMap::default()
    }]
}

/// Everything that draws a material.
fn requests(shaders: &Shaders, material: &Material, colors: bool, channel: Option<&str>, samples: u32) -> Vec<Request> {
    let maps = face_maps();
    let of = Composition::new(shaders, &surroundings(material, &maps));
    let sight = Sight { channel, punctual: samples == 4, environment: samples == 4, hdr: false };
    let picture = Picture { output: Output { samples, ..Output::default() }, depth_format: DEPTH_FORMAT, sight };
    let draw = super::draw_list::Draw {
        material: 0,
        indices: 0..3,
        first_person: 0..0,
        center: glam::Vec3::ZERO,
        has_vertex_colors: colors,
        blend: material.alpha.mode == AlphaMode::Blend,
        layered: material.blending() != Blending::Sorted,
        core: material.has_core(),
        weighted: material.blending() == Blending::Weighted,
        write_depth: true,
        queue_offset: 0,
        casts_on_face: true,
        casts_lids: true,
        mark: Mark::Eyes,
    };
    let mut list: Vec<Request> = surface_requests(&draw, &of, material, &picture).iter().cloned().collect();
    list.extend(of.has("glow").then(|| glow::request(&of, material, colors)));
    list.push(shadow::request(&of, colors));
    list.push(bangs_shadow::request(&of, colors));
    list.push(velocity::request(&of, material, colors));
    list.extend([true, false].map(|surfaces| prepass::request(&of, material, colors, surfaces)));
    list
}

fn validate(shaders: &Shaders, recipe: &Recipe) {
    let linked = shaders.linked(recipe).unwrap_or_else(|e| panic!("{recipe:?}: {e}"));
    let module = naga::front::wgsl::parse_str(&linked.text)
        .unwrap_or_else(|e| panic!("{recipe:?}: {}", e.emit_to_string(&linked.text)));
    Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(&module)
        .unwrap_or_else(|e| panic!("{recipe:?}: {}", e.emit_to_string(&linked.text)));
}

/// Validates each shader once.
fn validate_all(shaders: &Shaders, materials: &[(Material, Option<&'static str>)]) {
    let mut seen = HashSet::new();
    let mut recipes = Vec::new();
    for (material, channel) in materials {
        for (colors, samples) in [(false, 1), (true, 4)] {
            let requests = requests(shaders, material, colors, *channel, samples);
            recipes.extend(requests.into_iter().map(|r| r.recipe).filter(|r| seen.insert(format!("{r:?}"))));
        }
    }
    recipes.par_iter().for_each(|recipe| validate(shaders, recipe));
}

#[test]
fn every_section_alone_links_in_every_pass() {
    let shaders = Shaders::new().expect("sections");
    let mut materials = Vec::new();
    for about in LISTED {
        for is_whole in [false, true] {
            for mode in [AlphaMode::Opaque, AlphaMode::Mask, AlphaMode::Blend] {
                materials.push((material_with(&[about], is_whole, mode), None));
            }
        }
        let material = material_with(&[about], true, AlphaMode::Mask);
        materials.extend(about.channels().map(|(channel, _)| (material.clone(), Some(channel))));
        let mut hashed = material.clone();
        hashed.alpha.hashed = true;
        materials.push((hashed, None));
        for blending in [Blending::ThreePass, Blending::DoubleLayer, Blending::Weighted] {
            let mut layered = material_with(&[about], true, AlphaMode::Blend);
            layered.alpha.blending = blending;
            materials.push((layered, None));
        }
        materials.push((Material { shading: Shading::Unlit, ..material }, None));
    }
    validate_all(&shaders, &materials);
}

#[test]
fn all_sections_that_go_together_link_in_every_pass() {
    let shaders = Shaders::new().expect("sections");
    let mut materials = Vec::new();
    const EYES: &[&str] = &["eye", "eye_depth"];
    // Each model in turn, and each of two that exclude each other.
    for (without, or) in [
        (["gem", "diamond", "standard"], EYES),
        (["gem", "shade_ramp", "standard"], EYES),
        (["diamond", "fur_detail", "standard"], EYES),
        (["gem", "transition", "standard"], EYES),
        (["gem", "diamond", "toon"], EYES),
        (["gem", "shade_ramp", "toon"], EYES),
        (["diamond", "transition", "toon"], EYES),
        (["gem", "diamond", "standard"], NOT_OF_EYES),
        (["gem", "shade_ramp", "toon"], NOT_OF_EYES),
    ] {
        let is_kept = |a: &&About| !without.contains(&a.key) && !or.contains(&a.key);
        let kept: Vec<&About> = LISTED.iter().copied().filter(is_kept).collect();
        for mode in [AlphaMode::Opaque, AlphaMode::Mask, AlphaMode::Blend] {
            for is_whole in [false, true] {
                let material = material_with(&kept, is_whole, mode);
                materials.push((Material { fire: None, ..material.clone() }, None));
                let alpha = Alpha { blending: Blending::Weighted, ..material.alpha };
                materials.push((Material { fire: None, alpha, ..material.clone() }, None));
                materials.push((material, None));
            }
        }
        let material = material_with(&kept, true, AlphaMode::Opaque);
        let channels = LISTED.iter().flat_map(|a| a.channels());
        materials.extend(channels.map(|(channel, _)| (material.clone(), Some(channel))));
    }
    validate_all(&shaders, &materials);
}

#[test]
fn passes_without_a_material_are_valid() {
    let shaders = Shaders::new().expect("sections");
    for pass in ["background", "bangs_near", "bloom", "deform", "environment", "fibre", "temporal"] {
        validate(&shaders, &Recipe::plain(pass));
    }
    for (several, encodes) in [(false, false), (true, false), (false, true), (true, true)] {
        let recipe = Recipe::plain("resolve").with("multisampled", several).with("encode_srgb", encodes);
        validate(&shaders, &recipe);
    }
    for (encodes, smooths) in [(false, false), (true, false), (false, true), (true, true)] {
        validate(&shaders, &Recipe::plain("post").with("encode_srgb", encodes).with("antialias", smooths));
    }
}

/// Faults would be an error: members that nobody writes, that do not exist, or of another size.
#[test]
fn every_member_of_every_section_is_written_once() {
    let shaders = Shaders::new().expect("sections");
    let maps = face_maps();
    for about in LISTED {
        for is_whole in [false, true] {
            let material = material_with(&[about], is_whole, AlphaMode::Blend);
            let written = bytes(&shaders.places, &surroundings(&material, &maps)).unwrap_or_else(|e| panic!("{e}"));
            assert_eq!(written.len(), shaders.places.size, "{}", about.key);
        }
        assert!(shaders.places.of(about.key).is_some(), "{} has no struct {}", about.key, about.name);
    }
}

/// Only the hooks of stages call into a section: a function that no stage knows would be dead.
#[test]
fn every_section_takes_part_in_a_stage_or_has_a_pass() {
    let shaders = Shaders::new().expect("sections");
    for about in LISTED {
        let has_pass = ["outline", "fluff", "glow"].contains(&about.key);
        // The toon model asks the ramp.
        let is_asked = about.key == "shade_ramp";
        assert!(!shaders.hooks(about).is_empty() || has_pass || is_asked, "{} does nothing", about.key);
    }
}

#[test]
fn what_binds_more_than_a_device_promises_names_its_sections() {
    let shaders = Shaders::new().expect("sections");
    let all: Vec<&About> =
        LISTED.iter().copied().filter(|a| !["standard", "eye", "eye_depth"].contains(&a.key)).collect();
    let material = material_with(&all, true, AlphaMode::Opaque);
    let maps = face_maps();
    let error = Composition::new(&shaders, &surroundings(&material, &maps)).check("Everything").expect_err("too many");
    let message = error.to_string();
    for word in ["Everything", "toon (2)", "face_paint (1)", "leave some"] {
        assert!(message.contains(word), "{message}");
    }
}

/// A number that a file of `wgsl/` names; files that import others are not WGSL for themselves.
fn constant(module: &str, name: &str) -> u32 {
    let start = format!("const {name}: ");
    let line = file(module).lines().find_map(|line| line.strip_prefix(&start));
    let value = line.and_then(|line| line.split_once(" = ")?.1.strip_suffix(';'));
    let number = value.and_then(|value| value.trim_end_matches(".0").trim_end_matches('u').parse().ok());
    number.unwrap_or_else(|| panic!("{module} has no number {name}: {line:?}"))
}

#[test]
fn tables_are_as_large_in_shaders() {
    assert_eq!(constant("pass/environment", "LEVELS"), LEVELS);
    let texel = format!("6.0 * {SIDE}.0 * {SIDE}.0");
    assert!(file("pass/environment").contains(&texel), "the solid angle of a texel is that of another side");

    assert_eq!(constant("lib/split_sum", "SPLIT_SUM_SIDE") as usize, SPLIT_SUM_SIDE);
    let entries = SPLIT_SUM_SIDE * SPLIT_SUM_SIDE;
    assert_eq!(Layout::of(file("bind/frame"), "SplitSum").size, entries * size_of::<[f32; 2]>());

    let twice = constant("lib/fibre", "TABLE_ROWS") * 2;
    assert_eq!([constant("lib/fibre", "TABLE_ANGLES") + 2, twice], fibre::SIZE, "two columns of energies follow");
}
