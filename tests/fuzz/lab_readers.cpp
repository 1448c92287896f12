#include "tests/fuzz/lab_readers.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>

#include "database/disk/server_note.h"
#include "database/server/server_address.h"
#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "protocols/protocol_json.h"
#include "rendering/display/driver_lines.h"
#include "rendering/response/response_drawing.h"
#include "rendering/response/response_file.h"
#include "rendering/response/response_table.h"
#include "rendering/signals/tactile/calibration.h"
#include "study/commands/server/station_requests.h"
#include "study/players/planted_effects.h"
#include "tests/fuzz/inputs.h"

namespace fuzz {

namespace {

namespace fs = std::filesystem;
using study::commands::StationRequest;

const protocols::Protocol& plantedProtocol()
{
    static const protocols::Protocol read = protocols::protocolFromJson(
        R"({"schema": "vis2hap.protocol/1", "name": "planted", "participants": 8, "fabrics": ["F01", "F02", "F03"],
            "conditions": ["v_grey", "h&f"], "phases": [{"questions": ["Q1"], "alternatives": 3},
            {"questions": ["Q2", "Q3"], "scale": {"min": 0, "max": 10}}]})",
        "protocol.json");
    return read;
}

void readPlant(const std::string& bytes)
{
    const auto effects = study::players::plantedEffectsFromJson(bytes, "plant.json", plantedProtocol());
    for (const auto& [question, choice] : effects.choices)
        for (const auto& [condition, effect] : choice.effects)
            require(choice.right + effect >= 0 && choice.right + effect <= 1, "a probability outside 0 to 1 was taken");
    for (const auto& [question, rating] : effects.ratings)
        require(rating.sd >= 0 && rating.personSd >= 0 && rating.fabricSd >= 0, "a negative spread was taken");
}

/// The text with the hash that its content needs: a changed text would else go no further than its hash.
std::string hashedAgain(const std::string& bytes)
{
    auto json = nlohmann::ordered_json::parse(bytes, nullptr, false);
    if (!json.is_object() || !json.contains("sha256")) return bytes;
    json.erase("sha256");
    try {
        json["sha256"] = protocols::sha256(json.dump());
        return json.dump();
    } catch (const nlohmann::json::exception&) {
        return bytes;  // not UTF-8
    }
}

void readResponse(const std::string& bytes)
{
    const auto response = rendering::responseFromJson(hashedAgain(bytes), "response.json");
    require(response.range() > 0, "a response without a range was taken");
    rendering::responseDrawing(response);
    const auto again = rendering::responseFromJson(rendering::responseJson(response), "response.json");
    require(again.friction == response.friction, "a response is not read as it was written");
}

rendering::DisplayResponse responseTo(const std::vector<rendering::FrictionAtLevel>& measurements)
{
    auto response = rendering::fitResponse(measurements, "table.csv");
    response.setting = {
        .display = "Our display", .finger = "index finger", .date = "2026-05-04", .loadN = 0.5, .speedMmPerS = 20};
    response.source = "table.csv";
    response.sourceSha256 = std::string(64, 'a');
    return response;
}

rendering::DisplayResponse soundResponse()
{
    std::vector<rendering::FrictionAtLevel> measurements;
    for (const int repeat : {0, 1})
        for (int level = 0; level <= 255; level += 15) measurements.push_back({level, 0.2 + level * 0.001 + repeat * 0.002});
    return responseTo(measurements);
}

/// A response whose friction changes by one unit of rounding, and one of the smallest numbers.
std::vector<std::string> nearlyFlatResponses()
{
    auto response = soundResponse();
    std::fill(response.friction.begin(), response.friction.end(), 0.5);
    response.friction.back() = std::nextafter(0.5, 1);
    const std::string rounded = rendering::responseJson(response);
    std::fill(response.friction.begin(), response.friction.end(), 0);
    for (auto& level : response.measured) level = {level.level, level.count, 0, 0, {}, {}, {}};
    response.friction.back() = std::numeric_limits<double>::denorm_min();
    return {rounded, rendering::responseJson(response)};
}

const std::string network =
    R"({"schema":"vis2hap.calibration/1","kind":"network","light":"own","channels":1,"by_place":false,"light_scale":2,)"
    R"("sizes":[1,2,2],"weights":[[1,2,3,4],[5,6,7,8,9,10]],"mm_per_pixel":0.1,"high_pass_cutoff_mm":null,"zero_percentile":2})";

/// A calibration of each kind with and without places, of a colour sensor and of lamps, with the look of its sensor.
std::vector<std::string> calibrations()
{
    using namespace rendering::signals;
    std::vector<std::string> texts{network};
    for (const int channels : {1, 3}) {
        const std::vector<double> gains(static_cast<std::size_t>(channels), 0.5);
        Calibration calibration;
        calibration.channels = channels;
        calibration.map = LinearMap{{gains, gains}, {0.1, -0.1}};
        calibration.mmPerPixel = 0.05;
        calibration.highPassCutoffMm = 4;
        texts.push_back(toJson(calibration));
        for (const bool byPlace : {false, true}) {
            const std::vector<double> factors(monomials(channels + (byPlace ? 2 : 0), 2).size(), 0.25);
            calibration.map = PolynomialMap{2, byPlace, 4, {factors, factors}};
            calibration.light = byPlace ? LightMeasure::AgainstOwnLight : LightMeasure::AgainstReference;
            texts.push_back(toJson(calibration));
        }
        const auto fields = static_cast<std::size_t>(SensorAppearance::columns * SensorAppearance::rows * channels);
        calibration.sensor = SensorAppearance{64, 48, std::vector<double>(fields, 0.5)};
        texts.push_back(toJson(calibration));
    }
    return texts;
}

/// What is read is written and read again without a difference.
void readCalibrationText(const std::string& bytes)
{
    const auto calibration = rendering::signals::calibrationFromJson(bytes, "c.json");
    require(rendering::signals::calibrationFromJson(toJson(calibration), "c.json") == calibration,
            "a calibration is not read as it was written");
}

/// The address of a study, and the same of the address that is made from it.
void readAddress(const std::string& bytes)
{
    if (!database::isServerAddress(bytes)) return;
    const auto address = database::serverAddressFrom(bytes);
    const auto again = database::serverAddressFrom(database::addressOfStudy(address, "another"));
    require(again.study == "another" && again.host == address.host && again.port == address.port &&
                again.database == address.database && again.user == address.user,
            "an address with another study leads elsewhere");
}

/// The bytes of a driver, in parts as they may arrive: the first byte is the length of a part, 0 for the whole at once. The same
/// lines come out as by a search in the whole.
void readDriverLines(const std::string& bytes)
{
    if (bytes.empty()) throw protocols::badInput({"no bytes", "", "", ""});
    const std::string_view sent = std::string_view(bytes).substr(1);
    const std::size_t part = bytes[0] == 0 ? bytes.size() : static_cast<unsigned char>(bytes[0]);
    rendering::DriverLines lines;
    std::size_t begin = 0, given = 0;
    do {
        lines.add(sent.substr(given, part));
        given = std::min(given + part, sent.size());
        while (const auto line = lines.next()) {
            const std::size_t end = sent.find('\n', begin);
            require(end < given && end - begin <= rendering::DriverLines::longest, "a line without its end");
            const std::string_view whole = sent.substr(begin, end - begin);
            require(*line == whole || *line + '\r' == whole, "another line than the one that was sent");
            begin = end + 1;
        }
        const auto next = std::min(sent.find('\n', begin), given);
        require(lines.isTooLong() == (next - begin > rendering::DriverLines::longest), "a line that is too long, or none");
        if (lines.isTooLong()) throw protocols::badInput({"a line is too long", "", "", ""});
        require(next == given && !lines.hasNext() && lines.waiting() == given - begin, "a line was left");
    } while (given < sent.size());
}

/// Requests of the bytes, given in parts of that many bytes.
std::vector<StationRequest> requestsIn(std::string_view sent, std::size_t part)
{
    study::commands::StationRequests requests;
    std::vector<StationRequest> all;
    for (std::size_t given = 0; given < sent.size(); given += part) {
        requests.add(sent.substr(given, part));
        while (auto request = requests.next()) all.push_back(std::move(*request));
    }
    return all;
}

/// The bytes of a station, in parts as readDriverLines() takes them. The same requests come out as of the whole, and what they
/// hold was sent in this order.
void readStationRequests(const std::string& bytes)
{
    if (bytes.empty()) throw protocols::badInput({"no bytes", "", "", ""});
    const std::string_view sent = std::string_view(bytes).substr(1);
    const std::size_t part = bytes[0] == 0 ? bytes.size() : static_cast<unsigned char>(bytes[0]);
    const std::vector<StationRequest> all = requestsIn(sent, part);
    require(all == requestsIn(sent, bytes.size()), "other requests, because the bytes came in parts");
    std::size_t begin = 0;
    for (const StationRequest& request : all) {
        const std::string& held = request.kind == StationRequest::Kind::Ticket ? request.ticket : request.line;
        const std::size_t found = sent.find(held, begin);
        require(found != std::string_view::npos, "a request that was not sent");
        begin = found + held.size();
        require(request.ticket.size() <= study::commands::StationRequests::longestTicket, "a ticket of too many bytes");
        require(request.line.size() <= study::commands::StationRequests::longestLine + 1, "a line that is too long");
    }
    if (all.empty() || all.back().kind >= StationRequest::Kind::NoTicket) throw protocols::badInput({"no request", "", "", ""});
}

}  // namespace

std::vector<Reader> labReaders(const fs::path& folder)
{
    const fs::path table = folder / "levels.csv", station = folder / "station";
    fs::create_directories(station);
    return {
        {"calibration", calibrations(), readCalibrationText},
        {"plant",
         {R"({"schema":"vis2hap.plant/1","comment":"a","choices":{"Q1":{"right":0.4,"effects":{"h&f":0.4}}},"ratings":{"Q2":{)"
          R"("mean":4.5,"effects":{"h&f":2.5,"v_grey":-1},"sd":1,"person_sd":0,"fabric_sd":2}},"careless":["SIM05"]})",
          R"({"schema":"vis2hap.plant/1","choices":{"Q1":{"right":0.4,"effects":{"h&f":0.4,"h+f":-0.3}}}})"},
         readPlant},
        {"display-response",
         {rendering::responseJson(soundResponse()), nearlyFlatResponses().front(), nearlyFlatResponses().back()},
         readResponse},
        {"response-table",
         {"level,friction\n0,0.21\n50,0.25\n100,0.31\n150,0.42\n200,0.5\n255,0.61\n",
          "Pegel;Kraft;sweep\n0;0,1;1\n60;0,12;1\n128;0,2;1\n200;0,25;1\n255;0,3;1\n255;0,3;2\n0;0,1;2\n",
          "level,friction\n0,0.5\n60,0.5\n120,0.5\n200,0.5\n255,0.5000000000000001\n0,0.5\n60,0.5\n120,0.5\n200,0.5\n"
          "255,0.5000000000000001\n"},
         [table](const std::string& bytes) {
             put(table, bytes);
             const auto read = rendering::readResponseTable(table, {}, 0.5);
             const auto fitted = responseTo(read.measurements);
             require(fitted.range() > 0, "a response without a range was fitted");
             rendering::responseDrawing(fitted);
         }},
        {"server-note",
         {R"({"schema":"vis2hap.on-server/1","address":"postgresql://a@b:5432/lab?study=x","station":"left","token":")" +
          std::string(64, 'c') + R"(","owner":true,"computer":"","study":")" + std::string(64, 'd') + R"("})"},
         [station](const std::string& bytes) {
             put(database::serverNoteOf(station), bytes);
             const auto note = database::readServerNote(station);
             database::writeServerNote(station, note.value());
             require(database::readServerNote(station)->token == note->token, "a note is not read as it was written");
         }},
        {"driver-lines",
         {std::string(1, '\0') + "{\"type\":\"hello\"}\r\n{\"type\":\"shown\"}\n", "\x07{\"type\":\"touched\"}\n\n\r\n{\"half\"",
          "\xff" + std::string(rendering::DriverLines::longest, 'a') + "\r\nb\n"},
         readDriverLines,
         {},
         2 * rendering::DriverLines::longest},
        {"station-requests",
         {std::string(1, '\0') +
              "{\"type\":\"hello\",\"id\":1}\r\n{\"type\":\"show\",\"id\":7,\"bytes\":4}\n{\"a\n{\"type\":\"clear\",\"id\":2}\n",
          "\x05{\"type\":\"show\",\"id\":8,\"bytes\":1030}\n" + std::string(1030, '\n') + "{\"type\":\"status\",\"id\":-1}\n",
          "\xff{\"type\":\"show\",\"id\":1,\"bytes\":0}\n{\"type\":\"show\",\"id\":3,\"bytes\":67108864}\nabc",
          "\x30{\"type\":\"hello\"" + std::string(study::commands::StationRequests::longestLine, ' ') + "}\nb\n"},
         readStationRequests,
         {},
         2 * study::commands::StationRequests::longestLine},
        {"server-address",
         {"postgresql://ada@lab.example:5433/lab?study=stripes&sslmode=verify-full", "postgresql://[::1]/lab",
          "postgresql:///lab?host=/run/postgresql", "postgresql://a%40b@h/d%20e?study=x&application_name=%F0%9F%98%80",
          "postgresql://a@h/lab;\xEF\xBF\xBF&x", "postgresql://a@h/lab;\xEF\xB7\xAF&x"},
         readAddress}};
}

}  // namespace fuzz
