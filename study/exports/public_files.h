// What a public export holds beside its tables: the licence, and how to cite the data.
#pragma once

#include <string>
#include <vector>

namespace study::exports {

inline constexpr const char* usualLicence = "CC-BY-4.0";

/// LICENSE.txt: the SPDX identifier and where its text is.
std::string licenceText(const std::string& study, const std::string& spdx);

/// CITATION.cff of format 1.2.0. Without authors it names a placeholder, which the caller asks to replace. `released`:
/// "2026-11-25".
std::string citationText(const std::string& study, const std::string& spdx, const std::vector<std::string>& authors,
                         const std::string& released);

}  // namespace study::exports
