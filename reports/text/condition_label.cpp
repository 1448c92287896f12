#include "reports/text/condition_label.h"

#include <algorithm>

#include "protocols/files/markup_text.h"
#include "reports/text/tex_text.h"

namespace reports {
namespace {

const protocols::Condition* known(const std::string& condition)
{
    const bool isUsual = !protocols::faultOf(condition) && protocols::conditionIdFrom(condition).value == condition;
    return isUsual ? &protocols::conditionNamed(condition) : nullptr;
}

LabelPart partOf(const std::string& text, const std::string& after)
{
    const std::size_t underscore = text.find('_');
    if (underscore == std::string::npos) return {text, "", after};
    return {text.substr(0, underscore), text.substr(underscore + 1), after};
}

constexpr std::size_t longestFigureName = 24;

bool isContinuation(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

std::size_t characters(const std::string& text)
{
    return text.size() - static_cast<std::size_t>(std::count_if(text.begin(), text.end(), isContinuation));
}

/// The first `most` characters of UTF-8, with an ellipsis where some were cut.
std::string shortened(const std::string& text, std::size_t most)
{
    if (characters(text) <= most) return text;
    std::size_t end = 0;
    for (std::size_t count = 0; end < text.size(); ++end)
        if (!isContinuation(text[end]) && ++count == most) break;
    return text.substr(0, end) + "\u2026";
}

}  // namespace

std::vector<LabelPart> labelParts(const std::string& condition)
{
    if (known(condition) == nullptr) return {{condition, "", ""}};
    const std::size_t at = condition.find('@');
    const std::string row = condition.substr(0, at), quality = at == std::string::npos ? "" : condition.substr(at);
    const std::size_t ampersand = row.find('&');
    if (ampersand == std::string::npos) return {partOf(row, quality)};
    return {partOf(row.substr(0, ampersand), "&"), partOf(row.substr(ampersand + 1), quality)};
}

std::string htmlLabel(const std::string& condition)
{
    if (known(condition) == nullptr) return protocols::escapedMarkup(condition);
    std::string html = "<span class=\"cond\">";
    for (const LabelPart& part : labelParts(condition)) {
        html += "<i>" + part.letter + "</i>";
        if (!part.subscript.empty()) html += "<sub>" + part.subscript + "</sub>";
        html += protocols::escapedMarkup(part.after);
    }
    return html + "</span>";
}

std::string texLabel(const std::string& condition)
{
    if (known(condition) == nullptr) return escapedTex(condition);
    std::string tex;
    for (const LabelPart& part : labelParts(condition)) {
        tex += "$" + part.letter + (part.subscript.empty() ? "" : "_{\\mathrm{" + part.subscript + "}}") + "$";
        tex += part.after == "&" ? "\\,\\&\\," : part.after;
    }
    return tex;
}

std::string svgLabel(const std::string& condition)
{
    if (known(condition) == nullptr) return protocols::escapedMarkup(shortened(condition, longestFigureName));
    // Renderers disagree about baseline-shift, so each piece undoes the vertical shift of the piece before it.
    std::string svg;
    for (const LabelPart& part : labelParts(condition)) {
        svg += std::string("<tspan font-style=\"italic\"") + (svg.empty() ? "" : " dx=\"2\"") + ">" + part.letter + "</tspan>";
        if (!part.subscript.empty()) svg += "<tspan dy=\"4\" font-size=\"75%\">" + part.subscript + "</tspan>";
        if (!part.after.empty())
            svg += std::string("<tspan dx=\"2\"") + (part.subscript.empty() ? "" : " dy=\"-4\"") + ">" +
                   protocols::escapedMarkup(part.after) + "</tspan>";
    }
    return svg;
}

std::string svgTextAfter(const std::string& condition, const std::string& escapedText)
{
    const LabelPart last = labelParts(condition).back();
    const bool endsLow = !last.subscript.empty() && last.after.empty();
    return std::string("<tspan") + (endsLow ? " dy=\"-4\"" : "") + ">" + escapedText + "</tspan>";
}

double labelLength(const std::string& condition)
{
    if (known(condition) == nullptr) return static_cast<double>(characters(shortened(condition, longestFigureName)));
    double length = 0;
    for (const LabelPart& part : labelParts(condition))
        length += static_cast<double>(part.letter.size()) + 0.75 * static_cast<double>(part.subscript.size()) +
                  (part.after == "&" ? 1.8 : static_cast<double>(part.after.size()));
    return length;
}

std::optional<protocols::ConditionGroup> groupOf(const std::string& condition)
{
    if (const protocols::Condition* one = known(condition)) return one->group;
    return std::nullopt;
}

std::string nameOf(protocols::ConditionGroup group)
{
    switch (group) {
        case protocols::ConditionGroup::Vision:
            return "vision";
        case protocols::ConditionGroup::Generated:
            return "generated";
        case protocols::ConditionGroup::Measured:
            return "measured";
    }
    return {};
}

}  // namespace reports
