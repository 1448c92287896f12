// The one kind of exception that this program throws on purpose: a fault that ends the work at hand. The user sees it as
// one line (what, where, what was expected, what to do next), and scripts see its exit code. Expected outcomes, such as
// a refused event or an undefined statistic, are returned as values.
#pragma once

#include <stdexcept>
#include <string>

namespace protocols {

/// Exit codes that scripts rely on.
enum class ExitCode : int {
    Done = 0,
    WorkFailed = 1,   ///< the work failed, or a fault was found in stored data
    BadInput = 2,     ///< the call or an input file is wrong
    Environment = 3,  ///< disk full, read-only, lock held, no screen
};

/// The four parts of an error message. An empty part is left out of the line.
struct Fault {
    std::string what;
    std::string where;  ///< file, and the place in it
    std::string expected;
    std::string nextStep;
};

class Error : public std::runtime_error {
public:
    Error(ExitCode code, const Fault& fault);
    ExitCode exitCode() const { return m_code; }

private:
    ExitCode m_code;
};

/// Make an error with the exit code of their name.
Error workFailed(const Fault& fault);
Error badInput(const Fault& fault);
Error environmentFault(const Fault& fault);

}  // namespace protocols
