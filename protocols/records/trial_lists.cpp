#include "protocols/records/trial_lists.h"

#include <algorithm>

#include "protocols/files/errors.h"

namespace protocols {

namespace {

std::string nameOf(const BlindedTrial& trial) { return "trial " + std::to_string(trial.number.value); }

/// The fault of a list that the program did not write.
Error alteredList(const std::string& what, const std::string& where, const std::string& expected)
{
    return workFailed({what, where, expected, "see `vis2hap verify`; restore the study from a backup"});
}

const Phase& phaseAt(const Protocol& protocol, const BlindedTrial& trial, const std::string& where)
{
    const auto phases = static_cast<int>(protocol.phases.size());
    if (trial.phase < 0 || trial.phase >= phases)
        throw alteredList(nameOf(trial) + " has the phase " + std::to_string(trial.phase), where,
                          "a phase of the protocol, from 0 to " + std::to_string(phases - 1));
    return protocol.phases[static_cast<std::size_t>(trial.phase)];
}

}  // namespace

const Phase& requiredPhase(const Protocol& protocol, const BlindedTrial& trial)
{
    return phaseAt(protocol, trial, "the list of trials");
}

void requireSoundTrial(const BlindedTrial& trial, const Protocol& protocol, const std::vector<FabricId>& fabrics,
                       const std::string& where)
{
    (void)phaseAt(protocol, trial, where);
    if (trial.presentationCode.empty())
        throw alteredList(nameOf(trial) + " has no presentation code", where, "letters and digits");
    // A server gives out the tray together with the image, when the presentation is due.
    if (trial.alternatives.empty() && !trial.sealedCode.empty())
        throw alteredList(nameOf(trial) + " has an empty tray", where, "one or more fabrics of the study");
    for (const FabricId& fabric : trial.alternatives)
        if (std::ranges::find(fabrics, fabric) == fabrics.end())
            throw alteredList(nameOf(trial) + " has the unknown fabric " + fabric.value, where, "a fabric of the study");
}

void requireSoundList(const std::vector<BlindedTrial>& list, const Protocol& protocol, const std::vector<FabricId>& fabrics,
                      const std::string& where)
{
    if (list.empty()) throw alteredList("the list of trials is empty", where, "the presentations of a participant");
    int expected = 0;
    for (const BlindedTrial& trial : list) {
        if (trial.number.value != ++expected)
            throw alteredList(nameOf(trial) + " stands at place " + std::to_string(expected), where, "numbers that run from 1");
        requireSoundTrial(trial, protocol, fabrics, where);
    }
}

}  // namespace protocols
