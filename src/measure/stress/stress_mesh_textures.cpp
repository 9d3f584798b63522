#include <stdexcept>

#include "io/mesh/mesh_source.h"
#include "io/mesh/mesh_texture.h"
#include "measure/stress/stress_mesh.h"
#include "measure/stress/stress_mesh_folder.h"

namespace bruma::measure {
namespace {

std::string big_endian(std::uint32_t value) {
    return {char(value >> 24), char(value >> 16), char(value >> 8), char(value)};
}

/// A chunk whose checksum is left 0: the decoder does not look at it.
std::string chunk(const std::string& type, const std::string& content) {
    return big_endian(std::uint32_t(content.size())) + type + content + std::string(4, '\0');
}

constexpr int grey = 0, rgb = 2, palette = 3, rgba = 6;

/// A PNG of 4 x 4 noise, or with another size at its head than it holds. Rows are stored, that is uncompressed.
std::string png(int bits, int color_type, std::uint32_t width = 4, std::uint32_t height = 4) {
    const int channels = color_type == rgb ? 3 : color_type == rgba ? 4 : 1;
    std::string rows;
    for (int y = 0; y < 4; ++y) {
        rows += '\0';  // no filter
        for (int n = 0; n < (4 * channels * bits + 7) / 8; ++n) {
            const auto value = unsigned(255.0 * stress_noise(16 * std::size_t(y) + std::size_t(n)));
            rows += char(color_type == palette && bits == 8 ? value & 3U : value);
        }
    }
    const auto length = std::uint32_t(rows.size());
    const std::string stored = std::string("\x78\x01\x01", 3) + char(length & 255U) + char(length >> 8) +
                               char(~length & 255U) + char((~length >> 8) & 255U) + rows + std::string(4, '\0');
    const std::string colors("\xff\x00\x00\x00\xff\x00\x20\x40\xff\xff\xff\xff", 12);
    return "\x89PNG\r\n\x1a\n" +
           chunk("IHDR",
                 big_endian(width) + big_endian(height) + char(bits) + char(color_type) + std::string(3, '\0')) +
           (color_type == palette ? chunk("PLTE", colors) : "") + chunk("IDAT", stored) + chunk("IEND", "");
}

const std::string square = "mtllib a.mtl\nv 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nvt 0 0\nvt 3 0\nvt 3 3\nvt 0 3\n";

}  // namespace

void stress_mesh_textures(MeshCases& cases) {
    const StressFolder folder;
    folder.write("a.mtl", "newmtl paint\nKd 1 1 1\nmap_Kd t.png\n");
    const auto mesh = folder.write("a.obj", square + "usemtl paint\nf 1/1 2/2 3/3 4/4\n");
    const auto painted = [&](const std::filesystem::path& obj) {
        scene::MeshSource source;
        source.file = obj.string();
        source.millimetres_per_unit = 1.0;
        return mesh_scene(io::load_mesh(source, {}).mesh);
    };
    struct Good {
        const char* name;
        int bits, color_type;
    };
    const Good goods[] = {{"grey-8", 8, grey},      {"grey-1", 1, grey},       {"grey-16", 16, grey},
                          {"rgb-8", 8, rgb},        {"rgb-16", 16, rgb},       {"rgba-8", 8, rgba},
                          {"rgba-16", 16, rgba},    {"palette-8", 8, palette}, {"palette-2", 2, palette},
                          {"palette-1", 1, palette}};
    for (const Good& good : goods) {
        cases.sound(good.name, "a PNG of this kind", [&] {
            const auto path = folder.write("t.png", png(good.bits, good.color_type));
            if (io::load_texture(path)->bits != (good.bits == 16 ? 16 : 8)) {
                throw std::runtime_error("its depth was lost");
            }
            return painted(mesh);
        });
    }
    const std::string whole = png(8, rgb);
    struct Bad {
        const char *name, *what;
        std::string bytes;
    };
    const Bad bads[] = {{"empty", "no byte at all", ""},
                        {"no-picture", "words", "this is no picture"},
                        {"cut-in-head", "a PNG that ends in its head", whole.substr(0, 20)},
                        {"cut-in-rows", "a PNG that ends in its rows", whole.substr(0, 70)},
                        {"size-0", "a PNG of 0 x 4", png(8, rgb, 0, 4)},
                        {"too-wide", "wider than any machine takes", png(8, rgb, 16385, 4)},
                        {"too-high", "higher than any machine takes", png(8, rgb, 4, 1U << 24)},
                        {"bomb", "a small file that says 16384 x 16384", png(16, rgba, 16384, 16384)},
                        {"bits-3", "a PNG of three bits", png(3, grey)}};
    for (const Bad& bad : bads) {
        const auto write = [&, &bytes = bad.bytes] { return folder.write("t.png", bytes); };
        cases.refused(bad.name, bad.what, [&] { io::load_texture(write()); });
        cases.sound(std::string(bad.name) + "-drawn", "a mesh that goes without this picture", [&] {
            write();
            return painted(mesh);
        });
    }
    cases.refused("missing", "a picture that is not there", [&] { io::load_texture(folder.path() / "gone.png"); });
    cases.refused("folder", "a folder", [&] { io::load_texture(folder.path()); });
    cases.sound("coordinates", "texture coordinates that are no numbers, or 1e300, or missing", [&] {
        folder.write("t.png", whole);
        return painted(
            folder.write("b.obj", square + "vt nan 1e300\nvt 1e300 -1e300\nusemtl paint\nf 1/5 2/6 3/3 4\n"));
    });
}

}  // namespace bruma::measure
