#version 450 core
// Light that leaves a translucent body, at each texel of one of the maps around it: adds an estimate to the mean of those
// before.
#include "include/random.glsl"
#include "include/octahedral.glsl"
#include "subsurface/subsurface.glsl"
#include "subsurface/subsurface_entry.glsl"
#include "subsurface/exit_maps.glsl"
#include "subsurface/exit_texels.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 7) readonly buffer Chosen { uint chosen[]; };  // addresses
uniform uint first_chosen;
uniform uint past_chosen;
// rgb: mean of R, radiance inside over T_21; alpha: depth before the camera, mm, which says that there is something.
layout(binding = 0, rgba32f) uniform image2DArray radiosity;
layout(binding = 1, r32f) uniform image2DArray variance;  // squared standard error of the mean's grey, 0 after one pass
uniform sampler2DArray exit_depth;
uniform sampler2DArray exit_normals;
uniform int passes_before;

void main()
{
    uint place = first_chosen + gl_GlobalInvocationID.x;
    if (place >= past_chosen) {
        return;
    }
    uint address = chosen[place];
    ivec3 at = texel_at(address);
    float depth = texelFetch(exit_depth, at, 0).x;
    ExitCamera camera = exit_cameras[at.z];
    vec2 across = vec2(camera.right.w, camera.up.w) + (vec2(at.xy) + 0.5) * camera.size.xy;
    vec3 x_o = across.x * camera.right.xyz + across.y * camera.up.xyz -
               (camera.back.w + depth * camera.size.z) * camera.back.xyz;
    vec3 n_o = octahedral_decode(texelFetch(exit_normals, at, 0).xy);

    vec3 estimate = vec3(0.0);
    for (int lamp = 0; lamp < lamp_count; ++lamp) {
        vec2 shift = random_units(uvec2(at.xy), uint(at.z), uint(lamp)).xy;
        estimate += light_from_inside(lamp, x_o, n_o, shift);
    }
    vec3 before = passes_before == 0 ? vec3(0.0) : imageLoad(radiosity, at).rgb;
    float m = float(passes_before);
    vec3 mean = before + (estimate - before) / (m + 1.0);
    const vec3 grey = vec3(1.0 / 3.0);
    float before_squares = passes_before == 0 ? 0.0 : imageLoad(variance, at).x * m * (m - 1.0);
    float squares = before_squares + dot(grey, estimate - before) * dot(grey, estimate - mean);
    imageStore(radiosity, at, vec4(mean, depth * camera.size.z));
    imageStore(variance, at, vec4(passes_before == 0 ? 0.0 : squares / (m * (m + 1.0))));
    passes_of[address] = uint(passes_before) + 1u;
}
