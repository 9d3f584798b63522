// Shelf: closed form. The same data in another type, or moved and stretched by an affine map, give the same picture.
#include <cmath>
#include <cstring>

#include "drawing.h"

namespace bruma::render {
namespace {

template <class T>
std::shared_ptr<const scene::VolumeGrid> typed(scene::VoxelType type, glm::ivec3 size,
                                               const std::function<T(int)>& of_byte) {
    std::vector<T> samples;
    for (int k = 0; k < size.z; ++k) {
        for (int j = 0; j < size.y; ++j) {
            for (int i = 0; i < size.x; ++i) {
                // Smooth, and made to hold both 0 and 255, so that all ranges correspond.
                const double wave = 0.5 + 0.5 * std::sin(0.7 * i) * std::cos(0.5 * j) * std::sin(0.6 * k + 0.3);
                const int byte = i + j + k == 0 ? 0 : i + j + k == 1 ? 255 : int(std::lround(255.0 * wave));
                samples.push_back(of_byte(byte));
            }
        }
    }
    auto grid = std::make_shared<scene::VolumeGrid>();
    grid->name = "typed";
    grid->size = size;
    grid->spacing = glm::dvec3(0.05);
    grid->type = type;
    grid->voxels.resize(samples.size() * sizeof(T));
    std::memcpy(grid->voxels.data(), samples.data(), grid->voxels.size());
    scene::finish_grid(*grid);
    return grid;
}

TEST_F(Drawing, EveryTypeOfVoxelGivesThePictureOfBytes) {
    const glm::ivec3 size(19, 16, 13);
    using scene::VoxelType;
    const auto floats = [&](double factor, double offset) {
        return typed<float>(VoxelType::float32, size, [=](int b) { return float(factor * b + offset); });
    };
    struct Case {
        const char* name;
        std::shared_ptr<const scene::VolumeGrid> grid;
    };
    const auto bytes = typed<std::uint8_t>(VoxelType::uint8, size, [](int b) { return std::uint8_t(b); });
    const std::vector<Case> cases{
        {"int8", typed<std::int8_t>(VoxelType::int8, size, [](int b) { return std::int8_t(b - 128); })},
        {"uint16", typed<std::uint16_t>(VoxelType::uint16, size, [](int b) { return std::uint16_t(257 * b); })},
        {"uint16 in a narrow range",
         typed<std::uint16_t>(VoxelType::uint16, size, [](int b) { return std::uint16_t(1000 + 3 * b); })},
        {"int16", typed<std::int16_t>(VoxelType::int16, size, [](int b) { return std::int16_t(100 * b - 12000); })},
        {"float32", floats(1.0 / 255.0, 0.0)},
        {"float32 up to 1e30", floats(1e30 / 255.0, 0.0)},
        {"float32 up to 1e-30", floats(1e-30 / 255.0, 0.0)},
        {"float32 around 1e6", floats(1.0, 1e6)},
        {"float32 below 0", floats(0.01, -7.0)},
    };
    for (const bool with_lamps : {false, true}) {
        for (const Classification classification : both_classifications) {
            const auto picture = [&](const std::shared_ptr<const scene::VolumeGrid>& grid) {
                scene::Scene scene = scene_with(grid, rich_transfer_function(0.1));
                // No jump in the curves: a value that rounding moves across it would change the picture at will.
                volume_in(scene).transfer_function.edit([](scene::TransferFunction& tf) {
                    tf.opacity = {{0.2, 0.0}, {0.4, 0.4}, {0.6, 0.05}, {0.9, 0.8}};
                });
                scene.camera = oblique_camera(scene);
                if (with_lamps) {
                    scene.lights["key"] = scene::Light{};
                    volume_in(scene).optics.edit([](scene::VolumeOptics& optics) { lit(optics); });
                }
                settle(scene, classification, 0.5, false);  // last bits may turn a half into eighths
                return draw(scene, {32, 32});
            };
            const Image expected = picture(bytes);
            for (const Case& c : cases) {
                const double difference = largest_difference(picture(c.grid), expected);
                report(std::string(c.name) + (with_lamps ? ", lit, " : ", unlit, ") + name_of(classification),
                       difference);
                // Texels differ by rounding of the affine map, some 1e-7 of the range: measured up to 2.6e-6. Lit ones
                // also hold gradients rounded to 16 bits instead of exact ones: measured up to 4.4e-5.
                EXPECT_LE(difference, with_lamps ? 1e-4 : 8e-6) << c.name;
            }
        }
    }
}

}  // namespace
}  // namespace bruma::render
