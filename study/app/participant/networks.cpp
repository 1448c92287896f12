#include "study/app/participant/networks.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>

#include <array>

namespace study::app {

namespace {

QString addressOf(const sockaddr& socketAddress)
{
    std::array<char, INET6_ADDRSTRLEN> text{};
    if (socketAddress.sa_family == AF_INET)
        ::inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in&>(socketAddress).sin_addr, text.data(), text.size());
    if (socketAddress.sa_family == AF_INET6) {
        const in6_addr& address = reinterpret_cast<const sockaddr_in6&>(socketAddress).sin6_addr;
        if (!IN6_IS_ADDR_LINKLOCAL(&address)) ::inet_ntop(AF_INET6, &address, text.data(), text.size());
    }
    return QString::fromLatin1(text.data());
}

}  // namespace

std::vector<Network> networksOfThisComputer()
{
    ifaddrs* all = nullptr;
    if (::getifaddrs(&all) != 0) return {};
    std::vector<Network> networks;
    for (const ifaddrs* one = all; one; one = one->ifa_next) {
        const bool isReachable = (one->ifa_flags & IFF_UP) != 0 && (one->ifa_flags & IFF_LOOPBACK) == 0;
        if (!isReachable || !one->ifa_addr) continue;
        if (const QString address = addressOf(*one->ifa_addr); !address.isEmpty())
            networks.push_back({QString::fromLocal8Bit(one->ifa_name), address});
    }
    ::freeifaddrs(all);
    return networks;
}

}  // namespace study::app
