// The folder of a training run: tables, curves and sample pictures. An interrupted and resumed run leaves the same folder
// as an uninterrupted one.
#include "rendering/models/training_log.h"

#include <QElapsedTimer>
#include <QTemporaryDir>
#include <QTest>
#include <QXmlStreamReader>
#include <cmath>
#include <filesystem>
#include <map>
#include <opencv2/core.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"
#include "rendering/images/image_png.h"
#include "rendering/models/training_curves.h"
#include "rendering/models/training_table.h"
#include "tests/rendering/refusal.h"

using namespace rendering;
using models::NamedValue;
using models::SampleRow;
using models::TrainingLog;
namespace fs = std::filesystem;

namespace {

std::vector<NamedValue> lossesAt(int step) { return {{"l1", 1.0 / step}, {"generator", 0.5 + 0.1 * std::sin(step)}}; }

std::vector<SampleRow> samples()
{
    const cv::Mat photograph(64, 64, CV_8UC3, cv::Scalar(200, 40, 40));
    cv::Mat ramp(48, 64, CV_32FC1), higher;
    for (int x = 0; x < 64; ++x) ramp.col(x).setTo(0.001 * x);
    higher = ramp * 2;
    return {{"F01", photograph, ramp, higher}, {"F02", photograph, cv::Mat(), ramp}};
}

void train(TrainingLog& log, int from, int to)
{
    for (int step = from; step <= to; ++step) {
        log.losses(step, lossesAt(step));
        if (step % 20 == 0) {
            const std::vector<NamedValue> figures{{"ssim", 0.01 * step}};
            log.validation(step, figures);
            log.pictures(step, samples());
        }
    }
}

std::map<std::string, std::string> contents(const fs::path& folder)
{
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(folder))
        files[entry.path().filename().string()] = protocols::readWholeFile(entry.path());
    return files;
}

}  // namespace

class TrainingLogTest : public QObject {
    Q_OBJECT

private:
    QTemporaryDir m_folder;
    fs::path at(const char* name) const { return fs::path(m_folder.path().toStdString()) / name; }

private Q_SLOTS:
    void everyStepHasItsRow()
    {
        TrainingLog log(at("rows"));
        train(log, 1, 40);
        const std::string text = protocols::readWholeFile(at("rows") / "losses.csv");
        QVERIFY(text.starts_with("step,l1,generator\n1,1,"));
        QCOMPARE(std::count(text.begin(), text.end(), '\n'), 41);
        QCOMPARE(protocols::readWholeFile(at("rows") / "validation.csv"), "step,ssim\n20,0.2\n40,0.4\n");
        QVERIFY(fs::exists(at("rows") / "samples-000040.png"));
        QCOMPARE(log.valuesOf("l1").back(), 1.0 / 40);
    }

    void resumedRunLeavesTheFolderOfAnUninterruptedOne()
    {
        TrainingLog unbroken(at("unbroken"));
        train(unbroken, 1, 90);
        {
            TrainingLog broken(at("broken"));
            train(broken, 1, 67);  // Killed after the checkpoint of step 50.
        }
        TrainingLog resumed(at("broken"), 50);
        QVERIFY(!fs::exists(at("broken") / "samples-000060.png"));
        QCOMPARE(resumed.valuesOf("l1").size(), std::size_t{50});
        train(resumed, 51, 90);
        QCOMPARE(contents(at("broken")), contents(at("unbroken")));
    }

    void newRunDeletesTheOldFilesAndNothingElse()
    {
        {
            TrainingLog old(at("anew"));
            train(old, 1, 40);
        }
        protocols::writeWholeFile(at("anew") / "notes.txt", "mine");
        const TrainingLog log(at("anew"));
        const auto files = contents(at("anew"));
        QCOMPARE(files.size(), std::size_t{1});
        QVERIFY(files.contains("notes.txt"));
    }

    void lateColumnIsEmptyAbove()
    {
        TrainingLog log(at("late"));
        log.losses(1, std::vector<NamedValue>{{"a", 1}});
        log.losses(2, std::vector<NamedValue>{{"b", INFINITY}, {"a", NAN}});
        QCOMPARE(protocols::readWholeFile(at("late") / "losses.csv"), "step,a,b\n1,1,\n2,,inf\n");
        const TrainingLog again(at("late"), 2);
        QCOMPARE(protocols::readWholeFile(at("late") / "losses.csv"), "step,a,b\n1,1,\n2,,inf\n");
    }

    void malformedTableIsRefusedWithItsLine()
    {
        fs::create_directories(at("spoilt"));
        protocols::writeWholeFile(at("spoilt") / "losses.csv", "step,a\n1,2\n2,two\n");
        try {
            const TrainingLog log(at("spoilt"), 5);
            QFAIL("a spoilt table was read");
        } catch (const protocols::Error& fault) {
            QVERIFY2(QString(fault.what()).contains("losses.csv, row 2 (line 3)"), fault.what());
        }
    }

    void aStepThatOccursTwiceIsRefusedWithItsLine()
    {
        fs::create_directories(at("twice"));
        protocols::writeWholeFile(at("twice") / "losses.csv", "step,a\n1,2\n2,3\n1,4\n");
        const QString refusal = refusalOf([&] { models::readTrainingTable(at("twice") / "losses.csv"); });
        QVERIFY2(refusal.contains("the step 1 occurs twice") && refusal.contains("row 3 (line 4)"), qPrintable(refusal));
    }

    /// A row of commas takes eight times its bytes.
    void aTableThatIsTooLargeIsNotRead()
    {
        fs::create_directories(at("large"));
        const fs::path file = at("large") / "losses.csv";
        protocols::writeWholeFile(file, "step,a\n1,2\n");
        fs::resize_file(file, (std::uintmax_t{1} << 26) + 1);  // Zero bytes that take no place on the disk.
        const QString refusal = refusalOf([&] { models::readTrainingTable(file); });
        QVERIFY2(refusal.contains("at most 67108864 bytes") && refusal.contains("losses.csv"), qPrintable(refusal));
    }

    void curvesAreAPictureOfEveryColumn()
    {
        TrainingLog log(at("curves"));
        for (int step = 1; step <= 3000; step += 2) log.losses(step, lossesAt(step));
        log.validation(3000, std::vector<NamedValue>{{"ssim", 0.4}});
        const std::string svg = protocols::readWholeFile(at("curves") / "curves.svg");
        QXmlStreamReader reader(QByteArray::fromStdString(svg));
        QStringList titles;
        bool saysLogarithmic = false;
        while (!reader.atEnd())
            if (reader.readNext() == QXmlStreamReader::StartElement && reader.name() == QLatin1String("text")) {
                const bool title = reader.attributes().value("font-weight") == QLatin1String("600");
                const QString words = reader.readElementText();
                saysLogarithmic = saysLogarithmic || words.contains("logarithmic");
                if (title) titles << words;
            }
        QVERIFY2(!reader.hasError(), qPrintable(reader.errorString()));
        QCOMPARE(titles, QStringList({"loss: l1", "loss: generator", "validation: ssim"}));
        QVERIFY(saysLogarithmic);  // l1 decreases from 1 to 1/3000.
        QVERIFY(!QString::fromStdString(svg).contains("nan"));
        QVERIFY2(svg.size() < 60000, qPrintable(QString::number(svg.size())));
    }

    void curvesOfNothingAndOfEvenValuesAreDrawn()
    {
        TrainingLog log(at("even"));
        log.losses(1, std::vector<NamedValue>{{"even", 0}, {"none", NAN}});
        log.validation(1, std::vector<NamedValue>{{"one", -3}});
        const QString svg = QString::fromStdString(protocols::readWholeFile(at("even") / "curves.svg"));
        QVERIFY(!svg.contains("nan") && !svg.contains("inf\"") && svg.contains("no finite values"));
    }

    /// A loss that has converged: its last values differ by rounding only. The training must go on after its validation.
    void curvesOfNearlyEvenAndOfHugeValuesAreDrawn_data()
    {
        QTest::addColumn<double>("first");
        QTest::addColumn<double>("second");
        QTest::newRow("one unit of rounding") << 0.3 << std::nextafter(0.3, 1);
        QTest::newRow("the same of a large number") << 1e17 << std::nextafter(1e17, 1e18);
        QTest::newRow("as wide as numbers are") << -1e308 << 1e308;
        QTest::newRow("as small as numbers are") << 0.0 << 5e-324;
        QTest::newRow("600 decades") << 1e-300 << 1e300;
    }
    void curvesOfNearlyEvenAndOfHugeValuesAreDrawn()
    {
        QFETCH(double, first);
        QFETCH(double, second);
        models::TrainingTable table;
        table.put(1, std::vector<NamedValue>{{"a", first}});
        table.put(2, std::vector<NamedValue>{{"a", second}});
        const QString svg = QString::fromStdString(models::curvesSvg(table, {}));
        QVERIFY(!svg.contains("nan") && !svg.contains("inf"));
        QVERIFY2(svg.count("<line") < 15, qPrintable(QString::number(svg.count("<line"))));
    }

    void curvesOfALongTrainingAreDrawnAtOnce()
    {
        models::TrainingTable table;
        for (int step = 1; step <= 200'000; ++step) table.rows[step] = {1.0 / step};
        table.names = {"a"};
        QElapsedTimer clock;
        clock.start();
        models::curvesSvg(table, {});
        QVERIFY2(clock.elapsed() < 5000, qPrintable(QString::number(clock.elapsed())));  // 40,000 steps took as long before
    }

    void samplesShareOneScaleARow()
    {
        const std::vector<SampleRow> rows = samples();
        const cv::Mat sheet = models::samplePicture(7, rows);
        TrainingLog log(at("pictures"));
        log.pictures(7, rows);
        QCOMPARE(cv::norm(readPng(at("pictures") / "samples-000007.png"), sheet, cv::NORM_INF), 0.0);
        const auto brightest = [&](int column) {
            double least = 0, greatest = 0;
            cv::minMaxLoc(sheet({56 + column * 200, 30, 190, 140}).clone().reshape(1), &least, &greatest);
            return greatest;
        };
        QVERIFY(std::abs(brightest(1) - 127) <= 3);  // Half the height of the generated one.
        QVERIFY(brightest(2) > 250);
        QCOMPARE(sheet.at<cv::Vec3b>(100, 100), cv::Vec3b(200, 40, 40));
    }

    void sparklineShowsRiseAndFall()
    {
        QCOMPARE(models::sparkline(std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7}), "▁▂▃▄▅▆▇█");
        QCOMPARE(models::sparkline(std::vector<double>{7, NAN, 0}), "█ ▁");
        QCOMPARE(models::sparkline(std::vector<double>{3, 3}), "▄▄");
        QCOMPARE(models::sparkline({}), "");
        std::vector<double> many(1000);
        for (std::size_t i = 0; i < many.size(); ++i) many[i] = static_cast<double>(i);
        const QString line = QString::fromStdString(models::sparkline(many, 16));
        QVERIFY(line.size() <= 16 && line.startsWith("▁") && line.endsWith("█"));
    }
};

QTEST_GUILESS_MAIN(TrainingLogTest)
#include "training_log_test.moc"
