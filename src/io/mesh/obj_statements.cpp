#include "io/mesh/obj_statements.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "io/blanks.h"

namespace bruma::io {
namespace {

/// A group of statements of the published format (Alias|Wavefront, "File Formats" 4.2, 1995, Appendix B), or of later
/// programs.
struct Family {
    std::string_view words;     ///< each between blanks
    std::string_view keywords;  ///< each between blanks
};
constexpr std::array<Family, 11> families{{
    {"lines", " l "},
    {"points", " p "},
    {"free-form curves and surfaces",
     " vp cstype deg bmat step curv curv2 surf parm trim hole scrv sp end con bsp bzp cdc cdp res "},
    {"smoothing groups, where edges are smoothed by their angle", " s "},
    {"settings of display and rendering", " bevel c_interp d_interp lod shadow_obj trace_obj ctech stech mg "},
    {"textures told in the mesh itself", " maplib usemap "},
    {"other files and commands", " call csh "},
    {"tags of subdivision surfaces", " t "},
    {"weights of bones", " vw "},
    {"faces in their old spelling", " fo "},
    {"colours painted on vertices", " #MRGB "},
}};

bool is_in(std::string_view keyword, std::string_view list) {
    return list.find(fmt::format(" {} ", keyword)) != std::string_view::npos;
}

}  // namespace

void ObjStatements::add(std::string_view line) {
    line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
    const std::string_view keyword = line.substr(0, line.find_first_of(blanks));
    if (keyword.empty() || keyword == "g" || keyword == "o" || (keyword.front() == '#' && keyword != "#MRGB")) {
        return;
    }
    if (keyword == "s") {
        // Off is what holds without such a line.
        const std::string_view group = line.substr(std::min(line.find_first_not_of(blanks, 1), line.size()));
        const std::string_view word = group.substr(0, group.find_first_of(blanks));
        if (word.empty() || word == "off" || word == "0") {
            return;
        }
    }
    constexpr std::size_t most = 20;
    seen_.add(std::string(keyword.substr(0, most)));
}

std::string ObjStatements::remark(bool has_normals) const {
    std::string text;
    std::vector<ToldLosses::Kind> left = seen_.kinds();
    const auto say = [&](std::string_view words, std::string_view keywords) {
        constexpr std::size_t most = 20;
        std::string list;
        std::size_t named = 0;
        for (const ToldLosses::Kind& kind : left) {
            if (keywords.empty() || is_in(kind.name, keywords)) {
                list += named < most ? fmt::format("{}{} {}", named == 0 ? "" : ", ", kind.name, kind.count) : "";
                ++named;
            }
        }
        list += named > most ? fmt::format(" and {} more kinds", named - most) : "";
        std::erase_if(left, [&](const ToldLosses::Kind& kind) { return is_in(kind.name, keywords); });
        if (named > 0) {
            text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", words, list);
        }
    };
    if (has_normals) {
        std::erase_if(left, [](const ToldLosses::Kind& kind) { return kind.name == "s"; });
    }
    for (const Family& family : families) {
        say(family.words, family.keywords);
    }
    say("unknown statements", "");
    return text;
}

}  // namespace bruma::io
