// Where a triangle covers part of a pixel, the pixel's middle may lie beside it, and light would be found beside the surface.
// WITHIN moves what was interpolated to the middle of the covered samples: along the plane through its neighbours, since
// centroids of drivers were seen to leave it. SAMPLES: how many a pixel has; 1 where it is not defined.

#ifdef SAMPLES
uniform vec2 sample_places[SAMPLES];  // in the pixel, less its middle
vec2 covered_middle = vec2(0.0);

// Whether all of the pixel is covered.
bool find_covered_part()
{
    int mask = gl_SampleMaskIn[0];
    if (mask == (1 << SAMPLES) - 1) {
        return true;
    }
    vec2 sum = vec2(0.0);
    float count = 0.0;
    for (int n = 0; n < SAMPLES; ++n) {
        if ((mask & (1 << n)) != 0) {
            sum += sample_places[n];
            count += 1.0;
        }
    }
    covered_middle = sum / max(count, 1.0);
    return false;
}
// What a triangle needs of a number that is meant for a whole pixel, at least 1.
int covered_share_of(int number) { return (number * bitCount(gl_SampleMaskIn[0]) + SAMPLES - 1) / SAMPLES; }
// Tells the triangles in a pixel apart, whatever their order: by what they cover; 0 for all of it.
uint part_number() { return uint(~gl_SampleMaskIn[0] & ((1 << SAMPLES) - 1)) << 8; }
#define WITHIN(varying) (varying + covered_middle.x * dFdx(varying) + covered_middle.y * dFdy(varying))
#else
bool find_covered_part() { return true; }
int covered_share_of(int number) { return number; }
uint part_number() { return 0u; }
#define WITHIN(varying) varying
#endif
