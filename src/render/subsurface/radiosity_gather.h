#pragma once
#include <string>
#include <vector>

#include "gl/shader_library.h"
#include "render/paths/path_goal.h"
#include "render/subsurface/subsurface_constants.h"
#include "render/subsurface/translucent_maps.h"

namespace bruma::render {

/// The light that leaves at each texel of the exit maps: a mean over passes. Texels that no pixel has looked up yet
/// have none; what one is given depends on nothing but its place and how many passes it has had.
struct RadiosityMaps {
    gl::Texture mean;               ///< RGBA32F array, alpha: depth, mm; see radiosity.comp
    gl::Texture variance;           ///< R32F array, of the means
    gl::Buffer passes_of;           ///< that each of the exit maps' texels has had
    gl::Buffer chosen;              ///< texels of the pass under way
    gl::Buffer totals;              ///< see radiosity_choice.comp
    int passes = 0;                 ///< that every texel has had that is read now
    std::uint32_t read_texels = 0;  ///< looked up by the camera's pixels, or all
    std::uint32_t all_texels = 0;   ///< that see the body
    std::uint64_t evaluations = 0;  ///< points of light that were drawn for them, each one evaluation of the BSSRDF
    double noise = 1e30;   ///< standard error of what a picture shows, share of the local value; 1e30: not known yet
    int noise_passes = 0;  ///< at which it was measured
    Revision start = 0;
};

/// What the light is gathered from, and where.
struct RadiosityInput {
    const LightMaps& light;
    const ExitMaps& exits;
    const gl::Buffer* reads = nullptr;  ///< of MapReads; null: all texels are wanted
    const SubsurfaceConstants& constants;
    const scene::SubsurfaceSettings& settings;
    const std::vector<glm::dvec3>& powers;  ///< of the lamps
};

/// Forgets the means, as after a change of what they are made from.
void begin_radiosity(RadiosityMaps& maps, const ExitMaps& exits, Revision start);
/// Adds passes, first where texels that are read have fewest, until the goal or the noise that was asked for is
/// reached; returns words for the frame graph's table.
std::string gather_radiosity(RadiosityMaps& maps, gl::ShaderLibrary& shaders, const RadiosityInput& input,
                             const PathGoal& goal);

}  // namespace bruma::render
