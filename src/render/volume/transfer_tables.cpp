#include "render/volume/transfer_tables.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace bruma::render {
namespace {

/// A stretch of the ray under the operator 'over': light that leaves it and what it does to light behind.
struct Layer {
    glm::dvec3 radiance{0.0};
    double opacity = 0.0;  ///< 1 - transmittance, kept apart so that thin layers keep their digits
    double transmittance = 1.0;
};

Layer over(const Layer& front, const Layer& back) {
    return {front.radiance + front.transmittance * back.radiance, front.opacity + front.transmittance * back.opacity,
            front.transmittance * back.transmittance};
}

/// Products of every window of `width` consecutive layers, in order, by a queue of two stacks: the back stack keeps one
/// running product, the front stack the products of all its suffixes. `emit(first, product)`.
template <class Emit>
void windows(const std::vector<Layer>& layers, int width, std::vector<Layer>& suffixes, const Emit& emit) {
    const int count = int(layers.size());
    Layer running;  // product of layers pushed since the last turn-over
    int running_first = 0;
    int suffix_first = 0;
    suffixes.clear();  // suffixes[i]: product from the i-th of them to running_first - 1, last one nearest
    for (int next = 0; next < count; ++next) {
        running = over(running, layers[std::size_t(next)]);
        const int first = next - width + 1;
        if (first < 0) {
            continue;
        }
        if (suffixes.empty()) {
            // Turn over: suffix products of [first, next].
            Layer product;
            suffixes.resize(std::size_t(next) - std::size_t(first) + 1);
            for (int n = next; n >= first; --n) {
                product = over(layers[std::size_t(n)], product);
                suffixes[std::size_t(n - first)] = product;
            }
            suffix_first = first;
            running = Layer{};
            running_first = next + 1;
        }
        const Layer& front = suffixes[std::size_t(first - suffix_first)];
        emit(first, running_first <= next ? over(front, running) : front);
        if (first + 1 == running_first) {
            suffixes.clear();
        }
    }
}

glm::vec4 mean_source(const Layer& layer, glm::dvec3 if_empty) {
    const glm::dvec3 mean = layer.opacity > 0.0 ? layer.radiance / layer.opacity : if_empty;
    return {mean, 0.0};
}

}  // namespace

std::vector<glm::vec4> preintegrate_source(const std::vector<double>& sigma, const std::vector<glm::dvec3>& source,
                                           const std::vector<glm::dvec3>& source_at_entries, double tau_of_full_step) {
    const int bins = int(sigma.size());
    const int entries = bins + 1;
    std::vector<glm::vec4> table(std::size_t(entries) * entries);
    const auto at = [&](int front, int back) -> glm::vec4& { return table[std::size_t(back) * entries + front]; };
    for (int n = 0; n < entries; ++n) {
        at(n, n) = {source_at_entries[std::size_t(n)], 0.0};
    }
    tbb::parallel_for(1, entries, [&](int width) {
        std::vector<Layer> layers(static_cast<std::size_t>(bins));
        std::vector<Layer> suffixes;
        for (int n = 0; n < bins; ++n) {
            const double tau = sigma[std::size_t(n)] * tau_of_full_step / width;
            const double opacity = -std::expm1(-tau);
            layers[std::size_t(n)] = {source[std::size_t(n)] * opacity, opacity, 1.0 - opacity};
        }
        const auto if_empty = [&](int first) {
            return 0.5 *
                   (source_at_entries[std::size_t(first)] + source_at_entries[std::size_t(first) + std::size_t(width)]);
        };
        windows(layers, width, suffixes, [&](int first, const Layer& product) {
            at(first, first + width) = mean_source(product, if_empty(first));
        });
        // The other way the layers are met in reverse.
        std::vector<Layer> reversed(layers.rbegin(), layers.rend());
        windows(reversed, width, suffixes, [&](int first, const Layer& product) {
            const int front = bins - first;
            at(front, front - width) = mean_source(product, if_empty(front - width));
        });
    });
    return table;
}

TransferTables make_transfer_tables(const scene::TransferFunction& tf, const TableParameters& parameters) {
    TransferTables tables;
    std::vector<double> sigma(depth_entries);
    std::vector<glm::dvec3> color(depth_entries);  // what lights act on, or all of it when unlit
    std::vector<glm::dvec3> glow(depth_entries);
    for (int n = 0; n < depth_entries; ++n) {
        const double u = double(n) / (depth_entries - 1);
        sigma[std::size_t(n)] = scene::extinction_of_opacity(scene::opacity_at(tf, u), 1.0);
        const glm::dvec3 c = scene::color_at(tf, u);
        const glm::dvec3 own = c * (parameters.emission + scene::emission_at(tf, u));
        tables.glows = tables.glows || own != glm::dvec3(0.0);
        color[std::size_t(n)] = parameters.scatters ? glm::min(parameters.albedo * c, glm::dvec3(1.0))
                                : parameters.lit    ? c
                                                    : c + own;
        glow[std::size_t(n)] = own;
    }
    tables.glows = tables.glows && parameters.lit;
    tables.optics.resize(depth_entries);
    tables.depth.resize(depth_entries);
    double prefix = 0.0;
    for (int n = 0; n < depth_entries; ++n) {
        const auto i = std::size_t(n);
        if (n > 0) {
            prefix += 0.5 * (sigma[i - 1] + sigma[i]) / (depth_entries - 1);
        }
        tables.optics[i] = {float(sigma[i]), glm::vec3(sigma[i] * color[i])};
        tables.depth[i] = {float(prefix), float(sigma[i])};
    }
    // Infinite beyond an end of the window that is visible itself: values outside are clamped to it.
    const auto visible = [](double s) { return s > 0.0; };
    const auto first = std::find_if(sigma.begin(), sigma.end(), visible) - sigma.begin();
    const auto last = depth_entries - 1 - (std::find_if(sigma.rbegin(), sigma.rend(), visible) - sigma.rbegin());
    const auto u_of = [](std::ptrdiff_t n) { return float(double(n) / (depth_entries - 1)); };
    tables.lowest_visible = first == 0 ? -1e30F : u_of(first - 1);
    tables.highest_visible = last == depth_entries - 1 ? 1e30F : u_of(last + 1);
    if (first == depth_entries) {
        tables.lowest_visible = 1e30F;
    }
    if (!parameters.preintegrated && !tables.glows) {
        return tables;
    }
    constexpr int fine = (depth_entries - 1) / (source_entries - 1);
    std::vector<double> bin_sigma(source_entries - 1);
    const auto make = [&](const std::vector<glm::dvec3>& s) {
        std::vector<glm::dvec3> bin_source(source_entries - 1);
        std::vector<glm::dvec3> at_entries(source_entries);
        for (int n = 0; n < source_entries; ++n) {
            at_entries[std::size_t(n)] = s[std::size_t(n) * fine];
        }
        for (int n = 0; n < source_entries - 1; ++n) {
            // Trapezoids over the finer entries of this bin.
            double depth = 0.0;
            glm::dvec3 light(0.0);
            glm::dvec3 plain(0.0);
            for (int f = 0; f < fine; ++f) {
                const auto a = std::size_t(n) * fine + f;
                depth += 0.5 * (sigma[a] + sigma[a + 1]) / fine;
                light += 0.5 * (sigma[a] * s[a] + sigma[a + 1] * s[a + 1]) / double(fine);
                plain += 0.5 * (s[a] + s[a + 1]) / double(fine);
            }
            bin_sigma[std::size_t(n)] = depth;
            bin_source[std::size_t(n)] = depth > 0.0 ? light / depth : plain;
        }
        return preintegrate_source(bin_sigma, bin_source, at_entries, parameters.tau_of_full_step);
    };
    if (parameters.preintegrated) {
        tables.source = make(color);
    }
    if (tables.glows) {
        tables.glow = make(glow);
    }
    return tables;
}

}  // namespace bruma::render
