#include "study/analyse/power/shared_counts.h"

#include <nlohmann/json.hpp>

#include "study/analyse/power/count_json.h"

namespace study::analyse {

namespace {

using nlohmann::ordered_json;

constexpr const char* countAgain = "run this shard again";

protocols::Error otherStudies(const std::string& studies, const std::string& where)
{
    return protocols::badInput({"a shard holds counts of other studies (" + studies + ")", where,
                                "the same studies and tests in every shard", countAgain});
}

void addTo(stats::Rejections& sum, const stats::Rejections& part)
{
    sum.studies += part.studies;
    sum.rejected += part.rejected;
    sum.undefined += part.undefined;
}

void addTo(stats::StudyMean& sum, const stats::StudyMean& part)
{
    sum.studies += part.studies;
    sum.sum += part.sum;
    sum.sumOfSquares += part.sumOfSquares;
}

void addTo(stats::PlantedRow& sum, const stats::PlantedRow& part)
{
    addTo(sum.these, part.these);
    addTo(sum.alike, part.alike);
    addTo(sum.reference, part.reference);
    addTo(sum.alikeMinusReference, part.alikeMinusReference);
}

bool isOfSame(const stats::Rejections&, const stats::Rejections&) { return true; }

bool isOfSame(const stats::PlantedRow& a, const stats::PlantedRow& b)
{
    return a.name == b.name && a.isCoverage == b.isCoverage && a.these.each == b.these.each && a.alike.each == b.alike.each &&
           a.reference.each == b.reference.each && a.alikeMinusReference.each == b.alikeMinusReference.each;
}

template <class Count>
void addAll(std::map<std::string, std::vector<Count>>& sum, const std::map<std::string, std::vector<Count>>& part,
            const std::string& where)
{
    if (sum.size() != part.size()) throw otherStudies(std::to_string(part.size()) + " kinds", where);
    for (const auto& [studies, counts] : part) {
        const auto found = sum.find(studies);
        if (found == sum.end() || found->second.size() != counts.size()) throw otherStudies(studies, where);
        for (std::size_t i = 0; i < counts.size(); ++i) {
            if (!isOfSame(found->second[i], counts[i])) throw otherStudies(studies, where);
            addTo(found->second[i], counts[i]);
        }
    }
}

template <class Count>
ordered_json jsonOfAll(const std::map<std::string, std::vector<Count>>& all)
{
    ordered_json json = ordered_json::object();
    for (const auto& [studies, counts] : all) json[studies] = jsonOf(counts);
    return json;
}

const ordered_json& objectIn(const ordered_json& values, const char* key, const std::string& where)
{
    if (!values.is_object() || !values.contains(key) || !values.at(key).is_object())
        throw protocols::badInput({"a shard lacks the counts \"" + std::string(key) + "\"", where,
                                   "counts as `vis2hap power` writes them", countAgain});
    return values.at(key);
}

/// The counts of these studies, which are of `wanted` studies each.
template <class Count>
std::vector<Count> countsOf(const std::map<std::string, std::vector<Count>>& all, const std::string& studies, std::size_t wanted)
{
    const auto found = all.find(studies);
    if (found == all.end())
        throw protocols::badInput({"the shards hold no counts of these studies", studies, "shards of this version of the program",
                                   "run the shards again"});
    requireStudies(found->second, wanted, studies, "run the shards again");
    return found->second;
}

template <class Counts, class Options>
void recordAll(Counts& counts, Options& options)
{
    if (options.counted)
        options.counted = [&counts, earlier = options.counted](const std::string& studies, std::size_t wanted) {
            auto found = earlier(studies, wanted);
            if (!found.empty()) counts[studies] = found;
            return found;
        };
    options.finished = [&counts, earlier = options.finished](const std::string& studies, const auto& made) {
        counts[studies] = made;
        if (earlier) earlier(studies, made);
    };
}

template <class Counts, class Options>
void takeAll(const Counts& counts, Options& options)
{
    options.counted = [&counts](const std::string& studies, std::size_t wanted) { return countsOf(counts, studies, wanted); };
}

}  // namespace

void SharedCounts::add(const SharedCounts& part, const std::string& where)
{
    addAll(planned, part.planned, where);
    addAll(calibrated, part.calibrated, where);
    addAll(planted, part.planted, where);
}

ordered_json jsonOf(const SharedCounts& counts)
{
    return {{"planned", jsonOfAll(counts.planned)},
            {"calibrated", jsonOfAll(counts.calibrated)},
            {"planted", jsonOfAll(counts.planted)}};
}

SharedCounts sharedCountsFrom(const ordered_json& values, const std::string& where)
{
    SharedCounts counts;
    for (const auto& [studies, json] : objectIn(values, "planned", where).items())
        counts.planned[studies] = rejectionsFrom(json, where, countAgain);
    for (const auto& [studies, json] : objectIn(values, "calibrated", where).items())
        counts.calibrated[studies] = rejectionsFrom(json, where, countAgain);
    for (const auto& [studies, json] : objectIn(values, "planted", where).items())
        counts.planted[studies] = plantedRowsFrom(json, where, countAgain);
    return counts;
}

void recordIn(SharedCounts& counts, stats::PowerOptions& options) { recordAll(counts.planned, options); }
void recordIn(SharedCounts& counts, stats::CalibrationOptions& options) { recordAll(counts.calibrated, options); }
void recordIn(SharedCounts& counts, stats::PlantedOptions& options) { recordAll(counts.planted, options); }

void takeFrom(const SharedCounts& counts, stats::PowerOptions& options) { takeAll(counts.planned, options); }
void takeFrom(const SharedCounts& counts, stats::CalibrationOptions& options) { takeAll(counts.calibrated, options); }
void takeFrom(const SharedCounts& counts, stats::PlantedOptions& options) { takeAll(counts.planted, options); }

}  // namespace study::analyse
