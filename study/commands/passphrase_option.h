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

/// The file, the variable VIS2HAP_PASSPHRASE, or the terminal, in this order. `whose`: what the terminal asks for.
database::Passphrase passphraseFrom(const PassphraseOption& option, const std::string& whose = "owner's passphrase");

/// The same without asking on the terminal.
database::Passphrase givenPassphrase(const PassphraseOption& option);

/// A new passphrase for this key: a terminal asks twice. Throws badInput where there is none, and where
/// protocols::faultOfNewPassphrase() finds a fault.
std::string newPassphrase(const PassphraseOption& option, const std::string& key = "the allocation key of this study");

}  // namespace study::commands
