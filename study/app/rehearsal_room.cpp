#include "study/app/rehearsal_room.h"

#include <utility>

#include "study/app/display_choice.h"
#include "study/app/pages/setup/rehearsal_page.h"
#include "study/app/pages/setup/room_checks.h"
#include "study/app/pages/study_page.h"
#include "study/app/session_room.h"
#include "study/app/showing_faults.h"
#include "study/app/window_pages.h"

namespace study::app {

RehearsalRoom::RehearsalRoom(MakeRehearsal make, const std::unique_ptr<OpenStudy>& openStudy, WindowPages& pages,
                             DisplayChoice& displayChoice, SessionRoom& session)
    : m_make(std::move(make)), m_openStudy(openStudy), m_pages(pages), m_displayChoice(displayChoice), m_session(session)
{
    m_pages.study->offerRehearsal(static_cast<bool>(m_make));
    connectPages();
}

void RehearsalRoom::connectPages()
{
    connect(m_pages.study, &StudyPage::rehearsalRequested, this, [this] {
        showingFaults(*m_pages.study, [this] {
            m_pages.rehearsal->begin(m_openStudy->codesOnPieces());
            m_isInUse = true;
            show();
        });
    });
    connect(m_pages.rehearsal, &RehearsalPage::checksRequested, this, &RehearsalRoom::show);
    connect(m_pages.rehearsal, &RehearsalPage::displayRequested, this, [this] { m_displayChoice.show(); });
    connect(m_pages.rehearsal, &RehearsalPage::sessionRequested, this, &RehearsalRoom::requestSession);
    connect(m_pages.rehearsal, &RehearsalPage::backRequested, this, [this] {
        m_isInUse = false;
        Q_EMIT left();
    });
}

void RehearsalRoom::show()
{
    m_displayChoice.connectDisplay(
        [this](auto display) {
            const QString name = display->isThere() ? QString::fromStdString(display->name()) : QString();
            display.reset();  // The session connects it again.
            present(name);
        },
        [this](const QString& fault) {
            present({});
            m_pages.rehearsal->showFault(fault);
        });
}

void RehearsalRoom::present(const QString& displayName)
{
    const database::StudyFolder& folder = m_openStudy->store().folder();
    const QString fault = faultOfDatabase(folder.database());
    m_pages.rehearsal->showRoom(displayName, fault.isEmpty() ? faultOfDisk(folder.folder) : fault);
    const auto refresh = [&] {
        m_pages.rehearsal->refresh(
            {m_openStudy->overview().nextParticipant, m_openStudy->codesOnPieces(), faultOfClocks(m_openStudy->lastWallTime())});
    };
    showingFaults(*m_pages.rehearsal, refresh);
    if (m_pages.currentWidget() == m_pages.rehearsal) return;
    m_pages.bring(*m_pages.rehearsal);
}

void RehearsalRoom::requestSession()
{
    m_session.end();  // A driver serves one connection at a time.
    m_displayChoice.connectDisplay(
        [this](auto display) {
            m_pages.setCurrentWidget(m_pages.rehearsal);
            showingFaults(*m_pages.rehearsal, [&] { play(std::move(display)); });
        },
        [this](const QString& fault) {
            m_pages.setCurrentWidget(m_pages.rehearsal);
            m_pages.rehearsal->showFault(fault);
        });
}

void RehearsalRoom::play(std::unique_ptr<rendering::HapticDisplay> display)
{
    m_session.end();
    m_played.reset();
    m_folder = m_make(m_openStudy->store().folder().folder);
    m_played = std::make_unique<OpenStudy>(*m_folder);
    try {
        m_session.begin(*m_played, protocols::ParticipantId(rehearsalParticipant), std::move(display));
    } catch (...) {
        close();  // a later session is of the study again
        throw;
    }
}

void RehearsalRoom::close()
{
    m_session.end();
    m_played.reset();
    m_folder.reset();
}

void RehearsalRoom::leaveSession(bool isWhole)
{
    close();
    m_pages.rehearsal->sessionLeft(isWhole);
    show();
}

}  // namespace study::app
