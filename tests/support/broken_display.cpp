// Display driver with one fault, named on the command line, for tests of the conformance check and of sessions:
//   broken_display FAULT [CLOCK]
// With a clock it stamps its events: "fine", or a name of one that tells no time.
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

namespace {

using Json = nlohmann::json;

std::string fault, deviceClock;
Json showing;
int images = 0;

bool is(const char* name) { return fault == name; }

void writeLine(const std::string& line) { std::cout << line << std::endl; }

/// The time of the device's clock, s.
double deviceS()
{
    static int reads = 0;
    static const double beganS = std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    const double runS =
        std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count() - beganS + 0.0123;
    constexpr double unixS = 1.79e9;
    ++reads;
    if (deviceClock == "six digits") return std::round((unixS + runS) / 1e4) * 1e4;
    if (deviceClock == "32 bits") return double(float(unixS + runS));
    if (deviceClock == "whole seconds") return std::floor(4321.8 + runS);
    if (deviceClock == "stands still") return 12.0317;
    if (deviceClock == "steps back") return 4321 + runS - (reads > 2 ? 1.5 : 0);
    return 4321 + runS;
}

void reply(const char* type, const Json& id, Json more = Json::object())
{
    more["type"] = type;
    if (!deviceClock.empty() && std::string(type) != "hello" && !more.contains("at_s")) more["at_s"] = deviceS();
    more["id"] = id;
    writeLine(more.dump());
    if (is("answers twice")) writeLine(more.dump());
}

void hang()
{
    while (true) ::pause();
}

void hello(const Json& request)
{
    if (is("silent at hello")) hang();
    if (is("babbles")) writeLine("Engine 2.1 is ready");
    if (is("endless line"))
        while (true) std::cout << std::string(1000, 'x') << std::flush;
    if (is("endless lines"))
        while (true) writeLine("x");
    if (is("other schema"))
        return reply("hello", request["id"], {{"schema", "acme/7"}, {"name", "A"}, {"width", 4}, {"height", 3}});
    if (is("echoes the schema"))
        return reply("hello", request["id"], {{"schema", request["schema"]}, {"name", "A"}, {"width", 40}, {"height", 30}});
    if (is("no name")) return reply("hello", request["id"], {{"schema", "vis2hap.display/1"}, {"width", 40}, {"height", 30}});
    if (is("shows at the start")) showing = 1;
    reply("hello", request["id"],
          {{"schema", "vis2hap.display/1"},
           {"name", is("wild name") ? "\x1b[2J" + std::string(5000, 'A') : "A"},
           {"width", 40},
           {"height", 30},
           {"touches", true}});
}

void show(const Json& request)
{
    ++images;
    const double receivedS = is("touched early") ? deviceS() : 0;
    if (is("touched early")) ::usleep(150000);
    if (!is("reads images as lines")) {
        std::string image(request["bytes"].get<std::size_t>(), '\0');
        std::cin.read(image.data(), static_cast<std::streamsize>(image.size()));
    }
    if (is("hangs at an image")) hang();
    while (is("babbles for ever")) {
        writeLine("frame");
        ::usleep(200);
    }
    if (is("dies at an image")) std::raise(SIGKILL);
    if (is("dies at the first image") && std::getenv("BROKEN_DISPLAY_MARK") != nullptr) {
        const std::string mark = std::getenv("BROKEN_DISPLAY_MARK");
        if (::access(mark.c_str(), F_OK) != 0) {
            std::fclose(std::fopen(mark.c_str(), "w"));
            std::fputs("cannot open the amplifier\n", stderr);
            std::exit(3);
        }
    }
    if (is("half a line")) {
        std::cout << "{\"type\":\"sho" << std::flush;
        std::exit(0);
    }
    if (is("floods its errors")) std::cerr << std::string(1 << 20, 'e') << std::endl;
    if (is("refuses images")) return reply("failed", request["id"], {{"why", "no amplifier"}});
    if (is("takes its own size only") && (request["width"] != 40 || request["height"] != 30))
        return reply("failed", request["id"], {{"why", "only 40 x 30"}});
    if (is("answers an old id")) return reply("shown", 1);
    if (is("late first reply") && images == 1) return reply("shown", 0);
    const Json before = std::exchange(showing, request["id"]);
    reply("shown", showing);
    if (is("touched before") && !before.is_null()) reply("touched", before);
    if (is("fingers of nonsense")) {
        for (const char* values : {R"("x_mm":1e999)", R"("x_mm":NaN)", R"("x_mm":"12")", R"("x_mm":1e300,"y_mm":2)",
                                   R"("force_n":-1e9)", R"("y_mm":[1])", R"("force_n":true)"})
            writeLine(R"({"type":"finger","id":)" + showing.dump() + "," + values + "}");
        reply("finger", 999999, {{"x_mm", 1}});
        reply("finger", showing, {{"x_mm", 7.5}});
    }
    for (int sample = 0; is("floods of fingers") && sample < 200000; ++sample)
        std::cout << R"({"type":"finger","id":)" << showing << R"(,"at_s":)" << sample * 1e-5 << R"(,"x_mm":1,"y_mm":2})"
                  << "\n";
    if (is("touched elsewhere")) reply("touched", 999999);
    if (is("touched early")) reply("touched", showing, {{"at_s", receivedS + 0.01}});
    if (is("touched late")) {
        ::usleep(400000);
        reply("touched", showing);
    }
    if (is("dies after an image")) {
        ::usleep(20000);
        std::raise(SIGKILL);
    }
}

void answer(const Json& request)
{
    const std::string type = request.is_object() ? request.value("type", "") : "";
    if (type == "hello") return hello(request);
    if (type == "show") return show(request);
    if (type == "clear" && !is("never clears")) showing = nullptr;
    if (type == "clear" && is("hangs at clearing")) hang();
    if (type == "clear") reply("cleared", request["id"]);
    if (type == "clear" && is("dies after clearing")) std::raise(SIGKILL);
    if (type == "clear") return;
    if (type == "status" && is("status is empty")) return reply("status", request["id"]);
    if (type == "status") return reply("status", request["id"], {{"showing", showing}});
    if (is("ends at the unknown")) std::exit(0);
    if (!is("silent at the unknown")) reply("failed", request.value("id", Json(0)), {{"why", "unknown"}});
}

}  // namespace

int main(int argc, char** argv)
{
    fault = argc > 1 ? argv[1] : "";
    deviceClock = argc > 2 ? argv[2] : "";
    for (std::string line; std::getline(std::cin, line);) answer(Json::parse(line, nullptr, false));
    if (is("continues without input")) hang();
    return 0;
}
