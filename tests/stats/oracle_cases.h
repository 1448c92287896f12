// Reads the shared reference cases (see their README) and compares answers in the same way as their scorer.
// Not a test by itself.
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
#include <string>
#include <vector>

namespace oracle {

using Json = nlohmann::json;

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
    if (parsed.ec != std::errc::result_out_of_range) return result;
    // a decimal beyond the range of double
    if (text.find("e-") != std::string::npos) return 0;
    return text.front() == '-' ? -infinity : infinity;
}

/// Digits of agreement, as the NIST data sets count them; at most 15.
inline double digits(double answer, double expected)
{
    if (std::isnan(expected) || std::isinf(expected) || std::isinf(answer) || std::isnan(answer))
        return answer == expected || (std::isnan(expected) && std::isnan(answer)) ? 15 : 0;
    const double error = std::fabs(answer - expected) / (expected == 0 ? 1 : std::fabs(expected));
    return error == 0 ? 15 : std::clamp(-std::log10(error), 0.0, 15.0);
}

inline QString told(const std::string& field, const Json& answer, const Json& expected)
{
    return QString("%1: got %2, expected %3; ").arg(field.c_str(), answer.dump().c_str(), expected.dump().c_str());
}

inline QString listFault(const std::string& field, const Json& answer, const Json& expected, double needed)
{
    if (!answer.is_array() || answer.size() != expected.size()) return told(field, answer, expected);
    for (std::size_t i = 0; i < expected.size(); ++i)
        if (digits(number(answer[i]), number(expected[i])) < needed) return told(field, answer, expected);
    return {};
}

/// The fault of one field, or empty. A field without required digits and without a tolerance is not compared.
inline QString fieldFault(const Json& one, const std::string& field, const Json& answer)
{
    const Json& expected = one["expected"][field];
    const bool isText = expected.is_string() && !std::isdigit(expected.get<std::string>().back()) && expected != "nan" &&
                        expected != "inf" && expected != "-inf";
    if (expected.is_boolean() || isText) return answer == expected ? QString() : told(field, answer, expected);
    const Json minima = one.value("min_lre", Json::object());
    const double needed = minima.contains(field) ? minima[field].get<double>() : one.contains("abs_tol") ? 15.0 : 0.0;
    if (expected.is_array()) return listFault(field, answer, expected, needed);
    const double off = std::fabs(number(answer) - number(expected));
    if (off <= 1e-300 || off <= one.value("abs_tol", -1.0)) return {};
    if (one.contains("field_abs_tol") && off <= one["field_abs_tol"].value(field, -1.0)) return {};
    if (one.contains("tol_ci") && (field == "ci_low" || field == "ci_high"))
        return off <= one["tol_ci"][field == "ci_high" ? 1 : 0].get<double>() ? QString() : told(field, answer, expected);
    return digits(number(answer), number(expected)) >= needed ? QString() : told(field, answer, expected);
}

/// All faults of an answer.
inline QString fault(const Json& one, const Json& answer)
{
    const auto status = one["status"].get<std::string>();
    const bool isFlagged = answer.contains("error") || (answer.contains("status") && answer.value("reason", "") != "");
    if (status == "degenerate" || status == "error" || status == "policy") {
        for (const auto& [field, value] : answer.items())
            if ((field == "p" || field.starts_with("p_")) && value.is_number()) return "must not have a p";
        return isFlagged ? "" : "must give a reason";
    }
    if (isFlagged) return status == "ok_or_error" ? QString() : "refused: " + QString::fromStdString(answer.dump());
    QString faults;
    for (const auto& [field, expected] : one["expected"].items()) {
        if (expected.is_null()) continue;
        faults += answer.contains(field) ? fieldFault(one, field, answer[field]) : QString("no %1; ").arg(field.c_str());
    }
    return faults;
}

}  // namespace oracle
