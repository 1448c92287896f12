// The JSON files of protocols/, of its texts and of its examples, built into the program.
#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace protocols::shipped {

std::string_view protocolSchema();  ///< protocol.schema.json
std::string_view paperProtocol();   ///< vis2hap.json

/// A file with usual texts.
struct TextFile {
    std::string_view name;  ///< "texts/usual_texts.de"
    std::string_view json;
};

/// The usual texts of all languages, English first.
std::vector<TextFile> usualTexts();

/// A protocol of protocols/examples.
struct Example {
    std::string_view name;  ///< of its file, without ".json"
    std::string_view text;
};
/// All of them, those that are explained first come first.
std::span<const Example> examples();

}  // namespace protocols::shipped
