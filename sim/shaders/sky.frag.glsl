#version 330
// A clear sky with thin clouds, and two chains of hills all round the horizon.
uniform vec3 zenith;
uniform vec3 horizon;
uniform sampler2D grain;
in vec3 direction;
out vec3 colour;

float ridge(float turn, float bumps, float seed) {
    // Straight slopes between peaks of different height, the same again after a full turn.
    float place = turn * bumps;
    float peak = floor(place);
    float along = place - peak;
    float high = fract(sin(mod(peak, bumps) * 12.9898 + seed) * 43758.5453);
    float next = fract(sin(mod(peak + 1.0, bumps) * 12.9898 + seed) * 43758.5453);
    return mix(high, next, along);
}

void main() {
    float level = length(direction.xy);
    float rise = direction.z / level;
    float turn = atan(direction.y, direction.x) / 6.28318531 + 0.5;
    float height = clamp(rise, 0.0, 1.4);
    colour = mix(horizon, zenith, 1.0 - exp(-2.6 * height));
    if (rise > 0.02) {
        vec2 cloud = direction.xy / (direction.z + 0.12 * level) * 0.045;
        float cover = texture(grain, cloud).r;
        colour = mix(colour, vec3(0.97, 0.98, 0.99), smoothstep(0.56, 0.86, cover) * smoothstep(0.02, 0.3, rise) * 0.75);
    }
    float far = 0.045 + 0.10 * ridge(turn, 19.0, 3.7);
    float near = 0.02 + 0.075 * ridge(turn, 29.0, 9.1);
    float edge = fwidth(rise);
    colour = mix(colour, mix(vec3(0.52, 0.62, 0.62), vec3(0.40, 0.53, 0.45), rise / far), smoothstep(edge, -edge, rise - far));
    colour = mix(colour, mix(vec3(0.38, 0.50, 0.33), vec3(0.30, 0.44, 0.29), rise / near), smoothstep(edge, -edge, rise - near));
}
