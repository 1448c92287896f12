#include "rendering/signals/grey.h"

#include <QTest>
#include <opencv2/core.hpp>

#include "tests/rendering/refusal.h"

using rendering::signals::grey;

class GreyTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void weighsTheColoursAsOpenCvDoes_data()
    {
        QTest::addColumn<int>("red");
        QTest::addColumn<int>("green");
        QTest::addColumn<int>("blue");
        QTest::addColumn<double>("expected");
        QTest::newRow("red") << 255 << 0 << 0 << 76.245;
        QTest::newRow("green") << 0 << 255 << 0 << 149.685;
        QTest::newRow("blue") << 0 << 0 << 255 << 29.07;
        QTest::newRow("white") << 255 << 255 << 255 << 255.0;
        QTest::newRow("mixed, not rounded") << 10 << 20 << 31 << 18.264;
    }
    void weighsTheColoursAsOpenCvDoes()
    {
        QFETCH(int, red);
        QFETCH(int, green);
        QFETCH(int, blue);
        QFETCH(double, expected);
        const cv::Mat result = grey(cv::Mat(2, 3, CV_8UC3, cv::Scalar(red, green, blue)));
        QCOMPARE(result.type(), CV_32FC1);
        QVERIFY(std::abs(result.at<float>(1, 2) - expected) < 1e-4);
    }

    void keepsAGreyImageAsItIs()
    {
        const cv::Mat image = (cv::Mat_<unsigned short>(1, 3) << 0, 300, 65535);
        QCOMPARE(cv::norm(grey(image), cv::Mat((cv::Mat_<float>(1, 3) << 0, 300, 65535))), 0.0);
    }

    void refusesOtherThanOneOrThreeChannels()
    {
        QVERIFY(refusalOf([] { grey(cv::Mat()); }).contains("0 pixels"));
        QVERIFY(refusalOf([] { grey(cv::Mat::zeros(2, 2, CV_8UC2)); }).contains("2 channels"));
    }
};

QTEST_GUILESS_MAIN(GreyTest)
#include "grey_test.moc"
