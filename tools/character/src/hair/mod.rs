//! Hair: locks by role, a cap under them, cards of thin strands over them.

mod back;
mod bangs;
mod cap;
mod cards;
mod chains;
mod course;
mod lock;
mod paint;
mod sides;
mod surface;

use std::collections::BTreeMap;

use crate::mesh::Part;
use crate::model::{Alpha, Material, Model, Texture, srgb};

/// Adds the hair.
pub fn add(model: &mut Model) {
    let chains = chains::add(model);
    let chain = |name: &str| chains.iter().find(|(n, _)| n == name).map(|(_, c)| c);
    for (name, locks) in [("HairFront", bangs::build()), ("HairSide", sides::build()), ("HairBack", back::build())] {
        let mut part = Part::new(name, name);
        if name == "HairBack" {
            cap::build(&mut part, &model.skeleton);
        }
        for (lock, chain_name) in &locks {
            lock.build(&mut part, &model.skeleton, chain(chain_name));
        }
        part.smooth_normals();
        model.parts.push(part);
        model.materials.push(Material {
            name,
            texture: Some("hair"),
            shade: srgb(0xd2c6e6),
            shade_texture: Some("hair_shade"),
            shift: -0.12,
            toony: 0.95,
            outline: 0.0007,
            outline_color: srgb(0x7d74b4),
            matcap: Some(("hair_matcap", [0.55, 0.55, 0.6])),
            extras: BTreeMap::from([("highlightBand", "hair_highlight")]),
            ..Material::default()
        });
    }
    let cards = cards::build(&model.skeleton, chain);
    model.parts.push(cards);
    model.materials.push(Material {
        name: "HairCards",
        texture: Some("hair_card"),
        shade: srgb(0xd2c6e6),
        shade_texture: Some("hair_card"),
        shift: -0.05,
        alpha: Alpha::Blend { depth_write: false, queue: 1 },
        double_sided: true,
        ..Material::default()
    });
    let texture = |name, paint| Texture { name, paint, repeat: false };
    model.textures.extend([
        texture("hair", paint::lit as fn() -> _),
        texture("hair_shade", paint::shade),
        texture("hair_highlight", paint::highlight),
        texture("hair_matcap", paint::matcap),
        texture("hair_card", paint::card),
    ]);
}
