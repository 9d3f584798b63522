// Free flights and transmittances through the medium of path_medium.glsl, without bias.
//
// Bounds: a ray crosses each macrocell once. Beyond `free_events` collisions, real or not, each one more is survived
// with `survival` and what survives counts for 1 / survival: nothing is lost on average, and no ray is expected to go on
// for more than 1 / (1 - survival) more. The loops end at `most_events`, which a ray reaches with a chance below 1e-50.
const int free_events = 4096;
const int most_events = 8192;
const float survival = 31.0 / 32.0;

// One block of random numbers after the other, for this pixel and path.
uvec2 random_pixel;
uint random_path;
uint random_block;
void begin_random(uvec2 pixel, int path)
{
    random_pixel = pixel;
    random_path = uint(path);
    random_block = 0u;
}
vec4 next_random() { return random_units(random_pixel, random_path, random_block++); }

float optical_depth_drawn(float number) { return -log(1.0 - number); }

// Flies from `c.t` on along the ray of begin_walk to the next collision (delta tracking). False when the ray leaves the
// medium or dies; `chance` then is 0, and else what the flight must be multiplied by.
bool fly(inout Collision c, out float chance)
{
    chance = 1.0;
    float depth = optical_depth_drawn(next_random().x);
    for (int events = 0; events < most_events;) {
        float until;
        float most = walk_bounds(c.t, until).y;
        if (until == never) {
            return false;
        }
        float reach = most * max(0.0, until - c.t);
        if (depth >= reach) {
            depth -= reach;
            c.t = until;
            walk_on(until);
            continue;
        }
        c.t += depth / most;
        vec4 numbers = next_random();
        if (collides(numbers.x * most, c)) {
            return true;
        }
        depth = optical_depth_drawn(numbers.y);
        if (++events > free_events) {
            if (numbers.z >= survival) {
                break;
            }
            chance /= survival;
        }
    }
    chance = 0.0;
    return false;
}

// Transmittance from `origin` over the length `far`: exactly that of the least sigma of each macrocell, times the mean
// of products over random points of the rest (residual ratio tracking, Novak et al. 2014).
float transmittance(vec3 origin, vec3 direction, float far)
{
    const float deepest = 88.0;   // exp(-88) is below the smallest normal float
    const float dim = 0.05;
    begin_walk(origin, direction, 0.0, far);
    float t = 0.0;
    float least_depth = 0.0;
    float rest = 1.0;
    float depth = optical_depth_drawn(next_random().x);
    for (int events = 0; events < most_events;) {
        float until;
        vec2 sigma = walk_bounds(t, until);
        if (until == never) {
            return rest * exp(-least_depth);
        }
        float span = max(0.0, until - t);
        float most = sigma.y - sigma.x;
        if (depth >= most * span) {
            depth -= most * span;
            least_depth += sigma.x * span;
            if (least_depth > deepest) {
                return 0.0;
            }
            t = until;
            walk_on(until);
            continue;
        }
        float flown = depth / most;
        t += flown;
        least_depth += sigma.x * flown;
        rest *= clamp((sigma.y - sigma_at(t)) / most, 0.0, 1.0);
        vec4 numbers = next_random();
        depth = optical_depth_drawn(numbers.x);
        ++events;
        float kept = rest * exp(-least_depth) < dim ? 0.5 : events > free_events ? survival : 1.0;
        if (numbers.y >= kept) {
            return 0.0;
        }
        rest /= kept;
    }
    return 0.0;
}
