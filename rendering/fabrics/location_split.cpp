#include "rendering/fabrics/location_split.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"
#include "protocols/random.h"
#include "rendering/fabrics/friction_record.h"
#include "rendering/images/image_png.h"

namespace rendering::fabrics {

namespace {

constexpr double strokeWidthMm = 1;

using Split = std::vector<std::pair<SamplePlace, Part>>;

struct PixelSize {
    double width = 0, height = 0;
};

protocols::Error noPngHeader(const std::filesystem::path& file)
{
    return protocols::badInput(
        {"does not begin like a PNG, so its size is unknown", file.string(), "a PNG image", "export it again as PNG"});
}

/// The size that the reader gives, without decoding: of thousands of pictures that would take minutes. Throws badInput: without
/// its size a picture would overlap none, and parts of one place could fall into training and testing.
PixelSize pngSize(const std::filesystem::path& file)
{
    constexpr std::size_t bytesToTheSize = 24;
    constexpr double mostSidePx = 1 << 20;
    const std::string bytes = protocols::readRegularFile(file, protocols::largestFile);  // the mark may stand behind the pixels
    if (bytes.size() < bytesToTheSize || !bytes.starts_with("\x89PNG\r\n\x1a\n") || bytes.compare(12, 4, "IHDR") != 0)
        throw noPngHeader(file);
    const auto byte = [&](std::size_t at) { return static_cast<double>(static_cast<unsigned char>(bytes[at])); };
    const auto number = [&](std::size_t at) {
        return ((byte(at) * 256 + byte(at + 1)) * 256 + byte(at + 2)) * 256 + byte(at + 3);
    };
    const PixelSize size{number(16), number(20)};
    if (!(size.width >= 1 && size.height >= 1 && size.width <= mostSidePx && size.height <= mostSidePx)) throw noPngHeader(file);
    return pngLiesOnItsSide(bytes) ? PixelSize{size.height, size.width} : size;
}

Footprint squareForEveryAngle(Footprint footprint)
{
    footprint.widthMm = footprint.heightMm = std::hypot(footprint.widthMm, footprint.heightMm);
    return footprint;
}

struct UnitVector {
    double x, y;
};

std::array<UnitVector, 2> axesOf(const Footprint& footprint)
{
    const double angle = footprint.rotationDeg * std::numbers::pi / 180;
    return {UnitVector{std::cos(angle), std::sin(angle)}, UnitVector{-std::sin(angle), std::cos(angle)}};
}

/// Half the length of a footprint's projection onto an axis.
double halfProjection(const Footprint& footprint, const UnitVector& axis)
{
    const auto own = axesOf(footprint);
    const auto share = [&](std::size_t i) { return std::abs(own[i].x * axis.x + own[i].y * axis.y); };
    return footprint.widthMm / 2 * share(0) + footprint.heightMm / 2 * share(1);
}

/// The stated length, unless the record itself lasts for another one. The stated length counts each sample as a step and is
/// rounded, so that it may exceed the way from the first sample to the last by a step.
double strokeLengthMm(const Dataset& dataset, const SamplePlace& place)
{
    constexpr double roundingMm = 1e-3;
    const double statedMm = dataset.friction.lengthMm;
    try {
        const FrictionRecord record = readFriction(dataset, place.fabric, place.index);
        const double ownMm = (record.timeS.back() - record.timeS.front()) * record.speedMmPerS;
        const double stepMm = record.speedMmPerS / record.sampleRateHz;
        return std::abs(statedMm - ownMm - stepMm / 2) <= stepMm + roundingMm ? statedMm : ownMm;
    } catch (const protocols::Error&) {
        return statedMm;  // the checker of the data set names the fault
    }
}

/// Disjoint sets that are joined one pair at a time.
class JoinedSets {
public:
    explicit JoinedSets(std::size_t count) : m_parent(count) { std::iota(m_parent.begin(), m_parent.end(), std::size_t{0}); }

    std::size_t rootOf(std::size_t item)
    {
        while (m_parent[item] != item) item = m_parent[item] = m_parent[m_parent[item]];
        return item;
    }
    void join(std::size_t a, std::size_t b) { m_parent[std::max(rootOf(a), rootOf(b))] = std::min(rootOf(a), rootOf(b)); }

private:
    std::vector<std::size_t> m_parent;
};

/// Samples of one fabric that stay together, as indices into the split.
using Cluster = std::vector<std::size_t>;

std::vector<Cluster> clustersOf(const Dataset& dataset, const Split& split, const std::vector<std::size_t>& samples)
{
    JoinedSets sets(samples.size());
    std::map<std::string, std::size_t> firstOfGroup;
    std::vector<std::optional<Footprint>> footprints;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const SamplePlace& place = split[samples[i]].first;
        footprints.push_back(footprintOf(dataset, place));
        sets.join(firstOfGroup.emplace(place.group, i).first->second, i);
        for (std::size_t j = 0; j < i; ++j)
            if (split[samples[j]].first.modality == place.modality && footprints[i] && footprints[j] &&
                overlap(*footprints[i], *footprints[j]))
                sets.join(i, j);
    }
    std::map<std::size_t, Cluster> clusters;
    for (std::size_t i = 0; i < samples.size(); ++i) clusters[sets.rootOf(i)].push_back(samples[i]);
    std::vector<Cluster> result;
    for (auto& [root, cluster] : clusters) result.push_back(std::move(cluster));
    return result;
}

using SampleCounts = std::map<Modality, std::size_t>;

SampleCounts countsOf(const Split& split, const Cluster& cluster)
{
    SampleCounts counts;
    for (const std::size_t sample : cluster) ++counts[split[sample].first.modality];
    return counts;
}

/// Number of samples of each signal for validation, and the same for testing; 0 where fewer than three groups exist.
SampleCounts wantedOf(const Split& split, const std::vector<Cluster>& clusters)
{
    SampleCounts samples, groups, wanted;
    for (const Cluster& cluster : clusters)
        for (const auto& [modality, count] : countsOf(split, cluster)) {
            samples[modality] += count;
            ++groups[modality];
        }
    for (const auto& [modality, count] : samples)
        wanted[modality] = groups[modality] < 3 ? 0 : std::max<std::size_t>(1, (count + 5) / 10);
    return wanted;
}

/// Puts whole clusters into `part` while they fit into the number of samples that it still needs.
void fill(Split& split, const std::vector<Cluster>& clusters, Part part, SampleCounts wanted)
{
    for (const Cluster& cluster : clusters) {
        const SampleCounts counts = countsOf(split, cluster);
        const bool fits =
            split[cluster.front()].second == Part::Training &&
            std::all_of(counts.begin(), counts.end(), [&](const auto& entry) { return entry.second <= wanted[entry.first]; });
        if (!fits) continue;
        for (const std::size_t sample : cluster) split[sample].second = part;
        for (const auto& [modality, count] : counts) wanted[modality] -= count;
    }
}

/// Puts the smallest cluster into a wanted part that is still empty, because no cluster was small enough for it.
void fillEmpty(Split& split, const std::vector<Cluster>& clusters, Part part, const SampleCounts& wanted)
{
    for (const auto& [modality, count] : wanted) {
        const auto holds = [&, modality = modality](const Cluster& cluster, Part where) {
            return split[cluster.front()].second == where && countsOf(split, cluster).contains(modality);
        };
        const Cluster* smallest = nullptr;
        const bool served =
            std::any_of(clusters.begin(), clusters.end(), [&](const Cluster& cluster) { return holds(cluster, part); });
        for (const Cluster& cluster : clusters)
            if (holds(cluster, Part::Training) && (smallest == nullptr || cluster.size() < smallest->size())) smallest = &cluster;
        if (count == 0 || served || smallest == nullptr) continue;
        for (const std::size_t sample : *smallest) split[sample].second = part;
    }
}

}  // namespace

std::optional<Footprint> footprintOf(const Dataset& dataset, const SamplePlace& place)
{
    if (!place.xMm || !place.yMm) return {};
    const double rotation = place.rotationDeg.value_or(0);
    Footprint footprint{*place.xMm, *place.yMm, 0, 0, rotation};
    if (place.modality == Modality::Friction) {
        const double lengthMm = strokeLengthMm(dataset, place);
        footprint.widthMm = lengthMm;
        footprint.heightMm = strokeWidthMm;
        if (!place.rotationDeg) {  // The stroke ends somewhere on the circle about its start.
            footprint.widthMm = footprint.heightMm = 2 * lengthMm;
            return footprint;
        }
        footprint.xMm += lengthMm / 2 * axesOf(footprint)[0].x;
        footprint.yMm += lengthMm / 2 * axesOf(footprint)[0].y;
        return footprint;
    }
    const auto pitch = place.modality == Modality::Visual ? photographPitch(dataset, place) : dataset.tactileMmPerPixel;
    if (!pitch) return {};
    const PixelSize size = pngSize(samplePath(dataset, place.fabric, place.modality, place.index));
    footprint.widthMm = size.width * *pitch;
    footprint.heightMm = size.height * *pitch;
    return place.rotationDeg ? footprint : squareForEveryAngle(footprint);
}

bool overlap(const Footprint& a, const Footprint& b)
{
    const double mostReach = (std::hypot(a.widthMm, a.heightMm) + std::hypot(b.widthMm, b.heightMm)) / 2;
    if (std::hypot(b.xMm - a.xMm, b.yMm - a.yMm) >= mostReach) return false;  // Decides most pairs cheaply.
    for (const Footprint* footprint : {&a, &b})
        for (const UnitVector& axis : axesOf(*footprint)) {
            const double distance = std::abs((b.xMm - a.xMm) * axis.x + (b.yMm - a.yMm) * axis.y);
            if (distance >= halfProjection(a, axis) + halfProjection(b, axis)) return false;
        }
    return true;
}

std::vector<std::pair<SamplePlace, Part>> splitByLocation(const Dataset& dataset, std::uint64_t seed)
{
    Split split = splitBySample(dataset, seed);
    std::map<protocols::FabricId, std::vector<std::size_t>> samplesOf;
    for (std::size_t i = 0; i < split.size(); ++i) {
        split[i].second = Part::Training;
        samplesOf[split[i].first.fabric].push_back(i);
    }
    for (const auto& [fabric, samples] : samplesOf) {
        std::vector<Cluster> clusters = clustersOf(dataset, split, samples);
        const SampleCounts wanted = wantedOf(split, clusters);
        protocols::Random random = protocols::Random::stream(seed, "location/" + fabric.value);
        random.shuffle(clusters);
        for (const Part part : {Part::Testing, Part::Validation}) fill(split, clusters, part, wanted);
        for (const Part part : {Part::Testing, Part::Validation}) fillEmpty(split, clusters, part, wanted);
    }
    return split;
}

}  // namespace rendering::fabrics
