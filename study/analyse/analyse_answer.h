// Building the answer to a request, quantity by quantity.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "stats/kernels/value.h"

namespace study::analyse {

class Answer {
public:
    /// Null, and its reason in "why", where there is no number; a decimal where no double holds it.
    Answer& put(const std::string& field, const stats::Value& value);
    Answer& put(const std::string& field, const std::vector<stats::Value>& values);
    /// A probability; a decimal from its logarithm where it is below the smallest normal double.
    Answer& putProbability(const std::string& field, const stats::Value& p, const stats::Value& logP);
    /// `low` and `high` after the field: ci_low, ci_high.
    Answer& put(const std::string& field, const stats::Interval& interval);
    Answer& putCount(const std::string& field, std::size_t count);
    Answer& putText(const std::string& field, const nlohmann::ordered_json& text);
    /// Why a quantity that is given is not an ordinary number.
    Answer& explain(const std::string& field, const std::string& why);

    nlohmann::ordered_json json() const;

private:
    nlohmann::ordered_json m_fields = nlohmann::ordered_json::object();
    nlohmann::ordered_json m_why = nlohmann::ordered_json::object();
};

/// A number as JSON; "nan", "inf" and "-inf" in quotes.
nlohmann::ordered_json numberJson(double number);

/// The analysis is not defined for these data.
nlohmann::ordered_json degenerate(const std::string& reason);

}  // namespace study::analyse
