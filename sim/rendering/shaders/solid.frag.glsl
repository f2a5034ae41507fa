#version 330
// What is matt as its corners are lit; on what is polished (GLOSSY) a reflected sky. MURKY is set under water.
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
#else
in vec3 light;
#endif
out vec3 colour;

#include "light.glsl"
#include "haze.glsl"

void main() {
#if GLOSSY
    vec3 back = normalize(eye - place);
    vec3 n = normalize(facing);
    colour = lit(n, sun, paint, surface.y);
    vec3 mirrored = reflect(-back, n);
    vec3 sky = mirrored.z > 0.0 ? mix(horizon, zenith, clamp(mirrored.z * 1.6, 0.0, 1.0)) : vec3(0.34, 0.35, 0.36);
    float grazing = pow(1.0 - max(dot(n, back), 0.0), 3.0);
    colour = mix(colour, sky, surface.x * (0.10 + 0.55 * grazing));
    colour += surface.x * pow(max(dot(mirrored, sun), 0.0), 48.0) * 0.8;
#else
    colour = light;
#endif
    colour = mix(colour, haze, hidden(distance_here(eye, place)));
}
