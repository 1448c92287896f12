// The JSON files of protocols/, of its texts and of its examples, built into the program.
#pragma once

#include <string_view>
#include <vector>

namespace protocols::shipped {

std::string_view protocolSchema();  ///< protocol.schema.json
std::string_view paperProtocol();   ///< vis2hap.json

/// A file that is built in.
struct TextFile {
    std::string_view name;  ///< "texts/usual_texts.de"
    std::string_view json;
};

/// The usual texts of all languages, English first.
std::vector<TextFile> usualTexts();

/// The protocols of protocols/examples by their names without folder and ".json"; those that are explained first come first.
std::vector<TextFile> examples();

}  // namespace protocols::shipped
