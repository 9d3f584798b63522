// The marcher: integrates emission and absorption along one ray through whatever medium the including shader defines.
//
// A ray is a run of nodes 0..last at parameters node_t(n); segment n lies between nodes n and n + 1. The parameter t
// counts steps, so every segment has length 1 except the first (shortened by jitter) and the last (what remains).
// Nodes are computed from the integer n by one expression, never by adding up: no drift, and a leap lands on the same
// bits as a walk.
//
// Holes that the including shader fills before it includes this file:
//
//   struct Sample                            what is looked up at one point of the ray
//   Sample medium_sample(float t), Sample medium_nothing()
//   bool medium_segment(Sample front, Sample back, float t_front, float t_back, out float tau, out vec3 source)
//       optical depth (>= 0, finite) and mean source radiance (finite) between two nodes; false when it is empty,
//       judged on looked-up values and not on a computed opacity. With SAMPLE_AT_MIDPOINTS both samples are the one
//       taken in the middle of the segment.
//   vec3 medium_lit(float weight)            with LIT, in place of `source`: light from the segment just judged, which
//                                            covers `weight` of the pixel
//   bool medium_empty(float t, out float until)
//       whether only emptiness is looked up on all of [t, until]; where false, it is not worth asking again before
//       `until` (>= t either way). Called only with LEAP.
//
//   bool medium_may_show(Sample front, Sample back)   with REFINE: false only if nothing between is visible, even if the
//                                            data bend
//
//   bool medium_has_hole(Sample front, Sample middle, Sample back)   with REFINE and HOLES: matter may begin or end abruptly
//
// Switches: SAMPLE_AT_MIDPOINTS (else at nodes), REFINE (nodes only), LIT, LEAP, STOP_EARLY, COUNT.
//
// REFINE: pre-integration takes the data for straight over a segment. Where something shows, one more sample in the
// middle tells how far that is from the truth: the halves replace the whole, and where they differ from it by more than
// refine_tolerance in opacity, or where matter ends abruptly, eighths replace the halves.
// Leaping changes no bit of the result: it skips only segments for which medium_segment would return false.

struct March {
    float t_in, t_out;         // steps
    float first_length;        // (0, 1]: length of segment 0
    float stop_transmittance;  // with STOP_EARLY the march ends below this
};

struct Marched {
    vec3 radiance;
    float transmittance;
    uint samples;  // medium_sample calls (COUNT)
    uint queries;  // medium_empty calls (COUNT)
};

float node_t(March m, int n)
{
    precise float t = m.t_in + (float(n - 1) + m.first_length);
    return n <= 0 ? m.t_in : min(t, m.t_out);
}

void march_add(float tau, vec3 source, inout Marched result)
{
    float opacity = opacity_of(tau);
    float weight = result.transmittance * opacity;
    result.transmittance *= 1.0 - opacity;
#ifdef LIT
    result.radiance += medium_lit(weight);
#else
    result.radiance += weight * source;
#endif
}

#ifdef COUNT
#define MARCH_COUNT(counter) ++result.counter
#else
#define MARCH_COUNT(counter)
#endif

#ifdef REFINE
const float refine_tolerance = 3e-4;
const int fine_parts = 8;

float march_opacity(Sample front, Sample back, float t_front, float t_back)
{
    float tau;
    vec3 source;
    return medium_segment(front, back, t_front, t_back, tau, source) ? opacity_of(tau) : 0.0;
}

void march_refined(Sample front, Sample back, float t_front, float t_back, inout Marched result)
{
    float t_middle = 0.5 * (t_front + t_back);
    Sample middle = medium_sample(t_middle);
    MARCH_COUNT(samples);
    float whole = march_opacity(front, back, t_front, t_back);
    float first = march_opacity(front, middle, t_front, t_middle);
    float second = march_opacity(middle, back, t_middle, t_back);
    float halves = first + second - first * second;
    int parts = result.transmittance * abs(halves - whole) > refine_tolerance ? fine_parts : 2;
#ifdef HOLES
    parts = medium_has_hole(front, middle, back) ? fine_parts : parts;
#endif
    float part = (t_back - t_front) / float(parts);
    float t_behind = t_front;
    for (int k = 1; k <= parts; ++k) {
        float t = k == parts ? t_back : t_front + float(k) * part;
        Sample next = back;
        if (k < parts) {
            next = middle;
            if (parts != 2) {
                next = medium_sample(t);
                MARCH_COUNT(samples);
            }
        }
        float tau;
        vec3 source;
        if (medium_segment(front, next, t_behind, t, tau, source)) {
            march_add(tau, source, result);
        }
        front = next;
        t_behind = t;
    }
}
#endif

Marched march(March m)
{
    Marched result = Marched(vec3(0.0), 1.0, 0u, 0u);
    int last = 1 + int(ceil(max(0.0, m.t_out - m.t_in - m.first_length)));
    float ask_at = m.t_in;  // no leap is possible before
#ifndef SAMPLE_AT_MIDPOINTS
    bool has_front = false;
    Sample front = medium_nothing();
#endif
#ifndef REFINE
    float tau;
    vec3 source;
#endif
    for (int n = 0; n < last; ++n) {
        float t_front = node_t(m, n);
#ifdef LEAP
#ifdef SAMPLE_AT_MIDPOINTS
        // Segments whose midpoints lie in emptiness are empty.
        float t_ask = 0.5 * (t_front + node_t(m, n + 1));
        const float ends = 1.0;
#else
        // Segments with both ends in emptiness are empty; a front from before would be stale.
        float t_ask = t_front;
        const float ends = 0.0;
#endif
        if (t_ask >= ask_at) {
            MARCH_COUNT(queries);
            if (medium_empty(t_ask, ask_at) && ask_at - t_ask + ends >= 1.0) {
                n += int(ask_at - t_ask + ends) - 1;
#ifndef SAMPLE_AT_MIDPOINTS
                has_front = false;
#endif
                continue;
            }
        }
#endif
#ifndef SAMPLE_AT_MIDPOINTS
        if (!has_front) {
            front = medium_sample(t_front);
            has_front = true;
            MARCH_COUNT(samples);
        }
#endif
        float t_back = node_t(m, n + 1);
#ifdef SAMPLE_AT_MIDPOINTS
        Sample back = medium_sample(0.5 * (t_front + t_back));
        Sample front = back;
#else
        Sample back = medium_sample(t_back);
#endif
        MARCH_COUNT(samples);
#ifdef REFINE
        if (medium_may_show(front, back)) {
            march_refined(front, back, t_front, t_back, result);
        }
#else
        if (medium_segment(front, back, t_front, t_back, tau, source)) {
            march_add(tau, source, result);
        }
#endif
#ifndef SAMPLE_AT_MIDPOINTS
        front = back;
#endif
#ifdef STOP_EARLY
        if (result.transmittance < m.stop_transmittance) {
            break;
        }
#endif
    }
    return result;
}
