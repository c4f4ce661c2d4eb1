//! Materials, pictures and texture coordinates.

use serde_json::json;

use super::first;
use crate::gltf::{F32, Glb, floats, picture};

#[test]
fn extras_may_hold_anything_and_name_highlights() {
    let mut glb = Glb::triangle();
    let texture = glb.texture(&picture(image::ImageFormat::Png), "image/png");
    glb.push("materials", json!({"name": "skin"}));
    glb.primitive()["material"] = json!(0);
    let load = |glb: &Glb| glb.load().map(|scene| scene.materials[0].authored.highlight.map(|t| t.texture));
    for extras in [json!(5), json!("hikage"), json!([1]), json!({"hikage": 7}), json!({"hikage": {"rampRow": 3}})] {
        glb.json["materials"][0]["extras"] = extras.clone();
        assert_eq!(load(&glb).expect("extras are free"), None, "{extras}");
    }
    for key in ["highlightBand", "noseLipHighlight"] {
        glb.json["materials"][0]["extras"] = json!({"hikage": {key: {"index": texture}}});
        assert_eq!(load(&glb).expect("loads"), Some(texture), "{key}");
        glb.json["materials"][0]["extras"] = json!({"hikage": {key: {"index": 9}}});
        let error = load(&glb).expect_err("no such texture").to_string();
        assert!(error.contains(&format!("/materials/0/extras/hikage/{key}/index")), "{error}");
    }
}

#[test]
fn webp_loads_declared_and_undeclared() {
    for declared in [true, false] {
        let mut glb = Glb::triangle();
        let texture = glb.texture(&picture(image::ImageFormat::WebP), "image/webp");
        if declared {
            glb.json["textures"][texture] = json!({"extensions": {"EXT_texture_webp": {"source": 0}}});
            glb.json["extensionsUsed"] = json!(["EXT_texture_webp"]);
            glb.json["extensionsRequired"] = json!(["EXT_texture_webp"]);
        }
        glb.push("materials", json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": texture}}}));
        glb.primitive()["material"] = json!(0);
        let scene = glb.load().expect("loads");
        assert_eq!(scene.images[0].format, "webp");
        assert_eq!(scene.images[0].pixels, [255, 0, 0, 255, 0, 0, 255, 128]);
        assert_eq!(first(&scene).uvs, [[[0., 0.], [1., 0.], [0., 1.]]]);
    }
}

#[test]
fn sixteen_bit_png_is_down_converted() {
    let pixels: image::ImageBuffer<image::Rgba<u16>, _> =
        image::ImageBuffer::from_raw(1, 1, vec![0x1234u16, 0x8080, 0xFFFF, 0xFFFF]).expect("1 x 1");
    let mut file = std::io::Cursor::new(Vec::new());
    image::DynamicImage::from(pixels).write_to(&mut file, image::ImageFormat::Png).expect("encodes");
    let image = hikage::import::image::decode("x.png", file.get_ref(), &Default::default()).expect("decodes");
    assert_eq!((image.source_bits, image.pixels), (16, vec![0x12, 0x80, 0xFF, 0xFF]));
}

#[test]
fn uv_sets_are_renumbered_by_material() {
    let mut glb = Glb::triangle();
    glb.attribute("TEXCOORD_3", F32, "VEC2", &floats(&[0.5, 0.5, 0.5, 0.5, 0.25, 0.25]), 3, false);
    let texture = glb.texture(&picture(image::ImageFormat::Png), "image/png");
    glb.push(
        "materials",
        json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": texture, "texCoord": 3}}, "emissiveTexture": {"index": texture}}),
    );
    glb.push("materials", json!({"emissiveTexture": {"index": texture, "extensions": {"KHR_texture_transform": {"texCoord": 3, "offset": [0.5, 0], "scale": [2, 3], "rotation": 1}}}}));
    glb.primitive()["material"] = json!(0);
    let mut second = glb.primitive().clone();
    second["material"] = json!(1);
    glb.json["meshes"][0]["primitives"].as_array_mut().expect("primitives").push(second);
    let scene = glb.load().expect("loads");
    let [a, b] = &scene.meshes[0].primitives[..] else { panic!("two primitives") };
    assert_eq!((a.uvs.len(), b.uvs.len()), (2, 1));
    assert_eq!((a.uvs[0][1], a.uvs[1][1], b.uvs[0][2]), ([1., 0.], [0.5, 0.5], [0.25, 0.25]));
    assert_eq!(scene.materials[0].base.texture.expect("base").uv_set, 1);
    assert_eq!(scene.materials[0].emission.texture.expect("emission").uv_set, 0);
    let moved = scene.materials[1].emission.texture.expect("emission");
    assert_eq!(
        (moved.uv_set, moved.transform.offset, moved.transform.scale, moved.transform.rotation_rad),
        (0, [0.5, 0.], [2., 3.], 1.0)
    );
    assert_eq!(scene.images.len(), 1, "a shared image is decoded once");
}
