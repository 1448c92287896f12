// Columns, rows and units of friction recordings: what each name and unit means, and what is refused with its line, so that no
// row is lost and no data set becomes unreadable.
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "rendering/fabrics/dataset_check.h"
#include "rendering/fabrics/recordings/import.h"
#include "rendering/fabrics/recordings/import_stage.h"
#include "rendering/signals/friction_trace.h"
#include "tests/rendering/fabric_files.h"

using namespace fabric_files;
using namespace rendering;
using namespace rendering::fabrics;

namespace {

/// A file of LabVIEW with a step of 0.5 s; `rows` begins in line 6.
std::string labviewFile(const std::string& rows)
{
    const std::string header = "LabVIEW Measurement\t\r\nChannels\t3\r\nDelta_X\t0.5\r\n***End_of_Header***\r\n";
    return header + "X_Value\tfx_N\tfy_N\tfz_N\tComment\r\n" + rows;
}

/// A file of a tribometer whose pin load is in mN; `rows` begins in line 3.
std::string tribometerFile(const std::string& rows)
{
    const std::string columns = "Step Time (s)\tTraction Coeff (-)\tPin Load (mN)\tTraction Force (N)\tSliding Speed (mm/s)";
    return "MTM311 Test Data File\r\n" + columns + "\r\n" + rows;
}

}  // namespace

class RecordingTablesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void init()
    {
        m_folder = std::make_unique<QTemporaryDir>();
        m_out = pathOf(*m_folder) / "set";
        m_options = {};
    }

    /// Such a record once made dataset.json unreadable, and with it all earlier recordings.
    void aRecordThatNoDatasetCanDescribeChangesNothing_data()
    {
        QTest::addColumn<QString>("kind");
        QTest::addColumn<QString>("file");
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("said");
        QTest::newRow("nanoseconds without a unit")
            << "friction-csv"
            << "Z_1.csv"
            << "timestamp,mu\n1700000000000000000,0.3\n1700000000010000000,0.3\n1700000000020000000,0.31\n"
            << "1e-07 Hz; expected 0.001 to 10,000,000 Hz; state the unit of time in the column's name";
        QTest::newRow("seconds called microseconds") << "friction-csv"
                                                     << "Z_1.csv"
                                                     << "time_us,mu\n0,0.3\n1e-4,0.3\n2e-4,0.31\n"
                                                     << "correct the time stamps or their unit";
        QTest::newRow("speed in a file name") << "slide"
                                              << "Z_F1_V-1e300mmps_0.csv"
                                              << "timestamp,channel1\n0,10\n28,11\n56,12\n"
                                              << "the speed is 1e+300 mm/s";
        QTest::newRow("stroke without length")
            << "tribometer"
            << "Z_1.txt" << QString::fromStdString(tribometerFile("0.0001\t0.2\t\t\t0.001\r\n0.0002\t0.2\t\t\t0.001\r\n"))
            << "the stroke is 2e-07 mm long";
    }
    void aRecordThatNoDatasetCanDescribeChangesNothing()
    {
        QFETCH(const QString, kind);
        QFETCH(const QString, file);
        QFETCH(const QString, text);
        QFETCH(const QString, said);
        const fs::path photograph = pathOf(*m_folder) / "Wool_1.png";
        writePng(photograph, speckled(20, 24, CV_8UC3));
        importRecordings({ImportKind::Photos, {photograph}, m_out, {}, {}});
        const auto before = contentOf(m_out);
        const std::string refusal =
            refusalOf([&] { importedAs(importKindNamed(kind.toStdString()), file.toStdString(), text.toStdString()); });
        QVERIFY2(contains(refusal, said.toStdString()) && contains(refusal, file.toStdString()), refusal.c_str());
        QVERIFY(contentOf(m_out) == before);
        QCOMPARE(readDataset(m_out).fabrics.size(), std::size_t(1));
    }

    void aDescriptionThatCannotBeReadAgainIsNotWritten()
    {
        valuesOf(ImportKind::FrictionCsv, "Z_1.csv", "t,mu\n0,0.3\n0.1,0.3\n");
        const auto before = contentOf(m_out);
        const std::string refusal = refusalOf([&] {
            ImportStage stage(m_out);
            stage.dataset().friction.sampleRateHz = 0;
            stage.commit();
        });
        QVERIFY2(contains(refusal, "sample_rate_hz") && contains(refusal, "the data set was not changed"), refusal.c_str());
        QVERIFY(contentOf(m_out) == before);
    }

    void nanosecondsAreReadWhereTheColumnSaysSo()
    {
        valuesOf(ImportKind::FrictionCsv, "Z_1.csv", "timestamp_ns,mu\n0,0.3\n10000000,0.3\n20000000,0.31\n");
        QCOMPARE(readDataset(m_out).friction.sampleRateHz, 100.0);
    }

    /// Rows below such a line once got lost without a word.
    void aLineThatInterruptsATableIsNamed_data()
    {
        QTest::addColumn<QString>("kind");
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("said");
        const auto labview = [](const char* rows) { return QString::fromStdString(labviewFile(rows)); };
        QTest::newRow("row without a stamp")
            << "labview" << labview("0\t3\t4\t-10\r\n.5\t3\t4\t-10\r\n\t3\t4\t-10\r\n1\t3\t4\t-10\r\n")
            << "line 8, column X_Value: a number is missing";
        QTest::newRow("rows after a blank line")
            << "labview" << labview("0\t3\t4\t-10\r\n.5\t3\t4\t-10\r\n\t\r\n1\t3\t4\t-10\r\n")
            << "line 9: a row of numbers stands after the end of its table";
        QTest::newRow("one stamp twice") << "labview" << labview("0\t3\t4\t-10\r\n0\t3\t4\t-10\r\n.5\t3\t4\t-10\r\n")
                                         << "row 2: the time goes from 0 s to 0 s";
        QTest::newRow("word of the operator")
            << "tribometer" << QString::fromStdString(tribometerFile("1\t.2\r\n2\t.2\r\nPaused by operator\r\n3\t.2\r\n"))
            << "line 6: a row of numbers stands after the end of its table";
    }
    void aLineThatInterruptsATableIsNamed()
    {
        QFETCH(const QString, kind);
        QFETCH(const QString, text);
        QFETCH(const QString, said);
        const std::string refusal =
            refusalOf([&] { importedAs(importKindNamed(kind.toStdString()), "Z_1.txt", text.toStdString()); });
        QVERIFY2(contains(refusal, said.toStdString()), refusal.c_str());
        QVERIFY(!fs::exists(m_out));
    }

    void stampsThatAreAllEqualGiveWayToTheStepOfTheHeader()
    {
        valuesOf(ImportKind::Labview, "Z_1.lvm", labviewFile("0\t3\t4\t-10\r\n0\t3\t4\t-10\r\n0\t3\t4\t-10\r\n"));
        QCOMPARE(readDataset(m_out).friction.sampleRateHz, 2.0);
    }

    void stampsOfFewDecimalsGiveWayToTheStepOfTheHeader()
    {
        valuesOf(ImportKind::Labview, "Z_1.lvm",
                 labviewFile("0\t3\t4\t-10\r\n0\t3\t4\t-10\r\n1\t3\t4\t-10\r\n1\t3\t4\t-10\r\n2\t3\t4\t-10\r\n"));
        QCOMPARE(readDataset(m_out).friction.sampleRateHz, 2.0);
    }

    /// Windows editors write the mark of UTF-8, and LabVIEW separates by commas where its user asks for that.
    void labviewFilesWithAMarkOrCommasAreRead()
    {
        const std::string rows = "0\t3\t4\t-10\r\n0.5\t3\t4\t-10\r\n1\t6\t8\t-10\r\n";
        const std::vector<double> expected{0.5, 0.5, 1};
        QCOMPARE(valuesOf(ImportKind::Labview, "Z_1.lvm", labviewFile(rows)), expected);
        QCOMPARE(valuesOf(ImportKind::Labview, "Z_1.lvm", "\xEF\xBB\xBF" + labviewFile(rows)), expected);
        const auto withCommas = [&](const std::string& decimal) {
            std::string text = labviewFile(rows + "\t\t\t\r\n");
            text.insert(text.find("Channels"), "Separator\tComma\r\nDecimal_Separator\t" + decimal + "\r\n");
            std::replace(text.begin(), text.end(), '\t', ',');
            return text;
        };
        QCOMPARE(valuesOf(ImportKind::Labview, "Z_1.lvm", withCommas(".")), expected);
        QVERIFY(contains(refusalOf([&] { importedAs(ImportKind::Labview, "Z_1.lvm", withCommas(",")); }),
                         "commas between its cells and in its numbers"));
    }

    void aNameAfterAMarkIsUtf8()
    {
        m_options.tangential = {ForceAxis{"f\xC3\xA4"}};
        std::string text = labviewFile("0\t3\t4\t-10\r\n0.5\t3\t4\t-10\r\n1\t6\t8\t-10\r\n");
        text.replace(text.find("fx_N"), 4, "f\xC3\xA4_N");
        QCOMPARE(valuesOf(ImportKind::Labview, "Z_1.lvm", "\xEF\xBB\xBF" + text), (std::vector<double>{0.3, 0.3, 0.6}));
    }

    /// Forces of 1005 mN were once taken for 1005 N.
    void theUnitOfALabviewColumnStandsInItsHeader_data()
    {
        QTest::addColumn<QString>("units");
        QTest::addColumn<QString>("names");
        QTest::addColumn<QString>("option");
        QTest::addColumn<double>("coefficient");  // of (300, 400, -1000) in the units of each column; 0: refused
        QTest::addColumn<QString>("said");
        QTest::newRow("one unit") << "mN\tmN\tmN"
                                  << "fx\tfy\tfz"
                                  << "" << 0.5 << "";
        QTest::newRow("two units") << "mN\tmN\tgf"
                                   << "fx\tfy\tfz"
                                   << "" << 0.05 / 0.980665 << "";
        QTest::newRow("kilograms") << "N\tN\tkg"
                                   << "fx\tfy\tfz"
                                   << "" << 0.05 / 0.980665 << "the normal force is 9807 N";
        QTest::newRow("the name of the column comes first") << "V\tV\tN"
                                                            << "fx_mN\tfy_mN\tfz_mN"
                                                            << "" << 0.5 << "";
        QTest::newRow("no unit of this column") << "mN\tmN\t"
                                                << "fx\tfy\tfz_mN"
                                                << "" << 0.5 << "";
        QTest::newRow("volts") << "mN\tmN\tVolts"
                               << "fx\tfy\tfz"
                               << "" << 0.0 << "the unit \"Volts\" of the column \"fz\" is unknown";
        QTest::newRow("pounds") << "lbf\tlbf\tlbf"
                                << "fx\tfy\tfz"
                                << "" << 0.0 << "state the unit with --force-unit";
        QTest::newRow("a default that the user corrects") << "Volts\tVolts\tVolts"
                                                          << "fx\tfy\tfz"
                                                          << "mN" << 0.5 << "";
        QTest::newRow("a unit that the user corrects") << "N\tN\tN"
                                                       << "fx\tfy\tfz"
                                                       << "mN" << 0.5 << "";
        QTest::newRow("times for each force") << "mN\t\tmN\t\tN"
                                              << "fx\tX_Value\tfy\tX_Value\tfz_mN"
                                              << "" << 0.5 << "";
        QTest::newRow("times for each force, units without gaps") << "V\tmN\tmN"
                                                                  << "\tX_Value\tfx\tX_Value\tfy\tfz_mN"
                                                                  << "" << 0.5 << "";
    }
    void theUnitOfALabviewColumnStandsInItsHeader()
    {
        QFETCH(const QString, units);
        QFETCH(const QString, names);
        QFETCH(const QString, option);
        QFETCH(const double, coefficient);
        QFETCH(const QString, said);
        m_options.forceUnit = option.toStdString();
        std::string rows;
        for (const char* time : {"0", "0.5", "1"}) {
            rows += time;
            for (const QString& name : names.split('\t'))
                rows += name.startsWith("fx")   ? "\t300"
                        : name.startsWith("fy") ? "\t400"
                        : name.startsWith("fz") ? "\t-1000"
                                                : "\t" + std::string(time);
            rows += "\r\n";
        }
        const std::string text =
            "LabVIEW Measurement\t\r\nX_Columns\tOne\r\n***End_of_Header***\t\r\nChannels\t3\r\nY_Unit_Label\t" +
            units.toStdString() + "\t\r\nDelta_X\t0.5\t0.5\t0.5\r\n***End_of_Header***\r\nX_Value\t" + names.toStdString() +
            "\tComment\r\n" + rows;
        const std::string refusal = refusalOf([&] { importedAs(ImportKind::Labview, "Z_1.lvm", text); });
        QVERIFY2(contains(refusal, said.toStdString()), refusal.c_str());
        QCOMPARE(refusal.empty(), said.isEmpty());
        if (!said.isEmpty()) return;
        for (const double value : lastValues()) QVERIFY2(std::abs(value - coefficient) < 1e-9, std::to_string(value).c_str());
        const std::string csv = read(m_out / "F01/friction/000.csv");
        QVERIFY2(contains(csv, units == "mN\tmN\tgf" ? "\n0,9.80665,0.5\n" : "\n0,1,0.5\n"), csv.c_str());
    }

    void labviewRowsWithoutTimesTakeTheStepOfTheHeader()
    {
        const std::vector<double> expected{0.5, 0.5, 1};
        const auto withoutTimes = [](const std::string& rows) {
            std::string text = labviewFile(rows);
            return text.insert(text.find("Channels"), "X_Columns\tNo\r\n");
        };
        const std::string rows = "\t3\t4\t-10\r\n\t3\t4\t-10\r\n\t6\t8\t-10\r\n";
        QCOMPARE(valuesOf(ImportKind::Labview, "Z_1.lvm", withoutTimes(rows)), expected);
        QCOMPARE(readDataset(m_out).friction.sampleRateHz, 2.0);
        // Some programs write the times nevertheless.
        const std::string timed = "0\t3\t4\t-10\r\n.25\t3\t4\t-10\r\n.5\t6\t8\t-10\r\n";
        QCOMPARE(valuesOf(ImportKind::Labview, "Z_1.lvm", withoutTimes(timed)), expected);
        QCOMPARE(readFriction(readDataset(m_out), FabricId("F01"), 1).sampleRateHz, 4.0);
        const auto refusal = [&](const std::string& text) {
            return refusalOf([&] { importedAs(ImportKind::Labview, "Z_1.lvm", text); });
        };
        QVERIFY(contains(refusal(withoutTimes(rows + "3\t3\t4\t-10\r\n")), "line 10, column X_Value"));
        QVERIFY(contains(refusal(withoutTimes(rows + "\t\r\n" + rows)), "line 11: a row of numbers stands after the end"));
        for (const char* step : {"Delta_X\t0\r", "Delta_X\t0.5\t0.1\r", "Delta_X\t\r"}) {
            std::string text = withoutTimes(rows);
            text.replace(text.find("Delta_X"), std::string("Delta_X\t0.5\r").size(), step);
            QVERIFY2(contains(refusal(text), "has neither times nor one step between its rows"), step);
        }
    }

    /// As the instrument writes under a German locale.
    void aTribometerMayWriteDecimalCommas()
    {
        const std::string rows = "0,5\t0,3\t800,25\t0,2\t10,5\r\n1\t0,3\t800,25\t0,2\t10,5\r\n1,5\t0,3\t800,25\t0,4\t10,5\r\n";
        QCOMPARE(valuesOf(ImportKind::Tribometer, "Z_1.txt", tribometerFile(rows)), (std::vector<double>{0.3, 0.3, 0.3}));
        QCOMPARE(readDataset(m_out).friction.sampleRateHz, 2.0);
        QCOMPARE(readDataset(m_out).friction.speedMmPerS, 10.5);
        m_options.normal = ForceAxis{"pin load"};
        const std::string line = importedAs(ImportKind::Tribometer, "Z_1.txt", tribometerFile(rows));
        QVERIFY2(contains(line, "read with decimal commas"), line.c_str());
        QVERIFY(contains(read(m_out / "F01/friction/001.csv"), "\n0,0.80025,0.2\n"));
        m_options.normal.reset();
        const auto refusal = [&](const std::string& text) {
            return refusalOf([&] { importedAs(ImportKind::Tribometer, "Z_1.txt", tribometerFile(text)); });
        };
        // Thousands, both signs for decimals, and thousands beside decimal commas.
        QVERIFY(contains(refusal("1,000\t0\r\n2,000\t0\r\n"), "\"1,000\" is not a time"));
        QVERIFY(contains(refusal("0,5\t0.3\r\n1,0\t0.3\r\n"), "\"0,5\" is not a time"));
        QVERIFY(contains(refusal("0,5\t1.234,5\r\n1,0\t0,3\r\n"), "\"1.234,5\" is not a number"));
        QVERIFY(contains(refusal("0,5\t0,3\r\nstopped\r\n1,0\t0,3\r\n"), "line 5: a row of numbers stands after the end"));
        // A comma in a column that nobody reads is no decimal comma.
        QCOMPARE(valuesOf(ImportKind::Tribometer, "Z_1.txt", tribometerFile("0.5\t0.3\t1,234\r\n1\t0.3\t0,5\r\n")),
                 (std::vector<double>{0.3, 0.3}));
    }

    /// The steps of a profile once all got the speed of the first, and with it ridges at a wrong distance.
    void eachStepOfAProfileKeepsItsSpeed()
    {
        std::string text;
        for (const char* speed : {"5", "20", ""}) {
            std::string rows;
            for (int i = 0; i < 60; ++i)
                rows += std::to_string(i * 0.01) + "\t" + std::to_string(0.4 + 0.1 * (i % 10 < 5)) + "\t\t\t" + speed + "\r\n";
            text += tribometerFile(rows) + "\r\n";
        }
        const std::string first = importedAs(ImportKind::Tribometer, "Z_1.txt", text);
        const Dataset dataset = readDataset(m_out);
        QCOMPARE(dataset.friction.speedMmPerS, 5.0);
        for (const auto& [index, speed] : {std::pair(0, 5.0), std::pair(1, 20.0), std::pair(2, 5.0)}) {
            const FrictionRecord record = readFriction(dataset, FabricId("F01"), index);
            QCOMPARE(record.speedMmPerS, speed);
            QVERIFY(std::abs(signals::frictionTrace(record, "").mmPerSample - speed / 100) < 1e-6);
        }
        QVERIFY(contains(read(m_out / "F01/friction/001.json"), "\"speed_mm_per_s\": 20.0"));
        QVERIFY(!contains(read(m_out / "F01/friction/002.json"), "speed_mm_per_s"));
    }

    /// The disc rests for 2 s, then turns for 8 s. The rest is cut, but it made 4 mm/s of 5.
    void theSpeedIsThatOfTheKeptRows()
    {
        std::string rows;
        for (int i = 0; i < 1000; ++i)
            rows += std::to_string(i * 0.01) + "\t" + std::to_string(i < 200 ? 0.0 : 0.4 + 0.1 * (i % 10 < 5)) + "\t\t\t" +
                    (i < 200 ? "0" : "5") + "\r\n";
        m_options.trim = Selection::Stated;
        m_options.trimInterval = {2, 9.99};
        importedAs(ImportKind::Tribometer, "Z_1.txt", tribometerFile(rows));
        QCOMPARE(readDataset(m_out).friction.speedMmPerS, 5.0);
    }

    void theSpeedBesideARecordIsChecked_data()
    {
        QTest::addColumn<QString>("json");
        QTest::addColumn<double>("speed");  // 0: refused
        const QString report = "{\"schema\": \"vis2hap.friction-import/1\", \"speed_mm_per_s\": %1}";
        QTest::newRow("a number") << report.arg("20.5") << 20.5;
        QTest::newRow("null") << report.arg("null") << 5.0;
        QTest::newRow("an older report") << "{\"schema\": \"vis2hap.friction-import/1\"}" << 5.0;
        QTest::newRow("a file of somebody else") << "{\"speed_mm_per_s\": 20}" << 5.0;
        QTest::newRow("a list") << "[20]" << 5.0;
        for (const char* wrong : {"0", "-20", "1e9", "1e400", "\"20\"", "true", "[20]"})
            QTest::newRow(wrong) << report.arg(wrong) << 0.0;
        QTest::newRow("no JSON") << "{\"schema" << 0.0;
    }
    void theSpeedBesideARecordIsChecked()
    {
        QFETCH(const QString, json);
        QFETCH(const double, speed);
        importedAs(ImportKind::FrictionCsv, "Z_1.csv", "t,mu\n0,0.3\n0.1,0.3\n");
        const Dataset dataset = readDataset(m_out);
        const std::string before = hashOf(dataset);
        write(m_out / "F01/friction/000.json", json.toStdString());
        if (speed > 0) {
            QCOMPARE(readFriction(dataset, FabricId("F01"), 0).speedMmPerS, speed);
            QCOMPARE(hashOf(dataset) == before, speed == 5);  // Data sets of earlier versions keep their hashes.
            return;
        }
        const std::string refusal = refusalOf([&] { readFriction(dataset, FabricId("F01"), 0); });
        QVERIFY2(contains(refusal, "F01/friction/000.json"), refusal.c_str());
        QVERIFY(!faultsOfDataset(m_out).empty());
    }

    /// Each line and each cell takes 16 bytes beside the text.
    void filesThatAreNoRecordingAreRefusedBeforeTheyFillTheMemory_data()
    {
        QTest::addColumn<QByteArray>("line");
        QTest::addColumn<int>("count");
        QTest::addColumn<QString>("said");
        QTest::newRow("empty lines") << QByteArray("\n") << 10'000'001 << "has more than 10000000 lines";
        QTest::newRow("one long line") << QByteArray("\t") << 20'000 << "line 1: has more than 16384 cells in a line";
        QTest::newRow("one long line of commas") << QByteArray(",") << 20'000 << "line 1: has more than 16384 cells in a line";
        QTest::newRow("tables without rows") << QByteArray("Step Time (s)\n") << 10'001 << "has more than 10000 tables";
    }
    void filesThatAreNoRecordingAreRefusedBeforeTheyFillTheMemory()
    {
        QFETCH(const QByteArray, line);
        QFETCH(const int, count);
        QFETCH(const QString, said);
        const std::string text = line.repeated(count).toStdString();
        const std::string refusal = refusalOf([&] { importedAs(ImportKind::Tribometer, "Z_1.txt", text); });
        QVERIFY2(contains(refusal, said.toStdString()), refusal.c_str());
        if (line == "Step Time (s)\n") return;
        const std::string labview = refusalOf([&] { importedAs(ImportKind::Labview, "Z_1.lvm", text); });
        QVERIFY2(contains(labview, said.toStdString()), labview.c_str());
    }

    void aLongCellIsShownInShort()
    {
        const std::string cell(100'000, '7');
        for (const std::string& row : {"1\t" + cell + "x\r\n", "1\t.2\r\n" + cell + "x\t.2\r\n"}) {
            const std::string refusal = refusalOf([&] { importedAs(ImportKind::Tribometer, "Z_1.txt", tribometerFile(row)); });
            QVERIFY2(contains(refusal, "is not a ") && refusal.size() < 1000, refusal.substr(0, 1000).c_str());
        }
    }

    /// A tribometer holds its disc between steps, and its sensor then writes noise.
    void aDiscThatHoldsStillHasNoSpeed()
    {
        QVERIFY(
            contains(importedAs(ImportKind::Tribometer, "Z_1.txt", tribometerFile("1\t0.2\t\t\t1e-7\r\n2\t0.2\t\t\t1e-7\r\n")),
                     "speed not stated"));
    }

    void aColumnOfATribometerIsNamedWithItsUnit()
    {
        const std::string text = tribometerFile("1\t0.3\t800\t0.2\r\n2\t0.3\t800\t0.2\r\n3\t0.3\t800\t0.4\r\n");
        QCOMPARE(valuesOf(ImportKind::Tribometer, "Z_1.txt", text), (std::vector<double>{0.3, 0.3, 0.3}));  // its own coefficient
        for (const char* name : {"Pin Load (mN)", "pin load"}) {
            m_options.normal = ForceAxis{name};
            QCOMPARE(valuesOf(ImportKind::Tribometer, "Z_1.txt", text), (std::vector<double>{0.25, 0.25, 0.5}));
        }
        m_options.normal = ForceAxis{"Pin Load (N)"};
        QVERIFY(
            contains(refusalOf([&] { importedAs(ImportKind::Tribometer, "Z_1.txt", text); }), "has no column \"Pin Load (N)\""));
        m_options.normal.reset();
        m_options.tangential = {ForceAxis{"Traction Force (N)"}};
        QVERIFY(contains(refusalOf([&] { importedAs(ImportKind::Tribometer, "Z_1.txt", text); }), "has no normal force"));
        m_options.tangential.push_back(ForceAxis{"Ball Load (N)"});
        QVERIFY(contains(refusalOf([&] { importedAs(ImportKind::Tribometer, "Z_1.txt", text); }), "--tangential names two axes"));
    }

    /// Each file has three rows of 0.1 s with the two numbers 5 and 1.5.
    void columnsAreWhatTheirNamesSay_data()
    {
        QTest::addColumn<QString>("header");
        QTest::addColumn<QString>("tangential");
        QTest::addColumn<double>("coefficient");  // 0: refused
        QTest::addColumn<QString>("said");
        const QString ambiguous = "may be a force or a coefficient; expected a force with its unit, or a coefficient called mu; ";
        QTest::newRow("friction without a unit") << "time,load,friction"
                                                 << "" << 0.0 << ambiguous + "rename the column to friction_N";
        QTest::newRow("friction alone") << "time,x,Friction"
                                        << "" << 0.0 << ambiguous;
        QTest::newRow("friction in newtons") << "time,load,friction_N"
                                             << "" << 0.3 << "friction_N / load";
        QTest::newRow("friction that the user names") << "time,load,friction"
                                                      << "friction" << 0.3 << "friction / load";
        QTest::newRow("percent") << "t_s,x,COF (%)"
                                 << "" << 0.015 << "coefficient of friction = COF (%) / 100";
        QTest::newRow("no dimension") << "t_s,x,COF [ - ]"
                                      << "" << 1.5 << "";
        QTest::newRow("no dimension in words") << "t_s,x,mu (dimensionless)"
                                               << "" << 1.5 << "";
        QTest::newRow("a ratio of forces") << "t_s,x,mu [N/N]"
                                           << "" << 1.5 << "";
        QTest::newRow("newtons are no coefficient") << "t_s,x,mu (N)"
                                                    << "" << 0.0 << "has a unit that no coefficient has";
        QTest::newRow("indices of forces") << "t,F_n,F_t"
                                           << "" << 0.3 << "F_t / F_n";
        QTest::newRow("indices with units") << "t,F_n (N),F_t (N)"
                                            << "" << 0.3 << "";
        QTest::newRow("number of the sample") << "t,n,Ft"
                                              << "" << 0.0 << "has the columns t, n, Ft";
        QTest::newRow("normal force in newtons") << "t,n (N),Ft"
                                                 << "" << 0.3 << "";
        QTest::newRow("clock without a unit") << "timestamp,x,mu"
                                              << "" << 1.5 << "";
    }
    void columnsAreWhatTheirNamesSay()
    {
        QFETCH(const QString, header);
        QFETCH(const QString, tangential);
        QFETCH(const double, coefficient);
        QFETCH(const QString, said);
        const std::string text = header.toStdString() + "\n0,5,1.5\n0.1,5,1.5\n0.2,5,1.5\n";
        m_options.tangential = axesFrom(tangential.toStdString(), "--tangential", 2);
        std::string line;
        const std::string refusal = refusalOf([&] { line = importedAs(ImportKind::FrictionCsv, "Z_1.csv", text); });
        QCOMPARE(refusal.empty(), coefficient > 0);
        QVERIFY2(contains(refusal + line, said.toStdString()), (refusal + line).c_str());
        if (coefficient > 0) QCOMPARE(lastValues(), std::vector<double>(3, coefficient));
    }

    void aSlowClockWithoutAUnitIsWarnedOf()
    {
        const std::string rows = ",mu\n0,0.3\n1,0.3\n2,0.31\n";
        const std::string said = "the column \"timestamp\" states no unit, and in s it gives 1 Hz";
        QVERIFY(contains(importedAs(ImportKind::FrictionCsv, "Z_1.csv", "timestamp" + rows), said));
        const auto saved = nlohmann::json::parse(read(m_out / "F01/friction/000.json"));
        QVERIFY(contains(saved["warnings"].dump(), "add that to its name"));
        QVERIFY(!contains(importedAs(ImportKind::FrictionCsv, "Z_1.csv", "timestamp_s" + rows), "states no unit"));
    }

    void onlyNumberedChannelsAreTaxels()
    {
        const auto sums =
            valuesOf(ImportKind::Slide, "Z_F1_V-20mmps_0.csv",
                     "timestamp,channel1,channel2,channel_count,channel\n0,10,20,2,7\n28,11,20,2,7\n56,12,20,2,7\n");
        QCOMPARE(sums, (std::vector<double>{30, 31, 32}));
    }

private:
    /// Imports one file into fabric F01 and returns the line that reports it.
    std::string importedAs(ImportKind kind, const std::string& file, const std::string& text)
    {
        const fs::path source = pathOf(*m_folder) / "one" / file;
        write(source, text);
        ImportRequest request{kind, {source}, m_out, FabricId("F01"), {}};
        request.friction = m_options;
        return importRecordings(request).front();
    }

    /// Values of the newest record.
    std::vector<double> lastValues() const
    {
        const Dataset dataset = readDataset(m_out);
        const FabricId fabric("F01");
        return readFriction(dataset, fabric, sampleIndices(dataset, fabric, Modality::Friction).back()).values;
    }

    std::vector<double> valuesOf(ImportKind kind, const std::string& file, const std::string& text)
    {
        importedAs(kind, file, text);
        return lastValues();
    }

    FrictionOptions m_options;
    std::unique_ptr<QTemporaryDir> m_folder;
    fs::path m_out;
};

QTEST_GUILESS_MAIN(RecordingTablesTest)
#include "recording_tables_test.moc"
