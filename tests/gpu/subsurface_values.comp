#version 450 core
// Evaluates shaders/subsurface/subsurface.glsl for configurations from a buffer, one per invocation.
#include "subsurface/subsurface.glsl"

layout(local_size_x = 64) in;

// std430 keeps vec4s tight; see Configuration in subsurface_test.cpp.
struct Configuration {
    vec4 d, sigma_tr, sigma_t, d_e, sigma_t_reduced, albedo_reduced, normalisation;
    vec4 eta_c_phi_c_e_c_phi_inverse;
    vec4 a_standard_a;
    vec4 to_light, n_i, x, n_o;
};
struct Values {
    vec4 directional_dipole;  // w: T_12
    vec4 standard_dipole;     // w: T at the cosine in n_o.w
};
layout(std430, binding = 0) readonly buffer Configurations { Configuration configurations[]; };
layout(std430, binding = 1) writeonly buffer Results { Values results[]; };

void main()
{
    uint n = gl_GlobalInvocationID.x;
    if (n >= configurations.length()) {
        return;
    }
    Configuration c = configurations[n];
    SubsurfaceMedium m;
    m.d = c.d.xyz;
    m.sigma_tr = c.sigma_tr.xyz;
    m.sigma_t = c.sigma_t.xyz;
    m.d_e = c.d_e.xyz;
    m.sigma_t_reduced = c.sigma_t_reduced.xyz;
    m.albedo_reduced = c.albedo_reduced.xyz;
    m.normalisation = c.normalisation.xyz;
    m.eta = c.eta_c_phi_c_e_c_phi_inverse.x;
    m.c_phi = c.eta_c_phi_c_e_c_phi_inverse.y;
    m.c_e = c.eta_c_phi_c_e_c_phi_inverse.z;
    m.c_phi_inverse = c.eta_c_phi_c_e_c_phi_inverse.w;
    m.a = c.a_standard_a.x;
    m.standard_a = c.a_standard_a.y;
    vec3 omega_12 = refract_into(c.to_light.xyz, c.n_i.xyz, m.eta);
    results[n].directional_dipole =
        vec4(directional_dipole(m, c.x.xyz, c.n_i.xyz, omega_12, c.n_o.xyz),
             fresnel_transmittance(dot(c.to_light.xyz, c.n_i.xyz), m.eta));
    results[n].standard_dipole = vec4(standard_dipole(m, c.x.xyz), fresnel_transmittance(c.n_o.w, m.eta));
}
