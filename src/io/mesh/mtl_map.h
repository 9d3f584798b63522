#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "scene/mesh/mesh_data.h"

namespace bruma::io {

/// A texture statement of a material library, such as `map_Kd -s 2 2 1 wood.png`.
struct MtlMap {
    scene::TexturePlacement placement;
    std::vector<std::string> names;  ///< what the file may be called, the likeliest first; empty: it names none
    std::vector<std::string> unused_options;  ///< what is told and not drawn, each once, for example "-t"
};

/// Reads the options and the file name behind a texture keyword; names may hold blanks. Options are those of the
/// published format (Alias|Wavefront, "File Formats" 4.2, 1995): -s, -o, -clamp and -mm are read; others are named in
/// `unused_options` where they ask for more than the usual. Where that text has -s make the picture larger and -o move
/// it to the right, programs that write and read these options multiply u and v by -s and then add -o, and so does
/// this.
MtlMap read_mtl_map(std::string_view arguments);

}  // namespace bruma::io
