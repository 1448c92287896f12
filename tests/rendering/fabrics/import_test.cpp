// Importers: invented recordings with results calculated by hand, the shared real recordings where they exist, and
// refusals that leave no files behind.
#include "rendering/fabrics/recordings/import.h"

#include <cmath>
#include <functional>
#include <memory>
#include <numeric>

#include "rendering/fabrics/dataset_check.h"
#include "rendering/fabrics/recordings/import_stage.h"
#include "tests/rendering/fabric_files.h"
#include "tests/support/colour_tiff.h"

using namespace fabric_files;
using namespace rendering;
using namespace rendering::fabrics;

namespace {

double meanOf(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

const char* const tribometerText =
    "MTM311 Test Data File\r\nLubricant name:\t\xB5\r\n\r\nStep 1 started at 20/09/2016 07:49:34\r\n"
    "Step Time (s)\tTraction Coeff (-)\tStep Time (s)\tBall Load (N)\tPin Load (N)\tSliding Speed (mm/s)\tTraction Force (N)\r\n"
    "1\t0.2\t1\t\t10\t25\t2\r\n2\t0.3\t2\t\t10\t25\t3\r\n3\t0.2\t3\t\t20\t25\t4\r\n\r\n"
    "Step 2 started at 20/09/2016 07:59:34\r\n"
    "Step Time (s)\tTraction Coeff (-)\r\n0.5\t0.11\r\n1\t0.12\r\n\r\nAll steps completed\r\n";

const char* const labviewText =
    "LabVIEW "
    "Measurement\t\r\nSeparator\tTab\r\n***End_of_Header***\t\r\n\t\r\nChannels\t4\r\nDelta_X\t0.5\t0.5\r\n***End_of_Header***"
    "\r\n"
    "X_Value\tfx_N\tfy_N\tfz_N\tdx_um\tComment\r\n0.0\t3\t4\t-10\t1\r\n0.5\t-6\t8\t-10\t1\r\n\r\nChannels\t4\r\nDelta_X\t0.5\r\n"
    "***End_of_Header***\r\nX_Value\tfx_N\tfy_N\tfz_N\tdx_um\tComment\r\n0.0\t0\t1\t5\t1\r\n0.5\t0\t1\t5\t1\r\n1."
    "0\t0\t1\t5\t1\r\n";

}  // namespace

class ImportTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void init()
    {
        m_folder = std::make_unique<QTemporaryDir>();
        m_in = pathOf(*m_folder) / "in";
        m_out = pathOf(*m_folder) / "set";
        fs::create_directories(m_in);
    }

    void kindsHaveTheNamesOfTheCommand()
    {
        QVERIFY(importKindNamed("friction-csv") == ImportKind::FrictionCsv);
        QVERIFY(
            contains(refusalOf([] { importKindNamed("foto"); }), "photos, gelsight, friction-csv, tribometer, labview, slide"));
    }

    void photographsAreGroupedByFolderOrName()
    {
        for (const char* name : {"Wool_1.png", "Wool_2.png", "my silk_front.png", "Aida/x.png", "Aida/deep/y.png"}) {
            fs::create_directories((m_in / name).parent_path());
            writePng(m_in / name, speckled(20, 24, CV_8UC3));
        }
        write(m_in / "LICENSE", "words");
        const auto lines = import(ImportKind::Photos, {m_in});
        QCOMPARE(lines.size(), std::size_t(3));
        const Dataset dataset = readDataset(m_out);
        QCOMPARE(dataset.fabrics.size(), std::size_t(3));
        QCOMPARE(dataset.fabrics[0].name, std::string("Aida"));
        QCOMPARE(dataset.fabrics[1].name, std::string("Wool"));
        QCOMPARE(dataset.fabrics[1].id.value, std::string("F02"));
        QCOMPARE(dataset.fabrics[2].name, std::string("my silk"));
        QCOMPARE(sampleIndices(dataset, FabricId("F02"), Modality::Visual), (std::vector<int>{0, 1}));
        QVERIFY(!dataset.procedural && !dataset.cameraMmPerPixel);
        QVERIFY(faultsOfDataset(m_out).empty());
    }

    void filesThatNobodyPutThereAreLeftOut_data()
    {
        QTest::addColumn<QString>("hidden");
        for (const char* name : {"._Wool_1.png", ".Trash-1000/files/Silk_1.png", ".stversions/Silk_1.png", ".@__thumb/Wool_1.png",
                                 "Wool/@eaDir/Wool_1.png", "#recycle/Silk_1.png"})
            QTest::newRow(name) << name;
    }
    void filesThatNobodyPutThereAreLeftOut()
    {
        QFETCH(const QString, hidden);
        for (const fs::path& file : {m_in / "Wool" / "Wool_1.png", m_in / hidden.toStdString()}) {
            fs::create_directories(file.parent_path());
            writePng(file, speckled(20, 24, CV_8UC3));
        }
        import(ImportKind::Photos, {m_in});
        const Dataset dataset = readDataset(m_out);
        QCOMPARE(dataset.fabrics.size(), std::size_t(1));
        QCOMPARE(sampleIndices(dataset, FabricId("F01"), Modality::Visual), std::vector<int>{0});
    }

    void photographsOfDifferentSizesAreNotedAndNoFault()
    {
        writePng(m_in / "A_1.png", speckled(20, 24, CV_8UC3));
        writePng(m_in / "A_2.png", speckled(24, 20, CV_8UC3));
        import(ImportKind::Photos, {m_in});
        const auto [faults, notes] = findingsOfDataset(m_out);
        QVERIFY2(faults.empty(), faults.empty() ? "" : faults.front().c_str());
        QCOMPARE(notes.size(), std::size_t(1));
        QVERIFY2(contains(notes[0], "different sizes: 20 x 24 (1), 24 x 20 (1)"), notes[0].c_str());
    }

    void tiffsAreReadWithoutADecoder()
    {
        write(m_in / "A_1.tif", tests::support::tiffOfOneColour(2, 1));
        import(ImportKind::Photos, {m_in});
        const cv::Mat read = readPhotograph(readDataset(m_out), FabricId("F01"), 0);
        QCOMPARE(read.size(), cv::Size(16, 16));
        QVERIFY(read.at<cv::Vec3b>(15, 15) == cv::Vec3b(200, 100, 50));
        write(m_in / "A_1.tif", tests::support::tiffOfOneColour(6, 1));  // YCbCr
        QVERIFY(contains(refusalOf([&] { import(ImportKind::Photos, {m_in}); }), "neither grey nor RGB"));
        write(m_in / "A_1.tif", tests::support::tiffOfOneColour(2, 6));  // lies on its side
        QVERIFY(contains(refusalOf([&] { import(ImportKind::Photos, {m_in}); }), "upright"));
        writeTiff(m_in / "A_1.tif", cv::Mat(16, 16, CV_32FC1, cv::Scalar(0.5)));
        QVERIFY(contains(refusalOf([&] { import(ImportKind::Photos, {m_in}); }), "8 or 16 bits"));
    }

    void picturesOfOtherFormatsAreNamed()
    {
        write(m_in / "A_1.tif", tests::support::tiffOfOneColour(2, 1));
        write(m_in / "B_1.HEIC", "not read");
        write(m_in / "sub" / "C_1.webp", "not read");
        write(m_in / "list.txt", "not a picture");
        const auto lines = import(ImportKind::Photos, {m_in});
        QCOMPARE(lines.back(),
                 std::string("2 pictures were left out (.heic, .webp); convert to PNG what belongs to the data set"));
    }

    void webpIsNotOffered()
    {
        const std::string refusal = refusalOf([&] { import(ImportKind::Photos, {m_in}); });
        QVERIFY2(contains(refusal, ".tiff") && !contains(refusal, "webp"), refusal.c_str());
    }

    void greyAndDeepPhotographsBecomeEightBitColour()
    {
        writePng(m_in / "A_1.png", cv::Mat(16, 16, CV_16UC1, cv::Scalar(257 * 77)));
        import(ImportKind::Photos, {m_in});
        QVERIFY(readPhotograph(readDataset(m_out), FabricId("F01"), 0).at<cv::Vec3b>(3, 3) == cv::Vec3b(77, 77, 77));
    }

    /// As a camera gives Mono12: 4,096 levels in files of 16 bits became 17.
    void picturesOfTwelveBitsAreRefusedUntilTheyAreScaled_data()
    {
        QTest::addColumn<int>("kind");
        QTest::addColumn<QString>("folder");
        QTest::newRow("photographs") << int(ImportKind::Photos) << "visual";
        QTest::newRow("tactile frames") << int(ImportKind::Gelsight) << "tactile";
    }
    void picturesOfTwelveBitsAreRefusedUntilTheyAreScaled()
    {
        QFETCH(const int, kind);
        QFETCH(const QString, folder);
        cv::Mat picture(64, 64, CV_16UC1);
        for (int level = 0; level < 4096; ++level) picture.at<ushort>(level / 64, level % 64) = static_cast<ushort>(level);
        writePng(m_in / "A_1.png", picture);
        const std::string refusal = refusalOf([&] { import(ImportKind(kind), {m_in}); });
        for (const char* words : {"A_1.png", "4095 of 65535", "17 grey levels", "the factor 64 or 16", "export them with 8 bits"})
            QVERIFY2(contains(refusal, words), refusal.c_str());
        QVERIFY(!fs::exists(m_out));
        writePng(m_in / "A_1.png", cv::Mat(16 * picture));
        import(ImportKind(kind), {m_in});
        const cv::Mat kept = readPng(m_out / "F01" / folder.toStdString() / "000.png");
        QCOMPARE(int(kept.at<cv::Vec3b>(1000 / 64, 1000 % 64)[0]), 62);
        QCOMPARE(int(kept.at<cv::Vec3b>(63, 63)[0]), 255);
    }

    void darkPicturesStayAsDarkAsTheyAre()
    {
        writePng(m_in / "A_1.png", cv::Mat(16, 16, CV_8UC3, cv::Scalar::all(3)));
        writePng(m_in / "B_1.png", cv::Mat(16, 16, CV_16UC3, cv::Scalar::all(257 * 16)));
        import(ImportKind::Photos, {m_in});
        const Dataset dataset = readDataset(m_out);
        QVERIFY(readPhotograph(dataset, FabricId("F01"), 0).at<cv::Vec3b>(3, 3) == cv::Vec3b::all(3));
        QVERIFY(readPhotograph(dataset, FabricId("F02"), 0).at<cv::Vec3b>(3, 3) == cv::Vec3b::all(16));
    }

    void anExistingDatasetIsAddedTo()
    {
        writePng(m_in / "Wool_1.png", speckled(20, 24, CV_8UC3));
        import(ImportKind::Photos, {m_in});
        const std::string first = read(m_out / "F01/visual/000.png");
        writePng(m_in / "Aida_1.png", speckled(20, 24, CV_8UC3, 9));
        import(ImportKind::Photos, {m_in});
        write(pathOf(*m_folder) / "strokes/Wool_a.csv",
              "time_ms,Fn [N],Ft [mN]\n0,2,500\n10,2,600\n20,4,1000\n30,2,500\n40,2,600\n50,4,1000\n60,2,500\n70,2,600\n");
        import(ImportKind::FrictionCsv, {pathOf(*m_folder) / "strokes"});
        const Dataset dataset = readDataset(m_out);
        QCOMPARE(dataset.fabrics.size(), std::size_t(2));
        QCOMPARE(dataset.fabric(FabricId("F01")).name, std::string("Wool"));
        QCOMPARE(dataset.fabric(FabricId("F02")).name, std::string("Aida"));
        QCOMPARE(read(m_out / "F01/visual/000.png"), first);
        QCOMPARE(sampleIndices(dataset, FabricId("F01"), Modality::Visual), (std::vector<int>{0, 1}));
        const FrictionRecord record = readFriction(dataset, FabricId("F01"), 0);
        QCOMPARE(record.values, (std::vector<double>{0.25, 0.3, 0.25, 0.25, 0.3, 0.25, 0.25, 0.3}));
        QCOMPARE(dataset.friction.sampleRateHz, 100.0);
        QVERIFY(faultsOfDataset(m_out).empty());
        for (const auto& entry : fs::directory_iterator(m_out))
            QVERIFY2(!contains(entry.path().string(), "unfinished"), entry.path().c_str());
    }

    /// Each import writes samples.csv and dataset.json whole: the later one would remove what the earlier one added.
    void aSecondImportAtTheSameTimeIsRefused()
    {
        writePng(m_in / "Wool_1.png", speckled(20, 24, CV_8UC3));
        import(ImportKind::Photos, {m_in});
        ImportStage slow(m_out);
        writePng(slow.addSample(slow.fabricFor("Linen", {}), Modality::Visual).file, speckled(20, 24, CV_8UC3, 3));
        writePng(m_in / "Aida_1.png", speckled(20, 24, CV_8UC3, 9));
        import(ImportKind::Photos, {m_in});
        QVERIFY(contains(refusalOf([&] { slow.commit(); }), "another program changed the data set during this import"));
        QCOMPARE(readDataset(m_out).fabrics.size(), std::size_t(2));
        QVERIFY(faultsOfDataset(m_out).empty());
    }

    /// Such a name was stored with another sign, so that the next import made a second fabric of it.
    void aNameThatIsNotUtf8IsRefused()
    {
        writePng(m_in / "wei\xDF_1.png", speckled(20, 24, CV_8UC3));
        QVERIFY(contains(refusalOf([&] { import(ImportKind::Photos, {m_in}); }), "the name of the fabric is not UTF-8"));
        QVERIFY(!fs::exists(m_out));
    }

    void allMayBePutIntoOneFabric()
    {
        writePng(m_in / "x_1.png", speckled(20, 24, CV_8UC3));
        writePng(m_in / "y_1.png", speckled(20, 24, CV_8UC3));
        ImportRequest request{ImportKind::Photos, {m_in}, m_out, FabricId("F07"), {}};
        importRecordings(request);
        QCOMPARE(sampleIndices(readDataset(m_out), FabricId("F07"), Modality::Visual).size(), std::size_t(2));
        request.fabric = FabricId("../F08");
        QVERIFY(contains(refusalOf([&] { importRecordings(request); }), "--fabric"));
        request.fabric = FabricId("NA");
        QVERIFY(contains(refusalOf([&] { importRecordings(request); }), "cannot name a fabric: it stands for a missing value"));
    }

    void theFibreOfTheLabelIsKeptAndNotChanged()
    {
        writePng(m_in / "Wool_1.png", speckled(20, 24, CV_8UC3));
        import(ImportKind::Photos, {m_in});
        writePng(m_in / "Aida_1.png", speckled(20, 24, CV_8UC3, 9));
        ImportRequest request{ImportKind::Photos, {m_in / "Aida_1.png"}, m_out, {}, {}};
        request.fibre = Fibre::Cotton;
        importRecordings(request);
        const Dataset dataset = readDataset(m_out);
        QVERIFY(!dataset.fabrics[0].fibre && dataset.fabrics[1].fibre == Fibre::Cotton);
        request.fibre = Fibre::Silk;
        QVERIFY(contains(refusalOf([&] { importRecordings(request); }), "F02 is of cotton, not silk"));
        QCOMPARE(sampleIndices(readDataset(m_out), FabricId("F02"), Modality::Visual).size(), std::size_t(1));
    }

    void otherPicturesAreDecodedByThePassedDecoder()
    {
        write(m_in / "Wool_1.jpg", "not really");
        ImportRequest request{ImportKind::Photos, {m_in}, m_out, {}, {}};
        QVERIFY(contains(refusalOf([&] { importRecordings(request); }), "Wool_1.jpg"));
        request.decodeOther = [](const fs::path&) { return speckled(20, 20, CV_8UC3); };
        importRecordings(request);
        QCOMPARE(readPhotograph(readDataset(m_out), FabricId("F01"), 0).cols, 20);
    }

    void aReferenceFrameIsKeptAsTheUntouchedSensor()
    {
        writePng(m_in / "background.png", speckled(20, 24, CV_8UC3, 1));
        writePng(m_in / "Wool_1.png", speckled(20, 24, CV_8UC3, 2));
        import(ImportKind::Gelsight, {m_in});
        const Dataset dataset = readDataset(m_out);
        QCOMPARE(dataset.fabrics.size(), std::size_t(1));
        QCOMPARE(readTactileReference(dataset).at<cv::Vec3b>(0, 0), speckled(20, 24, CV_8UC3, 1).at<cv::Vec3b>(0, 0));
        QVERIFY(dataset.tactileCalibration.empty());
        QVERIFY(faultsOfDataset(m_out).empty());
        writePng(m_in / "background.png", speckled(20, 24, CV_8UC3, 5));
        const auto before = contentOf(m_out);
        QVERIFY(contains(refusalOf([&] { import(ImportKind::Gelsight, {m_in}); }), "another sensor"));
        QVERIFY(contentOf(m_out) == before);
    }

    void unevenTimeIsResampledAndReported()
    {
        write(m_in / "Felt_1.csv", "t;normal;tangential\n0;10;1\n0.1;10;2\n0.2;10;3\n0.35;10;4.5\n0.4;10;5\n0.5;10;6\n");
        const auto lines = import(ImportKind::FrictionCsv, {m_in});
        QVERIFY2(contains(lines[0], "resampled") && contains(lines[0], "6 rows") && contains(lines[0], "not stated"),
                 lines[0].c_str());
        const FrictionRecord record = readFriction(readDataset(m_out), FabricId("F01"), 0);
        QCOMPARE(record.values.size(), std::size_t(6));
        for (std::size_t i = 0; i < 6; ++i) QVERIFY(std::abs(record.values[i] - 0.1 * double(i + 1)) < 1e-9);
        QVERIFY(std::abs(record.sampleRateHz - 10) < 1e-6);
    }

    /// As a German tribometer or spreadsheet writes it.
    void frictionWithDecimalCommasIsTheSame()
    {
        write(m_in / "Felt_1.csv", "sep=;\r\nZeit [s];Normal [N];Tangential [N]\r\n0,0;10,0;2,5\r\n0,5;10,0;3,5\r\n1,0;10;4\r\n");
        import(ImportKind::FrictionCsv, {m_in});
        QCOMPARE(readFriction(readDataset(m_out), FabricId("F01"), 0).values, (std::vector<double>{0.25, 0.35, 0.4}));
    }

    void aTribometerGivesCoefficientsStepByStep()
    {
        write(m_in / "disc_1.txt", tribometerText);
        const auto lines = import(ImportKind::Tribometer, {m_in});
        QCOMPARE(lines.size(), std::size_t(2));
        QVERIFY2(contains(lines[0], "coefficient") && contains(lines[0], "3 rows") && contains(lines[0], "Pin Load"),
                 lines[0].c_str());
        const Dataset dataset = readDataset(m_out);
        QCOMPARE(dataset.fabrics[0].name, std::string("disc"));
        QCOMPARE(dataset.friction.speedMmPerS, 25.0);
        QCOMPARE(dataset.friction.sampleRateHz, 1.0);
        QCOMPARE(readFriction(dataset, FabricId("F01"), 0).values, (std::vector<double>{0.2, 0.3, 0.2}));
        QCOMPARE(readFriction(dataset, FabricId("F01"), 1).values, (std::vector<double>{0.11, 0.12}));
        QCOMPARE(readFriction(dataset, FabricId("F01"), 1).sampleRateHz, 2.0);
    }

    void labviewSegmentsBecomeStrokes()
    {
        write(m_in / "probe_1.txt", labviewText);
        import(ImportKind::Labview, {m_in / "probe_1.txt"});
        const Dataset dataset = readDataset(m_out);
        QCOMPARE(readFriction(dataset, FabricId("F01"), 0).values, (std::vector<double>{0.5, 1.0}));
        QCOMPARE(readFriction(dataset, FabricId("F01"), 1).values, (std::vector<double>{0.2, 0.2, 0.2}));
        QCOMPARE(readFriction(dataset, FabricId("F01"), 1).sampleRateHz, 2.0);
    }

    void aSlideIsCountsAndNeverACoefficient()
    {
        write(m_in / "Felt_soft_F150_V-20mmps_0.csv",
              "timestamp, proximity1, channel1, channel2\n1000,7,10,20\n1028,65535,11,21\n1056,7,12,22\n1085,7,10,23\n");
        const auto lines = import(ImportKind::Slide, {m_in});
        QVERIFY2(
            contains(lines[0], "taxel_sum_counts") && contains(lines[0], "not a coefficient") && contains(lines[0], "20 mm/s"),
            lines[0].c_str());
        const Dataset dataset = readDataset(m_out);
        QCOMPARE(dataset.fabrics[0].name, std::string("Felt_soft"));
        QCOMPARE(dataset.friction.speedMmPerS, 20.0);
        QVERIFY(read(m_out / "F01/friction/000.csv").starts_with("t_s,taxel_sum_counts\n0,30\n0.028,32\n"));
        QVERIFY(!readFriction(dataset, FabricId("F01"), 0).isCoefficient());
    }

    void unusableInputIsRefusedByFileAndReason_data()
    {
        QTest::addColumn<QString>("kind");
        QTest::addColumn<QString>("file");
        QTest::addColumn<QByteArray>("bytes");
        QTest::addColumn<QString>("reason");
        const auto row = [](const char* title, const char* kind, const char* file, const QByteArray& bytes, const char* reason) {
            QTest::newRow(title) << QString(kind) << QString(file) << bytes << QString(reason);
        };
        row("photo of text", "photos", "Z_1.png", "hello", "PNG");
        row("empty photo", "photos", "Z_1.png", "", "PNG");
        row("frame of text", "gelsight", "Z_1.png", "hello", "PNG");
        row("no columns", "friction-csv", "Z_1.csv", "a,b,c\n1,2,3\n", "a, b, c");
        row("lost contact", "friction-csv", "Z_1.csv", "t,normal,tangential\n0,5,1\n1,0.01,1\n2,5,1\n", "row 2");
        row("time backwards", "friction-csv", "Z_1.csv", "t,normal,tangential\n0,5,1\n2,5,1\n1,5,1\n", "row 3");
        row("a word", "friction-csv", "Z_1.csv", "t,normal,tangential\n0,5,1\n1,x,1\n", "row 2");
        row("unknown unit", "friction-csv", "Z_1.csv", "t,normal (lbf),tangential\n0,5,1\n1,5,1\n", "unit");
        row("doubled role", "friction-csv", "Z_1.csv", "t,normal,fn,tangential\n0,5,1,1\n1,5,1,1\n", "both");
        row("one row", "friction-csv", "Z_1.csv", "t,mu\n0,0.1\n", "1 rows");
        row("binary", "friction-csv", "Z_1.csv", QByteArray("\x00\x01\x02\xff", 4), "zero byte");
        row("no tribometer", "tribometer", "Z_1.txt", "words\nwords\n", "Step Time");
        row("tribometer cut in a row", "tribometer", "Z_1.txt",
            QByteArray(tribometerText).left(QByteArray(tribometerText).indexOf("3\t0.2\t3") + 9), "column");
        row("no labview", "labview", "Z_1.txt", "words\n", "LabVIEW");
        row("labview without forces", "labview", "Z_1.txt", "LabVIEW Measurement\nX_Value\ta\n0\t1\n", "fx");
        row("labview cut in a row", "labview", "Z_1.txt",
            QByteArray(labviewText).left(QByteArray(labviewText).indexOf("0.5\t-6") + 6), "line");
        row("no slide", "slide", "Z_F1.csv", "t,mu\n0,1\n1,1\n", "timestamp");
        row("slide cut in a row", "slide", "Z_F1.csv", "timestamp, channel1, channel2\n0,1,2\n28,1", "row 2");
    }

    void unusableInputIsRefusedByFileAndReason()
    {
        QFETCH(QString, kind);
        QFETCH(QString, file);
        QFETCH(QByteArray, bytes);
        QFETCH(QString, reason);
        const ImportKind importKind = importKindNamed(kind.toStdString());
        if (importKind == ImportKind::Photos || importKind == ImportKind::Gelsight)
            writePng(m_in / "A_1.png", speckled(20, 20, CV_8UC3));
        write(m_in / file.toStdString(), bytes.toStdString());
        const std::string refusal = refusalOf([&] { import(importKind, {m_in}); });
        QVERIFY2(contains(refusal, (m_in / file.toStdString()).string()) && contains(refusal, reason.toStdString()),
                 refusal.c_str());
        QVERIFY(!fs::exists(m_out));
        QCOMPARE(std::distance(fs::directory_iterator(pathOf(*m_folder)), fs::directory_iterator()), std::ptrdiff_t(1));
    }

    void wrongCallsAreRefused()
    {
        QVERIFY(contains(refusalOf([&] { import(ImportKind::Photos, {m_in / "nowhere"}); }), "nowhere"));
        QVERIFY(contains(refusalOf([&] { import(ImportKind::Photos, {m_in}); }), "no file to import"));
        write(m_in / "notes.md", "x");
        QVERIFY(contains(refusalOf([&] { import(ImportKind::Slide, {m_in / "notes.md"}); }), "notes.md"));
        write(m_out / "something.txt", "x");
        writePng(m_in / "A_1.png", speckled(20, 20, CV_8UC3));
        QVERIFY(contains(refusalOf([&] { import(ImportKind::Photos, {m_in}); }), m_out.string()));
        QCOMPARE(contentOf(m_out).size(), std::size_t(1));
    }

    void twelveRealPhotographsAreSixFabrics()
    {
        const auto lines = importReal(ImportKind::Photos, "fabricbtdf_photos");
        if (lines.empty()) QSKIP("shared/data/fabricbtdf_photos is not beside the project");
        const Dataset dataset = readDataset(m_out);
        QCOMPARE(dataset.fabrics.size(), std::size_t(6));
        const char* const names[] = {"satin1", "satin2", "satin3", "twill1", "twill2", "twill3"};
        for (std::size_t i = 0; i < 6; ++i) {
            QCOMPARE(dataset.fabrics[i].name, std::string(names[i]));
            QCOMPARE(dataset.fabrics[i].id.value, "F0" + std::to_string(i + 1));
            QCOMPARE(sampleIndices(dataset, dataset.fabrics[i].id, Modality::Visual), (std::vector<int>{0, 1}));
            QCOMPARE(readPhotograph(dataset, dataset.fabrics[i].id, 1).size(), cv::Size(512, 512));
        }
        QVERIFY(faultsOfDataset(m_out).empty());
    }

    void aRealTribometerRecordIsACoefficientOf7500Rows()
    {
        const auto lines = importReal(ImportKind::Tribometer, "tribology_moritzploss/pcs_demo_7.txt");
        if (lines.empty()) QSKIP("shared/data/tribology_moritzploss is not beside the project");
        QVERIFY2(contains(lines[0], "7500 rows") && contains(lines[0], "coefficient") && contains(lines[0], "200"),
                 lines[0].c_str());
        const FrictionRecord record = readFriction(readDataset(m_out), FabricId("F01"), 0);
        QCOMPARE(record.values.size(), std::size_t(7500));
        // First row: 1.2984 N over 11.769 N; the instrument itself reports 0.1103.
        QVERIFY(std::abs(record.values[0] - 1.2984 / 11.769) < 1e-12);
        QVERIFY(std::abs(meanOf(record.values) - 0.1) < 0.03);
        QVERIFY(std::abs(readDataset(m_out).friction.speedMmPerS - 200) < 1);
    }

    void aRealLabviewFileHasThreeSegments()
    {
        const auto lines = importReal(ImportKind::Labview, "tribology_moritzploss/labview_demo_1.txt");
        if (lines.empty()) QSKIP("shared/data/tribology_moritzploss is not beside the project");
        QCOMPARE(lines.size(), std::size_t(3));
        const FrictionRecord record = readFriction(readDataset(m_out), FabricId("F01"), 0);
        QCOMPARE(record.values.size(), std::size_t(6));
        QVERIFY(std::abs(record.values[0] - std::hypot(0.211219, 0.050140) / 13.157429) < 1e-12);
        QVERIFY(std::abs(record.sampleRateHz - 7000) < 20);
    }

    void realSlidesAreSevenFabricsOfCounts()
    {
        const auto lines = importReal(ImportKind::Slide, "fabricslide/fabric");
        if (lines.empty()) QSKIP("shared/data/fabricslide is not beside the project");
        const Dataset dataset = readDataset(m_out);
        QCOMPARE(dataset.fabrics.size(), std::size_t(7));
        QCOMPARE(dataset.fabrics[0].name, std::string("BeigeCotton"));
        QVERIFY2(contains(lines[0], "taxel_sum_counts") && contains(lines[0], "resampled"), lines[0].c_str());
        const FrictionRecord record = readFriction(dataset, FabricId("F01"), 0);
        QVERIFY(!record.isCoefficient());
        QVERIFY(record.sampleRateHz > 30 && record.sampleRateHz < 40);
    }

    void realGelsightPressesKeepTheirReference()
    {
        const auto lines = importReal(ImportKind::Gelsight, "taxim_gelsight");
        if (lines.empty()) QSKIP("shared/data/taxim_gelsight is not beside the project");
        const Dataset dataset = readDataset(m_out);
        QCOMPARE(sampleIndices(dataset, FabricId("F01"), Modality::Tactile).size(), std::size_t(39));
        QCOMPARE(readTactileReference(dataset).size(), cv::Size(160, 120));
    }

private:
    std::vector<std::string> import(ImportKind kind, std::vector<fs::path> from)
    {
        return importRecordings({kind, std::move(from), m_out, {}, {}});
    }

    /// Empty where the recordings do not exist.
    std::vector<std::string> importReal(ImportKind kind, const std::string& name)
    {
        const fs::path source = sharedData() / name;
        if (sharedData().empty() || !fs::exists(source)) return {};
        auto lines = import(kind, {source});
        for (std::size_t i = 0; i < std::min<std::size_t>(lines.size(), 3); ++i) qInfo("%s", lines[i].c_str());
        return lines;
    }

    std::unique_ptr<QTemporaryDir> m_folder;
    fs::path m_in, m_out;
};

QTEST_GUILESS_MAIN(ImportTest)
#include "import_test.moc"
