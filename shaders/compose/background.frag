#version 450 core
// The picture where no volume stands in the scene. OPAQUE: there are surfaces before the background, SKY: a picture of
// both stands ready, CLOUDS, SHAFTS: see clouds/clouds_over.glsl.
#include "surfaces/opaque.glsl"
#ifdef SHAFTS
#include "include/view_ray.glsl"
#include "clouds/cloud_shadow.glsl"
#else
uniform vec2 pixels;
#endif
#ifdef CLOUDS
#include "clouds/clouds_over.glsl"
#endif
layout(location = 0) out vec4 picture;
#ifdef SKY
uniform sampler2D sky_picture;
#endif
uniform vec3 background_top;
uniform vec3 background_bottom;

void main()
{
#ifdef OPAQUE
    if (opaque_share() == 0.0) {
        discard;
    }
#endif
#ifdef SKY
    picture = texelFetch(sky_picture, ivec2(gl_FragCoord.xy), 0);
#else
    vec3 background = mix(background_bottom, background_top, gl_FragCoord.y / pixels.y);
#ifdef OPAQUE
    picture = opaque_over(background);
#else
    picture = vec4(background, 0.0);
#endif
#endif
#ifdef CLOUDS
    picture = with_clouds(vec4(0.0, 0.0, 0.0, 1.0), 0.0, CLOUDS_END(metres_per_step), picture);
#endif
    picture = SHARE_OF(picture);
}
