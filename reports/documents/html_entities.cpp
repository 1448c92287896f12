#include "reports/documents/html_entities.h"

namespace reports {
namespace {

struct Replacement {
    const char* html;
    const char* xml;
};

constexpr Replacement replacements[] = {{"&ldquo;", "\u201C"}, {"&rdquo;", "\u201D"}, {"&minus;", "\u2212"},
                                        {"&ndash;", "\u2013"}, {"&nbsp;", "\u00A0"},  {"&sup2;", "\u00B2"},
                                        {"&times;", "\u00D7"}, {"&rsquo;", "\u2019"}, {"<br>", "<br/>"}};

}  // namespace

QByteArray asXml(const std::string& html)
{
    QByteArray xml = QByteArray::fromStdString(html);
    for (const Replacement& one : replacements) xml.replace(one.html, one.xml);
    return "<text>" + xml + "</text>";
}

}  // namespace reports
