#include "rendering/scans/scan_files.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>

#include "protocols/files/errors.h"
#include "rendering/fabrics/recordings/import_sources.h"
#include "rendering/fabrics/recordings/photograph_files.h"

namespace rendering::scans {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view separators = "_-. ";
constexpr std::array<std::string_view, 9> colourWords{"diff",  "diffuse", "albedo", "basecolor", "basecolour",
                                                      "color", "colour",  "col",    "alb"};
constexpr std::array<std::string_view, 6> normalWords{"nor", "normal", "normals", "nrm", "norm", "normalmap"};
constexpr std::array<std::string_view, 8> displacementWords{"disp", "displacement", "height",   "heightmap",
                                                            "bump", "depthmap",     "displace", "hgt"};
constexpr std::array<std::string_view, 4> openGlWords{"gl", "ogl", "opengl", "yup"};
constexpr std::array<std::string_view, 4> directXWords{"dx", "directx", "dirx", "ydown"};
/// Words that describe a file and are no part of a fabric's name.
constexpr std::array<std::string_view, 14> fillers{"jpg",     "jpeg", "png",  "tif",  "tiff",  "map",  "tex",
                                                   "texture", "base", "srgb", "8bit", "16bit", "var1", "seamless"};
constexpr std::array<std::string_view, 4> plainFolders{"textures", "texture", "maps", "images"};
/// Formats of images in which libraries and drawing programs give maps, and which are not read.
constexpr std::array<std::string_view, 18> unreadEndings{".exr",  ".hdr",  ".tga", ".webp", ".psd",  ".dds",
                                                         ".ktx",  ".ktx2", ".jp2", ".jxl",  ".heic", ".heif",
                                                         ".avif", ".gif",  ".pfm", ".ppm",  ".pgm",  ".tx"};

template <std::size_t N>
bool isOneOf(const std::string& word, const std::array<std::string_view, N>& words)
{
    return std::find(words.begin(), words.end(), word) != words.end();
}

/// "1k", "16k", "1024", "2048x2048"; other numbers may belong to the name of a fabric.
bool isSize(const std::string& word)
{
    static constexpr std::array<std::string_view, 6> sides{"512", "1024", "2048", "4096", "8192", "16384"};
    const auto digits = word.find_first_not_of("0123456789");
    if (digits == std::string::npos) return isOneOf(word, sides);
    if (digits == 0) return false;
    return word.substr(digits) == "k" || (word[digits] == 'x' && isOneOf(word.substr(0, digits), sides));
}

struct Word {
    std::string text;   ///< lower case
    std::size_t start;  ///< in the stem
};

std::vector<Word> wordsOf(std::string_view stem)
{
    std::vector<Word> words;
    for (std::size_t at = 0; at < stem.size();) {
        const std::size_t end = std::min(stem.find_first_of(separators, at), stem.size());
        if (end > at) words.push_back({fabrics::lowerCase(std::string(stem.substr(at, end - at))), at});
        at = end + 1;
    }
    return words;
}

/// Takes a sign of the green channel off the end of a word: "normalgl" becomes "normal".
GreenUp greenAtEnd(std::string& word)
{
    const auto ends = [&](const auto& signs) {
        for (const std::string_view sign : signs)
            if (word.ends_with(sign) && isOneOf(word.substr(0, word.size() - sign.size()), normalWords)) {
                word.resize(word.size() - sign.size());
                return true;
            }
        return false;
    };
    return ends(directXWords) ? GreenUp::No : ends(openGlWords) ? GreenUp::Yes : GreenUp::Unstated;
}

std::optional<MapRole> roleOf(const std::string& word)
{
    if (isOneOf(word, colourWords)) return MapRole::Colour;
    if (isOneOf(word, normalWords)) return MapRole::Normals;
    if (isOneOf(word, displacementWords)) return MapRole::Displacement;
    return {};
}

bool isFiller(const std::string& word) { return isSize(word) || isOneOf(word, fillers); }

std::string nameOfFolder(const fs::path& folder)
{
    const std::string name = folder.filename().string();
    return isOneOf(fabrics::lowerCase(name), plainFolders) ? folder.parent_path().filename().string() : name;
}

using FabricKey = std::pair<std::string, fs::path>;

FabricKey keyOf(const fs::path& file, const MapName& map)
{
    const fs::path folder = fs::absolute(file).lexically_normal().parent_path();
    return {map.fabric.empty() ? nameOfFolder(folder) : map.fabric, folder};
}

std::map<FabricKey, ScanFiles> sorted(const std::vector<fabrics::SourceFile>& files, std::vector<fs::path>& leftOver)
{
    std::map<FabricKey, ScanFiles> found;
    for (const auto& source : files) {
        const auto map = mapNamed(source.file.stem().string());
        if (!map) {
            leftOver.push_back(source.file);
            continue;
        }
        const FabricKey key = keyOf(source.file, *map);
        ScanFiles& fabric = found[key];
        std::tie(fabric.name, fabric.folder) = key;
        auto& list = map->role == MapRole::Colour    ? fabric.colour
                     : map->role == MapRole::Normals ? fabric.normals
                                                     : fabric.displacement;
        list.push_back({source.file, map->green});
    }
    return found;
}

/// Maps by their names, in formats that are not read.
std::vector<fs::path> unreadMaps(const fs::path& folder)
{
    std::vector<fs::path> maps;
    std::error_code problem;
    fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, problem);
    for (; !problem && entry != fs::recursive_directory_iterator(); entry.increment(problem)) {
        const fs::path& file = entry->path();
        std::error_code unknown;
        if (fabrics::isHidden(file))
            entry.disable_recursion_pending();
        else if (isOneOf(fabrics::lowerCase(file.extension().string()), unreadEndings) && entry->is_regular_file(unknown) &&
                 mapNamed(file.stem().string()))
            maps.push_back(file);
    }
    std::sort(maps.begin(), maps.end());
    return maps;
}

/// Normals tell more than a displacement does, so beside them it may be missing.
const char* lackingRole(const ScanFiles& fabric, MapRole role)
{
    switch (role) {
        case MapRole::Colour:
            return fabric.colour.empty() ? "colour" : nullptr;
        case MapRole::Normals:
            return fabric.normals.empty() ? "normals" : nullptr;
        case MapRole::Displacement:
            return fabric.normals.empty() && fabric.displacement.empty() ? "displacement" : nullptr;
    }
    return nullptr;
}

/// Without this, a fabric whose measured normals lie beside it would get guessed slopes.
void requireNoneNeeded(const std::vector<fs::path>& unread, const std::map<FabricKey, ScanFiles>& found)
{
    for (const fs::path& file : unread) {
        const MapName map = mapNamed(file.stem().string()).value();
        const FabricKey key = keyOf(file, map);
        auto fabric = found.find(key);
        if (fabric == found.end())  // The formats of one fabric may lie in folders of their own.
            fabric = std::find_if(found.begin(), found.end(), [&](const auto& one) { return one.first.first == key.first; });
        const char* const role = fabric == found.end() ? nullptr : lackingRole(fabric->second, map.role);
        if (!role) continue;
        throw protocols::badInput({"is not read, and \"" + fabric->second.name + "\" has no other file with its " + role,
                                   file.string(), "PNG, JPEG or TIFF",
                                   map.role == MapRole::Colour
                                       ? "convert it to PNG"
                                       : "convert it to a PNG of 16 bits whose numbers stay as they are"});
    }
}

void requireComplete(const ScanFiles& fabric)
{
    const bool hasColour = !fabric.colour.empty();
    if (hasColour && (!fabric.normals.empty() || !fabric.displacement.empty())) return;
    throw protocols::badInput(
        {hasColour ? "\"" + fabric.name + "\" has colour but neither normals nor displacement, so its height is unknown"
                   : "\"" + fabric.name + "\" has no colour",
         fabric.folder.string(),
         hasColour ? "a file such as " + fabric.name + "_nor_gl_2k.png or " + fabric.name + "_disp_2k.png"
                   : "a file such as " + fabric.name + "_diff_2k.jpg",
         hasColour ? "add the file, or import the photograph alone with `vis2hap import photos`" : "add the file"});
}

}  // namespace

std::optional<MapName> mapNamed(std::string_view stem)
{
    std::vector<Word> words = wordsOf(stem);
    MapName map;
    while (!words.empty() && isFiller(words.back().text)) words.pop_back();
    if (!words.empty() && isOneOf(words.back().text, directXWords)) map.green = GreenUp::No;
    if (!words.empty() && isOneOf(words.back().text, openGlWords)) map.green = GreenUp::Yes;
    if (map.green != GreenUp::Unstated) words.pop_back();
    if (words.empty()) return {};
    std::string last = words.back().text;
    const GreenUp attached = greenAtEnd(last);
    const auto role = roleOf(last);
    if (!role || (*role != MapRole::Normals && map.green != GreenUp::Unstated)) return {};
    map.role = *role;
    if (attached != GreenUp::Unstated) map.green = attached;
    words.pop_back();
    while (!words.empty() && isFiller(words.back().text)) words.pop_back();
    if (!words.empty()) map.fabric = std::string(stem.substr(0, words.back().start + words.back().text.size()));
    return map;
}

FoundScans scansIn(const fs::path& folder)
{
    const fs::path from[] = {folder};
    const auto files = fabrics::sourceFiles(from, fabrics::photographEndings(), fabrics::FabricNaming::FolderOrFile);
    FoundScans scans;
    auto found = sorted(files, scans.leftOver);
    scans.unread = unreadMaps(folder);
    requireNoneNeeded(scans.unread, found);
    std::map<std::string, int> uses;
    for (const auto& [key, fabric] : found) ++uses[key.first];
    for (auto& [key, fabric] : found) {
        requireComplete(fabric);
        if (uses.at(key.first) > 1) fabric.name = nameOfFolder(key.second) + " " + key.first;
        scans.fabrics.push_back(std::move(fabric));
    }
    if (scans.fabrics.empty())
        throw protocols::badInput(
            {"holds no scanned material", folder.string(),
             "files such as NAME_diff_2k.jpg and NAME_nor_gl_2k.png, or NAME_Color.jpg and NAME_NormalGL.jpg",
             "choose the folder with the images, or rename them"});
    return scans;
}

}  // namespace rendering::scans
