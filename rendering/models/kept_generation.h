// Generated signals that a cache keeps: the generators start only for photographs whose signals it lacks.
#pragma once

#include <functional>

#include "rendering/cache/result_cache.h"
#include "rendering/models/generation.h"

namespace rendering::models {

using GenerateSignals = std::function<std::vector<GeneratedSignals>(std::span<const InputPhotograph>, const GenerationOptions&)>;

/// Text that changes with the weights and with vis2hap-nn. Throws badInput for a model without a card, environmentFault where
/// vis2hap-nn is missing.
std::string identityOfGenerators(cache::ResultCache& cache, const GenerationOptions& options);

class KeptGeneration {
public:
    /// Without a cache, everything is generated. `generate`: generates what the cache lacks.
    KeptGeneration(cache::ResultCache* cache, GenerateSignals generate) : m_cache(cache), m_generate(std::move(generate)) {}

    /// As generate() of generation.h. Calls the generators at most once, and only for the photographs that need them.
    std::vector<GeneratedSignals> operator()(std::span<const InputPhotograph> photographs, const GenerationOptions& options);

    int generated() const { return m_generated; }  ///< photographs that the generators saw

private:
    cache::ResultCache* m_cache;
    GenerateSignals m_generate;
    int m_generated = 0;
};

}  // namespace rendering::models
