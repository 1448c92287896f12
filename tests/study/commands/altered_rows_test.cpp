// Rows of study.db that a person with a shell wrote: every command names the fault and ends with exit code 1, and `verify` still
// lists what is wrong.
#include <QDir>
#include <QTemporaryDir>
#include <QTest>
#include <limits>
#include <stdexcept>

#include "database/study_rows.h"
#include "tests/support/error_text.h"
#include "tests/support/played_session.h"
#include "tests/support/program.h"
#include "tests/support/raw_sqlite.h"
#include "tests/support/study_builder.h"

using support::mustRun;
using support::runProgram;
using tests::support::OpenSession;
using tests::support::RawSqlite;

namespace fs = std::filesystem;

namespace {

/// Runs the statement with triggers and checks out of force.
void alter(const QString& study, const QString& sql)
{
    RawSqlite raw(database::StudyFolder{study.toStdString()}.database());
    raw.dropTriggers();
    const std::string fault = raw.run("PRAGMA ignore_check_constraints = 1; PRAGMA foreign_keys = 0; " + sql.toStdString());
    if (!fault.empty()) throw std::runtime_error(fault + ": " + sql.toStdString());
}

}  // namespace

class AlteredRowsTest : public QObject {
    Q_OBJECT
    QTemporaryDir m_place;

    QString at(const QString& name) const { return m_place.filePath(name); }

    /// A fresh copy: twelve presentations in two phases; S01 has finished, S02 is in mid-session.
    QString copyOf(const QString& sound) const
    {
        QDir(at("tried")).removeRecursively();
        fs::copy(at(sound).toStdString(), at("tried").toStdString(), fs::copy_options::recursive);
        return at("tried");
    }

private Q_SLOTS:
    void initTestCase()
    {
        const database::StudyFolder folder = tests::support::buildStudy(at("blinded").toStdString(), {.hasSwatchCodes = true});
        mustRun({"study", "preregister", at("blinded")});
        OpenSession(folder, "S01").playToEnd();
        OpenSession(folder, "S02").playUntilAnswers(3);
        fs::copy(folder.folder, at("unblinded").toStdString(), fs::copy_options::recursive);
        mustRun({"unblind", at("unblinded"), "--who", "M", "--why", "done"});
    }

    void theFaultIsNamed_data()
    {
        QTest::addColumn<QString>("sound");
        QTest::addColumn<QStringList>("command");
        QTest::addColumn<QString>("sql");
        QTest::addColumn<QString>("said");
        const QStringList plan{"study", "plan", "STUDY", "--csv", "OUT"}, status{"study", "status", "STUDY"},
            report{"report", "STUDY", "--out", "OUT"}, exported{"export", "STUDY", "--out", "OUT"}, leaks{"leak-check", "STUDY"};
        const auto row = [](const char* name, const char* sound, const QStringList& command, const char* sql, const char* said) {
            QTest::addRow("%s: %s, %s", sound, qPrintable(command.mid(0, 2).join(' ')), name) << sound << command << sql << said;
        };
        const char* second = "UPDATE trials SET phase = 2 WHERE slot = 1 AND number = 12";
        row("next phase", "blinded", plan, second, "trial 12 has the phase 2");
        row("phase -1", "blinded", plan, "UPDATE trials SET phase = -1 WHERE number = 3", "trial 3 has the phase -1");
        row("unknown fabric", "blinded", plan, R"(UPDATE trials SET alternatives = '["ZZ"]' WHERE slot = 1 AND number = 1)",
            "trial 1 has the unknown fabric ZZ");
        const char* far = "UPDATE trials SET phase = 99 WHERE slot = 1 AND number = 2";
        row("far phase", "blinded", report, far, "trial 2 has the phase 99");
        row("far phase", "unblinded", report, far, "trial 2 has the phase 99");
        row("far phase", "unblinded", status, far, "trial 2 has the phase 99");
        row("far phase", "unblinded", exported, far, "trial 2 has the phase 99");
        const char* strange = "UPDATE responses SET trial = 999 WHERE id = 1";
        row("strange trial", "unblinded", exported, strange, "an answer of S01 names trial 999");
        row("strange trial", "unblinded", status, strange, "an answer of S01 names trial 999");
        row("strange participant", "unblinded", {"verify", "STUDY"}, "UPDATE responses SET participant = 'X' WHERE id = 1",
            "refers to a missing row of participants");
        row("slot beyond 2^31", "unblinded", exported, "UPDATE participants SET slot = 2147483648 WHERE id = 'S01'",
            "list of S01");
        row("empty trays", "unblinded", status, "UPDATE trials SET alternatives = '[]' WHERE slot = 1",
            "trial 1 has an empty tray");
        const char* other = "UPDATE trials SET number = 99 WHERE slot = 1 AND number = 12";
        row("number", "unblinded", exported, other, "trial 99 stands at place 12");
        row("number", "blinded", leaks, other, "trial 99 stands at place 12");
        row("planned balance", "blinded", status, R"(UPDATE study SET planned_balance = '{"of":5}')",
            "the planned balance of the study cannot be read");
        row("count of 64 bits", "blinded", status,
            R"(UPDATE study SET planned_balance = '{"of":"other designs by the same rules","balance":)"
            R"([{"what":"a","min":1,"max":18446744073709551615}]}')",
            "the planned balance of the study cannot be read");
        const char* negative =
            "UPDATE events SET payload = json_set(payload, '$.json', json_set(json_extract(payload, '$.json'), "
            "'$.plan.participants', -1)) WHERE kind = 'preregistered'";
        row("-1 participants", "blinded", report, negative, "a preregistration in the log cannot be read");
        row("-1 participants", "unblinded", report, negative, "a preregistration in the log cannot be read");
        row("last number of an entry", "blinded", {"verify", "STUDY"},
            "UPDATE events SET sequence = 9223372036854775807 WHERE sequence = 5", "are missing");
        row("first number of an entry", "blinded", {"verify", "STUDY"},
            "UPDATE events SET sequence = -9223372036854775807 - 1 WHERE sequence = 5", "are missing");
    }

    void theFaultIsNamed()
    {
        QFETCH(QString, sound);
        QFETCH(QStringList, command);
        QFETCH(QString, sql);
        QFETCH(QString, said);
        const QString study = copyOf(sound), out = at("out");
        QDir(out).removeRecursively();
        QFile::remove(out);
        alter(study, sql);
        command.replace(command.indexOf("STUDY"), study);
        if (const auto place = command.indexOf("OUT"); place >= 0) command.replace(place, out);
        const auto result = runProgram(command);
        const QString text = result.out + result.err;
        QVERIFY2(text.contains(said), qPrintable(text));
        QVERIFY2(!text.contains("unexpected failure"), qPrintable(text));
        QCOMPARE(result.exitCode, 1);
        const auto verified = runProgram({"verify", study});
        QVERIFY2(verified.exitCode == 1 && !verified.err.contains("unexpected failure"), qPrintable(verified.err));
    }

    void noSessionBeginsWithAnAlteredList_data()
    {
        QTest::addColumn<QString>("sql");
        QTest::addColumn<QString>("said");
        QTest::newRow("phase") << "UPDATE trials SET phase = 2 WHERE slot = 2 AND number = 9"
                               << "trial 9 has the phase 2";
        QTest::newRow("number") << "UPDATE trials SET number = 13 WHERE slot = 2 AND number = 4"
                                << "trial 5 stands at place 4";
        QTest::newRow("code") << "UPDATE trials SET presentation_code = '' WHERE slot = 2 AND number = 9"
                              << "trial 9 has no presentation code";
        QTest::newRow("tray") << "UPDATE trials SET alternatives = '[]' WHERE slot = 2 AND number = 9"
                              << "trial 9 has an empty tray";
        QTest::newRow("no list") << "DELETE FROM trials WHERE slot = 2"
                                 << "the list of trials is empty";
        QTest::newRow("latest stamp") << "UPDATE events SET at_ns = 9223372036854775807 WHERE participant = 'S02'"
                                      << "the stored log is inconsistent: The time stamp";
        QTest::newRow("earliest stamp") << "UPDATE events SET at_ns = -9223372036854775807 - 1 WHERE participant = 'S02'"
                                        << "the stored log is inconsistent: The time stamp";
        QTest::newRow("last number of an entry")
            << "UPDATE events SET sequence = 9223372036854775807 WHERE sequence = (SELECT max(sequence) FROM events)"
            << "the last entry of the log has the largest number";
    }

    void noSessionBeginsWithAnAlteredList()
    {
        QFETCH(QString, sql);
        QFETCH(QString, said);
        const QString study = copyOf("blinded");
        alter(study, sql);
        const QString error = tests::support::errorOf([&] { OpenSession({study.toStdString()}, "S02"); });
        QVERIFY2(error.startsWith("1: ") && error.contains(said), qPrintable(error));
    }

    /// The status of a study is shown also where times were altered: `verify` names these.
    void noTimeExceeds64Bits()
    {
        using Limits = std::numeric_limits<std::int64_t>;
        QCOMPARE(database::secondsBetween(Limits::min(), Limits::max()), static_cast<double>(Limits::max()) / 1e9);
        QCOMPARE(database::secondsBetween(Limits::max(), Limits::min()), static_cast<double>(Limits::min()) / 1e9);
        QCOMPARE(database::secondsBetween(1'000'000'000, 3'500'000'000), 2.5);
        const QString study = copyOf("unblinded");
        alter(study,
              "UPDATE responses SET ready_at = -9223372036854775807 - 1, touched_at = NULL, answered_at = 9223372036854775807");
        for (const QStringList& command : {QStringList{"study", "status", study}, {"report", study, "--out", at("far report")}}) {
            const auto result = runProgram(command);
            QVERIFY2(result.exitCode == 0, qPrintable(result.err));
        }
        QCOMPARE(runProgram({"verify", study}).exitCode, 1);
    }
};

QTEST_GUILESS_MAIN(AlteredRowsTest)
#include "altered_rows_test.moc"
