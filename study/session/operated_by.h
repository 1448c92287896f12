// Who runs a sitting, with which program, on which machine. The log keeps it with every sitting, correction and void.
#pragma once

#include <string>

namespace study::session {

struct OperatedBy {
    std::string operatorName;  ///< empty: nobody is recorded, as in logs of earlier versions
    std::string program;       ///< "vis2hap 0.6.0"
    std::string host;
    bool plainImages = false;  ///< the display leaves each image as a plain file while it can be felt
    std::string display = {};  ///< name of the display; "none" if nothing can be felt
    bool operator==(const OperatedBy&) const = default;
};

/// The given name, or else the name of the account; and the name of this machine.
OperatedBy operatedBy(const std::string& name, const std::string& program);

}  // namespace study::session
