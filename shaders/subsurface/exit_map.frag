#version 450 core
// What one of the cameras around a translucent body sees of it: where light leaves.
#include "include/octahedral.glsl"

in vec3 position_body;
in vec3 normal_body;
layout(location = 0) out vec2 normal;  // octahedral, on the side of the camera

uniform vec3 toward_camera;

void main()
{
    float squared = dot(normal_body, normal_body);
    vec3 outward = squared > 1e-30 ? normal_body * inversesqrt(squared) : toward_camera;
    normal = octahedral_encode(gl_FrontFacing ? outward : -outward);
}
