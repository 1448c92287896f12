// A lab's own conditions: ready images beside those of the program, from the protocol to the report, and folders that do not fit.
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QSet>
#include <QTemporaryDir>
#include <QTest>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "rendering/images/image_io.h"
#include "tests/support/program.h"

using support::mustRun;
using support::runProgram;
using Json = nlohmann::ordered_json;

namespace {

// Ids that mean something elsewhere in the program.
constexpr const char* protocolText =
    R"({"schema": "vis2hap.protocol/1", "name": "own", "participants": 3, "fabrics": ["F01", "F02", "F03", "F04", "F05"],
    "conditions": ["h", {"id": "quality", "images": "lab/stripes"}, {"id": "answers-2", "images": "lab/noise"}],
    "planned": [["quality", "h"], ["quality", "answers-2"]],
    "phases": [{"questions": ["Q1"], "alternatives": 3}, {"questions": ["Q2"], "scale": {"min": 0, "max": 10}}]})";

Json jsonIn(const QString& file)
{
    std::ifstream in(file.toStdString());
    return Json::parse(in);
}

cv::Mat stripes(int period)
{
    cv::Mat image(800, 1280, CV_8UC1);
    for (int x = 0; x < image.cols; ++x) image.col(x) = cv::Scalar(x % period < period / 2 ? 40 : 220);
    return image;
}

cv::Mat noise(int seed)
{
    cv::Mat image(800, 1280, CV_8UC1);
    cv::RNG(seed).fill(image, cv::RNG::UNIFORM, 0, 256);
    return image;
}

}  // namespace

class OwnConditionTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        write("own.json", protocolText);
        mustRun({"fabrics", "make", path("fabrics"), "--fabrics", "6", "--samples", "4", "--seed", "5"});
        for (int number = 1; number <= 5; ++number) {
            writeImage(QString("lab/stripes/F0%1.png").arg(number), stripes(8 * number));
            writeImage(QString("lab/noise/F0%1.png").arg(number), noise(number));
        }
        const auto made = newStudy("study", "own.json");
        QVERIFY2(made.exitCode == 0 && made.err.contains("2 conditions show ready images that this program did not make"),
                 qPrintable(made.err));
        mustRun({"simulate", path("study")});
    }

    void theyAreBlindedLikeTheOthers()
    {
        QSet<qint64> sizes;
        for (const QFileInfo& file : QDir(path("study/stimuli")).entryInfoList(QDir::Files)) sizes.insert(file.size());
        QCOMPARE(sizes.size(), 1);
        mustRun({"report", path("study"), "--out", path("blinded")});
        QCOMPARE(jsonIn(path("blinded/results.json"))["conditions"].dump(), std::string(R"(["K1","K2","K3"])"));
        QFile page(path("blinded/index.html"));
        QVERIFY(page.open(QIODevice::ReadOnly));
        QVERIFY(!page.readAll().contains("answers-2"));
        // The trays of so small a study tell true pieces (README); the conditions must stay hidden.
        const auto leaks = runProgram({"leak-check", path("study")});
        for (const QString& line : leaks.out.split('\n').filter("***")) QVERIFY2(!line.contains(" condition "), qPrintable(line));
        QVERIFY2(leaks.out.contains("learned condition"), qPrintable(leaks.out + leaks.err));
        mustRun({"verify", path("study")});
    }

    void theReportHasThemInTheOrderOfTheProtocol()
    {
        mustRun({"unblind", path("study"), "--who", "tester", "--why", "test"});
        mustRun({"report", path("study"), "--out", path("report")});
        const Json results = jsonIn(path("report/results.json"));
        QCOMPARE(results["conditions"].dump(), std::string(R"(["h","quality","answers-2"])"));
        QCOMPARE(results["claims"][0]["a"].get<std::string>(), std::string("quality"));
        for (const char* id : {"h", "quality", "answers-2"}) QVERIFY(results["questions"]["Q2"][id]["mean"].is_number());
        QVERIFY(QFile::exists(path("report/figures/friction_images.svg")));
        const auto replayed = runProgram({"export", path("study"), "--out", path("scripts"), "--format", "script"});
        QVERIFY2(replayed.exitCode == 0, qPrintable(replayed.err));
    }

    void aStudyOfOwnImagesAloneNeedsNoRecording()
    {
        write("alone.json", QByteArray(protocolText)
                                .replace("\"h\", {", "{")
                                .replace("[\"quality\", \"h\"], ", "")
                                .replace("\"planned\"", "\"familiarisation_fabrics\": 1, \"planned\""));
        const auto made = newStudy("alone", "alone.json");
        QVERIFY2(made.exitCode == 0 && made.err.contains("no image can be made of other fabrics"), qPrintable(made.err));
        mustRun({"simulate", path("alone")});
        mustRun({"unblind", path("alone"), "--who", "tester", "--why", "test"});
        mustRun({"report", path("alone"), "--out", path("alone-report")});
    }

    void imagesThatDoNotFitAreRefusedBeforeAnythingIsMade_data()
    {
        QTest::addColumn<cv::Mat>("image");
        QTest::addColumn<QString>("words");
        QTest::newRow("another size") << cv::Mat(600, 800, CV_8UC1, cv::Scalar(9)) << "800 x 600 pixels";
        QTest::newRow("colour") << cv::Mat(800, 1280, CV_8UC3, cv::Scalar(9, 8, 7)) << "3 channels of 8 bits";
        QTest::newRow("16 bits") << cv::Mat(800, 1280, CV_16UC1, cv::Scalar(9)) << "1 channel of 16 bits";
        QTest::newRow("none") << cv::Mat() << "lacks 1 of 5 images: F03.png";
    }

    void imagesThatDoNotFitAreRefusedBeforeAnythingIsMade()
    {
        QFETCH(cv::Mat, image);
        QFETCH(QString, words);
        QDir(path("lab/bad")).removeRecursively();
        for (const char* fabric : {"F01", "F02", "F04", "F05"}) writeImage(QString("lab/bad/%1.png").arg(fabric), stripes(8));
        if (!image.empty()) writeImage("lab/bad/F03.png", image);
        write("bad.json", QByteArray(protocolText).replace("lab/noise", "lab/bad"));
        const auto made = newStudy("never", "bad.json");
        QCOMPARE(made.exitCode, 2);
        QVERIFY2(made.messages().size() == 1 && made.err.contains(words), qPrintable(made.err));
        QVERIFY(!QDir(path("never")).exists());
    }

    void aFlatImageIsToldBeforeTheStudy()
    {
        writeImage("lab/flat/F01.png", cv::Mat(800, 1280, CV_8UC1, cv::Scalar(128)));
        for (const char* fabric : {"F02", "F03", "F04", "F05"}) writeImage(QString("lab/flat/%1.png").arg(fabric), stripes(8));
        write("flat.json", QByteArray(protocolText).replace("lab/noise", "lab/flat"));
        const auto made = newStudy("flat", "flat.json");
        QCOMPARE(made.exitCode, 0);
        QVERIFY2(made.err.contains("the image of F01 under answers-2 has one level"), qPrintable(made.err));
    }

    /// One folder named twice, by a slip: the study would compare a condition with itself.
    void conditionsWithTheSameImagesAreNamed()
    {
        write("twice.json", QByteArray(protocolText).replace("lab/noise", "lab/stripes"));
        const auto made = newStudy("twice", "twice.json");
        QCOMPARE(made.exitCode, 0);
        QVERIFY2(made.err.contains("conditions answers-2 and quality give the same image for F01, F02, F03, F04, F05"),
                 qPrintable(made.err));
    }

    void idsThatMeanSomethingElseAreRefused_data()
    {
        QTest::addColumn<QByteArray>("id");
        for (const char* id : {"K3", "catch", "h_g", "h_g+f_g", "v_grey@fast", "2nd", "a b", "\u89e6\u611f", "../x", "=1+1"})
            QTest::newRow(id) << QByteArray(id);
    }

    void idsThatMeanSomethingElseAreRefused()
    {
        QFETCH(QByteArray, id);
        write("id.json", QByteArray(protocolText).replace("answers-2", id));
        const auto checked = runProgram({"protocol", "check", path("id.json")});
        QCOMPARE(checked.exitCode, 2);
        QVERIFY2(checked.out.contains(":2:") && checked.out.contains("conditions[2]"), qPrintable(checked.out));
    }

private:
    QString path(const QString& name) const { return m_folder.filePath(name); }

    void write(const QString& name, const QByteArray& text) const
    {
        std::ofstream(path(name).toStdString()) << text.toStdString();
    }

    void writeImage(const QString& name, const cv::Mat& image) const
    {
        QDir().mkpath(QFileInfo(path(name)).path());
        rendering::writePng(path(name).toStdString(), image);
    }

    support::ProgramResult newStudy(const QString& study, const QString& protocol) const
    {
        return runProgram({"study", "new", path(study), "--dataset", path("fabrics"), "--protocol", path(protocol), "--seed", "1",
                           "--no-passphrase"});
    }

    QTemporaryDir m_folder;
};

QTEST_GUILESS_MAIN(OwnConditionTest)
#include "own_condition_test.moc"
