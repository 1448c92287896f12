// The comparison of signals that a study stores as text: read into a value, written as it was, shown in its table.
#include "reports/json/signals_json.h"

#include <QtTest>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "reports/page/page.h"
#include "reports/tables/signal_tables.h"
#include "reports/tables/table_formats.h"
#include "tests/reports/study_builder.h"

using Json = nlohmann::ordered_json;

namespace {

/// The text that `study new` writes: one signal is equivalent, one has no bounds, and one number does not exist.
const std::string stored =
    R"({"friction_mae":0.01374,"friction_mae_over_mean":0.0584,"height_ssim":null,"why":{"height_ssim":"no maps overlap"},)"
    R"("height_range_mm":0.273,"t_tests":[{"signal":"friction","unit":"fabric","n":7,"mean_difference":-0.00146,)"
    R"("statistic":-0.4927,"df":6.0,"p":0.6398,"ci95":[-0.00874,0.00581],"tost":{"bounds":[-0.02354,0.02354],)"
    R"("bounds_are":"a tenth of the measured mean","p_lower":0.0001536,"p_upper":7.7e-05,"p":0.0001536,)"
    R"("ci90":[-0.00724,0.00431],"equivalent":true,"verdict":"not different / equivalent"}},{"signal":"height",)"
    R"("unit":"fabric","n":7,"mean_difference":-0.0078,"statistic":-5.15,"df":6.0,"p":0.0021,"ci95":[-0.0115,-0.0041],)"
    R"("tost":{"bounds":[0.0,0.0],"bounds_are":"a tenth of the measured mean","equivalent":null,)"
    R"("why":{"equivalent":"the measured mean is 0"}}}]})";

reports::StudyAnalysis analysisWith(const std::string& text, bool blinded)
{
    reports::StudyData data = builders::emptyStudy(0, 1, {"f"}, {{"Q2", "", builders::onScale}});
    data.blinded = blinded;
    data.signals = reports::signalsFromJson(text);
    return reports::analyse(data);
}

}  // namespace

class SignalsJsonTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void storedTextIsWrittenAsItWas() { QCOMPARE(reports::signalsJson(*reports::signalsFromJson(stored)).dump(), stored); }

    void absentSignalsAreNone()
    {
        QVERIFY(!reports::signalsFromJson(""));
        QVERIFY(!reports::signalsFromJson("{}"));
    }

    void brokenTextIsAFault_data()
    {
        QTest::addColumn<QString>("text");
        QTest::newRow("cut off") << "{\"friction_mae\":";
        QTest::newRow("no object") << "[1]";
        QTest::newRow("tests are no list") << R"({"t_tests":[3]})";
    }
    void brokenTextIsAFault()
    {
        QFETCH(QString, text);
        QVERIFY_EXCEPTION_THROWN(reports::signalsFromJson(text.toStdString()), protocols::Error);
    }

    void tableShowsBothTests()
    {
        const auto tables = reports::signalTables(analysisWith(stored, false));
        QCOMPARE(tables.size(), std::size_t(1));
        const QStringList lines = QString::fromStdString(reports::toText(tables[0].table)).split('\n');
        QCOMPARE(lines[2].simplified(), QString("friction 7 -0.0015 [-0.0087, 0.0058] -0.49 6 .640 [-0.0235, 0.0235] < .001 "
                                                "not different / equivalent"));
        QCOMPARE(lines[3].simplified(), QString("height 7 -0.0078 [-0.0115, -0.0041] -5.15 6 .002 [0.0000, 0.0000] - undefined"));
    }

    void pageShowsTheNumbers_data()
    {
        QTest::addColumn<QString>("tile");
        QTest::newRow("friction") << "<b>0.0137</b><span>mean absolute error of the friction coefficient</span>";
        QTest::newRow("share") << "<b>5.8 %</b><span>of the mean measured friction</span>";
        QTest::newRow("SSIM") << "<b>\u2013</b><span>structural similarity (SSIM) of the height maps: no maps overlap</span>";
        QTest::newRow("range") << "<b>0.273 mm</b><span>range of the measured maps (L of SSIM)</span>";
    }
    void pageShowsTheNumbers()
    {
        QFETCH(QString, tile);
        const auto analysis = analysisWith(stored, false);
        const std::string page = reports::reportPage(analysis, reports::signalTables(analysis), {});
        QVERIFY(QString::fromStdString(page).contains(tile));
    }

    void blindedReportHasNoTable() { QVERIFY(reports::signalTables(analysisWith(stored, true)).empty()); }
};

QTEST_GUILESS_MAIN(SignalsJsonTest)
#include "signals_json_test.moc"
