#pragma once
#include <functional>
#include <string_view>

namespace bruma::io {

/// Told how far a long reading has come: `share` in [0, 1] and a word for people. It stops the reading by throwing; the
/// exception passes through and nothing is kept. An empty function is never called.
using Progress = std::function<void(double share, std::string_view what)>;

}  // namespace bruma::io
