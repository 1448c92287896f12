#include "study/analyse/power/kept_counts.h"

#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"

namespace study::analyse {

namespace {

using nlohmann::ordered_json;

constexpr const char* countsSchema = "vis2hap.power-counts/1";

ordered_json settingsOf(const stats::StudyDesign& design, const stats::RatingTruth& ratings,
                        const stats::SimulationOptions& simulation)
{
    return {{"participants", design.participants},
            {"fabrics", design.fabrics},
            {"conditions", design.conditions},
            {"alternatives", design.alternatives},
            {"scale", {ratings.scaleMin, ratings.scaleMax, ratings.scaleStep}},
            {"studies", simulation.studies},
            {"seed", simulation.seed}};
}

ordered_json jsonOf(const stats::StudyMean& mean) { return {mean.studies, mean.sum, mean.sumOfSquares}; }

protocols::Error damagedCounts(const std::string& truth)
{
    return protocols::badInput(
        {"the counts are damaged", truth, "counts as this program writes them", "name another file after --resume"});
}

/// A count of studies; fails for a negative number and for a fraction.
std::size_t countAt(const ordered_json& json, std::size_t place)
{
    return json.at(place).get_ref<const ordered_json::number_unsigned_t&>();
}

/// The counts that `read` takes from JSON. Throws badInput where they are not as add() writes them.
template <class Read>
auto countsFrom(const ordered_json& json, const std::string& truth, const Read& read)
{
    std::vector<decltype(read(json))> counts;
    try {
        for (const ordered_json& one : json) counts.push_back(read(one));
    } catch (const ordered_json::exception&) {
        throw damagedCounts(truth);
    }
    return counts;
}

stats::StudyMean studyMeanOf(const ordered_json& json)
{
    return {countAt(json, 0), json.at(1).get<double>(), json.at(2).get<double>()};
}

}  // namespace

KeptCounts::KeptCounts(std::filesystem::path file)
    : m_file(std::move(file)), m_root(std::make_shared<ordered_json>(ordered_json{{"schema", countsSchema}}))
{
    if (std::filesystem::exists(m_file))
        *m_root = protocols::parseStrictOrderedJson(protocols::readWholeFile(m_file), m_file.string());
    if (!m_root->is_object() || m_root->value("schema", ordered_json()) != countsSchema)
        throw protocols::badInput({"the file holds no counts of simulated studies", m_file.string(),
                                   std::string("a file with the schema ") + countsSchema, "name another file after --resume"});
    protocols::requireWritable(m_file);
}

void KeptCounts::require(const std::string& kind, const ordered_json& settings)
{
    if (!m_root->contains(kind)) {
        (*m_root)[kind] = {{"settings", settings}, {"finished", ordered_json::object()}};
        return;
    }
    const ordered_json& counted = m_root->at(kind);
    if (counted.is_object() && counted.contains("finished") && !counted.at("finished").is_object())
        throw protocols::badInput({"the counts of \"" + kind + "\" are damaged", m_file.string(),
                                   "counts as this program writes them", "name another file after --resume"});
    // Another program may have written the file with its keys in another order.
    const auto isSame = [&](const ordered_json& earlier) {
        return nlohmann::json::parse(earlier.dump()) == nlohmann::json::parse(settings.dump());
    };
    if (!counted.is_object() || !isSame(counted.value("settings", ordered_json())) || !counted.contains("finished"))
        throw protocols::badInput({"\"" + kind + "\" was counted with other settings", m_file.string(),
                                   "the same protocol, number of participants, number of studies and seed",
                                   "name another file after --resume"});
}

ordered_json KeptCounts::of(const std::string& kind, const std::string& truth) const
{
    return m_root->at(kind).at("finished").value(truth, ordered_json());
}

void KeptCounts::add(const std::string& kind, const std::string& truth, const ordered_json& counts)
{
    (*m_root)[kind]["finished"][truth] = counts;
    protocols::writeWholeFile(m_file, m_root->dump(1) + "\n");
}

void resumeFrom(KeptCounts& kept, stats::CalibrationOptions& options)
{
    constexpr const char* kind = "calibrate";
    kept.require(kind, settingsOf(options.design, options.ratings, options.simulation));
    options.counted = [&kept](const std::string& truth) {
        auto counts = countsFrom(kept.of(kind, truth), truth, [](const ordered_json& one) {
            return stats::Rejections{countAt(one, 0), countAt(one, 1), countAt(one, 2)};
        });
        for (const stats::Rejections& one : counts)
            if (one.rejected > one.studies || one.undefined > one.studies - one.rejected) throw damagedCounts(truth);
        return counts;
    };
    options.finished = [&kept](const std::string& truth, const std::vector<stats::Rejections>& counts) {
        ordered_json json = ordered_json::array();
        for (const stats::Rejections& one : counts) json.push_back({one.studies, one.rejected, one.undefined});
        kept.add(kind, truth, json);
    };
}

void resumeFrom(KeptCounts& kept, stats::PlantedOptions& options)
{
    constexpr const char* kind = "planted";
    ordered_json settings = settingsOf(options.design, options.ratings, options.simulation);
    settings["contrasts"] = options.contrasts;
    kept.require(kind, settings);
    options.counted = [&kept](const std::string& truth) {
        return countsFrom(kept.of(kind, truth), truth, [](const ordered_json& row) {
            return stats::PlantedRow{row.at("name").get<std::string>(), row.at("coverage").get<bool>(),
                                     studyMeanOf(row.at("these")),      studyMeanOf(row.at("alike")),
                                     studyMeanOf(row.at("reference")),  studyMeanOf(row.at("difference"))};
        });
    };
    options.finished = [&kept](const std::string& truth, const std::vector<stats::PlantedRow>& rows) {
        ordered_json json = ordered_json::array();
        for (const stats::PlantedRow& row : rows)
            json.push_back({{"name", row.name},
                            {"coverage", row.isCoverage},
                            {"these", jsonOf(row.these)},
                            {"alike", jsonOf(row.alike)},
                            {"reference", jsonOf(row.reference)},
                            {"difference", jsonOf(row.alikeMinusReference)}});
        kept.add(kind, truth, json);
    };
}

}  // namespace study::analyse
