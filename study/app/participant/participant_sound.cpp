#include "study/app/participant/participant_sound.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "protocols/files/errors.h"
#include "study/app/language/below.h"
#include "study/app/state/rating_text.h"

namespace study::app {

using namespace participant;

namespace {

using Keys = std::vector<std::string>;

constexpr std::string_view numberKind = "number_";

/// The keys one after another: those of a number together, each other one alone.
std::vector<Keys> keysTogether(const Keys& keys)
{
    std::vector<Keys> together;
    for (const std::string& key : keys) {
        const std::string before = together.empty() ? std::string() : together.back().back();
        const bool isDecimal = before == "point" && together.back().size() > 1 && key.starts_with(numberKind);
        const bool goesOn = isDecimal || (key == "point" && before.starts_with(numberKind));
        if (goesOn)
            together.back().push_back(key);
        else
            together.push_back({key});
    }
    return together;
}

std::optional<PromptPart> partFor(const std::string& key, const SaidPrompts& prompts, bool hasVoice)
{
    if (const auto file = prompts.files.find(key); file != prompts.files.end()) return Recording{file->second};
    if (const auto text = prompts.texts.find(key); text != prompts.texts.end() && hasVoice) return SpokenText{text->second};
    return std::nullopt;
}

/// "number_5", "point", "number_4": 5.4.
protocols::Tenths numberOf(const Keys& keys)
{
    const auto digits = [](const std::string& key) { return std::stoi(key.substr(numberKind.size())); };
    return {digits(keys.front()) * 10 + (keys.size() > 2 ? digits(keys.back()) : 0)};
}

}  // namespace

PlayPrompts playedFor(const std::vector<std::string>& keys, const SaidPrompts& prompts, bool hasVoice)
{
    PlayPrompts play;
    for (const Keys& together : keysTogether(keys)) {
        Together all;
        for (const std::string& key : together)
            if (auto part = partFor(key, prompts, hasVoice)) all.parts.push_back(std::move(*part));
        if (all.parts.size() < together.size()) continue;
        if (all.parts.size() == 1)
            std::visit([&](auto& one) { play.prompts.emplace_back(std::move(one)); }, all.parts.front());
        else
            play.prompts.emplace_back(std::move(all));
    }
    return play;
}

std::optional<CutNumber> cutNumberIn(const std::vector<std::string>& keys, const SaidPrompts& prompts, bool hasVoice)
{
    const auto isMissing = [&](const std::string& key) { return !partFor(key, prompts, hasVoice); };
    for (const Keys& together : keysTogether(keys)) {
        const auto missing = std::ranges::find_if(together, isMissing);
        if (missing != together.end() && !std::ranges::all_of(together, isMissing))
            return CutNumber{numberOf(together), *missing};
    }
    return std::nullopt;
}

ParticipantSound::ParticipantSound(QObject* parent) : QObject(parent), m_process(new LineProcess(this))
{
    connect(m_process, &LineProcess::lineRead, this, &ParticipantSound::hear);
    connect(m_process, &LineProcess::ended, this, [this](const QString& why) {
        m_state.isOn = false;
        m_state.device.clear();
        m_state.voice.clear();
        m_state.fault = tr("The sound has stopped: %1").arg(why);
        Q_EMIT stateChanged();
    });
}

void ParticipantSound::setPrompts(SaidPrompts prompts)
{
    std::erase_if(prompts.texts,
                  [&](const auto& one) { return prompts.files.contains(one.first) || one.second.size() > longestSpokenText; });
    if (prompts == m_prompts) return;
    const bool isOtherLanguage = prompts.language != m_prompts.language || prompts.texts.empty() != m_prompts.texts.empty();
    m_prompts = std::move(prompts);
    m_state.recordings = static_cast<int>(m_prompts.files.size());
    m_state.texts = static_cast<int>(m_prompts.texts.size());
    if (m_state.isOn && isOtherLanguage) tellLanguage();
    Q_EMIT stateChanged();
}

void ParticipantSound::start(double noise, Speech speech)
{
    m_state.fault.clear();
    m_state.device.clear();
    m_speech = speech;
    try {
        m_process->start(QStringLiteral("vis2hap-sound"), {}, ProgramSurroundings::Own);
        m_state.isOn = true;
        setNoise(noise);
        tellLanguage();
    } catch (const protocols::Error& fault) {
        m_state.fault = inOwnLanguage(fault.what());
    }
    Q_EMIT stateChanged();
}

void ParticipantSound::setSpeech(Speech speech)
{
    m_speech = speech;
    if (m_state.isOn) tellLanguage();
    Q_EMIT stateChanged();
}

/// Asks for a voice; the program answers with its name or with what is missing.
void ParticipantSound::tellLanguage()
{
    m_state.voice.clear();
    m_state.noVoice.clear();
    const bool isWanted = m_speech == Speech::Wanted && !m_prompts.texts.empty();
    m_process->send(lineOf(LineToSound(SpeechLanguage{isWanted ? m_prompts.language : std::string()})));
}

void ParticipantSound::stop()
{
    m_process->stop();
    m_state.isOn = false;
    m_state.device.clear();
    m_state.voice.clear();
    m_state.noVoice.clear();
    m_state.fault.clear();
    Q_EMIT stateChanged();
}

void ParticipantSound::setNoise(double noise) { m_process->send(lineOf(LineToSound(NoiseLevel{noise}))); }

void ParticipantSound::say(const std::vector<std::string>& keys)
{
    if (!keys.empty()) Q_EMIT due(keys);
    if (!m_state.isOn) return;
    const bool hasVoice = !m_state.voice.isEmpty();
    const PlayPrompts play = playedFor(keys, m_prompts, hasVoice);
    if (!play.prompts.empty()) m_process->send(lineOf(LineToSound(play)));
    if (!keys.empty()) showCutNumber(cutNumberIn(keys, m_prompts, hasVoice));
}

/// The operator reads back what the headphones do not, each time.
void ParticipantSound::showCutNumber(const std::optional<CutNumber>& cut)
{
    const QString before = std::exchange(
        m_cutNumber, cut ? tr("The headphones do not read %1 back, because they have nothing for “%2”. Read it back yourself")
                               .arg(textOf(cut->number), QString::fromStdString(cut->missing))
                         : QString());
    if (!before.isEmpty() && m_state.fault == before) {
        m_state.fault.clear();
        Q_EMIT stateChanged();
    }
    if (!cut) return;
    m_state.fault = m_cutNumber;
    Q_EMIT stateChanged();
}

std::string ParticipantSound::someKey() const
{
    if (!m_prompts.files.empty()) return m_prompts.files.begin()->first;
    const auto question = m_prompts.texts.lower_bound("question_");
    return m_state.voice.isEmpty() || question == m_prompts.texts.end() ? std::string() : question->first;
}

void ParticipantSound::hear(const std::string& line)
{
    const auto said = participant::saidBySound(line);
    if (!said) return;
    const auto take = [](QString& shown, const std::optional<std::string>& text) {
        if (text) shown = QString::fromStdString(*text);
    };
    take(m_state.device, said->ready);
    take(m_state.voice, said->voice);
    take(m_state.noVoice, said->noVoice);
    take(m_state.fault, said->fault);
    Q_EMIT stateChanged();
}

}  // namespace study::app
