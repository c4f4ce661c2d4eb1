// Lights of a drawn eye that move.
import package::bind::actor::actors;
import package::bind::frame::frame;
import package::bind::varying::{Varying, in_face_frame};
import package::bind::vertex::{Vertex, world_position, world_rotated};
import package::lib::highlight::card_shift;
import package::material::material;

struct EyeCard {
    by_view_m: vec2f,
    by_light_m: vec2f,
    within_m: f32,
}

fn eye_card_vary(v: Vertex, out: ptr<function, Varying>) {
    let m = &material.eye_card;
    let view = in_face_frame(v, normalize(frame.eye - world_position(v, actors[v.actor].head)));
    let shift = card_shift(
        view, in_face_frame(v, frame.to_light), (*m).by_view_m, (*m).by_light_m, (*m).within_m
    ) * length(v.world_row_x.xyz);
    let moved = world_rotated(v, actors[v.actor].face_left) * shift.x + world_rotated(v, actors[v.actor].face_up) * shift.y;
    out.clip_position += frame.clip_from_world * vec4f(moved, 0.0);
    @if(world) out.world_position += moved;
}
