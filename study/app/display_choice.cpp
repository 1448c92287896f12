#include "study/app/display_choice.h"

#include <utility>

#include "study/app/pages/setup/connecting_page.h"
#include "study/app/pages/setup/display_page.h"
#include "study/app/pages/start_page.h"
#include "study/app/pages/study_page.h"
#include "study/app/state/tried_display.h"
#include "study/app/window_pages.h"

namespace study::app {

DisplayChoice::DisplayChoice(const AppOptions& options, WindowPages& pages)
    : m_pages(pages),
      m_settings(options.settings),
      m_specification(options.display),
      m_operatedBy(options.operatedBy),
      m_rehearses(options.isDisplayGiven && options.display == "none"),
      m_opening(options.openDisplay)
{
    takeRemembered(options);
    connectPages();
}

void DisplayChoice::takeRemembered(const AppOptions& options)
{
    const std::string remembered = rememberedDisplay(options.settings.get());
    const bool isAllowed = options.allowsPlainImages || !leavesPlainImages(remembered);
    const bool isWanted = !options.isDisplayGiven && options.kind == database::ParticipantKind::Human && !remembered.empty();
    if (!isWanted) return;
    if (isAllowed) return take(remembered);
    m_faultOfLastTime = tr("The display of the last time, %1, is not connected: an operator could open its plain images. Choose "
                           "another display here, or start the program with --plain-images.")
                            .arg(QString::fromStdString(remembered));
}

void DisplayChoice::connectPages()
{
    connect(m_pages.start, &StartPage::displayRequested, this, [this] { show(); });
    connect(m_pages.study, &StudyPage::displayRequested, this, [this] { show(); });
    connect(m_pages.display, &DisplayPage::backRequested, this, &DisplayChoice::leave);
    connect(m_pages.connecting, &ConnectingPage::stopRequested, this, &DisplayChoice::stopConnecting);
    connect(m_pages.display, &DisplayPage::chosen, this, [this](const QString& specification) {
        m_rehearses = false;
        take(specification.toStdString());
    });
    connect(m_pages.display, &DisplayPage::rehearsalRequested, this, &DisplayChoice::rehearse);
}

std::optional<double> DisplayChoice::mmPerPixel() const { return rememberedScale(m_settings.get(), m_specification); }

void DisplayChoice::take(const std::string& specification)
{
    m_specification = specification;
    m_operatedBy.plainImages = leavesPlainImages(specification);
}

void DisplayChoice::rehearse()
{
    m_rehearses = true;
    take("none");
    const auto waiting = m_waiting;
    leave();
    if (waiting) waiting();
}

void DisplayChoice::connectDisplay(DisplayOpening::Opened use, DisplayOpening::Failed failed)
{
    m_stopped = failed;
    m_opening.open(m_specification, std::move(use), std::move(failed));
    if (!m_opening.isOpening()) return;
    m_pages.setCurrentWidget(m_pages.connecting);
    m_pages.connecting->present(QString::fromStdString(m_specification));
}

void DisplayChoice::stopConnecting()
{
    m_opening.stop();
    if (m_stopped) m_stopped(tr("Connecting the display was stopped."));
}

void DisplayChoice::show(const QString& why)
{
    m_pages.display->present(m_specification, why);
    m_pages.bring(*m_pages.display);
}

void DisplayChoice::showFor(const QString& why, std::function<void()> begin)
{
    show(why);
    m_waiting = std::move(begin);
}

void DisplayChoice::leave()
{
    m_waiting = nullptr;
    Q_EMIT left();
}

}  // namespace study::app
