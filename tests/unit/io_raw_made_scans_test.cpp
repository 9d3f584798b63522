#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "io/volume/raw_proposals.h"
#include "io_temporary_folder.h"

/// Whether the layouts of headerless files are found again. The files are made here after what scanners, microscopes
/// and simulations write: sizes that are no powers of two, slices farther apart than their samples, noise, both byte
/// orders, headers.
namespace bruma::io {
namespace {

using scene::Endian;
using scene::VoxelType;

/// Even numbers in [0, 1) without a pattern that data could share (Knuth's MMIX generator).
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15U + 1U) {}
    double operator()() {
        state_ = state_ * 6364136223846793005U + 1442695040888963407U;
        return double(state_ >> 40U) * 0x1p-24;
    }
    double between(double low, double high) { return low + (high - low) * (*this)(); }

  private:
    std::uint64_t state_;
};

struct Scan {
    const char* name;
    glm::ivec3 size;
    VoxelType type;
    glm::dvec3 spacing_mm;
    double air, tissue;  ///< values outside and inside of what was scanned
    double noise;        ///< as a share of the tissue's contrast
    Endian endian = Endian::little;
    std::int64_t header = 0;
};

/// Some ellipsoids within one another and beside one another, in mm, and waves through all of them.
struct Body {
    glm::dvec3 centre_mm, radii_mm;
    double value;
};

std::vector<Body> bodies_of(const Scan& scan, Random& random) {
    const glm::dvec3 extent = glm::dvec3(scan.size) * scan.spacing_mm;
    const double contrast = scan.tissue - scan.air;
    std::vector<Body> bodies{{extent * glm::dvec3(random.between(0.45, 0.55), random.between(0.45, 0.55), 0.5),
                              extent * glm::dvec3(0.42, 0.4, random.between(0.45, 0.7)), 0.5 * contrast}};
    for (int n = 0; n < 14; ++n) {
        const glm::dvec3 share(random(), random(), random());
        const double radius = std::min({extent.x, extent.y, extent.z}) * random.between(0.06, 0.3);
        bodies.push_back({extent * (0.15 + 0.7 * share),
                          radius * glm::dvec3(random.between(0.6, 1.4), random.between(0.6, 1.4), 1.0),
                          contrast * random.between(-0.3, 0.5)});
    }
    return bodies;
}

template <class T>
void append_samples(const Scan& scan, Random& random, std::string& bytes) {
    const std::vector<Body> bodies = bodies_of(scan, random);
    const double contrast = scan.tissue - scan.air;
    const bool integral = std::is_integral_v<T>;
    std::vector<double> row(std::size_t(scan.size.x));
    std::vector<T> samples(row.size());
    const std::size_t start = bytes.size();
    bytes.resize(start + row.size() * sizeof(T) * std::size_t(scan.size.y) * std::size_t(scan.size.z));
    char* out = bytes.data() + start;
    for (int k = 0; k < scan.size.z; ++k) {
        for (int j = 0; j < scan.size.y; ++j) {
            const double y = j * scan.spacing_mm.y;
            const double z = k * scan.spacing_mm.z;
            std::fill(row.begin(), row.end(), scan.air);
            for (const Body& body : bodies) {
                const double dy = (y - body.centre_mm.y) / body.radii_mm.y;
                const double dz = (z - body.centre_mm.z) / body.radii_mm.z;
                const double left = 1.0 - dy * dy - dz * dz;
                if (left <= 0.0) {
                    continue;
                }
                const double half = std::sqrt(left) * body.radii_mm.x;
                const int from = std::max(0, int((body.centre_mm.x - half) / scan.spacing_mm.x));
                const int to = std::min(scan.size.x - 1, int((body.centre_mm.x + half) / scan.spacing_mm.x));
                // An edge about a millimetre wide: what a scanner resolves.
                const double sharp = 0.5 * body.radii_mm.x;
                for (int i = from; i <= to; ++i) {
                    const double dx = (i * scan.spacing_mm.x - body.centre_mm.x) / body.radii_mm.x;
                    row[std::size_t(i)] += body.value * std::clamp((left - dx * dx) * sharp, 0.0, 1.0);
                }
            }
            for (std::size_t i = 0; i < row.size(); ++i) {
                const double grain = random() + random() + random() - 1.5;  // standard deviation 1/2
                const double value = row[i] + 2.0 * scan.noise * contrast * grain;
                // Air shows noise on one side alone where values cannot be negative, as magnitudes of MR do.
                const double least = integral ? double(std::numeric_limits<T>::min()) : -1e30;
                const double most = integral ? double(std::numeric_limits<T>::max()) : 1e30;
                samples[i] = T(std::clamp(integral ? std::round(value) : value, least, most));
            }
            std::memcpy(out, samples.data(), samples.size() * sizeof(T));
            if (scan.endian == Endian::big) {
                for (std::size_t i = 0; i < samples.size(); ++i) {
                    std::reverse(out + i * sizeof(T), out + (i + 1) * sizeof(T));
                }
            }
            out += samples.size() * sizeof(T);
        }
    }
}

std::string bytes_of(const Scan& scan, std::uint64_t seed) {
    Random random(seed);
    std::string bytes;
    for (std::int64_t n = 0; n < scan.header; ++n) {
        bytes += n < 64 ? char(random.between(32, 127)) : '\0';
    }
    switch (scan.type) {
        case VoxelType::uint8:
            append_samples<std::uint8_t>(scan, random, bytes);
            break;
        case VoxelType::int8:
            append_samples<std::int8_t>(scan, random, bytes);
            break;
        case VoxelType::uint16:
            append_samples<std::uint16_t>(scan, random, bytes);
            break;
        case VoxelType::int16:
            append_samples<std::int16_t>(scan, random, bytes);
            break;
        default:
            append_samples<float>(scan, random, bytes);
    }
    return bytes;
}

constexpr auto u8 = VoxelType::uint8;
constexpr auto u16 = VoxelType::uint16;
constexpr auto i16 = VoxelType::int16;
constexpr auto f32 = VoxelType::float32;
constexpr auto big = Endian::big;

const std::array<Scan, 22> scans{{
    {"angiography", {416, 512, 60}, u16, {0.41, 0.41, 0.8}, 20, 900, 0.04},
    {"cropped CT", {378, 332, 100}, u8, {0.8, 0.8, 1.5}, 8, 180, 0.02},
    {"resampled CT", {360, 420, 75}, f32, {0.5, 0.5, 1.0}, -1000, 60, 0.02},
    {"thick slices", {512, 512, 40}, i16, {0.7, 0.7, 5.0}, -1000, 200, 0.02},
    {"head, big endian", {256, 256, 113}, u16, {1, 1, 2}, 0, 1200, 0.01, big},
    {"lobster", {301, 324, 56}, u8, {1, 1, 1.4}, 10, 130, 0.03},
    {"knee", {320, 320, 48}, u16, {0.5, 0.5, 3.0}, 10, 700, 0.05},
    {"brain", {240, 240, 155}, i16, {1, 1, 1}, 0, 900, 0.03},
    {"brain atlas", {181, 217, 181}, u8, {1, 1, 1}, 0, 200, 0.01},
    {"small atlas", {91, 109, 91}, f32, {2, 2, 2}, 0, 8000, 0.01},
    {"industrial CT", {492, 492, 44}, u16, {0.6, 0.6, 0.6}, 600, 9000, 0.02},
    {"microscope", {640, 480, 40}, u8, {0.3, 0.3, 1.0}, 6, 120, 0.08},
    {"flow", {193, 194, 250}, f32, {1, 1, 1}, 0.0, 0.7, 0.0},
    {"tooth", {103, 94, 161}, u8, {1, 1, 1}, 20, 190, 0.02},
    {"statue", {341, 341, 93}, u8, {1, 1, 4}, 0, 160, 0.02},
    {"tree", {512, 499, 48}, u16, {0.9, 0.9, 0.9}, 100, 3000, 0.03},
    {"sagittal MR, big endian", {176, 256, 160}, i16, {1.2, 0.9, 0.9}, 0, 500, 0.04, big},
    {"tube", {64, 64, 512}, u8, {1, 1, 1}, 0, 250, 0.0},
    {"behind 512 bytes", {500, 300, 47}, u16, {0.7, 0.7, 2.0}, 0, 1500, 0.02, Endian::little, 512},
    {"floats, big endian", {128, 128, 96}, f32, {1, 1, 1}, -3.0, 5.0, 0.01, big},
    {"behind 1024 bytes", {190, 271, 133}, u16, {0.8, 0.8, 1.2}, 50, 2500, 0.03, Endian::little, 1024},
    {"behind 352 bytes", {400, 350, 50}, i16, {0.6, 0.6, 2.5}, -1000, 300, 0.03, Endian::little, 352},
}};

TEST(RawMadeScans, AreProposedFirst) {
    const TemporaryFolder folder;
    int first = 0;
    for (std::size_t n = 0; n < scans.size(); ++n) {
        const Scan& scan = scans[n];
        const auto file = folder.write("data.bin", bytes_of(scan, n + 1));
        const std::vector<RawProposal> proposals = propose_layouts(file, {}, 12);
        const auto found = std::find_if(proposals.begin(), proposals.end(), [&](const RawProposal& p) {
            return p.size == scan.size && p.type == scan.type && p.endian == scan.endian && p.offset == scan.header;
        });
        first += found == proposals.begin() && found != proposals.end() ? 1 : 0;
        EXPECT_NE(found, proposals.end()) << scan.name << ": not even among the first twelve";
        if (found != proposals.begin()) {
            for (auto p = proposals.begin(); p != proposals.end() && p <= found; ++p) {
                std::printf("%s: %.3f %s (%s)\n", scan.name, p->score, as_options(*p).c_str(), p->reason.c_str());
            }
        }
    }
    EXPECT_GE(first, 21) << "of " << scans.size();
}

/// Headers of any length are found when they hold the size, as in the files of Vienna's university of technology.
TEST(RawMadeScans, AreFoundBehindTheirOwnSizes) {
    const TemporaryFolder folder;
    const Scan scan{"tree", {123, 119, 61}, u16, {0.9, 0.9, 0.9}, 100, 3000, 0.03};
    const std::string samples = bytes_of(scan, 7);
    const auto first = [&](const std::string& header) {
        const auto proposals = propose_layouts(folder.write("data.dat", header + samples), {}, 1);
        return !proposals.empty() && proposals[0].size == scan.size && proposals[0].type == scan.type &&
               proposals[0].offset == std::int64_t(header.size());
    };
    EXPECT_TRUE(first(std::string("\x7b\0\x77\0\x3d\0", 6))) << "16 bits, little endian";
    EXPECT_TRUE(
        first(std::string("VOL2") + std::string("\0\0\0\x7b\0\0\0\x77\0\0\0\x3d", 12) + std::string(5018, '\0')))
        << "32 bits, big endian, somewhere in a longer header";
}

}  // namespace
}  // namespace bruma::io
