#include "app/verbs/shader_variants.h"

namespace bruma::app {
namespace {

using Variants = std::vector<gl::Defines>;

/// Each of one list with each of the other; where both say something, the first does.
Variants operator*(const Variants& left, const Variants& right) {
    Variants variants;
    variants.reserve(left.size() * right.size());
    for (const gl::Defines& first : left) {
        for (const gl::Defines& second : right) {
            variants.push_back(first);
            variants.back().insert(second.begin(), second.end());
        }
    }
    return variants;
}

/// One list behind the other.
Variants operator+(Variants left, const Variants& right) {
    left.insert(left.end(), right.begin(), right.end());
    return left;
}

/// These switches, and none of them.
Variants with_and_without(const std::vector<const char*>& names) {
    Variants variants{{}, {}};
    for (const char* const name : names) {
        variants.back()[name] = "";
    }
    return variants;
}

/// Every choice among these switches.
Variants each_or_none(const std::vector<const char*>& names) {
    Variants variants{{}};
    for (const char* const name : names) {
        variants = variants * with_and_without({name});
    }
    return variants;
}

const Variants one_or_two_volumes{{{"VOLUMES", "1"}}, {{"VOLUMES", "2"}}};
const Variants lamps{{{"DIRECTIONAL_LIGHTS", "1"}, {"POINT_LIGHTS", "1"}}};
const Variants sun{{{"DIRECTIONAL_LIGHTS", "1"}, {"POINT_LIGHTS", "0"}}};
const Variants shadows_of_clouds{{{"CLOUD_SHADOWS", "1"}}, {{"CLOUD_SHADOWS", "2"}}};
const Variants shafts = Variants{{}} + Variants{{{"SHAFTS", ""}}} * shadows_of_clouds;
const Variants white_border{{{"BORDER_LIGHT", "vec3(1.0)"}}};

Variants background_variants() {
    const Variants behind_clouds = with_and_without({"OPAQUE"}) * with_and_without({"SKY"}) *
                                   Variants{{{"CLOUDS", "1"}}, {{"CLOUDS", "3"}}} * shafts;
    return each_or_none({"OPAQUE", "SKY"}) + behind_clouds;
}

/// Light of volumes: for surfaces, for scattering media, for both at once.
Variants lit_variants() {
    const Variants lit = lamps * Variants{{{"LIT", ""}, {"GLOW", ""}, {"HIGHLIGHTS", ""}}};
    const Variants one_shading{{{"TWO_SIDED", "true"}, {"BLINN_PHONG", "false"}}};
    const Variants near{{{"SCATTER", ""}, {"NEAR_STEPS", "2"}}};
    return lit * (Variants{{{"REFLECT", ""}}} + one_shading * Variants{{{"REFLECT", ""}}} +
                  Variants{{{"SCATTER", ""}, {"NEAR_STEPS", "0"}}} + near * Variants{{{"DIFFUSE_LIGHT", ""}}} +
                  near * Variants{{{"DIFFUSE_LIGHT", ""}, {"SURFACES", ""}}} + near * Variants{{{"REFLECT", ""}}});
}

Variants march_variants() {
    const Variants sampling{{}, {{"SAMPLE_AT_MIDPOINTS", ""}}, {{"REFINE", ""}}};  // refinement: of pre-integration
    const Variants march = one_or_two_volumes * sampling * each_or_none({"LEAP", "STOP_EARLY", "COUNT", "OPAQUE"});
    // Sky and clouds stand in for what is behind, whatever the march does.
    const Variants behind = with_and_without({"OPAQUE"}) * with_and_without({"SKY"}) *
                            Variants{{{"VOLUMES", "1"}, {"CLOUDS", "2"}}} * shafts;
    const Variants from_voxels =
        lamps * Variants{{{"LIT", ""}, {"REFLECT", ""}, {"GRADIENTS_FROM_VOXELS", ""}}} * with_and_without({"HOLES"});
    const Variants holes = one_or_two_volumes * sampling * Variants{{{"HOLES", ""}, {"LEAP", ""}}};
    return (Variants{{}} + lit_variants()) * (march + holes) + Variants{{{"VOLUMES", "1"}, {"SKY", ""}}} + behind +
           one_or_two_volumes * from_voxels + behind * lit_variants() * shadows_of_clouds;
}

Variants mesh_variants() {
    const Variants samples{{}, {{"SAMPLES", "4"}}};
    const Variants around = with_and_without({"SHADOWS"}) * with_and_without({"SKY_LIGHT"}) * samples;
    const Variants points = Variants{{{"FROM_POINTS", ""}}} *
                            Variants{{}, {{"CUBE_LAMPS", ""}}, {{"STANDARD_DIPOLE", ""}}, {{"EXPONENTIAL_DISK", ""}}};
    const Variants maps{{{"EXIT_MAPS", "8"}}, {{"EXIT_MAPS", "16"}}};
    const Variants inside = Variants{{{"TRANSLUCENT", ""}}} * (maps + points);
    return Variants{{{"DEPTH_ONLY", ""}}, {{"THICKNESS", ""}}} +
           sun * Variants{{{"VERTEX_COLORS", ""}}} * samples * (Variants{{}} + inside) +
           lamps * around * (Variants{{}} + inside) * (Variants{{}} + shadows_of_clouds) +
           sun * shadows_of_clouds * inside + samples * Variants{{{"MAP_READS", ""}, {"TRANSLUCENT", ""}}} * maps;
}

Variants sky_models() {
    return Variants{{}, {{"PREETHAM", ""}}, {{"LOOK", ""}}};
}

Variants sky_variants() {
    return sky_models() * each_or_none({"MARCH", "OPAQUE"});
}

const std::vector<const char*> cloud_field{"OVERLAY", "FOLLOWS_TOP", "LINEAR_COVERAGE", "PACKED"};

Variants cloud_march_variants() {
    const Variants light{{}, {{"OCTAVES", "8"}}, {{"OCTAVES", "8"}, {"HALVING", ""}}, {{"ARTISTIC", ""}}};
    const Variants steps = each_or_none({"LEAP", "BIG_STEPS", "STOP_EARLY", "ADAPT"});
    return light * with_and_without({"BOX"}) * each_or_none({"OPAQUE", "AIR", "SPARSE"}) +
           light * with_and_without({"COUNT"}) * with_and_without({"CONE"}) * with_and_without({"SPARE_DETAIL"}) *
               steps +
           each_or_none(cloud_field) * with_and_without({"BOX"});
}

Variants path_trace_variants() {
    const Variants lights{{{"LIGHTS", "0"}}, {{"LIGHTS", "2"}}, {{"LIGHTS", "5"}}};
    return one_or_two_volumes * lights * with_and_without({"GLOW"}) * with_and_without({"HOLES"});
}

const Variants from_both = with_and_without({"FROM_POINT"});

Variants light_sweep_variants() {
    return from_both * with_and_without({"WHOLE_SLICES"}) * with_and_without({"LEAP"}) *
           (Variants{{}, {{"DIFFUSE", ""}, {"BORDER_LIGHT", "vec3(0.0)"}}} + white_border * Variants{{{"PAPER", ""}}});
}

Variants light_combine_variants() {
    return from_both * (Variants{{{"CHANNELS", "1"}, {"FORMAT", "r16f"}}} +
                        white_border * Variants{{{"CHANNELS", "4"}, {"FORMAT", "rgba32f"}, {"ALSO_DIRECT", "r32f"}}});
}

Variants light_rays_variants() {
    return from_both * with_and_without({"HOLES"}) *
           Variants{
               {{"VOLUMES", "1"}, {"SAMPLE_AT_MIDPOINTS", ""}, {"LEAP", ""}, {"STOP_EARLY", ""}, {"FORMAT", "r16f"}}};
}

}  // namespace

std::vector<gl::Defines> shader_variants(const std::string& file) {
    using Make = Variants (*)();
    static const std::map<std::string, Make> files{
        {"compose/background.frag", background_variants},
        {"clouds/cloud_columns.comp", [] { return each_or_none(cloud_field); }},
        {"clouds/cloud_march.frag", cloud_march_variants},
        {"clouds/cloud_noise.comp",
         [] {
             return Variants{{{"TEXEL_FORMAT", "rgba16"}}, {{"TEXEL_FORMAT", "r16"}, {"PACKED", ""}}};
         }},
        {"clouds/cloud_shafts.comp", [] { return shadows_of_clouds; }},
        {"clouds/cloud_sun.comp", [] { return each_or_none(cloud_field); }},
        {"light/light_combine.comp", light_combine_variants},
        {"light/light_medium.comp", [] { return with_and_without({"ALBEDO"}) * with_and_without({"HOLES"}); }},
        {"light/light_rays.comp", light_rays_variants},
        {"light/light_sweep.comp", light_sweep_variants},
        {"mesh/mesh.frag", mesh_variants},
        {"mesh/mesh.vert",
         [] {
             return each_or_none({"SHADOWS", "TRANSLUCENT", "VERTEX_COLORS"});
         }},
        {"paths/path_trace.comp", path_trace_variants},
        {"subsurface/radiosity.comp",
         [] {
             return Variants{{}, {{"CUBE_LAMPS", ""}}, {{"STANDARD_DIPOLE", ""}}, {{"EXPONENTIAL_DISK", ""}}};
         }},
        {"sky/sky.frag", sky_variants},
        {"sky/sky_irradiance.comp", sky_models},
        {"surfaces/surface_layers.frag",
         [] {
             return Variants{{{"SAMPLES", "4"}}};
         }},
        {"march/volume_march.frag", march_variants},
    };
    const auto found = files.find(file);
    return found == files.end() ? Variants{{}} : found->second();
}

}  // namespace bruma::app
