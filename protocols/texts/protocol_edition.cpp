#include "protocols/texts/protocol_edition.h"

#include <charconv>

namespace protocols {

ProtocolEdition editionOf(std::string_view programVersion)
{
    constexpr std::string_view majorZero = "0.";
    constexpr int firstCurrentMinor = 6;
    if (!programVersion.starts_with(majorZero)) return ProtocolEdition::Current;
    const std::string_view rest = programVersion.substr(majorZero.size());
    int minor = firstCurrentMinor;
    std::from_chars(rest.data(), rest.data() + rest.size(), minor);
    return minor < firstCurrentMinor ? ProtocolEdition::Before06 : ProtocolEdition::Current;
}

}  // namespace protocols
