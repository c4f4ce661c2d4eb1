//! The functions of `wgsl/lib` on the adapter against float64 vectors.
//!
//! Vectors are read from `tests/oracles`, or from the folder that `HIKAGE_ORACLES` names; `HIKAGE_ADAPTER` names
//! another adapter than the default.

mod esm;
mod eye;
mod face;
mod hair;
mod mtoon;
mod skin;
mod stylized;
mod weighted;

use std::path::PathBuf;

use serde_json::Value;
use wgpu::util::DeviceExt;

use crate::support::gpu;

/// Runs `body`, which may read `input[base + k]` and must write `output[out + k]`, once for each row of numbers.
fn run(library: &[&str], body: &str, rows: &[Vec<f32>], outputs: usize) -> Vec<Vec<f32>> {
    let gpu = gpu();
    let stride = rows[0].len();
    assert!(rows.iter().all(|r| r.len() == stride));
    let mut text = String::new();
    for file in library {
        let path = format!("{}/wgsl/lib/{file}.wgsl", env!("CARGO_MANIFEST_DIR"));
        let source = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path}: {e}"));
        // Library functions have unique names, so their files may simply stand behind each other.
        text.extend(source.lines().filter(|l| !l.starts_with("import ")).flat_map(|l| [l, "\n"]));
    }
    text += &format!(
        "@group(0) @binding(0) var<storage, read> input: array<f32>;
         @group(0) @binding(1) var<storage, read_write> output: array<f32>;
         fn input3(i: u32) -> vec3f {{ return vec3f(input[i], input[i + 1u], input[i + 2u]); }}
         fn write3(i: u32, v: vec3f) {{ output[i] = v.x; output[i + 1u] = v.y; output[i + 2u] = v.z; }}
         @compute @workgroup_size(1) fn main(@builtin(workgroup_id) id: vec3u) {{
             let base = id.x * {stride}u;
             let out = id.x * {outputs}u;
             {body}
         }}"
    );
    let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(text.into()),
    });
    let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: None,
        layout: None,
        module: &module,
        entry_point: Some("main"),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    });
    let flat: Vec<f32> = rows.concat();
    let input = gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: None,
        contents: bytemuck::cast_slice(&flat),
        usage: wgpu::BufferUsages::STORAGE,
    });
    let bytes = (rows.len() * outputs * 4) as u64;
    let buffer = |usage| {
        gpu.device.create_buffer(&wgpu::BufferDescriptor { label: None, size: bytes, usage, mapped_at_creation: false })
    };
    let output = buffer(wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
    let read = buffer(wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ);
    let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[
            wgpu::BindGroupEntry { binding: 0, resource: input.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 1, resource: output.as_entire_binding() },
        ],
    });
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(rows.len() as u32, 1, 1);
    }
    encoder.copy_buffer_to_buffer(&output, 0, &read, 0, bytes);
    gpu.queue.submit([encoder.finish()]);
    read.slice(..).map_async(wgpu::MapMode::Read, |r| r.expect("mapped"));
    let timeout = Some(std::time::Duration::from_secs(60));
    gpu.device.poll(wgpu::PollType::Wait { submission_index: None, timeout }).expect("the adapter answers");
    let mapped = read.slice(..).get_mapped_range().expect("mapped");
    bytemuck::pod_collect_to_vec::<u8, f32>(&mapped).chunks_exact(outputs).map(<[f32]>::to_vec).collect()
}

fn vectors(name: &str) -> Value {
    let own = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/oracles");
    let folder = std::env::var_os("HIKAGE_ORACLES").map_or(own, PathBuf::from);
    let path = folder.join(name);
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    serde_json::from_str(&text).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

fn cases<'a>(file: &'a Value, list: &str) -> &'a Vec<Value> {
    let cases = file[list].as_array().unwrap_or_else(|| panic!("no list {list}"));
    assert!(!cases.is_empty(), "{list} is empty");
    cases
}

/// Numbers at the given paths (`params.base`), vectors laid out one component after the other.
fn numbers(case: &Value, paths: &[&str]) -> Vec<f32> {
    let mut row = Vec::new();
    for path in paths {
        let value = path.split('.').fold(case, |v, key| &v[key]);
        match value {
            Value::Array(list) => row.extend(list.iter().map(|x| x.as_f64().expect(path) as f32)),
            other => row.push(other.as_f64().unwrap_or_else(|| panic!("no number at {path}")) as f32),
        }
    }
    row
}

fn assert_close(what: &str, case: usize, found: &[f32], expected: &[f32], tolerance: f32) {
    assert_eq!(found.len(), expected.len());
    for (i, (f, e)) in found.iter().zip(expected).enumerate() {
        assert!((f - e).abs() <= tolerance, "{what}, case {case}, number {i}: {f}, expected {e} ± {tolerance}");
    }
}
