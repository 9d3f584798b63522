// Shelf: double-precision reference, and published numbers. The subsurface functions of the shaders, in single
// precision.
#include <glm/gtc/type_ptr.hpp>

#include "drawing.h"
#include "gl/buffer.h"
#include "reference/random.h"
#include "reference/subsurface/dipole.h"
#include "render/subsurface/subsurface_constants.h"
#include "subsurface_truth.h"

namespace bruma::render {
namespace {

using reference::Bssrdf;
using reference::RandomStream;
using reference::SubsurfaceMedium;
using reference::SubsurfaceModel;
using reference::SurfacePoint;

/// As subsurface_values.comp reads it.
struct Configuration {
    glm::vec4 d, sigma_tr, sigma_t, d_e, sigma_t_reduced, albedo_reduced, normalisation;
    glm::vec4 eta_c_phi_c_e_c_phi_inverse;
    glm::vec4 a_standard_a;
    glm::vec4 to_light, n_i, x, n_o;
};
struct Values {
    glm::vec4 directional_dipole, standard_dipole;
};

/// One evaluation, rounded to single precision before either side sees it.
struct Case {
    SubsurfaceMedium medium;
    glm::vec3 to_light{0.0F, 0.0F, 1.0F}, n_i{0.0F, 0.0F, 1.0F}, x{1.0F, 0.0F, 0.0F}, n_o{0.0F, 0.0F, 1.0F};
    bool normalised = false;
    double cosine = 1.0;
};

Configuration configuration(const Case& c) {
    Configuration result{};
    const Bssrdf bssrdf(c.medium, SubsurfaceModel::directional_dipole);
    for (int k = 0; k < 3; ++k) {
        const reference::DiffusionConstants& diffusion = bssrdf.channel(k).diffusion();
        result.d[k] = float(diffusion.d);
        result.sigma_tr[k] = float(diffusion.sigma_tr);
        result.sigma_t[k] = float(diffusion.sigma_t);
        result.d_e[k] = float(diffusion.d_e);
        result.sigma_t_reduced[k] = float(diffusion.sigma_t_reduced);
        result.albedo_reduced[k] = float(diffusion.albedo_reduced);
        result.normalisation[k] =
            c.normalised ? float(reference::energy_normalisation(diffusion.albedo_reduced, c.medium.eta)) : 1.0F;
    }
    const reference::DiffuseBoundary& b = bssrdf.channel(0).boundary();
    result.eta_c_phi_c_e_c_phi_inverse = glm::vec4(c.medium.eta, b.c_phi, b.c_e, b.c_phi_inverse);
    result.a_standard_a = glm::vec4(b.a, reference::standard_dipole_a(c.medium.eta), 0.0, 0.0);
    result.to_light = glm::vec4(c.to_light, 0.0F);
    result.n_i = glm::vec4(c.n_i, 0.0F);
    result.x = glm::vec4(c.x, 0.0F);
    result.n_o = glm::vec4(c.n_o, float(c.cosine));
    return result;
}

class SubsurfaceShader : public Drawing {
  protected:
    std::vector<Values> evaluate(const std::vector<Case>& cases) {
        std::vector<Configuration> configurations;
        configurations.reserve(cases.size());
        for (const Case& c : cases) {
            configurations.push_back(configuration(c));
        }
        std::vector<Values> values(cases.size());
        const gl::Buffer in("subsurface configurations", std::span<const Configuration>(configurations));
        const gl::Buffer out("subsurface values", std::span<const Values>(values));
        shaders().get("../tests/gpu/subsurface_values.comp").use();  // relative to the folder of shaders
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, in.name());
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, out.name());
        glDispatchCompute(GLuint((cases.size() + 63) / 64), 1, 1);
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        out.read(std::span<Values>(values));
        return values;
    }
};

glm::dvec3 truth(const Case& c, SubsurfaceModel model) {
    const glm::dvec3 n_i(c.n_i);
    const glm::dvec3 omega_12 = reference::refract_into(glm::dvec3(c.to_light), n_i, c.medium.eta);
    return Bssrdf(c.medium, model).s_d({{}, n_i}, omega_12, {glm::dvec3(c.x), glm::dvec3(c.n_o)});
}

SubsurfaceMedium grey(double sigma_a, double sigma_s, double g, double eta) {
    return {glm::dvec3(sigma_a), glm::dvec3(sigma_s), glm::dvec3(g), eta};
}

// Shelf: published numbers. What the program works out for the shaders shares its formulas with the reference, so both
// are held against the same tables (the reference in tests/unit/reference_fresnel_test.cpp and
// reference_dipole_test.cpp) and not against each other.
TEST(SubsurfaceConstants, BoundariesAreThePublishedOnes) {
    struct Row {
        double eta, twice_c1, thrice_c2, twice_c1_outside;
    };
    // Fits of d'Eon and Irving 2011 to six decimals, the last outside their range by quadrature; matched: nothing.
    const Row rows[] = {{1.0, 0.0, 0.0, 0.0},
                        {1.3, 0.445295, 0.297448, 0.061116},
                        {1.4, 0.529885, 0.386347, 0.076788},
                        {1.5, 0.596541, 0.462609, 0.091774},
                        {2.0, 0.790536, 0.706720, 0.160589},
                        {2.5, 0.876878, 0.827561, 0.221913},
                        {3.0, 0.919578, 0.882685, 1.0 - 9.0 * (1.0 - 0.919578)}};
    for (const Row& row : rows) {
        scene::SubsurfaceMedium medium = scene::medium_of(scene::Material::potato);
        medium.refraction_index = row.eta;
        const SubsurfaceConstants k = subsurface_constants(medium, scene::SubsurfaceModel::directional_dipole);
        const double digits = row.eta < 2.6 ? 6e-7 : 1e-5;
        EXPECT_NEAR(1.0 - 4.0 * k.c_phi, row.twice_c1, digits) << row.eta;
        EXPECT_NEAR(1.0 - 2.0 * k.c_e, row.thrice_c2, digits) << row.eta;
        EXPECT_NEAR(1.0 - 4.0 * k.c_phi_inverse, row.twice_c1_outside, row.eta < 2.6 ? 6e-7 : 1e-4) << row.eta;
        EXPECT_NEAR(k.a, (1.0 + row.thrice_c2) / (1.0 - row.twice_c1), 1e-5 * k.a + 2e-3 * (row.eta > 2.6)) << row.eta;
    }
}

TEST(SubsurfaceConstants, EveryMaterialReturnsWhatIsPublished) {
    for (const reference::HalfSpaceTruth& truth : reference::half_space_truths) {
        scene::SubsurfaceMedium medium;
        medium.reduced_scattering = glm::dvec3(truth.sigma_s);
        medium.absorption = glm::dvec3(truth.sigma_a);
        medium.refraction_index = truth.eta;
        const SubsurfaceConstants k = subsurface_constants(medium, scene::SubsurfaceModel::normalised_dipole);
        // Random walks over the dipole's own integral: one percent of the table of factors, and the walks' error.
        const double factor = truth.walk[0] / truth.dipole[0];
        EXPECT_NEAR(k.normalisation.x, factor, 0.01 * factor + 4.0 * truth.walk_error[0] / truth.dipole[0])
            << truth.name;
        // Four decimals, and up to 2e-4 by which the fitted reflectance of the boundary is beside the exact one.
        EXPECT_NEAR(k.diffuse_reflectance.x, truth.standard_dipole, 3e-4) << truth.name;
    }
    const scene::SubsurfaceMedium marble = scene::medium_of(scene::Material::marble);
    const SubsurfaceConstants k = subsurface_constants(marble, scene::SubsurfaceModel::directional_dipole);
    EXPECT_NEAR(k.d.y, 0.127027679, 1e-9);
    EXPECT_NEAR(k.sigma_tr.y, 0.179656422, 1e-9);
    EXPECT_NEAR(k.d_e.y, 0.270907706, 1e-9);
}

TEST_F(SubsurfaceShader, GoldenPointValues) {
    const glm::vec3 up(0.0F, 0.0F, 1.0F);
    const float half = std::sqrt(0.5F);
    const SubsurfaceMedium u1 = grey(0.0041, 2.62, 0.0, 1.5);
    const SubsurfaceMedium u5 = grey(0.0024, 0.68, 0.0, 1.3);
    const std::vector<Case> cases = {
        {u1, up, up, {1, 0, 0}, up},
        {u1, up, up, {0, 0, 0}, up},
        {u1, {-half, 0, half}, up, {1, 0, 0}, up},
        {u1, {-half, 0, half}, up, {-1, 0, 0}, up},
        {u5, up, up, {5, 0, 0}, up},
        {u5, up, up, {0.5F, 0, -3}, -up},
        {u5, up, up, {0, 0, -3}, -up},
        {grey(0.17, 0.88, 0.0, 1.3), {-0.5F * std::sqrt(3.0F), 0, 0.5F}, up, {0.7F, 0.2F, -0.3F}, {0.6F, 0, 0.8F}},
        {grey(0.0024, 3.4, 0.8, 1.3), up, up, {0.5F, 0, -3}, -up},
        {grey(1.45, 0.03, 0.0, 1.3), up, up, {1, 0, 0}, up},
    };
    const double expected[] = {1.576677203e-02, 1.558556887e+00, 1.894967818e-02, 1.221321296e-02, 7.207105567e-04,
                               3.782265542e-03, 3.9587e-03,      3.570874535e-02, 3.958085116e-03, 1.281518384e-03};
    const std::vector<Values> values = evaluate(cases);
    for (std::size_t n = 0; n < cases.size(); ++n) {
        for (int c = 0; c < 3; ++c) {
            // Single precision: some 1e-7 in each of a dozen terms, of which the larger halves cancel.
            EXPECT_NEAR(values[n].directional_dipole[c], expected[n], 1e-4 * expected[n]) << "configuration " << n;
        }
    }
}

TEST_F(SubsurfaceShader, FresnelAtEveryAngle) {
    std::vector<Case> cases;
    for (const double eta : {1.0, 1.3, 1.5, 2.5}) {
        for (int n = -4; n <= 90; ++n) {
            Case c;
            c.medium = grey(0.1, 1.0, 0.0, eta);
            c.cosine = std::sin(glm::radians(double(n)));
            cases.push_back(c);
        }
    }
    const std::vector<Values> values = evaluate(cases);
    for (std::size_t n = 0; n < cases.size(); ++n) {
        EXPECT_NEAR(values[n].standard_dipole.w, reference::fresnel_transmittance(cases[n].cosine, cases[n].medium.eta),
                    2e-6)
            << cases[n].cosine << ", " << cases[n].medium.eta;
    }
}

/// The directional dipole with every difference turned into a sum: what single precision is relative to where the terms
/// cancel, as they do in front of a ray and where the mirror image shines as brightly.
double sum_of_terms(const Case& c, int channel, glm::dvec3 omega_12) {
    const reference::Dipole dipole(c.medium.channel(channel), SubsurfaceModel::directional_dipole);
    const reference::DiffusionConstants& k = dipole.diffusion();
    const reference::DiffuseBoundary& b = dipole.boundary();
    const glm::dvec3 x(c.x);
    const auto source = [&](double length, double rho2) {
        const double rho = std::sqrt(rho2);
        const double t = k.sigma_tr * rho;
        const double fluence = b.c_phi * (rho2 / k.d + 3.0 * (1.0 + t) * length);
        const double along = 1.0 + t + 3.0 * k.d * (3.0 * (1.0 + t) + t * t) / rho2 * length;
        const double flux = b.c_e * (3.0 * k.d * (1.0 + t) + length * along);
        return std::exp(-t) / (rho2 * rho) * (fluence + flux) / (157.91367041742974 * b.c_phi_inverse);
    };
    const double lift = 2.0 * b.a * k.d_e;
    const double virtual_r2 = glm::dot(x, x) + lift * lift;
    return source(glm::length(x), reference::directional_dipole_d_r2(k, x, omega_12, glm::dvec3(c.n_o))) +
           source(std::sqrt(virtual_r2), virtual_r2);
}

TEST_F(SubsurfaceShader, AgreesWithTheReferenceOnRandomConfigurations) {
    std::vector<Case> cases;
    RandomStream random(9, 0, 0);
    const auto direction = [&] {
        const double z = 2.0 * random.uniform() - 1.0;
        const double phi = 6.283185307179586 * random.uniform();
        const double s = std::sqrt(1.0 - z * z);
        return glm::vec3(glm::normalize(glm::dvec3(s * std::cos(phi), s * std::sin(phi), z)));
    };
    for (int n = 0; n < 20000; ++n) {
        Case c;
        const auto log_between = [&](double low, double high) { return low * std::pow(high / low, random.uniform()); };
        for (int k = 0; k < 3; ++k) {
            // Rounded first, so that the constants of both sides mean the same medium.
            c.medium.sigma_s[k] = float(log_between(0.05, 10.0));
            c.medium.sigma_a[k] = float(log_between(1e-4, 1.0));
            c.medium.g[k] = n % 2 == 0 ? 0.0 : double(float(0.9 * random.uniform()));
        }
        c.medium.eta = n % 3 == 0 ? 1.5 : 1.3;
        c.n_i = direction();
        do {
            c.to_light = direction();
        } while (glm::dot(c.to_light, c.n_i) < 0.02F);
        c.n_o = direction();
        c.x = direction() * float(log_between(1e-2, 30.0));
        c.normalised = n % 2 == 0;
        cases.push_back(c);
    }
    const std::vector<Values> values = evaluate(cases);
    int compared = 0;
    int beyond = 0;
    double worst = 0.0;
    for (std::size_t n = 0; n < cases.size(); ++n) {
        const Case& c = cases[n];
        const glm::dvec3 directional = truth(
            c, c.normalised ? SubsurfaceModel::normalised_directional_dipole : SubsurfaceModel::directional_dipole);
        const glm::dvec3 standard = truth(c, SubsurfaceModel::standard_dipole);
        const glm::dvec3 omega_12 = reference::refract_into(glm::dvec3(c.to_light), glm::dvec3(c.n_i), c.medium.eta);
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(values[n].standard_dipole[k], standard[k], 1e-4 * standard[k] + 1e-35);
            ASSERT_TRUE(std::isfinite(values[n].directional_dipole[k]));
            if (std::abs(glm::dot(omega_12, glm::dvec3(c.n_o))) < 1e-5) {
                continue;  // d_r jumps here
            }
            const double terms = sum_of_terms(c, k, omega_12);
            const double error = std::abs(values[n].directional_dipole[k] - directional[k]);
            // Some ten roundings of 6e-8 in each term, and one of the exponent, which goes to 90: 6e-6.
            EXPECT_LE(error, 1e-5 * terms + 1e-35) << n;
            worst = std::max(worst, error / (terms + 1e-30));
            beyond += error > 1e-4 * directional[k] + 1e-35 ? 1 : 0;
            ++compared;
        }
    }
    EXPECT_GT(compared, 50000);
    report("largest error of the shader's directional dipole, of the sum of its terms", worst);
    report("share of configurations off by more than 1e-4 of their value", double(beyond) / compared);
}

}  // namespace
}  // namespace bruma::render
