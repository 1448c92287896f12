#include "study/analyse/power/kept_counts.h"

#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"
#include "study/analyse/power/count_json.h"

namespace study::analyse {

namespace {

using nlohmann::ordered_json;

constexpr const char* countsSchema = "vis2hap.power-counts/1";

ordered_json settingsOf(const stats::StudyDesign& design, const stats::RatingTruth& ratings,
                        const stats::SimulationOptions& simulation)
{
    ordered_json json{{"participants", design.participants},
                      {"fabrics", design.fabrics},
                      {"conditions", design.conditions},
                      {"alternatives", design.alternatives},
                      {"scale", {ratings.scaleMin, ratings.scaleMax, ratings.scaleStep}},
                      {"studies", simulation.studies},
                      {"seed", simulation.seed}};
    if (!simulation.share.isAll()) json["share"] = {simulation.share.part, simulation.share.parts};
    return json;
}

constexpr const char* anotherFile = "name another file after --resume";

}  // namespace

KeptCounts::KeptCounts(std::filesystem::path file)
    : m_file(std::move(file)), m_root(std::make_shared<ordered_json>(ordered_json{{"schema", countsSchema}}))
{
    if (std::filesystem::exists(m_file))
        *m_root = protocols::parseStrictOrderedJson(protocols::readWholeFile(m_file, protocols::largestJson), m_file.string());
    if (!m_root->is_object() || m_root->value("schema", ordered_json()) != countsSchema)
        throw protocols::badInput({"the file holds no counts of simulated studies", m_file.string(),
                                   std::string("a file with the schema ") + countsSchema, anotherFile});
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
        throw protocols::badInput(
            {"the counts of \"" + kind + "\" are damaged", m_file.string(), "counts as this program writes them", anotherFile});
    // Another program may have written the file with its keys in another order.
    const auto isSame = [&](const ordered_json& earlier) {
        return nlohmann::json::parse(earlier.dump()) == nlohmann::json::parse(settings.dump());
    };
    if (!counted.is_object() || !isSame(counted.value("settings", ordered_json())) || !counted.contains("finished"))
        throw protocols::badInput({"\"" + kind + "\" was counted with other settings", m_file.string(),
                                   "the same protocol, number of participants, number of studies and seed", anotherFile});
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
    options.counted = [&kept](const std::string& truth, std::size_t studies) {
        auto counts = rejectionsFrom(kept.of(kind, truth), truth, anotherFile);
        requireStudies(counts, studies, truth, anotherFile);
        return counts;
    };
    options.finished = [&kept](const std::string& truth, const std::vector<stats::Rejections>& counts) {
        kept.add(kind, truth, jsonOf(counts));
    };
}

void resumeFrom(KeptCounts& kept, stats::PlantedOptions& options)
{
    constexpr const char* kind = "planted";
    ordered_json settings = settingsOf(options.design, options.ratings, options.simulation);
    settings["contrasts"] = options.contrasts;
    kept.require(kind, settings);
    options.counted = [&kept](const std::string& truth, std::size_t studies) {
        auto counts = plantedRowsFrom(kept.of(kind, truth), truth, anotherFile);
        requireStudies(counts, studies, truth, anotherFile);
        return counts;
    };
    options.finished = [&kept](const std::string& truth, const std::vector<stats::PlantedRow>& rows) {
        kept.add(kind, truth, jsonOf(rows));
    };
}

}  // namespace study::analyse
