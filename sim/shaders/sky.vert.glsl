#version 330
// One triangle over the whole picture; the direction of view at each corner goes on to the fragments.
uniform mat3 to_world;      // camera (x right, y up, z back) to world
uniform vec2 half_extent;   // tangent of half the field of view, along x and y
uniform float upward;       // -1 when the picture is drawn upside down
in vec2 corner;
out vec3 direction;

void main() {
    direction = to_world * vec3(corner * half_extent, -1.0);
    gl_Position = vec4(corner.x, corner.y * upward, 1.0, 1.0);
}
