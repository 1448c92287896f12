// The share of numbered items that one of several processes works on: every parts-th item, so that all shares take about as long.
#pragma once

#include <cstddef>

namespace stats {

struct Share {
    std::size_t part = 0;   ///< 0 to parts - 1
    std::size_t parts = 1;  ///< at least 1; 1: everything

    /// Number of items of this share, where there are `items` in all.
    std::size_t sizeOf(std::size_t items) const { return items > part ? (items - part - 1) / parts + 1 : 0; }
    /// The place among all items of item `i` of this share.
    std::size_t item(std::size_t i) const { return part + i * parts; }
    bool isAll() const { return parts == 1; }

    bool operator==(const Share&) const = default;
};

}  // namespace stats
