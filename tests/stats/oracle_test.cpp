// Every family of the shared reference cases that the module computes, with the digits they ask for.
#include <QtTest>

#include "stats/binomial.h"
#include "stats/equivalence.h"
#include "stats/image_metrics.h"
#include "stats/multiplicity.h"
#include "stats/rank_tests.h"
#include "stats/repeated_measures.h"
#include "stats/t_tests.h"
#include "stats/trace_error.h"
#include "stats/wilcoxon.h"
#include "tests/stats/oracle_cases.h"

using oracle::Answer;
using oracle::Json;

namespace {

struct Reply {
    Answer answer;
    std::string why;
    QString more;  ///< faults that are not numbers
};

stats::Tail tailOf(const Json& options)
{
    const auto name = options.value("alternative", std::string("two-sided"));
    return name == "less" ? stats::Tail::Less : name == "greater" ? stats::Tail::Greater : stats::Tail::TwoSided;
}

stats::TKind kindOf(const Json& inputs)
{
    const auto kind = inputs["kind"].get<std::string>();
    if (kind == "paired") return stats::TKind::Paired;
    if (kind == "student") return stats::TKind::Student;
    return kind == "welch" ? stats::TKind::Welch : stats::TKind::OneSample;
}

std::vector<double> secondOf(const Json& inputs)
{
    return inputs.contains("y") ? oracle::numbers(inputs["y"]) : std::vector<double>();
}

Reply tTest(const Json& one)
{
    const auto x = oracle::numbers(one["inputs"]["x"]);
    const auto y = secondOf(one["inputs"]);
    const stats::TOptions options{oracle::number(one["options"]["mu"]), tailOf(one["options"]),
                                  one["options"].value("conf_level", 0.95)};
    const auto t = stats::tTest(kindOf(one["inputs"]), x, y, options);
    return {{{"estimate", t.estimate},
             {"sd", t.sd},
             {"se", t.se},
             {"t", t.t},
             {"df", t.df},
             {"p", t.p},
             {"log_p", t.logP},
             {"ci_low", t.ci.low},
             {"ci_high", t.ci.high},
             {"d_z", t.dZ},
             {"hedges_g_z", t.hedgesGz},
             {"d_av_lakens", t.dAvLakens},
             {"d_av_rms", t.dAvRms},
             {"d_s", t.dS},
             {"hedges_g_s", t.hedgesGs}},
            t.why,
            {}};
}

Reply tost(const Json& one)
{
    const auto x = oracle::numbers(one["inputs"]["x"]);
    const auto y = secondOf(one["inputs"]);
    const stats::EquivalenceOptions options{oracle::number(one["options"]["low"]), oracle::number(one["options"]["high"]),
                                            one["options"].value("alpha", 0.05)};
    const auto t = stats::equivalenceTest(kindOf(one["inputs"]), x, y, options);
    QString more;
    const Json& expected = one.value("expected", Json::object());
    if (expected.contains("verdict") && expected["verdict"] != t.verdict())
        more = "verdict " + QString::fromStdString(t.verdict());
    if (expected.contains("equivalent") && expected["equivalent"].get<bool>() != t.equivalent) more += " equivalent";
    return {{{"estimate", t.estimate},
             {"se", t.se},
             {"df", t.df},
             {"t_lower", t.tLower},
             {"p_lower", t.pLower},
             {"t_upper", t.tUpper},
             {"p_upper", t.pUpper},
             {"p_tost", t.p},
             {"ci_low", t.ci.low},
             {"ci_high", t.ci.high},
             {"nhst_t", t.tDifference},
             {"nhst_p", t.pDifference}},
            t.why,
            more};
}

Reply wilcoxon(const Json& one)
{
    const auto x = oracle::numbers(one["inputs"]["x"]);
    const auto y = secondOf(one["inputs"]);
    stats::WilcoxonOptions options;
    options.tail = tailOf(one["options"]);
    options.zeros = one["options"]["zero_method"] == "pratt" ? stats::ZeroMethod::Pratt : stats::ZeroMethod::Wilcox;
    options.arithmetic = one["options"].value("arithmetic", "double") == std::string("decimal") ? stats::Arithmetic::Decimal
                                                                                                : stats::Arithmetic::Double;
    const auto w = stats::wilcoxonSignedRank(x, y, options);
    return {{{"n_used", static_cast<double>(w.nUsed)},
             {"n_zero", static_cast<double>(w.nZero)},
             {"V", w.v},
             {"p_exact", w.pExact},
             {"log_p_exact", w.logPExact},
             {"z", w.z},
             {"p_normal", w.pNormal},
             {"z_cc", w.zCorrected},
             {"p_normal_cc", w.pNormalCorrected},
             {"rank_biserial", w.rankBiserial},
             {"hodges_lehmann", w.hodgesLehmann}},
            w.why,
            {}};
}

double chanceOf(const Json& p0)
{
    if (p0.is_number()) return p0.get<double>();
    const auto text = p0.get<std::string>();
    const auto slash = text.find('/');
    return oracle::number(Json(text.substr(0, slash))) / oracle::number(Json(text.substr(slash + 1)));
}

Reply binomial(const Json& one)
{
    const auto b = stats::binomialTest(one["inputs"]["k"].get<long long>(), one["inputs"]["n"].get<long long>(),
                                       chanceOf(one["options"]["p0"]), one["options"].value("conf_level", 0.95));
    return {{{"p_greater", b.pGreater},
             {"log_p_greater", b.logPGreater},
             {"p_less", b.pLess},
             {"p_two_sided_minlike", b.pTwoSided},
             {"p_mid_greater", b.pMidGreater},
             {"estimate", b.estimate},
             {"cp_low", b.clopperPearson.low},
             {"cp_high", b.clopperPearson.high},
             {"wilson_low", b.wilson.low},
             {"wilson_high", b.wilson.high}},
            b.why,
            {}};
}

Reply friedman(const Json& one)
{
    const auto f = stats::friedmanTest(stats::blockTableOf(oracle::rows(one["inputs"]["rows"])).table);
    return {{{"Q", f.q},
             {"df", f.df},
             {"p", f.p},
             {"log_p", f.logP},
             {"kendall_w", f.kendallW},
             {"iman_davenport_F", f.imanDavenportF},
             {"F_df1", f.fDf1},
             {"F_df2", f.fDf2},
             {"F_p", f.fP}},
            f.why,
            {}};
}

Reply cochran(const Json& one)
{
    const auto c = stats::cochranTest(stats::blockTableOf(oracle::rows(one["inputs"]["rows"])).table);
    return {{{"Q", c.q}, {"df", c.df}, {"p", c.p}, {"log_p", c.logP}}, c.why, {}};
}

Reply rmAnova(const Json& one)
{
    const auto a = stats::repeatedMeasuresAnova(stats::blockTableOf(oracle::rows(one["inputs"]["rows"])).table);
    QString more;
    if (one.contains("expected") && one["expected"].contains("morey_ci_halfwidth")) {
        const auto expected = oracle::numbers(one["expected"]["morey_ci_halfwidth"]);
        for (std::size_t i = 0; i < expected.size(); ++i)
            if (oracle::digits(a.moreyHalfWidths[i].orElse(0), expected[i]) < 8) more += QString("half-width %1; ").arg(i);
    }
    stats::Value hfUsed = a.epsilonHf.exists() ? stats::Value(std::min(1.0, *a.epsilonHf)) : a.epsilonHf;
    return {{{"ss_condition", a.ssCondition},
             {"ss_subject", a.ssSubject},
             {"ss_error", a.ssError},
             {"F", a.f},
             {"df1", a.df1},
             {"df2", a.df2},
             {"p", a.p},
             {"log_p", a.logP},
             {"eps_gg", a.epsilonGg},
             {"p_gg", a.pGg},
             {"log_p_gg", a.logPGg},
             {"eps_hf_raw", a.epsilonHf},
             {"eps_hf_used", hfUsed},
             {"p_hf", a.pHf},
             {"eta2_partial", a.partialEtaSquared},
             {"eta2_generalized", a.generalizedEtaSquared}},
            a.why,
            more};
}

Reply traceError(const Json& one)
{
    const auto e = stats::traceError(oracle::numbers(one["inputs"]["generated"]), oracle::numbers(one["inputs"]["truth"]));
    return {{{"mae", e.mae},
             {"mean_truth", e.meanTruth},
             {"mae_over_mean", e.maeOverMean},
             {"rmse", e.rmse},
             {"bias", e.bias},
             {"max_abs", e.maxAbs}},
            e.why,
            {}};
}

stats::Adjustment adjustmentOf(const std::string& name)
{
    static const std::map<std::string, stats::Adjustment> names{{"holm", stats::Adjustment::Holm},
                                                                {"hochberg", stats::Adjustment::Hochberg},
                                                                {"bonferroni", stats::Adjustment::Bonferroni},
                                                                {"BH", stats::Adjustment::BenjaminiHochberg},
                                                                {"BY", stats::Adjustment::BenjaminiYekutieli}};
    return names.at(name);
}

Reply pAdjust(const Json& one)
{
    std::vector<stats::Value> p;
    for (const double value : oracle::numbers(one["inputs"]["p"]))
        p.push_back(std::isnan(value) ? stats::Value::undefined("missing") : stats::Value(value));
    const auto adjusted = stats::adjusted(p, adjustmentOf(one["options"]["method"]));
    const auto expected = oracle::numbers(one["expected"]["adjusted"]);
    QString more = adjusted.size() == expected.size() ? "" : "length";
    for (std::size_t i = 0; more.isEmpty() && i < expected.size(); ++i) {
        const double value = adjusted[i].orElse(std::numeric_limits<double>::quiet_NaN());
        if (oracle::digits(value, expected[i]) < 14 && !(std::fabs(value - expected[i]) <= 1e-300))
            more = QString("p %1: %2 for %3").arg(i).arg(value).arg(expected[i]);
    }
    return {{}, {}, more};
}

using Solver = Reply (*)(const Json&);
struct Family {
    const char* name;
    Solver solve;
    std::set<std::string> later;  ///< fields that are not computed
};

const std::vector<Family>& families()
{
    static const std::vector<Family> all{
        {"ttest", tTest, {}},
        {"tost", tost, {}},
        {"wilcoxon", wilcoxon, {}},
        {"binomial", binomial, {}},
        {"friedman", friedman, {"p_exact"}},
        {"cochran", cochran, {}},
        {"rmanova", rmAnova, {"mauchly_w", "mauchly_p_box2", "mauchly_p_chi2", "mauchly_chi2", "mauchly_df"}},
        {"mae", traceError, {}},
        {"padjust", pAdjust, {}},
    };
    return all;
}

}  // namespace

class OracleTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void familyAgreesWithItsReferenceCases_data()
    {
        QTest::addColumn<int>("index");
        for (std::size_t i = 0; i < families().size(); ++i) QTest::newRow(families()[i].name) << static_cast<int>(i);
    }

    void familyAgreesWithItsReferenceCases()
    {
        QFETCH(int, index);
        const Family& family = families()[static_cast<std::size_t>(index)];
        const auto file = oracle::sharedFolder() / "oracle" / "cases" / "public" / (std::string(family.name) + ".json");
        if (!std::filesystem::exists(file)) QSKIP("the shared reference cases are not here: nothing was compared");
        std::ifstream stream(file);
        const Json document = Json::parse(stream);
        QVERIFY(!document["cases"].empty());
        int wrong = 0;
        for (const Json& one : document["cases"]) {
            const Reply reply = family.solve(one);
            const QString faults = oracle::fault(one, reply.answer, reply.why, family.later) + reply.more;
            if (faults.isEmpty() || family.solve == pAdjust) {
                if (!reply.more.isEmpty()) {
                    ++wrong;
                    qWarning("%s %s", one["id"].get<std::string>().c_str(), qPrintable(reply.more));
                }
                continue;
            }
            ++wrong;
            qWarning("%s: %s", one["id"].get<std::string>().c_str(), qPrintable(faults));
        }
        qInfo("%s: %zu cases, %d wrong", family.name, document["cases"].size(), wrong);
        QCOMPARE(wrong, 0);
    }
};

QTEST_GUILESS_MAIN(OracleTest)
#include "oracle_test.moc"
