// vis2hap view, stroke and display check, run from the command line.
#include <sys/stat.h>

#include <QFile>
#include <QImage>
#include <QProcess>
#include <QTemporaryDir>
#include <QTest>

#include "rendering/images/image_io.h"
#include "tests/rendering/fabric_files.h"
#include "tests/support/colour_tiff.h"
#include "tests/support/program.h"
#include "tests/support/study_builder.h"

using support::ProgramResult;
using support::runProgram;

class ViewCommandTest : public QObject {
    Q_OBJECT
    QTemporaryDir m_folder;

    QString at(const char* name) { return m_folder.filePath(name); }
    std::filesystem::path pathAt(const char* name) { return at(name).toStdString(); }

private Q_SLOTS:
    void initTestCase()
    {
        fabric_files::smallDataset(pathAt("set"));
        cv::Mat image(60, 90, CV_8UC1);
        for (int i = 0; i < 60 * 90; ++i) image.data[i] = static_cast<unsigned char>(i * 13 % 256);
        rendering::writePgm(pathAt("image.pgm"), image);
    }

    void signalsOfAFabricStandSideBySide()
    {
        const auto ended = runProgram({"view", at("set/F01/visual/000.png"), at("set/F01/tactile/000.png"),
                                       at("set/F01/height/000.tiff"), at("set/F01/friction/000.csv"), "--out", at("sheet.png")});
        QVERIFY2(ended.exitCode == 0, qPrintable(ended.err));
        const QImage sheet(at("sheet.png"));
        QVERIFY(sheet.width() > 4 * 460 && sheet.height() > 700);
        const QStringList lines = ended.out.split('\n', Qt::SkipEmptyParts);
        QCOMPARE(lines.size(), 4);
        QVERIFY(lines[2].contains("height, 32 × 24") && lines[2].contains("0.125 mm") &&
                lines[2].contains("All values are equal"));
        QVERIFY(lines[3].contains("coefficient") || lines[3].contains("friction record"));
    }

    /// Qt fills the missing part with grey and reports a success.
    void aColourTiffIsShown()
    {
        QFile file(m_folder.filePath("colours.tif"));
        const std::string bytes = tests::support::tiffOfOneColour(2, 1);
        QVERIFY(file.open(QIODevice::WriteOnly) && file.write(bytes.data(), qint64(bytes.size())) == qint64(bytes.size()));
        file.close();
        const auto ended = runProgram({"view", file.fileName(), "--out", m_folder.filePath("colours.png")});
        QVERIFY2(ended.exitCode == 0, qPrintable(ended.err));
        QVERIFY(QFile::exists(m_folder.filePath("colours.png")));
    }

    void aTruncatedPhotographIsRefused_data()
    {
        QTest::addColumn<QString>("format");
        QTest::newRow("JPEG") << "jpg";
        QTest::newRow("BMP") << "bmp";
    }
    void aTruncatedPhotographIsRefused()
    {
        QFETCH(const QString, format);
        const QString photo = m_folder.filePath("photo." + format);
        QImage image(200, 150, QImage::Format_RGB888);
        for (int i = 0; i < 200 * 150; ++i) image.setPixel(i % 200, i / 200, qRgb(i * 13 % 256, i * 7 % 256, i % 256));
        QVERIFY(image.save(photo));
        QFile file(photo);
        QVERIFY(file.open(QIODevice::ReadOnly));
        const QByteArray whole = file.readAll();
        file.close();
        const auto importing = [&](const QByteArray& bytes, const QString& out) {
            QFile written(photo);
            if (!written.open(QIODevice::WriteOnly)) return ProgramResult{};
            written.write(bytes);
            written.close();
            return runProgram({"import", "photos", photo, "--out", out});
        };
        const QString out = m_folder.filePath("photos-" + format);
        for (const auto kept : {whole.size() - 2, whole.size() / 2}) {
            const auto ended = importing(whole.left(kept), out);
            QCOMPARE(ended.exitCode, 2);
            QVERIFY2(ended.err.contains("the file is truncated") && !QFile::exists(out), qPrintable(ended.err));
        }
        // A camera appends other images, and one of them may be cut without harm to the first.
        QCOMPARE(importing(whole + whole.left(500), out).exitCode, 0);
    }

    /// A card that loses bytes leaves the end in place; Qt decodes what follows as grey.
    void aDamagedPhotographIsRefused()
    {
        const QString photo = at("damaged.jpg");
        QImage image(200, 150, QImage::Format_RGB888);
        for (int i = 0; i < 200 * 150; ++i) image.setPixel(i % 200, i / 200, qRgb(i * 13 % 256, i * 7 % 256, i % 256));
        QVERIFY(image.save(photo));
        const auto written = [&](const QByteArray& bytes) {
            QFile file(photo);
            return file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size();
        };
        QFile file(photo);
        QVERIFY(file.open(QIODevice::ReadOnly));
        const QByteArray whole = file.readAll();
        file.close();
        QVERIFY(written(whole.left(whole.size() / 2) + "\xFF\xD9"));
        for (const QStringList& command : {QStringList{"import", "photos", photo, "--out", at("of-damaged")},
                                           QStringList{"view", photo, "--out", at("of-damaged.png")}}) {
            const auto ended = runProgram(command);
            QCOMPARE(ended.exitCode, 2);
            QVERIFY2(ended.err.startsWith("vis2hap: ") && ended.err.contains("is a damaged JPEG") && ended.err.count('\n') == 1,
                     qPrintable(ended.err));
        }
        QByteArray holed = whole;
        holed.replace(whole.size() / 2, 2000, QByteArray(2000, '\0'));
        QVERIFY(written(holed));
        QCOMPARE(runProgram({"view", photo, "--out", at("of-damaged.png")}).exitCode, 2);
        // Some cameras pad the end of the image.
        QByteArray padded = whole;
        padded.insert(whole.size() - 2, QByteArray("\x11\x22\x33"));
        QVERIFY(written(padded));
        const auto ended = runProgram({"view", photo, "--out", at("of-padded.png")});
        QVERIFY2(ended.exitCode == 0 && !ended.err.contains("qt."), qPrintable(ended.err));
    }

    /// Fuzzing found the first one: 44 bytes filled 3 GB.
    void aFewBytesThatStateALargePictureAreRefused_data()
    {
        QTest::addColumn<QString>("name");
        QTest::addColumn<QByteArray>("bytes");
        QTest::addColumn<QString>("reason");
        QTest::newRow("BMP of the first version")
            << "old.bmp"
            << QByteArray::fromHex("424db6060a0000000000000001004001004001202890010018000000000000002100380000002000800400")
            << "the file is truncated";
        // A header of 40 bytes, 16,000 x 16,000 pixels of 8 bits, run-length coded; the code ends at once.
        const QByteArray header = QByteArray::fromHex("424d40000000000000003600000028000000803e0000803e0000010008000100000000");
        QTest::newRow("BMP of runs") << "runs.bmp"
                                     << header.leftJustified(54, '\0') + QByteArray(1024, '\0') + QByteArray("\0\1", 2)
                                     << "16000 x 16000 pixels in 1080 bytes";
        QTest::newRow("GIF with another ending")
            << "large.jpg" << QByteArray::fromHex("474946383961803e803e800000000000ffffff2c00000000803e803e000002024401003b")
            << "16000 x 16000 pixels in";
    }
    void aFewBytesThatStateALargePictureAreRefused()
    {
        QFETCH(const QString, name);
        QFETCH(const QByteArray, bytes);
        QFETCH(const QString, reason);
        QFile file(m_folder.filePath(name));
        QVERIFY(file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size());
        file.close();
        const auto ended = runProgram({"view", file.fileName(), "--out", at("of-few-bytes.png")});
        QCOMPARE(ended.exitCode, 2);
        QVERIFY2(ended.err.contains(reason) && ended.err.count('\n') == 1, qPrintable(ended.err));
    }

    /// The first version of BMP has a header of 26 bytes. This one has two rows of one red and one blue pixel.
    void aBmpOfTheFirstVersionIsReadWhole()
    {
        const QByteArray whole = QByteArray::fromHex(
            "424d2200000000000000"
            "1a000000"
            "0c000000"
            "01000200"
            "01001800"
            "ff000000"
            "0000ff00");
        for (const qsizetype length : {whole.size(), whole.size() - 2}) {
            QFile file(at("old-whole.bmp"));
            QVERIFY(file.open(QIODevice::WriteOnly) && file.write(whole.left(length)) == length);
            file.close();
            const auto ended = runProgram({"view", at("old-whole.bmp"), "--out", at("of-old.png")});
            QVERIFY2(ended.exitCode == (length == whole.size() ? 0 : 2), qPrintable(ended.err));
        }
    }

    void aPipeInThePlaceOfAPictureIsRefused()
    {
        for (const char* name : {"pipe.jpg", "pipe.bmp"}) {
            QCOMPARE(::mkfifo(qPrintable(at(name)), 0600), 0);
            QProcess process;
            support::startProgram(process, {"view", at(name), "--out", at("of-pipe.png")});
            const bool isEnded = process.waitForFinished(20'000);
            if (!isEnded) process.kill();
            QVERIFY(isEnded);  // although nobody writes into the pipe
            QCOMPARE(process.exitCode(), 2);
            const QString said = QString::fromUtf8(process.readAll());
            QVERIFY2(said.startsWith("vis2hap: ") && said.contains(name), qPrintable(said));
        }
    }

    void strokeIsWrittenAndLookedAt()
    {
        const auto stroked = runProgram({"stroke", at("image.pgm"), "--csv", at("stroke.csv"), "--speed", "20"});
        QVERIFY2(stroked.exitCode == 0, qPrintable(stroked.err));
        const std::string text = fabric_files::read(pathAt("stroke.csv"));
        QVERIFY(text.starts_with("t_s,position_mm,normal_n,tangential_n\n0,0,0.5,"));
        // 89 pixels of 0.170 mm at 20 mm/s and 1000 Hz, both ends counted.
        QCOMPARE(std::count(text.begin(), text.end(), '\n'), 1 + 756 + 1);
        const auto ended =
            runProgram({"view", at("stroke.csv"), at("image.pgm"), "--out", at("two.png"), "--dark", "--per-row", "1"});
        QVERIFY2(ended.exitCode == 0, qPrintable(ended.err));
        QVERIFY(QImage(at("two.png")).height() > 1400);
    }

    void wrongCallsAreRefused_data()
    {
        QTest::addColumn<QStringList>("arguments");
        QTest::addColumn<QString>("told");
        QTest::newRow("no speed") << QStringList{"stroke", "IMAGE", "--csv", "OUT", "--speed", "0"} << "speed";
        QTest::newRow("backwards") << QStringList{"stroke", "IMAGE", "--csv", "OUT", "--speed", "-3"} << "speed";
        QTest::newRow("far too fast") << QStringList{"stroke", "IMAGE", "--csv", "OUT", "--speed", "1e9"} << "speed";
        QTest::newRow("line outside") << QStringList{"stroke", "IMAGE", "--csv", "OUT", "--line", "60"} << "no line 60";
        QTest::newRow("photograph") << QStringList{"stroke", "PHOTO", "--csv", "OUT"} << "not a friction image";
        QTest::newRow("missing") << QStringList{"view", "NOTHING", "--out", "OUT"} << "nothing-here.png";
        QTest::newRow("more than a sheet holds")
            << QStringList{"view", "--per-row", "1", "--width", "2000", "--out", "OUT"} + QStringList(9, "IMAGE")
            << "at most 32000 px per side";
        QTest::newRow("no file") << QStringList{"view", "--out", "OUT"} << "FILE";
        QTest::newRow("nothing to check") << QStringList{"display", "check", "none"} << "no driver to check";
        QTest::newRow("no port") << QStringList{"display", "check", "tcp:lab"} << "tcp:HOST:PORT";
    }
    void wrongCallsAreRefused()
    {
        QFETCH(QStringList, arguments);
        QFETCH(QString, told);
        arguments.replaceInStrings("IMAGE", at("image.pgm")).replaceInStrings("OUT", at("not-written"));
        arguments.replaceInStrings("PHOTO", at("set/F01/visual/000.png")).replaceInStrings("NOTHING", at("nothing-here.png"));
        const ProgramResult ended = runProgram(arguments);
        QCOMPARE(ended.exitCode, 2);
        QVERIFY2(ended.err.contains(told) && ended.err.count('\n') == 1, qPrintable(ended.err));
        QVERIFY(!QFile::exists(at("not-written")));
    }

    void stimuliOfAnOpenStudyAreRefused()
    {
        const auto study = tests::support::buildStudy(pathAt("study"));
        const auto stimulus = QString::fromStdString(std::filesystem::directory_iterator(study.stimuli())->path().string());
        const ProgramResult ended = runProgram({"view", stimulus, "--out", at("seen.png")});
        QCOMPARE(ended.exitCode, 2);
        QVERIFY2(ended.err.contains("not unblinded"), qPrintable(ended.err));
        QVERIFY(!QFile::exists(at("seen.png")));
        const ProgramResult stroked = runProgram({"stroke", stimulus, "--csv", at("felt.csv")});
        QCOMPARE(stroked.exitCode, 2);
        QVERIFY(stroked.err.contains("not unblinded") && !QFile::exists(at("felt.csv")));

        // A comparison with a rendering of known condition would reveal the condition of the stimulus.
        const ProgramResult compared = runProgram({"metrics", stimulus, stimulus});
        QCOMPARE(compared.exitCode, 2);
        QVERIFY2(compared.err.contains("not unblinded") && compared.out.isEmpty(), qPrintable(compared.err));
    }

    void ownerOfADisplayChecksTheDriver()
    {
        const QString driver = QStringLiteral("exec:" VIS2HAP_REFERENCE_DISPLAY " '%1'").arg(at("felt"));
        const ProgramResult ended = runProgram({"display", "check", driver + " --touch-after 20", "--touch", "5"});
        QVERIFY2(ended.exitCode == 0, qPrintable(ended.out + ended.err));
        QCOMPARE(ended.out.count("\npass  "), 19);
        QVERIFY(ended.out.contains("reference display: meets every requirement") && ended.out.contains(" ms of 10, longest "));
        const ProgramResult dead = runProgram({"display", "check", driver + " --crash-at 1"});
        QCOMPARE(dead.exitCode, 1);
        QVERIFY2(dead.out.contains("FAIL  shows an image") && dead.out.contains("signal 9"), qPrintable(dead.out));
    }

    void nothingHeavyIsLoaded()
    {
        // The app and the light commands start in milliseconds; see CONTRIBUTING.md.
        QProcess libraries;
        libraries.start("ldd", {VIS2HAP_PROGRAM});
        QVERIFY(libraries.waitForFinished());
        const QString loaded = QString::fromUtf8(libraries.readAllStandardOutput());
        QVERIFY(loaded.contains("libopencv_core"));
        for (const char* heavy : {"libtorch", "libopencv_imgcodecs", "libopencv_highgui", "libgdal"})
            QVERIFY2(!loaded.contains(heavy), heavy);
    }
};

QTEST_GUILESS_MAIN(ViewCommandTest)
#include "view_command_test.moc"
