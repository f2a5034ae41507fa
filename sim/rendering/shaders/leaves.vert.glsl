#version 330
// One copy of a ball of leaves: bulging here and there, stretched, turned and placed.
uniform mat4 view_projection;
uniform vec3 sun;
in vec3 corner;
in vec3 normal;       // where it lies in the picture of leaves: once round, and from the bottom to the top
in vec3 position;
in vec4 rotation;
in vec3 size;
in vec2 taper;
in vec3 tint;
in vec2 finish;       // gloss; part of the ball that is gaps between leaves
out vec2 leaf;
out vec3 light;
flat out float gaps;

#define INDOOR 0
#include "light.glsl"

vec3 turn(vec4 q, vec3 v) {
    vec3 t = 2.0 * cross(q.xyz, v);
    return v + q.w * t + cross(q.xyz, t);
}

void main() {
    vec3 wave = sin(corner * 11.0 + position.yzx * 2.3 + size.x * 9.0);
    float bulge = 0.96 + 0.05 * (wave.x + wave.y + wave.z);
    vec3 n = turn(rotation, normalize(corner / size));
    vec3 body = corner * size * bulge;
    body.xy *= mix(vec2(1.0), taper, corner.z + 0.5);
    vec3 place = position + turn(rotation, body);
    float around = max(2.0, floor(3.14 * size.x / 0.7 + 0.5));
    leaf = vec2(normal.x * around, normal.y * max(1.0, 0.5 * around)) + position.xy;
    // Light comes through leaves, and little to those that hang below or lie within.
    light = lit(normalize(n + vec3(0.0, 0.0, 0.35)), sun, tint, 0.0) * (0.72 + 0.32 * normal.y + 0.55 * (bulge - 0.96));
    gaps = finish.y;
    gl_Position = view_projection * vec4(place, 1.0);
}
