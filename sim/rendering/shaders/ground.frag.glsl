#version 330
// The ground with painted lines and baked shadows where the world is, grass round it; or water.
// LOOK is 0 asphalt, 1 water, 2 floor, 3 grass, 4 sand, 5 a ceiling, 6 the water's surface from below; ROWS and LINES are how many there are of each; SIGNS is set where
// something else is painted, GRAINED where the grain is on the picture of the shadows, MURKY under water, INDOOR under a ceiling. All are set before the program is made, for a software renderer works out
// both sides of every question.
uniform sampler2D markings;   // red: painted signs, or the grain (GRAINED); green: light that is left by shadows
uniform sampler2D grain;
uniform vec2 extent;          // of the lot, centred on the origin [m]
uniform vec3 eye;
uniform vec3 haze;
uniform float murk;           // how much of the haze a metre of water brings; 0 in air
uniform float level;          // height of this plane [m]
uniform vec3 horizon;
#if MURKY
uniform float time;           // [s], for what moves on water
#endif
#if LOOK == 5
uniform sampler2D lamplight;  // of full light, what each place of the floor has
#endif
#if ROWS + LINES > 0
uniform vec4 rows[ROWS];      // rows of bays: x and y of the south-west corner, breadth of a bay, depth [m]
uniform vec2 bays[ROWS];      // how many in the row; one by the breadth of a bay [1/m]
uniform vec4 lines[LINES];    // where it begins: x, y [m]; its direction
uniform vec2 widths[LINES];   // half of its width, and its length [m]
#endif
in vec2 place;
out vec3 colour;

#include "haze.glsl"

const float HALF_LINE = 0.06;

#if ROWS + LINES > 0
// Part of a pixel, `size` broad round `at`, that lies between `low` and `high`; `per` is one by twice its size.
float covered(float at, float size, float per, float low, float high) {
    return clamp((min(at + size, high) - max(at - size, low)) * per, 0.0, 1.0);
}

// Drawn by formula and not from a picture: a picture seen at this low angle would blur or flicker.
float lines_here() {
    float most = 0.0;
    vec2 to_right = dFdx(place), up = dFdy(place);
    vec2 pixel = max((abs(to_right) + abs(up)) * 0.5, vec2(1e-5));
    vec2 per = 0.5 / pixel;
    for (int i = 0; i < ROWS; i++) {
        float along = (place.x - rows[i].x) * bays[i].y;
        float nearest = clamp(floor(along + 0.5), 0.0, bays[i].x) * rows[i].z + rows[i].x;
        float x = covered(place.x, pixel.x, per.x, nearest - HALF_LINE, nearest + HALF_LINE);
        most = max(most, x * covered(place.y, pixel.y, per.y, rows[i].y, rows[i].y + rows[i].w));
    }
    for (int i = 0; i < LINES; i++) {
        vec2 ahead = lines[i].zw, left = vec2(-ahead.y, ahead.x);
        vec2 from = place - lines[i].xy;
        vec2 spread = abs(vec2(dot(to_right, ahead), dot(to_right, left))) + abs(vec2(dot(up, ahead), dot(up, left)));
        spread = max(spread * 0.5, vec2(1e-5));
        vec2 each = 0.5 / spread;
        float across = covered(dot(from, left), spread.y, each.y, -widths[i].x, widths[i].x);
        most = max(most, across * covered(dot(from, ahead), spread.x, each.x, 0.0, widths[i].y));
    }
    return most;
}
#endif

// What the ground is made of, without paint.
vec3 bare(float rough) {
#if LOOK == 2
    vec2 tile = abs(fract(place * 1.6667) - 0.5);
    float joint = smoothstep(0.485, 0.5, max(tile.x, tile.y));
    return mix(vec3(0.70, 0.69, 0.66) * (0.96 + 0.06 * rough), vec3(0.52, 0.51, 0.49), joint);
#elif LOOK == 3
    return mix(vec3(0.30, 0.40, 0.19), vec3(0.44, 0.53, 0.28), rough);
#elif LOOK == 4
    return vec3(0.63, 0.60, 0.47) * (0.82 + 0.34 * rough);
#else
    return vec3(0.415, 0.425, 0.44) * (0.87 + 0.26 * rough);
#endif
}

// The surface from above: deep where one looks down, the sky's edge where one looks along it.
vec3 water(vec3 back) {
    float ripple = texture(grain, place * 0.23).r * 0.6 + texture(grain, place.yx * 0.071).r * 0.4;
    float along = pow(1.0 - clamp(back.z + (ripple - 0.5) * 0.16, 0.0, 1.0), 3.0);
    return mix(vec3(0.07, 0.24, 0.29) * (0.85 + 0.35 * ripple), horizon, along * 0.75);
}

#if LOOK == 5
// Square tiles in a metal grid, lit by what comes back from the floor.
void main() {
    vec2 inside = extent * 0.5 - abs(place);
    if (min(inside.x, inside.y) < 0.0) discard;
    vec2 tile = abs(fract(place * 1.6667) - 0.5);
    float joint = smoothstep(0.475, 0.492, max(tile.x, tile.y)) * clamp(1.6 - 0.1 / gl_FragCoord.w, 0.15, 1.0);
    float strength = texture(lamplight, place / extent + 0.5).r;
    colour = mix(vec3(0.88, 0.85, 0.79), vec3(0.62, 0.60, 0.57), joint) * (0.34 + 0.56 * strength);
}
#elif LOOK == 6
// A window of light above, round which the water mirrors itself; ripples break its edge.
void main() {
    vec3 off = vec3(place, level) - eye;
    vec2 ripple = texture(grain, place * 0.21 + time * vec2(0.02, 0.03)).rg;
    float up = off.z * inversesqrt(dot(off, off));
    float through = clamp((up + (ripple.x - 0.5) * 0.7 + (ripple.y - 0.3) * 0.25) * 3.3 - 1.55, 0.0, 1.0);
    vec3 mirrored = haze * (0.92 + 0.9 * ripple.x * ripple.x + 0.35 * ripple.y);
    colour = through_haze(mix(mirrored, vec3(0.62, 0.86, 0.87) * (0.82 + 0.4 * ripple.y), through), off);
}
#else
void main() {
    vec2 outside = abs(place) - extent * 0.5;
#if SIGNS
    vec2 mark = texture(markings, place / extent + 0.5, -1.5).rg;  // crisp, however flat one looks at them
#elif LOOK != 1 && !MURKY
    vec2 mark = texture(markings, place / extent + 0.5).rg;
#endif
#if GRAINED
    float rough = max(outside.x, outside.y) < 0.0 ? mark.r : 0.5;
    float paint = 0.0;
#elif MURKY
    // Two webs of light run over the bottom; what both have is bright.
    vec2 light = texture(grain, place * 0.31 + time * vec2(0.05, 0.03)).rg;
    float rough = light.r;
    float other = texture(grain, place.yx * 0.37 - time * vec2(0.04, 0.06)).g;
    vec2 mark = vec2(0.0, 0.74 + 0.95 * min(light.g, other) + 0.12 * light.g);
#else
    float rough = texture(grain, place * 0.43).r;
#endif
#if !GRAINED
#if LOOK != 1
    float paint = mark.r;
#endif
#endif
#if ROWS + LINES > 0
    paint = max(paint, lines_here());
#endif
#if LOOK == 1
    colour = water(normalize(eye - vec3(place, level)));
#else
    colour = mix(bare(rough), vec3(0.92, 0.93, 0.92), paint * (0.78 + 0.20 * rough)) * mark.g;
#if INDOOR
    colour *= vec3(1.16, 1.10, 1.00);
#endif
#endif
#if LOOK != 4
    vec3 grass = mix(vec3(0.26, 0.37, 0.18), vec3(0.42, 0.53, 0.28), rough);
    colour = max(outside.x, outside.y) < 0.0 ? colour : grass;
#endif
    colour = through_haze(colour, vec3(place, level) - eye);
}
#endif
