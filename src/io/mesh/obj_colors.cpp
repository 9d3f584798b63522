#include "io/mesh/obj_colors.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "io/blanks.h"
#include "io/picture/picture_file.h"

namespace bruma::io {
void ObjColors::add(std::size_t ordinal, std::string_view numbers) {
    // x y z r g b, perhaps with an alpha behind; x y z w has no colour.
    std::array<float, 6> values{};
    const char* at = numbers.data();
    const char* const end = at + numbers.size();
    for (std::size_t n = 0; n < values.size(); ++n) {
        at = std::find_if_not(at, end, [](char c) { return is_blank(c); });
        at += at != end && *at == '+' ? 1 : 0;
        if (n < 3) {  // coordinates are read elsewhere
            at = std::find_if(at, end, [](char c) { return is_blank(c); });
            continue;
        }
        const auto [after, error] = std::from_chars(at, end, values[n]);
        if (error != std::errc() || !std::isfinite(values[n])) {
            return;
        }
        at = after;
    }
    const float none = std::numeric_limits<float>::quiet_NaN();
    encoded_.resize(std::max(encoded_.size(), ordinal + 1), glm::vec3(none));
    encoded_[ordinal] = {values[3], values[4], values[5]};
    largest_ = std::max({largest_, values[3], values[4], values[5]});
}

std::vector<glm::vec3> ObjColors::linear(std::size_t count) const {
    if (encoded_.empty()) {
        return {};
    }
    const double white = largest_ > 1.0F ? 255.0 : 1.0;
    std::vector<glm::vec3> colors(count, glm::vec3(1.0F));
    for (std::size_t n = 0; n < std::min(count, encoded_.size()); ++n) {
        for (int c = 0; c < 3; ++c) {
            const double value = encoded_[n][c] / white;
            colors[n][c] = std::isnan(value) ? 1.0F : float(linear_of_srgb(std::clamp(value, 0.0, 1.0)));
        }
    }
    return colors;
}

}  // namespace bruma::io
