// The figures that `vis2hap bench signals` prints for friction images and records, except the times.
#include "study/bench/bench_composition.h"

#include <QTest>
#include <algorithm>
#include <cmath>

using study::bench::BenchRow;

class BenchCompositionTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { m_rows = study::bench::benchComposition(); }

    void errorsAreWithinWhatIsPromised_data()
    {
        QTest::addColumn<QString>("stage");
        QTest::addColumn<QString>("quality");
        QTest::addColumn<double>("most");
        QTest::newRow("pixels") << "nine conditions 800x1280, pixels"
                                << "tile" << 3.0;
        QTest::newRow("physical") << "nine conditions 800x1280, physical"
                                  << "tile" << 10.0;
        QTest::newRow("resampling") << "friction record resampled"
                                    << "linear" << 0.5;
        QTest::newRow("round trip") << "spectrogram round trip"
                                    << "complex" << 1e-12;
        for (const char* stage : {"frame 240x320 to image 800x1280", "frame 480x640 to image 800x1280"}) {
            QTest::addRow("%s, mirror", stage) << stage << "fast, mirror" << 1.0;
            QTest::addRow("%s, tile", stage) << stage << "fast, tile" << 1.5;
            QTest::addRow("%s, accurate", stage) << stage << "accurate, mirror" << 0.0;
        }
        QTest::newRow("mean") << "mean through a magnitude alone"
                              << "fast" << 0.1;
    }
    void errorsAreWithinWhatIsPromised()
    {
        QFETCH(QString, stage);
        QFETCH(QString, quality);
        QFETCH(double, most);
        const auto row = std::find_if(m_rows.begin(), m_rows.end(), [&](const BenchRow& one) {
            return one.stage == stage.toStdString() && one.quality == quality.toStdString();
        });
        QVERIFY(row != m_rows.end());
        QVERIFY(row->milliseconds && row->error);
        qInfo("%s, %s: %.2f ms, %.3g %s; %s", row->stage.c_str(), row->quality.c_str(), *row->milliseconds, *row->error,
              row->errorUnit.c_str(), row->note.c_str());
        QVERIFY(std::isfinite(*row->error) && *row->error <= most);
        QVERIFY(*row->milliseconds > 0);
    }

    void theMirrorTurnsATwill()
    {
        for (const BenchRow& row : m_rows)
            if (row.quality == "mirror") {
                qInfo("%s, mirror: %.2f ms, %.3g %%", row.stage.c_str(), row.milliseconds.value(), row.error.value());
                QVERIFY(row.error.value() > 20);
            }
    }

private:
    std::vector<BenchRow> m_rows;
};

QTEST_GUILESS_MAIN(BenchCompositionTest)
#include "bench_composition_test.moc"
