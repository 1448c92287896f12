// Feeds mutated files to the friction readers. Each reader must return finite numbers or refuse the file by name. A run takes
// a few seconds with a fixed seed; VIS2HAP_FUZZ_SECONDS=600 makes it longer and tries more files.
#include <QElapsedTimer>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <variant>

#include "protocols/random.h"
#include "rendering/fabrics/recordings/friction_plot.h"
#include "rendering/fabrics/recordings/friction_preparation.h"
#include "rendering/fabrics/recordings/friction_report.h"
#include "rendering/fabrics/recordings/friction_tables.h"
#include "rendering/fabrics/recordings/instrument_texts.h"
#include "rendering/fabrics/recordings/labview_texts.h"
#include "rendering/signals/friction_trace.h"
#include "rendering/signals/spectrogram_file.h"
#include "tests/rendering/fabric_files.h"
#include "tests/rendering/stroke_text.h"
#include "tests/support/mutated_files.h"

using namespace fabric_files;
using namespace rendering;
using namespace rendering::fabrics;

namespace {

void requireFinite(const std::vector<double>& values, const char* what)
{
    for (const double value : values)
        if (!std::isfinite(value)) throw std::runtime_error(std::string(what) + " holds a value that is not finite");
}

/// Does everything that an import does with a record except writing it.
void useRecords(const std::vector<RawRecord>& records)
{
    for (const RawRecord& record : records) {
        const PreparedRecord result = prepare(record, {});
        requireFinite(result.values, "a prepared record");
        requireFinite(result.evenNormalN, "its normal force");
        for (const double force : result.evenNormalN)
            if (!(force > 0.05)) throw std::runtime_error("a normal force of " + std::to_string(force) + " N was kept");
        if (!std::isfinite(result.mean) || !(result.stepS > 0)) throw std::runtime_error("no mean or no step");
        const auto json = nlohmann::json::parse(preparationJson(record, {}, result));
        if (json.at("mean").is_null()) throw std::runtime_error("the saved mean is not finite");
        const std::string svg = frictionPlot("spoilt", record, result);
        if (svg.find("nan") != std::string::npos) throw std::runtime_error("the picture has a coordinate that is not a number");
    }
}

using RecordReader = std::vector<RawRecord> (*)(const fs::path&, const FrictionOptions&);

struct Target {
    const char* name;
    std::string file;  ///< below the folder of the test
    std::string seed;
    std::function<void(const fs::path& folder)> read;
};

Target importer(const char* name, const char* file, std::string seed, RecordReader reader)
{
    return {name, file, std::move(seed), [reader, file](const fs::path& folder) { useRecords(reader(folder / file, {})); }};
}

std::string shortStroke()
{
    stroke_text::Stroke stroke;
    stroke.rateHz = 20;
    return stroke_text::twoForces(stroke);
}

std::string labviewText()
{
    std::string text = "LabVIEW Measurement\t\r\nSeparator\tTab\r\nDecimal_Separator\t.\r\n***End_of_Header***\t\r\n";
    for (int segment = 0; segment < 2; ++segment) {
        text += "Channels\t4\r\nDelta_X\t0.01\r\n***End_of_Header***\r\nX_Value\tfx_N\tfy_N\tfz_N\tComment\r\n";
        for (int i = 0; i < 60; ++i)
            text += stroke_text::number(i * 0.01) + "\t0.3\t0.4\t-" + stroke_text::number(1 + 0.01 * (i % 7)) + "\r\n";
        text += "\r\n";
    }
    return text;
}

std::string tribometerText()
{
    std::string text =
        "MTM311 Test Data File\r\nLubricant name:\t\xB5\r\n\r\nStep 1 started at 20/09/2016 07:49:34\r\n"
        "Step Time (s)\tTraction Coeff (-)\tBall Load (N)\tPin Load (N)\tSliding Speed (mm/s)\tTraction Force (N)\r\n";
    for (int i = 1; i < 80; ++i)
        text += std::to_string(i) + "\t0.2\t\t10.5\t25\t" + stroke_text::number(2 + 0.01 * (i % 5)) + "\r\n";
    return text + "\r\nAll steps completed\r\n";
}

std::string withDecimalCommas(std::string text)
{
    std::replace(text.begin(), text.end(), '.', ',');
    return text;
}

std::string labviewWithoutTimes()
{
    std::string text = "LabVIEW Measurement\t\r\nSeparator\tTab\r\nX_Columns\tNo\r\n***End_of_Header***\t\r\nChannels\t3\r\n";
    text += "Y_Unit_Label\tmN\tmN\tmN\r\nDelta_X\t0.01\t0.01\t0.01\r\n***End_of_Header***\r\nX_Value\tfx\tfy\tfz\tComment\r\n";
    for (int i = 0; i < 60; ++i) text += "\t300\t400\t-" + std::to_string(1000 + 10 * (i % 7)) + "\r\n";
    return text;
}

std::string slideText()
{
    std::string text = "timestamp, proximity1, channel1, channel2\n";
    for (int i = 0; i < 60; ++i) text += std::to_string(1000 + 28 * i + i % 3) + ",7," + std::to_string(10 + i % 4) + ",20\n";
    return text;
}

}  // namespace

class ReaderFuzzTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void spoiltFilesGiveAResultOrANamedRefusal_data()
    {
        m_path = pathOf(m_folder);
        smallDataset(m_path / "set");
        std::string stroke = "t_s,normal_n,tangential_n\n";
        for (int i = 0; i < 60; ++i)
            stroke += stroke_text::number(i / 60.0) + ",5," + stroke_text::number(2 + 0.1 * (i % 3)) + "\n";
        write(m_path / "set/F01/friction/000.csv", stroke);
        writeSpectrogram(m_path / "s.json", signals::stft(std::vector<double>(200, 0.5)));
        QTest::addColumn<int>("target");
        m_targets = {
            importer("friction-csv", "a.csv", shortStroke(), readFrictionCsv),
            importer("friction-csv with units", "a.csv",
                     "Time [ms];Fn (mN);Fx (mN);Fy (mN)\n0;500;3;4\n10;510;3;4\n25;520;-3;4\n", readFrictionCsv),
            importer("friction-csv quoted", "a.csv", "\"t_s\",\"mu\"\r\n\"0\",\"0.25\"\r\n\"0.1\",\"0.5\"\r\n0.2,0.5\r\n",
                     readFrictionCsv),
            importer("tribometer", "a.txt", tribometerText(), readTribometer),
            importer("labview", "a.txt", labviewText(), readLabview),
            importer("tribometer with decimal commas", "a.txt", withDecimalCommas(tribometerText()), readTribometer),
            importer("labview without times", "a.txt", labviewWithoutTimes(), readLabview),
            importer("slide", "a_F1_V-20mmps_0.csv", slideText(), readSlide),
            {"record of a data set", "set/F01/friction/000.csv", stroke,
             [](const fs::path& folder) {
                 const auto record = readFriction(readDataset(folder / "set"), FabricId("F01"), 0);
                 requireFinite(record.values, "a record");
                 requireFinite(signals::frictionTrace(record, "000.csv").values, "its trace");
             }},
            {"speed beside a record", "set/F01/friction/000.json",
             R"({"schema":"vis2hap.friction-import/1","from":"a.txt","speed_mm_per_s":20.5,"warnings":[]})",
             [](const fs::path& folder) {
                 const auto trace =
                     signals::frictionTrace(readFriction(readDataset(folder / "set"), FabricId("F01"), 0), "000.csv");
                 if (!(trace.mmPerSample > 0)) throw std::runtime_error("a trace has no length");
                 requireFinite({trace.mmPerSample}, "the spacing of a trace");
             }},
            {"samples.csv", "set/samples.csv", read(m_path / "set/samples.csv"),
             [](const fs::path& folder) { readSamplePlaces(readDataset(folder / "set")); }},
            {"dataset.json", "set/dataset.json", read(m_path / "set/dataset.json"),
             [](const fs::path& folder) { readDataset(folder / "set"); }},
            {"spectrogram.json", "s.json", read(m_path / "s.json"),
             [](const fs::path& folder) {
                 const auto read = readSpectrogram(folder / "s.json");
                 if (const auto* complex = std::get_if<signals::Spectrogram>(&read))
                     requireFinite(signals::istft(*complex), "a trace");
             }},
            {"spectrogram.npy", "s.npy", read(m_path / "s.npy"),
             [](const fs::path& folder) {
                 requireFinite(signals::istft(std::get<signals::Spectrogram>(readSpectrogram(folder / "s.json"))), "a trace");
             }},
        };
        for (int i = 0; i < int(m_targets.size()); ++i) QTest::newRow(m_targets[std::size_t(i)].name) << i;
    }

    void spoiltFilesGiveAResultOrANamedRefusal()
    {
        QFETCH(int, target);
        const Target& one = m_targets.at(std::size_t(target));
        const fs::path file = m_path / one.file;
        const double seconds = mutated_files::fuzzSeconds(4) / double(m_targets.size());
        auto random = protocols::Random::stream(7, one.name);
        QElapsedTimer clock;
        clock.start();
        int taken = 0, refused = 0;
        do {
            const std::string spoilt = mutated_files::mutated(one.seed, random);
            write(file, spoilt);
            try {
                one.read(m_path);
                ++taken;
            } catch (const protocols::Error&) {
                ++refused;
            } catch (const std::exception& fault) {
                const fs::path kept = fs::temp_directory_path() / ("vis2hap-fuzz-" + file.filename().string());
                write(kept, spoilt);
                QFAIL(qPrintable(
                    QString("%1: %2 (kept as %3)").arg(one.name, fault.what(), QString::fromStdString(kept.string()))));
            }
        } while (clock.elapsed() < 1000 * seconds);
        qInfo("%s: %d taken, %d refused", one.name, taken, refused);
        write(file, one.seed);
        one.read(m_path);  // The unchanged file is read.
        QVERIFY(taken > 0 && refused > 0);
    }

private:
    QTemporaryDir m_folder;
    fs::path m_path;
    std::vector<Target> m_targets;
};

QTEST_GUILESS_MAIN(ReaderFuzzTest)
#include "reader_fuzz_test.moc"
