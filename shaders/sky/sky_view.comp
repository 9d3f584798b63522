#version 450 core
// The sky and the ground around the camera, dense at the horizon, the sun in the plane of x and y. What haze scatters
// directly stands apart and without its phase function, which is too sharp for a table.
layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba32f, binding = 0) writeonly uniform image2D clear_table;
layout(rgba32f, binding = 1) writeonly uniform image2D haze_table;
uniform float altitude;
uniform float sun_climb;

#include "sky/sky_air.glsl"
#include "sky/sky_tables.glsl"

const int steps = 40;

void main()
{
    ivec2 size = imageSize(clear_table);
    ivec2 texel = ivec2(gl_GlobalInvocationID);
    if (any(greaterThanEqual(texel, size))) {
        return;
    }
    vec2 coordinates = table_coordinate(texel, size);
    vec2 place = sky_view_place(altitude, coordinates);
    float level = sin(place.x);
    vec3 direction = vec3(level * place.y, cos(place.x), level * sqrt(max(0.0, 1.0 - place.y * place.y)));
    vec3 to_sun = vec3(sqrt(max(0.0, 1.0 - sun_climb * sun_climb)), sun_climb, 0.0);
    AirLight light = sky_along(vec3(0.0, altitude, 0.0), direction, altitude, direction.y, coordinates.y > 0.5, to_sun,
                               steps);
    imageStore(clear_table, texel, vec4(light.clear, 1.0));
    imageStore(haze_table, texel, vec4(light.haze, 1.0));
}
