#include "io/mesh/mesh_texture.h"

#include <fmt/core.h>

#include "base/error.h"
#include "io/input_file.h"
#include "io/picture/raster_picture.h"

namespace bruma::io {

std::shared_ptr<const scene::MeshTexture> load_texture(const std::filesystem::path& path) {
    const std::string bytes = read_text_file(path, most_picture_bytes);
    const PictureDoor door{
        "textures may be .png, .jpg, .bmp or .tga", [&](int width, int height) {
            if (width > most_texture_texels || height > most_texture_texels) {
                throw InputError(
                    fmt::format("{}: {} x {} texels, but a texture has at most {} along each side; scale it down",
                                path.string(), width, height, most_texture_texels));
            }
        }};
    RasterPicture picture = decode_raster(path.string(), bytes, door);
    auto texture = std::make_shared<scene::MeshTexture>();
    texture->file = path.string();
    texture->width = picture.width;
    texture->height = picture.height;
    texture->bits = picture.bits;
    texture->texels = std::move(picture.rgba);
    return texture;
}

}  // namespace bruma::io
