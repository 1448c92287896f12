#include "stats/models/mixed_model_system.h"

namespace stats {

std::size_t MixedModelSystem::thetaCount() const
{
    std::size_t count = 0;
    for (const TermPlace& term : m_terms) count += term.components == 1 ? 1 : 3;
    return count;
}

}  // namespace stats
