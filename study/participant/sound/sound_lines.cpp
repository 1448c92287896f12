#include "study/participant/sound/sound_lines.h"

#include <nlohmann/json.hpp>

#include "protocols/files/strict_json.h"

namespace study::participant {

namespace {

constexpr const char* soundLine = "a line of the app";
constexpr std::size_t mostFiles = 40;

protocols::Error refusedSoundLine(const std::string& what)
{
    return protocols::badInput({what, soundLine, R"({"noise": LEVEL} or {"play": [FILES]})", ""});
}

}  // namespace

std::string lineOf(const LineToSound& line)
{
    nlohmann::ordered_json text;
    if (const auto* noise = std::get_if<NoiseLevel>(&line))
        text["noise"] = noise->level;
    else
        text["play"] = std::get<PlayFiles>(line).files;
    return text.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

LineToSound lineToSound(std::string_view text)
{
    const nlohmann::json line = protocols::parseStrictJson(text, soundLine);
    if (!line.is_object() || line.size() != 1) throw refusedSoundLine("this line says nothing that the sound knows");
    if (line.contains("noise")) {
        const auto& level = line.at("noise");
        constexpr double loudest = 0.3;
        if (!level.is_number() || !(level.get<double>() >= 0 && level.get<double>() <= loudest))
            throw refusedSoundLine("'noise' is no number from 0 to 0.3");
        return NoiseLevel{level.get<double>()};
    }
    if (!line.contains("play") || !line.at("play").is_array() || line.at("play").size() > mostFiles)
        throw refusedSoundLine("'play' is no list of at most 40 files");
    PlayFiles play;
    for (const auto& file : line.at("play")) {
        if (!file.is_string()) throw refusedSoundLine("'play' names something that is no file");
        play.files.push_back(file.get<std::string>());
    }
    return play;
}

}  // namespace study::participant
