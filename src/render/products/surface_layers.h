#pragma once
#include <array>
#include <cstdint>

#include "gl/full_screen.h"
#include "gl/shader_library.h"
#include "gl/texture.h"

namespace bruma::render {

/// Surfaces that pixels show. Where edges are smoothed a pixel's area falls into up to three shares: the nearest
/// surface, one further away, nothing; each layer holds one of them, and a picture is the sum over layers of what is
/// seen of it times its share. Bottom row first.
struct SurfaceLayer {
    gl::Texture radiance;  ///< linear Rec.709; alpha is 1 on a surface and 0 beside
    gl::Texture distance;  ///< x: along the pixel's ray, from the eye or the plane through it, 1e30: none; y: share
    gl::Framebuffer framebuffer;
};
struct SurfaceLayers {
    std::array<SurfaceLayer, 2> shown;
    gl::Texture nothing;   ///< distance and share of the third layer
    gl::Texture farthest;  ///< distance of what is seen furthest away in each pixel; only where there are layers
    gl::Framebuffer resolved;
    int count = 1;            ///< 1: edges are not smoothed and all shares are 1; or 3
    double unit_world = 1.0;  ///< of distances, metres

    const gl::Texture& distances(int layer) const { return layer < 2 ? shown[std::size_t(layer)].distance : nothing; }
    /// For who looks as far as any share of a pixel does.
    const gl::Texture& farthest_distances() const { return count == 1 ? shown[0].distance : farthest; }
    /// Binds what surfaces/opaque.glsl reads of one layer: two texture units from `unit` on.
    void bind(gl::Program& program, int layer, GLuint unit) const;
};

/// Where meshes are drawn: several samples in each pixel, or the first layer itself.
class SampledSurfaces {
  public:
    /// Makes room for a picture; `wanted` samples, or as many as the driver has, which is said once.
    void prepare(SurfaceLayers& layers, glm::ivec2 pixels, int wanted);
    const gl::Framebuffer& target(const SurfaceLayers& layers) const;
    int samples() const { return samples_; }
    /// Gathers the samples of each pixel into layers; `pixel_size`: of a pixel at distance 0 and its growth per unit of
    /// distance, units.
    void resolve(const SurfaceLayers& layers, gl::ShaderLibrary& shaders, glm::dvec2 pixel_size) const;

  private:
    int samples_ = 0;
    gl::Texture radiance_, distance_, depth_;
    gl::Framebuffer framebuffer_;
    gl::FullScreen full_screen_;
};

/// The samples that a driver has where `wanted` are asked for.
int samples_of_driver(int wanted);

}  // namespace bruma::render
