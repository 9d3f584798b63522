#version 450 core
// The picture where no volume stands in the scene. OPAQUE: there are surfaces before the background.
// SKY: a picture of both stands ready.
#ifdef OPAQUE
#include "include/opaque.glsl"
#endif
layout(location = 0) out vec4 picture;
#ifdef SKY
uniform sampler2D sky_picture;
#endif
uniform vec2 pixels;
uniform vec3 background_top;
uniform vec3 background_bottom;

void main()
{
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
}
