#include "reports/text/number_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
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

std::string replaced(const std::string& text, const auto& replacementOf)
{
    std::string result;
    for (const char c : text) {
        const std::string replacement = replacementOf(c);
        result += replacement.empty() ? std::string(1, c) : replacement;
    }
    return result;
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

std::string counted(std::size_t n, const std::string& singular)
{
    return std::to_string(n) + " " + singular + (n == 1 ? "" : "s");
}

std::string escapedHtml(const std::string& text)
{
    return replaced(text, [](char c) -> std::string {
        switch (c) {
            case '&':
                return "&amp;";
            case '<':
                return "&lt;";
            case '>':
                return "&gt;";
            case '"':
                return "&quot;";
            case '\'':
                return "&#39;";
            default:
                return {};
        }
    });
}

std::string escapedTex(const std::string& text)
{
    return replaced(text, [](char c) -> std::string {
        switch (c) {
            case '&':
            case '%':
            case '$':
            case '#':
            case '_':
            case '{':
            case '}':
                return std::string("\\") + c;
            case '~':
                return "\\textasciitilde{}";
            case '^':
                return "\\textasciicircum{}";
            case '\\':
                return "\\textbackslash{}";
            case '<':
                return "$<$";
            case '>':
                return "$>$";
            default:
                return {};
        }
    });
}

void putNull(Json& object, const std::string& key, const std::string& why)
{
    object[key] = nullptr;
    object["why"][key] = why;
}

void putReasonsLast(Json& object)
{
    if (!object.contains("why")) return;
    Json why = object["why"];
    object.erase("why");
    object["why"] = std::move(why);
}

void put(Json& object, const std::string& key, const stats::Value& value)
{
    if (!value.exists())
        putNull(object, key, value.why());
    else if (!std::isfinite(*value))
        putNull(object, key, "unbounded");
    else
        object[key] = *value;
}

void putWhole(Json& object, const std::string& key, const stats::Value& value)
{
    if (value.exists() && std::fabs(*value) < 1e15 && std::nearbyint(*value) == *value)
        object[key] = static_cast<std::int64_t>(*value);
    else
        put(object, key, value);
}

void putP(Json& object, const std::string& key, const stats::Value& p, const stats::Value& logP)
{
    if (p.exists() && *p == 0 && logP.exists())
        putNull(object, key, "below the smallest double; log10 p = " + fixed(*logP / std::numbers::ln10, 2));
    else
        put(object, key, p);
}

void put(Json& object, const std::string& key, const stats::Interval& interval)
{
    if (!interval.low.exists() || !interval.high.exists())
        putNull(object, key, interval.low.exists() ? interval.high.why() : interval.low.why());
    else
        object[key] = {*interval.low, *interval.high};
}

stats::Value valueOf(const Json& object, const std::string& key)
{
    if (object.is_object() && object.contains(key) && object[key].is_number()) return object[key].get<double>();
    if (object.is_object() && object.contains("why") && object["why"].is_object() && object["why"].contains(key))
        return stats::Value::undefined(object["why"][key].get<std::string>());
    return stats::Value::undefined("not given");
}

stats::Interval intervalOf(const Json& object, const std::string& key)
{
    if (object.is_object() && object.contains(key) && object[key].is_array() && object[key].size() == 2)
        return {object[key][0].get<double>(), object[key][1].get<double>()};
    const stats::Value none = valueOf(object, key);
    return {none, none};
}

}  // namespace reports
