// Where a ray runs between two altitudes, in single precision at the size of a planet: no squares of its radius are
// subtracted, and the root that would cancel comes from the product of both (Citardauq). All lengths in metres.

const float no_hit = -1e30;

// Distances to the sphere of altitude `sphere` from altitude `from`, near and far, negative behind; a miss is no_hit.
vec2 sphere_hits(float planet_radius, float from, float climb, float sphere)
{
    float product = (from - sphere) * (2.0 * planet_radius + from + sphere);
    float half_sum = (planet_radius + from) * climb;
    float discriminant = half_sum * half_sum - product;
    if (!(discriminant >= 0.0)) {
        return vec2(no_hit);
    }
    float root = sqrt(discriminant);
    float q = half_sum > 0.0 ? -half_sum - root : root - half_sum;
    float other = q == 0.0 ? 0.0 : product / q;
    return vec2(min(q, other), max(q, other));
}

// (begin, end) of the first part in xy and of the second in zw; an empty part has end <= begin.
vec4 shell_intervals(float planet_radius, float from, float climb, float bottom, float top)
{
    vec2 ground = sphere_hits(planet_radius, from, climb, 0.0);
    vec2 low = sphere_hits(planet_radius, from, climb, bottom);
    vec2 high = sphere_hits(planet_radius, from, climb, top);
    bool on_ground = ground.x > 0.0;
    // On the bottom counts as below: its near root is 0 there, and the gap would be marched.
    if (from <= bottom) {
        return on_ground ? vec4(0.0) : vec4(max(low.y, 0.0), high.y, 0.0, 0.0);
    }
    if (from > top && !(high.x > 0.0)) {
        return vec4(0.0);
    }
    float enter = from > top ? high.x : 0.0;
    if (!(low.x > 0.0)) {
        return vec4(enter, high.y, 0.0, 0.0);
    }
    return vec4(enter, low.x, on_ground ? vec2(0.0) : vec2(low.y, high.y));
}

// Altitude of a point relative to the sea-level point below the camera, y up there.
float altitude_above(float planet_radius, vec3 from_sea_level)
{
    float rise = 2.0 * planet_radius * from_sea_level.y + dot(from_sea_level, from_sea_level);
    return rise / (sqrt(planet_radius * planet_radius + rise) + planet_radius);
}
