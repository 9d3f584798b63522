// Air, haze and ozone around a planet, after Hillaire 2020, "A Scalable and Production Ready Sky and Atmosphere Rendering
// Technique". Metres; altitudes above the ground; `climb` is the vertical component of a unit direction. No square of the
// planet's radius is ever subtracted from another: altitudes and distances keep to metres in single precision.

struct Air {
    float radius;               // of the planet
    float height;               // above which there is nothing
    vec3 rayleigh_scattering;   // per metre, at sea level
    float rayleigh_scale_height;
    float mie_scattering;
    float mie_extinction;
    float mie_scale_height;
    float mie_g;
    vec3 ozone_absorption;
    float ozone_altitude;
    float ozone_half_width;
    vec3 ground_albedo;
};
uniform Air air;

struct AirPoint {
    vec3 rayleigh;    // scattering per metre
    float mie;        // scattering
    vec3 extinction;
};

AirPoint air_at(float altitude)
{
    float thin = exp(-altitude / air.rayleigh_scale_height);
    float haze = exp(-altitude / air.mie_scale_height);
    float ozone = max(0.0, 1.0 - abs(altitude - air.ozone_altitude) / air.ozone_half_width);
    AirPoint point;
    point.rayleigh = air.rayleigh_scattering * thin;
    point.mie = air.mie_scattering * haze;
    point.extinction = point.rayleigh + air.mie_extinction * haze + air.ozone_absorption * ozone;
    return point;
}

float rayleigh_phase(float mu) { return 0.0596831037 * (1.0 + mu * mu); }

// Cornette and Shanks 1992. The base is (1 - g)^2 at least.
float mie_phase(float mu, float g)
{
    float base = max(1.0 + g * g - 2.0 * g * mu, 1e-6);
    return 0.1193662073 * (1.0 - g * g) * (1.0 + mu * mu) / ((2.0 + g * g) * base * sqrt(base));
}

// Distances to the sphere of an altitude, near and far, negative behind the origin; (1e30, -1e30) where it is missed.
vec2 sphere_hits(float altitude, float climb, float sphere_altitude)
{
    float product = (altitude - sphere_altitude) * (2.0 * air.radius + altitude + sphere_altitude);
    float half_sum = (air.radius + altitude) * climb;
    float discriminant = half_sum * half_sum - product;
    if (discriminant < 0.0) {
        return vec2(1e30, -1e30);
    }
    float root = sqrt(discriminant);
    float q = half_sum > 0.0 ? -half_sum - root : root - half_sum;
    float other = q == 0.0 ? 0.0 : product / q;  // the root that would cancel, from the product of both
    return vec2(min(q, other), max(q, other));
}

// Altitude of a point relative to the sea-level point below the camera.
float altitude_above(vec3 from_sea_level)
{
    float rise = 2.0 * air.radius * from_sea_level.y + dot(from_sea_level, from_sea_level);
    return rise / (sqrt(max(air.radius * air.radius + rise, 0.0)) + air.radius);
}

vec3 up_at(vec3 from_sea_level) { return normalize(from_sea_level + vec3(0.0, air.radius, 0.0)); }

// Length of the tangent to the ground.
float tangent_length(float altitude) { return sqrt(max(altitude, 0.0) * (2.0 * air.radius + altitude)); }

// The vertical component of the ray that just touches the ground.
float horizon_climb(float altitude) { return -tangent_length(altitude) / (air.radius + altitude); }

float distance_to_top(float altitude, float climb) { return max(0.0, sphere_hits(altitude, climb, air.height).y); }

// Of a ray that goes below the horizon; at the horizon itself the tangent.
float distance_to_ground(float altitude, float climb)
{
    float product = altitude * (2.0 * air.radius + altitude);
    float half_sum = (air.radius + altitude) * climb;
    return product / (sqrt(max(half_sum * half_sum - product, 0.0)) - half_sum);
}

// Texture coordinate of x in [0,1], whose ends stand at the centres of the first and the last of n texels; and back.
vec2 table_texture_coordinate(vec2 x, vec2 n) { return (0.5 + x * (n - 1.0)) / n; }
vec2 table_coordinate(ivec2 texel, ivec2 n) { return vec2(texel) / vec2(max(n - 1, ivec2(1))); }

// Transmittance table: from the ray straight up (0) to the horizon (1), and over the altitude (Bruneton and Neyret 2008).
vec2 transmittance_coordinates(float altitude, float climb)
{
    float longest = tangent_length(air.height);
    float tangent = tangent_length(altitude);
    float nearest = air.height - altitude;
    float span = tangent + longest - nearest;
    float d = distance_to_top(altitude, climb);
    return clamp(vec2(span > 0.0 ? (d - nearest) / span : 0.0, tangent / longest), 0.0, 1.0);
}

// Altitude and climb.
vec2 transmittance_place(vec2 coordinates)
{
    float longest = tangent_length(air.height);
    float tangent = coordinates.y * longest;
    float altitude = tangent * tangent / (sqrt(tangent * tangent + air.radius * air.radius) + air.radius);
    float nearest = air.height - altitude;
    float d = nearest + coordinates.x * (tangent + longest - nearest);
    float radius = air.radius + altitude;
    // (top^2 - r^2 - d^2) / (2 r d), the first difference factored.
    float numerator = nearest * (2.0 * air.radius + air.height + altitude) - d * d;
    return vec2(altitude, d > 0.0 ? clamp(numerator / (2.0 * radius * d), -1.0, 1.0) : 1.0);
}

// Angle between straight down and the horizon; from one metre up it has one of its own.
float horizon_nadir_angle(float altitude)
{
    return atan(air.radius, tangent_length(max(altitude, 1.0)));
}

// Sky-view table: u from towards the sun (0) to away from it (1), v from the zenith (0) over the horizon (0.5) to straight
// down (1). v = 0.5 is both sky and ground, so the caller says which.
vec2 sky_view_coordinates(float altitude, float zenith_angle, float azimuth_cosine, bool toward_ground)
{
    float nadir = horizon_nadir_angle(altitude);
    float horizon = 3.14159265 - nadir;
    float v = toward_ground ? 0.5 + 0.5 * sqrt(clamp((zenith_angle - horizon) / nadir, 0.0, 1.0))
                            : 0.5 - 0.5 * sqrt(clamp(1.0 - zenith_angle / horizon, 0.0, 1.0));
    return vec2(sqrt(clamp(0.5 - 0.5 * azimuth_cosine, 0.0, 1.0)), v);
}

// Zenith angle and cosine of the azimuth.
vec2 sky_view_place(float altitude, vec2 coordinates)
{
    float nadir = horizon_nadir_angle(altitude);
    float horizon = 3.14159265 - nadir;
    float w = 1.0 - 2.0 * coordinates.y;
    return vec2(w > 0.0 ? horizon * (1.0 - w * w) : horizon + nadir * w * w, 1.0 - 2.0 * coordinates.x * coordinates.x);
}

// Share of the sun's disc above the horizon, smooth over the disc's angle.
float sun_disc_above_horizon(float altitude, float sun_climb)
{
    float half_width = 0.004675 * air.radius / (air.radius + altitude);
    float horizon = horizon_climb(altitude);
    return smoothstep(horizon - half_width, horizon + half_width, sun_climb);
}
