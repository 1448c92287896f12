#include "study/photographs/photograph_protocol.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"
#include "protocols/protocol_json.h"
#include "protocols/usual_texts.h"
#include "rendering/fabrics/dataset.h"

namespace study::photographs {

namespace {

namespace fs = std::filesystem;

int mostAlternativesOf(const nlohmann::ordered_json& protocol)
{
    int most = 1;
    for (const auto& phase : protocol.at("phases")) most = std::max(most, phase.value("alternatives", 1));
    return most;
}

}  // namespace

std::string photographProtocol(const std::vector<std::string>& conditions, int fabrics, const std::string& language)
{
    auto protocol = nlohmann::ordered_json::parse(protocols::paperProtocolIn(language));
    if (const int needed = mostAlternativesOf(protocol); fabrics < needed)
        throw protocols::badInput({"the data set has too few fabrics for the paper's questions",
                                   std::to_string(fabrics) + " fabrics", std::to_string(needed) + " or more",
                                   "add photographs, or make a new study with a protocol of your own"});
    const auto isKept = [&](const nlohmann::ordered_json& condition) {
        return std::find(conditions.begin(), conditions.end(), condition.get<std::string>()) != conditions.end();
    };
    protocol["name"] = "Study of photographs";
    protocol["fabrics"] = std::min(fabrics, protocol.at("fabrics").get<int>());
    protocol["conditions"] = conditions;
    auto planned = nlohmann::ordered_json::array();
    for (const auto& pair : protocol.at("planned"))
        if (isKept(pair.at(0)) && isKept(pair.at(1))) planned.push_back(pair);
    protocol["planned"] = planned;
    if (planned.empty()) protocol.erase("planned");
    if (!isKept(protocol.at("primary").at(0)) || !isKept(protocol.at("primary").at(1))) protocol.erase("primary");
    const std::string text = protocol.dump(2) + "\n";
    protocols::protocolFromJson(text, "the protocol of the photographs");
    return text;
}

fs::path writePhotographProtocol(const fs::path& dataset, const std::vector<std::string>& conditions, const std::string& language)
{
    const auto fabrics = rendering::fabrics::readDataset(dataset).fabrics.size();
    const std::string text = photographProtocol(conditions, static_cast<int>(fabrics), language);
    fs::path file = dataset.string() + "-protocol.json";
    std::error_code unknown;
    for (int number = 2; fs::exists(fs::symlink_status(file, unknown)); ++number) {
        if (fs::is_regular_file(file, unknown) && protocols::readWholeFile(file) == text) return file;
        file = dataset.string() + "-protocol-" + std::to_string(number) + ".json";
    }
    protocols::writeWholeFile(file, text);
    return file;
}

}  // namespace study::photographs
