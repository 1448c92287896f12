// A small driver of a display for Vis2Hap (vis2hap.display/1) in C++17 and POSIX without any library: copy it, fill in Device.
//
//   c++ -std=c++17 -O2 -o small_driver small_driver.cpp
//   small_driver FILE.pgm         Vis2Hap starts it: --display "exec:./small_driver felt.pgm"
//   small_driver FILE.pgm [ADDRESS:]PORT    it waits for connections: --display tcp:HOST:PORT
//
// With a port alone, only this computer can connect. For another computer, name the address of your own end of the cable, or
// 0.0.0.0 for every network: nothing checks who connects.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace {

const int width = 1280, height = 800;  // pixels of your glass
const std::size_t longestLine = 65536, mostBytes = std::size_t{64} << 20;

/// ==== The one place for your vendor's calls. This example keeps the image in a file. ====
struct Device {
    std::string file;

    /// grey: one byte a pixel, row by row from the upper left; 255 is the highest friction. Returns when it can be felt; throws
    /// with a reason for the operator if the engine fails.
    void show(int wide, int high, const std::string& grey)
    {
        std::FILE* image = std::fopen(file.c_str(), "wb");
        if (image == nullptr) throw std::runtime_error("the engine cannot write its image");
        bool isWritten = std::fprintf(image, "P5\n%d %d\n255\n", wide, high) > 0;
        isWritten = std::fwrite(grey.data(), 1, grey.size(), image) == grey.size() && isWritten;
        if (std::fclose(image) != 0 || !isWritten) throw std::runtime_error("the engine cannot write its image");
    }
    /// Nothing can be felt any more.
    void clear() { show(width, height, std::string(std::size_t{width} * height, '\0')); }
};

/// What follows "KEY": in a line of Vis2Hap, a word or a whole number; empty without it.
std::string valueOf(const std::string& key, const std::string& line)
{
    std::size_t at = line.find('"' + key + '"');
    if (at == line.npos || (at = line.find(':', at)) == line.npos) return {};
    at = line.find_first_not_of(": \"", at);
    return at == line.npos ? "" : line.substr(at, line.find_first_of("\",} ", at) - at);
}

/// The digits of an id; "0" for anything else, so that a reply is always JSON.
std::string numberIn(const std::string& text)
{
    const bool isNumber = !text.empty() && text.size() < 20 && text.find_first_not_of("0123456789") == text.npos;
    return isNumber ? text : "0";
}

/// The next line; empty at the end of the input, and after a line that is too long.
std::string nextLine(std::FILE* in)
{
    std::string line;
    for (int letter = 0; line.size() < longestLine && (letter = std::fgetc(in)) != EOF;)
        if (line += static_cast<char>(letter); letter == '\n') return line;
    return {};
}

/// Clears while no computer reads a reason.
void clearForNobody(Device& device)
{
    try {
        device.clear();
    } catch (const std::exception& fault) {
        std::fprintf(stderr, "the device is not cleared: %s\n", fault.what());
    }
}

/// Answers one computer until its input ends.
void serve(Device device, std::FILE* in, std::FILE* out)
{
    std::string showing = "null";
    clearForNobody(device);
    for (std::string line = nextLine(in); !line.empty(); line = nextLine(in)) {
        const std::string type = valueOf("type", line), id = numberIn(valueOf("id", line));
        std::string reply = R"("type":"failed","why":"unknown request")";
        try {
            if (type == "hello")
                reply = R"("type":"hello","schema":"vis2hap.display/1","name":"small driver in C++","touches":false,"width":)" +
                        std::to_string(width) + R"(,"height":)" + std::to_string(height);
            if (type == "status") reply = R"("type":"status","showing":)" + showing;
            if (type == "show") {
                const int wide = std::atoi(valueOf("width", line).c_str()), high = std::atoi(valueOf("height", line).c_str());
                const std::size_t bytes = std::strtoul(valueOf("bytes", line).c_str(), nullptr, 10);
                if (bytes > mostBytes) break;  // the next message could not be found any more
                std::string grey(bytes, '\0');
                if (std::fread(grey.data(), 1, grey.size(), in) != grey.size()) break;  // the input ends within an image
                if (wide < 1 || high < 1 || grey.size() != static_cast<std::size_t>(wide) * static_cast<std::size_t>(high))
                    throw std::runtime_error("width x height differs from the number of bytes");
                device.show(wide, high, grey);
                showing = id;
                reply = R"("type":"shown")";
            }
            if (type == "clear") {
                device.clear();
                showing = "null";
                reply = R"("type":"cleared")";
            }
        } catch (const std::exception& fault) {  // the operator reads the reason, and the session pauses
            std::string why = fault.what();
            for (char& letter : why)
                if (letter == '"' || letter == '\\' || static_cast<unsigned char>(letter) < ' ') letter = ' ';
            reply = R"("type":"failed","why":")" + why + '"';
        }
        std::fprintf(out, "{%s,\"id\":%s}\n", reply.c_str(), id.c_str());
        std::fflush(out);
    }
    clearForNobody(device);  // Vis2Hap has ended, perhaps by a crash
}

}  // namespace

int main(int argc, char** argv)
{
    if (argc != 2 && argc != 3) return std::fputs("usage: small_driver FILE.pgm [[ADDRESS:]PORT]\n", stderr), 2;
    std::signal(SIGPIPE, SIG_IGN);
    if (argc == 2) return serve({argv[1]}, stdin, stdout), 0;
    const int server = ::socket(AF_INET, SOCK_STREAM, 0), yes = 1;
    sockaddr_in place{};
    place.sin_family = AF_INET;
    const std::string text = argv[2], address = text.find(':') == text.npos ? "127.0.0.1" : text.substr(0, text.find(':'));
    const std::string port = text.substr(text.find(':') + 1);
    int number = -1;
    const auto read = std::from_chars(port.data(), port.data() + port.size(), number);
    if (read.ptr != port.data() + port.size() || number < 0 || number > 65535) return std::fputs("unknown port\n", stderr), 2;
    place.sin_port = htons(static_cast<std::uint16_t>(number));
    if (::inet_pton(AF_INET, address.c_str(), &place.sin_addr) != 1)
        return std::fputs("an address has four numbers, such as 192.168.0.7\n", stderr), 2;
    ::setsockopt(server, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    socklen_t size = sizeof place;
    if (::bind(server, reinterpret_cast<sockaddr*>(&place), size) != 0 || ::listen(server, 1) != 0) return std::perror("port"), 3;
    ::getsockname(server, reinterpret_cast<sockaddr*>(&place), &size);
    std::printf("listening at port %d of %s\n", ntohs(place.sin_port), address.c_str());
    std::fflush(stdout);
    while (true) {
        const int client = ::accept(server, nullptr, nullptr);
        if (client < 0) continue;
        ::setsockopt(client, SOL_SOCKET, SO_KEEPALIVE, &yes, sizeof yes);  // a computer without power closes nothing
        std::FILE *in = ::fdopen(client, "rb"), *out = ::fdopen(::dup(client), "wb");
        if (in == nullptr || out == nullptr) return std::perror("connection"), 3;
        serve({argv[1]}, in, out);
        std::fclose(in);
        std::fclose(out);
    }
}
