#include "rendering/display/stimulus_bank.h"

#include <sys/stat.h>

#include <QTemporaryDir>
#include <QTest>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>

#include "protocols/files/sha256.h"
#include "tests/rendering/refusal.h"

using namespace rendering;
using protocols::FileCode;

namespace {

cv::Mat image(int level) { return cv::Mat(800, 1280, CV_8UC1, cv::Scalar(level)); }

/// A bank of stimuli "a", "b" and so on, each with its own level.
struct Stimuli {
    explicit Stimuli(int count)
    {
        for (int i = 0; i < count; ++i) {
            const FileCode code(std::string(1, static_cast<char>('a' + i)));
            hashes[code] = writeStimulus(path, code, image(10 * i));
        }
    }
    std::filesystem::path file(const char* name) const { return path / (std::string(name) + ".pgm"); }

    QTemporaryDir folder;
    std::filesystem::path path{folder.path().toStdString()};
    std::map<FileCode, std::string> hashes;
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
        const auto hash = writeStimulus(path, FileCode("flat"), image(0));
        writeStimulus(path, FileCode("rough"), noise);
        struct stat flat, rough;
        QCOMPARE(stat((path / "flat.pgm").c_str(), &flat), 0);
        QCOMPARE(stat((path / "rough.pgm").c_str(), &rough), 0);
        QCOMPARE(flat.st_size, rough.st_size);
        QCOMPARE(flat.st_mtime, 946684800);
        QCOMPARE(rough.st_mtim.tv_sec, flat.st_mtim.tv_sec);
        QCOMPARE(rough.st_mtim.tv_nsec, 0);
        QCOMPARE(flat.st_mode & 0777, 0644U);
        QCOMPARE(hash, protocols::sha256OfFile(path / "flat.pgm"));
    }

    void imageComesBackByItsCode()
    {
        const Stimuli stimuli(6);
        StimulusBank bank(stimuli.path, stimuli.hashes);
        for (int round = 0; round < 2; ++round)
            for (int i = 0; i < 6; ++i) {
                const cv::Mat& shown = bank.image(FileCode(std::string(1, static_cast<char>('a' + i))));
                QCOMPARE(shown.type(), CV_8UC1);
                QCOMPARE(cv::norm(shown, image(10 * i), cv::NORM_INF), 0.0);
            }
        QVERIFY(bank.faults().empty());
    }

    void prefetchedImageNeedsNoFile()
    {
        const Stimuli stimuli(2);
        StimulusBank bank(stimuli.path, stimuli.hashes);
        bank.prefetch(FileCode("b"));
        std::filesystem::remove(stimuli.file("b"));
        QCOMPARE(int(bank.image(FileCode("b")).at<unsigned char>(3, 3)), 10);
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
        StimulusBank bank(stimuli.path, stimuli.hashes);
        const auto refusal = refusalOf([&] { bank.image(FileCode("b")); });
        QVERIFY2(refusal.contains(said) && refusal.contains("b.pgm"), qPrintable(refusal));
        QCOMPARE(bank.faults().size(), std::size_t(1));
        QVERIFY(QString::fromStdString(bank.faults().front()).contains(said));
        QCOMPARE(int(bank.image(FileCode("c")).at<unsigned char>(0, 0)), 20);
    }

    void unknownCodeIsRefused()
    {
        const Stimuli stimuli(1);
        StimulusBank bank(stimuli.path, stimuli.hashes);
        QVERIFY(refusalOf([&] { bank.image(FileCode("zz")); }).contains("no stimulus"));
    }
};

QTEST_GUILESS_MAIN(StimulusBankTest)
#include "stimulus_bank_test.moc"
