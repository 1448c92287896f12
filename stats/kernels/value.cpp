#include "stats/kernels/value.h"

namespace stats {

UndefinedValueRead::UndefinedValueRead(const std::string& why) : std::logic_error("a value was read that does not exist: " + why)
{
}

void Value::throwUndefined() const { throw UndefinedValueRead(m_why); }

}  // namespace stats
