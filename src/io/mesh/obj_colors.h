#pragma once
#include <glm/glm.hpp>
#include <string_view>
#include <vector>

namespace bruma::io {

/// The colours that many programs write behind the coordinates of `v` lines.
class ObjColors {
  public:
    /// Takes note of what stands behind the keyword of `v` line `ordinal`, counted from 0.
    void add(std::size_t ordinal, std::string_view numbers);

    /// Linear Rec.709 for `count` vertices, white where a line tells none; empty when no line does. They are taken for
    /// sRGB-encoded, as scans and painting programs write them, and for 0 to 255 when one is larger than 1.
    std::vector<glm::vec3> linear(std::size_t count) const;

  private:
    std::vector<glm::vec3> encoded_;  ///< of the first lines; not a number: told none
    float largest_ = 0.0F;
};

}  // namespace bruma::io
