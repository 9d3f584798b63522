#include <fmt/core.h>

#include <limits>

#include "measure/stress/stress_rig.h"
#include "measure/stress/stress_scenes.h"

namespace bruma::measure {
namespace {

using scene::VoxelType;

/// Rough data bend within a segment of a quarter of a voxel, so pre-integration's straight line between its ends is
/// what is missed: second order, 4e-3 at most seen; the bound leaves a factor of about 2.
constexpr double rough = 1e-2;
/// Smooth data: the same, far smaller; what is left is the table's 1/1020.
constexpr double smooth = 1e-3;

double log_between(double low, double high, double share) {
    return low * std::pow(high / low, share);
}

}  // namespace

void stress_values(StressRig& rig) {
    rig.group("values");
    const glm::ivec3 cube(12);
    rig.picture("noise-uint8", "0 or 255 at random",
                stress_scene(typed_grid<std::uint8_t>(VoxelType::uint8, cube,
                                                      [](std::size_t n) { return stress_noise(n) < 0.5 ? 0 : 255; })),
                rough);
    rig.picture("extremes-int8", "-128 or 127 at random",
                stress_scene(typed_grid<std::int8_t>(VoxelType::int8, cube,
                                                     [](std::size_t n) { return stress_noise(n) < 0.5 ? -128 : 127; })),
                rough);
    rig.picture("extremes-int16", "-32768 or 32767 at random",
                stress_scene(typed_grid<std::int16_t>(
                    VoxelType::int16, cube, [](std::size_t n) { return stress_noise(n) < 0.5 ? -32768 : 32767; })),
                rough);
    rig.picture("extremes-uint16", "0 or 65535 at random",
                stress_scene(typed_grid<std::uint16_t>(
                    VoxelType::uint16, cube, [](std::size_t n) { return stress_noise(n) < 0.5 ? 0 : 65535; })),
                rough);
    rig.picture("float-60-decades", "1e-30 to 1e30, evenly in the logarithm",
                stress_scene(float_grid(cube, [](std::size_t n) { return log_between(1e-30, 1e30, stress_noise(n)); })),
                rough);
    rig.picture("float-largest", "-3.4e38 or 3.4e38 at random",
                stress_scene(float_grid(cube,
                                        [](std::size_t n) {
                                            return stress_noise(n) < 0.5 ? std::numeric_limits<float>::lowest()
                                                                         : std::numeric_limits<float>::max();
                                        })),
                rough);
    rig.picture(
        "denormals", "1e-44 to 1e-39",
        stress_scene(float_grid(cube, [](std::size_t n) { return log_between(1e-44, 1e-39, stress_noise(n)); })),
        rough);
    rig.picture("offset", "1e6 - 1 to 1e6 + 1",
                stress_scene(float_grid(cube, [](std::size_t n) { return 1e6 + 2.0 * stress_noise(n) - 1.0; })), rough);
    rig.picture("not-finite", "NaN and infinities among numbers",
                stress_scene(float_grid(cube,
                                        [](std::size_t n) {
                                            const double kind = stress_noise(n);
                                            return kind < 0.1   ? std::numeric_limits<double>::quiet_NaN()
                                                   : kind < 0.2 ? std::numeric_limits<double>::infinity()
                                                                : stress_noise(n, 2);
                                        })),
                rough);
    for (const double value : {0.0, 1.0, -7.5, 1e30, 1e-40}) {
        rig.picture(fmt::format("constant-{:g}", value), "one value everywhere",
                    stress_scene(float_grid(cube, [value](std::size_t) { return value; })), smooth);
    }
    const auto checker = [](std::size_t n) { return double((n + n / 2 + n / 4) % 2); };
    const auto ramp = [](std::size_t n) { return double(n); };
    rig.picture("1x1x1", "a single sample", stress_scene(float_grid({1, 1, 1}, ramp)), smooth);
    rig.picture("1x1x64", "a line of samples", stress_scene(float_grid({1, 1, 64}, ramp)), smooth);
    rig.picture("64x1x1", "the same along x", stress_scene(float_grid({64, 1, 1}, ramp)), smooth);
    rig.picture("1x33x17", "a sheet", stress_scene(float_grid({1, 33, 17}, ramp)), smooth);
    rig.picture("2x2x2", "eight samples, 0 and 1 in turn", stress_scene(float_grid({2, 2, 2}, checker)), rough);
    rig.picture(
        "4x4x512", "long and thin",
        stress_scene(float_grid({4, 4, 512}, [](std::size_t n) { return 0.5 + 0.5 * std::sin(0.02 * double(n)); })),
        rough);
    scene::Scene spaced = stress_scene(smooth_grid());
    auto grid = std::make_shared<scene::VolumeGrid>(**stress_volume(spaced).grid);
    grid->spacing = {1e-3, 1e-3, 1e-9};
    stress_volume(spaced).grid = std::shared_ptr<const scene::VolumeGrid>(grid);
    spaced.rendering.edit([](scene::RenderSettings& s) { s.step = 1.0; });
    rig.picture("spacing-1e-9", "spacing of 1 mm, 1 mm and 1 nm", spaced);
}

}  // namespace bruma::measure
