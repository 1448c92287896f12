#include "study/app/drafts/draft_edits.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "protocols/condition.h"
#include "protocols/protocol.h"

namespace study::app {

namespace {

using Json = nlohmann::ordered_json;

std::string textOr(const Json& value) { return value.is_string() ? value.get<std::string>() : std::string(); }

/// Ids of all questions, as often as they are asked.
std::vector<std::string> askedIds(const ProtocolDraft& draft)
{
    std::vector<std::string> ids;
    for (std::size_t phase = 0; phase < draft.countAt("phases"); ++phase)
        for (const Json& id : draft.at(phasePlace(phase, "questions")))
            if (id.is_string()) ids.push_back(id.get<std::string>());
    return ids;
}

/// An object of the document by its key, for keys that are no steps of a place ("a.b").
Json objectAt(const ProtocolDraft& draft, const char* key)
{
    const Json& value = draft.at(key);
    return value.is_object() ? value : Json::object();
}

void setObject(ProtocolDraft& draft, const char* key, const Json& object)
{
    if (object.empty())
        draft.erase(key);
    else
        draft.set(key, object);
}

/// Forgets sentences and recordings of questions that nobody asks any more.
void forgetUnasked(ProtocolDraft& draft, const std::string& id)
{
    if (std::ranges::count(askedIds(draft), id) > 0) return;
    Json texts = objectAt(draft, "question_texts"), prompts = objectAt(draft, "prompts");
    if (texts.erase(id) > 0) setObject(draft, "question_texts", texts);
    if (prompts.erase("question_" + id) > 0) setObject(draft, "prompts", prompts);
}

/// Copies the value of a key to another key, which has none yet.
void copyKey(ProtocolDraft& draft, const char* object, const std::string& from, const std::string& to)
{
    Json copied = objectAt(draft, object);
    if (!copied.contains(from) || copied.contains(to)) return;
    const Json value = copied[from];
    copied[to] = value;
    draft.set(object, copied);
}

std::string freeQuestionId(const ProtocolDraft& draft, PhaseKind kind)
{
    const std::vector<std::string> asked = askedIds(draft);
    // The paper's questions come with their sentences.
    const bool hasChoiceSentence = kind == PhaseKind::Choice, hasRatingSentence = kind == PhaseKind::Numbers;
    for (const char* usual : {"Q1", "Q2", "Q3", "Q4"}) {
        const bool fits = usual == std::string("Q1") ? hasChoiceSentence : hasRatingSentence;
        if (fits && std::ranges::count(asked, usual) == 0) return usual;
    }
    const std::string stem = kind == PhaseKind::OwnWords ? "Remarks" : kind == PhaseKind::SameDifferent ? "Same" : "Question";
    if (kind != PhaseKind::Words && stem != "Question" && std::ranges::count(asked, stem) == 0) return stem;
    for (int number = 1;; ++number)
        if (const std::string id = stem + std::to_string(number); std::ranges::count(asked, id) == 0) return id;
}

void addQuestionOf(ProtocolDraft& draft, std::size_t phase, PhaseKind kind)
{
    const std::string id = freeQuestionId(draft, kind);
    draft.set(phasePlace(phase, "questions") + "[" + std::to_string(draft.countAt(phasePlace(phase, "questions"))) + "]", id);
    if (kind == PhaseKind::OwnWords) setInOwnWords(draft, phase, id, true);
}

/// Whether the known condition `id` stands before `other` in the usual order; own conditions come last.
bool standsBefore(const std::string& id, const Json& other)
{
    if (!other.is_string() || protocols::faultOf(other.get<std::string>())) return true;
    return protocols::comesBefore(protocols::conditionIdFrom(id), protocols::conditionIdFrom(other.get<std::string>()));
}

/// Whether a question of the phase asks for a place on a scale.
bool isRated(const ProtocolDraft& draft, std::size_t phase)
{
    const PhaseKind kind = phaseKindOf(draft, phase);
    return draft.has(phasePlace(phase, "scale")) && (kind == PhaseKind::Numbers || kind == PhaseKind::Words);
}

/// The scale's ends as the program reads them: those of the usual scale where the draft has none.
protocols::RatingScale endsOf(const ProtocolDraft& draft, std::size_t phase)
{
    protocols::RatingScale scale;
    const auto take = [&](const char* key, protocols::Tenths& end) {
        const Json& typed = draft.at(phasePlace(phase, key));
        constexpr double farthest = 1e5;  // A number beyond it is a fault of its own.
        if (typed.is_number() && std::abs(typed.get<double>()) <= farthest)
            end.value = static_cast<int>(std::lround(10 * typed.get<double>()));
    };
    take("scale.min", scale.min);
    take("scale.max", scale.max);
    return scale;
}

std::string usualSpelling(const std::string& id) { return protocols::faultOf(id) ? id : protocols::conditionIdFrom(id).value; }

}  // namespace

std::string phasePlace(std::size_t phase, std::string_view key)
{
    const std::string place = "phases[" + std::to_string(phase) + "]";
    return key.empty() ? place : place + "." + std::string(key);
}

PhaseKind phaseKindOf(const ProtocolDraft& draft, std::size_t phase)
{
    if (draft.has(phasePlace(phase, "alternatives"))) return PhaseKind::Choice;
    if (draft.at(phasePlace(phase, "same_different")) == true) return PhaseKind::SameDifferent;
    const std::size_t questions = draft.countAt(phasePlace(phase, "questions"));
    std::size_t inOwnWords = 0;
    for (std::size_t i = 0; i < questions; ++i) inOwnWords += isInOwnWords(draft, phase, questionIdAt(draft, phase, i)) ? 1 : 0;
    if (questions > 0 && inOwnWords == questions) return PhaseKind::OwnWords;
    return draft.has(phasePlace(phase, "scale.labels")) ? PhaseKind::Words : PhaseKind::Numbers;
}

void setPhaseKind(ProtocolDraft& draft, std::size_t phase, PhaseKind kind)
{
    for (const char* key : {"alternatives", "same_different", "scale"}) draft.erase(phasePlace(phase, key));
    if (kind != PhaseKind::Choice) draft.erase(phasePlace(phase, "few_swaps"));
    const Json numbers{{"min", 0}, {"max", 10}, {"step", 0.1}, {"sections", 9}};
    const Json words{{"min", 1},
                     {"max", 5},
                     {"step", 1},
                     {"sections", 1},
                     {"labels", {"not at all", "a little", "somewhat", "mostly", "completely"}}};
    switch (kind) {
        case PhaseKind::Choice:
            draft.set(phasePlace(phase, "alternatives"), 3);
            break;
        case PhaseKind::SameDifferent:
            draft.set(phasePlace(phase, "same_different"), true);
            break;
        case PhaseKind::Words:
            draft.set(phasePlace(phase, "scale"), words);
            break;
        case PhaseKind::Numbers:
        case PhaseKind::OwnWords:  // a phase declares a kind, and a scale lays the true piece alone on the tray
            draft.set(phasePlace(phase, "scale"), numbers);
            break;
    }
    const bool isInWordsOnly = kind == PhaseKind::OwnWords;
    for (std::size_t i = 0; i < draft.countAt(phasePlace(phase, "questions")); ++i)
        setInOwnWords(draft, phase, questionIdAt(draft, phase, i), isInWordsOnly);
}

void addPhase(ProtocolDraft& draft, PhaseKind kind)
{
    const std::size_t phase = draft.countAt("phases");
    draft.set(phasePlace(phase), {{"questions", Json::array()}});
    setPhaseKind(draft, phase, kind);
    addQuestionOf(draft, phase, kind);
}

void removePhase(ProtocolDraft& draft, std::size_t phase)
{
    std::vector<std::string> ids;
    for (std::size_t i = 0; i < draft.countAt(phasePlace(phase, "questions")); ++i) ids.push_back(questionIdAt(draft, phase, i));
    draft.erase(phasePlace(phase));
    for (const std::string& id : ids) forgetUnasked(draft, id);
}

void exchangePhases(ProtocolDraft& draft, std::size_t a, std::size_t b)
{
    const Json first = draft.at(phasePlace(a));
    draft.set(phasePlace(a), draft.at(phasePlace(b)));
    draft.set(phasePlace(b), first);
}

std::string questionIdAt(const ProtocolDraft& draft, std::size_t phase, std::size_t question)
{
    return textOr(draft.at(phasePlace(phase, "questions") + "[" + std::to_string(question) + "]"));
}

void renameQuestion(ProtocolDraft& draft, std::size_t phase, std::size_t question, const std::string& id)
{
    const std::string before = questionIdAt(draft, phase, question);
    if (before == id) return;
    const bool inOwnWords = isInOwnWords(draft, phase, before);
    setInOwnWords(draft, phase, before, false);
    draft.set(phasePlace(phase, "questions") + "[" + std::to_string(question) + "]", id);
    setInOwnWords(draft, phase, id, inOwnWords);
    if (!id.empty()) copyKey(draft, "question_texts", before, id);
    if (!id.empty()) copyKey(draft, "prompts", "question_" + before, "question_" + id);
    forgetUnasked(draft, before);
}

void addQuestion(ProtocolDraft& draft, std::size_t phase) { addQuestionOf(draft, phase, phaseKindOf(draft, phase)); }

void removeQuestion(ProtocolDraft& draft, std::size_t phase, std::size_t question)
{
    const std::string id = questionIdAt(draft, phase, question);
    draft.erase(phasePlace(phase, "questions") + "[" + std::to_string(question) + "]");
    setInOwnWords(draft, phase, id, false);
    forgetUnasked(draft, id);
}

std::string sentenceOf(const ProtocolDraft& draft, const std::string& id)
{
    const Json& texts = draft.at("question_texts");
    const auto found = texts.is_object() ? texts.find(id) : texts.end();
    return found == texts.end() ? std::string() : textOr(*found);
}

void setSentence(ProtocolDraft& draft, const std::string& id, const std::string& sentence)
{
    Json texts = objectAt(draft, "question_texts");
    if (sentence.empty())
        texts.erase(id);
    else
        texts[id] = sentence;
    setObject(draft, "question_texts", texts);
}

bool isInOwnWords(const ProtocolDraft& draft, std::size_t phase, const std::string& id)
{
    const Json& list = draft.at(phasePlace(phase, "free_text"));
    return list.is_array() && std::find(list.begin(), list.end(), Json(id)) != list.end();
}

void setInOwnWords(ProtocolDraft& draft, std::size_t phase, const std::string& id, bool inOwnWords)
{
    if (isInOwnWords(draft, phase, id) == inOwnWords) return;
    Json list = draft.at(phasePlace(phase, "free_text"));
    if (!list.is_array()) list = Json::array();
    if (inOwnWords)
        list.push_back(id);
    else
        list.erase(std::find(list.begin(), list.end(), Json(id)));
    if (list.empty())
        draft.erase(phasePlace(phase, "free_text"));
    else
        draft.set(phasePlace(phase, "free_text"), list);
}

std::string languageOf(const ProtocolDraft& draft)
{
    const std::string language = textOr(draft.at("language"));
    return language.empty() ? "en" : language;
}

void takeLanguage(ProtocolDraft& draft, const std::string& language)
{
    if (languageOf(draft) == language) return;
    draft.set("language", language);
    for (const char* id : {"Q1", "Q2", "Q3", "Q4"}) setSentence(draft, id, {});
}

std::vector<DraftCondition> conditionsOf(const ProtocolDraft& draft)
{
    std::vector<DraftCondition> conditions;
    for (std::size_t i = 0; i < draft.countAt("conditions"); ++i) {
        const Json& one = draft.at("conditions[" + std::to_string(i) + "]");
        if (!one.is_object()) {
            conditions.push_back({usualSpelling(textOr(one)), {}, false});
            continue;
        }
        DraftCondition condition;
        for (const auto& [key, value] : one.items()) {
            if (key == "id")
                condition.id = textOr(value);
            else if (key == "program" && value == true)
                condition.byProgram = true;
            else
                condition.source += (condition.source.empty() ? "" : ", ") + (value.is_string() ? textOr(value) : value.dump());
        }
        conditions.push_back(condition);
    }
    return conditions;
}

void setCondition(ProtocolDraft& draft, const std::string& id, bool isChosen)
{
    Json list = draft.at("conditions");
    if (!list.is_array()) list = Json::array();
    const auto found = std::find_if(list.begin(), list.end(), [&](const Json& one) {
        const std::string its = one.is_object() && one.contains("id") ? textOr(one.at("id")) : textOr(one);
        return usualSpelling(its) == id;
    });
    if (!isChosen && found != list.end())
        list.erase(found);
    else if (isChosen && found == list.end())
        list.insert(std::find_if(list.begin(), list.end(), [&](const Json& other) { return standsBefore(id, other); }), id);
    draft.set("conditions", list);
}

void addOwnCondition(ProtocolDraft& draft, const std::string& id, const std::string& folder)
{
    Json added{{"id", id}};
    if (folder.empty())
        added["program"] = true;
    else
        added["images"] = folder;
    draft.set("conditions[" + std::to_string(draft.countAt("conditions")) + "]", added);
}

std::vector<DraftContrast> contrastsOf(const ProtocolDraft& draft)
{
    const auto pairAt = [](const Json& pair) {
        const auto side = [&](std::size_t i) {
            return pair.is_array() && i < pair.size() ? usualSpelling(textOr(pair[i])) : std::string();
        };
        return DraftContrast{side(0), side(1)};
    };
    const DraftContrast primary = pairAt(draft.at("primary"));
    std::vector<DraftContrast> contrasts;
    for (std::size_t i = 0; i < draft.countAt("planned"); ++i) {
        contrasts.push_back(pairAt(draft.at("planned[" + std::to_string(i) + "]")));
        contrasts.back().isPrimary = draft.has("primary") && contrasts.back() == primary;
    }
    return contrasts;
}

void setContrasts(ProtocolDraft& draft, const std::vector<DraftContrast>& contrasts)
{
    Json planned = Json::array();
    for (const DraftContrast& contrast : contrasts) planned.push_back(Json::array({contrast.a, contrast.b}));
    const auto primary = std::ranges::find(contrasts, true, &DraftContrast::isPrimary);
    if (primary == contrasts.end())
        draft.erase("primary");
    else
        draft.set("primary", Json::array({primary->a, primary->b}));
    if (planned.empty())
        draft.erase("planned");
    else
        draft.set("planned", planned);
}

double usualBoundOf(const ProtocolDraft& draft)
{
    std::vector<protocols::Phase> ratings;
    for (std::size_t phase = 0; phase < draft.countAt("phases"); ++phase)
        if (isRated(draft, phase)) ratings.emplace_back().questions.push_back({{}, {}, protocols::Rating{endsOf(draft, phase)}});
    return protocols::usualBoundsOf(ratings).second;
}

}  // namespace study::app
