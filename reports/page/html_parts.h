// HTML elements of the page's sections. Arguments called `html` are already escaped; other arguments are not.
#pragma once

#include <string>
#include <vector>

namespace reports {

std::string paragraph(const std::string& html);

/// A heading that the reader opens to see what is below it.
std::string folded(const std::string& heading, const std::string& html);

std::string bulletList(const std::vector<std::string>& html, const std::string& cssClass = {});

/// A number in large type with its caption.
struct NumberTile {
    std::string value;
    std::string what;
};
std::string tiles(const std::vector<NumberTile>& numbers);

}  // namespace reports
