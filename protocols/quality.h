// The price of computed signals. Three fixed settings, so that images do not depend on the machine.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace protocols {

enum class Quality { Fast, Balanced, Accurate };

/// In the order of their price.
inline constexpr Quality allQualities[] = {Quality::Fast, Quality::Balanced, Quality::Accurate};

inline std::string nameOf(Quality quality)
{
    switch (quality) {
        case Quality::Fast:
            return "fast";
        case Quality::Balanced:
            return "balanced";
        case Quality::Accurate:
            return "accurate";
    }
    return {};
}

inline std::optional<Quality> qualityFrom(std::string_view name)
{
    for (const Quality quality : allQualities)
        if (nameOf(quality) == name) return quality;
    return std::nullopt;
}

}  // namespace protocols
