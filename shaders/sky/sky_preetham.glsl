// The fit of Preetham, Shirley and Smits 1999, "A Practical Analytic Model for Daylight": from the ground by day.
// Y in kcd/m2; angles in radians from the zenith, gamma between view and sun.

// A to E over the turbidity t; components Y, x, y.
struct PreethamSpread {
    vec3 a, b, c, d, e;
};

PreethamSpread preetham_spread(float t)
{
    return PreethamSpread(vec3(0.1787, -0.0193, -0.0167) * t + vec3(-1.4630, -0.2592, -0.2608),
                          vec3(-0.3554, -0.0665, -0.0950) * t + vec3(0.4275, 0.0008, 0.0092),
                          vec3(-0.0227, -0.0004, -0.0079) * t + vec3(5.3251, 0.2125, 0.2102),
                          vec3(0.1206, -0.0641, -0.0441) * t + vec3(-2.5771, -0.8989, -1.6537),
                          vec3(-0.0670, -0.0033, -0.0109) * t + vec3(0.3703, 0.0452, 0.0529));
}

vec3 preetham_distribution(PreethamSpread s, float zenith_cosine, float gamma)
{
    float cosine = cos(gamma);
    return (1.0 + s.a * exp(s.b / max(zenith_cosine, 0.01))) * (1.0 + s.c * exp(s.d * gamma) + s.e * cosine * cosine);
}

vec3 preetham_zenith(float t, float sun_zenith)
{
    float chi = (4.0 / 9.0 - t / 120.0) * (3.14159265 - 2.0 * sun_zenith);
    vec3 powers = vec3(t * t, t, 1.0);
    vec4 angles = vec4(sun_zenith * sun_zenith * sun_zenith, sun_zenith * sun_zenith, sun_zenith, 1.0);
    // Columns: what stands before the powers of the angle.
    const mat4x3 x = mat4x3(0.00166, -0.02903, 0.11693, -0.00375, 0.06377, -0.21196, 0.00209, -0.03202, 0.06052, 0.0,
                            0.00394, 0.25886);
    const mat4x3 y = mat4x3(0.00275, -0.04214, 0.15346, -0.00610, 0.08970, -0.26756, 0.00317, -0.04153, 0.06670, 0.0,
                            0.00516, 0.26688);
    return vec3((4.0453 * t - 4.9710) * tan(chi) - 0.2155 * t + 2.4192, dot(powers, x * angles),
                dot(powers, y * angles));
}

vec3 preetham_Yxy(float turbidity, float zenith_cosine, float sun_zenith, float gamma)
{
    PreethamSpread s = preetham_spread(turbidity);
    return preetham_zenith(turbidity, sun_zenith) * preetham_distribution(s, zenith_cosine, gamma) /
           preetham_distribution(s, 1.0, sun_zenith);
}

vec3 rec709_from_Yxy(vec3 Yxy)
{
    vec3 XYZ = vec3(Yxy.y, Yxy.z, 1.0 - Yxy.y - Yxy.z) * (Yxy.x / Yxy.z);
    const mat3 from_XYZ = mat3(3.2404542, -0.9692660, 0.0556434, -1.5371385, 1.8760108, -0.2040259, -0.4985314, 0.0415560,
                               1.0572252);
    return from_XYZ * XYZ;
}
