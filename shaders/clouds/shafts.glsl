// Distances of the grid that cloud_shafts.comp fills: exponential, from where a ray can first be below the clouds' top.

struct Shafts {
    float first;  // m
    float near;   // m: beyond it by that much steps are twice as long
    float growth; // log(1 + (reach - first) / near)
};
uniform Shafts shafts;

float shaft_distance(float x) { return shafts.first + shafts.near * (exp(shafts.growth * x) - 1.0); }
float shaft_coordinate(float distance)
{
    return clamp(log(1.0 + max(distance - shafts.first, 0.0) / shafts.near) / shafts.growth, 0.0, 1.0);
}
