// Signals on a sheet: figures that reveal a bad recording, readable axes, correct pictures. Also the protection of stimuli of a
// study that still runs.
#include <QSet>
#include <cmath>
#include <limits>

#include "database/study_store.h"
#include "rendering/fabrics/procedural/procedural_fabrics.h"
#include "rendering/images/image_io.h"
#include "study/looking/dataset_sheet.h"
#include "study/looking/open_study.h"
#include "study/looking/picture_decoder.h"
#include "study/looking/read_signal.h"
#include "study/looking/relief_picture.h"
#include "study/looking/sheet.h"
#include "tests/rendering/fabric_files.h"
#include "tests/support/study_builder.h"

using namespace study::looking;
using fabric_files::contains;
using fabric_files::refusalOf;

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

SeenMap& mapOf(SeenSignal& signal) { return std::get<SeenMap>(signal.what); }

QString warningsIn(const SeenSignal& signal)
{
    QStringList texts;
    for (const auto& warning : warningsOf(signal, factsOf(signal))) texts << QString::fromStdString(warning);
    return texts.join(' ');
}

/// Number of colours in a picture; an empty picture has few.
int coloursIn(const QImage& image)
{
    QSet<QRgb> colours;
    for (int y = 0; y < image.height(); y += 3)
        for (int x = 0; x < image.width(); x += 3) colours.insert(image.pixel(x, y));
    return static_cast<int>(colours.size());
}

}  // namespace

class LookingTest : public QObject {
    Q_OBJECT
    QTemporaryDir m_folder;

    std::filesystem::path at(const std::string& name) { return fabric_files::pathOf(m_folder) / name; }

private Q_SLOTS:
    void figuresOfAMapAreExact()
    {
        // 1 2 / 3 NaN: mean 2, Sq sqrt(2/3).
        cv::Mat heights = (cv::Mat_<float>(2, 2) << 1, 2, 3, static_cast<float>(nothing));
        rendering::writeTiff(at("h.tiff"), heights);
        const auto seen = readSignal(at("h.tiff"), {0.1, {}, {}, {}, {}});
        const auto facts = factsOf(seen);
        QCOMPARE(facts.min.value(), 1.0);
        QCOMPARE(facts.max.value(), 3.0);
        QCOMPARE(facts.mean.value(), 2.0);
        QVERIFY(std::abs(facts.sq.value() - std::sqrt(2.0 / 3)) < 1e-12);
        QCOMPARE(facts.missingShare, 0.25);
        QVERIFY(!facts.clippedLowShare);
        QVERIFY(warningsIn(seen).contains("25 % of the points are missing"));
        QCOMPARE(QString::fromStdString(linesOf(seen, facts).front()), QString("min 1   max 3 mm"));
    }

    void smallWavesOnALargeHeightKeepTheirSq()
    {
        cv::Mat heights(100, 100, CV_32FC1);
        for (int i = 0; i < 10000; ++i) heights.at<float>(i / 100, i % 100) = 1024.0f + (i % 2 ? 0.125f : -0.125f);
        const auto facts = factsOf(seenHeight(heights, {}, "t", "o"));
        QVERIFY(std::abs(facts.sq.value() - 0.125) < 1e-9);
    }

    void clippedPixelsAreCounted_data()
    {
        QTest::addColumn<int>("low");
        QTest::addColumn<int>("high");
        QTest::addColumn<bool>("isWarned");
        QTest::newRow("none") << 0 << 0 << false;
        QTest::newRow("a few") << 3 << 2 << false;
        QTest::newRow("bright") << 0 << 50 << true;
        QTest::newRow("dark") << 30 << 0 << true;
    }
    void clippedPixelsAreCounted()
    {
        QFETCH(int, low);
        QFETCH(int, high);
        QFETCH(bool, isWarned);
        cv::Mat image(20, 50, CV_8UC1);
        for (int i = 0; i < 1000; ++i)
            image.data[i] = static_cast<unsigned char>(i < low ? 0 : i < low + high ? 255 : 40 + i % 150);
        rendering::writePgm(at("c.pgm"), image);
        const auto seen = readSignal(at("c.pgm"));
        const auto facts = factsOf(seen);
        QCOMPARE(facts.clippedLowShare.value(), low / 1000.0);
        QCOMPARE(facts.clippedHighShare.value(), high / 1000.0);
        QCOMPARE(warningsIn(seen).contains("clipped"), isWarned);
    }

    void oneClippedChannelOfAColourCounts()
    {
        cv::Mat picture(10, 10, CV_8UC3, cv::Scalar(100, 150, 200));
        picture.at<cv::Vec3b>(3, 3) = {100, 255, 0};
        rendering::writePng(at("p.png"), picture);
        auto seen = readSignal(at("p.png"));
        const auto facts = factsOf(seen);
        QCOMPARE(facts.clippedLowShare.value(), 0.01);
        QCOMPARE(facts.clippedHighShare.value(), 0.01);
        QVERIFY(mapOf(seen).colours.at<cv::Vec3b>(0, 0) == cv::Vec3b(100, 150, 200));
    }

    void sixteenBitImagesKeepTheirScale()
    {
        cv::Mat image(4, 5, CV_16UC1, cv::Scalar(1000));
        image.at<std::uint16_t>(0, 0) = 65535;
        rendering::writePng(at("deep.png"), image);
        const auto facts = factsOf(readSignal(at("deep.png")));
        QCOMPARE(facts.max.value(), 65535.0);
        QCOMPARE(facts.clippedHighShare.value(), 0.05);
    }

    void markersOfMissingHeightsAreNotHeights()
    {
        cv::Mat heights = (cv::Mat_<float>(1, 3) << 0.1f, -1e10f, 0.3f);
        rendering::writeTiff(at("marked.tiff"), heights);
        const auto facts = factsOf(readSignal(at("marked.tiff")));
        QVERIFY(facts.min.value() > 0);
        QVERIFY(std::abs(facts.missingShare - 1.0 / 3) < 1e-12);
    }

    void pitchComesFromTheDataSet()
    {
        const auto dataset = fabric_files::smallDataset(at("set"));
        auto photograph = readSignal(at("set/F01/visual/001.png")), frame = readSignal(at("set/F01/tactile/000.png")),
             height = readSignal(at("set/F01/height/000.tiff"));
        QCOMPARE(mapOf(photograph).mmPerPixel.value(), 0.04);
        QCOMPARE(mapOf(frame).mmPerPixel.value(), 0.05);
        QCOMPARE(mapOf(height).mmPerPixel.value(), 0.05);
        QCOMPARE(mapOf(height).unit, std::string("mm"));
        QVERIFY(contains(photograph.kind, "photograph") && contains(frame.kind, "tactile frame") &&
                contains(height.kind, "height"));
        QCOMPARE(photograph.title, std::string("F01 visual 001.png"));
        auto overridden = readSignal(at("set/F01/visual/001.png"), {0.5, {}, {}, {}, {}});
        QCOMPARE(mapOf(overridden).mmPerPixel.value(), 0.5);
        const auto stroke = readSignal(at("set/F01/friction/000.csv"));
        const auto& trace = std::get<SeenTrace>(stroke.what);
        QCOMPARE(trace.placeUnit, std::string("mm"));
        QCOMPARE(trace.places, (std::vector<double>{0, 2.5, 5, 7.5, 10, 12.5, 15, 17.5}));  // 5 mm/s
        QCOMPARE(trace.values, (std::vector<double>{0.2, 0.3, 0.2, 0.2, 0.3, 0.2, 0.2, 0.3}));
        QVERIFY(warningsIn(readSignal(at("set/F01/height/000.tiff"))).contains("All values are equal"));
    }

    void profilometerMapsKeepTheirPitch()
    {
        std::string bytes = "Binary TrueMap Data File v2.0\r\n";
        bytes.resize(32);
        bytes += std::string("made for a test") + '\0';
        const std::uint32_t size[] = {4, 3};
        const float extent[] = {2, 3, 0, 0}, heights[] = {0, 1, 2, 3, 0, 1, -1e10f, 3, 0, 1, 2, 3};
        bytes.append(reinterpret_cast<const char*>(size), sizeof size);
        bytes.append(reinterpret_cast<const char*>(extent), sizeof extent);
        bytes.append(reinterpret_cast<const char*>(heights), sizeof heights);
        fabric_files::write(at("scan.TMD"), bytes);
        auto seen = readSignal(at("scan.TMD"));
        QCOMPARE(mapOf(seen).values.size(), cv::Size(4, 3));
        QVERIFY(mapOf(seen).mmPerPixel.value() > 0 && mapOf(seen).rowPitch > 1.5);  // the pitch between rows is larger
        QVERIFY(std::abs(factsOf(seen).missingShare - 1.0 / 12) < 1e-12);
        QVERIFY(coloursIn(drawSheet({seen}, lightSheet())) > 20);
    }

    void otherPictureFormatsNeedADecoder()
    {
        fabric_files::write(at("photo.jpg"), "as a camera writes it");
        ReadingOptions options;
        QVERIFY(contains(refusalOf([&] { readSignal(at("photo.jpg"), options); }), "photo.jpg"));
        options.decode = [](const std::filesystem::path&) { return cv::Mat(5, 6, CV_8UC3, cv::Scalar(1, 2, 3)); };
        auto seen = readSignal(at("photo.jpg"), options);
        QCOMPARE(mapOf(seen).values.size(), cv::Size(6, 5));
    }

    /// Qt decides by the content. A drawing that is program text is no photograph, whatever its name.
    void onlyFormatsOfPhotographsAreDecoded()
    {
        QImage image(24, 20, QImage::Format_RGB32);
        image.fill(Qt::darkCyan);
        for (const char* format : {"JPG", "PNG", "BMP", "PPM"}) {
            QVERIFY(image.save(QString::fromStdString(at("photo.jpg").string()), format));
            QCOMPARE(decodeByQt(at("photo.jpg")).size(), cv::Size(24, 20));
        }
        for (const char* format : {"XPM", "XBM"}) {
            QVERIFY(image.save(QString::fromStdString(at("photo.jpg").string()), format));
            const auto refusal = refusalOf([&] { decodeByQt(at("photo.jpg")); });
            QVERIFY2(contains(refusal, "none of the formats of photographs") && contains(refusal, "PNG, JPEG, BMP, GIF"),
                     refusal.c_str());
        }
    }

    void heightsBelowZeroInADataSetGiveAWarning()
    {
        fabric_files::smallDataset(at("low"));
        cv::Mat height = (cv::Mat_<float>(1, 3) << -0.1f, 0.2f, 0.3f);
        for (const char* file : {"low/F01/height/000.tiff", "low.tiff"}) rendering::writeTiff(at(file), height);
        QVERIFY(warningsIn(readSignal(at("low/F01/height/000.tiff"))).contains("below 0"));
        QVERIFY(!warningsIn(readSignal(at("low.tiff"))).contains("below 0"));  // outside a data set, heights have no fixed zero
    }

    void frictionImageOfTheDisplayHasTheGlassPitch()
    {
        rendering::writePgm(at("glass.pgm"), cv::Mat(800, 1280, CV_8UC1, cv::Scalar(1)));
        rendering::writePgm(at("part.pgm"), cv::Mat(80, 128, CV_8UC1, cv::Scalar(1)));
        auto whole = readSignal(at("glass.pgm")), part = readSignal(at("part.pgm"));
        QCOMPARE(mapOf(whole).mmPerPixel.value(), 0.170);
        QVERIFY(!mapOf(part).mmPerPixel);
    }

    void recordWithoutContactShowsItsGaps()
    {
        fabric_files::write(at("air.csv"), "t_s,normal_n,tangential_n\n0,1,0.5\n1,0,0.1\n2,,0.1\n3,2,0.5\n");
        const auto seen = readSignal(at("air.csv"));
        const auto& trace = std::get<SeenTrace>(seen.what);
        QCOMPARE(trace.placeUnit, std::string("s"));
        QVERIFY(trace.values[0] == 0.5 && std::isnan(trace.values[1]) && std::isnan(trace.values[2]) && trace.values[3] == 0.25);
        QCOMPARE(trace.sampleRateHz.value(), 1.0);
        QVERIFY2(warningsIn(seen).contains("50 % of the samples are missing: not in contact"), qPrintable(warningsIn(seen)));
    }

    /// A lab keeps both strokes in one file, so its time begins again at 0.
    void aSecondStrokeIsNotPartOfTheRate()
    {
        std::string stroke;
        for (int i = 0; i < 100; ++i) stroke += QStringLiteral("%1,0.3\n").arg(i * 0.01, 0, 'f', 2).toStdString();
        fabric_files::write(at("two.csv"), "t_s,mu\n" + stroke + stroke);
        const auto seen = readSignal(at("two.csv"));
        QCOMPARE(figure(std::get<SeenTrace>(seen.what).sampleRateHz.value()), std::string("100"));
        QVERIFY2(contains(seen.kind, "100 samples, 100 Hz"), seen.kind.c_str());
        QVERIFY2(warningsIn(seen).contains("100 rows are not shown"), qPrintable(warningsIn(seen)));
    }

    /// Such files come from loggers that write their memory as it is. The program must answer, not draw for ever.
    void recordsThatNoAxisCanShowAreRefused_data()
    {
        QTest::addColumn<QByteArray>("rows");
        QTest::addColumn<QString>("told");
        QTest::newRow("far stamps") << QByteArray("-1e308,0.5\n1e308,0.6\n") << "times or places";
        QTest::newRow("stamps that hardly differ") << QByteArray("0,0.5\n1e-320,0.6\n2e-320,0.5\n") << "times or places";
        QTest::newRow("huge values") << QByteArray("0,-1e308\n1,1e308\n") << "values up to 1.00e+100";
    }
    void recordsThatNoAxisCanShowAreRefused()
    {
        QFETCH(QByteArray, rows);
        QFETCH(QString, told);
        fabric_files::write(at("odd.csv"), "t_s,mu\n" + rows.toStdString());
        const auto refusal = refusalOf([&] { readSignal(at("odd.csv")); });
        QVERIFY2(contains(refusal, "odd.csv") && contains(refusal, told.toStdString()), refusal.c_str());
    }

    void curveWithPlacesOutsideNumbersIsDrawn()
    {
        QImage picture(64, 32, QImage::Format_RGB32);
        picture.fill(Qt::white);
        QPainter painter(&picture);
        const double infinite = std::numeric_limits<double>::infinity();
        for (const PlotAxis& x :
             {PlotAxis{0, 1, {}}, PlotAxis{-1e308, 1e308, {}}, PlotAxis{0, 5e-324, {}}, PlotAxis{0, infinite, {}}})
            drawCurve(painter, QRectF(2, 2, 60, 28), x, {0, 1, {}}, {-1e308, 0, nothing, 5e-324, 1e308},
                      {0.1, 0.2, 0.3, nothing, 1}, lightSheet());
        for (const auto& [low, high] :
             {std::pair(-infinite, infinite), std::pair(0.3, std::nextafter(0.3, 1)), std::pair(0.0, 5e-324)})
            QVERIFY(ticksBetween(low, high, 6).size() < 20);
    }

    void recordsOfOtherQuantitiesKeepTheirName_data()
    {
        QTest::addColumn<QByteArray>("text");
        QTest::addColumn<QString>("quantity");
        QTest::addColumn<QString>("unit");
        QTest::newRow("coefficient") << QByteArray("t_s,mu\n0,1\n1,2\n") << "coefficient of friction"
                                     << "s";
        QTest::newRow("coefficient under another name") << QByteArray("t_s,COF\n0,1\n1,2\n") << "coefficient of friction"
                                                        << "s";
        QTest::newRow("counts") << QByteArray("t_s,taxel_sum_counts\n0,1\n1,2\n") << "taxel_sum_counts"
                                << "s";
        QTest::newRow("of a stroke") << QByteArray("t_s,position_mm,normal_n,tangential_n\n0,0,1,1\n1,5,1,2\n")
                                     << "coefficient of friction"
                                     << "mm";
        QTest::newRow("without time") << QByteArray("counts\n1\n2\n") << "counts"
                                      << "samples";
    }
    void recordsOfOtherQuantitiesKeepTheirName()
    {
        QFETCH(QByteArray, text);
        QFETCH(QString, quantity);
        QFETCH(QString, unit);
        fabric_files::write(at("record.csv"), text.toStdString());
        const auto seen = readSignal(at("record.csv"));
        QCOMPARE(QString::fromStdString(std::get<SeenTrace>(seen.what).quantity), quantity);
        QCOMPARE(QString::fromStdString(std::get<SeenTrace>(seen.what).placeUnit), unit);
        QCOMPARE(std::get<SeenTrace>(seen.what).values, (std::vector<double>{1, 2}));
    }

    void anyColumnOfARecordCanBeShown()
    {
        fabric_files::write(at("channels.csv"), "timestamp, channel1, channel2\n10,1,5\n20,2,6\n");
        const auto first = readSignal(at("channels.csv")), second = readSignal(at("channels.csv"), {{}, {}, {}, "channel2", {}});
        QCOMPARE(std::get<SeenTrace>(first.what).values, (std::vector<double>{1, 2}));
        QCOMPARE(std::get<SeenTrace>(second.what).values, (std::vector<double>{5, 6}));
        const auto refusal = refusalOf([&] { readSignal(at("channels.csv"), {{}, {}, {}, "channel3", {}}); });
        QVERIFY2(contains(refusal, "has no column channel3") && contains(refusal, "channel1, channel2"), refusal.c_str());
    }

    void unreadableFilesAreRefusedByName_data()
    {
        QTest::addColumn<QString>("file");
        QTest::addColumn<QByteArray>("bytes");
        QTest::newRow("missing file") << "none.png" << QByteArray();
        QTest::newRow("truncated") << "cut.png" << QByteArray("\x89PNG\r\n\x1a\n");
        QTest::newRow("unknown kind") << "film.mov" << QByteArray("x");
        QTest::newRow("only time") << "time.csv" << QByteArray("t_s\n0\n1\n");
        QTest::newRow("no rows") << "empty.csv" << QByteArray("t_s,mu\n");
        QTest::newRow("no header") << "blank.csv" << QByteArray("");
    }
    void unreadableFilesAreRefusedByName()
    {
        QFETCH(QString, file);
        QFETCH(QByteArray, bytes);
        if (!bytes.isNull()) fabric_files::write(at(file.toStdString()), bytes.toStdString());
        const auto refusal = refusalOf([&] { readSignal(at(file.toStdString())); });
        QVERIFY2(contains(refusal, file.toStdString()), refusal.c_str());
    }

    void extremeSignalsMakeASheet_data()
    {
        QTest::addColumn<int>("rows");
        QTest::addColumn<int>("columns");
        QTest::addColumn<double>("value");
        QTest::addColumn<double>("wave");
        QTest::newRow("one pixel") << 1 << 1 << 0.5 << 0.0;
        QTest::newRow("one column") << 300 << 1 << 0.0 << 1.0;
        QTest::newRow("flat") << 40 << 50 << 0.25 << 0.0;
        QTest::newRow("only NaN") << 30 << 40 << nothing << 0.0;
        QTest::newRow("infinite") << 30 << 40 << std::numeric_limits<double>::infinity() << 0.0;
        QTest::newRow("a nanometre") << 30 << 40 << 0.0 << 1e-6;
        QTest::newRow("a kilometre") << 30 << 40 << 0.0 << 1e6;
        QTest::newRow("long and low") << 2 << 5000 << 0.0 << 1.0;
    }
    void extremeSignalsMakeASheet()
    {
        QFETCH(int, rows);
        QFETCH(int, columns);
        QFETCH(double, value);
        QFETCH(double, wave);
        cv::Mat map(rows, columns, CV_32FC1);
        for (int i = 0; i < rows; ++i)
            for (int j = 0; j < columns; ++j) map.at<float>(i, j) = static_cast<float>(value + wave * std::sin(0.3 * (i + j)));
        SeenTrace trace;
        for (int i = 0; i < rows * columns; ++i) {
            trace.places.push_back(0.1 * i);
            trace.values.push_back(map.at<float>(i / columns, i % columns));
        }
        trace.placeUnit = "mm";
        const std::vector<SeenSignal> signals{
            seenHeight(map, {}, "map", "made"), seenHeight(map, 0.05, "map", "made"), {"trace", "made", trace}};
        for (const SheetStyle& style : {lightSheet(), darkSheet()}) {
            const QImage sheet = drawSheet(signals, style);
            QVERIFY(sheet.width() > 3 * 460 && sheet.height() > 700);
            QVERIFY(coloursIn(sheet) > 5);
        }
        const QString description = describe(signals);
        QVERIFY2(!description.contains("inf"), qPrintable(description));
    }

    void sheetWrapsItsRows()
    {
        const std::vector<SeenSignal> signals(5, seenHeight(cv::Mat(3, 3, CV_32FC1, cv::Scalar(1)), {}, "map", "made"));
        const QImage one = drawSheet({signals.front()}, lightSheet()), five = drawSheet(signals, lightSheet(), 2);
        QVERIFY(five.width() > 1.9 * one.width() && five.width() < 2.1 * one.width());
        QVERIFY(five.height() > 2.8 * one.height());
    }

    void stepsAreRound_data()
    {
        QTest::addColumn<double>("most");
        QTest::addColumn<double>("step");
        QTest::newRow("between") << 7.3 << 5.0;
        QTest::newRow("exactly") << 20.0 << 20.0;
        QTest::newRow("just below") << 0.1999 << 0.1;
        QTest::newRow("small") << 3.1e-7 << 2e-7;
    }
    void stepsAreRound()
    {
        QFETCH(double, most);
        QFETCH(double, step);
        QVERIFY(std::abs(roundStep(most) / step - 1) < 1e-9);
    }

    void ticksLieWithinTheAxis()
    {
        QCOMPARE(ticksBetween(0, 1, 6).size(), std::size_t(6));  // 0, 0.2, …, 1
        for (const auto& [low, high] : {std::pair(-0.3, 0.31), std::pair(1e-9, 2e-9), std::pair(-1e6, 1e6), std::pair(5.0, 5.0)})
            for (const double tick : ticksBetween(low, high, 5))
                QVERIFY(tick >= low - 1e-6 * (high - low) && tick <= high + 1e-6 * (high - low));
        QCOMPARE(tickText(0.30000000000000004, 0.1), QString("0.3"));
        QCOMPARE(tickText(-1e-17, 0.1), QString("0"));
        QCOMPARE(tickText(1500, 500), QString("1500"));
    }

    void figuresHaveThreeDigits_data()
    {
        QTest::addColumn<double>("value");
        QTest::addColumn<QString>("text");
        QTest::newRow("zero") << 0.0 << "0";
        QTest::newRow("whole") << 255.0 << "255";
        QTest::newRow("small") << 0.05512 << "0.0551";
        QTest::newRow("rounded up") << 0.99999 << "1.00";
        QTest::newRow("tiny") << 1.234e-7 << "1.23e-07";
        QTest::newRow("huge") << -1.28e9 << "-1.28e+09";
    }
    void figuresHaveThreeDigits()
    {
        QFETCH(double, value);
        QFETCH(QString, text);
        QCOMPARE(QString::fromStdString(figure(value)), text);
    }

    void reliefIsBrightTowardsTheLight()
    {
        // One long ridge across the picture. Its left side faces the light.
        cv::Mat ridge(60, 60, CV_32FC1);
        for (int i = 0; i < 60; ++i)
            for (int j = 0; j < 60; ++j) ridge.at<float>(i, j) = static_cast<float>(-std::abs(j - 30));
        const ReliefPicture relief = reliefOf(ridge, {300, 200}, QColor(200, 200, 200));
        QVERIFY(qGray(relief.picture.pixel(75, 150)) > qGray(relief.picture.pixel(225, 150)) + 20);
        QVERIFY(relief.pixelsPerUnit > 0);
        QCOMPARE(relief.pixelsPerValue, 5.0);
        QCOMPARE(reliefOf(cv::Mat(9, 9, CV_32FC1, cv::Scalar(4)), {300, 200}, QColor(200, 200, 200)).pixelsPerUnit, 0.0);
    }

    void pictureDistinguishesLowHighAndMissingValues()
    {
        const cv::Mat values = (cv::Mat_<float>(1, 3) << 0, 1, static_cast<float>(nothing));
        const QImage grey = pictureOf(values, 0, 1, Palette::Grey, Qt::red);
        QCOMPARE(QColor(grey.pixel(0, 0)), QColor(Qt::black));
        QCOMPARE(QColor(grey.pixel(1, 0)), QColor(Qt::white));
        QCOMPARE(QColor(grey.pixel(2, 0)), QColor(Qt::red));
        double before = -1;
        for (int step = 0; step <= 20; ++step) {
            const double lightness = qGray(colourOf(step / 20.0).rgb());
            QVERIFY(lightness > before);
            before = lightness;
        }
    }

    void overviewAndSheetsCoverADataSet()
    {
        fabric_files::smallDataset(at("walk"));
        const auto seen = overviewOf(at("walk"));
        QCOMPARE(seen.fabrics.size(), std::size_t(2));
        QCOMPARE(seen.fabrics[0], (FabricCounts{"F01", "Linen", "plain weave", 2, 1, 1, 2}));
        QCOMPARE(seen.fabrics[1].most(), 1);
        QVERIFY(contains(seen.about, "0.04 mm per pixel") && contains(seen.about, "5 mm/s") && contains(seen.about, "CC0-1.0"));
        const auto first = sheetOf(at("walk"), "F01", 0), second = sheetOf(at("walk"), "F01", 1);
        QCOMPARE(first.signals.size(), std::size_t(4));
        QCOMPARE(second.signals.size(), std::size_t(2));  // this fabric has one press
        QVERIFY(first.faults.empty() && sheetOf(at("walk"), "F02", 7).signals.empty());
        QVERIFY(contains(refusalOf([&] { sheetOf(at("walk"), "F09", 0); }), "F09"));
    }

    void heightIsComputedIfNoneIsKnown()
    {
        rendering::fabrics::ProceduralOptions options;
        options.fabrics = options.samples = 1;
        rendering::fabrics::makeProceduralFabrics(at("made"), options);
        const auto known = factsOf(sheetOf(at("made"), "F01", 0).signals.at(2));
        std::filesystem::remove(at("made/F01/height/000.tiff"));
        const auto sheet = sheetOf(at("made"), "F01", 0);
        QVERIFY2(sheet.faults.empty(), sheet.faults.empty() ? "" : sheet.faults.front().c_str());
        QCOMPARE(sheet.signals.size(), std::size_t(4));
        QVERIFY(contains(sheet.signals[2].kind, "from the frame"));
        const auto computed = factsOf(sheet.signals[2]);
        QVERIFY(std::abs(computed.sq.value() / known.sq.value() - 1) < 0.3);
        std::filesystem::remove(at("made/tactile-calibration.json"));
        const auto without = sheetOf(at("made"), "F01", 0);
        QCOMPARE(without.signals.size(), std::size_t(3));
        QVERIFY(contains(without.faults.front(), "tactile-calibration.json"));
    }

    void stimuliOfAnOpenStudyAreRefusedUntilItIsUnblinded()
    {
        const auto study = tests::support::buildStudy(at("study"));
        const auto stimulus = std::filesystem::directory_iterator(study.stimuli())->path();
        std::filesystem::create_symlink(stimulus, at("innocent.pgm"));
        std::filesystem::create_directory_symlink(study.folder, at("elsewhere"));
        for (const auto& file : {stimulus, at("innocent.pgm"), at("elsewhere") / "stimuli" / stimulus.filename(),
                                 at("study/stimuli/../stimuli") / stimulus.filename()}) {
            const auto refusal = refusalOf([&] { readSignal(file); });
            QVERIFY2(contains(refusal, "not unblinded"), refusal.c_str());
        }
        QVERIFY(contains(refusalOf([&] { overviewOf(study.folder / "stimuli"); }), "not unblinded"));
        {
            database::StudyStore store(study, database::StudyStore::Access::Write);
            store.recordUnblinding({"A. Tester", "the study is over", "2026-11-21T12:00:00.000Z"});
        }
        // Then its file is still sealed: an encrypted file is no picture.
        QVERIFY(contains(refusalOf([&] { readSignal(stimulus); }), "file ending"));
    }

    void unreadableStudyCountsAsBlinded()
    {
        fabric_files::write(at("broken/study.db"), "no database");
        rendering::writePgm(at("broken/image.pgm"), cv::Mat(3, 3, CV_8UC1, cv::Scalar(5)));
        QVERIFY(contains(refusalOf([&] { readSignal(at("broken/image.pgm")); }), "not unblinded"));
    }
};

QTEST_MAIN(LookingTest)
#include "looking_test.moc"
