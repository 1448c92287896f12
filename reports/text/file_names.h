// Names for the files of one folder.
#pragma once

#include <set>
#include <string>

namespace reports {

class FileNames {
public:
    /// The wanted name, made fit for any file system and different from all earlier ones without regard to case. Everything but
    /// ASCII letters, digits, "-" and "_" becomes "_"; a name that is taken gets "-2", "-3" ... No question's id holds "-".
    std::string unique(const std::string& wanted);

private:
    std::set<std::string> m_taken;  ///< in lower case
};

}  // namespace reports
