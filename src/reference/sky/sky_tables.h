#pragma once
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "reference/sky/sky_atmosphere.h"

namespace bruma::reference {

/// Values at texel centres whose first and last stand for the ends 0 and 1 of each coordinate; linear in between.
class SkyTable {
  public:
    SkyTable(int width, int height) : width_(width), height_(height), texels_(std::size_t(width) * height) {}
    int width() const { return width_; }
    int height() const { return height_; }
    glm::dvec3& at(int x, int y) { return texels_[std::size_t(y) * width_ + x]; }
    const glm::dvec3& at(int x, int y) const { return texels_[std::size_t(y) * width_ + x]; }
    /// The coordinates in [0,1]^2 that a texel stands for; with u = (0.5 + x (N - 1)) / N in texture space.
    glm::dvec2 coordinates(int x, int y) const { return {x / double(width_ - 1), y / double(height_ - 1)}; }
    glm::dvec3 sample(glm::dvec2 coordinates) const;

  private:
    int width_, height_;
    std::vector<glm::dvec3> texels_;
};

struct SkyTableOptions {
    glm::ivec2 transmittance_size{256, 64};
    int transmittance_steps = 40;
    glm::ivec2 multiple_size{32, 32};
    int multiple_directions = 8;  ///< along each of two angles
    int multiple_steps = 20;
    bool multiple_scattering = true;
};

/// What air adds to a ray and leaves of what is behind it.
struct AirLight {
    glm::dvec3 radiance{0.0};
    glm::dvec3 transmittance{1.0};
};

/// The tables that do not depend on sun or camera, and what is made from them. Hillaire 2020, sections 5.2 to 5.5.
class AtmosphereTables {
  public:
    explicit AtmosphereTables(const scene::Atmosphere& atmosphere, const SkyTableOptions& options = {});

    const scene::Atmosphere& atmosphere() const { return atmosphere_; }
    /// To the end of the atmosphere, above the horizon.
    glm::dvec3 transmittance(double altitude_m, double climb) const;
    /// Of the sun's light: with the share of the disc above the horizon.
    glm::dvec3 sun_transmittance(double altitude_m, double sun_climb) const;
    /// Radiance per scattering length from all orders beyond the first; no phase function belongs to it.
    glm::dvec3 multiple_scattering(double altitude_m, double sun_climb) const;
    /// Along a ray from the point at this altitude above the origin of a local frame, y up there.
    AirLight air_light(double altitude_m, const glm::dvec3& direction_local, const glm::dvec3& to_sun_local,
                       double length_m, int steps = 200) const;
    const SkyTable& transmittance_table() const { return transmittance_; }
    const SkyTable& multiple_table() const { return multiple_; }

  private:
    struct Bounce {
        glm::dvec3 radiance{0.0}, scattered_share{0.0};
    };
    Bounce isotropic_bounce(double altitude_m, const glm::dvec3& direction, double sun_climb, int steps) const;
    glm::dvec3 multiple_at(double altitude_m, double sun_climb, const SkyTableOptions& options) const;

    scene::Atmosphere atmosphere_;
    SkyTable transmittance_, multiple_;
    bool with_multiple_;
};

/// Light from the upper half of all directions, on a level plane and from all of them alike.
struct SkyIrradiance {
    glm::dvec3 planar{0.0}, scalar{0.0};
};
SkyIrradiance sky_irradiance(const std::function<glm::dvec3(const glm::dvec3& direction)>& radiance);

/// The sky around one point, for irradiance 1 of the sun, without its disc.
class SkyView {
  public:
    SkyView(const AtmosphereTables& tables, double altitude_m, const glm::dvec3& to_sun_local,
            glm::ivec2 size = {192, 108}, int steps = 30);
    glm::dvec3 radiance(const glm::dvec3& direction_local) const;
    /// Radiance over all upward directions, and the same weighted by the cosine.
    glm::dvec3 scalar_irradiance() const { return irradiance().scalar; }
    glm::dvec3 planar_irradiance() const { return irradiance().planar; }

  private:
    SkyIrradiance irradiance() const;
    scene::Atmosphere atmosphere_;
    double altitude_m_;
    glm::dvec3 to_sun_;
    SkyTable table_;
};

}  // namespace bruma::reference
