#include "tests/fuzz/readers.h"

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <utility>

#include "database/disk/finger_text.h"
#include "protocols/files/csv_table.h"
#include "protocols/files/errors.h"
#include "protocols/files/id_rule.h"
#include "protocols/files/number_text.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"
#include "protocols/protocol_json.h"
#include "protocols/records/key_json.h"
#include "protocols/secrets/sealing.h"
#include "rendering/composition/earlier_render.h"
#include "rendering/display/driver_messages.h"
#include "rendering/display/stimulus_bank.h"
#include "rendering/fabrics/dataset_json.h"
#include "rendering/fabrics/friction_record.h"
#include "rendering/fabrics/recordings/friction_preparation.h"
#include "rendering/fabrics/recordings/friction_report.h"
#include "rendering/fabrics/recordings/friction_tables.h"
#include "rendering/fabrics/recordings/import_friction.h"
#include "rendering/fabrics/recordings/instrument_texts.h"
#include "rendering/fabrics/recordings/labview_texts.h"
#include "rendering/fabrics/recordings/record_text.h"
#include "rendering/fabrics/sample_places.h"
#include "rendering/images/image_io.h"
#include "rendering/images/image_png.h"
#include "rendering/images/image_tiff.h"
#include "rendering/images/true_map.h"
#include "rendering/signals/spectrogram_file.h"
#include "study/players/script.h"
#include "tests/fuzz/answer_readers.h"
#include "tests/fuzz/foreign_readers.h"
#include "tests/fuzz/inputs.h"
#include "tests/fuzz/lab_readers.h"
#include "tests/fuzz/made_files.h"
#include "tests/fuzz/made_png.h"
#include "tests/fuzz/model_readers.h"
#include "tests/fuzz/number_readers.h"
#include "tests/fuzz/page_readers.h"
#include "tests/fuzz/settings_readers.h"
#include "tests/fuzz/shard_readers.h"
#include "tests/fuzz/study_readers.h"
#include "tests/fuzz/text_readers.h"
#include "tests/support/true_map_bytes.h"

namespace fuzz {

namespace {

namespace fs = std::filesystem;
using protocols::Sync;

std::string bytesOf(const fs::path& file)
{
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Reads every byte, so that the address sanitizer checks it.
void use(const cv::Mat& image)
{
    if (image.empty()) throw std::runtime_error("an image without pixels was read");
    volatile unsigned sum = 0;
    for (int row = 0; row < image.rows; ++row)
        for (std::size_t byte = 0; byte < static_cast<std::size_t>(image.cols) * image.elemSize(); ++byte)
            sum = sum + image.ptr<unsigned char>(row)[byte];
}

cv::Mat ramp(int type)
{
    cv::Mat image(7, 9, type);
    for (std::size_t byte = 0; byte < image.total() * image.elemSize(); ++byte)
        image.data[byte] = static_cast<unsigned char>(byte * 7 % 61);
    return image;
}

cv::Mat heights()
{
    cv::Mat_<float> map(7, 9);
    for (int i = 0; i < 63; ++i) map(i / 9, i % 9) = static_cast<float>(i % 5) / 4;
    return map;
}

// ------------------------------------------------------------------ texts

const std::string smallProtocol =
    R"({"schema":"vis2hap.protocol/1","name":"x","participants":3,"fabrics":["F01","F02","F03"],"conditions":["v_grey","h&f","f"],)"
    R"("phases":[{"questions":["Q1"],"alternatives":3,"catch_trials":1},{"questions":["Q2"],"scale":{"min":0,"max":10,"step":0.1},)"
    R"("anchors":{"mismatched":1,"repeated":2,"condition":"f"}}],)"
    R"("question_texts":{"Q1":"Which?"},"equivalence_bounds":[-0.5,0.5],"planned":[["h&f","f"]],"primary":["h&f","f"],"facts":["age"]})";

const std::string smallScript =
    R"({"schema":"vis2hap.script/1","participant":"S01","answers":[{"question":"Q1","condition":"h","fabric":"F01","answer":"foil:1",)"
    R"("seconds":2.5,"attempt":1,"touch_seconds":0.5,"touched_by":"display"},{"question":"Q2","trial":3,"answer":5.4}],)"
    R"("events":[{"do":"pause","after_answer":1,"why":"x"},{"do":"note","before_answer":1,"text":"x","flag":true},)"
    R"({"do":"correct","after_answer":2,"question":"Q2","answer":4,"why":"x"},{"do":"expect","after_answer":2,"stage":"Paused"},)"
    R"({"do":"answer","before_answer":2,"answer":3,"must_fail":true,"refusal":"x"}]})";

const std::string smallKey = R"({"schema":"vis2hap.allocation-key/2","secret":")" + std::string(64, '7') +
                             R"(","entries":{"a1":{"fabric":"F01","condition":"h&f","label":"K1"}}})";

const std::string olderKey =
    R"({"schema":"vis2hap.allocation-key/1","entries":{"a1":{"fabric":"F01","condition":"h&f","label":"K1"},)"
    R"("a2":{"fabric":"F02","condition":"f","label":"K2"}}})";

const std::string smallDataset =
    R"({"schema":"vis2hap.dataset/1","name":"d","fabrics":[{"id":"F01","name":"a","structure":"b","fibre":"wool"}],)"
    R"("camera":{"mm_per_pixel":0.05},"tactile":{"mm_per_pixel":0.1,"calibration":"known"},)"
    R"("friction":{"sample_rate_hz":60,"speed_mm_per_s":5,"length_mm":40},"pairing":"weak","procedural":true,"licence":"x"})";

const std::string smallRender =
    R"({"schema":"vis2hap.render/1","dataset":"d","conditions":{"h":{"range":{"min":0,"max":1},"mapping":"x","images":["F01"],)"
    R"("range_over":["F01","F02"],"extension":{"F01":"tile"}}},"samples":{"F01":[0,0,0]},"photographs":{"F01":{"distance":1}}})";

std::string recordText(const char* header, int columns, char separator)
{
    std::string text = std::string(header) + "\n";
    for (int row = 0; row < 40; ++row) {
        text += std::to_string(row * 0.05);
        for (int column = 1; column < columns; ++column) text += separator + std::to_string(1 + column + 0.1 * (row % 7));
        text += "\n";
    }
    return text;
}

const std::string labview =
    "LabVIEW Measurement\t\r\nSeparator\tTab\r\nDecimal_Separator\t.\r\n***End_of_Header***\t\r\nChannels\t3\r\nDelta_X\t0.01\r\n"
    "***End_of_Header***\r\nX_Value\tfx_N\tfy_N\tfz_N\tComment\r\n0\t0.3\t0.4\t-1\r\n0.01\t0.3\t0.4\t-1.1\r\n0.02\t0.3\t0.4\t-1."
    "2\r\n";

const std::string labviewWithoutTimes =
    "LabVIEW Measurement\t\r\nX_Columns\tNo\r\n***End_of_Header***\t\r\nChannels\t3\r\nY_Unit_Label\tmN\tmN\tmN\r\n"
    "Delta_X\t0.01\t0.01\t0.01\r\n***End_of_Header***\r\nX_Value\tfx\tfy\tfz\tComment\r\n"
    "\t300\t400\t-1000\r\n\t300\t400\t-1100\r\n";

const std::string tribometerWithCommas =
    "Profile\tx\r\n\r\nStep Time (s)\tTraction Force (N)\tPin Load (N)\tSliding Speed (mm/s)\r\n"
    "0,00\t0,400\t1,000\t10,0\r\n0,01\t0,410\t1,000\t10,0\r\n0,02\t0,4\t1,1\t10\r\n";

const std::string tribometer =
    "MTM311 Test Data File\r\nLubricant name:\t\xB5\r\n\r\nStep 1 started at 20/09/2016 07:49:34\r\n"
    "Step Time (s)\tTraction Coeff (-)\tBall Load (N)\tPin Load (N)\tSliding Speed (mm/s)\tTraction Force (N)\r\n"
    "1\t0.2\t\t10.5\t25\t2.1\r\n2\t0.2\t\t10.4\t25\t2.2\r\n3\t0.2\t\t10.6\t25\t2.0\r\n\r\nAll steps completed\r\n";

// ------------------------------------------------------------------ readers

void readTable(const std::string& bytes)
{
    for (const char separator : {',', '\t'}) {
        try {
            const auto table = protocols::csvTableFrom(bytes, "a.csv", separator);
            for (std::size_t row = 0; row < table.rows.size(); ++row)
                for (std::size_t column = 0; column < table.columns.size(); ++column)
                    if (const auto number = protocols::numberOrMissing(table, row, column); number && !std::isfinite(*number))
                        throw std::runtime_error("a number that is not finite was read");
        } catch (const protocols::Error&) {
        }
    }
}

void readJson(const std::string& bytes)
{
    const protocols::JsonDocument document(bytes, "a.json");
    for (const char* pointer : {"", "/answers/1", "/phases/0/questions", "/a~1b/0"}) document.placeOf(pointer);
    if (nlohmann::json::parse(document.root().dump()) != document.root()) throw std::runtime_error("the value changed");
}

void readId(const std::string& bytes)
{
    protocols::fileNameOf(bytes);
    if (protocols::printable(bytes).find('\x1b') != std::string::npos) throw std::runtime_error("an escape was let through");
    protocols::requireGoodId(bytes, "a participant", "a.json");
}

void readDriverLine(const std::string& bytes)
{
    const auto message = rendering::driverMessageFrom(bytes);
    if (!message || message->kind != rendering::MessageKind::Finger) return;
    for (const auto& value : {message->xMm, message->yMm, message->forceN})
        if (value && !(std::abs(*value) <= 1e4)) throw std::runtime_error("a finger beyond every display was read");
}

void readFingerText(const std::string& bytes)
{
    const auto samples = database::fingerSamplesFrom(bytes, 1'000'000'000);
    if (!samples) throw protocols::badInput({"no samples of a finger", "", "", ""});
    const auto again = database::fingerSamplesFrom(database::fingerTextOf(*samples), 1'000'000'000);
    if (!again || again->size() != samples->size()) throw std::runtime_error("samples are not read as they were written");
}

void readKey(const std::string& text)
{
    try {
        protocols::olderKeyEntriesFromJson(text, "k.json");
    } catch (const protocols::Error&) {
    }
    protocols::allocationKeyFromJson(text, "k.json");
}

/// Reads the text of a key behind its passphrase, as it reads an open one.
void readSealedKey(const std::string& bytes)
{
    constexpr std::string_view passphrase = "four words of mine";
    const auto content = contentToPack(bytes);
    const std::string sealed =
        content ? protocols::sealWithPassphrase(passphrase, *content, protocols::PassphraseCost::ForTests) : bytes;
    const auto opened = protocols::openWithPassphrase(passphrase, sealed, "k.json");
    require(!content || opened == content, "a sealed key gives another text");
    if (opened) readKey(*opened);
}

void readSealedStimulus(const protocols::SecretKey& key, const std::string& sound, const std::string& bytes)
{
    const auto content = contentToPack(bytes);
    const std::string sealed = content ? protocols::seal(key, *content, "code") : bytes;
    const auto opened = protocols::open(key, sealed, "code");
    require(!content || opened == content, "a sealed stimulus gives another one");
    if (!opened) return;
    require(content || *opened == sound, "an altered stimulus was opened");
    use(rendering::openedStimulus(key, sealed, "code", "code.sealed"));
}

Reader imageReader(const std::string& name, const fs::path& file, std::vector<std::string> corpus)
{
    return {name, std::move(corpus), [file](const std::string& bytes) {
                put(file, bytes);
                use(rendering::readImage(file));
            }};
}

std::vector<Reader> textReaders()
{
    const auto paper = protocols::protocolFromJson(protocols::paperProtocolJson(), "the paper's protocol");
    const auto key = protocols::SecretKey::ofHex(std::string(64, '7'), "key");
    const std::string stimulus = rendering::pgmBytes(ramp(CV_8UC1));
    return {
        {"json",
         {smallProtocol, smallScript, R"({"a/b":[1,-0.5e3,"\u00e4\\",null,true]})",
          R"({"\u0061":{"\u0062":[{"\u0063":{"d":1}}]},"e":2})"},
         readJson},
        {"csv", {recordText("t_s,a,b", 3, ','), "a;b\n\"1,5\";2\n", "\"a\"\"b\",c\r\n\"x\ny\",NA\r\n"}, readTable},
        {"id", {"P01", "P 01", "\xE5\x8F\x82", "../victim", "a\xE2\x80\xAE"}, readId},
        {"protocol",
         {smallProtocol, std::string(protocols::paperProtocolJson())},
         [](const std::string& bytes) {
             try {
                 protocols::keptProtocolFromJson(bytes, "p.json", "0.5.0");
             } catch (const protocols::Error&) {
             }
             protocols::protocolFromJson(bytes, "p.json");
         }},
        {"script", {smallScript}, [paper](const std::string& bytes) { study::players::scriptFromJson(bytes, "s.json", paper); }},
        {"key", {smallKey, olderKey}, readKey},
        {"sealed-key",
         {"+" + smallKey, protocols::sealWithPassphrase("four words of mine", smallKey, protocols::PassphraseCost::ForTests),
          "+" + olderKey},
         readSealedKey},
        {"sealed-stimulus",
         {"+" + stimulus, protocols::seal(key, stimulus, "code"), "+P5\n# c\n2 2\n255\n1234"},
         [key, stimulus](const std::string& bytes) { readSealedStimulus(key, stimulus, bytes); }},
        {"dataset",
         {smallDataset,
          R"({"schema":"vis2hap.dataset/1","fabrics":[{"id":"F01"},{"id":"F02","surface_in_mm":false,"fibre":null}]})",
          R"({"schema":"vis2hap.dataset/1","fabrics":[{"id":"F01","fibre":"cotton"}],"pairing":"aligned",)"
          R"("surface":{"free":true},)"
          R"("camera":{"mm_per_pixel":null},"tactile":{"mm_per_pixel":null,"calibration":"sensor.json"},"friction":{}})"},
         [](const std::string& bytes) { rendering::fabrics::datasetFromJson(bytes, "d.json"); }},
        {"render", {smallRender}, [](const std::string& bytes) { rendering::joined(smallRender, bytes, "render.json"); }},
        {"driver",
         {R"({"type":"hello","id":1,"schema":"vis2hap.display/1","name":"x","width":1280,"height":800,"touches":true})",
          R"({"type":"shown","id":2,"t_device":1.5})", R"({"type":"failed","id":3,"why":"x"})",
          R"({"type":"finger","id":2,"at_s":1.5,"x_mm":31.2,"y_mm":20.05,"force_n":0.42})",
          R"({"type":"finger","id":2,"at_s":null,"x_mm":-1e4,"y_mm":null,"force_n":1e999})", R"({"type":"finger","id":7.0})",
          R"({"type":"shown","id":2,"id":3,"volts":{"a":[1],"a":2}})"},
         readDriverLine},
        {"finger-text", {"0,3120,2005,420;50,12,,-3;60,,,", "0,,,;1,2147483647,-9,"}, readFingerText},
        {"true-map", {tests::support::trueMapBytes(heights())}, [](const std::string& bytes) {
             use(rendering::trueMapFrom(bytes, "a.tmd").heightMm);
         }}};
}

std::vector<Reader> imageReaders(const fs::path& folder)
{
    rendering::writePng(folder / "grey.png", ramp(CV_8UC1), Sync::Later);
    rendering::writePng(folder / "deep.png", ramp(CV_16UC3), Sync::Later);
    rendering::writeTiff(folder / "height.tiff", heights(), Sync::Later);
    rendering::writeNpy(folder / "array.npy", heights(), Sync::Later);
    std::vector<std::string> pngs{bytesOf(folder / "grey.png"), bytesOf(folder / "deep.png")};
    for (const std::string& parts : partsOfPngs()) pngs.push_back("+" + parts);
    std::vector<std::string> tiffs{bytesOf(folder / "height.tiff")};
    for (std::string& more : greyTiffs(folder / "a.tiff")) tiffs.push_back(std::move(more));
    return {{"png", std::move(pngs),
             [file = folder / "a.png"](const std::string& bytes) {
                 const auto parts = contentToPack(bytes);
                 put(file, parts ? pngOf(*parts) : bytes);
                 use(rendering::readImage(file));
             }},
            imageReader("tiff", folder / "a.tiff", std::move(tiffs)),
            imageReader("npy", folder / "a.npy", {bytesOf(folder / "array.npy")}),
            imageReader("pgm", folder / "a.pgm", {rendering::pgmBytes(ramp(CV_8UC1)), "P5\n# c\n2 2\n65535\n12345678"})};
}

using RecordReader = std::vector<rendering::fabrics::RawRecord> (*)(const fs::path&, const rendering::fabrics::FrictionOptions&);

/// Goes on as an import does. What it accepts, it must write so that the data set can be read again.
void importInto(rendering::fabrics::Dataset dataset, const rendering::fabrics::RawRecord& record)
{
    using namespace rendering::fabrics;
    constexpr std::size_t mostSamples = 50'000;  // More take seconds with sanitizers.
    const PreparedRecord prepared = prepare(record, {});
    const FrictionRecording stated = recordingOf(record, prepared, dataset.friction);
    if (prepared.values.size() > mostSamples) return;
    const protocols::FabricId fabric = dataset.fabrics.front().id;
    const fs::path file = samplePath(dataset, fabric, Modality::Friction, 0);
    put(file, frictionCsv(prepared, record.quantity));
    put(fs::path(file).replace_extension(".json"), preparationJson(record, {}, prepared));
    dataset.friction.speedMmPerS = 7;  // The record states its own speed, or has this one.
    try {
        Dataset described = dataset;
        described.friction = stated;
        const FrictionRecording again = datasetFromJson(toJson(described), "d.json").friction;
        require(again.sampleRateHz == stated.sampleRateHz && again.speedMmPerS == stated.speedMmPerS &&
                    again.lengthMm == stated.lengthMm,
                "dataset.json states another recording");
        const FrictionRecord read = readFriction(dataset, fabric, 0);
        require(read.values.size() == prepared.values.size(), "another number of samples is read again");
        require(read.speedMmPerS == record.speedMmPerS.value_or(dataset.friction.speedMmPerS), "another speed is read again");
        require(std::abs(read.sampleRateHz * prepared.stepS - 1) < 0.01, "another sample rate is read again");
        for (std::size_t i = 0; i < read.values.size(); ++i) {
            const double load = prepared.evenNormalN.empty() ? 1 : prepared.evenNormalN[i];
            require(read.values[i] == prepared.values[i] / load, "another value is read again");
        }
    } catch (const protocols::Error& fault) {
        throw std::runtime_error("an imported record is refused where it is read again: " + std::string(fault.what()));
    }
}

/// Number of lines that begin with a number and a tab, below the first line that begins with `header`.
std::size_t numericRows(const std::string& bytes, std::string_view header)
{
    const std::string text = rendering::fabrics::asUtf8(bytes);
    std::size_t count = 0;
    bool isBelow = false;
    for (const std::string_view line : rendering::fabrics::linesOf(text)) {
        const std::string_view first = line.substr(0, line.find('\t'));
        if (isBelow && first.size() < line.size() && protocols::numberIn(first)) ++count;
        isBelow = isBelow || first == header;
    }
    return count;
}

/// `header`: first cell of the header rows of an instrument whose rows must all be in the records; empty for tables.
Reader recordReader(const std::string& name, const fs::path& file, std::vector<std::string> corpus, RecordReader reader,
                    const rendering::fabrics::Dataset& dataset, const std::string& header = {})
{
    return {name, std::move(corpus), [file, reader, dataset, header](const std::string& bytes) {
                put(file, bytes);
                const auto records = reader(file, {});
                require(!records.empty(), "no record was read and none was refused");
                std::size_t rows = 0;
                for (const auto& record : records) rows += record.timeS.size();
                require(header.empty() || rows >= numericRows(bytes, header), "a row of numbers is in no record");
                for (const auto& record : records) importInto(dataset, record);
            }};
}

std::vector<Reader> recordReaders(const fs::path& folder)
{
    using namespace rendering::fabrics;
    const fs::path spectrogram = folder / "s.json";
    rendering::writeSpectrogram(spectrogram, rendering::signals::stft(std::vector<double>(200, 0.5)), Sync::Later);
    const std::string header = bytesOf(spectrogram), values = bytesOf(folder / "s.npy");
    Dataset dataset = datasetFromJson(smallDataset, "d.json");
    dataset.folder = folder;
    fs::create_directories(samplePath(dataset, dataset.fabrics.front().id, Modality::Friction, 0).parent_path());
    return {
        recordReader("friction-csv", folder / "a.csv",
                     {recordText("t_s,normal_n,tangential_n", 3, ','), recordText("Time [ms];Fn (mN);Fx (mN);Fy (mN)", 4, ';'),
                      "\"t_s\",\"mu\"\r\n\"0\",\"0.25\"\r\n\"0.1\",\"0.5\"\r\n0.2,0.5\r\n",
                      "Zeit [ms]\tF_n (mN)\tfriction_mN\n0\t500,5\t200,25\n10\t510,5\t205,5\n25\t520\t210,5\n",
                      "timestamp,COF (%),n\n0,25,1\n1,26.5,2\n2,27,3\n"},
                     readFrictionCsv, dataset),
        recordReader("slide", folder / "a_F1_V-20mmps_0.csv", {recordText("timestamp, proximity1, channel1, channel2", 4, ',')},
                     readSlide, dataset),
        recordReader("tribometer", folder / "a.txt", {tribometer, tribometerWithCommas}, readTribometer, dataset,
                     "Step Time (s)"),
        recordReader("labview", folder / "a.lvm", {labview, labviewWithoutTimes}, readLabview, dataset, "X_Value"),
        {"samples",
         {"fabric,signal,index,x_mm,y_mm,rotation_deg,group\nF01,visual,0,908.981,739.053,-2.89,F01/visual/"
          "0\nF01,tactile,1,3,4,,a\n",
          "fabric,signal,index,x_mm,y_mm,rotation_deg,group\nF01,visual,0,,,,a\nF01,visual,0,,,,b\n"},
         [dataset](const std::string& bytes) {
             put(dataset.folder / "samples.csv", bytes);
             readSamplePlaces(dataset);
         }},
        {"spectrogram",
         {header},
         [spectrogram, values](const std::string& bytes) {
             put(spectrogram, bytes);
             put(fs::path(spectrogram).replace_extension(".npy"), values);
             rendering::readSpectrogram(spectrogram);
         }},
        {"spectrogram-values", {values}, [spectrogram, header](const std::string& bytes) {
             put(spectrogram, header);
             put(fs::path(spectrogram).replace_extension(".npy"), bytes);
             rendering::readSpectrogram(spectrogram);
         }}};
}

}  // namespace

std::vector<Reader> allReaders(const fs::path& folder)
{
    std::vector<Reader> readers = textReaders();
    for (auto& more : {answerReaders(folder), foreignReaders(folder), imageReaders(folder), labReaders(folder),
                       modelReaders(folder), recordReaders(folder), numberReaders(folder), pageReaders(), settingsReaders(folder),
                       shardReaders(folder), studyReaders(folder), writtenTextReaders(folder)})
        readers.insert(readers.end(), more.begin(), more.end());
    return readers;
}

}  // namespace fuzz
