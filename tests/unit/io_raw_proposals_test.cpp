#include "io/volume/raw_proposals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <set>

#include "io/volume/raw_name.h"
#include "io_temporary_folder.h"

namespace bruma::io {
namespace {

int rank_of(const std::vector<RawProposal>& proposals, glm::ivec3 size, scene::VoxelType type, scene::Endian endian,
            std::int64_t offset) {
    for (std::size_t n = 0; n < proposals.size(); ++n) {
        const RawProposal& p = proposals[n];
        if (p.size == size && p.type == type && p.endian == endian && p.offset == offset) {
            return int(n) + 1;
        }
    }
    return 999;
}

void print(const std::vector<RawProposal>& proposals) {
    for (const RawProposal& proposal : proposals) {
        std::printf("    %8.3f  %s (%s)\n", proposal.score, as_options(proposal).c_str(), proposal.reason.c_str());
    }
}

TEST(RawProposals, FindTheLayoutOfRealVolumes) {
    if (!data_folder()) {
        GTEST_SKIP() << "BRUMA_DATA does not name a folder with real volumes";
    }
    const std::set<std::string> always_first{"bonsai-zfp8", "engine-zfp8", "Bucky", "CThead", "boston_teapot"};
    for (const auto& entry : std::filesystem::directory_iterator(*data_folder() / "volumes")) {
        if (entry.path().extension() != ".raw") {
            continue;
        }
        const scene::VolumeSource truth = layout_from_name(entry.path());
        const TemporaryFolder folder;
        std::filesystem::copy_file(entry.path(), folder / "data.raw");
        const auto proposals = propose_layouts(folder / "data.raw", {}, 5);
        const std::string name = make_grid_name(entry.path());
        const int rank = rank_of(proposals, *truth.size, *truth.type, scene::Endian::little, 0);
        std::printf("%s: rank %d\n", name.c_str(), rank);
        print(proposals);
        EXPECT_LE(rank, always_first.contains(name) ? 1 : 3) << name;
    }
}

/// A smooth blob with a little grain, off-centre, in 16 bits or as float.
template <class T>
std::string blob(glm::ivec3 size, double amplitude, double base, bool big_endian) {
    std::string bytes;
    std::uint32_t state = 1;
    for (int k = 0; k < size.z; ++k) {
        for (int j = 0; j < size.y; ++j) {
            for (int i = 0; i < size.x; ++i) {
                const glm::dvec3 p = (glm::dvec3(i, j, k) - 0.45 * glm::dvec3(size)) / (0.3 * glm::dvec3(size));
                state = state * 1664525U + 1013904223U;
                const double grain = 0.01 * (state >> 8) * 0x1p-24;
                const T value = T(base + amplitude * (std::exp(-glm::dot(p, p)) + grain));
                char raw[sizeof(T)];
                std::memcpy(raw, &value, sizeof value);
                if (big_endian) {
                    std::reverse(raw, raw + sizeof value);
                }
                bytes.append(raw, sizeof value);
            }
        }
    }
    return bytes;
}

TEST(RawProposals, TellTypesByteOrdersAndHeadersApart) {
    const TemporaryFolder folder;
    const glm::ivec3 size(64, 64, 40);
    const auto rank = [&](const std::string& bytes, scene::VoxelType type, scene::Endian endian, std::int64_t offset) {
        const auto proposals = propose_layouts(folder.write("data.raw", bytes), {}, 4);
        const int found = rank_of(proposals, size, type, endian, offset);
        if (found > 1) {
            print(proposals);
        }
        return found;
    };
    using scene::Endian;
    using scene::VoxelType;
    EXPECT_EQ(rank(blob<std::uint16_t>(size, 3000, 10, false), VoxelType::uint16, Endian::little, 0), 1);
    EXPECT_EQ(rank(blob<std::uint16_t>(size, 3000, 10, true), VoxelType::uint16, Endian::big, 0), 1);
    EXPECT_EQ(rank(blob<std::int16_t>(size, 3000, -1000, false), VoxelType::int16, Endian::little, 0), 1);
    EXPECT_EQ(rank(blob<std::int16_t>(size, 3000, -1000, true), VoxelType::int16, Endian::big, 0), 1);
    EXPECT_EQ(rank(blob<float>(size, 0.1, 0.02, false), VoxelType::float32, Endian::little, 0), 1);
    EXPECT_EQ(rank(blob<float>(size, 5.0, -2.0, true), VoxelType::float32, Endian::big, 0), 1);
    EXPECT_EQ(rank(blob<std::int8_t>(size, 100, -40, false), VoxelType::int8, Endian::little, 0), 1);
    EXPECT_EQ(
        rank(std::string(512, 'h') + blob<std::uint8_t>(size, 200, 10, false), VoxelType::uint8, Endian::little, 512),
        1);
}

TEST(RawProposals, KeepToWhatIsKnown) {
    const TemporaryFolder folder;
    const auto file = folder.write("data.raw", blob<std::uint16_t>({32, 32, 20}, 3000, 0, false));
    scene::VolumeSource hints;
    hints.size = glm::ivec3(32, 32, 20);
    for (const RawProposal& proposal : propose_layouts(file, hints, 100)) {
        EXPECT_EQ(proposal.size, *hints.size);
    }
    EXPECT_EQ(propose_layouts(file, hints, 1).at(0).type, scene::VoxelType::uint16);
    hints.size.reset();
    hints.type = scene::VoxelType::uint8;
    for (const RawProposal& proposal : propose_layouts(file, hints, 100)) {
        EXPECT_EQ(proposal.type, scene::VoxelType::uint8);
    }
    hints.offset = std::int64_t(1) << 40;
    EXPECT_TRUE(propose_layouts(file, hints, 100).empty());
}

TEST(RawProposals, AnswerForTinyAndConstantFiles) {
    const TemporaryFolder folder;
    EXPECT_FALSE(propose_layouts(folder.write("one.raw", "x"), {}, 3).empty());
    EXPECT_FALSE(propose_layouts(folder.write("prime.raw", std::string(9973, 'x')), {}, 3).empty());
    const auto constant = propose_layouts(folder.write("cube.raw", std::string(32768, '\0')), {}, 3);
    EXPECT_EQ(constant.at(0).size, glm::ivec3(32));
}

}  // namespace
}  // namespace bruma::io
