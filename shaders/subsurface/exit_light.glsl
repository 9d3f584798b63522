// The light from inside at a visible point of a translucent body, out of the maps around it. Needs
// subsurface/body_surface.glsl and subsurface/exit_maps.glsl; mm.
// EXIT_MAPS: at least as many as there are. MAP_READS: only which texels those are.

// Below this, what maps say is too coarse: one of them sees the point, slantingly or past an edge.
const float seen_well = 0.02;
// Maps that see a point at less than this share of the squarest one's cosine add nothing where the squarer ones see it.
const float share_of_squarest = 0.6;
// Where these see less than this, 1 being the squarest map alone and whole, the slanting ones are asked too.
const float enough_seen = 0.5;

#ifdef MAP_READS
uniform sampler2DArray exit_depth;
// What another program may round the other way.
const float slack = 0.001;
ivec2 last_exit_texel() { return textureSize(exit_depth, 0).xy - 1; }
vec4 exit_texel(ivec3 at)
{
    float stored = texelFetch(exit_depth, at, 0).x;
    return vec4(0.0, 0.0, 0.0, stored < 1.0 ? stored * exit_cameras[at.z].size.z : 1e30);
}
#else
uniform sampler2DArray radiosity;  // alpha: depth before the camera, 1e30 where nothing was worked out
const float slack = 0.0;
ivec2 last_exit_texel() { return textureSize(radiosity, 0).xy - 1; }
vec4 exit_texel(ivec3 at) { return texelFetch(radiosity, at, 0); }
#endif

// Of a quadratic B-spline, at most 1.5 away.
float spline(float x)
{
    float a = abs(x);
    return a < 0.5 ? 0.75 - a * a : 0.5 * (1.5 - a) * (1.5 - a);
}

// What one map holds, filtered over 3 x 3 texels of this very surface; w: the share of them that is.
vec4 seen_by(int n, BodySurface s)
{
    ExitCamera camera = exit_cameras[n];
    ivec2 last = last_exit_texel();
    vec2 p = exit_place(camera, s.position);
    vec2 texel = floor(p);
    vec2 f = p - texel - 0.5;
    float depth = -dot(camera.back.xyz, s.position) - camera.back.w;
    // What the depth of a texel's centre is if the surface goes on flat.
    vec2 slope = vec2(dot(s.facet, camera.right.xyz), dot(s.facet, camera.up.xyz)) / dot(s.facet, camera.back.xyz);
    // What curves by a texel over a texel is still the same surface.
    float most = max(camera.size.x, camera.size.y) * (0.75 + length(slope)) * (1.0 - slack);
    vec4 seen = vec4(0.0);
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            vec2 beside = vec2(x, y) - f;
            vec4 stored = exit_texel(ivec3(clamp(ivec2(texel) + ivec2(x, y), ivec2(0), last), n));
            float expected = depth + dot(slope, beside * camera.size.xy);
            float weight = abs(stored.w - expected) < most ? spline(beside.x) * spline(beside.y) : 0.0;
            seen += weight * vec4(stored.rgb, 1.0);
        }
    }
    return seen;
}

// The maps that see a point, as bits; the squarest is the one whose view meets the surface most nearly at a right angle.
// Loops over bits end; in software, branches not taken cost as much as those taken.
struct MapsAround {
    int best;         // the squarest
    float squarest;   // its cosine
    float least;      // that counts beside it
    uint square;      // of at least that
    uint slanting;    // of less
};

MapsAround maps_around(BodySurface s, float slack_of_cosine)
{
    // With counts that are known when this is compiled, cameras are read once and not by each pixel.
    float cosines[EXIT_MAPS];
    MapsAround maps = MapsAround(0, -1.0, 0.0, 0u, 0u);
    for (int n = 0; n < EXIT_MAPS; ++n) {
        cosines[n] = exit_cosine(exit_cameras[n], s.normal, s.facet);
        maps.best = cosines[n] > maps.squarest ? n : maps.best;
        maps.squarest = max(maps.squarest, cosines[n]);
    }
    maps.least = max(least_cosine, share_of_squarest * maps.squarest);
    for (int n = 0; n < EXIT_MAPS; ++n) {
        maps.square |= cosines[n] >= maps.least - slack_of_cosine ? 1u << n : 0u;
        maps.slanting |= cosines[n] >= least_cosine - slack_of_cosine ? 1u << n : 0u;
    }
    maps.slanting &= ~maps.square;
    return maps;
}

// Sums over maps, weighted; w: the weights.
struct ExitSums {
    vec4 square;  // 0 at the least cosine that counts, 1 at the largest
    vec4 all;     // 0 at the least of all
};

// Slanting texels smear far over the surface; with neighbours on one side only there is no mean, only a guess.
void add_map(int n, BodySurface s, MapsAround maps, inout ExitSums sums)
{
    vec4 seen = seen_by(n, s);
    float cosine = exit_cosine(exit_cameras[n], s.normal, s.facet);
    float below = clamp((maps.squarest - cosine) / max(maps.squarest - maps.least, 1e-6), 0.0, 1.0);
    float square = 1.0 - below * below;  // broad, for the less noise
    float facing = max(cosine - least_cosine, 0.0);
    sums.square += square * seen.w * seen;
    sums.all += facing * facing * seen.w * seen;
}

bool needs_slanting_maps(ExitSums sums)
{
    return sums.square.w < enough_seen * (1.0 + 10.0 * slack) || sums.all.w < seen_well * (1.0 + 10.0 * slack);
}

// Mean of R over the maps that see a point; w: how well it is seen, at most as many as there are maps.
vec4 light_from_maps(BodySurface s)
{
    MapsAround maps = maps_around(s, 0.0);
    ExitSums sums = ExitSums(vec4(0.0), vec4(0.0));
    uint left = maps.square;
    uint slanting = maps.slanting;
    while (left != 0u) {
        add_map(findLSB(left), s, maps, sums);
        left &= left - 1u;
        if (left == 0u && needs_slanting_maps(sums)) {
            left = slanting;
            slanting = 0u;
        }
    }
    vec3 mean = mix(sums.all.rgb / max(sums.all.w, 1e-20), sums.square.rgb / max(sums.square.w, 1e-20),
                    min(sums.square.w / enough_seen, 1.0));
    return vec4(mean, sums.all.w);
}
