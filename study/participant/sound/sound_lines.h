// The lines between the app and vis2hap-sound, one JSON object a line.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace study::participant {

/// Root mean square of the masking noise, 0 to 0.3 of full scale.
struct NoiseLevel {
    double level = 0;
    bool operator==(const NoiseLevel&) const = default;
};
/// The language of texts to speak, BCP 47; empty to speak none.
struct SpeechLanguage {
    std::string tag;
    bool operator==(const SpeechLanguage&) const = default;
};
struct Recording {
    std::string file;  ///< a WAV file
    bool operator==(const Recording&) const = default;
};
inline constexpr std::size_t longestSpokenText = 8000;  ///< bytes, about eight minutes
struct SpokenText {
    std::string text;
    bool operator==(const SpokenText&) const = default;
};
using PromptPart = std::variant<Recording, SpokenText>;
/// Parts that mean something together only, such as those of a number: where one cannot be played, none is.
struct Together {
    std::vector<PromptPart> parts;
    bool operator==(const Together&) const = default;
};
using Prompt = std::variant<Recording, SpokenText, Together>;
/// Prompts to play one after another, in place of those that still play.
struct PlayPrompts {
    std::vector<Prompt> prompts;
    bool operator==(const PlayPrompts&) const = default;
};
using LineToSound = std::variant<NoiseLevel, SpeechLanguage, PlayPrompts>;

std::string lineOf(const LineToSound& line);
/// Throws badInput for anything that lineOf() does not write, and for more than 40 prompts or 40 parts of one.
LineToSound lineToSound(std::string_view text);

/// What vis2hap-sound says in a line, without control characters. A field that the line does not name is absent.
struct SaidBySound {
    std::optional<std::string> ready;    ///< the device that plays
    std::optional<std::string> voice;    ///< of the engine that speaks
    std::optional<std::string> noVoice;  ///< why no engine speaks
    std::optional<std::string> fault;
    bool operator==(const SaidBySound&) const = default;
};
/// nullopt for a line that is no message.
std::optional<SaidBySound> saidBySound(std::string_view line);

}  // namespace study::participant
