// Numbers as text and back, independent of the locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace protocols {

/// The shortest text that reads back exactly.
std::string shortest(double value);

/// `decimals` digits after the point, at most 100; a negative zero loses its sign. From 1e12 on as "1.32e+276".
std::string fixed(double value, int decimals);

/// The finite number that the whole text states; blanks around it and a leading plus are allowed.
std::optional<double> numberIn(std::string_view text);

/// Without blanks, tabs and line breaks at both ends.
std::string_view withoutBlanks(std::string_view text);

}  // namespace protocols
