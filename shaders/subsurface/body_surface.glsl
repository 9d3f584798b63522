// The surface of a translucent body at a pixel, in the body's frame. Needs mesh/covered_part.glsl.

in vec3 position_body;  // mm
in vec3 normal_body;

struct BodySurface {
    vec3 position;
    vec3 normal;  // smooth; like `facet` on the side of the eye
    vec3 facet;   // of the triangle
};

BodySurface body_surface()
{
    vec3 facet = cross(dFdx(position_body), dFdy(position_body));
    vec3 outward = WITHIN(normal_body);
    float squared = dot(outward, outward);
    vec3 normal = squared > 1e-30 ? outward * inversesqrt(squared) : vec3(0.0, 0.0, 1.0);
    float length2 = dot(facet, facet);
    facet = length2 > 1e-36 ? facet * inversesqrt(length2) : normal;
    facet = dot(facet, normal) < 0.0 ? -facet : facet;
    return BodySurface(WITHIN(position_body), gl_FrontFacing ? normal : -normal, gl_FrontFacing ? facet : -facet);
}
