#version 330
// Lambert light from the sun, soft light from sky and ground, a reflected sky on what is polished.
uniform vec3 eye;
uniform vec3 sun;
uniform vec3 zenith;
uniform vec3 horizon;
uniform vec3 haze;
uniform float murk;           // how much of the haze a metre of water brings; 0 in air
in vec3 place;
in vec3 facing;
flat in vec3 paint;
flat in vec2 surface;
out vec3 colour;

void main() {
    vec3 n = normalize(facing);
    vec3 back = eye - place;
    float away = length(back);
    back /= away;
    float direct = max(dot(n, sun), 0.0);
    vec3 ambient = mix(vec3(0.36, 0.35, 0.33), vec3(0.56, 0.60, 0.66), 0.5 + 0.5 * n.z);
    vec3 light = ambient + direct * vec3(0.66, 0.62, 0.54);
    light = mix(light, vec3(1.0), surface.y);
    colour = paint * light;
    if (surface.x > 0.0) {
        vec3 mirrored = reflect(-back, n);
        vec3 sky = mirrored.z > 0.0 ? mix(horizon, zenith, clamp(mirrored.z * 1.6, 0.0, 1.0)) : vec3(0.34, 0.35, 0.36);
        float grazing = pow(1.0 - max(dot(n, back), 0.0), 3.0);
        colour = mix(colour, sky, surface.x * (0.10 + 0.55 * grazing));
        colour += surface.x * pow(max(dot(mirrored, sun), 0.0), 48.0) * 0.8;
    }
    float through = murk > 0.0 ? away * murk : max(away - 12.0, 0.0) * 0.005;
    colour = mix(colour, haze, 1.0 - exp(-through));
}
