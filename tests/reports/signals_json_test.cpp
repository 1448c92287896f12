// The comparison of signals that a study stores as text: read into a value, written as it was, shown in its table.
#include "reports/json/signals_json.h"

#include <QTest>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "reports/formats/table_formats.h"
#include "reports/page/page.h"
#include "reports/tables/signal_tables.h"
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

/// The measures of a source: every height SSIM is `plain`, every registered one `registered`; the rest does not matter here.
Json measures(double plain, double registered)
{
    return {{"friction_mae", 0.02},        {"friction_mae_over_mean", 0.09}, {"mean_friction_error", 0.1},
            {"friction_spectrum_db", 1.9}, {"height_ssim", plain},           {"height_ssim_registered", registered},
            {"height_spectrum_db", 1.2},   {"height_sq_ratio", 0.98}};
}

Json source(const std::string& name, double plain, double registered)
{
    Json json{{"name", name}};
    json.update(measures(plain, registered));
    return json;
}

/// Adds the difference of the registered SSIM and the values of three fabrics.
Json control(const std::string& name, double plain, double registered, double difference, double p)
{
    Json json = source(name, plain, registered);
    json["difference"]["height_ssim_registered"] = {
        {"n", 3}, {"mean_difference", difference}, {"ci95", {difference - 0.1, difference + 0.1}}, {"p", p / 2}, {"p_holm", p}};
    return json;
}

/// The text that `study new` writes since 0.7.0, with controls that are worse, better, undecided and unfair.
std::string withControls(const std::string& pairing = "weak")
{
    Json json = Json::parse(stored);
    for (const auto& [field, value] : std::initializer_list<std::pair<const char*, double>>{{"height_ssim_registered", 0.79},
                                                                                            {"height_spectrum_db", 1.2},
                                                                                            {"height_sq_ratio", 0.98},
                                                                                            {"mean_friction_error", 0.1},
                                                                                            {"friction_spectrum_db", 1.9}})
        json[field] = value;
    json["pairing"] = pairing;
    json["controls_know"] = {{"photographs", 30}, {"presses", 1}, {"strokes", 29}};
    json["notes"] = {"The data set <has> no pitch."};
    Json controls{{"fabric_mean", control("the fabric's mean", 0.30, 0.297, 0.493, 0.002)},
                  {"retrieval", control("nearest photograph", 0.19, 0.78, 0.01, 0.7)},
                  {"l1_only", source("L1-only network", 0.29, 0.326)},
                  {"another_place", control("same fabric, another place", 0.20, 0.87, -0.08, 0.03)}};
    controls["l1_only"]["steps"] = 800;
    controls["l1_only"]["not_a_fair_control"] = "trained with 800 steps (the model: 6,000)";
    json["controls"] = Json::object();
    json["generated"] = source("generated", 0.192, 0.79);
    json["generated"]["steps"] = 6000;
    json["generated_mean"] = source("generated, mean friction alone", 0, 0);
    for (const char* field : {"height_ssim", "height_ssim_registered"}) {
        json["generated_mean"][field] = nullptr;
        json["generated_mean"]["why"][field] = "this predictor gives friction only";
    }
    for (const auto& [id, one] : controls.items()) json["controls"][id] = one;
    for (Json* one : {&json["generated"], &json["generated_mean"], &json["controls"]["fabric_mean"],
                      &json["controls"]["retrieval"], &json["controls"]["l1_only"], &json["controls"]["another_place"]}) {
        (*one)["fabrics"] = Json::array();
        for (const char* fabric : {"F01", "F02", "F03"}) {
            Json of{{"fabric", fabric}};
            of.update(measures(0.2, 0.8));
            (*one)["fabrics"].push_back(of);
        }
    }
    // Through one reading and writing, so that the order of keys is the program's.
    return reports::signalsJson(*reports::signalsFromJson(json.dump())).dump();
}

reports::StudyAnalysis analysisWith(const std::string& text)
{
    reports::StudyData data = builders::emptyStudy(0, 1, {"f"}, {{"Q2", "", builders::onScale}});
    data.signals = reports::signalsFromJson(text);
    return reports::analyse(data);
}

/// The page without line breaks.
QString sectionOf(const std::string& text)
{
    const auto analysis = analysisWith(text);
    return QString::fromStdString(reports::reportPage(analysis, reports::signalTables(analysis), {})).simplified();
}

}  // namespace

class SignalsJsonTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void numbersOfAnEarlierVersionAreKeptAndTheNewOnesHaveAReason()
    {
        const Json old = Json::parse(stored);
        Json now = reports::signalsJson(*reports::signalsFromJson(stored));
        for (const char* field : {"height_ssim_registered", "height_spectrum_db", "height_sq_ratio", "mean_friction_error",
                                  "friction_spectrum_db", "controls"}) {
            QVERIFY2(now[field].is_null(), field);
            QCOMPARE(now["why"][field].get<std::string>(),
                     std::string("the study was made by an earlier version, which stored no controls"));
            now.erase(field);
            now["why"].erase(field);
        }
        QCOMPARE(now.dump(), old.dump());
        QVERIFY(sectionOf(stored).contains("Controls are missing: the study was made by an earlier version"));
    }

    void controlsAreWrittenAsTheyWere()
    {
        const std::string text = withControls();
        const Json json = Json::parse(text);
        QCOMPARE(json["height_ssim_registered"].get<double>(), 0.79);
        QCOMPARE(json["controls"].size(), std::size_t(4));
        QCOMPARE(json["controls"]["l1_only"]["not_a_fair_control"].get<std::string>(),
                 std::string("trained with 800 steps (the model: 6,000)"));
        QCOMPARE(json["controls"]["fabric_mean"]["difference"]["height_ssim_registered"]["ci95"][0].get<double>(), 0.493 - 0.1);
        QCOMPARE(json["controls"]["retrieval"]["fabrics"][2]["fabric"].get<std::string>(), std::string("F03"));
        QCOMPARE(json["generated_mean"]["why"]["height_ssim"].get<std::string>(),
                 std::string("this predictor gives friction only"));
        QCOMPARE(reports::signalsJson(*reports::signalsFromJson(text)).dump(), text);
    }

    void controlsWithoutNumbersKeepTheirReason()
    {
        Json json = Json::parse(stored);
        json["controls"] = nullptr;
        json["why"]["controls"] = "the study's conditions compute no generated signal";
        const Json now = reports::signalsJson(*reports::signalsFromJson(json.dump()));
        QCOMPARE(now["why"]["controls"].get<std::string>(), std::string("the study's conditions compute no generated signal"));
        QCOMPARE(now["why"]["height_spectrum_db"].get<std::string>(),
                 std::string("the study's conditions compute no generated signal"));
    }

    void oneTableHasGeneratedSignalsAndControls()
    {
        const auto tables = reports::signalTables(analysisWith(withControls()));
        QCOMPARE(tables.size(), std::size_t(3));
        const QStringList lines = QString::fromStdString(reports::toText(tables[0].table)).split('\n');
        QCOMPARE(lines[2].simplified(), QString("generated 0.0200 9.0 10.0 1.90 0.192 0.790 1.20 0.980 trained with 6000 steps"));
        QCOMPARE(lines[3].simplified(), QString("generated, mean friction alone 0.0200 9.0 10.0 1.90 - - 1.20 0.980"));
        QCOMPARE(lines[6].simplified(), QString("L1-only network 0.0200 9.0 10.0 1.90 0.290 0.326 1.20 0.980 not a fair control: "
                                                "trained with 800 steps (the model: 6,000)"));
        const QStringList differences = QString::fromStdString(reports::toText(tables[1].table)).split('\n');
        QCOMPARE(differences[2].simplified(),
                 QString("the fabric's mean SSIM, registered 3 0.493 [0.393, 0.593] .001 .002 better"));
        QCOMPARE(differences[4].simplified(),
                 QString("same fabric, another place SSIM, registered 3 -0.080 [-0.180, 0.020] .015 .030 worse"));
    }

    void wordsFollowTheCorrectedTestAndTheBetterSide()
    {
        using reports::SignalMeasure;
        const auto word = [](SignalMeasure measure, double difference, double p) {
            return reports::wordFor(measure, {7, difference, {}, p / 2, p});
        };
        QCOMPARE(word(SignalMeasure::HeightSsimRegistered, 0.1, 0.049), std::string("better"));
        QCOMPARE(word(SignalMeasure::HeightSsimRegistered, -0.1, 0.049), std::string("worse"));
        QCOMPARE(word(SignalMeasure::FrictionMae, -0.1, 0.049), std::string("better"));
        QCOMPARE(word(SignalMeasure::HeightSpectrum, 0.1, 0.049), std::string("worse"));
        QCOMPARE(word(SignalMeasure::HeightSpectrum, 0.1, 0.05), std::string("not decided"));
        QCOMPARE(reports::wordFor(SignalMeasure::FrictionMae, {}), std::string("undefined"));
        QCOMPARE(reports::wordFor(SignalMeasure::FrictionMae, {1, 0.1, {}, {}, {}}), std::string("not decided"));
    }

    void headlineClaimsOnlyWhatIsMeasured_data()
    {
        QTest::addColumn<QString>("sentence");
        QTest::newRow("headline") << "<b>Registered SSIM of the generated height maps is 0.790</b>, the mean over 3 fabrics.";
        QTest::newRow("better")
            << "<b>the fabric&#39;s mean</b>: 0.297. The generated maps are better by 0.493, 95 % CI [0.393, 0.593].";
        QTest::newRow("worse")
            << "another place</b>: 0.870. The generated maps are worse by 0.080, 95 % CI [\u22120.020, 0.180].";
        QTest::newRow("undecided")
            << "0.780. Whether the generated maps differ is not decided: 0.010, 95 % CI [\u22120.090, 0.110].";
        QTest::newRow("unfair") << "0.326. It is not a fair control, because it was trained with 800 steps (the model: 6,000). "
                                   "No difference is stated.";
        QTest::newRow("pairs") << "The pairs are weak";
        QTest::newRow("plain")
            << "a flat map at the fabric's mean height has a plain SSIM of 0.300, the generated maps have 0.192.";
        QTest::newRow("known") << "The controls know 30 photographs, 1 press and 29 strokes";
        QTest::newRow("note") << "The data set &lt;has&gt; no pitch.";
    }
    void headlineClaimsOnlyWhatIsMeasured()
    {
        QFETCH(QString, sentence);
        const QString page = sectionOf(withControls());
        QVERIFY2(page.contains(sentence), qPrintable(page.mid(page.indexOf("Registered SSIM of"), 2500)));
    }

    void alignedPairsAreNamed()
    {
        const QString page = sectionOf(withControls("aligned"));
        QVERIFY(page.contains("The pairs are aligned") && !page.contains("The pairs are weak"));
    }

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
        const auto tables = reports::signalTables(analysisWith(stored));
        QCOMPARE(tables.size(), std::size_t(1));
        const QStringList lines = QString::fromStdString(reports::toText(tables[0].table)).split('\n');
        QCOMPARE(lines[2].simplified(), QString("friction 7 -0.0015 [-0.0087, 0.0058] -0.49 6 .640 [-0.0235, 0.0235] < .001 "
                                                "difference not shown / equivalent"));
        QCOMPARE(lines[3].simplified(), QString("height 7 -0.0078 [-0.0115, -0.0041] -5.15 6 .002 [0.0000, 0.0000] - undefined"));
    }

    void pageShowsTheNumbers_data()
    {
        QTest::addColumn<QString>("tile");
        QTest::newRow("friction") << "<b>0.0137</b><span>mean absolute error of the friction coefficient</span>";
        QTest::newRow("share") << "<b>5.8 %</b><span>of the mean measured friction</span>";
        QTest::newRow("SSIM") << "<b>\u2013</b><span>plain SSIM of the height maps, without registration: no maps overlap</span>";
        QTest::newRow("range") << "<b>0.273 mm</b><span>range of the measured maps (L of SSIM)</span>";
    }
    void pageShowsTheNumbers()
    {
        QFETCH(QString, tile);
        const auto analysis = analysisWith(stored);
        const std::string page = reports::reportPage(analysis, reports::signalTables(analysis), {});
        QVERIFY(QString::fromStdString(page).contains(tile));
    }
};

QTEST_GUILESS_MAIN(SignalsJsonTest)
#include "signals_json_test.moc"
