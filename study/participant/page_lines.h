// The lines between the app and vis2hap-page, one JSON object a line. The app sends codes, texts and the present instruction; the
// page's program sends back its port, its guests and the acts of the participant. Neither trusts the other: every line is read
// strictly and within a length.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "study/participant/participant_act.h"

namespace study::participant {

inline constexpr std::size_t longestLine = 1 << 18;  ///< bytes

// ---- from the app to the page
/// A new code for one browser; the browser that was in is out.
struct NewCode {
    std::string code;
    bool operator==(const NewCode&) const = default;
};
/// The browser that was in before the program was started again stays in.
struct KnownDevice {
    std::string sessionHash;
    bool operator==(const KnownDevice&) const = default;
};
/// The page's own words, by the keys of protocols::usualParticipantTexts(), and their language.
struct PageTexts {
    std::string language;
    std::map<std::string, std::string> texts;
    bool operator==(const PageTexts&) const = default;
};
struct NumberedInstruction {
    int number = 0;
    Instruction instruction;
    bool operator==(const NumberedInstruction&) const = default;
};
using LineToPage = std::variant<NewCode, KnownDevice, PageTexts, NumberedInstruction>;

std::string lineOf(const LineToPage& line);
/// Throws badInput for anything that lineOf() does not write.
LineToPage lineToPage(std::string_view text);

// ---- from the page to the app
struct Listening {
    int port = 0;
    bool operator==(const Listening&) const = default;
};
/// `from`: address of the browser.
struct DeviceEntered {
    std::string from, sessionHash;
    bool operator==(const DeviceEntered&) const = default;
};
struct WrongCodeEntered {
    std::string from;
    int tries = 0;
    bool isVoid = false;  ///< the code is not valid any more
    bool operator==(const WrongCodeEntered&) const = default;
};
/// Another browser tried to enter while one is in.
struct DeviceRefused {
    std::string from;
    bool operator==(const DeviceRefused&) const = default;
};
using LineFromPage = std::variant<Listening, DeviceEntered, WrongCodeEntered, DeviceRefused, ParticipantAct>;

std::string lineOf(const LineFromPage& line);
/// Throws badInput for anything that lineOf() does not write.
LineFromPage lineFromPage(std::string_view text);

/// Takes bytes as they come and gives whole lines, without their ends.
class LineBuffer {
public:
    /// Throws badInput where a line is longer than longestLine; the buffer is empty then.
    std::vector<std::string> take(std::string_view bytes);

private:
    std::string m_begun;
};

}  // namespace study::participant
