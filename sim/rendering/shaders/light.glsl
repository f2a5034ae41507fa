// Sunlight by Lambert, soft light from sky and ground.
vec3 lit(vec3 n, vec3 sun, vec3 paint, float glow) {
    float direct = max(dot(n, sun), 0.0);
    vec3 ambient = mix(vec3(0.36, 0.35, 0.33), vec3(0.56, 0.60, 0.66), 0.5 + 0.5 * n.z);
    return paint * mix(ambient + direct * vec3(0.66, 0.62, 0.54), vec3(1.0), glow);
}
