#include "stats/kernels/value.h"

#include <utility>

namespace stats {

UndefinedValueRead::UndefinedValueRead(const std::string& why) : std::logic_error("a value was read that does not exist: " + why)
{
}

struct Value::Absence {
    std::string why;
    std::string decimal;

    bool operator==(const Absence&) const = default;
};

const Value::Absence Value::notComputed{"not computed", ""};

Value Value::undefined(std::string why)
{
    Value value;
    value.m_absence = std::make_shared<const Absence>(Absence{std::move(why), ""});
    return value;
}

Value Value::beyondDouble(std::string decimal)
{
    Value value;
    value.m_absence =
        std::make_shared<const Absence>(Absence{"beyond the largest number that can be written as a double", std::move(decimal)});
    return value;
}

const std::string& Value::why() const { return absence().why; }

const std::string& Value::decimal() const { return absence().decimal; }

bool Value::operator==(const Value& other) const
{
    if (exists() || other.exists()) return exists() == other.exists() && m_number == other.m_number;
    return absence() == other.absence();
}

void Value::throwUndefined() const { throw UndefinedValueRead(why()); }

}  // namespace stats
