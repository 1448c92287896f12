#include "protocols/allocation.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <set>
#include <string_view>
#include <utility>

#include "protocols/condition.h"

namespace protocols {

namespace {

// Neither alphabet has two characters that people confuse when they read or hear them.
constexpr std::string_view fileCodeLetters = "abcdefghjkmnpqrstuvwxyz23456789";
constexpr std::string_view presentationLetters = "ACEFHJKLMNPRTUVWXY3479";
constexpr int fileCodeLength = 8;
constexpr int presentationCodeLength = 4;
constexpr std::size_t presentationCodes = std::size_t{22} * 22 * 22 * 22;

std::string drawCode(std::string_view letters, int length, Random& random)
{
    std::string code;
    for (int i = 0; i < length; ++i) code += letters[random.below(letters.size())];
    return code;
}

std::string drawUnusedCode(std::string_view letters, int length, std::set<std::string>& used, Random& random)
{
    std::string code = drawCode(letters, length, random);
    while (!used.insert(code).second) code = drawCode(letters, length, random);
    return code;
}

std::vector<std::size_t> permutation(std::size_t count, Random random)
{
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    random.shuffle(order);
    return order;
}

/// [label][fabric]. Only the secret seed decides which condition a label is.
std::vector<std::vector<FileCode>> drawFileCodes(std::size_t labels, std::size_t fabrics, std::uint64_t secretSeed)
{
    Random random = Random::stream(secretSeed, "allocation/file codes");
    std::set<std::string> used;
    std::vector<std::vector<FileCode>> codes(labels);
    for (auto& perFabric : codes)
        for (std::size_t fabric = 0; fabric < fabrics; ++fabric)
            perFabric.emplace_back(drawUnusedCode(fileCodeLetters, fileCodeLength, used, random));
    return codes;
}

AllocationKey keyOf(const Protocol& protocol, const std::vector<FabricId>& fabrics,
                    const std::vector<std::vector<FileCode>>& codes, std::uint64_t secretSeed)
{
    const std::size_t labels = protocol.conditions.size();
    const auto conditions = permutation(labels, Random::stream(secretSeed, "allocation/conditions"));
    const auto masks = permutation(labels, Random::stream(secretSeed, "allocation/masked labels"));
    AllocationKey key;
    for (std::size_t label = 0; label < labels; ++label)
        for (std::size_t fabric = 0; fabric < fabrics.size(); ++fabric)
            key.entries[codes[label][fabric]] = {fabrics[fabric], protocol.conditions[conditions[label]],
                                                 ConditionLabel("K" + std::to_string(masks[label] + 1))};
    if (codes.size() > labels)
        for (std::size_t fabric = 0; fabric < fabrics.size(); ++fabric)
            key.entries[codes.back()[fabric]] = {fabrics[fabric], catchTrialId(), ConditionLabel(catchTrialId().value)};
    return key;
}

std::vector<FileCode> drawMoreFileCodes(const AllocationKey& key, int count, std::uint64_t secretSeed)
{
    Random random = Random::stream(secretSeed, "allocation/familiarisation codes");
    std::set<std::string> used;
    for (const auto& [code, entry] : key.entries) used.insert(code.value);
    std::vector<FileCode> codes;
    for (int i = 0; i < count; ++i) codes.emplace_back(drawUnusedCode(fileCodeLetters, fileCodeLength, used, random));
    return codes;
}

/// Three digits each, all different within the study as long as there are enough.
std::vector<SwatchLabels> drawSwatches(const Protocol& protocol, const std::vector<FabricId>& fabrics, std::size_t slots,
                                       std::uint64_t secretSeed)
{
    Random random = Random::stream(secretSeed, "allocation/swatch codes");
    std::vector<SwatchLabels> drawn;
    std::vector<int> numbers;
    const std::size_t sets = protocol.swatchCodes == SwatchCodes::PerParticipant ? slots : 1;
    for (std::size_t set = 0; set < sets; ++set) {
        auto& labels = drawn.emplace_back();
        if (numbers.size() < fabrics.size()) {
            numbers.resize(900);
            std::iota(numbers.begin(), numbers.end(), 100);
            random.shuffle(numbers);
        }
        for (const FabricId& fabric : fabrics) {
            labels[fabric] = std::to_string(numbers.back());
            numbers.pop_back();
        }
    }
    drawn.resize(slots, drawn.front());
    return drawn;
}

/// Draws presentation codes: unique in the study if there are enough codes, always unique within a participant.
class PresentationCodes {
public:
    PresentationCodes(const Design& design, std::uint64_t secretSeed)
        : m_random(Random::stream(secretSeed, "allocation/presentation codes"))
    {
        std::size_t needed = 0;
        for (const auto& participant : design.participants) needed += participant.size();
        m_uniqueInStudy = needed <= presentationCodes / 4;
    }

    void beginParticipant()
    {
        if (!m_uniqueInStudy) m_used.clear();
    }

    PresentationCode next()
    {
        // One participant may have more trials than there are codes of this length: continue with longer codes.
        if (m_used.size() >= presentationCodes / 2) {
            ++m_length;
            m_used.clear();
        }
        return PresentationCode(drawUnusedCode(presentationLetters, m_length, m_used, m_random));
    }

private:
    Random m_random;
    std::set<std::string> m_used;
    bool m_uniqueInStudy = true;
    int m_length = presentationCodeLength;
};

}  // namespace

Allocation allocate(const Protocol& protocol, const Design& design, const std::vector<FabricId>& fabrics,
                    std::uint64_t secretSeed, int familiarisation)
{
    assert(static_cast<int>(fabrics.size()) == protocol.fabricCount && "one fabric id for each number of the design");
    const bool hasCatchTrials = std::ranges::any_of(protocol.phases, [](const Phase& phase) { return phase.catchTrials > 0; });
    const auto codes = drawFileCodes(protocol.conditions.size() + std::size_t(hasCatchTrials), fabrics.size(), secretSeed);
    PresentationCodes presentationCodesOf(design, secretSeed);
    Allocation allocation;
    allocation.key = keyOf(protocol, fabrics, codes, secretSeed);
    allocation.familiarisation = drawMoreFileCodes(allocation.key, familiarisation, secretSeed);
    allocation.swatches = drawSwatches(protocol, fabrics, design.participants.size(), secretSeed);
    for (const auto& trials : design.participants) {
        auto& list = allocation.participants.emplace_back();
        presentationCodesOf.beginParticipant();
        for (const DesignTrial& trial : trials) {
            BlindedTrial blinded;
            blinded.number = TrialNumber{static_cast<int>(list.size()) + 1};
            blinded.phase = trial.phase;
            const auto& row = trial.label == catchTrialLabel ? codes.back() : codes.at(static_cast<std::size_t>(trial.label));
            blinded.fileCode = row.at(static_cast<std::size_t>(trial.fabric));
            blinded.presentationCode = presentationCodesOf.next();
            for (const int fabric : trial.alternatives)
                blinded.alternatives.push_back(fabrics.at(static_cast<std::size_t>(fabric)));
            list.push_back(std::move(blinded));
        }
    }
    return allocation;
}

PresentationCode codeOfAttempt(const std::vector<BlindedTrial>& list, std::size_t index, int attempt)
{
    const std::string& own = list.at(index).presentationCode.value;
    if (attempt <= 1) return list[index].presentationCode;
    std::set<std::string> used;
    for (const BlindedTrial& trial : list) used.insert(trial.presentationCode.value);
    Random random = Random::stream(static_cast<std::uint64_t>(attempt), "presentation again/" + own);
    return PresentationCode(drawUnusedCode(presentationLetters, static_cast<int>(own.size()), used, random));
}

MaskedKey masked(const AllocationKey& key)
{
    MaskedKey result;
    for (const auto& [code, entry] : key.entries) result.entries[code] = {entry.fabric, entry.label};
    return result;
}

}  // namespace protocols
