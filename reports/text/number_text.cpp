#include "reports/text/number_text.h"

#include <numbers>

namespace reports {

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

stats::Value writableP(const stats::Value& p)
{
    return p.exists() && *p == 0 ? stats::Value::undefined("below the smallest double") : p;
}

std::string percentText(double part, double whole) { return fixed(100 * part / whole, 0) + " %"; }

std::string typeset(const std::string& number) { return number.starts_with('-') ? "\u2212" + number.substr(1) : number; }

}  // namespace reports
