// Numbers as people type them: with comma or point, on European and East Asian keyboards.
#pragma once

#include <string>

namespace protocols {

/// A decimal number with a point and plain digits: "21.5" for "21,5", "21.5" or "２１．５". Any other text as it was, without
/// blanks around it. A single comma is the decimal mark, never a mark of thousands.
std::string typedNumber(const std::string& typed);

}  // namespace protocols
