// Friction images and friction records through the program, as users run it: both scales, a saved range, strokes from a file,
// and a whole study with a condition that is not one of the paper's nine.
#include <QDir>
#include <QFile>
#include <QImage>
#include <QProcess>
#include <QTemporaryDir>
#include <QTest>
#include <fstream>
#include <nlohmann/json.hpp>

#include "protocols/files/place_lock.h"
#include "tests/rendering/stroke_text.h"
#include "tests/support/program.h"

using support::mustRun;
using support::runProgram;

namespace {

nlohmann::ordered_json readJson(const QString& file)
{
    std::ifstream in(file.toStdString());
    return nlohmann::ordered_json::parse(in);
}

void writeText(const QString& file, const std::string& text) { std::ofstream(file.toStdString()) << text; }

}  // namespace

class FrictionImageCommandTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase()
    {
        m_fabrics = path("fabrics");
        mustRun({"fabrics", "make", m_fabrics, "--fabrics", "4", "--samples", "2", "--seed", "5"});
    }

    void whatIsLostIsPrintedAndSaved()
    {
        const auto ended =
            mustRun({"render", m_fabrics, "--condition", "v_grey,f,h", "--out", path("mm"), "--scale", "physical"});
        for (const char* part : {"F01: ", "F04: ", "tile, ", "of its variance lost", "traces run along x"})
            QVERIFY2(ended.out.contains(part), qPrintable(ended.out));
        const auto condition = readJson(path("mm/render.json"))["conditions"]["h"];
        QCOMPARE(condition["mapping"]["scale"].get<std::string>(), std::string("physical"));
        QCOMPARE(condition["extension"]["F02"].get<std::string>(), std::string("tile"));
        QCOMPARE(condition["stroke_axis"].get<std::string>(), std::string("x"));
        const double lost = condition["variance_lost"]["F02"];
        QVERIFY(lost > 0 && lost < 0.9);
    }

    void allConditionsAreTheNineOfThePaper()
    {
        mustRun({"render", m_fabrics, "--fabric", "F01", "--condition", "v_grey,gradient", "--out", path("ten")});
        QVERIFY(QFile::exists(path("ten/F01/gradient.png")));
        const auto told =
            mustRun({"render", m_fabrics, "--fabric", "F01", "--condition", "gradient", "--explain", "--out", path("ten")});
        QVERIFY(told.out.contains("gradient of the height") && told.out.contains("no libtorch"));
        const auto refused = runProgram({"render", m_fabrics, "--condition", "gradients", "--out", path("ten")});
        QCOMPARE(refused.exitCode, 2);
        QVERIFY(refused.err.contains("h&f, gradient"));
    }

    void aSecondRenderSaysWhatItChanges()
    {
        mustRun({"render", m_fabrics, "--condition", "f", "--out", path("twice")});
        const auto same = mustRun({"render", m_fabrics, "--fabric", "F01", "--condition", "f", "--out", path("twice")});
        QVERIFY2(!same.err.contains("warning"), qPrintable(same.err));
        const auto other = mustRun(
            {"render", m_fabrics, "--fabric", "F01", "--condition", "f", "--out", path("twice"), "--range-percentiles", "1,99"});
        QVERIFY2(other.err.contains("warning") && other.err.contains("images of F02, F03, F04"), qPrintable(other.err));
        QCOMPARE(readJson(path("twice/render.json"))["conditions"]["f"]["mapped_otherwise"].size(), std::size_t(3));
        for (const char* wrong : {"5", "99,1", "a,b", "0,200"}) {
            const auto refused =
                runProgram({"render", m_fabrics, "--condition", "f", "--out", path("never"), "--range-percentiles", wrong});
            QCOMPARE(refused.exitCode, 2);
        }
        QVERIFY(!QFile::exists(path("never/render.json")));
    }

    /// Each call writes render.json whole: what another one wrote in between would vanish.
    void aRenderWaitsForAnotherOneIntoTheSameFolder()
    {
        mustRun({"render", m_fabrics, "--condition", "f", "--out", path("shared")});
        QProcess second;
        {
            const protocols::PlaceLock lock(path("shared").toStdString());
            second.start(VIS2HAP_PROGRAM, {"render", m_fabrics, "--condition", "v_grey", "--out", path("shared")});
            QVERIFY(!second.waitForFinished(3000));
            QVERIFY(!readJson(path("shared/render.json"))["conditions"].contains("v_grey"));
        }
        QVERIFY(second.waitForFinished(60000) && second.exitCode() == 0);
        for (const char* condition : {"f", "v_grey"})
            QVERIFY(readJson(path("shared/render.json"))["conditions"].contains(condition));
    }

    void sixteenBitsAndDitheringAreOptions()
    {
        mustRun({"render", m_fabrics, "--fabric", "F01", "--condition", "h", "--out", path("deep"), "--bits", "16"});
        QCOMPARE(QImage(path("deep/F01/h.png")).format(), QImage::Format_Grayscale16);
        for (const char* name : {"a", "b"})
            mustRun({"render", m_fabrics, "--fabric", "F01", "--condition", "h", "--out", path(name), "--dither"});
        const QImage first(path("a/F01/h.png"));
        QCOMPARE(first.format(), QImage::Format_Grayscale8);
        QCOMPARE(first, QImage(path("b/F01/h.png")));
    }

    /// A condition is one row of a table: a tenth one needs no other change from protocol to report.
    void aTenthConditionGoesThroughAWholeStudy()
    {
        writeText(path("protocol.json"), R"({"schema":"vis2hap.protocol/1","name":"ten","participants":2,"fabrics":3,
            "conditions":["h","gradient"],"phases":[{"questions":["Q1"],"alternatives":3},
            {"questions":["Q2"],"scale":{"min":0,"max":10,"step":0.1,"sections":9}}],
            "planned":[["gradient","h"]],"familiarisation_fabrics":0})");
        const QString study = path("study");
        mustRun({"study", "new", "--no-passphrase", study, "--dataset", m_fabrics, "--protocol", path("protocol.json"), "--seed",
                 "3", "--key-seed", "4"});
        QVERIFY(readJson(study + "/allocation-key.json").dump().find("gradient") != std::string::npos);
        mustRun({"simulate", study, "--dataset", m_fabrics});
        mustRun({"verify", study});
        mustRun({"unblind", study, "--who", "nobody", "--why", "the test ends"});
        mustRun({"report", study, "--out", path("report")});
        const auto results = readJson(path("report/results.json"));
        QCOMPARE(results["conditions"], nlohmann::ordered_json({"h", "gradient"}));
        QCOMPARE(results["questions"]["Q1"]["gradient"]["trials"].get<int>(), 6);
        QVERIFY(results["questions"]["Q2"]["gradient"]["mean"].is_number());
        QVERIFY(results["comparisons"][0].value("planned", false));
    }

    void aStrokeIsImportedWithItsPicture()
    {
        writeText(path("Felt_1.csv"), stroke_text::twoForces({}, "t_s,fz,fx"));
        const auto ended = mustRun({"import", "friction-csv", path("Felt_1.csv"), "--out", path("set"), "--plots", path("plots"),
                                    "--normal=fz", "--tangential=fx", "--rate", "100"});
        QVERIFY2(ended.out.contains("breakaway") && ended.out.contains("unloaded samples") && ended.out.contains("100 Hz"),
                 qPrintable(ended.out));
        for (const char* file : {"set/F01/friction/000.csv", "set/F01/friction/000.json", "plots/F01-000.svg",
                                 "plots/F01-000.spectrogram.json", "plots/F01-000.spectrogram.npy"})
            QVERIFY2(QFile::exists(path(file)), file);
        QVERIFY(std::abs(readJson(path("plots/F01-000.spectrogram.json"))["mean"].get<double>() - 0.5) < 0.002);
        QCOMPARE(mustRun({"fabrics", "check", path("set")}).exitCode, 0);
        mustRun({"render", path("set"), "--condition", "f", "--out", path("felt"), "--scale", "physical"});
        for (const auto& wrong : {QStringList{"--zero", "9"}, QStringList{"--trim", "3,2"}, QStringList{"--force-unit", "stone"},
                                  QStringList{"--normal", "fq"}, QStringList{"--rate", "0"}}) {
            const auto refused =
                runProgram(QStringList{"import", "friction-csv", path("Felt_1.csv"), "--out", path("no")} + wrong);
            QCOMPARE(refused.exitCode, 2);
            QVERIFY(!QFile::exists(path("no")));
        }
    }

    /// Rendered, its relief would be upside down.
    void aStrokeAgainstItsAxisIsImportedWithAWarningAndNeverRendered()
    {
        writeText(path("Back_1.csv"), stroke_text::twoForces({}, "t_s,fz,fx"));
        const QStringList call{"import", "friction-csv", path("Back_1.csv"), "--normal=fz"};
        const auto ended = mustRun(call + QStringList{"--tangential=-fx", "--out", path("back"), "--plots", path("seen")});
        QVERIFY2(ended.out.contains("the tangential axis points against the stroke"), qPrintable(ended.out));
        QVERIFY(QFile::exists(path("seen/F01-000.svg")));
        const auto checked = runProgram({"fabrics", "check", path("back")});
        const auto rendered = runProgram({"render", path("back"), "--condition", "f", "--out", path("felt back")});
        QVERIFY2(checked.exitCode == 1 && checked.out.contains("points against the stroke"), qPrintable(checked.out));
        QVERIFY2(rendered.exitCode == 2 && rendered.err.contains("F01/friction/000.csv"), qPrintable(rendered.err));
        QVERIFY2(rendered.err.contains("--tangential=-NAME"), qPrintable(rendered.err));
        QVERIFY(!QFile::exists(path("felt back/F01/f.png")));
    }

private:
    QString path(const QString& name) const { return m_folder.filePath(name); }

    QTemporaryDir m_folder;
    QString m_fabrics;
};

QTEST_GUILESS_MAIN(FrictionImageCommandTest)
#include "friction_image_command_test.moc"
