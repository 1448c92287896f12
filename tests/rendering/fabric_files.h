// Shared by the tests of data sets and importers: files written and read whole, a small data set, and the message
// of a refusal.
#pragma once

#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <opencv2/core.hpp>
#include <string>

#include "protocols/files/errors.h"
#include "rendering/fabrics/dataset.h"
#include "rendering/fabrics/friction_record.h"
#include "rendering/fabrics/sample_places.h"
#include "rendering/images/image_png.h"
#include "rendering/images/image_tiff.h"

namespace fabric_files {

namespace fs = std::filesystem;
using protocols::FabricId;

inline fs::path pathOf(const QTemporaryDir& folder) { return folder.path().toStdString(); }

inline void write(const fs::path& file, const std::string& bytes)
{
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << bytes;
}

inline std::string read(const fs::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// Relative path and bytes of every file below a folder.
inline std::map<std::string, std::string> contentOf(const fs::path& folder)
{
    std::map<std::string, std::string> content;
    if (fs::exists(folder))
        for (const auto& entry : fs::recursive_directory_iterator(folder))
            if (entry.is_regular_file()) content[entry.path().lexically_relative(folder).string()] = read(entry.path());
    return content;
}

/// The message of the refusal, or an empty text where nothing was refused. Its exit code must be `code`.
template <class Action>
std::string refusalOf(Action action, protocols::ExitCode code = protocols::ExitCode::BadInput)
{
    try {
        action();
    } catch (const protocols::Error& error) {
        return error.exitCode() == code ? error.what() : "wrong exit code: " + std::string(error.what());
    }
    return {};
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

inline cv::Mat speckled(int rows, int columns, int type, int salt = 0)
{
    cv::Mat image(rows, columns, type);
    for (int y = 0; y < rows; ++y)
        for (std::size_t x = 0; x < image.step[0]; ++x)
            image.ptr(y)[x] = static_cast<uchar>((std::size_t(y) * 37 + x * 11 + std::size_t(salt) * 101 + x * x % 7) % 251);
    return image;
}

/// Two fabrics. F01 has all three signals (2 photographs, 1 press with known height, 2 strokes), F02 has a stroke of counts.
inline rendering::fabrics::Dataset smallDataset(const fs::path& folder)
{
    using namespace rendering;
    using namespace rendering::fabrics;
    Dataset dataset;
    dataset.folder = folder;
    dataset.name = "small";
    dataset.fabrics = {{FabricId("F01"), "Linen", "plain weave"}, {FabricId("F02"), "Felt, \"thick\"", ""}};
    dataset.cameraMmPerPixel = 0.04;
    dataset.tactileMmPerPixel = 0.05;
    dataset.tactileCalibration = "known";
    dataset.friction = {60, 5, 40};
    dataset.licence = "CC0-1.0";
    for (const char* sub : {"F01/visual", "F01/tactile", "F01/height", "F01/friction", "F02/friction"})
        fs::create_directories(folder / sub);
    writePng(folder / "F01/visual/000.png", speckled(20, 30, CV_8UC3, 1));
    writePng(folder / "F01/visual/001.png", speckled(20, 30, CV_8UC3, 2));
    writePng(folder / "F01/tactile/000.png", speckled(24, 32, CV_8UC3, 3));
    writePng(folder / "tactile-reference.png", speckled(24, 32, CV_8UC3, 4));
    writeTiff(folder / "F01/height/000.tiff", cv::Mat(24, 32, CV_32FC1, cv::Scalar(0.125)));
    write(folder / "F01/friction/000.csv",
          "t_s,normal_n,tangential_n\n0,10,2\n0.5,10,3\n1,20,4\n1.5,10,2\n2,10,3\n2.5,20,4\n3,10,2\n3.5,10,3\n");
    write(folder / "F01/friction/001.csv",
          "t_s,COF\r\n0,0.25\r\n0.1,0.5\r\n0.2,0.5\r\n0.3,0.25\r\n0.4,0.5\r\n0.5,0.5\r\n0.6,0.25\r\n0.7,0.5\r\n");
    write(folder / "F02/friction/000.csv",
          "t_s,taxel_sum_counts\n0,2000\n0.02,2010\n0.04,1990\n0.06,2000\n0.08,2010\n0.1,1990\n0.12,2000\n0.14,2010\n");
    writeDatasetJson(dataset);
    writeSamplePlaces(dataset, {{FabricId("F01"), Modality::Visual, 0, 1.5, 2.25, 30, "a, first"},
                                {FabricId("F01"), Modality::Visual, 1, {}, {}, {}, "b"},
                                {FabricId("F01"), Modality::Tactile, 0, 0.1, {}, {}, "c"},
                                {FabricId("F01"), Modality::Friction, 0, {}, {}, {}, "d"},
                                {FabricId("F01"), Modality::Friction, 1, {}, {}, {}, "e"},
                                {FabricId("F02"), Modality::Friction, 0, {}, {}, {}, "f"}});
    return dataset;
}

/// Folder of the shared recordings, or an empty path.
inline fs::path sharedData()
{
    const QByteArray named = qgetenv("VIS2HAP_SHARED");
    const fs::path shared = named.isEmpty() ? fs::path(VIS2HAP_SOURCE_DIR) / ".." / "shared" : fs::path(named.toStdString());
    return fs::is_directory(shared / "data") ? fs::canonical(shared / "data") : fs::path();
}

}  // namespace fabric_files
