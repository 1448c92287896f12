#include "tests/fuzz/foreign_readers.h"

#include <QBuffer>
#include <QImage>
#include <QImageWriter>
#include <chrono>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "database/server/answer_queue.h"
#include "database/server/held_log.h"
#include "database/server/server_replies.h"
#include "protocols/files/errors.h"
#include "protocols/files/foreign/foreign_table.h"
#include "protocols/files/utf8.h"
#include "rendering/cache/packed_result.h"
#include "rendering/images/image_tiff.h"
#include "rendering/models/cloth/cloth_check.h"
#include "rendering/models/model_card.h"
#include "rendering/scans/normal_map.h"
#include "rendering/scans/scan_files.h"
#include "rendering/scans/stated_resolution.h"
#include "rendering/scans/tile_widths.h"
#include "reports/json/results_json.h"
#include "study/app/drafts/protocol_draft.h"
#include "study/looking/picture_decoder.h"
#include "study/participant/sound/sound_lines.h"
#include "tests/fuzz/damaged_rows.h"
#include "tests/fuzz/inputs.h"
#include "tests/fuzz/made_files.h"

namespace fuzz {

namespace {

namespace fs = std::filesystem;

/// Runs steps of which each may refuse.
void refusable(const std::function<void()>& step)
{
    try {
        step();
    } catch (const protocols::Error&) {
        // Another step may take the same input.
    }
}

void useTable(const protocols::ForeignTable& read)
{
    for (const auto& row : read.table.rows)
        for (const std::string& cell : row) {
            require(!protocols::firstByteThatIsNotUtf8(cell), "a cell is not UTF-8");
            require(protocols::cellWithoutGuard(protocols::safeCell(cell)) == cell, "a safe cell does not give its text back");
        }
}

void readForeign(const std::string& bytes)
{
    for (const char* encoding : {"windows-1252", "GB18030", "UTF-16LE", "CP1258", "CP1255", "BIG5-HKSCS"})
        refusable([&] { useTable(protocols::foreignTableFrom(bytes, "a.csv", encoding)); });
    useTable(protocols::foreignTableFrom(bytes, "a.csv"));
}

/// An uncompressed RGB image of 4 x 3 pixels.
std::string colourTiff(std::uint32_t bits)
{
    constexpr std::uint32_t width = 4, height = 3, shortType = 3, longType = 4, entries = 10;
    const std::uint32_t afterTable = 8 + 2 + 12 * entries + 4, pixels = afterTable + 6, size = width * height * 3 * bits / 8;
    std::string file = "II" + little(42, 2) + little(8, 4) + little(entries, 2);
    const auto entry = [&](std::uint32_t tag, std::uint32_t type, std::uint32_t count, std::uint32_t value) {
        file += little(tag, 2) + little(type, 2) + little(count, 4) + little(value, 4);
    };
    entry(256, longType, 1, width);
    entry(257, longType, 1, height);
    entry(258, shortType, 3, afterTable);
    entry(259, shortType, 1, 1);
    entry(262, shortType, 1, 2);
    entry(273, longType, 1, pixels);
    entry(274, shortType, 1, 1);
    entry(277, shortType, 1, 3);
    entry(278, longType, 1, height);
    entry(279, longType, 1, size);
    file += little(0, 4);
    for (int channel = 0; channel < 3; ++channel) file += little(bits, 2);
    for (std::uint32_t i = 0; i < size; ++i) file += static_cast<char>(i * 7);
    return file;
}

std::string pictureBytes(const char* format, QImage::Format kind = QImage::Format_RGB888, bool isProgressive = false)
{
    QImage image(24, 16, QImage::Format_RGB888);
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) image.setPixel(x, y, qRgb(x * 10, y * 15, (x ^ y) * 8));
    image = image.convertToFormat(kind);
    image.setDotsPerMeterX(5906);
    image.setDotsPerMeterY(5906);
    QByteArray bytes;
    QBuffer buffer(&bytes);
    buffer.open(QIODevice::WriteOnly);
    QImageWriter writer(&buffer, format);
    writer.setProgressiveScanWrite(isProgressive);
    if (!writer.write(image)) throw std::runtime_error("Qt cannot write this format");
    return bytes.toStdString();
}

/// A JPEG whose EXIF states 300 dots an inch.
std::string pictureWithExif()
{
    std::string exif = "II" + little(42, 2) + little(8, 4) + little(3, 2);
    exif += little(0x0112, 2) + little(3, 2) + little(1, 4) + little(6, 4);  // turned
    exif += little(0x011a, 2) + little(5, 2) + little(1, 4) + little(50, 4);
    exif += little(0x0128, 2) + little(3, 2) + little(1, 4) + little(2, 4);
    exif += little(0, 4) + little(300, 4) + little(1, 4);
    const std::string content = std::string("Exif\0\0", 6) + exif;
    const auto length = static_cast<std::uint32_t>(content.size() + 2);
    std::string jpeg = pictureBytes("JPG");
    jpeg.insert(2, std::string("\xFF\xE1") + static_cast<char>(length >> 8) + static_cast<char>(length & 0xff) + content);
    return jpeg;
}

void readResolution(const std::string& bytes)
{
    const auto stated = rendering::scans::statedResolution(bytes);
    if (stated) require(std::isfinite(stated->perInch) && stated->perInch > 0, "an impossible resolution was taken");
}

/// The bytes as pixels of a normal map and of a displacement beside it.
void readScanPixels(const std::string& bytes)
{
    if (bytes.size() < 3) throw protocols::badInput({"too few bytes", "", "", ""});
    const auto sideOf = [&](std::size_t at) { return 1 + static_cast<unsigned char>(bytes[at]) % 48; };
    cv::Mat normals(sideOf(0), sideOf(1), CV_8UC3), displacement(sideOf(1), sideOf(2), CV_32FC1);
    std::size_t next = 3;
    const auto byte = [&] { return bytes.size() > 3 ? static_cast<unsigned char>(bytes[3 + next++ % (bytes.size() - 3)]) : 0; };
    for (auto& pixel : cv::Mat_<cv::Vec3b>(normals))
        for (int channel = 0; channel < 3; ++channel) pixel[channel] = static_cast<unsigned char>(byte());
    for (auto& height : cv::Mat_<float>(displacement)) height = static_cast<float>(byte()) / 255;
    const auto slopes = rendering::scans::slopesOfNormals(normals, "normals.png");
    require(cv::checkRange(slopes.x) && cv::checkRange(slopes.y), "a slope is not finite");
    const double correlation = rendering::scans::heightCorrelation(slopes.x, displacement);
    require(std::abs(correlation) <= 1 + 1e-6, "a correlation beyond 1");
}

std::string soundPixels()
{
    std::string bytes("\x1f\x1f\x1f", 3);
    for (int i = 0; i < 32 * 32; ++i)
        bytes += std::string{static_cast<char>(128 + i % 13 - 6), static_cast<char>(124 + i % 7), '\xF0'};
    return bytes;
}

void readKept(const std::string& bytes)
{
    const auto kept = rendering::cache::unpacked(bytes);
    if (!kept) throw protocols::badInput({"no kept result", "", "", ""});
    const auto again = rendering::cache::unpacked(rendering::cache::packed(*kept));
    require(again && again->arrays.size() == kept->arrays.size(), "a result is not read as it was written");
}

std::string soundKept()
{
    cv::Mat heights(5, 4, CV_32FC1);
    cv::randu(heights, 0, 1);
    return rendering::cache::packed({R"({"ms":3.5,"mm_per_pixel":0.05})", {heights, cv::Mat(), cv::Mat::eye(2, 3, CV_64FC1)}});
}

void readCloth(const fs::path& file)
{
    static const cv::Mat picture = rendering::models::drawnClothPicture(3, 1);
    const auto check = rendering::models::readClothCheck(file);
    check.likenessOf(check.score(picture));
}

/// The bytes of a queue, which is made once.
const std::string& soundQueue(const fs::path& folder)
{
    static const std::string sound = [&folder] {
        fs::create_directories(folder);
        const database::StudyFolder place{folder};
        {
            database::AnswerQueue queue(place);
            for (int entry = 0; entry < 3; ++entry) queue.put({0, "P01", "human", R"({"kind":"answered","payload":"{}"})"});
            queue.keepSeen({"a study", {7, std::string(64, 'a')}, 5});
            queue.keepEnrolled("P01");
        }
        std::ifstream in(place.queue(), std::ios::binary);
        return std::string{std::istreambuf_iterator<char>(in), {}};
    }();
    return sound;
}

/// The bytes are a queue, or behind a "+" rows of a sound one.
void readQueue(const fs::path& folder, const std::string& bytes)
{
    const database::StudyFolder place{folder};
    for (const char* ending : {"", "-wal", "-shm"}) fs::remove(place.queue().string() + ending);
    const auto rows = contentToPack(bytes);
    put(place.queue(), rows ? soundQueue(folder / "sound") : bytes);
    if (rows) changeRows(place.queue(), *rows);
    database::AnswerQueue queue(place);
    for (int taken = 0; taken < 4; ++taken) {
        const auto entry = queue.first();
        if (!entry) break;
        queue.remove(entry->number);
    }
    queue.put({0, "P01", "human", "{}"});
    require(queue.size() > 0, "an entry was put and is not there");
    const auto seen = queue.seenOf("a study");
    require(seen.head.sequence >= 0 && (!seen.lostAfter || *seen.lostAfter < seen.head.sequence),
            "an impossible memory was read");
    queue.keepSeen(database::afterHead(seen, {8, std::string(64, 'b')}));
    for (const std::string& code : queue.enrolledHere()) require(code.size() <= 64, "a code that is too long was read");
}

void readReply(const std::string& bytes)
{
    const std::string where = "postgresql://a@b/lab?study=x";
    const auto reply = database::replyFrom(bytes, where);
    const std::chrono::system_clock::time_point asked{std::chrono::seconds(1'767'225'600)};  // 2026
    (void)database::clockAheadOf(reply, asked, asked + std::chrono::milliseconds(250));
    refusable([&] { (void)database::headFrom(reply, where); });
    refusable([&] { (void)database::entryNumberFrom(reply, where); });
    refusable(
        [&] { require(database::trialFrom(reply, where, {3}).number == protocols::TrialNumber{3}, "another trial was taken"); });
    refusable([&] { (void)database::placesFrom(reply, where); });
    refusable([&] { require(database::progressFrom(reply, where).answers >= 0, "fewer answers than none"); });
    refusable([&] {
        for (const auto& item : database::studyReplyFrom(reply, where).facts.familiarisation)
            require(database::familiarisationPosition(item.sealedCode).has_value(), "an image cannot be asked for");
    });
    refusable([&] {
        const auto place = database::claimReplyFrom(reply, where, "P01");
        for (std::size_t i = 0; i < place.trials.size(); ++i)
            require(place.trials[i].number.value == static_cast<int>(i) + 1, "trials are not in their order");
    });
}

const std::string head = R"("head":{"sequence":4,"hash":"ab"})";
const std::string places =
    R"("places":[{"slot":1,"state":"started","participant":"P01","kind":"human","answers":3},{"slot":2,"state":"free","participant":"","kind":"","answers":0}])";

std::vector<std::string> soundReplies()
{
    return {
        R"({"name":"a","protocol_json":"{}","protocol_sha256":"00","has_passphrase":true,"dataset_procedural":false,"stamps":"[\"a\"]","created_at":"2026-01-01T00:00:00Z","made_with_program":"0.6.0","fabrics":[{"id":"F01","name":"Linen"}],"familiarisation":[{"name":"a","position":1}],"protocol_version":1,"images_to":"display",)" +
            head + "}",
        R"({"slot":1,"state":"started","protocol_version":1,"swatches":{"F01":"K7"},"trials":[{"number":1,"phase":0,"presentation_code":"A1","instruction":"","aim":"","alternatives":"[\"F01\",\"F02\"]","sealed_code":"00ff"},{"number":2,"phase":0,"presentation_code":"A2","deadline_ms":900}],"events":[{"sequence":1,"sitting":1,"kind":"begun","payload":"{}","at_ns":5,"wall_time":"2026-01-01T00:00:00Z"}],)" +
            head + "}",
        "{" + places +
            R"(,"stations":[{"station":"left","login":"hand","program":"vis2hap 0.6.0","participant":null,"live":true,"queue_length":0,"last_seen_seconds":1}],)" +
            head + "}",
        R"({"event":7,)" + head + "}",
        R"({"event":7,"now":"2026-01-01T00:00:01.250Z",)" + head + "}",
        R"({"refused":{"code":"VH101","parts":["the slot is taken","P01","another one"]},)" + head + "}",
        "{" + places +
            R"(,"stations":[],"owed":[{"station":"left","participant":"P01","queue_length":3},)"
            R"({"station":"right","queue_length":1}],)" +
            head + "}",
        R"({"slot":1,"state":"started","protocol_version":1,"protocol_json":"{\"schema\":\"vis2hap.protocol/1\"}",)"
        R"("swatches":{},"trials":[],"events":[],)" +
            head + "}",
        R"({"name":"a","protocol_json":"{}","protocol_sha256":"00","has_passphrase":false,)"
        R"("dataset_procedural":true,"stamps":["a"],)"
        R"("created_at":"","made_with_program":"","fabrics":[],"familiarisation":[],"protocol_version":3,)" +
            head + "}"};
}

void readDraft(const std::string& bytes)
{
    using namespace study::app;
    ProtocolDraft draft = ProtocolDraft::fromText(bytes, "a.json");
    for (const char* place : {"name", "fabrics", "fabrics[0]", "phases[1].scale.min", "phases[0].questions", "prompts.wait",
                              "phases[foo", "[99999999999999999999]"}) {
        (void)draft.typedAt(place);
        (void)draft.countAt(place);
        for (const FieldKind kind : {FieldKind::Text, FieldKind::Number, FieldKind::Lines}) draft.setTyped(place, kind, "4,5\nb");
        draft.erase(place);
    }
    ProtocolDraft emptied = draft;
    for (const auto& [key, value] : draft.document().items()) require(emptied.eraseKey("", key), "a key was not removed");
    require(emptied.document().empty(), "a key is left");
    (void)filesBeside(draft);
    makeImageFoldersAbsolute(draft, "/tmp");
    if (ProtocolDraft::fromText(draft.fileText(), "b.json") != draft) throw std::runtime_error("a draft is not read as written");
}

void readTiles(const fs::path& folder)
{
    using namespace rendering::scans;
    const std::vector<ScanFiles> fabrics{{"linen", folder, {}, {}, {}}};
    for (const TileWidth& width : tileWidths(fabrics, folder, {}))
        require(width.mm >= 1 && width.mm <= 100'000, "an impossible width was taken");
}

}  // namespace

std::vector<Reader> foreignReaders(const fs::path& folder)
{
    const fs::path tiff = folder / "colour.tif", picture = folder / "picture", cloth = folder / "cloth.json",
                   results = folder / "results.json", station = folder / "station-queue", tables = folder / "tiles",
                   stated = folder / "stated";
    for (const fs::path& one : {station, tables, stated}) fs::create_directories(one);
    const auto shippedCheck = rendering::models::shippedModel().parent_path() / "cloth-check.json";
    std::ifstream check(shippedCheck, std::ios::binary);
    return {
        {"foreign-table",
         {"fabric;thickness\nLinen;0,45\nCotton;1,2\n", "sep=;\nfabric;n\n\"a;b\";=1+1\n",
          "\xEF\xBB\xBF"
          "a\tb\r1\t2\r",
          "Stoff;L\xE4nge\nWolle;1,5\n", "a;b\n1;\xE2", "a;b\n1;\xF9", "a;b\n1;\x88\x66", "\xB2\xBC\xC1\xCF;a\n\xC3\xDE;1\n",
          std::string("\xFF\xFE"
                      "a\0,\0b\0\n\0"
                      "1\0,\0"
                      "2\0\n\0",
                      18)},
         readForeign},
        {"colour-tiff",
         {},
         [tiff](const std::string& bytes) {
             put(tiff, bytes);
             require(rendering::readColourTiff(tiff).channels() % 2 == 1, "neither grey nor RGB");
         },
         [tiff] {
             std::vector<std::string> corpus{colourTiff(8), colourTiff(16)};
             for (std::string& more : colourTiffs(tiff)) corpus.push_back(std::move(more));
             return corpus;
         }},
        {"picture",
         {},
         [picture](const std::string& bytes) {
             put(picture, bytes);
             require(study::looking::decodeByQt(picture).type() == CV_8UC3, "another kind of picture");
         },
         [] {
             std::vector<std::string> corpus{pictureBytes("JPG"),
                                             pictureBytes("BMP"),
                                             pictureBytes("PPM"),
                                             pictureBytes("XPM"),
                                             pictureWithExif(),
                                             pictureBytes("JPG", QImage::Format_Grayscale8),
                                             pictureBytes("JPG", QImage::Format_RGB888, true)};
             for (std::string& more : drawnPictures()) corpus.push_back(std::move(more));
             return corpus;
         }},
        {"stated-resolution",
         {},
         readResolution,
         [] {
             return std::vector<std::string>{pictureBytes("JPG"), pictureBytes("PNG"), pictureWithExif()};
         }},
        {"scan-name",
         {"weave_nor_gl_2k", "Fabric023_2K-JPG_NormalDX", "linen_basecolor", "normal"},
         [](const std::string& bytes) {
             if (const auto name = rendering::scans::mapNamed(bytes); name && name->fabric.size() > bytes.size())
                 throw std::runtime_error("a name became longer");
         }},
        {"scan-pixels", {soundPixels(), "\xa6\xfa\x50\x7f\x89\xf1"}, readScanPixels},
        {"tiles",
         {"name,width_mm\nlinen,268.1\n"},
         [tables](const std::string& bytes) {
             put(tables / "tiles.csv", bytes);
             readTiles(tables);
         }},
        {"scan-json",
         {R"({"tile_mm":268.1})"},
         [stated](const std::string& bytes) {
             put(stated / "scan.json", bytes);
             readTiles(stated);
         }},
        {"kept-result", {soundKept()}, readKept},
        {"cloth-check",
         {std::string(std::istreambuf_iterator<char>(check), {})},
         [cloth](const std::string& bytes) {
             put(cloth, bytes);
             readCloth(cloth);
         }},
        {"answer-queue",
         {},
         [station](const std::string& bytes) { readQueue(station, bytes); },
         [station] {
             std::vector<std::string> corpus{soundQueue(station / "sound")};
             for (const std::string& rows : rowsOf(database::StudyFolder{station / "sound"}.queue()))
                 corpus.push_back("+" + rows);
             return corpus;
         }},
        {"server-reply", soundReplies(), readReply},
        {"sound-said",
         {R"({"ready":"Speakers"})", R"({"voice":"en","no_voice":"a","fault":"\u001b[0m"})"},
         [](const std::string& bytes) {
             if (!study::participant::saidBySound(bytes)) throw protocols::badInput({"no message", "", "", ""});
         }},
        {"draft",
         {R"({"schema":"vis2hap.protocol/1","name":"a","fabrics":["F01","F02"],"phases":[{"questions":["Q1"],"images":"x"},{"scale":{"min":0}}],"prompts":{"wait":"wait.wav"}})"},
         readDraft},
        {"results-file",
         {R"({"schema":"vis2hap.results/2","study":{"simulated":true}})",
          R"({"a":1,"schema":"x","schema":"vis2hap.results/2","b":[[[[[[[[[[{"a":{},"a":[]}]]]]]]]]]]})"},
         [results](const std::string& bytes) {
             put(results, bytes);
             (void)reports::isResultsFile(results);
         }}};
}

}  // namespace fuzz
