#include "study/leaks/value_parts.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <string_view>

namespace study::leaks {

namespace {

constexpr ValuePart allParts[] = {
    {"", [](const std::string& value) { return value; }},
    {"first character of ", [](const std::string& value) { return value.substr(0, 1); }},
    {"first two characters of ", [](const std::string& value) { return value.substr(0, 2); }},
    {"last character of ", [](const std::string& value) { return value.empty() ? value : value.substr(value.size() - 1); }},
    {"last two characters of ",
     [](const std::string& value) { return value.size() < 2 ? value : value.substr(value.size() - 2); }},
    {"length of ", [](const std::string& value) { return value.empty() ? value : std::to_string(value.size()); }},
};

std::vector<double> placesOf(const std::vector<std::string>& values, bool& isText)
{
    std::vector<double> numbers;
    for (const auto& value : values) {
        const auto number = numberIn(value.empty() ? "0" : value);
        if (!number) break;
        numbers.push_back(*number);
    }
    isText = numbers.size() != values.size();
    if (!isText) return numbers;
    std::vector<std::string> sorted = values;
    std::ranges::sort(sorted);
    numbers.clear();
    for (const auto& value : values)
        numbers.push_back(static_cast<double>(std::ranges::lower_bound(sorted, value) - sorted.begin()));
    return numbers;
}

}  // namespace

std::span<const ValuePart> valueParts() { return allParts; }

std::optional<double> numberIn(const std::string& text)
{
    double number = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
    return fault == std::errc() && end == text.data() + text.size() && std::isfinite(number) ? std::optional(number)
                                                                                             : std::nullopt;
}

CodedValues coded(const std::vector<std::string>& values)
{
    CodedValues forms;
    forms.equal = numbersOfEqual(values, forms.repeats);
    forms.places = placesOf(values, forms.isText);
    return forms;
}

std::vector<int> numbersOfEqual(const std::vector<std::string>& values, bool& repeats)
{
    std::map<std::string_view, int> known;
    std::vector<int> numbers;
    repeats = false;
    for (const auto& value : values) {
        if (value.empty()) {
            numbers.push_back(-1);
            continue;
        }
        const auto [at, isNew] = known.emplace(value, static_cast<int>(known.size()));
        repeats = repeats || !isNew;
        numbers.push_back(at->second);
    }
    return numbers;
}

}  // namespace study::leaks
