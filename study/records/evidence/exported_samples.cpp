#include "study/records/evidence/exported_samples.h"

#include <algorithm>

#include "database/evidence/finger_records.h"
#include "protocols/files/csv_table.h"
#include "protocols/files/foreign/foreign_table.h"
#include "protocols/files/number_text.h"

namespace study::records {

namespace {

std::string cellOfValue(const std::optional<double>& value) { return value ? protocols::shortest(*value) : std::string(); }

}  // namespace

std::string fingerSamplesCsv(const database::StudyStore& store, const protocols::ParticipantId& participant,
                             const std::optional<Naming>& naming)
{
    std::vector<std::string> head{"participant", "trial", "attempt", "voided", "at_ns", "x_mm", "y_mm", "force_n"};
    const bool anchored = naming && std::ranges::any_of(naming->entries, [](const auto& entry) {
                              return entry.second.anchor != protocols::AnchorKind::None;
                          });
    if (naming) head.insert(head.end(), {"fabric", "condition"});
    if (anchored) head.emplace_back("anchor");
    std::string text = protocols::csvRow(head);
    eachFingerRecord(store, participant, [&](const database::FingerRecord& record) {
        std::vector<std::string> names;
        if (naming) {
            const auto named = naming->entries.find({record.participant, record.trial});
            const Naming::Entry entry = named == naming->entries.end() ? Naming::Entry{} : named->second;
            names = {protocols::safeCell(entry.fabric.value), protocols::safeCell(entry.condition)};
            if (anchored) names.push_back(nameOf(entry.anchor));
        }
        const auto add = [&](const std::vector<std::string>& values) {
            std::vector<std::string> cells{protocols::safeCell(record.participant.value), std::to_string(record.trial.value),
                                           std::to_string(record.attempt), record.voided ? "1" : "0"};
            cells.insert(cells.end(), values.begin(), values.end());
            cells.insert(cells.end(), names.begin(), names.end());
            text += protocols::csvRow(cells);
        };
        for (const protocols::FingerSample& sample : record.samples)
            add({std::to_string(sample.atNs), cellOfValue(sample.xMm), cellOfValue(sample.yMm), cellOfValue(sample.forceN)});
        for (int stretch = 0; stretch < record.unreadable; ++stretch) add({"", "", "", ""});
    });
    return text;
}

}  // namespace study::records
