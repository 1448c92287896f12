#include "rendering/fabrics/fibre.h"

#include <algorithm>

namespace rendering::fabrics {

namespace {

constexpr std::string_view namesOfFibres[fibreCount] = {"cotton", "linen",     "jute",    "wool",
                                                        "silk",   "polyester", "viscose", "acrylic"};

}  // namespace

std::string nameOf(Fibre fibre) { return std::string(namesOfFibres[std::size_t(fibre)]); }

std::optional<Fibre> fibreFrom(std::string_view name)
{
    std::string small(name);
    for (char& letter : small)
        if (letter >= 'A' && letter <= 'Z') letter = char(letter - 'A' + 'a');
    const auto found = std::ranges::find(namesOfFibres, small);
    if (found == std::end(namesOfFibres)) return std::nullopt;
    return Fibre(found - std::begin(namesOfFibres));
}

std::string fibreNames()
{
    std::string all;
    for (const std::string_view name : namesOfFibres) all.append(all.empty() ? "" : ", ").append(name);
    return all;
}

}  // namespace rendering::fabrics
