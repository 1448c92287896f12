// Pieces of a plain HTML page to read and print. All texts are escaped here.
#pragma once

#include <string>
#include <vector>

namespace study::records::page {

std::string sentence(const std::string& text);  ///< a paragraph
std::string section(const std::string& heading, const std::string& body);
/// Each row has as many cells as `head`.
std::string table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows);
/// `language`: BCP 47 tag of the texts.
std::string whole(const std::string& title, const std::string& body, const std::string& language);

}  // namespace study::records::page
