// Shelf: closed form. Meshes that broke other programs: each is loaded into sound triangles, or refused in one
// sentence.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "io/mesh/mesh_source.h"
#include "io_temporary_folder.h"

namespace bruma::io {
namespace {

std::vector<std::filesystem::path> obj_files(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.path().extension() == ".obj") {
            files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

void expect_sound(const scene::TriangleMesh& mesh, const std::string& file) {
    EXPECT_FALSE(mesh.triangles.empty()) << file;
    EXPECT_EQ(mesh.normals.size(), mesh.positions.size()) << file;
    EXPECT_EQ(mesh.triangle_materials.size(), mesh.triangles.size()) << file;
    for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
        const glm::vec3 p = mesh.positions[n];
        EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) << file;
        EXPECT_NEAR(glm::length(mesh.normals[n]), 1.0, 1e-5) << file;  // rounded to floats
    }
    for (const glm::uvec3& t : mesh.triangles) {
        EXPECT_LT(std::max({t.x, t.y, t.z}), mesh.positions.size()) << file;
    }
    for (const std::uint32_t material : mesh.triangle_materials) {
        EXPECT_LT(material, mesh.materials.size()) << file;
    }
}

/// One line for people that names the file, says what was found and what to do.
bool is_clear_sentence(const std::string& text, const std::filesystem::path& file) {
    return text.starts_with(file.string() + ": ") && !contains(text, "\n") && text.size() < file.string().size() + 300;
}

TEST(NastyMeshes, LoadOrAreRefusedInOneSentence) {
    const auto data = data_folder();
    if (!data || !std::filesystem::is_directory(*data / "nasty")) {
        GTEST_SKIP() << "BRUMA_DATA names no folder that holds 'nasty'; set it to one to try meshes that broke others";
    }
    std::size_t loaded = 0, refused = 0;
    for (const std::filesystem::path& file : obj_files(*data / "nasty")) {
        scene::MeshSource source;
        source.file = file.string();
        scene::LoadedMesh mesh;
        const std::string sentence = refusal([&] { mesh = load_mesh(source, {}); });
        if (sentence.empty()) {
            expect_sound(*mesh.mesh, file.string());
            for (const std::string& remark : mesh.remarks) {
                EXPECT_FALSE(contains(remark, "\n")) << remark;
            }
            ++loaded;
        } else {
            EXPECT_TRUE(is_clear_sentence(sentence, file)) << sentence;
            EXPECT_TRUE(contains(sentence, "; ")) << "no next step: " << sentence;
            ++refused;
        }
    }
    EXPECT_GT(loaded, 0U);
    std::printf("    %zu meshes loaded, %zu refused\n", loaded, refused);
}

}  // namespace
}  // namespace bruma::io
