// Numbers as text for people and files, independent of the locale.
#pragma once

#include <string>

#include "protocols/files/number_text.h"
#include "stats/kernels/value.h"

namespace reports {

using protocols::fixed;

/// A probability as papers print it: ".032", "< .001", "1.00".
std::string pText(double p);

/// The p value itself, unless it is too small for a double: then undefined, with its power of ten as the reason.
stats::Value writableP(const stats::Value& p, const stats::Value& logP);
/// The same for a p value without a logarithm, such as a corrected one: a test never gives 0.
stats::Value writableP(const stats::Value& p);

/// "12 %" for 3 of 25.
std::string percentText(double part, double whole);

/// "−0.25": the hyphen of a negative number becomes a minus sign.
std::string typeset(const std::string& number);

}  // namespace reports
