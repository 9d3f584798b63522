#version 450 core
// The picture where nothing stands in the scene.
layout(location = 0) out vec4 picture;
uniform vec2 pixels;
uniform vec3 background_top;
uniform vec3 background_bottom;

void main()
{
    picture = vec4(mix(background_bottom, background_top, gl_FragCoord.y / pixels.y), 0.0);
}
