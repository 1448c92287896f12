#include "study/participant/session/prompts.h"

#include <algorithm>
#include <string_view>

#include "protocols/usual_texts.h"

namespace study::participant {

namespace {

using namespace session;
using Keys = std::vector<std::string>;

Keys numberKeys(protocols::Tenths rating)
{
    if (rating.value < 0) return {};  // there is no recording of a minus
    Keys keys{"number_" + std::to_string(rating.value / 10)};
    if (rating.value % 10 != 0) {
        keys.emplace_back("point");
        keys.push_back("number_" + std::to_string(rating.value % 10));
    }
    return keys;
}

/// The sentence with this key; empty if the protocol gives none and its language has no usual texts.
std::string ownText(const protocols::Protocol& protocol, const std::string& key)
{
    const bool isOwn = protocol.participantTexts.contains(key);
    return isOwn || protocols::hasUsualTexts(protocol.language) ? protocols::participantText(protocol, key) : std::string();
}

std::string titleAndText(const protocols::Protocol& protocol, const std::string& key)
{
    const std::string title = ownText(protocol, key + "_title"), text = ownText(protocol, key + "_text");
    return title.empty() || text.empty() ? title + text : title + ". " + text;
}

bool isEnglish(const protocols::Protocol& protocol)
{
    return protocols::hasUsualTexts(protocol.language) && protocols::usualTexts(protocol.language).language == "en";
}

/// Whether a voice of the protocol's language can say the sentence. The program's English sentences need an English voice.
bool isSpoken(const protocols::Question& question, const protocols::Phase& phase, const protocols::Protocol& protocol)
{
    using Edition = protocols::ProtocolEdition;
    const bool isUsualEnglish = question.text == usualTextOf(question.id, phase.task, Edition::Current) ||
                                question.text == usualTextOf(question.id, phase.task, Edition::Before06);
    return isEnglish(protocol) || !isUsualEnglish;
}

/// The highest number that is read back, as protocols::isPromptKey() knows it.
int highestNumber(const protocols::Protocol& protocol)
{
    constexpr int usual = 100, highest = 999;
    int number = usual;
    for (const auto& phase : protocol.phases)
        for (const auto& question : phase.questions)
            if (const auto* rating = std::get_if<protocols::Rating>(&question.kind))
                number = std::max(number, rating->scale.max.value / 10);
    return std::min(number, highest);
}

constexpr std::string_view questionKind = "question_";

/// The text that a recording with this key says; empty for letters, numbers, and where the program has none.
std::string recordedText(const protocols::Protocol& protocol, const std::string& key)
{
    if (!key.starts_with(questionKind)) {
        const auto texts = spokenTexts(protocol);
        return texts.contains(key) ? texts.at(key) : std::string();
    }
    const auto* question = protocols::questionWith(protocol, protocols::QuestionId(key.substr(questionKind.size())));
    return question ? question->text : std::string();
}

std::string namesOfRecordings(const protocols::Protocol& protocol)
{
    std::string names;
    for (const auto& [key, file] : protocol.prompts) names += (names.empty() ? "" : ", ") + file;
    return names;
}

bool isPresenting(const View& view) { return std::holds_alternative<Presenting>(view.state.stage) && !view.state.paused; }

bool isAtTray(const View& view) { return std::holds_alternative<PlacingTray>(view.state.stage) && !view.state.paused; }

}  // namespace

Keys readBackOf(const GivenAnswer& answer, const std::vector<protocols::FabricId>& tray)
{
    return std::visit(
        protocols::Overloaded{[&](const protocols::FabricId& fabric) {
                                  const auto slot = std::find(tray.begin(), tray.end(), fabric) - tray.begin();
                                  const bool hasLetter = slot < static_cast<std::ptrdiff_t>(tray.size()) && slot < 26;
                                  return hasLetter ? Keys{std::string("answer_") + static_cast<char>('A' + slot)} : Keys();
                              },
                              [](const protocols::Tenths& rating) { return numberKeys(rating); },
                              [](const Sameness& sameness) { return Keys{sameness.same ? "same" : "different"}; },
                              [](const Words&) { return Keys(); }},
        answer);
}

Keys promptsBetween(const View& before, const View& now)
{
    Keys keys;
    if (now.state.answersStored == before.state.answersStored + 1 && !now.state.answers.empty())
        keys = readBackOf(now.state.answers.back().response, before.trayIds);
    const auto* asked = std::get_if<Presenting>(&now.state.stage);
    const auto* askedBefore = std::get_if<Presenting>(&before.state.stage);
    if (isPresenting(now)) {
        if (!isPresenting(before)) keys.emplace_back("feel");
        const bool isNew =
            !isPresenting(before) || asked->index != askedBefore->index || asked->question != askedBefore->question;
        if (isNew && now.question) keys.push_back("question_" + now.question->id.value);
    } else if (isAtTray(now) && (isPresenting(before) || std::holds_alternative<OnBreak>(before.state.stage))) {
        keys.emplace_back("wait");
    } else if (now.state.stage.index() != before.state.stage.index()) {
        if (std::holds_alternative<OnBreak>(now.state.stage)) keys.emplace_back("break");
        if (std::holds_alternative<Debriefing>(now.state.stage)) keys.emplace_back("end");
    }
    return keys;
}

std::map<std::string, std::string> spokenTexts(const protocols::Protocol& protocol)
{
    std::map<std::string, std::string> texts{
        {"wait", ownText(protocol, "wait_title")},   {"feel", ownText(protocol, "feel_title")},
        {"break", titleAndText(protocol, "break")},  {"end", titleAndText(protocol, "end")},
        {"same", ownText(protocol, "spoken_same")},  {"different", ownText(protocol, "spoken_different")},
        {"point", ownText(protocol, "spoken_point")}};
    for (const auto& phase : protocol.phases)
        for (const auto& question : phase.questions)
            if (isSpoken(question, phase, protocol)) texts["question_" + question.id.value] = question.text;
    for (char slot = 'A'; slot <= 'Z'; ++slot) texts[std::string("answer_") + slot] = std::string(1, slot);
    for (int number = 0; number <= highestNumber(protocol); ++number)
        texts["number_" + std::to_string(number)] = std::to_string(number);
    std::erase_if(texts, [](const auto& one) { return one.second.empty(); });
    return texts;
}

std::vector<std::string> notesOnRecordings(const protocols::Protocol& before, const protocols::Protocol& amended)
{
    const std::string stays = ", which the headphones go on with; only a new study takes new recordings";
    const bool isOtherLanguage = before.language != amended.language && !amended.prompts.empty();
    std::vector<std::string> notes;
    if (isOtherLanguage)
        notes.push_back("the language changes from " + before.language + " to " + amended.language +
                        ", but not that of the recordings " + namesOfRecordings(amended) + stays);
    for (const auto& [key, file] : amended.prompts) {
        const bool isOfQuestion = key.starts_with(questionKind);
        if ((isOtherLanguage && !isOfQuestion) || recordedText(before, key) == recordedText(amended, key)) continue;
        notes.push_back("the text of " + (isOfQuestion ? key.substr(questionKind.size()) : "the prompt " + key) +
                        " changes, but not its recording " + file + stays);
    }
    return notes;
}

}  // namespace study::participant
