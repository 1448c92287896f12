// Reads the reference cases of the shared oracle (see its README) and compares answers as its scorer
// does. Not a test by itself.
#pragma once

#include <QByteArray>
#include <QString>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "stats/value.h"

namespace oracle {

using Json = nlohmann::json;
using Answer = std::map<std::string, stats::Value>;

inline std::filesystem::path sharedFolder()
{
    const QByteArray named = qgetenv("VIS2HAP_SHARED");
    if (!named.isEmpty()) return named.toStdString();
    return std::filesystem::path(VIS2HAP_SOURCE_DIR) / ".." / "shared";
}

/// "nan", "inf", "-inf", decimal strings, null and numbers as doubles.
inline double number(const Json& value)
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (value.is_null()) return std::numeric_limits<double>::quiet_NaN();
    if (value.is_number()) return value.get<double>();
    const auto text = value.get<std::string>();
    if (text == "nan") return std::numeric_limits<double>::quiet_NaN();
    double result = 0;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), result);
    if (parsed.ec == std::errc::result_out_of_range)  // a decimal string beyond the doubles
        return text.front() == '-' ? -infinity : infinity;
    return result;
}

/// An array of numbers, or the recipe of a large one.
inline std::vector<double> numbers(const Json& value)
{
    std::vector<double> result;
    if (value.is_object()) {
        const auto n = value.at("n").get<std::uint64_t>();
        const double offset = number(value.at("offset"));
        for (std::uint64_t i = 0; i < n; ++i)
            result.push_back(static_cast<double>((i * 2654435761U) % 4294967296U) / 4294967296.0 + offset);
        return result;
    }
    for (const Json& item : value) result.push_back(number(item));
    return result;
}

inline std::vector<std::vector<double>> rows(const Json& value)
{
    std::vector<std::vector<double>> result;
    for (const Json& row : value) result.push_back(numbers(row));
    return result;
}

/// Digits of agreement, as the NIST data sets count them; at most 15.
inline double digits(double answer, double expected)
{
    if (std::isnan(expected) || std::isinf(expected) || std::isinf(answer) || std::isnan(answer))
        return answer == expected || (std::isnan(expected) && std::isnan(answer)) ? 15 : 0;
    const double error = std::fabs(answer - expected) / (expected == 0 ? 1 : std::fabs(expected));
    return error == 0 ? 15 : std::clamp(-std::log10(error), 0.0, 15.0);
}

/// What is wrong with one field, or empty.
inline QString fieldFault(const Json& one, const std::string& field, const stats::Value& value)
{
    const double expected = number(one["expected"][field]);
    const double answer = value.orElse(std::numeric_limits<double>::quiet_NaN());
    if (!value.exists() && (std::isnan(expected) || std::isinf(expected)))
        return {};  // undefined on both sides, or beyond the doubles
    if (std::fabs(answer - expected) <= 1e-300) return {};
    if (one.contains("abs_tol") && std::fabs(answer - expected) <= one["abs_tol"].get<double>()) return {};
    if (one.contains("field_abs_tol") && one["field_abs_tol"].contains(field) &&
        std::fabs(answer - expected) <= one["field_abs_tol"][field].get<double>())
        return {};
    const Json minima = one.value("min_lre", Json::object());
    const double needed = minima.contains(field) ? minima[field].get<double>() : 0.0;
    if (!one.contains("abs_tol") && digits(answer, expected) >= needed) return {};
    return QString("%1: got %2 (%3), expected %4 to %5 digits")
        .arg(QString::fromStdString(field))
        .arg(answer, 0, 'g', 17)
        .arg(QString::fromStdString(value.why()))
        .arg(expected, 0, 'g', 17)
        .arg(needed);
}

/// All faults of an answer; `why` is the reason it gives for having no result; `later` are fields that
/// the module does not compute.
inline QString fault(const Json& one, const Answer& answer, const std::string& why, const std::set<std::string>& later)
{
    const auto status = one["status"].get<std::string>();
    if (status == "degenerate" || status == "error" || status == "policy") {
        for (const auto& [field, value] : answer)
            if ((field == "p" || field.starts_with("p_")) && value.exists()) return "must not have a p";
        return why.empty() ? "must give a reason" : "";
    }
    if (!why.empty()) return status == "ok_or_error" ? QString() : "refused: " + QString::fromStdString(why);
    QString faults;
    for (const auto& [field, expected] : one["expected"].items()) {
        if (later.count(field) || expected.is_array() || expected.is_boolean()) continue;
        if (expected.is_string() && (field == "verdict")) continue;
        if (!answer.count(field))
            faults += QString("no %1; ").arg(QString::fromStdString(field));
        else if (const QString one_fault = fieldFault(one, field, answer.at(field)); !one_fault.isEmpty())
            faults += one_fault + "; ";
    }
    return faults;
}

}  // namespace oracle
