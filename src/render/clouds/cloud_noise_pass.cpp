#include "render/clouds/cloud_noise_pass.h"

#include <algorithm>
#include <vector>

namespace bruma::render {
namespace {

constexpr int shape_size = 128;
constexpr int detail_size = 32;
constexpr int table_entries = 1025;

gl::Texture made(gl::ShaderLibrary& shaders, bool detail, bool packed) {
    const bool one_channel = detail || packed;
    const int size = detail ? detail_size : shape_size;
    const GLenum format = one_channel ? GL_R16 : GL_RGBA16;
    gl::Texture texture =
        gl::Texture::make_3d(detail ? "cloud detail noise" : "cloud shape noise", format, glm::ivec3(size));
    gl::Defines defines{{"TEXEL_FORMAT", one_channel ? "r16" : "rgba16"}};
    if (one_channel) {
        defines["PACKED"] = "";
    }
    gl::Program& program = shaders.get("clouds/cloud_noise.comp", defines);
    program.use();
    program.set("detail", detail ? 1 : 0);
    glBindImageTexture(0, texture.name(), 0, GL_TRUE, 0, GL_WRITE_ONLY, format);
    const auto groups = GLuint(size) / 8;
    glDispatchCompute(groups, groups, GLuint(size));
    texture.set_repeat();
    return texture;
}

/// One minus the quantiles of the base shape over all texels, from its largest value down.
gl::Texture coverage_table(const gl::Texture& shape, bool packed) {
    const std::size_t texels = std::size_t(shape_size) * shape_size * shape_size;
    std::vector<float> bases(texels);
    if (packed) {
        shape.download({GL_RED, GL_FLOAT}, texels * sizeof(float), bases.data());
    } else {
        std::vector<glm::vec4> noise(texels);
        shape.download({GL_RGBA, GL_FLOAT}, texels * sizeof(glm::vec4), noise.data());
        std::transform(noise.begin(), noise.end(), bases.begin(), [](const glm::vec4& texel) {
            const float octaves = 0.625F * texel.g + 0.25F * texel.b + 0.125F * texel.a;
            return (texel.r - (octaves - 1.0F)) / (2.0F - octaves);
        });
    }
    std::sort(bases.begin(), bases.end(), std::greater<>());
    std::vector<float> entries;
    for (std::size_t n = 0; n < table_entries; ++n) {
        entries.push_back(1.0F - bases[n * (texels - 1) / (table_entries - 1)]);
    }
    gl::Texture table = gl::Texture::make_1d("cloud coverage", GL_R32F, table_entries);
    table.upload({GL_RED, GL_FLOAT}, entries.data());
    return table;
}

}  // namespace

CloudNoisePass::CloudNoisePass(FrameGraph& graph, gl::ShaderLibrary& shaders, scene::NoisePacking packing)
    : graph_(graph), shaders_(shaders), packing_(packing) {
    const std::string name = packing == scene::NoisePacking::packed ? "cloud_noise packed" : "cloud_noise";
    shader_revision_ = graph.add_source<int>("cloud noise shader");
    noise = graph.add_product<CloudNoise>(name);
    pass_ =
        graph.add_pass({name, "tileable noise that clouds are made of", {shader_revision_.index}, {noise.index}, {}});
}

void CloudNoisePass::update(bool with_coverage_table) {
    graph_.set_source(shader_revision_, 0, shaders_.revision());
    graph_.set_parameters(pass_, with_coverage_table);
    graph_.set_execute(pass_,
                       [this, with_coverage_table](const PassAccess& access) { make(access, with_coverage_table); });
}

void CloudNoisePass::remove() {
    graph_.remove_pass(pass_);
    graph_.remove_source(shader_revision_.index);
}

void CloudNoisePass::make(const PassAccess& access, bool with_coverage_table) {
    const bool packed = packing_ == scene::NoisePacking::packed;
    CloudNoise& out = access.write(noise);
    if (!out.shape || made_with_ != graph_.revision(shader_revision_.index)) {
        out.shape = made(shaders_, false, packed);
        out.detail = made(shaders_, true, packed);
        glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
        made_with_ = graph_.revision(shader_revision_.index);
    }
    out.coverage = with_coverage_table ? coverage_table(out.shape, packed) : gl::Texture();
    access.note("128^3 and 32^3 texels");
}

}  // namespace bruma::render
