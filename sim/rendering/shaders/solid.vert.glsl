#version 330
// One copy of a unit solid: stretched, tapered towards its top, turned and placed. GLOSSY is set for what is polished.
uniform mat4 view_projection;
in vec3 corner;
in vec3 normal;
in vec3 position;
in vec4 rotation;
in vec3 size;
in vec2 taper;
in vec3 tint;
in vec2 finish;       // gloss, glow
out vec3 place;
#if INDOOR
uniform sampler2D lamplight;  // of full light, what each place of the floor has
uniform vec2 extent;          // of the floor [m]
#endif
#if GLOSSY
out vec3 facing;
flat out vec3 paint;
flat out vec2 surface;
#endif
#if INDOOR || !GLOSSY
uniform vec3 sun;
out vec3 light;
#endif

#include "light.glsl"

vec3 turn(vec4 q, vec3 v) {
    vec3 t = 2.0 * cross(q.xyz, v);
    return v + q.w * t + cross(q.xyz, t);
}

void main() {
    float up = corner.z + 0.5;
    vec3 body = corner * size;
    body.xy *= mix(vec2(1.0), taper, up);
    // A side that leans inward looks up: by the slope of the taper over the height.
    vec2 lean = (1.0 - taper) * size.xy * 0.5 / size.z;
    vec3 out_ = vec3(normal.xy / size.xy, normal.z / size.z);
    float level = length(out_.xy);
    if (level > 1e-6 && abs(normal.z) < 0.01) {
        vec2 side = out_.xy / level;
        out_ = vec3(side, dot(side * side, lean));
    }
    place = position + turn(rotation, body);
    vec3 n = turn(rotation, normalize(out_));
#if GLOSSY
    facing = n;
    paint = tint;
    surface = finish;
#endif
#if INDOOR || !GLOSSY
    // What is matt is lit at its corners: a pixel costs far more than a corner.
    light = lit(n, sun, tint, finish.y);
#endif
    gl_Position = view_projection * vec4(place, 1.0);
}
