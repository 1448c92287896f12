#include "reports/text/number_text.h"

#include <array>
#include <charconv>
#include <numbers>

namespace reports {

std::string fixed(double number, int decimals)
{
    std::array<char, 512> buffer;  // the largest double has 309 digits before the point
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number, std::chars_format::fixed, decimals).ptr;
    std::string text(buffer.data(), end);
    if (text.starts_with('-') && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
    return text;
}

std::string pText(double p)
{
    if (p < 0.001) return "< .001";
    if (p > 0.9994999) return "1.00";
    return fixed(p, 3).substr(1);
}

stats::Value writableP(const stats::Value& p, const stats::Value& logP)
{
    if (!p.exists() || *p != 0 || !logP.exists()) return p;
    return stats::Value::undefined("below the smallest double; log10 p = " + fixed(*logP / std::numbers::ln10, 2));
}

std::string percentText(double part, double whole) { return fixed(100 * part / whole, 0) + " %"; }

std::string typeset(const std::string& number) { return number.starts_with('-') ? "\u2212" + number.substr(1) : number; }

}  // namespace reports
