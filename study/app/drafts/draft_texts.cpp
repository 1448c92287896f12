#include "study/app/drafts/draft_texts.h"

#include <algorithm>
#include <cmath>

#include "protocols/usual_texts.h"
#include "study/app/drafts/draft_edits.h"

namespace study::app {

namespace {

using Json = nlohmann::ordered_json;

std::string ownTextAt(const ProtocolDraft& draft, const std::string& object, const std::string& key)
{
    const Json& texts = draft.at(object);
    const auto found = texts.is_object() ? texts.find(key) : texts.end();
    return found != texts.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// Fills in the file's own texts, and adds its other keys.
void addOwnTexts(const ProtocolDraft& draft, const std::string& object, std::vector<KeyedText>& texts)
{
    for (KeyedText& text : texts) text.own = ownTextAt(draft, object, text.key);
    if (!draft.at(object).is_object()) return;
    for (const auto& [key, value] : draft.at(object).items())
        if (std::ranges::find(texts, key, &KeyedText::key) == texts.end())
            texts.push_back({key, {}, ownTextAt(draft, object, key)});
}

std::string shownText(const std::vector<KeyedText>& texts, const char* key)
{
    const auto found = std::ranges::find(texts, key, &KeyedText::key);
    if (found == texts.end()) return {};
    return found->own.empty() ? found->usual : found->own;
}

void addPrompt(std::vector<KeyedText>& prompts, const std::string& key, const std::string& said)
{
    if (std::ranges::find(prompts, key, &KeyedText::key) == prompts.end()) prompts.push_back({key, said, {}});
}

void addLetters(const ProtocolDraft& draft, std::size_t phase, std::vector<KeyedText>& prompts)
{
    const Json& alternatives = draft.at(phasePlace(phase, "alternatives"));
    const int letters = alternatives.is_number() ? std::clamp(static_cast<int>(alternatives.get<double>()), 0, 26) : 0;
    for (int letter = 0; letter < letters; ++letter) {
        const char name = static_cast<char>('A' + letter);
        addPrompt(prompts, std::string("answer_") + name, std::string(1, name));
    }
}

/// Whole numbers of the scale, and digits after the point where it has tenths.
void addNumbers(const ProtocolDraft& draft, std::size_t phase, std::vector<KeyedText>& prompts)
{
    constexpr double highestSaid = 100;
    const auto numberAt = [&](const char* key, double usual) {
        const Json& value = draft.at(phasePlace(phase, key));
        return value.is_number() ? value.get<double>() : usual;
    };
    if (!draft.at(phasePlace(phase, "scale")).is_object()) return;
    const double low = std::max(0.0, std::floor(numberAt("scale.min", 0)));
    const double high = std::min(highestSaid, numberAt("scale.max", 10));
    const double step = numberAt("scale.step", 0.1);
    if (step != std::floor(step))
        for (int digit = 0; digit <= 9; ++digit) addPrompt(prompts, "number_" + std::to_string(digit), std::to_string(digit));
    for (int number = static_cast<int>(low); number <= high; ++number)
        addPrompt(prompts, "number_" + std::to_string(number), std::to_string(number));
}

}  // namespace

std::vector<KeyedText> participantTextsOf(const ProtocolDraft& draft)
{
    std::vector<KeyedText> texts;
    for (const auto& [key, usual] : protocols::usualParticipantTexts(languageOf(draft))) texts.push_back({key, usual, {}});
    addOwnTexts(draft, "participant_texts", texts);
    return texts;
}

std::vector<KeyedText> promptsOf(const ProtocolDraft& draft)
{
    const std::vector<KeyedText> said = participantTextsOf(draft);
    std::vector<KeyedText> prompts;
    for (const auto& [key, text] : {std::pair("wait", "wait_title"), std::pair("feel", "feel_title"),
                                    std::pair("break", "break_title"), std::pair("end", "end_title")})
        prompts.push_back({key, shownText(said, text), {}});
    for (std::size_t phase = 0; phase < draft.countAt("phases"); ++phase)
        for (std::size_t i = 0; i < draft.countAt(phasePlace(phase, "questions")); ++i)
            if (const std::string id = questionIdAt(draft, phase, i); !id.empty())
                addPrompt(prompts, "question_" + id, sentenceOf(draft, id));
    for (std::size_t phase = 0; phase < draft.countAt("phases"); ++phase) addLetters(draft, phase, prompts);
    for (const char* key : {"same", "different", "point"})
        addPrompt(prompts, key, shownText(said, (std::string("spoken_") + key).c_str()));
    for (std::size_t phase = 0; phase < draft.countAt("phases"); ++phase) addNumbers(draft, phase, prompts);
    addOwnTexts(draft, "prompts", prompts);
    return prompts;
}

void setOwnText(ProtocolDraft& draft, const std::string& object, const std::string& key, const std::string& text)
{
    Json texts = draft.at(object);
    if (!texts.is_object()) texts = Json::object();
    if (text.empty())
        texts.erase(key);
    else
        texts[key] = text;
    if (texts.empty())
        draft.erase(object);
    else
        draft.set(object, texts);
}

}  // namespace study::app
