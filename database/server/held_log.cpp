#include "database/server/held_log.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "protocols/files/whole_file.h"

namespace database {

namespace {

bool isConfirmed(const EventRecord& entry) { return entry.sequence != 0; }

bool isSameEntry(const EventRecord& held, const EventRecord& onServer)
{
    return (!isConfirmed(held) || held.sequence == onServer.sequence) && held.sitting == onServer.sitting &&
           held.kind == onServer.kind && held.payloadJson == onServer.payloadJson && held.atNs == onServer.atNs;
}

}  // namespace

std::optional<std::string> differenceOf(const std::string& participant, const std::vector<EventRecord>& held,
                                        const std::vector<EventRecord>& onServer)
{
    const auto confirmed = static_cast<std::size_t>(std::ranges::count_if(held, isConfirmed));
    const std::size_t found = onServer.size();
    if (found < confirmed) return "lost entries of " + participant + " (" + std::to_string(confirmed - found) + ")";
    const auto [one, other] = std::ranges::mismatch(held, onServer, isSameEntry);
    if (other == onServer.end()) return std::nullopt;
    if (one != held.end() && isConfirmed(*one)) return "has other entries of " + participant;
    return "gained entries of " + participant + " (" + std::to_string(found - confirmed) + ")";
}

void confirmFirst(std::vector<EventRecord>& held, std::int64_t sequence)
{
    if (std::ranges::find(held, sequence, &EventRecord::sequence) != held.end()) return;
    const auto first = std::ranges::find_if_not(held, isConfirmed);
    if (first != held.end()) first->sequence = sequence;
}

std::filesystem::path keepHeldLog(const StudyFolder& folder, const std::string& participant, const std::vector<EventRecord>& held)
{
    std::string lines;
    for (const EventRecord& entry : held)
        lines += nlohmann::ordered_json{{"sequence", entry.sequence},   {"sitting", entry.sitting}, {"kind", entry.kind},
                                        {"payload", entry.payloadJson}, {"at_ns", entry.atNs},      {"wall_time", entry.wallTime}}
                     .dump() +
                 "\n";
    std::filesystem::path file;
    for (int number = 1; file.empty() || std::filesystem::exists(file); ++number)
        file = folder.folder / ("held-" + participant + "-" + std::to_string(number) + ".json");
    protocols::writeWholeFile(file, lines, protocols::Sync::Now, protocols::Readers::OwnerOnly);
    return file;
}

}  // namespace database
