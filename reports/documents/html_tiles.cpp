#include "reports/documents/html_tiles.h"

#include <cstring>
#include <utility>

namespace reports {

std::string withoutTiles(std::string html)
{
    constexpr std::pair<const char*, const char*> replacements[] = {{"<div class=\"tiles\">", "<p>"},
                                                                    {"<div class=\"tile\">", ""},
                                                                    {"</b><span>", "</b> "},
                                                                    {"</span></div></div>", "</p>"},
                                                                    {"</span></div>", "; "}};
    for (const auto& [from, to] : replacements)
        for (std::size_t at = html.find(from); at != std::string::npos; at = html.find(from, at))
            html.replace(at, std::strlen(from), to);
    return html;
}

}  // namespace reports
