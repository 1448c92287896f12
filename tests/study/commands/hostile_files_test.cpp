// Every command that reads a file refuses what is not such a file with one clear line, in bounded time and memory.
#include <sys/resource.h>
#include <unistd.h>

#include <QByteArrayList>
#include <QFileInfo>
#include <QProcess>
#include <QTemporaryDir>
#include <QTest>
#include <filesystem>

#include "protocols/files/whole_file.h"
#include "tests/support/program.h"

using support::ProgramResult;
using support::runProgram;

namespace {

namespace fs = std::filesystem;

/// What stands where a command expects its file.
void put(const fs::path& file, const QByteArray& kind)
{
    if (kind == "a folder")
        fs::create_directory(file);
    else if (kind == "a device")
        fs::create_symlink("/dev/zero", file);
    else if (kind != "nothing there")
        protocols::writeWholeFile(file, kind.toStdString(), protocols::Sync::Later);
    if (kind == "10 GB" && ::truncate(file.c_str(), 10'000'000'000) != 0) QFAIL("no sparse file can be made here");
}

}  // namespace

class HostileFilesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void whatIsNoSuchFileIsRefusedInOneLine_data()
    {
        QTest::addColumn<QString>("call");
        QTest::addColumn<QByteArray>("kind");
        const QStringList calls{"power --studies 20 --protocol F",
                                "power --studies 20 --calibrate 100 --resume F",
                                "describe F --column a",
                                "metrics F F",
                                "analyse F --out O",
                                "view F.png --out O",
                                "view F.csv --out O",
                                "view F.npy --out O",
                                "view F.tiff --out O",
                                "view F.tmd --out O",
                                "view F.json --out O",
                                "stroke F.pgm --csv O",
                                "height F.png --calibration F.png --out O",
                                "height --gradients F.npy F.npy --out O",
                                "height --normals F.png --out O",
                                "import photos F.png --fabric F01 --out O",
                                "import friction-csv F.csv --fabric F01 --out O",
                                "import tribometer F.txt --fabric F01 --out O",
                                "import labview F.lvm --fabric F01 --out O",
                                "import gelsight F.png --calibration F.png --fabric F01 --out O"};
        const QByteArrayList kinds{"nothing there",
                                   "a folder",
                                   "a device",
                                   "10 GB",
                                   "",
                                   QByteArray("\0\0\0\0", 4),
                                   "Bj\xF6rn,\xE4\n1\n",
                                   "\xEF\xBB\xBF{\"schema\": 7}",
                                   "{\"schema\": [null], \"cases\": {}}",
                                   "a,b\n" + QByteArray(1000, '9') + "\n",
                                   "\x1b[31mred\n",
                                   QByteArray(100'000, '['),
                                   QByteArray(100'000, '[') + QByteArray(100'000, ']'),
                                   QByteArray("{\"a\":").repeated(100'000)};
        for (const QString& call : calls)
            for (const QByteArray& kind : kinds) {
                // A file of counts that is not there is made.
                if (call.contains("--resume") && kind == "nothing there") continue;
                QTest::addRow("%s: %.12s (%d bytes)", qPrintable(call), kind.toPercentEncoding().constData(), int(kind.size()))
                    << call << kind;
            }
    }
    void whatIsNoSuchFileIsRefusedInOneLine()
    {
        QFETCH(const QString, call);
        QFETCH(const QByteArray, kind);
        const QTemporaryDir folder;
        QStringList arguments;
        for (const QString& word : call.split(' ')) {
            const bool isFile = word.size() == 1 || word.startsWith("F.");
            arguments << (isFile ? folder.filePath(word) : word);
            if (isFile && word[0] == 'F' && !fs::exists(fs::symlink_status(arguments.back().toStdString())))
                put(arguments.back().toStdString(), kind);
        }
        const ProgramResult ended = runProgram(arguments);
        const QStringList messages = ended.messages();
        QVERIFY2(ended.exitCode == 2 || ended.exitCode == 3, qPrintable(ended.err));
        QCOMPARE(messages.size(), 1);
        QVERIFY2(messages[0].startsWith("vis2hap: ") && messages[0].size() < 1500, qPrintable(messages[0]));
        for (const char* inside : {"unexpected failure", "json.exception", "memory is used up", "\x1b"})
            QVERIFY2(!messages[0].contains(inside), qPrintable(messages[0]));
    }

    /// An object that keeps the order of its keys looks through all of them for each.
    void aResponseOfManyKeysIsRefusedSoon()
    {
        const QTemporaryDir folder;
        const QString file = folder.filePath("response.json");
        QByteArray text = "{\"schema\": \"vis2hap.display-response/1\"";
        for (int key = 0; key < 300'000; ++key) text += ",\"k" + QByteArray::number(key) + "\":0";
        protocols::writeWholeFile(file.toStdString(), (text + "}").toStdString(), protocols::Sync::Later);
        const QString cloth = folder.filePath("cloth");
        support::mustRun({"fabrics", "make", cloth, "--fabrics", "7", "--samples", "10"});
        QElapsedTimer timer;
        timer.start();
        const ProgramResult made =
            runProgram({"study", "new", folder.filePath("study"), "--dataset", cloth, "--response", file, "--no-passphrase"});
        QVERIFY2(made.exitCode == 2 && made.messages().size() == 1 && made.err.contains("response.json"), qPrintable(made.err));
        QVERIFY2(timer.elapsed() < 20'000, qPrintable(QString::number(timer.elapsed())));
    }

    /// "010" was taken for 8, and a number that does not fit for the largest.
    void wholeNumbersAreDecimalDigits()
    {
        const QTemporaryDir folder;
        for (const char* seed : {"010", "0x0A", "+5", "1e3", "-1", "18446744073709551616", ""}) {
            const QString out = folder.filePath("cloth");
            const auto ended =
                runProgram({"fabrics", "make", out, "--fabrics", "1", "--samples", "1", QString("--seed=") + seed});
            QVERIFY2(ended.exitCode == 2 && !QFileInfo::exists(out), qPrintable(QString(seed) + ": " + ended.err));
        }
        const auto trained = runProgram({"train", folder.path(), "--out", folder.filePath("m.safetensors"), "--steps", "08"});
        QVERIFY2(trained.exitCode == 2 && trained.err.contains("08 is no whole number"), qPrintable(trained.err));
    }

    void scalesThatNoProtocolMayHaveAreRefused_data()
    {
        QTest::addColumn<QString>("scale");
        for (const char* scale : {"0,1e300", "0,214748365", "2.96,5.04", "-10001,5", "0,0.05", "inf,5"})
            QTest::newRow(scale) << scale;
    }
    void scalesThatNoProtocolMayHaveAreRefused()
    {
        QFETCH(const QString, scale);
        const QTemporaryDir folder;
        protocols::writeWholeFile(folder.filePath("a.csv").toStdString(),
                                  "participant,fabric,condition,Q2\nP1,F1,a,3\nP1,F1,b,4\nP2,F1,a,3\nP2,F1,b,5\n");
        const ProgramResult ended =
            runProgram({"report", "--from", folder.filePath("a.csv"), "--out", folder.filePath("out"), "--scale=" + scale});
        QCOMPARE(ended.exitCode, 2);
        QVERIFY2(ended.err.contains("\"" + scale + "\"") && ended.err.contains("--scale"), qPrintable(ended.err));
        QVERIFY(!fs::exists(folder.filePath("out").toStdString()));
    }

    void tooFewOpenFilesAreNamedWithTheirLimit()
    {
        const QTemporaryDir folder;
        protocols::writeWholeFile(folder.filePath("a.csv").toStdString(), "a\n1\n2\n");
        rlimit before{};
        QCOMPARE(::getrlimit(RLIMIT_NOFILE, &before), 0);
        QProcess process;
        process.setChildProcessModifier([&] {
            const rlimit few{8, before.rlim_max};
            ::setrlimit(RLIMIT_NOFILE, &few);
        });
        support::startProgram(process, {"describe", folder.filePath("a.csv"), "--column", "a"});
        QVERIFY(process.waitForFinished());
        QCOMPARE(process.exitCode(), 3);
        const QString said = QString::fromUtf8(process.readAll());
        QVERIFY2(said.contains("which is 8: `ulimit -n 1024`"), qPrintable(said));
    }
};

QTEST_GUILESS_MAIN(HostileFilesTest)
#include "hostile_files_test.moc"
