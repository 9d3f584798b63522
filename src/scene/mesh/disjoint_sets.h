#pragma once
#include <cstdint>
#include <numeric>
#include <vector>

namespace bruma::scene {

/// Numbers 0 .. count - 1 in sets, each alone at first, that can be joined (union by path halving).
class DisjointSets {
  public:
    explicit DisjointSets(std::size_t count = 0) { reset(count); }
    void reset(std::size_t count) {
        parent_.resize(count);
        std::iota(parent_.begin(), parent_.end(), 0U);
    }
    /// The same number for all of a set, until it is joined with another.
    std::uint32_t root(std::uint32_t n) {
        while (parent_[n] != n) {
            n = parent_[n] = parent_[parent_[n]];
        }
        return n;
    }
    void join(std::uint32_t a, std::uint32_t b) { parent_[root(a)] = root(b); }

  private:
    std::vector<std::uint32_t> parent_;
};

}  // namespace bruma::scene
