#include "tests/support/study_builder.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "database/keys.h"
#include "database/study_store.h"
#include "protocols/files/sha256.h"
#include "protocols/orders/allocation.h"
#include "protocols/orders/counterbalancing.h"
#include "protocols/protocol_json.h"
#include "protocols/records/balance.h"
#include "rendering/display/stimulus_bank.h"

namespace tests::support {

namespace {

std::vector<protocols::FabricId> fabricsOf(const StudyRecipe& recipe)
{
    std::vector<protocols::FabricId> fabrics(recipe.fabricIds.begin(), recipe.fabricIds.end());
    if (!fabrics.empty()) return fabrics;
    for (int number = 1; number <= recipe.fabrics; ++number)
        fabrics.emplace_back((number < 10 ? "F0" : "F") + std::to_string(number));
    return fabrics;
}

rendering::StimulusHashes writeStimuli(const database::StudyFolder& folder, const protocols::AllocationKey& key,
                                       const StudyRecipe& recipe)
{
    std::filesystem::create_directory(folder.stimuli());
    rendering::StimulusHashes hashes;
    int number = 0;
    for (const auto& [code, entry] : key.entries) {
        const int grey = 10 * ++number + (recipe.keyNames.empty() ? 0 : 5);
        const cv::Mat image(recipe.imageHeightPx, recipe.imageWidthPx, CV_8UC1, cv::Scalar(grey % 256));
        hashes[code] = rendering::writeStimulus(folder.stimuli(), code, image, stationKeyOf(key.secret));
    }
    return hashes;
}

}  // namespace

std::string protocolText(const StudyRecipe& recipe)
{
    if (!recipe.protocol.empty()) return recipe.protocol;
    nlohmann::ordered_json fabrics = nlohmann::ordered_json::array();
    for (const protocols::FabricId& fabric : fabricsOf(recipe)) fabrics.push_back(fabric.value);
    const nlohmann::ordered_json phases = {
        {{"questions", {"Q1"}}, {"alternatives", recipe.alternatives}},
        {{"questions", {"Q2", "Q3", "Q4"}}, {"scale", {{"min", 0}, {"max", 10}, {"step", 0.1}, {"sections", 9}}}}};
    const nlohmann::ordered_json protocol = {{"schema", "vis2hap.protocol/1"},
                                             {"name", "Small study"},
                                             {"participants", recipe.participants},
                                             {"fabrics", fabrics},
                                             {"conditions", recipe.conditions},
                                             {"phases", phases},
                                             {"seconds_per_presentation", 30},
                                             {"break_after", recipe.breakAfter},
                                             {"dead_time_seconds", recipe.deadTimeSeconds},
                                             {"confirm_pieces", recipe.confirmPieces}};
    return protocol.dump(2);
}

database::StudyFolder buildStudy(const std::filesystem::path& path, const StudyRecipe& recipe)
{
    const database::StudyFolder folder{path};
    std::filesystem::create_directory(path);
    const std::string text = protocolText(recipe);
    std::ofstream(folder.protocol(), std::ios::binary) << text;
    const protocols::Protocol protocol = protocols::protocolFromJson(text, "small study");
    const auto fabrics = fabricsOf(recipe);
    const auto secret = protocols::SecretKey::ofSeed(recipe.keySeed);
    const auto design = protocols::drawDesign(protocol, designSeedOf(secret, recipe.designSeed));
    auto allocation = protocols::allocate(protocol, design, fabrics, secret, recipe.familiarisationImages);
    for (auto& [code, entry] : allocation.key.entries)
        if (const auto other = recipe.keyNames.find(entry.condition.value); other != recipe.keyNames.end())
            entry.condition = protocols::ConditionId(other->second);
    const database::KeyHashes keys = database::writeKeys(folder, allocation.key, recipe.passphrase);

    database::StudyFacts facts;
    facts.name = protocol.name;
    facts.protocolJson = text;
    facts.protocolSha256 = protocols::sha256(text);
    facts.designSeed = recipe.designSeed;
    facts.keySha256 = keys.allocation;
    facts.stationKeySha256 = keys.station;
    facts.hasPassphrase = recipe.passphrase.has_value();
    facts.plannedBalance = jsonOf(balanceOf(design, protocol)).dump();
    facts.madeWith = "{}";
    facts.datasetProcedural = true;
    facts.fabrics = fabrics;
    for (const protocols::FabricId& fabric : fabrics) facts.fabricNames[fabric] = "fabric " + fabric.value.substr(1);
    if (recipe.hasSwatchCodes) facts.swatches = allocation.swatches;
    for (const protocols::FileCode& code : allocation.familiarisation)
        facts.familiarisation.push_back(
            {"known fabric " + std::to_string(facts.familiarisation.size() + 1), sealed(code, stationKeyOf(secret))});
    facts.signalsJson = "{}";
    facts.createdAt = "2000-01-01T00:00:00.000Z";
    facts.programVersion = "test";
    auto hashes = writeStimuli(folder, allocation.key, recipe);
    const cv::Mat black = cv::Mat::zeros(recipe.imageHeightPx, recipe.imageWidthPx, CV_8UC1);
    for (const protocols::FileCode& code : allocation.familiarisation)
        hashes[code] = rendering::writeStimulus(folder.stimuli(), code, black, stationKeyOf(secret));
    database::StudyStore::create(folder, facts, allocation.participants, hashes);
    return folder;
}

}  // namespace tests::support
