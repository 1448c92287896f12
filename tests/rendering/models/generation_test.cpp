// Signals generated with the weights of the program, through the second executable.
#include "rendering/models/generation.h"

#include <QElapsedTimer>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <functional>
#include <numeric>
#include <opencv2/core.hpp>

#include "protocols/files/errors.h"
#include "rendering/fabrics/dataset.h"
#include "rendering/fabrics/friction_record.h"
#include "rendering/fabrics/procedural/procedural_fabrics.h"
#include "rendering/models/exchange.h"

using namespace rendering;
using models::GeneratedSignals;
using models::GenerationOptions;
using models::InputPhotograph;
using models::Quality;

namespace {

std::vector<GeneratedSignals> generated(const std::vector<InputPhotograph>& photographs, const GenerationOptions& options = {})
{
    return models::generate(photographs, options);
}

double deviation(const cv::Mat& map)
{
    cv::Scalar mean, spread;
    cv::meanStdDev(map, mean, spread);
    return spread[0];
}

double meanOf(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

void verifySound(const GeneratedSignals& signals, const cv::Size& size)
{
    QCOMPARE(signals.heightMm.type(), CV_32FC1);
    QCOMPARE(signals.heightMm.cols, size.width);
    QCOMPARE(signals.heightMm.rows, size.height);
    QVERIFY(cv::checkRange(signals.heightMm, true, nullptr, 0, 100));
    QVERIFY(cv::checkRange(signals.spectrogram, true, nullptr, 0, 1e6));
    const auto& parameters = signals.spectrogramParameters;  // Sufficient for the inversion.
    QCOMPARE(signals.spectrogram.rows, parameters.frequencies());
    QCOMPARE(signals.spectrogram.cols, parameters.frames(static_cast<int>(signals.trace.size())));
    QVERIFY(std::abs(parameters.sampleRateHz * signals.traceMmPerSample - 1) < 1e-12);
    QVERIFY(signals.meanFriction > 0 && signals.meanFriction < 10);
    QVERIFY(std::abs(meanOf(signals.trace) / signals.meanFriction - 1) < 1e-6);
}

/// Replaces vis2hap-nn by another program during its lifetime.
class Instead {
public:
    explicit Instead(const QByteArray& program) { qputenv("VIS2HAP_NN", program); }
    ~Instead() { qunsetenv("VIS2HAP_NN"); }
    Instead(const Instead&) = delete;
    Instead& operator=(const Instead&) = delete;
};

protocols::ExitCode codeOfFault(const std::function<void()>& work, QString* line = nullptr)
{
    try {
        work();
    } catch (const protocols::Error& fault) {
        if (line != nullptr) *line = QString::fromUtf8(fault.what());
        return fault.exitCode();
    }
    return protocols::ExitCode::Done;
}

}  // namespace

class GenerationTest : public QObject {
    Q_OBJECT

private:
    QTemporaryDir m_folder;
    fabrics::Dataset m_dataset;

    InputPhotograph photograph(const char* fabric, int index = 0) const
    {
        return {fabrics::readPhotograph(m_dataset, protocols::FabricId(fabric), index), m_dataset.cameraMmPerPixel};
    }

    /// A shell script that replaces the second executable.
    QByteArray script(const char* body) const
    {
        const QString name = m_folder.filePath("stand-in.sh");
        QFile file(name);
        if (!file.open(QIODevice::WriteOnly | QIODevice::Truncate)) return {};
        file.write(QByteArray("#!/bin/sh\n") + body + "\n");
        file.close();
        file.setPermissions(QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
        return name.toUtf8();
    }

private Q_SLOTS:
    void initTestCase()
    {
        fabrics::ProceduralOptions options;
        options.fabrics = 8;
        options.samples = 2;
        options.seed = 4711;
        m_dataset = fabrics::makeProceduralFabrics(m_folder.filePath("fabrics").toStdString(), options);
    }

    void photographGivesMapsOfItsSize()
    {
        const std::vector<GeneratedSignals> answers = generated({photograph("F01"), photograph("F05")});
        QCOMPARE(answers.size(), std::size_t{2});
        for (const GeneratedSignals& signals : answers) {
            verifySound(signals, {256, 256});
            QCOMPARE(signals.heightMmPerPixel, 0.05);
            QCOMPARE(signals.trace.size(), std::size_t{480});
            QVERIFY(std::abs(signals.traceMmPerSample - 5.0 / 60) < 1e-12);
        }
    }

    void fabricsDifferInGeneratedReliefAndFriction()
    {
        const std::vector<GeneratedSignals> answers = generated({photograph("F01"), photograph("F05"), photograph("F01", 1)});
        cv::Mat apart;
        cv::absdiff(answers[0].heightMm, answers[1].heightMm, apart);
        QVERIFY(cv::mean(apart)[0] > 1e-3);
        const double between = std::abs(std::log(deviation(answers[0].heightMm) / deviation(answers[1].heightMm)));
        const double within = std::abs(std::log(deviation(answers[0].heightMm) / deviation(answers[2].heightMm)));
        QVERIFY2(between > within, qPrintable(QString("%1 %2").arg(between).arg(within)));
        QVERIFY(std::abs(answers[0].meanFriction - answers[1].meanFriction) >
                2 * std::abs(answers[0].meanFriction - answers[2].meanFriction));
    }

    void meanFrictionIsNearTheMeasuredOne()
    {
        double sum = 0;
        std::vector<InputPhotograph> photographs;
        for (const fabrics::FabricInfo& fabric : m_dataset.fabrics) photographs.push_back(photograph(fabric.id.value.c_str()));
        const std::vector<GeneratedSignals> answers = generated(photographs);
        for (std::size_t i = 0; i < answers.size(); ++i) {
            const fabrics::FrictionRecord record = fabrics::readFriction(m_dataset, m_dataset.fabrics[i].id, 0);
            sum += std::abs(answers[i].meanFriction / meanOf(record.values) - 1);
        }
        QVERIFY2(sum / static_cast<double>(answers.size()) < 0.15,
                 qPrintable(QString::number(sum / static_cast<double>(answers.size()))));
    }

    void onlyRequestedSignalsAreComputed()
    {
        GenerationOptions heightOnly, frictionOnly;
        heightOnly.friction = false;
        frictionOnly.height = false;
        const GeneratedSignals relief = generated({photograph("F02")}, heightOnly).front();
        QVERIFY(!relief.heightMm.empty());
        QVERIFY(relief.trace.empty() && relief.spectrogram.empty());
        const GeneratedSignals stroke = generated({photograph("F02")}, frictionOnly).front();
        QVERIFY(stroke.heightMm.empty());
        QCOMPARE(stroke.trace.size(), std::size_t{480});
    }

    void uniformPicturesGiveFiniteNumbers_data()
    {
        QTest::addColumn<int>("width");
        QTest::addColumn<int>("height");
        QTest::addColumn<int>("value");
        QTest::newRow("grey") << 256 << 256 << 128;
        QTest::newRow("black") << 100 << 40 << 0;
        QTest::newRow("white") << 300 << 17 << 255;
        QTest::newRow("one pixel") << 1 << 1 << 90;
        QTest::newRow("a line") << 513 << 1 << 200;
    }

    void uniformPicturesGiveFiniteNumbers()
    {
        QFETCH(int, width);
        QFETCH(int, height);
        QFETCH(int, value);
        const cv::Mat plain(height, width, CV_8UC3, cv::Scalar::all(value));
        verifySound(generated({{plain, std::nullopt}}).front(), {width, height});
    }

    void heightsHaveThePitchOfThePhotograph()
    {
        const cv::Mat plain(100, 200, CV_8UC3, cv::Scalar::all(120));
        for (const double pitch : {0.025, 0.1}) {
            const GeneratedSignals signals = generated({{plain, pitch}}).front();
            verifySound(signals, {200, 100});
            QCOMPARE(signals.heightMmPerPixel, pitch);
        }
    }

    void aPictureOfTwiceTheScaleShowsTwiceTheHeight()
    {
        InputPhotograph one = photograph("F01"), twice = one;
        *twice.mmPerPixel *= 2;
        const std::vector<GeneratedSignals> answers = generated({one, twice});
        const double ratio = deviation(answers[1].heightMm) / deviation(answers[0].heightMm);
        QVERIFY2(std::abs(ratio - 2) < 0.01, qPrintable(QString::number(ratio)));
    }

    void qualitiesAgreeAndRepeat()
    {
        std::vector<GeneratedSignals> answers;
        for (const Quality quality : {Quality::Fast, Quality::Balanced, Quality::Accurate, Quality::Accurate}) {
            GenerationOptions options;
            options.quality = quality;
            answers.push_back(generated({photograph("F03")}, options).front());
        }
        QCOMPARE(cv::norm(answers[2].heightMm, answers[3].heightMm, cv::NORM_INF), 0.0);
        QCOMPARE(answers[2].trace, answers[3].trace);
        const double level = cv::mean(answers[2].heightMm)[0];
        for (int i = 0; i < 2; ++i) {
            QVERIFY(cv::norm(answers[static_cast<std::size_t>(i)].heightMm, answers[2].heightMm, cv::NORM_L1) / (256 * 256) <
                    0.5 * level);
            QVERIFY(std::abs(answers[static_cast<std::size_t>(i)].meanFriction / answers[2].meanFriction - 1) < 0.2);
        }
        QVERIFY(cv::norm(answers[0].heightMm, answers[2].heightMm, cv::NORM_INF) > 0);
    }

    void missingProgramIsAnEnvironmentFault()
    {
        const Instead none("/nowhere/vis2hap-nn");
        QString line;
        QCOMPARE(codeOfFault([&] { generated({photograph("F01")}); }, &line), protocols::ExitCode::Environment);
        QVERIFY2(line.contains("/nowhere/vis2hap-nn"), qPrintable(line));
    }

    void missingLibtorchIsAnEnvironmentFault()
    {
        const Instead unloadable(
            script("echo 'error while loading shared libraries: libtorch.so.1.13: cannot open' >&2; exit 127"));
        QString line;
        QCOMPARE(codeOfFault([&] { generated({photograph("F01")}); }, &line), protocols::ExitCode::Environment);
        QVERIFY2(line.contains("libtorch.so.1.13") && line.contains("libtorch-dev"), qPrintable(line));
    }

    void faultsOfTheProgramKeepTheirKind_data()
    {
        QTest::addColumn<QByteArray>("body");
        QTest::addColumn<int>("code");
        QTest::newRow("killed") << QByteArray("kill -9 $$") << 3;
        QTest::newRow("failed") << QByteArray("echo 'vis2hap: it did not work' >&2; exit 1") << 1;
        QTest::newRow("bad weights") << QByteArray("echo 'vis2hap: bad weights' >&2; exit 2") << 2;
        QTest::newRow("silent success") << QByteArray("exit 0") << 1;
    }

    void faultsOfTheProgramKeepTheirKind()
    {
        QFETCH(QByteArray, body);
        QFETCH(int, code);
        const Instead other(script(body.constData()));
        QString line;
        QCOMPARE(static_cast<int>(codeOfFault([&] { generated({photograph("F01")}); }, &line)), code);
        QVERIFY(!line.contains('\n') && !line.contains("vis2hap: "));
    }

    void programThatHangsIsGivenUp()
    {
        const Instead hanging(script("exec sleep 100"));
        qputenv("VIS2HAP_NN_SECONDS", "1");
        QElapsedTimer time;
        time.start();
        QString line;
        const protocols::ExitCode code = codeOfFault([&] { generated({photograph("F01")}); }, &line);
        qunsetenv("VIS2HAP_NN_SECONDS");
        QCOMPARE(code, protocols::ExitCode::Environment);
        QVERIFY2(line.contains("did not finish in time") && !line.contains('\n'), qPrintable(line));
        QVERIFY2(time.elapsed() < 5000, qPrintable(QString::number(time.elapsed())));
    }

    void tooLittleMemoryIsNamed()
    {
#ifdef __SANITIZE_ADDRESS__
        QSKIP("the sanitizer needs more memory than any limit");
#endif
        qputenv("VIS2HAP_NN_MEMORY_MB", "150");
        const cv::Mat large(2048, 2048, CV_8UC3, cv::Scalar::all(120));
        QString line;
        const protocols::ExitCode code = codeOfFault([&] { generated({{large, 0.05}}); }, &line);
        qunsetenv("VIS2HAP_NN_MEMORY_MB");
        QCOMPARE(code, protocols::ExitCode::Environment);
        QVERIFY2(line.contains("the limit is 150 MB") && !line.contains('\n'), qPrintable(line));
    }

    void noPhotographsStartNothing()
    {
        const Instead none("/nowhere/vis2hap-nn");
        QVERIFY(generated({}).empty());
    }

    /// Before, scales and friction of any size went into the images.
    void answersWithImpossibleNumbersAreRefused()
    {
        GeneratedSignals sound;
        sound.heightMm = cv::Mat(4, 5, CV_32FC1, cv::Scalar(0.25));
        sound.heightMmPerPixel = sound.traceMmPerSample = 0.05;
        sound.trace.assign(10, 0.4);
        sound.meanFriction = 0.4;
        const auto faultOf = [&](double GeneratedSignals::*number, double value) {
            GeneratedSignals answer = sound;
            answer.*number = value;
            const QTemporaryDir folder;
            models::AnswerWriter writer(folder.path().toStdString());
            writer.add(answer);
            writer.finish();
            QString line;
            codeOfFault([&] { models::readAnswers(folder.path().toStdString()); }, &line);
            return line;
        };
        QCOMPARE(faultOf(&GeneratedSignals::meanFriction, 0.4), QString());
        for (const double value : {-0.4, 0.0, 1e300}) {
            QVERIFY(faultOf(&GeneratedSignals::heightMmPerPixel, value).contains("height_mm_per_pixel is no number above 0"));
            QVERIFY(faultOf(&GeneratedSignals::traceMmPerSample, value).contains("trace_mm_per_sample is no number above 0"));
            QVERIFY(faultOf(&GeneratedSignals::meanFriction, value).contains("mean_friction is no number above 0 and below 1"));
        }
    }

    void wrongPhotographsAreRefused()
    {
        const cv::Mat grey(10, 10, CV_8UC1, cv::Scalar(5));
        QCOMPARE(codeOfFault([&] { generated({{grey, std::nullopt}}); }), protocols::ExitCode::BadInput);
        QCOMPARE(codeOfFault([&] { generated({{cv::Mat(), std::nullopt}}); }), protocols::ExitCode::BadInput);
        QCOMPARE(codeOfFault([&] { generated({{cv::Mat(4, 4, CV_8UC3, cv::Scalar()), 0.0}}); }), protocols::ExitCode::BadInput);
    }
};

QTEST_GUILESS_MAIN(GenerationTest)
#include "generation_test.moc"
