//! The check of a user's WGSL.

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
