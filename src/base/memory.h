#pragma once
#include <cstdint>

namespace bruma {

/// Bytes that can be had without swapping, by the kernel's own estimate; the largest number when it does not tell.
std::uint64_t available_memory();

}  // namespace bruma
