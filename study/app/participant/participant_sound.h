// The participant's headphones: masking noise, and the recordings of the study, played by vis2hap-sound. That program runs only
// while the operator wants sound, and the session never waits for it.
#pragma once

#include <QObject>
#include <map>
#include <string>
#include <vector>

#include "protocols/protocol.h"
#include "study/app/participant/line_process.h"

namespace study::app {

/// The sound as the operator sees it.
struct SoundState {
    bool isOn = false;  ///< the operator has started the sound
    QString device;     ///< empty until it plays
    int recordings = 0;
    QString fault;  ///< why nothing is heard, or which recording cannot be played
};

class ParticipantSound : public QObject {
    Q_OBJECT
public:
    explicit ParticipantSound(QObject* parent);

    /// The recordings by key, with their files; empty without a study.
    void setRecordings(std::map<std::string, std::string> files);
    /// `noise`: root mean square of the masking noise, 0 to 0.3 of full scale.
    void start(double noise);
    void stop();
    void setNoise(double noise);
    /// Plays the recordings of these keys in place of those that still play; keys without one are left out. Nothing is played
    /// while the sound is off.
    void say(const std::vector<std::string>& keys);
    /// The first recording's key; empty if there is none.
    std::string someKey() const { return m_files.empty() ? std::string() : m_files.begin()->first; }
    const SoundState& state() const { return m_state; }

Q_SIGNALS:
    void stateChanged();
    /// These prompts are due, whether they can be heard or not.
    void due(const std::vector<std::string>& keys);

private:
    void hear(const std::string& line);

    LineProcess* m_process;
    std::map<std::string, std::string> m_files;
    SoundState m_state;
};

}  // namespace study::app
