// Options whose text is a pair: "LOW,HIGH", "A,B", "MEANING=COLUMN".
#pragma once

#include <string>
#include <utility>

namespace study::commands {

/// Two numbers, the first below the second. `option` and `example` are for the error. Throws badInput.
std::pair<double, double> numbersInOrder(const std::string& text, const std::string& option, const std::string& example);

/// The words before and after the only `sign` of the text, without blanks; neither is empty. Throws badInput.
std::pair<std::string, std::string> wordsAround(const std::string& text, char sign, const std::string& option,
                                                const std::string& example);

}  // namespace study::commands
