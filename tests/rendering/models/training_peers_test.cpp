// Training in several processes: their losses and weights are those of one process within rounding, and a process that ends, or
// was started otherwise, ends the others with one clear error.
#include <QElapsedTimer>
#include <QFile>
#include <QProcess>
#include <QTcpServer>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <cstring>
#include <opencv2/core.hpp>
#include <thread>

#include "rendering/models/process/child_process.h"
#include "rendering/models/seeing/cloth_steps.h"
#include "rendering/models/seeing/friction_target.h"

using namespace rendering::models;

namespace {

/// Rounding of float32 grows from step to step, because Adam divides by the size of a gradient.
constexpr double largestLossDifference = 1e-5, largestShareOfWay = 1e-3;

/// A port of the loopback interface that nobody uses now.
QString freeMaster()
{
    QTcpServer server;
    server.listen(QHostAddress::LocalHost);
    return QString("127.0.0.1:%1").arg(server.serverPort());
}

ClothTrainingOptions smallOptions()
{
    ClothTrainingOptions options;
    options.steps = 6;
    options.seed = 5;
    options.batch = 5;  // The processes have different numbers of patches.
    options.side = 48;
    options.baseChannels = 4;
    options.learningRate = 0.05;  // Of which the first steps take a hundredth more each.
    return options;
}

Architecture smallArchitecture()
{
    Architecture architecture;
    architecture.sees = true;
    architecture.baseChannels = 4;
    architecture.crop = 48;
    architecture.imposesSpectrum = false;
    setSpectrogramShape(architecture);
    return architecture;
}

struct TrainedSteps {
    std::vector<ClothLosses> losses;
    std::vector<StoredTensor> before, after;
};

TrainedSteps stepsOf(ClothTraining& training)
{
    TrainedSteps done;
    done.before = training.tensors();
    const int steps = *smallOptions().steps;
    for (int step = 0; step < steps; ++step) done.losses.push_back(training.step(step, static_cast<double>(step) / steps));
    done.after = training.tensors();
    return done;
}

/// Sum of the absolute differences of the weights in training.
double distanceOf(const std::vector<StoredTensor>& a, const std::vector<StoredTensor>& b)
{
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k)
        for (std::size_t i = 0; a[k].kind.name.starts_with("now.") && a[k].kind.element == Element::F32 && i < a[k].bytes.size();
             i += 4) {
            float x = 0, y = 0;
            std::memcpy(&x, &a[k].bytes[i], 4);
            std::memcpy(&y, &b[k].bytes[i], 4);
            sum += std::abs(static_cast<double>(x) - y);
        }
    return sum;
}

}  // namespace

class TrainingPeersTest : public QObject {
    Q_OBJECT

private:
    QTemporaryDir m_folder;

    /// Starts a process of a tiny training.
    void start(QProcess& process, const QString& master, int rank, const QStringList& more = {}, int waitS = 20) const
    {
        process.start(QString::fromStdString(generatorProgram().string()),
                      QStringList{"train-cloth",
                                  "--out",
                                  m_folder.filePath(QString("model-%1").arg(rank)),
                                  "--crop",
                                  "48",
                                  "--channels",
                                  "4",
                                  "--batch",
                                  "4",
                                  "--seed",
                                  "5",
                                  "--threads",
                                  "1",
                                  "--validation-patches",
                                  "8",
                                  "--processes",
                                  "2",
                                  "--rank",
                                  QString::number(rank),
                                  "--master",
                                  master,
                                  "--wait",
                                  QString::number(waitS)} +
                          more);
        QVERIFY(process.waitForStarted());
    }

private Q_SLOTS:
    void rowsOfABatchAreThoseOfTheWhole()
    {
        ClothBatchOptions options;
        options.size = 5;
        options.side = 48;
        options.spectrograms = smallArchitecture();
        cv::Mat3b colour(160, 160, cv::Vec3b(90, 120, 150));
        cv::Mat1f height(160, 160);
        cv::randu(height, 0.f, 0.3f);
        const std::vector<ScannedCloth> scans{{"F01", colour, height, 0.1, true, 45.0}};
        options.scanShare = 0.5;
        const ClothBatch whole = drawClothBatch(scans, options, 3, 7);
        options.firstRow = 2;
        options.rows = 2;
        const ClothBatch part = drawClothBatch(scans, options, 3, 7);
        QCOMPARE(part.size, 2);
        const auto isPart = [](const std::vector<float>& all, const std::vector<float>& some) {
            const std::size_t row = all.size() / 5;
            return some.size() == 2 * row &&
                   std::memcmp(all.data() + 2 * row, some.data(), some.size() * sizeof(float)) == 0;  // NaN equals NaN
        };
        QVERIFY(isPart(whole.photographs, part.photographs));
        QVERIFY(isPart(whole.reliefs, part.reliefs));
        QVERIFY(isPart(whole.lamps, part.lamps));
        QVERIFY(isPart(whole.logPitches, part.logPitches));
        QVERIFY(isPart(whole.logFrictions, part.logFrictions));
        QVERIFY(isPart(whole.logRatios, part.logRatios));
    }

    void twoProcessesTrainAsOneDoes()
    {
        torch::set_num_threads(1);
        const ClothTrainingOptions options = smallOptions();
        const std::vector<ScannedCloth> none;
        const auto made = [&](std::uint64_t seed) {
            torch::manual_seed(seed);
            return std::make_unique<ClothTraining>(smallArchitecture(), none, options);
        };
        const TrainedSteps alone = stepsOf(*made(5));
        // Rank 1 draws other first weights, and takes those of rank 0.
        const std::vector<std::unique_ptr<ClothTraining>> trainings = [&] {
            std::vector<std::unique_ptr<ClothTraining>> both;
            both.push_back(made(5));
            both.push_back(made(6));
            return both;
        }();
        const std::string master = freeMaster().toStdString();
        std::vector<TrainedSteps> together(2);
        std::vector<std::string> faults(2);
        std::vector<std::thread> processes;
        for (std::size_t rank = 0; rank < 2; ++rank)
            processes.emplace_back([&, rank] {
                try {
                    const TrainingPeers peers({2, static_cast<int>(rank), master, 60}, {{"--seed", "5"}});
                    trainings[rank]->shareWith(peers);
                    together[rank] = stepsOf(*trainings[rank]);
                } catch (const std::exception& fault) {
                    faults[rank] = fault.what();
                }
            });
        for (std::thread& one : processes) one.join();
        QCOMPARE(faults[0] + faults[1], std::string());
        double largest = 0;
        for (std::size_t step = 0; step < alone.losses.size(); ++step) {
            const ClothLosses &one = alone.losses[step], &two = together[0].losses[step];
            for (const auto& [a, b] :
                 {std::pair{one.relief, two.relief}, {one.friction, two.friction}, {one.spectrogram, two.spectrogram}}) {
                qInfo("step %zu: %.7f in one process, %.7f in two", step, a, b);
                largest = std::max(largest, std::abs(a - b) / std::max(1.0, std::abs(a)));
            }
            QCOMPARE(together[1].losses[step].relief, two.relief);  // Sums have the same bits in all processes.
        }
        const double moved = distanceOf(alone.before, alone.after), apart = distanceOf(alone.after, together[0].after);
        qInfo("largest difference of a loss %.2g; weights apart by %.2g of their way", largest, apart / moved);
        QVERIFY2(largest < largestLossDifference, qPrintable(QString::number(largest)));
        QVERIFY(largest > 0);  // Two processes really sum in another order.
        QVERIFY2(apart < largestShareOfWay * moved, qPrintable(QString::number(apart / moved)));
        QVERIFY(together[0].after == together[1].after);  // Weights, running statistics and optimiser.
    }

    void onlyRankZeroWrites()
    {
        const QString master = freeMaster();
        QProcess first, second;
        start(first, master, 0, {"--steps", "4"});
        start(second, master, 1, {"--steps", "4"});
        QVERIFY(first.waitForFinished(60000) && second.waitForFinished(60000));
        QVERIFY2(first.exitCode() == 0, first.readAllStandardError().constData());
        QVERIFY2(second.exitCode() == 0, second.readAllStandardError().constData());
        QVERIFY(QFile::exists(m_folder.filePath("model-0")) && QFile::exists(m_folder.filePath("model-0.json")));
        for (const char* file : {"model-1", "model-1.json", "model-1.checkpoint", "model-1.log"})
            QVERIFY2(!QFile::exists(m_folder.filePath(file)), file);
        QVERIFY(!QFile::exists(m_folder.filePath("model-0.checkpoint")));
    }

    void aProcessThatDiesEndsTheOther()
    {
        const QString master = freeMaster();
        QProcess first, second;
        start(first, master, 0, {"--steps", "100000", "--checkpoint-every", "1"});
        start(second, master, 1, {"--steps", "100000", "--checkpoint-every", "1"});
        QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(m_folder.filePath("model-0.checkpoint")), 30000);
        second.kill();
        QElapsedTimer waited;
        waited.start();
        QVERIFY(first.waitForFinished(30000));
        qInfo("rank 0 ended %lld ms after rank 1 was killed", static_cast<long long>(waited.elapsed()));
        QCOMPARE(first.exitCode(), 1);
        const QByteArray error = first.readAllStandardError();
        QVERIFY2(error.count('\n') == 1 && error.contains("another process of the training has ended"), error.constData());
        QVERIFY(!QFile::exists(m_folder.filePath("model-0.json.tmp")));
        QVERIFY(QFile::exists(m_folder.filePath("model-0.checkpoint")));
        second.waitForFinished();
    }

    void processesThatDifferAreRefusedByName()
    {
        const QString master = freeMaster();
        QProcess first, second;
        start(first, master, 0, {"--steps", "4"});
        start(second, master, 1, {"--steps", "5"});
        QVERIFY(first.waitForFinished(60000) && second.waitForFinished(60000));
        for (QProcess* process : {&first, &second}) {
            const QByteArray error = process->readAllStandardError();
            QVERIFY2(process->exitCode() == 2, error.constData());
            QVERIFY2(error.count('\n') == 1 && error.contains("--steps is 5 at rank 1 and 4 at rank 0"), error.constData());
        }
    }

    void aProcessThatDoesNotComeEndsTheWait()
    {
        QProcess alone;
        start(alone, freeMaster(), 0, {"--steps", "4"}, 2);
        QVERIFY(alone.waitForFinished(30000));
        const QByteArray error = alone.readAllStandardError();
        QVERIFY2(alone.exitCode() == 3, error.constData());
        QVERIFY2(error.count('\n') == 1 && error.contains("did not meet"), error.constData());
    }

    void impossiblePlacesAreRefused()
    {
        const auto refused = [&](const QStringList& more) {
            QProcess process;
            process.start(QString::fromStdString(generatorProgram().string()),
                          QStringList{"train-cloth", "--out", m_folder.filePath("none"), "--steps", "1"} + more);
            process.waitForFinished(30000);
            return process.exitCode();
        };
        QCOMPARE(refused({"--processes", "0"}), 2);
        QCOMPARE(refused({"--processes", "2", "--rank", "2", "--master", "127.0.0.1:29500"}), 2);
        QCOMPARE(refused({"--processes", "2", "--master", "127.0.0.1"}), 2);
        QCOMPARE(refused({"--processes", "2", "--master", "127.0.0.1:99999"}), 2);
        QCOMPARE(refused({"--processes", "2", "--batch", "1", "--master", "127.0.0.1:29500"}), 2);
    }
};

QTEST_GUILESS_MAIN(TrainingPeersTest)
#include "training_peers_test.moc"
