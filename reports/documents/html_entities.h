// HTML text of a report as well-formed XML, which Qt's readers take.
#pragma once

#include <QByteArray>
#include <string>

namespace reports {

/// One element <text> with the HTML: named entities become characters, <br> becomes <br/>.
QByteArray asXml(const std::string& html);

}  // namespace reports
