#include "io/volume/raw_proposals.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "io/volume/layout_search.h"
#include "io/volume/raw_headers.h"
#include "io/volume/sample_roughness.h"

namespace bruma::io {
namespace {

using scene::Endian;
using scene::VoxelType;

double type_penalty(VoxelType type, Endian endian) {
    static constexpr std::array<double, 5> by_type{0.0, 0.15, 0.02, 0.1, 0.02};
    return by_type[std::size_t(type)] + (endian == Endian::big ? 0.05 : 0.0);
}

std::string reason_words(const SizeGuess& guess, bool in_header) {
    const glm::ivec3 size = guess.size;
    const char* shape = in_header                              ? "the file begins with these numbers"
                        : size.x == size.y && size.y == size.z ? "a cube"
                        : size.x == size.y                     ? "square slices"
                                                               : "edges that fit the length";
    return fmt::format("{}; neighbours differ by {:.1f} % of what distant samples do", shape, 100.0 * guess.roughness);
}

struct Draft {
    RawProposal proposal;
    HeaderGuess header;
    double penalty = 0.0;  ///< of all but the size
};

/// The `most` likeliest, best first, each layout once.
void sort_out(std::vector<Draft>& drafts, std::size_t most) {
    std::stable_sort(drafts.begin(), drafts.end(),
                     [](const Draft& a, const Draft& b) { return a.proposal.score < b.proposal.score; });
    std::set<std::tuple<int, int, int, VoxelType, Endian, std::int64_t>> seen;
    std::erase_if(drafts, [&](const Draft& draft) {
        const RawProposal& p = draft.proposal;
        return !seen.insert({p.size.x, p.size.y, p.size.z, p.type, p.endian, p.offset}).second;
    });
    drafts.resize(std::min(drafts.size(), most));
}

/// Half the sum of |differences| of two histograms of bytes: those at `first` and at `second` bytes within every four.
double histogram_distance(std::span<const std::byte> bytes, std::size_t first, std::size_t second) {
    std::array<double, 256> difference{};
    const std::size_t groups = bytes.size() / 4;
    const std::size_t skip = std::max<std::size_t>(1, groups / 20000) | 1U;  // odd: powers of two would beat with rows
    double counted = 0.0;
    for (std::size_t group = 0; group < groups; group += skip) {
        difference[std::to_integer<std::size_t>(bytes[4 * group + first])] += 1.0;
        difference[std::to_integer<std::size_t>(bytes[4 * group + second])] -= 1.0;
        counted += 1.0;
    }
    double sum = 0.0;
    for (const double d : difference) {
        sum += std::abs(d);
    }
    return counted > 0.0 ? 0.5 * sum / counted : 0.0;
}

/// How unlikely it is, by index, that a sample takes 1, 2 or 4 bytes, in the unit of the score.
std::array<double, 5> rate_widths(std::span<const std::byte> bytes) {
    constexpr int places = 768;
    constexpr double floor = 1e-3;
    constexpr double most = 3.0;
    constexpr double alike = 0.15;  // some thousand bytes of one source come to 0.03 to 0.06
    constexpr double weight = 4.0;
    SampleRoughness single(bytes, {VoxelType::uint8, Endian::little, 0, std::int64_t(bytes.size())}, places);
    // Bytes of equal weight resemble one another, so the roughness of single bytes is least at the width of a sample.
    std::array<double, 5> rating{};
    double least = 1e9;
    for (const std::int64_t width : {1, 2, 4}) {
        rating[std::size_t(width)] = std::log(single.at_lag(width) + floor);
        least = std::min(least, rating[std::size_t(width)]);
    }
    for (double& rated : rating) {
        rated = std::min(most, rated - least);
    }
    // Upper and lower bytes have other histograms; where they have not, they are samples of their own.
    rating[2] += weight * std::max(0.0, alike - histogram_distance(bytes, 0, 1));
    rating[4] += weight * std::max(0.0, alike - histogram_distance(bytes, 1, 3));
    return rating;
}

/// The readings that were measured so far. Signed and unsigned ones without a top bit are the same numbers.
class Readings {
  public:
    Readings(std::span<const std::byte> bytes, int places) : bytes_(bytes), places_(places) {}

    SampleRoughness& of(VoxelType type, Endian endian, std::int64_t shift) {
        if (type == VoxelType::int8 || type == VoxelType::int16) {
            SampleRoughness& other = of(type == VoxelType::int8 ? VoxelType::uint8 : VoxelType::uint16, endian, shift);
            if (!other.has_top_bits()) {
                return other;
            }
        }
        const std::int64_t count = (std::int64_t(bytes_.size()) - shift) / std::int64_t(scene::bytes_per_voxel(type));
        return known_.try_emplace({type, endian, shift}, bytes_, Reading{type, endian, shift, count}, places_)
            .first->second;
    }

  private:
    std::span<const std::byte> bytes_;
    int places_;
    std::map<std::tuple<VoxelType, Endian, std::int64_t>, SampleRoughness> known_;
};

/// All layouts worth a second look.
std::vector<Draft> draft_layouts(std::span<const std::byte> bytes, const scene::VolumeSource& hints, int places) {
    constexpr double of_interest = 1.5;  // beyond the best score: a factor of more than four in roughness
    const std::array<double, 5> width_rating = rate_widths(bytes);
    // The likeliest first: the better the best is, the less of the others is looked at.
    std::array types{VoxelType::uint8, VoxelType::uint16, VoxelType::float32, VoxelType::int8, VoxelType::int16};
    std::stable_sort(types.begin(), types.end(), [&](VoxelType a, VoxelType b) {
        return width_rating[scene::bytes_per_voxel(a)] < width_rating[scene::bytes_per_voxel(b)];
    });
    Readings readings(bytes, places);
    double best = 1e9;
    std::vector<Draft> drafts;
    for (const VoxelType type : types) {
        const auto width = std::int64_t(scene::bytes_per_voxel(type));
        if (hints.type && *hints.type != type) {
            continue;
        }
        for (const HeaderGuess& header : guess_headers(bytes, hints, width)) {
            const std::int64_t count = (std::int64_t(bytes.size()) - header.offset) / width;
            for (const Endian endian : {Endian::little, Endian::big}) {
                if ((width == 1 && endian == Endian::big) || (hints.endian && width > 1 && *hints.endian != endian)) {
                    continue;
                }
                SampleRoughness& roughness = readings.of(type, endian, header.offset % width);
                if (!roughness.plausible()) {
                    continue;
                }
                const double penalty = header.penalty + type_penalty(type, endian) + width_rating[std::size_t(width)];
                const std::vector<SizeGuess> guesses =
                    header.size ? std::vector{judge_size(roughness, *header.size)}
                                : guess_sizes(roughness, count, best + of_interest - penalty, of_interest);
                for (const SizeGuess& guess : guesses) {
                    best = std::min(best, guess.score + penalty);
                    drafts.push_back(
                        {{guess.size, type, endian, header.offset, guess.score + penalty, {}}, header, penalty});
                }
            }
        }
    }
    return drafts;
}

}  // namespace

std::vector<RawProposal> propose_layouts(const std::filesystem::path& path, const scene::VolumeSource& hints,
                                         int most) {
    constexpr int quick = 96;  // places at which all layouts are measured, and the likeliest once more
    constexpr int thorough = 768;
    constexpr std::size_t measured_again = 200;
    const MappedFile file(path);
    std::vector<Draft> drafts = draft_layouts(file.bytes(), hints, quick);
    sort_out(drafts, measured_again);
    Readings readings(file.bytes(), thorough);
    for (Draft& draft : drafts) {
        RawProposal& proposal = draft.proposal;
        const auto width = std::int64_t(scene::bytes_per_voxel(proposal.type));
        const SizeGuess guess =
            judge_size(readings.of(proposal.type, proposal.endian, proposal.offset % width), proposal.size);
        proposal.score = guess.score + draft.penalty;
        proposal.reason = reason_words(guess, draft.header.penalty < 0.0);
    }
    sort_out(drafts, std::size_t(std::max(0, most)));
    std::vector<RawProposal> proposals;
    proposals.reserve(drafts.size());
    for (Draft& draft : drafts) {
        proposals.push_back(std::move(draft.proposal));
    }
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
