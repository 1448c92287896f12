// Whole numbers in JSON objects. The library's own get<int>() takes 4294967312 for 16 and cuts off fractions.
#pragma once

#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>

namespace protocols {

/// The whole number from 0 to 2^64 - 1 under this key. Throws std::out_of_range, naming the key, for any other value, and the
/// library's exception where the key is missing.
template <class Json>
std::uint64_t seedIn(const Json& object, const char* key)
{
    const Json& value = object.at(key);
    if (!value.is_number_unsigned() && !(value.is_number_integer() && value.template get<std::int64_t>() >= 0))
        throw std::out_of_range(std::string(key) + " is no whole number from 0 to 2^64 - 1");
    return value.template get<std::uint64_t>();
}

/// The same, from 0 to the largest int.
template <class Json>
int countIn(const Json& object, const char* key)
{
    constexpr int most = std::numeric_limits<int>::max();
    const Json& value = object.at(key);
    // A number beyond 2^63 becomes a negative one here.
    const std::int64_t count = value.is_number_integer() ? value.template get<std::int64_t>() : -1;
    if (count < 0 || count > most)
        throw std::out_of_range(std::string(key) + " is no whole number from 0 to " + std::to_string(most));
    return static_cast<int>(count);
}

/// The whole number. Throws the library's out_of_range for any other value, and for a number that does not fit.
template <class Whole, class Json>
Whole wholeOf(const Json& value)
{
    const bool fits = value.is_number_unsigned()
                          ? std::in_range<Whole>(value.template get<std::uint64_t>())
                          : value.is_number_integer() && std::in_range<Whole>(value.template get<std::int64_t>());
    if (!fits) throw Json::out_of_range::create(406, "expected a whole number within its range", &value);
    return value.template get<Whole>();
}

/// The same for the member under this key; `otherwise` where there is none.
template <class Whole, class Json>
Whole wholeIn(const Json& object, const char* key, Whole otherwise)
{
    const auto found = object.find(key);
    return found == object.end() ? otherwise : wholeOf<Whole>(*found);
}

}  // namespace protocols
