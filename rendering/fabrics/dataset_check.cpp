#include "rendering/fabrics/dataset_check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <set>
#include <tuple>

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"
#include "rendering/fabrics/dataset.h"
#include "rendering/fabrics/dataset_json.h"
#include "rendering/fabrics/friction_record.h"
#include "rendering/fabrics/sample_places.h"
#include "rendering/images/sensor_appearance.h"

namespace rendering::fabrics {

namespace fs = std::filesystem;

namespace {

std::string sizeText(cv::Size size) { return std::to_string(size.width) + " x " + std::to_string(size.height); }

/// The sensor that a calibration states; nullopt where its form is not that of a sensor.
std::optional<SensorAppearance> statedSensor(const nlohmann::json& sensor)
{
    try {
        const auto side = [&](const char* name) {
            const double px = sensor.at(name).get<double>();
            return px >= 1 && px <= 1 << 20 ? static_cast<int>(px) : 0;
        };
        return SensorAppearance{side("width"), side("height"), sensor.at("colours").get<std::vector<double>>()};
    } catch (const nlohmann::json::exception&) {
        return std::nullopt;
    }
}

class DatasetCheck {
public:
    DatasetCheck(const fs::path& folder, const std::function<void(int, int)>& progress) : m_folder(folder), m_progress(progress)
    {
    }

    DatasetFindings run()
    {
        try {
            m_dataset = datasetFromJson(protocols::readWholeFile(m_folder / "dataset.json", protocols::largestJson),
                                        (m_folder / "dataset.json").string());
        } catch (const protocols::Error& error) {
            return {{error.what()}, {}};  // The list of fabrics is missing, so no other file can be checked.
        }
        m_dataset.folder = m_folder;
        if (m_dataset.fabrics.empty()) fault("dataset.json", "lists no fabrics");
        checkFolders();
        for (const FabricInfo& fabric : m_dataset.fabrics)
            for (const Modality modality : allModalities)
                m_samples += static_cast<int>(sampleIndices(m_dataset, fabric.id, modality).size());
        for (const FabricInfo& fabric : m_dataset.fabrics) checkSamples(fabric);
        checkSizes();
        noteGaps();
        noteQuantities();
        checkSensor();
        checkPlaces();
        return {m_faults, m_notes};
    }

private:
    void fault(const fs::path& file, const std::string& what) { m_faults.push_back((m_folder / file).string() + ": " + what); }

    /// False where the reader throws; its message, which names the file, becomes a fault.
    template <class Read>
    bool readable(Read read)
    {
        try {
            read();
            return true;
        } catch (const protocols::Error& error) {
            m_faults.emplace_back(error.what());
        }
        return false;
    }

    void checkFolders()
    {
        for (const auto& entry : fs::directory_iterator(m_folder)) {
            const std::string name = entry.path().filename().string();
            if (!entry.is_directory()) continue;
            const bool known = std::any_of(m_dataset.fabrics.begin(), m_dataset.fabrics.end(),
                                           [&](const FabricInfo& fabric) { return fabric.id.value == name; });
            if (!known) fault(name, "is a folder of no fabric in dataset.json");
        }
        for (const FabricInfo& fabric : m_dataset.fabrics) {
            if (!fs::is_directory(m_folder / fabric.id.value)) {
                fault(fabric.id.value, "the folder of this fabric is missing");
                continue;
            }
            for (const auto& entry : fs::directory_iterator(m_folder / fabric.id.value)) checkSignalFolder(fabric, entry);
        }
    }

    void checkSignalFolder(const FabricInfo& fabric, const fs::directory_entry& entry)
    {
        const std::string name = entry.path().filename().string();
        const fs::path relative = fs::path(fabric.id.value) / name;
        const bool signal =
            std::any_of(std::begin(allModalities), std::end(allModalities), [&](Modality m) { return nameOf(m) == name; });
        if (!entry.is_directory() || (!signal && name != "height" && name != "surface")) {
            fault(relative, "is none of visual, tactile, friction, height and surface");
            return;
        }
        const auto expected = filesOf(fabric, name);
        for (const auto& file : fs::directory_iterator(entry.path()))
            if (!expected.contains(file.path().filename().string()))
                fault(relative / file.path().filename(),
                      name == "height"    ? "is a height without a tactile frame, or its name is wrong"
                      : name == "surface" ? "is a surface without a photograph, or its name is wrong"
                                          : "does not have the name of a sample (000.png, 000.csv)");
    }

    std::set<std::string> filesOf(const FabricInfo& fabric, const std::string& folder) const
    {
        std::set<std::string> names;
        for (const Modality modality : allModalities)
            for (const int index : sampleIndices(m_dataset, fabric.id, modality)) {
                if (nameOf(modality) == folder)
                    names.insert(samplePath(m_dataset, fabric.id, modality, index).filename().string());
                if (modality == Modality::Friction && folder == nameOf(modality))  // The report of its import.
                    names.insert(samplePath(m_dataset, fabric.id, modality, index).stem().string() + ".json");
                if (modality == Modality::Tactile && folder == "height")
                    names.insert(knownHeightPath(m_dataset, fabric.id, index).filename().string());
                if (modality == Modality::Visual && folder == "surface")
                    names.insert(surfacePath(m_dataset, fabric.id, index).filename().string());
            }
        return names;
    }

    void checkSamples(const FabricInfo& fabric)
    {
        int samples = 0;
        for (const Modality modality : allModalities)
            for (const int index : sampleIndices(m_dataset, fabric.id, modality)) {
                ++samples;
                if (m_progress) m_progress(m_done++, m_samples);
                m_present.insert({fabric.id.value, modality, index});
                checkSample(fabric, modality, index);
            }
        if (samples == 0 && fs::is_directory(m_folder / fabric.id.value)) fault(fabric.id.value, "holds no samples");
    }

    void checkSample(const FabricInfo& fabric, Modality modality, int index)
    {
        const fs::path file = samplePath(m_dataset, fabric.id, modality, index);
        switch (modality) {
            case Modality::Visual: {
                cv::Size size;
                readable([&] {
                    size = readPhotograph(m_dataset, fabric.id, index).size();
                    m_sizes["visual"].emplace_back(file, size);
                });
                readable([&] { checkSurface(fabric, index, size); });
                return;
            }
            case Modality::Tactile: {
                cv::Size size;
                readable([&] {
                    size = readTactileFrame(m_dataset, fabric.id, index).size();
                    m_sizes["tactile"].emplace_back(file, size);
                });
                readable([&] { checkHeight(fabric, index, size); });
                return;
            }
            case Modality::Friction:
                readable([&] {
                    const FrictionRecord record = readFriction(m_dataset, fabric.id, index);
                    if (record.isCoefficient()) requireAxisAlongStroke(record.mean(), file.string());
                    if (record.values.size() < shortestTrace)
                        fault(file.lexically_relative(m_folder), "has only " + std::to_string(record.values.size()) +
                                                                     " samples; a friction image needs " +
                                                                     std::to_string(shortestTrace));
                    m_quantities.try_emplace(record.quantity, file);
                });
                return;
        }
    }

    void checkHeight(const FabricInfo& fabric, int index, cv::Size frameSize)
    {
        const auto height = readKnownHeight(m_dataset, fabric.id, index);
        if (!height) return;
        const fs::path file = knownHeightPath(m_dataset, fabric.id, index).lexically_relative(m_folder);
        if (frameSize.area() > 0 && height->size() != frameSize)
            fault(file, "is " + sizeText(height->size()) + ", but the tactile frame is " + sizeText(frameSize));
        bool finite = true, positive = true;
        for (const float value : cv::Mat_<float>(*height)) {
            finite = finite && std::isfinite(value);
            positive = positive && !(value < 0);
        }
        if (!finite) fault(file, "holds heights that are not finite");
        if (!positive) fault(file, "holds heights below 0");
    }

    void checkSurface(const FabricInfo& fabric, int index, cv::Size photographSize)
    {
        const auto surface = readSurface(m_dataset, fabric.id, index);
        if (!surface) return;
        const fs::path file = surfacePath(m_dataset, fabric.id, index).lexically_relative(m_folder);
        if (photographSize.area() > 0 && surface->size() != photographSize)
            fault(file, "is " + sizeText(surface->size()) + ", but the photograph is " + sizeText(photographSize));
        int unmeasured = 0;
        bool infinite = false;
        for (const float value : cv::Mat_<float>(*surface)) {
            unmeasured += std::isnan(value) ? 1 : 0;
            infinite = infinite || std::isinf(value);
        }
        if (infinite) fault(file, "holds infinite heights");
        const double share = unmeasured / static_cast<double>(surface->total());
        if (share >= 1) fault(file, "holds no measured height");
        if (share == 0 || share >= 1) return;
        m_surfacesWithGaps += 1;
        if (share <= m_largestGap) return;
        m_largestGap = share;
        m_mostGaps = file.string() + ": " + std::to_string(unmeasured) + " of " + std::to_string(surface->total()) + " points, " +
                     protocols::fixed(100 * share, 2) + " %";
    }

    /// NaN marks points without a measurement, so that they are no fault.
    void noteGaps()
    {
        if (m_surfacesWithGaps == 0) return;
        m_notes.push_back(m_folder.string() + ": " + std::to_string(m_surfacesWithGaps) +
                          (m_surfacesWithGaps == 1 ? " surface has" : " surfaces have") +
                          " points without a measured height (NaN), most of them in " + m_mostGaps);
    }

    static std::map<std::pair<int, int>, int> countsOf(const std::vector<std::pair<fs::path, cv::Size>>& sizes)
    {
        std::map<std::pair<int, int>, int> counts;
        for (const auto& [file, size] : sizes) ++counts[{size.width, size.height}];
        return counts;
    }

    /// Reports tactile frames that differ from their most frequent size. Photographs of different sizes are usual, because each
    /// one is cut and scaled by itself.
    void checkSizes()
    {
        for (const auto& [signal, sizes] : m_sizes) {
            const auto counts = countsOf(sizes);
            if (counts.size() < 2) continue;
            if (signal == "visual") {
                noteSizes(counts);
                continue;
            }
            const auto commonest =
                std::max_element(counts.begin(), counts.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
            const cv::Size usual(commonest->first.first, commonest->first.second);
            for (const auto& [file, size] : sizes)
                if (size != usual)
                    fault(file.lexically_relative(m_folder),
                          "is " + sizeText(size) + ", but most " + signal + " samples are " + sizeText(usual));
        }
    }

    /// Images of different quantities have no range in common: the finger cannot compare them.
    void noteQuantities()
    {
        if (m_quantities.size() < 2) return;
        std::string list;
        for (const auto& [quantity, file] : m_quantities)
            list += (list.empty() ? "" : ", ") + quantity + " (such as " + file.lexically_relative(m_folder).string() + ")";
        m_notes.push_back(m_folder.string() +
                          ": the friction records hold different quantities, each with a range of its own: " + list);
    }

    void noteSizes(const std::map<std::pair<int, int>, int>& counts)
    {
        std::string list;
        for (const auto& [size, count] : counts)
            list += (list.empty() ? "" : ", ") + sizeText({size.first, size.second}) + " (" + std::to_string(count) + ")";
        m_notes.push_back(m_folder.string() + ": the photographs have different sizes: " + list);
    }

    void checkSensor()
    {
        const auto& frames = m_sizes["tactile"];
        const bool calibrated = !m_dataset.tactileCalibration.empty();
        cv::Mat reference;
        if (fs::exists(m_folder / "tactile-reference.png")) {
            readable([&] {
                reference = readTactileReference(m_dataset);
                if (!frames.empty() && frames.front().second != reference.size())
                    fault("tactile-reference.png",
                          "is " + sizeText(reference.size()) + ", but the frames are " + sizeText(frames.front().second));
            });
        } else if (calibrated && m_dataset.tactileCalibration != "known" && !frames.empty()) {
            fault("tactile-reference.png", "is missing, but the frames are calibrated");
        }
        if (!calibrated || m_dataset.tactileCalibration == "known") return;
        const fs::path file = m_folder / m_dataset.tactileCalibration;
        readable([&] {
            const nlohmann::json calibration =
                protocols::parseStrictJson(protocols::readWholeFile(file, protocols::largestJson), file.string());
            if (calibration.is_object() && calibration.value("schema", nlohmann::json()) == "vis2hap.calibration/1")
                checkCalibratedSensor(calibration, reference);
            else
                fault(m_dataset.tactileCalibration, "is not a calibration (schema vis2hap.calibration/1)");
        });
    }

    /// With the calibration of another sensor, or of frames of another size, heights have another scale.
    void checkCalibratedSensor(const nlohmann::json& calibration, const cv::Mat& reference)
    {
        const auto sensor = calibration.value("sensor", nlohmann::json());
        const auto stated = sensor.is_null() ? std::nullopt : statedSensor(sensor);
        if (!sensor.is_null() && !stated)
            fault(m_dataset.tactileCalibration, "states its sensor without width, height and colours");
        if (stated && !reference.empty())
            if (const auto difference = differenceOf(*stated, appearanceOf(reference)))
                fault("tactile-reference.png", "is not of the sensor of " + m_dataset.tactileCalibration + ": " + *difference);
        const auto pitch = calibration.value("mm_per_pixel", nlohmann::json());
        if (!pitch.is_number() || !m_dataset.tactileMmPerPixel) return;
        if (const double mm = pitch.get<double>(); !isSamePitch(mm, *m_dataset.tactileMmPerPixel))
            fault(m_dataset.tactileCalibration, "is for frames of " + protocols::shortest(mm) +
                                                    " mm per pixel, but dataset.json states " +
                                                    protocols::shortest(*m_dataset.tactileMmPerPixel));
    }

    void checkPlaces()
    {
        if (!fs::exists(m_folder / "samples.csv")) return;
        std::vector<SamplePlace> places;
        if (!readable([&] { places = readSamplePlaces(m_dataset); })) return;
        std::set<SampleKey> listed;
        for (const SamplePlace& place : places) {
            const SampleKey key{place.fabric.value, place.modality, place.index};
            const std::string name = place.fabric.value + " " + nameOf(place.modality) + " " + std::to_string(place.index);
            listed.insert(key);
            if (!m_present.contains(key)) fault("samples.csv", "lists " + name + ", which has no file");
        }
        for (const SampleKey& key : m_present)
            if (!listed.contains(key)) {
                const auto& [fabric, modality, index] = key;
                fault(samplePath(m_dataset, protocols::FabricId(fabric), modality, index).lexically_relative(m_folder),
                      "has no row in samples.csv");
            }
    }

    using SampleKey = std::tuple<std::string, Modality, int>;

    fs::path m_folder;
    const std::function<void(int, int)>& m_progress;
    int m_samples = 0, m_done = 0;
    Dataset m_dataset;
    std::vector<std::string> m_faults, m_notes;
    int m_surfacesWithGaps = 0;  ///< with NaN in a part of their points
    double m_largestGap = 0;     ///< share of NaN in the surface that has most
    std::string m_mostGaps;      ///< that surface and its count
    std::map<std::string, std::vector<std::pair<fs::path, cv::Size>>> m_sizes;
    std::set<SampleKey> m_present;
    std::map<std::string, fs::path> m_quantities;  ///< of the friction records, each with one of them
};

}  // namespace

DatasetFindings findingsOfDataset(const fs::path& folder, const std::function<void(int, int)>& progress)
{
    requireDatasetFolder(folder);
    return DatasetCheck(folder, progress).run();
}

std::vector<std::string> faultsOfDataset(const fs::path& folder, const std::function<void(int, int)>& progress)
{
    return findingsOfDataset(folder, progress).faults;
}

}  // namespace rendering::fabrics
