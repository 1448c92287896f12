// What the participant hears: recordings as they were, noise that is lowered while they play, and prompts that say only what the
// participant has said or may know.
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QProcess>
#include <QProcessEnvironment>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <set>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"
#include "protocols/protocol_json.h"
#include "protocols/usual_texts.h"
#include "study/participant/session/prompts.h"
#include "study/participant/sound/sound_lines.h"
#include "study/participant/sound/sound_mix.h"
#include "study/participant/sound/wav_sound.h"
#include "tests/support/played_session.h"
#include "tests/support/study_builder.h"
#include "tests/support/whole_protocol.h"

using namespace study::participant;
using namespace study::session;
using Keys = std::vector<std::string>;
using tests::support::OpenSession;

namespace {

std::vector<float> tone(double seconds, double level)
{
    std::vector<float> samples(static_cast<std::size_t>(seconds * mixRateHz));
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] = static_cast<float>(level * std::sin(2 * M_PI * 440 * static_cast<double>(i) / mixRateHz));
    return samples;
}

double rmsOf(std::span<const float> samples)
{
    double sum = 0;
    for (const float sample : samples) sum += double(sample) * sample;
    return std::sqrt(sum / double(samples.size()));
}

std::vector<float> heardFor(SoundMix& mix, double seconds)
{
    std::vector<float> samples(static_cast<std::size_t>(seconds * mixRateHz));
    mix.fill(samples);
    return samples;
}

void put(std::string& bytes, std::size_t at, unsigned value, int size)
{
    for (int i = 0; i < size; ++i) bytes[at + static_cast<std::size_t>(i)] = static_cast<char>(value >> (8 * i));
}

/// vis2hap-sound with an engine of the test: a script that finds its folder in $folder, with half a second of a tone in tone.wav.
struct Speaking {
    QString folder;
    QString path;  ///< where the program looks for the engine
    QByteArray told;

    Speaking(const QString& in, const QString& engine) : folder(in), path(in + "/engine:/usr/bin:/bin")
    {
        QDir(in).mkpath("engine");
        const QString file = in + "/engine/espeak-ng";
        protocols::writeWholeFile(file.toStdString(), ("#!/bin/sh\nfolder='" + in + "'\n" + engine + "\n").toStdString());
        QFile::setPermissions(file, QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
        protocols::writeWholeFile((in + "/tone.wav").toStdString(), wavOf(tone(0.5, 0.5)));
        for (const char* old : {"said", "arguments"}) QFile::remove(in + "/" + old);
    }
    QByteArray read(const char* file) const
    {
        return QByteArray::fromStdString(protocols::readWholeFile((folder + "/" + file).toStdString()));
    }
    std::vector<float> heard(const std::vector<LineToSound>& lines)
    {
        QProcess program;
        QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
        environment.insert("PATH", path);
        program.setProcessEnvironment(environment);
        program.setWorkingDirectory(folder);
        program.start(QFileInfo(VIS2HAP_PROGRAM).path() + "/vis2hap-sound", {"--to", folder + "/heard.wav"});
        for (const LineToSound& line : lines) program.write(QByteArray::fromStdString(lineOf(line) + "\n"));
        program.closeWriteChannel();
        if (!program.waitForFinished(20000) || program.exitCode() != 0)
            qFatal("vis2hap-sound: %s", program.readAllStandardError().constData());
        told = program.readAllStandardOutput();
        const std::string bytes = protocols::readWholeFile((folder + "/heard.wav").toStdString());
        return bytes.size() > 44 ? soundFromWav(bytes, "heard.wav") : std::vector<float>();
    }
};

}  // namespace

class SoundTest : public QObject {
    Q_OBJECT

    QTemporaryDir m_folder;

private Q_SLOTS:
    void aRecordingIsReadAsItWasWritten()
    {
        const auto samples = tone(0.1, 0.5);
        const auto read = soundFromWav(wavOf(samples), "a.wav");
        QCOMPARE(read.size(), samples.size());
        for (std::size_t i = 0; i < read.size(); ++i) QVERIFY(std::abs(read[i] - samples[i]) < 1e-4);
    }

    void otherRatesAndChannelsBecomeMonoAtTheMixRate()
    {
        std::string bytes = wavOf(tone(0.2, 0.5));
        put(bytes, 24, 24000, 4);  // the same samples, half as fast
        QCOMPARE(soundFromWav(bytes, "slow.wav").size(), std::size_t(2 * 0.2 * mixRateHz));
        bytes = wavOf(tone(0.2, 0.5));
        put(bytes, 22, 2, 2);  // pairs of samples are left and right
        QCOMPARE(soundFromWav(bytes, "stereo.wav").size(), std::size_t(0.1 * mixRateHz));
        // Another chunk before the samples, of odd length with its filling byte.
        bytes = wavOf(tone(0.1, 0.5));
        bytes.insert(36, std::string("LIST\x03\0\0\0abc\0", 12));
        QCOMPARE(soundFromWav(bytes, "list.wav").size(), std::size_t(0.1 * mixRateHz));
    }

    void whatCannotBePlayedIsNamed_data()
    {
        QTest::addColumn<QByteArray>("bytes");
        QTest::addColumn<QString>("named");
        const std::string sound = wavOf(tone(0.01, 0.5));
        const auto row = [](const char* name, const std::string& bytes, const char* named) {
            QTest::newRow(name) << QByteArray::fromStdString(bytes) << QString(named);
        };
        const auto with = [&](std::size_t at, unsigned value) {
            std::string bytes = sound;
            put(bytes, at, value, 2);
            return bytes;
        };
        row("nothing", "", "no WAV file");
        row("a text", "Hello", "no WAV file");
        row("a cut file", sound.substr(0, 200), "is cut");
        row("a format without samples", sound.substr(0, 36), "has no samples");
        row("an empty recording", wavOf({}), "has no samples");
        row("floating point", with(20, 3), "other samples");
        row("eight bits", with(34, 8), "other samples");
        row("six channels", with(22, 6), "other channels");
        row("no rate", with(24, 0), "rate");
        row("samples without a format", "RIFF....WAVEdata\x02" + std::string(3, '\0') + "ab", "names no format");
        row("a cut format", "RIFF....WAVEfmt \x04" + std::string(7, '\0'), "format of the recording is cut");
    }
    void whatCannotBePlayedIsNamed()
    {
        QFETCH(QByteArray, bytes);
        QFETCH(QString, named);
        try {
            soundFromWav(bytes.toStdString(), "x.wav");
            QFAIL("it was read");
        } catch (const protocols::Error& fault) {
            QVERIFY2(QString(fault.what()).contains(named) && QString(fault.what()).contains("x.wav"), fault.what());
        }
    }

    void theNoiseHasItsLevelAndIsLoweredUnderARecording()
    {
        SoundMix mix;
        QCOMPARE(rmsOf(heardFor(mix, 0.5)), 0.0);
        mix.setNoise(0.1F);
        heardFor(mix, 1);
        const double before = rmsOf(heardFor(mix, 4));
        QVERIFY2(before > 0.08 && before < 0.12, qPrintable(QString::number(before)));
        mix.play(std::vector<float>(mixRateHz * 4, 0.0F));  // a silent recording: only the noise is heard
        heardFor(mix, 0.5);
        const double under = rmsOf(heardFor(mix, 3));
        QVERIFY2(under > before * 0.2 && under < before * 0.3, qPrintable(QString::number(under / before)));
        heardFor(mix, 1);
        QVERIFY(!mix.isPlaying());
        const double after = rmsOf(heardFor(mix, 4));
        QVERIFY(after > before * 0.9 && after < before * 1.1);
    }

    void recordingsPlayOneAfterAnotherAndNothingIsLost()
    {
        SoundMix mix;
        const auto first = tone(0.05, 0.4), second = tone(0.03, 0.2);
        mix.play(first);
        mix.play({});
        mix.play(second);
        const auto heard = heardFor(mix, 0.1);
        auto expected = first;
        expected.insert(expected.end(), second.begin(), second.end());
        QVERIFY(std::equal(expected.begin(), expected.end(), heard.begin()));
        mix.play(first);
        heardFor(mix, 0.01);
        mix.silence();
        QCOMPARE(rmsOf(heardFor(mix, 0.05)), 0.0);
        mix.play(second);
        QCOMPARE(heardFor(mix, 0.001)[1], second[1]);  // from its beginning
    }

    void linesAreReadStrictly()
    {
        for (const LineToSound& line :
             {LineToSound(NoiseLevel{0.08}), LineToSound(SpeechLanguage{"zh-Hant"}), LineToSound(SpeechLanguage{}),
              LineToSound(PlayPrompts{{Recording{"/a b.wav"}, SpokenText{"Fühlen \"Sie\"."}, Recording{"/ü.wav"}}}),
              LineToSound(PlayPrompts{{Together{{Recording{"/5.wav"}, SpokenText{"point"}}}, Recording{"/w.wav"}}}),
              LineToSound(PlayPrompts{{Together{{SpokenText{"5"}}}}})})
            QVERIFY(lineToSound(lineOf(line)) == line);
        for (const char* line :
             {"", "{}", R"({"noise":0.5})", R"({"noise":-1})", R"({"noise":"loud"})", R"({"play":"a"})", R"({"play":[1]})",
              R"({"play":[],"noise":0})", R"({"play":[[]]})", R"({"play":[["a",["b"]]]})", R"({"play":[{"say":1}]})",
              R"({"play":[{"say":"a","file":"b"}]})", R"({"language":7})", R"({"language":"-v"})", R"({"language":"../mb"})",
              R"({"language":"abcdefghijklmnopqrstuvwxyz0123456789"})"})
            QVERIFY_EXCEPTION_THROWN(lineToSound(line), protocols::Error);
    }

    void tooLongTextsAreRefused()
    {
        const auto said = [](std::size_t bytes) { return lineOf(PlayPrompts{{SpokenText{std::string(bytes, 'a')}}}); };
        lineToSound(said(longestSpokenText));
        QVERIFY_EXCEPTION_THROWN(lineToSound(said(longestSpokenText + 1)), protocols::Error);
    }

    void anEngineSpeaksTextsAsData()
    {
        Speaking speaking(m_folder.path(),
                          R"(cat >> "$folder/said"; echo "$@" >> "$folder/arguments"; cp "$folder/tone.wav" "$7")");
        const std::string text = "Feel $(touch evil); \"now\" [[h@l]] -w x\x01\n";
        const auto heard = speaking.heard({SpeechLanguage{"pt-BR"}, PlayPrompts{{SpokenText{text}, SpokenText{text}}}});
        QVERIFY2(speaking.told.contains("espeak-ng pt-br"), speaking.told.constData());
        QCOMPARE(speaking.read("said"), QByteArray("\nFeel $(touch evil); \"now\"   h@l   -w x  \n"));  // once: the sound is kept
        QVERIFY2(speaking.read("arguments").startsWith("-b 1 -v pt-br --stdin -w /dev/null\n-b 1 -v pt-br --stdin -w /"),
                 speaking.read("arguments").constData());
        QVERIFY(!QFileInfo::exists(m_folder.filePath("evil")));
        QCOMPARE(heard.size(), std::size_t(2 * 0.5 * mixRateHz + 0.5 * mixRateHz));
        QVERIFY(rmsOf(std::span(heard).first(mixRateHz)) > 0.34);
    }

    void theEngineGetsNoSecretOfTheOwner()
    {
        qputenv("VIS2HAP_PASSPHRASE", "Sekret1");
        qputenv("PGPASSWORD", "Sekret2");
        qputenv("OF_THE_LAB", "kept");
        Speaking speaking(m_folder.path(), R"(env > "$folder/variables"; cp "$folder/tone.wav" "$7")");
        speaking.heard({SpeechLanguage{"en"}, PlayPrompts{{SpokenText{"x"}}}});
        for (const char* variable : {"VIS2HAP_PASSPHRASE", "PGPASSWORD", "OF_THE_LAB"}) qunsetenv(variable);
        const QByteArray variables = speaking.read("variables");
        QVERIFY(variables.contains("OF_THE_LAB=kept"));
        QVERIFY(!variables.contains("Sekret") && !variables.contains("PGPASSWORD"));
    }

    void theMainLanguageStandsInForItsVariant()
    {
        Speaking speaking(m_folder.path(), R"([ "$4" = zh ] && cp "$folder/tone.wav" "$7")");
        const auto heard = speaking.heard({SpeechLanguage{"zh-Hant-TW"}, PlayPrompts{{SpokenText{"x"}}}});
        QVERIFY2(speaking.told.contains(R"({"voice":"espeak-ng zh"})"), speaking.told.constData());
        QVERIFY(heard.size() == mixRateHz);
        speaking.heard({SpeechLanguage{"qq"}});
        QVERIFY2(speaking.told.contains("no_voice") && speaking.told.contains("language 'qq'"), speaking.told.constData());
    }

    void withoutAnEngineTheProgramSaysHowToGetOne()
    {
        Speaking speaking(m_folder.path(), "exit 1");
        speaking.path = "/nonexistent";
        const auto heard = speaking.heard({SpeechLanguage{"en"}, NoiseLevel{0.1}, SpeechLanguage{}});
        QVERIFY2(speaking.told.contains("no_voice") && speaking.told.contains("apt-get install espeak-ng"),
                 speaking.told.constData());
        QVERIFY(speaking.told.endsWith("{\"voice\":\"\"}\n"));  // none was wanted
        QVERIFY(rmsOf(heard) > 0.05);                           // the noise goes on
    }

    void aFaultyEngineLeavesOnlyItsPromptOut_data()
    {
        QTest::addColumn<QString>("engine");
        QTest::addColumn<QString>("named");
        QTest::newRow("fails") << "exit 1"
                               << "could not speak";
        QTest::newRow("crashes") << "kill -SEGV $$"
                                 << "could not speak";
        QTest::newRow("writes nothing") << "exit 0"
                                        << "speech.wav";
        QTest::newRow("writes no sound") << R"(echo Hello > "$7")"
                                         << "no WAV file";
        QTest::newRow("never stops writing") << R"(exec cat /dev/zero > "$7")"
                                             << "could not speak";
        QTest::newRow("never ends") << "exec sleep 60"
                                    << "could not speak";
    }
    void aFaultyEngineLeavesOnlyItsPromptOut()
    {
        QFETCH(QString, engine);
        QFETCH(QString, named);
        Speaking speaking(m_folder.path(), R"([ "$7" = /dev/null ] && exit 0; )" + engine);
        const std::string tones = m_folder.filePath("tone.wav").toStdString();
        const auto heard = speaking.heard({SpeechLanguage{"en"}, PlayPrompts{{SpokenText{"x"}, Recording{tones}}}});
        QVERIFY2(speaking.told.contains("\"fault\"") && speaking.told.contains(named.toUtf8()), speaking.told.constData());
        QCOMPARE(heard.size(), std::size_t(mixRateHz));  // the recording, and half a second
    }

    void theInstalledEngineSpeaks()
    {
        if (QStandardPaths::findExecutable("espeak-ng").isEmpty())
            QSKIP("espeak-ng is not installed (apt-get install espeak-ng)");
        Speaking speaking(m_folder.path(), "exit 1");
        speaking.path = qEnvironmentVariable("PATH");
        for (const auto& [language, text] : {std::pair("en", "Feel the display."),
                                             {"pt-BR", "Toque a tela."},
                                             {"ja", "触ってください。"},
                                             {"zh", "请感受触觉屏。"}}) {
            const auto heard = speaking.heard({SpeechLanguage{language}, PlayPrompts{{SpokenText{text}}}});
            QVERIFY2(speaking.told.startsWith("{\"voice\""), speaking.told.constData());
            const double seconds = double(heard.size()) / mixRateHz - 0.5;
            QVERIFY2(seconds > 0.5 && seconds < 5, qPrintable(QString("%1: %2 s").arg(language).arg(seconds)));
            QVERIFY(rmsOf(heard) > 0.02);
        }
    }

    void textsAreSpokenInTheLanguageOfTheProtocol()
    {
        protocols::Protocol protocol = protocols::protocolFromJson(tests::support::wholeProtocolText(), "whole");
        const auto english = spokenTexts(protocol);
        QCOMPARE(english.at("feel"), std::string("Feel the display"));
        QCOMPARE(english.at("answer_B"), std::string("B"));
        QCOMPARE(english.at("number_10"), std::string("10"));
        for (const auto& phase : protocol.phases)
            for (const auto& question : phase.questions) QCOMPARE(english.at("question_" + question.id.value), question.text);
        for (const auto& [key, text] : english) QVERIFY2(protocols::isPromptKey(protocol, key) && !text.empty(), key.c_str());
        QVERIFY(!english.contains("number_101"));
        for (const auto& [max, last] : {std::pair(2000, 200), {30000, 999}}) {
            protocols::Protocol wide = protocol;
            protocols::RatingScale scale;
            scale.max = protocols::Tenths{max};
            wide.phases[0].questions[0].kind = protocols::Rating{scale};
            const auto texts = spokenTexts(wide);
            QVERIFY(texts.contains("number_" + std::to_string(last)) && !texts.contains("number_" + std::to_string(last + 1)));
        }
        protocol.language = "nl";  // has no usual texts
        protocol.participantTexts = {{"feel_title", "Voel"}, {"break_text", "Rust uit."}};
        protocol.phases[0].questions[1].text = "Hoe voelt het?";
        auto usual = protocol.phases[0].questions[0];
        usual.id = protocols::QuestionId("Q4");
        usual.text = protocols::usualTextOf(usual.id, protocol.phases[0].task, protocols::ProtocolEdition::Current);
        protocol.phases[0].questions.push_back(usual);
        const auto dutch = spokenTexts(protocol);
        QCOMPARE(dutch.at("feel"), std::string("Voel"));
        QCOMPARE(dutch.at("break"), std::string("Rust uit."));
        QCOMPARE(dutch.at("question_W1"), std::string("Hoe voelt het?"));
        for (const char* key : {"wait", "end", "same", "different", "point", "question_Q4"}) QVERIFY2(!dutch.contains(key), key);
        QCOMPARE(dutch.at("number_5"), std::string("5"));
        const auto german = spokenTexts(protocols::protocolFromJson(protocols::paperProtocolIn("de"), "German"));
        QCOMPARE(german.at("feel"), std::string("Fühlen Sie das Display"));
        QCOMPARE(german.at("point"), std::string("Komma"));
        QVERIFY(german.at("question_Q4").starts_with("Wie echt"));
        const auto chinese = spokenTexts(protocols::protocolFromJson(protocols::paperProtocolIn("zh"), "Chinese"));
        QCOMPARE(chinese.at("wait"), std::string("请等候实验人员"));
        QVERIFY(chinese.at("question_Q4").starts_with("与布料相比"));
    }

    void theProgramWritesWhatIsHeard()
    {
        const std::string folder = m_folder.path().toStdString();
        protocols::writeWholeFile(folder + "/tone.wav", wavOf(tone(0.5, 0.5)));
        QFile large(m_folder.filePath("large.wav"));  // 2 GB without a block on the disk
        QVERIFY(large.open(QIODevice::WriteOnly) && large.resize(qint64{2} << 30));
        QProcess program;
        program.start(QFileInfo(VIS2HAP_PROGRAM).path() + "/vis2hap-sound", {"--to", m_folder.filePath("heard.wav")});
        QVERIFY(program.waitForStarted(5000));
        for (const LineToSound& line : {LineToSound(NoiseLevel{0.1}),
                                        LineToSound(PlayPrompts{{Recording{folder + "/tone.wav"}, Recording{folder + "/none.wav"},
                                                                 Recording{folder + "/large.wav"}}})})
            program.write(QByteArray::fromStdString(lineOf(line) + "\n"));
        program.closeWriteChannel();
        QVERIFY(program.waitForFinished(10000));
        QVERIFY2(program.exitCode() == 0, program.readAllStandardError().constData());
        const QByteArray faults = program.readAllStandardOutput();
        QVERIFY(faults.contains("none.wav"));                                     // told, and left out
        QVERIFY2(faults.contains("at most 33554432 bytes"), faults.constData());  // so nothing of it was read
        const auto heard = soundFromWav(protocols::readWholeFile(folder + "/heard.wav"), "heard.wav");
        QVERIFY(heard.size() > 1.9 * mixRateHz && heard.size() < 2.1 * mixRateHz);
        const std::span<const float> all(heard);
        const double noise = rmsOf(all.subspan(mixRateHz / 2, mixRateHz / 2));
        const double tones = rmsOf(all.subspan(mixRateHz + mixRateHz / 10, mixRateHz * 3 / 10));
        QVERIFY(noise > 0.06 && noise < 0.14);
        QVERIFY2(tones > 0.34 && tones < 0.39, qPrintable(QString::number(tones)));  // 0.5 / sqrt(2), and a little noise
    }

    /// The recording of the point was lost after the study was made.
    void aNumberWithALostRecordingIsNotPlayedInPart()
    {
        Speaking speaking(m_folder.path(), "exit 1");
        const Recording digit{m_folder.filePath("tone.wav").toStdString()}, lost{m_folder.filePath("lost.wav").toStdString()};
        const auto seconds = [&](const Prompt& number) {
            const auto heard = speaking.heard({PlayPrompts{{number, digit}}});
            return double(heard.size()) / mixRateHz - 0.5;
        };
        QCOMPARE(seconds(Together{{digit, digit, digit}}), 2.0);
        QVERIFY2(!speaking.told.contains("fault"), speaking.told.constData());
        QCOMPARE(seconds(Together{{digit, lost, digit}}), 0.5);
        QVERIFY2(speaking.told.contains("lost.wav"), speaking.told.constData());
    }

    void theProgramRefusesWhatTheAppNeverSends()
    {
        QProcess program;
        program.start(QFileInfo(VIS2HAP_PROGRAM).path() + "/vis2hap-sound", {"--to", m_folder.filePath("x.wav")});
        program.write("{\"volume\":11}\n");
        program.closeWriteChannel();
        QVERIFY(program.waitForFinished(10000));
        QCOMPARE(program.exitCode(), 2);
        QVERIFY(!QFileInfo::exists(m_folder.filePath("x.wav")));
    }

    void answersAreReadBackAsTheyWereSaid()
    {
        const std::vector<protocols::FabricId> tray{protocols::FabricId("F02"), protocols::FabricId("F01")};
        QVERIFY(readBackOf(protocols::FabricId("F01"), tray) == Keys{"answer_B"});
        QVERIFY(readBackOf(protocols::FabricId("F09"), tray).empty());
        QVERIFY(readBackOf(protocols::Tenths{54}, tray) == (Keys{"number_5", "point", "number_4"}));
        QVERIFY(readBackOf(protocols::Tenths{100}, tray) == Keys{"number_10"});
        QVERIFY(readBackOf(protocols::Tenths{-5}, tray).empty());
        QVERIFY(readBackOf(Sameness{true}, tray) == Keys{"same"});
        QVERIFY(readBackOf(Words{"soft"}, tray).empty());
    }

    void promptsFollowTheSessionWhileTheBlindfoldIsWorn()
    {
        const auto folder = tests::support::buildStudy(m_folder.filePath("study").toStdString(), tests::support::wholeStudy());
        OpenSession session(folder, "P01");
        std::vector<Keys> said;
        View before = session.driver->view();
        const auto listen = [&] {
            const View now = session.driver->view();
            if (const Keys keys = promptsBetween(before, now); !keys.empty()) said.push_back(keys);
            before = now;
        };
        while (nameOf(session.driver->state()) != "PlacingTray") {
            session.step();
            listen();
        }
        QVERIFY(said.empty());  // the operator speaks during the preparation
        session.step();
        listen();
        QVERIFY(said.back() == (Keys{"feel", "question_Q1"}));
        session.send(Answered{session.driver->view().trayIds[2]});
        listen();
        QVERIFY(said.back() == (Keys{"answer_C", "question_W1"}));
        session.send(Answered{Words{"dry"}});
        listen();
        QVERIFY(said.back() == Keys{"wait"});
        const std::size_t soFar = said.size();
        session.send(Paused{});
        listen();
        session.send(Resumed{});
        listen();
        QCOMPARE(said.size(), soFar);  // the operator speaks in a pause
        while (session.step()) listen();
        QVERIFY(said.back() == Keys{"end"} || said.back().back() == "end");
        const auto& plan = session.driver->plan();
        for (const Keys& keys : said)
            for (const std::string& key : keys) QVERIFY2(protocols::isPromptKey(plan.protocol, key), key.c_str());
        const auto isBreak = [](const Keys& keys) { return keys.back() == "break"; };
        QVERIFY(std::any_of(said.begin(), said.end(), isBreak));
    }
};

QTEST_GUILESS_MAIN(SoundTest)
#include "sound_test.moc"
