#if INDOOR
// Lamp light from above, warm, as strong as at this place of the floor; what looks up gets most, what is low and upright least.
vec3 lit(vec3 n, vec3 sun, vec3 paint, float glow) {
    vec2 beside = (place.xy + n.xy * 0.3) / extent + 0.5;
    float strength = textureLod(lamplight, beside, 0.0).r;
    float faces = 0.91 + 0.13 * n.z + 0.07 * n.x + 0.05 * n.y;
    float high = 0.86 + 0.07 * clamp(place.z, 0.0, 2.0);
    vec3 warm = mix(vec3(1.13, 1.03, 0.90), vec3(1.10, 1.06, 0.99), strength);
    return paint * mix(warm * (strength * faces * high), vec3(1.0), glow);
}
#else
// Sunlight by Lambert, soft light from sky and ground.
vec3 lit(vec3 n, vec3 sun, vec3 paint, float glow) {
    float direct = max(dot(n, sun), 0.0);
    vec3 ambient = mix(vec3(0.36, 0.35, 0.33), vec3(0.56, 0.60, 0.66), 0.5 + 0.5 * n.z);
    return paint * mix(ambient + direct * vec3(0.66, 0.62, 0.54), vec3(1.0), glow);
}
#endif
