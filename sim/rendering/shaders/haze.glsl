// How much of what is so far away [m] the haze hides.
float hidden(float away) {
#if MURKY
    return 1.0 - exp(-away * murk);
#else
    float far = max(away - 12.0, 0.0) * 0.006;
    return far / (1.0 + far);
#endif
}

// How far away this pixel is [m]; ahead is enough in air, and costs less.
float distance_here(vec3 eye, vec3 place) {
#if MURKY
    return length(eye - place);
#else
    return 1.0 / gl_FragCoord.w;
#endif
}
