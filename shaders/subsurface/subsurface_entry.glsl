// The light that leaves a translucent body at one point, estimated from points where it enters:
//
//     R(x_o) = integral of E_perp T_12 S_d dA_perp  ~  1/N sum of E_perp T_12 S_d / p
//
// Points are drawn in the plane through x_o across the light and looked up in what the lamp sees, so that each is lit and
// its cosine is in the measure of the plane. A point beside the body counts in N. Needs subsurface/subsurface.glsl and
// include/octahedral.glsl; lengths in mm.

struct LightFace {
    vec4 right, up;  // w: texels per unit across the view
    vec4 toward;     // w: layer
    vec4 first;      // xy: texel of the coordinate 0
};
struct Lamp {
    vec4 power;  // rgb: E_perp; with a position intensity, E_perp times mm^2. w: 0 parallel, 1 one view, 2 six views
    vec4 eye;    // mm; w: radius of the disk that holds the body: mm, or the tangent of its angle
    LightFace faces[6];
};
layout(std430, binding = 2) readonly buffer Lamps { Lamp lamps[]; };
uniform vec2 entry_points[256];  // in the unit square

uniform SubsurfaceMedium medium;
uniform int lamp_count;
uniform int entry_samples;
uniform vec3 tail_rates;  // 1/mm
uniform vec3 core_rates;
uniform float back_lit_depth;
uniform sampler2DArray light_points;
uniform sampler2DArray light_normals;

const float pi = 3.14159265358979;

struct Entry {
    vec3 point;   // mm
    vec3 normal;  // on the side of the lamp
    float share;  // that passes the surface; 0: nothing is there
};

// The surface that a lamp sees at, or through, a point. Within a texel it is taken to be flat: sums over texels' centres
// alone would miss or double the peak of S_d, which may be narrower than a texel.
// `v` is that point less the lamp's place.
Entry entry_through(int lamp, float kind, LightFace f, vec3 q, vec3 v)
{
    bool parallel = kind == 0.0;
#ifdef CUBE_LAMPS
    if (kind == 2.0) {
        vec3 a = abs(v);
        int face =
            a.x >= a.y && a.x >= a.z ? (v.x > 0.0 ? 0 : 1) : a.y >= a.z ? (v.y > 0.0 ? 2 : 3) : (v.z > 0.0 ? 4 : 5);
        f = lamps[lamp].faces[face];
    }
#endif
    float depth = parallel ? 1.0 : max(-dot(f.toward.xyz, v), 1e-30);
    vec2 across = vec2(dot(f.right.xyz, v), dot(f.up.xyz, v)) / depth;
    vec2 at = floor(across * vec2(f.right.w, f.up.w) + f.first.xy);
    vec2 last = vec2(textureSize(light_points, 0).xy - 1);
    vec4 stored = at == clamp(at, vec2(0.0), last) ? texelFetch(light_points, ivec3(at, f.toward.w), 0) : vec4(0.0);
    vec3 normal = octahedral_decode(texelFetch(light_normals, ivec3(clamp(at, vec2(0.0), last), f.toward.w), 0).xy);
    vec3 toward = parallel ? f.toward.xyz : -normalize(v);
    vec3 beside = q - stored.xyz;
    beside -= toward * dot(beside, toward);
    vec3 point = stored.xyz + beside - toward * (dot(normal, beside) / max(dot(normal, toward), 0.2));
    return Entry(point, normal, stored.w);
}

#ifdef EXPONENTIAL_DISK
// The density of Dal Corso et al. (2016), e^(-rate rho) on a disk, cut where the body ends: `disk` is the rate, the
// radius and 1 / Z.
float share_within(float t)
{
    return t < 0.05 ? t * t * (0.5 - t / 3.0 + 0.125 * t * t) : 1.0 - (1.0 + t) * exp(-t);
}

vec3 published_disk(float body_radius)
{
    float rate = min(tail_rates.x, min(tail_rates.y, tail_rates.z));
    float radius = min(8.0 / rate, 2.0 * body_radius);
    return vec3(rate, radius, rate * rate / (2.0 * pi * share_within(rate * radius)));
}

float density_around(float rho, vec3 disk) { return rho <= disk.y ? disk.z * exp(-disk.x * rho) : 0.0; }

// Newton's method, kept inside of a bracket.
float drawn_distance(float u, vec3 disk)
{
    vec2 ends = vec2(0.0, disk.x * disk.y);
    float wanted = u * share_within(ends.y);
    float t = min(ends.y, sqrt(2.0 * wanted));
    for (int turn = 0; turn < 12; ++turn) {
        float excess = share_within(t) - wanted;
        ends = excess > 0.0 ? vec2(ends.x, t) : vec2(t, ends.y);
        float next = t - excess / max(t * exp(-t), 1e-30);
        t = next > ends.x && next < ends.y ? next : 0.5 * (ends.x + ends.y);
    }
    return t / disk.x;
}
#else
// Core and tail of each channel at distance rho.
float density_around(float rho, vec3 cores)
{
    vec3 sum = tail_rates * exp(-tail_rates * rho) + cores * exp(-cores * rho);
    return (sum.x + sum.y + sum.z) / (12.0 * pi * max(rho, 1e-30));
}

// One number picks the rate and, stretched, the distance.
float drawn_distance(float u, vec3 cores)
{
    float scaled = 6.0 * u;
    int pick = min(int(scaled), 5);
    float rate = pick < 3 ? tail_rates[pick] : cores[pick - 3];
    return -log(max(1.0 - (scaled - float(pick)), 1e-7)) / rate;
}
#endif

vec3 subsurface_density(vec3 x, Entry entry, vec3 toward, vec3 n_o)
{
#ifdef STANDARD_DIPOLE
    return standard_dipole(medium, x);
#else
    return directional_dipole(medium, x, entry.normal, refract_into(toward, entry.normal, medium.eta), n_o);
#endif
}

// R at x_o by the light of one lamp. `shift` is uniform in the unit square: it moves the points, so that each alone is
// uniform and the estimate has no bias however few there are.
vec3 light_from_inside(int lamp, vec3 x_o, vec3 n_o, vec2 shift)
{
    float kind = lamps[lamp].power.w;
    vec3 eye = lamps[lamp].eye.xyz;
    LightFace face = lamps[lamp].faces[0];
    vec3 axis = face.toward.xyz;
    vec3 right = face.right.xyz;
    vec3 up = face.up.xyz;
    vec3 from_eye = x_o - eye;
    if (kind == 2.0) {
        axis = -normalize(from_eye + vec3(0.0, 0.0, dot(from_eye, from_eye) > 0.0 ? 0.0 : 1.0));
        right = normalize(abs(axis.z) < 0.9 ? vec3(-axis.y, axis.x, 0.0) : vec3(0.0, -axis.z, axis.y));
        up = cross(axis, right);
    }
    float distance_o = kind == 0.0 ? 1.0 : max(-dot(axis, from_eye), 1e-20);  // of the plane
    vec2 centre = -vec2(dot(right, from_eye), dot(up, from_eye));             // of the body, seen along the light
    float radius = lamps[lamp].eye.w * distance_o;

    // How deep x_o lies below the lit surface decides which density suits.
    Entry above = entry_through(lamp, kind, face, x_o, from_eye);
    vec3 toward_o = kind == 0.0 ? axis : -normalize(from_eye);
    float depth = above.share > 0.0 ? dot(above.point - x_o, toward_o) : 0.0;
#ifdef EXPONENTIAL_DISK
    bool thick = false;
    vec3 cores = published_disk(radius);
    float uniform_share = kind == 2.0 ? 0.1 : 0.0;
#else
    bool back_lit = depth > back_lit_depth;
    bool thick = back_lit && depth >= 0.25 * radius;
    vec3 cores = back_lit ? min(core_rates, vec3((thick ? 2.0 : 1.0) / depth)) : core_rates;
    // Around a lamp amid the body, points on the far side of it are reached by uniform directions alone.
    float uniform_share = kind == 2.0 ? (thick ? 0.5 : back_lit ? 0.25 : 0.1) : back_lit ? 0.25 : 0.0;
#endif
    // From behind, the rim of the lit side is nearest: points as if uniform on a hemisphere over the disk.
    float hemisphere_share = thick && kind != 2.0 ? 0.25 : 0.0;
    float disk_share = uniform_share + hemisphere_share;

    vec3 sum = vec3(0.0);
    for (int n = 0; n < entry_samples; ++n) {
        vec2 u = fract(entry_points[n] + shift);
        float rotation = 2.0 * pi * u.y;
        vec2 round_about = vec2(cos(rotation), sin(rotation));
        vec2 d;
        vec3 v;  // from the lamp
        if (u.x < disk_share) {
            float s = u.x < uniform_share ? u.x / uniform_share : (u.x - uniform_share) / hemisphere_share;
            d = centre + radius * sqrt(u.x < uniform_share ? s : s * (2.0 - s)) * round_about;
            v = from_eye + d.x * right + d.y * up;
            if (kind == 2.0) {
                float z = 2.0 * s - 1.0;
                v = distance_o * vec3(sqrt(max(0.0, 1.0 - z * z)) * round_about, z);
                float along = -dot(axis, v);
                // Where the plane is met again, if it is.
                v *= along > 1e-4 * distance_o ? distance_o / along : 1.0;
                vec3 on_plane = v - from_eye;
                d = along > 1e-4 * distance_o ? vec2(dot(right, on_plane), dot(up, on_plane)) : vec2(1e30);
            }
        } else {
            d = drawn_distance((u.x - disk_share) / (1.0 - disk_share), cores) * round_about;
            v = from_eye + d.x * right + d.y * up;
        }
        // Density per area of the plane; about a lamp amid the body, per solid angle.
        float squared = dot(v, v);
        float area_per_angle = kind == 0.0 ? 1.0 : squared * sqrt(squared) / distance_o;
        float p = (1.0 - disk_share) * (d.x < 1e29 ? density_around(length(d), cores) : 0.0);
        if (kind == 2.0) {
            p = p * area_per_angle + uniform_share / (4.0 * pi);
        } else {
            vec2 from_centre = (d - centre) / radius;
            float slope2 = 1.0 - dot(from_centre, from_centre);
            float disk = uniform_share + 0.5 * hemisphere_share * inversesqrt(max(slope2, 1e-6));
            p += slope2 >= -1e-6 ? disk / (pi * radius * radius) : 0.0;  // no drawn point is rounded off the rim
            p *= area_per_angle;
        }
        Entry entry = entry_through(lamp, kind, face, eye + v, v);
        if (entry.share > 0.0) {
            vec3 toward = kind == 0.0 ? axis : -v * inversesqrt(squared);
            sum += entry.share / p * subsurface_density(x_o - entry.point, entry, toward, n_o);
        }
    }
    return lamps[lamp].power.rgb * sum / float(entry_samples);
}
