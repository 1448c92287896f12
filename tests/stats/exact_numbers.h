// Compares the numbers that a function returns with reference numbers, and names each that differs. Not a test by itself.
#pragma once

#include <QTest>
#include <cmath>
#include <initializer_list>

#include "stats/kernels/value.h"

/// A number with its reference. Where the reference is 0, `relative` is the largest size allowed.
struct ExactNumber {
    const char* name;
    stats::Value found;
    double expected;
    double relative = 1e-12;
};

inline QString differenceOf(const ExactNumber& one)
{
    if (!one.found.exists()) return QString("%1 is undefined: %2; ").arg(one.name, one.found.why().c_str());
    const double most = one.relative * (one.expected == 0 ? 1 : std::fabs(one.expected));
    if (*one.found == one.expected || std::fabs(*one.found - one.expected) <= most) return {};
    return QString("%1 is %2, expected %3; ").arg(one.name).arg(*one.found, 0, 'g', 16).arg(one.expected, 0, 'g', 16);
}

inline void compareNumbers(std::initializer_list<ExactNumber> numbers)
{
    QString differences;
    for (const ExactNumber& one : numbers) differences += differenceOf(one);
    QVERIFY2(differences.isEmpty(), qPrintable(differences));
}

/// An undefined value, and words that its reason must contain.
struct MissingNumber {
    const char* name;
    stats::Value found;
    const char* why;
};

inline void compareReasons(std::initializer_list<MissingNumber> numbers)
{
    QString differences;
    for (const MissingNumber& one : numbers) {
        if (one.found.exists()) differences += QString("%1 exists; ").arg(one.name);
        if (!QString(one.found.why().c_str()).contains(one.why))
            differences += QString("%1: \"%2\" does not say \"%3\"; ").arg(one.name, one.found.why().c_str(), one.why);
    }
    QVERIFY2(differences.isEmpty(), qPrintable(differences));
}
