// The fibre that a fabric is made of, as its label names it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace rendering::fabrics {

enum class Fibre { Cotton, Linen, Jute, Wool, Silk, Polyester, Viscose, Acrylic };
inline constexpr std::size_t fibreCount = 8;

/// "cotton", "linen" ... as in dataset.json.
std::string nameOf(Fibre fibre);
/// In capitals or not; nullopt for another name.
std::optional<Fibre> fibreFrom(std::string_view name);
/// All names in one line, for messages.
std::string fibreNames();

}  // namespace rendering::fabrics
