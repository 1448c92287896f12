#include "study/simulation/simulation_cost.h"

#include <chrono>

#include "database/keys.h"
#include "protocols/files/folder_draft.h"
#include "protocols/files/sha256.h"
#include "protocols/files/temporary_folder.h"
#include "protocols/files/whole_file.h"
#include "protocols/orders/counterbalancing.h"
#include "protocols/protocol_json.h"
#include "study/session/stimuli.h"
#include "study/simulation/simulate_through_store.h"
#include "study/simulation/simulation_analysis.h"

namespace study::simulation {

namespace {

constexpr int orders = 10;  // drawn for a study of the paper's size; more places have them again

/// A study of the paper's size, with percepts by chance instead of images.
struct CostStudy {
    std::string protocolJson{protocols::paperProtocolJson()};
    protocols::Protocol protocol = protocols::protocolFromJson(protocolJson, "the paper's protocol");
    std::vector<protocols::FabricId> fabrics;
    protocols::Allocation allocation;

    explicit CostStudy(int places)
    {
        for (int fabric = 1; fabric <= protocol.fabricCount; ++fabric) fabrics.emplace_back("F0" + std::to_string(fabric));
        protocol.participants = orders;
        auto design = drawDesign(protocol, 1);
        for (int place = orders; place < places; ++place) {
            auto list = design.participants[static_cast<std::size_t>(place % orders)];
            design.participants.push_back(std::move(list));
        }
        design.participants.resize(static_cast<std::size_t>(places));
        allocation = allocate(protocol, design, fabrics, protocols::SecretKey::ofSeed(2));
    }
};

players::Percept drawnPercept(protocols::Random& random)
{
    players::Percept percept;
    percept.slipperiness = 0.2 * random.normal();
    for (double& band : percept.texture) band = -1 + 0.2 * random.normal();
    return percept;
}

players::Percepts drawnPercepts(const CostStudy& study)
{
    protocols::Random random(3);
    players::Percepts percepts;
    percepts.stationKey = stationKeyOf(study.allocation.key.secret);
    for (const auto& fabric : study.fabrics) percepts.fabrics[fabric] = drawnPercept(random);
    for (const auto& [code, entry] : study.allocation.key.entries) percepts.stimuli[code] = drawnPercept(random);
    return percepts;
}

/// The folder of the study, with images of one pixel.
void makeFolder(const CostStudy& study, const database::StudyFolder& folder)
{
    protocols::makeFolders(folder.stimuli(), protocols::Sync::Later);
    protocols::writeWholeFile(folder.protocol(), study.protocolJson, protocols::Sync::Later);
    std::map<protocols::FileCode, std::string> hashes;
    const auto station = stationKeyOf(study.allocation.key.secret);
    for (const auto& [code, entry] : study.allocation.key.entries)
        hashes[code] = rendering::writeStimulus(folder.stimuli(), code, cv::Mat(1, 1, CV_8UC1, cv::Scalar(128)), station);
    const auto keys = database::writeKeys(folder, study.allocation.key);
    database::StudyFacts facts;
    facts.name = "cost of simulated participants";
    facts.protocolJson = study.protocolJson;
    facts.protocolSha256 = protocols::sha256(study.protocolJson);
    facts.keySha256 = keys.allocation;
    facts.stationKeySha256 = keys.station;
    facts.plannedBalance = facts.madeWith = facts.signalsJson = "{}";
    facts.fabrics = study.fabrics;
    facts.swatches = study.allocation.swatches;
    database::StudyStore::create(folder, facts, study.allocation.participants, hashes);
}

template <class Work>
double secondsOf(const Work& work)
{
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

double secondsInMemory(int participants)
{
    const CostStudy cost(orders);
    const auto study = memoryStudyOf(cost.protocol, cost.allocation, cost.fabrics, drawnPercepts(cost));
    return secondsOf([&] {
        SimulationRequest request;
        request.count = participants;
        (void)analysisOf(study, simulateInMemory(study, request));
    });
}

double secondsThroughStore(int participants)
{
    const CostStudy cost(participants);
    const protocols::TemporaryFolder place;
    const database::StudyFolder folder{place.path()};
    makeFolder(cost, folder);
    database::StudyStore store(folder, database::StudyStore::Access::Write);
    auto bank = session::stimuliOf(store);
    const auto percepts = drawnPercepts(cost);
    const auto ids = store.nextParticipantIds("SIM", static_cast<std::size_t>(participants));
    return secondsOf([&] { simulateThroughStore(store, bank, percepts, ids, {}); });
}

}  // namespace study::simulation
