// The key of a result: SHA-256 over all that it was computed from, and over the program that computed it.
#pragma once

#include <concepts>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "rendering/cache/result_cache.h"

namespace rendering::cache {

/// Begins with the kind of the result, the bytes of the running program, the version of OpenCV and the instructions that OpenCV
/// uses on this processor: the last bits of a result depend on them.
class CacheKey {
public:
    CacheKey(ResultCache& cache, std::string_view kind);

    CacheKey& add(std::string_view name, std::string_view value);
    CacheKey& add(std::string_view name, double value);
    CacheKey& add(std::string_view name, const std::optional<double>& value);
    template <std::integral Whole>
    CacheKey& add(std::string_view name, Whole value)
    {
        return add(name, std::string_view(std::to_string(value)));
    }
    /// The content of a file, and that there is none. Throws badInput where it cannot be read.
    CacheKey& addFile(std::string_view name, const std::filesystem::path& file);

    std::string hex() const;

private:
    ResultCache& m_cache;
    std::string m_text;
};

}  // namespace rendering::cache
