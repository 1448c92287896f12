// The steps of writing a draft, for undo and redo. Typing in one field is one step.
#pragma once

#include <string>
#include <vector>

#include "study/app/drafts/protocol_draft.h"

namespace study::app {

class DraftHistory {
public:
    /// Begins anew with this draft.
    void begin(const ProtocolDraft& draft);
    const ProtocolDraft& now() const { return m_steps[m_present].draft; }
    /// Adds a step. Changes with the same `field`, one after another, are one step; an empty one is always a step of its own.
    void add(const ProtocolDraft& draft, const std::string& field);
    /// The next change is a step of its own.
    void endStep() { m_mayMerge = false; }

    bool canUndo() const { return m_present > 0; }
    bool canRedo() const { return m_present + 1 < m_steps.size(); }
    void undo();
    void redo();

private:
    struct Step {
        ProtocolDraft draft;
        std::string field;
    };
    std::vector<Step> m_steps{1};
    std::size_t m_present = 0;
    bool m_mayMerge = false;
    std::size_t m_mostSteps = 1;
};

}  // namespace study::app
