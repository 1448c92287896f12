// The owner's passphrase on the command line: from a file, from the environment, or asked for on the terminal.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "database/keys.h"

namespace study::commands {

struct PassphraseOption {
    std::string file;
};

/// Adds --passphrase-file.
void addPassphraseOption(CLI::App& command, PassphraseOption& option);

/// The file, the variable VIS2HAP_PASSPHRASE, or the terminal, in this order.
database::Passphrase passphraseFrom(const PassphraseOption& option);

/// The same without asking on the terminal.
database::Passphrase givenPassphrase(const PassphraseOption& option);

/// The passphrase of a new study: a terminal asks twice. Throws badInput where there is none, or where it has less than 8
/// characters.
std::string newPassphrase(const PassphraseOption& option);

}  // namespace study::commands
