#include "study/exports/public_files.h"

namespace study::exports {

namespace {

/// A scalar of YAML in double quotes.
std::string quoted(const std::string& text)
{
    std::string yaml = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') yaml += '\\';
        yaml += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
    return yaml + "\"";
}

}  // namespace

std::string licenceText(const std::string& study, const std::string& spdx)
{
    return "The tables of the study \"" + study + "\" in this folder are under the licence " + spdx +
           ".\nIts text: https://spdx.org/licenses/" + spdx + ".html\n";
}

std::string citationText(const std::string& study, const std::string& spdx, const std::vector<std::string>& authors,
                         const std::string& released)
{
    std::string text =
        "cff-version: 1.2.0\nmessage: \"If you use these data, please cite them as below.\"\ntype: dataset\ntitle: " +
        quoted(study) + "\nlicense: " + quoted(spdx) + "\ndate-released: " + quoted(released) + "\nauthors:\n";
    for (const std::string& author : authors) text += "  - name: " + quoted(author) + "\n";
    if (authors.empty()) text += "  - name: \"NAME THE AUTHORS HERE\"\n";
    return text;
}

}  // namespace study::exports
