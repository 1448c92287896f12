// The page that makes and changes protocols: from an idea to a running session by its controls alone, and what it keeps of files
// that others wrote.
#include <QAbstractItemView>
#include <QElapsedTimer>
#include <QScrollArea>
#include <QScrollBar>

#include "protocols/texts/shipped_texts.h"
#include "protocols/usual_texts.h"
#include "study/app/language/language.h"
#include "tests/study/app/editor_fixture.h"
#include "tests/support/program.h"

using namespace study::app;
using protocols::ConditionId;
using tests::bytesAt;
using tests::protocolAt;
using tests::ShownEditor;
using tests::support::OpenWindow;

namespace {

class ResizeCounter : public QObject {
public:
    int count = 0;

protected:
    bool eventFilter(QObject*, QEvent* event) override
    {
        count += event->type() == QEvent::Resize ? 1 : 0;
        return false;
    }
};

}  // namespace

class AppEditorTest : public tests::support::WindowTest {
    Q_OBJECT

private Q_SLOTS:
    void fromAnIdeaToARunningSession();
    void examplesAreSavedAsTheyAre_data();
    void examplesAreSavedAsTheyAre();
    void everyExampleIsOffered();
    void fieldsThatNobodyKnowsStay();
    void imagesStayInTheirFolder();
    void fabricsComeFromADataSet();
    void newConditionsAndContrasts();
    void hintOfTheBoundsIsWhatTheProgramUses_data();
    void hintOfTheBoundsIsWhatTheProgramUses();
    void wayByKeysAlone();
    void previewStaysStillAtEveryHeight();
    void previewShowsTheWholePage();
    void numbersHaveTheMarkOfTheLanguage();
    void emptyFieldIsNamedByItsCaption();
    void captionsTickTheirBox();
    void listOfAChoiceShowsAllRows();
};

void AppEditorTest::fromAnIdeaToARunningSession()
{
    ShownEditor shown;
    shown.beginWith("Empty");
    shown.enter("name", "Five fabrics, four renderings");
    shown.enter("participants", "6");
    shown.enter("fabrics", "5");
    shown.section(2);
    for (const char* condition : {"v_grey", "v_shape", "h", "h&f"})
        shown.gui.click(QStringLiteral("condition ") + QLatin1String(condition));
    shown.section(3);
    shown.pick("newPhaseKind", 2);  // rate with words
    shown.gui.click("addPhaseButton");
    shown.enter("phases[0].scale.labels", "not at all\na little\nsomewhat\nmostly\ncompletely");
    shown.enter("phases[0].questions[0]", "Similar");
    shown.enter("phases[0].questions[0].text", "How similar does the screen feel to the fabric?");
    shown.section(4);
    shown.enter("seconds_per_presentation", "20");
    shown.enter("break_after", "10");
    shown.section(6);
    // The words make a scale from 1 to 5.
    QCOMPARE(shown.widget<QLineEdit>("lowerBound").placeholderText().replace(',', '.'), QString("-0.2"));
    shown.pick("contrastFirst", 3);
    shown.pick("contrastSecond", 0);
    shown.gui.click("addContrastButton");
    shown.check();
    QCOMPARE(shown.faults(), QStringList());
    QVERIFY2(
        shown.text("sessionNumbers").contains("about 7 minutes") && shown.text("sessionNumbers").contains("Presentations: 20"),
        qPrintable(shown.text("sessionNumbers")));
    QVERIFY2(shown.text("detectableEffects").contains("Similar: a difference of"), qPrintable(shown.text("detectableEffects")));
    QVERIFY2(shown.text("possibleBalance").contains("ordered pairs of conditions"), qPrintable(shown.text("possibleBalance")));

    const QString file = filePath("idea.json");
    tests::nameInDialog(file);
    shown.gui.click("makeStudyButton");
    QTRY_COMPARE(shown.window.currentPage()->objectName(), QString("newStudyPage"));
    QCOMPARE(shown.window.currentPage()->findChild<QLineEdit*>("protocolField")->text(), file);

    const auto protocol = protocolAt(file);
    QCOMPARE(protocol.name, std::string("Five fabrics, four renderings"));
    QCOMPARE(protocol.participants, 6);
    QCOMPARE(protocol.fabricCount, 5);
    QCOMPARE(protocol.conditions,
             (std::vector<ConditionId>{ConditionId("v_grey"), ConditionId("v_shape"), ConditionId("h"), ConditionId("h&f")}));
    QCOMPARE(protocol.phases.size(), std::size_t(1));
    const auto& scale = std::get<protocols::Rating>(protocol.phases[0].task).scale;
    QCOMPARE(scale.labels.size(), std::size_t(5));
    QCOMPARE(scale.max, protocols::Tenths{50});
    QCOMPARE(protocol.phases[0].questions[0].id.value, std::string("Similar"));
    QCOMPARE(protocol.phases[0].questions[0].text, std::string("How similar does the screen feel to the fabric?"));
    QCOMPARE(protocol.planned, (std::vector<protocols::PlannedContrast>{{ConditionId("h&f"), ConditionId("v_grey")}}));
    QVERIFY(support::mustRun({"protocol", "check", file}).out.contains("no fault"));

    support::mustRun({"fabrics", "make", filePath("fabrics"), "--fabrics", "5", "--samples", "3", "--seed", "4"});
    support::mustRun(
        {"study", "new", filePath("study"), "--dataset", filePath("fabrics"), "--protocol", file, "--no-passphrase"});
    OpenWindow session(database::StudyFolder{filePath("study").toStdString()}, tests::editorOptions());
    session.enrolAndBegin("P01");
    session.playTo("Presenting", "Similar");
    session.playToEnd();
    QCOMPARE(session.view().answersStored, 20);
}

void AppEditorTest::examplesAreSavedAsTheyAre_data()
{
    QTest::addColumn<QString>("text");
    const auto textOf = [](std::string_view text) { return QString::fromUtf8(text.data(), qsizetype(text.size())); };
    QTest::newRow("paper") << textOf(protocols::paperProtocolJson());
    for (const auto& example : protocols::shipped::examples())
        QTest::newRow(std::string(example.name).c_str()) << textOf(example.json);
}

void AppEditorTest::examplesAreSavedAsTheyAre()
{
    QFETCH(QString, text);
    const QString file = filePath(QLatin1String(QTest::currentDataTag()) + ".json"), copy = filePath("copy.json");
    protocols::writeWholeFile(file.toStdString(), text.toStdString());
    ShownEditor shown;
    shown.open(file);
    shown.check();
    QCOMPARE(shown.faults(), QStringList());
    QVERIFY(!shown.page().hasUnsavedChanges());
    // Every section is shown once, so that no control changes what it shows.
    for (int section = 1; section <= 6; ++section) shown.section(section);
    QVERIFY(!shown.page().hasUnsavedChanges());
    shown.gui.click("saveButton");
    QCOMPARE(bytesAt(file), text.toStdString());
    shown.saveAs(copy);
    QCOMPARE(protocolAt(copy), protocolAt(file));
    // A change that is taken back leaves the same protocol, too.
    shown.section(1);
    shown.enter("name", "Another name");
    shown.gui.click("saveButton");
    auto changed = protocolAt(file);
    changed.name = "Another name";
    QCOMPARE(protocolAt(copy), changed);
}

void AppEditorTest::everyExampleIsOffered()
{
    ShownEditor shown;
    const auto& list = shown.widget<QListWidget>("exampleList");
    QStringList offered;
    for (int row = 0; row < list.count(); ++row) {
        offered << list.item(row)->data(Qt::UserRole).toString();
        QVERIFY2(list.item(row)->text().contains('\n'), qPrintable(list.item(row)->text() + " has no explanation"));
    }
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(VIS2HAP_SOURCE_DIR "/protocols/examples")) {
        if (entry.path().extension() != ".json") continue;
        ++files;
        QVERIFY2(offered.contains(QString::fromStdString(protocols::readWholeFile(entry.path()))), entry.path().c_str());
    }
    QVERIFY(files >= 5);
    QVERIFY(offered.contains(QString::fromStdString(protocols::paperProtocolIn("en"))));
}

void AppEditorTest::fieldsThatNobodyKnowsStay()
{
    const QString file = filePath("newer.json");
    protocols::writeWholeFile(file.toStdString(), R"({
  "schema": "vis2hap.protocol/1", "name": "Newer", "comment": "ours", "participants": 2, "fabrics": 4,
  "conditions": ["v_grey", {"id": "engine", "later": "kept"}, {"id": "mine", "images": "pictures"}, "h"],
  "phases": [
    {"questions": ["Q1"], "alternatives": 2, "later": [{"same_twice": 3}]},
    {"questions": ["Q2"], "scale": {"min": 0, "max": 10}, "later": "second"}
  ],
  "participant_texts": {"agree": "Yes"}, "prompts": {"wait": "wait.wav"}, "planned": [["v_grey", "mine"]], "later": {"a": [1, 2]}
})");
    ShownEditor shown;
    shown.open(file);
    shown.check();
    QVERIFY(!shown.faults().isEmpty());  // this version does not know the keys, and says so
    shown.section(3);
    shown.gui.click("phaseDownButton");
    shown.enter("phases[1].alternatives", "3");
    shown.section(2);
    shown.gui.click("condition h");
    shown.gui.click("saveButton");
    const auto saved = nlohmann::json::parse(bytesAt(file));
    QCOMPARE(saved["comment"], "ours");
    QCOMPARE(saved["later"], nlohmann::json::parse(R"({"a": [1, 2]})"));
    QCOMPARE(saved["conditions"],
             nlohmann::json::parse(R"(["v_grey", {"id": "engine", "later": "kept"}, {"id": "mine", "images": "pictures"}])"));
    QCOMPARE(saved["phases"][0],
             nlohmann::json::parse(R"({"questions": ["Q2"], "scale": {"min": 0, "max": 10}, "later": "second"})"));
    QCOMPARE(saved["phases"][1],
             nlohmann::json::parse(R"({"questions": ["Q1"], "alternatives": 3, "later": [{"same_twice": 3}]})"));
    QCOMPARE(saved["participant_texts"]["agree"], "Yes");
    QCOMPARE(saved["prompts"]["wait"], "wait.wav");
    shown.check();
    // A key that no protocol has can be removed without seeing the file.
    for (int left = 10; left > 0 && !shown.faults().filter("unknown key").isEmpty(); --left) {
        const QStringList faults = shown.faults();
        const qsizetype row = faults.indexOf(faults.filter("unknown key").first());
        shown.gui.click(QStringLiteral("goToFault%1").arg(row + 1));
        QTRY_VERIFY(shown.faults() != faults);
        shown.check();
    }
    QVERIFY2(shown.faults().filter("unknown key").isEmpty(), qPrintable(shown.faults().join('\n')));
}

void AppEditorTest::imagesStayInTheirFolder()
{
    const QString file = filePath("with-images.json");
    QDir().mkpath(filePath("elsewhere"));
    protocols::writeWholeFile(file.toStdString(),
                              R"({"schema": "vis2hap.protocol/1", "name": "Images", "participants": 2, "fabrics": 3,
"conditions": ["v_grey", {"id": "mine", "images": "pictures"}], "phases": [{"questions": ["Q1"], "alternatives": 2}],
"prompts": {"wait": "wait.wav"}})");
    ShownEditor shown;
    shown.open(file);
    shown.section(2);
    shown.saveAs(filePath("elsewhere/copy.json"));
    const auto copy = protocolAt(filePath("elsewhere/copy.json"));
    QCOMPARE(copy.ownImages.at(ConditionId("mine")), filePath("pictures").toStdString());
    QVERIFY2(shown.text("editorMessage").contains("wait.wav"), qPrintable(shown.text("editorMessage")));
    QCOMPARE(protocolAt(file).ownImages.at(ConditionId("mine")), std::string("pictures"));
}

void AppEditorTest::fabricsComeFromADataSet()
{
    auto options = tests::editorOptions();
    options.lookAtData.open = [](const std::filesystem::path&) {
        return DataOverview{
            "Set", "", {{"F01", "Linen", "", 1, 1, 1, 1, 1}, {"F02", "Felt", "", 1, 1, 1, 1, 1}, {"F03", "", "", 1, 1, 1, 1, 1}}};
    };
    options.lookAtData.draw = [](const DataSheetRequest&) { return DataSheet{}; };
    options.lookAtData.check = [](const std::filesystem::path&, const std::function<void(double)>&) { return QStringList(); };
    ShownEditor shown(options);
    shown.beginWith("Two pieces");
    tests::nameInDialog(filePath("."));
    shown.gui.click("chooseFabricsButton");
    QTRY_VERIFY(shown.page().findChild<QListWidget*>("fabricList")->isVisible());
    auto& list = *shown.page().findChild<QListWidget*>("fabricList");
    list.setFocus();
    QTest::keyClick(&list, Qt::Key_Space);
    QTest::keyClick(&list, Qt::Key_Down);
    QTest::keyClick(&list, Qt::Key_Down);
    QTest::keyClick(&list, Qt::Key_Space);
    shown.check();
    QCOMPARE(shown.page().draft().at("fabrics"), nlohmann::ordered_json::parse(R"(["F01", "F03"])"));
    QCOMPARE(shown.widget<QLineEdit>("fabrics").text(), QString("F01, F03"));
    shown.enter("fabrics", "F02, F03");
    QCOMPARE(list.item(0)->checkState(), Qt::Unchecked);
    QCOMPARE(list.item(1)->checkState(), Qt::Checked);
}

void AppEditorTest::newConditionsAndContrasts()
{
    ShownEditor shown;
    shown.beginWith("Two pieces");
    shown.section(2);
    shown.gui.click("addOwnButton");
    QVERIFY(shown.text("conditionsMessage").contains("no name"));
    shown.enter("ownConditionField", "h_g");
    shown.enter("ownFolderField", "/pictures");
    shown.gui.click("addOwnButton");
    QVERIFY2(shown.page().findChild<QLabel*>("conditionsMessage")->isVisible(), "a known condition is no name of one's own");
    shown.enter("ownConditionField", "mine");
    shown.gui.click("addOwnButton");
    shown.pick("qualityChoice", 2);
    shown.gui.click("addQualityButton");
    shown.check();
    QCOMPARE(shown.faults(), QStringList());
    auto& further = shown.widget<QListWidget>("furtherConditions");
    QCOMPARE(further.count(), 2);
    shown.section(6);
    shown.pick("contrastFirst", 0);
    shown.pick("contrastSecond", 0);
    shown.gui.click("addContrastButton");
    QVERIFY(shown.text("analysisMessage").contains("the same"));
    shown.pick("contrastSecond", 5);
    shown.gui.click("addContrastButton");
    shown.gui.click("primaryContrastButton");
    shown.enter("lowerBound", "-0,25");
    shown.enter("upperBound", "0,25");
    shown.saveAs(filePath("rich.json"));
    const auto protocol = protocolAt(filePath("rich.json"));
    QCOMPARE(protocol.conditions.size(), std::size_t(6));
    QCOMPARE(protocol.ownImages.at(ConditionId("mine")), std::string("/pictures"));
    QVERIFY(protocol.primary && protocol.primary->b == ConditionId("mine"));
    QCOMPARE(protocol.equivalenceBounds, std::pair(-0.25, 0.25));
    // A condition that leaves is missed by its contrast, and the fault leads there.
    shown.section(2);
    shown.widget<QListWidget>("furtherConditions").setCurrentRow(1);
    shown.gui.click("removeConditionButton");
    shown.check();
    QVERIFY2(!shown.faults().isEmpty() && shown.faults().first().contains("mine"), qPrintable(shown.faults().join('\n')));
    shown.gui.click("goToFault1");
    QTRY_COMPARE(shown.window.focusWidget()->objectName(), QString("plannedContrasts"));
    QCOMPARE(shown.widget<QListWidget>("plannedContrasts").currentRow(), 2);
    shown.gui.click("removeContrastButton");
    shown.check();
    QCOMPARE(shown.faults(), QStringList());
}

void AppEditorTest::hintOfTheBoundsIsWhatTheProgramUses_data()
{
    QTest::addColumn<QString>("phases");
    QTest::addColumn<double>("bound");
    QTest::addColumn<bool>("isSound");
    const QString hundred = R"({"questions": ["Q2"], "scale": {"min": 0, "max": 100, "step": 1}})";
    QTest::newRow("no rating") << R"([{"questions": ["Q1"], "alternatives": 2}])" << 0.5 << true;
    QTest::newRow("own words beside a rating")
        << "[" + hundred + R"(, {"questions": ["Remarks"], "free_text": ["Remarks"], "scale": {"min": 0, "max": 10}}])" << 5.0
        << true;
    QTest::newRow("own words after a rating of the same phase")
        << R"([{"questions": ["Q2", "Remarks"], "free_text": ["Remarks"], "scale": {"min": 0, "max": 100}}])" << 5.0 << true;
    QTest::newRow("the shorter of two scales")
        << "[" + hundred + R"(, {"questions": ["Q3"], "scale": {"min": 1, "max": 5, "step": 1}}])" << 0.2 << true;
    QTest::newRow("only the upper end of a scale") << R"([{"questions": ["Q2"], "scale": {"max": 100}}])" << 5.0 << false;
    QTest::newRow("only the lower end of a scale") << R"([{"questions": ["Q2"], "scale": {"min": -10}}])" << 1.0 << false;
}

void AppEditorTest::hintOfTheBoundsIsWhatTheProgramUses()
{
    QFETCH(QString, phases);
    QFETCH(double, bound);
    nlohmann::ordered_json document{{"schema", "vis2hap.protocol/1"}, {"name", "Bounds"}, {"participants", 2}, {"fabrics", 3}};
    document["conditions"] = {"v_grey", "h"};
    document["phases"] = nlohmann::ordered_json::parse(phases.toStdString());
    if (phases.contains("Remarks")) document["question_texts"] = {{"Remarks", "What else did you feel?"}};
    ShownEditor shown;
    shown.page().edit(study::app::ProtocolDraft::fromText(document.dump(), "here"), {});
    shown.section(6);
    QCOMPARE(shown.widget<QLineEdit>("upperBound").placeholderText().replace(',', '.').toDouble(), bound);
    QCOMPARE(shown.widget<QLineEdit>("lowerBound").placeholderText().replace(',', '.').toDouble(), -bound);
    const auto protocol = protocols::checkedProtocol(document.dump(), "here").protocol;
    QTEST(protocol.has_value(), "isSound");
    if (protocol) QCOMPARE(protocol->equivalenceBounds, std::pair(-bound, bound));
}

void AppEditorTest::wayByKeysAlone()
{
    tests::support::ShownWindow shown(tests::editorOptions());
    QVERIFY(QTest::qWaitForWindowActive(&shown.window));
    const auto press = [&](Qt::Key key, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
        QTest::keyClick(shown.window.focusWidget() ? shown.window.focusWidget() : &shown.window, key, modifiers);
    };
    const auto tabTo = [&](const char* name) {
        for (int steps = 0; steps < 120; ++steps) {
            if (shown.window.focusWidget() && shown.window.focusWidget()->objectName() == QLatin1String(name)) return true;
            press(Qt::Key_Tab);
        }
        return false;
    };
    QVERIFY(tabTo("makeProtocolButton"));
    press(Qt::Key_Return);
    QCOMPARE(shown.window.focusWidget()->objectName(), QString("exampleList"));
    press(Qt::Key_End);
    press(Qt::Key_Return);
    QCOMPARE(shown.window.focusWidget()->objectName(), QString("name"));
    QTest::keyClicks(shown.window.focusWidget(), "By keys");
    press(Qt::Key_2, Qt::AltModifier);
    QCOMPARE(shown.window.focusWidget()->objectName(), QString("condition v_grey"));
    press(Qt::Key_Space);
    QVERIFY(tabTo("condition h"));
    press(Qt::Key_Space);
    press(Qt::Key_3, Qt::AltModifier);
    QVERIFY(tabTo("addPhaseButton"));
    press(Qt::Key_Space);
    tests::nameInDialog(filePath("keys.json"));
    press(Qt::Key_S, Qt::ControlModifier);
    const auto protocol = protocolAt(filePath("keys.json"));
    QCOMPARE(protocol.name, std::string("By keys"));
    QCOMPARE(protocol.conditions.size(), std::size_t(2));
    QVERIFY(std::holds_alternative<protocols::ForcedChoice>(protocol.phases.at(0).task));
    press(Qt::Key_Escape);
    QTRY_COMPARE(shown.window.currentPage()->objectName(), QString("startPage"));
}

void AppEditorTest::previewStaysStillAtEveryHeight()
{
    AppOptions options = tests::editorOptions();
    options.lookAhead = [](const protocols::Protocol&) { return SessionOutlook{true, {{"true slots, Q1", 9, 11}}, {}}; };
    ShownEditor shown(options);
    shown.beginWith("Two pieces");
    shown.check();
    ResizeCounter counter;
    shown.widget<QLabel>("previewPicture").installEventFilter(&counter);
    int shownBars = 0, hiddenBars = 0;
    const auto& bar = *shown.widget<QScrollArea>("checkArea").verticalScrollBar();
    for (int height = 1000; height > 600; height -= 2) {
        counter.count = 0;
        shown.window.resize(1366, height);
        QTest::qWait(1);
        for (int turn = 0; turn < 20; ++turn) QCoreApplication::processEvents();
        QVERIFY2(counter.count <= 8, qPrintable(QString("%1 px: %2 sizes").arg(height).arg(counter.count)));
        ++(bar.isVisible() ? shownBars : hiddenBars);
    }
    QVERIFY(shownBars > 0);
    QVERIFY(hiddenBars > 0);
}

void AppEditorTest::previewShowsTheWholePage()
{
    // The page of the picture has a scroll bar at its right edge if its text did not get smaller.
    ShownEditor shown;
    shown.beginWith("Two pieces");
    shown.section(3);
    shown.enter("phases[0].questions[0].text", QString("Which of the two pieces of fabric feels like the screen? ").repeated(6));
    const QImage picture = shown.widget<QLabel>("previewPicture").pixmap().toImage();
    const QRgb background = picture.pixel(picture.width() - 3, picture.height() - 3);
    for (int y = 2; y < picture.height() - 2; ++y) QCOMPARE(picture.pixel(picture.width() - 3, y), background);
    // The two answers are white boxes as wide as the page.
    int boxes = 0;
    bool isInBox = false;
    for (int y = 2; y < picture.height() - 2; ++y) {
        const bool isWhite = picture.pixel(picture.width() * 3 / 4, y) == qRgb(255, 255, 255);
        boxes += isWhite && !isInBox ? 1 : 0;
        isInBox = isWhite;
    }
    QVERIFY2(boxes >= 2, qPrintable(QString::number(boxes)));
}

void AppEditorTest::numbersHaveTheMarkOfTheLanguage()
{
    LanguageInUse language("vis2hap 0.6.0");
    language.use("de");
    ShownEditor shown;
    shown.beginWith("Zwei Proben");
    shown.section(4);
    QCOMPARE(shown.widget<QLineEdit>("dead_time_seconds").placeholderText(), QString("0,7"));
    shown.enter("dead_time_seconds", "1,5");
    shown.section(6);
    QCOMPARE(shown.widget<QLineEdit>("lowerBound").text(), QString("-0,5"));
    shown.enter("lowerBound", "-0.25");
    QCOMPARE(shown.faults(), QStringList());
    shown.saveAs(filePath("german.json"));
    const auto protocol = protocolAt(filePath("german.json"));
    QCOMPARE(protocol.deadTimeSeconds, 1.5);
    shown.page().edit(shown.page().draft(), filePath("german.json").toStdString());
    shown.section(6);
    QCOMPARE(shown.widget<QLineEdit>("lowerBound").text(), QString("-0,25"));
}

void AppEditorTest::emptyFieldIsNamedByItsCaption()
{
    ShownEditor shown;
    shown.beginWith("Two pieces");
    shown.enter("name", "");
    QCOMPARE(shown.faults(), QStringList{"Name of the study is missing"});
    shown.page().edit(study::app::ProtocolDraft(), {});
    shown.check();
    QVERIFY2(shown.faults().contains("Conditions: none yet"), qPrintable(shown.faults().join("; ")));
}

void AppEditorTest::captionsTickTheirBox()
{
    ShownEditor shown;
    shown.beginWith("Empty");
    shown.section(2);
    auto& box = shown.widget<QAbstractButton>("condition v_grey");
    for (QLabel* caption :
         {shown.page().findChild<QLabel*>("conditionId"), shown.page().findChild<QLabel*>("conditionSentence")}) {
        const bool before = box.isChecked();
        QTest::mouseClick(caption, Qt::LeftButton);
        QCOMPARE(box.isChecked(), !before);
        QTest::mouseClick(caption, Qt::RightButton);
        QCOMPARE(box.isChecked(), !before);
    }
}

void AppEditorTest::listOfAChoiceShowsAllRows()
{
    ShownEditor shown;
    shown.beginWith("Empty");
    shown.section(3);
    auto& choice = shown.widget<QComboBox>("newPhaseKind");
    choice.showPopup();
    QTest::qWait(1);
    const auto* list = choice.view();
    const QRect last = list->visualRect(list->model()->index(choice.count() - 1, 0));
    QVERIFY2(list->viewport()->rect().contains(last), qPrintable(QString::number(last.bottom())));
    choice.hidePopup();
}

QTEST_MAIN(AppEditorTest)
#include "app_editor_test.moc"
