#include "tests/fuzz/page_readers.h"

#include <algorithm>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "protocols/files/errors.h"
#include "study/participant/page_room.h"
#include "study/participant/sound/sound_lines.h"
#include "study/participant/sound/wav_sound.h"
#include "tests/fuzz/made_files.h"

namespace fuzz {

namespace {

using namespace study::participant;

constexpr const char* host = "127.0.0.1:8577";

Instruction scaleTraining()
{
    Instruction instruction;
    instruction.task = Task::Scale;
    instruction.title = "Learn the scale";
    instruction.scale = ScaleTask{};
    instruction.scale->scale.labels = {"no", "yes"};
    instruction.scale->asked = protocols::Tenths{35};
    instruction.scale->last = ScaleFeedback{{35}, {30}, true, "Right."};
    return instruction;
}

/// Bytes as a request: a line each for method, path, host, origin, cookie and content type; the rest is the body.
PageRequest requestFrom(const std::string& bytes)
{
    std::istringstream stream(bytes);
    PageRequest request;
    for (std::string* part :
         {&request.method, &request.path, &request.host, &request.origin, &request.cookie, &request.contentType})
        std::getline(stream, *part);
    request.body.assign(std::istreambuf_iterator<char>(stream), {});
    request.from = "127.0.0.1";
    return request;
}

Instruction instructionOf(Task task)
{
    if (task == Task::Scale) return scaleTraining();
    Instruction instruction;
    instruction.task = task;
    instruction.title = "Before you begin";
    instruction.lines = {"Feel the cloth."};
    if (task == Task::Consent) instruction.statement = "I agree.";
    if (task == Task::Facts) instruction.questions = {"How old are you?", "Which hand do you write with?"};
    if (task == Task::Read) instruction.breakSeconds = 30;
    return instruction;
}

/// The requests of an input, and the instruction that its first digit chooses.
struct Visit {
    Task task = Task::Scale;
    std::vector<PageRequest> requests;
};

constexpr char betweenRequests = '\x1e';

Visit visitFrom(const std::string& bytes)
{
    constexpr std::size_t mostRequests = 10;
    constexpr Task tasks[] = {Task::Read, Task::Consent, Task::Facts, Task::Scale};
    Visit visit;
    std::size_t begin = 0;
    if (!bytes.empty() && bytes[0] >= '0' && bytes[0] <= '3') visit.task = tasks[bytes[begin++] - '0'];
    while (visit.requests.size() < mostRequests) {
        const std::size_t end = std::min(bytes.find(betweenRequests, begin), bytes.size());
        visit.requests.push_back(requestFrom(bytes.substr(begin, end - begin)));
        if (end == bytes.size()) break;
        begin = end + 1;
    }
    return visit;
}

/// Whatever comes in, nobody without the cookie sees the instruction or acts, and every line for the app can be read.
void answer(const std::string& bytes)
{
    const Visit visit = visitFrom(bytes);
    PageRoom room(host, {"html", "css", "js"}, PageAccess([] { return "secret"; }, {}));
    room.take(NewCode{"482913"}, 0);
    room.take(NumberedInstruction{7, instructionOf(visit.task)}, 0);
    std::int64_t nowNs = 0;
    bool hasEntered = false;
    for (const PageRequest& request : visit.requests) {
        const PageReply before = room.answer(request, ++nowNs);
        const bool isCodeNamed = request.path == "/enter" && request.body.find("482913") != std::string::npos;
        hasEntered = hasEntered || (before.status == 204 && isCodeNamed);
        if (before.status >= 200 && before.status < 300 && !hasEntered && request.path != "/" && request.path != "/words" &&
            !request.path.starts_with("/page."))
            throw std::runtime_error("a browser without a code was served");
        if (before.status < 300 && request.host != host) throw std::runtime_error("another host was served");
    }
    room.take(KnownDevice{"2bb80d537b1da3e38bd30361aa855686bde0eacd7162fef6a25fe97bf527a25b"}, nowNs);  // of "secret"
    for (const PageRequest& request : visit.requests)
        for (const auto& line : room.answer(request, ++nowNs).lines)
            if (lineFromPage(lineOf(line)) != line) throw std::runtime_error("a line changed on its way");
}

void readToPage(const std::string& bytes)
{
    LineBuffer buffer;
    for (const std::string& text : buffer.take(bytes + "\n")) {
        const LineToPage line = lineToPage(text);
        if (lineToPage(lineOf(line)) != line) throw std::runtime_error("a line changed");
    }
}

void readFromPage(const std::string& bytes)
{
    LineBuffer buffer;
    for (const std::string& text : buffer.take(bytes + "\n")) {
        const LineFromPage line = lineFromPage(text);
        if (lineFromPage(lineOf(line)) != line) throw std::runtime_error("a line changed");
    }
}

}  // namespace

std::vector<Reader> pageReaders()
{
    const std::string from = std::string("\n") + host + "\n\nvis2hap=secret\napplication/json\n";
    std::vector<std::string> wavs{wavOf({0, 0.5F, -0.5F, 1}), wavOf(std::vector<float>(50, 0.25F))};
    for (std::string& more : recordings()) wavs.push_back(std::move(more));
    return {{"page-request",
             {"POST\n/act" + from + R"({"number":7,"tapped":32})", "GET\n/now" + from, "GET\n/" + from, "GET\n/words" + from,
              "POST\n/enter" + from + R"({"code":"482913"})", "POST\n/act" + from + R"({"number":7,"facts":["31","\u00e4"]})",
              "2POST\n/act" + from + R"({"number":7,"facts":["31","left"]})" + betweenRequests + "GET\n/now" + from,
              "1POST\n/act" + from + R"({"number":7,"agrees":true})",
              "0POST\n/enter" + from + R"({"code":"000000"})" + betweenRequests + "POST\n/enter" + from + R"({"code":"482913"})" +
                  betweenRequests + "GET\n/now" + from + betweenRequests + "POST\n/act" + from + R"({"number":7})"},
             answer},
            {"page-input",
             {lineOf(NumberedInstruction{7, scaleTraining()}), lineOf(NewCode{"482913"}),
              lineOf(KnownDevice{std::string(64, 'a')}), lineOf(PageTexts{"en", {{"agree", "I agree"}}})},
             readToPage},
            {"page-output",
             {lineOf(ParticipantAct{7, FactsTold{{"31", ""}}}), lineOf(ParticipantAct{7, Agreement{true}}),
              lineOf(ParticipantAct{7, PlaceTapped{{32}}}), lineOf(Listening{8577}),
              lineOf(DeviceEntered{"::1", std::string(64, 'a')}), lineOf(WrongCodeEntered{"::1", 3, true}),
              lineOf(DeviceRefused{"::1"})},
             readFromPage},
            {"sound-input",
             {lineOf(LineToSound(NoiseLevel{0.08})), lineOf(LineToSound(SpeechLanguage{"pt-BR"})),
              lineOf(LineToSound(PlayPrompts{{Recording{"/a.wav"}, SpokenText{"Feel."}}}))},
             [](const std::string& bytes) {
                 const LineToSound line = lineToSound(bytes);
                 if (lineToSound(lineOf(line)) != line) throw std::runtime_error("a line changed");
             }},
            {"wav", std::move(wavs), [](const std::string& bytes) {
                 for (const float sample : soundFromWav(bytes, "a.wav"))
                     if (!(sample >= -1 && sample <= 1)) throw std::runtime_error("a sample lies beyond full scale");
             }}};
}

}  // namespace fuzz
