#include "study/analyse/power/count_json.h"

#include <nlohmann/json.hpp>

namespace study::analyse {

namespace {

using nlohmann::ordered_json;

ordered_json jsonOfMean(const stats::StudyMean& mean)
{
    ordered_json json{mean.studies, mean.sum, mean.sumOfSquares};
    if (mean.each != 1) json.push_back(mean.each);
    return json;
}

/// More than any run makes; sums of such counts stay whole numbers.
constexpr std::size_t mostStudies = 1'000'000'000'000;

/// A count of studies; fails for a negative number, a fraction and more than mostStudies.
std::size_t countAt(const ordered_json& json, std::size_t place)
{
    const std::size_t count = json.at(place).get_ref<const ordered_json::number_unsigned_t&>();
    if (count > mostStudies) throw ordered_json::other_error::create(501, "impossible counts", nullptr);
    return count;
}

stats::StudyMean studyMeanOf(const ordered_json& json)
{
    stats::StudyMean mean{countAt(json, 0), json.at(1).get<double>(), json.at(2).get<double>(),
                          json.size() > 3 ? countAt(json, 3) : 1};
    if (mean.each == 0 || json.size() > 4) throw ordered_json::other_error::create(501, "impossible counts", nullptr);
    return mean;
}

/// What `read` takes from each element. Throws damagedCounts() where they are not as they are written.
template <class Read>
auto countsFrom(const ordered_json& json, const std::string& truth, const std::string& nextStep, const Read& read)
{
    std::vector<decltype(read(json))> counts;
    try {
        for (const ordered_json& one : json) counts.push_back(read(one));
    } catch (const ordered_json::exception&) {
        throw damagedCounts(truth, nextStep);
    }
    return counts;
}

void requireSame(std::size_t counted, std::size_t studies, const std::string& truth, const std::string& nextStep)
{
    if (counted != studies)
        throw protocols::badInput({"the counts are those of " + std::to_string(counted) + " studies", truth,
                                   "counts of " + std::to_string(studies) + " studies, as the run has", nextStep});
}

}  // namespace

void requireStudies(const std::vector<stats::Rejections>& counts, std::size_t studies, const std::string& truth,
                    const std::string& nextStep)
{
    for (const stats::Rejections& one : counts) requireSame(one.studies, studies, truth, nextStep);
}

void requireStudies(const std::vector<stats::PlantedRow>& rows, std::size_t studies, const std::string& truth,
                    const std::string& nextStep)
{
    for (const stats::PlantedRow& row : rows)
        for (const stats::StudyMean* mean : {&row.these, &row.alike, &row.reference, &row.alikeMinusReference})
            requireSame(mean->studies, studies, truth, nextStep);
}

protocols::Error damagedCounts(const std::string& truth, const std::string& nextStep)
{
    return protocols::badInput({"the counts are damaged", truth, "counts as this program writes them", nextStep});
}

ordered_json jsonOf(const std::vector<stats::Rejections>& counts)
{
    ordered_json json = ordered_json::array();
    for (const stats::Rejections& one : counts) json.push_back({one.studies, one.rejected, one.undefined});
    return json;
}

std::vector<stats::Rejections> rejectionsFrom(const ordered_json& json, const std::string& truth, const std::string& nextStep)
{
    auto counts = countsFrom(json, truth, nextStep, [](const ordered_json& one) {
        return stats::Rejections{countAt(one, 0), countAt(one, 1), countAt(one, 2)};
    });
    for (const stats::Rejections& one : counts)
        if (one.rejected > one.studies || one.undefined > one.studies - one.rejected) throw damagedCounts(truth, nextStep);
    return counts;
}

ordered_json jsonOf(const std::vector<stats::PlantedRow>& rows)
{
    ordered_json json = ordered_json::array();
    for (const stats::PlantedRow& row : rows)
        json.push_back({{"name", row.name},
                        {"coverage", row.isCoverage},
                        {"these", jsonOfMean(row.these)},
                        {"alike", jsonOfMean(row.alike)},
                        {"reference", jsonOfMean(row.reference)},
                        {"difference", jsonOfMean(row.alikeMinusReference)}});
    return json;
}

std::vector<stats::PlantedRow> plantedRowsFrom(const ordered_json& json, const std::string& truth, const std::string& nextStep)
{
    return countsFrom(json, truth, nextStep, [](const ordered_json& row) {
        return stats::PlantedRow{row.at("name").get<std::string>(), row.at("coverage").get<bool>(),
                                 studyMeanOf(row.at("these")),      studyMeanOf(row.at("alike")),
                                 studyMeanOf(row.at("reference")),  studyMeanOf(row.at("difference"))};
    });
}

}  // namespace study::analyse
