// vis2hap evaluate with the shipped weights, run from the command line.
#include <QDir>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <nlohmann/json.hpp>

#include "tests/support/program.h"

using nlohmann::json;

class EvaluateCommandTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        m_data = m_folder.filePath("cloths");
        support::mustRun({"fabrics", "make", m_data, "--fabrics", "3", "--samples", "12", "--seed", "77"});
    }

    void tablesArePrintedAndWritten()
    {
        const QString file = m_folder.filePath("evaluation.json");
        const auto ended = support::mustRun({"evaluate", m_data, "--split", "location", "--quality", "fast", "--json", file});
        for (const char* wanted : {"Friction (by location, weak pairs)", "nearest photograph", "fabric, another place",
                                   "noise floor", "Criteria for the generated signals"})
            QVERIFY2(ended.out.contains(wanted), wanted);
        QFile written(file);
        QVERIFY(written.open(QIODevice::ReadOnly));
        const auto read = json::parse(written.readAll().toStdString());
        QCOMPARE(read["schema"].get<std::string>(), std::string("vis2hap.evaluation/1"));
        QCOMPARE(read["pairs"].get<int>(), 3);
        const auto& generated = read["speakers"][0];
        QVERIFY(generated["friction_mae_over_mean"].get<double>() > 0 && generated["friction_mae_over_mean"].get<double>() < 1);
        QVERIFY(generated["ssim"].get<double>() > -1 && generated["ssim"].get<double>() < 1);
        QVERIFY(generated["sq_ratio"].get<double>() > 0.05);
        QCOMPARE(generated["fabrics"].size(), std::size_t(3));
        QCOMPARE(read["leaks"]["left_out_trained_on"]["visual"].get<int>(), 0);
    }

    void jsonAloneGoesToStandardOutputAndRepeats()
    {
        const QStringList call{"evaluate", m_data, "--samples", "1", "--quality", "fast", "--json"};
        const auto once = support::mustRun(call);
        QCOMPARE(json::parse(once.out.toStdString())["split"]["by"].get<std::string>(), std::string("sample"));
        QCOMPARE(support::mustRun(call).out, once.out);
    }

    void fibresOfTheDataSetAreToldUnlessTheyAreLeftOut()
    {
        const QString drawn = m_folder.filePath("drawn");
        support::mustRun({"fabrics", "make", drawn, "--drawn", "3", "--samples", "3", "--seed", "5"});
        QStringList call{"evaluate", drawn, "--samples", "1", "--quality", "fast", "--json"};
        const auto told = json::parse(support::mustRun(call).out.toStdString());
        call.insert(1, "--fibre-untold");
        const auto untold = json::parse(support::mustRun(call).out.toStdString());
        QVERIFY(told["notes"].dump().find("told the fibre of 3 of 3 fabrics") != std::string::npos);
        QVERIFY(untold["notes"].dump().find("fibre") == std::string::npos);
        QVERIFY(untold["notes"].dump().find("trained on") == std::string::npos);
        QVERIFY(told["speakers"][0]["mean_friction"] != untold["speakers"][0]["mean_friction"]);
        QCOMPARE(told["speakers"][0]["sq_mm"].get<double>(), untold["speakers"][0]["sq_mm"].get<double>());
    }

    void aDataSetOfTheFabricsOfTheTrainingIsNamed()
    {
        const QString known = m_folder.filePath("known");
        const QString note = "vis2hap was trained on fabrics that seed 31 draws";
        const auto made = support::mustRun({"fabrics", "make", known, "--drawn", "3", "--samples", "3", "--seed", "31"});
        QVERIFY2(made.out.contains("\nnote: " + note), qPrintable(made.out));
        const QStringList call{"evaluate", known, "--samples", "1", "--quality", "fast"};
        const auto text = support::mustRun(call).out;
        QVERIFY2(text.contains("MEMORY: " + note) && text.contains("note: " + note), qPrintable(text));
        const auto read = json::parse(support::mustRun(call + QStringList{"--json"}).out.toStdString());
        QVERIFY(read["notes"].dump().find(note.toStdString()) != std::string::npos);
        const auto other = support::mustRun({"fabrics", "make", m_folder.filePath("other"), "--drawn", "1", "--seed", "32"});
        QVERIFY(!other.out.contains("note:"));
    }

    void badCallsAreRefusedInOneLine_data()
    {
        QTest::addColumn<QStringList>("arguments");
        QTest::addColumn<QString>("named");
        const auto row = [](const char* name, const QStringList& arguments, const char* named) {
            QTest::newRow(name) << arguments << named;
        };
        row("no data set", {"evaluate", "/nowhere"}, "/nowhere");
        row("no such split", {"evaluate", "DATA", "--split", "person"}, "person");
        row("no samples", {"evaluate", "DATA", "--samples", "0"}, "samples");
        row("bounds that are none", {"evaluate", "DATA", "--bounds", "nan"}, "bounds");
        row("no such model", {"evaluate", "DATA", "--model", "/nowhere.safetensors"}, "/nowhere.safetensors");
        row("no such rival", {"evaluate", "DATA", "--against", "/rival.safetensors"}, "/rival.safetensors");
        row("nothing held out", {"evaluate", "DATA", "--split", "fabric"}, "--hold-out");
    }

    void badCallsAreRefusedInOneLine()
    {
        QFETCH(QStringList, arguments);
        QFETCH(QString, named);
        arguments.replaceInStrings("DATA", m_data);
        const auto ended = support::runProgram(arguments);
        QCOMPARE(ended.exitCode, 2);
        QVERIFY2(ended.err.contains(named), qPrintable(ended.err));
        QVERIFY(ended.out.isEmpty());
    }

    void photographsAreNeeded()
    {
        const QString data = m_folder.filePath("touch only");
        support::mustRun({"fabrics", "make", data, "--fabrics", "1", "--samples", "3", "--seed", "1"});
        QVERIFY(QDir(data + "/F01/visual").removeRecursively());
        const auto ended = support::runProgram({"evaluate", data});
        QCOMPARE(ended.exitCode, 2);
        QVERIFY2(ended.err.contains("has no photographs"), qPrintable(ended.err));
    }

private:
    QTemporaryDir m_folder;
    QString m_data;
};

QTEST_GUILESS_MAIN(EvaluateCommandTest)
#include "evaluate_command_test.moc"
