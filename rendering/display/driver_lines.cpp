#include "rendering/display/driver_lines.h"

namespace rendering {

void DriverLines::add(std::string_view bytes)
{
    if (m_isTooLong) return;
    // What was taken is removed here and not line by line: many short lines would be moved again and again.
    m_bytes.erase(0, m_begin);
    m_searched -= m_begin;
    m_begin = 0;
    m_bytes.append(bytes);
}

std::optional<std::string> DriverLines::next()
{
    const auto end = m_bytes.find('\n', m_searched);
    const bool isWhole = end != std::string::npos;
    m_searched = isWhole ? end : m_bytes.size();
    m_isTooLong = m_isTooLong || m_searched - m_begin > longest;
    if (m_isTooLong) {
        m_bytes.clear();
        m_begin = m_searched = 0;
    }
    if (!isWhole || m_isTooLong) return std::nullopt;
    std::string line = m_bytes.substr(m_begin, end - m_begin);
    m_begin = m_searched = end + 1;
    if (line.ends_with('\r')) line.pop_back();
    return line;
}

}  // namespace rendering
