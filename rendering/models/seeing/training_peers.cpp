#include "rendering/models/seeing/training_peers.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>
#include <thread>
#include <torch/csrc/distributed/c10d/ProcessGroupGloo.hpp>
#include <torch/csrc/distributed/c10d/TCPStore.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/strict_json.h"

namespace rendering::models {

namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

struct MasterAddress {
    std::string host, port;
};

MasterAddress masterAddress(const std::string& master)
{
    const std::size_t colon = master.rfind(':');
    std::string host = master.substr(0, colon);
    if (host.size() > 2 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
    return {host, master.substr(colon + 1)};
}

/// Reason of a failure of torch in one line, without its stack.
std::string reasonOf(const std::exception& fault)
{
    const auto* ofTorch = dynamic_cast<const c10::Error*>(&fault);
    std::string reason = ofTorch != nullptr ? ofTorch->what_without_backtrace() : fault.what();
    return protocols::printable(reason.substr(0, std::min<std::size_t>(reason.find('\n'), 200)));
}

/// The address of this machine on the way to the master, as numbers: what the other processes can reach. The name of a machine
/// often leads to the loopback address of that machine.
std::string ownAddressTowards(const MasterAddress& master)
{
    const auto unknown = [&](const std::string& why) {
        return protocols::environmentFault({"the machine of rank 0 is unknown (" + why + ")", master.host + ":" + master.port,
                                            "a name or address that this machine can reach", "correct --master"});
    };
    addrinfo wanted{}, *found = nullptr;
    wanted.ai_socktype = SOCK_DGRAM;
    if (const int fault = ::getaddrinfo(master.host.c_str(), master.port.c_str(), &wanted, &found); fault != 0)
        throw unknown(::gai_strerror(fault));
    const std::unique_ptr<addrinfo, void (*)(addrinfo*)> keeper(found, ::freeaddrinfo);
    for (const addrinfo* one = found; one != nullptr; one = one->ai_next) {
        const int socket = ::socket(one->ai_family, SOCK_DGRAM | SOCK_CLOEXEC, 0);
        if (socket < 0) continue;
        sockaddr_storage own{};
        socklen_t length = sizeof own;
        char text[NI_MAXHOST] = {};
        // A connected datagram socket sends nothing; the system only chooses the way.
        const bool isFound =
            ::connect(socket, one->ai_addr, one->ai_addrlen) == 0 &&
            ::getsockname(socket, reinterpret_cast<sockaddr*>(&own), &length) == 0 &&
            ::getnameinfo(reinterpret_cast<const sockaddr*>(&own), length, text, sizeof text, nullptr, 0, NI_NUMERICHOST) == 0;
        ::close(socket);
        if (isFound) return text;
    }
    throw unknown("no way leads there");
}

bool isLoopback(const std::string& address) { return address.starts_with("127.") || address == "::1"; }

std::string textIn(const std::vector<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

std::string keyOf(const char* kind, int rank) { return kind + ("/" + std::to_string(rank)); }

/// The texts that the processes leave for each other before the training.
class Meeting {
public:
    Meeting(const TrainingPlace& place, const MasterAddress& master) : m_place(place)
    {
        c10d::TCPStoreOptions options;
        options.port = static_cast<std::uint16_t>(std::stoi(master.port));
        options.isServer = place.isFirst();
        options.numWorkers = static_cast<std::size_t>(place.processes);
        options.timeout = seconds(place.waitS);
        m_store = c10::make_intrusive<c10d::TCPStore>(master.host, options);
        m_store->setTimeout(options.timeout);
    }

    c10::intrusive_ptr<c10d::TCPStore> store() const { return m_store; }

    void say(const char* kind, const std::string& text)
    {
        m_store->set(keyOf(kind, m_place.rank), std::vector<std::uint8_t>(text.begin(), text.end()));
    }

    std::string said(const char* kind, int rank) const
    {
        try {
            return textIn(m_store->get(keyOf(kind, rank)));
        } catch (const std::exception&) {
            throw std::runtime_error("rank " + std::to_string(rank) + " did not come");
        }
    }

    /// True for the first process that takes the rank.
    bool takesRank() { return m_store->add(keyOf("taken", m_place.rank), 1) == 1; }

    /// Waits until all processes have come to this line, so that rank 0 does not leave while others still read.
    void leaveTogether()
    {
        m_store->add("left", 1);
        if (!m_place.isFirst()) return;
        const auto end = std::chrono::steady_clock::now() + seconds(std::min(m_place.waitS, 10));
        while (m_store->add("left", 0) < m_place.processes && std::chrono::steady_clock::now() < end)
            std::this_thread::sleep_for(milliseconds(20));
    }

private:
    TrainingPlace m_place;
    c10::intrusive_ptr<c10d::TCPStore> m_store;
};

std::string settingsText(const AgreedSettings& settings)
{
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    for (const auto& [name, value] : settings) json[name] = value;
    return json.dump();
}

/// Names the first setting in which this process differs from rank 0; empty where none does.
std::string differenceFrom(const std::string& ofFirst, const AgreedSettings& own, int rank)
{
    const nlohmann::json first = protocols::parseStrictJson(ofFirst, "rank 0");
    for (const auto& [name, value] : own) {
        const std::string other = first.value(name, std::string("(none)"));
        if (other != value)
            return name + " is " + (value.empty() ? "(none)" : value) + " at rank " + std::to_string(rank) + " and " +
                   (other.empty() ? "(none)" : other) + " at rank 0";
    }
    return {};
}

void requireAgreement(Meeting& meeting, const TrainingPlace& place, const AgreedSettings& settings)
{
    meeting.say("settings", settingsText(settings));
    meeting.say("difference", differenceFrom(meeting.said("settings", 0), settings, place.rank));
    std::string difference;
    for (int rank = 0; rank < place.processes; ++rank)
        if (const std::string one = meeting.said("difference", rank); difference.empty()) difference = one;
    if (difference.empty()) return;
    meeting.leaveTogether();
    throw protocols::badInput({"the processes of the training differ: " + protocols::printable(difference),
                               "rank " + std::to_string(place.rank), "the same options, data and version in all processes",
                               "start all of them again with the same options"});
}

/// Throws environmentFault where some processes are known by a loopback address and others are on other machines.
void requireReachable(Meeting& meeting, const TrainingPlace& place, const std::string& ownAddress)
{
    meeting.say("address", ownAddress);
    int local = 0;
    std::string last;
    for (int rank = 0; rank < place.processes; ++rank) {
        const std::string address = meeting.said("address", rank);
        if (!isLoopback(address)) continue;
        ++local;
        last = "rank " + std::to_string(rank) + " has the address " + protocols::printable(address);
    }
    if (local == 0 || local == place.processes) return;
    meeting.leaveTogether();
    throw protocols::environmentFault({last + ", which other machines do not reach", place.master,
                                       "an address of rank 0 in the network that all machines share",
                                       "give --master the number of that address instead of a name"});
}

}  // namespace

struct TrainingPeers::Group {
    c10::intrusive_ptr<c10d::TCPStore> store;  ///< Rank 0 serves it until the end.
    std::unique_ptr<c10d::ProcessGroupGloo> processes;
};

TrainingPeers::TrainingPeers(const TrainingPlace& place, AgreedSettings settings)
    : m_place(place), m_group(std::make_unique<Group>())
{
    settings.insert(settings.begin(), {"version", VIS2HAP_VERSION});
    settings.emplace_back("--processes", std::to_string(place.processes));
    const MasterAddress master = masterAddress(place.master);
    const std::string address = ownAddressTowards(master);
    try {
        Meeting meeting(place, master);
        if (!meeting.takesRank())
            throw protocols::badInput({"another process has rank " + std::to_string(place.rank) + " already", place.master,
                                       "each rank from 0 to " + std::to_string(place.processes - 1) + " once",
                                       "correct --rank, or end the other process"});
        requireAgreement(meeting, place, settings);
        requireReachable(meeting, place, address);
        auto options = c10d::ProcessGroupGloo::Options::create(seconds(place.waitS));
        options->devices.push_back(c10d::ProcessGroupGloo::createDeviceForHostname(address));
        options->threads = 1;  // One sum at a time.
        m_group->store = meeting.store();
        m_group->processes =
            std::make_unique<c10d::ProcessGroupGloo>(meeting.store(), place.rank, place.processes, std::move(options));
    } catch (const protocols::Error&) {
        throw;
    } catch (const std::exception& fault) {
        throw protocols::environmentFault(
            {"the " + std::to_string(place.processes) + " processes of the training did not meet (" + reasonOf(fault) + ")",
             place.master, "all ranks started within " + std::to_string(place.waitS) + " s, and a free port that all reach",
             "look at the messages of the other ranks, and start all of them again"});
    }
}

TrainingPeers::~TrainingPeers() = default;

namespace {

/// One act of all processes.
void together(const TrainingPlace& place, const std::function<c10::intrusive_ptr<c10d::Work>()>& act)
{
    try {
        act()->wait();
    } catch (const std::exception& fault) {
        throw protocols::workFailed({"another process of the training has ended or does not answer (" + reasonOf(fault) + ")",
                                     "rank " + std::to_string(place.rank) + " of " + std::to_string(place.processes),
                                     "all processes until the end",
                                     "look at the messages of the other ranks; start all again, with --resume to continue from "
                                     "the last checkpoint of rank 0"});
    }
}

}  // namespace

void TrainingPeers::sum(torch::Tensor& numbers) const
{
    std::vector<torch::Tensor> tensors{numbers};
    together(m_place, [&] { return m_group->processes->allreduce(tensors); });
}

void TrainingPeers::takeFromFirst(torch::Tensor& numbers) const
{
    std::vector<torch::Tensor> tensors{numbers};
    together(m_place, [&] { return m_group->processes->broadcast(tensors); });
}

void TrainingPeers::takeFromFirst(std::string& bytes) const
{
    torch::Tensor shared = torch::from_blob(bytes.data(), {static_cast<std::int64_t>(bytes.size())}, torch::kByte);
    takeFromFirst(shared);
}

}  // namespace rendering::models
