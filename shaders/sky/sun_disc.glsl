// The sun's disc for irradiance 1, without the air: darker and redder towards the limb (Hestroffer and Magnan 1998), with
// the irradiance kept.

// Angle between two vectors, exact for small ones too; drivers are free with arc cosines, some to 1e-4.
float angle_between(vec3 a, vec3 b) { return atan(length(cross(a, b)), dot(a, b)); }

vec3 sun_disc_radiance(float angle, float angular_radius, bool limb_darkening)
{
    float share = angle / angular_radius;
    if (share >= 1.0) {
        return vec3(0.0);
    }
    float half_sine = sin(0.5 * angular_radius);
    vec3 limb = vec3(1.0);
    if (limb_darkening) {
        // The mean of m^a over the disc is 2 / (2 + a).
        const vec3 exponent = vec3(0.397, 0.503, 0.652);
        limb = pow(vec3(sqrt(max(1.0 - share * share, 1e-12))), exponent) * (2.0 + exponent) * 0.5;
    }
    return limb / (12.5663706 * half_sine * half_sine);
}

// The same where a pixel covers an angle: its rim is as wide as the pixel, and a disc smaller than that keeps its light.
vec3 sun_disc_in_pixel(float angle, float angular_radius, bool limb_darkening, float pixel_angle)
{
    float pixel = max(pixel_angle, 1e-9);
    float covered = clamp((angular_radius - angle) / pixel + 0.5, 0.0, 1.0) *
                    min(1.0, 6.28318531 * angular_radius * angular_radius / (pixel * pixel));
    float inside = min(angle, angular_radius * (1.0 - 1e-4) - 0.5 * min(pixel, angular_radius));
    return covered > 0.0 ? covered * sun_disc_radiance(max(inside, 0.0), angular_radius, limb_darkening) : vec3(0.0);
}
