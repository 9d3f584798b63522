// The ray through a pixel's centre, one for every pass that draws what the camera sees.

uniform vec2 pixels;       // size of the picture
uniform int orthographic;
uniform vec2 half_view;    // perspective: tangents; orthographic: half sizes in the pass's unit of length

struct ViewRay {
    vec3 start;   // in camera axes (right, up, back), relative to the eye
    vec3 toward;  // not of unit length: 1 along the view axis
};

// A shader that draws some pixels only says where they are in the picture.
#ifndef PIXEL_CENTRE
#define PIXEL_CENTRE gl_FragCoord.xy
#endif

ViewRay view_ray()
{
    vec2 ndc = PIXEL_CENTRE / pixels * 2.0 - 1.0;
    vec2 across = ndc * half_view;
    return orthographic != 0 ? ViewRay(vec3(across, 0.0), vec3(0.0, 0.0, -1.0))
                             : ViewRay(vec3(0.0), vec3(across, -1.0));
}
