//! The anime look: which sections each role gets.

use std::collections::BTreeSet;

use glam::{Quat, Vec3};
use rayon::prelude::*;

use super::{Anime, hair_band, shade};
use crate::color::LinearRgb;
use crate::material::{
    AlphaMode, Authored, BangsShadow, CastShadow, DepthRim, Diamond, FacePaint, FaceShadow, Fire, Fluff, FurDetail,
    Gem, Glow, Highlight, Layer, Material, Outline, OutlineTint, OutlineWidth, RampMaps, ShadeRamp, Shading,
    ShapedHighlight, Sparkle, Stocking, Substance, TintSource, Transition,
};
use crate::scene::{Bangs, Bloom, EyesThrough, Post, Role, Scene, SelfShadow, Warning};
use crate::sdf::{FaceMap, Feature, Guide, Sides};
use crate::smoothstep::smoothstep;

/// Materials that get a face's shadow: characters have one to three, and a file of thousands must not fill the memory.
const MOST_FACES: usize = 16;

pub(super) fn apply(scene: &mut Scene, look: &Anime) {
    let before: Vec<[f32; 3]> = scene.materials.iter().map(shade_factor).collect();
    let of_faces: Vec<usize> = materials_of(scene, Role::Face).into_iter().take(MOST_FACES).collect();
    let guides = || of_faces.par_iter().map(|face| Guide::new(scene, *face, look.face_style)).collect::<Vec<_>>();
    let (guides, greys) = rayon::join(guides, || shade::greys(scene));
    shade::apply(scene, greys);
    scene.bangs = Some(Bangs::default());
    scene.eyes_through = Some(EyesThrough::default());
    outlines(scene);
    borders(scene);
    round_hair(scene);
    hair(scene, look);
    faces(scene, look, of_faces.into_iter().zip(guides), &before);
    body_rims(scene);
    self_shadow(scene);
    eyes(scene);
    for material in bare_skin(scene) {
        scene.materials[material].transition = Some(Transition::default());
    }
    cloth(scene);
    painted_shade(scene);
    substances(scene);
    post(scene);
    let shadow = BangsShadow { color: [0.78, 0.5, 0.52], ..BangsShadow::default() };
    for material in materials_of(scene, Role::Mouth) {
        scene.materials[material].bangs_shadow = Some(shadow);
    }
}

/// Materials that a part of this role has.
pub(super) fn materials_of(scene: &Scene, role: Role) -> BTreeSet<usize> {
    let parts = scene.meshes.iter().flat_map(|m| &m.primitives);
    parts.filter(|p| p.role == role).map(|p| p.material).filter(|m| *m < scene.materials.len()).collect()
}

/// Materials that a part of any of these roles has.
pub(super) fn materials_of_any(scene: &Scene, roles: &[Role]) -> BTreeSet<usize> {
    roles.iter().flat_map(|role| materials_of(scene, *role)).collect()
}

/// What lies over skin.
const WORN: [Role; 5] = [Role::Hair, Role::HairFront, Role::Cloth, Role::Accessory, Role::Other];

/// Materials of skin alone: a palette of a whole character may count a dressed body among it.
fn bare_skin(scene: &Scene) -> BTreeSet<usize> {
    let skin = materials_of_any(scene, &[Role::Face, Role::Skin, Role::Mouth]);
    skin.difference(&materials_of_any(scene, &WORN)).copied().collect()
}

/// Luminance up to which a line counts as black.
const BLACK: f32 = 0.02;

/// Lines in a dark tone of what they surround: instead of black ones, and round a character whose file knows none.
fn outlines(scene: &mut Scene) {
    if scene.materials.iter().any(|m| m.outline.is_some()) {
        let worn = materials_of_any(scene, &WORN);
        for (index, material) in scene.materials.iter_mut().enumerate() {
            let Some(outline) = &mut material.outline else { continue };
            if outline.color.iter().all(|c| *c < BLACK) {
                outline.tint = Some(OutlineTint::default());
            } else if outline.lighting_mix == 1.0 {
                // A drawn line keeps in shade the colour that it has in light.
                let factor = outline.color;
                let kept = OutlineTint {
                    from: TintSource::Lit,
                    gamma: 1.0,
                    saturation: 1.0,
                    factor,
                    ..OutlineTint::default()
                };
                outline.tint = Some(kept);
            }
            // A pen has one width, however near the camera comes. From afar a line is a pixel wide, where it cannot cross a
            // face.
            let least = if worn.contains(&index) { 1.0 } else { 0.0 };
            outline.clamp_px.get_or_insert([least, 4.0]);
        }
        return;
    }
    let solid = [Role::Face, Role::Skin, Role::Hair, Role::HairFront, Role::Cloth, Role::Accessory, Role::Other];
    for index in materials_of_any(scene, &solid) {
        let material = &mut scene.materials[index];
        if material.alpha.mode != AlphaMode::Blend {
            let width = OutlineWidth::Screen { height_ratio: 0.0021 };
            material.outline = Some(Outline { width, tint: Some(OutlineTint::default()), ..Outline::default() });
        }
    }
}

/// How crisp the border of shade is at least on clothes, as MToon measures it: one stroke of a brush; and on what is round and
/// spreads a border wider, as hair and helmets.
const CRISP: f32 = 0.95;
const CRISP_ON_ROUND: f32 = 0.985;

/// Crisp borders on all but skin, whose light turns warm before it turns to shade.
fn borders(scene: &mut Scene) {
    let round: &[Role] = &[Role::Hair, Role::HairFront, Role::Accessory, Role::Other];
    for (roles, crisp) in [(round, CRISP_ON_ROUND), (&[Role::Cloth], CRISP)] {
        for index in materials_of_any(scene, roles) {
            if let Shading::Toon(toon) = &mut scene.materials[index].shading {
                toon.toony = toon.toony.max(crisp);
            }
        }
    }
}

/// Share of the way to its shade that cloth has gone where its light ends, and how far from there it begins, in N·L: folds and
/// the turn of a sleeve show in light, too.
const HALFTONE: f32 = 0.85;
const HALFTONE_WIDTH: f32 = 0.8;

/// A soft half-tone on clothes whose shade is a factor of their light.
fn cloth(scene: &mut Scene) {
    for index in materials_of(scene, Role::Cloth) {
        let material = &mut scene.materials[index];
        if let Some(factor) = own_shade_factor(material) {
            let color = factor.map(|f| 1.0 - HALFTONE * (1.0 - f));
            material.transition = Some(Transition { color, width: HALFTONE_WIDTH, ..Transition::default() });
        }
    }
}

/// Head, body and clothes cast on body and clothes, and of a face on the neck. Locks of hair and tufts of fur do not: nobody
/// draws the shade of each, and their edges would tear all others.
fn self_shadow(scene: &mut Scene) {
    // What nobody knows for a face would be cut across its eyes by the shadow of a hat.
    if scene.head_node().is_some() && materials_of(scene, Role::Face).is_empty() {
        let message = "cast shadows are left out: no part is known to be the face, which those of a hat would darken; \
            say which one is, as in [parts] Head = \"face\"";
        scene.warnings.push(Warning { pointer: "/meshes".to_owned(), message: message.to_owned() });
        return;
    }
    scene.self_shadow = Some(SelfShadow::default());
    let face = materials_of_any(scene, &[Role::Face]);
    for index in materials_of_any(scene, &[Role::Face, Role::Skin, Role::Cloth, Role::Accessory, Role::Other]) {
        let material = &mut scene.materials[index];
        // A face without a map would get all of it; what is as bright in shade as in light shows none.
        let is_bare = face.contains(&index) && material.face_shadow.is_none();
        let is_flat = own_shade_factor(material) == Some([1.0; 3]);
        let received = if is_bare || is_flat { 0.0 } else { 1.0 };
        if material.alpha.mode != AlphaMode::Blend {
            material.cast_shadow = Some(CastShadow { casts: material.alpha.mode == AlphaMode::Opaque, received });
        }
    }
}

/// How far the normals of hair are turned to those of a round head.
const ROUNDED: f32 = 0.6;
/// How far those of a lock are turned about the head to either side at most, radians: the border of shade steps from lock to
/// lock, and is no straight line across them.
const STEP: f32 = 0.2;

/// Lets light fall on hair as on one round shape, so that its shade lies in masses and not in a stripe for each lock: round
/// the head above its middle, round its axis below.
fn round_hair(scene: &mut Scene) {
    let Some((low, high)) = scene.face_box(None) else { return };
    let middle = (low + high) * 0.5;
    scene.for_each_hair(|part, matrix| {
        let back = matrix.inverse();
        if !back.is_finite() {
            return;
        }
        let (locks, _) = part.pieces();
        // Neighbours in the file differ most: shares of the golden ratio.
        let steps: Vec<Quat> = locks
            .iter()
            .map(|lock| Quat::from_rotation_y(STEP * (2.0 * (*lock as f32 * 0.618_034).fract() - 1.0)))
            .collect();
        for ((normal, position), step) in part.normals.iter_mut().zip(&part.positions).zip(steps) {
            let out = matrix.transform_point3(Vec3::from(*position)) - middle;
            let round = step * out.with_y(out.y.max(0.0)).normalize_or(Vec3::Y);
            let own = Vec3::from(*normal);
            let round = back.transform_vector3(round).normalize_or(own);
            // The inner side of a lock keeps its own.
            let turned = own.lerp(round, ROUNDED * smoothstep(-0.2, 0.4, own.dot(round)));
            *normal = turned.normalize_or(own).to_array();
        }
    });
}

/// A band that follows view and light: painted, where the file carries one, else round the head.
fn hair(scene: &mut Scene, look: &Anime) {
    let mut bare = BTreeSet::new();
    for role in [Role::HairFront, Role::Hair] {
        for index in materials_of(scene, role) {
            let material = &mut scene.materials[index];
            material.depth_rim = (material.alpha.mode != AlphaMode::Blend).then_some(rim());
            material.highlight = material.authored.highlight.map(|map| Highlight {
                map,
                second_strength: 0.5,
                second_color: [0.86, 0.84, 1.0],
                breakup: 0.35,
                in_shade: 0.08,
                ..Highlight::default()
            });
            // Wisps of alpha are drawn, not lit.
            if material.highlight.is_none() && material.alpha.mode != AlphaMode::Blend {
                bare.insert(index);
            }
        }
    }
    hair_band::add(scene, &bare, look.band);
}

/// A lock before the hair of the back is no contour, and neither is an arm before the chest.
fn rim() -> DepthRim {
    DepthRim { threshold_m: 0.15, width_px: 3.0, ..DepthRim::default() }
}

/// Warm and faint.
fn skin_rim() -> DepthRim {
    DepthRim { color: [0.6, 0.5, 0.44], strength: 0.5, ..rim() }
}

/// Rims of the body: those of skin, and in the cloth's own colour on clothes.
fn body_rims(scene: &mut Scene) {
    let cloth = DepthRim { tint: 0.85, strength: 0.8, ..rim() };
    let faces = materials_of(scene, Role::Face);
    let skin = bare_skin(scene).difference(&faces).copied().collect();
    for (materials, rim) in [(materials_of(scene, Role::Cloth), cloth), (skin, skin_rim())] {
        for index in materials {
            let material = &mut scene.materials[index];
            material.depth_rim = (material.alpha.mode != AlphaMode::Blend).then_some(rim);
        }
    }
}

fn faces(scene: &mut Scene, look: &Anime, guides: impl Iterator<Item = (usize, Option<Guide>)>, before: &[[f32; 3]]) {
    for (index, guide) in guides {
        let guide = match look.face {
            Some(_) => guide,
            None => guide.and_then(|guide| safe_guide(scene, index, guide, before)),
        };
        let map = guide.and_then(|guide| match &look.face {
            Some(painted) => Some(over(painted, &guide.over_texture(scene, index)?)),
            None => unwrapped(scene, index, &guide),
        });
        let shade = shade_factor(&scene.materials[index]);
        let material = &mut scene.materials[index];
        material.bangs_shadow = Some(BangsShadow { color: shade, ..BangsShadow::default() });
        material.transition = Some(Transition::default());
        material.depth_rim = Some(skin_rim());
        material.highlight = material.authored.highlight.map(|map| Highlight {
            map,
            strength: 0.9,
            light_v: 0.0,
            view_v: 0.0,
            turn_u: 0.012,
            in_shade: 0.0,
            facing: 0.35,
            ..Highlight::default()
        });
        material.face_paint = material.authored.face_paint.map(|map| FacePaint { map, ..FacePaint::default() });
        if let Some(map) = map {
            scene.face_maps.push(map);
            material.face_shadow = Some(FaceShadow { map: scene.face_maps.len() - 1, ..FaceShadow::default() });
        }
    }
}

/// Ramps and strokes of fur, where the file carries them. Eyes stay as they are drawn.
fn painted_shade(scene: &mut Scene) {
    let eyes = materials_of_any(scene, &[Role::EyeWhite, Role::Eye, Role::EyeHighlight, Role::Lash, Role::Brow]);
    let skin = bare_skin(scene);
    for (index, material) in scene.materials.iter_mut().enumerate().filter(|(i, _)| !eyes.contains(i)) {
        let Authored { ramps, ramp_rows: [rows, row], part_ids, part_rows, detail_normal, .. } = material.authored;
        let part_rows = part_rows.map(|r| u32::try_from(r).unwrap_or(row));
        // Where no part has a row of its own, the map need not be read.
        let part_ids = part_ids.filter(|_| part_rows.iter().any(|r| *r != row));
        let maps = ramps.map(|[warm, cool]| RampMaps { warm, cool, rows, row, part_ids, part_rows });
        // On skin the terminator is a thin blush.
        let width = if skin.contains(&index) {
            0.18
        } else {
            ShadeRamp::default().width
        };
        material.shade_ramp = maps.map(|maps| ShadeRamp { maps: Some(maps), width, ..ShadeRamp::default() });
        if maps.is_some() {
            material.transition = None;
        }
        material.fur_detail = detail_normal.map(|detail_normal| FurDetail { detail_normal, ..FurDetail::default() });
    }
}

/// Metal, stones, fire and fluff, where the file says so.
fn substances(scene: &mut Scene) {
    for material in &mut scene.materials {
        let Authored { highlight_shape, inclusions, heat, substance, .. } = material.authored;
        let Some(substance) = substance else { continue };
        let stone = |gem: Gem| Some(Gem { inclusions, ..gem });
        match substance {
            Substance::Metal => {
                material.shaped_highlight =
                    Some(ShapedHighlight { map: highlight_shape, matcap_mix: 0.55, ..ShapedHighlight::default() });
                material.glow = Some(Glow { emission: 1.0, highlight: 0.5 });
            }
            Substance::Amber => {
                material.gem = stone(Gem::amber());
                material.sparkle = Some(Sparkle::dust());
            }
            Substance::Ruby => {
                material.gem = stone(Gem::ruby());
                material.sparkle = Some(Sparkle::dust());
            }
            // Milk hides what would flash.
            Substance::Jade => material.gem = stone(Gem::jade()),
            Substance::Diamond => {
                material.diamond = Some(Diamond::default());
                material.sparkle = Some(Sparkle { color: [3.0; 3], spacing_px: 9.0, ..Sparkle::default() });
                material.glow = Some(Glow { emission: 1.0, highlight: 1.0 });
            }
            Substance::Fire => {
                material.fire = Some(Fire { heat, ..Fire::default() });
                material.glow = Some(Glow { emission: 0.6, ..Glow::default() });
            }
            Substance::Fluff => {
                material.fluff = Some(Fluff::default());
                // Its contour is soft.
                material.outline = None;
            }
            // The file paints the knit itself; it gets darker where it is seen aslant.
            Substance::Stocking => {
                material.stocking = Some(Stocking { color: [0.012, 0.01, 0.022], cover: 0.12 });
            }
        }
        if material.gem.is_some() || material.diamond.is_some() {
            // What the file paints in their place.
            material.matcap = None;
            material.shade_ramp = None;
        }
    }
}

/// Light spreads where something glows.
fn post(scene: &mut Scene) {
    if scene.materials.iter().any(|m| m.glow.is_some()) {
        scene.post = Some(Post { bloom: Some(Bloom::default()), ..Post::default() });
    }
}

/// White, iris and lights lie on one another in this order. Lids and bangs shade the first two, which stay readable in
/// shade; the lights stay lit.
fn eyes(scene: &mut Scene) {
    for (role, index, shadow) in [
        (Role::EyeWhite, 0, Some([0.72, 0.68, 0.84])),
        (Role::Eye, 1, Some([0.7, 0.65, 0.76])),
        (Role::EyeHighlight, 2, None),
    ] {
        for material in materials_of(scene, role) {
            let material = &mut scene.materials[material];
            material.layer = Some(Layer { index, stay_lit: if shadow.is_some() { 0.6 } else { 1.0 } });
            material.bangs_shadow =
                shadow.map(|color| BangsShadow { color, strength: 0.7, lids: true, ..BangsShadow::default() });
        }
    }
}

/// What the lit colour is multiplied by in shade, where one texture serves both; else the default of the shadow.
fn shade_factor(material: &Material) -> [f32; 3] {
    own_shade_factor(material).unwrap_or(BangsShadow::default().color)
}

/// What the lit colour is multiplied by in shade, where one texture serves both.
fn own_shade_factor(material: &Material) -> Option<[f32; 3]> {
    let Shading::Toon(toon) = material.shading else { return None };
    let share = |shade: f32, base: f32| {
        if base > 1e-3 {
            (shade / base).clamp(0.0, 1.0)
        } else {
            1.0
        }
    };
    let [r, g, b, _] = material.base.color;
    let factor = [share(toon.shade_color[0], r), share(toon.shade_color[1], g), share(toon.shade_color[2], b)];
    (toon.shade_texture == material.base.texture).then_some(factor)
}

/// Front of a face that may be lit otherwise than by its file under light from the front.
const MOST_CHANGED: f32 = 0.4;

/// The shadow made from a face's mesh, where it keeps what the face is read by: else the file's own shading is left there, and a
/// warning says so.
fn safe_guide(scene: &mut Scene, index: usize, mut guide: Guide, before: &[[f32; 3]]) -> Option<Guide> {
    let material = &scene.materials[index];
    let Shading::Toon(toon) = material.shading else { return Some(guide) };
    let luminance = |factor: [f32; 3]| LinearRgb(factor).luminance();
    let shades = [before.get(index).copied().unwrap_or([1.0; 3]), shade_factor(material)].map(luminance);
    let pointer = format!("/materials/{index}");
    let changed = guide.changed(&toon);
    if changed > MOST_CHANGED {
        let message = format!(
            "face shadow left to the file: the map from the mesh would change {:.0} % of the face under light from the front",
            changed * 100.0
        );
        scene.warnings.push(Warning { pointer, message });
        return None;
    }
    let mut left = Vec::new();
    for feature in Feature::ALL {
        let contrast = |guide: &Guide| guide.contrast(feature, &toon, shades).filter(|c| !c.is_kept());
        let Some(found) = contrast(&guide) else { continue };
        // As little as serves.
        for share in [0.25, 0.5, 0.75, 1.0] {
            guide.leave(feature, share);
            if contrast(&guide).is_none() {
                break;
            }
        }
        let name = match feature {
            Feature::Eyes => "eyes",
            Feature::Brows => "brows",
            Feature::Nose => "nose",
            Feature::Mouth => "mouth",
        };
        // It lives from the shade round it, too.
        let is_lost = contrast(&guide).is_some();
        let what = if is_lost { "face shadow" } else { name };
        let message = format!(
            "{what} left to the file's shading: the contrast of the {name} fell from {:.3} to {:.3} under light from {:.0} \
             degrees",
            found.before, found.after, found.yaw_deg
        );
        let warning = Warning { pointer: pointer.clone(), message };
        if is_lost {
            scene.warnings.push(warning);
            return None;
        }
        left.push(warning);
    }
    scene.warnings.append(&mut left);
    Some(guide)
}

/// The map of a face on coordinates of its own, which do not share or mirror what its texture does; over the texture where the
/// parts of the material have a second set already.
fn unwrapped(scene: &mut Scene, material: usize, guide: &Guide) -> Option<FaceMap> {
    let mut parts = scene.meshes.iter().flat_map(|m| &m.primitives).filter(|p| p.material == material);
    if parts.any(|p| p.uvs.len() > 1) {
        return guide.over_texture(scene, material);
    }
    let world = scene.rest_world_from_nodes();
    for node in 0..scene.nodes.len() {
        let matrix = scene.rest_placement(&world, node);
        let Some(mesh) = scene.nodes[node].mesh.and_then(|m| scene.meshes.get_mut(m)) else { continue };
        for part in mesh.primitives.iter_mut().filter(|p| p.material == material && p.uvs.len() < 2) {
            let is_face = part.role == Role::Face;
            let place = |p: &[f32; 3]| {
                if is_face {
                    guide.unwrap(matrix.transform_point3(Vec3::from(*p)))
                } else {
                    // A corner, where all is left to normals.
                    [0.0, -1.0]
                }
            };
            let set = part.positions.iter().map(place).collect();
            if part.uvs.is_empty() {
                part.uvs.push(vec![[0.0; 2]; part.positions.len()]);
            }
            part.uvs.push(set);
        }
    }
    Some(guide.over_relief())
}

/// The painted thresholds, with the regions of the map from the mesh.
fn over(painted: &Sides, mesh: &FaceMap) -> FaceMap {
    let mut texels = painted.texels();
    let [width, height] = [texels.width as usize, texels.height as usize];
    let regions = mesh.front.first().map_or(&[] as &[[u16; 4]], Vec::as_slice);
    for (i, texel) in texels.rgba.iter_mut().enumerate() {
        let (x, y) = (i % width * mesh.width as usize / width, i / width * mesh.height as usize / height);
        texel[2] = regions.get(y * mesh.width as usize + x).map_or(0, |r| r[2]);
    }
    FaceMap::single("painted", texels)
}
