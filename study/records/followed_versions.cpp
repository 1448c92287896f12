#include "study/records/followed_versions.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "protocols/files/errors.h"
#include "protocols/protocol_json.h"
#include "protocols/usual_texts.h"
#include "reports/text/plain_words.h"

namespace study::records {

namespace {

using protocols::ParticipantId;
using protocols::Protocol;
using protocols::QuestionId;

/// In a damaged study without versions that cannot be read, but for the latest.
std::map<int, Protocol> protocolsByVersion(const database::StudyStore& store)
{
    const std::string madeBy = store.facts().programVersion;
    const auto versions = store.protocolVersions();
    std::map<int, Protocol> known;
    for (const auto& version : versions) try {
            known.emplace(version.version, protocols::keptProtocolFromJson(version.json, "the study's protocol", madeBy));
        } catch (const protocols::Error&) {
            if (&version == &versions.back()) throw;
        }
    return known;
}

/// The version of each participant who has not withdrawn. In a damaged study somebody may follow a version that is not there.
std::map<ParticipantId, int> versionsOfAnalysed(const database::StudyStore& store, const std::map<int, Protocol>& known)
{
    std::map<ParticipantId, int> versions;
    for (const auto& enrolment : store.enrolments())
        if (enrolment.state != database::SlotState::Withdrawn && known.contains(enrolment.protocolVersion))
            versions.emplace(enrolment.participant, enrolment.protocolVersion);
    return versions;
}

using ByVersion = std::map<int, std::set<ParticipantId>>;

/// The different texts of these versions, each with the participants to whom it was read.
std::vector<reports::SentenceWording> wordingsOf(const ByVersion& participants,
                                                 const std::function<std::string(int version)>& textIn)
{
    std::vector<reports::SentenceWording> wordings;
    for (const auto& [version, people] : participants) {
        const std::string text = textIn(version);
        auto same = std::ranges::find(wordings, text, &reports::SentenceWording::text);
        if (same == wordings.end()) same = wordings.insert(wordings.end(), {text, {}, {}});
        same->versions.push_back(version);
        for (const ParticipantId& one : people) same->participants.push_back(one.value);
    }
    return wordings;
}

/// Sets the text, and the wordings where there are several.
template <class Info>
void describeText(Info& info, const ByVersion& participants, int latest, const std::function<std::string(int version)>& textIn)
{
    auto wordings = wordingsOf(participants, textIn);
    info.text = wordings.empty() ? textIn(latest) : wordings.back().text;
    if (wordings.size() > 1) info.wordings = std::move(wordings);
}

const protocols::Phase* phaseAsking(const Protocol& protocol, const QuestionId& question)
{
    for (const protocols::Phase& phase : protocol.phases)
        if (std::ranges::find(phase.questions, question, &protocols::Question::id) != phase.questions.end()) return &phase;
    return nullptr;
}

std::string questionText(const Protocol& protocol, const QuestionId& question)
{
    const auto* asked = questionWith(protocol, question);
    return asked == nullptr ? std::string() : asked->text;
}

std::string instructionText(const Protocol& protocol, const QuestionId& question, const protocols::InstructionId& instruction)
{
    const auto* phase = phaseAsking(protocol, question);
    const auto* found = phase == nullptr ? nullptr : instructionWith(phase->instructions, instruction);
    return found == nullptr ? std::string() : found->text;
}

bool isEnglish(const std::string& tag) { return protocols::hasUsualTexts(tag) && protocols::usualTexts(tag).language == "en"; }

std::string languageSentence(const std::string& tag, const std::string& whose)
{
    const std::string text = "The language of " + whose + " is '" + tag + "'";
    if (isEnglish(tag)) return text + ".";
    if (!protocols::hasUsualTexts(tag)) return text + "; sentences that the protocol does not give are in English.";
    const protocols::UsualTexts& texts = protocols::usualTexts(tag);
    return text + "; the program's own sentences in " + texts.name + ": " +
           (texts.reviewer.empty() ? "translation not reviewed" : "translation reviewed by " + texts.reviewer) + ".";
}

/// Numbers of participants by language, in the order of the versions.
std::vector<std::string> languageSentences(const std::vector<std::pair<std::string, std::size_t>>& languages)
{
    if (languages.size() == 1) {
        const std::string& tag = languages.front().first;
        return isEnglish(tag) ? std::vector<std::string>() : std::vector{languageSentence(tag, "the participants")};
    }
    std::vector<std::string> sentences;
    for (const auto& [tag, people] : languages)
        sentences.push_back(languageSentence(tag, reports::counted(people, "participant")));
    return sentences;
}

std::string versionsSentence(const std::map<int, std::size_t>& participants)
{
    std::vector<std::string> parts;
    for (const auto& [version, people] : participants)
        parts.push_back((participants.size() == 1 ? "all analysed participants" : reports::counted(people, "participant")) +
                        " followed version " + std::to_string(version));
    return "The protocol was amended: " + reports::listed(parts) + ".";
}

}  // namespace

database::ProtocolVersion versionBeforeAnswers(const database::StudyStore& store)
{
    const auto versions = store.protocolVersions();
    if (versions.size() == 1) return versions.front();
    const auto answered = store.firstEventOfKind("answered"), unblinded = store.firstEventOfKind("unblinded");
    const auto isBefore = [](std::int64_t event, const std::optional<std::int64_t>& other) { return !other || event < *other; };
    database::ProtocolVersion last = versions.front();
    for (const auto& version : versions)
        if (isBefore(version.event, answered) && isBefore(version.event, unblinded)) last = version;
    return last;
}

void describeWordings(const database::StudyStore& store, const std::vector<database::CurrentAnswer>& answers,
                      reports::StudyData& data)
{
    const auto versions = store.protocolVersions();
    if (versions.size() == 1) return;
    const auto known = protocolsByVersion(store);
    const auto analysed = versionsOfAnalysed(store, known);
    std::map<QuestionId, ByVersion> asked;
    std::map<int, std::set<ParticipantId>> followed;
    for (const auto& answer : answers)
        if (const auto found = analysed.find(answer.participant); found != analysed.end() && !answer.voided) {
            asked[answer.record.question][found->second].insert(answer.participant);
            followed[found->second].insert(answer.participant);
        }
    for (const auto& version : versions)
        data.protocolVersions.push_back({version.version, version.sha256, followed[version.version].size()});
    const int latest = versions.back().version;
    for (reports::QuestionInfo& info : data.questions) {
        const QuestionId question(info.id);
        const ByVersion& participants = asked[question];
        describeText(info, participants, latest, [&](int version) { return questionText(known.at(version), question); });
        for (reports::InstructionInfo& one : info.instructions)
            describeText(one, participants, latest, [&](int version) {
                return instructionText(known.at(version), question, protocols::InstructionId(one.id));
            });
    }
}

std::vector<std::string> followedSentences(const database::StudyStore& store)
{
    const auto known = protocolsByVersion(store);
    if (known.size() == 1) return languageSentences({{known.begin()->second.language, 0}});
    std::map<int, std::size_t> participants;
    const auto answers = store.answerCounts();
    for (const auto& [participant, version] : versionsOfAnalysed(store, known))
        if (const auto given = answers.find(participant); given != answers.end() && given->second > 0) ++participants[version];
    if (participants.empty()) return languageSentences({{known.rbegin()->second.language, 0}});
    std::vector<std::pair<std::string, std::size_t>> languages;
    for (const auto& [version, people] : participants) {
        const std::string& tag = known.at(version).language;
        auto same = std::ranges::find(languages, tag, &std::pair<std::string, std::size_t>::first);
        if (same == languages.end()) same = languages.insert(languages.end(), {tag, 0});
        same->second += people;
    }
    auto sentences = languageSentences(languages);
    sentences.push_back(versionsSentence(participants));
    return sentences;
}

}  // namespace study::records
