#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "reference/subsurface/dipole.h"
#include "reference/subsurface/ray_mesh.h"
#include "scene/light.h"

/// The BSSRDF integrated over the lit surface of a mesh, in double, by quadrature that adapts to a stated error:
///
///     R(x_o) = integral of V E_perp T_12 S_d(x_i, omega_i; x_o) (n_i . omega_i) dA_i,   L_o = T_21(omega_o) R(x_o)
///
/// The cosine and the area are those of the flat face, the normals in T_12 and S_d the interpolated ones; V is a ray to
/// the light. All lengths in mm.
namespace bruma::reference {

/// A light as a body sees it.
struct BodyLight {
    bool directional = true;
    glm::dvec3 to_light{0.0, 0.0, 1.0};  ///< directional: unit vector
    glm::dvec3 position{0.0};            ///< point: mm
    /// Directional: E_perp, the irradiance of a plane that faces it. Point: intensity, E_perp times mm^2.
    glm::dvec3 strength{1.0};
    std::optional<scene::Light> spot = std::nullopt;  ///< whose cone it is; `position` counts
};
/// Share of a light's strength that goes against the unit vector `to_light`: 1 but for spots.
double share_towards(const BodyLight& light, glm::dvec3 to_light);

struct QuadratureOptions {
    double tolerance = 1e-3;                    ///< of R, relative, each channel
    std::uint64_t max_evaluations = 5'000'000;  ///< of S_d (three channels at once) for one x_o; then the error stands
};

struct QuadratureResult {
    glm::dvec3 value{0.0};  ///< R, radiance without T_21
    glm::dvec3 error{0.0};  ///< estimated bound: the sum over all cells of what two rules disagree by
    std::uint64_t evaluations = 0;
};

/// A lit mesh made ready for points x_o. The mesh and the BSSRDF must outlive it. May be used from several threads.
class SubsurfaceQuadrature {
  public:
    SubsurfaceQuadrature(const RayMesh& mesh, const Bssrdf& bssrdf, std::vector<BodyLight> lights,
                         const QuadratureOptions& options = {});

    QuadratureResult at(const SurfacePoint& exit) const;

    /// A part of a triangle, in barycentric weights of its second and third corner.
    struct Cell {
        std::uint32_t light = 0, triangle = 0;
        glm::dvec2 a{0.0, 0.0}, b{1.0, 0.0}, c{0.0, 1.0};
    };
    /// A node of the rule: where light enters, and how much of it.
    struct Entry {
        SurfacePoint point;
        glm::dvec3 omega_12{0.0};
        glm::dvec3 irradiance{0.0};  ///< V E_perp T_12 cos
    };

  private:
    struct Integral {
        glm::dvec3 value{0.0}, error{0.0};
    };
    struct BaseCell {
        Cell cell;
        double area = 0.0, diameter = 0.0;
        glm::dvec3 centre{0.0};
        Entry entries[7];
    };
    Entry entry_at(const Cell& cell, glm::dvec2 barycentric) const;
    void add_base_cells(const Cell& cell);
    Integral integral(const Entry* entries, double area, const SurfacePoint& exit) const;
    Integral integral(const Cell& cell, const SurfacePoint& exit) const;
    bool is_too_coarse(double diameter, glm::dvec3 centre, const SurfacePoint& exit) const;

    const RayMesh& mesh_;
    const Bssrdf& bssrdf_;
    std::vector<BodyLight> lights_;
    QuadratureOptions options_;
    double core_;
    std::vector<BaseCell> base_;
};

}  // namespace bruma::reference
