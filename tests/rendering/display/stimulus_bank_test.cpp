#include "rendering/display/stimulus_bank.h"

#include <sys/stat.h>
#include <unistd.h>

#include <QElapsedTimer>
#include <QTemporaryDir>
#include <QTest>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>

#include "protocols/files/sha256.h"
#include "protocols/files/whole_file.h"
#include "protocols/orders/allocation.h"
#include "tests/rendering/refusal.h"

using namespace rendering;
using protocols::FileCode;

namespace {

const protocols::SecretKey key = protocols::SecretKey::ofSeed(3);

cv::Mat image(int level) { return cv::Mat(800, 1280, CV_8UC1, cv::Scalar(level)); }

/// A bank of stimuli "a", "b" and so on, each with its own level.
struct Stimuli {
    explicit Stimuli(int count)
    {
        for (int i = 0; i < count; ++i) {
            const FileCode code(std::string(1, static_cast<char>('a' + i)));
            hashes[code] = writeStimulus(path, code, image(10 * i), key);
        }
    }
    std::filesystem::path file(const char* name) const { return path / (std::string(name) + ".sealed"); }

    QTemporaryDir folder;
    std::filesystem::path path{folder.path().toStdString()};
    StimulusHashes hashes;
};

}  // namespace

class StimulusBankTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void filesRevealNothingAboutTheirStimulus()
    {
        QTemporaryDir folder;
        const std::filesystem::path path(folder.path().toStdString());
        cv::Mat noise(800, 1280, CV_8UC1);
        cv::theRNG().state = 5;
        cv::randu(noise, 0, 256);
        const auto hash = writeStimulus(path, FileCode("flat"), image(0), key);
        writeStimulus(path, FileCode("rough"), noise, key);
        struct stat flat, rough;
        QCOMPARE(stat((path / "flat.sealed").c_str(), &flat), 0);
        QCOMPARE(stat((path / "rough.sealed").c_str(), &rough), 0);
        QCOMPARE(flat.st_size, rough.st_size);
        QCOMPARE(flat.st_mtime, 946684800);
        QCOMPARE(rough.st_mtim.tv_sec, flat.st_mtim.tv_sec);
        QCOMPARE(rough.st_mtim.tv_nsec, 0);
        QCOMPARE(flat.st_mode & 0777, 0600U);
        QCOMPARE(hash, protocols::sha256OfFile(path / "flat.sealed"));
    }

    void imageComesBackByItsCode()
    {
        const Stimuli stimuli(6);
        StimulusBank bank(stimuli.path, stimuli.hashes, key);
        for (int round = 0; round < 2; ++round)
            for (int i = 0; i < 6; ++i) {
                const FileCode code(std::string(1, static_cast<char>('a' + i)));
                const cv::Mat& shown = bank.image(protocols::sealed(code, key));
                QCOMPARE(shown.type(), CV_8UC1);
                QCOMPARE(cv::norm(shown, image(10 * i), cv::NORM_INF), 0.0);
            }
        QVERIFY(faultsOfStimuli(stimuli.path, stimuli.hashes).empty());
    }

    void noFileIsReadDuringASession()
    {
        const Stimuli stimuli(2);
        StimulusBank bank(stimuli.path, stimuli.hashes, key);
        std::filesystem::remove(stimuli.file("b"));
        bank.prefetch(protocols::sealed(FileCode("b"), key));
        QCOMPARE(int(bank.imageOf(FileCode("b")).at<unsigned char>(3, 3)), 10);
    }

    void equalImagesHaveFilesWithoutAnythingInCommon()
    {
        const QTemporaryDir folder;
        const std::filesystem::path path(folder.path().toStdString());
        writeStimulus(path, FileCode("one"), image(7), key);
        writeStimulus(path, FileCode("two"), image(7), key);
        const auto first = protocols::readWholeFile(path / "one.sealed"), second = protocols::readWholeFile(path / "two.sealed");
        QCOMPARE(first.size(), second.size());
        std::size_t equal = 0;
        for (std::size_t i = 0; i < first.size(); ++i) equal += first[i] == second[i];
        // One byte in 256 agrees by chance, with a standard deviation of 63.
        QVERIFY2(std::abs(static_cast<double>(equal) - static_cast<double>(first.size()) / 256) < 320,
                 qPrintable(QString::number(equal)));
        QVERIFY(qCompress(QByteArray::fromStdString(first)).size() >= static_cast<qsizetype>(first.size()));
    }

    void unusableStimulusIsRefused_data()
    {
        QTest::addColumn<QString>("harm");
        QTest::addColumn<QString>("said");
        QTest::newRow("missing") << "remove"
                                 << "missing";
        QTest::newRow("one byte changed") << "flip"
                                          << "altered";
        QTest::newRow("cut short") << "cut"
                                   << "altered";
        QTest::newRow("a folder in its place") << "folder"
                                               << "missing";
    }
    void unusableStimulusIsRefused()
    {
        QFETCH(QString, harm);
        QFETCH(QString, said);
        const Stimuli stimuli(3);
        const auto file = stimuli.file("b");
        if (harm == "remove" || harm == "folder") std::filesystem::remove(file);
        if (harm == "folder") std::filesystem::create_directory(file);
        if (harm == "flip") std::fstream(file, std::ios::in | std::ios::out | std::ios::binary).seekp(500000).put('\x7f');
        if (harm == "cut") std::filesystem::resize_file(file, 1000);
        const auto refusal = refusalOf([&] { StimulusBank(stimuli.path, stimuli.hashes, key); });
        QVERIFY2(refusal.contains(said) && refusal.contains("b.sealed"), qPrintable(refusal));
        const auto faults = faultsOfStimuli(stimuli.path, stimuli.hashes);
        QCOMPARE(faults.size(), std::size_t(1));
        QVERIFY(QString::fromStdString(faults.front()).contains(said));
    }

    void tooLargeStimulusIsNotRead()
    {
        const Stimuli stimuli(3);
        std::filesystem::resize_file(stimuli.file("b"), 10'000'000'000);  // sparse
        QElapsedTimer time;
        time.start();
        const auto refusal = refusalOf([&] { StimulusBank(stimuli.path, stimuli.hashes, key); });
        const auto faults = faultsOfStimuli(stimuli.path, stimuli.hashes);
        QVERIFY(time.elapsed() < 1000);
        QVERIFY2(refusal.contains("it has 10000000000 bytes"), qPrintable(refusal));
        QCOMPARE(faults.size(), std::size_t(1));
        const auto size = std::filesystem::file_size(stimuli.file("a"));
        const auto said =
            QString("b.sealed: the stimulus was altered: it has 10000000000 bytes, and at most %1 are right").arg(size);
        QVERIFY2(QString::fromStdString(faults.front()).contains(said), faults.front().c_str());
    }

    void unreadableStimulusIsNotMissing()
    {
        const Stimuli stimuli(3);
        std::filesystem::permissions(stimuli.path, std::filesystem::perms(0755));
        std::filesystem::permissions(stimuli.file("b"), std::filesystem::perms::none);
        for (const char* name : {"a", "c"}) std::filesystem::permissions(stimuli.file(name), std::filesystem::perms(0644));
        const bool isRoot = ::geteuid() == 0;  // root may read every file
        if (isRoot) QCOMPARE(::seteuid(65534), 0);
        const auto refusal = refusalOf([&] { StimulusBank(stimuli.path, stimuli.hashes, key); });
        const auto faults = faultsOfStimuli(stimuli.path, stimuli.hashes);
        if (isRoot) QCOMPARE(::seteuid(0), 0);
        QVERIFY2(refusal.contains("the stimulus cannot be read (Permission denied)"), qPrintable(refusal));
        QCOMPARE(faults.size(), std::size_t(1));
        QVERIFY2(QString::fromStdString(faults.front()).endsWith("b.sealed: the stimulus cannot be read (Permission denied)"),
                 faults.front().c_str());
    }

    void swappedFilesAreRefused()
    {
        const Stimuli stimuli(2);
        std::filesystem::rename(stimuli.file("a"), stimuli.file("x"));
        std::filesystem::rename(stimuli.file("b"), stimuli.file("a"));
        std::filesystem::rename(stimuli.file("x"), stimuli.file("b"));
        QVERIFY(refusalOf([&] { StimulusBank(stimuli.path, stimuli.hashes, key); }).contains("altered"));
    }

    void anotherKeyOpensNothing()
    {
        const Stimuli stimuli(1);
        QVERIFY(
            refusalOf([&] { StimulusBank(stimuli.path, stimuli.hashes, protocols::SecretKey::ofSeed(4)); }).contains("altered"));
    }

    void unknownCodeIsRefused()
    {
        const Stimuli stimuli(1);
        StimulusBank bank(stimuli.path, stimuli.hashes, key);
        QVERIFY(refusalOf([&] { bank.imageOf(FileCode("zz")); }).contains("no stimulus"));
    }
};

QTEST_GUILESS_MAIN(StimulusBankTest)
#include "stimulus_bank_test.moc"
