// The bench measures on known surfaces and traces, so that its errors have known bounds. Times are not
// checked, because they depend on the machine.
#include "study/bench/bench.h"

#include <QTest>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "study/bench/bench_signals.h"
#include "study/bench/peer_programs.h"

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
            return found == rows.end() ? study::bench::BenchRow{"", "", 0, 1e9, "", "", {}} : *found;
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
        QVERIFY(row("shape from shading", "accurate").error < 0.5);
        QVERIFY(row("spectrogram and back", "complex").error < 1e-10);
        QVERIFY(row("spectrogram inversion", "accurate").error < 10);
    }

    void patchesOfDrawnFabricsAreTimedAlone()
    {
        const auto rows = study::bench::benchStage("fabrics", {});
        QCOMPARE(rows.size(), std::size_t(2));
        for (const auto& row : rows) {
            QVERIFY(row.milliseconds && *row.milliseconds > 0);
            QVERIFY(row.note.find("patches a second") != std::string::npos);
        }
        QVERIFY_EXCEPTION_THROWN(study::bench::benchStage("fabric", {}), protocols::Error);
    }

    void aRowIsALineAndAnObject()
    {
        const study::bench::BenchRow row{"ssim", "double", 21.5, {}, "-", "goal 30 ms", {{"R", 40.26}, {"scipy", {}}}};
        const auto json = jsonOf(row);
        QCOMPARE(json.dump(), R"({"stage":"ssim","quality":"double","ms":21.5,"error":null,"error_is":"-",)"
                              R"("note":"goal 30 ms, R 40.3 ms, scipy not installed","peers":{"R":40.26,"scipy":null}})");
        const QString table = QString::fromStdString(study::bench::tableOf({row}));
        QCOMPARE(table.count('\n'), 2);
        QVERIFY(table.contains("21.500") && table.endsWith("-; goal 30 ms, R 40.3 ms, scipy not installed\n"));
    }

    void scriptsOfPeersAreFilesThatAreFound()
    {
        for (const char* script : {"statistics_peer.py", "statistics_peer.R", "signals_peer.py", "generators_peer.py"})
            QVERIFY2(std::filesystem::exists(study::bench::peerScript(script)), script);
        QVERIFY_EXCEPTION_THROWN(study::bench::peerScript("nobodys_peer.py"), protocols::Error);
    }
};

QTEST_GUILESS_MAIN(BenchTest)
#include "bench_test.moc"
