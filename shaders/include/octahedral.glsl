// Unit vectors in two numbers from 0 to 1 (Cigolle et al. 2014, "A Survey of Efficient Representations for Independent
// Unit Vectors").

vec2 octahedral_encode(vec3 v)
{
    vec2 p = v.xy / (abs(v.x) + abs(v.y) + abs(v.z));
    vec2 folded = (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
    return 0.5 + 0.5 * (v.z < 0.0 ? folded : p);
}

vec3 octahedral_decode(vec2 code)
{
    vec2 p = 2.0 * code - 1.0;
    float z = 1.0 - abs(p.x) - abs(p.y);
    vec2 unfolded = (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
    return normalize(vec3(z < 0.0 ? unfolded : p, z));
}
