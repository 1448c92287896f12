// Text files as other programs write them: UTF-8 and UTF-16 with a byte order mark, and the code pages of Windows and of old
// Macs.
#pragma once

#include <string>
#include <string_view>

namespace protocols {

struct DecodedText {
    std::string text;      ///< UTF-8 without a byte order mark
    std::string encoding;  ///< "UTF-8", "UTF-16", "Windows-1252", "GB18030", "Mac OS Roman"
};

/// Finds the encoding. A byte order mark decides. Text that is well-formed UTF-8 is UTF-8. Otherwise bytes above 127 that always
/// come in pairs are GB18030 (Chinese), lines that end with CR alone are Mac OS Roman, and everything else is Windows-1252, which
/// contains ISO 8859-1. `where` names the text in errors. Throws badInput where a byte has no meaning in the encoding.
DecodedText decodedText(std::string_view bytes, const std::string& where);

/// The text of bytes in a named encoding, by any name that iconv knows. Throws badInput for an unknown name and for bytes without
/// meaning.
DecodedText decodedText(std::string_view bytes, const std::string& where, const std::string& encoding);

}  // namespace protocols
