// The response of a display through the program: from a laboratory's table to a study that states it, and every refusal.
#include <QFile>
#include <QImage>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "protocols/files/sha256.h"
#include "tests/support/program.h"

using support::mustRun;
using support::runProgram;
using Json = nlohmann::ordered_json;

namespace {

Json readJsonFile(const QString& file)
{
    std::ifstream in(file.toStdString());
    return Json::parse(in);
}

/// Friction that grows with the square of the level, up and down, as a German spreadsheet writes it.
QByteArray germanTable()
{
    QByteArray text = "Grauwert;mu\n";
    const auto row = [&](int level) {
        text += QByteArray::number(level) + ";" +
                QByteArray::number(0.2 + 0.4 * level * level / 65025.0, 'f', 5).replace('.', ',') + "\n";
    };
    for (int level = 0; level <= 255; level += 15) row(level);
    for (int level = 255; level >= 0; level -= 15) row(level);
    return text;
}

}  // namespace

class DisplayResponseCommandTest : public QObject {
    Q_OBJECT
    QTemporaryDir m_folder;

    QString path(const QString& name) const { return m_folder.filePath(name); }
    QString textOf(const QString& name) const
    {
        QFile file(path(name));
        return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
    }
    void write(const QString& name, const QByteArray& text) const
    {
        QFile file(path(name));
        QVERIFY(file.open(QIODevice::WriteOnly) && file.write(text) == text.size());
    }
    QStringList calibration(const QStringList& more) const
    {
        return QStringList{"display",
                           "calibrate",
                           path("glass.csv"),
                           "--map",
                           "level=Grauwert",
                           "--display",
                           "small driver in C++",
                           "--load",
                           "0.5",
                           "--speed",
                           "20",
                           "--finger",
                           "index finger, dry",
                           "--date",
                           "2026-05-04"} +
               more;
    }

private Q_SLOTS:
    void initTestCase()
    {
        write("glass.csv", germanTable());
        mustRun({"fabrics", "make", path("fabrics"), "--fabrics", "4", "--samples", "2", "--seed", "5"});
        write("protocol.json",
              R"({"schema":"vis2hap.protocol/1","name":"glass","participants":2,"fabrics":3,"conditions":["h","v_grey"],
            "phases":[{"questions":["Q2"],"scale":{"min":0,"max":10,"step":0.1,"sections":9}}],"familiarisation_fabrics":1})");
        const auto made = mustRun(calibration({"--out", path("response.json"), "--picture", path("response.svg")}));
        QVERIFY2(made.err.contains("is read as semicolons, decimal commas"), qPrintable(made.err));
        for (const char* part : {"friction from 0.2000 to 0.6000, a factor of 3.00", "rising and falling levels differ by 0.0000",
                                 "measured on 2026-05-04 on small driver in C++ at 0.5 N and 20 mm/s with index finger, dry"})
            QVERIFY2(made.out.contains(part), qPrintable(made.out));
        QFile picture(path("response.svg"));
        QVERIFY(picture.open(QIODevice::ReadOnly) && picture.readAll().contains("</svg>"));
    }

    /// Levels are the square root of what they were without the response.
    void renderMapsThroughTheResponse()
    {
        mustRun({"render", path("fabrics"), "--condition", "v_grey", "--out", path("linear")});
        mustRun(
            {"render", path("fabrics"), "--condition", "v_grey", "--out", path("mapped"), "--response", path("response.json")});
        const QImage linear(path("linear/F01/v_grey.png")), mapped(path("mapped/F01/v_grey.png"));
        double worst = 0;
        for (int y = 0; y < linear.height(); y += 7)
            for (int x = 0; x < linear.width(); x += 7) {
                const double level = qGray(linear.pixel(x, y));
                if (level > 20) worst = std::max(worst, std::abs(qGray(mapped.pixel(x, y)) - 255 * std::sqrt(level / 255)));
            }
        QVERIFY2(worst < 2.5, qPrintable(QString::number(worst)));
        const auto condition = readJsonFile(path("mapped/render.json"))["conditions"]["v_grey"];
        QCOMPARE(condition["mapping"]["response"]["sha256"], readJsonFile(path("response.json"))["sha256"]);
        QVERIFY(condition["out_of_reach"]["F01"].is_number());
        QVERIFY(!readJsonFile(path("linear/render.json"))["conditions"]["v_grey"]["mapping"].contains("response"));
        const auto again =
            mustRun({"render", path("fabrics"), "--fabric", "F02", "--condition", "v_grey", "--out", path("mapped")});
        QVERIFY2(again.err.contains("the mapping was"), qPrintable(again.err));
    }

    void aStudyKeepsAndStatesIt()
    {
        const QStringList common{"--dataset",       path("fabrics"), "--protocol", path("protocol.json"),
                                 "--no-passphrase", "--key-seed",    "4"};
        const auto made = mustRun(
            QStringList{"study", "new", path("study"), "--response", path("response.json"), "--images", path("kept")} + common);
        const QString sentence =
            "Friction of the display's glass was measured on 2026-05-04 on small driver in C++ at 0.5 N and 20 mm/s "
            "with index finger, dry";
        QVERIFY2(made.out.contains(sentence), qPrintable(made.out));
        mustRun({"simulate", path("study")});
        QVERIFY(mustRun({"verify", path("study")}).exitCode == 0);
        QVERIFY(mustRun({"study", "data-sheet", path("study")}).out.simplified().contains(sentence));
        mustRun({"unblind", path("study"), "--who", "nobody", "--why", "the test ends"});
        mustRun({"report", path("study"), "--out", path("report"), "--page-only"});
        const auto results = readJsonFile(path("report/results.json"));
        QCOMPARE(results["study"]["made_with"]["display_response"], readJsonFile(path("response.json")));
        QFile page(path("report/index.html"));
        QVERIFY(page.open(QIODevice::ReadOnly) && page.readAll().contains("The images are mapped through this response."));
        mustRun({"export", path("study"), "--format", "json", "--out", path("study-json")});
        const auto stamps = readJsonFile(path("study-json/export.json"))["stamps"];
        QVERIFY2(stamps.back().get<std::string>().starts_with(sentence.toStdString()), stamps.dump(1).c_str());
        mustRun({"export", path("study"), "--format", "psych-ds", "--out", path("study-set")});
        QVERIFY(textOf("study-set/README.md").contains(sentence) &&
                textOf("study-set/dataset_description.json").contains(sentence));
        // Published data name neither the day nor the finger.
        mustRun({"export", path("study"), "--format", "psych-ds", "--public", "--out", path("study-open")});
        for (const char* file : {"study-open/README.md", "study-open/dataset_description.json"}) {
            const QString text = textOf(file);
            QVERIFY2(text.contains("Friction of the display's glass was measured. The images are mapped"), qPrintable(text));
            QVERIFY2(!text.contains("2026-05-04") && !text.contains("index finger"), qPrintable(text));
        }
        // Images that were kept with a response are no images of a study without one.
        const auto without = mustRun(QStringList{"study", "new", path("plain"), "--images", path("kept")} + common);
        QVERIFY2(!without.out.contains("friction images reused"), qPrintable(without.out));
        QVERIFY(without.out.contains("The response of the display was not measured"));
        QVERIFY(mustRun({"study", "data-sheet", path("plain")}).out.contains("The response of the display was not measured"));
        mustRun({"export", path("plain"), "--format", "json", "--out", path("plain-json")});
        QCOMPARE(readJsonFile(path("plain-json/export.json"))["stamps"].back().get<std::string>(),
                 std::string("The response of the display was not measured: grey levels stand for friction."));
    }

    void aStepSaysWhatItCannotReach()
    {
        QByteArray step = "level,mu\n";
        for (int level = 0; level <= 255; level += 1) step += QByteArray::number(level) + (level < 128 ? ",0.3\n" : ",0.6\n");
        write("step.csv", step);
        mustRun({"display", "calibrate", path("step.csv"), "--out", path("step.json"), "--display", "d", "--load", "0.5",
                 "--speed", "20", "--finger", "tip"});
        const auto made = mustRun({"study", "new", path("stepped"), "--dataset", path("fabrics"), "--protocol",
                                   path("protocol.json"), "--no-passphrase", "--response", path("step.json")});
        QVERIFY2(made.err.contains("h: no level of the display gives the friction of some pixels: F0"), qPrintable(made.err));
        QVERIFY(made.err.contains("v_grey: no level of the display"));
    }

    void theCheckKnowsAnotherDisplay()
    {
        const QString driver = QStringLiteral("exec:" VIS2HAP_REFERENCE_DISPLAY " '%1'").arg(path("felt"));
        const auto other = runProgram({"display", "check", driver, "--response", path("response.json")});
        QCOMPARE(other.exitCode, 1);
        QVERIFY2(other.out.contains(
                     "FAIL  its response was measured on this display: it was measured on \"small driver in C++\", and this is "
                     "\"reference display\""),
                 qPrintable(other.out));
        mustRun(calibration({"--out", path("mine.json"), "--display", "reference display"}).mid(0, 5) +
                QStringList{"--display", "reference display", "--load", "0.5", "--speed", "20", "--finger", "tip", "--out",
                            path("mine.json")});
        QVERIFY(mustRun({"display", "check", driver, "--response", path("mine.json")})
                    .out.contains("pass  its response was measured"));
    }

    void refusalsLeaveNothing_data()
    {
        QTest::addColumn<QStringList>("more");
        QTest::addColumn<QString>("told");
        QTest::newRow("date") << QStringList{"--date", "4.5.2026"} << "YYYY-MM-DD";
        QTest::newRow("speed") << QStringList{"--speed", "-3"} << "above 0";
        QTest::newRow("column") << QStringList{"--map", "friction=Reibung"} << "no column \"Reibung\"";
        QTest::newRow("meaning") << QStringList{"--map", "volt=mu"} << "is no meaning of a column";
        QTest::newRow("picture") << QStringList{"--picture", "/nowhere/response.svg"} << "/nowhere";
    }
    void refusalsLeaveNothing()
    {
        QFETCH(QStringList, more);
        QFETCH(QString, told);
        QStringList call = calibration({"--out", path("never.json")});
        if (const auto at = call.indexOf(more.first()); at > 0 && more.first() != "--map") call.remove(at, 2);
        const auto refused = runProgram(call + more);
        QVERIFY2((refused.exitCode == 2 || refused.exitCode == 3) && refused.err.contains(told) && refused.messages().size() == 1,
                 qPrintable(refused.err));
        QVERIFY(!QFile::exists(path("never.json")));
    }

    void aFileThatIsNoResponseIsRefused()
    {
        for (const QString& file : {path("protocol.json"), path("glass.csv"), path("missing.json")}) {
            const auto refused = runProgram({"study", "new", path("never"), "--dataset", path("fabrics"), "--protocol",
                                             path("protocol.json"), "--no-passphrase", "--response", file});
            QCOMPARE(refused.exitCode, 2);
            QVERIFY2(refused.messages().size() == 1 && refused.err.contains(file), qPrintable(refused.err));
            QVERIFY(!QFile::exists(path("never")));
        }
        const auto deep =
            runProgram({"render", path("fabrics"), "--out", path("never"), "--bits", "16", "--response", path("response.json")});
        QCOMPARE(deep.exitCode, 2);
        QVERIFY2(deep.err.contains("256 levels"), qPrintable(deep.err));
    }
};

QTEST_GUILESS_MAIN(DisplayResponseCommandTest)
#include "display_response_command_test.moc"
