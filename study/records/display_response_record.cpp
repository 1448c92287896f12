#include "study/records/display_response_record.h"

#include <nlohmann/json.hpp>
#include <set>

#include "protocols/files/number_text.h"
#include "reports/text/plain_words.h"

namespace study::records {

namespace {

/// A null value without a response.
nlohmann::json keptResponse(const database::StudyFacts& facts)
{
    const auto made = nlohmann::json::parse(facts.madeWith, nullptr, false);
    return made.is_object() ? made.value(displayResponseField, nlohmann::json()) : nlohmann::json();
}

/// Drivers add their address to the name of the display: "Our display (exec:driver)".
bool isThisDisplay(const std::string& used, const std::string& measured)
{
    return used == measured || used.starts_with(measured + " (");
}

}  // namespace

std::string displayResponseSentence(const database::StudyFacts& facts)
{
    const auto response = keptResponse(facts);
    if (!response.is_object()) return "The response of the display was not measured: grey levels stand for friction.";
    return "Friction of the display's glass was measured on " + response.value("date", "") + " on " +
           response.value("display", "") + " at " + protocols::shortest(response.value("load_n", 0.0)) + " N and " +
           protocols::shortest(response.value("speed_mm_per_s", 0.0)) + " mm/s with " + response.value("finger", "") +
           " (SHA-256 " + response.value("sha256", "").substr(0, 16) + "). The images are mapped through this response.";
}

std::string otherDisplaySentence(const database::StudyStore& store, const database::StudyFacts& facts)
{
    const auto response = keptResponse(facts);
    if (!response.is_object()) return {};
    const std::string measured = response.value("display", "");
    std::set<protocols::ParticipantId> people;
    for (const auto& enrolment : store.enrolments())
        if (enrolment.kind == database::ParticipantKind::Human) people.insert(enrolment.participant);
    std::set<std::string> others;
    std::size_t sittings = 0;
    for (const auto& sitting : store.eventsOfKind("sitting_started")) {
        const auto payload = nlohmann::json::parse(sitting.payloadJson, nullptr, false);
        const std::string used = payload.is_object() ? payload.value("display", "") : "";
        if (!people.contains(sitting.participant) || used.empty() || used == "none" || isThisDisplay(used, measured)) continue;
        others.insert(used);
        ++sittings;
    }
    if (others.empty()) return {};
    std::string names;
    for (const std::string& name : others) names += (names.empty() ? "" : ", ") + name;
    return reports::counted(sittings, "sitting") + " used another display (" + names +
           ") than the one whose response was measured (" + measured + ").";
}

}  // namespace study::records
