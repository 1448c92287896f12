// Evidence that leaves the study: the log in exports, the data sheet; and the rule for names of people.
#include <QCryptographicHash>
#include <QDir>
#include <QFile>
#include <QProcess>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QTest>
#include <nlohmann/json.hpp>

#include "database/evidence/acts.h"
#include "tests/study/commands/evidence_study.h"
#include "tests/support/program.h"
#include "tests/support/raw_sqlite.h"

using nlohmann::json;
using protocols::CsvTable;
using support::mustRun;
using support::runProgram;
using tests::evidence::bytesOf;
using tests::evidence::cell;
using tests::evidence::headIn;
using tests::evidence::tableOf;

namespace {

QByteArray field(const QByteArray& bytes) { return QByteArray::number(bytes.size()) + ':' + bytes + ','; }

/// The head of the log by the recipe of log.txt; empty where an entry does not fit.
QString headOf(const CsvTable& log)
{
    QString previous;
    for (std::size_t row = 0; row < log.rows.size(); ++row) {
        QByteArray bytes = field(previous.toUtf8());
        for (const char* column : {"sequence", "participant", "sitting", "kind", "places", "commitment"})
            bytes += field(cell(log, row, column).toUtf8());
        const QString own = QCryptographicHash::hash(bytes, QCryptographicHash::Sha256).toHex();
        if (cell(log, row, "previous_hash") != previous || cell(log, row, "hash") != own) return {};
        previous = own;
    }
    return QString::number(log.rows.size()) + ':' + previous;
}

}  // namespace

class EvidenceCommandTest : public QObject {
    Q_OBJECT
    QTemporaryDir m_place;
    int m_studies = 0;

    QString at(const QString& name) const { return m_place.filePath(name); }

    QString playedStudy(const std::string& protocol = tests::evidence::askingProtocol)
    {
        const QString study = at(QString("study%1").arg(++m_studies));
        tests::evidence::playStudy(study.toStdString(), protocol);
        return study;
    }

private Q_SLOTS:
    void theExportedLogLeadsToTheHead_data()
    {
        QTest::addColumn<QString>("format");
        for (const char* format : {"csv", "json", "script"}) QTest::newRow(format) << format;
    }
    void theExportedLogLeadsToTheHead()
    {
        QFETCH(const QString, format);
        const QString study = playedStudy();
        const QString out = at("log-" + format);
        const auto run = mustRun({"export", study, "--out", out, "--format", format, "--with-log"});
        QVERIFY2(run.out.contains("log.csv holds the log, acts.csv"), qPrintable(run.out));
        const auto log = tableOf(out + "/log.csv");
        QCOMPARE(headOf(log), headIn(study));
        QVERIFY(bytesOf(out + "/log.txt").contains("Head: " + headIn(study)));
        QVERIFY(tableOf(out + "/acts.csv").rows.empty());
    }

    /// Exports, backups and reports made before, each with the head of the log at that time.
    void theExportedActsTellWhatWasMade()
    {
        const QString study = playedStudy();
        mustRun({"export", study, "--out", at("act-one")});
        mustRun({"backup", study, "--out", at("act-two.tar")});
        mustRun({"export", study, "--out", at("act-three"), "--with-log"});
        const auto acts = tableOf(at("act-three/acts.csv"));
        QCOMPARE(acts.rows.size(), std::size_t{2});
        QCOMPARE(cell(acts, 0, "kind"), "export");
        QCOMPARE(cell(acts, 1, "kind"), "backup");
        const json details = json::parse(cell(acts, 1, "details").toStdString());
        QCOMPARE(QString::fromStdString(details["path"]), at("act-two.tar"));
        QCOMPARE(QString("%1:%2").arg(details["entry"].get<int>()).arg(QString::fromStdString(details["hash"])), headIn(study));
        QCOMPARE(cell(acts, 1, "previous_hash"), cell(acts, 0, "hash"));
        QVERIFY(bytesOf(at("act-three/log.txt")).contains("Acts: 2:" + cell(acts, 1, "hash")));
    }

    /// The backup is made all the same: it may be the last chance to keep the answers.
    void aBackupSaysThatAKeyIsDamaged()
    {
        const QString study = playedStudy();
        QFile key(study + "/allocation-key.json");
        QVERIFY(key.open(QIODevice::Append) && key.write("x") == 1);
        key.close();
        const auto run = mustRun({"backup", study, "--out", at("damaged-key.tar")});
        QVERIFY2(run.err.startsWith("warning: ") && run.err.contains("the allocation key is not the one committed"),
                 qPrintable(run.err));
        QVERIFY2(run.out.contains("acts head 1:"), qPrintable(run.out));
        const auto acts = database::actsOf({{study.toStdString()}, database::StudyStore::Access::Read});
        QVERIFY(acts.front().kind == "backup" && acts.front().note.find("allocation key") != std::string::npos);
    }

    /// The rescue file holds what was erased afterwards; `erase` said so once, the backup says it again.
    void aBackupNamesRescueFilesFromBeforeAnErasure()
    {
        const QString study = playedStudy();
        QVERIFY(QFile::copy(study + "/study.db", study + "/rescue-1.db"));
        QVERIFY(mustRun({"backup", study, "--out", at("with-rescue.tar")}).err.isEmpty());
        QCOMPARE(runProgram({"erase", study, "--participant", "P1", "--who", "Ada", "--why", "on request"}).exitCode, 1);
        const auto run = mustRun({"backup", study, "--out", at("after-erasure.tar")});
        QVERIFY2(run.err.startsWith("warning: rescue-1.db: ") && run.err.contains("may hold what was erased"),
                 qPrintable(run.err));
    }

    void anExportHoldsNoLogUnlessAsked()
    {
        mustRun({"export", playedStudy(), "--out", at("plain")});
        QVERIFY(!QFile::exists(at("plain/log.csv")) && !QFile::exists(at("plain/acts.csv")) &&
                !QFile::exists(at("plain/log.txt")));
    }

    /// The clear part alone: no salt, no payload, no answer.
    void theExportedLogHoldsNoContent()
    {
        const QString study = playedStudy();
        mustRun({"export", study, "--out", at("clear"), "--with-log"});
        const QString text = bytesOf(at("clear/log.csv"));
        tests::support::RawSqlite raw(study.toStdString() + "/study.db");
        const auto salts = raw.rows("SELECT salt FROM events");
        QVERIFY(salts.size() > 50);
        for (const auto& salt : salts) QVERIFY(!text.contains(QString::fromStdString(salt)));
        for (const char* word : {"glue", "wrong piece", "F01", "F02", "tenths", "Ada", "v_grey", "h&f"})
            QVERIFY2(!text.contains(word), word);
    }

    /// log.txt ends with a program for Python. It must compute both chains, and find an altered entry and an altered act.
    void theRecipeRuns()
    {
        const QString python = QStandardPaths::findExecutable("python3");
        if (python.isEmpty()) QSKIP("python3 is not installed: the recipe is not run");
        const QString study = playedStudy();
        mustRun({"export", study, "--out", at("before-recipe")});
        mustRun({"export", study, "--out", at("recipe"), "--with-log"});
        const QString recipe = bytesOf(at("recipe/log.txt"));
        QFile program(at("check.py"));
        QVERIFY(program.open(QIODevice::WriteOnly));
        program.write(recipe.mid(recipe.indexOf("import csv")).toUtf8());
        program.close();
        const auto result = [&] {
            QProcess run;
            run.start(python, {program.fileName(), at("recipe/log.csv"), at("recipe/acts.csv")});
            run.waitForFinished();
            return QString::fromUtf8(run.readAllStandardOutput() + run.readAllStandardError()).trimmed();
        };
        const auto replaced = [&](const QString& file, const QString& before, const QString& after) {
            QString text = bytesOf(file);
            text.replace(text.indexOf(before), before.size(), after);
            QFile altered(file);
            return altered.open(QIODevice::WriteOnly) && altered.write(text.toUtf8()) > 0;
        };
        const auto acts = tableOf(at("recipe/acts.csv"));
        QCOMPARE(result(), "log " + headIn(study) + "\nacts 1:" + cell(acts, 0, "hash"));
        QVERIFY(replaced(at("recipe/acts.csv"), "before-recipe", "after--recipe"));
        QCOMPARE(result(), "act 1 was altered, or one before it is missing");
        QVERIFY(replaced(at("recipe/acts.csv"), "after--recipe", "before-recipe"));
        QVERIFY(replaced(at("recipe/log.csv"), "noted", "rated"));
        QVERIFY2(result().startsWith("entry ") && result().contains("was altered"), qPrintable(result()));
    }

    /// Somebody chained the log anew and left the acts: their heads are no longer in it.
    void theRecipeComparesTheActsWithTheLog()
    {
        const QString python = QStandardPaths::findExecutable("python3");
        if (python.isEmpty()) QSKIP("python3 is not installed: the recipe is not run");
        const QString study = playedStudy(), other = playedStudy();
        mustRun({"export", study, "--out", at("first")});
        mustRun({"export", study, "--out", at("own-acts"), "--with-log"});
        mustRun({"export", other, "--out", at("other-log"), "--with-log"});
        const QString recipe = bytesOf(at("own-acts/log.txt"));
        QFile program(at("compare.py"));
        QVERIFY(program.open(QIODevice::WriteOnly));
        program.write(recipe.mid(recipe.indexOf("import csv")).toUtf8());
        program.close();
        QProcess run;
        run.start(python, {program.fileName(), at("other-log/log.csv"), at("own-acts/acts.csv")});
        run.waitForFinished();
        QCOMPARE(QString::fromUtf8(run.readAllStandardError()).trimmed(), "act 1 names a head that the log does not have");
        QVERIFY(run.exitCode() != 0);
    }

    void bothExportsAreActs()
    {
        const QString study = playedStudy();
        mustRun({"export", study, "--out", at("act1"), "--with-log"});
        mustRun({"export", study, "--participant", "P2", "--out", at("act2")});
        const database::StudyStore store({study.toStdString()}, database::StudyStore::Access::Read);
        const auto acts = actsOf(store);
        QCOMPARE(acts.size(), std::size_t{2});
        QVERIFY(acts[0].path.ends_with("act1") && acts[1].path.ends_with("act2") && acts[1].kind == database::personExport);
    }

    void aPrintedCommandQuotesAPathWithBlanks()
    {
        const QString study = at("Stüdie mit Leer");
        QVERIFY(QFile::rename(playedStudy(), study));
        mustRun({"study", "sheets", study, "--out", at("quoted pages")});
        const QString text = bytesOf(at("quoted pages/labels.html"));
        QVERIFY(text.contains("vis2hap verify &#39;Stüdie mit Leer&#39; --against ") ||
                text.contains("vis2hap verify 'Stüdie mit Leer' --against "));
    }

    void theDataSheetIsPrintedAndWritten()
    {
        const QString study = playedStudy();
        mustRun({"export", study, "--out", at("listed")});
        const auto run = mustRun({"study", "data-sheet", study});
        QVERIFY2(run.out.contains("Data sheet of the study A <study> of touch") && run.out.contains("2 human"),
                 qPrintable(run.out));
        QVERIFY2(run.out.contains(at("listed")), qPrintable(run.out));
        mustRun({"study", "data-sheet", study, "--out", at("sheet.txt")});
        QVERIFY(bytesOf(at("sheet.txt")).contains("6. Erasure"));
        const json sheet = json::parse(mustRun({"study", "data-sheet", study, "--json"}).out.toStdString());
        QCOMPARE(sheet["schema"].get<std::string>(), "vis2hap.data-sheet/1");
        QCOMPARE(sheet["acts"].size(), std::size_t{1});
        QCOMPARE(runProgram({"study", "data-sheet", study, "--out", study + "/sheet.txt"}).exitCode, 2);
    }

    void namesAndReasonsAreOneLine_data()
    {
        QTest::addColumn<QStringList>("call");
        QTest::addColumn<QString>("fault");
        const QString control = "Ada\x1b[2J", lines = "Ada\nBob", turned = QString::fromUtf8("Ada\u202Eadb");
        const QString tooLong(201, 'x'), tooLongReason(1001, 'x');
        const QStringList unblind{"unblind", "STUDY"}, erase{"erase", "STUDY", "--participant", "P1"};
        QTest::newRow("unblind who") << unblind + QStringList{"--who", control, "--why", "x"}
                                     << "--who: the text holds a control";
        QTest::newRow("unblind why") << unblind + QStringList{"--who", "x", "--why", lines} << "--why: the text holds a control";
        QTest::newRow("unblind blank") << unblind + QStringList{"--who", " ", "--why", "x"} << "--who: the text is empty";
        QTest::newRow("erase who") << erase + QStringList{"--who", turned, "--why", "x"} << "--who: the text holds an invisible";
        QTest::newRow("erase why") << erase + QStringList{"--who", "x", "--why", tooLongReason}
                                   << "--why: the text has 1001 bytes";
        QTest::newRow("amend") << QStringList{"study", "amend", "STUDY", "--who", tooLong, "--why", "x"}
                               << "--who: the text has 201 bytes";
        QTest::newRow("preregister") << QStringList{"study", "preregister", "STUDY", "--who", lines}
                                     << "--who: the text holds a control";
        QTest::newRow("replay") << QStringList{"replay", "STUDY", "script.json", "--operator", control}
                                << "--operator: the text holds a control";
        QTest::newRow("app") << QStringList{"STUDY", "--operator", ""} << "--operator: the text is empty";
    }
    void namesAndReasonsAreOneLine()
    {
        QFETCH(QStringList, call);
        QFETCH(const QString, fault);
        static const QString study = playedStudy();
        call.replaceInStrings("STUDY", study);
        const auto run = runProgram(call);
        QCOMPARE(run.exitCode, 2);
        QVERIFY2(run.err.contains(fault), qPrintable(run.err));
        QVERIFY2(!run.err.contains('\x1b') && run.err.count('\n') == 1, qPrintable(run.err));
    }

    /// Whoever writes into study.db could otherwise change what the terminal shows, and add lines to a certificate. Studies with
    /// such a name were made by earlier versions.
    void alteredCellsSteerNoTerminal()
    {
        const QString study = playedStudy();
        mustRun({"export", study, "--out", at("altered-act")});
        {
            tests::support::RawSqlite raw((study + "/study.db").toStdString());
            raw.dropTriggers();
            for (const char* sql :
                 {"UPDATE study SET name = 'a' || char(27) || '[2J' || char(10) || 'Log head: 1:forged' || printf('%.*c', 800, "
                  "'x')",
                  "UPDATE events SET hash = char(27) || '[2J' || hash WHERE sequence = (SELECT MAX(sequence) FROM events)",
                  "UPDATE acts SET hash = char(27) || '[2J' || hash, details = json_set(details, '$.host', 'h' || char(10) || "
                  "'Forged: x' || char(27) || 'c')"})
                QCOMPARE(raw.run(sql), std::string());
        }
        const auto verified = runProgram({"verify", study});
        QVERIFY2(verified.out.contains(":\\x1b[2J"), qPrintable(verified.out));
        const auto status = mustRun({"study", "status", study});
        QVERIFY2(status.out.contains("x (blinded)\n") && !status.out.contains("\nLog head: 1:forged"), qPrintable(status.out));
        const QString erased = runProgram({"erase", study, "--participant", "P1", "--who", "Ada", "--why", "on request"}).out;
        const QDir erasures(study + "/erasures");
        QCOMPARE(erasures.entryList(QDir::Files).size(), 1);
        const QString certificate = bytesOf(erasures.filePath(erasures.entryList(QDir::Files).front()));
        QVERIFY2(!certificate.contains("\nLog head: 1:forged") && !certificate.contains("\nForged: x"), qPrintable(certificate));
        QVERIFY2(certificate.contains("on h Forged: x\\x1bc, "), qPrintable(certificate));
        for (const QString& text : {verified.out, verified.err, status.out, erased, certificate,
                                    runProgram({"export", study, "--out", at("altered")}).out,
                                    runProgram({"backup", study, "--out", at("altered.tar")}).out})
            QVERIFY2(!text.contains('\x1b'), qPrintable(text));
    }
};

QTEST_GUILESS_MAIN(EvidenceCommandTest)
#include "evidence_command_test.moc"
