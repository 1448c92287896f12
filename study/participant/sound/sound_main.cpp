// vis2hap-sound: masking noise, recordings and spoken texts for the participant's headphones. The app starts it when sound is
// wanted and sends it lines on standard input; it answers with the name of the device, the voice, or faults. It ends with its
// input.
#include <QAudioSink>
#include <QCommandLineParser>
#include <QCoreApplication>
#include <QIODevice>
#include <QMediaDevices>
#include <QThreadPool>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <new>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"
#include "study/participant/programs/child_program.h"
#include "study/participant/sound/sound_lines.h"
#include "study/participant/sound/sound_mix.h"
#include "study/participant/sound/speech.h"
#include "study/participant/sound/wav_sound.h"

namespace {

using namespace study::participant;

constexpr const char* program = "vis2hap-sound";
constexpr int channels = 2;

/// Writes a line for the app. One call writes the whole line, so lines of two threads do not mix.
void tell(const char* key, const std::string& text)
{
    const std::string line = nlohmann::json{{key, text}}.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
    std::fwrite(line.data(), 1, line.size(), stdout);
    std::fflush(stdout);
}

std::vector<float> soundOf(const Recording& recording, SpeechEngine&)
{
    return soundFromWav(protocols::readWholeFile(recording.file, largestWav), recording.file);
}

std::vector<float> soundOf(const SpokenText& spoken, SpeechEngine& speech) { return speech.spoken(spoken.text); }

/// Throws where one part cannot be played.
std::vector<float> soundOf(const Together& together, SpeechEngine& speech)
{
    std::vector<float> all;
    for (const PromptPart& one : together.parts) {
        const auto sound = std::visit([&](const auto& part) { return soundOf(part, speech); }, one);
        all.insert(all.end(), sound.begin(), sound.end());
    }
    return all;
}

/// The prompts as sound. A prompt that cannot be played is left out, and the app gets the reason.
std::vector<std::vector<float>> soundsOf(const PlayPrompts& play, SpeechEngine& speech)
{
    std::vector<std::vector<float>> sounds;
    for (const Prompt& prompt : play.prompts) try {
            sounds.push_back(std::visit([&](const auto& one) { return soundOf(one, speech); }, prompt));
        } catch (const protocols::Error& fault) {
            tell("fault", fault.what());
        } catch (const std::bad_alloc&) {
            tell("fault", "a prompt needs more memory than there is (expected shorter recordings): close other programs");
        }
    return sounds;
}

void chooseVoice(const std::string& language, SpeechEngine& speech)
{
    try {
        tell("voice", language.empty() ? "" : speech.chooseVoice(language));
    } catch (const protocols::Error& fault) {
        tell("no_voice", fault.what());
    }
}

void playAll(std::vector<std::vector<float>> sounds, SoundMix& mix)
{
    for (auto& sound : sounds) mix.play(std::move(sound));
}

/// The mix as a stream that the device reads.
class MixStream final : public QIODevice {
public:
    explicit MixStream(SoundMix& mix) : m_mix(mix) { open(QIODevice::ReadOnly); }
    bool isSequential() const override { return true; }
    qint64 bytesAvailable() const override { return 1 << 20; }  // it never ends

protected:
    qint64 readData(char* data, qint64 maxSize) override
    {
        const auto frames = static_cast<std::size_t>(maxSize / (channels * 2));
        m_samples.resize(frames);
        m_mix.fill(m_samples);
        auto* out = reinterpret_cast<qint16*>(data);
        for (const float sample : m_samples)
            for (int channel = 0; channel < channels; ++channel) *out++ = static_cast<qint16>(std::lround(sample * 32767));
        return static_cast<qint64>(frames) * channels * 2;
    }
    qint64 writeData(const char*, qint64) override { return -1; }

private:
    SoundMix& m_mix;
    std::vector<float> m_samples;
};

/// Obeys lines while the device plays. Files are read and texts are spoken by another thread, so that the noise never stops.
class Player {
public:
    explicit Player(SoundMix& mix) : m_mix(mix) { m_worker.setMaxThreadCount(1); }
    ~Player() { m_worker.waitForDone(); }

    void obey(const std::string& text)
    {
        const LineToSound line = lineToSound(text);
        if (const auto* noise = std::get_if<NoiseLevel>(&line)) return m_mix.setNoise(static_cast<float>(noise->level));
        if (const auto* language = std::get_if<SpeechLanguage>(&line))
            return m_worker.start([this, tag = language->tag] { chooseVoice(tag, m_speech); });
        m_mix.silence();
        m_worker.start([this, play = std::get<PlayPrompts>(line), number = ++m_lists] {
            auto sounds = soundsOf(play, m_speech);
            QMetaObject::invokeMethod(QCoreApplication::instance(), [this, number, ready = std::move(sounds)]() mutable {
                if (number == m_lists) playAll(std::move(ready), m_mix);  // else a later list has taken its place
            });
        });
    }

private:
    SoundMix& m_mix;
    SpeechEngine m_speech;  ///< used by the worker only
    int m_lists = 0;
    QThreadPool m_worker;
};

protocols::Error withoutOutput(const char* what, const std::string& where)
{
    return protocols::environmentFault(
        {what, where, "headphones or loudspeakers, 48 kHz stereo", "connect the headphones, then start the sound again"});
}

/// The masking noise must not fall silent unseen, so this program ends where its device stops or is taken away. `devices` and
/// `sink` report that while `devices` lives.
void endWithTheOutput(const QMediaDevices& devices, const QAudioSink& sink, const QAudioDevice& device)
{
    const auto end = [where = device.description().toStdString()](const char* what) {
        const protocols::Error fault = withoutOutput(what, where);
        QCoreApplication::exit(reported(program, fault, static_cast<int>(fault.exitCode())));
    };
    QObject::connect(&sink, &QAudioSink::stateChanged, &devices, [end](QAudio::State state) {
        if (state == QAudio::StoppedState) end("the output for sound has stopped");  // nobody here stops it
    });
    QObject::connect(&devices, &QMediaDevices::audioOutputsChanged, &devices, [id = device.id(), end] {
        const auto outputs = QMediaDevices::audioOutputs();
        const auto isOurs = [&](const QAudioDevice& output) { return output.id() == id; };
        if (std::ranges::none_of(outputs, isOurs)) end("the output for sound is no longer connected");
    });
}

int playOnDevice()
{
    const QAudioDevice device = QMediaDevices::defaultAudioOutput();
    QAudioFormat format;
    format.setSampleRate(mixRateHz);
    format.setChannelCount(channels);
    format.setSampleFormat(QAudioFormat::Int16);
    if (device.isNull() || !device.isFormatSupported(format))
        throw withoutOutput("there is no output for sound", "this computer");
    SoundMix mix;
    MixStream stream(mix);
    QAudioSink sink(device, format);
    constexpr int latencyMs = 100;
    sink.setBufferSize(format.bytesForDuration(latencyMs * 1000));
    sink.start(&stream);
    if (sink.error() != QAudio::NoError)
        throw protocols::environmentFault({"the output for sound cannot be opened", device.description().toStdString(),
                                           "a free output", "close other programs that play sound, then start it again"});
    const QMediaDevices devices;
    endWithTheOutput(devices, sink, device);
    Player player(mix);
    const InputLines input(program, [&](const std::string& line) { player.obey(line); });
    tell("ready", device.description().toStdString());
    return QCoreApplication::exec();
}

/// Writes what the lines of the input would sound like: a second after each level of noise, and each list of prompts with half a
/// second after it.
int writeTo(const std::string& file)
{
    SoundMix mix;
    SpeechEngine speech;
    std::vector<float> all;
    const auto more = [&](double seconds) {
        std::vector<float> samples(static_cast<std::size_t>(seconds * mixRateHz));
        mix.fill(samples);
        all.insert(all.end(), samples.begin(), samples.end());
    };
    for (std::string text; std::getline(std::cin, text);) {
        const LineToSound line = lineToSound(text);
        if (const auto* noise = std::get_if<NoiseLevel>(&line)) {
            mix.setNoise(static_cast<float>(noise->level));
            more(1);
        } else if (const auto* language = std::get_if<SpeechLanguage>(&line)) {
            chooseVoice(language->tag, speech);
        } else {
            playAll(soundsOf(std::get<PlayPrompts>(line), speech), mix);
            while (mix.isPlaying()) more(0.01);
            more(0.5);
        }
    }
    protocols::writeWholeFile(file, wavOf(all), protocols::Sync::Later);
    return 0;
}

}  // namespace

int main(int argc, char** argv)
{
    becomeChildProgram();
    QCoreApplication app(argc, argv);
    QCommandLineParser parser;
    parser.setApplicationDescription(
        "Masking noise, recordings and spoken prompts for the participant's headphones. The app of Vis2Hap starts this program.");
    parser.addOption({"to", "Write the sound to this WAV file instead of playing it.", "FILE"});
    parser.addHelpOption();
    parser.process(app);
    try {
        return parser.isSet("to") ? writeTo(parser.value("to").toStdString()) : playOnDevice();
    } catch (const protocols::Error& fault) {
        return reported(program, fault, static_cast<int>(fault.exitCode()));
    }
}
