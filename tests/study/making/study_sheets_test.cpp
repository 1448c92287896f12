// Pages to print: which piece and place a code belongs to, long words, and sheets of another study in the same folder.
#include "study/making/study_sheets.h"

#include <QRegularExpression>
#include <QString>
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "protocols/files/whole_file.h"
#include "tests/support/error_text.h"
#include "tests/support/raw_sqlite.h"
#include "tests/support/study_builder.h"

namespace {

namespace fs = std::filesystem;

/// Two participants, three fabrics, codes that are fresh for each participant.
constexpr const char* freshCodes = R"({"schema":"vis2hap.protocol/1","name":"fresh","participants":2,"fabrics":3,
  "conditions":["v_grey","h&f"],"swatches":"fresh","phases":[{"questions":["Q1"],"alternatives":3}]})";

constexpr const char* ratings = R"({"schema":"vis2hap.protocol/1","name":"ratings","participants":2,"fabrics":3,
  "conditions":["v_grey","h&f"],"question_texts":{"W1":"How alike?"},"phases":[{"questions":["W1"],
  "scale":{"min":1,"max":5,"step":1,"labels":["unlike the piece","a","b","c","like the piece of fabric <that> lies there"]}}]})";

const QString longId = QString(60, 'x');

}  // namespace

class StudySheetsTest : public QObject {
    Q_OBJECT
    QTemporaryDir m_place;
    int m_folders = 0;

    fs::path newPlace(const char* name) { return m_place.filePath(name + QString::number(++m_folders)).toStdString(); }

    /// A study whose rows somebody altered.
    database::StudyFolder alteredStudy(const char* sql)
    {
        tests::support::StudyRecipe recipe;
        recipe.protocol = freshCodes;
        recipe.hasSwatchCodes = true;
        const auto folder = tests::support::buildStudy(newPlace("study"), recipe);
        tests::support::RawSqlite raw(folder.database());
        raw.dropTriggers();
        const std::string fault = raw.run(std::string("PRAGMA ignore_check_constraints = 1; PRAGMA foreign_keys = 0; ") + sql);
        if (!fault.empty()) throw std::runtime_error(fault);
        return folder;
    }

    void writeSheets(const char* protocol, const fs::path& out)
    {
        tests::support::StudyRecipe recipe;
        recipe.protocol = protocol;
        recipe.fabricIds = {"F01", "F02", longId.toStdString()};
        recipe.hasSwatchCodes = true;
        const auto folder = tests::support::buildStudy(newPlace("study"), recipe);
        study::making::writeSheets({folder, database::StudyStore::Access::Read}, out);
    }

    QString sheet(const char* protocol, const char* name)
    {
        const fs::path out = newPlace("sheets");
        writeSheets(protocol, out);
        return QString::fromStdString(protocols::readWholeFile(out / name));
    }

private Q_SLOTS:
    void aLongNamePushesNoColumnOffThePage()
    {
        const QString page = sheet(freshCodes, "preparation.html");
        QVERIFY(page.contains("overflow-wrap:anywhere") && page.contains("table-layout:fixed;width:100%"));
        QVERIFY(page.contains("<th>code</th><th>id</th><th>fabric</th>"));
        QVERIFY(page.contains("</b></td><td>" + longId + "</td><td>fabric " + longId.mid(1) + "</td></tr>"));
    }

    /// Browsers print a head again on each page that its table reaches.
    void theHeadOfEachTableNamesThePlace()
    {
        const QStringList tables = sheet(freshCodes, "preparation.html").split("<table>").mid(1);
        QCOMPARE(tables.size(), 2);
        for (int place = 1; place <= 2; ++place) {
            const QString head = tables[place - 1].section("</thead>", 0, 0);
            QVERIFY2(head.contains("<thead>") && head.contains(QString("<th colspan=\"3\">Place %1</th>").arg(place)),
                     qPrintable(head));
            QVERIFY2(head.contains("<th>code</th>"), qPrintable(head));
        }
    }

    void eachPlaceHasItsOwnPageOfLabels()
    {
        const QString page = sheet(freshCodes, "labels.html");
        QVERIFY(page.contains(".sheet+.sheet{page-break-before:always}"));
        const QStringList places = page.split("<div class=\"sheet\">").mid(1);
        QCOMPARE(places.size(), 2);
        for (int place = 1; place <= 2; ++place) {
            const QString& labels = places[place - 1];
            QCOMPARE(labels.count("<span class=\"label\">"), 3);
            QCOMPARE(labels.count(QString("</b><small>Place %1</small></span>").arg(place)), 3);
            QVERIFY(!labels.contains(QString("Place %1<").arg(3 - place)));
        }
    }

    void labelsForAllParticipantsNameNoPlace()
    {
        const QString page = sheet(ratings, "labels.html");
        QCOMPARE(page.count("<span class=\"label\"><b>"), 3);
        QVERIFY(page.contains("All participants") && !page.contains("<small>"));
    }

    void aLineShowsWhichWayUpALabelIs()
    {
        const QString page = sheet(freshCodes, "labels.html");
        QVERIFY(QRegularExpression("\\.label b\\{[^}]*border-bottom:1mm solid #000").match(page).hasMatch());
        QVERIFY(page.contains("The line on a label is below the code"));
    }

    /// Text of an SVG does not wrap.
    void theWordsOfTheScaleWrapBelowTheirEnds()
    {
        const QString page = sheet(ratings, "scale-card.html");
        QVERIFY(
            page.contains("</svg>\n<div class=\"ends\"><span>unlike the piece</span>"
                          "<span>like the piece of fabric &lt;that&gt; lies there</span></div>"));
        QVERIFY(page.contains(".ends span{width:47%}"));
        QVERIFY(!page.section("<svg", 1).section("</svg>", 0, 0).contains("unlike"));
    }

    /// Each word has its own number, also where a step is not 1 and the first number is below 0.
    void theCardNumbersEachWord()
    {
        const QByteArray steps = QByteArray(ratings)
                                     .replace("\"min\":1,\"max\":5,\"step\":1", "\"min\":-5,\"max\":5,\"step\":2.5")
                                     .replace("like the piece of fabric <that> lies there", "the same");
        const QString page = sheet(steps.constData(), "scale-card.html");
        QVERIFY2(
            page.contains("<p><b>-5</b> unlike the piece<br><b>-2.5</b> a<br><b>0</b> b<br><b>2.5</b> c<br><b>5</b> the same"),
            qPrintable(page));
    }

    void theHeadOfTheLogHasTheWidestColumn()
    {
        static const QRegularExpression millimetres("<col style=\"width:(\\d+)mm\">");
        const QString page = sheet(freshCodes, "session.html");
        int widest = 0, last = 0;
        for (auto found = millimetres.globalMatch(page); found.hasNext();) {
            last = found.next().captured(1).toInt();
            widest = std::max(widest, last);
        }
        QVERIFY2(last >= 60, qPrintable(QString::number(last)));
        QCOMPARE(last, widest);
        QCOMPARE(page.count("<th>"), 4);
    }

    void alteredCodesAreNoMarkup()
    {
        const auto folder = alteredStudy("UPDATE swatches SET code = '<script>alert(1)</script>'");
        const fs::path out = newPlace("sheets");
        study::making::writeSheets({folder, database::StudyStore::Access::Read}, out);
        for (const char* name : {"labels.html", "preparation.html"}) {
            const QString page = QString::fromStdString(protocols::readWholeFile(out / name));
            QVERIFY2(!page.contains("<script>") && page.contains("&lt;script&gt;alert(1)"), name);
        }
    }

    void aCodeWithoutItsFabricIsNamed()
    {
        const auto folder = alteredStudy("DELETE FROM fabrics");
        const QString said = tests::support::errorOf([&] {
            study::making::writeSheets({folder, database::StudyStore::Access::Read}, newPlace("sheets"));
        });
        for (const char* part : {"1: ", "which the study does not have", "study.db", "vis2hap verify"})
            QVERIFY2(said.contains(part), qPrintable(said));
    }

    void materialsForTheEndsOfAScaleAreNamed_data()
    {
        QTest::addColumn<QString>("phase");
        QTest::addColumn<QString>("texts");
        QTest::addColumn<QString>("materials");
        const QString numbers = R"({"questions":["Q2"],"scale":{"min":0,"max":10}})", none = "{}", nothing;
        const QString usual = "You also need sandpaper, silk and a second piece of one fabric, for the two ends of the scale.",
                      both = "The usual ones are sandpaper, silk and a second piece of one fabric.";
        QTest::newRow("numbers") << numbers << none << usual;
        QTest::newRow("choices") << R"({"questions":["Q1"],"alternatives":3})" << none << nothing;
        QTest::newRow("words") << R"({"questions":["Q2"],"scale":{"min":1,"max":2,"step":1,"labels":["rough","soft"]}})" << none
                               << nothing;
        QTest::newRow("choices, then numbers") << R"({"questions":["Q1"],"alternatives":3},)" + numbers << none << usual;
        QTest::newRow("own cards") << numbers << R"({"card_low":"{number} is rough.","card_high":"{number} is soft."})" << both;
        QTest::newRow("own line") << numbers << R"({"scale_low":"rough","scale_high":"soft"})" << both;
        QTest::newRow("one own end") << numbers << R"({"card_high":"{number} is the softest that you know."})" << both;
        QTest::newRow("another own text") << numbers << R"({"card_title":"our scale"})" << usual;
    }

    void materialsForTheEndsOfAScaleAreNamed()
    {
        QFETCH(QString, phase);
        QFETCH(QString, texts);
        QFETCH(QString, materials);
        const QString protocol = R"({"schema":"vis2hap.protocol/1","name":"ends","participants":2,"fabrics":3,
  "conditions":["v_grey","h&f"],"participant_texts":)" +
                                 texts + R"(,"phases":[)" + phase + "]}";
        const QString page = sheet(protocol.toStdString().c_str(), "preparation.html");
        QVERIFY(page.contains("preparation of the fabric pieces"));
        QCOMPARE(page.contains("You also need"), !materials.isEmpty());
        QVERIFY2(page.contains(materials), qPrintable(page));
    }

    void theCardDescribesTheSameEndsAsItsLine()
    {
        constexpr const char* protocol = R"({"schema":"vis2hap.protocol/1","name":"ends","participants":2,"fabrics":3,
  "conditions":["v_grey","h&f"],"participant_texts":{"scale_low":"rough <as> bark","scale_high":"smooth as glass",
  "card_high":"{number} is like glass."},"phases":[{"questions":["Q2"],"scale":{"min":0,"max":10}}]})";
        const QString card = sheet(protocol, "scale-card.html");
        QVERIFY2(!card.contains("sandpaper"), qPrintable(card));
        QVERIFY2(card.contains("<b>0</b> rough &lt;as&gt; bark<br><b>10</b> is like glass.<br>"), qPrintable(card));
    }

    void sheetsOfAnotherStudyDoNotStay()
    {
        const fs::path out = newPlace("sheets");
        writeSheets(ratings, out);
        QVERIFY(fs::exists(out / "scale-card.html"));
        protocols::writeWholeFile(out / "instructions.html", "<p>notes of the lab</p>");
        writeSheets(freshCodes, out);
        QVERIFY(!fs::exists(out / "scale-card.html"));
        QVERIFY(protocols::readWholeFile(out / "labels.html").find("fresh: labels") != std::string::npos);
        QCOMPARE(protocols::readWholeFile(out / "instructions.html"), std::string("<p>notes of the lab</p>"));
    }
};

QTEST_GUILESS_MAIN(StudySheetsTest)
#include "study_sheets_test.moc"
