#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "base/revision.h"
#include "gl/program.h"

namespace bruma::gl {

/// Compiled programs by name and definitions, made when first asked for. A scene without clouds asks for no cloud
/// shader, so none is compiled.
class ShaderLibrary {
  public:
    explicit ShaderLibrary(std::filesystem::path root) : root_(std::move(root)) {}

    /// The program of a compute shader (.comp), or of a fragment shader (.frag) with the vertex shader of its name, or
    /// with `full_screen.vert` where there is none.
    Program& get(const std::string& file, const Defines& defines = {});

    /// Looks at the files' times; after a save recompiles what was compiled. Returns whether programs changed. When a
    /// new text does not compile, the old program stays, the log says why, and the message is kept in `last_fault`.
    bool reload_if_saved();
    const std::string& last_fault() const { return last_fault_; }

    /// Newer after each reload: an input of every pass that draws.
    Revision revision() const { return revision_; }
    std::size_t compiled_count() const { return programs_.size(); }
    /// Names of all programs compiled so far, with their definitions.
    std::vector<std::string> compiled_names() const;

  private:
    struct Key {
        std::string file;
        Defines defines;
        auto operator<=>(const Key&) const = default;  // NOLINT(modernize-use-nullptr): it stumbles over '<=>'
    };
    Program build(const Key& key) const;
    std::filesystem::file_time_type newest_file() const;

    std::filesystem::path root_;
    std::map<Key, Program> programs_;
    Revision revision_ = next_revision();
    std::filesystem::file_time_type seen_ = std::filesystem::file_time_type::min();
    std::string last_fault_;
};

}  // namespace bruma::gl
