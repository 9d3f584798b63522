#include "render/volume/majorants.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>

namespace bruma::render {
namespace {

/// Smallest and largest entry of any span of a table in constant time: level k holds those of all spans of 2^k entries.
class SpanBounds {
  public:
    explicit SpanBounds(const std::vector<float>& table) {
        std::vector<glm::vec2> level;
        level.reserve(table.size());
        for (const float entry : table) {
            level.emplace_back(entry, entry);
        }
        levels_.push_back(std::move(level));
        for (std::size_t width = 2; width <= table.size(); width *= 2) {
            const std::vector<glm::vec2>& half = levels_.back();
            std::vector<glm::vec2> whole;
            whole.reserve(table.size() - width + 1);
            for (std::size_t first = 0; first + width <= table.size(); ++first) {
                whole.push_back(joined(half[first], half[first + width / 2]));
            }
            levels_.push_back(std::move(whole));
        }
    }
    /// Of entries first .. behind - 1, at least one.
    glm::vec2 of(int first, int behind) const {
        const int level = std::bit_width(unsigned(std::max(1, behind - first))) - 1;
        const std::vector<glm::vec2>& spans = levels_[std::size_t(level)];
        return joined(spans[std::size_t(first)], spans[std::size_t(behind - (1 << level))]);
    }

  private:
    static glm::vec2 joined(glm::vec2 a, glm::vec2 b) { return {std::min(a.x, b.x), std::max(a.y, b.y)}; }
    std::vector<std::vector<glm::vec2>> levels_;
};

}  // namespace

ExtinctionBounds bound_extinction(const CellRanges& ranges, const std::vector<float>& extinction,
                                  glm::dvec2 u_of_value) {
    const TouchedEntries touched(ranges, u_of_value, int(extinction.size()));
    const SpanBounds spans(extinction);
    ExtinctionBounds bounds;
    bounds.cells = ranges.cells;
    bounds.least_most.resize(ranges.smallest.size());
    tbb::parallel_for(std::size_t(0), bounds.least_most.size(), [&](std::size_t cell) {
        if (ranges.is_nothing(cell)) {
            return;  // 0, 0
        }
        const auto [first, behind] = touched.of(cell);
        const glm::vec2 bound = spans.of(first, behind);
        // The texture unit's own rounding, far above its half unit in the last place.
        const bool holes = !ranges.holes.empty() && ranges.holes[cell] != 0;
        bounds.least_most[cell] = {holes ? 0.0F : bound.x * (1.0F - 1e-6F), bound.y * (1.0F + 1e-6F)};
    });
    return bounds;
}

}  // namespace bruma::render
