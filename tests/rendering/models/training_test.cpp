// Training through the real command on a tiny procedural data set.
#include <QDir>
#include <QElapsedTimer>
#include <QFile>
#include <QProcess>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "protocols/files/canonical_bytes.h"
#include "protocols/files/sha256.h"
#include "rendering/fabrics/dataset.h"
#include "rendering/fabrics/location_split.h"
#include "rendering/fabrics/procedural/procedural_fabrics.h"
#include "rendering/models/model_card_fields.h"
#include "rendering/models/process/child_process.h"
#include "rendering/signals/tactile/calibration.h"
#include "tests/rendering/spoilt_tensors.h"

using namespace rendering;
using fabrics::Part;

namespace {

struct TrainingOutcome {
    int exitCode = 0;
    QString output, errors;
};

QString program() { return QString::fromStdString(models::generatorProgram().string()); }

TrainingOutcome run(const QStringList& arguments)
{
    QProcess process;
    process.start(program(), arguments);
    process.waitForFinished(300000);
    return {process.exitStatus() == QProcess::NormalExit ? process.exitCode() : -1, process.readAllStandardOutput(),
            process.readAllStandardError()};
}

}  // namespace

class TrainingTest : public QObject {
    Q_OBJECT

private:
    QTemporaryDir m_folder;

    std::filesystem::path at(const char* name) const { return std::filesystem::path(m_folder.path().toStdString()) / name; }
    QString text(const char* name) const { return m_folder.filePath(name); }

    /// A run that is small enough for a test: crops of 64 px, narrow networks.
    QStringList smallRun(const char* out, int steps) const
    {
        return {"train",
                text("fabrics"),
                "--out",
                text(out),
                "--steps",
                QString::number(steps),
                "--crop",
                "64",
                "--channels",
                "4",
                "--batch",
                "3",
                "--seed",
                "5",
                "--checkpoint-every",
                "4",
                "--validation-pairs",
                "12",
                "--threads",
                "1"};
    }

    /// Kills a run of 24 steps as soon as its first checkpoint exists.
    void breakOffAtFirstCheckpoint(const char* out) const
    {
        QProcess broken;
        broken.start(program(), smallRun(out, 24));
        const QString checkpoint = text(out) + ".checkpoint";
        QElapsedTimer waited;
        waited.start();
        while (!QFile::exists(checkpoint) && waited.elapsed() < 120000) QTest::qWait(2);
        broken.kill();
        broken.waitForFinished();
        QVERIFY(QFile::exists(checkpoint));
        QVERIFY2(!QFile::exists(text(out)), "the run ended before it was interrupted");
    }

private Q_SLOTS:
    void initTestCase()
    {
        for (const auto& [name, value] : models::missingThreadSettings())
            qputenv(name.c_str(), QByteArray::fromStdString(value));  // Otherwise each run starts twice, to set it.
        fabrics::ProceduralOptions options;
        options.fabrics = 3;
        options.samples = 10;
        options.seed = 31;
        fabrics::makeProceduralFabrics(at("fabrics"), options);
    }

    void trainingFromScratchLowersTheValidationDistances()
    {
        const TrainingOutcome outcome = run(smallRun("model.safetensors", 160));
        QVERIFY2(outcome.exitCode == 0, qPrintable(outcome.errors));
        QVERIFY(outcome.output.contains("step 160"));
        QVERIFY(outcome.output.contains("left"));
        const models::ModelCardFields card = models::readModelCardFields(at("model.safetensors"));
        QCOMPARE(card.steps, 160);
        const auto validation = nlohmann::ordered_json::parse(card.validationJson);
        const std::map<const char*, double> shares{
            {"distance", 0.8}, {"mean_friction_relative_error", 0.8}, {"height_l1_mm", 0.95}, {"log_ratio_l1", 0.95}};
        for (const auto& [figure, share] : shares) {
            const double before = validation.at("before").at(figure).at("generated").get<double>();
            const double after = validation.at("after").at(figure).at("generated").get<double>();
            QVERIFY2(after < share * before, qPrintable(QString("%1: %2 -> %3").arg(figure).arg(before).arg(after)));
        }
        const fabrics::Dataset dataset = fabrics::readDataset(at("fabrics"));
        QCOMPARE(card.architecture.zeroPercentile,
                 signals::readCalibration(dataset.folder / dataset.tactileCalibration).zeroPercentile);
        QVERIFY(!std::filesystem::exists(at("model.safetensors.checkpoint")));
        QVERIFY(std::filesystem::file_size(at("model.safetensors")) < (4U << 20U));
    }

    void cardNamesTheFilesTrainedOnAndNoOthers()
    {
        const models::ModelCard card = models::readModelCard(at("model.safetensors"));
        const fabrics::Dataset dataset = fabrics::readDataset(at("fabrics"));
        std::vector<std::string> expected;
        std::set<std::string> others;
        for (const auto& [place, part] : fabrics::splitByLocation(dataset, 1)) {
            const std::string hash =
                protocols::sha256OfFile(fabrics::samplePath(dataset, place.fabric, place.modality, place.index));
            if (part == Part::Training)
                expected.push_back(hash);
            else
                others.insert(hash);
        }
        std::sort(expected.begin(), expected.end());
        QVERIFY(others.size() >= 9);
        QCOMPARE(card.trainingSampleHashes, expected);
        for (const std::string& hash : card.trainingSampleHashes) QVERIFY(!others.contains(hash));
        QVERIFY(card.trainedOnProceduralSet);
        QCOMPARE(card.sha256, protocols::sha256OfFile(at("model.safetensors")));
        QVERIFY(card.trainingCommand.starts_with("vis2hap train "));
    }

    void heldOutFabricLeavesNoTrace()
    {
        const TrainingOutcome outcome = run(smallRun("held.safetensors", 1) << "--hold-out"
                                                                            << "F02,F03");
        QVERIFY2(outcome.exitCode == 0, qPrintable(outcome.errors));
        const models::ModelCardFields card = models::readModelCardFields(at("held.safetensors"));
        QCOMPARE(card.heldOut, (std::vector<std::string>{"F02", "F03"}));
        const fabrics::Dataset dataset = fabrics::readDataset(at("fabrics"));
        for (const char* fabric : {"F02", "F03"})
            for (const fabrics::Modality modality :
                 {fabrics::Modality::Visual, fabrics::Modality::Tactile, fabrics::Modality::Friction})
                for (const int index : fabrics::sampleIndices(dataset, protocols::FabricId(fabric), modality)) {
                    const std::string hash =
                        protocols::sha256OfFile(fabrics::samplePath(dataset, protocols::FabricId(fabric), modality, index));
                    QVERIFY(!std::ranges::binary_search(card.summary.trainingSampleHashes, hash));
                }
    }

    void resumedRunEqualsTheUninterruptedOne()
    {
        QCOMPARE(run(smallRun("whole.safetensors", 24)).exitCode, 0);
        breakOffAtFirstCheckpoint("broken.safetensors");
        const TrainingOutcome resumed = run(smallRun("broken.safetensors", 24) << "--resume");
        QVERIFY2(resumed.exitCode == 0, qPrintable(resumed.errors));
        QVERIFY(resumed.output.contains("resumed at step"));
        QCOMPARE(protocols::sha256OfFile(at("broken.safetensors")), protocols::sha256OfFile(at("whole.safetensors")));
        for (const char* file : {"losses.csv", "validation.csv", "curves.svg"})
            QCOMPARE(protocols::sha256OfFile(at("broken.safetensors.log") / file),
                     protocols::sha256OfFile(at("whole.safetensors.log") / file));
    }

    /// Another version may split the same data set otherwise.
    void checkpointOfAnotherSplitIsRefused()
    {
        breakOffAtFirstCheckpoint("split.safetensors");
        std::ifstream stream(at("split.safetensors.checkpoint"), std::ios::binary);
        std::string bytes{std::istreambuf_iterator<char>(stream), {}};
        protocols::CanonicalBytes files;
        for (const std::string& hash : models::readModelCard(at("whole.safetensors")).trainingSampleHashes) files << hash;
        const auto named = bytes.find(files.hash());
        QVERIFY(named != std::string::npos);
        bytes.replace(named, 64, protocols::sha256("files of another split"));
        std::ofstream(at("split.safetensors.checkpoint"), std::ios::binary) << bytes;
        const TrainingOutcome outcome = run(smallRun("split.safetensors", 24) << "--resume");
        QCOMPARE(outcome.exitCode, 2);
        QVERIFY2(outcome.errors.contains("belongs to a run with another data set or other options"), qPrintable(outcome.errors));
    }

    void anotherSeedGivesOtherWeights()
    {
        QStringList other = smallRun("other.safetensors", 24);
        other[other.indexOf("--seed") + 1] = "6";
        QCOMPARE(run(other).exitCode, 0);
        QVERIFY(protocols::sha256OfFile(at("other.safetensors")) != protocols::sha256OfFile(at("whole.safetensors")));
    }

    void wildLearningRateStopsTheRunAndWritesNothing()
    {
        const TrainingOutcome outcome = run(smallRun("wild.safetensors", 40) << "--learning-rate"
                                                                             << "1e30");
        QCOMPARE(outcome.exitCode, 1);
        QCOMPARE(outcome.errors.trimmed().count('\n'), 0);
        QVERIFY2(outcome.errors.contains("the loss is not finite"), qPrintable(outcome.errors));
        QVERIFY(!QFile::exists(text("wild.safetensors.checkpoint")));
        QVERIFY(!QFile::exists(text("wild.safetensors")));
    }

    void brokenLossKeepsTheCheckpointBeforeIt()
    {
        breakOffAtFirstCheckpoint("nan.safetensors");
        std::ifstream stream(at("nan.safetensors.checkpoint"), std::ios::binary);
        const std::string whole{std::istreambuf_iterator<char>(stream), {}};
        const std::string spoilt = support::withNumbersSpoilt(whole, "F32", std::string("\xE6\xB1\x61\x7F", 4));  // 3e38
        std::ofstream(at("nan.safetensors.checkpoint"), std::ios::binary) << spoilt;
        const TrainingOutcome outcome = run(smallRun("nan.safetensors", 24) << "--resume");
        QCOMPARE(outcome.exitCode, 1);
        QCOMPARE(outcome.errors.trimmed().count('\n'), 0);
        QVERIFY2(outcome.errors.contains("the loss is not finite") && outcome.errors.contains("nan.safetensors.checkpoint"),
                 qPrintable(outcome.errors));
        QCOMPARE(protocols::sha256OfFile(at("nan.safetensors.checkpoint")), protocols::sha256(spoilt));
        QVERIFY(!QFile::exists(text("nan.safetensors")));
    }

    void checkpointsWithObjectsOrWithoutNumbersAreRefused()
    {
        std::ifstream stream(at("nan.safetensors.checkpoint"), std::ios::binary);
        const std::string whole{std::istreambuf_iterator<char>(stream), {}};
        const std::string holes = support::withNumbersSpoilt(whole, "F32", std::string("\x00\x00\xC0\x7F", 4));
        for (const auto& [bytes, named] : {std::pair{std::string("PK\x03\x04", 4) + whole, "archive of objects"},
                                           {holes, "not finite"},
                                           {whole.substr(0, whole.size() - 1), "bytes of data"}}) {
            std::ofstream(at("holes.safetensors.checkpoint"), std::ios::binary) << bytes;
            const TrainingOutcome outcome = run(smallRun("holes.safetensors", 24) << "--resume");
            QCOMPARE(outcome.exitCode, 2);
            QCOMPARE(outcome.errors.trimmed().count('\n'), 0);
            QVERIFY2(outcome.errors.contains(named), qPrintable(outcome.errors));
        }
    }

    void referenceLossesTrainToo()
    {
        QCOMPARE(run(smallRun("reference.safetensors", 2) << "--reference").exitCode, 0);
        const models::ModelCardFields card = models::readModelCardFields(at("reference.safetensors"));
        QCOMPARE(card.objective, std::string("reference"));
        QVERIFY(!card.architecture.imposesSpectrum);  // The paper's networks impose nothing.
    }

    void controlByL1TrainsWithoutADiscriminator()
    {
        const TrainingOutcome outcome = run(smallRun("l1.safetensors", 2) << "--l1-only");
        QCOMPARE(outcome.exitCode, 0);
        QVERIFY2(outcome.output.contains("D 0.0 "), qPrintable(outcome.output));
        QCOMPARE(models::readModelCardFields(at("l1.safetensors")).objective, std::string("l1-only"));
    }

    void splitAfterAugmentationLeavesNothingUnseen()
    {
        QCOMPARE(run(smallRun("augmented.safetensors", 1) << "--split"
                                                          << "augmented")
                     .exitCode,
                 0);
        const models::ModelCardFields card = models::readModelCardFields(at("augmented.safetensors"));
        QCOMPARE(card.split, std::string("augmented"));
        const fabrics::Dataset dataset = fabrics::readDataset(at("fabrics"));
        QCOMPARE(card.summary.trainingSampleHashes.size(), fabrics::splitBySample(dataset, 1).size());
    }

    void trainingStopsWhereValidationNoLongerImproves()
    {
        QStringList call = smallRun("early.safetensors", 400);
        call << "--validate-every"
             << "1"
             << "--patience"
             << "1"
             << "--learning-rate"
             << "0.05";
        const TrainingOutcome outcome = run(call);
        QVERIFY2(outcome.exitCode == 0, qPrintable(outcome.errors));
        const models::ModelCardFields card = models::readModelCardFields(at("early.safetensors"));
        QVERIFY2(card.steps < 400, qPrintable(QString::number(card.steps)));
        QCOMPARE(card.bestStep, card.steps - 1);
    }

    void logShowsTheLossesAndPicturesOfTheRun()
    {
        const QDir log(text("model.safetensors.log"));
        QCOMPARE(log.entryList({"losses.csv", "validation.csv", "curves.svg", "samples-*.png"}, QDir::Files).size(), 4);
        QFile losses(log.filePath("losses.csv"));
        QVERIFY(losses.open(QIODevice::ReadOnly));
        QCOMPARE(losses.readAll().trimmed().count('\n'), 16);  // A header, then every tenth of 160 steps.
    }

    void minutesEndTheRunInTime()
    {
        QStringList brief = smallRun("brief.safetensors", 1);
        const auto steps = brief.indexOf("--steps");
        brief[steps] = "--minutes";
        brief[steps + 1] = "0.02";
        QCOMPARE(run(brief).exitCode, 0);
        const models::ModelCardFields card = models::readModelCardFields(at("brief.safetensors"));
        QVERIFY(card.steps >= 1);
        QVERIFY(card.trainingMinutes < 0.5);
    }

    void wrongCallsAreRefusedInOneLine_data()
    {
        QTest::addColumn<QStringList>("arguments");
        QTest::addColumn<int>("exitCode");
        QTest::addColumn<QString>("named");
        const QString fabrics = text("fabrics"), out = text("no.safetensors");
        QTest::newRow("no data set") << QStringList{"train", text("nowhere"), "--out", out} << 2 << "nowhere";
        QTest::newRow("no --out") << QStringList{"train", fabrics} << 2 << "--out";
        QTest::newRow("unknown option") << QStringList{"train", fabrics, "--out", out, "--stepz", "3"} << 2 << "--stepz";
        QTest::newRow("steps and minutes") << QStringList{"train", fabrics, "--out", out, "--steps", "3", "--minutes", "1"} << 2
                                           << "--minutes";
        QTest::newRow("no steps") << QStringList{"train", fabrics, "--out", out, "--steps", "0"} << 2 << "--steps";
        QTest::newRow("odd crop") << QStringList{"train", fabrics, "--out", out, "--steps", "1", "--crop", "50"} << 2 << "--crop";
        QTest::newRow("a huge batch") << QStringList{"train", fabrics, "--out", out, "--steps", "1", "--batch", "100000"} << 2
                                      << "--batch";
        QTest::newRow("many threads") << QStringList{"train", fabrics, "--out", out, "--steps", "1", "--threads", "100000"} << 2
                                      << "--threads";
        QTest::newRow("a huge rate") << QStringList{"train", fabrics, "--out", out, "--steps", "1", "--learning-rate", "1e300"}
                                     << 2 << "--learning-rate";
        QTest::newRow("unknown split") << QStringList{"train", fabrics, "--out", out, "--split", "weather"} << 2 << "--split";
        QTest::newRow("two kinds of losses")
            << QStringList{"train", fabrics, "--out", out, "--reference", "--l1-only"} << 2 << "--l1-only";
        QTest::newRow("unknown fabric") << QStringList{"train", fabrics, "--out", out, "--steps", "1", "--hold-out", "F77"} << 2
                                        << "F77";
        QTest::newRow("nothing left") << QStringList{"train", fabrics, "--out", out, "--steps", "1", "--hold-out", "F01,F02,F03"}
                                      << 2 << "held out";
        QTest::newRow("nothing to resume") << QStringList{"train", fabrics, "--out", out, "--steps", "1", "--resume"} << 2
                                           << "no checkpoint";
        QTest::newRow("no folder for the weights")
            << QStringList{"train", fabrics, "--out", text("none/no.safetensors"), "--steps", "1", "--crop", "64"} << 3
            << "none/no.safetensors";
        QTest::newRow("a folder for the weights")
            << QStringList{"train", fabrics, "--out", text("fabrics"), "--steps", "1"} << 2 << "fabrics";
    }

    void wrongCallsAreRefusedInOneLine()
    {
        QFETCH(QStringList, arguments);
        QFETCH(int, exitCode);
        QFETCH(QString, named);
        const TrainingOutcome outcome = run(arguments);
        QCOMPARE(outcome.exitCode, exitCode);
        QCOMPARE(outcome.errors.trimmed().count('\n'), 0);
        QVERIFY2(outcome.errors.contains(named), qPrintable(outcome.errors));
        QVERIFY(!QFile::exists(text("no.safetensors")));
    }

    void dataSetWithoutFrictionIsRefusedByName()
    {
        std::filesystem::copy(at("fabrics"), at("untouched"), std::filesystem::copy_options::recursive);
        for (const char* fabric : {"F01", "F02", "F03"}) std::filesystem::remove_all(at("untouched") / fabric / "friction");
        const TrainingOutcome outcome = run({"train", text("untouched"), "--out", text("no.safetensors"), "--steps", "1"});
        QCOMPARE(outcome.exitCode, 2);
        QVERIFY2(outcome.errors.contains("friction"), qPrintable(outcome.errors));
    }

    void checkpointOfAnotherRunIsRefused()
    {
        std::filesystem::copy_file(at("nan.safetensors.checkpoint"), at("tame.safetensors.checkpoint"));
        const TrainingOutcome outcome = run(smallRun("tame.safetensors", 3) << "--resume");
        QCOMPARE(outcome.exitCode, 2);
        QVERIFY2(outcome.errors.contains("another data set or other options"), qPrintable(outcome.errors));
        std::filesystem::resize_file(at("tame.safetensors.checkpoint"), 1000);
        const TrainingOutcome damaged = run(smallRun("tame.safetensors", 3) << "--resume");
        QCOMPARE(damaged.exitCode, 2);
        QCOMPARE(damaged.errors.trimmed().count('\n'), 0);
    }
};

QTEST_GUILESS_MAIN(TrainingTest)
#include "training_test.moc"
