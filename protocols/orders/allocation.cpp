#include "protocols/orders/allocation.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <set>
#include <string_view>
#include <utility>

#include "protocols/condition.h"
#include "protocols/files/errors.h"
#include "protocols/secrets/sealing.h"

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

/// The code is longer where those of this length seem to be used up. Only a short code in an altered study leads there.
std::string drawUnusedCode(std::string_view letters, int length, std::set<std::string>& used, Random& random)
{
    constexpr int mostDraws = 10'000;
    for (;; ++length)
        for (int draw = 0; draw < mostDraws; ++draw)
            if (std::string code = drawCode(letters, length, random); used.insert(code).second) return code;
}

/// Each purpose has a seed of its own, so that the draws that a session shows tell nothing about the others.
Random drawsFor(std::string_view purpose, const SecretKey& secret) { return Random(secret.seedFor(purpose)); }

std::vector<std::size_t> permutation(std::size_t count, Random random)
{
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    random.shuffle(order);
    return order;
}

/// [label][fabric]. Only the secret seed decides which condition a label is.
std::vector<std::vector<FileCode>> drawFileCodes(std::size_t labels, std::size_t fabrics, const SecretKey& secret)
{
    Random random = drawsFor("allocation/file codes", secret);
    std::set<std::string> used;
    std::vector<std::vector<FileCode>> codes(labels);
    for (auto& perFabric : codes)
        for (std::size_t fabric = 0; fabric < fabrics; ++fabric)
            perFabric.emplace_back(drawUnusedCode(fileCodeLetters, fileCodeLength, used, random));
    return codes;
}

AllocationKey keyOf(const Protocol& protocol, const std::vector<FabricId>& fabrics,
                    const std::vector<std::vector<FileCode>>& codes, const SecretKey& secret)
{
    const std::size_t labels = protocol.conditions.size();
    const auto conditions = permutation(labels, drawsFor("allocation/conditions", secret));
    const auto masks = permutation(labels, drawsFor("allocation/masked labels", secret));
    AllocationKey key{{}, secret};
    for (std::size_t label = 0; label < labels; ++label)
        for (std::size_t fabric = 0; fabric < fabrics.size(); ++fabric)
            key.entries[codes[label][fabric]] = {fabrics[fabric], protocol.conditions[conditions[label]],
                                                 ConditionLabel("K" + std::to_string(masks[label] + 1))};
    if (codes.size() > labels)
        for (std::size_t fabric = 0; fabric < fabrics.size(); ++fabric)
            key.entries[codes.back()[fabric]] = {fabrics[fabric], catchTrialId(), ConditionLabel(catchTrialId().value)};
    return key;
}

std::vector<FileCode> drawMoreFileCodes(const AllocationKey& key, int count, const SecretKey& secret)
{
    Random random = drawsFor("allocation/familiarisation codes", secret);
    std::set<std::string> used;
    for (const auto& [code, entry] : key.entries) used.insert(code.value);
    std::vector<FileCode> codes;
    for (int i = 0; i < count; ++i) codes.emplace_back(drawUnusedCode(fileCodeLetters, fileCodeLength, used, random));
    return codes;
}

/// Smallest code on a piece: 100 for up to 900 codes, 1000 for up to 9000, and so on.
int smallestSwatchCode(std::size_t count)
{
    int smallest = 100;
    while (count > 9 * static_cast<std::size_t>(smallest)) smallest *= 10;
    return smallest;
}

/// Codes that all have the same number of digits and all differ within the study.
std::vector<SwatchLabels> drawSwatches(const Protocol& protocol, const std::vector<FabricId>& fabrics, std::size_t slots,
                                       const SecretKey& secret)
{
    Random random = drawsFor("allocation/swatch codes", secret);
    const std::size_t sets = protocol.swatchCodes == SwatchCodes::PerParticipant ? slots : 1;
    const int smallest = smallestSwatchCode(sets * fabrics.size());
    std::vector<int> numbers(9 * static_cast<std::size_t>(smallest));
    std::iota(numbers.begin(), numbers.end(), smallest);
    random.shuffle(numbers);
    std::vector<SwatchLabels> drawn(sets);
    for (SwatchLabels& labels : drawn)
        for (const FabricId& fabric : fabrics) {
            labels[fabric] = std::to_string(numbers.back());
            numbers.pop_back();
        }
    drawn.resize(slots, drawn.front());
    return drawn;
}

/// Draws presentation codes: unique in the study if there are enough codes, always unique within a participant.
class PresentationCodes {
public:
    PresentationCodes(const Design& design, const SecretKey& secret) : m_random(drawsFor("allocation/presentation codes", secret))
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

void instruct(BlindedTrial& trial, const std::vector<Phase>& phases, int place)
{
    const BlockInstruction& instruction =
        phases.at(static_cast<std::size_t>(trial.phase)).instructions.at(static_cast<std::size_t>(place));
    trial.instruction = instruction.id;
    trial.aim = instruction.aim;
    if (instruction.deadlineSeconds) trial.deadlineMs = static_cast<int>(std::lround(*instruction.deadlineSeconds * 1000));
}

/// The file of the image that a presentation of the design shows.
const FileCode& fileCodeOf(const DesignTrial& trial, const Protocol& protocol, const std::vector<std::vector<FileCode>>& codes,
                           const AllocationKey& key)
{
    const auto fabric = static_cast<std::size_t>(trial.fabric);
    if (trial.label == catchTrialLabel) return codes.back().at(fabric);
    if (trial.label != mismatchedLabel) return codes.at(static_cast<std::size_t>(trial.label)).at(fabric);
    const ConditionId shown = anchorConditionOf(protocol, protocol.phases.at(static_cast<std::size_t>(trial.phase)).anchors);
    const auto row = std::ranges::find(codes, shown, [&](const auto& own) { return key.entries.at(own.front()).condition; });
    assert(row != codes.end() && "the condition of the anchors is one of the protocol's");
    return row->at(fabric);
}

constexpr std::string_view boundToCodes = "vis2hap presentation";

}  // namespace

const AllocationKey::Entry& AllocationKey::entryOf(const BlindedTrial& trial) const
{
    const auto found = entries.find(opened(trial.sealedCode, stationKeyOf(secret)));
    if (found == entries.end())
        throw workFailed({"a presentation shows an image that the allocation key does not know",
                          "trial " + std::to_string(trial.number.value), "the key of this study", "run vis2hap verify"});
    return found->second;
}

SecretKey stationKeyOf(const SecretKey& secret) { return secret.derived("station key"); }

SealedCode sealed(const FileCode& code, const SecretKey& stationKey)
{
    return SealedCode(hexText(seal(stationKey, code.value, boundToCodes)));
}

FileCode opened(const SealedCode& code, const SecretKey& stationKey)
{
    if (auto text = open(stationKey, ofHexText(code.value, "the sealed code of a presentation"), boundToCodes))
        return FileCode(std::move(*text));
    throw workFailed({"the sealed code of a presentation cannot be opened", "the list of trials in study.db",
                      "the code and the station key of this study", "run vis2hap verify; restore the study from a backup"});
}

std::uint64_t designSeedOf(const SecretKey& secret, std::uint64_t publicSeed)
{
    return secret.seedFor("design " + std::to_string(publicSeed));
}

Allocation allocate(const Protocol& protocol, const Design& design, const std::vector<FabricId>& fabrics, const SecretKey& secret,
                    int familiarisation)
{
    assert(static_cast<int>(fabrics.size()) == protocol.fabricCount && "one fabric id for each number of the design");
    const bool hasCatchTrials = std::ranges::any_of(protocol.phases, [](const Phase& phase) { return phase.catchTrials > 0; });
    const auto codes = drawFileCodes(protocol.conditions.size() + std::size_t(hasCatchTrials), fabrics.size(), secret);
    PresentationCodes presentationCodesOf(design, secret);
    const SecretKey station = stationKeyOf(secret);
    Allocation allocation{{}, keyOf(protocol, fabrics, codes, secret), {}, {}};
    allocation.familiarisation = drawMoreFileCodes(allocation.key, familiarisation, secret);
    allocation.swatches = drawSwatches(protocol, fabrics, design.participants.size(), secret);
    for (const auto& trials : design.participants) {
        auto& list = allocation.participants.emplace_back();
        presentationCodesOf.beginParticipant();
        for (const DesignTrial& trial : trials) {
            BlindedTrial blinded;
            blinded.number = TrialNumber{static_cast<int>(list.size()) + 1};
            blinded.phase = trial.phase;
            blinded.sealedCode = sealed(fileCodeOf(trial, protocol, codes, allocation.key), station);
            blinded.presentationCode = presentationCodesOf.next();
            for (const int fabric : trial.alternatives)
                blinded.alternatives.push_back(fabrics.at(static_cast<std::size_t>(fabric)));
            if (trial.instruction) instruct(blinded, protocol.phases, *trial.instruction);
            list.push_back(std::move(blinded));
        }
    }
    return allocation;
}

std::vector<FileCode> newFileCodes(std::size_t count, const SecretKey& secret) { return drawFileCodes(1, count, secret).front(); }

PresentationCode codeOfAttempt(const std::vector<BlindedTrial>& list, std::size_t index, int attempt)
{
    const std::string& own = list.at(index).presentationCode.value;
    if (attempt <= 1) return list[index].presentationCode;
    if (own.empty())
        throw workFailed({"trial " + std::to_string(list[index].number.value) + " has no presentation code", "the list of trials",
                          "letters and digits", "see `vis2hap verify`; restore the study from a backup"});
    std::set<std::string> used;
    for (const BlindedTrial& trial : list) used.insert(trial.presentationCode.value);
    Random random = Random::stream(static_cast<std::uint64_t>(attempt), "presentation again/" + own);
    return PresentationCode(drawUnusedCode(presentationLetters, static_cast<int>(own.size()), used, random));
}

}  // namespace protocols
