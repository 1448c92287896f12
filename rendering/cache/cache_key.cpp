#include "rendering/cache/cache_key.h"

#include <opencv2/core/utility.hpp>
#include <system_error>

#include "protocols/files/number_text.h"
#include "protocols/files/sha256.h"

namespace rendering::cache {

namespace fs = std::filesystem;

CacheKey::CacheKey(ResultCache& cache, std::string_view kind) : m_cache(cache)
{
    add("kind", kind);
    add("program", cache.hashOfProgram());
    add("opencv", cv::getVersionString() + " " + cv::getCPUFeaturesLine());
}

CacheKey& CacheKey::add(std::string_view name, std::string_view value)
{
    // The length stands before the value, so that no two lists of values give the same text.
    m_text += std::string(name) + " " + std::to_string(value.size()) + " ";
    m_text += value;
    m_text += "\n";
    return *this;
}

CacheKey& CacheKey::add(std::string_view name, double value) { return add(name, std::string_view(protocols::shortest(value))); }

CacheKey& CacheKey::add(std::string_view name, const std::optional<double>& value)
{
    return value ? add(name, *value) : add(name, std::string_view("none"));
}

CacheKey& CacheKey::addFile(std::string_view name, const fs::path& file)
{
    std::error_code none;
    return fs::exists(file, none) ? add(name, std::string_view(m_cache.hashOfFile(file)))
                                  : add(name, std::string_view("no file"));
}

std::string CacheKey::hex() const { return protocols::sha256(m_text); }

}  // namespace rendering::cache
