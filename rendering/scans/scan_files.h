// Files of scanned materials, sorted by fabric and by what they hold, from their names alone: weave_diff_2k.jpg,
// weave_nor_gl_2k.png, Fabric023_2K-JPG_NormalDX.jpg, linen_basecolor.png, normal.tif in a folder of its own.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rendering::scans {

enum class MapRole { Colour, Normals, Displacement };

/// Direction of the green channel of a normal map, as the file name states it.
enum class GreenUp { Unstated, Yes /* OpenGL */, No /* DirectX */ };

/// What a file name says.
struct MapName {
    std::string fabric;  ///< "weave"; empty where the name holds nothing else
    MapRole role = MapRole::Colour;
    GreenUp green = GreenUp::Unstated;
};
/// Reads the stem of a file name. Returns nullopt for roughness, occlusion and everything else that is not one of the roles.
std::optional<MapName> mapNamed(std::string_view stem);

struct MapFile {
    std::filesystem::path file;
    GreenUp green = GreenUp::Unstated;
};

/// The files of one fabric.
struct ScanFiles {
    std::string name;
    std::filesystem::path folder;
    std::vector<MapFile> colour, normals, displacement;  ///< several where a folder holds several sizes or both green signs
};

struct FoundScans {
    std::vector<ScanFiles> fabrics;               ///< in the order of their names
    std::vector<std::filesystem::path> leftOver;  ///< images of no known role
    std::vector<std::filesystem::path> unread;    ///< maps by their names, in formats that are not read (.exr, .tga and others)
};

/// Searches a folder and its sub-folders. Throws badInput that names the folder where no fabric has colour, and that names
/// the fabric which has no colour, or neither normals nor displacement. Throws badInput that names an unread file where a fabric
/// lacks its colour or normals, or, without normals, its displacement.
FoundScans scansIn(const std::filesystem::path& folder);

}  // namespace rendering::scans
