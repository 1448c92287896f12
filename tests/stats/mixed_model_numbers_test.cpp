// The linear mixed model against R, a second program and published analyses.
#include <QTest>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "stats/models/crossed_study.h"
#include "stats/models/mixed_model.h"
#include "tests/stats/exact_numbers.h"
#include "tests/stats/shared_study.h"
#include "tests/stats/small_models.h"

namespace {

/// Reaction times of six people on five days, two missing, in three batches.
stats::MixedModelData reactionStudy()
{
    const std::vector<double> times{251, 258, 256, 279, 281, 222, 232, 227, 245, 262, 203, 210, 219, 216, 232,
                                    321, 300, 308, 315, 330, 287, 285, 311, 320, 345, 215, 235, 241, 243, 260};
    stats::MixedModelData data;
    std::vector<int> person, batch;
    std::vector<double> day;
    for (int i = 0; i < 30; ++i) {
        if (i == 7 || i == 23) continue;
        data.y.push_back(times[static_cast<std::size_t>(i)]);
        person.push_back(i / 5);
        batch.push_back((2 * i + i / 5) % 3);
        day.push_back(i % 5);
    }
    data.fixed = stats::interceptOnly(data.y.size());
    data.fixed.names.push_back("day");
    data.fixed.columns.push_back(day);
    data.random = {{factor("person", person), day, "day"}, {factor("batch", batch), {}, ""}};
    return data;
}

/// Ratings by formula of 6 participants, 4 fabrics and 3 conditions; two are missing.
stats::CrossedStudy crossedStudy()
{
    std::vector<std::string> person, fabric, condition;
    std::vector<double> ratings;
    for (int p = 0; p < 6; ++p)
        for (int f = 0; f < 4; ++f)
            for (int c = 0; c < 3; ++c) {
                person.push_back("p" + std::to_string(p));
                fabric.push_back("f" + std::to_string(f));
                condition.push_back("c" + std::to_string(c));
                const double rating = 5 + 0.9 * std::sin(3 * p + 1) + 0.8 * std::cos(5 * f) + 0.6 * c +
                                      0.8 * std::sin(7 * p + 11 * c) + 0.7 * std::sin(13 * f + 5 * c + 2) +
                                      0.8 * std::sin(17 * p + 23 * f + 31 * c);
                ratings.push_back(std::round(10 * rating) / 10);
            }
    ratings[10] = ratings[41] = std::nan("");
    return {stats::factorOf("who", person), stats::factorOf("what", fabric), stats::factorOf("how", condition), ratings};
}

struct ContrastNumbers {
    double estimate, se, df, t, p, low, high;
};

void compareContrast(const stats::ContrastTest& test, const ContrastNumbers& expected)
{
    compareNumbers({{"estimate", test.estimate, expected.estimate, 1e-9},
                    {"se", test.se, expected.se, 1e-9},
                    {"df", test.df, expected.df, 1e-7},
                    {"t", test.t, expected.t, 1e-9},
                    {"p", test.p, expected.p, 1e-7},
                    {"log p", test.logP, std::log(expected.p), 1e-7},
                    {"low", test.ci.low, expected.low, 1e-8},
                    {"high", test.ci.high, expected.high, 1e-8}});
}

}  // namespace

class MixedModelNumbersTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void sharedStudiesAgreeWithR_data()
    {
        QTest::addColumn<QString>("name");
        for (const char* name : {"study_a", "study_missing_a"}) QTest::addRow("%s", name) << name;
    }

    void sharedStudiesAgreeWithR()
    {
        QFETCH(QString, name);
        const auto rows = shared::readCsv(shared::studyFolder() / (name + ".csv").toStdString());
        if (rows.empty())
            QSKIP("the shared studies are missing: nothing was compared with lme4 and lmerTest (set VIS2HAP_SHARED)");
        const auto report = shared::expected(name.toStdString());
        for (std::size_t column = 4; column < 7; ++column) {
            const std::string question = rows[0][column];
            const auto& expected = report[question]["lmm"];
            const auto rating = stats::fitRatings(shared::study(rows, column));
            for (const auto& fixed : rating.model.fixed) {
                compare(fixed.test.estimate, expected["fixef"][fixed.name], 1e-5, fixed.name);
                compare(fixed.test.se, expected["se"][fixed.name], 1e-4, "se of " + fixed.name);
            }
            // lme4's optimiser stops up to 5e-8 above the minimum of the criterion. Its variances then differ by up to
            // 1.4e-4 from the closed forms of balanced data (study_a, Q2).
            for (const auto& random : rating.model.random)
                compare(random.variance, expected["var"][random.name], 2e-4, random.name);
            compare(rating.model.residualVariance, expected["var"]["Residual"], 1e-4, "residual");
            compare(rating.model.criterion, expected["REML_criterion"], 1e-10, "REML criterion");
            QVERIFY(*rating.model.criterion <= expected["REML_criterion"].get<double>() + 1e-9);
            compare(rating.condition.f, expected["F"], 1e-4, "F");
            compare(rating.condition.df1, expected["num_df"], 0, "df1");
            compare(rating.condition.df2, expected["den_df"], 1e-4, "df2");
            compare(rating.condition.logP, std::log(expected["p"].get<double>()), 1e-4, "log p");
            QCOMPARE(rating.model.singular, expected["singular"].get<bool>());
        }
    }

    void sleepstudyAsPublished()
    {
        const auto rows = shared::readCsv(oracle::sharedFolder() / "oracle/datasets/sleepstudy.csv");
        if (rows.empty()) QSKIP("the data set sleepstudy is missing: the random slope was not compared (set VIS2HAP_SHARED)");
        auto fixed = stats::interceptOnly(rows.size() - 1);
        fixed.names.push_back("Days");
        fixed.columns.push_back(shared::numbers(rows, 1));
        const stats::RandomTerm subjects{stats::factorOf("Subject", shared::column(rows, 2)), shared::numbers(rows, 1), "Days"};
        const auto model = stats::fitMixedModel({shared::numbers(rows, 0), fixed, {subjects}});
        // Bates et al. 2015, J. Stat. Softw. 67(1): Reaction ~ Days + (Days | Subject).
        compare(model.fixed[0].test.estimate, 251.405, 1e-5, "intercept");
        compare(model.fixed[0].test.se, 6.825, 1e-3, "its se");
        compare(model.fixed[1].test.estimate, 10.467, 1e-4, "slope");
        compare(model.fixed[1].test.se, 1.546, 1e-3, "its se");
        compare(model.random[0].sd, 24.74, 1e-3, "sd of intercepts");
        compare(model.random[0].slopeSd, 5.92, 1e-3, "sd of slopes");
        QVERIFY(std::fabs(*model.random[0].correlation - 0.07) < 0.005);
        compare(model.residualSd, 25.59, 1e-3, "residual");
        compare(model.criterion, 1743.62827196, 1e-10, "REML criterion");
        compare(model.fixed[1].test.df, 17, 1e-6, "df");  // balanced: subjects - 1
    }

    void wineAsPublished()
    {
        const auto rows = shared::readCsv(oracle::sharedFolder() / "oracle/datasets/wine.csv");
        if (rows.empty()) QSKIP("the wine data are missing: two crossed fixed effects were not compared (set VIS2HAP_SHARED)");
        auto fixed = stats::interceptOnly(rows.size() - 1);
        std::vector<double> warm, contact, both;
        for (std::size_t i = 1; i < rows.size(); ++i) {
            warm.push_back(rows[i][2] == "warm" ? 1 : 0);
            contact.push_back(rows[i][3] == "yes" ? 1 : 0);
            both.push_back(warm.back() * contact.back());
        }
        fixed.names.insert(fixed.names.end(), {"tempwarm", "contactyes", "tempwarm:contactyes"});
        fixed.columns.insert(fixed.columns.end(), {warm, contact, both});
        const auto model = stats::fitMixedModel(
            {shared::numbers(rows, 0), fixed, {{stats::factorOf("judge", shared::column(rows, 5)), {}, ""}}});
        compare(model.criterion, 558.842811164, 1e-11, "REML criterion");
        compare(model.random[0].variance, 73.3323507591, 1e-6, "judges");
        compare(model.residualVariance, 152.084258998, 1e-6, "residual");
        const double estimates[] = {31.0555555556, 18.9444444444, 9.5, 7.77777777778};
        for (std::size_t i = 0; i < 4; ++i) compare(model.fixed[i].test.estimate, estimates[i], 1e-10, model.fixed[i].name);
    }

    // /usr/bin/python3 tests/stats/reference/mixed_models.py
    void everyNumberOfTheSmallStudy_data()
    {
        QTest::addColumn<bool>("reml");
        QTest::addColumn<double>("confidence");
        QTest::addColumn<std::vector<double>>("model");             // criterion, variances of people, fabrics, residual
        QTest::addColumn<std::vector<ContrastNumbers>>("effects");  // the fixed effects, then level 3 - level 2
        QTest::addColumn<std::vector<double>>("f");
        QTest::newRow("REML")
            << true << 0.95 << std::vector<double>{39.8369187624965, 0.17544653824535, 0.0245467835532415, 0.439785461673984}
            << std::vector<ContrastNumbers>{{4.4313836228799, 0.345969002350326, 6.77101315463441, 12.8086146237827,
                                             5.38518640129832e-06, 3.60765485152809, 5.25511239423172},
                                            {1.63907462207255, 0.389876085257137, 10.7733668135544, 4.20409120757309,
                                             0.00154368440664797, 0.778755588805561, 2.49939365533953},
                                            {2.2186163771201, 0.389201292455157, 10.7257850091651, 5.70043424862398,
                                             0.000152016305561757, 1.35931052149175, 3.07792223274844},
                                            {0.57954175504755, 0.384109781575783, 10.3363764322428, 1.50879197262309,
                                             0.161295395512706, -0.114350421819546, 1.27343393191465}}
            << std::vector<double>{17.3518464429229, 10.6027498078295, 0.000453109431842401};
        QTest::newRow("maximum likelihood")
            << false << 0.9 << std::vector<double>{38.219946862559, 0.151792862770678, 0.00408022680930246, 0.37319005130218}
            << std::vector<ContrastNumbers>{{4.42827135692502, 0.306091099389052, 11.2183602212053, 14.4671679959454,
                                             1.32236806844669e-08, 3.8795444840435, 4.97699822980654},
                                            {1.62703319771865, 0.358700720353727, 12.4083205709434, 4.53590724912449,
                                             0.000627955846854595, 0.989473694258964, 2.26459270117833},
                                            {2.22172864307498, 0.358540345208826, 12.2404151728423, 6.19659313871906,
                                             4.22428189502997e-05, 1.58375078939181, 2.85970649675814},
                                            {0.594695445356326, 0.352994737980324, 11.9124631516647, 1.6847147602225,
                                             0.118038964894068, -0.0348281056831373, 1.22421899639579}}
            << std::vector<double>{20.4238485504828, 12.1784909493753, 0.000128706286659609};
    }

    void everyNumberOfTheSmallStudy()
    {
        QFETCH(bool, reml);
        QFETCH(double, confidence);
        QFETCH(std::vector<double>, model);
        QFETCH(std::vector<ContrastNumbers>, effects);
        QFETCH(std::vector<double>, f);
        const auto fitted = stats::fitMixedModel(smallStudy(), {.reml = reml, .confidence = confidence});
        QCOMPARE(fitted.rows, std::size_t{18});
        compareNumbers({{"criterion", fitted.criterion, model[0], 1e-13},
                        {"people", fitted.random[0].variance, model[1], 1e-9},
                        {"sd of people", fitted.random[0].sd, std::sqrt(model[1]), 1e-9},
                        {"fabrics", fitted.random[1].variance, model[2], 1e-8},
                        {"residual", fitted.residualVariance, model[3], 1e-9},
                        {"sd of the residual", fitted.residualSd, std::sqrt(model[3]), 1e-9}});
        for (std::size_t i = 0; i < 3; ++i) compareContrast(fitted.fixed[i].test, effects[i]);
        compareContrast(stats::levelDifference(fitted, 2, 1, 0.9), effects[3]);
        const auto test = stats::effectTest(fitted);
        compareNumbers({{"F", test.f, f[0], 1e-9},
                        {"df1", test.df1, 2},
                        {"df2", test.df2, f[1], 1e-7},
                        {"p", test.p, f[2], 1e-7},
                        {"log p", test.logP, std::log(f[2]), 1e-7}});
        compareReasons({{"slope", fitted.random[0].slopeSd, "intercepts only"},
                        {"correlation", fitted.random[0].correlation, "intercepts only"}});
    }

    // /usr/bin/python3 tests/stats/reference/mixed_models.py
    void slopesThatGoWithTheirIntercepts_data()
    {
        QTest::addColumn<bool>("reml");
        QTest::addColumn<std::vector<double>>("model");
        QTest::addColumn<std::vector<ContrastNumbers>>("effects");
        QTest::newRow("REML") << true << std::vector<double>{214.702473708161,   1538.10775720972, 13.0689076615923,
                                                             0.0707775624292679, 10.0625635020139, 45.9398101752449}
                              << std::vector<ContrastNumbers>{
                                     {246.873394418426, 16.2594376756086, 5.12504714368101, 15.1833906770817,
                                      1.85797324444427e-05, 205.382055752424, 288.364733084429},
                                     {8.75362264135099, 1.72130536225536, 4.66462229841389, 5.08545597620252, 0.00463846383302784,
                                      4.23144562526108, 13.2757996574409}};
        QTest::newRow("maximum likelihood") << false
                                            << std::vector<double>{224.849461082226,   1281.07226358695, 9.86959947478964,
                                                                   0.0853794304246144, 9.73317531996416, 46.2326096144734}
                                            << std::vector<ContrastNumbers>{
                                                   {246.874758107904, 14.8811916041075, 6.17314108043544, 16.5897170519437,
                                                    2.3593102791032e-06, 210.707930935131, 283.041585280676},
                                                   {8.74158008929278, 1.5602835668173, 5.51453113274521, 5.60255858306837,
                                                    0.00182277258671025, 4.84073175048721, 12.6424284280984}};
    }

    void slopesThatGoWithTheirIntercepts()
    {
        QFETCH(bool, reml);
        QFETCH(std::vector<double>, model);
        QFETCH(std::vector<ContrastNumbers>, effects);
        const auto data = reactionStudy();
        const auto fitted = stats::fitMixedModel(data, {.reml = reml});
        compareNumbers({{"criterion", fitted.criterion, model[0], 1e-12},
                        {"intercepts", fitted.random[0].variance, model[1], 1e-8},
                        {"slopes", fitted.random[0].slopeVariance, model[2], 1e-8},
                        {"sd of the slopes", fitted.random[0].slopeSd, std::sqrt(model[2]), 1e-8},
                        {"correlation", fitted.random[0].correlation, model[3], 1e-7},
                        {"batches", fitted.random[1].variance, model[4], 1e-7},
                        {"residual", fitted.residualVariance, model[5], 1e-8}});
        compareContrast(fitted.fixed[0].test, effects[0]);
        compareContrast(fitted.fixed[1].test, effects[1]);
        QCOMPARE(fitted.random[0].slopeName, std::string("day"));
        QVERIFY(!fitted.singular && !fitted.random[0].zero);
        // Another unit of the covariate only changes the unit of the slopes.
        auto hours = data;
        for (double& day : hours.random[0].slope) day *= 24;
        const auto inHours = stats::fitMixedModel(hours, {.reml = reml});
        compareNumbers({{"slopes in hours", inHours.random[0].slopeVariance, model[2] / 576, 1e-7},
                        {"correlation", inHours.random[0].correlation, model[3], 1e-6},
                        {"p of the slope", inHours.fixed[1].test.p, *fitted.fixed[1].test.p, 1e-6}});
    }

    // /usr/bin/python3 tests/stats/reference/mixed_models.py
    void everyNumberOfACrossedStudy()
    {
        const auto rating = stats::fitRatings(crossedStudy());
        QCOMPARE(rating.formula,
                 std::string("y~condition+(1|participant)+(1|fabric)+(1|participant:condition)+(1|fabric:condition)"));
        QCOMPARE(rating.model.missing, std::size_t{2});
        QVERIFY(rating.leftOut.empty());
        compareNumbers(
            {{"criterion", rating.model.criterion, 179.520543852869},
             {"participants", effectNamed(rating.model, "participant").variance, 0.288842866047612, 1e-8},
             {"fabrics", effectNamed(rating.model, "fabric").variance, 0.406397248192026, 1e-8},
             {"participants by condition", effectNamed(rating.model, "participant:condition").variance, 0.197634983118413, 1e-8},
             {"fabrics by condition", effectNamed(rating.model, "fabric:condition").variance, 0.0419688964214894, 1e-8},
             {"residual", rating.model.residualVariance, 0.456824624550332, 1e-8},
             {"F", rating.condition.f, 2.01911964459256, 1e-9},
             {"df2", rating.condition.df2, 9.23937070189565, 1e-7},
             {"p", rating.condition.p, 0.187285186690752, 1e-8}});
        compareContrast(rating.model.fixed[0].test,
                        ContrastNumbers{5.55833333333333, 0.460657722216086, 8.6598631903146, 12.0660808779974,
                                        1.03589516075287e-06, 4.50998045225886, 6.60668621440781});
        compareContrast(rating.model.fixed[1].test,
                        ContrastNumbers{0.711193789285692, 0.354972435210423, 9.18768262535211, 2.00351835450013,
                                        0.0754735563874235, -0.0893161195049257, 1.51170369807631});
        compareContrast(rating.model.fixed[2].test,
                        ContrastNumbers{0.400384380077643, 0.354972435210423, 9.18768262535211, 1.12793090494562,
                                        0.287941567969437, -0.400125528712975, 1.20089428886826});
        compareContrast(stats::levelDifference(rating.model, 2, 1),
                        ContrastNumbers{-0.310809409208049, 0.356530469356655, 9.34551578412714, -0.87176114223531,
                                        0.405177595000774, -1.11281478576196, 0.491195967345863});
        QCOMPARE(rating.model.fixed[2].name, std::string("conditionc2"));
    }

    // /usr/bin/python3 tests/stats/reference/mixed_models.py: two fabrics leave about two degrees of freedom.
    void fewDegreesOfFreedom_data()
    {
        QTest::addColumn<int>("missing");
        QTest::addColumn<std::vector<double>>("variances");
        QTest::addColumn<ContrastNumbers>("effect");
        QTest::addColumn<std::vector<double>>("f");
        QTest::newRow("rating 7 is missing")
            << 7 << std::vector<double>{0.0552704848190948, 7.1057642034766, 0.812654805946176}
            << ContrastNumbers{-0.501297726905337, 0.912853681565933, 2.00269227670731, -0.5491545217251,
                               0.637956731232547,  -4.42393456440541, 3.42133911059473}
            << std::vector<double>{0.463646796515053, 2.0, 0.683224943600466};
        QTest::newRow("rating 8 is missing")
            << 8 << std::vector<double>{0.0559737454268198, 7.22102507886029, 0.671969667344058}
            << ContrastNumbers{-0.575000000000003, 0.832826932029422, 1.98480205412312, -0.690419555235624,
                               0.561764789389679,  -4.18478791380554, 3.03478791380554}
            << std::vector<double>{0.518295672240798, 2.0, 0.658633241392394};
    }

    void fewDegreesOfFreedom()
    {
        QFETCH(int, missing);
        QFETCH(std::vector<double>, variances);
        QFETCH(ContrastNumbers, effect);
        QFETCH(std::vector<double>, f);
        stats::MixedModelData data;
        std::vector<int> person, fabric, pair, condition;
        for (int i = 0; i < 24; ++i) {
            if (i == missing) continue;
            const int p = i / 6, g = i / 3 % 2, c = i % 3;
            const double rating = 5 + 0.3 * std::sin(3 * p + 1) + 5 * g + 1.2 * std::sin(4 * g + 5 * c + 2) +
                                  0.4 * std::sin(17 * p + 23 * g + 31 * c);
            data.y.push_back(std::round(10 * rating) / 10);
            person.push_back(p);
            fabric.push_back(g);
            pair.push_back(3 * g + c);
            condition.push_back(c);
        }
        data.fixed = stats::treatmentCoded(factor("condition", condition));
        data.random = {{factor("person", person), {}, ""}, {factor("fabric", fabric), {}, ""}, {factor("pair", pair), {}, ""}};
        const auto model = stats::fitMixedModel(data);
        compareNumbers({{"people", model.random[0].variance, variances[0], 1e-7},
                        {"fabrics", model.random[1].variance, variances[1], 1e-7},
                        {"pairs", model.random[2].variance, variances[2], 1e-7}});
        compareContrast(model.fixed[1].test, effect);
        const auto test = stats::effectTest(model);
        compareNumbers({{"F", test.f, f[0], 1e-8}, {"df2", test.df2, f[1], 1e-6}, {"p", test.p, f[2], 1e-6}});
    }
};

QTEST_GUILESS_MAIN(MixedModelNumbersTest)
#include "mixed_model_numbers_test.moc"
