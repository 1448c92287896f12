// Whole numbers on the command line. CLI11 reads "010" as octal, and wraps numbers that do not fit.
#pragma once

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdint>
#include <string>

namespace protocols {

template <class Whole>
std::string faultOfWhole(const std::string& text)
{
    Whole value = 0;
    const char *begin = text.data(), *end = begin + text.size();
    const auto [read, problem] = std::from_chars(begin, end, value);
    const std::size_t sign = text.starts_with('-') ? 1 : 0;
    const bool isOctal = text.size() > sign + 1 && text[sign] == '0';
    return read == end && problem == std::errc{} && !isOctal ? "" : text + " is no whole number that fits, in plain digits";
}

/// Lets every option for whole numbers, of the command and its subcommands, take decimal digits alone.
inline void requirePlainWholeNumbers(CLI::App& app)
{
    for (CLI::Option* option : app.get_options()) {
        const std::string type = option->get_type_name();
        if (type.starts_with("UINT"))
            option->check(CLI::Validator([](std::string& text) { return faultOfWhole<std::uint64_t>(text); }, ""));
        else if (type.starts_with("INT"))
            option->check(CLI::Validator([](std::string& text) { return faultOfWhole<std::int64_t>(text); }, ""));
    }
    for (CLI::App* command : app.get_subcommands({})) requirePlainWholeNumbers(*command);
}

}  // namespace protocols
