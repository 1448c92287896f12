// The answer to a request, built quantity by quantity.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "stats/kernels/value.h"

namespace study::analyse {

class AnswerFields {
public:
    /// Puts null with its reason in "why" for an undefined number, and a decimal for a number beyond the range of double.
    AnswerFields& put(const std::string& field, const stats::Value& value);
    AnswerFields& put(const std::string& field, const std::vector<stats::Value>& values);
    /// Puts a probability. Below the smallest normal double it is a decimal, computed from its logarithm.
    AnswerFields& putProbability(const std::string& field, const stats::Value& p, const stats::Value& logP);
    /// Puts two fields, with _low and _high behind the name: ci_low, ci_high.
    AnswerFields& put(const std::string& field, const stats::Interval& interval);
    AnswerFields& putCount(const std::string& field, std::size_t count);
    AnswerFields& putText(const std::string& field, const nlohmann::ordered_json& text);
    /// Puts an object with one entry for each name; reasons stand under "field.name".
    AnswerFields& put(const std::string& field, const std::vector<std::string>& names, const std::vector<stats::Value>& values);
    /// Adds the reason why a quantity is not an ordinary number.
    AnswerFields& explain(const std::string& field, const std::string& why);

    nlohmann::ordered_json json() const;

private:
    nlohmann::ordered_json m_fields = nlohmann::ordered_json::object();
    nlohmann::ordered_json m_why = nlohmann::ordered_json::object();
};

/// A number as JSON; "nan", "inf" and "-inf" in quotes.
nlohmann::ordered_json numberJson(double number);

/// The answer where the analysis is not defined for these data.
nlohmann::ordered_json degenerate(const std::string& reason);

}  // namespace study::analyse
