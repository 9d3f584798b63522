#include "io/mesh_texture.h"

#include <fmt/core.h>
#include <stb/stb_image.h>

#include <cstring>

#include "base/error.h"
#include "io/input_file.h"
#include "io/raw_volume.h"

namespace bruma::io {
namespace {

[[noreturn]] void throw_broken(const std::filesystem::path& path) {
    const char* reason = stbi_failure_reason();
    throw InputError(fmt::format("{}: broken or unknown picture ({}); textures may be .png, .jpg, .bmp or .tga",
                                 path.string(), reason != nullptr ? reason : "no reason given"));
}

}  // namespace

std::shared_ptr<const scene::MeshTexture> load_texture(const std::filesystem::path& path) {
    constexpr std::int64_t most_bytes = (std::int64_t(1) << 31) - 1;  // stb counts bytes in an int
    const std::string bytes = read_text_file(path, most_bytes);
    const auto* memory = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int length = int(bytes.size());
    int width = 0;
    int height = 0;
    int channels = 0;
    // The size stands at the head: a picture that is too large is refused before it is unpacked.
    if (stbi_info_from_memory(memory, length, &width, &height, &channels) == 0) {
        throw_broken(path);
    }
    if (width > most_texture_texels || height > most_texture_texels) {
        throw InputError(fmt::format("{}: {} x {} texels, but a texture has at most {} along each side; scale it down",
                                     path.string(), width, height, most_texture_texels));
    }
    const bool is_deep = stbi_is_16_bit_from_memory(memory, length) != 0;
    const std::size_t needed = std::size_t(width) * std::size_t(height) * (is_deep ? 8 : 4);
    if (2 * needed > available_memory()) {
        throw InputError(fmt::format("{}: {} x {} texels need {} MiB of memory, but {} MiB are free; scale it down",
                                     path.string(), width, height, needed >> 19, available_memory() >> 20));
    }
    void* const pixels =
        is_deep ? static_cast<void*>(stbi_load_16_from_memory(memory, length, &width, &height, &channels, 4))
                : static_cast<void*>(stbi_load_from_memory(memory, length, &width, &height, &channels, 4));
    if (pixels == nullptr) {
        throw_broken(path);
    }
    auto texture = std::make_shared<scene::MeshTexture>();
    texture->file = path.string();
    texture->width = width;
    texture->height = height;
    texture->bits = is_deep ? 16 : 8;
    texture->texels.resize(needed);
    std::memcpy(texture->texels.data(), pixels, needed);
    stbi_image_free(pixels);
    return texture;
}

}  // namespace bruma::io
