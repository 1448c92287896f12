// Requests to `vis2hap analyse` and their answers: formulas, recipes, faults.
#include "study/analyse/analyse.h"

#include <QElapsedTimer>
#include <QTemporaryDir>
#include <QTest>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"
#include "rendering/images/image_io.h"
#include "study/analyse/analyse_formula.h"
#include "study/analyse/analyse_inputs.h"
#include "study/analyse/analyse_recipe.h"
#include "study/analyse/column_statistics.h"
#include "study/analyse/csv_column.h"
#include "study/analyse/request_file.h"
#include "study/analyse/similarity.h"

namespace {

using nlohmann::json;
using study::analyse::answerOf;
using study::analyse::arraysOfRecipe;
using study::analyse::valueOfFormula;

json answerTo(const char* analysis, const json& inputs, const json& options = json::object())
{
    return answerOf({{"id", "one"}, {"analysis", analysis}, {"inputs", inputs}, {"options", options}}, ".");
}

bool saysError(const json& answer, const QString& words)
{
    return answer.size() == 1 && answer.contains("error") &&
           QString::fromStdString(answer["error"].get<std::string>()).contains(words);
}

}  // namespace

class AnalyseTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void formulasAreArithmetic_data()
    {
        QTest::addColumn<QString>("formula");
        QTest::addColumn<double>("value");
        QTest::newRow("fraction") << "1/3" << 1.0 / 3;
        QTest::newRow("root") << "sqrt(2)/2" << std::sqrt(2.0) / 2;
        QTest::newRow("number") << "0.707" << 0.707;
        QTest::newRow("exponent") << "-2.5e-3" << -2.5e-3;
        QTest::newRow("precedence") << "1 + 2*3^2 - 4/2" << 17.0;
        QTest::newRow("modulus") << "(7*2654435761) mod 2^32" << 1401181143.0;
        QTest::newRow("beyond 2^53") << "(2^62 + 1) mod 10" << 5.0;
        QTest::newRow("negative modulus") << "(0-3) mod 8" << 5.0;
        QTest::newRow("beyond 2^127") << "(2^59)^3" << std::pow(2.0, 177);
        QTest::newRow("negative, beyond 2^127") << "(0-2^59)^3" << -std::pow(2.0, 177);
        QTest::newRow("factor without a sign") << ".8sqrt(4)" << 1.6;
    }

    void formulasAreArithmetic()
    {
        QFETCH(QString, formula);
        QFETCH(double, value);
        QCOMPARE(valueOfFormula(formula.toStdString()), value);
    }

    void whatIsNoFormulaIsRefused()
    {
        for (const char* text : {"", "1/", "(1", "1 2", "x", "sqrt 2", "import os", "1e999"})
            QVERIFY_EXCEPTION_THROWN(valueOfFormula(text), study::analyse::RequestFault);
        QVERIFY_EXCEPTION_THROWN(valueOfFormula(std::string(5000, '(')), study::analyse::RequestFault);
    }

    void recipeOfOneArray()
    {
        const auto made = arraysOfRecipe("x_i = ((i*2654435761) mod 2^32)/2^32 + offset, i=0..n-1, all in IEEE double",
                                         {{"n", 4}, {"offset", 1e9}});
        const std::vector<double> expected{1e9, 2654435761.0 / 4294967296.0 + 1e9,
                                           (2 * 2654435761.0 - 4294967296.0) / 4294967296.0 + 1e9,
                                           (3 * 2654435761.0 - 4294967296.0) / 4294967296.0 + 1e9};
        QCOMPARE(made.arrays.at("x"), expected);
    }

    void recipesVaryInTheirNumbers()
    {
        const auto made =
            arraysOfRecipe("y_k=5 + 0.5*((k*1103515245+12345) mod 2^31)/2^31 - shift, k=1..n", {{"n", 3}, {"shift", 0.25}});
        QCOMPARE(made.last, std::string("y"));
        QCOMPARE(made.arrays.at("y").size(), std::size_t{3});
        QCOMPARE(made.arrays.at("y")[0], 5 + 0.5 * ((1103515245.0 + 12345) / 2147483648.0) - 0.25);
    }

    void recipeOfTwoImages()
    {
        const auto made = arraysOfRecipe(
            "a_k=((k*2654435761+12345) mod 2^32)/2^32, c_k=((k*3266489917+99) mod 2^32)/2^32, b=0.8*a+0.2*c (two roundings: "
            "fl(fl(.8a)+fl(.2c))), k row-major, 3 rows x 5 cols, float64",
            {});
        QCOMPARE(made.rows, std::size_t{3});
        QCOMPARE(made.columns, std::size_t{5});
        QCOMPARE(made.arrays.at("a").size(), std::size_t{15});
        QCOMPARE(made.arrays.at("b")[0], 0.8 * (12345 / 4294967296.0) + 0.2 * (99 / 4294967296.0));
    }

    void recipesThatCannotBeReadSayWhere()
    {
        QVERIFY_EXCEPTION_THROWN(arraysOfRecipe("nothing", {}), study::analyse::RequestFault);
        QVERIFY_EXCEPTION_THROWN(arraysOfRecipe("x_i = i", {}), study::analyse::RequestFault);  // number of entries missing
        QVERIFY_EXCEPTION_THROWN(arraysOfRecipe("x_i = j, i=0..3", {}), study::analyse::RequestFault);
        QVERIFY_EXCEPTION_THROWN(arraysOfRecipe("x_i = i, i=0..n-1", {{"n", 1e18}}), study::analyse::RequestFault);
        const auto answer = answerTo("t_test", {{"kind", "one_sample"}, {"x", {{"recipe", "x_i = rand(i)"}, {"n", 5}}}});
        QVERIFY(saysError(answer, "rand"));
    }

    void recipesMayHaveBlanksAnywhere()
    {
        const auto made = arraysOfRecipe(" x_i  =  i + 1 ; i =\t0 ... 2 ; a remark of 3 rows, float32", {});
        QCOMPARE(made.arrays.at("x"), (std::vector<double>{1, 2, 3}));
        QCOMPARE(made.rows, std::size_t{0});
        QCOMPARE(arraysOfRecipe("x=i, of 2rows*3columns", {}).arrays.at("x").size(), std::size_t{6});
        QCOMPARE(arraysOfRecipe("x=k, k  row-major, 1 row by 2 cols", {}).arrays.at("x"), (std::vector<double>{0, 1}));
    }

    /// Before, 900 blanks took 3.4 s, and the allowed 10,000 characters hours.
    void aLongRecipeIsReadAtOnce()
    {
        QElapsedTimer clock;
        clock.start();
        for (const char* begin : {"a=", "a=1", "a", "1row"})
            QVERIFY_EXCEPTION_THROWN(arraysOfRecipe(begin + std::string(9'000, ' '), {}), study::analyse::RequestFault);
        QVERIFY_EXCEPTION_THROWN(arraysOfRecipe("a=1" + std::string(9'000, '.'), {}), study::analyse::RequestFault);
        QVERIFY2(clock.elapsed() < 2000, qPrintable(QString("%1 ms").arg(clock.elapsed())));
    }

    void sizesBeyondAllMemoryAreRefused_data()
    {
        QTest::addColumn<QString>("recipe");
        QTest::addColumn<QString>("said");
        QTest::newRow("20 digits") << "a=k, k row-major, 99999999999999999999 rows x 2 cols"
                                   << "the recipe's shape has a side of 99999999999999999999";
        QTest::newRow("a product of 2^64") << "a=k, k row-major, 4611686018427387904 rows x 4 cols"
                                           << "the recipe's shape has a side of 4611686018427387904";
        QTest::newRow("a large product") << "a=k, k row-major, 10000000 rows x 10000000 cols"
                                         << "asks for 100000000000000 entries of 1 array";
        QTest::newRow("a range beyond 64 bits") << "a=i, i=0..2^100"
                                                << "is not a whole number below 9e15";
        QTest::newRow("both ends far away") << "a=i, i=0-2^63..2^63-1"
                                            << "is not a whole number below 9e15";
        QTest::newRow("backwards") << "a=i, i=3..0"
                                   << "asks for -2 entries";
        QTest::newRow("each array counts") << "a=i, b=i, c=i, i=1..5000000"
                                           << "entries of 3 arrays; expected 0 to 10000000 in all";
        QTest::newRow("n") << "a=i"
                           << "the recipe's n is outside 0 to 10000000";
        QTest::newRow("hours of work") << "a=i" + QString("+1").repeated(4000) + ", i=1..1000000"
                                       << "is too long for 1000000";
        QTest::newRow("twice") << "a=i, a=2, i=0..1"
                               << "defines a twice";
        QTest::newRow("range against shape") << "a=i, b=i, i=0..3, 800 rows x 1280 cols"
                                             << "has 4 entries, but its shape 1024000";
    }

    void sizesBeyondAllMemoryAreRefused()
    {
        QFETCH(const QString, recipe);
        QFETCH(const QString, said);
        const auto answer = answerTo("t_test", {{"kind", "one_sample"}, {"x", {{"recipe", recipe.toStdString()}, {"n", 1e300}}}});
        QVERIFY2(saysError(answer, said), answer.dump().c_str());
    }

    /// Before, each recipe had a limit of its own, so that 20 rows asked for 16 GB.
    void theRecipesOfARequestShareOneLimit()
    {
        const json half{{"recipe", "x=i, i=0..4999999"}};
        QVERIFY(saysError(answerTo("friedman", {{"rows", json::array({half, half, half})}}),
                          "15000000 entries of all recipes; expected smaller inputs, at most 10000000"));
        const json slow{{"recipe", "x=i" + std::string(8'000, ' ') + ", i=0..69999"}};
        QVERIFY(saysError(answerTo("t_test", {{"kind", "paired"}, {"x", slow}, {"y", slow}}), "entries x characters"));
    }

    void smallRequestsOfTooMuchAreRefused_data()
    {
        QTest::addColumn<QString>("analysis");
        QTest::addColumn<QString>("inputs");
        QTest::addColumn<QString>("options");
        QTest::addColumn<QString>("said");
        const auto row = [](const char* name, const char* analysis, const json& inputs, const json& options, const char* said) {
            QTest::newRow(name) << QString(analysis) << QString::fromStdString(inputs.dump())
                                << QString::fromStdString(options.dump()) << QString(said);
        };
        json ids = json::array(), ones = json::array(), two = json::array();
        for (int i = 0; i < 2400; ++i) {
            ids.push_back("c" + std::to_string(i));
            ones.push_back(i % 2);
            two.push_back("c" + std::to_string(i % 2));
        }
        const json none = json::object();
        const std::map<const char*, const char*> models{{"linear_mixed", "value"},
                                                        {"logistic_mixed", "correct"},
                                                        {"ordinal_mixed", "rating"},
                                                        {"r_squared", "value"},
                                                        {"claims", "value"}};
        for (const auto& [model, field] : models)
            row(model, model, {{field, ones}, {"condition", ids}, {"participant", ids}}, none,
                "2400 conditions; expected smaller inputs, at most 100");
        const json timed{{"seconds", ones}, {"correct", ones}, {"condition", ids}, {"participant", ids}};
        row("speed_contrasts", "speed_contrasts", timed, none, "2400 conditions");
        json pairs = json::array();
        for (int i = 0; i < 5001; ++i) pairs.push_back(json::array({"c0", "c1"}));
        const json few{{"value", ones}, {"condition", two}, {"participant", ids}};
        row("pairs", "claims", few, {{"contrasts", pairs}}, "5001 contrasts; expected smaller inputs, at most 5000");
        const json long3{{"recipe", "x=i*i mod 101, i=0..1000"}};
        row("rm_anova", "rm_anova_oneway", {{"rows", {long3, long3, long3}}}, none, "1001 conditions");
        json a = json::array(), b = json::array();
        for (int i = 0; i < 2400; ++i) {
            a.push_back("a" + std::to_string(i / 40 % 30));
            b.push_back(i % 40);
        }
        const json within{{"value", ones}, {"a", a}, {"b", b}, {"participant", two}};
        row("two_way_anova", "two_way_anova", within, {{"design", "within"}}, "1200 measures of a participant");
        row("resamples", "bca_bootstrap_mean", {{"x", {1, 2, 4}}}, {{"n_resamples", 100000000}}, "100000000 resamples");
        row("draws", "bca_bootstrap_mean", {{"x", {{"recipe", "x=i, i=0..299999"}}}}, none, "3000000000 resamples x values");
        const json million{{"recipe", "x=0.5, i=0..1000000"}};
        row("p_adjust", "p_adjust", {{"p", million}}, none, "1000001 p values");
        row("bis", "bis", {{"pc", million}, {"rt", million}}, none, "1000001 cells");
        const json many{{"recipe", "x=i-i+4, i=0..100000"}};
        row("mafc_probit", "mafc_probit", {{"level", many}, {"k", many}, {"n", many}, {"m", 3}}, none, "100001 levels");
        const json trace{{"recipe", "x=i mod 7, i=0..99999"}};
        row("spectrum", "spectrum_distance", {{"generated", trace}, {"truth", trace}}, {{"segment", 65536}}, "values x segment");
        row("shifts", "registered_ssim", {{"recipe", "a=i mod 7, b=i mod 5, 500 rows x 500 cols"}},
            {{"data_range", 7}, {"most_shift", 200}}, "pixels x shifts");
    }

    /// Before, each took gigabytes or many seconds for a request of some kilobytes.
    void smallRequestsOfTooMuchAreRefused()
    {
        QFETCH(const QString, analysis);
        QFETCH(const QString, inputs);
        QFETCH(const QString, options);
        QFETCH(const QString, said);
        QElapsedTimer clock;
        clock.start();
        const auto answer = answerTo(qPrintable(analysis), json::parse(inputs.toStdString()), json::parse(options.toStdString()));
        QVERIFY2(saysError(answer, said), answer.dump().substr(0, 300).c_str());
        QVERIFY2(saysError(answer, "expected smaller inputs"), answer.dump().substr(0, 300).c_str());
        QVERIFY2(clock.elapsed() < 2000, qPrintable(QString("%1 ms").arg(clock.elapsed())));
    }

    /// Before, the time grew with the square of the number of ids, and of that of the groups.
    void manyIdsAndGroupsTakeNoLonger()
    {
        QElapsedTimer clock;
        clock.start();
        std::string cases, groups;
        for (int i = 0; i < 50000; ++i) {
            cases += std::string(i == 0 ? "" : ",") + "{\"id\":\"request " + std::to_string(i) + "\"}";
            groups += (i == 0 ? "" : ",") + std::string("\"g") + std::to_string(i / 2) + "\"";
        }
        const auto answers = study::analyse::answersTo("{\"cases\":[" + cases + "]}", "requests.json", ".");
        QCOMPARE(answers.size(), std::size_t{50000});
        QVERIFY(answers.back() == answers.front());
        const json y{{"recipe", "y=i*i mod 101, i=0..49999"}};
        const auto anova = answerTo("anova_oneway", {{"y", y}, {"group", json::parse("[" + groups + "]")}});
        QCOMPARE(anova["k"].get<int>(), 25000);
        QVERIFY2(clock.elapsed() < 10000, qPrintable(QString("%1 ms").arg(clock.elapsed())));
    }

    /// Before, one such recipe ended the run, and no request was answered.
    void afterARefusedRequestTheOthersAreAnswered()
    {
        const json bad{{"id", "bad"},
                       {"analysis", "ssim"},
                       {"inputs", {{"recipe", "a=k, b=k, k row-major, 99999999999999999999 rows x 2 cols"}}},
                       {"options", {{"data_range", 1}}}};
        const json good{{"id", "good"}, {"analysis", "p_adjust"}, {"inputs", {{"p", {0.5}}}}};
        const auto answers = study::analyse::answersTo(json{{"cases", {bad, good}}}.dump(), "requests.json", ".");
        QVERIFY(saysError(answers["bad"], "the recipe's shape"));
        QVERIFY(answers["good"].contains("adjusted"));
    }

    void numbersMayBeSpelled()
    {
        const auto answer = answerTo("p_adjust", {{"p", {0.01, "nan", "4e-2", nullptr}}}, {{"method", "bonferroni"}});
        QCOMPARE(answer["adjusted"].dump(), std::string("[0.02,\"nan\",0.08,\"nan\"]"));
        const auto tiny = answerTo("p_adjust", {{"p", {"1e-400", 0.5}}}, {{"method", "holm"}});
        QCOMPARE(tiny["adjusted"][0].get<double>(), 0.0);
    }

    void undefinedAnalysesAreDegenerateWithAReason()
    {
        const auto answer = answerTo("t_test", {{"kind", "paired"}, {"x", {1, 2, 3}}, {"y", {1, 2, 3}}});
        QCOMPARE(answer.size(), std::size_t{2});
        QCOMPARE(answer["status"].get<std::string>(), std::string("degenerate"));
        QCOMPARE(answer["reason"].get<std::string>(), std::string("no variation: all differences are equal"));
    }

    void missingQuantitiesCarryTheirReason()
    {
        const auto answer = answerTo("trace_error", {{"generated", {1, -1}}, {"truth", {1, -1.5}}});
        QVERIFY(answer["mae_over_mean"].is_null());
        QCOMPARE(answer["why"]["mae_over_mean"].get<std::string>(), std::string("the mean of the truth is not positive"));
        QCOMPARE(answer["mae"].get<double>(), 0.25);
    }

    void openEndsAndTinyProbabilitiesAreTexts()
    {
        const json x{10001, 10002, 10003, 10004, 10005, 10006, 10003, 10004};
        const auto greater = answerTo("t_test", {{"kind", "one_sample"}, {"x", x}}, {{"alternative", "greater"}});
        QCOMPARE(greater["ci_high"].get<std::string>(), std::string("inf"));
        const auto all = answerTo("binomial", {{"k", 2000}, {"n", 2000}}, {{"p0", "1/3"}});
        // 3^-2000
        QVERIFY2(all["p_greater"].get<std::string>().ends_with("e-955"), all["p_greater"].dump().c_str());
    }

    /// The value after a missing one is not that of the row before.
    void missingRowsOfATraceAreNamed()
    {
        QTemporaryDir folder;
        const std::filesystem::path place(folder.path().toStdString());
        protocols::writeWholeFile(place / "a.csv", "x\n1\n2\n\n4\n");
        protocols::writeWholeFile(place / "b.csv", "x\n1\n\n3\n4\n");
        const json metrics = study::analyse::similarityOf(place / "a.csv", place / "b.csv", std::nullopt);
        QVERIFY2(metrics["mae"].is_null() && !metrics["why"]["mae"].get<std::string>().empty(), metrics.dump().c_str());
        const json column = study::analyse::describeColumn(study::analyse::readColumn(place / "a.csv", "x"));
        QVERIFY2(column["n"] == 3 && column["missing"] == 1, column.dump().c_str());
    }

    /// An interval that ends on one side only has null on the other, with its reason. That of a mean beside a test of ranks, too.
    void oneSidedIntervalsSayWhichEndTheyLack()
    {
        using study::analyse::ColumnTest;
        const std::vector<double> a{1, 2.5, 3, 4.2, 5}, b{1.2, 2, 2, 5, 3};
        for (const ColumnTest test : {ColumnTest::Paired, ColumnTest::Welch, ColumnTest::Student, ColumnTest::Wilcoxon}) {
            const json less = study::analyse::compareColumns({test, stats::Tail::Less}, a, b);
            QVERIFY2(less["ci95"][0].is_null() && less["ci95"][1].is_number(), less.dump().c_str());
            QVERIFY2(less["why"]["ci95"] == "one-sided: no lower bound", less.dump().c_str());
            const json greater = study::analyse::compareColumns({test, stats::Tail::Greater}, a, b);
            QVERIFY2(greater["ci95"][0].is_number() && greater["ci95"][1].is_null(), greater.dump().c_str());
            QVERIFY2(greater["why"]["ci95"] == "one-sided: no upper bound", greater.dump().c_str());
            const json both = study::analyse::compareColumns({test, stats::Tail::TwoSided}, a, b);
            QVERIFY2(both["ci95"][1].is_number() && !both.value("why", json::object()).contains("ci95"), both.dump().c_str());
            QVERIFY(less["ci95"][1] < both["ci95"][1]);
        }
    }

    /// Two equal columns: a script read "not equivalent" of a difference of 0.
    void aTestThatThereIsNotDecidesNothing()
    {
        using study::analyse::ColumnTest;
        const std::vector<double> same{1, 2, 3, 4};
        const json tost = study::analyse::compareColumns({ColumnTest::Equivalence}, same, same);
        QVERIFY2(tost["equivalent"].is_null() && !tost["why"]["equivalent"].get<std::string>().empty(), tost.dump().c_str());
        const json ranks = study::analyse::compareColumns({ColumnTest::Wilcoxon}, same, same);
        QVERIFY2(ranks["p"].is_null() && !ranks.contains("p_is"), ranks.dump().c_str());
    }

    /// One surface, once in 8 and once in 16 bits: its grey values differ 257 times.
    void imagesOfDifferentDepthAreNotCompared()
    {
        const QTemporaryDir folder;
        const std::filesystem::path place = folder.path().toStdString();
        cv::Mat bytes(16, 16, CV_8UC1), words, floats;
        for (int i = 0; i < 256; ++i) bytes.at<uchar>(i / 16, i % 16) = static_cast<uchar>(i);
        bytes.convertTo(words, CV_16U, 257);
        bytes.convertTo(floats, CV_64F);
        rendering::writePng(place / "bytes.png", bytes);
        rendering::writePng(place / "words.png", words);
        rendering::writeNpy(place / "floats.npy", floats);
        const auto faultOf = [&](const char* a, const char* b) -> std::string {
            try {
                (void)study::analyse::similarityOf(place / a, place / b, std::nullopt);
                return "";
            } catch (const protocols::Error& error) {
                return error.what();
            }
        };
        for (const auto& [a, b, depths] : {std::tuple("bytes.png", "words.png", "8 bits and 16 bits"),
                                           std::tuple("words.png", "bytes.png", "16 bits and 8 bits"),
                                           std::tuple("floats.npy", "bytes.png", "floating-point values and 8 bits")}) {
            const std::string fault = faultOf(a, b);
            QVERIFY2(fault.find(depths) != std::string::npos && fault.find("--range") != std::string::npos, fault.c_str());
        }
        QVERIFY(faultOf("floats.npy", "floats.npy").find("has floating-point values") != std::string::npos);
        for (const char* file : {"bytes.png", "words.png"})
            QCOMPARE(study::analyse::similarityOf(place / file, place / file, std::nullopt)["ssim"].get<double>(), 1.0);
        QCOMPARE(study::analyse::similarityOf(place / "floats.npy", place / "bytes.png", 255)["ssim"].get<double>(), 1.0);
    }

    void requestsThatCannotBeUnderstoodAreErrors()
    {
        QVERIFY(saysError(answerOf("text", "."), "not an object"));
        QVERIFY(saysError(answerTo("", {}), "no analysis is named"));
        QVERIFY(saysError(answerTo("anova", {}), "unknown analysis \"anova\""));
        QVERIFY(saysError(answerTo("t_test", {{"kind", "pared"}, {"x", {1, 2}}}), "expected one of: one_sample"));
        QVERIFY(saysError(answerTo("t_test", {{"kind", "one_sample"}}), "have no x"));
        QVERIFY(saysError(answerTo("t_test", {{"kind", "one_sample"}, {"x", {1, "two"}}}), "value 2 of x"));
        QVERIFY(saysError(answerTo("binomial", {{"k", 2.5}, {"n", 5}}, {{"p0", "1/3"}}), "not a whole number"));
        QVERIFY(saysError(answerTo("friedman", {{"rows", {{1, 2}, {1}}}}), "differ in length"));
        QVERIFY(saysError(answerTo("ssim", {{"a", "absent.npy"}, {"b", "absent.npy"}}, {{"data_range", 1}}), "absent.npy"));
        QVERIFY(saysError(answerTo("p_adjust", {{"p", {1.5}}}), "outside 0 to 1"));
    }

    void everyAnalysisAnswersNothingWithoutCrashing()
    {
        for (const auto& analysis : study::analyse::analyses()) {
            const auto answer = answerTo(std::string(analysis.name).c_str(), json::object());
            QVERIFY2(answer.contains("error") || answer.contains("reason"), analysis.name.data());
        }
    }
};

QTEST_GUILESS_MAIN(AnalyseTest)
#include "analyse_test.moc"
