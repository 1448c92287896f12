// A number, or the sentence that says why there is none. Every quantity of this module that can be
// undefined is returned as a Value. So no NaN, p = 0 or p = 1 stands in for "undefined".
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

namespace stats {

/// Thrown where the number of an undefined Value is read, which is a mistake of the program; what() holds
/// the reason why there is no number.
class UndefinedValueRead : public std::logic_error {
public:
    explicit UndefinedValueRead(const std::string& why);
};

/// 24 bytes: a report holds millions of values, and few of them are undefined. Copies share the reason.
class Value {
public:
    /// Undefined: "not computed".
    Value() : m_absence(std::shared_ptr<const Absence>(), &notComputed) {}
    Value(double number) : m_number(number) {}
    static Value undefined(std::string why);

    /// A number beyond the range of double: undefined for arithmetic, but printed with its digits.
    static Value beyondDouble(std::string decimal);

    bool exists() const { return m_absence == nullptr; }
    explicit operator bool() const { return exists(); }

    /// The number. Throws UndefinedValueRead where there is none.
    double operator*() const
    {
        if (!exists()) throwUndefined();
        return m_number;
    }
    double orElse(double other) const { return exists() ? m_number : other; }
    /// The reason why there is no number; without meaning where there is one.
    const std::string& why() const;
    /// "1.8584942812709108e+308" where the number is known but no double holds it; else empty.
    const std::string& decimal() const;

    /// Equal numbers, or equal reasons.
    bool operator==(const Value& other) const;

private:
    struct Absence;
    static const Absence notComputed;

    const Absence& absence() const { return exists() ? notComputed : *m_absence; }
    [[noreturn]] void throwUndefined() const;

    double m_number = 0;
    std::shared_ptr<const Absence> m_absence;  ///< null where the number exists
};

/// The two ends of an interval; -infinity or infinity marks the open end of a one-sided interval.
struct Interval {
    Value low;
    Value high;
    bool operator==(const Interval&) const = default;
};

}  // namespace stats
