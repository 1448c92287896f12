// What no command line may overwrite: files of a study, files that the command reads, and files to which a link leads.
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <QDir>
#include <QFile>
#include <QProcess>
#include <QTemporaryDir>
#include <QTest>
#include <cerrno>
#include <filesystem>
#include <fstream>

#include "protocols/files/whole_file.h"
#include "protocols/protocol_json.h"
#include "study/commands/parts/study_backup.h"
#include "tests/support/played_session.h"
#include "tests/support/program.h"
#include "tests/support/study_builder.h"

using support::mustRun;
using support::runProgram;

namespace {

namespace fs = std::filesystem;

bool refusesModesAndTimes = false;

int refused()
{
    errno = EPERM;
    return -1;
}

QByteArray bytesOf(const QString& file)
{
    QFile in(file);
    if (!in.open(QIODevice::ReadOnly)) return "unreadable";
    return in.readAll();
}

/// Runs the program in a shell, where PROGRAM stands for it. Returns the exit code.
int inShell(QString line, QString* errors = nullptr)
{
    QProcess shell;
    shell.start("sh", {"-c", line.replace("PROGRAM", VIS2HAP_PROGRAM)});
    if (!shell.waitForFinished(60'000)) return -1;
    if (errors) *errors = QString::fromUtf8(shell.readAllStandardError());
    return shell.exitCode();
}

}  // namespace

// The linker prefers these definitions to those of the C library.
extern "C" {

int fchmod(int descriptor, mode_t mode) noexcept
{
    return refusesModesAndTimes ? refused() : static_cast<int>(::syscall(SYS_fchmod, descriptor, mode));
}

int fchmodat(int folder, const char* file, mode_t mode, int) noexcept
{
    return refusesModesAndTimes ? refused() : static_cast<int>(::syscall(SYS_fchmodat, folder, file, mode));
}

int utimensat(int folder, const char* file, const struct timespec times[2], int flags) noexcept
{
    return refusesModesAndTimes ? refused() : static_cast<int>(::syscall(SYS_utimensat, folder, file, times, flags));
}
}

class SafeOutputsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void noOutputLiesInAStudy_data()
    {
        QTest::addColumn<QString>("call");
        QTest::newRow("status") << "study status STUDY --json STUDY/study.db";
        QTest::newRow("verify") << "verify STUDY --json STUDY/allocation-key.json";
        QTest::newRow("station key") << "verify STUDY --json STUDY/station-key.json";
        QTest::newRow("plan") << "study plan STUDY --csv STUDY/study.db";
        QTest::newRow("preregister") << "study preregister STUDY --json STUDY/study.db";
        QTest::newRow("leak-check") << "leak-check STUDY --json STUDY/study.db";
        QTest::newRow("data sheet") << "study data-sheet STUDY --json STUDY/study.db";
        QTest::newRow("protocol") << "protocol check STUDY/protocol.json --json STUDY/study.db";
        QTest::newRow("export") << "export STUDY --out STUDY";
        QTest::newRow("export below") << "export STUDY --out STUDY/stimuli/new";
        QTest::newRow("report") << "report STUDY --out STUDY/report";
        QTest::newRow("sheets") << "study sheets STUDY --out STUDY/stimuli";
        QTest::newRow("signing key") << "study signing-key --no-passphrase --out STUDY/x";
        QTest::newRow("picture")
            << "display calibrate T --display glass --speed 20 --finger index --out STUDY-r.json --picture STUDY/study.db";
        QTest::newRow("images") << "study new STUDY-2 --dataset D --protocol STUDY/protocol.json --images STUDY/images";
    }
    void noOutputLiesInAStudy()
    {
        QFETCH(QString, call);
        const QString study = newStudy();
        const QByteArray before = bytesOf(study + "/study.db");
        const auto result = runProgram(call.replace("STUDY", study).split(' '));
        QCOMPARE(result.exitCode, 2);
        QVERIFY2(result.err.contains("would lie in the study folder"), qPrintable(result.err));
        QCOMPARE(bytesOf(study + "/study.db"), before);
        QVERIFY(mustRun({"verify", study}).out.contains("sound"));
    }

    /// A script whose variable is not set must not pass for one that made its check.
    void anEmptyArgumentIsRefused_data()
    {
        QTest::addColumn<QStringList>("call");
        QTest::addColumn<QString>("argument");
        QTest::newRow("head") << QStringList{"verify", "STUDY", "--against", ""} << "--against";
        QTest::newRow("key") << QStringList{"verify", "STUDY", "--against", "1:x", "--public-key", ""} << "--public-key";
        QTest::newRow("passphrase") << QStringList{"study", "status", "STUDY", "--passphrase-file", ""} << "--passphrase-file";
        QTest::newRow("study") << QStringList{"verify", ""} << "STUDY";
    }
    void anEmptyArgumentIsRefused()
    {
        QFETCH(QStringList, call);
        QFETCH(const QString, argument);
        const auto result = runProgram(call.replaceInStrings("STUDY", newStudy()));
        QCOMPARE(result.exitCode, 2);
        QVERIFY2(result.err.contains(argument + " is given, and empty"), qPrintable(result.err));
    }

    void noOutputLiesInTheFolderOfAStudyOnAServer()
    {
        const QString folder = m_place.filePath("station");
        fs::create_directory(folder.toStdString());
        for (const char* name : {"/server.json", "/protocol.json"})
            protocols::writeWholeFile(folder.toStdString() + name, protocols::paperProtocolJson());
        const auto result = runProgram({"protocol", "check", folder + "/protocol.json", "--json", folder + "/server.json"});
        QCOMPARE(result.exitCode, 2);
        QVERIFY2(result.err.contains("would lie in the study folder"), qPrintable(result.err));
    }

    void noOutputReplacesAFileThatIsRead_data()
    {
        QTest::addColumn<QString>("call");
        QTest::newRow("describe") << "describe table.csv --column a --json table.csv";
        QTest::newRow("protocol") << "protocol show protocol.json --json protocol.json";
        QTest::newRow("another name of it") << "protocol check protocol.json --json ./protocol.json";
        QTest::newRow("passphrase") << "study status STUDY --passphrase-file words --json words";
        QTest::newRow("signing key") << "study sign STUDY --key key --out key";
        QTest::newRow("the list of a data set") << "evaluate set --json set/dataset.json";
        QTest::newRow("a map of a data set") << "evaluate ./set --json set/F01/../F01/height.png";
    }
    void noOutputReplacesAFileThatIsRead()
    {
        QFETCH(QString, call);
        const QString study = newStudy();
        const QDir place(m_place.path());
        for (const char* name : {"table.csv", "words", "key", "key.pub", "protocol.json"}) QFile::remove(place.filePath(name));
        protocols::writeWholeFile(place.filePath("table.csv").toStdString(), "a\n1\n2\n");
        protocols::writeWholeFile(place.filePath("words").toStdString(), "four plain short words\n");
        protocols::writeWholeFile(place.filePath("protocol.json").toStdString(), protocols::paperProtocolJson());
        mustRun({"study", "signing-key", "--no-passphrase", "--out", place.filePath("key")});
        QVERIFY(place.mkpath("set/F01"));
        for (const char* name : {"set/dataset.json", "set/F01/height.png"})
            protocols::writeWholeFile(place.filePath(name).toStdString(), name);
        const auto all = [&] {
            QByteArray bytes;
            for (const char* name : {"table.csv", "words", "key", "protocol.json", "set/dataset.json", "set/F01/height.png"})
                bytes += bytesOf(place.filePath(name));
            return bytes;
        };
        const QByteArray before = all();
        QString errors;
        QCOMPARE(inShell("cd " + m_place.path() + " && PROGRAM " + call.replace("STUDY", study), &errors), 2);
        QVERIFY2(errors.contains("would replace a file that the command reads"), qPrintable(errors));
        QCOMPARE(all(), before);
    }

    void aLinkInThePlaceOfTheLockLeadsNowhere()
    {
        const QString study = newStudy(), victim = m_place.filePath("victim");
        protocols::writeWholeFile(victim.toStdString(), "precious data");
        fs::remove(study.toStdString() + "/.lock");
        fs::create_symlink("../victim", study.toStdString() + "/.lock");
        const auto result = runProgram({"study", "amend", study, "--undo"});
        QCOMPARE(result.exitCode, 2);
        QVERIFY2(result.err.contains("stands in the place of the file"), qPrintable(result.err));
        QCOMPARE(bytesOf(victim), QByteArray("precious data"));
    }

    void streamsThatTheCallerClosedAreNoFiles()
    {
        const QString study = newStudy();
        inShell("PROGRAM study amend " + study + " --undo <&- >&- 2>&-");
        QVERIFY(QFile::exists(study + "/.lock"));
        QCOMPARE(bytesOf(study + "/.lock"), QByteArray());  // the program empties it at its end
        QVERIFY(mustRun({"verify", study}).out.contains("sound"));
    }

    /// A killed session leaves its write-ahead log beside study.db, and people unpack a backup over the folder.
    void aBackupUnpackedOverAKilledSessionIsSound()
    {
        const QString study = newStudy(), tar = m_place.filePath("over.tar"), log = study + "/study.db-wal";
        mustRun({"backup", study, "--out", tar});
        {
            tests::support::OpenSession session({study.toStdString()}, "S01");
            session.playUntilAnswers(6);
            fs::copy_file(log.toStdString(), m_place.filePath("kept-wal").toStdString());
        }
        fs::copy_file(m_place.filePath("kept-wal").toStdString(), log.toStdString());
        QVERIFY(fs::file_size(log.toStdString()) > 0);
        QCOMPARE(inShell("tar xf " + tar + " -C " + m_place.path()), 0);
        QVERIFY(mustRun({"verify", study}).out.contains("sound (3 answers"));
    }

    void namesReachTheTerminalWithoutControlCharacters()
    {
        const QString study = newStudy(), strange = m_place.filePath("e\x1b[31mred");
        fs::rename(study.toStdString(), strange.toStdString());
        for (const QStringList& call :
             {QStringList{"backup", strange, "--out", m_place.filePath("b\x1b[31m.tar")},
              QStringList{"unblind", strange, "--who", "Ada", "--why", "it is over"},
              QStringList{"study", "signing-key", "--no-passphrase", "--out", m_place.filePath("k\x1b[0m")}}) {
            const auto result = mustRun(call);
            QVERIFY2(!result.out.contains('\x1b') && !result.err.contains('\x1b') && result.out.contains("\\x1b"),
                     qPrintable(result.out + result.err));
        }
    }

    void aBackupIsWholeWhateverTheSurroundingsSay()
    {
        const QString study = newStudy(), tar = m_place.filePath("whole.tar"), list = m_place.filePath("list");
        fs::create_symlink("/etc/hostname", study.toStdString() + "/notes.txt");
        fs::create_symlink("user@host.123:99", study.toStdString() + "/.#protocol.json");
        fs::create_directory(study.toStdString() + "/study.db.old");
        const auto result = runProgram({"backup", study, "--out", tar}, {"TAR_OPTIONS=--exclude=study.db --exclude=*.sealed"});
        QCOMPARE(result.exitCode, 0);
        QVERIFY2(result.err.contains("notes.txt: not in the backup") && result.err.contains(".#protocol.json: not in the backup"),
                 qPrintable(result.err));
        QCOMPARE(inShell("tar tf " + tar + " > " + list), 0);
        const QByteArray names = bytesOf(list);
        QVERIFY2(names.contains("/study.db\n") && names.contains(".sealed\n") && names.contains("/study.db.old/\n"),
                 names.constData());
        QVERIFY(!names.contains("notes.txt"));
    }

    /// A network share may refuse modes and times of files.
    void aBackupNeedsNeitherModesNorTimes()
    {
        const QString study = newStudy(), tar = m_place.filePath("share.tar");
        const database::StudyStore store({study.toStdString()}, database::StudyStore::Access::Read);
        refusesModesAndTimes = true;
        const auto faults = study::commands::writeBackup(store, tar.toStdString()).faults;
        refusesModesAndTimes = false;
        QVERIFY(faults.empty());
        fs::remove_all(study.toStdString());
        QCOMPARE(inShell("tar xf " + tar + " -C " + m_place.path()), 0);
        QVERIFY(mustRun({"verify", study}).out.contains("sound"));
    }

    void aLimitOfFileSizesIsAnError()
    {
        QString errors;
        const QString made = m_place.filePath("made");
        QCOMPARE(inShell("ulimit -f 8; PROGRAM fabrics make " + made + " --fabrics 2 --samples 2", &errors), 3);
        QVERIFY2(errors.startsWith("vis2hap: ") && !QFile::exists(made), qPrintable(errors));
    }

private:
    QString newStudy()
    {
        const QString study = m_place.filePath(QString("study%1").arg(++m_studies));
        const auto folder = tests::support::buildStudy(study.toStdString());
        tests::support::OpenSession(folder, "S01").playUntilAnswers(3);
        return study;
    }
    QTemporaryDir m_place;
    int m_studies = 0;
};

QTEST_GUILESS_MAIN(SafeOutputsTest)
#include "safe_outputs_test.moc"
