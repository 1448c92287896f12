// `export --public` where names and designs are extreme, and reports on a study of words: what leaves the lab is text that no
// reader runs, breaks on or takes for something else.
#include <QDir>
#include <QFile>
#include <QRegularExpression>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QTest>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "protocols/files/utf8.h"
#include "tests/study/commands/psych_ds_files.h"
#include "tests/support/played_session.h"
#include "tests/support/program.h"
#include "tests/support/raw_sqlite.h"
#include "tests/support/study_builder.h"

using nlohmann::json;
using support::mustRun;
using support::runProgram;
using namespace tests::support;

namespace {

const QString longName = QString(500, u'ü');
const QString turnedName = QString::fromUtf8("דיון \u202egnp.exe\u202c مجس");  // right to left, and turned around

QString bytesOf(const QString& file)
{
    QFile opened(file);
    return opened.open(QIODevice::ReadOnly) ? QString::fromUtf8(opened.readAll()) : QString("(missing)");
}

/// Text that a scalar of YAML in double quotes stands for; nothing where a character is no text in YAML.
std::optional<QString> scalarOf(const QString& quoted)
{
    if (quoted.size() < 2 || !quoted.startsWith('"') || !quoted.endsWith('"')) return {};
    QString text;
    for (qsizetype at = 1; at + 1 < quoted.size(); ++at) {
        const char16_t c = quoted[at].unicode();
        if (c < 0x20 || c == 0x7f || (c >= 0x80 && c < 0xa0) || c == 0x2028 || c == 0x2029 || c == u'"') return {};
        if (c != u'\\') {
            text += QChar(c);
            continue;
        }
        const QChar escaped = quoted[++at];
        text += escaped == u'u' ? QChar(static_cast<char16_t>(quoted.mid(at + 1, 4).toUInt(nullptr, 16))) : escaped;
        if (escaped == u'u') at += 4;
    }
    return text;
}

/// The scalars of CITATION.cff under these keys, in their order.
QStringList scalarsOf(const QString& citation, const QString& key)
{
    QStringList found;
    for (const QString& line : citation.split('\n'))
        if (const QString start = key + ": "; line.trimmed().startsWith(start) || line.trimmed().startsWith("- " + start))
            found << scalarOf(line.mid(line.indexOf(start) + start.size())).value_or("(no YAML)");
    return found;
}

/// Cells that a spreadsheet would run, and numbers that are none.
QString dangerousCellOf(const Rows& rows)
{
    for (const auto& row : rows)
        for (const std::string& cell : row) {
            const bool isNumber = QRegularExpression("^-?[0-9.e-]+$").match(QString::fromStdString(cell)).hasMatch();
            if (!cell.empty() && std::string("=+-@\t\r").find(cell.front()) != std::string::npos && !isNumber)
                return QString::fromStdString(cell);
        }
    return {};
}

struct Design {
    int fabrics = 3;
    json conditions = json::parse(R"(["v_grey", "h&f"])");
    json phases = json::parse(R"([{"questions": ["Q1"], "alternatives": 3},
                                  {"questions": ["Feel", "Why"], "scale": {"min": 1, "max": 7, "step": 0.5, "sections": 1},
                                   "free_text": ["Why"]}])");
};

std::string protocolOf(const QString& name, const Design& design)
{
    json protocol{{"schema", "vis2hap.protocol/1"},  {"name", name.toStdString()},      {"participants", 2},
                  {"conditions", design.conditions}, {"phases", design.phases},         {"dead_time_seconds", 0},
                  {"fabrics", json::array()},        {"question_texts", json::object()}};
    for (int f = 1; f <= design.fabrics; ++f) protocol["fabrics"].push_back("F0" + std::to_string(f));
    for (const auto& phase : design.phases)
        for (const auto& question : phase["questions"])
            if (question != "Q1") protocol["question_texts"][question.get<std::string>()] = "How is it?";
    return protocol.dump();
}

const json wordsOnly = json::parse(R"([{"questions": ["Why"], "scale": {"min": 1, "max": 7}, "free_text": ["Why"]}])");

/// Conditions of the lab's own, with ready images.
json fortyConditions()
{
    json conditions = json::array();
    for (int c = 1; c <= 40; ++c)
        conditions.push_back({{"id", "mine" + std::to_string(c)}, {"images", "/home/anna.meier/pictures"}});
    return conditions;
}

}  // namespace

class PublicExportTest : public QObject {
    Q_OBJECT
    QTemporaryDir m_place;
    int m_studies = 0;

    QString at(const QString& name) const { return m_place.filePath(name); }

    /// An unblinded study that these people finished.
    QString study(const QString& name, const Design& design, const QStringList& people)
    {
        const QString folder = at(QString("study%1").arg(++m_studies));
        buildStudy(folder.toStdString(), {.protocol = protocolOf("Plain", design)});
        for (const QString& person : people) {
            OpenSession session({folder.toStdString()}, person.toStdString());
            session.stepUntil("Presenting");
            session.send(study::session::Noted{"=a note", true});
            session.playToEnd();
        }
        renameAsBefore((folder + "/study.db").toStdString(), name.toStdString());
        mustRun({"unblind", folder, "--who", "M", "--why", "done"});
        return folder;
    }

private Q_SLOTS:
    void namesStayText_data()
    {
        QTest::addColumn<QString>("name");
        QTest::addColumn<QString>("person");
        QTest::addColumn<QString>("author");
        QTest::newRow("500 characters") << longName << QString(32, u'ü') << QString(100, u'ü');
        QTest::newRow("right to left") << turnedName << QString::fromUtf8("משתתף א") << QString::fromUtf8("د. ليلى");
        QTest::newRow("quotes") << "\"double\" 'single' \\ back ` tick"
                                << "\"P\" 'x'"
                                << "A. \"B\" \\ 'C'";
        QTest::newRow("script") << "</script><script>alert(1)</script>"
                                << "<b>&amp;"
                                << "</script>";
        QTest::newRow("formula") << "=1+1"
                                 << "=1+1"
                                 << "=cmd|' /C calc'!A0";
        QTest::newRow("lines") << QString::fromUtf8("one\nlicense: \"GPL\"\u2028two\u0085three\x7f") << "@x"
                               << "+1";
    }

    void namesStayText()
    {
        QFETCH(const QString, name);
        QFETCH(const QString, person);
        QFETCH(const QString, author);
        const QString of = study(name, {}, {person});
        const QString out = of + "-public";
        const auto said = mustRun({"export", of, "--public", "--author", author, "--out", out});
        QVERIFY2(said.out.contains("12 answers as csv"), qPrintable(said.out));
        QVERIFY2(said.out.contains("(6 answers in words left out)"), qPrintable(said.out));
        const QString citation = bytesOf(out + "/CITATION.cff");
        QCOMPARE(scalarsOf(citation, "title"), QStringList{name});
        QCOMPARE(scalarsOf(citation, "name"), QStringList{author});
        QCOMPARE(scalarsOf(citation, "license"), QStringList{"CC-BY-4.0"});
        QCOMPARE(bytesOf(out + "/LICENSE.txt").count('\n'), 2);
        for (const char* table : {"answers.csv", "participants.csv", "codebook.csv"}) {
            const auto rows = csvRows(bytesOf(out + "/" + table).toStdString());
            QVERIFY2(rows && rows->size() > 1, table);
            QVERIFY2(dangerousCellOf(*rows).isEmpty(), qPrintable(dangerousCellOf(*rows)));
        }
        const Rows people = *csvRows(bytesOf(out + "/participants.csv").toStdString());
        const QString cell = QString::fromStdString(cellAt(people, 1, "participant"));
        QVERIFY2(cell == person || cell == "'" + person, qPrintable(cell));
        for (const QString& file : QDir(out).entryList(QDir::Files)) {
            const QString bytes = bytesOf(out + "/" + file);
            QVERIFY2(!bytes.contains("a note") && !bytes.contains("wall_time,"), qPrintable(file));
        }
        // The exported answers give the numbers of the study's own report.
        mustRun({"report", of, "--out", of + "-report", "--page-only"});
        mustRun({"report", "--from", out + "/answers.csv", "--protocol", of + "/protocol.json", "--out", of + "-again",
                 "--page-only"});
        const auto partsOf = [](const QString& report) {
            const json all = json::parse(bytesOf(report + "/results.json").toStdString());
            json questions = all["questions"];
            questions.erase("Why");  // words stay in the lab
            return questions.dump() + all["comparisons"].dump();
        };
        QCOMPARE(partsOf(of + "-again"), partsOf(of + "-report"));
    }

    void designsOfAnySizeAreExported_data()
    {
        QTest::addColumn<int>("conditions");
        QTest::addColumn<int>("people");
        QTest::addColumn<bool>("isWords");
        QTest::addColumn<int>("rows");
        QTest::newRow("40 conditions") << 40 << 1 << false << 40 * 3 * 2;
        QTest::newRow("two conditions") << 2 << 2 << false << 2 * 2 * 3 * 2;
        QTest::newRow("words only") << 2 << 2 << true << 0;
        QTest::newRow("no answers") << 2 << 0 << false << 0;
        QTest::newRow("no words") << 2 << 0 << true << 0;
    }

    void designsOfAnySizeAreExported()
    {
        QFETCH(const int, conditions);
        QFETCH(const int, people);
        QFETCH(const bool, isWords);
        QFETCH(const int, rows);
        Design design;
        if (conditions == 40) design.conditions = fortyConditions();
        if (isWords) design.phases = wordsOnly;
        const QStringList names = QStringList{"P1", "P2"}.mid(0, people);
        const QString of = study("Any size", design, names);
        for (const char* format : {"csv", "psych-ds"}) {
            const auto said = mustRun({"export", of, "--public", "--format", format, "--out", of + "-" + format});
            QVERIFY2(said.out.contains(QString("%1 answers as %2").arg(rows).arg(format)), qPrintable(said.out));
        }
        // A folder of ready images may name an account.
        const QString protocol = bytesOf(of + "-psych-ds/materials/protocol-1.json");
        QVERIFY(!protocol.contains("anna.meier") && protocol.contains("pictures") == (conditions == 40));
        const Dataset dataset = datasetIn("any size", (of + "-psych-ds").toStdString());
        const auto sameAnswers = csvRows(bytesOf(of + "-csv/answers.csv").toStdString());
        QVERIFY(sameAnswers && dataset.answers() == *sameAnswers);
        QCOMPARE(int(sameAnswers->size()) - 1, rows);
        const Rows table = *csvRows(bytesOf(of + "-csv/answers.csv").toStdString());
        std::set<std::string> met;
        for (std::size_t row = 1; row < table.size(); ++row) met.insert(cellAt(table, row, "condition"));
        QCOMPARE(int(met.size()), rows == 0 ? 0 : conditions);
    }

    // A study of words has no numbers, so no script can compute any; it says so.
    void aStudyOfWordsIsReported_data()
    {
        QTest::addColumn<QString>("language");
        QTest::addColumn<int>("people");
        for (const char* language : {"R", "python"})
            for (const int people : {0, 2}) QTest::addRow("%s, %d people", language, people) << language << people;
    }

    void aStudyOfWordsIsReported()
    {
        QFETCH(const QString, language);
        QFETCH(const int, people);
        Design design;
        design.phases = wordsOnly;
        const QString of = study("Words", design, QStringList{"P1", "P2"}.mid(0, people));
        const auto run = runProgram({"report", of, "--out", of + "-report", "--page-only", "--check-with", language});
        QVERIFY2(run.exitCode == 0 || run.out.contains("needs scipy"), qPrintable(run.out + run.err));
        QCOMPARE(bytesOf(of + "-report/reproduce/expected.csv").count('\n'), 1);
        QVERIFY(QFile::exists(of + "-report/index.html"));
        const QString program = language == "R" ? "Rscript" : "python3";
        if (QStandardPaths::findExecutable(program).isEmpty()) {
            QVERIFY2(run.out.contains("not checked: " + program + " is not installed"), qPrintable(run.out));
            QSKIP(qPrintable(program + " is not installed, so its script was not run"));
        }
        if (run.out.contains("needs scipy")) QSKIP("scipy is not installed, so analysis.py was not run");
        QVERIFY2(run.out.contains("nothing to compute") && run.out.contains("reproduced: 0 of 0"), qPrintable(run.out));
    }
};

QTEST_GUILESS_MAIN(PublicExportTest)
#include "public_export_test.moc"
