// The usual texts of each language: complete, with the places of the English ones; and which wording of a question was used.
#include "protocols/usual_texts.h"

#include <QTest>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"
#include "protocols/protocol_json.h"

using namespace protocols;

namespace {

const std::string folder = VIS2HAP_SOURCE_DIR "/protocols/texts/";

std::string textOf(const char* question, int pieces, const std::string& language)
{
    return usualTextOf(QuestionId(question), ForcedChoice{pieces}, ProtocolEdition::Current, language);
}

/// A protocol of one question in this language, with more members.
Protocol protocolIn(const std::string& language, const std::string& more = "")
{
    return protocolFromJson(R"({"schema": "vis2hap.protocol/1", "name": "a", "participants": 2, "fabrics": 4, "conditions": ["h"],
 "phases": [{"questions": ["Q1"], "alternatives": 4}], "language": ")" +
                                language + "\"" + more + "}",
                            "a protocol");
}

}  // namespace

class UsualTextsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void everyFileOfTheFolderIsBuiltIn()
    {
        const auto languages = languagesOfUsualTexts();
        QCOMPARE(languages.front(), std::string("en"));
        std::size_t files = 0;
        for (const auto& entry : std::filesystem::directory_iterator(folder))
            if (entry.path().extension() == ".json") {
                ++files;
                const UsualTexts texts = usualTextsFromJson(readWholeFile(entry.path()), entry.path().filename().string());
                QVERIFY2(std::ranges::find(languages, texts.language) != languages.end(), texts.language.c_str());
                QCOMPARE(entry.path().filename().string(), "usual_texts." + texts.language + ".json");
            }
        QCOMPARE(files, languages.size());
    }

    void everyLanguageSaysAllThatEnglishSays()
    {
        const UsualTexts& english = usualTexts("en");
        QVERIFY(english.participant.size() > 60);
        for (const std::string& language : languagesOfUsualTexts()) {
            const UsualTexts& texts = usualTexts(language);  // throws where a text or a place is missing
            QCOMPARE(texts.checklist.size(), english.checklist.size());
            QCOMPARE(texts.readings.size(), english.readings.size());
            QCOMPARE(texts.facts.size(), english.facts.size());
            QCOMPARE(texts.counts.size(), english.counts.size());
            for (const auto& [key, text] : texts.participant) {
                QVERIFY2(!text.empty(), key.c_str());
                QVERIFY2(language == "en" || text != english.participant.find(key)->second || key.starts_with("code_") ||
                             key == "decimal_mark",
                         (language + ": " + key).c_str());
            }
            for (const auto& [key, text] : texts.ownData)
                QVERIFY2(!text.empty() && (language == "en" || text != english.ownData.find(key)->second),
                         (language + ": " + key).c_str());
        }
    }

    void aBrokenFileNamesItsPart_data()
    {
        QTest::addColumn<QString>("part");
        QTest::addColumn<QString>("fault");
        const auto row = [](const char* part, const char* fault) { QTest::newRow(part) << part << fault; };
        row("language", "'language' is missing");
        row("reviewer", "'reviewer' is missing");
        row("questions", "'questions' is missing");
        row("counts", "'counts' is no list of texts");
        row("participant", "'participant' is missing");
        row("own_data", "'own_data' is missing");
    }
    void aBrokenFileNamesItsPart()
    {
        QFETCH(const QString, part);
        QFETCH(const QString, fault);
        auto file = nlohmann::json::parse(readWholeFile(folder + "usual_texts.en.json"));
        file.erase(part.toStdString());
        try {
            usualTextsFromJson(file.dump(), "own.json");
            QFAIL("accepted");
        } catch (const Error& refused) {
            QVERIFY2(QString(refused.what()).contains("own.json: " + fault), refused.what());
        }
    }

    void theMainPartOfTheTagDecides()
    {
        for (const char* tag : {"de", "de-CH", "DE", "de_AT"}) QCOMPARE(usualTexts(tag).language, std::string("de"));
        for (const char* tag : {"zh", "zh-CN", "zh_Hans", "zh-Hans-HK", "zh-SG"})
            QCOMPARE(usualTexts(tag).language, std::string("zh"));
        for (const char* tag : {"en", "en-GB", "fr", "", "deu", "zh-Hant", "zh_TW", "zh-HK", "zho"})
            QCOMPARE(usualTexts(tag).language, std::string("en"));
        QVERIFY(hasUsualTexts("de-CH") && !hasUsualTexts("fr") && !hasUsualTexts("d"));
    }

    void questionsAreAskedInTheLanguage()
    {
        QCOMPARE(textOf("Q1", 3, "en"), std::string("Which of the three pieces of fabric feels like the screen: A, B or C?"));
        QCOMPARE(textOf("Q1", 3, "de"),
                 std::string("Welche der drei Stoffproben fühlt sich an wie der Bildschirm: A, B oder C?"));
        QCOMPARE(textOf("Q1", 20, "de"), std::string("Welche der 20 Stoffproben fühlt sich an wie der Bildschirm: A bis T?"));
        QCOMPARE(textOf("W7", 3, "de"), std::string());
        QCOMPARE(textOf("Q1", 3, "zh"), std::string("这三块布料中，哪一块的手感与屏幕上的相符：A、B还是C？"));
        QCOMPARE(textOf("Q1", 2, "zh"), std::string("这两块布料中，哪一块的手感与屏幕上的相符：A还是B？"));
        BlockInstruction fast{InstructionId("fast"), SpeedAim::Speed, 2.5, {}};
        QCOMPARE(usualInstructionText(fast, "en"),
                 std::string("Answer as fast as you can. Mistakes are all right now. Answer within 2.5 seconds after your finger "
                             "touches the screen."));
        QVERIFY(usualInstructionText(fast, "de").find("innerhalb von 2,5 Sekunden") != std::string::npos);
        QCOMPARE(usualInstructionText(fast, "zh"),
                 std::string("请尽快回答。现在答错也没关系。请在手指触到屏幕后的2.5秒内回答。"));
        fast.deadlineSeconds = 1;
        QVERIFY(usualInstructionText(fast, "de").find("innerhalb von 1 Sekunde,") != std::string::npos);
    }

    void aProtocolTakesTheTextsOfItsLanguage()
    {
        const Protocol german = protocolIn("de-AT");
        QCOMPARE(german.phases[0].questions[0].text, textOf("Q1", 4, "de"));
        QCOMPARE(german.consent, usualTexts("de").consent);
        QCOMPARE(german.strokeWords, usualTexts("de").strokeWords);
        QCOMPARE(participantText(german, "break_title"), std::string("Pause"));
        const Protocol own =
            protocolIn("de", R"(, "question_texts": {"Q1": "Welche?"}, "participant_texts": {"break_title": "Rast"})");
        QCOMPARE(own.phases[0].questions[0].text, std::string("Welche?"));
        QCOMPARE(participantText(own, "break_title"), std::string("Rast"));
        QCOMPARE(participantText(own, "say_stop"), std::string("Sie können jederzeit aufhören. Sie müssen keinen Grund nennen."));
        QCOMPARE(protocolIn("fr").consent, usualTexts("en").consent);
        // A study of an earlier version keeps what its participants heard.
        const std::string json =
            R"({"schema": "vis2hap.protocol/1", "name": "a", "participants": 2, "fabrics": 4, "language": "de",
 "conditions": ["h"], "phases": [{"questions": ["Q2"], "scale": {"min": 0, "max": 10}}]})";
        QCOMPARE(keptProtocolFromJson(json, "a study", "0.5.0").phases[0].questions[0].text, paperWordingOf(QuestionId("Q2")));
    }

    void ownEndsOfTheScaleReplaceTheUsualOnes_data()
    {
        QTest::addColumn<QString>("own");
        QTest::addColumn<QString>("low");
        QTest::addColumn<QString>("ends");
        QTest::addColumn<QString>("missing");
        const QString usualLow = "These two are unrelated. This is {number}.";
        QTest::newRow("none") << "" << usualLow << "{low} means unrelated. {high} means totally the same."
                              << "";
        QTest::newRow("line") << R"("scale_low": "rough", "scale_high": "soft")"
                              << "{number} rough"
                              << "{low} rough, {high} soft"
                              << "card_low, say_unrelated, card_high, say_same, say_ends";
        QTest::newRow("one end") << R"("scale_high": "soft")" << usualLow << "{low} unrelated, {high} soft"
                                 << "card_high, say_same, say_ends";
        QTest::newRow("card") << R"("card_low": "{number} is rough.")"
                              << "{number} is rough."
                              << "{low} is rough. {high} totally the same"
                              << "scale_low, say_unrelated, say_ends";
        QTest::newRow("all of one end")
            << R"("scale_low": "rough", "card_low": "{number} a", "say_unrelated": "{number} b", "say_ends": "{low} c {high}")"
            << "{number} b"
            << "{low} c {high}"
            << "";
        QTest::newRow("spoken only") << R"("say_unrelated": "{number} b")"
                                     << "{number} b"
                                     << "{low} means unrelated. {high} means totally the same."
                                     << "";
    }
    void ownEndsOfTheScaleReplaceTheUsualOnes()
    {
        QFETCH(const QString, own);
        QFETCH(const QString, low);
        QFETCH(const QString, ends);
        QFETCH(const QString, missing);
        const std::string json = R"({"schema": "vis2hap.protocol/1", "name": "a", "participants": 2, "fabrics": 4,
 "conditions": ["h"], "participant_texts": {)" +
                                 own.toStdString() + R"(}, "phases": [{"questions": ["Q2"], "scale": {"min": 0, "max": 10}}]})";
        Protocol protocol = protocolFromJson(json, "ends");
        QCOMPARE(QString::fromStdString(participantText(protocol, "say_unrelated")), low);
        QCOMPARE(QString::fromStdString(participantText(protocol, "say_ends")), ends);
        const QString note = QString::fromStdString(noteOnOwnEnds(protocol));
        QCOMPARE(note.section(", but no ", 1).section("; ", 0, 0), missing);
        protocol.phases.clear();
        QCOMPARE(noteOnOwnEnds(protocol), std::string());  // no scale of numbers
    }

    void thePapersStudyIsMadeInEachLanguage()
    {
        const Protocol english = protocolFromJson(paperProtocolIn("en"), "en");
        QCOMPARE(paperProtocolIn("en"), std::string(paperProtocolJson()));
        for (const std::string& language : languagesOfUsualTexts()) {
            const Protocol protocol = protocolFromJson(paperProtocolIn(language), language);
            QCOMPARE(protocol.language, language);
            QCOMPARE(protocol.phases[0].questions[0].text, textOf("Q1", 3, language));
            QCOMPARE(protocol.checklist, usualTexts(language).checklist);
            QVERIFY(fixedPartsChanged(english, protocol).empty());
        }
    }

    void theWordingOfAQuestionIsKnown()
    {
        const auto wording = [](const char* id, const std::string& text) {
            return QString::fromStdString(wordingOf(QuestionId(id), ForcedChoice{3}, text));
        };
        QCOMPARE(wording("Q1", "Which of the showed three fabric pieces does the haptic rendering match with?"),
                 QString("the paper's wording"));
        QCOMPARE(wording("Q4", "How much realism of haptic rendering do you feel compared with physical fabric?"),
                 QString("the paper's wording"));
        QCOMPARE(wording("Q2", usualTexts("en").questions.at("Q2")), QString("the corrected wording"));
        QCOMPARE(wording("Q1", textOf("Q1", 3, "de")), QString("the corrected wording in German, translation not reviewed"));
        QCOMPARE(wording("Q3", "How rough is it?"), QString("the study's own wording"));
        QCOMPARE(wording("W1", "How does it feel?"), QString());
    }
};

QTEST_APPLESS_MAIN(UsualTextsTest)
#include "usual_texts_test.moc"
