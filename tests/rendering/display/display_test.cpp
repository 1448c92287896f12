#include "rendering/display/display.h"

#include <QTemporaryDir>
#include <QTest>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <set>

#include "rendering/display/test_patterns.h"
#include "rendering/images/image_io.h"
#include "tests/rendering/refusal.h"

using namespace rendering;

class DisplayTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void patternsHaveTheStatedPixels()
    {
        using enum TestPatternKind;
        const cv::Size size(16, 3);
        const auto row = [&](const TestPattern& pattern, std::optional<double> mmPerPixel = {}) {
            const cv::Mat image = testPatternImage(pattern, size, mmPerPixel);
            std::vector<int> values;
            for (int column = 0; column < image.cols; ++column) values.push_back(image.at<std::uint8_t>(1, column));
            for (int line = 0; line < image.rows; ++line)
                if (cv::norm(image.row(line), image.row(1), cv::NORM_INF) > 0) values.clear();
            return values;
        };
        const int h = 255;
        QCOMPARE(row({Uniform, 0}), std::vector<int>(16, h));
        QCOMPARE(row({Edge, 0}), (std::vector<int>{0, 0, 0, 0, 0, 0, 0, 0, h, h, h, h, h, h, h, h}));
        QCOMPARE(row({Grating, 2}, 0.25), (std::vector<int>{0, 0, 0, 0, h, h, h, h, 0, 0, 0, 0, h, h, h, h}));
        QCOMPARE(row({Grating, 1}, 0.5), (std::vector<int>{0, h, 0, h, 0, h, 0, h, 0, h, 0, h, 0, h, 0, h}));
        QCOMPARE(row({Grating, 4}, 0.5), (std::vector<int>{0, 0, 0, 0, h, h, h, h, 0, 0, 0, 0, h, h, h, h}));
        QCOMPARE(row({Ramp, 0}), (std::vector<int>{0, 17, 34, 51, 68, 85, 102, 119, 136, 153, 170, 187, 204, 221, 238, 255}));
        QCOMPARE(testPatternImage({Edge, 0}, std::nullopt, std::nullopt).size(), cv::Size(1280, 800));
        QVERIFY(refusalOf([&] {
                    testPatternImage({Grating, 2}, size, std::nullopt);
                }).contains("scale of the display is unknown"));
        QVERIFY(refusalOf([&] { testPatternImage({Grating, 1}, size, 0.6); }).contains("at least 2 pixels"));
    }

    void everyPatternHasANameOfItsOwn()
    {
        std::set<std::string> names;
        for (const TestPattern& pattern : testPatterns()) names.insert(nameOf(pattern));
        QCOMPARE(names, (std::set<std::string>{"uniform", "edge", "grating 1 mm", "grating 2 mm", "grating 4 mm", "grating 8 mm",
                                               "left–right ramp"}));
    }

    void sessionRunsWithoutADevice()
    {
        const auto display = openDisplay("none");
        display->show(cv::Mat(800, 1280, CV_8UC1, cv::Scalar(9)));
        display->clear();
        QCOMPARE(display->name(), std::string("none"));
    }

    void folderHoldsTheImageShownAndNothingElse()
    {
        QTemporaryDir folder;
        const std::filesystem::path path(folder.filePath("watched").toStdString()), current = path / "current.pgm";
        const auto display = openDisplay("folder:" + path.string());
        QCOMPARE(cv::countNonZero(readPgm(current)), 0);
        display->show(cv::Mat(800, 1280, CV_8UC1, cv::Scalar(77)));
        QCOMPARE(cv::norm(readPgm(current), cv::Mat(800, 1280, CV_8UC1, cv::Scalar(77)), cv::NORM_INF), 0.0);
        QCOMPARE(std::distance(std::filesystem::directory_iterator(path), {}), 1);
        display->clear();
        QCOMPARE(cv::countNonZero(readPgm(current)), 0);
        QCOMPARE(readPgm(current).size(), cv::Size(1280, 800));
    }

    void readerOfTheOldImageKeepsIt()
    {
        QTemporaryDir folder;
        const std::filesystem::path path(folder.path().toStdString());
        const auto display = openDisplay("folder:" + path.string());
        display->show(cv::Mat(800, 1280, CV_8UC1, cv::Scalar(50)));
        std::ifstream reader(path / "current.pgm", std::ios::binary);
        std::string bytes(1000, '\0');
        reader.read(bytes.data(), 1000);
        display->show(cv::Mat(800, 1280, CV_8UC1, cv::Scalar(200)));
        const std::string rest{std::istreambuf_iterator<char>(reader), {}};
        QCOMPARE(rest.size() + 1000, std::size_t(1280 * 800 + 16));
        QVERIFY(rest.find_first_not_of(char(50)) == std::string::npos);
    }

    void lostFolderIsReported()
    {
        QTemporaryDir folder;
        const std::filesystem::path path(folder.filePath("watched").toStdString());
        const auto display = openDisplay("folder:" + path.string());
        std::filesystem::remove_all(path);
        const auto refusal = refusalOf([&] { display->show(cv::Mat::zeros(800, 1280, CV_8UC1)); });
        QVERIFY2(refusal.contains("current.pgm"), qPrintable(refusal));
    }

    void unknownDisplayIsRefused_data()
    {
        QTest::addColumn<QString>("specification");
        for (const char* text : {"", "tanvas", "folder:", "folder", "None", "exec", "udp:host:1"})
            QTest::addRow("'%s'", text) << text;
    }
    void unknownDisplayIsRefused()
    {
        QFETCH(QString, specification);
        QVERIFY(refusalOf([&] { openDisplay(specification.toStdString()); }).contains("folder:DIR"));
    }
};

QTEST_GUILESS_MAIN(DisplayTest)
#include "display_test.moc"
