#include "tests/fuzz/changed_json.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace fuzz {

namespace {

using nlohmann::ordered_json;

constexpr char separator = '\x1f';
constexpr std::size_t largestJson = 1 << 16;
constexpr int mostLevels = 100;  ///< the library writes JSON by recursion

/// Begin and length of a part of the input.
using Part = std::pair<std::size_t, std::size_t>;

bool mayHoldJson(const std::string& input, const Part& part)
{
    if (part.second < 2 || part.second > largestJson) return false;
    if (input[part.first] != '{' && input[part.first] != '[') return false;
    int levels = 0, deepest = 0;
    for (std::size_t i = part.first; i < part.first + part.second; ++i) {
        levels += (input[i] == '{' || input[i] == '[') - (input[i] == '}' || input[i] == ']');
        deepest = std::max(deepest, levels);
    }
    return deepest <= mostLevels;
}

/// Parts between separators; an input without any is one part, from its first bracket on.
std::vector<Part> partsWithJson(const std::string& input)
{
    std::vector<Part> parts;
    std::size_t begin = 0;
    if (input.find(separator) == std::string::npos) begin = std::min(input.find_first_of("{["), input.size());
    while (begin < input.size()) {
        const std::size_t end = std::min(input.find(separator, begin), input.size());
        if (const Part part{begin, end - begin}; mayHoldJson(input, part)) parts.push_back(part);
        begin = end + 1;
    }
    return parts;
}

/// A value of the tree below the root, with the object or list that holds it.
struct Place {
    ordered_json* holder;
    ordered_json::iterator value;
};

void collect(ordered_json& holder, std::vector<Place>& places)
{
    if (!holder.is_structured()) return;
    for (auto value = holder.begin(); value != holder.end(); ++value) {
        places.push_back({&holder, value});
        collect(*value, places);
    }
}

void change(ordered_json& document, protocols::Random& random)
{
    static const ordered_json others[] = {nullptr,
                                          true,
                                          -1,
                                          0,
                                          2147483648LL,
                                          9223372036854775807LL,
                                          1e300,
                                          0.5,
                                          "",
                                          "x",
                                          ordered_json::array(),
                                          ordered_json::array({1, "a", nullptr}),
                                          ordered_json::object(),
                                          ordered_json{{"a", 1}}};
    std::vector<Place> places;
    collect(document, places);
    if (places.empty()) return;
    const Place place = places[random.below(places.size())];
    const std::uint64_t kind = random.below(4);
    if (kind == 0)
        place.holder->erase(place.value);
    else if (kind == 1)
        *place.value = ordered_json(*places[random.below(places.size())].value);
    else
        *place.value = others[random.below(std::size(others))];
}

}  // namespace

std::string withChangedJson(const std::string& input, protocols::Random& random)
{
    const std::vector<Part> parts = partsWithJson(input);
    if (parts.empty()) return input;
    const auto [begin, length] = parts[random.below(parts.size())];
    ordered_json document = ordered_json::parse(input.substr(begin, length), nullptr, false);
    if (document.is_discarded()) return input;
    change(document, random);
    return input.substr(0, begin) + document.dump(-1, ' ', false, ordered_json::error_handler_t::replace) +
           input.substr(begin + length);
}

}  // namespace fuzz
