// How a condition is written: "h_g&f_g" as h and f with a subscript g. Names that are not among the
// nine conditions of the paper are written as they are.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "protocols/condition.h"

namespace reports {

/// A letter with its subscript; `after` joins it with the next one ("&" or nothing).
struct LabelPart {
    std::string letter;
    std::string subscript;
    std::string after;
};
std::vector<LabelPart> labelParts(const std::string& condition);

std::string htmlLabel(const std::string& condition);
std::string texLabel(const std::string& condition);
/// Content of a <text> element; names of more than 24 characters are cut.
std::string svgLabel(const std::string& condition);
/// Characters that the label of a figure takes, roughly.
double labelLength(const std::string& condition);

/// Vision, generated or measured; none for other names (K-labels, conditions of another study).
std::optional<protocols::ConditionGroup> groupOf(const std::string& condition);
std::string nameOf(protocols::ConditionGroup group);

}  // namespace reports
