// Instructions of blocks: how a protocol asks for speed, accuracy or a deadline, and how the running orders carry them.
#include <QTest>
#include <map>
#include <set>
#include <tuple>

#include "protocols/files/whole_file.h"
#include "protocols/orders/allocation.h"
#include "protocols/orders/counterbalancing.h"
#include "protocols/orders/running_orders.h"
#include "protocols/protocol_json.h"
#include "protocols/records/balance.h"

using namespace protocols;

namespace {

std::string protocolWith(const std::string& instructions, int participants = 12)
{
    return R"({"schema": "vis2hap.protocol/1", "name": "Trade", "participants": )" + std::to_string(participants) +
           R"(, "fabrics": 4, "conditions": ["v_grey", "h&f"],
               "phases": [{"questions": ["Q1"], "alternatives": 3)" +
           instructions + R"(}, {"questions": ["Q2"], "scale": {"min": 0, "max": 10}}], "break_after": 5})";
}

constexpr const char* three = R"(, "instructions": [{"id": "speed", "aim": "speed"}, {"id": "accuracy", "aim": "accuracy"},
                                                    {"id": "deadline", "deadline_seconds": 2.5}])";

Protocol instructed(int participants = 12) { return protocolFromJson(protocolWith(three, participants), "test"); }

std::string faultsIn(const std::string& instructions)
{
    try {
        protocolFromJson(protocolWith(instructions), "test");
    } catch (const std::exception& fault) {
        return fault.what();
    }
    return "";
}

/// The instructions of a participant's first phase in their order.
std::vector<int> orderOf(const std::vector<DesignTrial>& trials)
{
    std::vector<int> order;
    for (const DesignTrial& trial : trials)
        if (trial.phase == 0 && (order.empty() || order.back() != trial.instruction.value())) order.push_back(*trial.instruction);
    return order;
}

}  // namespace

class InstructionsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void usualSentencesAreSaid()
    {
        const auto protocol = instructed();
        const auto& instructions = protocol.phases[0].instructions;
        QCOMPARE(instructions.size(), std::size_t(3));
        QVERIFY(instructions[0].aim == SpeedAim::Speed && instructions[0].text.starts_with("Answer as fast as you can."));
        QVERIFY(instructions[1].text.starts_with("Answer as accurately as you can."));
        QCOMPARE(instructions[2].text, std::string("Answer within 2.5 seconds after your finger touches the screen."));
        QCOMPARE(instructions[2].deadlineSeconds, std::optional(2.5));
        const auto own = protocolFromJson(protocolWith(R"(, "instructions": [{"id": "go", "text": "Go!"}])"), "test");
        QCOMPARE(own.phases[0].instructions[0].text, std::string("Go!"));
        QCOMPARE(own.phases[0].runs(), 1);
    }

    void everyFaultIsNamed()
    {
        QVERIFY(faultsIn(R"(, "instructions": [])").find("phases[0].instructions") != std::string::npos);
        QVERIFY(faultsIn(R"(, "instructions": [{"id": "a b"}])").find("phases[0].instructions[0].id") != std::string::npos);
        QVERIFY(faultsIn(R"(, "instructions": [{"id": "a", "aim": "luck"}])").find("\"speed\" or \"accuracy\"") !=
                std::string::npos);
        QVERIFY(faultsIn(R"(, "instructions": [{"id": "a", "deadline_seconds": 0}])").find("deadline_seconds") !=
                std::string::npos);
        QVERIFY(faultsIn(R"(, "instructions": [{"id": "Fast"}, {"id": "fast"}])").find("'fast' is named twice") !=
                std::string::npos);
        QCOMPARE(faultsIn(three), std::string());
    }

    /// 12 participants: two cycles of the six orders of three instructions.
    void everyRenderingComesOnceUnderEveryInstruction()
    {
        const Protocol protocol = instructed();
        const Design design = drawDesign(protocol, 5);
        QCOMPARE(protocol.presentations(), 4 * 2 * 3 + 4 * 2);
        QCOMPARE(protocol.answersPerParticipant(), 32);
        std::map<std::vector<int>, int> orders;
        for (const auto& trials : design.participants) {
            QCOMPARE(static_cast<int>(trials.size()), protocol.presentations());
            std::set<std::tuple<int, int, int>> seen;
            for (const DesignTrial& trial : trials) {
                QCOMPARE(trial.instruction.has_value(), trial.phase == 0);
                if (trial.phase == 0) QVERIFY(seen.emplace(*trial.instruction, trial.label, trial.fabric).second);
            }
            QCOMPARE(seen.size(), std::size_t(24));
            const auto order = orderOf(trials);
            QCOMPARE(order.size(), std::size_t(3));  // the blocks of one instruction follow one another
            ++orders[order];
        }
        QCOMPARE(orders.size(), std::size_t(6));
        for (const auto& [order, count] : orders) QCOMPARE(count, 2);
        QVERIFY(drawDesign(protocol, 5) == design);
        QVERIFY(drawDesign(protocol, 6) != design);
    }

    void placesAndSuccessorsOfInstructionsAreEven()
    {
        for (const int instructions : {1, 2, 3, 4, 5, 6}) {
            Random random(9);
            const int cycle = instructions % 2 == 0 ? instructions : 2 * instructions;
            std::map<std::pair<int, int>, int> places, pairs;
            for (const auto& order : drawInstructionOrders(2 * cycle, instructions, random)) {
                QCOMPARE(static_cast<int>(std::set<int>(order.begin(), order.end()).size()), instructions);
                for (int at = 0; at < instructions; ++at) {
                    ++places[{at, order[static_cast<std::size_t>(at)]}];
                    if (at > 0) ++pairs[{order[static_cast<std::size_t>(at) - 1], order[static_cast<std::size_t>(at)]}];
                }
            }
            QCOMPARE(static_cast<int>(places.size()), instructions * instructions);
            QCOMPARE(static_cast<int>(pairs.size()), instructions * (instructions - 1));
            for (const auto& [place, count] : places) QCOMPARE(count, 2 * cycle / instructions);
            for (const auto& [pair, count] : pairs) QCOMPARE(count, places.begin()->second);
        }
    }

    /// Without instructions the draws are those of earlier versions; the second phase does not depend on the first.
    void otherPhasesKeepTheirOrders()
    {
        const auto secondPhase = [](const Protocol& protocol) {
            Design design = drawDesign(protocol, 3);
            for (auto& trials : design.participants) std::erase_if(trials, [](const DesignTrial& t) { return t.phase == 0; });
            return design;
        };
        QVERIFY(secondPhase(instructed()) == secondPhase(protocolFromJson(protocolWith(""), "test")));
    }

    void trialsCarryInstructionAndDeadline()
    {
        const Protocol protocol = instructed(2);
        const std::vector<FabricId> fabrics{FabricId("F01"), FabricId("F02"), FabricId("F03"), FabricId("F04")};
        const auto allocation = allocate(protocol, drawDesign(protocol, 1), fabrics, SecretKey::ofSeed(1));
        std::map<std::string, int> trials;
        for (const BlindedTrial& trial : allocation.participants[0]) {
            ++trials[trial.instruction.value];
            QCOMPARE(trial.deadlineMs, trial.instruction.value == "deadline" ? std::optional(2500) : std::nullopt);
        }
        QCOMPARE(trials, (std::map<std::string, int>{{"", 8}, {"accuracy", 8}, {"deadline", 8}, {"speed", 8}}));
    }

    void theBalanceIsThatOfEachInstruction()
    {
        const Protocol protocol = instructed();
        const auto certificate = balanceOf(drawDesign(protocol, 5), protocol);
        int found = 0;
        for (const auto& range : certificate.ranges)
            if (range.what == "presentations of a rendering per participant, Q1 (speed)") {
                ++found;
                QCOMPARE(range.min, 1);
                QCOMPARE(range.max, 1);
            }
        QCOMPARE(found, 1);
        QCOMPARE(certificate.immediateRepeats, 0);
    }

    void onlySentencesMayChangeLater()
    {
        const Protocol kept = instructed();
        Protocol changed = kept;
        changed.phases[0].instructions[0].text = "Be quick.";
        QVERIFY(fixedPartsChanged(kept, changed).empty());
        changed.phases[0].instructions[2].deadlineSeconds = 3;
        QCOMPARE(fixedPartsChanged(kept, changed), std::vector<std::string>{"phases"});
    }

    void theExampleIsAProtocol()
    {
        const std::filesystem::path file = std::filesystem::path(VIS2HAP_SOURCE_DIR) / "protocols/examples/speed_accuracy.json";
        const Protocol protocol = protocolFromJson(readWholeFile(file), file.string());
        QVERIFY(hasInstructions(protocol));
        QCOMPARE(protocol.presentations(), 63);
    }
};

QTEST_GUILESS_MAIN(InstructionsTest)
#include "instructions_test.moc"
