#include "study/commands/parts/pair_options.h"

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"

namespace study::commands {

std::pair<double, double> numbersInOrder(const std::string& text, const std::string& option, const std::string& example)
{
    const std::size_t comma = text.find(',');
    const auto low = protocols::numberIn(text.substr(0, comma));
    const auto high = comma == std::string::npos ? std::nullopt : protocols::numberIn(text.substr(comma + 1));
    if (!low || !high || !(*low < *high))
        throw protocols::badInput({"\"" + text + "\" does not give two numbers", option,
                                   "LOW,HIGH with LOW below HIGH, e.g. " + option + "=" + example, "correct the numbers"});
    return {*low, *high};
}

std::pair<std::string, std::string> wordsAround(const std::string& text, char sign, const std::string& option,
                                                const std::string& example)
{
    const std::size_t at = text.find(sign);
    if (at != std::string::npos && text.find(sign, at + 1) == std::string::npos) {
        const std::string first(protocols::withoutBlanks(text.substr(0, at)));
        const std::string second(protocols::withoutBlanks(text.substr(at + 1)));
        if (!first.empty() && !second.empty()) return {first, second};
    }
    throw protocols::badInput({"\"" + text + "\" does not name two things", option, "such as " + option + " " + example, ""});
}

}  // namespace study::commands
