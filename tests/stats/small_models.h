// Small data of mixed models that several tests share, and the comparison of one number.
#pragma once

#include <QTest>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "stats/models/mixed_model.h"

inline bool isNear(double a, double b, double relative)
{
    return std::fabs(a - b) <= relative * std::max(std::fabs(a), std::fabs(b));
}

inline void compare(const stats::Value& value, double expected, double relative, const std::string& what)
{
    QVERIFY2(value.exists(), (what + ": " + value.why()).c_str());
    QVERIFY2(isNear(*value, expected, relative),
             qPrintable(QString("%1: %2, expected %3").arg(what.c_str()).arg(*value, 0, 'g', 12).arg(expected, 0, 'g', 12)));
}

inline stats::Factor factor(const std::string& name, const std::vector<int>& levels)
{
    std::vector<std::string> values;
    for (const int level : levels) values.push_back(std::to_string(level));
    return stats::factorOf(name, values);
}

/// Eighteen ratings of six people, three conditions and two fabrics, with gaps.
inline stats::MixedModelData smallStudy()
{
    stats::MixedModelData data;
    data.y = {4.1, 6.1, 6.0, 3.2, 5.5, 5.8, 4.4, 6.9, 6.6, 5.4, 5.2, 7.9, 5.3, 6.6, 5.0, 7.3, 7.0, 4.2};
    data.fixed = stats::treatmentCoded(factor("c", {1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3, 2, 3, 1, 2, 3, 1}));
    data.random = {{factor("p", {1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4, 5, 5, 6, 6, 6, 2}), {}, ""},
                   {factor("f", {1, 2, 1, 2, 1, 2, 1, 2, 1, 2, 1, 2, 1, 1, 2, 1, 2, 1}), {}, ""}};
    return data;
}

inline const stats::RandomEffect& effectNamed(const stats::MixedModel& model, const std::string& name)
{
    return *std::find_if(model.random.begin(), model.random.end(), [&](const auto& effect) { return effect.name == name; });
}
