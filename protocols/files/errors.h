// The one kind of exception that this program throws on purpose: a fault that ends the work at hand.
// It is told to the user in one line (what, where, what was expected, what to do next) and carries
// the exit code of the command. Expected outcomes (a refused event, an undefined statistic) are
// returned as values, not thrown.
#pragma once

#include <stdexcept>
#include <string>

namespace protocols {

/// Exit codes promised to scripts.
enum class ExitCode : int {
    Done = 0,
    WorkFailed = 1,   ///< the work failed, or a fault was found in stored data
    BadInput = 2,     ///< the call or an input file is wrong
    Environment = 3,  ///< disk full, read-only, lock held, no screen
};

/// The four parts of an error message; an empty part is left out of the line.
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

/// The makers; every message of the program is worded at one of their calls.
Error workFailed(const Fault& fault);
Error badInput(const Fault& fault);
Error environmentFault(const Fault& fault);

}  // namespace protocols
