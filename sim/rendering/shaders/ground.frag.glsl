#version 330
// The ground with painted lines and baked shadows where the world is, grass round it; or water.
// LOOK is 0 asphalt, 1 water, 2 floor, 3 grass, 4 sand; ROWS and LINES are how many there are of each; SIGNS is set where
// something else is painted, GRAINED where the grain is on the picture of the shadows, MURKY under water. All are set before the program is made, for a software renderer works out
// both sides of every question.
uniform sampler2D markings;   // red: painted signs, or the grain (GRAINED); green: light that is left by shadows
uniform sampler2D grain;
uniform vec2 extent;          // of the lot, centred on the origin [m]
uniform vec3 eye;
uniform vec3 haze;
uniform float murk;           // how much of the haze a metre of water brings; 0 in air
uniform float level;          // height of this plane [m]
uniform vec3 horizon;
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

void main() {
    vec2 outside = abs(place) - extent * 0.5;
#if SIGNS
    vec2 mark = texture(markings, place / extent + 0.5, -1.5).rg;  // crisp, however flat one looks at them
#elif LOOK != 1
    vec2 mark = texture(markings, place / extent + 0.5).rg;
#endif
#if GRAINED
    float rough = max(outside.x, outside.y) < 0.0 ? mark.r : 0.5;
    float paint = 0.0;
#else
    float rough = texture(grain, place * 0.43).r;
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
#endif
#if LOOK != 4
    vec3 grass = mix(vec3(0.26, 0.37, 0.18), vec3(0.42, 0.53, 0.28), rough);
    colour = max(outside.x, outside.y) < 0.0 ? colour : grass;
#endif
    colour = mix(colour, haze, hidden(distance_here(eye, vec3(place, level))));
}
