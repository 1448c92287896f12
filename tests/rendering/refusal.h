// The message of a refusal, for tests of bad input; empty where nothing was refused.
#pragma once

#include <QString>
#include <string>

#include "protocols/files/errors.h"

template <class Work>
QString refusalOf(Work work)
{
    try {
        work();
    } catch (const protocols::Error& error) {
        return QString::fromStdString(error.what());
    }
    return {};
}
