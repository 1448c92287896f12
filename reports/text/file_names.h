// Names for the files of one folder.
#pragma once

#include <set>
#include <string>

namespace reports {

class FileNames {
public:
    /// The wanted name, changed so that it is valid on any file system and differs from all earlier ones, ignoring case.
    /// Characters other than ASCII letters, digits, "-" and "_" become "_". A name that exists gets "-2", "-3" ... No question's
    /// id contains "-".
    std::string unique(const std::string& wanted);

private:
    std::set<std::string> m_taken;  ///< in lower case
};

}  // namespace reports
