// Checks of numbers on the command line. Unlike CLI::Range and CLI::PositiveNumber they refuse NaN.
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <string>

namespace study::commands {

inline CLI::Validator finiteIn(double least, double most)
{
    char words[60];
    std::snprintf(words, sizeof words, "%g to %g", least, most);
    return CLI::Validator(
        [=, range = std::string(words)](std::string& text) {
            double value = 0;
            const bool good = CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value >= least && value <= most;
            return good ? std::string() : text + " is not a number from " + range;
        },
        words);
}

inline CLI::Validator aboveZero()
{
    return CLI::Validator(
        [](std::string& text) {
            double value = 0;
            const bool good = CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value > 0;
            return good ? std::string() : text + " is not a number above 0";
        },
        "above 0");
}

}  // namespace study::commands
