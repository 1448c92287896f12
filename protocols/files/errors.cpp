#include "protocols/files/errors.h"

#include "protocols/files/safe_text.h"

namespace protocols {

namespace {

std::string inOneLine(const Fault& fault)
{
    std::string line = fault.where.empty() ? fault.what : fault.where + ": " + fault.what;
    if (!fault.expected.empty()) line += "; expected " + fault.expected;
    if (!fault.nextStep.empty()) line += "; " + fault.nextStep;
    return printable(line);
}

}  // namespace

Error::Error(ExitCode code, const Fault& fault) : std::runtime_error(inOneLine(fault)), m_code(code) {}

Error workFailed(const Fault& fault) { return Error(ExitCode::WorkFailed, fault); }
Error badInput(const Fault& fault) { return Error(ExitCode::BadInput, fault); }
Error environmentFault(const Fault& fault) { return Error(ExitCode::Environment, fault); }

}  // namespace protocols
