#include "io/raw_proposals.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <tuple>

#include "io/sample_roughness.h"

namespace bruma::io {
namespace {

using scene::Endian;
using scene::VoxelType;

/// How unusual an edge length is; 0 for powers of two.
double edge_penalty(int edge) {
    if ((edge & (edge - 1)) == 0) {
        return 0.0;
    }
    return edge % 64 == 0 ? 0.03 : edge % 8 == 0 ? 0.06 : edge % 2 == 0 ? 0.1 : 0.13;
}

/// How unusual a size is, in the unit of the score (natural logarithm of the roughness). The weights only order what
/// smoothness leaves nearly even: factors of two in the roughness outweigh all of them but extreme shapes.
double size_penalty(glm::ivec3 size) {
    const int longest = std::max({size.x, size.y, size.z});
    const int shortest = std::min({size.x, size.y, size.z});
    double penalty = edge_penalty(size.x) + edge_penalty(size.y) + edge_penalty(size.z);
    penalty += 0.15 * std::log2(double(longest) / shortest);
    if (size.x == size.y && size.y == size.z) {
        penalty -= 0.15;
    } else if (size.x != size.y) {
        // Scanners make square slices; odd slices are mostly cropped ones.
        penalty += 0.2;
    }
    return shortest < 4 ? penalty + 2.0 : penalty;
}

std::vector<std::int64_t> divisors(std::int64_t n) {
    std::vector<std::int64_t> found;
    for (std::int64_t d = 1; d * d <= n; ++d) {
        if (n % d == 0) {
            found.push_back(d);
            if (d != n / d) {
                found.push_back(n / d);
            }
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

struct RatedSize {
    glm::ivec3 size;
    double penalty;
};

/// The sizes of exactly `count` samples, most usual first, at most `most` of them.
std::vector<RatedSize> usual_sizes(std::int64_t count, std::size_t most) {
    constexpr std::int64_t longest_edge = 1 << 16;
    std::vector<RatedSize> sizes;
    const std::vector<std::int64_t> all = divisors(count);
    for (const std::int64_t x : all) {
        for (const std::int64_t y : all) {
            if (x > longest_edge || y > longest_edge || (count / x) % y != 0 || count / x / y > longest_edge) {
                continue;
            }
            const glm::ivec3 size(x, y, count / x / y);
            sizes.push_back({size, size_penalty(size)});
        }
    }
    std::stable_sort(sizes.begin(), sizes.end(),
                     [](const RatedSize& a, const RatedSize& b) { return a.penalty < b.penalty; });
    sizes.resize(std::min(sizes.size(), most));
    return sizes;
}

/// Headers worth trying: none, the usual lengths, and what a usual cube leaves over.
std::set<std::int64_t> usual_offsets(std::int64_t length, const scene::VolumeSource& hints, std::int64_t width) {
    if (hints.offset) {
        return {*hints.offset};
    }
    if (hints.size) {
        const std::int64_t needed = std::int64_t(hints.size->x) * hints.size->y * hints.size->z * width;
        return {length - needed};
    }
    std::set<std::int64_t> offsets{0, 128, 256, 352, 512, 1024};
    for (const std::int64_t edge : {32, 64, 128, 256, 512, 1024}) {
        const std::int64_t left = length - edge * edge * edge * width;
        if (left > 0 && left <= 65536) {
            offsets.insert(left);
        }
    }
    return offsets;
}

double offset_penalty(std::int64_t offset) {
    static constexpr std::array<std::int64_t, 5> usual{128, 256, 352, 512, 1024};
    return offset == 0 ? 0.0 : std::find(usual.begin(), usual.end(), offset) != usual.end() ? 0.5 : 0.7;
}

double type_penalty(VoxelType type, Endian endian) {
    static constexpr std::array<double, 5> by_type{0.0, 0.15, 0.02, 0.1, 0.02};
    return by_type[std::size_t(type)] + (endian == Endian::big ? 0.05 : 0.0);
}

std::string reason_words(glm::ivec3 size, double roughness) {
    const char* shape = size.x == size.y && size.y == size.z ? "a cube"
                        : size.x == size.y                   ? "square slices"
                                                             : "edges that fit the length";
    return fmt::format("{}; neighbours differ by {:.1f} % of what distant samples do", shape, 100.0 * roughness);
}

/// Over the axes that have neighbours.
double mean_roughness(SampleRoughness& roughness, glm::ivec3 size) {
    const std::int64_t row = size.x;
    const std::array<std::int64_t, 3> lags{1, row, row * size.y};
    double sum = 0.0;
    int axes = 0;
    for (int axis = 0; axis < 3; ++axis) {
        if (size[axis] > 1) {
            sum += roughness.at_lag(lags[std::size_t(axis)]);
            ++axes;
        }
    }
    return axes > 0 ? sum / axes : 0.0;
}

void propose(const MappedFile& file, const Reading& reading, const std::vector<RatedSize>& sizes,
             std::vector<RawProposal>& proposals) {
    SampleRoughness roughness(file.bytes(), reading);
    if (!roughness.plausible()) {
        return;
    }
    for (const RatedSize& rated : sizes) {
        const double mean = mean_roughness(roughness, rated.size);
        // The floor keeps constant data from an infinite score: they are then ranked by usual size alone.
        const double score = std::log(mean + 1e-3) + rated.penalty + offset_penalty(reading.offset) +
                             type_penalty(reading.type, reading.endian);
        proposals.push_back(
            {rated.size, reading.type, reading.endian, reading.offset, score, reason_words(rated.size, mean)});
    }
}

}  // namespace

std::vector<RawProposal> propose_layouts(const std::filesystem::path& path, const scene::VolumeSource& hints,
                                         int most) {
    const MappedFile file(path);
    const auto length = std::int64_t(file.bytes().size());
    std::vector<RawProposal> proposals;
    for (const VoxelType type :
         {VoxelType::uint8, VoxelType::int8, VoxelType::uint16, VoxelType::int16, VoxelType::float32}) {
        const auto width = std::int64_t(scene::bytes_per_voxel(type));
        if (hints.type && *hints.type != type) {
            continue;
        }
        for (const std::int64_t offset : usual_offsets(length, hints, width)) {
            if (offset < 0 || offset >= length || (length - offset) % width != 0) {
                continue;
            }
            const std::int64_t count = (length - offset) / width;
            const auto sizes =
                hints.size ? std::vector<RatedSize>{{*hints.size, 0.0}} : usual_sizes(count, offset == 0 ? 200 : 40);
            if (hints.size && count != std::int64_t(hints.size->x) * hints.size->y * hints.size->z) {
                continue;
            }
            for (const Endian endian : {Endian::little, Endian::big}) {
                if ((width == 1 && endian == Endian::big) || (hints.endian && width > 1 && *hints.endian != endian)) {
                    continue;
                }
                propose(file, {type, endian, offset, count}, sizes, proposals);
            }
        }
    }
    std::stable_sort(proposals.begin(), proposals.end(),
                     [](const RawProposal& a, const RawProposal& b) { return a.score < b.score; });
    proposals.resize(std::min(proposals.size(), std::size_t(std::max(0, most))));
    return proposals;
}

std::string as_options(const RawProposal& proposal) {
    std::string text = fmt::format("--dims {}x{}x{} --type {}", proposal.size.x, proposal.size.y, proposal.size.z,
                                   scene::enum_words<VoxelType>()[std::size_t(proposal.type)]);
    if (proposal.endian == Endian::big) {
        text += " --endian big";
    }
    return proposal.offset > 0 ? text + fmt::format(" --offset {}", proposal.offset) : text;
}

}  // namespace bruma::io
