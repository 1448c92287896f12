// The rules and usual texts that a protocol follows. A study keeps those of the program version that made it.
// So an update of the program never changes in mid-study what a participant hears.
#pragma once

#include <string_view>

namespace protocols {

enum class ProtocolEdition {
    Before06,  ///< before 0.6.0: question ids were not checked, and the usual texts were other ones
    Current,
};

/// The edition of a study that this program version made ("0.5.0"). A text that is no version is current.
ProtocolEdition editionOf(std::string_view programVersion);

}  // namespace protocols
