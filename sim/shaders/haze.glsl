// How much of what is so far away [m] the haze hides.
float hidden(float away) {
#if MURKY
    return 1.0 - exp(-away * murk);
#else
    float far = max(away - 12.0, 0.0) * 0.006;
    return far / (1.0 + far);
#endif
}
