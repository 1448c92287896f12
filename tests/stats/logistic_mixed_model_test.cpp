// The logistic mixed model against a second program, closed forms and R, and where the likelihood has no maximum.
#include "stats/models/logistic_mixed_model.h"

#include <QTest>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "stats/models/crossed_study.h"
#include "stats/models/random_columns.h"
#include "stats/power/simulated_study.h"
#include "tests/stats/cycled_factor.h"
#include "tests/stats/exact_numbers.h"
#include "tests/stats/shared_study.h"

namespace {

bool near(double a, double b, double relative) { return std::fabs(a - b) <= relative * std::max(std::fabs(a), std::fabs(b)); }

void compare(const stats::Value& value, double expected, double relative, const std::string& what)
{
    QVERIFY2(value.exists(), (what + ": " + value.why()).c_str());
    QVERIFY2(near(*value, expected, relative),
             qPrintable(QString("%1: %2, expected %3").arg(what.c_str()).arg(*value, 0, 'g', 12).arg(expected, 0, 'g', 12)));
}

/// Five people, four fabrics, three conditions: every cell once.
stats::LogisticData smallStudy()
{
    return {{1, 0, 1, 1, 0, 1, 1, 1, 1, 0, 0, 1, 1, 1, 1, 1, 0, 0, 1, 1, 1, 1, 1, 1, 0, 0, 0, 1, 0, 0,
             1, 0, 1, 0, 0, 0, 1, 1, 1, 1, 1, 0, 1, 1, 0, 0, 1, 1, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1},
            cycled("c", 3, 1, 60),
            {cycled("p", 5, 12, 60), cycled("f", 4, 3, 60)}};
}

void answerAll(stats::LogisticData& data, std::size_t condition, double right)
{
    for (std::size_t row = 0; row < data.right.size(); ++row)
        if (data.condition.of[row] == condition) data.right[row] = right;
}

}  // namespace

class LogisticMixedModelTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void peopleAlikeLeaveAPlainTable()
    {
        // All people answer alike, so that the groups have no variance: log odds of 12/20, 8/20 and 15/20, and
        // the likelihood ratio is the G test of the table (R: 2*sum(O*log(O/E)) = 5.3086...).
        stats::LogisticData data{{}, cycled("c", 3, 1, 60), {cycled("p", 4, 15, 60)}};
        // Right answers of each person among five under each condition.
        const int right[4][3] = {{3, 2, 4}, {3, 2, 4}, {3, 2, 4}, {3, 2, 3}};
        for (int p = 0; p < 4; ++p)
            for (int i = 0; i < 5; ++i)
                for (int c = 0; c < 3; ++c) data.right.push_back(i < right[p][c] ? 1 : 0);
        const auto model = stats::fitLogisticMixedModel(data);
        QVERIFY(model.singular && model.random[0].zero);
        compare(model.fixed[0].estimate, std::log(12.0 / 8), 1e-9, "intercept");
        compare(model.fixed[0].se, std::sqrt(1.0 / 12 + 1.0 / 8), 1e-6, "its se");
        compare(model.fixed[1].estimate, std::log(8.0 / 12) - std::log(12.0 / 8), 1e-9, "second");
        compare(model.fixed[2].se, std::sqrt(1.0 / 15 + 1.0 / 5 + 1.0 / 12 + 1.0 / 8), 1e-6, "se of the third");
        double g = 0;
        for (const double count : {12.0, 8.0, 15.0})
            g += 2 * (count * std::log(count / (35.0 / 3)) + (20 - count) * std::log((20 - count) / (25.0 / 3)));
        compare(model.chiSquared, g, 1e-9, "G");
    }

    void aConditionAlwaysRightIsSaidAndTheRestIsFitted()
    {
        auto data = smallStudy();
        answerAll(data, 2, 1);
        const auto model = stats::fitLogisticMixedModel(data);
        QVERIFY(model.separation == stats::Separation::Quasi);
        QCOMPARE(model.separationWhy, std::string("quasi-complete separation: 3 (always right)"));
        QVERIFY(model.why.empty() && model.fixed[1].p.exists());
        QVERIFY(!model.fixed[2].estimate.exists() && !model.fixed[2].p.exists());
        QVERIFY(model.fixed[2].p.why().find("3 (always right)") != std::string::npos);
        // The likelihood tends to that of the study without this condition.
        stats::LogisticData two{{}, {"c", {"1", "2"}, {}}, {{"p", data.groups[0].levels, {}}, {"f", data.groups[1].levels, {}}}};
        for (std::size_t row = 0; row < data.right.size(); ++row) {
            if (data.condition.of[row] == 2) continue;
            two.right.push_back(data.right[row]);
            two.condition.of.push_back(data.condition.of[row]);
            for (std::size_t g = 0; g < 2; ++g) two.groups[g].of.push_back(data.groups[g].of[row]);
        }
        const auto rest = stats::fitLogisticMixedModel(two);
        compare(model.logLikelihood, *rest.logLikelihood, 1e-12, "log likelihood");
        compare(model.fixed[1].estimate, *rest.fixed[1].estimate, 1e-12, "second condition");
        QVERIFY(model.p.exists() && *model.df == 2);
    }

    void aSeparatedReferenceLeavesNoDifference()
    {
        auto data = smallStudy();
        answerAll(data, 0, 0);
        const auto model = stats::fitLogisticMixedModel(data);
        QVERIFY(model.separation == stats::Separation::Quasi);
        for (const auto& effect : model.fixed) QVERIFY(!effect.estimate.exists() && !effect.p.why().empty());
        QVERIFY(model.logLikelihood.exists() && model.random[0].sd.exists());
    }

    void completeSeparationIsSaid()
    {
        auto data = smallStudy();
        for (const std::size_t condition : {0U, 1U, 2U}) answerAll(data, condition, condition == 1 ? 1 : 0);
        const auto model = stats::fitLogisticMixedModel(data);
        QVERIFY(model.separation == stats::Separation::Complete);
        QVERIFY(
            QString::fromStdString(model.separationWhy).startsWith("complete separation: 1 (always wrong), 2 (always right)"));
        QCOMPARE(*model.logLikelihood, 0.0);
        QVERIFY(!model.random[0].sd.exists());
        for (const auto& effect : model.fixed) QVERIFY(!effect.p.exists());
    }

    void refusalsSayWhy_data()
    {
        QTest::addColumn<QString>("kind");
        QTest::addColumn<QString>("why");
        QTest::addRow("nothing") << "nothing"
                                 << "no choices";
        QTest::addRow("all missing") << "missing"
                                     << "no choices";
        QTest::addRow("all right") << "right"
                                   << "every choice was right";
        QTest::addRow("all wrong") << "wrong"
                                   << "every choice was wrong";
        QTest::addRow("half a choice") << "half"
                                       << "neither right";
        QTest::addRow("one condition") << "one"
                                       << "one condition";
        QTest::addRow("one person") << "person"
                                    << "belong to one p";
        QTest::addRow("by person") << "by person"
                                   << "no finite estimate";
    }

    void refusalsSayWhy()
    {
        QFETCH(QString, kind);
        QFETCH(QString, why);
        auto data = smallStudy();
        if (kind == "nothing") data = {{}, {"c", {}, {}}, {}};
        if (kind == "missing") std::fill(data.right.begin(), data.right.end(), std::nan(""));
        if (kind == "right") std::fill(data.right.begin(), data.right.end(), 1.0);
        if (kind == "wrong") std::fill(data.right.begin(), data.right.end(), 0.0);
        if (kind == "half") data.right[5] = 0.5;
        if (kind == "one") data.condition = cycled("c", 1, 1, 60);
        if (kind == "person") data.groups[0] = cycled("p", 1, 1, 60);
        if (kind == "by person") {
            // The person determines every choice, with two exceptions.
            for (std::size_t row = 0; row < data.right.size(); ++row) data.right[row] = data.groups[0].of[row] < 2 ? 1 : 0;
            answerAll(data, 2, 0);
            data.right[2] = data.right[14] = 1;
        }
        const auto model = stats::fitLogisticMixedModel(data);
        QVERIFY2(QString::fromStdString(model.why).contains(why), model.why.c_str());
        QVERIFY(!model.p.exists() && !model.p.why().empty() && !model.logLikelihood.exists());
        for (const auto& effect : model.fixed) QVERIFY(!effect.p.exists());
    }

    void missingChoicesAndOrderChangeNothing()
    {
        auto data = smallStudy();
        const auto plain = stats::fitLogisticMixedModel(data);
        stats::LogisticData turned{
            {}, {"c", data.condition.levels, {}}, {{"p", data.groups[0].levels, {}}, {"f", data.groups[1].levels, {}}}};
        for (std::size_t row = data.right.size(); row-- > 0;) {
            turned.right.push_back(data.right[row]);
            turned.condition.of.push_back(data.condition.of[row]);
            for (std::size_t g = 0; g < 2; ++g) turned.groups[g].of.push_back(data.groups[g].of[row]);
        }
        turned.right.push_back(std::nan(""));
        turned.condition.of.push_back(1);
        for (auto& group : turned.groups) group.of.push_back(0);
        const auto other = stats::fitLogisticMixedModel(turned);
        QCOMPARE(other.missing, std::size_t(1));
        compare(other.logLikelihood, *plain.logLikelihood, 1e-10, "log likelihood");
        compare(other.fixed[2].estimate, *plain.fixed[2].estimate, 1e-5, "estimate");
        compare(other.fixed[2].se, *plain.fixed[2].se, 1e-5, "se");
    }

    void manyDrawnStudiesAllHaveAFit()
    {
        const stats::StudyDesign design{6, 5, 4, 3};
        int singular = 0;
        for (std::uint64_t seed = 0; seed < 200; ++seed) {
            stats::Draws draws(seed, 1);
            auto study = stats::emptyStudy(design);
            stats::drawChoices(study, {0.6, 0.3}, std::vector<double>{-0.5, 0, 0.5, 2.5}, draws);
            const auto fit = stats::fitChoices(study).model;
            QVERIFY2(fit.why.empty(), fit.why.c_str());
            QVERIFY(*fit.chiSquared >= 0 && *fit.p >= 0 && *fit.p <= 1);
            singular += fit.singular ? 1 : 0;
        }
        QVERIFY(singular > 10 && singular < 190);  // both kinds occurred
    }

    void sharedStudiesAgreeWithR_data()
    {
        QTest::addColumn<QString>("name");
        for (const char* name : {"study_a", "study_missing_a"}) QTest::addRow("%s", name) << name;
    }

    void sharedStudiesAgreeWithR()
    {
        QFETCH(QString, name);
        const auto rows = shared::readCsv(shared::studyFolder() / (name + ".csv").toStdString());
        if (rows.empty()) QSKIP("the shared studies are missing: nothing was compared with glmer (set VIS2HAP_SHARED)");
        const auto expected = shared::expected(name.toStdString())["q1_glmm"];
        const auto model = stats::fitChoices(shared::study(rows, 3)).model;
        for (const auto& effect : model.fixed) {
            compare(effect.estimate, expected["fixef"][effect.name], 1e-3, effect.name);
            compare(effect.se, expected["se"][effect.name], 1e-3, "se of " + effect.name);
        }
        compare(model.random[0].sd, expected["sd_participant"], 1e-3, "participants");
        compare(model.random[1].sd, expected["sd_fabric"], 1e-3, "fabrics");
        // glmer stops one step before the mode, and therefore below the maximum of Laplace's approximation.
        compare(model.logLikelihood, expected["logLik"], 1e-7, "log likelihood");
        QVERIFY(*model.logLikelihood >= expected["logLik"].get<double>() - 1e-9);
        compare(model.chiSquared, expected["lrt_chi2"], 1e-3, "chi-squared");
        compare(model.df, expected["lrt_df"], 0, "df");
        compare(model.p, expected["lrt_p"], 1e-3, "p");
        QVERIFY(model.separation == stats::Separation::None);
    }

    // /usr/bin/python3 tests/stats/reference/logistic_mixed_model.py
    void everyNumberOfTheSmallStudy_data()
    {
        QTest::addColumn<int>("groups");
        QTest::addColumn<std::vector<double>>("sds");
        QTest::addColumn<std::vector<double>>("effects");  // estimate, standard error and p of each
        QTest::addColumn<std::vector<double>>("test");     // log likelihoods, chi-squared, p
        QTest::newRow("people and fabrics") << 2 << std::vector<double>{0.88684046333786, 0.624616373985511}
                                            << std::vector<double>{0.497864315258087,  0.715928045708035, 0.486797701468924,
                                                                   -0.503728856378753, 0.70949974447351,  0.477718087652264,
                                                                   0.263427297449061,  0.72101896712788,  0.714847035565107}
                                            << std::vector<double>{-38.2438576287715, -38.8351382193338, 1.18256118112449,
                                                                   0.553617872775359};
        QTest::newRow("people") << 1 << std::vector<double>{0.770559066268709}
                                << std::vector<double>{0.457727941549059,  0.596960241496725, 0.443221526362908,
                                                       -0.462590393545744, 0.681855165248155, 0.497499656613169,
                                                       0.242578872488903,  0.695106175761425, 0.727103547631937}
                                << std::vector<double>{-38.8720004326782, -39.4167771863155, 1.08955350727452, 0.579971245359368};
    }

    void everyNumberOfTheSmallStudy()
    {
        QFETCH(int, groups);
        QFETCH(std::vector<double>, sds);
        QFETCH(std::vector<double>, effects);
        QFETCH(std::vector<double>, test);
        auto data = smallStudy();
        data.groups.resize(static_cast<std::size_t>(groups));
        const auto model = stats::fitLogisticMixedModel(data, {.confidence = 0.9, .curvature = stats::Curvature::AtOneStep});
        QCOMPARE(model.rows, std::size_t{60});
        // The covariance is computed before the last Newton step, at a distance of about 1e-5.
        for (std::size_t g = 0; g < sds.size(); ++g) compareNumbers({{"sd", model.random[g].sd, sds[g], 1e-6}});
        const double z = 1.64485362695147;  // R: qnorm(.95)
        for (std::size_t i = 0; i < 3; ++i) {
            const auto& one = model.fixed[i];
            const double estimate = effects[3 * i], se = effects[3 * i + 1], p = effects[3 * i + 2];
            compareNumbers({{"estimate", one.estimate, estimate, 1e-6},
                            {"se", one.se, se, 2e-5},
                            {"z", one.z, estimate / se, 2e-5},
                            {"p", one.p, p, 2e-5},
                            {"log p", one.logP, std::log(p), 1e-4},
                            {"low", one.ci.low, estimate - z * se, 3e-5},
                            {"high", one.ci.high, estimate + z * se, 3e-5},
                            {"variance", model.covariance(i, i), se * se, 5e-5}});
        }
        compareNumbers({{"log likelihood", model.logLikelihood, test[0]},
                        {"without condition", model.logLikelihoodNull, test[1]},
                        {"chi-squared", model.chiSquared, test[2], 1e-10},
                        {"df", model.df, 2},
                        {"p", model.p, test[3], 1e-10},
                        {"log p", model.logP, std::log(test[3]), 1e-10}});
    }

    void theCheapestBlocksAreTaken_data()
    {
        QTest::addColumn<int>("participants");
        QTest::addColumn<int>("conditions");
        QTest::addColumn<int>("blocks");
        QTest::addColumn<int>("border");
        QTest::newRow("participants") << 50 << 3 << 50 << 4 + 4 * 3;
        QTest::newRow("conditions") << 5 << 40 << 40 << 5 + 4;
    }

    /// Participants or conditions are the blocks, whichever are more; fabrics are four.
    void theCheapestBlocksAreTaken()
    {
        QFETCH(int, participants);
        QFETCH(int, conditions);
        QFETCH(int, blocks);
        QFETCH(int, border);
        const auto p = static_cast<std::size_t>(participants), c = static_cast<std::size_t>(conditions), rows = p * 4 * c;
        const auto people = cycled("p", p, 4 * c, rows), fabrics = cycled("f", 4, c, rows), condition = cycled("c", c, 1, rows);
        const std::vector<stats::Factor> groups{people, fabrics, stats::interactionOf(people, condition),
                                                stats::interactionOf(fabrics, condition)};
        const stats::RandomColumns columns(groups, rows);
        QCOMPARE(columns.count(), p + 4 + p * c + 4 * c);
        QCOMPARE(columns.shape().blocks(), static_cast<std::size_t>(blocks));
        QCOMPARE(columns.shape().border(), static_cast<std::size_t>(border));
    }

    void manyParticipantsHaveTheCrossedModel()
    {
        auto study = stats::emptyStudy({150, 3, 4, 3});
        stats::Draws draws(1, 1);
        stats::drawChoices(study, {0.6, 0.3}, std::vector<double>{-0.5, 0, 0.5, 1}, draws);
        const auto fit = stats::fitChoices(study, stats::ChoiceTerms::WithInteractions);
        QVERIFY2(fit.model.why.empty(), fit.model.why.c_str());
        QCOMPARE(fit.model.random.size(), std::size_t{4});
    }

    void aFitThatTakesTooLongIsRefused()
    {
        // 800 people who meet five of 800 fabrics, other neighbours in each round: nothing falls apart into small blocks.
        const std::size_t rows = 4000;
        stats::LogisticData data{{}, cycled("c", 2, 1, rows), {cycled("p", 800, 5, rows), cycled("f", 800, 1, rows)}};
        for (std::size_t row = 0; row < rows; ++row) data.groups[1].of[row] = (row + row / 800 * 3) % 800;
        for (std::size_t row = 0; row < rows; ++row) data.right.push_back(row % 3 == 0 ? 1 : 0);
        const auto model = stats::fitLogisticMixedModel(data);
        QVERIFY2(model.why.find("million multiplications; at most 100 million") != std::string::npos, model.why.c_str());
        QVERIFY(!model.p.exists());
    }

    // No groups: the proportions of the conditions, 1200 choices. Sum of k log p + (n - k) log(1 - p).
    void withoutGroupsItIsATableOfProportions()
    {
        stats::LogisticData data{{}, cycled("c", 2, 1, 1200), {}};
        for (std::size_t i = 0; i < 600; ++i) {
            data.right.push_back(i % 4 == 0 ? 0 : 1);  // 450 of 600
            data.right.push_back(i % 3 == 0 ? 1 : 0);  // 200 of 600
        }
        const auto model = stats::fitLogisticMixedModel(data);
        const auto part = [](double k, double n) { return k * std::log(k / n) + (n - k) * std::log(1 - k / n); };
        const double se = std::sqrt(1.0 / 450 + 1.0 / 150),
                     seOfDifference = std::sqrt(1.0 / 450 + 1.0 / 150 + 1.0 / 200 + 1.0 / 400);
        compareNumbers({{"intercept", model.fixed[0].estimate, std::log(3.0), 1e-9},
                        {"its se", model.fixed[0].se, se, 1e-7},
                        {"difference", model.fixed[1].estimate, std::log(0.5) - std::log(3.0), 1e-9},
                        {"its se", model.fixed[1].se, seOfDifference, 1e-7},
                        {"covariance", model.covariance(0, 1), -se * se, 1e-7},
                        {"covariance", model.covariance(1, 0), -se * se, 1e-7},
                        {"log likelihood", model.logLikelihood, part(450, 600) + part(200, 600)},
                        {"without condition", model.logLikelihoodNull, part(650, 1200)}});
        QVERIFY(model.evaluations > 0 && !model.singular && model.random.empty());
    }
};

QTEST_GUILESS_MAIN(LogisticMixedModelTest)
#include "logistic_mixed_model_test.moc"
