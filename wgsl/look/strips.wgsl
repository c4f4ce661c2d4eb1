// Strips of hair: what models of hair ask of them.
import package::bind::shown::shown;
import package::bind::surface::{Shaded, Surface};
import package::bind::varying::Varying;
import package::bind::vertex::Vertex;
import package::lib::strips::{strip_hue, strip_occlusion, strip_place};
import package::material::material;

struct Strips {
    occlusion: vec3f,
    grayness: f32,
}

// Light that is left in a strip, three strengths of it: those of the material, or what the file has painted.
fn occlusion_of_strips(in: Varying) -> vec3f {
    @if(strip_colors) return in.color.rgb;
    @if(!strip_colors) return strip_occlusion(strip_place(in.color), material.strips.occlusion);
}

// How gray the hair is, 0 to 1: that of the material, or the alpha that the file has painted.
fn grayness_of_strips(in: Varying) -> f32 {
    @if(strip_colors) return in.color.a;
    @if(!strip_colors) return material.strips.grayness;
}

// Channels alone ask for the strip of a vertex: its number in 8 bits, and its turn in 8 above.
fn strips_vary(v: Vertex, out: ptr<function, Varying>) {
    @if(channel_strips || channel_strip_order) out.part = v.part >> 16u;
}

// After the model: what has no light shows its colour in every channel.
fn strips_shine(s: ptr<function, Surface>, l: ptr<function, Shaded>) {
    @if(channel_strips) shown = strip_hue(s.at.part & 0xffu);
    @if(channel_strip_order) shown = vec3f(f32(s.at.part >> 8u) / 255.0);
    @if(channel_strip_occlusion) shown = occlusion_of_strips(s.at);
    @if(channel_strip_grayness) shown = vec3f(grayness_of_strips(s.at));
}
