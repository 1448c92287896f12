// Protocol of a study of photographs alone: the paper's study with the conditions that need no recordings of touch.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace study::photographs {

/// Text of the paper's protocol in this language, with these conditions, the planned contrasts among them, and as many of
/// `fabrics` as the paper has at most. Throws badInput where a question shows more alternatives than there are fabrics.
std::string photographProtocol(const std::vector<std::string>& conditions, int fabrics, const std::string& language = "en");

/// Writes the protocol for this data set beside it, "DATASET-protocol.json", and returns its path. A file of another content
/// stays, and a number is added to the name. Throws protocols::Error.
std::filesystem::path writePhotographProtocol(const std::filesystem::path& dataset, const std::vector<std::string>& conditions,
                                              const std::string& language = "en");

}  // namespace study::photographs
