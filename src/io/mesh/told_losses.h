#pragma once
#include <map>
#include <string>
#include <vector>

namespace bruma::io {

/// What a file tells and a picture does not show: each kind once, in the order of its first mention, with a count.
class ToldLosses {
  public:
    /// One more of a kind, for example "d (opacity)".
    void add(const std::string& kind) { ++count_of(kind); }

    bool empty() const { return kinds_.empty(); }
    struct Kind {
        std::string name;
        std::size_t count = 0;
    };
    const std::vector<Kind>& kinds() const { return kinds_; }

  private:
    std::size_t& count_of(const std::string& kind) {
        const auto [found, is_new] = index_of_.try_emplace(kind, kinds_.size());
        if (is_new) {
            kinds_.push_back({kind, 0});
        }
        return kinds_[found->second].count;
    }
    std::vector<Kind> kinds_;
    std::map<std::string, std::size_t> index_of_;
};

}  // namespace bruma::io
