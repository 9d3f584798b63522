// The look of three.js' Sky: single scattering with exponents that are no physics, and a disc of twice the sun's size.
// For comparison. rayleigh and mie are strengths, sun_disc is 0 for none; the constants are per metre for 680, 550 and
// 450 nm.

vec3 look_radiance(vec3 direction, vec3 to_sun, float turbidity, float rayleigh_strength, float mie_strength, float g,
                   float sun_disc)
{
    vec3 molecules = vec3(5.804542996e-6, 1.356291142e-5, 3.026590247e-5) * rayleigh_strength;
    vec3 haze = 0.434 * 0.2 * turbidity * mie_strength * vec3(1.8399918514e-3, 2.7798023920e-3, 4.0790479544e-3);
    float zenith = atan(length(direction.xz), max(direction.y, 0.0));
    float mass = 1.0 / (cos(zenith) + 0.15 * pow(93.885 - degrees(zenith), -1.253));
    vec3 passed = exp(-(molecules * 8400.0 + haze * 1250.0) * mass);
    float mu = dot(direction, to_sun);
    float sun = 1000.0 * max(0.0, 1.0 - exp(-(1.61107 - atan(length(to_sun.xz), to_sun.y)) / 1.5));
    float shifted = 0.5 * mu + 0.5;
    float base = max(1.0 + g * g - 2.0 * g * mu, 1e-6);
    float forward = 0.0795774715 * (1.0 - g * g) / (base * sqrt(base));
    vec3 scattered = sun * (molecules * (0.0596831037 * (1.0 + shifted * shifted)) + haze * forward) /
                     max(molecules + haze, 1e-30);
    float low_sun = clamp(pow(max(1.0 - to_sun.y, 0.0), 5.0), 0.0, 1.0);
    vec3 air_light = scattered * (1.0 - passed);
    vec3 in_scattered = air_light * sqrt(air_light) * mix(vec3(1.0), sqrt(scattered * passed), low_sun);
    const float disc = 0.99995667694;
    vec3 direct = 0.1 * passed + sun_disc * 19000.0 * sun * passed * smoothstep(disc, disc + 0.00002, mu);
    // A unit vector makes the original's fade of the sun, which divides by 450000, a constant 1.
    return pow((in_scattered + direct) * 0.04 + vec3(0.0, 0.0003, 0.00075), vec3(1.0 / 2.4));
}
