#include "rendering/cache/packed_result.h"

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/strict_json.h"
#include "protocols/json_count.h"

namespace rendering::cache {

namespace {

constexpr int largestSide = 1 << 24;
constexpr int mostTypes = CV_MAKETYPE(CV_16F, CV_CN_MAX);

/// Throws nlohmann's exceptions for other fields.
std::optional<cv::Mat> arrayFrom(const nlohmann::json& shape, std::string_view& bytes)
{
    using protocols::wholeOf;
    const int rows = wholeOf<int>(shape.at(0)), columns = wholeOf<int>(shape.at(1)), type = wholeOf<int>(shape.at(2));
    if (rows == 0 || columns == 0) return cv::Mat();
    if (rows < 0 || columns < 0 || rows > largestSide || columns > largestSide || type < 0 || type > mostTypes)
        return std::nullopt;
    const std::uint64_t needed = static_cast<std::uint64_t>(rows) * static_cast<std::uint64_t>(columns) * CV_ELEM_SIZE(type);
    if (needed > bytes.size()) return std::nullopt;
    cv::Mat array(rows, columns, type);
    std::memcpy(array.data, bytes.data(), needed);
    bytes.remove_prefix(needed);
    return array;
}

}  // namespace

std::string packed(const PackedResult& result)
{
    nlohmann::json head{{"facts", nlohmann::json::parse(result.factsJson)}, {"arrays", nlohmann::json::array()}};
    for (const cv::Mat& array : result.arrays) head["arrays"].push_back({array.rows, array.cols, array.type()});
    std::string bytes = head.dump() + "\n";
    for (const cv::Mat& array : result.arrays) {
        const cv::Mat whole = array.isContinuous() ? array : array.clone();
        if (!whole.empty()) bytes.append(reinterpret_cast<const char*>(whole.data), whole.total() * whole.elemSize());
    }
    return bytes;
}

std::optional<PackedResult> unpacked(std::string_view bytes)
{
    const auto end = bytes.find('\n');
    if (end == std::string_view::npos) return std::nullopt;
    try {
        const auto head = protocols::parseStrictJson(bytes.substr(0, end), "a kept result");
        bytes.remove_prefix(end + 1);
        PackedResult result{head.at("facts").dump(), {}};
        for (const auto& shape : head.at("arrays")) {
            auto array = arrayFrom(shape, bytes);
            if (!array) return std::nullopt;
            result.arrays.push_back(*array);
        }
        return result;
    } catch (const nlohmann::json::exception&) {
        return std::nullopt;
    } catch (const protocols::Error&) {
        return std::nullopt;
    }
}

}  // namespace rendering::cache
