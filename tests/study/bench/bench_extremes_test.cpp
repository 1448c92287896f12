// Every line of `vis2hap bench extremes`: the promised digits or the refusal, and the page that README links.
#include <QCoreApplication>
#include <QTest>

#include "protocols/files/markup_text.h"
#include "protocols/files/whole_file.h"
#include "study/bench/extremes/extremes_page.h"

using study::bench::ExtremeAnswer;
using study::bench::ExtremeCase;
using study::bench::ExtremeResult;

class BenchExtremesTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void everyCaseReachesItsDigits_data()
    {
        QTest::addColumn<int>("number");
        m_cases = study::bench::extremeCases();
        QVERIFY(m_cases.size() > 80);
        for (std::size_t i = 0; i < m_cases.size(); ++i)
            QTest::newRow((m_cases[i].room + ", " + m_cases[i].name()).c_str()) << static_cast<int>(i);
    }
    void everyCaseReachesItsDigits()
    {
        QFETCH(int, number);
        const ExtremeCase& asked = m_cases.at(static_cast<std::size_t>(number));
        const ExtremeResult result{asked, asked.ours(), 0, {}};
        QVERIFY2(result.isReached(),
                 qPrintable(QString("answer \"%1%2\", truth %3, %4 digits of %5")
                                .arg(result.ours.decimal.c_str(), result.ours.refusal.c_str(), asked.truth.c_str())
                                .arg(result.digits().value_or(-1))
                                .arg(asked.leastDigits)));
        QVERIFY(!asked.source.empty());
        QVERIFY(asked.mustRefuse() || asked.leastDigits >= 4);
    }

    void noTwoLinesAreTheSame()
    {
        QSet<QString> names;
        for (const ExtremeCase& one : study::bench::extremeCases()) {
            const QString name = QString::fromStdString(one.room + one.name());
            QVERIFY2(!names.contains(name), qPrintable(name));
            names << name;
        }
    }

    void digitsAreCounted()
    {
        const auto digits = [](const char* answer, const char* truth) { return study::bench::correctDigits(answer, truth); };
        QCOMPARE(digits("0.75", "0.75").value(), 16.0);
        QVERIFY(std::abs(digits("0.1001", "0.1").value() - 3) < 1e-9);
        QVERIFY(std::abs(digits("1e-12", "0").value() - 12) < 1e-9);
        QCOMPARE(digits("7", "1").value(), 0.0);
        // Beyond double.
        QVERIFY(std::abs(digits("2.002e+400", "2e+400").value() - 3) < 1e-9);
        QVERIFY(!digits("inf", "2e+400") && !digits("", "1") && !digits("1", "refused"));
    }

    void aWrongAnswerIsShownAsWrong()
    {
        ExtremeCase asked{"statistics", "a < b", "p", "refused", "no such number", 0, {}, {}};
        ExtremeResult result{asked, {"0.015", ""}, 1, {}};
        QVERIFY(!result.isReached() && !study::bench::allReached({result}));
        result.peers["scipy"] = {{"0.015", ""}, 2};
        result.peers["R"] = {{"", "data are constant"}, 2};
        const QString page = QString::fromStdString(study::bench::extremesPage({result}, "2 cores", true));
        QVERIFY(page.contains("a &lt; b") && page.contains("class=\"wrong\"") && page.contains("OpenCV is not installed"));
        QVERIFY(page.contains("R: 1 of the 1 cases") && page.contains("scipy: 0 of the 1 cases"));
        result.ours = {"", "no variation"};
        QVERIFY(result.isReached());
        result.asked.truth = "0.5";
        result.asked.leastDigits = 10;
        QVERIFY(!result.isReached());
        result.ours = {"0.5", ""};
        QVERIFY(result.isReached());
    }

    /// README links this page; `vis2hap bench extremes --peers --page study/bench/extremes/extremes.html` makes it anew.
    void theKeptPageShowsEveryCase()
    {
        const std::string page = protocols::readWholeFile(VIS2HAP_SOURCE_DIR "/study/bench/extremes/extremes.html");
        QVERIFY(page.find("prefers-color-scheme:dark") != std::string::npos &&
                page.find("width=device-width") != std::string::npos);
        std::size_t from = 0;
        for (const ExtremeCase& one : study::bench::extremeCases()) {
            const auto line = page.find("<tr><th scope=\"row\">" + protocols::escapedMarkup(one.input) + "<span>" +
                                            protocols::escapedMarkup(one.asked) + "</span>",
                                        from);
            QVERIFY2(line != std::string::npos, one.name().c_str());
            from = page.find("</tr>", line);
            const std::string row = page.substr(line, from - line);
            QVERIFY2(row.find("<b>" + protocols::escapedMarkup(one.truth) + "</b>") != std::string::npos, one.name().c_str());
            const auto ours = row.find("data-label=\"vis2hap\" class=\"right\"");
            QVERIFY2(ours != std::string::npos, one.name().c_str());
            const auto first = row.find("<b>", ours) + 3;
            const std::string shown = row.substr(first, row.find("</b>", first) - first);
            if (one.mustRefuse())
                QCOMPARE(shown, std::string("refused"));
            else
                QVERIFY2(study::bench::correctDigits(shown, one.truth).value_or(-1) >= one.leastDigits, one.name().c_str());
        }
    }

private:
    std::vector<ExtremeCase> m_cases;
};

QTEST_GUILESS_MAIN(BenchExtremesTest)
#include "bench_extremes_test.moc"
