#pragma once
#include <cstdint>
#include <utility>

namespace bruma {

/// Counts changes over the whole process: a larger number is newer. 0 means 'never'.
using Revision = std::uint64_t;

/// A number larger than any handed out before. Safe from any thread.
Revision next_revision();

/// A value that knows when it last changed. Setting it to an equal value is no change, so a panel may write back
/// what it read without making anything newer.
template <class T>
class Tracked {
  public:
    Tracked() : revision_(next_revision()) {}
    explicit(false) Tracked(T value) : value_(std::move(value)), revision_(next_revision()) {}

    const T& operator*() const { return value_; }
    const T* operator->() const { return &value_; }
    Revision revision() const { return revision_; }

    /// Takes the new value; returns whether it differed.
    bool set(T value) {
        if (value == value_) {
            return false;
        }
        value_ = std::move(value);
        revision_ = next_revision();
        return true;
    }

    /// Changes the value in place through `change(T&)`, newer only if the result differs.
    template <class Change>
    bool edit(Change&& change) {
        T copy = value_;
        change(copy);
        return set(std::move(copy));
    }

  private:
    T value_{};
    Revision revision_;
};

}  // namespace bruma
