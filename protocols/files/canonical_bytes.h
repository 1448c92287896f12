// Fields joined into bytes that can be read in one way only, so that equal hashes mean equal fields: each field as its length,
// a colon, its bytes and a comma; an absent field as "-,".
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "protocols/files/sha256.h"

namespace protocols {

class CanonicalBytes {
public:
    CanonicalBytes& operator<<(const std::string& field)
    {
        m_bytes += std::to_string(field.size()) + ':' + field + ',';
        return *this;
    }
    CanonicalBytes& operator<<(std::int64_t number) { return *this << std::to_string(number); }
    CanonicalBytes& operator<<(int number) { return *this << std::to_string(number); }
    CanonicalBytes& operator<<(bool yes) { return *this << std::string(yes ? "1" : "0"); }
    template <class T>
    CanonicalBytes& operator<<(const std::optional<T>& field)
    {
        if (field) return *this << *field;
        m_bytes += "-,";
        return *this;
    }

    const std::string& text() const { return m_bytes; }
    /// SHA-256 in lower-case hexadecimal.
    std::string hash() const { return sha256(m_bytes); }

private:
    std::string m_bytes;
};

}  // namespace protocols
