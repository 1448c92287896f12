#include "study/bench/bench_study.h"

#include <map>
#include <opencv2/core.hpp>

#include "database/keys.h"
#include "database/study_store.h"
#include "protocols/files/sha256.h"
#include "protocols/files/whole_file.h"
#include "protocols/orders/allocation.h"
#include "protocols/protocol_json.h"
#include "rendering/display/stimulus_bank.h"
#include "study/session/preparation.h"
#include "study/session/stimuli.h"

namespace study::bench {

database::StudyFolder makeConstantStudy(const std::filesystem::path& path, const std::string& protocolJson,
                                        protocols::Design (*draw)(const protocols::Protocol&), const cv::Mat& image)
{
    const database::StudyFolder folder{path};
    std::filesystem::create_directories(folder.stimuli());
    protocols::writeWholeFile(folder.protocol(), protocolJson, protocols::Sync::Later);
    const auto protocol = protocols::protocolFromJson(protocolJson, "bench");
    database::StudyFacts facts;
    for (int fabric = 1; fabric <= protocol.fabricCount; ++fabric) facts.fabrics.emplace_back("F" + std::to_string(100 + fabric));
    const auto allocation = allocate(protocol, draw(protocol), facts.fabrics, protocols::SecretKey::ofSeed(2));
    std::map<protocols::FileCode, std::string> hashes;
    for (const auto& [code, entry] : allocation.key.entries)
        hashes[code] = rendering::writeStimulus(folder.stimuli(), code, image, stationKeyOf(allocation.key.secret));
    const auto keys = database::writeKeys(folder, allocation.key);
    facts.name = "bench";
    facts.protocolJson = protocolJson;
    facts.protocolSha256 = protocols::sha256(protocolJson);
    facts.keySha256 = keys.allocation;
    facts.stationKeySha256 = keys.station;
    facts.plannedBalance = facts.madeWith = "{}";
    facts.swatches = allocation.swatches;
    facts.signalsJson = "{}";
    database::StudyStore::create(folder, facts, allocation.participants, hashes);
    return folder;
}

database::StudyFolder makeConstantStudy(const std::filesystem::path& path, const std::string& protocolJson)
{
    return makeConstantStudy(
        path, protocolJson, [](const protocols::Protocol& protocol) { return protocols::drawDesign(protocol, 1); },
        cv::Mat(1, 1, CV_8UC1, cv::Scalar(128)));
}

}  // namespace study::bench
