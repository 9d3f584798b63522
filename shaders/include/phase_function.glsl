// The phase function of Henyey and Greenstein (1941), normalised to 1 over the sphere. `cosine` is that of the angle
// between the directions of travel before and after scattering; g in (-1, 1) is its mean.

float phase_function(float cosine, float g)
{
    // 1 + g^2 - 2 g cos, written so that it keeps its digits where it is small.
    float squared = g > 0.0 ? (1.0 - g) * (1.0 - g) + 2.0 * g * (1.0 - cosine)
                            : (1.0 + g) * (1.0 + g) - 2.0 * g * (1.0 + cosine);
    return (1.0 - g * g) * inversesqrt(squared) / squared * (0.25 / 3.14159265358979);
}

// Cosine of the angle of scattering for a uniform number in [0, 1). The usual inverse, (1 + g^2 - ((1 - g^2) /
// (1 + g s))^2) / 2g with s = 2 number - 1, multiplied out so that g may go to 0.
float scattering_cosine(float number, float g)
{
    float s = 2.0 * number - 1.0;
    float below = 1.0 + g * s;
    float above = s + g * (0.5 * (s * s + 3.0) + g * (s + g * 0.5 * (s * s - 1.0)));
    return clamp(above / (below * below), -1.0, 1.0);
}

// The direction at an angle from a unit vector, turned about it by a share of the full circle. Axes after Duff et al.
// (2017), "Building an orthonormal basis, revisited".
vec3 turned_direction(vec3 direction, float cosine, float share_of_circle)
{
    float side = direction.z < 0.0 ? -1.0 : 1.0;
    float a = -1.0 / (side + direction.z);
    float b = direction.x * direction.y * a;
    vec3 across = vec3(1.0 + side * direction.x * direction.x * a, side * b, -side * direction.x);
    vec3 along = vec3(b, side + direction.y * direction.y * a, -direction.y);
    float sine = sqrt(max(0.0, 1.0 - cosine * cosine));
    float angle = 6.28318530717959 * share_of_circle;
    return normalize(sine * (cos(angle) * across + sin(angle) * along) + cosine * direction);
}
