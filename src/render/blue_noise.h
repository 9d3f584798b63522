#pragma once
#include <cstdint>
#include <vector>

namespace bruma::render {

/// A square tile of `edge` * `edge` ranks in [0, edge^2), each once, whose neighbours differ as much as possible: blue
/// noise by void and cluster (Ulichney 1993). Tiles without a seam. Always the same for the same edge.
std::vector<std::uint16_t> make_blue_noise(int edge);

}  // namespace bruma::render
