#include "study/participant/sound/speech.h"

#include <sys/prctl.h>
#include <sys/resource.h>

#include <QFileInfo>
#include <QProcess>
#include <QProcessEnvironment>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <csignal>

#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/whole_file.h"
#include "protocols/secrets/secret_variables.h"
#include "study/participant/sound/wav_sound.h"

namespace study::participant {

namespace {

constexpr const char* engineName = "espeak-ng";
constexpr int patienceMs = 5000;
constexpr std::size_t mostKept = 200;

protocols::Error speechFault(const std::string& what, const std::string& expected)
{
    return protocols::environmentFault(
        {what, "", expected, "the operator says what has no recording; the session works without speech"});
}

/// A broken engine may neither fill the disk nor run on. The limit leaves room for the 64 MiB that PulseAudio shares with a
/// program as a file in memory.
void limitEngine()
{
    constexpr rlim_t mostBytes = rlim_t{128} << 20;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    const rlimit bytes{mostBytes, mostBytes}, seconds{patienceMs / 1000, patienceMs / 1000};
    ::setrlimit(RLIMIT_FSIZE, &bytes);
    ::setrlimit(RLIMIT_CPU, &seconds);
}

/// True if the engine took the text and ended well.
bool runEngine(const std::string& program, const std::string& voice, const std::string& text, const QString& wavFile)
{
    QProcess engine;
    engine.setProcessEnvironment(protocols::withoutSecrets(QProcessEnvironment::systemEnvironment()));
    engine.setChildProcessModifier(limitEngine);
    engine.start(QString::fromStdString(program),
                 {QStringLiteral("-b"), QStringLiteral("1"), QStringLiteral("-v"), QString::fromStdString(voice),
                  QStringLiteral("--stdin"), QStringLiteral("-w"), wavFile});
    engine.write(QByteArray::fromStdString(text + "\n"));
    engine.closeWriteChannel();
    if (!engine.waitForFinished(patienceMs)) {
        engine.kill();
        engine.waitForFinished(patienceMs);
        return false;
    }
    return engine.exitStatus() == QProcess::NormalExit && engine.exitCode() == 0;
}

/// The tag and its shorter forms: "zh-hant-tw", "zh-hant", "zh". The engine writes them in small letters.
std::vector<std::string> voicesFor(const std::string& language)
{
    std::vector<std::string> voices;
    std::string tag = QString::fromStdString(language).toLower().toStdString();
    for (; !tag.empty(); tag.erase(tag.find_last_of('-') == std::string::npos ? 0 : tag.find_last_of('-'))) voices.push_back(tag);
    return voices;
}

}  // namespace

std::string plainSpeech(const std::string& text)
{
    std::string plain;
    for (const char letter : text) {
        const bool isControl = static_cast<unsigned char>(letter) < 0x20 || letter == 0x7F;
        plain += isControl || letter == '[' || letter == ']' ? ' ' : letter;
    }
    return plain;
}

std::string SpeechEngine::chooseVoice(const std::string& language)
{
    m_kept.clear();
    m_voice.clear();
    m_program = QStandardPaths::findExecutable(QString::fromLatin1(engineName)).toStdString();
    if (m_program.empty())
        throw protocols::environmentFault({"no speech engine is installed", "this computer", engineName,
                                           "install it with `apt-get install espeak-ng`, then start the sound again; until then "
                                           "the operator says what has no recording"});
    for (const std::string& voice : voicesFor(language)) {
        if (!runEngine(m_program, voice, "", QStringLiteral("/dev/null"))) continue;
        m_voice = voice;
        return std::string(engineName) + " " + voice;
    }
    throw speechFault(std::string(engineName) + " has no voice for the language '" + protocols::printable(language) + "'",
                      "a language that `espeak-ng --voices` lists");
}

std::vector<float> SpeechEngine::spoken(const std::string& text)
{
    if (m_voice.empty()) throw speechFault("no voice was chosen", "a voice for the language of the protocol");
    const std::string plain = plainSpeech(text);
    if (plain.find_first_not_of(' ') == std::string::npos) return {};
    if (const auto kept = m_kept.find(plain); kept != m_kept.end()) return kept->second;
    const QTemporaryDir folder;
    const QString file = folder.filePath(QStringLiteral("speech.wav"));
    const bool isSpoken = folder.isValid() && runEngine(m_program, m_voice, plain, file);
    if (!isSpoken || QFileInfo(file).size() > static_cast<qint64>(largestWav))
        throw speechFault(std::string(engineName) + " could not speak a sentence", "a sentence within 5 s");
    std::vector<float> sound =
        soundFromWav(protocols::readWholeFile(file.toStdString(), largestWav), "the sound of " + std::string(engineName));
    if (m_kept.size() < mostKept) m_kept[plain] = sound;
    return sound;
}

}  // namespace study::participant
