#pragma once
#include <string>

namespace bruma::app {

/// The path that a person means by what they typed or pasted: without blanks and line ends around it, without quotes
/// around it, file:// URLs decoded, ~ and ~NAME at its start replaced by the home folder of the person or of NAME. A
/// file that is there under exactly this name is taken as it is. Throws nothing; what cannot be decoded is left as it
/// is.
std::string typed_path(const std::string& typed);

}  // namespace bruma::app
