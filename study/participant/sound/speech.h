// Speech for prompts without a recording: the engine espeak-ng, a program of its own, writes each sentence as a WAV file.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace study::participant {

class SpeechEngine {
public:
    /// Chooses the engine's voice for a language (BCP 47), or for its main part: "pt-BR", then "pt". Returns the name of the
    /// voice. Throws environmentFault, with the next step, where there is no engine or no such voice.
    std::string chooseVoice(const std::string& language);

    /// Samples from -1 to 1 at mixRateHz; empty for a blank text. The engine gets the text as data on its standard input. Throws
    /// protocols::Error where no voice was chosen, or where the engine fails, takes more than 5 s, or writes more than 32 MiB.
    std::vector<float> spoken(const std::string& text);

private:
    std::string m_program;
    std::string m_voice;                               ///< empty until one is chosen
    std::map<std::string, std::vector<float>> m_kept;  ///< by text, of this voice
};

/// The text without control characters, and without the brackets by which the engine takes a text as phonemes.
std::string plainSpeech(const std::string& text);

}  // namespace study::participant
