// The tiles of the page in documents that have none.
#pragma once

#include <string>

namespace reports {

/// HTML text of a report whose tiles stand in one line, a paragraph: "10 participants; 63 renderings".
std::string withoutTiles(std::string html);

}  // namespace reports
