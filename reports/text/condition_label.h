// Typeset names of conditions: "h_g&f_g" is written as h and f with a subscript g. A name that is not among the nine conditions
// of the paper is not changed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "protocols/condition.h"

namespace reports {

/// A letter with its subscript; `after` follows it: "&" before the next part, "@fast" at the end, or nothing.
struct LabelPart {
    std::string letter;
    std::string subscript;
    std::string after;
};
std::vector<LabelPart> labelParts(const std::string& condition);

std::string htmlLabel(const std::string& condition);
std::string texLabel(const std::string& condition);
/// Content of a <text> element of SVG. A name of more than 24 characters is cut.
std::string svgLabel(const std::string& condition);
/// Text after the label of a condition. It returns to the line that a subscript at the end of the label has left.
std::string svgTextAfter(const std::string& condition, const std::string& escapedText);
/// Approximate width of the label in a figure, in characters.
double labelLength(const std::string& condition);

/// Vision, generated or measured; none for other names (K-labels, conditions of another study).
std::optional<protocols::ConditionGroup> groupOf(const std::string& condition);
std::string nameOf(protocols::ConditionGroup group);

}  // namespace reports
