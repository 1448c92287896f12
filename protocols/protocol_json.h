// Reads a protocol file: JSON that is checked against protocol.schema.json (built into the program) and against the rules that
// a schema cannot express (protocol.h, question_ids.h). All faults of a file stand in one list.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocols/protocol.h"

namespace protocols {

/// One fault of a protocol file, at the value that has it.
struct ProtocolFault {
    std::size_t line = 1;    ///< from 1
    std::size_t column = 1;  ///< from 1, in characters
    std::string text;        ///< the key, the value there, and what was expected
};

/// Largest protocol file, bytes. The paper's has 2,300.
inline constexpr std::size_t largestProtocol = std::size_t{1} << 20;

struct CheckedProtocol {
    std::optional<Protocol> protocol;   ///< none where the file has a fault
    std::vector<ProtocolFault> faults;  ///< in the order of the file; of very many the last says how many are not listed
};

/// The faults of a text. Throws badInput where the text is not JSON: then no later fault can be found.
CheckedProtocol checkedProtocol(std::string_view json, const std::string& where);

/// `where` names the source in errors. Throws badInput listing the faults in one line.
Protocol protocolFromJson(std::string_view json, const std::string& where);
Protocol readProtocol(const std::filesystem::path& file);

/// The text of a protocol file. Throws badInput where it has more than `largestProtocol` bytes, as readWholeFile() does.
std::string readProtocolText(const std::filesystem::path& file);

/// The protocol that an existing study keeps, by the rules and usual texts of its time. `madeBy`: the program version that made
/// the study.
Protocol keptProtocolFromJson(std::string_view json, const std::string& where, std::string_view madeBy);

/// The text of the paper's study, 7 fabrics x 9 conditions x 10 participants: the shipped protocols/vis2hap.json as it is built
/// into the program. A study folder keeps this text and its hash.
std::string_view paperProtocolJson();

}  // namespace protocols
