#pragma once
#include <optional>
#include <string>

#include "io/mesh/mtl_map.h"
#include "io/mesh/mtl_text.h"
#include "io/mesh/told_losses.h"
#include "scene/mesh/mesh_data.h"

namespace bruma::io {

/// A material as Bruma draws it.
struct MtlMaterial {
    scene::MeshMaterial material;
    std::optional<MtlMap> diffuse_map;  ///< not loaded
};

/// What is to be said of a library's materials.
struct MtlFindings {
    ToldLosses losses;                ///< by material
    std::size_t unread = 0;           ///< statements without usable numbers
    std::string first_unread;         ///< as "line 3, 'Kd red'"
    std::string first_decimal_comma;  ///< the same, where numbers were written with decimal commas
    std::size_t limited = 0;          ///< materials whose values were beyond what can be drawn
};

/// Reads a material as "File Formats" 4.2 (Alias|Wavefront, 1995) defines it, in linear Rec.709:
/// illum 0 shows Kd in any light; 1 is Lambert's, without Ks; 2 adds Blinn's highlight, Ks to the power of Ns; 3 and
/// above are drawn as 2. A material that tells no illum is taken for 2. Ns of 0 or none means no highlight, though the
/// formula would add Ks in full from every light: that is how programs write surfaces that do not shine (Blender,
/// MeshLab: `Ks .8 .8 .8`, `Ns 0`, `illum 2`). Ka is not used: light from all sides is light, and Kd reflects it. Where
/// no Kd is told, it is 1 under a texture and 0.8 without. Ke, an extension, is radiance.
MtlMaterial read_mtl_material(const MtlEntry& entry, MtlFindings& findings);

/// The sentences on a library, without its name: at most one of each kind.
std::vector<std::string> remarks_of(const MtlFindings& findings);

}  // namespace bruma::io
