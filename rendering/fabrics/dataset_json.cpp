#include "rendering/fabrics/dataset_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "protocols/files/errors.h"
#include "protocols/files/id_rule.h"
#include "protocols/files/strict_json.h"

namespace rendering::fabrics {

namespace {

using nlohmann::json;

/// An object of the file, with its path for faults.
class Fields {
public:
    Fields(const json& object, std::string where, std::string path)
        : m_object(object), m_where(std::move(where)), m_path(std::move(path))
    {
        if (!object.is_object()) throw fault("", "is not an object", "an object");
    }

    const json* find(const char* name) const
    {
        const auto found = m_object.find(name);
        return found == m_object.end() || found->is_null() ? nullptr : &*found;
    }

    const json& needed(const char* name, const char* expected) const
    {
        if (const json* value = find(name)) return *value;
        throw fault(name, "is missing", expected);
    }

    std::string text(const char* name, std::optional<std::string> otherwise = std::nullopt) const
    {
        if (otherwise && !find(name)) return *otherwise;
        const json& value = needed(name, "a string");
        if (!value.is_string()) throw fault(name, "is not a string", "a string");
        return value.get<std::string>();
    }

    std::optional<Fibre> fibre(const char* name) const
    {
        if (!find(name)) return std::nullopt;
        const std::string given = text(name);
        if (const std::optional<Fibre> known = fibreFrom(given)) return known;
        throw fault(name, "is \"" + given + "\"", "null, or one of " + fibreNames());
    }

    std::optional<double> positive(const char* name) const
    {
        const json* value = find(name);
        if (!value) return std::nullopt;
        if (!value->is_number() || !(value->get<double>() > 0) || !(value->get<double>() < 1e9))
            throw fault(name, "is " + value->dump(), "a number above 0, or null");
        return value->get<double>();
    }

    bool yesOrNo(const char* name, bool otherwise = false) const
    {
        const json* value = find(name);
        if (value && !value->is_boolean()) throw fault(name, "is " + value->dump(), "true or false");
        return value ? value->get<bool>() : otherwise;
    }

    protocols::Error fault(const std::string& name, const std::string& what, const std::string& expected) const
    {
        const std::string field = name.empty() ? m_path : m_path.empty() ? name : m_path + "." + name;
        return protocols::badInput(
            {(field.empty() ? "the file" : "\"" + field + "\"") + " " + what, m_where, expected, "correct the file"});
    }

private:
    const json& m_object;
    std::string m_where, m_path;
};

std::vector<FabricInfo> fabricsIn(const Fields& fields, const std::string& where)
{
    const json& list = fields.needed("fabrics", "a list of fabrics");
    if (!list.is_array()) throw fields.fault("fabrics", "is not a list", "a list of fabrics");
    std::vector<FabricInfo> fabrics;
    std::set<std::string> seen;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const Fields entry(list[i], where, "fabrics[" + std::to_string(i) + "]");
        const std::string id = entry.text("id");
        if (const std::string why = protocols::faultOfId(id); !why.empty())
            throw entry.fault("id", "is \"" + id + "\", which " + why, protocols::idRule());
        if (!seen.insert(id).second) throw entry.fault("id", "repeats \"" + id + "\"", "each id once");
        fabrics.push_back({protocols::FabricId(id), entry.text("name", id), entry.text("structure", ""),
                           entry.yesOrNo("surface_in_mm", true), entry.fibre("fibre")});
    }
    return fabrics;
}

FrictionRecording frictionIn(const Fields& fields, const std::string& where)
{
    FrictionRecording recording;
    if (const json* section = fields.find("friction")) {
        const Fields friction(*section, where, "friction");
        recording.sampleRateHz = friction.positive("sample_rate_hz").value_or(recording.sampleRateHz);
        recording.speedMmPerS = friction.positive("speed_mm_per_s").value_or(recording.speedMmPerS);
        recording.lengthMm = friction.positive("length_mm").value_or(recording.lengthMm);
    }
    return recording;
}

void readTactile(const Fields& fields, const std::string& where, Dataset& dataset)
{
    const json* section = fields.find("tactile");
    if (!section) return;
    const Fields tactile(*section, where, "tactile");
    dataset.tactileMmPerPixel = tactile.positive("mm_per_pixel");
    dataset.tactileCalibration = tactile.text("calibration", "");
    if (dataset.tactileCalibration.find_first_of("/\\") != std::string::npos || dataset.tactileCalibration == "..")
        throw tactile.fault("calibration", "is \"" + dataset.tactileCalibration + "\"",
                            "a file name in the data set, or \"known\"");
}

json orNull(const std::optional<double>& value) { return value ? json(*value) : json(nullptr); }

}  // namespace

Dataset datasetFromJson(std::string_view text, const std::string& where)
{
    const json document = protocols::parseStrictJson(text, where);
    const Fields fields(document, where, "");
    if (fields.text("schema") != "vis2hap.dataset/1")
        throw fields.fault("schema", "is \"" + fields.text("schema") + "\"", "\"vis2hap.dataset/1\"");
    Dataset dataset;
    dataset.name = fields.text("name", "");
    dataset.fabrics = fabricsIn(fields, where);
    if (const json* camera = fields.find("camera"))
        dataset.cameraMmPerPixel = Fields(*camera, where, "camera").positive("mm_per_pixel");
    readTactile(fields, where, dataset);
    if (const json* surface = fields.find("surface")) dataset.surfaceIsFree = Fields(*surface, where, "surface").yesOrNo("free");
    dataset.friction = frictionIn(fields, where);
    const std::string pairing = fields.text("pairing", "weak");
    if (pairing != "weak" && pairing != "aligned")
        throw fields.fault("pairing", "is \"" + pairing + "\"", "\"weak\" or \"aligned\"");
    dataset.pairing = pairing == "aligned" ? Pairing::Aligned : Pairing::Weak;
    dataset.procedural = fields.yesOrNo("procedural");
    dataset.licence = fields.text("licence", "");
    return dataset;
}

std::string toJson(const Dataset& dataset)
{
    nlohmann::ordered_json document;
    document["schema"] = "vis2hap.dataset/1";
    document["name"] = dataset.name;
    document["fabrics"] = nlohmann::ordered_json::array();
    for (const FabricInfo& fabric : dataset.fabrics) {
        nlohmann::ordered_json entry;
        entry["id"] = fabric.id.value;
        entry["name"] = fabric.name;
        entry["structure"] = fabric.structure;
        if (!fabric.surfaceInMm) entry["surface_in_mm"] = false;
        if (fabric.fibre) entry["fibre"] = nameOf(*fabric.fibre);
        document["fabrics"].push_back(entry);
    }
    document["camera"]["mm_per_pixel"] = orNull(dataset.cameraMmPerPixel);
    document["tactile"]["mm_per_pixel"] = orNull(dataset.tactileMmPerPixel);
    document["tactile"]["calibration"] = dataset.tactileCalibration.empty() ? json(nullptr) : json(dataset.tactileCalibration);
    if (dataset.surfaceIsFree) document["surface"]["free"] = true;
    document["friction"]["sample_rate_hz"] = dataset.friction.sampleRateHz;
    document["friction"]["speed_mm_per_s"] = dataset.friction.speedMmPerS;
    document["friction"]["length_mm"] = dataset.friction.lengthMm;
    document["pairing"] = dataset.pairing == Pairing::Aligned ? "aligned" : "weak";
    document["procedural"] = dataset.procedural;
    document["licence"] = dataset.licence;
    return document.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace rendering::fabrics
