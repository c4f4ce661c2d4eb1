// What a debug channel shows of a surface: looks write it behind `@if(channel_name)`. Black where none does.
var<private> shown: vec3f;
