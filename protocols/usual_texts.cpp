#include "protocols/usual_texts.h"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "protocols/files/strict_json.h"
#include "protocols/texts/shipped_texts.h"

namespace protocols {

namespace {

using nlohmann::json;

/// Sentences of studies that were made before 0.6.0. Those of the questions are the paper's, except that Q1 leaves the number of
/// pieces out.
constexpr const char* choiceBefore06 = "Which of the showed fabric pieces does the haptic rendering match with?";
constexpr const char* consentBefore06 =
    "The participant has read the information sheet, was told that they may stop at any time without giving a reason, "
    "and has agreed to take part";
constexpr const char* strokeWordsBefore06 =
    "Stroke from left to right with one finger, lightly, at about the width of the hand in two seconds; lift the finger on the "
    "way back. Stroke the glass and the cloth the same way, as often as you like.";

Error faultOfTexts(const std::string& what, const std::string& where)
{
    return badInput({what, where, "the parts of protocols/texts/usual_texts.en.json", "add what is missing"});
}

/// The object at `key` as texts by key.
TextsByKey textsAt(const json& document, const char* key, const std::string& where)
{
    TextsByKey texts;
    const auto part = document.find(key);
    if (part == document.end() || !part->is_object()) throw faultOfTexts("'" + std::string(key) + "' is missing", where);
    for (const auto& [name, text] : part->items()) {
        if (!text.is_string()) throw faultOfTexts("'" + std::string(key) + "." + name + "' is no text", where);
        texts[name] = text.get<std::string>();
    }
    return texts;
}

std::vector<std::string> listAt(const json& document, const char* key, const std::string& where)
{
    const auto part = document.find(key);
    const auto isText = [](const json& one) { return one.is_string(); };
    if (part == document.end() || !part->is_array() || part->empty() || !std::ranges::all_of(*part, isText))
        throw faultOfTexts("'" + std::string(key) + "' is no list of texts", where);
    return part->get<std::vector<std::string>>();
}

std::string textAt(const json& document, const char* key, const std::string& where)
{
    const auto part = document.find(key);
    if (part == document.end() || !part->is_string()) throw faultOfTexts("'" + std::string(key) + "' is missing", where);
    return part->get<std::string>();
}

/// The parts that the file of another language must have as well, with the same names in braces. Nothing need stand between two
/// sentences.
void requireSameParts(const TextsByKey& texts, const TextsByKey& english, const std::string& part, const std::string& where)
{
    for (const auto& [key, text] : english) {
        const auto own = texts.find(key);
        if (own == texts.end() || (own->second.empty() && key != "between"))
            throw faultOfTexts("'" + part + "." + key + "' is missing", where);
        if (placeholdersIn(own->second) != placeholdersIn(text))
            throw faultOfTexts("'" + part + "." + key + "' has other names in braces than in English", where);
    }
    for (const auto& [key, text] : texts)
        if (!english.contains(key)) throw faultOfTexts("'" + part + "." + key + "' is no known text", where);
}

/// Whether a file says all that the English one says.
void requireSameParts(const UsualTexts& texts, const UsualTexts& english, const std::string& where)
{
    requireSameParts(texts.questions, english.questions, "questions", where);
    requireSameParts(texts.instructions, english.instructions, "instructions", where);
    requireSameParts(texts.letters, english.letters, "letters", where);
    requireSameParts(texts.participant, english.participant, "participant", where);
    requireSameParts(texts.ownData, english.ownData, "own_data", where);
}

/// The files of all languages, read once.
const std::vector<UsualTexts>& allUsualTexts()
{
    static const std::vector<UsualTexts> all = [] {
        std::vector<UsualTexts> read;
        for (const auto& file : shipped::usualTexts()) {
            const std::string where = std::string(file.name) + ".json";
            read.push_back(usualTextsFromJson(file.json, where));
            requireSameParts(read.back(), read.front(), where);
        }
        return read;
    }();
    return all;
}

/// Whether the tag (in small letters) asks for traditional characters: "zh-hant", or a place where they are usual.
bool isTraditionalChinese(std::string_view tag)
{
    const auto asksFor = [&](std::string_view part) { return tag.find(part) != std::string_view::npos; };
    if (!tag.starts_with("zh") || asksFor("hans")) return false;
    return asksFor("hant") || asksFor("tw") || asksFor("hk") || asksFor("mo");
}

const UsualTexts* textsOf(std::string_view language)
{
    std::string tag(language);
    std::ranges::transform(tag, tag.begin(), [](unsigned char c) { return std::tolower(c); });
    if (isTraditionalChinese(tag)) return nullptr;  // the file has simplified characters
    const auto found = std::ranges::find(allUsualTexts(), tag.substr(0, tag.find_first_of("-_")), &UsualTexts::language);
    return found == allUsualTexts().end() ? nullptr : &*found;
}

const std::string& valueOf(const TextsByKey& texts, std::string_view key) { return texts.find(key)->second; }

std::string inWords(const UsualTexts& texts, int number)
{
    const auto place = static_cast<std::size_t>(number);
    return place < texts.counts.size() ? texts.counts[place] : std::to_string(number);
}

std::string slotLetter(int slot) { return {static_cast<char>('A' + slot)}; }

/// "A, B or C"; a longer list than can be kept in mind becomes "A to K".
std::string lettersOf(const UsualTexts& texts, int pieces)
{
    constexpr int mostToName = 6;
    if (pieces > mostToName)
        return filledText(valueOf(texts.letters, "range"), {{"first", "A"}, {"last", slotLetter(pieces - 1)}});
    std::string letters = "A";
    for (int slot = 1; slot < pieces; ++slot)
        letters += valueOf(texts.letters, slot + 1 == pieces ? "last" : "between") + slotLetter(slot);
    return letters;
}

std::string choiceText(const UsualTexts& texts, const AnswerKind& task)
{
    const int pieces = piecesOnTray(task);
    if (pieces < 2) return valueOf(texts.questions, "choice_of_one");
    return filledText(valueOf(texts.questions, "choice"),
                      {{"count", inWords(texts, pieces)}, {"letters", lettersOf(texts, pieces)}});
}

constexpr const char* paperIds[] = {"Q1", "Q2", "Q3", "Q4"};

/// Keys of the texts about one end of the scale.
struct KeysOfEnd {
    const char *atLine, *onCard, *spoken;
};

constexpr KeysOfEnd keysOfLow{"scale_low", "card_low", "say_unrelated"}, keysOfHigh{"scale_high", "card_high", "say_same"};

/// The number and the protocol's own text for this end; empty where it has none. `number` is a name in braces.
std::string ownTextOf(const Protocol& protocol, const KeysOfEnd& end, const std::string& number)
{
    const TextsByKey own(protocol.participantTexts.begin(), protocol.participantTexts.end());
    if (own.contains(end.atLine)) return number + " " + valueOf(own, end.atLine);
    return filledText(own.contains(end.onCard) ? valueOf(own, end.onCard) : "", {{"number", number}});
}

/// Stands for "say_ends". An end without a text of its own has its usual words.
std::string bothEndsFrom(const Protocol& protocol)
{
    std::string low = ownTextOf(protocol, keysOfLow, "{low}"), high = ownTextOf(protocol, keysOfHigh, "{high}");
    if (low.empty() && high.empty()) return {};
    if (low.empty()) low = "{low} " + participantText(protocol, keysOfLow.atLine);
    if (high.empty()) high = "{high} " + participantText(protocol, keysOfHigh.atLine);
    const UsualTexts& texts = usualTexts(protocol.language);
    const bool isSentence = low.ends_with(".") || low.ends_with("。");
    return low + valueOf(isSentence ? texts.instructions : texts.letters, "between") + high;
}

/// Whether a rating has numbers only, so that texts describe its ends.
bool hasScaleOfNumbers(const Protocol& protocol)
{
    return std::ranges::any_of(protocol.phases, [](const Phase& phase) {
        return std::ranges::any_of(phase.questions, [](const Question& question) {
            const auto* rating = std::get_if<Rating>(&question.kind);
            return rating != nullptr && rating->scale.labels.empty();
        });
    });
}

}  // namespace

UsualTexts usualTextsFromJson(std::string_view text, const std::string& where)
{
    const json document = parseStrictJson(text, where);
    if (!document.is_object()) throw faultOfTexts("this is no object", where);
    return {.language = textAt(document, "language", where),
            .name = textAt(document, "name", where),
            .reviewer = textAt(document, "reviewer", where),
            .studyName = textAt(document, "study_name", where),
            .questions = textsAt(document, "questions", where),
            .instructions = textsAt(document, "instructions", where),
            .counts = listAt(document, "counts", where),
            .letters = textsAt(document, "letters", where),
            .consent = textAt(document, "consent", where),
            .strokeWords = textAt(document, "stroke_words", where),
            .checklist = listAt(document, "checklist", where),
            .readings = listAt(document, "readings", where),
            .facts = listAt(document, "facts", where),
            .participant = textsAt(document, "participant", where),
            .ownData = textsAt(document, "own_data", where)};
}

std::vector<std::string> languagesOfUsualTexts()
{
    std::vector<std::string> languages;
    for (const UsualTexts& texts : allUsualTexts()) languages.push_back(texts.language);
    return languages;
}

bool hasUsualTexts(std::string_view language) { return textsOf(language) != nullptr; }

const UsualTexts& usualTexts(std::string_view language)
{
    const UsualTexts* texts = textsOf(language);
    return texts ? *texts : allUsualTexts().front();
}

std::string paperProtocolIn(std::string_view language)
{
    const UsualTexts& texts = usualTexts(language);
    if (texts.language == "en") return std::string(shipped::paperProtocol());
    auto protocol = nlohmann::ordered_json::parse(shipped::paperProtocol());
    protocol["language"] = std::string(language);
    protocol["name"] = texts.studyName;
    for (const auto& phase : protocol.at("phases")) {
        const AnswerKind task =
            phase.contains("alternatives") ? AnswerKind(ForcedChoice{phase["alternatives"].get<int>()}) : AnswerKind(Rating{});
        for (const auto& id : phase.at("questions"))
            protocol["question_texts"][id.get<std::string>()] =
                usualTextOf(QuestionId(id.get<std::string>()), task, ProtocolEdition::Current, language);
    }
    protocol["consent"] = texts.consent;
    protocol["stroke_words"] = texts.strokeWords;
    protocol["checklist"] = texts.checklist;
    protocol["readings"] = texts.readings;
    protocol["facts"] = texts.facts;
    return protocol.dump(2) + "\n";
}

std::string usualTextOf(const QuestionId& question, const AnswerKind& task, ProtocolEdition edition, std::string_view language)
{
    if (std::ranges::find(paperIds, question.value) == std::end(paperIds)) return "";
    if (edition == ProtocolEdition::Before06) return question.value == "Q1" ? choiceBefore06 : paperWordingOf(question);
    const UsualTexts& texts = usualTexts(language);
    return question.value == "Q1" ? choiceText(texts, task) : valueOf(texts.questions, question.value);
}

std::string paperWordingOf(const QuestionId& question)
{
    if (question.value == "Q1") return "Which of the showed three fabric pieces does the haptic rendering match with?";
    if (question.value == "Q2") return "Does the haptic rendering have the same slipperiness as the physical fabric?";
    if (question.value == "Q3") return "Does the haptic rendering have the same texture as the physical fabric?";
    if (question.value == "Q4") return "How much realism of haptic rendering do you feel compared with physical fabric?";
    return "";
}

std::string wordingOf(const QuestionId& question, const AnswerKind& task, const std::string& text)
{
    const std::string paper = paperWordingOf(question);
    if (paper.empty()) return "";
    if (text == paper || text == usualTextOf(question, task, ProtocolEdition::Before06)) return "the paper's wording";
    for (const UsualTexts& texts : allUsualTexts()) {
        if (text != usualTextOf(question, task, ProtocolEdition::Current, texts.language)) continue;
        if (texts.language == "en") return "the corrected wording";
        return "the corrected wording in " + texts.name + ", " +
               (texts.reviewer.empty() ? "translation not reviewed" : "reviewed by " + texts.reviewer);
    }
    return "the study's own wording";
}

std::string usualConsent(ProtocolEdition edition, std::string_view language)
{
    return edition == ProtocolEdition::Before06 ? consentBefore06 : usualTexts(language).consent;
}

std::string usualStrokeWords(ProtocolEdition edition, std::string_view language)
{
    return edition == ProtocolEdition::Before06 ? strokeWordsBefore06 : usualTexts(language).strokeWords;
}

std::string usualInstructionText(const BlockInstruction& instruction, std::string_view language)
{
    const TextsByKey& texts = usualTexts(language).instructions;
    std::string text;
    switch (instruction.aim) {
        case SpeedAim::Speed:
            text = valueOf(texts, "speed");
            break;
        case SpeedAim::Accuracy:
            text = valueOf(texts, "accuracy");
            break;
        case SpeedAim::None:
            if (!instruction.deadlineSeconds) text = valueOf(texts, "both");
            break;
    }
    if (!instruction.deadlineSeconds) return text;
    std::string limit = shortest(*instruction.deadlineSeconds);
    const std::string_view key = limit == "1" ? "deadline_of_one" : "deadline";
    if (const auto point = limit.find('.'); point != std::string::npos)
        limit.replace(point, 1, valueOf(usualParticipantTexts(language), "decimal_mark"));
    return text + (text.empty() ? "" : valueOf(texts, "between")) + filledText(valueOf(texts, key), {{"seconds", limit}});
}

const TextsByKey& usualParticipantTexts(std::string_view language) { return usualTexts(language).participant; }

std::string textFromOwnEnds(const Protocol& protocol, std::string_view key)
{
    if (key == "say_ends") return bothEndsFrom(protocol);
    for (const KeysOfEnd& end : {keysOfLow, keysOfHigh})
        if (key == end.onCard || key == end.spoken) return ownTextOf(protocol, end, "{number}");
    return {};
}

std::string noteOnOwnEnds(const Protocol& protocol)
{
    std::string own, missing;
    const auto sort = [&](const char* key) {
        std::string& list = protocol.participantTexts.contains(key) ? own : missing;
        list += (list.empty() ? "" : ", ") + std::string(key);
    };
    const auto isOwn = [&](const KeysOfEnd& end) { return !ownTextOf(protocol, end, "{number}").empty(); };
    for (const KeysOfEnd& end : {keysOfLow, keysOfHigh})
        if (isOwn(end))
            for (const char* key : {end.atLine, end.onCard, end.spoken}) sort(key);
    if (own.empty() || !hasScaleOfNumbers(protocol)) return {};
    sort("say_ends");
    if (missing.empty()) return {};
    return "participant_texts: the study has its own " + own + ", but no " + missing +
           "; write them, too, so that every text describes the same ends of the scale";
}

std::set<std::string> placeholdersIn(std::string_view text)
{
    std::set<std::string> names;
    for (std::size_t from = text.find('{'); from != std::string_view::npos; from = text.find('{', from + 1)) {
        const std::size_t to = text.find('}', from);
        if (to == std::string_view::npos) break;
        names.emplace(text.substr(from + 1, to - from - 1));
    }
    return names;
}

std::string filledText(std::string text, const TextsByKey& values)
{
    for (const auto& [name, value] : values) {
        const std::string place = "{" + name + "}";
        for (std::size_t at = text.find(place); at != std::string::npos; at = text.find(place, at + value.size()))
            text.replace(at, place.size(), value);
    }
    return text;
}

}  // namespace protocols
