// Sentences on the participant's screen and recordings for the headphones, as the editor of protocols offers them.
#include "protocols/usual_texts.h"
#include "study/app/drafts/draft_texts.h"
#include "tests/study/app/editor_fixture.h"

using namespace study::app;
using Json = nlohmann::ordered_json;
using tests::bytesAt;
using tests::protocolAt;
using tests::ShownEditor;

class AppEditorTextsTest : public tests::support::WindowTest {
    Q_OBJECT

private:
    /// Chooses the row of this key by a click on it.
    static void choose(ShownEditor& shown, const char* list, const QString& key)
    {
        auto& rows = *shown.page().findChild<QListWidget*>(QLatin1String(list));
        for (int row = 0; row < rows.count(); ++row)
            if (rows.item(row)->text().section(QStringLiteral("    "), 0, 0) == key) rows.setCurrentRow(row);
        QCOMPARE(rows.currentItem()->text().section(QStringLiteral("    "), 0, 0), key);
    }
    static QString chosenRow(const ShownEditor& shown, const char* list)
    {
        return shown.page().findChild<QListWidget*>(QLatin1String(list))->currentItem()->text();
    }
    static QPlainTextEdit& fieldOf(const ShownEditor& shown, const char* object)
    {
        return *shown.page().findChild<QPlainTextEdit*>(QLatin1String(object));
    }

private Q_SLOTS:
    void aSentenceIsReplacedAndUsualAgain();
    void thePreviewShowsTheSentence();
    void everySentenceOfThePageIsOffered();
    void recordingsHaveTheirFields();
    void promptsFollowTheQuestions();
    void faultsLeadToTheirSentence();
    void sentencesFollowTheLanguage();
};

void AppEditorTextsTest::aSentenceIsReplacedAndUsualAgain()
{
    ShownEditor shown;
    shown.beginWith("Two pieces");
    shown.section(5);
    choose(shown, "participant_textsList", "break_title");
    QCOMPARE(chosenRow(shown, "participant_textsList"), QString("break_title    Break"));
    QCOMPARE(fieldOf(shown, "participant_texts").placeholderText(), QString("Break"));
    shown.enter("participant_texts", "A rest");
    QCOMPARE(chosenRow(shown, "participant_textsList"), QString("break_title    own: A rest"));
    choose(shown, "participant_textsList", "feel_title");
    QCOMPARE(fieldOf(shown, "participant_texts").toPlainText(), QString());
    shown.enter("participant_texts", "Touch the glass");
    QCOMPARE(shown.faults(), QStringList());
    const QString file = filePath("texts.json");
    shown.saveAs(file);
    QCOMPARE(protocolAt(file).participantTexts,
             (std::map<std::string, std::string>{{"break_title", "A rest"}, {"feel_title", "Touch the glass"}}));
    // Undo takes back one sentence, then the other.
    fieldOf(shown, "participant_texts").setFocus();
    QTest::keyClick(&fieldOf(shown, "participant_texts"), Qt::Key_Z, Qt::ControlModifier);
    QCOMPARE(shown.page().draft().at("participant_texts"), Json::parse(R"({"break_title": "A rest"})"));
    QCOMPARE(fieldOf(shown, "participant_texts").toPlainText(), QString());
    choose(shown, "participant_textsList", "break_title");
    shown.enter("participant_texts", "");
    QVERIFY(!shown.page().draft().has("participant_texts"));
    QCOMPARE(chosenRow(shown, "participant_textsList"), QString("break_title    Break"));
}

void AppEditorTextsTest::thePreviewShowsTheSentence()
{
    ShownEditor shown;
    shown.beginWith("Two pieces");
    shown.section(5);
    const auto& preview = shown.widget<QComboBox>("previewChoice");
    const auto picture = [&] { return shown.widget<QLabel>("previewPicture").pixmap(Qt::ReturnByValue).toImage(); };
    for (const auto& [key, page] : {std::pair("break_title", "break"), std::pair("welcome_text", "welcome"),
                                    std::pair("mask_title", "blindfold"), std::pair("end_text", "end")}) {
        choose(shown, "participant_textsList", key);
        QCOMPARE(preview.currentText(), QStringLiteral("Participant's screen: ") + QLatin1String(page));
        const QImage before = picture();
        shown.enter("participant_texts", "Something else altogether");
        QVERIFY2(picture() != before, key);
    }
    const QString last = preview.currentText();
    choose(shown, "participant_textsList", "code_wrong");  // on no page of the preview
    QCOMPARE(preview.currentText(), last);
}

void AppEditorTextsTest::everySentenceOfThePageIsOffered()
{
    ShownEditor shown;
    shown.beginWith("Two pieces");
    const auto& rows = *shown.page().findChild<QListWidget*>("participant_textsList");
    const auto& usual = protocols::usualParticipantTexts();
    QCOMPARE(rows.count(), static_cast<int>(usual.size()));
    int row = 0;
    for (const auto& [key, text] : usual)
        QVERIFY2(rows.item(row++)->text().startsWith(QString::fromStdString(key) + "    "), key.c_str());
}

void AppEditorTextsTest::recordingsHaveTheirFields()
{
    ShownEditor shown;
    shown.beginWith("Two pieces");
    shown.section(5);
    choose(shown, "promptsList", "wait");
    shown.enter("prompts", "wait.wav");
    choose(shown, "promptsList", "answer_A");
    shown.enter("prompts", "a.wav");
    QCOMPARE(shown.faults(), QStringList());
    shown.saveAs(filePath("prompts.json"));
    QCOMPARE(protocolAt(filePath("prompts.json")).prompts,
             (std::map<std::string, std::string>{{"answer_A", "a.wav"}, {"wait", "wait.wav"}}));
    shown.enter("prompts", "../a.wav");
    QCOMPARE(shown.faults().size(), qsizetype(1));
    choose(shown, "promptsList", "wait");
    shown.gui.click("goToFault1");
    QTRY_COMPARE(shown.window.focusWidget(), static_cast<QWidget*>(&fieldOf(shown, "prompts")));
    QCOMPARE(chosenRow(shown, "promptsList"), QString("answer_A    own: ../a.wav"));
}

void AppEditorTextsTest::promptsFollowTheQuestions()
{
    const auto keysOf = [](const char* phases) {
        ProtocolDraft draft;
        draft.set("phases", Json::parse(phases));
        QStringList keys;
        for (const KeyedText& prompt : promptsOf(draft)) keys << QString::fromStdString(prompt.key);
        return keys.join(' ');
    };
    QCOMPARE(keysOf("[]"), QString("wait feel break end same different point"));
    QCOMPARE(keysOf(R"([{"questions": ["Q1", "W.1"], "alternatives": 2}])"),
             QString("wait feel break end question_Q1 question_W.1 answer_A answer_B same different point"));
    QCOMPARE(keysOf(R"([{"questions": ["L1"], "scale": {"min": -1, "max": 2, "step": 1}}])"),
             QString("wait feel break end question_L1 same different point number_0 number_1 number_2"));
    QVERIFY(keysOf(R"([{"questions": ["Q2"], "scale": {"min": 0, "max": 1, "step": 0.1}}])").endsWith("number_8 number_9"));
    QVERIFY(keysOf(R"([{"questions": ["Q2"], "scale": {"min": 0, "max": 1e9, "step": 1}}])").endsWith("number_100"));
    QVERIFY(keysOf(R"([{"questions": [7, ""], "alternatives": "two", "scale": "wide"}])").endsWith("point"));
    // Every offered prompt is one that a protocol may have.
    ShownEditor shown;
    shown.beginWith("Two pieces");
    const protocols::Protocol protocol =
        protocols::checkedProtocol(shown.page().draft().fileText(), "the example").protocol.value();
    for (const KeyedText& prompt : promptsOf(shown.page().draft()))
        QVERIFY2(isPromptKey(protocol, prompt.key), prompt.key.c_str());
}

void AppEditorTextsTest::faultsLeadToTheirSentence()
{
    const QString file = filePath("faulty.json");
    protocols::writeWholeFile(file.toStdString(),
                              R"({"schema": "vis2hap.protocol/1", "name": "Faulty", "participants": 2, "fabrics": 3,
"conditions": ["v_grey", "h"], "phases": [{"questions": ["Q1"], "alternatives": 2}],
"participant_texts": {"scale_tap": "Tap.", "hello": "Hi"}})");
    ShownEditor shown;
    shown.open(file);
    shown.check();
    const QStringList faults = shown.faults();
    QCOMPARE(faults.size(), qsizetype(2));
    const auto fault = faults.indexOf(faults.filter("{number}").value(0));
    shown.gui.click(QStringLiteral("goToFault%1").arg(fault + 1));
    QTRY_COMPARE(shown.window.focusWidget(), static_cast<QWidget*>(&fieldOf(shown, "participant_texts")));
    QCOMPARE(fieldOf(shown, "participant_texts").toPlainText(), QString("Tap."));
    shown.enter("participant_texts", "Tap at {number}.");
    choose(shown, "participant_textsList", "hello");  // no page has it; it can be removed
    shown.enter("participant_texts", "");
    QCOMPARE(shown.faults(), QStringList());
    QCOMPARE(shown.page().draft().at("participant_texts"), Json::parse(R"({"scale_tap": "Tap at {number}."})"));
}

void AppEditorTextsTest::sentencesFollowTheLanguage()
{
    ShownEditor shown;
    shown.beginWith("Two pieces");
    shown.section(5);
    choose(shown, "participant_textsList", "break_title");
    shown.enter("language", "de");
    QCOMPARE(chosenRow(shown, "participant_textsList"), QString("break_title    Pause"));
    QCOMPARE(fieldOf(shown, "participant_texts").placeholderText(), QString("Pause"));
    QCOMPARE(shown.page().draft().has("participant_texts"), false);
}

QTEST_MAIN(AppEditorTextsTest)
#include "app_editor_texts_test.moc"
