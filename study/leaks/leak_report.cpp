#include "study/leaks/leak_report.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "database/disk/station_key.h"
#include "protocols/files/errors.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/temporary_folder.h"
#include "protocols/records/anchor_trials.h"
#include "protocols/records/trial_lists.h"
#include "stats/tests/binomial.h"
#include "study/leaks/cache_marks.h"
#include "study/leaks/readable_files.h"
#include "study/leaks/removal_search.h"
#include "study/leaks/tray_counts.h"
#include "study/leaks/value_guessers.h"

namespace study::leaks {

namespace {

namespace fs = std::filesystem;

/// The stored lists, each read once. Throws workFailed where one is not of the protocol.
class StoredLists {
public:
    StoredLists(const database::StudyStore& store, const SeenStudy& seen)
        : m_store(store), m_protocol(seen.protocol), m_fabrics(store.facts().fabrics)
    {
    }

    const protocols::BlindedTrial& of(const SeenTrial& trial)
    {
        const auto [entry, isNew] = m_lists.try_emplace(trial.slot);
        auto& list = entry->second;
        const std::string where = m_store.folder().database().string() + ", list of slot " + std::to_string(trial.slot);
        if (isNew) {
            list = m_store.trials(trial.slot);
            requireSoundList(list, m_protocol, m_fabrics, where);
        }
        if (trial.number >= 1 && static_cast<std::size_t>(trial.number) <= list.size())
            return list[static_cast<std::size_t>(trial.number) - 1];
        throw protocols::workFailed({"trial " + std::to_string(trial.number) + " stands in two lists or in none", where,
                                     "1 to " + std::to_string(list.size()),
                                     "see `vis2hap verify`; restore the study from a backup"});
    }

private:
    const database::StudyStore& m_store;
    const protocols::Protocol& m_protocol;
    std::vector<protocols::FabricId> m_fabrics;
    std::map<int, std::vector<protocols::BlindedTrial>> m_lists;
};

Truth truthOf(const database::StudyStore& store, const protocols::AllocationKey& key, const SeenStudy& seen)
{
    Truth truth;
    StoredLists lists(store, seen);
    std::map<int, protocols::AnchorFinder> anchors;
    for (const SeenTrial& trial : seen.trials) {
        const auto& stored = lists.of(trial);
        const auto& entry = key.entryOf(stored);
        // The trials of a slot come in the order of its list.
        const auto anchor = anchors.try_emplace(trial.slot, seen.protocol).first->second.next(stored, entry);
        const bool isMismatched = anchor == protocols::AnchorKind::Mismatched;
        truth.trials.push_back({entry.fabric.value, isMismatched ? nameOf(anchor) : entry.condition.value, nameOf(anchor)});
    }
    for (const auto& [code, entry] : key.entries) truth.files[code.value] = {entry.fabric.value, entry.condition.value};
    return truth;
}

/// The images that the station key leads to, and the pieces that they name through the rating trials.
LeakReport::StationKey withStationKey(const database::StudyStore& store, const SeenStudy& seen, const std::optional<Truth>& truth)
{
    LeakReport::StationKey result;
    std::optional<protocols::SecretKey> key;
    try {
        key = database::readStationKey(store.folder(), store.facts().stationKeySha256);
    } catch (const protocols::Error&) {
        return result;
    }
    result.isReadable = true;
    StoredLists lists(store, seen);
    std::vector<std::string> images;
    // A mismatched presentation shows an image beside another fabric, so that the commonest one counts.
    std::map<std::string, std::map<std::string, int>> fabrics;
    for (const SeenTrial& trial : seen.trials) {
        const auto& stored = lists.of(trial);
        images.push_back(opened(stored.sealedCode, *key).value);
        if (seen.showsTruth(trial)) ++fabrics[images.back()][trial.tray.front()];
    }
    for (std::size_t i = 0; i < images.size(); ++i) {
        const auto named = fabrics.find(images[i]);
        if (!seen.isChoice(seen.trials[i]) || named == fabrics.end()) continue;
        ++result.named;
        const auto commonest = std::ranges::max_element(named->second, {}, [](const auto& fabric) { return fabric.second; });
        result.hits += truth && truth->trials[i].fabric == commonest->first;
    }
    result.images = std::set<std::string>(images.begin(), images.end()).size();
    return result;
}

/// As the making of the study says; studies of earlier versions do not.
bool isDrawnFromNumber(const database::StudyStore& store)
{
    const auto made = protocols::storedJson(store.facts().madeWith);
    const auto settings = made.is_object() ? made.find("settings") : made.end();
    if (settings == made.end() || !settings->is_object()) return false;
    const auto given = settings->find("key_seed_given");
    return given != settings->end() && given->is_boolean() && given->get<bool>();
}

/// A secret drawn from a small number can be found by trying all small numbers: a sealed code opens with the right one.
std::vector<std::string> guessedSecrets(const database::StudyStore& store, const SeenStudy& seen)
{
    constexpr std::uint64_t most = 1000;
    StoredLists lists(store, seen);
    const protocols::SealedCode& code = lists.of(seen.trials.front()).sealedCode;
    for (std::uint64_t seed = 0; seed <= most; ++seed) try {
            const std::uint64_t tried = seed == most ? seen.publicSeed : seed;
            opened(code, stationKeyOf(protocols::SecretKey::ofSeed(tried)));
            return {"the secret was drawn from the number " + std::to_string(tried) +
                    " (--key-seed): whoever tries small numbers opens the station key and the allocation"};
        } catch (const protocols::Error&) {
            continue;  // a wrong key, as expected
        }
    if (!isDrawnFromNumber(store)) return {};
    return {
        "the secret was drawn from a number (--key-seed): whoever guesses it, or reads it in the history of a shell, opens the "
        "station key and the allocation"};
}

std::set<std::string> codesOf(const SeenStudy& seen)
{
    std::set<std::string> codes;
    for (const SeenTrial& trial : seen.trials) codes.insert(trial.code);
    return codes;
}

std::size_t slotsIn(const SeenStudy& seen)
{
    std::set<int> slots;
    for (const SeenTrial& trial : seen.trials) slots.insert(trial.slot);
    return slots.size();
}

/// Every export that needs no key: words that it must not hold, and its tables for the guessers.
void readExports(const std::vector<Exporter>& exporters, const SeenStudy& seen, LeakReport& report,
                 std::vector<TextTable>& tables)
{
    for (const Exporter& exporter : exporters) {
        const protocols::TemporaryFolder folder;
        exporter.write(folder.path());
        for (const auto& line : namedInTexts(folder.path(), seen.protocol))
            report.findings.push_back(exporter.name + ": " + line);
        for (auto& table : tablesOfFolder(folder.path(), codesOf(seen))) {
            table.name = exporter.name + "/" + table.name;
            tables.push_back(std::move(table));
        }
    }
}

}  // namespace

std::vector<const Guess*> LeakReport::aboveChance() const
{
    std::vector<const Guess*> found;
    for (const Guess& guess : guesses)
        if (guess.pAdjusted < alpha) found.push_back(&guess);
    std::ranges::stable_sort(found, {}, [](const Guess* guess) { return guess->p; });
    return found;
}

std::optional<LeakReport::Power> LeakReport::power() const
{
    const bool hasChoices = std::ranges::find(guesses, "true piece", &Guess::target) != guesses.end();
    const Guess* largest = nullptr;
    for (const Guess& guess : guesses) {
        const bool isOfTrials = !guess.target.ends_with(" of a file");
        if (hasChoices ? guess.target != "true piece" : !isOfTrials) continue;
        if (largest == nullptr || guess.trials > largest->trials) largest = &guess;
    }
    if (largest == nullptr) return std::nullopt;
    Power power{largest->target, largest->trials, largest->chance, {}};
    const auto isFound = [&](long long hits) {
        const double p = *stats::binomialTest(hits, power.trials, power.chance).pGreater;
        return p * static_cast<double>(guesses.size()) < alpha;  // the first step of Holm's correction
    };
    for (long long hits = power.trials; hits > 0 && isFound(hits); --hits)
        power.share = static_cast<double>(hits) / static_cast<double>(power.trials);
    return power;
}

bool LeakReport::isTooSmallToTell() const
{
    const auto found = power();
    return hasTruth && !(found && found->share);
}

bool LeakReport::learnsNothing() const
{
    return hasTruth && !isUnblinded && findings.empty() && modes.empty() && aboveChance().empty() && !isTooSmallToTell();
}

LeakReport leakReport(const database::StudyStore& store, const std::optional<protocols::AllocationKey>& key,
                      const std::vector<Exporter>& exporters, const fs::path& cache, const std::vector<fs::path>& unknownFiles)
{
    const auto& folder = store.folder();
    LeakReport report;
    report.study = store.facts().name;
    report.isUnblinded = store.unblinding().has_value();
    report.modes = openModes(store.namedFolder());  // a copy has modes of its own
    auto tables = tablesOfDatabase(folder.database());
    const SeenStudy seen = seenStudy(tables);
    report.trials = seen.trials.size();
    report.slots = slotsIn(seen);
    report.trialsOfStudy = seen.trialsOfStudy;
    report.slotsOfStudy = seen.slotsOfStudy;
    report.choices = static_cast<std::size_t>(
        std::ranges::count_if(seen.trials, [&](const SeenTrial& trial) { return seen.isChoice(trial); }));
    if (fs::exists(folder.allocationKey()))
        report.findings.push_back("allocation-key.json lies open: whoever reads it knows everything");
    for (const auto& line : differencesOfStimuli(folder.stimuli())) report.findings.push_back(line);
    for (const auto& line : guessedSecrets(store, seen)) report.findings.push_back(line);
    const bool hasCache = !cache.empty() && fs::is_directory(cache);
    if (hasCache) {
        for (const auto& line : openModes(cache)) report.modes.push_back(line);
        auto codes = codesOf(seen);
        for (const auto& entry : fs::directory_iterator(folder.stimuli())) codes.insert(entry.path().stem().string());
        for (const auto& line : codesInCache(cache, codes)) report.findings.push_back(line);
    }
    std::set<fs::path> left{"study.db",      "study.db-wal", "study.db-shm",     "allocation-key.json",
                            "protocol.json", ".lock",        "station-key.json", "allocation-key.sealed",
                            "stimuli"};
    for (const fs::path& file : unknownFiles) {
        left.insert(file);
        report.findings.push_back(file.string() + " does not belong to the study and was not read: move it out of the folder");
    }
    for (auto& table : tablesOfFolder(folder.folder, codesOf(seen), left)) tables.push_back(std::move(table));
    if (!report.isUnblinded) readExports(exporters, seen, report, tables);
    auto features = featuresOf(seen, tables, folder.database());
    report.features = features.size();
    for (auto& count : trayCounts(seen)) features.push_back(std::move(count));
    std::optional<Truth> truth;
    if (key) truth = truthOf(store, *key, seen);
    report.hasTruth = truth.has_value();
    report.stationKey = withStationKey(store, seen, truth);
    if (!truth) return report;
    for (auto guesses : {guessesByValues(seen, features, *truth), guessesByTrays(seen, *truth), guessesOfAnchors(seen, *truth),
                         guessesOfRemovals(seen, *truth), guessesByFiles(marksOfStimuli(folder.stimuli()), *truth),
                         guessesByFiles(hasCache ? marksOfCache(cache, folder.stimuli()) : std::vector<FileMark>{}, *truth)})
        report.guesses.insert(report.guesses.end(), guesses.begin(), guesses.end());
    std::vector<Guess*> all;
    for (Guess& guess : report.guesses) all.push_back(&guess);
    correctForNumber(all);
    return report;
}

}  // namespace study::leaks
