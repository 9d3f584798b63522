#include "scene/clouds/cloud_weather.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/integer_hash.h"

namespace bruma::scene {
namespace {

double saturate(double v) {
    return std::clamp(v, 0.0, 1.0);
}
double smooth(double v, double from, double to) {
    const double t = saturate((v - from) / (to - from));
    return t * t * (3.0 - 2.0 * t);
}
double between(double a, double b, double t) {
    return a + t * (b - a);
}

/// Plane noise on a lattice of cells_x by cells_y cells that repeats, u and v in [0,1).
class PlaneLattice {
  public:
    PlaneLattice(int cells_x, int cells_y, std::uint32_t stream) : size_(cells_x, cells_y), stream_(stream) {}

    /// One minus the distance to the nearest feature point in cells, at least 0.
    double worley(double u, double v) const {
        const Place place(*this, u, v);
        double nearest = 1.0;
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                const auto hash = hash_of(place.cell + glm::ivec2(dx, dy));
                const double x = dx + unit_interval(hash[0]) - place.offset.x;
                const double y = dy + unit_interval(hash[1]) - place.offset.y;
                nearest = std::min(nearest, x * x + y * y);
            }
        }
        return 1.0 - std::sqrt(nearest);
    }

    /// A number of each cell, smooth in between.
    double value(double u, double v) const {
        const Place place(*this, u, v);
        const double x = smooth(place.offset.x, 0.0, 1.0);
        const auto row = [&](int dy) {
            return between(unit_interval(hash_of(place.cell + glm::ivec2(0, dy))[2]),
                           unit_interval(hash_of(place.cell + glm::ivec2(1, dy))[2]), x);
        };
        return between(row(0), row(1), smooth(place.offset.y, 0.0, 1.0));
    }

  private:
    struct Place {
        glm::ivec2 cell;
        glm::dvec2 offset;
        Place(const PlaneLattice& lattice, double u, double v) {
            const glm::dvec2 at = glm::dvec2(u - std::floor(u), v - std::floor(v)) * glm::dvec2(lattice.size_);
            const glm::dvec2 low = glm::floor(at);
            cell = glm::ivec2(low);
            offset = at - low;
        }
    };
    std::array<std::uint32_t, 3> hash_of(glm::ivec2 cell) const {
        const glm::ivec2 wrapped = (cell + size_) % size_;
        return pcg3d(std::uint32_t(wrapped.x), std::uint32_t(wrapped.y), stream_);
    }

    glm::ivec2 size_;
    std::uint32_t stream_;
};

/// Heaps at `cells` cells along each edge: bright round spots, with a second octave at their rims.
class Heaps {
  public:
    Heaps(int cells_x, int cells_y, std::uint32_t stream)
        : coarse_(cells_x, cells_y, stream), fine_(2 * cells_x, 2 * cells_y, stream + 1) {}
    double operator()(double u, double v) const { return 0.7 * coarse_.worley(u, v) + 0.3 * fine_.worley(u, v); }

  private:
    PlaneLattice coarse_, fine_;
};

/// The weather at a point of the tile, for each pattern.
class Pattern {
  public:
    Pattern(WeatherPattern pattern, std::uint32_t stream)
        : pattern_(pattern),
          heaps_(heap_cells(pattern).x, heap_cells(pattern).y, stream),
          slow_(4, 4, stream + 2),
          fast_(24, 24, stream + 3) {}

    CloudWeather at(double u, double v) const {
        const double slow = slow_.value(u, v);
        switch (pattern_) {
            case WeatherPattern::scattered: {
                const double heap = heaps_(u, v) + 0.15 * (slow - 0.5);
                return {smooth(heap, 0.5, 0.75), smooth(heap, 0.36, 0.64), between(0.6, 1.0, heap), 0.5};
            }
            case WeatherPattern::overcast: {
                const double closed = between(0.8, 1.0, 0.5 * (slow + fast_.value(u, v)));
                return {closed, closed, between(0.15, 0.35, slow), 0.5};
            }
            case WeatherPattern::ripples: {
                const double flake = heaps_(u, v) * smooth(slow, 0.15, 0.6);
                return {smooth(flake, 0.2, 0.5), smooth(flake, 0.05, 0.35), between(0.5, 0.9, flake), 0.5};
            }
            case WeatherPattern::wisps: {
                const double streak = heaps_(u + 0.05 * slow, v) * smooth(slow, 0.2, 0.7);
                return {smooth(streak, 0.2, 0.7), smooth(streak, 0.1, 0.5), between(0.5, 1.0, streak),
                        between(0.3, 0.6, fast_.value(u, v))};
            }
            case WeatherPattern::towers: {
                const double tower = heaps_(u, v) * smooth(slow, 0.3, 0.7);
                return {smooth(tower, 0.25, 0.5), smooth(tower, 0.1, 0.4), between(0.3, 1.0, smooth(tower, 0.2, 0.55)),
                        between(0.5, 0.8, tower)};
            }
        }
        return {};
    }

  private:
    static glm::ivec2 heap_cells(WeatherPattern pattern) {
        switch (pattern) {
            case WeatherPattern::ripples:
                return {24, 16};
            case WeatherPattern::wisps:
                return {4, 28};
            case WeatherPattern::towers:
                return {6, 6};
            default:
                return {10, 10};
        }
    }
    WeatherPattern pattern_;
    Heaps heaps_;
    PlaneLattice slow_, fast_;
};

std::uint8_t byte_of(double v) {
    return std::uint8_t(std::floor(255.0 * saturate(v) + 0.5));
}

}  // namespace

CloudWeather WeatherMap::sample(double u, double v) const {
    const double x = (u - std::floor(u)) * width - 0.5;
    const double y = (v - std::floor(v)) * height - 0.5;
    const double low_x = std::floor(x), low_y = std::floor(y);
    const int x0 = (int(low_x) + width) % width, x1 = (x0 + 1) % width;
    const int y0 = (int(low_y) + height) % height, y1 = (y0 + 1) % height;
    const auto channel = [&](int c) {
        const auto at = [&](int column, int row) {
            return double(rgba[4 * (std::size_t(row) * width + column) + c]) / 255.0;
        };
        return between(between(at(x0, y0), at(x1, y0), x - low_x), between(at(x0, y1), at(x1, y1), x - low_x),
                       y - low_y);
    };
    return {channel(0), channel(1), channel(2), channel(3)};
}

CloudWeather WeatherMap::largest() const {
    std::uint8_t most[4] = {};
    for (std::size_t n = 0; n < rgba.size(); ++n) {
        most[n % 4] = std::max(most[n % 4], rgba[n]);
    }
    return {most[0] / 255.0, most[1] / 255.0, most[2] / 255.0, most[3] / 255.0};
}

std::shared_ptr<const WeatherMap> make_weather_map(WeatherPattern pattern, std::int64_t variation, int size) {
    if (size < 1 || size > 8192) {
        throw InputError(
            fmt::format("weather map: a size of {} texels, expected 1 to 8192; choose one of these", size));
    }
    auto map = std::make_shared<WeatherMap>();
    map->name = fmt::format("{} {}", enum_words<WeatherPattern>()[std::size_t(pattern)], variation);
    map->width = map->height = size;
    map->rgba.reserve(std::size_t(4) * size * size);
    const Pattern weather(pattern, pcg(std::uint32_t(variation)));
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const CloudWeather at = weather.at((x + 0.5) / size, (y + 0.5) / size);
            for (const double value : {at.placement, at.placement_overcast, at.top, at.density}) {
                map->rgba.push_back(byte_of(value));
            }
        }
    }
    return map;
}

}  // namespace bruma::scene
