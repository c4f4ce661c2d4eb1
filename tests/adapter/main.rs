//! Laws of what is drawn, and functions of the shaders, on the adapter.

#[path = "../support/scene.rs"]
mod support;

#[path = "../support/eye.rs"]
mod eyeballs;

mod adapters;
mod automatic;
mod backdrop;
mod bangs_shadow;
mod body_looks;
mod channels;
mod depth_rim;
mod eye;
mod eye_drawn;
mod eye_layers;
mod eye_surface;
mod eyes_through;
mod face_shadow;
mod faults;
mod first_person;
mod ground;
mod host;
mod laws;
mod layers;
mod limits;
mod motion;
mod natural;
mod oracles;
mod own_look;
mod pupils;
mod self_shadow;
mod skin;
mod skin_drawn;
mod skin_screen_space;
mod skin_texture_space;
mod skin_texturing;
mod stage;
mod strips;
mod temporal;
mod temporal_windows;
