#include "study/app/window_pages.h"

#include "study/app/pages/data_page.h"
#include "study/app/pages/new_study_page.h"
#include "study/app/pages/photographs/photographs_page.h"
#include "study/app/pages/session_page.h"
#include "study/app/pages/setup/connecting_page.h"
#include "study/app/pages/setup/display_page.h"
#include "study/app/pages/setup/keys_page.h"
#include "study/app/pages/setup/latency_page.h"
#include "study/app/pages/setup/participant_page.h"
#include "study/app/pages/setup/rehearsal_page.h"
#include "study/app/pages/start_page.h"
#include "study/app/pages/study_page.h"
#include "study/app/pages/tools/tools_page.h"
#include "study/app/participant_room.h"

namespace study::app {

WindowPages::WindowPages(const AppOptions& options, const ParticipantRoom& room, QWidget* parent)
    : QStackedWidget(parent),
      start(new StartPage(this)),
      newStudy(new NewStudyPage(options.makeStudy, this)),
      data(new DataPage(options.lookAtData, this)),
      photographs(new PhotographsPage(options.photographs, this)),
      display(new DisplayPage(options, this)),
      connecting(new ConnectingPage(this)),
      keys(new KeysPage(options.settings, this)),
      latency(new LatencyPage(options.clock, this)),
      participant(new ParticipantPage(room.side(), room.sound(), this)),
      rehearsal(new RehearsalPage(this)),
      study(new StudyPage(this)),
      tools(new ToolsPage(options.useTool, this)),
      session(new SessionPage(this))
{
    setObjectName("pages");
    for (QWidget* page : std::initializer_list<QWidget*>{start, newStudy, data, photographs, display, connecting, keys, latency,
                                                         participant, rehearsal, study, tools, session})
        addWidget(page);
    connectStart();
}

void WindowPages::connectStart()
{
    connect(start, &StartPage::newStudyRequested, this, [this] { bring(*newStudy); });
    connect(start, &StartPage::dataRequested, this, [this] { bring(*data); });
    connect(start, &StartPage::photographsRequested, this, [this] { bring(*photographs); });
    connect(data, &DataPage::backRequested, this, &WindowPages::startRequested);
    connect(photographs, &PhotographsPage::backRequested, this, &WindowPages::startRequested);
    connect(photographs, &PhotographsPage::studyRequested, this, [this](const QString& dataset, const QString& protocol) {
        newStudy->fill(dataset, protocol);
        bring(*newStudy);
    });
    connect(newStudy, &NewStudyPage::backRequested, this, &WindowPages::startRequested);
    connect(newStudy, &NewStudyPage::made, this, &WindowPages::studyMade);
}

}  // namespace study::app
