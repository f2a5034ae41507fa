#version 330
// The level ground, a square far larger than what can be seen.
uniform mat4 view_projection;
uniform vec2 centre;
uniform float reach;
in vec2 corner;
out vec2 place;

void main() {
    place = centre + corner * reach;
    gl_Position = view_projection * vec4(place, 0.0, 1.0);
}
