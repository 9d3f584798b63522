// Where a ray meets an axis-parallel box, in units of the ray's parameter.
// Parallel rays take a branch of their own: 0 * infinity would be NaN when the origin lies on a face, and GLSL's
// min and max say nothing about NaN.
// Returns (entry, exit); a miss has entry > exit.
vec2 ray_box(vec3 origin, vec3 direction, vec3 low, vec3 high)
{
    float enter = -1e30;
    float leave = 1e30;
    for (int k = 0; k < 3; ++k) {
        if (abs(direction[k]) < 1e-20) {
            if (origin[k] < low[k] || origin[k] > high[k]) {
                return vec2(1.0, -1.0);
            }
        } else {
            float t1 = (low[k] - origin[k]) / direction[k];
            float t2 = (high[k] - origin[k]) / direction[k];
            enter = max(enter, min(t1, t2));
            leave = min(leave, max(t1, t2));
        }
    }
    return vec2(enter, leave);
}
