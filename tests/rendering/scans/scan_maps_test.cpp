// What file names say about a scan, the widths of tiles, normal maps with either green sign, and patches with their guards.
#include <opencv2/imgproc.hpp>

#include "rendering/scans/normal_map.h"
#include "rendering/scans/relighting.h"
#include "rendering/scans/scan.h"
#include "rendering/scans/stated_resolution.h"
#include "rendering/scans/tile_widths.h"
#include "tests/rendering/scans/scan_folders.h"

using namespace fabric_files;
using namespace rendering;
using namespace rendering::scans;
using namespace scan_folders;

namespace {

constexpr double tileMm = 40;

/// A scan as a library publishes it, without its green sign in the name.
ScanFiles scanOf(const fs::path& folder, const cv::Mat& colour, const cv::Mat& normals, const cv::Mat& displacement = {})
{
    ScanFiles files{"weave", folder, {{folder / "weave_diff.png"}}, {}, {}};
    writePicture(folder / "weave_diff.png", colour);
    if (!normals.empty()) {
        writePicture(folder / "weave_nor.png", normals);
        files.normals.push_back({folder / "weave_nor.png"});
    }
    if (!displacement.empty()) {
        writePicture(folder / "weave_disp.png", displacement);
        files.displacement.push_back({folder / "weave_disp.png"});
    }
    return files;
}

std::string allOf(const std::vector<std::string>& lines)
{
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    return text;
}

/// A JPEG header with an EXIF resolution and orientation, up to its frame of `width` x 500.
std::string exifJpeg(int perInch, int unit, int width, int orientation = 1)
{
    const auto two = [](int value) { return std::string{char(value >> 8), char(value & 255)}; };
    std::string tiff("MM\0*\0\0\0\x08\0\x03", 10);
    tiff += std::string("\x01\x12\0\x03\0\0\0\x01", 8) + two(orientation) + two(0);
    tiff +=
        std::string("\x01\x1a\0\x05\0\0\0\x01\0\0\0\x32", 12) + std::string("\x01\x28\0\x03\0\0\0\x01", 8) + two(unit) + two(0);
    tiff += std::string(4, '\0') + std::string(2, '\0') + two(perInch) + std::string("\0\0\0\x01", 4);
    const std::string body = std::string("Exif\0\0", 6) + tiff;
    const std::string frame = std::string("\x08", 1) + two(500) + two(width) + std::string("\x03", 1);
    return "\xff\xd8\xff\xe1" + two(int(body.size()) + 2) + body + "\xff\xc0" + two(int(frame.size()) + 2) + frame;
}

/// A PNG of 4096 x 500 with 508 pixels per inch across and 254 down, up to its data.
std::string exifPng(int orientation)
{
    const auto chunk = [](const std::string& kind, const std::string& content) {
        return std::string("\0\0\0", 3) + char(content.size()) + kind + content + std::string(4, '\0');
    };
    const auto four = [](int value) { return std::string{0, 0, char(value >> 8), char(value & 255)}; };
    std::string tiff("MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0", 19);
    tiff += char(orientation) + std::string(6, '\0');
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", four(4096) + four(500) + std::string("\x08\x02\0\0\0", 5)) +
           chunk("pHYs", four(20000) + four(10000) + "\x01") + chunk("eXIf", tiff);
}

}  // namespace

class ScanMapsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void init() { m_temporary = std::make_unique<QTemporaryDir>(), m_folder = pathOf(*m_temporary); }

    void fileNamesSayWhatTheyHold_data()
    {
        QTest::addColumn<QString>("stem");
        QTest::addColumn<QString>("fabric");
        QTest::addColumn<int>("role");  // -1: none
        QTest::addColumn<int>("green");
        const int colour = int(MapRole::Colour), normals = int(MapRole::Normals), displacement = int(MapRole::Displacement);
        const int unstated = int(GreenUp::Unstated), up = int(GreenUp::Yes), down = int(GreenUp::No);
        const auto row = [](const char* stem, const char* fabric, int role, int green) {
            QTest::newRow(stem) << stem << fabric << role << green;
        };
        row("hessian_230_diff_1k", "hessian_230", colour, unstated);
        row("hessian_230_nor_gl_1k", "hessian_230", normals, up);
        row("hessian_230_nor_dx_4k", "hessian_230", normals, down);
        row("hessian_230_disp_16k", "hessian_230", displacement, unstated);
        row("Fabric023_2K-JPG_Color", "Fabric023", colour, unstated);
        row("Fabric023_2K-JPG_NormalGL", "Fabric023", normals, up);
        row("Fabric023_2K-PNG_NormalDX", "Fabric023", normals, down);
        row("Fabric023_2K-JPG_Displacement", "Fabric023", displacement, unstated);
        row("blue_denim_albedo", "blue_denim", colour, unstated);
        row("Linen Fine_BaseColor", "Linen Fine", colour, unstated);
        row("linen_base_color", "linen", colour, unstated);
        row("linen-normal-ogl", "linen", normals, up);
        row("linen_Normal_DirectX", "linen", normals, down);
        row("linen_height", "linen", displacement, unstated);
        row("normal_cotton_diff_1k", "normal_cotton", colour, unstated);
        row("color", "", colour, unstated);
        row("normal", "", normals, unstated);
        row("hessian_230_rough_1k", "", -1, unstated);
        row("Fabric023_2K-JPG_AmbientOcclusion", "", -1, unstated);
        row("hessian_230_arm_1k", "", -1, unstated);
        row("Fabric023", "", -1, unstated);
        row("_", "", -1, unstated);
    }

    void fileNamesSayWhatTheyHold()
    {
        QFETCH(QString, stem);
        QFETCH(QString, fabric);
        QFETCH(int, role);
        QFETCH(int, green);
        const auto map = mapNamed(stem.toStdString());
        QCOMPARE(map ? int(map->role) : -1, role);
        if (!map) return;
        QCOMPARE(map->fabric, fabric.toStdString());
        QCOMPARE(int(map->green), green);
    }

    void theHeightComesBackWithEitherGreenSign_data()
    {
        QTest::addColumn<int>("depth");
        QTest::addColumn<bool>("greenUp");
        QTest::addColumn<int>("columns");
        QTest::addColumn<int>("rows");
        QTest::newRow("8 bits, up") << CV_8U << true << 200 << 200;
        QTest::newRow("8 bits, down") << CV_8U << false << 200 << 200;
        QTest::newRow("16 bits, up, not square") << CV_16U << true << 240 << 155;
        QTest::newRow("16 bits, down, not square") << CV_16U << false << 155 << 240;
    }

    void theHeightComesBackWithEitherGreenSign()
    {
        QFETCH(int, depth);
        QFETCH(bool, greenUp);
        QFETCH(int, columns);
        QFETCH(int, rows);
        const auto known = obliqueWaves({columns, rows}, tileMm);
        const ScanFiles files = scanOf(m_folder, plainColour({columns, rows}), normalMapOf(known.slopes, depth, greenUp));
        const Scan scan = readScan(files, tileMm, decodeByQt);
        QVERIFY(scan.surfaceInMm && scan.bordersMeet);
        QCOMPARE(scan.mmPerPixel, tileMm / columns);
        QVERIFY2(contains(allOf(scan.remarks), greenUp ? "green points up" : "green points down"), allOf(scan.remarks).c_str());
        const double error = cv::norm(scan.surface, known.heightMm, cv::NORM_L2) / cv::norm(known.heightMm, cv::NORM_L2);
        QVERIFY2(error < (depth == CV_8U ? 0.02 : 2e-4), qPrintable(QString::number(error)));
    }

    void aMapOfTwoChannelsGetsItsBlueFromThem()
    {
        const auto known = obliqueWaves({128, 128}, tileMm);
        const cv::Mat whole = normalMapOf(known.slopes, CV_8U, true);
        for (const double blue : {0, 255}) {
            cv::Mat normals = whole.clone();
            const cv::Mat level(normals.size(), CV_8UC1, cv::Scalar(blue));
            cv::insertChannel(level, normals, 2);
            const signals::Slopes slopes = slopesOfNormals(normals, "two channels");
            QVERIFY(cv::norm(slopes.x, known.slopes.x, cv::NORM_INF) < 0.02 &&
                    cv::norm(slopes.y, known.slopes.y, cv::NORM_INF) < 0.02);
        }
    }

    void theNameDecidesWhereTheSlopesCannot()
    {
        // Waves along x and y alone look the same with either sign of green.
        cv::Mat p(120, 120, CV_32FC1), q(120, 120, CV_32FC1);
        for (int y = 0; y < 120; ++y)
            for (int x = 0; x < 120; ++x) {
                p.at<float>(y, x) = 0.3f * std::sin(float(x) * 0.3141593f);
                q.at<float>(y, x) = 0.3f * std::sin(float(y) * 0.3141593f);
            }
        const GreenSign named = greenSignOf({p, q}, {}, GreenUp::No);
        QVERIFY(!named.isUp && contains(named.remark, "the file name does"));
        const GreenSign open = greenSignOf({p, q}, {}, GreenUp::Unstated);
        QVERIFY(open.isUp && contains(open.remark, "check a picture"));
    }

    void aContradictedNameIsReported()
    {
        const auto known = obliqueWaves({128, 128}, tileMm);
        ScanFiles files = scanOf(m_folder, plainColour({128, 128}), normalMapOf(known.slopes, CV_8U, false),
                                 displacementOf(known.heightMm, CV_8U));
        files.normals.front().green = GreenUp::Yes;
        const Scan scan = readScan(files, tileMm, decodeByQt);
        QVERIFY2(contains(allOf(scan.remarks), "although the name says otherwise"), allOf(scan.remarks).c_str());
        QVERIFY(correlation(scan.surface, known.heightMm) > 0.999);
    }

    void displacementChecksTheNormals_data()
    {
        QTest::addColumn<int>("depth");
        QTest::newRow("8 bits") << CV_8U;
        QTest::newRow("16 bits") << CV_16U;
    }

    void displacementChecksTheNormals()
    {
        QFETCH(int, depth);
        const auto known = obliqueWaves({256, 192}, tileMm);
        cv::Mat half;
        cv::resize(known.heightMm, half, {128, 96}, 0, 0, cv::INTER_AREA);
        const ScanFiles files =
            scanOf(m_folder, plainColour({256, 192}), normalMapOf(known.slopes, CV_16U, true), displacementOf(half, depth));
        const Scan scan = readScan(files, tileMm, decodeByQt);
        QCOMPARE(scan.surface.size(), cv::Size(256, 192));
        QVERIFY2(contains(allOf(scan.remarks), "correlates with the integrated normals at 0.99") ||
                     contains(allOf(scan.remarks), "correlates with the integrated normals at 1.00"),
                 allOf(scan.remarks).c_str());
    }

    /// What rounding leaves of a level picture is no relief. Its share of the correlation could be beyond 1.
    void aLevelHeightCorrelatesWithNothing()
    {
        cv::Mat relief(41, 33, CV_32FC1);
        cv::randu(relief, 0, 1);
        QVERIFY(heightCorrelation(relief, relief) > 0.999999 && heightCorrelation(relief, relief) <= 1);
        QVERIFY(heightCorrelation(relief, 1 - relief) < -0.999);
        for (const int level : {1, 85, 137, 241})
            QCOMPARE(heightCorrelation(relief, cv::Mat(33, 33, CV_32FC1, cv::Scalar(level / 255.0F))), 0.0);
    }

    void displacementAloneHasNoAmplitude()
    {
        const auto known = obliqueWaves({160, 128}, tileMm);
        const Scan scan =
            readScan(scanOf(m_folder, plainColour({160, 128}), {}, displacementOf(known.heightMm, CV_16U)), tileMm, decodeByQt);
        QVERIFY(!scan.surfaceInMm);
        QVERIFY2(contains(allOf(scan.remarks), "amplitude of the height is unknown"), allOf(scan.remarks).c_str());
        QVERIFY(correlation(scan.surface, known.heightMm) > 0.9999);
        QVERIFY(correlation(scan.slopes.x, known.slopes.x) > 0.999 && correlation(scan.slopes.y, known.slopes.y) > 0.999);
        const double power = scan.slopes.x.dot(scan.slopes.x) + scan.slopes.y.dot(scan.slopes.y);
        QVERIFY(std::abs(std::sqrt(power / double(scan.surface.total())) - assumedRmsSlope) < 1e-4);
    }

    void colourOfAnotherSizeFollowsTheSurface_data()
    {
        QTest::addColumn<int>("colourColumns");
        QTest::addColumn<int>("columns");
        QTest::newRow("finer colour") << 320 << 160;
        QTest::newRow("coarser colour") << 128 << 128;
    }

    void colourOfAnotherSizeFollowsTheSurface()
    {
        QFETCH(int, colourColumns);
        QFETCH(int, columns);
        const auto known = obliqueWaves({160, 120}, tileMm);
        const Scan scan = readScan(
            scanOf(m_folder, plainColour({colourColumns, colourColumns * 3 / 4}), normalMapOf(known.slopes, CV_16U, true)),
            tileMm, decodeByQt);
        QCOMPARE(scan.colour.size(), cv::Size(columns, columns * 3 / 4));
        QCOMPARE(scan.surface.size(), scan.colour.size());
        QCOMPARE(scan.slopes.y.size(), scan.colour.size());
        QCOMPARE(scan.mmPerPixel, tileMm / columns);
    }

    void aTileWhoseBordersDoNotMeetIsNamed()
    {
        const auto known = obliqueWaves({300, 300}, tileMm);
        const cv::Rect part(10, 15, 190, 170);
        const signals::Slopes slopes{known.slopes.x(part).clone(), known.slopes.y(part).clone()};
        const Scan scan = readScan(scanOf(m_folder, plainColour(part.size()), normalMapOf(slopes, CV_16U, true)),
                                   tileMm * 190 / 300, decodeByQt);
        QVERIFY(!scan.bordersMeet);
        QVERIFY(contains(allOf(scan.remarks), "borders do not meet"));
        const cv::Mat level = signals::withoutTilt(known.heightMm(part).clone(), {});
        QVERIFY(correlation(scan.surface, level) > 0.999);
        // 8 bits store level cloth 0.004 too steep. The tilt that this makes is no relief.
        const signals::Slopes tilted{slopes.x + 0.05, slopes.y.clone()};
        const Scan again = readScan(scanOf(m_folder, plainColour(part.size()), normalMapOf(tilted, CV_16U, true)),
                                    tileMm * 190 / 300, decodeByQt);
        QVERIFY(correlation(again.surface, level) > 0.999);
    }

    void picturesThatAreNoScanAreRefused_data()
    {
        QTest::addColumn<QString>("fault");
        QTest::addColumn<QString>("words");
        QTest::newRow("photograph as normals") << "photograph"
                                               << "no tangent normal map";
        QTest::newRow("grey normals") << "grey"
                                      << "1 channels";
        QTest::newRow("other shape") << "shape"
                                     << "another shape than the colour";
        QTest::newRow("flat displacement") << "flat"
                                           << "same height everywhere";
        QTest::newRow("no image") << "text"
                                  << "weave_nor.png";
        QTest::newRow("colour of 12 bits") << "deep"
                                           << "4095 of 65535";
        QTest::newRow("tiny") << "tiny"
                              << "at least 64 px";
        QTest::newRow("strip") << "strip"
                               << "a longer side of at most 64 times the shorter one";
        for (const char* value : {"nan", "inf"}) QTest::newRow(value) << value << "heights that are not finite";
    }

    void picturesThatAreNoScanAreRefused()
    {
        QFETCH(QString, fault);
        QFETCH(QString, words);
        const auto known = obliqueWaves({128, 128}, tileMm);
        const cv::Mat normals = normalMapOf(known.slopes, CV_8U, true), colour = plainColour({128, 128});
        ScanFiles files = scanOf(m_folder, colour, normals);
        if (fault == "photograph") writePicture(m_folder / "weave_nor.png", colour);
        if (fault == "grey") writePicture(m_folder / "weave_nor.png", cv::Mat(128, 128, CV_8UC1, cv::Scalar(128)));
        if (fault == "shape") writePicture(m_folder / "weave_diff.png", plainColour({128, 96}));
        if (fault == "text") write(m_folder / "weave_nor.png", "this is no picture");
        if (fault == "deep") writePicture(m_folder / "weave_diff.png", cv::Mat(128, 128, CV_16UC3, cv::Scalar::all(4095)));
        if (fault == "tiny") writePicture(m_folder / "weave_nor.png", normals(cv::Rect(0, 0, 40, 40)).clone());
        if (fault == "flat") files = scanOf(m_folder, colour, {}, cv::Mat(128, 128, CV_8UC1, cv::Scalar(9)));
        if (fault == "strip") writePicture(m_folder / "weave_nor.png", cv::Mat(64, 600'000, CV_8UC1, cv::Scalar(128)));
        if (fault == "nan" || fault == "inf") {
            files.displacement.push_back({m_folder / "weave_disp.tiff"});
            cv::Mat heights = known.heightMm.clone();
            heights.at<float>(70, 30) = fault.toFloat();
            writeTiff(m_folder / "weave_disp.tiff", heights);
        }
        const std::string refusal = refusalOf([&] { readScan(files, tileMm, decodeByQt); });
        QVERIFY2(contains(refusal, words.toStdString()) && contains(refusal, m_folder.string()), refusal.c_str());
    }

    void levelClothKeepsItsColourUnderTheLamp()
    {
        Scan scan;
        scan.colour = plainColour({64, 64}, {200, 120, 30});
        scan.slopes = {cv::Mat::zeros(64, 64, CV_32FC1), cv::Mat::zeros(64, 64, CV_32FC1)};
        QVERIFY(cv::norm(relit(scan, oneLampDeg), scan.colour, cv::NORM_INF) <= 1);
    }

    void aHillIsBrightTowardsTheLamp()
    {
        Scan scan;
        scan.colour = plainColour({64, 64});
        cv::Mat height(64, 64, CV_32FC1);
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x)
                height.at<float>(y, x) = 4 * std::exp(-float((x - 32) * (x - 32) + (y - 32) * (y - 32)) / 200);
        cv::Sobel(height, scan.slopes.x, CV_32F, 1, 0, 3, 1 / 8.0);
        cv::Sobel(height, scan.slopes.y, CV_32F, 0, 1, 3, 1 / 8.0);
        const auto level = [&](double side, int x, int y) { return int(relit(scan, side).at<cv::Vec3b>(y, x)[0]); };
        QVERIFY(level(135, 25, 25) > level(135, 39, 39));  // upper left is bright, lower right is dark
        QVERIFY(level(315, 25, 25) < level(315, 39, 39));
        QVERIFY(level(45, 39, 25) > level(45, 25, 39));
        const int brightest = level(135, 25, 25), around = level(135, 3, 3);
        QVERIFY(brightest > around && around > level(135, 39, 39));
    }

    void bandsKeepTheirGuardsAcrossTheWrap_data()
    {
        QTest::addColumn<int>("columns");
        QTest::addColumn<int>("rows");
        QTest::addColumn<int>("bands");
        QTest::addColumn<int>("across");
        QTest::newRow("velour") << 1024 << 985 << 3 << 4;
        QTest::newRow("2k") << 2048 << 2043 << 6 << 8;
        QTest::newRow("4k") << 4096 << 4096 << 13 << 16;
    }

    void bandsKeepTheirGuardsAcrossTheWrap()
    {
        QFETCH(int, columns);
        QFETCH(int, rows);
        QFETCH(int, bands);
        QFETCH(int, across);
        const auto patches = patchesOf({columns, rows}, usualPatchPx);
        QCOMPARE(int(patches.size()), bands * across);
        for (const Patch& a : patches) {
            QVERIFY((a.place & cv::Rect(0, 0, columns, rows)) == a.place);
            for (const Patch& b : patches) {
                if (a.band == b.band) continue;
                const int down = ((b.place.y - a.place.y) % rows + rows) % rows;  // going down, across the border
                QVERIFY(down >= usualPatchPx + guardPx && rows - down >= usualPatchPx + guardPx);
            }
        }
        QCOMPARE(patchSideFor({columns, rows}), usualPatchPx);
        QCOMPARE(patchSideFor({512, 600}), 152);
    }

    void theResolutionInAHeaderIsRead()
    {
        const auto inch = statedResolution(exifJpeg(508, 2, 4096));
        QVERIFY(inch && inch->hasUnit && inch->widthPx == 4096 && std::abs(inch->perInch - 508) < 1e-9);
        const auto cm = statedResolution(exifJpeg(200, 3, 4096));
        QVERIFY(cm && cm->hasUnit && std::abs(cm->perInch - 508) < 1e-9);
        const auto none = statedResolution(exifJpeg(773, 1, 1024));
        QVERIFY(none && !none->hasUnit);
        const auto turned = statedResolution(exifJpeg(508, 2, 4096, 6));  // shown with rows and columns exchanged
        QVERIFY(turned && turned->widthPx == 500);
        const auto upsideDown = statedResolution(exifJpeg(508, 2, 4096, 3));
        QVERIFY(upsideDown && upsideDown->widthPx == 4096);
        const auto png = statedResolution(exifPng(1)), turnedPng = statedResolution(exifPng(8));
        QVERIFY(png && png->widthPx == 4096 && std::abs(png->perInch - 508) < 1e-9);
        QVERIFY(turnedPng && turnedPng->widthPx == 500 && std::abs(turnedPng->perInch - 254) < 1e-9);
        QVERIFY(!statedResolution("no picture"));
        const std::string whole = exifJpeg(508, 2, 4096);
        for (std::size_t length = 0; length < whole.size(); ++length) statedResolution(whole.substr(0, length));
    }

    void widthsComeFromTheNearestSource()
    {
        const std::vector<ScanFiles> fabrics{
            {"a", m_folder / "a", {}, {}, {}}, {"b", m_folder / "b", {}, {}, {}}, {"c", m_folder, {}, {}, {}}};
        write(m_folder / "a/scan.json", "{\"tile_mm\": 111.5}");
        write(m_folder / "tiles.csv", "name,width_mm\nb,222\na,5\n");
        const auto widths = tileWidths(fabrics, m_folder, {333, {}});
        QCOMPARE(widths[0].mm, 111.5);
        QCOMPARE(widths[1].mm, 222.0);
        QCOMPARE(widths[2].mm, 333.0);
        QCOMPARE(tileWidths(fabrics, m_folder, {333, {{"a", 444}}})[0].source, std::string("--tile"));
        const auto refused = [&](const TileOptions& options) {
            return refusalOf([&] { tileWidths(fabrics, m_folder, options); });
        };
        QVERIFY2(contains(refused({}), "\"c\"") && contains(refused({}), "--tile c=WIDTH"), refused({}).c_str());
        QVERIFY(contains(refused({333, {{"d", 4}}}), "one of a, b, c"));
        QVERIFY(contains(refused({-3, {}}), "1 to 100,000 mm"));
        write(m_folder / "tiles.csv", "name,width\nb,222\n");
        QVERIFY(contains(refused({333, {}}), "name,width_mm"));
        write(m_folder / "tiles.csv", "name,width_mm\nb,wide\n");
        QVERIFY(contains(refused({333, {}}), "row 1"));
        fs::remove(m_folder / "tiles.csv");
        write(m_folder / "a/scan.json", "{\"tile\": 3}");
        QVERIFY(contains(refused({333, {}}), "scan.json"));
    }

    void aBelievableResolutionIsUsed()
    {
        std::vector<ScanFiles> fabrics{{"a", m_folder, {{m_folder / "a_diff.jpg"}}, {}, {}}};
        write(m_folder / "a_diff.jpg", exifJpeg(508, 2, 4096));
        QCOMPARE(tileWidths(fabrics, m_folder, {})[0].mm, 25.4 * 4096 / 508);
        write(m_folder / "a_diff.jpg", exifJpeg(773, 1, 1024));
        const std::string noUnit = refusalOf([&] { tileWidths(fabrics, m_folder, {}); });
        QVERIFY2(contains(noUnit, "773 pixels per inch without a unit, which gives 33.6 mm"), noUnit.c_str());
        write(m_folder / "a_diff.jpg", exifJpeg(72, 2, 1024));
        QVERIFY(contains(refusalOf([&] { tileWidths(fabrics, m_folder, {}); }), "is unknown"));
    }

private:
    std::unique_ptr<QTemporaryDir> m_temporary;
    fs::path m_folder;
};

QTEST_GUILESS_MAIN(ScanMapsTest)
#include "scan_maps_test.moc"
