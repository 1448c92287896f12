#include "study/bench/machine.h"

#include <fstream>
#include <thread>

#include "protocols/files/sha256.h"

namespace study::bench {

namespace {

/// "Debian GNU/Linux 12" of PRETTY_NAME="Debian GNU/Linux 12 (bookworm)"; empty where the system states none.
std::string systemName()
{
    std::ifstream release("/etc/os-release");
    const std::string field = "PRETTY_NAME=\"";
    for (std::string line; std::getline(release, line);)
        if (line.starts_with(field)) {
            const std::string name = line.substr(field.size(), line.find('"', field.size()) - field.size());
            return name.substr(0, name.find(" ("));
        }
    return {};
}

/// "AMD EPYC 7763 64-Core Processor" of "model name : …"; empty where the system states none.
std::string processorName()
{
    std::ifstream cpus("/proc/cpuinfo");
    for (std::string line; std::getline(cpus, line);)
        if (line.starts_with("model name"))
            if (const auto colon = line.find(": "); colon != std::string::npos) return line.substr(colon + 2);
    return {};
}

}  // namespace

std::string machineInWords()
{
    const unsigned cores = std::thread::hardware_concurrency();
    const std::string system = systemName();
    return std::to_string(cores) + (cores == 1 ? " core" : " cores") + (system.empty() ? "" : ", " + system);
}

std::string processorHash()
{
    const std::string processor = processorName();
    return processor.empty() ? processor : protocols::sha256(processor).substr(0, 12);
}

}  // namespace study::bench
