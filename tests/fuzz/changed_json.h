// Changes of the structure of JSON, which changes of single bytes hardly ever make without breaking it.
#pragma once

#include <string>

#include "protocols/random.h"

namespace fuzz {

/// The input with one value of its JSON removed, or replaced by null, a number, a text, a list or an object. The input is JSON,
/// perhaps behind a first sign, or holds JSON between two characters 0x1F. Without JSON it stays as it is.
std::string withChangedJson(const std::string& input, protocols::Random& random);

}  // namespace fuzz
