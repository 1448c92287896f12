// vis2hap calibrate and vis2hap height, as a person with a sensor runs them: a calibration and its report from presses, heights
// in mm from frames, gradients and normal maps. Faults are named and leave no files behind.
#include <QDir>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "protocols/random.h"
#include "rendering/images/image_io.h"
#include "tests/rendering/simulated_presses.h"
#include "tests/support/program.h"

using nlohmann::json;

namespace {

json jsonIn(const QString& file)
{
    QFile in(file);
    if (!in.open(QIODevice::ReadOnly)) throw std::runtime_error(("not there: " + file).toStdString());
    return json::parse(in.readAll().toStdString());
}

void writeJson(const QString& file, const json& content)
{
    QFile out(file);
    if (!out.open(QIODevice::WriteOnly)) throw std::runtime_error(("not writable: " + file).toStdString());
    out.write(content.dump().c_str());
}

double highest(const cv::Mat& image)
{
    double top = 0;
    cv::minMaxLoc(image, nullptr, &top);
    return top;
}

}  // namespace

class HeightCommandTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        const auto made = tests::simulatedPresses(10);
        m_presses = m_folder.filePath("presses");
        QVERIFY(QDir().mkpath(m_presses));
        rendering::writePng((m_presses + "/background.png").toStdString(), made.presses.background);
        for (const auto& press : made.presses.presses)
            rendering::writePng((m_presses + "/").toStdString() + press.name, press.frame);
        m_sensor = m_folder.filePath("sensor.json");
    }

    void pressesBecomeACalibrationWithItsQuality()
    {
        const auto ended =
            support::mustRun({"calibrate", m_presses, "--ball-radius", "2", "--mm-per-pixel", "0.125", "--out", m_sensor});
        QVERIFY2(ended.out.contains("cross-validated") && ended.out.contains("accurate"), qPrintable(ended.out));
        QCOMPARE(jsonIn(m_sensor)["kind"].get<std::string>(), std::string("polynomial"));
        const auto report = jsonIn(m_folder.filePath("sensor-quality.json"));
        QCOMPARE(report["presses"].get<int>(), 10);
        QVERIFY(report["cross_validated"]["normal_error_deg"].get<double>() < 3);
        QCOMPARE(report["cross_validated"]["presses"].size(), std::size_t(10));
        QCOMPARE(report["trade"].size(), std::size_t(3));
        const cv::Mat sheet = rendering::readPng(m_folder.filePath("sensor-presses.png").toStdString());
        QVERIFY(sheet.rows > 1000 && sheet.channels() == 3);
        QVERIFY(QFile::exists(m_folder.filePath("sensor-background.png")));
    }

    void furtherPressesAreScoredApart()
    {
        const auto ended =
            support::mustRun({"calibrate", m_presses, "--ball-radius", "2", "--mm-per-pixel", "0.125", "--out",
                              m_folder.filePath("tested.json"), "--quality", "fast", "--test", m_presses, "--json"});
        const auto report = json::parse(ended.out.toStdString());
        QCOMPARE(report["test"]["presses"].size(), std::size_t(10));
        QVERIFY(report["test"]["depth_error_mm"].get<double>() < 0.1);
    }

    void pressIsReadAboveTheEdgeOfItsContact()
    {
        const QString out = m_folder.filePath("heights");
        support::mustRun({"height", m_presses + "/press_3.png", "--calibration", m_sensor, "--out", out});
        const cv::Mat height = rendering::readTiff((out + "/press_3.tiff").toStdString());
        QVERIFY2(std::abs(highest(height) - (2 - std::sqrt(4 - 1.625 * 1.625))) < 0.2,
                 qPrintable(QString::number(highest(height))));
        const auto facts = jsonIn(out + "/press_3.json");
        QCOMPARE(facts["contact"].get<std::string>(), std::string("part"));
        QVERIFY(facts["curl_residual"].get<double>() < 0.5);
        QVERIFY(QFile::exists(out + "/press_3-gx.npy") && QFile::exists(out + "/press_3-gy.npy"));
        support::mustRun({"height", m_presses + "/press_3.png", "--calibration", m_sensor, "--contact", "whole", "--out", out});
        QVERIFY(jsonIn(out + "/press_3.json")["high_pass_cutoff_mm"].get<double>() > 0);
    }

    void framesOfACalibratedSensorBecomeADataSetWithHeights()
    {
        const QString felt = m_folder.filePath("frames/Felt"), set = m_folder.filePath("set"),
                      images = m_folder.filePath("images");
        QVERIFY(QDir().mkpath(felt));
        for (const char* press : {"/press_1.png", "/press_2.png"}) QVERIFY(QFile::copy(m_presses + press, felt + press));
        const auto ended =
            support::mustRun({"import", "gelsight", m_folder.filePath("frames"), "--calibration", m_sensor, "--out", set});
        QVERIFY2(ended.out.contains("calibrated"), qPrintable(ended.out));
        QCOMPARE(jsonIn(set + "/dataset.json")["tactile"]["mm_per_pixel"].get<double>(), 0.125);
        support::mustRun({"render", set, "--condition", "h", "--out", images});
        QVERIFY(QFile::exists(images + "/F01/h.png"));

        // A calibration of 16-bit frames has a background of 16 bits; the data set could not be read.
        const QString wide = m_folder.filePath("wide.json"), wideSet = m_folder.filePath("wide-set");
        QVERIFY(QFile::copy(m_sensor, wide));
        cv::Mat background;
        rendering::readPng((m_presses + "/background.png").toStdString()).convertTo(background, CV_16U, 257);
        rendering::writePng(m_folder.filePath("wide-background.png").toStdString(), background);
        support::mustRun({"import", "gelsight", m_folder.filePath("frames"), "--calibration", wide, "--out", wideSet});
        support::mustRun({"fabrics", "check", wideSet});
        QCOMPARE(rendering::readPng((wideSet + "/tactile-reference.png").toStdString()).type(), CV_8UC3);

        // With another calibration, the data set would contain frames of two sensors.
        const auto refused = support::runProgram(
            {"import", "gelsight", m_folder.filePath("frames"), "--calibration", m_folder.filePath("tested.json"), "--out", set});
        QCOMPARE(refused.exitCode, 2);
        QVERIFY2(refused.err.contains("another calibration"), qPrintable(refused.err));
    }

    void anotherSensorsBackgroundIsRefused()
    {
        const QString other = m_folder.filePath("other.png"), out = m_folder.filePath("nothing");
        cv::Mat background = rendering::readPng((m_presses + "/background.png").toStdString());
        rendering::writePng(other.toStdString(), background * 0.6);
        const auto ended = support::runProgram(
            {"height", m_presses + "/press_3.png", "--calibration", m_sensor, "--background", other, "--out", out});
        QCOMPARE(ended.exitCode, 2);
        QVERIFY2(ended.err.contains("not of the calibrated sensor"), qPrintable(ended.err));
        QVERIFY2(!QDir(out).exists(), "nothing is left behind");
    }

    /// Frames of 320 x 240 px with the calibration of 3280 x 2464 px rendered without a word, 8 times too low.
    void framesOfAnotherSensorThanTheCalibratedAreRefused_data()
    {
        QTest::addColumn<QString>("change");
        QTest::addColumn<QString>("words");
        QTest::newRow("smaller frames") << "size"
                                        << "it has 80 x 60 pixels, but the sensor has 160 x 120";
        QTest::newRow("other light") << "light"
                                     << "another sensor or other light";
        QTest::newRow("other pitch") << "pitch"
                                     << "mm per pixel, but";
    }
    void framesOfAnotherSensorThanTheCalibratedAreRefused()
    {
        QFETCH(const QString, change);
        QFETCH(const QString, words);
        const QString frames = m_folder.filePath("foreign-" + change), set = frames + "-set", images = frames + "-images";
        QVERIFY(QDir().mkpath(frames + "/Felt") && QFile::copy(m_presses + "/press_5.png", frames + "/Felt/press_5.png"));
        support::mustRun({"import", "gelsight", frames, "--calibration", m_sensor, "--out", set});
        support::mustRun({"fabrics", "check", set});
        for (const char* name : {"/tactile-reference.png", "/F01/tactile/000.png"}) {
            const std::string file = (set + name).toStdString();
            const cv::Mat frame = rendering::readPng(file);
            if (change == "size") rendering::writePng(file, frame(cv::Rect(0, 0, 80, 60)).clone());
            if (change == "light") rendering::writePng(file, frame * 0.6);
        }
        auto dataset = jsonIn(set + "/dataset.json");
        if (change == "pitch") dataset["tactile"]["mm_per_pixel"] = 1.0;
        writeJson(set + "/dataset.json", dataset);

        const auto checked = support::runProgram({"fabrics", "check", set});
        QCOMPARE(checked.exitCode, 1);
        QVERIFY2(checked.out.contains(words) && checked.out.contains(": 1 fault\n"), qPrintable(checked.out));
        const auto rendered = support::runProgram({"render", set, "--condition", "h", "--out", images});
        QCOMPARE(rendered.exitCode, 2);
        QVERIFY2(rendered.err.contains(words), qPrintable(rendered.err));
        QVERIFY(!QFile::exists(images + "/F01/h.png"));
    }

    /// A colour picture ended as an unexpected failure, and left a calibration behind; micrometres calibrated without a word.
    void surfacesThatAreNoHeightsInMillimetresAreRefused_data()
    {
        QTest::addColumn<QString>("surface");
        QTest::addColumn<QString>("words");
        cv::Mat waves(120, 160, CV_32FC1), integers;
        for (int i = 0; i < 120; ++i)
            for (int j = 0; j < 160; ++j) waves.at<float>(i, j) = 100 * std::sin(0.4F * j + 0.3F * i);  // um, if read rightly
        waves.convertTo(integers, CV_16U, 1, 100);
        rendering::writePng(m_folder.filePath("micrometres.png").toStdString(), integers);
        rendering::writeTiff(m_folder.filePath("micrometres.tiff").toStdString(), waves);
        QTest::newRow("colour picture") << m_presses + "/press_2.png"
                                        << "is a picture, and no map of heights in mm";
        QTest::newRow("integers") << m_folder.filePath("micrometres.png") << "is a picture, and no map of heights in mm";
        QTest::newRow("micrometres") << m_folder.filePath("micrometres.tiff") << "steeper than 10 mm per mm";
    }
    void surfacesThatAreNoHeightsInMillimetresAreRefused()
    {
        QFETCH(const QString, surface);
        QFETCH(const QString, words);
        const QString out = m_folder.filePath("surface.json");
        const auto ended = support::runProgram({"calibrate", m_presses + "/press_1.png", "--surface", surface, "--background",
                                                m_presses + "/background.png", "--mm-per-pixel", "0.125", "--out", out});
        QCOMPARE(ended.exitCode, 2);
        QVERIFY2(ended.err.contains(words) && ended.messages().size() == 1, qPrintable(ended.err));
        QVERIFY(!QFile::exists(out));
    }

    void gradientsComeBackAsTheSurfaceTheyAreOf()
    {
        cv::Mat height(40, 50, CV_64FC1), x(40, 50, CV_64FC1), y(40, 50, CV_64FC1);
        protocols::Random random(4);
        for (double& value : cv::Mat_<double>(height)) value = random.normal();
        for (int i = 0; i < 40; ++i)
            for (int j = 0; j < 50; ++j) {
                const int left = std::max(0, j - 1), right = std::min(49, j + 1), above = std::max(0, i - 1),
                          below = std::min(39, i + 1);
                x.at<double>(i, j) = (height.at<double>(i, right) - height.at<double>(i, left)) / ((right - left) * 0.02);
                y.at<double>(i, j) = (height.at<double>(below, j) - height.at<double>(above, j)) / ((below - above) * 0.05);
            }
        const auto gx = m_folder.filePath("gx.npy"), gy = m_folder.filePath("gy.npy"), out = m_folder.filePath("integrated");
        rendering::writeNpy(gx.toStdString(), x);
        rendering::writeNpy(gy.toStdString(), y);
        support::mustRun({"height", "--gradients", gx, gy, "--kind", "central", "--pitch", "0.02,0.05", "--out", out});
        cv::Mat found;
        rendering::readTiff((out + "/height.tiff").toStdString()).convertTo(found, CV_64F);
        QVERIFY(cv::norm(found - cv::mean(found)[0], height - cv::mean(height)[0], cv::NORM_INF) < 1e-5);

        x.at<double>(7, 9) = std::numeric_limits<double>::quiet_NaN();
        rendering::writeNpy(gx.toStdString(), x);
        support::mustRun({"height", "--gradients", gx, gy, "--kind", "central", "--pitch", "0.02,0.05", "--out", out});
        const auto facts = jsonIn(out + "/height.json");
        QCOMPARE(facts["missing_share"].get<double>(), 1.0 / 2000);
        QVERIFY(cv::checkRange(rendering::readTiff((out + "/height.tiff").toStdString())));
    }

    void normalMapIsTurnedTheWayThatIsASurface()
    {
        cv::Mat normals(64, 64, CV_8UC3);
        for (int i = 0; i < 64; ++i)
            for (int j = 0; j < 64; ++j) {
                const double p = 0.3 * std::sin(0.3 * j + 0.2 * i), q = 0.2 * std::sin(0.3 * j + 0.2 * i),
                             length = std::sqrt(1 + p * p + q * q);
                const auto stored = [&](double n) { return cv::saturate_cast<uchar>(255 * (n / length + 1) / 2); };
                normals.at<cv::Vec3b>(i, j) = {stored(-p), stored(-q), stored(1)};  // y points down, but no option states it
            }
        const auto file = m_folder.filePath("normals.png"), out = m_folder.filePath("normal");
        rendering::writePng(file.toStdString(), normals);
        support::mustRun({"height", "--normals", file, "--out", out});
        const auto facts = jsonIn(out + "/normals.json");
        QCOMPARE(facts["normals_y"].get<std::string>(), std::string("down"));
        QVERIFY(facts["curl_residual"].get<double>() < 0.1);
        QVERIFY(facts["curl_residual_y_up"].get<double>() > 0.3);
    }

    /// The places that the mask leaves out chose "down" for a map whose y points up.
    void maskedNormalsDoNotDecideWhichWayYPoints()
    {
        constexpr int firstMasked = 45;
        cv::Mat normals(64, 64, CV_8UC3), mask(64, 64, CV_8UC1);
        for (int i = 0; i < 64; ++i)
            for (int j = 0; j < 64; ++j) {
                const bool isMasked = j >= firstMasked;
                const double wave = (isMasked ? 4 : 1) * std::sin(0.3 * j + 0.2 * i), p = 0.3 * wave,
                             q = (isMasked ? -0.2 : 0.2) * wave, length = std::sqrt(1 + p * p + q * q);
                const auto stored = [&](double n) { return cv::saturate_cast<uchar>(255 * (n / length + 1) / 2); };
                normals.at<cv::Vec3b>(i, j) = {stored(-p), stored(q), stored(1)};
                mask.at<uchar>(i, j) = isMasked ? 0 : 255;
            }
        const auto file = m_folder.filePath("half.png"), places = m_folder.filePath("half-mask.png"),
                   out = m_folder.filePath("half");
        rendering::writePng(file.toStdString(), normals);
        rendering::writePng(places.toStdString(), mask);
        support::mustRun({"height", "--normals", file, "--mask", places, "--out", out});
        const auto facts = jsonIn(out + "/half.json");
        QCOMPARE(facts["normals_y"].get<std::string>(), std::string("up"));
        QVERIFY(facts["curl_residual"].get<double>() < 0.1);
        QVERIFY(facts["curl_residual_y_down"].get<double>() > 0.3);
    }

    void maskedSlopesDoNotCountInTheCurl()
    {
        const cv::Rect hole(20, 15, 12, 10);
        cv::Mat x(50, 60, CV_32FC1), y(50, 60, CV_32FC1), mask(50, 60, CV_8UC1, cv::Scalar(255));
        for (int i = 0; i < 50; ++i)
            for (int j = 0; j < 60; ++j) {
                x.at<float>(i, j) = 0.3F * std::cos(0.3F * static_cast<float>(j) + 0.2F * static_cast<float>(i));
                y.at<float>(i, j) = 0.2F * std::cos(0.3F * static_cast<float>(j) + 0.2F * static_cast<float>(i));
            }
        mask(hole) = 0;
        protocols::Random random(4);
        for (int i = hole.y; i < hole.y + hole.height; ++i)
            for (int j = hole.x; j < hole.x + hole.width; ++j) {
                x.at<float>(i, j) = static_cast<float>(20 * random.normal());
                y.at<float>(i, j) = static_cast<float>(20 * random.normal());
            }
        const auto gx = m_folder.filePath("noise-gx.npy"), gy = m_folder.filePath("noise-gy.npy"),
                   places = m_folder.filePath("hole.png"), masked = m_folder.filePath("masked"),
                   missing = m_folder.filePath("missing");
        rendering::writeNpy(gx.toStdString(), x);
        rendering::writeNpy(gy.toStdString(), y);
        rendering::writePng(places.toStdString(), mask);
        support::mustRun({"height", "--gradients", gx, gy, "--mask", places, "--out", masked});
        for (cv::Mat* slope : {&x, &y}) (*slope)(hole) = std::numeric_limits<float>::quiet_NaN();
        rendering::writeNpy(gx.toStdString(), x);
        rendering::writeNpy(gy.toStdString(), y);
        support::mustRun({"height", "--gradients", gx, gy, "--out", missing});
        const auto facts = jsonIn(masked + "/height.json"), same = jsonIn(missing + "/height.json");
        QCOMPARE(facts["missing_share"].get<double>(), 120.0 / 3000);
        QCOMPARE(facts["curl_residual"].get<double>(), same["curl_residual"].get<double>());
        QVERIFY2(facts["curl_residual"].get<double>() < 0.05, qPrintable(QString::number(facts["curl_residual"].get<double>())));
        const auto heightIn = [](const QString& folder) { return rendering::readTiff((folder + "/height.tiff").toStdString()); };
        QCOMPARE(cv::norm(heightIn(masked), heightIn(missing), cv::NORM_INF), 0.0);
    }

    void wrongCallsAreNamed_data()
    {
        QTest::addColumn<QStringList>("arguments");
        QTest::addColumn<QString>("named");
        QTest::newRow("no source") << QStringList{"height", "--out", "x"} << "0 sources of heights";
        QTest::newRow("no calibration") << QStringList{"height", "frame.png", "--out", "x"} << "calibration";
        QTest::newRow("no ball") << QStringList{"calibrate", "presses", "--out", "x.json"} << "--ball-radius";
        QTest::newRow("no folder") << QStringList{"calibrate",      "/nowhere", "--ball-radius", "2",
                                                  "--mm-per-pixel", "0.1",      "--out",         "x.json"}
                                   << "/nowhere";
        QTest::newRow("unknown kind") << QStringList{"height", "--gradients", "a.npy", "b.npy",
                                                     "--kind", "sideways",    "--out", "x"}
                                      << "--kind";
        QTest::newRow("cut-off that is no number")
            << QStringList{"height", "--normals", "n.png", "--cutoff", "nan", "--out", "x"} << "--cutoff";
        QTest::newRow("contact of gradients")
            << QStringList{"height", "--gradients", "a.npy", "b.npy", "--contact", "whole", "--out", "x"} << "--contact";
        QTest::newRow("unknown contact") << QStringList{"height",        m_presses + "/press_1.png",
                                                        "--calibration", m_sensor,
                                                        "--contact",     "foo",
                                                        "--out",         "x"}
                                         << "foo";
        QTest::newRow("pitch of frames") << QStringList{"height",        m_presses + "/press_1.png",
                                                        "--calibration", m_sensor,
                                                        "--pitch",       "3",
                                                        "--out",         "x"}
                                         << "--pitch";
        for (const char* pitch : {"0.02,,0.05", "0.02,", "0.02,0.05,0.1", "0.02,x", "0,0.05"})
            QTest::addRow("pitch %s", pitch)
                << QStringList{"height", "--gradients", "a.npy", "b.npy", "--pitch", pitch, "--out", "x"}
                << "one number above 0, or two";
        QTest::newRow("folder as calibration")
            << QStringList{"height", m_presses + "/press_1.png", "--calibration", m_presses, "--out", m_folder.filePath("x")}
            << "cannot be read";
        QTest::newRow("one name twice")
            << QStringList{"height", m_presses + "/press_1.png", m_presses + "/press_1.png", "--calibration", m_sensor,
                           "--out",  m_folder.filePath("x")}
            << "press_1.png";
        QTest::newRow("no recordings") << QStringList{"bench", "signals", "--data", "/nowhere"} << "/nowhere";
    }
    void wrongCallsAreNamed()
    {
        QFETCH(QStringList, arguments);
        QFETCH(QString, named);
        const auto ended = support::runProgram(arguments);
        QCOMPARE(ended.exitCode, 2);
        QVERIFY2(ended.err.contains(named), qPrintable(ended.err));
        QCOMPARE(ended.messages().size(), 1);
        QVERIFY2(!ended.err.contains("so far"), qPrintable(ended.err));  // before any work
    }

private:
    QTemporaryDir m_folder;
    QString m_presses, m_sensor;
};

QTEST_GUILESS_MAIN(HeightCommandTest)
#include "height_command_test.moc"
