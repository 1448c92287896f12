#include "study/records/display_response_record.h"

#include <nlohmann/json.hpp>
#include <set>

#include "database/disk/payload_fields.h"
#include "protocols/files/number_text.h"
#include "protocols/files/strict_json.h"
#include "reports/text/plain_words.h"

namespace study::records {

namespace {

using database::textIn;

/// A null value without a response.
nlohmann::json keptResponse(const database::StudyFacts& facts)
{
    const auto made = protocols::storedJson(facts.madeWith);
    return made.is_object() && made.contains(displayResponseField) ? made.at(displayResponseField) : nlohmann::json();
}

constexpr const char* notMeasured = "The response of the display was not measured: grey levels stand for friction.";
constexpr const char* mapped = "The images are mapped through this response.";

/// Zero where the field is missing or no number.
std::string sizeIn(const nlohmann::json& response, const char* field)
{
    const auto value = response.find(field);
    return protocols::shortest(value != response.end() && value->is_number() ? value->get<double>() : 0.0);
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
    if (!response.is_object()) return notMeasured;
    return "Friction of the display's glass was measured on " + textIn(response, "date") + " on " + textIn(response, "display") +
           " at " + sizeIn(response, "load_n") + " N and " + sizeIn(response, "speed_mm_per_s") + " mm/s with " +
           textIn(response, "finger") + " (SHA-256 " + textIn(response, "sha256").substr(0, 16) + "). " + mapped;
}

std::string publicDisplayResponseSentence(const database::StudyFacts& facts)
{
    if (!keptResponse(facts).is_object()) return notMeasured;
    return std::string("Friction of the display's glass was measured. ") + mapped;
}

std::string otherDisplaySentence(const database::StudyStore& store, const database::StudyFacts& facts, bool namesThem)
{
    const auto response = keptResponse(facts);
    if (!response.is_object()) return {};
    const std::string measured = textIn(response, "display");
    std::set<protocols::ParticipantId> people;
    for (const auto& enrolment : store.enrolments())
        if (enrolment.kind == database::ParticipantKind::Human) people.insert(enrolment.participant);
    std::set<std::string> others;
    std::size_t sittings = 0;
    for (const auto& sitting : store.eventsOfKind("sitting_started")) {
        const std::string used = textIn(database::payloadIn(sitting.payloadJson), "display");
        if (!people.contains(sitting.participant) || used.empty() || used == "none" || isThisDisplay(used, measured)) continue;
        others.insert(used);
        ++sittings;
    }
    if (others.empty()) return {};
    std::string names;
    for (const std::string& name : others) names += (names.empty() ? "" : ", ") + name;
    const auto named = [&](const std::string& name) { return namesThem ? " (" + name + ")" : std::string(); };
    return reports::counted(sittings, "sitting") + " used another display" + named(names) +
           " than the one whose response was measured" + named(measured) + ".";
}

}  // namespace study::records
