// The import of scanned materials: folders as libraries publish them become a data set that its check accepts, and whose splits
// keep bands whole. The shared real scans are imported where they exist.
#include <set>

#include "rendering/fabrics/dataset_check.h"
#include "rendering/fabrics/location_split.h"
#include "rendering/scans/import_scans.h"
#include "tests/rendering/scans/scan_folders.h"

using namespace fabric_files;
using namespace rendering;
using namespace rendering::fabrics;
using namespace rendering::scans;
using namespace scan_folders;

namespace {

constexpr double tileMm = 60;
constexpr int patchPx = 64;
const cv::Size tileSize(384, 384);

bool anyLine(const std::vector<std::string>& lines, const std::string& fabric, const std::string& words)
{
    return std::any_of(lines.begin(), lines.end(),
                       [&](const std::string& line) { return contains(line, fabric) && contains(line, words); });
}

}  // namespace

class ScanImportTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void init()
    {
        m_temporary = std::make_unique<QTemporaryDir>();
        m_in = pathOf(*m_temporary) / "scans";
        m_out = pathOf(*m_temporary) / "set";
        m_patchPx = patchPx;
        m_known = unevenCloth(tileSize, tileMm, 7);
    }

    void librariesOfSeveralKindsBecomeOneDataSet()
    {
        writePolyHaven("weave");
        writeAmbient("Fabric023");
        const cv::Mat grey(tileSize, CV_8UC1, cv::Scalar(140));
        writePicture(m_in / "plain/textures/albedo.png", grey);
        writePicture(m_in / "plain/textures/height.png", displacementOf(m_known.heightMm, CV_16U));
        const auto lines = imported({tileMm, {}});
        const Dataset dataset = readDataset(m_out);
        QCOMPARE(dataset.fabrics.size(), std::size_t(3));
        QCOMPARE(dataset.fabrics[0].name, std::string("Fabric023"));
        QCOMPARE(dataset.fabrics[1].name, std::string("plain"));
        QCOMPARE(dataset.fabrics[2].name, std::string("weave"));
        QVERIFY(dataset.surfaceIsFree && dataset.fabrics[0].surfaceInMm && !dataset.fabrics[1].surfaceInMm);
        QVERIFY2(anyLine(lines, "weave", "green points up"), lines.front().c_str());
        QVERIFY(anyLine(lines, "Fabric023", "correlates with the integrated normals"));
        const auto faults = faultsOfDataset(m_out);
        QVERIFY2(faults.empty(), faults.empty() ? "" : faults.front().c_str());
    }

    void eachPlaceHasThreePhotographsOfOneSurface()
    {
        writePolyHaven("weave");
        imported({tileMm, {}});
        const Dataset dataset = readDataset(m_out);
        const FabricId weave("F01");
        const auto places = readSamplePlaces(dataset);
        const auto patches = patchesOf(tileSize, patchPx);
        QCOMPARE(places.size(), 3 * patches.size());
        std::map<double, int> lamps;
        for (std::size_t i = 0; i < places.size(); ++i) {
            const SamplePlace& place = places[i];
            const char* const lights[] = {oneLampName, fourLampsName, colourName};
            QCOMPARE(place.light, std::string(lights[i % 3]));
            QCOMPARE(place.lightDeg.has_value(), i % 3 != 2);
            if (i % 3 == 0) QCOMPARE(*place.lightDeg, 135.0);
            if (i % 3 == 1) ++lamps[*place.lightDeg];
            QCOMPARE(place.mmPerPixel, std::optional(tileMm / tileSize.width));
            const cv::Rect at = patches[i / 3].place;
            QCOMPARE(*place.xMm, (at.x + patchPx / 2.0) * tileMm / tileSize.width);
            const cv::Mat surface = readSurface(dataset, weave, int(i)).value();
            const double match = correlation(surface, m_known.heightMm(at));
            QVERIFY2(match > 0.95, qPrintable(QString::number(match)));  // JPEG halves the resolution of colours.
        }
        QCOMPARE(lamps.size(), std::size_t(4));
        const cv::Mat colour = readPhotograph(dataset, weave, 2);
        QVERIFY(cv::norm(colour, plainColour(colour.size()), cv::NORM_INF) <= 3);
        cv::Scalar mean, lit, flat;
        cv::meanStdDev(readPhotograph(dataset, weave, 0), mean, lit);
        cv::meanStdDev(colour, mean, flat);
        QVERIFY2(lit[0] > 5 * std::max(1.0, flat[0]), qPrintable(QString::number(lit[0])));
    }

    void noSplitByPlaceSharesABand()
    {
        writePolyHaven("weave");
        imported({tileMm, {}});
        const Dataset dataset = readDataset(m_out);
        std::map<std::string, std::set<Part>> parts;
        std::set<Part> all;
        for (const auto& [place, part] : splitByLocation(dataset, 5)) {
            parts[place.group].insert(part);
            all.insert(part);
        }
        QCOMPARE(parts.size(), std::size_t(tileSize.height / (patchPx + guardPx)));
        for (const auto& [group, of] : parts) QCOMPARE(of.size(), std::size_t(1));
        QCOMPARE(all.size(), std::size_t(3));
    }

    void aClonedPlaceKeepsTheFabricWhole()
    {
        // Sixteen copies of one small tile.
        const auto known = obliqueWaves({96, 96}, 15);
        cv::Mat x, y;
        cv::repeat(known.slopes.x, 4, 4, x);
        cv::repeat(known.slopes.y, 4, 4, y);
        writePicture(m_in / "tiled_diff.png", plainColour(tileSize));
        writePicture(m_in / "tiled_nor_gl.png", normalMapOf({x, y}, CV_8U, true));
        const auto lines = imported({tileMm, {}});
        QVERIFY2(anyLine(lines, "tiled", "no split divides this fabric"), lines.back().c_str());
        std::set<std::string> groups;
        for (const auto& place : readSamplePlaces(readDataset(m_out))) groups.insert(place.group);
        QCOMPARE(groups.size(), std::size_t(1));
        for (const auto& [place, part] : splitByLocation(readDataset(m_out), 5)) QVERIFY(part == Part::Training);
    }

    void aSecondFolderIsAddedAndARepeatedFabricRefused()
    {
        writePolyHaven("weave");
        imported({tileMm, {}});
        const auto before = contentOf(m_out);
        const std::string again = refusalOf([&] { imported({tileMm, {}}); });
        QVERIFY2(contains(again, "\"weave\" is in the data set already, as F01"), again.c_str());
        QVERIFY(contentOf(m_out) == before);
        fs::remove_all(m_in);
        writePolyHaven("other");
        imported({tileMm, {}});
        QCOMPARE(readDataset(m_out).fabrics.size(), std::size_t(2));
        QVERIFY(faultsOfDataset(m_out).empty());
    }

    void whatIsMissingIsNamedAndNothingIsWritten_data()
    {
        QTest::addColumn<QString>("fault");
        QTest::addColumn<QString>("words");
        QTest::newRow("no normals") << "normals"
                                    << "\"weave\" has colour but neither normals nor displacement";
        QTest::newRow("no colour") << "colour"
                                   << "\"weave\" has no colour";
        QTest::newRow("no scale") << "scale"
                                  << "the width of the tile of \"weave\" in mm is unknown";
        QTest::newRow("no image") << "text"
                                  << "weave_nor_gl_1k.jpg";
        QTest::newRow("too small") << "small"
                                   << "no room for three bands";
        QTest::newRow("nothing of a scan") << "nothing"
                                           << "holds no scanned material";
        QTest::newRow("empty") << "empty"
                               << "holds no file to import";
    }

    void whatIsMissingIsNamedAndNothingIsWritten()
    {
        QFETCH(QString, fault);
        QFETCH(QString, words);
        writePolyHaven("weave");
        if (fault == "normals") fs::remove(m_in / "weave/weave_nor_gl_1k.jpg");
        if (fault == "colour") fs::remove(m_in / "weave/weave_diff_1k.jpg");
        if (fault == "text") write(m_in / "weave/weave_nor_gl_1k.jpg", "this is no picture");
        if (fault == "nothing" || fault == "empty") fs::remove_all(m_in / "weave");
        if (fault == "nothing") writePicture(m_in / "holiday.png", plainColour({80, 80}));
        if (fault == "small") m_patchPx = 128;
        const TileOptions tiles = fault == "scale" ? TileOptions{} : TileOptions{tileMm, {}};
        const std::string refusal = refusalOf([&] { imported(tiles); });
        QVERIFY2(contains(refusal, words.toStdString()), refusal.c_str());
        QVERIFY(!fs::exists(m_out));
    }

    /// Measured normals lay beside the displacement, and networks were trained with guessed slopes.
    void neededMapsThatAreNotReadAreRefused_data()
    {
        QTest::addColumn<QString>("unread");
        QTest::addColumn<QString>("removed");
        QTest::addColumn<QString>("role");
        QTest::newRow("normals") << "weave/weave_nor_gl_4k.exr"
                                 << ""
                                 << "normals";
        QTest::newRow("normals in a folder of their own") << "exr/weave_nor_gl_4k.exr"
                                                          << ""
                                                          << "normals";
        QTest::newRow("colour") << "weave/weave_diff_4k.tga"
                                << "weave_diff_1k.png"
                                << "colour";
        QTest::newRow("displacement") << "weave/weave_disp_4k.EXR"
                                      << "weave_disp_1k.png"
                                      << "displacement";
    }
    void neededMapsThatAreNotReadAreRefused()
    {
        QFETCH(const QString, unread);
        QFETCH(const QString, removed);
        QFETCH(const QString, role);
        writePicture(m_in / "weave/weave_diff_1k.png", plainColour(tileSize));
        writePicture(m_in / "weave/weave_disp_1k.png", displacementOf(m_known.heightMm, CV_16U));
        if (!removed.isEmpty()) fs::remove(m_in / "weave" / removed.toStdString());
        write(m_in / unread.toStdString(), "not read");
        const std::string refusal = refusalOf([&] { imported({tileMm, {}}); });
        for (const std::string& words :
             {(m_in / unread.toStdString()).string() + ": is not read",
              "\"weave\" has no other file with its " + role.toStdString(), std::string("convert it to")})
            QVERIFY2(contains(refusal, words), refusal.c_str());
        QVERIFY(!fs::exists(m_out));
    }

    void imagesThatAreLeftOutAreNamed()
    {
        writePolyHaven("weave");
        for (const char* name : {"weave_disp_4k.exr", "weave_nor_gl_4k.tga"}) write(m_in / "weave" / name, "not read");
        const auto lines = imported({tileMm, {}});
        QVERIFY2(anyLine(lines, "1 image was left out", "displacement by name): weave_rough_1k.jpg"), lines.back().c_str());
        QVERIFY2(
            anyLine(lines, "2 images were left out", "convert to PNG what is needed): weave_disp_4k.exr, weave_nor_gl_4k.tga"),
            lines.back().c_str());
        fs::remove_all(m_in);
        writeAmbient("Fabric023");
        QVERIFY(!anyLine(imported({tileMm, {}}), "left out", ""));
    }

    void theSharedScansHaveTheirPublishedFigures()
    {
        const fs::path shared = sharedData() / "fabric_scans";
        if (sharedData().empty() || !fs::is_directory(shared))
            QSKIP("there are no shared scans; VIS2HAP_SHARED names their folder");
        m_in = shared;
        m_patchPx = usualPatchPx;
        const TileOptions tiles{std::nullopt,
                                {{"hessian_230", 268.1},
                                 {"ribbed_corduroy", 266.0},
                                 {"terry_cloth", 269.0},
                                 {"velour_velvet", 269.0},
                                 {"crepe_satin", 267.9},
                                 {"gingham_check", 297},
                                 {"caban", 274.0},
                                 {"cotton_jersey", 263.6},
                                 {"curly_teddy_natural", 335.8}}};
        const auto lines = imported(tiles);
        const Dataset dataset = readDataset(m_out);
        QCOMPARE(dataset.fabrics.size(), std::size_t(9));
        for (const FabricInfo& fabric : dataset.fabrics) {
            const bool hasNormals = fabric.name != "gingham_check";
            QCOMPARE(fabric.surfaceInMm, hasNormals);
            if (hasNormals) QVERIFY2(anyLine(lines, fabric.name, "green points up (OpenGL);"), fabric.name.c_str());
            QCOMPARE(anyLine(lines, fabric.name, "no split divides"), fabric.name == "curly_teddy_natural");
            QVERIFY2(!anyLine(lines, fabric.name, "borders do not meet"), fabric.name.c_str());
        }
        const auto faults = faultsOfDataset(m_out);
        QVERIFY2(faults.empty(), faults.empty() ? "" : faults.front().c_str());
    }

private:
    std::vector<std::string> imported(const TileOptions& tiles)
    {
        return importScans({m_in, m_out, tiles, m_patchPx, decodeByQt});
    }

    void writePolyHaven(const std::string& name)
    {
        writeJpeg(m_in / name / (name + "_diff_1k.jpg"), plainColour(tileSize));
        writeJpeg(m_in / name / (name + "_nor_gl_1k.jpg"), normalMapOf(m_known.slopes, CV_8U, true));
        writeJpeg(m_in / name / (name + "_rough_1k.jpg"), plainColour(tileSize));
    }

    void writeAmbient(const std::string& name)
    {
        writeJpeg(m_in / (name + "_1K-JPG_Color.jpg"), plainColour(tileSize));
        writePicture(m_in / (name + "_1K-JPG_NormalDX.png"), normalMapOf(m_known.slopes, CV_16U, false));
        writePicture(m_in / (name + "_1K-JPG_NormalGL.png"), normalMapOf(m_known.slopes, CV_16U, true));
        writePicture(m_in / (name + "_1K-JPG_Displacement.png"), displacementOf(m_known.heightMm, CV_8U));
    }

    std::unique_ptr<QTemporaryDir> m_temporary;
    fs::path m_in, m_out;
    int m_patchPx = patchPx;
    KnownSurface m_known;
};

QTEST_GUILESS_MAIN(ScanImportTest)
#include "scan_import_test.moc"
