// What the numbers of a bench were measured on, in neutral words.
#pragma once

#include <string>

namespace study::bench {

/// "2 cores, Debian GNU/Linux 12". No name of the machine, its owner or its processor.
std::string machineInWords();

/// A short hash of the processor's name, which tells machines of another kind apart; empty where the system states none.
std::string processorHash();

}  // namespace study::bench
