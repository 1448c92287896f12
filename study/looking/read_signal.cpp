#include "study/looking/read_signal.h"

#include "protocols/errors.h"
#include "rendering/fabrics/csv_table.h"
#include "rendering/fabrics/dataset.h"
#include "rendering/friction_image.h"
#include "rendering/image_io.h"
#include "study/looking/open_study.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace study::looking {

namespace {

namespace fs = std::filesystem;
using rendering::fabrics::CsvTable;
using rendering::fabrics::Dataset;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr double missingMarkerMm = -1e9;  // instruments write -1e10
constexpr double leastNormalN = 0.05;     // below it a coefficient is noise over noise

/// Where a file lies in a data set: DATASET/F01/visual/000.png.
struct Place {
    Dataset dataset;
    std::string fabric, signal;
};

std::optional<Place> placeOf(const fs::path& file)
{
    std::error_code problem;
    const fs::path whole = fs::weakly_canonical(file, problem);
    const fs::path signal = whole.parent_path(), fabric = signal.parent_path();
    if (!fs::exists(fabric.parent_path() / "dataset.json", problem))
        return std::nullopt;
    return Place{rendering::fabrics::readDataset(fabric.parent_path()), fabric.filename().string(), signal.filename().string()};
}

std::optional<double> pitchIn(const Place& place)
{
    if (place.signal == "visual")
        return place.dataset.cameraMmPerPixel;
    const bool isTactile = place.signal == "tactile" || place.signal == "height";
    return isTactile ? place.dataset.tactileMmPerPixel : std::nullopt;
}

std::string titleOf(const fs::path& file, const std::optional<Place>& place)
{
    return place ? place->fabric + " " + place->signal + " " + file.filename().string() : file.filename().string();
}

std::string sizeOf(const cv::Mat& image)
{
    return std::to_string(image.cols) + " × " + std::to_string(image.rows);
}

/// Bit 0: a channel at 0; bit 1: a channel at the highest.
cv::Mat clippedIn(const cv::Mat& image, const Holds& holds)
{
    cv::Mat marks = cv::Mat::zeros(image.size(), CV_8UC1);
    std::vector<cv::Mat> channels;
    cv::split(image, channels);
    for (const cv::Mat& channel : channels) {
        marks |= (channel == holds.lowest) & 1;
        marks |= (channel == holds.highest) & 2;
    }
    return marks;
}

SeenMap mapOfImage(const cv::Mat& image)
{
    SeenMap map;
    map.holds = image.depth() == CV_8U ? Holds{0, 255} : Holds{0, 65535};
    map.unit = "grey level";
    map.clipped = clippedIn(image, *map.holds);
    cv::Mat grey = image;
    if (image.channels() == 3) {
        image.convertTo(map.colours, CV_8U, 255.0 / map.holds->highest);
        cv::cvtColor(image, grey, cv::COLOR_RGB2GRAY);
    }
    grey.convertTo(map.values, CV_32F);
    return map;
}

SeenMap mapOfNumbers(const cv::Mat& numbers, const std::string& unit)
{
    SeenMap map;
    map.unit = unit;
    numbers.convertTo(map.values, CV_32F);
    for (float& value : cv::Mat_<float>(map.values))
        if (!std::isfinite(value) || (unit == "mm" && value <= missingMarkerMm))
            value = static_cast<float>(nothing);
    return map;
}

SeenSignal seenRow(const cv::Mat& row, const std::string& title, const std::string& unit)
{
    SeenTrace trace;
    cv::Mat values;
    row.convertTo(values, CV_64F);
    for (int i = 0; i < values.cols; ++i) {
        const double value = values.at<double>(i);
        trace.places.push_back(i);
        trace.values.push_back(std::isfinite(value) ? value : nothing);
    }
    trace.placeUnit = "samples";
    trace.quantity = unit.empty() ? "value" : unit;
    return {title, "array of one row, " + std::to_string(values.cols) + " values", std::move(trace)};
}

/// Friction images of the display's own size lie on its glass pixel by pixel.
bool isOfTheGlass(const cv::Mat& image)
{
    return image.channels() == 1 && image.size() == cv::Size(rendering::displayWidthPx, rendering::displayHeightPx);
}

std::string kindOfImage(const cv::Mat& image, const std::optional<Place>& place)
{
    const std::string depth = image.depth() == CV_8U ? ", 8 bits" : ", 16 bits";
    if (place && place->signal == "visual")
        return "photograph, " + sizeOf(image) + depth;
    if (place && place->signal == "tactile")
        return "tactile frame, " + sizeOf(image) + depth;
    const char* kind = image.channels() == 3 ? "colour picture, " : isOfTheGlass(image) ? "friction image, " : "grey picture, ";
    return kind + sizeOf(image) + depth;
}

SeenSignal readMap(const fs::path& file, const ReadingOptions& options)
{
    const cv::Mat image = rendering::readImage(file);
    if (image.empty())
        throw protocols::badInput({"holds no numbers", file.string(), "at least one pixel", ""});
    const auto place = placeOf(file);
    const bool isImage = image.depth() == CV_8U || image.depth() == CV_16U;
    const bool isArray = file.extension() == ".npy";
    if (!isImage && image.channels() != 1)
        throw protocols::badInput({"holds " + std::to_string(image.channels()) + " numbers a pixel", file.string(), "one number a pixel, or an image of 8 or 16 bits", ""});
    if (isArray && image.rows == 1 && image.cols > 1)
        return seenRow(image, titleOf(file, place), options.unit);
    SeenMap map = isImage ? mapOfImage(image) : mapOfNumbers(image, !options.unit.empty() ? options.unit : isArray ? "mm/mm" : "mm");
    if (!options.unit.empty())
        map.unit = options.unit;
    if (options.mmPerPixel)
        map.mmPerPixel = options.mmPerPixel;
    else if (place)
        map.mmPerPixel = pitchIn(*place);
    else if (isImage && isOfTheGlass(image))
        map.mmPerPixel = rendering::displayMmPerPixel;
    const std::string kind = isImage ? kindOfImage(image, place) : (map.unit == "mm" ? "height, " : isArray ? "gradient, " : "map, ") + sizeOf(image);
    return {titleOf(file, place), kind, std::move(map)};
}

// ---- traces

std::vector<double> columnOf(const CsvTable& table, std::size_t column)
{
    std::vector<double> values;
    values.reserve(table.rows.size());
    for (const auto& row : table.rows)
        values.push_back(rendering::fabrics::numberIn(row[column]).value_or(nothing));
    return values;
}

std::string joined(const std::vector<std::string>& names)
{
    std::string line;
    for (const std::string& name : names)
        line += (line.empty() ? "" : ", ") + name;
    return line;
}

/// What of the table is friction: tangential over normal force, "mu", or the first column that is neither time nor place.
void takeValues(SeenTrace& trace, const CsvTable& table, const std::string& quantity)
{
    if (!quantity.empty()) {
        const auto column = table.column(quantity);
        if (!column)
            throw protocols::badInput({"has no column " + quantity, table.where, "one of its columns: " + joined(table.columns), ""});
        trace.values = columnOf(table, *column);
        trace.quantity = quantity;
        return;
    }
    const auto normal = table.column("normal_n"), tangential = table.column("tangential_n"), mu = table.column("mu");
    if (normal && tangential) {
        trace.values = columnOf(table, *tangential);
        const auto load = columnOf(table, *normal);
        for (std::size_t i = 0; i < load.size(); ++i)
            trace.values[i] = load[i] > leastNormalN ? trace.values[i] / load[i] : nothing;
        trace.quantity = "coefficient of friction";
        trace.whyMissing = "not in contact";
        return;
    }
    for (std::size_t column = 0; column < table.columns.size(); ++column) {
        const std::string& name = table.columns[column];
        if (name == "t_s" || name == "position_mm" || name.starts_with("time") || (mu && column != *mu))
            continue;
        trace.values = columnOf(table, column);
        trace.quantity = mu ? "coefficient of friction" : name;
        return;
    }
    throw protocols::badInput({"holds no friction", table.where, "t_s,normal_n,tangential_n or t_s,mu or t_s and one named quantity", ""});
}

/// Samples without a place of their own (and what stands out of order) are left out.
void keepRising(SeenTrace& trace)
{
    std::size_t kept = 0;
    for (std::size_t i = 0; i < trace.places.size(); ++i) {
        if (!std::isfinite(trace.places[i]) || (kept > 0 && trace.places[i] <= trace.places[kept - 1]))
            continue;
        trace.places[kept] = trace.places[i];
        trace.values[kept++] = trace.values[i];
    }
    trace.places.resize(kept);
    trace.values.resize(kept);
}

void takePlaces(SeenTrace& trace, const CsvTable& table, std::optional<double> speedMmPerS)
{
    const auto time = table.column("t_s"), position = table.column("position_mm");
    trace.placeUnit = position || (time && speedMmPerS) ? "mm" : time ? "s" : "samples";
    if (position || time)
        trace.places = columnOf(table, position ? *position : *time);
    else
        for (std::size_t i = 0; i < table.rows.size(); ++i)
            trace.places.push_back(static_cast<double>(i));
    if (!position && time && speedMmPerS)
        for (double& place : trace.places)
            place *= *speedMmPerS;
}

SeenSignal readTrace(const fs::path& file, const ReadingOptions& options)
{
    const CsvTable table = rendering::fabrics::readCsvTable(file);
    const auto place = placeOf(file);
    std::optional<double> speed = options.speedMmPerS;
    if (!speed && place)
        speed = place->dataset.friction.speedMmPerS;
    SeenTrace trace;
    takeValues(trace, table, options.quantity);
    takePlaces(trace, table, speed);
    keepRising(trace);
    if (trace.places.empty())
        throw protocols::badInput({"holds no samples", file.string(), "at least one row", ""});
    const double gaps = static_cast<double>(trace.places.size() - 1);
    const double length = trace.places.back() - trace.places.front();
    if (trace.placeUnit == "mm" && length > 0)
        trace.samplesPerMm = gaps / length;
    if (const auto time = table.column("t_s"); time && gaps > 0) {
        const auto times = columnOf(table, *time);
        if (times.back() > times.front())
            trace.sampleRateHz = static_cast<double>(times.size() - 1) / (times.back() - times.front());
    }
    const std::string rate = trace.sampleRateHz ? ", " + figure(*trace.sampleRateHz) + " Hz" : "";
    return {titleOf(file, place), "friction record, " + std::to_string(trace.places.size()) + " samples" + rate, std::move(trace)};
}

}  // namespace

SeenSignal readSignal(const fs::path& file, const ReadingOptions& options)
{
    requireNotOfOpenStudy(file);
    return file.extension() == ".csv" ? readTrace(file, options) : readMap(file, options);
}

SeenSignal seenHeight(const cv::Mat& heightMm, std::optional<double> mmPerPixel, const std::string& title, const std::string& origin)
{
    SeenMap map = mapOfNumbers(heightMm, "mm");
    map.mmPerPixel = mmPerPixel;
    return {title, "height, " + sizeOf(heightMm) + ", " + origin, std::move(map)};
}

}  // namespace study::looking
