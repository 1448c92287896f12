// The participant's headphones: masking noise, the recordings of the study, and speech for prompts without one, played by
// vis2hap-sound. That program runs only while the operator wants sound, and the session never waits for it.
#pragma once

#include <QObject>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "protocols/protocol.h"
#include "study/app/participant/line_process.h"
#include "study/participant/sound/sound_lines.h"

namespace study::app {

/// The sound as the operator sees it.
struct SoundState {
    bool isOn = false;  ///< the operator has started the sound
    QString device;     ///< empty until it plays
    int recordings = 0;
    int texts = 0;    ///< prompts without a recording that an engine could speak
    QString voice;    ///< of the engine; empty until it has one
    QString noVoice;  ///< why no engine speaks, with the next step; empty if one does, or if none is wanted
    QString fault;    ///< why nothing is heard, or which prompt cannot be played
};

/// What the headphones can say of a study, by the keys of protocols::isPromptKey().
struct SaidPrompts {
    std::map<std::string, std::string> files;  ///< recordings
    std::map<std::string, std::string> texts;  ///< for an engine; a recording of the same key always wins
    std::string language = "en";               ///< of the texts, BCP 47
    bool operator==(const SaidPrompts&) const = default;
};

/// What is played for these keys, in their order: the recording, else the text if there is a voice. Other keys are left out. A
/// number is played whole or not at all.
participant::PlayPrompts playedFor(const std::vector<std::string>& keys, const SaidPrompts& prompts, bool hasVoice);

/// A number that only a part of could be played.
struct CutNumber {
    protocols::Tenths number;
    std::string missing;  ///< the first key without recording and voice, such as "point"
    bool operator==(const CutNumber&) const = default;
};
/// The number among these keys that playedFor() leaves out although it could play a part of it; none if there is none.
std::optional<CutNumber> cutNumberIn(const std::vector<std::string>& keys, const SaidPrompts& prompts, bool hasVoice);

enum class Speech { Wanted, RecordingsOnly };

class ParticipantSound : public QObject {
    Q_OBJECT
public:
    explicit ParticipantSound(QObject* parent);

    /// Empty without a study.
    void setPrompts(SaidPrompts prompts);
    /// What can be said now; a text only where there is no recording.
    const SaidPrompts& prompts() const { return m_prompts; }
    /// `noise`: root mean square of the masking noise, 0 to 0.3 of full scale.
    void start(double noise, Speech speech);
    void stop();
    void setNoise(double noise);
    void setSpeech(Speech speech);
    /// Plays the prompts of these keys in place of those that still play; keys without a recording or text are left out. Nothing
    /// is played while the sound is off.
    void say(const std::vector<std::string>& keys);
    /// The key of a prompt that can be played now: a recording, else a spoken text; empty if there is none.
    std::string someKey() const;
    const SoundState& state() const { return m_state; }
    /// 0 while the program does not run.
    qint64 processId() const { return m_process->processId(); }

Q_SIGNALS:
    void stateChanged();
    /// These prompts are due, whether they can be heard or not.
    void due(const std::vector<std::string>& keys);

private:
    void hear(const std::string& line);
    void showCutNumber(const std::optional<CutNumber>& cut);
    void tellLanguage();

    LineProcess* m_process;
    SaidPrompts m_prompts;
    Speech m_speech = Speech::Wanted;
    SoundState m_state;
    QString m_cutNumber;  ///< what the fault says of the last read-back; empty if it was whole
};

}  // namespace study::app
