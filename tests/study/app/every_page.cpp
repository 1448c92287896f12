#include "tests/study/app/every_page.h"

#include <QLabel>
#include <QLineEdit>
#include <QTest>

#include "protocols/files/errors.h"
#include "study/app/pages/data_page.h"
#include "study/app/pages/editor/editor_page.h"
#include "study/app/pages/monitor_window.h"
#include "study/app/pages/photographs/photographs_page.h"
#include "study/app/pages/tools/tools_page.h"
#include "tests/support/whole_protocol.h"

using namespace study::app;
using namespace study::session;
using protocols::Tenths;
using tests::support::OpenWindow;

namespace tests {

namespace {

/// A data set with one faulty file and a blank sheet.
LookAtData someData()
{
    LookAtData look;
    look.open = [](const std::filesystem::path&) {
        return DataOverview{"Fifteen fabrics",
                            "signals of different places; photographs 0.05 mm per pixel; CC0-1.0",
                            {{"F01", "Linen", "plain weave", 225, 225, 225, 225, 225}, {"F02", "Felt", "", 3, 0, 0, 2, 3}}};
    };
    look.draw = [](const DataSheetRequest& request) {
        QImage sheet(request.widthPx, 500, QImage::Format_RGB32);
        sheet.fill(Qt::gray);
        return DataSheet{sheet, "F01 visual 000.png: min 79, max 243", {}};
    };
    look.check = [](const std::filesystem::path&, const std::function<void(double)>&) {
        return QStringList{"fabrics/F02/visual/001.png: is truncated"};
    };
    return look;
}

/// Two photographs, one with a warning, and a blank picture of friction images.
PhotographSteps somePhotographs()
{
    PhotographSteps steps;
    steps.find = [](const std::filesystem::path& place) {
        return std::vector<std::filesystem::path>{place / "linen.jpg", place / "felt, from the museum.jpg"};
    };
    steps.see = [](const std::filesystem::path&, int) {
        QImage picture(800, 600, QImage::Format_RGB32);
        picture.fill(Qt::gray);
        return SeenPhotograph{picture, QSize(4000, 3000)};
    };
    steps.check = [](const PhotographSet&, const ToolProgress&) {
        return std::vector<QStringList>{{},
                                        {"photograph 0 of felt is unusual for cloth (one drawn cloth in twenty is like it); its "
                                         "height and friction are doubtful"}};
    };
    steps.write = [](const PhotographSet&, const std::filesystem::path&, const ToolProgress&) {};
    steps.draw = [](const FrictionPictureRequest& request, const ToolProgress&) {
        QImage picture(request.widthPx, 500, QImage::Format_RGB32);
        picture.fill(Qt::gray);
        return picture;
    };
    steps.plan = [](const std::filesystem::path&, const std::vector<std::string>&, const std::string&) -> std::filesystem::path {
        throw protocols::badInput({"the data set has too few fabrics for the paper's questions", "2 fabrics", "3 or more",
                                   "add photographs, or make a new study with a protocol of your own"});
    };
    return steps;
}

}  // namespace

void EveryPage::visitPages(const Look& look)
{
    AppOptions options;
    options.makeStudy = [](const NewStudyRequest&, const MakingProgress&) { return std::vector<std::string>(); };
    options.lookAtData = someData();
    options.lookAhead = [](const protocols::Protocol&) {
        return SessionOutlook{true,
                              {{"ordered pairs of conditions", 4, 5}, {"true slots per condition, Q1", 9, 11}},
                              {{"Q1", false, 0.66, ""}, {"Similar", true, 0.83, ""}}};
    };
    options.photographs = somePhotographs();
    options.useTool = [](StudyTool, const std::filesystem::path&, const std::filesystem::path&, const ToolProgress&) {
        return ToolOutcome{};
    };
    options.makeRehearsal = [](const std::filesystem::path&) -> std::shared_ptr<const std::filesystem::path> {
        throw protocols::workFailed({"the station key is missing", "station-key.json", "the file of the study", "restore it"});
    };
    options.settings = std::make_shared<QSettings>(filePath("pages.ini"), QSettings::IniFormat);
    OpenWindow open(newStudy(tests::support::wholeStudy({.language = m_language})), options);
    open.window().startSession(protocols::ParticipantId("P01"));
    open.playTo("Debriefing");
    open.gui().type("One felt sticky, the others dry.");
    look(open.window(), "debriefing");
    open.playToEnd();
    look(open.window(), "finished");
    open.gui().pressKey(Qt::Key_Return);
    QTest::qWait(1);
    open.window().startSession(protocols::ParticipantId("P02"));
    visitPreparation(open, look);
    visitQuestions(open, look);
    visitPanels(open, look);
    visitAround(open, look);
}

void EveryPage::visitPreparation(OpenWindow& open, const Look& look)
{
    look(open.window(), "introduction");
    open.playTo("Consenting");
    look(open.window(), "consent");
    open.playTo("AskingFacts");
    open.gui().focusOn("fact1");
    open.gui().type("31");
    look(open.window(), "facts");
    open.playTo("Familiarising");
    look(open.window(), "familiarisation");
    open.gui().pressKey(Qt::Key_2);
    look(open.window(), "familiarisation-shown");
    open.playTo("ScaleTraining");
    look(open.window(), "scale-training");
    open.perform(ScalePlaced{*open.view().placeToName, Tenths{50}});
    look(open.window(), "scale-training-named");
    open.playTo("CheckingList");
    open.gui().focusOn("check1");
    open.gui().pressKey(Qt::Key_Space);
    open.gui().pressKey(Qt::Key_Space);  // the focus has moved to the next box
    look(open.window(), "checklist");
    open.gui().pressKey(Qt::Key_Return);
    look(open.window(), "checklist-refused");
}

void EveryPage::visitQuestions(OpenWindow& open, const Look& look)
{
    open.playTo("PlacingTray");
    look(open.window(), "tray-first");
    open.playTo("Presenting");
    look(open.window(), "choice");
    open.gui().pressKey(Qt::Key_B);
    look(open.window(), "choice-read-back");
    open.playTo("Presenting", "W1");
    open.gui().type("Like paper,\nbut softer.");
    look(open.window(), "words");
    open.playTo("PlacingTray");
    look(open.window(), "tray");
    open.playTo("OnBreak");
    look(open.window(), "break");
    open.playTo("Presenting", "S1");
    open.gui().pressKey(Qt::Key_D);
    look(open.window(), "same-different");
    open.playTo("Presenting", "Q2");
    look(open.window(), "rating");
    open.gui().type("5,4");
    look(open.window(), "rating-read-back");
    open.gui().type("9");
    open.gui().pressKey(Qt::Key_Return);
    look(open.window(), "rating-refused");
    open.widget<QLineEdit>("ratingField").clear();
    open.playTo("Presenting", "L1");
    open.gui().type("4");
    look(open.window(), "likert");
    open.playTo("Presenting", "C1");
    open.gui().type("7.2");
    look(open.window(), "continuous");
}

void EveryPage::visitPanels(OpenWindow& open, const Look& look)
{
    open.playTo("PlacingTray");
    const auto visit = [&](Qt::Key key, const char* page) {
        open.gui().pressKey(key);
        look(open.window(), page);
        open.gui().pressKey(Qt::Key_Escape);
    };
    visit(Qt::Key_L, "correction-of-rating");
    open.gui().pressKey(Qt::Key_L);
    open.gui().click("answerToQ1");
    look(open.window(), "correction-of-choice");
    open.gui().pressKey(Qt::Key_Escape);
    visit(Qt::Key_V, "void");
    visit(Qt::Key_N, "note");
    visit(Qt::Key_F, "flag");
    visit(Qt::Key_W, "withdrawal");
    open.playTo("Presenting");
    open.perform(Noted{"", true});
    look(open.window(), "flagged");
    open.perform(Paused{});
    look(open.window(), "paused");
    open.display().fault = "the display does not answer";
    open.perform(Resumed{});
    open.gui().pressKey(Qt::Key_Return);
    look(open.window(), "display-fault");
    open.display().fault.clear();
}

void EveryPage::visitAround(OpenWindow& open, const Look& look)
{
    const auto leave = [&] {
        open.gui().pressKey(Qt::Key_Q);
        QTest::qWait(1);
    };
    leave();
    open.window().startSession(protocols::ParticipantId("P02"));
    look(open.window(), "welcome-back");
    open.perform(SittingPrepared{});
    look(open.window(), "scale-refresher");
    open.playTo("PlacingTray");
    open.clock().advanceSeconds(61 * 60);
    open.playTo("OnBreak");
    look(open.window(), "sitting-over");
    visitMonitor(open, look);
    leave();
    open.window().startSession(protocols::ParticipantId("P03"));
    open.perform(WithdrawnEvent{"tired"});
    look(open.window(), "withdrawn");
    open.gui().pressKey(Qt::Key_Return);
    QTest::qWait(1);
    look(open.window(), "study");
    open.gui().click("participantScreenButton");
    look(open.window(), "participant");
    open.gui().click("startPageButton");
    QTRY_VERIFY(open.window().currentPage()->findChild<QLabel*>("pageAddress")->isVisible());
    look(open.window(), "participant-page");
    open.gui().click("startPageButton");
    open.gui().pressKey(Qt::Key_Escape);
    open.gui().click("studyKeysButton");
    open.gui().click("assignKeyButton");
    look(open.window(), "keys");
    open.gui().pressKey(Qt::Key_Escape);
    open.gui().click("latencyTaskButton");
    look(open.window(), "latency");
    open.gui().pressKey(Qt::Key_Escape);
    open.gui().pressKey(Qt::Key_Escape);
    visitRehearsal(open, look);
    open.widget<QLineEdit>("participantField").setText("not/allowed");
    open.gui().click("enrolButton");
    look(open.window(), "study-hint");
    open.gui().pressKey(Qt::Key_F2);
    look(open.window(), "tools");
    open.gui().pressKey(Qt::Key_S);
    auto& tools = *qobject_cast<ToolsPage*>(open.window().currentPage());
    QTRY_VERIFY(!tools.isBusy());
    look(open.window(), "tools-status");
    open.gui().pressKey(Qt::Key_Escape);
    open.gui().pressKey(Qt::Key_Escape);
    look(open.window(), "start");
    open.widget<QLineEdit>("studyFolderField").setText(filePath("nothing-here"));
    open.gui().click("openButton");
    look(open.window(), "start-fault");
    open.gui().click("newStudyButton");
    look(open.window(), "new-study");
    open.gui().pressKey(Qt::Key_Escape);
    open.gui().click("lookAtDataButton");
    look(open.window(), "data");
    auto& page = *qobject_cast<DataPage*>(open.window().currentPage());
    page.open("fabrics");
    QTRY_VERIFY(!page.isBusy());
    look(open.window(), "data-open");
    open.gui().pressKey(Qt::Key_Escape);
    visitPhotographs(open, look);
    visitEditor(open, look);
    open.gui().click("displayButton");
    look(open.window(), "display");
    open.gui().click("connectDisplayButton");
    open.gui().click("pattern2Button");
    look(open.window(), "display-pattern");
}

void EveryPage::visitRehearsal(OpenWindow& open, const Look& look)
{
    open.gui().click("rehearsalButton");
    look(open.window(), "rehearsal");
    auto& field = open.widget<QLineEdit>("rehearsalPieceField");
    field.setText("000");
    QTest::keyClick(&field, Qt::Key_Return);
    look(open.window(), "rehearsal-wrong-piece");
    open.gui().pressKey(Qt::Key_F5);
    look(open.window(), "rehearsal-fault");
    open.gui().pressKey(Qt::Key_Escape);
}

void EveryPage::visitPhotographs(OpenWindow& open, const Look& look)
{
    open.gui().click("photographsButton");
    look(open.window(), "photographs");
    auto& page = *qobject_cast<PhotographsPage*>(open.window().currentPage());
    page.add(filePath("photographs"));
    QTRY_VERIFY(!page.isBusy());
    open.widget<QLineEdit>("fabricNameField").setFocus();
    look(open.window(), "photographs-name-refused");  // an id has no comma
    open.gui().clear();
    open.gui().type("felt");
    open.gui().focusOn("pixelWidthField");
    open.gui().type("40");
    look(open.window(), "photographs-scale-refused");
    open.gui().clear();
    open.gui().type("0.05");
    open.gui().click("checkPhotographsButton");
    QTRY_VERIFY(!page.isBusy());
    look(open.window(), "photographs-checked");
    open.gui().click("writeDatasetButton");
    QTRY_VERIFY(!page.isBusy());
    open.gui().click("drawFrictionImagesButton");
    QTRY_VERIFY(!page.isBusy());
    look(open.window(), "photographs-rendered");
    open.gui().click("photographsToStudyButton");
    QTRY_VERIFY(!page.isBusy());
    look(open.window(), "photographs-too-few");
    open.gui().pressKey(Qt::Key_Escape);
}

void EveryPage::visitEditor(OpenWindow& open, const Look& look)
{
    open.gui().click("makeProtocolButton");
    look(open.window(), "editor-start");
    open.gui().pressKey(Qt::Key_Return);
    auto& page = *qobject_cast<EditorPage*>(open.window().currentPage());
    const auto settle = [&] { QTRY_VERIFY_WITH_TIMEOUT(!page.isBusy(), 30000); };
    settle();
    const char* const sections[] = {"editor-study",  "editor-conditions", "editor-questions",
                                    "editor-course", "editor-texts",      "editor-analysis"};
    for (int number = 0; number < editorSections; ++number) {
        page.showSection(static_cast<EditorSection>(number));
        look(open.window(), sections[number]);
    }
    page.showPanel(true);
    look(open.window(), "editor-check");
    page.showSection(EditorSection::Study);
    open.gui().clear();
    settle();
    page.showPanel(true);
    look(open.window(), "editor-faults");
    open.gui().pressKey(Qt::Key_Escape);
    look(open.window(), "editor-unsaved");
    open.gui().click("dropChangesButton");
    QTRY_VERIFY(qobject_cast<EditorPage*>(open.window().currentPage()) == nullptr);
}

void EveryPage::visitMonitor(OpenWindow& open, const Look& look)
{
    AppOptions options;
    options.clock = std::shared_ptr<Clock>(std::shared_ptr<Clock>(), &open.clock());
    options.settings = std::make_shared<QSettings>(filePath("monitor.ini"), QSettings::IniFormat);
    options.readFlags = [](const database::StudyStore&) {
        return std::vector<MonitorFlag>{
            {"P01", "too_fast", "9 of 42 answers (21 %) came within 0.5 s of the touch"},
            {"P02", "straight_lining",
             "Q2: 12 of 18 ratings are 5; a participant who feels no difference also gives such ratings"}};
    };
    MonitorWindow monitor(open.window().study()->store().folder().folder, options);
    monitor.show();
    QTRY_VERIFY(monitor.findChild<QLabel*>("flags")->text().contains("12"));
    look(monitor, "monitor");
}

}  // namespace tests
