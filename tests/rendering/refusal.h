// What a refusal says, for tests of bad input: "" where nothing was refused.
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
