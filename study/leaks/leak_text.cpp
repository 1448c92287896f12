#include "study/leaks/leak_text.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

namespace study::leaks {

namespace {

using nlohmann::ordered_json;

constexpr const char* notCounted = "nobody gave the owner's passphrase: hits cannot be counted";
constexpr const char* answersAreEvidence =
    "The answers of the participants are no part of any attack: they are evidence that no seal can hide.";
constexpr const char* redrawnWithPresentDraws =
    "Designs were redrawn from the public seed with the draws of this version only. A study that versions up to 0.6.0 made was "
    "drawn by theirs from that seed itself: whoever has such a version can draw it again, upgraded or not.";
constexpr const char* memoryTells =
    "Whoever reads the memory of the running program finds the image on display and the station key. The program marks itself as "
    "not "
    "dumpable, which stops other programs of the same user, but not root. The way to close this is a server that keeps both keys "
    "and "
    "sends one image at a time.";

/// Which trials the guessers attacked, and the rule that chose them.
std::string attackedTrials(const LeakReport& report)
{
    if (report.trials == report.trialsOfStudy) return "all " + std::to_string(report.trials) + " trials of the study";
    return std::to_string(report.trials) + " of " + std::to_string(report.trialsOfStudy) +
           " trials: " + std::to_string(report.slots) + " of " + std::to_string(report.slotsOfStudy) +
           " running orders, in neighbouring pairs that are spread evenly over the study";
}

std::string percent(double share)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.0f %%", 100 * share);
    return text;
}

/// How good a guesser must be to be found: few trials find none.
std::string powerText(const std::optional<LeakReport::Power>& power)
{
    if (!power) return "; nothing could be guessed at, so this verdict says nothing";
    const std::string things = power->target == "true piece"  ? "true pieces"
                               : power->target == "condition" ? "conditions"
                                                              : "trials (" + power->target + ")";
    const std::string of = std::to_string(power->trials) + " " + things + " (chance " + percent(power->chance) + ")";
    if (!power->share)
        return "; with only " + of + " even one who names them all would not stand out: this verdict says nothing. " +
               std::string("Simulate a whole study of the same protocol and check that one");
    return "; one who names " + percent(*power->share) + " or more of " + of + " would stand out";
}

std::string verdictOfOperator(const LeakReport& report)
{
    if (report.isUnblinded) return "the study is unblinded: the folder holds the open allocation key";
    const auto above = report.aboveChance();
    if (!above.empty())
        return std::to_string(above.size()) + " of " + std::to_string(report.guesses.size()) +
               " guessers above chance, first: " + above.front()->attack + " (" + above.front()->what + ")";
    if (!report.hasTruth) return notCounted;
    const std::string guessers =
        "not above chance: " + std::to_string(report.guesses.size()) + " guessers" + powerText(report.power());
    return report.findings.empty() ? guessers : guessers + ", but see the findings";
}

std::string verdictOfStation(const LeakReport& report)
{
    const auto& key = report.stationKey;
    if (!key.isReadable) return "the station key cannot be read here";
    std::string text = std::to_string(key.named) + " of " + std::to_string(report.choices) + " true pieces named";
    if (report.hasTruth) text += ", " + std::to_string(key.hits) + " right";
    return text + "; " + std::to_string(key.images) +
           " unnamed images. Whoever looks at an image, or renders the data set, names its condition";
}

/// Null where no share of true pieces would stand out.
ordered_json leastShareFound(const std::optional<LeakReport::Power>& power)
{
    return power && power->share ? ordered_json(*power->share) : ordered_json();
}

const char* verdictOfOwner(const LeakReport& report) { return report.hasTruth ? "everything" : "everything; not opened here"; }

std::string line(const char* format, auto... values)
{
    char text[400];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

/// The guesser with the least p of each attack, and the number of its guessers. The hits of all guessers together would tell
/// much of the truth.
std::vector<std::pair<const Guess*, std::size_t>> bestOfEach(const LeakReport& report)
{
    std::vector<std::pair<const Guess*, std::size_t>> best;
    for (const Guess& guess : report.guesses) {
        const auto found = std::ranges::find_if(
            best, [&](const auto& other) { return other.first->attack == guess.attack && other.first->target == guess.target; });
        if (found == best.end()) {
            best.emplace_back(&guess, 1);
            continue;
        }
        ++found->second;
        if (guess.p < found->first->p) found->first = &guess;
    }
    return best;
}

}  // namespace

ordered_json jsonOf(const LeakReport& report)
{
    ordered_json guesses = ordered_json::array();
    for (const auto& [guess, count] : bestOfEach(report))
        guesses.push_back({{"attack", guess->attack},
                           {"what", guess->what},
                           {"target", guess->target},
                           {"guessers", count},
                           {"hits", guess->hits},
                           {"trials", guess->trials},
                           {"chance", guess->chance},
                           {"p", guess->p},
                           {"p_holm", guess->pAdjusted}});
    ordered_json why = ordered_json::object();
    if (!report.hasTruth)
        why["guessers"] = why["least_share_found"] = why["least_share_of"] = notCounted;
    else if (report.power() && leastShareFound(report.power()).is_null())
        why["least_share_found"] = "too few trials";
    else if (!report.power())
        why["least_share_found"] = why["least_share_of"] = "nothing could be guessed at";
    const auto& station = report.stationKey;
    ordered_json stationKey{{"readable", station.isReadable}, {"images", station.images}, {"pieces_named", station.named}};
    stationKey["pieces_right"] = report.hasTruth ? ordered_json(station.hits) : ordered_json();
    if (!report.hasTruth) stationKey["why"] = {{"pieces_right", notCounted}};
    return {
        {"schema", "vis2hap.leak-check/1"},
        {"study", report.study},
        {"trials", report.trials},
        {"trials_of_study", report.trialsOfStudy},
        {"attacked", attackedTrials(report)},
        {"choice_trials", report.choices},
        {"readable_values", report.features},
        {"alpha", alpha},
        {"least_share_found", leastShareFound(report.power())},
        {"least_share_of", report.power() ? ordered_json(report.power()->target) : ordered_json()},
        {"unblinded", report.isUnblinded},
        {"learns_nothing", report.learnsNothing()},
        {"findings", report.findings},
        {"open_modes", report.modes},
        {"guessers", report.hasTruth ? guesses : ordered_json()},
        {"station_key", stationKey},
        {"verdicts",
         {{"operator", verdictOfOperator(report)}, {"station_key", verdictOfStation(report)}, {"owner", verdictOfOwner(report)}}},
        {"notes", {answersAreEvidence, redrawnWithPresentDraws, memoryTells}},
        {"why", why}};
}

std::string textOf(const LeakReport& report)
{
    std::string text = line("%s: %zu trials, %zu of them choices, %zu readable values beside them\n", report.study.c_str(),
                            report.trials, report.choices, report.features);
    text += "attacked: " + attackedTrials(report) + "\n";
    if (report.hasTruth) {
        text += line("%-42s %-20s %8s %11s %7s %9s %9s\n", "attack", "target", "guessers", "best", "chance", "p", "p (Holm)");
        for (const auto& [guess, count] : bestOfEach(report))
            text += line("%-42s %-20s %8zu %5lld/%-5lld %6.1f%% %9.2g %9.2g%s\n", guess->attack.c_str(), guess->target.c_str(),
                         count, guess->hits, guess->trials, 100 * guess->chance, guess->p, guess->pAdjusted,
                         guess->pAdjusted < alpha ? (" *** " + guess->what).c_str() : "");
    }
    for (const auto& finding : report.findings) text += "finding: " + finding + "\n";
    for (const auto& mode : report.modes) text += "mode: " + mode + "\n";
    text += "operator with a shell, without both keys: " + verdictOfOperator(report) + "\n";
    if (!report.modes.empty())
        text += "other users of this computer: can read " + std::to_string(report.modes.size()) + " files and folders\n";
    text += "with the station key too: " + verdictOfStation(report) + "\n";
    text += std::string("with the owner's passphrase: ") + verdictOfOwner(report) + "\n";
    return text + answersAreEvidence + "\n" + redrawnWithPresentDraws + "\n" + memoryTells + "\n";
}

}  // namespace study::leaks
