#pragma once
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "base/image.h"
#include "reference/subsurface/dipole.h"
#include "reference/subsurface/ray_mesh.h"
#include "reference/subsurface/subsurface_quadrature.h"
#include "scene/camera.h"
#include "scene/light.h"

/// Pictures of a translucent mesh by the two slow truths: the BSSRDF integral, and photons.
namespace bruma::reference {

enum class SubsurfaceMethod {
    quadrature,  ///< of the chosen model, at each pixel's central ray
    random_walk  ///< no model: photons from the lights, counted where they leave; the mean over each pixel's area
};

struct SubsurfaceViewOptions {
    SubsurfaceMethod method = SubsurfaceMethod::quadrature;
    SubsurfaceModel model = SubsurfaceModel::normalised_directional_dipole;  ///< quadrature
    QuadratureOptions quadrature = {};
    std::uint64_t paths = 1'000'000;  ///< random walk: photons of each light and channel
    std::uint64_t seed = 1;
    /// Radiance from far away along a direction in world space, seen through the body without being scattered; black if
    /// empty. It lights nothing.
    std::function<glm::dvec3(glm::dvec3)> environment = {};
    std::function<void(double)> progress = {};  ///< share done in [0, 1]; called from worker threads, one at a time
};

struct SubsurfaceView {
    Image image;                    ///< radiance; alpha is 1 where the central ray meets the body
    std::vector<glm::vec3> error;   ///< per pixel: estimated bound (quadrature) or standard error (random walk)
    double rms_error = 0.0;         ///< over all pixels and channels
    std::uint64_t evaluations = 0;  ///< of S_d, three channels at once (quadrature)
    std::uint64_t paths = 0;        ///< photons that entered (random walk)
    std::uint64_t lost = 0;         ///< of these, lost through holes and seams
};

/// The light that comes out of a body, without surface reflection. `mesh_world` is in metres, world space; the medium
/// in 1/mm. Both methods show L = T_21(omega_o) M / (4 pi C_phi(1 / eta)), where M is the exitance: that is what a
/// BSSRDF without omega_o says, and it takes from the walk where and how much light leaves, not the shape of its lobe.
/// Light that has left does not come back elsewhere. Same inputs give the same picture, bit for bit, on the same
/// machine. Throws InputError for a mesh or medium out of range, and for a picture without pixels.
SubsurfaceView render_subsurface(const TriangleMesh& mesh_world, const SubsurfaceMedium& medium,
                                 const std::vector<scene::Light>& lights, const scene::Camera& camera, int width,
                                 int height, const SubsurfaceViewOptions& options = {});

/// The scene's light as the body sees it, in mm. A headlight shines along the camera's axis. Off lights are black.
BodyLight body_light(const scene::Light& light, const scene::Camera& camera);

}  // namespace bruma::reference
