#include "reports/page/html_parts.h"

#include "protocols/files/markup_text.h"

namespace reports {

std::string paragraph(const std::string& html) { return "<p>" + html + "</p>\n"; }

std::string folded(const std::string& heading, const std::string& html)
{
    return "<details><summary>" + protocols::escapedMarkup(heading) + "</summary>" + html + "</details>\n";
}

std::string bulletList(const std::vector<std::string>& html, const std::string& cssClass)
{
    std::string list = cssClass.empty() ? "<ul>" : "<ul class=\"" + cssClass + "\">";
    for (const std::string& item : html) list += "<li>" + item + "</li>\n";
    return list + "</ul>\n";
}

std::string tiles(const std::vector<NumberTile>& numbers)
{
    std::string html = "<div class=\"tiles\">";
    for (const NumberTile& one : numbers)
        html += "<div class=\"tile\"><b>" + protocols::escapedMarkup(one.value) + "</b><span>" +
                protocols::escapedMarkup(one.what) + "</span></div>";
    return html + "</div>\n";
}

}  // namespace reports
