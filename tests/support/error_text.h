// The exit code and the message of an error, for tests of bad input and of faults.
#pragma once

#include <QString>

#include "protocols/files/errors.h"

namespace tests::support {

/// "2: what went wrong"; empty where nothing was thrown.
template <class Call>
QString errorOf(Call call)
{
    try {
        call();
    } catch (const protocols::Error& fault) {
        return QString("%1: %2").arg(static_cast<int>(fault.exitCode())).arg(fault.what());
    }
    return {};
}

}  // namespace tests::support
