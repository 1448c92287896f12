// The split by location: samples that show the same piece of fabric stay in one part, and the parts remain 8:1:1.
#include "rendering/fabrics/location_split.h"

#include <sys/stat.h>

#include <map>
#include <set>

#include "tests/rendering/fabric_files.h"

using namespace fabric_files;
using namespace rendering;
using namespace rendering::fabrics;

namespace {

SamplePlace at(Modality modality, int index, double x, double y, double rotation = 0)
{
    return {FabricId("F01"), modality, index, x, y, rotation, ""};
}

/// Photographs of 1 mm x 1 mm at the given places.
Dataset photographed(const fs::path& folder, const std::vector<SamplePlace>& places)
{
    Dataset dataset;
    dataset.folder = folder;
    dataset.fabrics = {{FabricId("F01"), "A", ""}};
    dataset.cameraMmPerPixel = 0.1;
    for (const SamplePlace& place : places) {
        fs::create_directories(folder / "F01" / "visual");
        writePng(samplePath(dataset, place.fabric, place.modality, place.index), cv::Mat(10, 10, CV_8UC3, cv::Scalar::all(9)));
    }
    writeDatasetJson(dataset);
    writeSamplePlaces(dataset, places);
    return dataset;
}

/// Single photographs, overlapping pairs and overlapping triples, all far from each other.
std::vector<SamplePlace> scattered(int places)
{
    std::vector<SamplePlace> result;
    for (int place = 0, index = 0; place < places; ++place)
        for (int k = 0; k <= place % 3; ++k) result.push_back(at(Modality::Visual, index++, place * 50 + 0.6 * k, place * 7, 30));
    return result;
}

/// A chunk eXIf that states orientation 6, with its checksum.
std::string onItsSide()
{
    return QByteArray::fromHex("0000001a655849664d4d002a00000008000101120003000000010006000000000000d6674b69").toStdString();
}

/// Twenty records of `seconds` at ten samples a second, which start `apartMm` apart on one line.
std::vector<SamplePlace> stroked(const Dataset& dataset, double seconds, double apartMm)
{
    std::string record = "t_s,mu\n";
    for (int i = 0; i <= std::lround(10 * seconds); ++i)
        record += std::to_string(i / 10.0) + "," + std::to_string(0.4 + 0.01 * (i % 3)) + "\n";
    std::vector<SamplePlace> places;
    for (int i = 0; i < 20; ++i) {
        places.push_back(at(Modality::Friction, i, apartMm * i, 0));
        write(samplePath(dataset, FabricId("F01"), Modality::Friction, i), record);
    }
    writeSamplePlaces(dataset, places);
    return places;
}

void stateOwnSpeed(const Dataset& dataset, const SamplePlace& place, const std::string& speed)
{
    fs::path report = samplePath(dataset, place.fabric, Modality::Friction, place.index).replace_extension(".json");
    write(report, R"({"schema": "vis2hap.friction-import/1", "speed_mm_per_s": )" + speed + "}");
}

std::map<Part, int> countsOf(const std::vector<std::pair<SamplePlace, Part>>& split)
{
    std::map<Part, int> counts;
    for (const auto& [place, part] : split) ++counts[part];
    return counts;
}

}  // namespace

class LocationSplitTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void init() { m_folder = std::make_unique<QTemporaryDir>(); }

    void aPipeInThePlaceOfAPhotographIsRefused()
    {
        const Dataset dataset = photographed(pathOf(*m_folder), {at(Modality::Visual, 0, 0, 0), at(Modality::Visual, 1, 9, 9)});
        const fs::path photograph = samplePath(dataset, FabricId("F01"), Modality::Visual, 1);
        fs::remove(photograph);
        QCOMPARE(::mkfifo(photograph.c_str(), 0600), 0);
        QVERIFY(refusalOf([&] { (void)splitByLocation(dataset, 1); }).find(photograph.string()) != std::string::npos);
    }

    /// Without a size it would overlap none, so that one place could be in training and in testing.
    void aPhotographThatIsNoPngIsRefused()
    {
        const Dataset dataset = photographed(pathOf(*m_folder), {at(Modality::Visual, 0, 0, 0), at(Modality::Visual, 1, 9, 9)});
        const fs::path photograph = samplePath(dataset, FabricId("F01"), Modality::Visual, 1);
        const std::string sound = read(photograph);
        for (const std::string& spoilt : {std::string("\xff\xd8\xff\xe0 a JPEG under the name of a PNG"), sound.substr(0, 20),
                                          std::string(sound).replace(16, 4, std::string(4, '\0')),
                                          std::string(sound).replace(20, 4, std::string(4, '\xff'))}) {
            write(photograph, spoilt);
            const std::string refusal = refusalOf([&] { (void)splitByLocation(dataset, 1); });
            QVERIFY2(contains(refusal, photograph.string()) && contains(refusal, "PNG"), refusal.c_str());
        }
    }

    /// The reader turns such a picture upright, so that its footprint has other sides than its header.
    void aPhotographThatACameraMarkedHasTheSidesOfItsPicture()
    {
        const SamplePlace place = at(Modality::Visual, 0, 0, 0);
        const Dataset dataset = photographed(pathOf(*m_folder), {place});
        const fs::path photograph = samplePath(dataset, FabricId("F01"), Modality::Visual, 0);
        writePng(photograph, cv::Mat(10, 30, CV_8UC3, cv::Scalar::all(9)));
        QCOMPARE(footprintOf(dataset, place)->widthMm, 3.0);
        const std::string upright = read(photograph), mark = onItsSide();
        const std::size_t beforePixels = 33, afterPixels = upright.size() - 12;
        for (const std::size_t where : {beforePixels, afterPixels}) {
            write(photograph, std::string(upright).insert(where, mark));
            QCOMPARE(readPhotograph(dataset, FabricId("F01"), 0).size(), cv::Size(10, 30));
            QCOMPARE(footprintOf(dataset, place)->widthMm, 1.0);
            QCOMPARE(footprintOf(dataset, place)->heightMm, 3.0);
        }
        write(photograph, std::string(upright).insert(beforePixels, mark.substr(0, 20)));  // a chunk that is cut
        QCOMPARE(footprintOf(dataset, place)->widthMm, 3.0);
    }

    void samplesOfOnePlaceStayTogether()
    {
        const Dataset dataset = photographed(pathOf(*m_folder), scattered(60));
        for (const std::uint64_t seed : {1, 2, 3}) {
            const auto split = splitByLocation(dataset, seed);
            for (const auto& [a, partOfA] : split)
                for (const auto& [b, partOfB] : split)
                    if (overlap(*footprintOf(dataset, a), *footprintOf(dataset, b))) QCOMPARE(partOfA, partOfB);
        }
    }

    void partsAreATenthEach()
    {
        const Dataset dataset = photographed(pathOf(*m_folder), scattered(60));  // 120 photographs.
        auto counts = countsOf(splitByLocation(dataset, 5));
        QCOMPARE(counts[Part::Testing], 12);
        QCOMPARE(counts[Part::Validation], 12);
        QCOMPARE(counts[Part::Training], 96);
    }

    void seedDrawsAnotherSplitAndTheSameOneAgain()
    {
        const Dataset dataset = photographed(pathOf(*m_folder), scattered(60));
        const auto parts = [&](std::uint64_t seed) {
            std::vector<Part> result;
            for (const auto& entry : splitByLocation(dataset, seed)) result.push_back(entry.second);
            return result;
        };
        QCOMPARE(parts(5), parts(5));
        QVERIFY(parts(5) != parts(6));
    }

    void samplesOfUnknownPlaceOverlapNone()
    {
        auto places = scattered(60);
        for (SamplePlace& place : places) place.xMm.reset();
        const Dataset dataset = photographed(pathOf(*m_folder), places);
        QVERIFY(!footprintOf(dataset, places.front()));
        auto counts = countsOf(splitByLocation(dataset, 5));
        QCOMPARE(counts[Part::Testing], 12);
        QCOMPARE(counts[Part::Training], 96);
    }

    void oneLargePlaceIsNotDivided()
    {
        std::vector<SamplePlace> places;
        for (int i = 0; i < 20; ++i) places.push_back(at(Modality::Visual, i, 0.5 * i, 0));  // A chain of overlaps.
        auto counts = countsOf(splitByLocation(photographed(pathOf(*m_folder), places), 5));
        QCOMPARE(counts[Part::Training], 20);
    }

    void threeLargePlacesFillEveryPart()
    {
        std::vector<SamplePlace> places;
        for (int i = 0; i < 9; ++i) places.push_back(at(Modality::Visual, i, 100 * (i / 3), 0));
        auto counts = countsOf(splitByLocation(photographed(pathOf(*m_folder), places), 5));
        QCOMPARE(counts[Part::Training], 3);
        QCOMPARE(counts[Part::Validation], 3);
        QCOMPARE(counts[Part::Testing], 3);
    }

    void groupsOfTheFileAreNotDivided()
    {
        std::vector<SamplePlace> places = scattered(60);
        for (SamplePlace& place : places) place.group = "day " + std::to_string(place.index / 5);
        const auto split = splitByLocation(photographed(pathOf(*m_folder), places), 5);
        std::map<std::string, std::set<Part>> partsOf;
        for (const auto& [place, part] : split) partsOf[place.group].insert(part);
        for (const auto& [group, parts] : partsOf) QCOMPARE(parts.size(), std::size_t(1));
        QVERIFY(countsOf(split)[Part::Training] < 120);
    }

    void rectanglesOverlapAsDrawn_data()
    {
        QTest::addColumn<double>("x");
        QTest::addColumn<double>("y");
        QTest::addColumn<double>("rotation");
        QTest::addColumn<bool>("overlaps");
        QTest::newRow("same place") << 0.0 << 0.0 << 0.0 << true;
        QTest::newRow("edges touch") << 4.0 << 0.0 << 0.0 << false;
        QTest::newRow("just inside") << 3.99 << 0.0 << 0.0 << true;
        QTest::newRow("below") << 0.0 << 2.01 << 0.0 << false;
        QTest::newRow("turned corner reaches in") << 0.0 << 2.5 << 90.0 << true;
        QTest::newRow("circles meet, rectangles do not") << 3.2 << 2.2 << 0.0 << false;
        QTest::newRow("turned by 45, its end reaches in") << 3.2 << 2.2 << 45.0 << true;
        QTest::newRow("turned by -45, its side stays away") << 3.2 << 2.2 << -45.0 << false;
    }

    void rectanglesOverlapAsDrawn()
    {
        QFETCH(double, x);
        QFETCH(double, y);
        QFETCH(double, rotation);
        QFETCH(bool, overlaps);
        const Footprint a{0, 0, 4, 2, 0}, b{x, y, 4, 2, rotation};
        QCOMPARE(overlap(a, b), overlaps);
        QCOMPARE(overlap(b, a), overlaps);
    }

    void strokesReachFromTheirPlaceOn()
    {
        const Dataset dataset = photographed(pathOf(*m_folder), scattered(3));
        const auto stroke = footprintOf(dataset, at(Modality::Friction, 0, 10, 20, 90));
        QCOMPARE(stroke->widthMm, 40.0);
        QCOMPARE(stroke->yMm, 40.0);
        QVERIFY(std::abs(stroke->xMm - 10) < 1e-9);
    }

    /// With the length of the first import, 40 mm, strokes of 200 mm on one line were taken for separate places.
    void strokesThatLieOnOneAnotherStayTogether()
    {
        const Dataset dataset = photographed(pathOf(*m_folder), {});
        const auto places = stroked(dataset, 8, 60);
        for (const SamplePlace& place : places) stateOwnSpeed(dataset, place, "25");
        const auto stroke = footprintOf(dataset, places[1]);
        QVERIFY(std::abs(stroke->widthMm - 200) < 1e-9 && std::abs(stroke->xMm - 160) < 1e-9);
        QVERIFY(overlap(*stroke, *footprintOf(dataset, places[4])) && !overlap(*stroke, *footprintOf(dataset, places[5])));
        SamplePlace unknownDirection = places[1];
        unknownDirection.rotationDeg.reset();
        QVERIFY(std::abs(footprintOf(dataset, unknownDirection)->widthMm - 400) < 1e-9);
        for (const std::uint64_t seed : {1, 2, 3}) QCOMPARE(countsOf(splitByLocation(dataset, seed))[Part::Training], 20);
    }

    void aStrokeIsAsLongAsItsRecordLasts_data()
    {
        QTest::addColumn<double>("seconds");
        QTest::addColumn<QByteArray>("speed");
        QTest::addColumn<double>("length");
        QTest::newRow("the stated length, from sample to sample") << 8.0 << QByteArray("null") << 40.0;
        QTest::newRow("the stated length, a step for each sample") << 7.9 << QByteArray("null") << 40.0;
        QTest::newRow("longer, at the speed of the data set") << 16.0 << QByteArray("null") << 80.0;
        QTest::newRow("shorter") << 4.0 << QByteArray("null") << 20.0;
        QTest::newRow("its own speed") << 8.0 << QByteArray("25") << 200.0;
        QTest::newRow("two samples") << 0.1 << QByteArray("50") << 5.0;
        QTest::newRow("a speed that cannot be read") << 16.0 << QByteArray("-3") << 40.0;
    }
    void aStrokeIsAsLongAsItsRecordLasts()
    {
        QFETCH(const double, seconds);
        QFETCH(const QByteArray, speed);
        QFETCH(const double, length);
        const Dataset dataset = photographed(pathOf(*m_folder), {});
        const SamplePlace place = stroked(dataset, seconds, 60).front();
        stateOwnSpeed(dataset, place, speed.toStdString());
        QVERIFY(std::abs(footprintOf(dataset, place)->widthMm - length) < 1e-9);
        if (length == 40) QCOMPARE(footprintOf(dataset, place)->widthMm, dataset.friction.lengthMm);  // to the last digit
    }

private:
    std::unique_ptr<QTemporaryDir> m_folder;
};

QTEST_GUILESS_MAIN(LocationSplitTest)
#include "location_split_test.moc"
