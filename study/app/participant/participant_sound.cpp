#include "study/app/participant/participant_sound.h"

#include <utility>

#include "study/app/language/below.h"

namespace study::app {

using namespace participant;

PlayPrompts playedFor(const std::vector<std::string>& keys, const SaidPrompts& prompts, bool hasVoice)
{
    PlayPrompts play;
    for (const std::string& key : keys)
        if (const auto file = prompts.files.find(key); file != prompts.files.end())
            play.prompts.emplace_back(Recording{file->second});
        else if (const auto text = prompts.texts.find(key); text != prompts.texts.end() && hasVoice)
            play.prompts.emplace_back(SpokenText{text->second});
    return play;
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
    const PlayPrompts play = playedFor(keys, m_prompts, !m_state.voice.isEmpty());
    if (!play.prompts.empty()) m_process->send(lineOf(LineToSound(play)));
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
