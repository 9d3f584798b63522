#include "io/mesh/mtl_material.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace bruma::io {
namespace {

/// A statement that is not drawn.
struct Undrawn {
    std::string_view keyword, meaning;
    double harmless = -1.0;  ///< a value of all its numbers that asks for nothing; negative: none
};
constexpr std::array<Undrawn, 36> undrawn{{
    {"bump", "bump map"},
    {"map_Bump", "bump map"},
    {"norm", "normal map"},
    {"disp", "displacement map"},
    {"map_disp", "displacement map"},
    {"decal", "decal"},
    {"map_decal", "decal"},
    {"refl", "reflection map"},
    {"map_refl", "reflection map"},
    {"map_Ka", "map of ambient light"},
    {"map_Ks", "map of the highlight"},
    {"map_Ns", "map of the highlight's exponent"},
    {"map_d", "opacity map"},
    {"map_Tr", "opacity map"},
    {"map_opacity", "opacity map"},
    {"map_aat", "anti-aliasing of textures"},
    {"sharpness", "sharpness of reflections"},
    {"Pr", "roughness"},
    {"Pm", "metal", 0.0},
    {"Ps", "sheen", 0.0},
    {"Pc", "clear coat", 0.0},
    {"Pcr", "roughness of the clear coat", 0.0},
    {"aniso", "anisotropy", 0.0},
    {"anisor", "direction of anisotropy", 0.0},
    {"Kt", "transmission", 0.0},
    {"Km", "reflectance of mirrors", 0.0},
    {"map_Pr", "roughness map"},
    {"map_Pm", "metal map"},
    {"map_Ps", "sheen map"},
    {"map_Pc", "clear coat map"},
    {"map_Pcr", "map of the clear coat's roughness"},
    {"map_aniso", "anisotropy map"},
    {"map_anisor", "map of anisotropy's direction"},
    {"map_Ke", "map of light of its own"},
    {"map_RMA", "map of roughness, metal and occlusion"},
    {"map_ORM", "map of occlusion, roughness and metal"},
}};

/// Linear Rec.709 of CIE 1931 tristimulus values; IEC 61966-2-1.
glm::dvec3 rec709_of_xyz(const glm::dvec3& xyz) {
    return {3.2406 * xyz.x - 1.5372 * xyz.y - 0.4986 * xyz.z, -0.9689 * xyz.x + 1.8758 * xyz.y + 0.0415 * xyz.z,
            0.0557 * xyz.x - 0.2040 * xyz.y + 1.0570 * xyz.z};
}

class MtlReader {
  public:
    MtlReader(const MtlEntry& entry, MtlFindings& findings) : entry_(entry), findings_(findings) {
        result_.material.name = entry.name;
    }

    MtlMaterial read() {
        for (const MtlStatement& statement : entry_.statements) {
            take(statement);
        }
        settle_colors();
        settle_opacity();
        settle_refraction();
        for (const std::string& kind : lost_) {
            findings_.losses.add(kind);
        }
        findings_.limited += is_limited_ ? 1 : 0;
        return std::move(result_);
    }

  private:
    void lose(const std::string& kind) {
        if (std::find(lost_.begin(), lost_.end(), kind) == lost_.end()) {
            lost_.push_back(kind);
        }
    }

    static std::string cited(const MtlStatement& statement) {
        constexpr std::size_t most = 60;
        const std::string text = statement.keyword + " " + statement.arguments;
        return fmt::format("line {}, '{}'", statement.line, text.size() > most ? text.substr(0, most) + "..." : text);
    }

    void say_unread(const MtlStatement& statement) {
        if (findings_.unread++ == 0) {
            findings_.first_unread = cited(statement);
        }
    }

    std::vector<double> numbers_of(const MtlStatement& statement, std::string_view text) {
        const MtlNumbers numbers = read_mtl_numbers(without_comment(text));
        if (numbers.decimal_commas && findings_.first_decimal_comma.empty()) {
            findings_.first_decimal_comma = cited(statement);
        }
        const auto is_finite = [](double value) { return std::isfinite(value); };
        if (numbers.values.empty() || !numbers.complete ||
            !std::all_of(numbers.values.begin(), numbers.values.end(), is_finite)) {
            say_unread(statement);
        }
        return numbers.values;
    }

    std::optional<double> number_of(const MtlStatement& statement, std::string_view text) {
        const std::vector<double> values = numbers_of(statement, text);
        return values.empty() || !std::isfinite(values.front()) ? std::nullopt : std::optional(values.front());
    }

    /// Three values of which the last ones may be left away; what is no finite number is 0.
    std::optional<glm::dvec3> triple_of(const MtlStatement& statement, std::string_view text) {
        const std::vector<double> values = numbers_of(statement, text);
        if (values.empty()) {
            return std::nullopt;
        }
        glm::dvec3 triple(values[0], values.size() > 1 ? values[1] : values[0],
                          values.size() > 2 ? values[2] : values[0]);
        for (int n = 0; n < 3; ++n) {
            triple[n] = std::isfinite(triple[n]) ? triple[n] : 0.0;
        }
        return triple;
    }

    std::optional<glm::dvec3> color_of(const MtlStatement& statement) {
        const std::string_view text = statement.arguments;
        const std::string_view word = text.substr(0, std::min(text.find_first_of(" \t"), text.size()));
        const std::string_view rest = text.substr(word.size());
        if (is_same_keyword(word, "xyz")) {
            const auto xyz = triple_of(statement, rest);
            return xyz ? std::optional(rec709_of_xyz(*xyz)) : std::nullopt;
        }
        if (!is_same_keyword(word, "spectral")) {
            return triple_of(statement, text);
        }
        // `ident` is the format's name for a curve that is 1 everywhere.
        std::string_view file = without_comment(rest);
        const std::string_view name = file.substr(0, std::min(file.find_first_of(" \t"), file.size()));
        if (is_same_keyword(name, "ident.rfl") || is_same_keyword(name, "ident")) {
            file.remove_prefix(name.size());
            const auto factor = file.empty() ? std::optional(1.0) : number_of(statement, file);
            return glm::dvec3(factor.value_or(1.0));
        }
        lose(fmt::format("{} spectral (a curve in a .rfl file)", statement.keyword));
        return std::nullopt;
    }

    glm::dvec3 limited(const glm::dvec3& color, double most) {
        const glm::dvec3 within = glm::clamp(color, 0.0, most);
        is_limited_ = is_limited_ || within != color;
        return within;
    }

    void take(const MtlStatement& statement) {
        const auto is = [&](std::string_view keyword) { return is_same_keyword(statement.keyword, keyword); };
        if (is("Kd")) {
            diffuse_ = color_of(statement);
        } else if (is("Ks")) {
            specular_ = color_of(statement);
        } else if (is("Ka")) {
            ambient_ = color_of(statement);
        } else if (is("Ke")) {
            emission_ = color_of(statement);
        } else if (is("Tf")) {
            filter_ = color_of(statement);
        } else if (is("Ns")) {
            exponent_ = number_of(statement, statement.arguments);
        } else if (is("Ni")) {
            refraction_index_ = number_of(statement, statement.arguments);
        } else if (is("illum")) {
            illumination_ = number_of(statement, statement.arguments);
        } else if (is("d")) {
            std::string_view text = statement.arguments;
            if (text.starts_with("-halo")) {
                text.remove_prefix(5);
                lose("d -halo (opacity at grazing angles)");
            }
            dissolve_ = number_of(statement, text);
        } else if (is("Tr")) {
            transparency_ = number_of(statement, statement.arguments);
        } else if (is("map_Kd")) {
            take_diffuse_map(statement);
        } else {
            take_undrawn(statement);
        }
    }

    void take_diffuse_map(const MtlStatement& statement) {
        result_.diffuse_map = read_mtl_map(statement.arguments);
        result_.material.placement = result_.diffuse_map->placement;
        for (const std::string& option : result_.diffuse_map->unused_options) {
            lose("map_Kd " + option + " (option of the texture)");
        }
        if (result_.diffuse_map->names.empty()) {
            say_unread(statement);
        }
    }

    void take_undrawn(const MtlStatement& statement) {
        const auto* const known = std::find_if(undrawn.begin(), undrawn.end(), [&](const Undrawn& u) {
            return is_same_keyword(u.keyword, statement.keyword);
        });
        if (known == undrawn.end()) {
            lose(fmt::format("{} (unknown)", statement.keyword.substr(0, 20)));
            return;
        }
        const MtlNumbers numbers = read_mtl_numbers(without_comment(statement.arguments));
        const bool is_harmless =
            known->harmless >= 0.0 && numbers.complete && !numbers.values.empty() &&
            std::all_of(numbers.values.begin(), numbers.values.end(), [&](double v) { return v == known->harmless; });
        if (!is_harmless) {
            lose(fmt::format("{} ({})", known->keyword, known->meaning));
        }
        has_glow_map_ = has_glow_map_ || known->keyword == "map_Ke";
    }

    void settle_colors() {
        scene::MeshMaterial& material = result_.material;
        const double illumination = illumination_.value_or(2.0);
        const bool has_texture = result_.diffuse_map && !result_.diffuse_map->names.empty();
        material.diffuse = diffuse_ ? limited(*diffuse_, 1.0) : has_texture ? glm::dvec3(1.0) : material.diffuse;
        material.constant = illumination == 0.0;
        const glm::dvec3 specular = limited(specular_.value_or(glm::dvec3(0.0)), 1.0);
        const bool has_highlight = illumination != 0.0 && illumination != 1.0 && specular != glm::dvec3(0.0);
        const double exponent = exponent_.value_or(0.0);
        if (has_highlight && exponent > 0.0) {
            constexpr double sharpest = 1000.0;  // where the format's range ends
            material.specular = specular;
            material.shininess = std::min(exponent, sharpest);
            is_limited_ = is_limited_ || exponent > sharpest;
        } else if (has_highlight) {
            lose("Ks without an exponent Ns above 0 (no highlight)");
        }
        if (ambient_ && *ambient_ != glm::dvec3(0.0) && *ambient_ != diffuse_) {
            lose("Ka (ambient light: Kd reflects it)");
        }
        if (emission_ && *emission_ != glm::dvec3(0.0) && !has_glow_map_) {
            constexpr double brightest = 1e6;
            material.emission = limited(*emission_, brightest);
            lose("Ke (light of its own: it lights nothing else)");
        } else if (emission_ && *emission_ != glm::dvec3(0.0)) {
            lose("Ke (light of its own)");
        }
        if (illumination_ && (illumination < 0.0 || illumination > 10.0 || illumination != std::floor(illumination))) {
            lose(fmt::format("illum {:g} (unknown: drawn as 2)", illumination));
        } else if (illumination == 10.0) {
            lose("illum 10 (an invisible surface in shadows: drawn as 2)");
        } else if (illumination > 2.0) {
            lose(fmt::format("illum {:g} (reflection or refraction: drawn as 2)", illumination));
        }
    }

    void settle_opacity() {
        // `d` is the published statement; Tr, an extension, is 1 - d.
        if (dissolve_ && *dissolve_ < 1.0) {
            lose("d (opacity: drawn opaque)");
        } else if (!dissolve_ && transparency_ && *transparency_ > 0.0) {
            lose("Tr (transparency: drawn opaque)");
        }
    }

    void settle_refraction() {
        // The models up to 3 know neither, as the format defines them.
        const bool may_refract = !illumination_ || *illumination_ > 3.0;
        if (may_refract && refraction_index_ && *refraction_index_ != 1.0) {
            lose("Ni (index of refraction)");
        }
        if (may_refract && filter_ && *filter_ != glm::dvec3(0.0) && *filter_ != glm::dvec3(1.0)) {
            lose("Tf (filter of what shines through)");
        }
    }

    const MtlEntry& entry_;
    MtlFindings& findings_;
    MtlMaterial result_;
    std::vector<std::string> lost_;
    std::optional<glm::dvec3> diffuse_, specular_, ambient_, emission_, filter_;
    std::optional<double> exponent_, refraction_index_, illumination_, dissolve_, transparency_;
    bool has_glow_map_ = false;
    bool is_limited_ = false;
};

}  // namespace

MtlMaterial read_mtl_material(const MtlEntry& entry, MtlFindings& findings) {
    return MtlReader(entry, findings).read();
}

std::vector<std::string> remarks_of(const MtlFindings& findings) {
    std::vector<std::string> remarks;
    if (!findings.losses.empty()) {
        constexpr std::size_t most = 20;
        const std::vector<ToldLosses::Kind>& kinds = findings.losses.kinds();
        std::string list;
        for (std::size_t n = 0; n < std::min(most, kinds.size()); ++n) {
            list += fmt::format("{}{} of {} material{}", n == 0 ? "" : ", ", kinds[n].name, kinds[n].count,
                                kinds[n].count == 1 ? "" : "s");
        }
        list += kinds.size() > most ? fmt::format(" and {} more kinds", kinds.size() - most) : "";
        remarks.push_back("tells more than is drawn: " + list);
    }
    if (findings.unread > 0) {
        remarks.push_back(fmt::format(
            "{} statement{} without the numbers or the name that belong{} there; the first "
            "is {}",
            findings.unread, findings.unread == 1 ? "" : "s", findings.unread == 1 ? "s" : "", findings.first_unread));
    }
    if (!findings.first_decimal_comma.empty()) {
        remarks.push_back(fmt::format("its numbers have decimal commas ({}) and are read so; the format has points",
                                      findings.first_decimal_comma));
    }
    if (findings.limited > 0) {
        remarks.push_back(fmt::format("colours beyond 0 to 1 or exponents beyond 1000 of {} material{} were limited",
                                      findings.limited, findings.limited == 1 ? "" : "s"));
    }
    return remarks;
}

}  // namespace bruma::io
