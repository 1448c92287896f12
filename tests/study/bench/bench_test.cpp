// The bench measures on known surfaces and traces, so that its errors have known bounds. Times are not
// checked, because they depend on the machine.
#include "study/bench/bench.h"

#include <QTest>
#include <QXmlStreamReader>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "study/bench/bench_models.h"
#include "study/bench/bench_signals.h"
#include "study/bench/peer_programs.h"
#include "study/bench/preset_choice.h"
#include "study/bench/trade_picture.h"

using study::bench::BenchRow;

class BenchTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void everyStageHasItsErrorWithinBounds()
    {
        const auto rows = study::bench::benchSignals();
        const auto row = [&](const QString& stage, const QString& quality) {
            const auto found = std::find_if(rows.begin(), rows.end(), [&](const auto& one) {
                return QString::fromStdString(one.stage).startsWith(stage) && one.quality == quality.toStdString();
            });
            return found == rows.end() ? BenchRow{"", "", 0, 1e9, "", "", {}} : *found;
        };
        for (const auto& one : rows) {
            QVERIFY(one.milliseconds && one.error);
            qInfo("%-28s %-9s %8.2f ms  %.3g %s (%s)", one.stage.c_str(), one.quality.c_str(), *one.milliseconds, *one.error,
                  one.errorUnit.c_str(), one.note.c_str());
            QVERIFY(*one.milliseconds > 0 && std::isfinite(*one.error));
        }
        QVERIFY(row("integration 240x320", "full").error < 0.01);
        QVERIFY(row("integration 480x640", "fast").error < 0.01);
        for (const char* quality : {"fast", "full", "balanced", "accurate"})
            QVERIFY(row("photometric stereo", quality).error < 3);
        for (const char* quality : {"fast", "balanced", "accurate"}) QVERIFY(row("calibration", quality).error < 10);
        QVERIFY(row("shape from shading", "accurate").error < 0.5);
        QVERIFY(row("spectrogram and back", "complex").error < 1e-10);
        QVERIFY(row("spectrogram inversion", "200 iterations").error < 10);
        QVERIFY(row("spectrogram inversion", "200 iterations").error < row("spectrogram inversion", "8 iterations").error);
        // Each repeated row has its quartiles about its median, and some settings lie on the front.
        QVERIFY(std::all_of(rows.begin(), rows.end(), [](const BenchRow& one) {
            return !one.quartiles || (one.quartiles->low <= *one.milliseconds && *one.milliseconds <= one.quartiles->high);
        }));
        QVERIFY(std::any_of(rows.begin(), rows.end(), [](const BenchRow& one) { return one.onFront; }));
        QVERIFY(study::bench::spreadPercent(rows).has_value());
        for (const auto& choice : study::bench::presetChoices(rows))
            if (choice.stage != "photograph to relief")
                for (const auto& chosen : choice.byRule) QVERIFY2(chosen.has_value(), choice.stage.c_str());
    }

    void simulatedFingersAgreeWithTheirClosedForm()
    {
        const auto rows = study::bench::benchPerception();
        QCOMPARE(rows.size(), std::size_t(5));
        for (std::size_t i = 0; i < rows.size(); ++i) {
            QVERIFY2(*rows[i].error < 10, qPrintable(QString::number(*rows[i].error)));
            QVERIFY(rows[i].milliseconds && *rows[i].milliseconds > 0);
        }
    }

    void plantedStudiesAreRecovered()
    {
        const auto rows = study::bench::benchModels();
        const auto error = [&](const char* stage, const char* setting) {
            for (const BenchRow& row : rows)
                if (row.stage.starts_with(stage) && row.quality == setting) return *row.error;
            return 1e9;
        };
        QCOMPARE(error("Friedman", "exact"), 0.0);
        QVERIFY(error("Friedman", "chi-squared") > 0 && error("Friedman", "chi-squared") < 0.1);
        QVERIFY(error("sign flips of 12", "t test") < 0.1);
        // A paired t test knows nothing of other fabrics, so its standard error is too small.
        QVERIFY(error("standard error", "mixed model") < error("standard error", "paired t"));
        QVERIFY(error("log odds", "main effects") < 0.6);
    }

    void aFrontHoldsWhatNothingBeats()
    {
        std::vector<BenchRow> rows{{"a", "quick", 1, 9, "%", ""},
                                   {"a", "slow", 5, 2, "%", ""},
                                   {"a", "both", 6, 3, "%", ""},
                                   {"b", "alone", 1, 1, "%", ""},
                                   {"a", "other unit", 9, 1, "mm", ""}};
        study::bench::markFronts(rows);
        std::string front;
        for (const BenchRow& row : rows)
            if (row.onFront) front += row.quality + " ";
        QCOMPARE(front, std::string("quick slow "));
        const auto chosen = [&](double most) { return study::bench::cheapestWithin(rows, "b", most)->quality; };
        QCOMPARE(chosen(1), std::string("alone"));
        rows.pop_back();
        QCOMPARE(study::bench::cheapestWithin(rows, "a", 1)->quality, std::string("slow"));
        QCOMPARE(study::bench::cheapestWithin(rows, "a", 4.4)->quality, std::string("slow"));
        QCOMPARE(study::bench::cheapestWithin(rows, "a", 4.5)->quality, std::string("quick"));
        QVERIFY(!study::bench::cheapestWithin(rows, "c", 2));
        QCOMPARE(study::bench::bestFor(rows, "a", 4.9)->quality, std::string("quick"));
        QCOMPARE(study::bench::bestFor(rows, "a", 5)->quality, std::string("slow"));
        QVERIFY(!study::bench::bestFor(rows, "a", 0.9));
    }

    void shippedPresetsStandBesideWhatTheRuleChooses()
    {
        std::vector<BenchRow> rows{{"integration 480x640", "full", 9, 0.004, "% of Sq", ""},
                                   {"integration 480x640", "fast", 4, 0.0041, "% of Sq", ""}};
        const auto text = study::bench::choiceText(rows);
        QVERIFY(text.find("accurate  shipped: full             the rule here: full, as shipped (9 ms, error 0.004)") !=
                std::string::npos);
        QVERIFY(text.find("not measured") != std::string::npos);
        QVERIFY(text.find("Nothing was changed") != std::string::npos);
        rows[0].error = 0.005;
        QVERIFY(!study::bench::presetChoices(rows).front().agrees());
    }

    void thePictureShowsEverySetting()
    {
        std::vector<BenchRow> rows{{"spectrogram inversion", "8 iterations", 1, 9, "% of magnitude", ""},
                                   {"spectrogram inversion", "32 iterations", 5, 2, "% of magnitude", ""},
                                   {"a <stage>", "slow & sure", 6, 0, "mm", ""},
                                   {"a <stage>", "quick", 2, 1, "mm", ""},
                                   {"alone", "one", 6, 3, "mm", ""}};
        study::bench::markFronts(rows);
        study::bench::CostCurve curve{"sums", "values", true, {{10, 1, {}}, {100, 10, {}}, {1000, 100, {}}}, {}, {}};
        study::bench::fitExponent(curve);
        QVERIFY(std::abs(*curve.exponent - 1) < 1e-12 && std::abs(curve.ci95->low - 1) < 1e-6);
        const QString svg = QString::fromStdString(study::bench::tradeSvg(rows, {curve}, "2 cores"));
        QXmlStreamReader reader(svg);
        while (!reader.atEnd()) reader.readNext();
        QVERIFY2(!reader.hasError(), qPrintable(reader.errorString()));
        for (const char* shown :
             {"8 iterations [F]", "32 iterations [B]", "slow &amp; sure", "a &lt;stage&gt;", "sums", "2 cores"})
            QVERIFY2(svg.contains(shown), shown);
        QVERIFY(!svg.contains("alone"));
        const QString characters = QString::fromStdString(study::bench::tradeInCharacters(rows, 100));
        for (const char* shown : {"8 iterations [F]", "slow & sure", "*", "on the Pareto front"})
            QVERIFY2(characters.contains(shown), shown);
        for (const QString& line : characters.split('\n')) QVERIFY(line.size() <= 100);
        QVERIFY(tableOf(std::vector{curve}).find("time ~ values^1.00") != std::string::npos);
    }

    /// A shard from elsewhere, read by `merge`.
    void curvesOfEqualSizesHaveNoExponent()
    {
        const study::bench::CostCurve sound{"w", "n", false, {{1, 3, {}}, {2, 7, {}}}, {}, {}};
        QCOMPARE(study::bench::curveFrom(jsonOf(sound), "shard.json").points.size(), std::size_t(2));
        auto equal = sound;
        equal.points[1].size = 1;
        QVERIFY_EXCEPTION_THROWN(study::bench::curveFrom(jsonOf(equal), "shard.json"), protocols::Error);
        equal.points = {{2, 3, {}}, {std::nextafter(2, 3), 7, {}}, {2.0000001, 9, {}}};
        QVERIFY(!study::bench::curveFrom(jsonOf(equal), "shard.json").exponent.has_value());
    }

    void peersGetNoSecrets()
    {
        qputenv("VIS2HAP_PASSPHRASE", "hidden");
        qputenv("VIS2HAP_BENCH_TEST", "shown");
        const auto variables = study::bench::peerEnvironment();
        QVERIFY(std::ranges::find(variables, "VIS2HAP_BENCH_TEST=shown") != variables.end());
        QVERIFY(std::ranges::find(variables, "VIS2HAP_PASSPHRASE=hidden") == variables.end());
        qunsetenv("VIS2HAP_PASSPHRASE");
    }

    void exponentsHaveTheirInterval()
    {
        // R: confint(lm(log(c(3, 7, 30)) ~ log(c(1, 2, 9))))[2, ]      0.262674956 1.807324574
        study::bench::CostCurve curve{"w", "n", false, {{1, 3, {}}, {2, 7, {}}, {9, 30, {}}}, {}, {}};
        study::bench::fitExponent(curve);
        QVERIFY(std::abs(curve.ci95->low - 0.262674956) < 1e-6);
        QVERIFY(std::abs(curve.ci95->high - 1.807324574) < 1e-6);
    }

    void patchesAndFrictionOfDrawnFabricsAreMeasuredAlone()
    {
        const auto rows = study::bench::benchStage("fabrics", {});
        QCOMPARE(rows.size(), std::size_t(6));
        for (const auto& row : {rows[0], rows[1]}) {
            QVERIFY(row.milliseconds && *row.milliseconds > 0);
            QVERIFY(row.note.find("patches a second") != std::string::npos);
        }
        // Who knows all terms of the law errs by its unseen spread: the mean of |1 / unseen - 1| is 4.8 % for 6 %.
        const auto error = [&](std::size_t i) { return rows[i].error.value(); };
        QVERIFY(std::abs(error(2) - 4.8) < 0.4);
        QVERIFY(error(3) > 3 * error(2) && error(4) > 3 * error(2));
        QVERIFY(error(5) > 30 && error(5) > error(3) && error(5) > error(4));
        QVERIFY_EXCEPTION_THROWN(study::bench::benchStage("fabric", {}), protocols::Error);
    }

    void aRowIsALineAndAnObject()
    {
        const BenchRow row{"ssim", "double", 21.5, {}, "-", "goal 30 ms", {{"R", 40.26}, {"scipy", {}}}};
        const auto json = jsonOf(row);
        QCOMPARE(json.dump(), R"({"stage":"ssim","quality":"double","ms":21.5,"error":null,"error_is":"-",)"
                              R"("note":"goal 30 ms, R 40.3 ms, scipy not installed",)"
                              R"("why":{"error":"this row has no known result to compare with",)"
                              R"("peers":"a peer without a number is not installed, or --peers was not given"},)"
                              R"("peers":{"R":40.26,"scipy":null},)"
                              R"("on_front":false})");
        BenchRow promised{"paired t", "double", 2, {}, "", "", {{"scipy", 7.0}}};
        promised.quartiles = study::bench::Quartiles{1.5, 3};
        promised.megabytes = 1.25;
        promised.peersDiffer["scipy"] = 1e-12;
        promised.promise = study::bench::RatioPromise{"scipy", 0.4, 2.0 / 7};
        QVERIFY(promised.promise->isMet());
        QCOMPARE(jsonOf(promised)["promise"].dump(), R"({"peer":"scipy","at_most":0.4,"ratio":0.2857142857142857,"met":true})");
        QCOMPARE(jsonOf(promised)["ms_quartiles"].dump(), "[1.5,3.0]");
        promised.promise->ratio = 0.41;
        QVERIFY(study::bench::tableOf({promised}).find("at most 0.40 x scipy, 0.410 (NOT met)") != std::string::npos);
        const QString table = QString::fromStdString(study::bench::tableOf({row}));
        QCOMPARE(table.count('\n'), 2);
        QVERIFY(table.contains("21.500") && table.endsWith("-; goal 30 ms, R 40.3 ms, scipy not installed\n"));
    }

    void scriptsOfPeersAreFilesThatAreFound()
    {
        for (const char* script : {"statistics_peer.py", "statistics_peer.R", "signals_peer.py", "generators_peer.py",
                                   "extremes_peer.py", "extremes_peer.R", "opencv_ssim.py"})
            QVERIFY2(std::filesystem::exists(study::bench::peerScript(script)), script);
        QVERIFY_EXCEPTION_THROWN(study::bench::peerScript("nobodys_peer.py"), protocols::Error);
    }
};

QTEST_GUILESS_MAIN(BenchTest)
#include "bench_test.moc"
