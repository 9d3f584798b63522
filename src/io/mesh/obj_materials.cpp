#include "io/mesh/obj_materials.h"

#include <fmt/core.h>

#include <algorithm>
#include <span>
#include <utility>

#include "base/error.h"
#include "io/input_file.h"
#include "io/mesh/mesh_texture.h"
#include "io/mesh/mtl_material.h"
#include "io/mesh/mtl_text.h"
#include "io/named_file.h"

namespace bruma::io {
namespace {

namespace fs = std::filesystem;

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

std::string listed(const std::vector<std::string>& things, std::string_view quote) {
    constexpr std::size_t most = 3;
    std::string list;
    for (std::size_t n = 0; n < std::min(most, things.size()); ++n) {
        list += fmt::format("{}{}{}{}", n == 0 ? "" : ", ", quote, things[n], quote);
    }
    return things.size() > most ? fmt::format("{} and {} more", list, things.size() - most) : list;
}

void add_new(const std::string& thing, std::vector<std::string>& things) {
    if (std::find(things.begin(), things.end(), thing) == things.end()) {
        things.push_back(thing);
    }
}

std::string plural(std::size_t count) {
    return count == 1 ? "" : "s";
}

/// Textures by path, each read once; null for one that cannot be read.
using Textures = std::map<fs::path, std::shared_ptr<const scene::MeshTexture>>;

bool has_transparent_texels(const scene::MeshTexture& texture) {
    const std::size_t bytes = std::size_t(texture.bits / 8);
    for (std::size_t at = 3 * bytes; at + bytes <= texture.texels.size(); at += 4 * bytes) {
        if (std::any_of(texture.texels.begin() + std::ptrdiff_t(at),
                        texture.texels.begin() + std::ptrdiff_t(at + bytes),
                        [](std::byte byte) { return byte != std::byte(255); })) {
            return true;
        }
    }
    return false;
}

/// Reads one library; `elsewhere` are the folders besides its own in which textures may lie.
class LibraryReader {
  public:
    LibraryReader(ObjMaterials& into, Textures& textures, const fs::path& file, std::span<const fs::path> elsewhere)
        : into_(into), textures_(textures), file_(file), folders_(folders_beside(file)) {
        folders_.insert(folders_.end(), elsewhere.begin(), elsewhere.end());
    }

    void read() {
        std::string text;
        try {
            constexpr std::int64_t most_bytes = 64 << 20;
            text = read_text_file(file_, most_bytes);
        } catch (const InputError& error) {
            into_.remarks.emplace_back(error.what());
            return;
        }
        const MtlText library = split_mtl_text(text);
        if (library.materials.empty()) {
            say("describes no material; is it a Wavefront material library?");
        }
        for (const MtlEntry& entry : library.materials) {
            add(entry);
        }
        for (const std::string& remark : remarks_of(findings_)) {
            say(remark);
        }
        say_what_is_amiss(library);
    }

  private:
    void say(const std::string& sentence) { into_.remarks.push_back(fmt::format("{}: {}", file_.string(), sentence)); }

    void say_what_is_amiss(const MtlText& library) {
        if (library.without_name > 0 && !library.materials.empty()) {
            say(fmt::format("{} material{} without a name left out", library.without_name,
                            plural(library.without_name)));
        }
        if (!repeated_.empty()) {
            say(fmt::format("describes material{} {} more than once; the first one counts", plural(repeated_.size()),
                            listed(repeated_, "'")));
        }
        if (!missing_.empty()) {
            say(fmt::format("material{} {} {} without {}: {}: no such file", plural(materials_without_.size()),
                            listed(materials_without_, "'"), materials_without_.size() == 1 ? "goes" : "go",
                            materials_without_.size() == 1 ? "its texture" : "their textures", listed(missing_, "")));
        }
        if (!found_otherwise_.empty()) {
            say(fmt::format("{} texture{} not where or not spelt as told, and taken from {}", found_otherwise_.size(),
                            found_otherwise_.size() == 1 ? " is" : "s are", listed(found_otherwise_, "")));
        }
        if (!transparent_.empty()) {
            say(fmt::format("{} texture{} with transparent texels, which are drawn opaque: {}", transparent_.size(),
                            plural(transparent_.size()), listed(transparent_, "")));
        }
    }

    void add(const MtlEntry& entry) {
        if (into_.index_of.contains(entry.name)) {
            add_new(entry.name, repeated_);
            return;
        }
        MtlMaterial read = read_mtl_material(entry, findings_);
        if (read.diffuse_map && !read.diffuse_map->names.empty()) {
            read.material.diffuse_texture = texture_of(read.diffuse_map->names, entry.name);
        }
        const auto index = std::uint32_t(into_.materials.size());
        into_.index_of.emplace(entry.name, index);
        into_.index_of.emplace(without_comment(entry.name), index);
        into_.materials.push_back(std::move(read.material));
    }

    NamedFile find(const std::vector<std::string>& names) const {
        for (const auto& look : {find_as_named, find_named_file}) {
            for (const std::string& name : names) {
                if (NamedFile found = look(name, folders_)) {
                    return found;
                }
            }
        }
        return {};
    }

    std::shared_ptr<const scene::MeshTexture> texture_of(const std::vector<std::string>& names,
                                                         const std::string& material) {
        const NamedFile file = find(names);
        if (!file) {
            add_new(material, materials_without_);
            add_new((folders_.front() / path_of_name(names.back())).string(), missing_);
            return nullptr;
        }
        if (!file.is_as_told) {
            add_new(file.path.string(), found_otherwise_);
        }
        std::error_code ignored;
        const fs::path real = fs::weakly_canonical(file.path, ignored);
        const auto [found, is_new] = textures_.try_emplace(real.empty() ? file.path : real);
        if (is_new) {
            try {
                found->second = load_texture(file.path);
                if (has_transparent_texels(*found->second)) {
                    transparent_.push_back(file.path.string());
                }
            } catch (const InputError& error) {
                say(fmt::format("material '{}' goes without its texture: {}", material, error.what()));
            }
        }
        return found->second;
    }

    ObjMaterials& into_;
    Textures& textures_;
    fs::path file_;
    std::vector<fs::path> folders_;
    MtlFindings findings_;
    std::vector<std::string> repeated_, materials_without_, missing_, found_otherwise_, transparent_;
};

/// The libraries that one line names, and the names of which there is no file.
struct NamedLibraries {
    std::vector<NamedFile> found;
    std::vector<std::string> missing;
};

NamedLibraries libraries_of_line(const std::string& line, std::span<const fs::path> folders) {
    // Many programs write names with blanks as they are, and some a comment behind them.
    const std::string name(without_comment(line));
    for (const std::string& whole : {line, name}) {
        if (NamedFile file = find_as_named(whole, folders)) {
            return {{file}, {}};
        }
    }
    NamedLibraries libraries;
    for (const std::string& part : split_names(name)) {
        NamedFile file = find_as_named(part, folders);
        file ? libraries.found.push_back(file) : libraries.missing.push_back(part);
    }
    if (libraries.found.empty()) {
        if (NamedFile file = find_named_file(name, folders)) {
            return {{file}, {}};
        }
    }
    for (std::string& part : std::exchange(libraries.missing, {})) {
        NamedFile file = find_named_file(part, folders);
        file ? libraries.found.push_back(file) : libraries.missing.push_back(std::move(part));
    }
    if (libraries.found.empty() && !name.empty()) {
        libraries.missing = {name};
    }
    return libraries;
}

}  // namespace

const std::uint32_t* ObjMaterials::find(const std::string& name) const {
    for (const std::string& known : {name, std::string(without_comment(name))}) {
        if (const auto found = index_of.find(known); found != index_of.end()) {
            return &found->second;
        }
    }
    return nullptr;
}

ObjMaterials read_obj_materials(const fs::path& obj_file, const std::vector<std::string>& libraries) {
    ObjMaterials result;
    Textures textures;
    const std::vector<fs::path> folders = folders_beside(obj_file);
    std::vector<fs::path> seen;
    for (const std::string& line : libraries) {
        const NamedLibraries named = libraries_of_line(line, folders);
        for (const NamedFile& file : named.found) {
            std::error_code ignored;
            const fs::path real = fs::weakly_canonical(file.path, ignored);
            if (std::find(seen.begin(), seen.end(), real) != seen.end()) {
                continue;
            }
            seen.push_back(real);
            if (!file.is_as_told) {
                result.remarks.push_back(fmt::format("{}: its material library is told as '{}' and taken from {}",
                                                     obj_file.string(), line, file.path.string()));
            }
            LibraryReader(result, textures, file.path, folders).read();
        }
        for (const std::string& name : named.missing) {
            result.remarks.push_back(
                fmt::format("{}: its material library {} does not exist; parts without a material get the default one",
                            obj_file.string(), (folders.front() / path_of_name(name)).string()));
        }
    }
    return result;
}

}  // namespace bruma::io
