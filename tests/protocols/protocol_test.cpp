#include <QTemporaryDir>
#include <QTest>
#include <fstream>

#include "protocols/files/errors.h"
#include "protocols/protocol_json.h"

using namespace protocols;

namespace {

Protocol paper() { return protocolFromJson(paperProtocolJson(), "vis2hap.json"); }

/// The refusal of a text; empty if it is accepted.
QString refusalOf(const QString& json)
{
    try {
        protocolFromJson(json.toStdString(), "study.json");
    } catch (const Error& error) {
        return error.exitCode() == ExitCode::BadInput ? error.what() : "wrong exit code";
    }
    return {};
}

/// A small protocol that can run, with one part replaced.
QString smallProtocol(const QString& part = {}, const QString& by = {})
{
    QString json = R"({"schema": "vis2hap.protocol/1", "name": "small", "participants": 2, "fabrics": 3,
 "conditions": ["v_grey", "h_g+f_g"],
 "phases": [{"questions": ["Q1"], "alternatives": 3}, {"questions": ["Q2"], "scale": {"min": 0, "max": 10}}]})";
    if (!part.isEmpty() && !json.contains(part)) qFatal("the part is not in the protocol");
    return part.isEmpty() ? json : json.replace(part, by);
}

}  // namespace

class ProtocolTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void paperAsks126TrialsAnd252AnswersOfEachParticipant()
    {
        const Protocol protocol = paper();
        QCOMPARE(protocol.participants, 10);
        QCOMPARE(protocol.presentationsPerPhase(), 63);
        QCOMPARE(protocol.presentations(), 126);
        QCOMPARE(protocol.answersPerParticipant(), 252);
        QCOMPARE(protocol.minutesPerParticipant(), 52.5);
        QCOMPARE(protocol.sittingsPerParticipant(), 1);
    }

    void otherKindsOfQuestionsAreRead()
    {
        const Protocol protocol = protocolFromJson(
            smallProtocol(
                R"("phases": [{"questions": ["Q1"], "alternatives": 3}, {"questions": ["Q2"], "scale": {"min": 0, "max": 10}}])",
                R"("question_texts": {"S1": "Same?", "L1": "Do you agree?", "N1": "Why?"},
 "phases": [{"questions": ["S1", "N1"], "same_different": true, "free_text": ["N1"], "catch_trials": 2},
            {"questions": ["L1"], "scale": {"min": 1, "max": 3, "step": 1, "sections": 2, "labels": ["no", "so so", "yes"]}}],
 "swatches": "fresh", "second_entry": true, "familiarisation_fabrics": 2, "break_after_minutes": 15,
 "dead_time_seconds": 1.5, "confirm_pieces": true, "language": "ja",
 "participant_texts": {"break_title": "休憩", "break_clock": "{time} 経過"},
 "readings": ["temperature in °C"])")
                .toStdString(),
            "study.json");
        const Phase& first = protocol.phases[0];
        QVERIFY(first.task == AnswerKind(SameDifferent{}));
        QCOMPARE(first.catchTrials, 2);
        QVERIFY(first.questions[0].kind == AnswerKind(SameDifferent{}));
        QVERIFY(first.questions[1].kind == AnswerKind(FreeText{}));
        QCOMPARE(std::get<Rating>(protocol.phases[1].questions[0].kind).scale.labels.size(), 3u);
        QCOMPARE(protocol.presentations(), 6 + 2 + 6);
        QCOMPARE(protocol.answersPerParticipant(), 2 * 8 + 6);
        QCOMPARE(protocol.swatchCodes, SwatchCodes::PerParticipant);
        QCOMPARE(protocol.breakAfterMinutes, std::optional<int>(15));
        QVERIFY(protocol.secondEntry);
        QCOMPARE(protocol.deadTimeSeconds, 1.5);
        QVERIFY(protocol.confirmPieces);
        QVERIFY(isPromptKey(protocol, "question_S1") && isPromptKey(protocol, "number_10") && isPromptKey(protocol, "answer_C"));
        for (const char* key : {"question_Q1", "number_05", "number_1000", "number_", "answer_AB", "answer_c", "_", "wait_"})
            QVERIFY2(!isPromptKey(protocol, key), key);
        QCOMPARE(protocol.language, std::string("ja"));
        QCOMPARE(participantText(protocol, "break_title"), std::string("休憩"));
        QCOMPARE(participantText(protocol, "agree"), std::string("I agree"));
        QCOMPARE(paper().phases[0].trayAim, TrayAim::EvenSlots);
        const auto fewSwaps = smallProtocol("\"alternatives\": 3", "\"alternatives\": 3, \"few_swaps\": true").toStdString();
        QCOMPARE(protocolFromJson(fewSwaps, "study.json").phases[0].trayAim, TrayAim::FewSwaps);
        QCOMPARE(paper().deadTimeSeconds, 0.7);
    }

    void onlyWordsTimesAndAnalysisMayChangeInMidStudy()
    {
        const Protocol kept = paper();
        Protocol changed = kept;
        changed.breakAfterPresentations = 10;
        changed.phases[0].questions[0].text = "Which one?";
        changed.equivalenceBounds = {-1, 1};
        changed.checklist.clear();
        QVERIFY(fixedPartsChanged(kept, changed).empty());
        std::get<Rating>(changed.phases[1].task).scale.max = Tenths{70};
        changed.conditions.pop_back();
        QCOMPARE(fixedPartsChanged(kept, changed), (std::vector<std::string>{"conditions", "phases"}));
    }

    void paperAsksItsQuestions()
    {
        const Protocol protocol = paper();
        QCOMPARE(protocol.phases.size(), std::size_t{2});
        QVERIFY(protocol.phases[0].questions[0].kind == AnswerKind(ForcedChoice{3}));
        QCOMPARE(protocol.phases[1].questions.size(), std::size_t{3});
        QVERIFY(protocol.phases[1].questions[0].text.find("slipperiness") != std::string::npos);
        for (const Question& question : protocol.phases[1].questions) QVERIFY(question.kind == AnswerKind(Rating{}));
        QVERIFY(RatingScale{}.holds(Tenths{54}));
        QVERIFY(!RatingScale{}.holds(Tenths{101}));
        QCOMPARE(protocol.equivalenceBounds, (std::pair<double, double>{-0.5, 0.5}));
        QCOMPARE(protocol.planned.front(), (PlannedContrast{ConditionId("h_g&f_g"), ConditionId("h&f")}));
    }

    void primaryContrastComesFirst()
    {
        Protocol protocol = paper();
        QCOMPARE(protocol.primary, std::optional(protocol.planned[0]));
        protocol.primary = protocol.planned[3];
        const std::vector<PlannedContrast> contrasts = contrastsInOrder(protocol);
        QCOMPARE(contrasts.size(), protocol.planned.size());
        QVERIFY(contrasts[0] == protocol.planned[3] && contrasts[1] == protocol.planned[0] &&
                contrasts[4] == protocol.planned[4]);
        protocol.primary.reset();
        QVERIFY(contrastsInOrder(protocol) == protocol.planned);
    }

    void shippedFileIsTheOneInTheProgram()
    {
        const std::filesystem::path file = std::filesystem::path(VIS2HAP_SOURCE_DIR) / "protocols/vis2hap.json";
        std::ifstream stream(file, std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(stream), {}};
        QVERIFY(!text.empty());
        QCOMPARE(text, std::string(paperProtocolJson()));
        QCOMPARE(readProtocol(file), paper());
    }

    void shippedProtocolComparesQualities()
    {
        const Protocol protocol = readProtocol(std::filesystem::path(VIS2HAP_SOURCE_DIR) / "protocols/examples/quality.json");
        QVERIFY(std::ranges::count(protocol.conditions, ConditionId("h_g@fast")) == 1);
        QCOMPARE(protocol.primary, std::optional(PlannedContrast{ConditionId("h_g@fast"), ConditionId("h_g@accurate")}));
    }

    void smallProtocolTakesDefaults()
    {
        const Protocol protocol = protocolFromJson(smallProtocol().toStdString(), "small.json");
        QCOMPARE(protocol.conditions[1], ConditionId("h_g&f_g"));
        QCOMPARE(std::get<Rating>(protocol.phases[1].task).scale.step, Tenths{1});
        QCOMPARE(protocol.equivalenceBounds, (std::pair<double, double>{-0.5, 0.5}));
        QVERIFY(!protocol.phases[0].questions[0].text.empty());
        QVERIFY(protocol.planned.empty());
    }

    /// Half a point would be half of a scale from 0 to 1, and nothing of one from 0 to 100.
    void boundsThatNobodyStatesAreATwentiethOfTheShortestScale()
    {
        const auto read = [](const QString& part, const QString& by) {
            return protocolFromJson(smallProtocol(part, by).toStdString(), "small.json");
        };
        const Protocol usual = read({}, {}), stated = read("\"name\"", "\"equivalence_bounds\": [-0.5, 0.5], \"name\"");
        QVERIFY(usual.hasUsualBounds && !stated.hasUsualBounds && !paper().hasUsualBounds);
        QCOMPARE(usual.equivalenceBounds, stated.equivalenceBounds);
        QCOMPARE(read("\"max\": 10", "\"max\": 1").equivalenceBounds, std::pair(-0.05, 0.05));
        QCOMPARE(read("\"max\": 10", "\"max\": 100").equivalenceBounds, std::pair(-5.0, 5.0));
        QCOMPARE(read(R"({"questions": ["Q2"], "scale": {"min": 0, "max": 10}})",
                      R"({"questions": ["Q2"], "scale": {"min": 0, "max": 10}},
                         {"questions": ["Q3"], "scale": {"min": 1, "max": 5, "step": 1}})")
                     .equivalenceBounds,
                 std::pair(-0.2, 0.2));
        QCOMPARE(read(R"(, {"questions": ["Q2"], "scale": {"min": 0, "max": 10}})", "").equivalenceBounds, std::pair(-0.5, 0.5));
        const auto kept = keptProtocolFromJson(smallProtocol("\"max\": 10", "\"max\": 1").toStdString(), "kept", "0.5.0");
        QVERIFY(kept.hasUsualBounds && kept.equivalenceBounds == std::pair(-0.05, 0.05));
    }

    void fabricsMayBeNamed()
    {
        const QString json = smallProtocol("\"fabrics\": 3", "\"fabrics\": [\"F02\", \"F05\", \"F07\"]");
        const Protocol protocol = protocolFromJson(json.toStdString(), "small.json");
        QCOMPARE(protocol.fabricCount, 3);
        QCOMPARE(protocol.fabrics[1], FabricId("F05"));
    }

    void everyFaultIsNamedAtItsPlace_data()
    {
        QTest::addColumn<QString>("part");
        QTest::addColumn<QString>("by");
        QTest::addColumn<QString>("named");
        const auto row = [](const char* name, const char* part, const char* by, const char* named) {
            QTest::newRow(name) << QString(part) << QString(by) << QString(named);
        };
        row("other schema", "protocol/1", "protocol/9", "schema: \"vis2hap.protocol/9\", expected \"vis2hap.protocol/1\"");
        row("missing name", "\"name\": \"small\", ", "", "'name' is missing");
        row("misspelt key", "\"name\"", "\"planed\": [], \"name\"", "unknown key 'planed'");
        row("no participant", "\"participants\": 2", "\"participants\": 0", "participants: 0");
        row("half a participant", "\"participants\": 2", "\"participants\": 2.5", "participants: 2.5, expected a whole number");
        row("text for a number", "\"participants\": 2", "\"participants\": \"2\"", "participants: \"2\"");
        row("huge number", "\"participants\": 2", "\"participants\": 99999999999999999999", "participants");
        row("unknown condition", "v_grey", "v_gray",
            "conditions[0]: unknown condition 'v_gray', expected one of v_grey, v_shape");
        row("unknown quality", "v_grey", "h_g@slow",
            "conditions[0]: unknown quality 'slow' in 'h_g@slow', expected fast, balanced or accurate after the @");
        row("quality without a choice", "v_grey", "v_grey@fast",
            "conditions[0]: 'v_grey@fast' has a quality, which changes nothing of v_grey, expected 'v_grey'");
        row("own condition without images", "\"v_grey\"", "{\"id\": \"mine\"}",
            "conditions[0]: has neither of 'images' and 'program', expected one of them");
        row("own condition of both kinds", "\"v_grey\"", "{\"id\": \"mine\", \"images\": \"a\", \"program\": true}",
            "conditions[0]: has both of 'images' and 'program', expected one of them");
        row("command in the protocol", "\"v_grey\"", "{\"id\": \"mine\", \"program\": \"rm *\"}",
            "conditions[0].program: \"rm *\", expected true, because the lab names the program");
        row("program of the program's condition", "\"v_grey\"", "{\"id\": \"h\", \"program\": true}",
            "conditions[0].id: 'h' is a condition of the program");
        row("doubled condition", "v_grey", "h_g&f_g", "conditions[1]: 'h_g&f_g' is named twice");
        row("too many alternatives", "\"alternatives\": 3", "\"alternatives\": 4", "phases[0].alternatives: 4 of 3 fabrics");
        row("swaps of one piece", "\"max\": 10}", "\"max\": 10}, \"few_swaps\": true",
            "phases[1].few_swaps: the tray has one piece, expected a phase with alternatives");
        row("no answers", ", \"alternatives\": 3", "", "phases[0]: has none of alternatives, scale and same_different");
        row("two kinds of answers", "\"alternatives\": 3", "\"alternatives\": 3, \"scale\": {\"min\": 0, \"max\": 1}",
            "phases[0]: has more than one of");
        row("question asked twice", "\"Q2\"", "\"Q1\"", "phases[1].questions[0]: 'Q1' is asked twice");
        row("question without words", "\"Q2\"", "\"Q9\"", "'Q9' has no text");
        row("unknown text for the participant", "\"name\"", "\"participant_texts\": {\"hello\": \"Hi\"}, \"name\"",
            "participant_texts: 'hello' is no text of the participant's page");
        row("text without its value", "\"name\"", "\"participant_texts\": {\"scale_tap\": \"Tap.\"}, \"name\"",
            "participant_texts.scale_tap: has no braces, expected {number}");
        row("unknown prompt", "\"name\"", "\"prompts\": {\"hello\": \"a.wav\"}, \"name\"", "prompts: 'hello' is no prompt");
        row("prompt of an unknown question", "\"name\"", "\"prompts\": {\"question_Q7\": \"a.wav\"}, \"name\"",
            "prompts: 'question_Q7' is no prompt");
        row("recording elsewhere", "\"name\"", "\"prompts\": {\"wait\": \"../a.wav\"}, \"name\"", "prompts.wait: \"../a.wav\"");
        row("no language", "\"name\"", "\"language\": \"Deutsch!\", \"name\"", "language: \"Deutsch!\", expected a language tag");
        row("words without question", "\"name\"", "\"question_texts\": {\"Q7\": \"Is it warm?\"}, \"name\"",
            "'Q7' is asked in no phase");
        row("scale upside down", "\"max\": 10", "\"max\": -1", "phases[1].scale: max is not above min");
        row("scale between tenths", "\"max\": 10", "\"max\": 10.05",
            "phases[1].scale.max: 10.05, expected a whole number of tenths");
        row("step that misses max", "\"max\": 10", "\"max\": 10, \"step\": 0.3", "phases[1].scale.step");
        row("bounds upside down", "\"name\"", "\"equivalence_bounds\": [1, -1], \"name\"", "equivalence_bounds");
        row("one bound", "\"name\"", "\"equivalence_bounds\": [1], \"name\"", "equivalence_bounds: a list of 1");
        row("contrast outside", "\"name\"", "\"planned\": [[\"h\", \"v_grey\"]], \"name\"",
            "planned[0]: 'h' is not among the conditions");
        row("contrast with itself", "\"name\"", "\"planned\": [[\"v_grey\", \"v_grey\"]], \"name\"", "with itself");
        row("primary that is not planned", "\"name\"", "\"primary\": [\"h&f\", \"v_grey\"], \"name\"",
            "primary: 'h&f' and 'v_grey' are not a planned contrast in this order");
        row("fabric twice", "\"fabrics\": 3", "\"fabrics\": [\"A\", \"B\", \"A\"]", "fabrics");
        row("cut off", "\"scale\": {\"min\": 0, \"max\": 10}}]}", "", "line 3");
        row("key twice", "\"name\"", "\"participants\": 4, \"name\"", "doubled key 'participants'");
        row("not an object", "{\"schema\"", "[{\"schema\"", "study.json");
    }

    void everyFaultIsNamedAtItsPlace()
    {
        QFETCH(const QString, part);
        QFETCH(const QString, by);
        QFETCH(const QString, named);
        const QString refusal = refusalOf(smallProtocol(part, by));
        QVERIFY2(refusal.startsWith("study.json"), qPrintable(refusal));
        QVERIFY2(refusal.contains(named), qPrintable(refusal));
        QVERIFY2(!refusal.contains('\n') && !refusal.contains("Failed to"), qPrintable(refusal));
    }

    void severalFaultsAreListedAtOnce()
    {
        QString json = smallProtocol("\"participants\": 2", "\"participants\": -1");
        json.replace("\"max\": 10", "\"max\": \"ten\"").replace("\"alternatives\": 3", "\"alternatives\": 1");
        const QString refusal = refusalOf(json);
        QVERIFY2(refusal.contains("3 faults"), qPrintable(refusal));
        for (const char* place : {"participants: -1", "phases[0].alternatives: 1", "phases[1].scale.max: \"ten\""})
            QVERIFY2(refusal.contains(place), qPrintable(refusal));
    }

    void faultsNameTheirLineAndColumn()
    {
        const QString json =
            "{\"schema\": \"vis2hap.protocol/1\", \"name\": \"Größe\", \"participants\": 0,\n"
            " \"fabrics\": 3, \"velvet\": 1,\n"
            " \"conditions\": [\"f\",\n"
            "                \"f\"],\n"
            " \"phases\": [{\"questions\": [\"Q1\"], \"alternatives\": 9}]}";
        const QString refusal = refusalOf(json);
        for (const char* place :
             {"line 1, column 67, participants: 0", "line 2, column 26, the protocol: unknown key 'velvet'",
              "line 4, column 17, conditions[1]: 'f' is named twice", "line 5, column 51, phases[0].alternatives: 9 of 3"})
            QVERIFY2(refusal.contains(place), qPrintable(refusal));
    }

    void severalBrokenRulesAreListedAtOnce()
    {
        QString json = smallProtocol("v_grey", "velvet");
        json.replace("\"alternatives\": 3", "\"alternatives\": 5").replace("\"Q2\"", "\"Q1\"");
        const QString refusal = refusalOf(json);
        for (const char* named : {"velvet", "5 of 3 fabrics", "asked twice"})
            QVERIFY2(refusal.contains(named), qPrintable(refusal));
    }

    void bytesOutsideUtf8AreRefused()
    {
        std::string json = smallProtocol().toStdString();
        json.replace(json.find("small"), 1, "\xff");
        try {
            protocolFromJson(json, "study.json");
            QFAIL("a name that is not UTF-8 was accepted");
        } catch (const Error& error) {
            QVERIFY2(QString(error.what()).contains("study.json, line 1, column 43: the text is not UTF-8"), error.what());
        }
        QVERIFY(refusalOf(smallProtocol("small", "Prüfung 織物")).isEmpty());
    }

    void unreadableFileIsNamed()
    {
        const QTemporaryDir folder;
        for (const QString& path : {folder.filePath("none.json"), folder.path()}) {
            try {
                readProtocol(path.toStdString());
                QFAIL("a path without a protocol file was read");
            } catch (const Error& error) {
                QCOMPARE(error.exitCode(), ExitCode::BadInput);
                QVERIFY2(QString(error.what()).startsWith(path), error.what());
            }
        }
    }
};

QTEST_GUILESS_MAIN(ProtocolTest)
#include "protocol_test.moc"
