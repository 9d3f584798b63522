#version 450 core
// How much of a ray's light comes through the air, from a point of any altitude to the end of the air.
layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba32f, binding = 0) writeonly uniform image2D table;

#include "sky/sky_air.glsl"

const int steps = 40;

void main()
{
    ivec2 size = imageSize(table);
    ivec2 texel = ivec2(gl_GlobalInvocationID);
    if (any(greaterThanEqual(texel, size))) {
        return;
    }
    vec2 place = transmittance_place(table_coordinate(texel, size));
    float segment = distance_to_top(place.x, place.y) / float(steps);
    float level = sqrt(max(0.0, 1.0 - place.y * place.y));
    vec3 optical_depth = vec3(0.0);
    for (int n = 0; n < steps; ++n) {
        float t = (float(n) + 0.5) * segment;
        float altitude = altitude_above(vec3(t * level, place.x + t * place.y, 0.0));
        optical_depth += air_at(max(altitude, 0.0)).extinction;
    }
    imageStore(table, texel, vec4(exp(-segment * optical_depth), 1.0));
}
