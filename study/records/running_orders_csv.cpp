#include "study/records/running_orders_csv.h"

#include "protocols/files/csv_table.h"
#include "protocols/files/number_text.h"
#include "protocols/records/trial_lists.h"
#include "study/records/stored_study.h"

namespace study::records {

namespace {

using protocols::csvCell;
using protocols::shortest;

/// The code on the fabric piece, or the fabric's id where pieces have no codes.
std::string pieceName(const database::StudyFacts& facts, int slot, const protocols::FabricId& fabric)
{
    const auto index = static_cast<std::size_t>(slot) - 1;
    return index < facts.swatches.size() ? facts.swatches[index].at(fabric) : fabric.value;
}

std::string spaced(const std::vector<std::string>& words)
{
    std::string text;
    for (const auto& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
}

}  // namespace

std::string runningOrdersCsv(const database::StudyStore& store)
{
    const auto facts = store.facts();
    const auto protocol = latestProtocolOf(store);
    const bool instructs = hasInstructions(protocol);
    std::string text = std::string("slot,trial,questions,presentation_code,tray,minutes,sitting") +
                       (instructs ? ",instruction,deadline_seconds\n" : "\n");
    const std::string lists = store.folder().database().string() + ", list of slot ";
    for (const auto& slot : store.slots()) {
        const auto list = store.trials(slot.number);
        requireSoundList(list, protocol, facts.fabrics, lists + std::to_string(slot.number));
        for (const auto& trial : list) {
            std::vector<std::string> questions, tray;
            for (const auto& question : requiredPhase(protocol, trial).questions) questions.push_back(question.id.value);
            for (const auto& fabric : trial.alternatives) tray.push_back(pieceName(facts, slot.number, fabric));
            const double minutes = (trial.number.value - 1) * protocol.secondsPerPresentation / 60;
            const int sitting = 1 + static_cast<int>(minutes / protocol.sittingMinutes);
            text += std::to_string(slot.number) + "," + std::to_string(trial.number.value) + "," + csvCell(spaced(questions)) +
                    "," + trial.presentationCode.value + "," + csvCell(spaced(tray)) + "," + shortest(minutes) + "," +
                    std::to_string(sitting);
            if (instructs)
                text += "," + trial.instruction.value + "," + (trial.deadlineMs ? shortest(*trial.deadlineMs / 1000.0) : "");
            text += "\n";
        }
    }
    return text;
}

}  // namespace study::records
