// The parallel cameras around a translucent body, mm.

struct ExitCamera {
    vec4 right;  // w: coordinate of the map's left edge
    vec4 up;     // w: lower edge
    vec4 back;   // unit, towards the camera; w: -back . p of depth 0
    vec4 size;   // xy: of a texel; z: depth 1 less depth 0
};
layout(std140, binding = 1) uniform ExitCameras { ExitCamera exit_cameras[32]; };  // 0 behind the last

// Seen more slantingly than this, texels are stretched too far.
const float least_cosine = 0.08;

// Of the smooth surface and of the triangle, whichever turns further away.
float exit_cosine(ExitCamera camera, vec3 normal, vec3 facet)
{
    return min(dot(normal, camera.back.xyz), dot(facet, camera.back.xyz));
}

// Where a camera sees a point, texels.
vec2 exit_place(ExitCamera camera, vec3 p)
{
    return
        vec2(dot(camera.right.xyz, p) - camera.right.w, dot(camera.up.xyz, p) - camera.up.w) / camera.size.xy;
}
