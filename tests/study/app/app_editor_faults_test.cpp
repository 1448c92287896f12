// The editor of protocols where something is wrong, undone, large, or not saved.
#include <QElapsedTimer>
#include <QScrollArea>
#include <QScrollBar>

#include "protocols/texts/shipped_texts.h"
#include "study/app/drafts/draft_edits.h"
#include "tests/study/app/editor_fixture.h"

using namespace study::app;
using tests::bytesAt;
using tests::protocolAt;
using tests::ShownEditor;

namespace {

using Json = nlohmann::ordered_json;

/// Ten faults, each on a line of its own.
constexpr const char* tenFaults = R"({
  "schema": "vis2hap.protocol/1",
  "name": "",
  "participants": 0,
  "fabrics": 1000,
  "conditions": ["v_grey", "h_g", "Größe"],
  "phases": [
    {"questions": ["Q1"], "alternatives": 1},
    {"questions": ["2nd"], "scale": {"min": 0, "max": 10}},
    {"questions": ["Q3"]}
  ],
  "question_texts": {"2nd": "How?", "Q3": "And?"},
  "planned": [["h_g", "h"]],
  "seconds_per_presentation": "long",
  "sitting_minute": 60
}
)";

}  // namespace

class AppEditorFaultsTest : public tests::support::WindowTest {
    Q_OBJECT

private Q_SLOTS:
    void faultsOfAFileHaveLinesAndColumns();
    void everyFaultLeadsToItsField_data();
    void everyFaultLeadsToItsField();
    void missingSentenceLeadsToItsField();
    void faultsOfAnotherPhaseShowThatPhase();
    void textThatIsNoProtocolIsNamed_data();
    void textThatIsNoProtocolIsNamed();
    void changesAreUndone();
    void unsavedChangesAreGuarded();
    void failedSavingIsTold();
    void protocolOfAStudyIsCopied();
    void previewFollowsTheQuestion();
    void largeProtocolOpensWithinSeconds();
    void narrowWindowSwitches();
    void questionsKeepTheirSentences();
    void placesThatLeadNowhereAreLeftAlone();
    void anUnknownKeyIsRemovedAsItStands_data();
    void anUnknownKeyIsRemovedAsItStands();
};

void AppEditorFaultsTest::faultsOfAFileHaveLinesAndColumns()
{
    const QString file = filePath("ten.json");
    protocols::writeWholeFile(file.toStdString(), tenFaults);
    const auto expected = protocols::checkedProtocol(tenFaults, "ten.json").faults;
    QCOMPARE(expected.size(), std::size_t(10));
    ShownEditor shown;
    shown.open(file);
    const QStringList faults = shown.faults();
    QCOMPARE(faults.size(), qsizetype(10));
    for (qsizetype i = 0; i < 10; ++i) {
        const auto& fault = expected[static_cast<std::size_t>(i)];
        QVERIFY2(faults[i].startsWith(QString("Line %1, column %2. ").arg(fault.line).arg(fault.column)), qPrintable(faults[i]));
    }
    QVERIFY2(faults[1].contains("Participants: 0, expected a whole number"), qPrintable(faults[1]));
    QVERIFY2(shown.text("editorMessage").contains("10"), qPrintable(shown.text("editorMessage")));
    // All are mended in the editor. Afterwards the file has none.
    shown.enter("name", "Mended");
    QVERIFY(!shown.faults().first().startsWith("Line"));  // the draft is no longer the file
    shown.enter("participants", "4");
    shown.enter("fabrics", "5");
    shown.section(2);
    shown.gui.click("removeConditionButton");
    shown.gui.click("condition h");
    shown.section(3);
    shown.enter("phases[0].alternatives", "2");
    shown.widget<QListWidget>("phaseList").setCurrentRow(1);
    shown.enter("phases[1].questions[0]", "Second");
    shown.widget<QListWidget>("phaseList").setCurrentRow(2);
    shown.pick("phaseKind", 3);
    shown.section(4);
    shown.enter("seconds_per_presentation", "12,5");
    QCOMPARE(shown.faults().size(), qsizetype(1));
    shown.gui.click("goToFault1");  // the key that no protocol has
    QTRY_COMPARE(shown.faults(), QStringList());
    shown.check();
    shown.gui.click("saveButton");
    const auto mended = protocolAt(file);
    QCOMPARE(mended.participants, 4);
    QCOMPARE(mended.secondsPerPresentation, 12.5);
    QCOMPARE(mended.phases[1].questions[0].text, std::string("How?"));
    QVERIFY(std::holds_alternative<protocols::SameDifferent>(mended.phases[2].task));
}

void AppEditorFaultsTest::everyFaultLeadsToItsField_data()
{
    QTest::addColumn<QString>("place");
    QTest::addColumn<QString>("value");
    QTest::addColumn<QString>("field");
    const auto row = [](const char* place, const char* value, const char* field = nullptr) {
        QTest::newRow(place) << QString(place) << QString(value) << QString(field ? field : place);
    };
    row("name", "\"\"");
    row("participants", "0");
    row("fabrics", "0");
    row("conditions", "[]", "condition v_grey");
    row("phases", "[]", "newPhaseKind");
    row("phases[0].alternatives", "99");
    row("phases[0].catch_trials", "-1");
    row("phases[0].questions", "[]", "addQuestionButton");
    row("phases[0].questions[0]", "\"2nd\"");
    row("phases[0].instructions", R"([{"id": "a b"}])", "phases[0].instructions[0].id");
    row("phases[1].scale", R"({"min": 5, "max": 1})", "phases[1].scale.min");
    row("phases[1].scale.step", "0", "phases[1].scale.labels");
    row("equivalence_bounds", "[1, -1]", "lowerBound");
    row("planned", R"([["h", "h"]])", "plannedContrasts");
    row("primary", R"(["f", "t_grey"])", "primaryContrastButton");
    row("seconds_per_presentation", "0");
    row("break_after", "0");
    row("break_after_minutes", "0");
    row("sitting_minutes", "0");
    row("familiarisation_fabrics", "-1");
    row("dead_time_seconds", "9");
    row("swatches", "\"twice\"");
    row("confirm_pieces", "3");
    row("second_entry", "3");
    row("language", "\"?\"");
    row("consent", "3");
    row("stroke_words", "3");
    row("checklist", "[3]");
    row("readings", "[\"a\", \"a\"]");
    row("facts", "[\"a\", \"a\"]");
}

void AppEditorFaultsTest::everyFaultLeadsToItsField()
{
    QFETCH(QString, place);
    QFETCH(QString, value);
    QFETCH(QString, field);
    ProtocolDraft draft;
    for (const auto& example : protocols::shipped::examples())
        if (example.name == "two_choice_likert") draft = ProtocolDraft::fromText(example.json, "example");
    draft.set(place.toStdString(), Json::parse(value.toStdString()));
    ShownEditor shown;
    QVERIFY(QTest::qWaitForWindowActive(&shown.window));
    shown.page().edit(draft, {});
    shown.check();
    QVERIFY2(!shown.faults().isEmpty(), "no fault");
    shown.gui.click("goToFault1");
    QTRY_COMPARE(shown.window.focusWidget()->objectName(), field);
    QVERIFY(shown.window.focusWidget()->isVisible());
    // Whatever the field shows, looking at it changes nothing.
    for (int section = 1; section <= 6; ++section) shown.section(section);
    QCOMPARE(shown.page().draft(), draft);
}

void AppEditorFaultsTest::missingSentenceLeadsToItsField()
{
    ShownEditor shown;
    shown.beginWith("Two pieces");
    shown.section(3);
    shown.gui.click("addQuestionButton");
    shown.check();
    shown.widget<QListWidget>("phaseList").setCurrentRow(1);
    shown.gui.click("addQuestionButton");
    shown.check();
    const QStringList faults = shown.faults().filter("has no sentence");
    QVERIFY2(!faults.isEmpty(), qPrintable(shown.faults().join('\n')));
    shown.gui.click(QStringLiteral("goToFault%1").arg(shown.faults().indexOf(faults.last()) + 1));
    QTRY_COMPARE(shown.window.focusWidget()->objectName(), QString("phases[1].questions[1].text"));
    shown.gui.type("How warm does the screen feel?");
    shown.check();
    QCOMPARE(shown.faults().filter("has no sentence").size(), faults.size() - 1);
}

void AppEditorFaultsTest::faultsOfAnotherPhaseShowThatPhase()
{
    ShownEditor shown;
    shown.beginWith("The study of the paper");
    shown.section(3);
    shown.widget<QListWidget>("phaseList").setCurrentRow(1);
    shown.enter("phases[1].scale.step", "0,3");
    QCOMPARE(shown.faults().size(), qsizetype(1));
    shown.widget<QListWidget>("phaseList").setCurrentRow(0);
    shown.section(1);
    shown.gui.click("goToFault1");
    QTRY_COMPARE(shown.window.focusWidget()->objectName(), QString("phases[1].scale.step"));
    QCOMPARE(shown.widget<QListWidget>("phaseList").currentRow(), 1);
}

void AppEditorFaultsTest::textThatIsNoProtocolIsNamed_data()
{
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("said");
    QTest::newRow("no JSON") << "{\n  \"name\": oops\n}"
                             << "line 2";
    QTest::newRow("a list") << "[1, 2]"
                            << "holds no protocol";
    QTest::newRow("doubled key") << "{\"name\": \"a\", \"name\": \"b\"}"
                                 << "name";
    QTest::newRow("empty") << ""
                           << "line 1";
}

void AppEditorFaultsTest::textThatIsNoProtocolIsNamed()
{
    QFETCH(QString, text);
    QFETCH(QString, said);
    const QString file = filePath("no-protocol.json");
    protocols::writeWholeFile(file.toStdString(), text.toStdString());
    ShownEditor shown;
    shown.open(file);
    QVERIFY2(shown.text("editorStartMessage").contains(said), qPrintable(shown.text("editorStartMessage")));
    QVERIFY(shown.page().findChild<QWidget*>("protocolFileField")->isVisible());
    shown.gui.focusOn("protocolFileField");
    shown.gui.clear();
    shown.gui.pressKey(Qt::Key_Return);
    QVERIFY(shown.text("editorStartMessage").contains("No file is given"));
}

void AppEditorFaultsTest::changesAreUndone()
{
    ShownEditor shown;
    QVERIFY(QTest::qWaitForWindowActive(&shown.window));
    shown.beginWith("Two pieces");
    const ProtocolDraft begun = shown.page().draft();
    const auto press = [&](Qt::Key key, Qt::KeyboardModifiers modifiers) {
        QTest::keyClick(shown.window.focusWidget(), key, modifiers);
    };
    QVERIFY(!shown.gui.widget("saveButton").isHidden() && !shown.page().findChild<QPushButton*>("undoButton")->isEnabled());
    shown.enter("name", "Typed in one go");
    const ProtocolDraft named = shown.page().draft();
    QVERIFY(named != begun);
    shown.enter("participants", "12");
    press(Qt::Key_Z, Qt::ControlModifier);  // in a text field, which would undo a letter only
    QCOMPARE(shown.page().draft(), named);
    QCOMPARE(shown.widget<QLineEdit>("participants").text(), QString("6"));
    shown.gui.click("undoButton");
    QCOMPARE(shown.page().draft(), begun);
    press(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
    QCOMPARE(shown.page().draft(), named);
    shown.section(3);
    shown.gui.click("removePhaseButton");
    QCOMPARE(shown.page().draft().countAt("phases"), std::size_t(1));
    press(Qt::Key_Z, Qt::ControlModifier);
    QCOMPARE(shown.page().draft(), named);
    QCOMPARE(shown.widget<QListWidget>("phaseList").count(), 2);
    // Half a name that is undone is not taken afterwards.
    shown.gui.focusOn("phases[0].questions[0]");
    shown.gui.type("x");
    press(Qt::Key_Z, Qt::ControlModifier);
    shown.section(1);
    QCOMPARE(questionIdAt(shown.page().draft(), 0, 0), std::string("Q1"));
}

void AppEditorFaultsTest::unsavedChangesAreGuarded()
{
    ShownEditor shown;
    shown.beginWith("Two pieces");
    shown.enter("name", "Precious");
    QVERIFY(shown.text("editorTitle").contains("not saved"));
    shown.gui.pressKey(Qt::Key_Escape);
    QVERIFY(shown.page().findChild<QWidget*>("leaveGuard")->isVisible());
    shown.gui.pressKey(Qt::Key_Escape);
    QVERIFY(!shown.page().findChild<QWidget*>("leaveGuard")->isVisible());
    QVERIFY(!shown.window.close());  // the window asks, too
    QVERIFY(shown.page().findChild<QWidget*>("leaveGuard")->isVisible());
    tests::nameInDialog(filePath("precious.json"));
    shown.gui.click("saveAndLeaveButton");
    QTRY_COMPARE(shown.window.currentPage()->objectName(), QString("startPage"));
    QCOMPARE(protocolAt(filePath("precious.json")).name, std::string("Precious"));

    shown.gui.click("changeProtocolButton");
    shown.open(filePath("precious.json"));
    shown.enter("name", "Dropped");
    shown.gui.pressKey(Qt::Key_Escape);
    shown.gui.click("dropChangesButton");
    QTRY_COMPARE(shown.window.currentPage()->objectName(), QString("startPage"));
    QCOMPARE(protocolAt(filePath("precious.json")).name, std::string("Precious"));
    // Without changes nothing is asked.
    shown.gui.click("changeProtocolButton");
    shown.open(filePath("precious.json"));
    shown.gui.pressKey(Qt::Key_Escape);
    QTRY_COMPARE(shown.window.currentPage()->objectName(), QString("startPage"));
}

void AppEditorFaultsTest::failedSavingIsTold()
{
    ShownEditor shown;
    shown.beginWith("Two pieces");
    shown.enter("name", "Nowhere");
    shown.page().edit(shown.page().draft(), filePath("missing/folder/protocol.json").toStdString());
    shown.enter("name", "Still nowhere");
    shown.gui.click("saveButton");
    QVERIFY2(shown.text("editorMessage").contains("missing"), qPrintable(shown.text("editorMessage")));
    QVERIFY(shown.page().hasUnsavedChanges());
}

void AppEditorFaultsTest::protocolOfAStudyIsCopied()
{
    const database::StudyFolder study = newStudy();
    const QString file = QString::fromStdString(study.protocol().string());
    const std::string before = bytesAt(file);
    ShownEditor shown;
    shown.open(file);
    QVERIFY2(shown.text("editorMessage").contains("study amend"), qPrintable(shown.text("editorMessage")));
    QVERIFY(shown.page().file().empty());
    shown.enter("name", "Changed");
    shown.saveAs(file);
    QVERIFY2(shown.text("editorMessage").contains("study amend"), qPrintable(shown.text("editorMessage")));
    QCOMPARE(bytesAt(file), before);
    shown.saveAs(filePath("copy-of-study.json"));
    QCOMPARE(protocolAt(filePath("copy-of-study.json")).name, std::string("Changed"));
}

void AppEditorFaultsTest::previewFollowsTheQuestion()
{
    ShownEditor shown;
    shown.beginWith("Two pieces");
    shown.check();
    const auto picture = [&] { return shown.widget<QLabel>("previewPicture").pixmap().toImage(); };
    const auto& choice = shown.widget<QComboBox>("previewChoice");
    QCOMPARE(choice.currentText(), QString("Question Q1"));
    const QImage before = picture();
    std::set<QRgb> colours;
    for (int x = 0; x < before.width(); x += 3)
        for (int y = 0; y < before.height(); y += 3) colours.insert(before.pixel(x, y));
    QVERIFY2(colours.size() > 20, "the preview is empty");
    shown.section(3);
    shown.enter("phases[0].questions[0].text", "Which of the two feels like the screen?");
    QVERIFY(picture() != before);
    shown.widget<QListWidget>("phaseList").setCurrentRow(1);
    shown.check();
    shown.gui.focusOn("phases[1].questions[0].text");
    QCOMPARE(choice.currentText(), QString("Question Similar"));
    // Every page can be drawn.
    auto& pages = shown.widget<QComboBox>("previewChoice");
    QVERIFY(pages.count() >= 8);
    QImage last;
    for (int page = 0; page < pages.count(); ++page) {
        pages.setCurrentIndex(page);
        QVERIFY2(picture() != last, qPrintable(pages.currentText()));
        last = picture();
    }
}

void AppEditorFaultsTest::largeProtocolOpensWithinSeconds()
{
    ProtocolDraft draft;
    draft.set("name", "Large");
    draft.set("conditions", {"v_grey", "h_g", "h"});
    for (int phase = 0; phase < 300; ++phase) {
        addPhase(draft, static_cast<PhaseKind>(phase % 3));
        for (int question = 0; question < 3 && phase % 3 == 1; ++question) addQuestion(draft, static_cast<std::size_t>(phase));
        for (std::size_t question = 0; question < draft.countAt(phasePlace(static_cast<std::size_t>(phase), "questions"));
             ++question)
            setSentence(draft, questionIdAt(draft, static_cast<std::size_t>(phase), question), "How does it feel?");
    }
    Json lines = Json::array();
    for (int line = 0; line < 2000; ++line) lines.push_back("Point " + std::to_string(line));
    draft.set("checklist", lines);
    const std::string text = draft.fileText();
    QVERIFY2(std::count(text.begin(), text.end(), '\n') > 5000,
             qPrintable(QString::number(std::count(text.begin(), text.end(), '\n'))));
    const QString file = filePath("large.json");
    protocols::writeWholeFile(file.toStdString(), text);
    auto options = tests::editorOptions();
    options.lookAhead = {};
    ShownEditor shown(options);
    QElapsedTimer clock;
    clock.start();
    shown.open(file);
    QCoreApplication::processEvents();
    const qint64 openedMs = clock.restart();
    QCOMPARE(shown.faults(), QStringList());
    shown.enter("name", "Larger");
    const qint64 typedMs = clock.elapsed();
    qInfo("opened in %lld ms, six letters typed and checked in %lld ms", openedMs, typedMs);
    QVERIFY2(openedMs < 5000 && typedMs < 5000, qPrintable(QString("%1 ms, %2 ms").arg(openedMs).arg(typedMs)));
}

void AppEditorFaultsTest::narrowWindowSwitches()
{
    ShownEditor shown;
    shown.window.resize(800, 600);
    shown.beginWith("Two pieces");
    shown.check();
    QVERIFY(QTest::qWaitFor([&] { return shown.window.width() == 800; }));
    QVERIFY(!shown.page().findChild<QWidget*>("checkArea")->isVisible());
    QVERIFY2(shown.widget<QPushButton>("panelButton").text().contains("No fault"),
             qPrintable(shown.widget<QPushButton>("panelButton").text()));
    shown.gui.click("panelButton");
    QVERIFY(shown.page().findChild<QWidget*>("checkArea")->isVisible());
    QVERIFY(!shown.page().findChild<QWidget*>("name")->isVisible());
    QTest::keyClick(shown.window.focusWidget(), Qt::Key_F6);
    QVERIFY(shown.page().findChild<QWidget*>("name")->isVisible());
}

void AppEditorFaultsTest::questionsKeepTheirSentences()
{
    ProtocolDraft draft = ProtocolDraft::fromText(R"({"phases": [
        {"questions": ["Q1", "Soft"], "alternatives": 2, "free_text": ["Soft"]}, {"questions": ["Warm"], "scale": {"min": 0, "max": 1}}],
        "question_texts": {"Soft": "How soft?", "Warm": "How warm?"}, "prompts": {"question_Soft": "soft.wav"}})",
                                                  "here");
    renameQuestion(draft, 0, 1, "Softness");
    QCOMPARE(sentenceOf(draft, "Softness"), std::string("How soft?"));
    QCOMPARE(sentenceOf(draft, "Soft"), std::string());
    QVERIFY(isInOwnWords(draft, 0, "Softness") && !isInOwnWords(draft, 0, "Soft"));
    QCOMPARE(draft.at("prompts"), Json::parse(R"({"question_Softness": "soft.wav"})"));
    // A name that another question has takes nothing away from that question.
    renameQuestion(draft, 0, 1, "Warm");
    QCOMPARE(sentenceOf(draft, "Warm"), std::string("How warm?"));
    removeQuestion(draft, 0, 1);
    QCOMPARE(sentenceOf(draft, "Warm"), std::string("How warm?"));
    QVERIFY(!draft.has("phases[0].free_text"));
    exchangePhases(draft, 0, 1);
    QCOMPARE(questionIdAt(draft, 0, 0), std::string("Warm"));
    removePhase(draft, 0);
    QVERIFY(!draft.has("question_texts.Warm"));
    QCOMPARE(draft.countAt("phases"), std::size_t(1));
    setPhaseKind(draft, 0, PhaseKind::OwnWords);
    QVERIFY(phaseKindOf(draft, 0) == PhaseKind::OwnWords);
    setPhaseKind(draft, 0, PhaseKind::Words);
    QVERIFY(phaseKindOf(draft, 0) == PhaseKind::Words && !draft.has("phases[0].free_text"));
}

void AppEditorFaultsTest::placesThatLeadNowhereAreLeftAlone()
{
    ProtocolDraft draft =
        ProtocolDraft::fromText(R"({"phases": [{"questions": ["Q1"]}], "phases[0]": 1, "a.b": 2, "": 3, "n": null})", "here");
    const ProtocolDraft begun = draft;
    for (const char* place :
         {"phases[foo", "phases[]", "phases[-1]", "phases[1x]", "phases[99999999999999999999]", "[", "", "."}) {
        QVERIFY2(place[0] == '\0' || place[0] == '.' || !draft.has(place), place);
        draft.erase(place);
        QVERIFY2(draft == begun, place);
    }
    QVERIFY(!draft.eraseKey("phases[7]", "questions") && !draft.eraseKey("phases[foo", "x") && !draft.eraseKey("phases", "0"));
    QVERIFY(draft == begun);
    for (const char* key : {"phases[0]", "a.b", "", "n"}) QVERIFY2(draft.eraseKey("", key), key);
    QCOMPARE(draft.document(), Json::parse(R"({"phases": [{"questions": ["Q1"]}]})"));
    QVERIFY(draft.eraseKey("phases[0]", "questions"));
    QCOMPARE(draft.document(), Json::parse(R"({"phases": [{}]})"));
}

void AppEditorFaultsTest::anUnknownKeyIsRemovedAsItStands_data()
{
    QTest::addColumn<QString>("key");
    QTest::newRow("a bracket that never closes") << "phases[foo";
    QTest::newRow("the name of a place") << "phases[0]";
    QTest::newRow("a key behind a quote") << "x'phases";
    QTest::newRow("a path") << "phases[0].questions";
    QTest::newRow("nothing") << "";
}

void AppEditorFaultsTest::anUnknownKeyIsRemovedAsItStands()
{
    QFETCH(const QString, key);
    ProtocolDraft sound;
    for (const auto& example : protocols::shipped::examples())
        if (example.name == "two_choice_likert") sound = ProtocolDraft::fromText(example.json, "example");
    sound.erase("$schema");
    Json document = sound.document();
    document[key.toStdString()] = 1;
    ShownEditor shown;
    QVERIFY(QTest::qWaitForWindowActive(&shown.window));
    shown.page().edit(ProtocolDraft::fromText(document.dump(), "here"), {});
    shown.check();
    QCOMPARE(shown.faults().size(), qsizetype(1));
    shown.gui.click("goToFault1");
    QTRY_COMPARE(shown.faults(), QStringList());
    QCOMPARE(shown.page().draft(), sound);
}

QTEST_MAIN(AppEditorFaultsTest)
#include "app_editor_faults_test.moc"
