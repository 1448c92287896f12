#include "reports/text/number_text.h"

#include <array>
#include <charconv>
#include <numbers>

namespace reports {
namespace {

template <typename... Format>
std::string written(double number, Format... format)
{
    std::array<char, 512> buffer;
    const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number, format...);
    return std::string(buffer.data(), result.ptr);
}

}  // namespace

std::string shortest(double number) { return written(number); }

std::string fixed(double number, int decimals)
{
    std::string text = written(number, std::chars_format::fixed, decimals);
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
