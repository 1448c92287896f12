// Claims, mixed models, analyses of variance of two factors and psychometric functions as `vis2hap analyse` answers them.
// Expected numbers: tests/stats/reference/analyse_families.R, two_way_anova.R and psychometric_function.R.
#include <QFile>
#include <QTest>
#include <cmath>
#include <nlohmann/json.hpp>

#include "study/analyse/analyse.h"

namespace {

using nlohmann::json;

json answerTo(const char* analysis, const json& inputs, const json& options = json::object())
{
    return study::analyse::answerOf({{"id", "one"}, {"analysis", analysis}, {"inputs", inputs}, {"options", options}}, ".");
}

bool near(const json& value, double expected, double relative = 1e-6)
{
    const bool agrees = value.is_number() && std::abs(value.get<double>() - expected) <= relative * std::abs(expected);
    if (!agrees) qWarning("got %s, expected %.12g", value.dump().c_str(), expected);
    return agrees;
}

bool says(const json& answer, const char* field, const QString& words)
{
    const bool agrees = answer.contains(field) && QString::fromStdString(answer[field].get<std::string>()).contains(words);
    if (!agrees) qWarning("answered %s", answer.dump().substr(0, 300).c_str());
    return agrees;
}

/// 8 participants, 5 fabrics and 3 conditions, as in the R file.
json rowsOf(const char* value)
{
    json rows{{value, json::array()}, {"condition", json::array()}, {"participant", json::array()}, {"fabric", json::array()}};
    for (int p = 0; p < 8; ++p)
        for (int f = 0; f < 5; ++f)
            for (int c = 0; c < 3; ++c) {
                const int rating =
                    (p * 7 + f * 5 + c * 4 + p * f * 11 + (p + c) * (p + c) * 3 + f * c * (f + 1) + c * p * p * f) % 13;
                const bool correct = (p * 5 + f * 3 + c * 7 + p * f * c + f * f + p * p) % 11 + c > 4;
                rows[value].push_back(std::string(value) == "value" ? json(rating / 2.0 + c) : json(correct ? 1 : 0));
                rows["condition"].push_back("c" + std::to_string(c));
                rows["participant"].push_back(p);
                rows["fabric"].push_back("f" + std::to_string(f));
            }
    return rows;
}

/// Choices with times; one participant has no times under c1, and the first row of c2 has no choice.
json timedRows()
{
    json rows = rowsOf("correct");
    rows.erase("fabric");
    rows["seconds"] = json::array();
    for (int p = 0; p < 8; ++p)
        for (int f = 0; f < 5; ++f)
            for (int c = 0; c < 3; ++c)
                rows["seconds"].push_back(p == 3 && c == 1 ? json() : json(2 + (p * 3 + f * 5 + c * 2 + 10) % 7 / 2.0));
    rows["correct"][2] = nullptr;
    return rows;
}

/// Adds a rating of a fabric; no condition has an effect.
void addRating(json& rows, int participant, int fabric, int condition, double value)
{
    rows["value"].push_back(value);
    rows["condition"].push_back(std::string(1, static_cast<char>('a' + condition)));
    rows["participant"].push_back(participant);
    rows["fabric"].push_back("f" + std::to_string(fabric));
}

/// Fabrics differ by 2 points each; the rest is noise of the row.
double ratingOf(int participant, int fabric, int condition, int repetition = 0)
{
    const int noise = (participant * 7 + fabric * 5 + condition * 11 + repetition * 3 + participant * fabric * condition +
                       (participant + repetition) * (condition + 2) * 4) %
                      9;
    return 2.0 * fabric + noise / 10.0;
}

bool haveSameOmnibus(const json& one, const json& other)
{
    bool areSame = one["omnibus"].size() == 2 && other["omnibus"].size() == 2;
    for (std::size_t i = 0; areSame && i < 2; ++i)
        for (const char* number : {"statistic", "df1", "df2", "p"})
            areSame = areSame && near(one["omnibus"][i][number], other["omnibus"][i][number].get<double>());
    return areSame;
}

const json& claimOf(const json& answer, const char* a, const char* b, const char* generalisation)
{
    static const json none;
    for (const json& claim : answer["claims"])
        if (claim["a"] == a && claim["b"] == b && claim["generalises_to"] == generalisation) return claim;
    return none;
}

}  // namespace

class AnalyseFamiliesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void linearMixedModelWithInteractions()
    {
        const json answer = answerTo("linear_mixed", rowsOf("value"), {{"bounds", {-1, 1}}});
        QVERIFY(near(answer["fixef"]["(Intercept)"], 2.7) && near(answer["se"]["conditionc1"], 0.540832661497));
        QVERIFY(near(answer["df"]["conditionc2"], 8, 1e-5) && near(answer["t"]["conditionc2"], 4.41448930505));
        QVERIFY(near(answer["p"]["(Intercept)"], 3.04010489664e-05, 1e-5));
        QVERIFY(near(answer["var"]["fabric:condition"], 0.4092154795148, 1e-5));
        QVERIFY(near(answer["var"]["Residual"], 2.5762755187283, 1e-6));
        QCOMPARE(answer["var"]["participant:condition"].get<double>(), 0.0);
        QVERIFY(answer["singular"].get<bool>() && near(answer["criterion"], 468.154284209, 1e-10));
        QVERIFY(near(answer["F"], 9.84081) && near(answer["F_df2"], 8, 1e-5) && near(answer["F_p"], 0.0069758, 1e-5));
        QCOMPARE(answer["contrasts"].size(), std::size_t(3));
        const json& last = answer["contrasts"][2];
        QVERIFY(last["a"] == "c1" && last["b"] == "c2" && near(last["estimate"], -0.9875));
        QVERIFY(near(last["p"], 0.105298300244, 1e-5) && last["p_equivalence"].is_number() && last["ci90_low"].is_number());
        QVERIFY(near(last["p_adjusted"], last["p"].get<double>(), 1e-12));
    }

    void linearMixedModelWithMainTerms()
    {
        const json answer =
            answerTo("linear_mixed", rowsOf("value"), {{"terms", "main"}, {"contrasts", json::parse(R"([["c1", "c2"]])")}});
        QCOMPARE(answer["formula"].get<std::string>(), std::string("y~condition+(1|participant)+(1|fabric)"));
        QVERIFY(near(answer["var"]["participant"], 0.0754076906664, 1e-5) && near(answer["criterion"], 471.300886542, 1e-10));
        QVERIFY(near(answer["F"], 20.39023) && near(answer["F_p"], 3.2195e-08, 1e-4));
        QCOMPARE(answer["contrasts"].size(), std::size_t(1));
        QVERIFY(near(answer["contrasts"][0]["p"], 0.00985614288999, 1e-5));
    }

    void logisticMixedModel()
    {
        const json answer = answerTo("logistic_mixed", rowsOf("correct"), {{"terms", "main"}});
        QVERIFY(near(answer["fixef"]["(Intercept)"], 0.306047459595, 1e-4));
        QVERIFY(near(answer["se"]["conditionc2"], 0.473586829088, 1e-3) &&
                near(answer["sd"]["participant"], 0.224266234763, 1e-3));
        QVERIFY(near(answer["logLik"], -79.18059602757, 1e-8) && near(answer["lrt_chi2"], 2.23264466087, 1e-5));
        QVERIFY(answer["singular"].get<bool>() && answer["separation"].is_null());
        const json crossed = answerTo("logistic_mixed", rowsOf("correct"));
        QCOMPARE(crossed["sd"].size(), std::size_t(4));
        QVERIFY(crossed["logLik"].get<double>() >= answer["logLik"].get<double>() - 1e-6);
    }

    void rSquaredOfMixedModels()
    {
        const json answer = answerTo("r_squared", rowsOf("value"));
        QVERIFY(near(answer["condition_variance"], 0.967542016807) && near(answer["marginal"], 0.232850957176));
        QVERIFY(near(answer["conditional"], 0.379987421667) && answer["scale"] == "value");
        QVERIFY(near(answer["share"]["Residual"], 1 - (0.379987421667 - 0.232850957176) / (1 - 0.232850957176)));
        QCOMPARE(answer["var"]["participant:condition"].get<double>(), 0.0);
        const json main = answerTo("r_squared", rowsOf("value"), {{"terms", "main"}});
        QVERIFY(near(main["marginal"], 0.235830803570) && near(main["conditional"], 0.311830738077));
        json choices = rowsOf("correct");
        choices["value"] = choices["correct"];
        choices.erase("correct");
        const json logistic = answerTo("r_squared", choices, {{"terms", "main"}, {"model", "logistic"}});
        QVERIFY(near(logistic["marginal"], 0.0243024291708, 1e-3) && near(logistic["conditional"], 0.0389942385224, 1e-3));
        QVERIFY(logistic["scale"] == "log_odds" && near(logistic["var"]["Residual"], 3.289868133696));
        json same = rowsOf("value");
        for (json& value : same["value"]) value = 10;
        QVERIFY(says(answerTo("r_squared", same), "reason", "no variation left"));
    }

    void speedOfConditions()
    {
        const json answer = answerTo("speed_contrasts", timedRows());
        const json& c1 = answer["conditions"]["c1"];
        QVERIFY(near(c1["bits_per_second"], 0.0399725432584) && near(c1["bis"], -0.3596472849624));
        QVERIFY(near(c1["bis_ci_low"], -2.3517701255822) && c1["bits_per_second_ci_high"].is_number());
        QCOMPARE(answer["contrasts"].size(), std::size_t(3));
        const json& contrast = answer["contrasts"][2];
        QVERIFY(contrast["a"] == "c1" && contrast["b"] == "c2" && contrast["bis"]["n"] == 7);
        const json& rate = contrast["bits_per_second"];
        QVERIFY(near(rate["estimate"], -0.0642273298122) && near(rate["ci_low"], -0.1789270111236) && near(rate["df"], 6));
        QVERIFY(near(rate["p"], 0.2196873245605) && near(rate["p_adjusted"], 0.6590619736816));
        QVERIFY(near(answer["contrasts"][0]["bits_per_second"]["p_adjusted"], 0.6983494501510));
        QVERIFY(near(contrast["bis"]["estimate"], -0.401971552363) && near(contrast["bis"]["p"], 0.662560871944));
        QVERIFY(near(contrast["log_seconds"]["estimate"], -0.0127192432869));
        QVERIFY(near(contrast["log_seconds"]["p"], 0.7576151994100));
        const json one = answerTo("speed_contrasts", timedRows(), {{"contrasts", json::parse(R"([["c2", "c0"]])")}});
        QVERIFY(near(one["contrasts"][0]["bis"]["p_adjusted"], 0.595665152036));
        QVERIFY(near(one["contrasts"][0]["bis"]["estimate"], 0.400074319982));
    }

    void speedThatIsNotDefinedSaysWhy()
    {
        json rows = timedRows();
        for (json& time : rows["seconds"]) time = nullptr;
        const json answer = answerTo("speed_contrasts", rows);
        QVERIFY(answer["contrasts"][0]["bis"].contains("reason"));
        QVERIFY(answer["conditions"]["c0"]["why"]["bits_per_second"] == "there are no response times");
        rows["correct"][0] = 0.5;
        QVERIFY(says(answerTo("speed_contrasts", rows), "error", "0, 1 and null"));
        rows["seconds"].push_back(1);
        QVERIFY(says(answerTo("speed_contrasts", rows), "error", "differ in length"));
        for (json& condition : rows["condition"]) condition = "one";
        rows["seconds"].erase(0);
        rows["correct"][0] = 1;
        QVERIFY(says(answerTo("speed_contrasts", rows), "reason", "one condition"));
    }

    void ordinalMixedModel()
    {
        json rows = rowsOf("value");
        rows["rating"] = rows["value"];
        rows.erase("value");
        const json answer = answerTo("ordinal_mixed", rows, {{"round_to", 1}});
        QVERIFY(near(answer["fixef"]["conditionc2"], 2.387937327772, 1e-4) &&
                near(answer["se"]["conditionc1"], 0.41614032, 1e-3));
        QVERIFY(near(answer["thresholds"]["0|1"], -2.360868454915, 1e-3));
        QVERIFY(near(answer["thresholds_se"]["7|8"], 0.622221986944, 2e-3));
        QVERIFY(near(answer["sd"]["fabric"], 0.451900237225, 1e-3) && near(answer["logLik"], -231.5321233592, 1e-7));
        QVERIFY(near(answer["lrt_chi2"], 31.7916530277, 1e-4) && near(answer["lrt_df"], 2) && answer["levels"].size() == 9);
        rows["condition"] = json::array();
        for (std::size_t row = 0; row < 120; ++row) rows["condition"].push_back("one");
        QVERIFY(says(answerTo("ordinal_mixed", rows), "reason", "condition"));
        QVERIFY(says(answerTo("ordinal_mixed", rows, {{"round_to", 3}}), "error", "round_to must be"));
    }

    void claimsAreMadeTwice()
    {
        const json answer = answerTo("claims", rowsOf("value"), {{"bounds", {-1, 1}}});
        QCOMPARE(answer["claims"].size(), std::size_t(6));
        const json& alike = claimOf(answer, "c0", "c2", "fabrics_like_these");
        // lmerTest: lmer(y ~ c + (1 | p) + (1 | f) + (1 | p:c) + (1 | f:c)) of the rows of c0 and c2. Holm: first of three.
        QVERIFY(near(alike["estimate"], -2.3875) && near(alike["se"], 0.451558150288622, 1e-5) && near(alike["df"], 8, 1e-5));
        QVERIFY(near(alike["p"], 0.000739686908688, 1e-4) && near(alike["p_adjusted"], 3 * 0.000739686908688, 1e-4));
        const json& these = claimOf(answer, "c0", "c2", "these_fabrics");
        QVERIFY(near(these["se"], 0.36812143765) && near(these["df"], 7) && near(these["p"], 0.000338682816445));
        QCOMPARE(these["verdict"].get<std::string>(), std::string("different"));
        QCOMPARE(answer["omnibus"].size(), std::size_t(2));
        QVERIFY(near(answer["omnibus"][1]["statistic"], 9.84081) && answer["omnibus"][0]["p"].is_number());
        QVERIFY(!answer.contains("above_chance"));
    }

    /// A shell splits at &, so both spellings name one condition.
    void contrastsHaveEitherSpelling()
    {
        json rows = rowsOf("value");
        const std::map<std::string, std::string> names{{"c0", "h_g&f_g"}, {"c1", "h+f@fast"}, {"c2", "h"}};
        for (json& condition : rows["condition"]) condition = names.at(condition.get<std::string>());
        const json options{{"contrasts", json::parse(R"([["h_g+f_g", "h"], ["h&f@fast", "h_g&f_g"]])")}};
        const json answer = answerTo("claims", rows, options);
        QCOMPARE(answer["claims"].size(), std::size_t(4));
        QVERIFY(answer["claims"][0]["a"] == "h_g&f_g" && answer["claims"][2]["a"] == "h+f@fast");
        QVERIFY(says(answerTo("claims", rows, {{"contrasts", json::parse(R"([["h_g&f_g", "h_g+f_g"]])")}}), "error",
                     "compares \"h_g&f_g\" with itself"));
        QVERIFY(says(answerTo("claims", rows, {{"contrasts", json::parse(R"([["h", "h_g&f_g"], ["h_g+f_g", "h"]])")}}), "error",
                     "would count twice in Holm's correction"));
    }

    /// Under condition "a" one of the two low fabrics is missing for each person. All conditions are alike.
    void missingCellsAreNoDifferenceOfConditions()
    {
        json missing, common;
        for (int p = 0; p < 10; ++p)
            for (int f = 0; f < 5; ++f)
                for (int c = 0; c < 3; ++c) {
                    const bool isLeftOut = f == p % 2;
                    if (!isLeftOut || c > 0) addRating(missing, p, f, c, ratingOf(p, f, c));
                    if (!isLeftOut) addRating(common, p, f, c, ratingOf(p, f, c));
                }
        const json answer = answerTo("claims", missing)["omnibus"][0], expected = answerTo("claims", common)["omnibus"][0];
        QVERIFY(answer["p"].get<double>() > 0.05);
        for (const char* number : {"statistic", "df1", "df2", "p"}) QVERIFY(near(answer[number], expected[number].get<double>()));
    }

    /// As in a report: a cell counts once, by its mean, for these fabrics and for fabrics like these.
    void repetitionsOfACellAreAveragedBeforeTheOmnibusTests()
    {
        json repeated, means;
        for (int p = 0; p < 8; ++p)
            for (int f = 0; f < 5; ++f)
                for (int c = 0; c < 3; ++c) {
                    const double first = ratingOf(p, f, c), second = ratingOf(p, f, c, 1);
                    addRating(repeated, p, f, c, first);
                    addRating(repeated, p, f, c, second);
                    addRating(means, p, f, c, (first + second) / 2);
                }
        QVERIFY(haveSameOmnibus(answerTo("claims", repeated), answerTo("claims", means)));
    }

    void claimsOfChoicesAboveChanceAndLeftOut()
    {
        const json options{{"chance", "1/3"}, {"contrasts", json::parse(R"([["c2", "c0"]])")}, {"leave_one_out", true}};
        json rows = rowsOf("correct");
        rows["value"] = rows["correct"];
        rows.erase("correct");
        const json answer = answerTo("claims", rows, options);
        QCOMPARE(answer["claims"].size(), std::size_t(2));
        QCOMPARE(answer["claims"][0]["without_fabric"].size(), std::size_t(5));
        QCOMPARE(answer["claims"][1]["without_participant"].size(), std::size_t(8));
        QVERIFY(answer["claims"][0]["p_equivalence"].is_null() && answer["claims"][0]["why"].contains("p_equivalence"));
        QCOMPARE(answer["above_chance"].size(), std::size_t(6));
        const json& last = answer["above_chance"][4];
        QVERIFY(last["condition"] == "c2" && last["generalises_to"] == "these_fabrics" && near(last["p"], 0.000927580885172));
        QVERIFY(last["above"].get<bool>());
    }

    void crossedMeanWithBounds()
    {
        // tests/stats/reference/mixed_models.py, crossed.
        const json inputs{{"value", {1.2, 0.4, -0.3, 2.1, 1.9, 0.2, 0.3, 0.8, -1.1, 1.6, 0.1, 0.7}},
                          {"participant", {1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4}},
                          {"fabric", {"a", "b", "c", "a", "b", "c", "a", "b", "c", "a", "b", "c"}}};
        const json answer = answerTo("crossed_mean", inputs, {{"bounds", {-3, 3}}});
        QVERIFY(near(answer["estimate"], 0.658333333333333) && near(answer["se"], 0.481101167462035));
        QVERIFY(near(answer["df"], 2.99159844981462) && near(answer["t"], 0.658333333333333 / 0.481101167462035));
        QVERIFY(answer["p_equivalence"].get<double>() < 0.02 && !answer["singular"].get<bool>());
        const json these = answerTo("crossed_mean", inputs, {{"generalises_to", "these_fabrics"}, {"alternative", "greater"}});
        QVERIFY(near(these["df"], 3) && these["p"].get<double>() < 0.5);
    }

    void twoWayAnovaOfThreeDesigns()
    {
        const json value{4.1, 5.3, 3.8, 6.2, 7.1, 5.9, 8.4, 2.9, 3.5, 6.6, 7.7, 7.2, 9.1, 8.8};
        json inputs{{"value", value}, {"a", json::array()}, {"b", json::array()}};
        for (const char letter : std::string("xxxxxxxzzzzzzz")) inputs["a"].push_back(std::string(1, letter));
        for (const char letter : std::string("pppqqrrppqqqrr")) inputs["b"].push_back(std::string(1, letter));
        const json between = answerTo("two_way_anova", inputs, {{"design", "between"}, {"ss_type", "II"}});
        QVERIFY(near(between["a"]["ss"], 0.2824705882) && near(between["b"]["F"], 29.21831) && near(between["a:b"]["df2"], 8));
        QCOMPARE(between["ss_type"].get<std::string>(), std::string("II"));
        const json three = answerTo("two_way_anova", inputs, {{"design", "between"}});
        QVERIFY(three["ss_type"] == "III" && near(three["a"]["ss"], 0.467604167));

        json within = rowsOf("value");
        within = {{"value", within["value"]},
                  {"a", within["condition"]},
                  {"b", within["fabric"]},
                  {"participant", within["participant"]}};
        const json both = answerTo("two_way_anova", within, {{"design", "within"}});
        QVERIFY(near(both["a:b"]["df1"], 8) && near(both["a:b"]["df2"], 56) && both["b"]["p_gg"].is_number());
        QVERIFY(both["ss_type"].is_null() && both["participants"] == 8);
        for (std::size_t row = 0; row < 120; ++row) within["a"][row] = row < 45 ? "few" : "many";
        const json mixed = answerTo("two_way_anova", within, {{"design", "mixed"}});
        QVERIFY(near(mixed["a"]["df2"], 6) && near(mixed["a:b"]["df2"], 24) && mixed["b"]["eta2_generalized"].is_number());
    }

    void psychometricFunction()
    {
        const json inputs{
            {"level", {0.5, 1, 1.5, 2, 2.5, 3}}, {"k", {14, 18, 22, 31, 37, 40}}, {"n", {40, 40, 40, 40, 40, 40}}, {"m", 3}};
        const json answer = answerTo("mafc_probit", inputs, {{"threshold_at", 0.75}});
        QVERIFY(near(answer["mu"], 1.729804915200) && near(answer["se_sigma"], 0.109127617195));
        QVERIFY(near(answer["threshold"], 1.917781507722) && near(answer["p_deviance"], 0.859941518899));
        QVERIFY(near(answer["mu_profile_high"], 1.941279865766) && answer["fitted"].size() == 6);
        const json free = answerTo("mafc_probit", inputs, {{"lapse", "estimate"}});
        QVERIFY(free["lapse_at_limit"].get<bool>() && free["why"].contains("se_lapse"));
    }

    void whatIsNotDefinedSaysWhy()
    {
        const json one{{"value", {1, 2}}, {"condition", {"a", "b"}}, {"participant", {1, 1}}, {"fabric", {1, 1}}};
        const json claims = answerTo("claims", one);
        QVERIFY(claims["claims"][0]["p"].is_null() && claims["claims"][0]["why"]["p"].is_string());
        QVERIFY(claims["claims"][0]["verdict"] == "not_decided");
        QVERIFY(answerTo("linear_mixed", one).contains("reason"));
        json same = rowsOf("value");
        for (json& value : same["value"]) value = 10;
        QVERIFY(says(answerTo("linear_mixed", same), "reason", "no variation left"));
        QVERIFY(says(answerTo("logistic_mixed", {{"correct", {1, 1}}, {"condition", {"a", "b"}}, {"participant", {1, 2}}}),
                     "reason", ""));
        QVERIFY(says(answerTo("crossed_mean", {{"value", {1, 2}}, {"participant", {1, 1}}, {"fabric", {1, 2}}}), "reason",
                     "one participant"));
        QVERIFY(says(answerTo("mafc_probit", {{"level", {1, 2}}, {"k", {5, 5}}, {"n", {5, 5}}, {"m", 2}}), "reason",
                     "all choices are correct"));
        const json flat{{"value", {1, 1, 1, 1}}, {"a", {1, 1, 2, 2}}, {"b", {1, 2, 1, 2}}};
        QVERIFY(says(answerTo("two_way_anova", flat, {{"design", "between"}}), "reason", "one value in each cell"));
    }

    void misspeltNamesAreErrors_data()
    {
        QTest::addColumn<QByteArray>("analysis");
        QTest::addColumn<QByteArray>("inputs");
        QTest::addColumn<QByteArray>("options");
        QTest::addColumn<QString>("words");
        QTest::newRow("input") << QByteArray("crossed_mean") << QByteArray(R"({"valu": [1], "participant": [1], "fabric": [1]})")
                               << QByteArray("{}") << "no value, but \"valu\"; expected: value, participant, fabric";
        QTest::newRow("input that may be absent")
            << QByteArray("wilcoxon_signed_rank") << QByteArray(R"({"x": [1, 2], "yy": [2, 1]})") << QByteArray("{}")
            << "unknown name \"yy\" in the inputs; expected: x, [y]";
        QTest::newRow("option") << QByteArray("t_test") << QByteArray(R"({"kind": "one_sample", "x": [1, 2, 3]})")
                                << QByteArray(R"({"alternativ": "less"})")
                                << "unknown name \"alternativ\" in the options; expected: [mu], [alternative], [conf_level]";
        QTest::newRow("required option") << QByteArray("tost") << QByteArray(R"({"kind": "one_sample", "x": [1, 2, 3]})")
                                         << QByteArray(R"({"low": -1})")
                                         << "the options have no high; expected: low, high, [alpha]";
        QTest::newRow("condition") << QByteArray("claims")
                                   << QByteArray(R"({"value": [1, 2], "condition": ["a", "b"], "participant": [1, 1]})")
                                   << QByteArray(R"({"contrasts": [["a", "B"]]})") << "\"B\", which is no condition";
        QTest::newRow("length") << QByteArray("claims")
                                << QByteArray(R"({"value": [1, 2], "condition": ["a"], "participant": [1, 1]})")
                                << QByteArray("{}") << "condition has 1 values and value has 2";
        QTest::newRow("label") << QByteArray("claims")
                               << QByteArray(R"({"value": [1, 2], "condition": ["a", null], "participant": [1, 1]})")
                               << QByteArray("{}") << "value 2 of condition is not a label";
        QTest::newRow("bounds") << QByteArray("claims")
                                << QByteArray(R"({"value": [1, 2], "condition": ["a", "b"], "participant": [1, 1]})")
                                << QByteArray(R"({"bounds": [1, -1]})") << "bounds must be [low, high]";
        QTest::newRow("design") << QByteArray("two_way_anova") << QByteArray(R"({"value": [1], "a": [1], "b": [1]})")
                                << QByteArray(R"({"design": "crossed"})") << "expected one of: between, within, mixed";
    }

    void misspeltNamesAreErrors()
    {
        QFETCH(QByteArray, analysis);
        QFETCH(QByteArray, inputs);
        QFETCH(QByteArray, options);
        QFETCH(QString, words);
        QVERIFY(says(answerTo(analysis.constData(), json::parse(inputs.toStdString()), json::parse(options.toStdString())),
                     "error", words));
    }

    void remarksBesideAllInputsAreAllowed()
    {
        const json answer = answerTo("mcnemar", {{"b", 1}, {"c", 9}, {"source", "a paper"}});
        QVERIFY(answer["p_exact"].is_number());
    }

    void everyAnalysisIsListedAndDocumented()
    {
        QFile readme(VIS2HAP_SOURCE_DIR "/README.md");
        QVERIFY(readme.open(QIODevice::ReadOnly));
        const QString text = QString::fromUtf8(readme.readAll()), list = QString::fromStdString(study::analyse::listOfAnalyses());
        for (const auto& analysis : study::analyse::analyses()) {
            const QString name = QString::fromUtf8(analysis.name.data(), static_cast<qsizetype>(analysis.name.size()));
            QVERIFY2(list.contains(name + ": "), qPrintable(name));
            QVERIFY2(text.contains("`" + name + "`"), qPrintable(name));
        }
        QVERIFY(list.contains("t_test: t test: one_sample, paired, student or welch\n    inputs: kind, x, [y]\n"));
    }

    void tenThousandRowsAreFine()
    {
        json rows{
            {"value", json::array()}, {"condition", json::array()}, {"participant", json::array()}, {"fabric", json::array()}};
        unsigned state = 1;
        for (int row = 0; row < 10000; ++row) {
            state = state * 1664525u + 1013904223u;
            rows["value"].push_back((state >> 16) % 11);
            rows["condition"].push_back(row % 5);
            rows["participant"].push_back(row / 50);
            rows["fabric"].push_back(row / 5 % 10);
        }
        QVERIFY(answerTo("claims", rows)["claims"].size() == 20);
        const json within{
            {"value", rows["value"]}, {"a", rows["condition"]}, {"b", rows["fabric"]}, {"participant", rows["participant"]}};
        QVERIFY(answerTo("two_way_anova", within, {{"design", "within"}})["a:b"]["p"].is_number());
        QVERIFY(answerTo("two_way_anova", within, {{"design", "between"}})["a:b"]["p"].is_number());
    }
};

QTEST_GUILESS_MAIN(AnalyseFamiliesTest)
#include "analyse_families_test.moc"
