#include "rendering/models/lab/lab_cloth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <set>

#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "protocols/random.h"
#include "rendering/fabrics/location_split.h"
#include "rendering/models/lab/lab_heights.h"
#include "rendering/models/photograph_at_pitch.h"
#include "rendering/signals/friction_trace.h"
#include "rendering/signals/tactile/photometric_stereo.h"

namespace rendering::models {

namespace {

using fabrics::Dataset;
using fabrics::Modality;
using fabrics::SamplePlace;
using protocols::FabricId;

/// More presses of a fabric tell nothing new of its statistics.
constexpr std::size_t mostPresses = 60;

using LabSplit = std::vector<std::pair<SamplePlace, LabPart>>;

/// How the heights of presses come to be.
struct PressReading {
    bool possible = false;
    cv::Mat reference;
    std::optional<signals::Calibration> calibration;  ///< nullopt: heights are known
};

PressReading pressReadingOf(const Dataset& dataset, std::vector<std::string>& notes)
{
    const bool pressed = std::ranges::any_of(dataset.fabrics, [&](const fabrics::FabricInfo& fabric) {
        return !fabrics::sampleIndices(dataset, fabric.id, Modality::Tactile).empty();
    });
    if (!pressed) return {};
    if (!dataset.tactileMmPerPixel || dataset.tactileCalibration.empty()) {
        notes.emplace_back("the presses are left out, because dataset.json states no calibration of the sensor");
        return {};
    }
    if (dataset.tactileCalibration == "known") return {true, {}, {}};
    const cv::Mat reference = fabrics::readTactileReference(dataset);
    return {true, reference, signals::calibrationOf(dataset, reference)};
}

/// Height of a press, mm; empty where it is neither known nor computable.
cv::Mat pressHeight(const Dataset& dataset, const PressReading& reading, const SamplePlace& place)
{
    cv::Mat height;
    if (reading.calibration)
        signals::heightFromFrame(fabrics::readTactileFrame(dataset, place.fabric, place.index), reading.reference,
                                 *reading.calibration, signals::IntegrationQuality::Fast)
            .convertTo(height, CV_32F);
    else if (const auto known = fabrics::readKnownHeight(dataset, place.fabric, place.index))
        known->convertTo(height, CV_32F);
    return height;
}

/// A stroke at the spacing of the networks. Waves that the record does not reach have no numbers.
std::optional<FrictionTarget> strokeTarget(const Dataset& dataset, const SamplePlace& place, const Architecture& architecture)
{
    const fabrics::FrictionRecord record = fabrics::readFriction(dataset, place.fabric, place.index);
    if (!record.isCoefficient()) return std::nullopt;
    const std::string file = fabrics::samplePath(dataset, place.fabric, Modality::Friction, place.index).string();
    const signals::FrictionTrace trace = signals::frictionTrace(record, file);
    FrictionTarget target =
        frictionTarget(atSpacing(trace.values, trace.mmPerSample, architecture.traceMmPerSample), architecture);
    const double reached = std::min(1.0, architecture.traceMmPerSample / trace.mmPerSample);
    const int rows = static_cast<int>(std::floor(reached * (architecture.rows - 1))) + 1;
    target.logRatio.rowRange(rows, architecture.rows).setTo(std::numeric_limits<float>::quiet_NaN());
    return target;
}

/// Fabrics with photographs and with something measured.
std::vector<FabricId> measuredFabrics(const Dataset& dataset)
{
    std::vector<FabricId> measured;
    for (const fabrics::FabricInfo& fabric : dataset.fabrics) {
        const std::vector<int> photographs = fabrics::sampleIndices(dataset, fabric.id, Modality::Visual);
        const auto hasSurface = [&](int index) {
            return std::filesystem::exists(fabrics::surfacePath(dataset, fabric.id, index));
        };
        if (!photographs.empty() && (!fabrics::sampleIndices(dataset, fabric.id, Modality::Tactile).empty() ||
                                     !fabrics::sampleIndices(dataset, fabric.id, Modality::Friction).empty() ||
                                     std::ranges::any_of(photographs, hasSurface)))
            measured.push_back(fabric.id);
    }
    return measured;
}

/// The fabrics that the caller names, else one in five by seed.
std::set<FabricId> heldOutFabrics(const Dataset& dataset, std::vector<FabricId> measured, const LabOptions& options)
{
    for (const FabricId& id : options.heldOut) dataset.fabric(id);
    if (!options.heldOut.empty()) return {options.heldOut.begin(), options.heldOut.end()};
    if (measured.size() < static_cast<std::size_t>(fabricsForHoldingOut)) return {};
    protocols::Random random = protocols::Random::stream(options.splitSeed, "lab/held-out fabrics");
    random.shuffle(measured);
    return {measured.begin(), measured.begin() + static_cast<std::ptrdiff_t>(measured.size() / fabricsForHoldingOut)};
}

/// The usual split holds out a tenth for validation and one for testing, but at least one place each. With few photographs one
/// of the two is enough.
bool isHeldOut(fabrics::Part part, std::size_t photographs)
{
    constexpr std::size_t manyPhotographs = 10;
    return part == fabrics::Part::Testing || (part == fabrics::Part::Validation && photographs >= manyPhotographs);
}

LabSplit splitOf(const Dataset& dataset, const std::set<FabricId>& heldOut, std::uint64_t seed)
{
    std::map<FabricId, std::size_t> photographs;
    for (const fabrics::FabricInfo& fabric : dataset.fabrics)
        photographs[fabric.id] = fabrics::sampleIndices(dataset, fabric.id, Modality::Visual).size();
    LabSplit split;
    for (auto& [place, part] : fabrics::splitByLocation(dataset, seed)) {
        const LabPart ours = heldOut.contains(place.fabric)               ? LabPart::HeldOutFabric
                             : isHeldOut(part, photographs[place.fabric]) ? LabPart::HeldOutPlace
                                                                          : LabPart::Training;
        split.emplace_back(std::move(place), ours);
    }
    return split;
}

/// The middle of a photograph, as large as inference uses it.
LabPhotograph usedPhotograph(const Dataset& dataset, const SamplePlace& place, const fabrics::PhotographViews& views,
                             const Architecture& architecture)
{
    const cv::Mat rgb = fabrics::readPhotograph(dataset, place.fabric, place.index);
    LabPhotograph photograph;
    photograph.index = place.index;
    photograph.mmPerPixel = views.mmPerPixel(place.fabric, place.index).value_or(assumedMmPerPixel(rgb, architecture));
    photograph.lightDeg = views.lightDeg(place.fabric, place.index);
    photograph.fibre = dataset.fabric(place.fabric).fibre;
    photograph.rgb = rgb;
    if (const auto surface = fabrics::readSurfaceOf(dataset, place.fabric, place.index, rgb.size())) {
        surface->convertTo(photograph.reliefMm, CV_32F);
        photograph.amplitudeKnown = dataset.fabric(place.fabric).surfaceInMm;
    }
    return photograph;
}

/// Cuts what inference does not use.
void cutToMiddle(LabPhotograph& photograph)
{
    const cv::Rect part = photographAtPitch({photograph.rgb, photograph.mmPerPixel}, photograph.mmPerPixel).part;
    if (part.size() == photograph.rgb.size()) return;
    photograph.rgb = photograph.rgb(part).clone();
    if (!photograph.reliefMm.empty()) photograph.reliefMm = photograph.reliefMm(part).clone();
}

std::size_t bytesOf(const LabPhotograph& photograph)
{
    return photograph.rgb.total() * photograph.rgb.elemSize() + photograph.reliefMm.total() * photograph.reliefMm.elemSize();
}

void refuseUnmeasured(const Dataset& dataset)
{
    throw protocols::badInput({"the data set has nothing to learn from", dataset.folder.string(),
                               "photographs together with measured heights (presses or surfaces) or strokes of the same fabrics",
                               "import them with `vis2hap import gelsight` or `vis2hap import friction-csv`"});
}

void refuseFew(const Dataset& dataset, std::size_t photographs)
{
    throw protocols::badInput({"only " + std::to_string(photographs) +
                                   (photographs == 1 ? " photograph has" : " photographs have") +
                                   " measured heights or strokes beside " + (photographs == 1 ? "it" : "them"),
                               dataset.folder.string(), "at least " + std::to_string(fewestLabPhotographs),
                               "take more photographs of the measured fabrics, each of another place"});
}

/// Reads everything but the photographs' relief by presses.
class LabReader {
public:
    LabReader(const Dataset& dataset, const Architecture& architecture, const LabOptions& options)
        : m_dataset(dataset), m_architecture(architecture), m_views(dataset), m_budget(options.memoryBytes)
    {
        const std::vector<FabricId> measured = measuredFabrics(dataset);
        if (measured.empty()) refuseUnmeasured(dataset);
        m_reading = pressReadingOf(dataset, m_cloth.notes);
        m_cloth.pressMmPerPixel = dataset.tactileMmPerPixel.value_or(m_cloth.pressMmPerPixel);
        const std::set<FabricId> heldOut = heldOutFabrics(dataset, measured, options);
        m_split = splitOf(dataset, heldOut, options.splitSeed);
        for (const FabricId& id : measured) {
            m_places[id] = m_cloth.fabrics.size();
            m_cloth.fabrics.push_back({id, heldOut.contains(id), {}, {}});
        }
        rememberHeldOut();
    }

    LabCloth read()
    {
        // Presses and strokes come first, because they decide which photographs serve.
        for (const auto& [place, part] : m_split)
            if (place.modality != Modality::Visual && m_places.contains(place.fabric)) readMeasurement(place, part);
        for (const auto& [place, part] : m_split)
            if (place.modality == Modality::Visual && m_places.contains(place.fabric)) readPhotograph(place, part);
        if (m_otherQuantities > 0)
            m_cloth.notes.push_back(std::to_string(m_otherQuantities) +
                                    " strokes are left out, because they hold no coefficient of friction");
        if (m_beyondBudget > 0)
            m_cloth.notes.push_back(std::to_string(m_beyondBudget) + " photographs are left out because of the memory budget");
        if (m_cloth.photographs.empty()) refuseUnmeasured(m_dataset);
        if (m_cloth.photographs.size() < static_cast<std::size_t>(fewestLabPhotographs))
            refuseFew(m_dataset, m_cloth.photographs.size());
        if (m_cloth.photographsOf(LabPart::Training).empty())
            throw protocols::badInput({"no photograph remains for training", m_dataset.folder.string(),
                                       "fabrics that are not held out", "hold out fewer fabrics"});
        if (m_cloth.photographsOf(LabPart::HeldOutPlace).empty() && m_cloth.photographsOf(LabPart::HeldOutFabric).empty())
            throw protocols::badInput({"no photograph can be held out, so no gain could be checked", m_dataset.folder.string(),
                                       "three separate places of a fabric, or five fabrics",
                                       "photograph more places, and state them in samples.csv"});
        std::ranges::sort(m_cloth.trainingHashes);
        return std::move(m_cloth);
    }

private:
    std::string hashOf(const SamplePlace& place) const
    {
        return protocols::sha256OfFile(fabrics::samplePath(m_dataset, place.fabric, place.modality, place.index));
    }

    /// Of photographs that are left out, too: scans may hold the same files.
    void rememberHeldOut()
    {
        for (const auto& [place, part] : m_split) {
            if (place.modality != Modality::Visual) continue;
            if (part == LabPart::HeldOutFabric) m_cloth.heldOutFabrics.insert(hashOf(place));
            if (part == LabPart::HeldOutPlace && m_places.contains(place.fabric)) m_cloth.heldOutPlaces.insert(hashOf(place));
        }
    }

    void remember(const SamplePlace& place, LabPart part)
    {
        if (part == LabPart::Training) m_cloth.trainingHashes.push_back(hashOf(place));
    }

    void readMeasurement(const SamplePlace& place, LabPart part)
    {
        LabFabric& fabric = m_cloth.fabrics[m_places.at(place.fabric)];
        if (place.modality == Modality::Friction) {
            auto target = strokeTarget(m_dataset, place, m_architecture);
            m_otherQuantities += target ? 0 : 1;
            if (!target) return;
            fabric.strokes.push_back({std::move(*target), part});
        } else {
            if (!m_reading.possible) return;
            const bool aligned = m_dataset.pairing == fabrics::Pairing::Aligned, enough = fabric.presses.size() >= mostPresses;
            if (enough && !aligned) return;
            const cv::Mat height = pressHeight(m_dataset, m_reading, place);
            if (height.empty()) return;
            if (!enough) fabric.presses.push_back({height, part});
            if (aligned) m_pressAt[{place.fabric, place.index}] = {height, place.rotationDeg.value_or(0)};
        }
        remember(place, part);
    }

    void readPhotograph(const SamplePlace& place, LabPart part)
    {
        const std::size_t at = m_places.at(place.fabric);
        const LabFabric& fabric = m_cloth.fabrics[at];
        std::size_t& used = m_used[at];
        if (used >= m_budget / m_cloth.fabrics.size()) {
            ++m_beyondBudget;
            return;
        }
        LabPhotograph photograph = usedPhotograph(m_dataset, place, m_views, m_architecture);
        photograph.fabric = at;
        photograph.part = part;
        const auto press = m_pressAt.find({place.fabric, place.index});
        if (photograph.reliefMm.empty() && press != m_pressAt.end())
            photograph.reliefMm = onPhotograph(
                press->second.heightMm, m_cloth.pressMmPerPixel,
                {photograph.rgb.size(), photograph.mmPerPixel, place.rotationDeg.value_or(0) - press->second.rotationDeg});
        if (photograph.reliefMm.empty() && fabric.presses.empty() && fabric.strokes.empty()) return;
        cutToMiddle(photograph);
        used += bytesOf(photograph);
        m_cloth.photographs.push_back(std::move(photograph));
        remember(place, part);
    }

    struct PressAt {
        cv::Mat heightMm;
        double rotationDeg = 0;
    };

    const Dataset& m_dataset;
    const Architecture& m_architecture;
    fabrics::PhotographViews m_views;
    std::size_t m_budget;
    std::map<std::size_t, std::size_t> m_used;  ///< bytes of the photographs of each fabric
    int m_otherQuantities = 0, m_beyondBudget = 0;
    PressReading m_reading;
    LabSplit m_split;
    LabCloth m_cloth;
    std::map<FabricId, std::size_t> m_places;
    std::map<std::pair<FabricId, int>, PressAt> m_pressAt;
};

/// A picture of a data set of scans, with what tells whether it shows held-out cloth.
struct ScanPicture {
    SamplePlace place;
    std::string sha256;
    std::optional<fabrics::Footprint> footprint;

    bool showsPlaceOf(const ScanPicture& other) const
    {
        return place.group == other.place.group ||
               (footprint && other.footprint && fabrics::overlap(*footprint, *other.footprint));
    }
};

std::vector<ScanPicture> picturesOf(const Dataset& scans)
{
    std::vector<ScanPicture> pictures;
    for (const SamplePlace& place : fabrics::readSamplePlaces(scans)) {
        const auto file = fabrics::samplePath(scans, place.fabric, place.modality, place.index);
        if (place.modality == Modality::Visual && std::filesystem::exists(file))
            pictures.push_back({place, protocols::sha256OfFile(file), fabrics::footprintOf(scans, place)});
    }
    return pictures;
}

}  // namespace

double LabFabric::logFriction(LabPart part) const
{
    double own = 0, all = 0;
    int count = 0;
    for (const LabStroke& stroke : strokes) {
        all += stroke.target.mean;
        if (stroke.part != part) continue;
        own += stroke.target.mean;
        ++count;
    }
    if (strokes.empty() || (count == 0 && part == LabPart::Training)) return std::numeric_limits<double>::quiet_NaN();
    return count > 0 ? std::log(own / count) : std::log(all / static_cast<double>(strokes.size()));
}

std::vector<std::size_t> LabCloth::photographsOf(LabPart part) const
{
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < photographs.size(); ++i)
        if (photographs[i].part == part) chosen.push_back(i);
    return chosen;
}

LabCloth readLabCloth(const Dataset& dataset, const Architecture& architecture, const LabOptions& options)
{
    return LabReader(dataset, architecture, options).read();
}

std::size_t heldOutAmong(const LabCloth& lab, const std::vector<std::string>& trainedOn)
{
    return static_cast<std::size_t>(std::ranges::count_if(trainedOn, [&](const std::string& hash) {
        return lab.heldOutPlaces.contains(hash) || lab.heldOutFabrics.contains(hash);
    }));
}

PictureSet scansOfHeldOut(const Dataset& scans, const LabCloth& lab)
{
    const std::vector<ScanPicture> pictures = picturesOf(scans);
    PictureSet found;
    for (const ScanPicture& known : pictures) {
        const bool ofFabric = lab.heldOutFabrics.contains(known.sha256);
        if (!ofFabric && !lab.heldOutPlaces.contains(known.sha256)) continue;
        for (const ScanPicture& other : pictures)
            if (other.place.fabric == known.place.fabric && (ofFabric || other.showsPlaceOf(known)))
                found.emplace(other.place.fabric, other.place.index);
    }
    return found;
}

}  // namespace rendering::models
