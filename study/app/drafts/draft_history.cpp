#include "study/app/drafts/draft_history.h"

#include <algorithm>

namespace study::app {

namespace {

/// Steps are whole drafts; those of a very long protocol are fewer.
constexpr std::size_t mostSteps = 200, fewestSteps = 10, mostBytes = 20'000'000;

}  // namespace

void DraftHistory::begin(const ProtocolDraft& draft)
{
    m_steps = {Step{draft, {}}};
    m_present = 0;
    m_mayMerge = false;
    m_mostSteps = std::clamp(mostBytes / std::max<std::size_t>(1, now().fileText().size()), fewestSteps, mostSteps);
}

void DraftHistory::add(const ProtocolDraft& draft, const std::string& field)
{
    if (draft == now()) return;
    m_steps.resize(m_present + 1);
    if (m_mayMerge && !field.empty() && m_steps.back().field == field) {
        m_steps.back().draft = draft;
        return;
    }
    m_steps.push_back({draft, field});
    if (m_steps.size() > m_mostSteps) m_steps.erase(m_steps.begin());
    m_present = m_steps.size() - 1;
    m_mayMerge = true;
}

void DraftHistory::undo()
{
    if (canUndo()) --m_present;
    m_mayMerge = false;
}

void DraftHistory::redo()
{
    if (canRedo()) ++m_present;
    m_mayMerge = false;
}

}  // namespace study::app
