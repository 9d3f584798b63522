#pragma once
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace bruma {

/// Values under indices that stay valid until they are removed. Places are used again, and an index holds how often its
/// place was, so that an old index never names what came after it (but for one of 2048 tries).
template <class T>
class Slots {
  public:
    int add(T value) {
        if (free_.empty()) {
            free_.push_back(int(slots_.size()));
            slots_.push_back({});
        }
        const int slot = free_.back();
        free_.pop_back();
        slots_[std::size_t(slot)].value.emplace(std::move(value));
        return index_of(slot);
    }
    /// Throws std::out_of_range when there is none.
    void remove(int index) {
        at(index);
        const int slot = index & slot_mask;
        slots_[std::size_t(slot)].value.reset();
        slots_[std::size_t(slot)].generation = (slots_[std::size_t(slot)].generation + 1) & generation_mask;
        free_.push_back(slot);
    }

    /// Null for an index below 0 and for a value that was removed.
    const T* find(int index) const {
        const std::size_t slot = std::size_t(index & slot_mask);
        return index >= 0 && slot < slots_.size() && slots_[slot].value && index == index_of(int(slot))
                   ? &*slots_[slot].value
                   : nullptr;
    }
    T* find(int index) { return const_cast<T*>(std::as_const(*this).find(index)); }
    const T& at(int index) const {
        if (const T* const found = find(index)) {
            return *found;
        }
        throw std::out_of_range("this index names nothing here, or what was removed");
    }
    T& at(int index) { return const_cast<T&>(std::as_const(*this).at(index)); }

    /// Indices of all values, by place.
    std::vector<int> indices() const {
        std::vector<int> all;
        for (std::size_t slot = 0; slot < slots_.size(); ++slot) {
            if (slots_[slot].value) {
                all.push_back(index_of(int(slot)));
            }
        }
        return all;
    }
    std::size_t places() const { return slots_.size(); }

  private:
    static constexpr int slot_bits = 20, slot_mask = (1 << slot_bits) - 1, generation_mask = (1 << 11) - 1;
    struct Slot {
        std::optional<T> value;
        int generation = 0;
    };

    int index_of(int slot) const { return slots_[std::size_t(slot)].generation << slot_bits | slot; }

    std::vector<Slot> slots_;
    std::vector<int> free_;
};

}  // namespace bruma
