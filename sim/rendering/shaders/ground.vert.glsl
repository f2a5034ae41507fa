#version 330
// The level ground, a square far larger than what can be seen.
uniform mat4 view_projection;
uniform vec2 centre;
uniform float reach;
uniform float level;           // its height [m]
in vec2 corner;
out vec2 place;

void main() {
    place = centre + corner * reach;
    gl_Position = view_projection * vec4(place, level, 1.0);
}
