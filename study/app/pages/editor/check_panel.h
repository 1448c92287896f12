// What the editor says of a draft while it is written: every fault with a button that leads to its field, minutes and sittings,
// what the study can detect, and a preview of the pages.
#pragma once

#include <QStringList>
#include <QWidget>

#include "protocols/protocol_json.h"
#include "study/app/drafts/session_outlook.h"
#include "study/app/state/in_background.h"

class QLabel;
class QVBoxLayout;

namespace study::app {

class DraftFields;
class PagePreview;

class CheckPanel : public QWidget {
    Q_OBJECT
public:
    CheckPanel(DraftFields& fields, LookAhead lookAhead, QWidget* parent);
    ~CheckPanel() override { m_work.stop(); }

    /// `phase`: whose pages are previewed. `hasLines`: the draft is the file as it stands, so that line and column are of use.
    void present(const protocols::CheckedProtocol& checked, int phase, bool hasLines);
    /// Forgets the pages of the draft before.
    void clear();
    const std::vector<protocols::ProtocolFault>& faults() const { return m_faults; }
    /// "No fault. 40 presentations, 17 minutes, 1 sitting": the whole panel in one line.
    QString summary() const;
    PagePreview& preview() const { return *m_preview; }
    bool isComputing() const { return m_work.isBusy(); }

Q_SIGNALS:
    void jumpRequested(const QString& place);
    /// The operator removes a key that no protocol has from the object at a place, "" for the protocol.
    void removeRequested(const QString& object, const QString& key);

private:
    void showFaults();
    void showNumbers();
    void beginOutlook();
    void showOutlook(const SessionOutlook& outlook);
    /// The fault in the words of the page.
    QString wordsOf(const protocols::ProtocolFault& fault) const;

    DraftFields& m_fields;
    LookAhead m_lookAhead;
    std::vector<protocols::ProtocolFault> m_faults;
    std::optional<protocols::Protocol> m_protocol;
    std::optional<protocols::Protocol> m_computed;  ///< whose outlook is shown or computed
    bool m_hasLines = false;
    QStringList m_shown;  ///< faults in words
    QLabel* m_state;
    QVBoxLayout* m_rows;
    QLabel* m_numbers;
    QLabel* m_detects;
    QLabel* m_balance;
    PagePreview* m_preview;
    InBackground m_work;
};

}  // namespace study::app
