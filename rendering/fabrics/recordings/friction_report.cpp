#include "rendering/fabrics/recordings/friction_report.h"

#include <nlohmann/json.hpp>

namespace rendering::fabrics {

namespace {

using nlohmann::ordered_json;

/// Time at the beginning of row `row`; the end of the record after its last row.
double timeAt(const PreparedRecord& prepared, std::size_t row)
{
    return prepared.timeS[std::min(row, prepared.timeS.size() - 1)];
}

struct Cut {
    const char* name;
    RowRange rows;
};

/// Parts around the steady slide, including empty ones.
std::vector<Cut> cutsOf(const PreparedRecord& prepared)
{
    const auto& [contact, steady, why] = prepared.slide;
    return {{"approach", {0, contact.begin}},
            {"breakaway", {contact.begin, steady.begin}},
            {"stop", {steady.end, contact.end}},
            {"after contact", {contact.end, prepared.timeS.size()}}};
}

ordered_json jsonOf(const PreparedRecord& prepared, RowRange rows)
{
    return {{"from_s", timeAt(prepared, rows.begin)}, {"to_s", timeAt(prepared, rows.end)}, {"samples", rows.count()}};
}

ordered_json jsonOf(const std::optional<ForceAxis>& axis)
{
    return axis ? ordered_json((axis->sign < 0 ? "-" : "") + axis->column) : ordered_json("found by name");
}

}  // namespace

std::string describeCuts(const PreparedRecord& prepared)
{
    std::string text;
    if (prepared.zeroRows)
        text += ", zero from " + std::to_string(prepared.zeroRows->count()) + " unloaded samples (normal " +
                fourFigures(prepared.zeroNormalN) + " N)";
    if (prepared.lacksZero) text += ", no zero taken (no unloaded samples found), so any offset of the sensor remains";
    if (prepared.normalReversed) text += ", normal force reversed";
    std::string cuts;
    for (const auto& [name, rows] : cutsOf(prepared))
        if (rows.count() > 0)
            cuts += (cuts.empty() ? "" : ", ") + std::string(name) + " " +
                    fourFigures(timeAt(prepared, rows.end) - timeAt(prepared, rows.begin)) + " s";
    if (!cuts.empty())
        text += ", slide " + fourFigures(timeAt(prepared, prepared.slide.steady.begin)) + " to " +
                fourFigures(timeAt(prepared, prepared.slide.steady.end - 1)) + " s of " + fourFigures(prepared.timeS.back()) +
                " s (" + cuts + " cut)";
    else
        text += prepared.slide.why.empty() ? ", the whole record is the slide" : ", nothing cut (" + prepared.slide.why + ")";
    if (prepared.leftOut > 0) text += ", " + std::to_string(prepared.leftOut) + " samples with too little normal force left out";
    for (const auto& warning : prepared.warnings) text += "; warning: " + warning;
    return text;
}

std::string preparationJson(const RawRecord& record, const FrictionOptions& options, const PreparedRecord& prepared)
{
    ordered_json json{{"schema", "vis2hap.friction-import/1"},
                      {"from", record.where},
                      {"instrument", record.instrument},
                      {"rows", record.timeS.size()},
                      {"quantity", record.normalN.empty() ? record.quantity : "mu"},
                      {"meaning", record.meaning}};
    if (prepared.speedMmPerS) json["speed_mm_per_s"] = *prepared.speedMmPerS;  // readFriction() reads it
    if (!record.normalN.empty()) {
        json["axes"] = {{"normal", jsonOf(options.normal)}, {"tangential", ordered_json::array()}};
        for (const auto& axis : options.tangential) json["axes"]["tangential"].push_back(jsonOf(std::optional(axis)));
        if (options.tangential.empty()) json["axes"]["tangential"] = "found by name";
        json["axes"]["normal_turned"] = prepared.normalReversed;
        json["axes"]["joined"] = !record.secondTangentialN.empty();
        json["zero"] = prepared.zeroRows ? jsonOf(prepared, *prepared.zeroRows) : ordered_json();
        if (prepared.zeroRows) {
            json["zero"]["normal_n"] = prepared.zeroNormalN;
            json["zero"]["tangential_n"] = prepared.zeroTangentialN;
        } else {
            json["why"]["zero"] = options.zero == Selection::None ? "by option" : "no unloaded samples";
        }
    }
    json["slide"] = jsonOf(prepared, prepared.slide.steady);
    json["cut"] = ordered_json::object();
    for (const auto& [name, rows] : cutsOf(prepared))
        if (rows.count() > 0) json["cut"][name] = jsonOf(prepared, rows);
    if (json["cut"].empty() && !prepared.slide.why.empty()) json["why"]["cut"] = prepared.slide.why;
    json["left_out"] = {{"samples", prepared.leftOut}, {"below_share_of_median_load", leastShareOfLoad}};
    json["resampling"] = {
        {"method", prepared.resampling},
        {"rate_hz", 1 / prepared.stepS},
        {"own_step_s",
         {{"median", prepared.base.stepS}, {"smallest", prepared.base.smallestS}, {"largest", prepared.base.largestS}}}};
    json["samples"] = prepared.values.size();
    json["mean"] = prepared.mean;
    json["sd"] = prepared.sd;
    json["warnings"] = prepared.warnings;
    return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) +
           "\n";  // File names may hold bytes that are not UTF-8.
}

}  // namespace rendering::fabrics
