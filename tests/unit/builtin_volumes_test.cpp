// Shelf: closed forms.
#include "scene/builtin/builtin_volumes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "scene/builtin/builtin.h"

namespace bruma::scene {
namespace {

TEST(BuiltinVolumes, AreWholeFiniteAndBearTheirNames) {
    for (const std::string& name : builtin_volume_names()) {
        const auto grid = builtin_volume(name);
        EXPECT_EQ(grid->name, name);
        EXPECT_EQ(grid->voxels.size(), grid->voxel_count() * bytes_per_voxel(grid->type)) << name;
        EXPECT_EQ(grid->spacing, glm::dvec3(1e-3)) << name;
        EXPECT_TRUE(std::isfinite(grid->smallest) && std::isfinite(grid->largest)) << name;
        EXPECT_EQ(grid->largest > grid->smallest, name != "cube") << name << " is the one without contrast";
    }
}

TEST(BuiltinVolumes, AreTheSameEveryTime) {
    for (const char* name : {"engine", "knot", "blobs"}) {
        EXPECT_EQ(builtin_volume(name)->voxels, builtin_volume(name)->voxels) << name;
    }
}

TEST(BuiltinVolumes, AnUnknownNameIsAnsweredWithTheNearest) {
    try {
        builtin_volume("buckey");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "builtin:buckey: there is no such volume; did you mean 'bucky'?");
    }
}

TEST(BuiltinBucky, EachOfTheSixtyAtomsHasThreeNearestNeighboursOnOneSphere) {
    const auto atoms = bucky_atoms_mm();
    for (const glm::dvec3& atom : atoms) {
        EXPECT_NEAR(glm::length(atom), 25.0, 1e-12);
        std::vector<double> distances;
        for (const glm::dvec3& other : atoms) {
            distances.push_back(glm::length(other - atom));
        }
        std::sort(distances.begin(), distances.end());
        EXPECT_EQ(distances[0], 0.0);
        // Edge of a truncated icosahedron of this circumradius: 4 R / sqrt(58 + 18 sqrt 5).
        const double edge = 100.0 / std::sqrt(58.0 + 18.0 * std::sqrt(5.0));
        for (int n = 1; n <= 3; ++n) {
            EXPECT_NEAR(distances[n], edge, 1e-12);
        }
        EXPECT_GT(distances[4], 1.5 * edge);
    }
}

TEST(BuiltinBucky, AllAtomsAreEqualMaximaOfTheDensity) {
    const auto atoms = bucky_atoms_mm();
    for (const glm::dvec3& atom : atoms) {
        const double peak = bucky_density(atom);
        EXPECT_NEAR(peak, bucky_density(atoms[0]), 1e-5);  // terms below e^-12 are left out on either side of the cut
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 step(0.0);
            step[axis] = 0.8;  // more than the pull of the neighbours shifts the maximum
            EXPECT_LT(bucky_density(atom + step), peak);
            EXPECT_LT(bucky_density(atom - step), peak);
        }
    }
}

TEST(BuiltinBucky, TheGridHoldsTheDensityRoundedToBytes) {
    const auto grid = make_bucky();
    for (const glm::ivec3 at : {glm::ivec3(32, 40, 56), glm::ivec3(7, 30, 33), glm::ivec3(0, 0, 0)}) {
        const double exact = bucky_density(glm::dvec3(at) + 0.5 - 32.0);
        EXPECT_NEAR(grid->value(at.x, at.y, at.z), 255.0 * std::min(1.0, exact), 0.5);
    }
}

TEST(BuiltinHydrogen, IsEvenVanishesOnItsNodesAndPeaksAtTheInnerLobes) {
    const auto grid = make_hydrogen();
    for (int n = 0; n < 128; n += 7) {
        EXPECT_EQ(grid->value(n, 50, 70), grid->value(127 - n, 50, 70));
        EXPECT_EQ(grid->value(60, n, 70), grid->value(60, 127 - n, 70));
    }
    // Nodal sphere r = 12 Bohr radii = 21.6 mm, on the axis: sample 63.5 + 21.6 = 85.1.
    EXPECT_LT(grid->value(64, 85, 64), 8.0);
    // Inner lobe at r = 5.07 Bohr radii = 9.1 mm, outer lobe at 18.93 Bohr radii = 34.1 mm: 0.436 of it.
    EXPECT_NEAR(grid->value(64, 73, 64), 255.0, 8.0);
    EXPECT_NEAR(grid->value(64, 98, 64), 0.436 * 255.0, 3.0);
}

TEST(BuiltinMarschnerLobb, GoldenValues) {
    // On the axis the ripple is cos(12 pi) = 1, so rho = (1 - sin(pi z / 2) + 0.5) / 2.5; at r = 1 it is cos 0 = 1 too.
    EXPECT_NEAR(marschner_lobb(0.0, 0.0, 0.0), 0.6, 1e-12);
    EXPECT_NEAR(marschner_lobb(0.0, 0.0, 1.0), 0.2, 1e-12);
    EXPECT_NEAR(marschner_lobb(1.0, 0.0, -1.0), 1.0, 1e-12);
    // cos(pi r / 2) = 23/24 makes the ripple cos(11.5 pi) = 0.
    EXPECT_NEAR(marschner_lobb(2.0 / std::acos(-1.0) * std::acos(23.0 / 24.0), 0.0, 0.0), 0.5, 1e-12);
    const auto grid = make_marschner_lobb();
    EXPECT_EQ(grid->value(20, 20, 20), double(0.6F));
    EXPECT_NEAR(grid->value(3, 8, 31), marschner_lobb(7.0 / 41 - 1, 17.0 / 41 - 1, 63.0 / 41 - 1), 1e-7);
}

/// Fowler-Noll-Vo 1a: enough to see any change of a byte.
std::uint64_t fingerprint(const VolumeGrid& grid) {
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const std::byte byte : grid.voxels) {
        hash = (hash ^ std::to_integer<std::uint64_t>(byte)) * 0x100000001b3U;
    }
    return hash;
}

// Shelf: previous result. These bytes are compared with other programs' pictures of the same data, so none may change.
TEST(BuiltinVolumes, SharedTestVolumesKeepEveryByte) {
    EXPECT_EQ(fingerprint(*make_marschner_lobb_256()), 0xd07bb6bb5a416f3dU);
    EXPECT_EQ(fingerprint(*make_blobs()), 0xbed6d875e798c820U);
}

TEST(BuiltinSphere, IsRadiallySymmetricWithItsClosedForm) {
    const auto grid = make_sphere();
    for (int n = 0; n < 64; ++n) {
        const double exact = std::pow(std::max(0.0, 1.0 - (std::pow(n - 31.5, 2) + 12.5) / (28.8 * 28.8)), 2);
        EXPECT_NEAR(grid->value(n, 29, 34), exact, 1e-7);  // rounding to float
        EXPECT_EQ(grid->value(n, 29, 34), grid->value(34, n, 29));
        EXPECT_EQ(grid->value(n, 29, 34), grid->value(63 - n, 34, 29));
    }
}

TEST(BuiltinEngine, HasAirAluminiumAndSteelApart) {
    const auto grid = make_engine();
    const Histogram h = histogram(*grid, 236, {grid->smallest, grid->largest});
    const double air = double(h.counts.front());
    const double aluminium = double(h.counts[115]);  // 0.45 * 255 = 114.75
    const double steel = double(h.counts.back());
    EXPECT_GT(air, 0.5 * double(grid->voxel_count()));
    EXPECT_GT(aluminium, 0.05 * double(grid->voxel_count()));
    EXPECT_GT(steel, 0.01 * double(grid->voxel_count()));
    EXPECT_GT(air + aluminium + steel, 0.85 * double(grid->voxel_count())) << "the rest are edges";
}

TEST(BuiltinKnot, ItsCurveIsDenseAndTheTubeEndsWithinTheBox) {
    const auto grid = make_knot();
    // (3 * 16, 0, 0) mm lies on the curve at t = 0.
    EXPECT_GT(grid->value(111, 63, 63), 240.0);
    for (int a = 0; a < 128; ++a) {
        for (int b = 0; b < 128; ++b) {
            EXPECT_EQ(grid->value(0, a, b) + grid->value(127, a, b) + grid->value(a, 0, b) + grid->value(a, 127, b) +
                          grid->value(a, b, 0) + grid->value(a, b, 127),
                      0.0);
        }
    }
}

}  // namespace
}  // namespace bruma::scene
