#pragma once
#include <glm/glm.hpp>
#include <vector>

#include "scene/volume/transfer_function.h"

namespace bruma::render {

/// Entries of the 1-D tables: u = i / 1020 puts every eighth-bit control point of 8-bit data (k / 255) on an entry.
constexpr int depth_entries = 1021;
/// Entries along each edge of the 2-D tables.
constexpr int source_entries = 256;

/// Texture coordinate of u in [0, 1] in a table of so many entries, the first and last of which stand for 0 and 1.
constexpr double table_coordinate(double u, int entries) {
    return (u * (entries - 1) + 0.5) / entries;
}
/// The same as a map of texels, from one to u: coordinate = x * texel + y.
inline glm::dvec2 table_from_voxel(glm::dvec2 u_from_voxel, int entries) {
    return {u_from_voxel.x * (entries - 1) / entries, table_coordinate(u_from_voxel.y, entries)};
}

/// A transfer function in the form that the marcher looks up. Extinction is per reference length, so the tables hold
/// for any step and size of the world.
struct TransferTables {
    std::vector<glm::vec4> optics;  ///< (sigma, sigma * S) at u = i / (depth_entries - 1)
    std::vector<glm::vec2> depth;   ///< (K, sigma), K(u) = integral of sigma from 0 to u
    std::vector<glm::vec4> source;  ///< [back * source_entries + front]: mean source radiance of a segment
    std::vector<glm::vec4> glow;    ///< the same for light that the volume gives by itself; empty without any
    bool glows = false;
    float lowest_visible = 0.0F, highest_visible = 0.0F;  ///< extinction is 0 at every u outside
};

/// What the tables depend on beside the transfer function.
struct TableParameters {
    double tau_of_full_step = 1.0;  ///< optical depth of one whole step per unit of sigma: density * step / reference
    bool preintegrated = true;      ///< whether the 2-D tables are wanted
    bool lit = false;               ///< glow is kept apart from the colour that lights act on
    double emission = 0.0;          ///< added to the transfer function's
    bool scatters = false;          ///< colour is albedo: times `albedo`, at most 1
    glm::dvec3 albedo{1.0};
    bool operator==(const TableParameters&) const = default;
};

TransferTables make_transfer_tables(const scene::TransferFunction& tf, const TableParameters& parameters);

/// S(front, back) = C / (1 - T) of a segment over which u runs linearly from front to back, with self-attenuation, for
/// all pairs in O(n^2): all windows of k consecutive bins under the associative operator 'over', by a queue made of
/// two stacks for each k. `sigma` and `source` are means over the n - 1 bins between entries.
std::vector<glm::vec4> preintegrate_source(const std::vector<double>& sigma, const std::vector<glm::dvec3>& source,
                                           const std::vector<glm::dvec3>& source_at_entries, double tau_of_full_step);

}  // namespace bruma::render
