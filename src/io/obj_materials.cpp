#include "io/obj_materials.h"

#include <fmt/core.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/error.h"
#include "io/input_file.h"
#include "io/mesh_texture.h"

namespace bruma::io {
namespace {

namespace fs = std::filesystem;

std::string trimmed(const std::string& text) {
    const std::size_t from = text.find_first_not_of(" \t\r");
    return from == std::string::npos ? "" : text.substr(from, text.find_last_not_of(" \t\r") - from + 1);
}

/// The names in a line, parted at blanks that have no backslash before them.
std::vector<std::string> split_names(const std::string& line) {
    std::vector<std::string> names(1);
    for (std::size_t n = 0; n < line.size(); ++n) {
        const bool escaped = line[n] == '\\' && n + 1 < line.size() && line[n + 1] == ' ';
        if (escaped) {
            ++n;
        }
        if (!escaped && (line[n] == ' ' || line[n] == '\t')) {
            names.emplace_back();
        } else {
            names.back() += line[n];
        }
    }
    std::erase(names, "");
    return names;
}

/// A path as written on any system, seen from a folder.
fs::path beside(const fs::path& folder, std::string name) {
    std::replace(name.begin(), name.end(), '\\', '/');
    const fs::path path(name);
    return path.is_absolute() ? path : folder / path;
}

bool is_file(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

double within(double value, double low, double high) {
    return std::isfinite(value) ? std::clamp(value, low, high) : low;
}
glm::dvec3 reflectance(const tinyobj::real_t* color) {
    return {within(color[0], 0.0, 1.0), within(color[1], 0.0, 1.0), within(color[2], 0.0, 1.0)};
}

/// Textures by path, each read once; null for one that cannot be read.
using Textures = std::map<fs::path, std::shared_ptr<const scene::MeshTexture>>;

class LibraryReader {
  public:
    LibraryReader(ObjMaterials& into, Textures& textures) : into_(into), textures_(textures) {}

    void read(const fs::path& file) {
        std::istringstream stream;
        try {
            constexpr std::int64_t most_bytes = 64 << 20;
            stream.str(read_text_file(file, most_bytes));
        } catch (const InputError& error) {
            into_.remarks.emplace_back(error.what());
            return;
        }
        std::map<std::string, int> unused;
        std::vector<tinyobj::material_t> found;
        std::string warning;
        std::string fault;
        tinyobj::LoadMtl(&unused, &found, &stream, &warning, &fault);
        std::size_t usable = 0;
        for (const tinyobj::material_t& material : found) {
            usable += add(file, material) ? 1 : 0;
        }
        if (usable == 0) {
            into_.remarks.push_back(
                fmt::format("{}: describes no material; is it a Wavefront material library?", file.string()));
        }
    }

  private:
    bool add(const fs::path& file, const tinyobj::material_t& from) {
        const std::string name = trimmed(from.name);
        if (name.empty() || into_.index_of.contains(name)) {
            return !name.empty();
        }
        scene::MeshMaterial material;
        material.name = name;
        material.diffuse = reflectance(from.diffuse);
        material.specular = reflectance(from.specular);
        material.shininess = within(double(from.shininess), 1.0, 1000.0);
        if (const std::string texture = trimmed(from.diffuse_texname); !texture.empty()) {
            material.diffuse_texture = texture_of(beside(file.parent_path(), texture), file, name);
        }
        into_.index_of.emplace(name, std::uint32_t(into_.materials.size()));
        into_.materials.push_back(std::move(material));
        return true;
    }

    std::shared_ptr<const scene::MeshTexture> texture_of(const fs::path& path, const fs::path& library,
                                                         const std::string& material) {
        const auto [found, is_new] = textures_.try_emplace(path);
        if (is_new) {
            try {
                found->second = load_texture(path);
            } catch (const InputError& error) {
                into_.remarks.push_back(fmt::format("{}: material '{}' goes without its texture: {}", library.string(),
                                                    material, error.what()));
            }
        }
        return found->second;
    }

    ObjMaterials& into_;
    Textures& textures_;
};

}  // namespace

ObjMaterials read_obj_materials(const fs::path& obj_file, const std::vector<std::string>& libraries) {
    ObjMaterials result;
    Textures textures;
    LibraryReader reader(result, textures);
    std::vector<fs::path> seen;
    for (const std::string& line : libraries) {
        // Many programs write names with blanks as they are.
        const fs::path whole = beside(obj_file.parent_path(), line);
        std::vector<fs::path> files;
        if (is_file(whole)) {
            files.push_back(whole);
        } else {
            for (const std::string& name : split_names(line)) {
                files.push_back(beside(obj_file.parent_path(), name));
            }
        }
        for (const fs::path& file : files) {
            if (std::find(seen.begin(), seen.end(), file) != seen.end()) {
                continue;
            }
            seen.push_back(file);
            if (is_file(file)) {
                reader.read(file);
            } else {
                result.remarks.push_back(fmt::format(
                    "{}: its material library {} does not exist; parts without a material get the default one",
                    obj_file.string(), file.string()));
            }
        }
    }
    return result;
}

}  // namespace bruma::io
