// The parallel cameras around a translucent body, mm.

struct ExitCamera {
    vec4 right;  // w: coordinate of the map's left edge
    vec4 up;     // w: lower edge
    vec4 back;   // unit, towards the camera; w: -back . p of depth 0
    vec4 size;   // xy: of a texel; z: depth 1 less depth 0
};
layout(std430, binding = 1) readonly buffer ExitCameras { ExitCamera exit_cameras[]; };
