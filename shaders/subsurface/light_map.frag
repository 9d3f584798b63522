#version 450 core
// What a lamp sees of a translucent body: where its light enters, and how much of it gets in.
#include "include/octahedral.glsl"
#include "subsurface/subsurface.glsl"

in vec3 position_body;
in vec3 normal_body;
layout(location = 0) out vec4 point;   // mm; w: share of the light across the beam that passes the surface, 0 nothing
layout(location = 1) out vec2 normal;  // octahedral, on the side of the lamp

uniform float eta;
uniform int has_position;
uniform vec3 lamp;  // parallel light: unit, to the lamp; otherwise its place, mm
uniform vec3 axis;  // spot: unit, against the beam; 0 for a point light
uniform vec2 cone;

void main()
{
    vec3 way = lamp - position_body;
    vec3 toward = has_position != 0 ? way * inversesqrt(max(dot(way, way), 1e-30)) : lamp;
    float squared = dot(normal_body, normal_body);
    vec3 outward = squared > 1e-30 ? normal_body * inversesqrt(squared) : toward;
    outward = gl_FrontFacing ? outward : -outward;
    float inside = clamp((dot(toward, axis) - cone.x) * cone.y, 0.0, 1.0);
    float share = has_position != 0 ? inside * inside * (3.0 - 2.0 * inside) : 1.0;
    // Light is spread over flat triangles, but they stand for a smooth surface: by the ratio of the two cosines.
    vec3 facet = cross(dFdx(position_body), dFdy(position_body));
    float facing = abs(dot(facet, toward)) * inversesqrt(max(dot(facet, facet), 1e-36));
    float cosine = dot(outward, toward);
    float smoothing = clamp(cosine / max(facing, 0.02), 0.0, 1.5);
    point = vec4(position_body, share * smoothing * fresnel_transmittance(cosine, eta));
    normal = octahedral_encode(outward);
}
