#include "io/picture/exr.h"

#include <fmt/core.h>
#include <tinyexr.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "base/error.h"

namespace bruma::io {
namespace {

std::string take_message(const char* message) {
    std::string text = message != nullptr ? message : "no reason given";
    if (message != nullptr) {
        FreeEXRErrorMessage(message);
    }
    std::erase(text, '\n');
    return text;
}

}  // namespace

std::vector<std::byte> encode_exr(const std::string& name, const Image& linear, const NamedChannels& extra) {
    const std::size_t pixels = linear.pixel_count();
    NamedChannels channels = extra;
    for (std::size_t c = 0; c < 4; ++c) {
        std::vector<float>& channel = channels[std::string(1, "RGBA"[c])];
        channel.resize(pixels);
        for (std::size_t n = 0; n < pixels; ++n) {
            channel[n] = linear.rgba[4 * n + c];
        }
    }
    // The map is in alphabetical order, which is the order the format asks for.
    std::vector<EXRChannelInfo> infos;
    std::vector<const float*> planes;
    for (const auto& [channel_name, samples] : channels) {
        EXRChannelInfo info{};
        if (channel_name.empty() || channel_name.size() >= sizeof info.name || samples.size() != pixels) {
            throw InputError(
                fmt::format("{}: channel '{}' has {} samples, expected {}, and a name of at most {} letters", name,
                            channel_name, samples.size(), pixels, sizeof info.name - 1));
        }
        std::memcpy(info.name, channel_name.c_str(), channel_name.size() + 1);
        infos.push_back(info);
        planes.push_back(samples.data());
    }
    std::vector<int> types(channels.size(), TINYEXR_PIXELTYPE_FLOAT);
    EXRHeader header;
    InitEXRHeader(&header);
    header.num_channels = int(channels.size());
    header.channels = infos.data();
    header.pixel_types = types.data();
    header.requested_pixel_types = types.data();
    header.compression_type = TINYEXR_COMPRESSIONTYPE_ZIP;
    EXRImage image;
    InitEXRImage(&image);
    image.num_channels = int(channels.size());
    image.width = linear.width;
    image.height = linear.height;
    image.images = reinterpret_cast<unsigned char**>(const_cast<float**>(planes.data()));
    unsigned char* memory = nullptr;
    const char* message = nullptr;
    const std::size_t size = SaveEXRImageToMemory(&image, &header, &memory, &message);
    const std::unique_ptr<unsigned char, void (*)(void*)> owner(memory, std::free);
    if (size == 0) {
        throw InputError(fmt::format("{}: cannot be encoded as OpenEXR ({})", name, take_message(message)));
    }
    const auto* first = reinterpret_cast<const std::byte*>(memory);
    return {first, first + size};
}

}  // namespace bruma::io
