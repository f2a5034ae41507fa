#version 330
// Leaves with gaps between them.
uniform sampler2D leaves;     // red: how light a leaf is; alpha: how far it lies in front of the others
uniform vec3 haze;
in vec2 leaf;
in vec3 light;
flat in float gaps;
out vec3 colour;

#define MURKY 0
#include "haze.glsl"

void main() {
    vec4 found = texture(leaves, leaf);
    if (found.a < gaps) discard;
    float shade = found.r;
    colour = light * mix(vec3(0.42, 0.46, 0.40), vec3(1.50, 1.42, 1.20), shade);
    colour = through_haze(colour, vec3(0.0));
}
