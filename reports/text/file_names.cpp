#include "reports/text/file_names.h"

#include "reports/text/plain_words.h"

namespace reports {
namespace {

bool isPlain(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
}

}  // namespace

std::string FileNames::unique(const std::string& wanted)
{
    std::string base = wanted;
    for (char& c : base)
        if (!isPlain(c)) c = '_';
    std::string name = base;
    for (int n = 2; !m_taken.insert(lowerCase(name)).second; ++n) name = base + "-" + std::to_string(n);
    return name;
}

}  // namespace reports
