#version 330
// What is matt as its corners are lit; on what is polished (GLOSSY) a reflected sky, or the ceiling (INDOOR). MURKY is set under water.
uniform vec3 eye;
uniform vec3 haze;
uniform float murk;           // how much of the haze a metre of water brings
in vec3 place;
#if GLOSSY
uniform vec3 sun;
uniform vec3 zenith;
uniform vec3 horizon;
in vec3 facing;
flat in vec3 paint;
flat in vec2 surface;
#endif
#if INDOOR || !GLOSSY
in vec3 light;
#else
#include "light.glsl"
#endif
#if MURKY
uniform sampler2D grain;
uniform float time;
#endif
out vec3 colour;

#include "haze.glsl"

void main() {
#if GLOSSY
    vec3 back = normalize(eye - place);
    vec3 n = normalize(facing);
    vec3 mirrored = reflect(-back, n);
    float grazing = pow(1.0 - max(dot(n, back), 0.0), 3.0);
#if INDOOR
    vec3 sky = mirrored.z > 0.0 ? vec3(0.74, 0.72, 0.66) : vec3(0.44, 0.42, 0.39);
    colour = mix(light, sky, surface.x * (0.08 + 0.45 * grazing));
#else
    colour = lit(n, sun, paint, surface.y);
    vec3 sky = mirrored.z > 0.0 ? mix(horizon, zenith, clamp(mirrored.z * 1.6, 0.0, 1.0)) : vec3(0.34, 0.35, 0.36);
    colour = mix(colour, sky, surface.x * (0.10 + 0.55 * grazing));
    colour += surface.x * pow(max(dot(mirrored, sun), 0.0), 48.0) * 0.8;
#endif
#else
    colour = light;
#endif
#if MURKY
    // The web of light on what stands in the water, drawn out downward.
    float web = texture(grain, (place.xy + place.z * vec2(0.31, 0.23)) * 0.35 + time * vec2(0.07, 0.05)).g;
    colour *= 0.88 + 0.50 * web;
#endif
    colour = through_haze(colour, place - eye);
}
