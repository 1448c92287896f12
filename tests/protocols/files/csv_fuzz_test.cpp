// Feeds damaged files to the reader of tables. It must return a table or refuse the file by name. VIS2HAP_FUZZ_SECONDS makes
// the run longer.
#include <QElapsedTimer>
#include <QTest>
#include <cmath>

#include "protocols/files/csv_table.h"
#include "protocols/files/errors.h"
#include "protocols/random.h"
#include "tests/support/mutated_files.h"

namespace {

/// The reader returns every table exactly as it was written.
bool readsBack(const protocols::CsvTable& table)
{
    std::string text = protocols::csvRow(table.columns);
    for (const auto& row : table.rows) text += protocols::csvRow(row);
    const auto again = protocols::csvTableFrom(text, "again");
    return again.columns == table.columns && again.rows == table.rows;
}

}  // namespace

class CsvFuzzTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void spoiltTablesGiveNumbersOrANamedRefusal()
    {
        const std::string seed =
            "participant,fabric,condition,Q1_correct,Q2,Q3,Q4,note\n\"P 1\",F01,h_g+f_g,1,5.5,4,3,\"said \"\"soft\"\",\nthen "
            "rough\"\n"
            "P2,F01,h,0,NA,,7e0,\nP2,F02,h,1,1,2,3,x\r\n";
        auto random = protocols::Random::stream(7, "tables");
        QElapsedTimer clock;
        clock.start();
        int taken = 0, refused = 0;
        do {
            const std::string spoilt = mutated_files::mutated(seed, random);
            try {
                const auto table = protocols::csvTableFrom(spoilt, "spoilt.csv");
                for (std::size_t row = 0; row < table.rows.size(); ++row)
                    for (std::size_t column = 3; column < std::min<std::size_t>(7, table.columns.size()); ++column) {
                        const auto number = protocols::numberOrMissing(table, row, column);
                        QVERIFY2(!number || std::isfinite(*number), spoilt.c_str());
                    }
                QVERIFY2(readsBack(table), spoilt.c_str());
                ++taken;
            } catch (const protocols::Error&) {
                ++refused;
            }
        } while (clock.elapsed() < 1000 * mutated_files::fuzzSeconds(1));
        qInfo("%d taken, %d refused", taken, refused);
        QVERIFY(taken > 0 && refused > 0);
    }
};

QTEST_GUILESS_MAIN(CsvFuzzTest)
#include "csv_fuzz_test.moc"
