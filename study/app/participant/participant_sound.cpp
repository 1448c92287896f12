#include "study/app/participant/participant_sound.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "study/participant/sound/sound_lines.h"

namespace study::app {

using namespace participant;

ParticipantSound::ParticipantSound(QObject* parent) : QObject(parent), m_process(new LineProcess(this))
{
    connect(m_process, &LineProcess::lineRead, this, &ParticipantSound::hear);
    connect(m_process, &LineProcess::ended, this, [this](const QString& why) {
        m_state.isOn = false;
        m_state.device.clear();
        m_state.fault = tr("The sound has stopped: %1").arg(why);
        Q_EMIT stateChanged();
    });
}

void ParticipantSound::setRecordings(std::map<std::string, std::string> files)
{
    if (files == m_files) return;
    m_files = std::move(files);
    m_state.recordings = static_cast<int>(m_files.size());
    Q_EMIT stateChanged();
}

void ParticipantSound::start(double noise)
{
    m_state.fault.clear();
    m_state.device.clear();
    try {
        m_process->start(QStringLiteral("vis2hap-sound"), {}, ProgramSurroundings::Own);
        m_state.isOn = true;
        setNoise(noise);
    } catch (const protocols::Error& fault) {
        m_state.fault = QString::fromUtf8(fault.what());
    }
    Q_EMIT stateChanged();
}

void ParticipantSound::stop()
{
    m_process->stop();
    m_state.isOn = false;
    m_state.device.clear();
    m_state.fault.clear();
    Q_EMIT stateChanged();
}

void ParticipantSound::setNoise(double noise) { m_process->send(lineOf(LineToSound(NoiseLevel{noise}))); }

void ParticipantSound::say(const std::vector<std::string>& keys)
{
    if (!keys.empty()) Q_EMIT due(keys);
    PlayFiles play;
    for (const std::string& key : keys)
        if (const auto file = m_files.find(key); file != m_files.end()) play.files.push_back(file->second);
    if (play.files.empty() || !m_state.isOn) return;
    m_process->send(lineOf(LineToSound(play)));
}

void ParticipantSound::hear(const std::string& line)
{
    const auto said = nlohmann::json::parse(line, nullptr, false);
    if (!said.is_object()) return;
    const auto text = [&](const char* key) {
        return said.contains(key) && said.at(key).is_string()
                   ? QString::fromStdString(protocols::printable(said.at(key).get<std::string>()))
                   : QString();
    };
    if (said.contains("ready")) m_state.device = text("ready");
    if (said.contains("fault")) m_state.fault = text("fault");
    Q_EMIT stateChanged();
}

}  // namespace study::app
