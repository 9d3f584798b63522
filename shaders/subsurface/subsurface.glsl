// Light that enters a translucent body at one point and leaves it at another. S = T_12 S_d T_21; S_d in 1/(mm^2 sr),
// lengths in mm: kept near 1, single precision neither under- nor overflows. Normals point out of the body; use smooth
// normals, for a bump's normal has the mirror image on the wrong side.

// What diffusion theory makes of the three channels, worked out in double precision by the program.
struct SubsurfaceMedium {
    vec3 d;                // diffusion coefficient D = 1 / (3 sigma_t'), mm
    vec3 sigma_tr;         // effective transport coefficient, 1/mm
    vec3 sigma_t;          // extinction, not reduced, 1/mm
    vec3 d_e;              // extrapolation distance, mm
    vec3 sigma_t_reduced;  // sigma_t', 1/mm
    vec3 albedo_reduced;   // sigma_s' / sigma_t'
    vec3 normalisation;    // factor on the directional dipole: 1, or what makes a half-space return the right share
    float eta;             // n_inside / n_outside, at least 1
    float c_phi;           // C_phi(eta)
    float c_e;             // C_E(eta)
    float c_phi_inverse;   // C_phi(1 / eta)
    float a;               // A(eta) of the directional dipole
    float standard_a;      // (1 + F_dr) / (1 - F_dr)
};

// Share of unpolarised light that passes the boundary, by the cosine of the angle outside; the same in both directions.
float fresnel_transmittance(float cos_outside, float eta)
{
    float c = min(cos_outside, 1.0);
    if (c <= 0.0) {
        return 0.0;
    }
    float cos_inside = sqrt(max(0.0, 1.0 - (1.0 - c * c) / (eta * eta)));
    float s = (c - eta * cos_inside) / (c + eta * cos_inside);
    float p = (eta * c - cos_inside) / (eta * c + cos_inside);
    return 1.0 - 0.5 * (s * s + p * p);
}

// Where light from `to_light` (above the surface) travels inside.
vec3 refract_into(vec3 to_light, vec3 normal, float eta)
{
    float c = dot(to_light, normal);
    float cos_inside = sqrt(max(0.0, 1.0 - (1.0 - c * c) / (eta * eta)));
    return normalize((c * normal - to_light) / eta - cos_inside * normal);
}

// The part of n_i across x. Along x it is free, and lies across the plane of incidence.
vec3 modified_tangent_normal(vec3 n_i, vec3 omega_12, vec3 x)
{
    float r = length(x);
    if (r == 0.0) {
        return n_i;
    }
    vec3 x_hat = x / r;
    vec3 sideways = cross(n_i, x_hat);
    // By cross products: subtracting the part along x leaves nothing but rounding where they are nearly parallel.
    if (dot(sideways, sideways) >= 1e-10) {
        return normalize(cross(x_hat, sideways));
    }
    vec3 across = cross(n_i, omega_12);
    if (dot(across, across) >= 1e-10) {
        return normalize(across);
    }
    return normalize(cross(abs(n_i.z) < 0.9 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0), n_i));
}

// What a ray source along w sends out through the normal n_o at offset y, but for 1 / (16 pi^2 C_phi(1/eta)); rho2 stands
// for |y|^2 wherever the length is meant and nowhere in the dot products y_w = y . w, y_n = y . n_o, w_n = w . n_o.
vec3 ray_source_radiance(SubsurfaceMedium m, vec3 y_w, vec3 y_n, float w_n, vec3 rho2)
{
    vec3 rho = sqrt(rho2);
    vec3 t = m.sigma_tr * rho;
    vec3 p = 1.0 + t;
    vec3 fluence = m.c_phi * (rho2 / m.d + 3.0 * y_w * p);
    vec3 flux = m.c_e * (3.0 * w_n * m.d * p - y_n * (p + 3.0 * y_w * m.d * (3.0 * p + t * t) / rho2));
    return exp(-t) / (rho2 * rho) * (fluence - flux);
}

// Directional dipole (Frisvad, Hachisuka, Kjeldsen 2014); x = x_o - x_i, omega_12 travels into the body.
vec3 directional_dipole(SubsurfaceMedium m, vec3 x, vec3 n_i, vec3 omega_12, vec3 n_o)
{
    float r2 = dot(x, x);
    float mu_0 = -dot(omega_12, n_o);
    vec3 d_r2;
    if (mu_0 > 0.0) {
        // |x|^2 - (x . w)^2 by a cross product, which does not cancel where x lies along w.
        vec3 aside = cross(x, omega_12);
        vec3 cos_beta = -sqrt(dot(aside, aside) / (r2 + m.d_e * m.d_e));
        d_r2 = r2 + m.d * mu_0 * (m.d * mu_0 - 2.0 * m.d_e * cos_beta);
    } else {
        d_r2 = r2 + 1.0 / (9.0 * m.sigma_t * m.sigma_t);
    }
    float x_w = dot(x, omega_12);
    float x_n = dot(x, n_o);
    vec3 real = ray_source_radiance(m, vec3(x_w), vec3(x_n), -mu_0, d_r2);

    // The virtual source stands at y = x - lift n_star, its ray mirrored at n_star, which is across x.
    vec3 n_star = modified_tangent_normal(n_i, omega_12, x);
    vec3 lift = 2.0 * m.a * m.d_e;
    float w_star = dot(omega_12, n_star);
    float x_star = dot(x, n_star);  // 0 but for rounding, and at x = 0
    float star_n = dot(n_star, n_o);
    vec3 virtual_one =
        ray_source_radiance(m, x_w - 2.0 * w_star * x_star + lift * w_star, x_n - lift * star_n,
                            -mu_0 - 2.0 * w_star * star_n, r2 + lift * (lift - 2.0 * x_star));
    return m.normalisation * max(vec3(0.0), real - virtual_one) / (157.91367041742974 * m.c_phi_inverse);
}

// Standard dipole (Jensen, Marschner, Levoy, Hanrahan 2001): R_d / pi.
vec3 standard_dipole_pole(SubsurfaceMedium m, float r2, vec3 z)
{
    vec3 d2 = r2 + z * z;
    vec3 d = sqrt(d2);
    return z * (1.0 + m.sigma_tr * d) * exp(-m.sigma_tr * d) / (d2 * d);
}

vec3 standard_dipole(SubsurfaceMedium m, vec3 x)
{
    vec3 z_r = 1.0 / m.sigma_t_reduced;
    vec3 z_v = z_r * (1.0 + 4.0 / 3.0 * m.standard_a);
    float r2 = dot(x, x);
    return m.albedo_reduced / 39.47841760435743 * (standard_dipole_pole(m, r2, z_r) + standard_dipole_pole(m, r2, z_v));
}

// What is left of light that goes straight through; sigma_unscattered = sigma_a + sigma_s (1 - g^2).
vec3 unscattered_transmittance(vec3 sigma_unscattered, float chord)
{
    return exp(-sigma_unscattered * chord);
}
