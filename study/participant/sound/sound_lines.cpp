#include "study/participant/sound/sound_lines.h"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>

#include "protocols/files/safe_text.h"
#include "protocols/files/strict_json.h"

namespace study::participant {

namespace {

constexpr const char* soundLine = "a line of the app";
constexpr std::size_t mostPrompts = 40;

protocols::Error refusedSoundLine(const std::string& what)
{
    return protocols::badInput({what, soundLine, R"({"noise": LEVEL}, {"language": TAG} or {"play": [PROMPTS]})", ""});
}

NoiseLevel noiseIn(const nlohmann::json& level)
{
    constexpr double loudest = 0.3;
    if (!level.is_number() || !(level.get<double>() >= 0 && level.get<double>() <= loudest))
        throw refusedSoundLine("'noise' is no number from 0 to 0.3");
    return {level.get<double>()};
}

/// The engine gets the tag as the name of a voice, so it must not look like an option or a path.
SpeechLanguage languageIn(const nlohmann::json& language)
{
    constexpr std::size_t longestTag = 35;
    const std::string tag = language.is_string() ? language.get<std::string>() : "-";
    const auto isPlain = [](char letter) { return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '-'; };
    if (tag.size() > longestTag || tag.starts_with('-') || !std::all_of(tag.begin(), tag.end(), isPlain))
        throw refusedSoundLine("'language' is no language tag");
    return {tag};
}

PromptPart partIn(const nlohmann::json& prompt)
{
    if (prompt.is_string()) return Recording{prompt.get<std::string>()};
    if (!prompt.is_object() || prompt.size() != 1 || !prompt.contains("say") || !prompt.at("say").is_string())
        throw refusedSoundLine("'play' names something that is neither a file nor a text");
    const std::string text = prompt.at("say").get<std::string>();
    if (text.size() > longestSpokenText) throw refusedSoundLine("'say' has more than 8,000 bytes");
    return SpokenText{text};
}

Prompt promptIn(const nlohmann::json& prompt)
{
    const auto asPrompt = [](const auto& part) { return Prompt(part); };
    if (!prompt.is_array()) return std::visit(asPrompt, partIn(prompt));
    if (prompt.empty() || prompt.size() > mostPrompts)
        throw refusedSoundLine("'play' names no part, or more than 40, of a prompt");
    Together together;
    for (const auto& part : prompt) together.parts.push_back(partIn(part));
    return together;
}

nlohmann::ordered_json promptJson(const Recording& recording) { return recording.file; }

nlohmann::ordered_json promptJson(const SpokenText& spoken)
{
    nlohmann::ordered_json say;
    say["say"] = spoken.text;
    return say;
}

nlohmann::ordered_json promptJson(const Together& together)
{
    auto parts = nlohmann::ordered_json::array();
    for (const PromptPart& one : together.parts)
        parts.push_back(std::visit([](const auto& part) { return promptJson(part); }, one));
    return parts;
}

}  // namespace

std::string lineOf(const LineToSound& line)
{
    nlohmann::ordered_json text;
    if (const auto* noise = std::get_if<NoiseLevel>(&line)) text["noise"] = noise->level;
    if (const auto* language = std::get_if<SpeechLanguage>(&line)) text["language"] = language->tag;
    if (const auto* play = std::get_if<PlayPrompts>(&line)) {
        text["play"] = nlohmann::ordered_json::array();
        for (const Prompt& prompt : play->prompts)
            text["play"].push_back(std::visit([](const auto& one) { return promptJson(one); }, prompt));
    }
    return text.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

LineToSound lineToSound(std::string_view text)
{
    const nlohmann::json line = protocols::parseStrictJson(text, soundLine);
    if (!line.is_object() || line.size() != 1) throw refusedSoundLine("this line says nothing that the sound knows");
    if (line.contains("noise")) return noiseIn(line.at("noise"));
    if (line.contains("language")) return languageIn(line.at("language"));
    if (!line.contains("play") || !line.at("play").is_array() || line.at("play").size() > mostPrompts)
        throw refusedSoundLine("'play' is no list of at most 40 prompts");
    PlayPrompts play;
    for (const auto& prompt : line.at("play")) play.prompts.push_back(promptIn(prompt));
    return play;
}

std::optional<SaidBySound> saidBySound(std::string_view line)
{
    const auto said = nlohmann::json::parse(line, nullptr, false);
    if (!said.is_object()) return std::nullopt;
    const auto text = [&](const char* key) -> std::optional<std::string> {
        const auto found = said.find(key);
        if (found == said.end()) return std::nullopt;
        return found->is_string() ? protocols::printable(found->get<std::string>()) : std::string();
    };
    return SaidBySound{text("ready"), text("voice"), text("no_voice"), text("fault")};
}

}  // namespace study::participant
