// Shadows of clouds: what the layers on the way to a lamp let through of its light. Their grids hold optical depths in
// columns that lean towards it, so that a point below looks up the column that its own ray runs along.
// CLOUD_SHADOWS: how many layers.

struct CloudShade {
    vec2 origin;  // of the eye, in tiles of the weather map
    float scale;  // tiles per metre
    vec2 band;    // altitudes of the grid's lowest and highest nodes, m
    vec4 box;     // low x, low z, high x, high z from the eye, m
    float turned; // 1 - g: the share of optical depth that turns light around
};
uniform CloudShade cloud_shades[CLOUD_SHADOWS];
uniform sampler3D cloud_depths[CLOUD_SHADOWS];
uniform vec2 cloud_lean;             // x and z of the way to the lamp per metre of altitude
uniform int cloud_lamp;              // the one that they stand before
uniform vec2 cloud_metres;           // per unit; altitude of the eye

// Optical depth on the way to the lamp; y: as far as it turns light around. `p`: x and z from the eye and the altitude
// between them, m.
vec2 cloud_depth_at(vec3 p)
{
    vec2 depth = vec2(0.0);
    for (int n = 0; n < CLOUD_SHADOWS; ++n) {
        CloudShade shade = cloud_shades[n];
        float above = p.y - shade.band.x;
        float share = above / max(shade.band.y - shade.band.x, 1e-3);
        vec2 foot = p.xz - cloud_lean * above;
        float slices = float(textureSize(cloud_depths[n], 0).z);
        float slice = (clamp(share, 0.0, 1.0) * (slices - 1.0) + 0.5) / slices;
        float way = textureLod(cloud_depths[n], vec3(shade.origin + foot * shade.scale, slice), 0.0).x;
        // Sides of a box are asked for where the way passes the middle of the layer, or begins above it.
        vec2 passes = p.xz + cloud_lean * max(0.0, 0.5 * (shade.band.x + shade.band.y) - p.y);
        bool inside = all(greaterThan(passes, shade.box.xy)) && all(lessThan(passes, shade.box.zw));
        depth += share < 1.0 && inside ? way * vec2(1.0, shade.turned) : vec2(0.0);
    }
    return depth;
}

float light_through_clouds_at(vec3 p) { return exp(-cloud_depth_at(p).x); }

// Share of the lamp's light on level ground, what clouds scatter down included: Eddington's approximation for a level
// layer over black ground (Shettle and Weinman 1970) of conservative matter.
float light_on_ground_below_clouds(vec3 p)
{
    float mu = inversesqrt(1.0 + dot(cloud_lean, cloud_lean));
    float depth = cloud_depth_at(p).y * mu;
    return (2.0 / 3.0 + mu + (2.0 / 3.0 - mu) * exp(-depth / mu)) / (4.0 / 3.0 + depth);
}

// `from_eye`: in the pass's unit of length, world axes.
float light_through_clouds(int lamp, vec3 from_eye)
{
    return lamp == cloud_lamp ? light_through_clouds_at(from_eye * cloud_metres.x + vec3(0.0, cloud_metres.y, 0.0)) : 1.0;
}
