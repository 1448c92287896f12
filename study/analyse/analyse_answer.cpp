#include "study/analyse/analyse_answer.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "stats/kernels/distributions.h"

namespace study::analyse {

using nlohmann::ordered_json;

ordered_json numberJson(double number)
{
    if (std::isnan(number)) return "nan";
    if (std::isinf(number)) return number > 0 ? "inf" : "-inf";
    return number == 0 ? 0.0 : number;  // the sign of a zero carries no information here
}

namespace {

ordered_json valueJson(const stats::Value& value)
{
    if (value.exists()) return numberJson(*value);
    return value.decimal().empty() ? ordered_json() : ordered_json(value.decimal());
}

}  // namespace

AnswerFields& AnswerFields::put(const std::string& field, const stats::Value& value)
{
    m_fields[field] = valueJson(value);
    return value.exists() ? *this : explain(field, value.why());
}

AnswerFields& AnswerFields::put(const std::string& field, const std::vector<stats::Value>& values)
{
    m_fields[field] = ordered_json::array();
    for (const stats::Value& value : values) {
        m_fields[field].push_back(valueJson(value));
        if (!value.exists()) explain(field, value.why());
    }
    return *this;
}

AnswerFields& AnswerFields::put(const std::string& field, const std::vector<std::string>& names,
                                const std::vector<stats::Value>& values)
{
    m_fields[field] = ordered_json::object();
    for (std::size_t i = 0; i < names.size(); ++i) {
        m_fields[field][names[i]] = valueJson(values[i]);
        if (!values[i].exists()) explain(field + "." + names[i], values[i].why());
    }
    return *this;
}

AnswerFields& AnswerFields::putProbability(const std::string& field, const stats::Value& p, const stats::Value& logP)
{
    put(field, p);
    if (p.exists() && *p < std::numeric_limits<double>::min() && logP.exists() && std::isfinite(*logP))
        m_fields[field] = stats::decimalOfLogarithm(*logP);
    return *this;
}

AnswerFields& AnswerFields::put(const std::string& field, const stats::Interval& interval)
{
    return put(field + "_low", interval.low).put(field + "_high", interval.high);
}

AnswerFields& AnswerFields::putCount(const std::string& field, std::size_t count)
{
    m_fields[field] = count;
    return *this;
}

AnswerFields& AnswerFields::putText(const std::string& field, const ordered_json& text)
{
    m_fields[field] = text;
    return *this;
}

AnswerFields& AnswerFields::explain(const std::string& field, const std::string& why)
{
    m_why[field] = why;
    return *this;
}

ordered_json AnswerFields::json() const
{
    ordered_json whole = m_fields;
    if (!m_why.empty()) whole["why"] = m_why;
    return whole;
}

ordered_json degenerate(const std::string& reason) { return {{"status", "degenerate"}, {"reason", reason}}; }

}  // namespace study::analyse
