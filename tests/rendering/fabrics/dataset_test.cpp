// The reader of data sets, its refusals, the split over groups, and the check with planted faults.
#include "rendering/fabrics/dataset.h"

#include <clocale>
#include <functional>
#include <limits>
#include <memory>
#include <set>

#include "protocols/files/number_text.h"
#include "rendering/fabrics/dataset_check.h"
#include "rendering/images/sensor_appearance.h"
#include "tests/rendering/fabric_files.h"

using namespace fabric_files;
using namespace rendering;
using namespace rendering::fabrics;

namespace {

bool anyContains(const std::vector<std::string>& lines, const std::string& first, const std::string& second)
{
    return std::any_of(lines.begin(), lines.end(),
                       [&](const std::string& line) { return contains(line, first) && contains(line, second); });
}

/// Data set of two fabrics with `groups` groups of strokes and photographs each.
Dataset strokesInGroups(const fs::path& folder, int groups, int samplesPerGroup)
{
    Dataset dataset;
    dataset.folder = folder;
    dataset.fabrics = {{FabricId("F01"), "A", ""}, {FabricId("F02"), "B", ""}};
    std::vector<SamplePlace> places;
    for (const FabricInfo& fabric : dataset.fabrics)
        for (int i = 0; i < groups * samplesPerGroup; ++i) {
            write(samplePath(dataset, fabric.id, Modality::Friction, i), "t_s,mu\n0,0.1\n1,0.2\n");
            write(samplePath(dataset, fabric.id, Modality::Visual, i), "");
            for (const Modality modality : {Modality::Friction, Modality::Visual})
                places.push_back(
                    {fabric.id, modality, i, {}, {}, {}, fabric.id.value + "-" + std::to_string(i / samplesPerGroup)});
        }
    writeDatasetJson(dataset);
    writeSamplePlaces(dataset, places);
    return dataset;
}

}  // namespace

class DatasetTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void init()
    {
        m_folder = std::make_unique<QTemporaryDir>();
        m_dataset = smallDataset(pathOf(*m_folder));
    }

    void whatWasWrittenIsRead()
    {
        const Dataset read = readDataset(m_dataset.folder);
        QCOMPARE(read.name, m_dataset.name);
        QCOMPARE(read.fabrics.size(), std::size_t(2));
        QCOMPARE(read.fabrics[1].name, std::string("Felt, \"thick\""));
        QCOMPARE(read.fabric(FabricId("F01")).structure, std::string("plain weave"));
        QCOMPARE(read.cameraMmPerPixel.value(), 0.04);
        QCOMPARE(read.tactileCalibration, std::string("known"));
        QCOMPARE(read.friction.lengthMm, 40.0);
        QCOMPARE(sampleIndices(read, FabricId("F01"), Modality::Visual), (std::vector<int>{0, 1}));
        QVERIFY(sampleIndices(read, FabricId("F02"), Modality::Tactile).empty());
        QCOMPARE(readPhotograph(read, FabricId("F01"), 1).size(), cv::Size(30, 20));
        QCOMPARE(readKnownHeight(read, FabricId("F01"), 0)->at<float>(3, 3), 0.125f);
        QCOMPARE(readKnownHeight(read, FabricId("F01"), 5), std::nullopt);
    }

    void unknownNumbersStayUnknown()
    {
        m_dataset.cameraMmPerPixel.reset();
        m_dataset.tactileCalibration.clear();
        writeDatasetJson(m_dataset);
        QVERIFY(contains(read(m_dataset.folder / "dataset.json"), "\"mm_per_pixel\": null"));
        QVERIFY(!readDataset(m_dataset.folder).cameraMmPerPixel.has_value());
        QVERIFY(readDataset(m_dataset.folder).tactileCalibration.empty());
    }

    void brokenJsonIsRefusedByField_data()
    {
        QTest::addColumn<QString>("from");
        QTest::addColumn<QString>("to");
        QTest::addColumn<QString>("named");
        QTest::newRow("no JSON") << "{"
                                 << ""
                                 << "dataset.json";
        QTest::newRow("other schema") << "vis2hap.dataset/1"
                                      << "vis2hap.dataset/9"
                                      << "schema";
        QTest::newRow("scale below 0") << "0.04"
                                       << "-0.04"
                                       << "camera.mm_per_pixel";
        QTest::newRow("scale as text") << "0.05"
                                       << "\"0.05\""
                                       << "tactile.mm_per_pixel";
        QTest::newRow("id with a path") << "\"F01\""
                                        << "\"../F01\""
                                        << "fabrics[0].id";
        QTest::newRow("id twice") << "\"F02\""
                                  << "\"F01\""
                                  << "fabrics[1].id";
        QTest::newRow("key twice") << "\"pairing\""
                                   << "\"name\""
                                   << "name";
        QTest::newRow("pairing") << "\"weak\""
                                 << "\"loose\""
                                 << "pairing";
        QTest::newRow("calibration elsewhere") << "\"known\""
                                               << "\"../known\""
                                               << "tactile.calibration";
        QTest::newRow("speed 0") << "\"speed_mm_per_s\": 5.0"
                                 << "\"speed_mm_per_s\": 0"
                                 << "friction.speed_mm_per_s";
        QTest::newRow("no fabrics") << "\"fabrics\""
                                    << "\"cloths\""
                                    << "fabrics";
    }

    void brokenJsonIsRefusedByField()
    {
        QFETCH(QString, from);
        QFETCH(QString, to);
        QFETCH(QString, named);
        const fs::path file = m_dataset.folder / "dataset.json";
        QString text = QString::fromStdString(read(file));
        const auto at = text.indexOf(from);
        QVERIFY2(at >= 0, qPrintable(text));
        write(file, text.replace(at, from.size(), to).toStdString());
        const std::string refusal = refusalOf([&] { readDataset(m_dataset.folder); });
        QVERIFY2(contains(refusal, named.toStdString()) && contains(refusal, "dataset.json"), refusal.c_str());
        QCOMPARE(faultsOfDataset(m_dataset.folder).size(), std::size_t(1));
    }

    void fibresAreStatedByName()
    {
        m_dataset.fabrics.front().fibre = Fibre::Wool;
        writeDatasetJson(m_dataset);
        const Dataset again = readDataset(m_dataset.folder);
        QVERIFY(again.fabrics.front().fibre == Fibre::Wool && !again.fabrics.back().fibre);
        const fs::path file = m_dataset.folder / "dataset.json";
        write(file, QString::fromStdString(read(file)).replace("\"wool\"", "\"100 % wool\"").toStdString());
        const std::string refusal = refusalOf([&] { readDataset(m_dataset.folder); });
        QVERIFY2(contains(refusal, "fabrics[0].fibre") && contains(refusal, "cotton, linen, jute, wool"), refusal.c_str());
    }

    void frictionIsReadByItsHeader()
    {
        const FrictionRecord forces = readFriction(m_dataset, FabricId("F01"), 0);
        QVERIFY(forces.isCoefficient());
        QCOMPARE(forces.values, (std::vector<double>{0.2, 0.3, 0.2, 0.2, 0.3, 0.2, 0.2, 0.3}));
        QCOMPARE(forces.sampleRateHz, 2.0);
        const FrictionRecord ratio = readFriction(m_dataset, FabricId("F01"), 1);
        QVERIFY(ratio.isCoefficient());  // another lab writes COF
        QCOMPARE(ratio.values, (std::vector<double>{0.25, 0.5, 0.5, 0.25, 0.5, 0.5, 0.25, 0.5}));
        const FrictionRecord counts = readFriction(m_dataset, FabricId("F02"), 0);
        QVERIFY(!counts.isCoefficient());
        QCOMPARE(counts.quantity, std::string("taxel_sum_counts"));
        QCOMPARE(counts.sampleRateHz, 50.0);
    }

    void brokenFrictionIsRefusedByRow_data()
    {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("named");
        QTest::newRow("lost contact") << "t_s,normal_n,tangential_n\n0,10,1\n1,0.05,1\n2,10,1\n"
                                      << "row 2";
        QTest::newRow("pulled off") << "t_s,normal_n,tangential_n\n0,-3,1\n1,5,1\n"
                                    << "row 1";
        QTest::newRow("text") << "t_s,mu\n0,0.1\n1,high\n"
                              << "row 2 (line 3), column mu";
        QTest::newRow("empty cell") << "t_s,mu\n0,0.1\n1,\n"
                                    << "row 2 (line 3), column mu";
        QTest::newRow("decimal comma") << "t_s,mu\n0,0.1\n1,\"0,2\"\n"
                                       << "row 2";
        QTest::newRow("not a number") << "t_s,mu\n0,nan\n1,0.1\n"
                                      << "row 1";
        QTest::newRow("short row") << "t_s,mu\n0,0.1\n1\n"
                                   << "row 2";
        QTest::newRow("time stands still") << "t_s,mu\n0,0.1\n0,0.2\n"
                                           << "row 2";
        QTest::newRow("one row") << "t_s,mu\n0,0.1\n"
                                 << "1 rows";
        QTest::newRow("no time") << "time,mu\n0,0.1\n1,0.1\n"
                                 << "time,mu";
        QTest::newRow("half the forces") << "t_s,normal_n\n0,1\n1,1\n"
                                         << "normal_n";
        QTest::newRow("empty file") << ""
                                    << "empty";
        QTest::newRow("open quote") << "t_s,mu\n0,\"0.1\n"
                                    << "quote";
        QTest::newRow("clock set an hour forward") << "t_s,mu\n0,0.1\n0.01,0.1\n0.02,0.1\n3600.03,0.1\n"
                                                   << "gap in time of 3600 s";
        QTest::newRow("row of the gap") << "t_s,mu\n0,0.1\n0.01,0.1\n0.2,0.1\n0.21,0.1\n"
                                        << "row 3";
        QTest::newRow("stamps beyond numbers") << "t_s,mu\n-1e308,0.1\n1e308,0.1\n"
                                               << "sample rate of 0 Hz";
        QTest::newRow("stamps that hardly differ") << "t_s,mu\n0,0.1\n1e-320,0.1\n"
                                                   << "sample rate of inf Hz";
        QTest::newRow("nanoseconds as seconds") << "t_s,mu\n0,0.1\n1000000,0.1\n2000000,0.1\n"
                                                << "column t_s is in seconds";
    }

    void brokenFrictionIsRefusedByRow()
    {
        QFETCH(QString, text);
        QFETCH(QString, named);
        const fs::path file = m_dataset.folder / "F01/friction/000.csv";
        write(file, text.toStdString());
        const std::string refusal = refusalOf([&] { readFriction(m_dataset, FabricId("F01"), 0); });
        QVERIFY2(contains(refusal, file.string()) && contains(refusal, named.toStdString()), refusal.c_str());
    }

    void missingSignalsAreRefusedByFabricAndSignal()
    {
        const std::string photo = refusalOf([&] { readPhotograph(m_dataset, FabricId("F02"), 0); });
        QVERIFY2(contains(photo, "F02") && contains(photo, "visual"), photo.c_str());
        QVERIFY(contains(refusalOf([&] { readPhotograph(m_dataset, FabricId("F01"), 7); }), "visual sample 7"));
        QVERIFY(contains(refusalOf([&] { readPhotograph(m_dataset, FabricId("F09"), 0); }), "F01, F02"));
        QVERIFY(contains(refusalOf([&] { readDataset(m_dataset.folder / "F01"); }), "not a data set"));
    }

    void numbersDoNotDependOnTheLocale()
    {
        const char* before = std::setlocale(LC_ALL, nullptr);
        const std::string kept = before ? before : "C";
        if (!std::setlocale(LC_ALL, "de_DE.UTF-8")) QSKIP("the locale de_DE.UTF-8 is not installed on this machine");
        const double value = readFriction(m_dataset, FabricId("F01"), 1).values[0];
        const std::string written = protocols::shortest(5.4);
        std::setlocale(LC_ALL, kept.c_str());
        QCOMPARE(value, 0.25);
        QCOMPARE(written, std::string("5.4"));
    }

    void placesComeBackWithTheirGroups()
    {
        const auto places = readSamplePlaces(m_dataset);
        QCOMPARE(places.size(), std::size_t(6));
        QCOMPARE(places[0].group, std::string("a, first"));
        QCOMPARE(places[0].rotationDeg.value(), 30.0);
        QVERIFY(!places[1].xMm.has_value());
        write(m_dataset.folder / "samples.csv", "fabric,signal,index,x_mm,y_mm,rotation_deg,group\nF01,smell,0,,,,\n");
        QVERIFY(contains(refusalOf([&] { readSamplePlaces(m_dataset); }), "smell"));
    }

    void aPhotographHasItsScaleLightAndSurface()
    {
        const FabricId linen("F01");
        writeSurface(20, 30, -0.25f);
        auto places = readSamplePlaces(m_dataset);
        QVERIFY(!contains(read(m_dataset.folder / "samples.csv"), "mm_per_pixel"));
        places[1].mmPerPixel = 0.13;
        places[1].light = "one_lamp";
        places[1].lightDeg = 135;
        writeSamplePlaces(m_dataset, places);
        const auto again = readSamplePlaces(m_dataset);
        QCOMPARE(again[1].light, std::string("one_lamp"));
        QCOMPARE(again[1].lightDeg, std::optional(135.0));
        QVERIFY(again[0].light.empty() && !again[0].mmPerPixel);
        const PhotographViews views(m_dataset);
        QCOMPARE(views.mmPerPixel(linen, 0), std::optional(0.04));
        QCOMPARE(views.mmPerPixel(linen, 1), std::optional(0.13));
        QCOMPARE(views.lightDeg(linen, 1), std::optional(135.0));
        QCOMPARE(views.lightDeg(linen, 0), std::nullopt);
        QCOMPARE(readSurface(m_dataset, linen, 1)->at<float>(0, 0), -0.25f);
        QCOMPARE(readSurface(m_dataset, linen, 0), std::nullopt);
        m_dataset.surfaceIsFree = true;
        m_dataset.fabrics[1].surfaceInMm = false;
        writeDatasetJson(m_dataset);
        const Dataset seen = readDataset(m_dataset.folder);
        QVERIFY(seen.surfaceIsFree && seen.fabrics[0].surfaceInMm && !seen.fabrics[1].surfaceInMm);
        const auto faults = faultsOfDataset(m_dataset.folder);
        QVERIFY2(faults.empty(), faults.empty() ? "" : faults.front().c_str());
        const std::string before = hashOf(m_dataset);
        writeSurface(20, 30, 0.5f);
        QVERIFY(hashOf(m_dataset) != before);
        write(m_dataset.folder / "samples.csv",
              "fabric,signal,index,x_mm,y_mm,rotation_deg,group,mm_per_pixel\nF01,visual,0,,,,,0\n");
        QVERIFY(contains(refusalOf([&] { readSamplePlaces(m_dataset); }), "column mm_per_pixel"));
    }

    /// As R writes them. A group "NA" would hold every sample of unknown place.
    void missingPlacesMayBeWrittenAsNa()
    {
        write(m_dataset.folder / "samples.csv",
              "fabric,signal,index,x_mm,y_mm,rotation_deg,group,mm_per_pixel,light\nF01,visual,0,NA,NaN,NA,NA,NA,NA\n"
              "F01,visual,1,2.5,1,NA,NA,0.1,colour\n");
        const auto places = readSamplePlaces(m_dataset);
        QVERIFY(!places[0].xMm && !places[0].yMm && !places[0].rotationDeg && !places[0].mmPerPixel && places[0].light.empty());
        QCOMPARE(places[0].group, std::string("F01/visual/0"));
        QCOMPARE(places[1].group, std::string("F01/visual/1"));
        QCOMPARE(places[1].xMm, std::optional(2.5));
    }

    /// Before, the last row counted in trainings and evaluations.
    void aSampleThatIsListedTwiceIsRefusedWithBothLines()
    {
        write(m_dataset.folder / "samples.csv",
              "fabric,signal,index,x_mm,y_mm,rotation_deg,group\nF01,visual,0,,,,a\nF01,visual,1,,,,a\nF01,visual,0,,,,b\n");
        const auto refusal = refusalOf([&] { splitBySample(m_dataset, 1); });
        for (const char* words : {"F01/visual/0 is listed twice", "line 2", "line 4"}) QVERIFY(contains(refusal, words));
    }

    void theHashChangesWithAnySample()
    {
        const std::string before = hashOf(m_dataset);
        QCOMPARE(hashOf(m_dataset), before);
        write(m_dataset.folder / "F02/friction/000.csv", "t_s,taxel_sum_counts\n0,2000\n0.02,2010\n0.04,1991\n");
        const std::string after = hashOf(m_dataset);
        QVERIFY(after != before);
        QCOMPARE(after.size(), std::size_t(64));
        fs::rename(m_dataset.folder / "F01/visual/001.png", m_dataset.folder / "F01/visual/002.png");
        QVERIFY(hashOf(m_dataset) != after);
    }

    void splitIsEightToOneToOneAndDividesNoGroup()
    {
        QTemporaryDir folder;
        const Dataset dataset = strokesInGroups(pathOf(folder), 20, 3);
        const auto split = splitBySample(dataset, 7);
        QCOMPARE(split.size(), std::size_t(2 * 2 * 60));
        std::map<std::string, std::set<Part>> partsOfGroup;
        std::map<std::pair<std::string, Part>, int> counts;
        for (const auto& [place, part] : split) {
            partsOfGroup[place.group].insert(part);
            ++counts[{place.fabric.value + nameOf(place.modality), part}];
        }
        for (const auto& [group, parts] : partsOfGroup) QCOMPARE(parts.size(), std::size_t(1));
        for (const char* signal : {"F01visual", "F01friction", "F02visual", "F02friction"}) {
            QCOMPARE((counts[{signal, Part::Training}]), 48);
            QCOMPARE((counts[{signal, Part::Validation}]), 6);
            QCOMPARE((counts[{signal, Part::Testing}]), 6);
        }
        const auto partsOnly = [](const auto& pairs) {
            std::vector<int> parts;
            for (const auto& [place, part] : pairs) parts.push_back(int(part));
            return parts;
        };
        QCOMPARE(partsOnly(splitBySample(dataset, 7)), partsOnly(split));
        QVERIFY(partsOnly(splitBySample(dataset, 8)) != partsOnly(split));
    }

    void twoGroupsAreAllForTraining()
    {
        QTemporaryDir folder;
        for (const auto& [place, part] : splitBySample(strokesInGroups(pathOf(folder), 2, 5), 7)) QVERIFY(part == Part::Training);
    }

    void aSoundDatasetHasNoFaults()
    {
        const auto faults = faultsOfDataset(m_dataset.folder);
        QVERIFY2(faults.empty(), faults.empty() ? "" : faults.front().c_str());
        QVERIFY(contains(refusalOf([&] { faultsOfDataset(m_dataset.folder / "F01"); }), "not a data set"));
        const auto notes = findingsOfDataset(m_dataset.folder).notes;
        QVERIFY(anyContains(notes, "different quantities", "mu (such as F01/friction/000.csv), taxel_sum_counts (such as F02"));
    }

    void everyPlantedFaultIsFoundWithItsFile_data()
    {
        QTest::addColumn<QString>("fault");
        QTest::addColumn<QString>("file");
        QTest::addColumn<QString>("words");
        QTest::newRow("cut photograph") << "cut"
                                        << "F01/visual/001.png"
                                        << "PNG";
        QTest::newRow("grey photograph") << "grey"
                                         << "F01/visual/001.png"
                                         << "1 channels";
        QTest::newRow("odd size") << "size"
                                  << "F01/tactile/002.png"
                                  << "40 x 10";
        QTest::newRow("missing file") << "remove"
                                      << "samples.csv"
                                      << "F01 friction 1, which has no file";
        QTest::newRow("file without row") << "extra"
                                          << "F01/friction/002.csv"
                                          << "no row in samples.csv";
        QTest::newRow("lost contact") << "contact"
                                      << "F01/friction/000.csv"
                                      << "row 2";
        QTest::newRow("short record") << "short"
                                      << "F01/friction/000.csv"
                                      << "has only 3 samples; a friction image needs 8";
        QTest::newRow("jump of the clock") << "clock"
                                           << "F01/friction/000.csv"
                                           << "gap in time";
        QTest::newRow("axis against the stroke") << "against"
                                                 << "F01/friction/000.csv"
                                                 << "points against the stroke";
        QTest::newRow("height that is not finite") << "nan"
                                                   << "F01/height/000.tiff"
                                                   << "not finite";
        QTest::newRow("height below 0") << "negative"
                                        << "F01/height/000.tiff"
                                        << "below 0";
        QTest::newRow("height of other size") << "heightsize"
                                              << "F01/height/000.tiff"
                                              << "32 x 24";
        QTest::newRow("surface without a measured point") << "surfacenan"
                                                          << "F01/surface/001.tiff"
                                                          << "no measured height";
        QTest::newRow("surface that is not finite") << "surfaceinfinite"
                                                    << "F01/surface/001.tiff"
                                                    << "infinite";
        QTest::newRow("surface of other size") << "surfacesize"
                                               << "F01/surface/001.tiff"
                                               << "30 x 20";
        QTest::newRow("surface of no photograph") << "surfacealone"
                                                  << "F01/surface/007.tiff"
                                                  << "without a photograph";
        QTest::newRow("unknown fabric") << "folder"
                                        << "F77"
                                        << "no fabric";
        QTest::newRow("fabric gone") << "gone"
                                     << "F02"
                                     << "missing";
        QTest::newRow("odd file") << "odd"
                                  << "F01/visual/notes.txt"
                                  << "name of a sample";
        QTest::newRow("row twice") << "twice"
                                   << "samples.csv"
                                   << "twice";
        QTest::newRow("reference of other size") << "reference"
                                                 << "tactile-reference.png"
                                                 << "10 x 10";
        QTest::newRow("calibration missing") << "calibration"
                                             << "tactile-calibration.json"
                                             << "cannot be read";
        QTest::newRow("calibration of another kind") << "kind"
                                                     << "tactile-calibration.json"
                                                     << "not a calibration";
        QTest::newRow("calibration of larger frames") << "sensorsize"
                                                      << "tactile-reference.png"
                                                      << "it has 32 x 24 pixels, but the sensor has 3280 x 24";
        QTest::newRow("calibration of another sensor") << "sensorlight"
                                                       << "tactile-reference.png"
                                                       << "another sensor or other light";
        QTest::newRow("calibration of another pitch") << "pitch"
                                                      << "tactile-calibration.json"
                                                      << "is for frames of 0.4 mm per pixel, but dataset.json states 0.05";
        QTest::newRow("sensor of no size") << "sensorform"
                                           << "tactile-calibration.json"
                                           << "without width, height and colours";
    }

    void everyPlantedFaultIsFoundWithItsFile()
    {
        QFETCH(QString, fault);
        QFETCH(QString, file);
        QFETCH(QString, words);
        plant(fault.toStdString());
        const auto faults = faultsOfDataset(m_dataset.folder);
        QVERIFY2(anyContains(faults, (m_dataset.folder / file.toStdString()).string(), words.toStdString()),
                 faults.empty() ? "no fault found" : faults.front().c_str());
    }

    void aCalibrationOfTheSensorIsNoFault()
    {
        writeCalibration(0.0502, appearanceOf(readTactileReference(m_dataset)));
        const auto faults = faultsOfDataset(m_dataset.folder);
        QVERIFY2(faults.empty(), faults.empty() ? "" : faults.front().c_str());
    }

    void pointsWithoutAMeasuredHeightAreNotedAndNoFault()
    {
        writeSurface(20, 30, std::numeric_limits<float>::quiet_NaN());
        const auto [faults, notes] = findingsOfDataset(m_dataset.folder);
        QVERIFY2(faults.empty(), faults.empty() ? "" : faults.front().c_str());
        QVERIFY(anyContains(notes, "1 surface has points without a measured height", "F01/surface/001.tiff: 1 of 600 points"));
    }

    void aSurfaceOfAnotherSizeIsNotReadForItsPhotograph()
    {
        writeSurface(20, 20, 0.1f);
        const auto refusal = refusalOf([&] { readSurfaceOf(m_dataset, FabricId("F01"), 1, {30, 20}); });
        QVERIFY2(contains(refusal, "F01/surface/001.tiff") && contains(refusal, "20 × 20"), refusal.c_str());
        QVERIFY(readSurfaceOf(m_dataset, FabricId("F01"), 1, {20, 20}).has_value());
        QVERIFY(!readSurfaceOf(m_dataset, FabricId("F01"), 0, {30, 20}).has_value());
    }

    void allFaultsAreReportedAtOnce()
    {
        for (const char* fault : {"cut", "contact", "nan", "folder"}) plant(fault);
        QCOMPARE(faultsOfDataset(m_dataset.folder).size(), std::size_t(4));
    }

private:
    void plant(const std::string& fault)
    {
        const fs::path folder = m_dataset.folder;
        const std::map<std::string, std::function<void()>> acts = {
            {"cut", [&] { write(folder / "F01/visual/001.png", read(folder / "F01/visual/001.png").substr(0, 200)); }},
            {"grey", [&] { writePng(folder / "F01/visual/001.png", speckled(20, 30, CV_8UC1)); }},
            {"size",
             [&] {
                 writePng(folder / "F01/tactile/001.png", speckled(24, 32, CV_8UC3));
                 writePng(folder / "F01/tactile/002.png", speckled(10, 40, CV_8UC3));
             }},
            {"remove", [&] { fs::remove(folder / "F01/friction/001.csv"); }},
            {"extra", [&] { write(folder / "F01/friction/002.csv", "t_s,mu\n0,0.1\n1,0.1\n"); }},
            {"contact", [&] { write(folder / "F01/friction/000.csv", "t_s,normal_n,tangential_n\n0,10,1\n1,0,1\n"); }},
            {"against", [&] { write(folder / "F01/friction/000.csv", "t_s,normal_n,tangential_n\n0,10,-1\n1,5,-1\n"); }},
            {"short", [&] { write(folder / "F01/friction/000.csv", "t_s,mu\n0,0.1\n0.1,0.2\n0.2,0.1\n"); }},
            {"clock", [&] { write(folder / "F01/friction/000.csv", "t_s,mu\n0,0.1\n0.01,0.1\n0.02,0.1\n3600,0.1\n"); }},
            {"nan", [&] { writeHeight(24, 32, std::numeric_limits<float>::quiet_NaN()); }},
            {"negative", [&] { writeHeight(24, 32, -0.01f); }},
            {"heightsize", [&] { writeHeight(20, 20, 0.1f); }},
            {"surfacenan",
             [&] {
                 constexpr float missing = std::numeric_limits<float>::quiet_NaN();
                 writeSurface(20, 30, missing);
                 writeTiff(folder / "F01/surface/001.tiff", cv::Mat(20, 30, CV_32FC1, cv::Scalar(missing)));
             }},
            {"surfaceinfinite", [&] { writeSurface(20, 30, std::numeric_limits<float>::infinity()); }},
            {"surfacesize", [&] { writeSurface(20, 20, 0.1f); }},
            {"surfacealone", [&] { writeSurface(20, 30, 0, "007.tiff"); }},
            {"folder", [&] { fs::create_directories(folder / "F77"); }},
            {"gone", [&] { fs::remove_all(folder / "F02"); }},
            {"odd", [&] { write(folder / "F01/visual/notes.txt", "x"); }},
            {"twice", [&] { write(folder / "samples.csv", read(folder / "samples.csv") + "F01,visual,0,,,,z\n"); }},
            {"reference", [&] { writePng(folder / "tactile-reference.png", speckled(10, 10, CV_8UC3)); }},
            {"calibration", [&] { nameCalibration(); }},
            {"kind", [&] { nameCalibration(), write(folder / "tactile-calibration.json", "{\"schema\":\"other/1\"}"); }},
            {"sensorsize",
             [&] {
                 SensorAppearance sensor = appearanceOf(readTactileReference(m_dataset));
                 sensor.width = 3280;
                 writeCalibration(0.05, sensor);
             }},
            {"sensorlight", [&] { writeCalibration(0.05, appearanceOf(readTactileReference(m_dataset) * 0.5)); }},
            {"pitch", [&] { writeCalibration(0.4, appearanceOf(readTactileReference(m_dataset))); }},
            {"sensorform",
             [&] {
                 nameCalibration();
                 write(folder / "tactile-calibration.json", R"({"schema":"vis2hap.calibration/1","sensor":{"width":"wide"}})");
             }},
        };
        acts.at(fault)();
    }

    void nameCalibration()
    {
        m_dataset.tactileCalibration = "tactile-calibration.json";
        writeDatasetJson(m_dataset);
    }

    void writeCalibration(double mmPerPixel, const SensorAppearance& sensor)
    {
        nameCalibration();
        std::string colours;
        for (const double colour : sensor.colours) colours += (colours.empty() ? "" : ",") + std::to_string(colour);
        write(m_dataset.folder / "tactile-calibration.json",
              R"({"schema":"vis2hap.calibration/1","mm_per_pixel":)" + std::to_string(mmPerPixel) + R"(,"sensor":{"width":)" +
                  std::to_string(sensor.width) + R"(,"height":)" + std::to_string(sensor.height) + R"(,"colours":[)" + colours +
                  "]}}");
    }

    void writeHeight(int rows, int columns, float corner)
    {
        cv::Mat height(rows, columns, CV_32FC1, cv::Scalar(0.1));
        height.at<float>(0, 0) = corner;
        writeTiff(m_dataset.folder / "F01/height/000.tiff", height);
    }

    void writeSurface(int rows, int columns, float corner, const std::string& name = "001.tiff")
    {
        fs::create_directories(m_dataset.folder / "F01/surface");
        cv::Mat surface(rows, columns, CV_32FC1, cv::Scalar(0.1));
        surface.at<float>(0, 0) = corner;
        writeTiff(m_dataset.folder / "F01/surface" / name, surface);
    }

    std::unique_ptr<QTemporaryDir> m_folder;
    Dataset m_dataset;
};

QTEST_GUILESS_MAIN(DatasetTest)
#include "dataset_test.moc"
