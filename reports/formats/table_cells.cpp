#include "reports/formats/table_cells.h"

#include <cmath>

#include "protocols/files/markup_text.h"
#include "protocols/files/number_text.h"
#include "reports/text/condition_label.h"
#include "reports/text/number_text.h"
#include "reports/text/plain_words.h"
#include "reports/text/tex_text.h"

namespace reports {
namespace {

TableCell noValue(const std::string& why) { return {"-", "", "\u2013", "--", why, true}; }

const std::string& reasonOf(const stats::Interval& interval)
{
    return interval.low.exists() ? interval.high.why() : interval.low.why();
}

}  // namespace

TableCell textCell(const std::string& text) { return {text, text, protocols::escapedMarkup(text), escapedTex(text), "", false}; }

TableCell oneLineCell(const std::string& text)
{
    TableCell cell = textCell(text);
    cell.html.clear();
    for (const char c : protocols::escapedMarkup(text)) cell.html += c == ' ' ? "\u00A0" : std::string(1, c);
    return cell;
}

TableCell numericTextCell(const std::string& text)
{
    TableCell cell = textCell(text);
    cell.isNumber = true;
    return cell;
}

TableCell conditionCell(const std::string& condition)
{
    return {condition, condition, htmlLabel(condition), texLabel(condition), "", false};
}

TableCell blankCell() { return {"", "", "", "", "", true}; }

TableCell numberCell(const stats::Value& value, int decimals)
{
    if (!value.exists()) return noValue(value.why());
    if (!std::isfinite(*value)) return noValue("unbounded");
    const std::string text = fixed(*value, decimals);
    return {text, protocols::shortest(*value), typeset(text), "$" + text + "$", "", true};
}

TableCell countCell(std::size_t n)
{
    const std::string text = std::to_string(n);
    return {text, text, text, text, "", true};
}

TableCell pCell(const stats::Value& known)
{
    const stats::Value p = writableP(known);
    if (!p.exists()) return noValue(p.why());
    const std::string text = pText(*p);
    return {text, protocols::shortest(*p), protocols::escapedMarkup(text), text.starts_with('<') ? "$<$ .001" : text, "", true};
}

TableCell pCell(const stats::Value& p, const stats::Value& logP) { return pCell(writableP(p, logP)); }

TableCell intervalCell(const stats::Interval& interval, int decimals)
{
    if (!interval.low.exists() || !interval.high.exists()) return noValue(reasonOf(interval));
    const std::string low = fixed(*interval.low, decimals);
    const std::string high = fixed(*interval.high, decimals);
    return {"[" + low + ", " + high + "]",
            "[" + protocols::shortest(*interval.low) + ", " + protocols::shortest(*interval.high) + "]",
            "[" + typeset(low) + ", " + typeset(high) + "]",
            "$[" + low + ", " + high + "]$",
            "",
            true};
}

TableCell rangeCell(double low, double high, int decimals)
{
    const std::string from = fixed(low, decimals), to = fixed(high, decimals);
    const std::string text = from + " to " + to;
    return {text, text, typeset(from) + " to " + typeset(to), "$" + from + "$ to $" + to + "$", "", true};
}

TableCell meanSdCell(const stats::Value& mean, const stats::Value& sd, int decimals)
{
    TableCell cell = numberCell(mean, decimals);
    if (!mean.exists()) return cell;
    const std::string spread = sd.exists() ? fixed(*sd, decimals) : "-";
    cell.text += " \u00B1 " + spread;
    cell.html += " <span class=\"sd\">\u00B1 " + spread + "</span>";
    cell.tex += " $\\pm$ " + spread;
    return cell;
}

std::string questionColumn(const std::string& question)
{
    return lowerCase(question) == "condition" ? "question " + question : question;
}

}  // namespace reports
