// What is so far away through the haze: in air by the depth, which is enough there and costs less; under water little of what is
// near is hidden, and the haze is lighter upward.
vec3 through_haze(vec3 colour, vec3 off) {
#if MURKY
    float away = length(off);
    vec3 veil = haze * (1.0 + 0.5 * off.z / away);
    float thick = away * murk;
    return mix(veil, colour, 1.0 / (1.0 + thick * thick * (0.6 + 0.15 * thick)));
#else
    float far = max(1.0 / gl_FragCoord.w - 12.0, 0.0) * 0.006;
    return mix(colour, haze, far / (1.0 + far));
#endif
}
