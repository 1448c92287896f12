// Training of the networks that see through the real command, and their signals. Tiny networks: this tests the way, not the
// skill.
#include <QElapsedTimer>
#include <QFile>
#include <QProcess>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <set>

#include "protocols/files/sha256.h"
#include "rendering/fabrics/drawn/drawn_dataset.h"
#include "rendering/fabrics/drawn/drawn_patch.h"
#include "rendering/fabrics/sample_places.h"
#include "rendering/models/fair_control.h"
#include "rendering/models/generation.h"
#include "rendering/models/model_card.h"
#include "rendering/models/model_card_fields.h"
#include "rendering/models/process/child_process.h"
#include "tests/support/program.h"

using namespace rendering;

namespace {

struct Outcome {
    int exitCode = 0;
    QString output, errors;
};

QString program() { return QString::fromStdString(models::generatorProgram().string()); }

Outcome run(const QStringList& arguments)
{
    QProcess process;
    process.start(program(), arguments);
    process.waitForFinished(300000);
    return {process.exitStatus() == QProcess::NormalExit ? process.exitCode() : -1, process.readAllStandardOutput(),
            process.readAllStandardError()};
}

/// Two pictures of one fabric, as if they were scans. Returns the hashes of their files.
std::vector<std::string> makeScans(const std::filesystem::path& folder)
{
    const fabrics::Dataset scans = fabrics::makeDrawnFabrics(folder, {.fabrics = 1, .samples = 2, .seed = 8});
    std::vector<fabrics::SamplePlace> places = fabrics::readSamplePlaces(scans);
    std::vector<std::string> hashes;
    for (fabrics::SamplePlace& place : places) {
        if (place.modality != fabrics::Modality::Visual) continue;
        place.light = "colour";
        hashes.push_back(protocols::sha256OfFile(fabrics::samplePath(scans, place.fabric, place.modality, place.index)));
    }
    fabrics::writeSamplePlaces(scans, places);
    return hashes;
}

QByteArray bytesOf(const QString& file)
{
    QFile opened(file);
    return opened.open(QIODevice::ReadOnly) ? opened.readAll() : QByteArray();
}

}  // namespace

class ClothTrainingTest : public QObject {
    Q_OBJECT

private:
    QTemporaryDir m_folder;

    QString at(const char* name) const { return m_folder.filePath(name); }

    QStringList smallRun(const char* out, int steps, const QStringList& more = {}) const
    {
        return QStringList{"train-cloth",
                           "--out",
                           at(out),
                           "--steps",
                           QString::number(steps),
                           "--crop",
                           "48",
                           "--channels",
                           "4",
                           "--batch",
                           "2",
                           "--seed",
                           "5",
                           "--threads",
                           "1",
                           "--checkpoint-every",
                           "4",
                           "--validation-patches",
                           "8"} +
               more;
    }

    models::GeneratedSignals signalsOf(const cv::Mat& rgb, double mmPerPixel, std::optional<double> lightDeg = {}) const
    {
        models::GenerationOptions options;
        options.model = at("model.safetensors").toStdString();
        return models::generate(std::vector<models::InputPhotograph>{{rgb, mmPerPixel, lightDeg}}, options).front();
    }

private Q_SLOTS:
    void initTestCase()
    {
        for (const auto& [name, value] : models::missingThreadSettings())
            qputenv(name.c_str(), QByteArray::fromStdString(value));  // Otherwise each run starts twice, to set it.
    }

    void trainingLowersTheLossesAndTheCardTellsItsFigures()
    {
        const Outcome outcome = run(smallRun("model.safetensors", 150));
        QVERIFY2(outcome.exitCode == 0, qPrintable(outcome.errors));
        const models::ModelCardFields card = models::readModelCardFields(at("model.safetensors").toStdString());
        QVERIFY(card.architecture.sees);
        QCOMPARE(card.steps, 150);
        QVERIFY(card.architecture.fibres[std::size_t(fabrics::Fibre::Cotton)]);             // one drawn fabric in four
        QVERIFY(card.summary.trainingCommand.starts_with("vis2hap train --drawn --out "));  // what the user types
        const auto figures = nlohmann::ordered_json::parse(card.validationJson);
        QCOMPARE(figures.at("patches").get<int>(), 8);
        QVERIFY2(figures.at("relief_correlation").get<double>() > 0.1, qPrintable(QString::fromStdString(card.validationJson)));
        QVERIFY(!QFile::exists(at("model.safetensors.checkpoint")));
        QVERIFY(QFile::exists(at("model.safetensors.log/losses.csv")));
    }

    void killedRunResumesToTheSameWeights_data()
    {
        QTest::addColumn<QStringList>("losses");
        QTest::newRow("the losses of the paper, with a discriminator") << QStringList{"--reference"};
        QTest::newRow("our losses") << QStringList();
    }
    void killedRunResumesToTheSameWeights()
    {
        QFETCH(QStringList, losses);
        const Outcome whole = run(smallRun("whole.safetensors", 12, losses));
        QVERIFY2(whole.exitCode == 0, qPrintable(whole.errors));
        QFile::remove(at("broken.safetensors"));
        QProcess broken;
        broken.start(program(), smallRun("broken.safetensors", 12, losses));
        QElapsedTimer waited;
        waited.start();
        while (!QFile::exists(at("broken.safetensors.checkpoint")) && waited.elapsed() < 120000) QTest::qWait(2);
        broken.kill();
        broken.waitForFinished();
        QVERIFY2(!QFile::exists(at("broken.safetensors")), "the run ended before it was interrupted");
        const Outcome resumed = run(smallRun("broken.safetensors", 12, losses + QStringList{"--resume"}));
        QVERIFY2(resumed.exitCode == 0, qPrintable(resumed.errors));
        QVERIFY(resumed.output.contains("resumed at step"));
        QCOMPARE(bytesOf(at("broken.safetensors")), bytesOf(at("whole.safetensors")));
    }

    /// A control sees the fabrics that its model saw, in networks of the same size, and learns by other losses.
    void controlsTrainOnTheSameDrawnFabrics()
    {
        const auto cardOf = [&](const char* name) { return models::readModelCardFields(at(name).toStdString()); };
        const auto control = support::runProgram(
            {"train", "--drawn", "--control-of", at("whole.safetensors"), "--out", at("control.safetensors"), "--threads", "1"});
        QVERIFY2(control.exitCode == 0, qPrintable(control.err));
        QCOMPARE(cardOf("control.safetensors").objective, std::string("l1-only"));
        QCOMPARE(models::trainingDifferences(cardOf("whole.safetensors"), cardOf("control.safetensors")),
                 std::vector<std::string>());
        const Outcome paper = run(smallRun("paper.safetensors", 12, {"--reference"}));
        QVERIFY2(paper.exitCode == 0, qPrintable(paper.errors));
        QCOMPARE(cardOf("paper.safetensors").objective, std::string("reference"));
        QVERIFY(bytesOf(at("paper.safetensors")) != bytesOf(at("control.safetensors")));
        const auto refused =
            support::runProgram({"train", "--drawn", "--control-of", QString::fromStdString(models::shippedModel().string()),
                                 "--out", at("refused.safetensors")});
        QCOMPARE(refused.exitCode, 2);
        QVERIFY2(refused.err.contains("not trained on drawn fabrics alone"), qPrintable(refused.err));
    }

    void weightsBetweenTwoModelsAreBetweenTheirAnswers()
    {
        const Outcome further = run(smallRun("further.safetensors", 40, {"--from", at("model.safetensors")}));
        QVERIFY2(further.exitCode == 0, qPrintable(further.errors));
        const auto between = [&](const char* out, const char* way) {
            const Outcome outcome = run({"train-cloth", "--out", at(out), "--from", at("model.safetensors"), "--towards",
                                         at("further.safetensors"), "--way", way, "--validation-patches", "8"});
            QVERIFY2(outcome.exitCode == 0, qPrintable(outcome.errors));
        };
        between("start.safetensors", "0");
        between("end.safetensors", "1");
        between("half.safetensors", "0.5");
        QCOMPARE(bytesOf(at("start.safetensors")), bytesOf(at("model.safetensors")));
        QCOMPARE(bytesOf(at("end.safetensors")), bytesOf(at("further.safetensors")));
        QVERIFY(bytesOf(at("half.safetensors")) != bytesOf(at("model.safetensors")));
        const models::ModelCardFields card = models::readModelCardFields(at("half.safetensors").toStdString());
        QCOMPARE(card.steps, 40);
        QCOMPARE(card.fromName, std::string("model"));
        const Outcome alone = run({"train-cloth", "--out", at("alone.safetensors"), "--towards", at("further.safetensors")});
        QCOMPARE(alone.exitCode, 2);
        QVERIFY2(alone.errors.contains("--towards was given without --from"), qPrintable(alone.errors));
        const Outcome other = run({"train-cloth", "--out", at("other.safetensors"), "--from", at("model.safetensors"),
                                   "--towards", QString::fromStdString(models::shippedModel().string())});
        QCOMPARE(other.exitCode, 2);
        QVERIFY2(other.errors.contains("the two models have other networks"), qPrintable(other.errors));
    }

    void theCardNamesTheFilesAndSeedsOfTheModelsBeforeIt()
    {
        using Seeds = std::set<std::uint64_t>;
        const auto saw = [&](const char* name) { return models::readModelCard(at(name).toStdString()).trainingSampleHashes; };
        const auto drew = [&](const char* name) { return models::readModelCard(at(name).toStdString()).drawnSeeds; };
        const auto modelThatSaw = [&](const char* name, std::vector<std::string> hashes, Seeds seeds) {
            QFile::copy(at("model.safetensors"), at(name));
            models::ModelCardFields card = models::readModelCardFields(at("model.safetensors").toStdString());
            card.summary.trainingSampleHashes = std::move(hashes);
            card.summary.drawnSeeds = std::move(seeds);
            QFile file(QString::fromStdString(models::cardOf(at(name).toStdString()).string()));
            QVERIFY(file.open(QIODevice::WriteOnly));
            file.write(QByteArray::fromStdString(models::cardText(card)));
        };
        const auto trained = [&](const QStringList& arguments) {
            const Outcome outcome = run(arguments);
            QVERIFY2(outcome.exitCode == 0, qPrintable(outcome.errors));
        };
        QVERIFY((drew("model.safetensors") == Seeds{5}));
        modelThatSaw("lab.safetensors", {"00aa11", "ff22"}, {40});
        modelThatSaw("another.safetensors", {"0123", "ff22"}, {2});
        trained(smallRun("after-lab.safetensors", 1, {"--from", at("lab.safetensors")}));
        QCOMPARE(saw("after-lab.safetensors"), (std::vector<std::string>{"00aa11", "ff22"}));
        std::vector<std::string> expected = makeScans(at("scans").toStdString());
        QCOMPARE(expected.size(), std::size_t{2});
        expected.insert(expected.end(), {"00aa11", "ff22"});
        std::ranges::sort(expected);
        trained(smallRun("after-scans.safetensors", 1, {"--from", at("after-lab.safetensors"), "--scans", at("scans")}));
        QCOMPARE(saw("after-scans.safetensors"), expected);
        trained({"train-cloth", "--out", at("mixed.safetensors"), "--from", at("another.safetensors"), "--towards",
                 at("after-scans.safetensors"), "--validation-patches", "8"});
        expected.push_back("0123");
        std::ranges::sort(expected);
        QCOMPARE(saw("mixed.safetensors"), expected);
        QVERIFY((drew("after-scans.safetensors") == Seeds{5, 40}));
        QVERIFY((drew("mixed.safetensors") == Seeds{2, 5, 40}));
    }

    void trainingStartsFromAModelAndPrintsItsFiguresFirst()
    {
        const Outcome outcome = run(smallRun("adapted.safetensors", 3, {"--from", at("model.safetensors")}));
        QVERIFY2(outcome.exitCode == 0, qPrintable(outcome.errors));
        const QString start =
            QString::fromStdString(models::readModelCardFields(at("model.safetensors").toStdString()).validationJson);
        const auto first = nlohmann::json::parse(outcome.output.section("validation ", 1, 1).section("\n", 0, 0).toStdString());
        const double before = nlohmann::json::parse(start.toStdString()).at("relief_correlation").get<double>();
        QVERIFY2(std::abs(first.at("relief_correlation").get<double>() - before) < 0.02, qPrintable(outcome.output));
        QCOMPARE(outcome.output.count("validation "), 2);
        const QString again = "note: model was trained on the fabrics of family 5 already";
        QVERIFY2(outcome.output.contains(again), qPrintable(outcome.output));
        QStringList call = smallRun("new-fabrics.safetensors", 1, {"--from", at("model.safetensors")});
        call[call.indexOf("--seed") + 1] = "6";
        const QString fresh = run(call).output;
        QVERIFY2(fresh.contains("training on drawn fabrics of family 6") && !fresh.contains("already"), qPrintable(fresh));
    }

    void checkpointOfOtherSettingsIsRefused()
    {
        QProcess broken;
        broken.start(program(), smallRun("other.safetensors", 400));
        QElapsedTimer waited;
        waited.start();
        while (!QFile::exists(at("other.safetensors.checkpoint")) && waited.elapsed() < 120000) QTest::qWait(2);
        broken.kill();
        broken.waitForFinished();
        const Outcome outcome = run(smallRun("other.safetensors", 500, {"--resume"}));
        QCOMPARE(outcome.exitCode, 2);
        QVERIFY2(outcome.errors.contains("other.safetensors.checkpoint"), qPrintable(outcome.errors));
    }

    void reliefGrowsWithThePitchAndKeepsThePixelsOfThePhotograph()
    {
        const fabrics::DrawnPatch patch = fabrics::drawPatch(3, 2, {150});
        const models::GeneratedSignals once = signalsOf(patch.rgb, 0.05), twice = signalsOf(patch.rgb, 0.1);
        QCOMPARE(once.heightMm.size(), patch.rgb.size());
        QCOMPARE(once.heightMmPerPixel, 0.05);
        QVERIFY(cv::norm(once.heightMm) > 0);
        QVERIFY2(cv::norm(twice.heightMm - 2 * once.heightMm, cv::NORM_INF) < 1e-5, "twice the pitch is twice the height");
        QVERIFY(once.meanFriction > 0 && once.meanFriction != twice.meanFriction);
        QVERIFY(!once.trace.empty());
        const auto& interval = once.photograph.meanFriction;
        QVERIFY(interval && interval->low < once.meanFriction && once.meanFriction < interval->high);
    }

    void aToldLampChangesTheReliefAndTheTurnedPictureIsTurnedBack()
    {
        const fabrics::DrawnPatch patch = fabrics::drawPatch(3, 2, {112});
        const cv::Mat untold = signalsOf(patch.rgb, 0.05).heightMm, upperLeft = signalsOf(patch.rgb, 0.05, 135).heightMm;
        QCOMPARE(upperLeft.size(), patch.rgb.size());
        QVERIFY(cv::norm(upperLeft - untold, cv::NORM_INF) > 0);
        // The picture and its lamp mirrored give the mirrored relief.
        cv::Mat mirrored, back;
        cv::flip(patch.rgb, mirrored, 1);
        cv::flip(signalsOf(mirrored, 0.05, 45).heightMm, back, 1);
        QVERIFY2(cv::norm(back - upperLeft, cv::NORM_INF) < 1e-6, "a lamp at the upper right is another one");
    }

    void extremePicturesGiveFiniteSignals_data()
    {
        QTest::addColumn<int>("width");
        QTest::addColumn<int>("height");
        QTest::addColumn<int>("grey");
        QTest::newRow("one pixel") << 1 << 1 << 128;
        QTest::newRow("a line") << 700 << 3 << 90;
        QTest::newRow("black") << 100 << 100 << 0;
        QTest::newRow("white") << 100 << 33 << 255;
    }
    void extremePicturesGiveFiniteSignals()
    {
        QFETCH(int, width);
        QFETCH(int, height);
        QFETCH(int, grey);
        const models::GeneratedSignals signals = signalsOf(cv::Mat(height, width, CV_8UC3, cv::Scalar::all(grey)), 0.05);
        QCOMPARE(signals.heightMm.size(), cv::Size(width, height));
        QVERIFY(cv::checkRange(signals.heightMm) && std::isfinite(signals.meanFriction));
    }

    void badOptionsAreRefused_data()
    {
        QTest::addColumn<QStringList>("options");
        QTest::addColumn<QString>("named");
        QTest::newRow("crop") << QStringList{"--crop", "100"} << "--crop is 100";
        QTest::newRow("steps") << QStringList{"--steps", "0"} << "--steps is 0";
        QTest::newRow("batch") << QStringList{"--batch", "1"} << "batch of at least 2";
        QTest::newRow("a huge batch") << QStringList{"--batch", "100000"} << "--batch is 100000";
        QTest::newRow("many threads") << QStringList{"--threads", "100000"} << "--threads is 100000";
        QTest::newRow("share") << QStringList{"--scan-share", "2"} << "--scan-share is out of range";
        QTest::newRow("scans") << QStringList{"--scans", "nowhere"} << "nowhere";
        QTest::newRow("a control from a model") << QStringList{"--reference", "--from", at("model.safetensors")}
                                                << "the losses of the paper were given together with";
        QTest::newRow("two controls") << QStringList{"--reference", "--l1-only"} << "both --reference and --l1-only";
    }
    void badOptionsAreRefused()
    {
        QFETCH(QStringList, options);
        QFETCH(QString, named);
        const Outcome outcome = run(QStringList{"train-cloth", "--out", at("refused.safetensors")} + options);
        QCOMPARE(outcome.exitCode, 2);
        QVERIFY2(outcome.errors.contains(named), qPrintable(outcome.errors));
        QVERIFY(!QFile::exists(at("refused.safetensors")));
    }

    /// Through `vis2hap train`, in whose words the options are refused.
    void optionsOfAnotherTrainingAreRefused_data()
    {
        QTest::addColumn<QStringList>("options");
        QTest::addColumn<QString>("named");
        for (const char* name : {"--split", "--split-seed", "--patience", "--validation-pairs"})
            QTest::addRow("%s", name) << QStringList{"--drawn", name, "3"} << QString(name) + " was given together with --drawn";
        for (const char* name : {"--towards", "--way", "--scans", "--scan-share"})
            QTest::addRow("%s", name) << QStringList{"cloths", name, "1"} << QString(name) + " was given together with DATASET";
    }
    void optionsOfAnotherTrainingAreRefused()
    {
        QFETCH(QStringList, options);
        QFETCH(QString, named);
        const auto refused = support::runProgram(QStringList{"train", "--out", at("refused.safetensors")} + options);
        QCOMPARE(refused.exitCode, 2);
        QVERIFY2(refused.err.contains(named) && refused.err.contains("; expected a training"), qPrintable(refused.err));
        QVERIFY(!QFile::exists(at("refused.safetensors")));
    }
};

QTEST_GUILESS_MAIN(ClothTrainingTest)
#include "cloth_training_test.moc"
