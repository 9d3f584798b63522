#pragma once
#include <string>
#include <vector>

#include "context/context.h"

namespace bruma::app {

/// An offscreen context of the wanted kind. Where this program cannot open it but its sibling can (OSMesa and EGL do
/// not fit in one program), runs the sibling with the same arguments in this process's place and does not return.
std::unique_ptr<context::Context> open_context_or_run_sibling(context::Kind kind,
                                                              const std::vector<std::string>& arguments);

/// The kind meant by auto, egl or osmesa; throws InputError for other words.
context::Kind context_kind(const std::string& word);

}  // namespace bruma::app
