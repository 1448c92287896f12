// A child process keeps its limits of time, memory and files, and dies with its parent.
#include "rendering/models/process/limited_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QElapsedTimer>
#include <QTemporaryDir>
#include <QTest>
#include <array>
#include <cerrno>
#include <filesystem>
#include <functional>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"
#include "rendering/fabrics/procedural/procedural_fabrics.h"
#include "rendering/models/process/child_process.h"
#include "rendering/models/process/second_program.h"
#include "tests/support/error_text.h"

using namespace rendering;
using models::LimitedProcess;
using models::ProcessLimits;
using tests::support::errorOf;
namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t mebibyte = 1 << 20;

ProcessLimits wide()
{
    ProcessLimits limits;
    limits.memoryBytes = 4096 * mebibyte;
    limits.fileBytes = 4096 * mebibyte;
    return limits;
}

/// True where the process is gone, or only its exit status is left.
bool ended(pid_t process)
{
    const std::string status = protocols::readIfPossible("/proc/" + std::to_string(process) + "/stat").value_or("");
    return status.empty() || status.find(") Z ") != std::string::npos;
}

/// Milliseconds until the process has ended, or -1 after `mostMs`.
qint64 msUntilEnd(pid_t process, qint64 mostMs)
{
    QElapsedTimer time;
    time.start();
    while (time.elapsed() < mostMs) {
        if (ended(process)) return time.elapsed();
        QTest::qSleep(5);
    }
    return -1;
}

}  // namespace

class LimitedProcessTest : public QObject {
    Q_OBJECT

private:
    QTemporaryDir m_folder;
    fs::path at(const char* name) const { return fs::path(m_folder.path().toStdString()) / name; }

    struct ShellOutcome {
        int status = 0;
        QString output;
    };

    ShellOutcome shell(const std::string& command, const ProcessLimits& limits) const
    {
        const fs::path output = at("output");
        fs::remove(output);
        LimitedProcess process("/bin/sh", {"-c", command}, models::ownEnvironment(), output, limits);
        const int status = process.wait();
        return {status, QString::fromStdString(protocols::readIfPossible(output).value_or(""))};
    }

    /// A parent that starts `program` and then waits for ever. It is killed; returns the milliseconds that its child lived on.
    qint64 msWithoutParent(const fs::path& program, const std::vector<std::string>& arguments,
                           const std::function<bool()>& underWay, bool stopped) const
    {
        std::array<int, 2> ends{};
        if (::pipe(ends.data()) != 0) return -2;
        const pid_t parent = ::fork();
        if (parent == 0) {
            const LimitedProcess child(program, arguments, models::ownEnvironment(), at("output"), wide());
            const pid_t number = child.number();
            if (::write(ends[1], &number, sizeof number) != static_cast<ssize_t>(sizeof number)) ::_exit(1);
            while (true) ::pause();
        }
        pid_t child = 0;
        if (::read(ends[0], &child, sizeof child) != static_cast<ssize_t>(sizeof child)) return -3;
        for (const int end : ends) ::close(end);
        QElapsedTimer waited;
        waited.start();
        while (!underWay() && waited.elapsed() < 60000) QTest::qSleep(10);
        if (!underWay() || ended(child)) return -4;
        if (stopped) ::kill(child, SIGSTOP);
        ::kill(parent, SIGKILL);
        ::waitpid(parent, nullptr, 0);
        return msUntilEnd(child, 2000);
    }

private Q_SLOTS:
    void outputAndStatusComeBack()
    {
        const ShellOutcome outcome = shell("echo out; echo err >&2; cat; exit 3", wide());
        QCOMPARE(outcome.output, "out\nerr\n");
        QVERIFY(WIFEXITED(outcome.status));
        QCOMPARE(WEXITSTATUS(outcome.status), 3);
    }

    /// VIS2HAP_NN may name a program of somebody else.
    void noPassphraseAndNoPasswordIsPassedOn()
    {
        qputenv("VIS2HAP_PASSPHRASE", "Sekret1");
        qputenv("PGPASSWORD", "Sekret2");
        qputenv("OF_THE_LAB", "open");
        const QString variables = shell("env", wide()).output;
        for (const char* variable : {"VIS2HAP_PASSPHRASE", "PGPASSWORD", "OF_THE_LAB"}) qunsetenv(variable);
        QVERIFY(variables.contains("OF_THE_LAB=open"));
        QVERIFY(!variables.contains("Sekret") && !variables.contains("PGPASSWORD"));
    }

    void programThatIsMissingIsNamed()
    {
        const QString fault = errorOf([&] { LimitedProcess("/nowhere/vis2hap-nn", {}, {}, at("output"), wide()); });
        QVERIFY2(fault.startsWith("3: ") && fault.contains("vis2hap-nn cannot be started: No such file") && !fault.contains('\n'),
                 qPrintable(fault));
    }

    void stoppedProcessIsGivenUpAfterItsTime()
    {
        ProcessLimits limits = wide();
        limits.time = std::chrono::seconds(1);
        LimitedProcess process("/bin/sleep", {"100"}, models::ownEnvironment(), at("output"), limits);
        const pid_t child = process.number();
        ::kill(child, SIGSTOP);
        QElapsedTimer time;
        time.start();
        const QString fault = errorOf([&] { process.wait(); });
        QVERIFY2(fault.startsWith("3: ") && fault.contains("sleep did not finish in time and was ended") &&
                     fault.contains("within 1 s") && fault.contains("VIS2HAP_NN_SECONDS") && !fault.contains('\n'),
                 qPrintable(fault));
        QVERIFY2(time.elapsed() < 3000, qPrintable(QString::number(time.elapsed())));
        QVERIFY(::kill(child, 0) != 0 && errno == ESRCH);
    }

    /// Children, and those that detached themselves, end with the program: at its end, at its limit and with its parent.
    void descendantsEndWithTheProgram_data()
    {
        QTest::addColumn<QString>("last");
        QTest::addColumn<int>("expected");
        QTest::newRow("at its end") << "exit 3" << 3;
        QTest::newRow("killed") << "kill -9 $$" << -9;
        QTest::newRow("at its limit") << "sleep 100" << -1;
    }

    void descendantsEndWithTheProgram()
    {
        QFETCH(QString, last);
        QFETCH(int, expected);
        ProcessLimits limits = wide();
        limits.time = std::chrono::seconds(expected == -1 ? 3 : 60);
        fs::remove(at("children"));
        const std::string note = " & echo $! >> '" + at("children").string() + "'; ";
        const std::string command =
            "sleep 100" + note + "setsid sleep 100" + note + "(sleep 100" + note + ") ; " + last.toStdString();
        LimitedProcess process(
            "/bin/sh", {"-c", command},
            models::ProcessSurroundings{
                .environment = models::ownEnvironment(), .output = at("output"), .errors = at("errors"), .withDescendants = true},
            limits);
        const auto status = process.statusInTime();
        QCOMPARE(!status ? -1 : WIFEXITED(*status) ? WEXITSTATUS(*status) : -WTERMSIG(*status), expected);
        const QStringList children =
            QString::fromStdString(protocols::readWholeFile(at("children"))).split('\n', Qt::SkipEmptyParts);
        QCOMPARE(children.size(), 3);
        for (const QString& child : children) QVERIFY2(ended(child.toInt()), qPrintable(child));
    }

    void outputAndErrorsMayBeApart()
    {
        for (const char* file : {"output", "errors"}) fs::remove(at(file));
        LimitedProcess process("/bin/sh", {"-c", "echo out; echo err >&2"},
                               models::ProcessSurroundings{.environment = {}, .output = at("output"), .errors = at("errors")},
                               wide());
        QCOMPARE(process.wait(), 0);
        QCOMPARE(protocols::readWholeFile(at("output")), std::string("out\n"));
        QCOMPARE(protocols::readWholeFile(at("errors")), std::string("err\n"));
    }

    void descendantsDieWithTheParentOfTheProgram()
    {
        fs::remove(at("children"));
        const pid_t parent = ::fork();
        if (parent == 0) {
            const LimitedProcess child(
                "/bin/sh", {"-c", "setsid sleep 100 & echo $! > '" + at("children").string() + "'; sleep 100"},
                models::ProcessSurroundings{
                    .environment = models::ownEnvironment(), .output = at("output"), .withDescendants = true},
                wide());
            while (true) ::pause();
        }
        QTRY_VERIFY_WITH_TIMEOUT(!protocols::readIfPossible(at("children")).value_or("").empty(), 10000);
        const pid_t child = QString::fromStdString(protocols::readWholeFile(at("children"))).trimmed().toInt();
        QVERIFY(!ended(child));
        ::kill(parent, SIGKILL);
        ::waitpid(parent, nullptr, 0);
        const qint64 lived = msUntilEnd(child, 2000);
        QVERIFY2(lived >= 0, qPrintable(QString::number(lived)));
    }

    /// The keeper becomes no other program, so a descriptor that closes with such a change would stay open in it.
    void keeperHoldsNoFileOfItsParent()
    {
        const int held = ::open(at("held").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
        QVERIFY(held > 2);
        const LimitedProcess process(
            "/bin/sleep", {"100"},
            models::ProcessSurroundings{.environment = models::ownEnvironment(), .output = at("output"), .withDescendants = true},
            wide());
        const auto descriptors = [&] {
            QStringList numbers;
            for (const auto& one : fs::directory_iterator("/proc/" + std::to_string(process.number()) + "/fd"))
                numbers << QString::fromStdString(one.path().filename().string());
            numbers.sort();
            return numbers;
        };
        QTRY_COMPARE(descriptors(), QStringList({"0", "1", "2"}));
        ::close(held);
    }

    void commandsFindTheProgramWhereOthersDo()
    {
        if (qEnvironmentVariableIsSet("VIS2HAP_NN")) QSKIP("VIS2HAP_NN names the program");
        QCOMPARE(models::secondProgram(), models::generatorProgram().string());  // one folder above this one
        QVERIFY(fs::is_regular_file(models::secondProgram()));
    }

    void limitsAreThoseAskedFor()
    {
        ProcessLimits limits = wide();
        limits.memoryBytes = 512 * mebibyte;
        limits.fileBytes = 3 * mebibyte;
        limits.openFiles = 77;
        const ShellOutcome outcome = shell("ulimit -f; ulimit -n; ulimit -c; ulimit -d", limits);
        const QStringList numbers = outcome.output.split('\n');
        QCOMPARE(numbers.mid(0, 3), QStringList({"6144", "77", "0"}));  // blocks of 512 bytes
#ifndef __SANITIZE_ADDRESS__
        QCOMPARE(numbers[3], "524288");  // kB
#endif
    }

    void fileBeyondItsLimitFailsWithAReason()
    {
        ProcessLimits limits = wide();
        limits.fileBytes = mebibyte;
        const ShellOutcome outcome = shell("head -c 3000000 /dev/zero > '" + at("large").string() + "'", limits);
        QVERIFY(WIFEXITED(outcome.status) && WEXITSTATUS(outcome.status) != 0);
        QVERIFY2(outcome.output.contains("File too large"), qPrintable(outcome.output));
        QCOMPARE(fs::file_size(at("large")), std::uintmax_t{mebibyte});
    }

    void memoryBeyondItsLimitIsRefused()
    {
#ifdef __SANITIZE_ADDRESS__
        QSKIP("the sanitizer needs more memory than any limit");
#endif
        ProcessLimits limits = wide();
        const std::string command = "dd if=/dev/zero of=/dev/null bs=300M count=1";
        QCOMPARE(shell(command, limits).status, 0);
        limits.memoryBytes = 100 * mebibyte;
        const ShellOutcome outcome = shell(command, limits);
        QVERIFY(WIFEXITED(outcome.status) && WEXITSTATUS(outcome.status) != 0);
        QVERIFY2(outcome.output.contains("exhausted"), qPrintable(outcome.output));
    }

    void variablesReplaceTheLimits()
    {
        const ProcessLimits usual = models::generationLimits(4.2);
        QCOMPARE(usual.time->count(), 600 + 1008);
        QVERIFY(usual.memoryBytes >= 4096 * mebibyte);
        QVERIFY(!models::trainingLimits().time);
        qputenv("VIS2HAP_NN_SECONDS", "7");
        qputenv("VIS2HAP_NN_MEMORY_MB", "900");
        QCOMPARE(models::generationLimits(4.2).time->count(), 7);
        QCOMPARE(models::benchLimits().time->count(), 7);
        QCOMPARE(models::trainingLimits().memoryBytes, 900 * mebibyte);
        QVERIFY(!models::trainingLimits().time);
        for (const char* wrong : {"0", "-3", "soon", "7s", "99999999999"}) {
            qputenv("VIS2HAP_NN_SECONDS", wrong);
            const QString fault = errorOf([] { (void)models::generationLimits(1); });
            QVERIFY2(fault.startsWith("2: ") && fault.contains("VIS2HAP_NN_SECONDS") && fault.contains(wrong), qPrintable(fault));
        }
        qunsetenv("VIS2HAP_NN_SECONDS");
        qunsetenv("VIS2HAP_NN_MEMORY_MB");
    }

    void processDiesWithItsParent()
    {
        for (const bool stopped : {false, true}) {
            const qint64 lived = msWithoutParent(
                "/bin/sleep", {"100"}, [] { return true; }, stopped);
            QVERIFY2(lived >= 0, qPrintable(QString::number(lived)));
        }
    }

    /// The program itself starts a second time for its thread settings; it must stay tied to its parent.
    void trainingDiesWithItsParent()
    {
        fabrics::ProceduralOptions options;
        options.fabrics = 1;
        options.samples = 4;
        options.seed = 32;
        fabrics::makeProceduralFabrics(at("fabrics"), options);
        const std::vector<std::string> call{"train",      at("fabrics").string(),
                                            "--out",      at("model.safetensors").string(),
                                            "--steps",    "1000000",
                                            "--crop",     "32",
                                            "--threads",  "1",
                                            "--channels", "2"};
        fs::remove(at("output"));
        const auto underWay = [this] {
            return protocols::readIfPossible(at("output")).value_or("").find("step 1 ") != std::string::npos;
        };
        const qint64 lived = msWithoutParent(models::generatorProgram(), call, underWay, false);
        QVERIFY2(lived >= 0, qPrintable(QString::number(lived)));
    }
};

QTEST_GUILESS_MAIN(LimitedProcessTest)
#include "limited_process_test.moc"
