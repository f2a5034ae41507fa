#version 330
// The dome of the sky, always round the eye and behind everything.
uniform mat4 view_projection;
uniform vec3 eye;
in vec3 direction;
in vec2 mark;
out vec2 place;

void main() {
    place = mark;
    gl_Position = (view_projection * vec4(eye + direction * 100.0, 1.0)).xyww;
}
