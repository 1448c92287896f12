#include "reports/text/plain_words.h"

namespace reports {

std::string pluralOf(std::size_t n, const std::string& singular) { return n == 1 ? singular : singular + "s"; }

std::string counted(std::size_t n, const std::string& singular) { return std::to_string(n) + " " + pluralOf(n, singular); }

std::string listed(const std::vector<std::string>& items)
{
    std::string text;
    for (std::size_t i = 0; i < items.size(); ++i) text += (i == 0 ? "" : i + 1 == items.size() ? " and " : ", ") + items[i];
    return text;
}

std::string lowerCase(std::string text)
{
    for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return text;
}

}  // namespace reports
