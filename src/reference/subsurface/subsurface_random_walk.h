#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "reference/random.h"
#include "reference/subsurface/ray_mesh.h"
#include "reference/subsurface/subsurface_medium.h"

/// The truth behind the BSSRDF: single photons walk inside a body with a smooth boundary, refracted where they enter
/// and leave, reflected inside by Fresnel's law, scattered by Henyey and Greenstein's phase function. Nothing is
/// diffusion.
namespace bruma::reference {

/// Where a walker inside a body meets its boundary.
struct BoundaryHit {
    double t = 0.0;
    glm::dvec3 position{0.0};
    glm::dvec3 normal{0.0};  ///< unit, outward
};

/// A shape to walk in. May be used from several threads.
class WalkBody {
  public:
    virtual ~WalkBody() = default;
    /// The first boundary from p, inside, along the unit vector d, if nearer than `limit`.
    virtual std::optional<BoundaryHit> first_boundary(glm::dvec3 p, glm::dvec3 d, double limit) const = 0;
    /// Whether rounding has carried a walker out through a seam.
    virtual bool has_lost(glm::dvec3) const { return false; }
};

/// z < 0.
class HalfSpaceBody : public WalkBody {
  public:
    std::optional<BoundaryHit> first_boundary(glm::dvec3 p, glm::dvec3 d, double limit) const override;
};

/// Around the origin.
class SphereBody : public WalkBody {
  public:
    explicit SphereBody(double radius) : radius_(radius) {}
    std::optional<BoundaryHit> first_boundary(glm::dvec3 p, glm::dvec3 d, double limit) const override;

  private:
    double radius_;
};

/// A closed mesh, whose faces are flat and face outwards by winding. The mesh must outlive the body.
class MeshBody : public WalkBody {
  public:
    explicit MeshBody(const RayMesh& mesh) : mesh_(mesh) {}
    std::optional<BoundaryHit> first_boundary(glm::dvec3 p, glm::dvec3 d, double limit) const override;
    bool has_lost(glm::dvec3 p) const override;

  private:
    const RayMesh& mesh_;
};

enum class WalkFate {
    escaped,
    absorbed,
    lost  ///< came out through a hole or a seam, or would not end: 10^7 scatterings
};

struct Walk {
    WalkFate fate = WalkFate::absorbed;
    double weight = 0.0;  ///< of what escaped, per unit that entered
    std::uint32_t scatterings = 0;
    glm::dvec3 position{0.0};   ///< where it left
    glm::dvec3 normal{0.0};     ///< outward, there
    glm::dvec3 direction{0.0};  ///< outside, refracted
};

/// One walk from `entry`, just inside, along `direction`.
Walk random_walk(const WalkBody& body, const SubsurfaceChannel& channel, glm::dvec3 entry, glm::dvec3 direction,
                 RandomStream& random);

/// A mean of independent samples with its standard error.
struct Estimate {
    double mean = 0.0;
    double standard_error = 0.0;
};

/// Share of the light that has entered a half-space and leaves it again. `cos_incidence` outside, (0, 1].
/// Same inputs give the same number, bit for bit, for any number of threads.
Estimate half_space_reflectance(const SubsurfaceChannel& channel, double cos_incidence, std::uint64_t paths,
                                std::uint64_t seed = 1);

/// Exitance over E_perp of a sphere in a directional light, averaged over `bins` equal steps of the cosine of the angle
/// from the lit pole, from -1 to 1.
std::vector<Estimate> sphere_exitance(const SubsurfaceChannel& channel, double radius, int bins, std::uint64_t paths,
                                      std::uint64_t seed = 1);
/// The same for any closed mesh of roughly that shape: the angle is that of the place of exit about the mesh's centre,
/// and exitance is per area of a sphere of `radius`.
std::vector<Estimate> mesh_exitance(const RayMesh& mesh, double radius, const SubsurfaceChannel& channel, int bins,
                                    std::uint64_t paths, std::uint64_t seed = 1);

}  // namespace bruma::reference
