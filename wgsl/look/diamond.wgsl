// Numbers of a stone that throws light back; wgsl/model/diamond.wgsl shades it.

struct Diamond {
    color: vec3f,
    facets: u32,
    ior: vec3f,
    brilliance: f32,
    bounces: u32,
}
