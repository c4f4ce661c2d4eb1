//! Every entry file links and validates with every option and pair of options. No adapter is needed.

use naga::valid::{Capabilities, ValidationFlags, Validator};

#[test]
fn every_entry_validates_with_every_pair_of_options() {
    for (name, text) in hikage::shaders::ENTRIES {
        let module =
            naga::front::wgsl::parse_str(text).unwrap_or_else(|e| panic!("{name}: {}", e.emit_to_string(text)));
        let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
        let info = validator.validate(&module).unwrap_or_else(|e| panic!("{name}: {}", e.emit_to_string(text)));
        let names: Vec<String> = module.overrides.iter().filter_map(|(_, o)| o.name.clone()).collect();
        let mut sets: Vec<Vec<&str>> = vec![vec![], names.iter().map(String::as_str).collect()];
        for (i, a) in names.iter().enumerate() {
            sets.push(vec![a]);
            sets.extend(names[i + 1..].iter().map(|b| vec![a.as_str(), b.as_str()]));
        }
        for set in sets {
            let constants = names.iter().map(|n| (n.clone(), f64::from(u8::from(set.contains(&n.as_str()))))).collect();
            let (module, _) = naga::back::pipeline_constants::process_overrides(&module, &info, None, &constants)
                .unwrap_or_else(|e| panic!("{name} with {set:?}: {e}"));
            Validator::new(ValidationFlags::all(), Capabilities::empty())
                .validate(&module)
                .unwrap_or_else(|e| panic!("{name} with {set:?}: {e}"));
        }
    }
}

#[test]
fn every_entry_file_is_embedded() {
    let stems: std::collections::BTreeSet<_> = std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/wgsl/pass"))
        .expect("wgsl/pass")
        .map(|e| e.expect("entry").path().file_stem().expect("stem").to_string_lossy().into_owned())
        .collect();
    let embedded: std::collections::BTreeSet<_> =
        hikage::shaders::ENTRIES.iter().map(|(name, _)| (*name).to_owned()).collect();
    assert_eq!(stems, embedded, "every entry file of wgsl/pass is listed in src/render/shaders.rs");
}

#[test]
fn users_shaders_are_refused_with_line_and_reason() {
    let deep = format!("@fragment fn fs_main() -> @location(0) vec4f {{ return vec4f({}1.0); }}", "-".repeat(20_000));
    let long = "x".repeat(hikage::shaders::MAX_WGSL_BYTES + 1);
    for (text, word) in [
        ("fn f() -> vec4f { return 1; }", "type"),
        ("enable frobnicate;", "frobnicate"),
        (deep.as_str(), "nest"),
        (long.as_str(), "limit"),
        ("const x = 1;", "entry point"),
    ] {
        let error = hikage::shaders::check("user.wgsl", text.as_bytes()).expect_err(word).to_string();
        assert!(error.contains("user.wgsl") && error.contains(word), "{error}");
    }
    let error = hikage::shaders::check("user.wgsl", &[0xff, 0xfe, 0x00]).expect_err("bytes").to_string();
    assert!(error.contains("UTF-8"), "{error}");
    let summary = hikage::shaders::check("user.wgsl", b"@compute @workgroup_size(1) fn main() {}").expect("valid");
    assert_eq!(summary.entry_points, ["compute main"]);
}
