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
//   bool medium_empty(float t, out float until)
//       whether only emptiness is looked up on all of [t, until]; where false, it is not worth asking again before
//       `until` (>= t either way). Called only with LEAP.
//
// Switches: SAMPLE_AT_MIDPOINTS (else at nodes), LEAP, STOP_EARLY, COUNT.
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

// Adds one segment; returns whether the ray has ended.
bool march_add(March m, float tau, vec3 source, inout Marched result)
{
    float opacity = opacity_of(tau);
    result.radiance += (result.transmittance * opacity) * source;
    result.transmittance *= 1.0 - opacity;
#ifdef STOP_EARLY
    return result.transmittance < m.stop_transmittance;
#else
    return false;
#endif
}

#ifdef COUNT
#define MARCH_COUNT(counter) ++result.counter
#else
#define MARCH_COUNT(counter)
#endif

Marched march(March m)
{
    Marched result = Marched(vec3(0.0), 1.0, 0u, 0u);
    int last = 1 + int(ceil(max(0.0, m.t_out - m.t_in - m.first_length)));
    float ask_at = m.t_in;  // no leap is possible before
#ifdef SAMPLE_AT_MIDPOINTS
    for (int n = 0; n < last;) {
        float t_front = node_t(m, n);
        float t_back = node_t(m, n + 1);
        float t = 0.5 * (t_front + t_back);
#ifdef LEAP
        if (t >= ask_at) {
            MARCH_COUNT(queries);
            if (medium_empty(t, ask_at)) {
                // Segments n .. n + floor(until - t) have their midpoints in there.
                n += 1 + int(ask_at - t);
                continue;
            }
        }
#endif
        Sample here = medium_sample(t);
        MARCH_COUNT(samples);
        float tau;
        vec3 source;
        if (medium_segment(here, here, t_front, t_back, tau, source) && march_add(m, tau, source, result)) {
            break;
        }
        ++n;
    }
#else
    // One sample a turn, at node n when the front is missing and else at node n + 1: lanes that run side by side stay
    // in step.
    bool has_front = false;
    Sample front = medium_nothing();
    for (int n = 0; n < last;) {
        float t_front = node_t(m, n);
#ifdef LEAP
        if (t_front >= ask_at) {
            MARCH_COUNT(queries);
            if (medium_empty(t_front, ask_at) && ask_at - t_front >= 1.0) {
                // Segments with both ends in there are empty; a front from before would be stale.
                n += int(ask_at - t_front);
                has_front = false;
                continue;
            }
        }
#endif
        float t_back = node_t(m, n + 1);
        Sample back = medium_sample(has_front ? t_back : t_front);
        MARCH_COUNT(samples);
        if (has_front) {
            float tau;
            vec3 source;
            if (medium_segment(front, back, t_front, t_back, tau, source) && march_add(m, tau, source, result)) {
                break;
            }
            ++n;
        }
        front = back;
        has_front = true;
    }
#endif
    return result;
}
