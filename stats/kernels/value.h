// A number, or the sentence that says why there is none. Every quantity of this module that can be
// undefined is returned as a Value. So no NaN, p = 0 or p = 1 stands in for "undefined".
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace stats {

/// Thrown where the number of an undefined Value is read, which is a mistake of the program; what() holds
/// the reason why there is no number.
class UndefinedValueRead : public std::logic_error {
public:
    explicit UndefinedValueRead(const std::string& why);
};

class Value {
public:
    Value() = default;
    Value(double number) : m_number(number), m_exists(true) {}
    static Value undefined(std::string why)
    {
        Value value;
        value.m_why = std::move(why);
        return value;
    }

    /// A number beyond the range of double: undefined for arithmetic, but printed with its digits.
    static Value beyondDouble(std::string decimal)
    {
        Value value = undefined("beyond the largest number that can be written as a double");
        value.m_decimal = std::move(decimal);
        return value;
    }

    bool exists() const { return m_exists; }
    explicit operator bool() const { return m_exists; }

    /// The number. Throws UndefinedValueRead where there is none.
    double operator*() const
    {
        if (!m_exists) throwUndefined();
        return m_number;
    }
    double orElse(double other) const { return m_exists ? m_number : other; }
    const std::string& why() const { return m_why; }
    /// "1.8584942812709108e+308" where the number is known but no double holds it; else empty.
    const std::string& decimal() const { return m_decimal; }

    bool operator==(const Value&) const = default;

private:
    [[noreturn]] void throwUndefined() const;

    double m_number = 0;
    bool m_exists = false;
    std::string m_why = "not computed";
    std::string m_decimal;
};

/// The two ends of an interval; -infinity or infinity marks the open end of a one-sided interval.
struct Interval {
    Value low;
    Value high;
    bool operator==(const Interval&) const = default;
};

}  // namespace stats
