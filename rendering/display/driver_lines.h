// Lines of a driver, put together from bytes as they arrive.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace rendering {

class DriverLines {
public:
    static constexpr std::size_t longest = 65536;  ///< bytes of one line without its "\n"

    void add(std::string_view bytes);
    /// The next line without its end, "\n" or "\r\n". Returns nullopt where none is whole, and from the first line on that is
    /// longer than `longest`: what arrives after it is dropped.
    std::optional<std::string> next();

    bool hasNext() const { return m_bytes.find('\n', m_searched) != std::string::npos; }
    /// True after next() met a line that is too long.
    bool isTooLong() const { return m_isTooLong; }
    /// Bytes that nobody has taken yet.
    std::size_t waiting() const { return m_bytes.size() - m_begin; }

private:
    std::string m_bytes;
    std::size_t m_begin = 0;     ///< of the next line
    std::size_t m_searched = 0;  ///< between here and m_begin there is no line end
    bool m_isTooLong = false;
};

}  // namespace rendering
