// Protocols that could break a study later: each is refused with its faults, or read completely. All faults of a file are in one
// list.
#include <QElapsedTimer>
#include <QRegularExpression>
#include <QTest>
#include <algorithm>

#include "protocols/files/errors.h"
#include "protocols/new_texts.h"
#include "protocols/orders/counterbalancing.h"
#include "protocols/protocol_json.h"
#include "protocols/question_ids.h"
#include "protocols/texts/protocol_edition.h"

using namespace protocols;

namespace {

/// A protocol with these phases and a text for each of these questions.
std::string protocolWith(const QString& phases, const QStringList& questions)
{
    QStringList texts;
    for (const QString& question : questions) texts << QString(R"("%1": "What about %1?")").arg(question);
    return QString(R"({"schema": "vis2hap.protocol/1", "name": "hostile", "participants": 2, "fabrics": 3,
 "conditions": ["v_grey", "h"], "phases": [%1], "question_texts": {%2}})")
        .arg(phases, texts.join(", "))
        .toStdString();
}

QString quoted(const QStringList& ids) { return "\"" + ids.join("\", \"") + "\""; }

/// One phase of ratings with these questions.
std::string ratingsOf(const QStringList& ids)
{
    return protocolWith(QString(R"({"questions": [%1], "scale": {"min": 0, "max": 10}})").arg(quoted(ids)), ids);
}

/// Without its line and column, which every fault has.
QString withoutPlace(QString fault)
{
    static const QRegularExpression place("^line \\d+, column \\d+, ");
    return place.match(fault).hasMatch() ? fault.remove(place) : "without a place: " + fault;
}

/// The faults of a text, in order; empty if it is accepted.
QStringList faultsIn(const std::string& json)
{
    try {
        protocolFromJson(json, "study.json");
    } catch (const Error& error) {
        const QString line = error.what();
        const QString begin = "malformed protocol, ";
        const qsizetype list = line.indexOf(": ", line.indexOf(begin) + begin.size()) + 2;
        QStringList faults = line.mid(list, line.indexOf("; see protocols/") - list).split("; ");
        std::transform(faults.begin(), faults.end(), faults.begin(), withoutPlace);
        return faults;
    }
    return {};
}

}  // namespace

class HostileProtocolTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void whatIsNoObjectIsNamed()
    {
        QCOMPARE(faultsIn("[1, 2]"), QStringList{"the protocol: a list of 2, expected an object with the fields of a protocol"});
        QCOMPARE(faultsIn("7"), QStringList{"the protocol: 7, expected an object with the fields of a protocol"});
    }

    void anIdThatWouldBreakATableIsRefusedByName_data()
    {
        QTest::addColumn<QStringList>("ids");
        QTest::addColumn<QStringList>("faults");
        const QString shape = ", expected a question id: a letter, then letters, digits and underscores, at most 40 characters";
        QTest::newRow("a slash") << QStringList{"soft/hard"} << QStringList{"phases[0].questions[0]: \"soft/hard\"" + shape};
        QTest::newRow("a hyphen") << QStringList{"Q-1"} << QStringList{"phases[0].questions[0]: \"Q-1\"" + shape};
        QTest::newRow("a digit first") << QStringList{"1st"} << QStringList{"phases[0].questions[0]: \"1st\"" + shape};
        QTest::newRow("a letter of another alphabet")
            << QStringList{"Q1", "fühlt"} << QStringList{"phases[0].questions[1]: \"fühlt\"" + shape};
        QTest::newRow("41 characters") << QStringList{QString(41, 'Q')}
                                       << QStringList{"phases[0].questions[0]: \"" + QString(41, 'Q') + "\"" + shape};
        QTest::newRow("case alone differs")
            << QStringList{"Real", "real"}
            << QStringList{"phases[0].questions[1]: 'real' differs from 'Real' in case only, expected different ids"};
        QTest::newRow("a column of another question")
            << QStringList{"Q1", "Q1_seconds"}
            << QStringList{
                   "phases[0].questions[1]: 'Q1_seconds' and 'Q1' would both have a column 'Q1_seconds' in exported "
                   "answers, expected another id"};
        QTest::newRow("another question has its column")
            << QStringList{"q1_Correct", "Q1"}
            << QStringList{
                   "phases[0].questions[1]: 'Q1' and 'q1_Correct' would both have a column 'Q1_correct' in exported "
                   "answers, expected another id"};
        QTest::newRow("a fixed column")
            << QStringList{"Condition"}
            << QStringList{"phases[0].questions[0]: 'Condition' is a column of exported answers, expected another id"};
        QTest::newRow("twice the same") << QStringList{"Q1", "Q1"}
                                        << QStringList{
                                               "phases[0].questions[1]: 'Q1' is asked twice, expected each question once"};
    }

    void anIdThatWouldBreakATableIsRefusedByName()
    {
        QFETCH(const QStringList, ids);
        QFETCH(const QStringList, faults);
        QStringList different = ids;
        different.removeDuplicates();
        std::string json = ratingsOf(ids);
        if (different != ids) json = protocolWith(R"({"questions": ["Q1", "Q1"], "scale": {"min": 0, "max": 10}})", different);
        QCOMPARE(faultsIn(json), faults);
    }

    void wordsOfTheReportMayBeIds_data()
    {
        QTest::addColumn<QStringList>("ids");
        QTest::newRow("quality") << QStringList{"quality"};
        QTest::newRow("conditions") << QStringList{"conditions"};
        QTest::newRow("40 characters") << QStringList{QString(40, 'q')};
        QTest::newRow("one letter and digits") << QStringList{"Q", "Q_1", "Q01"};
    }

    void wordsOfTheReportMayBeIds()
    {
        QFETCH(const QStringList, ids);
        QCOMPARE(faultsIn(ratingsOf(ids)), QStringList());
        const Protocol protocol = protocolFromJson(ratingsOf(ids), "study.json");
        QCOMPARE(protocol.phases[0].questions.size(), static_cast<std::size_t>(ids.size()));
        for (int i = 0; i < ids.size(); ++i)
            QCOMPARE(protocol.phases[0].questions[static_cast<std::size_t>(i)].id.value, ids[i].toStdString());
    }

    void onePhaseMayAskTwentySixQuestions()
    {
        QStringList ids;
        for (int number = 1; number <= 26; ++number) ids << "R" + QString::number(number);
        const Protocol protocol = protocolFromJson(ratingsOf(ids), "study.json");
        QCOMPARE(protocol.phases[0].questions.size(), std::size_t{26});
        QCOMPARE(protocol.answersPerParticipant(), 6 * 26);
    }

    void aStudyMayAskInWordsAlone()
    {
        const Protocol protocol = protocolFromJson(
            protocolWith(R"({"questions": ["W1", "W2"], "free_text": ["W2", "W1"], "scale": {"min": 0, "max": 10}})",
                         {"W1", "W2"}),
            "study.json");
        for (const Question& question : protocol.phases[0].questions) QVERIFY(question.kind == AnswerKind(FreeText{}));
        const Design design = drawDesign(protocol, 1);
        for (const DesignTrial& trial : design.participants[0]) QCOMPARE(trial.alternatives, std::vector<int>{trial.fabric});
        QCOMPARE(faultsIn(protocolWith(R"({"questions": ["W1"], "free_text": ["W1"], "alternatives": 3})", {"W1"})),
                 QStringList{"phases[0].questions: 0 questions with a right answer, expected one (and any number in free_text)"});
    }

    void aStudyMayAskOnlyForSameOrDifferent()
    {
        const Protocol protocol =
            protocolFromJson(protocolWith(R"({"questions": ["S1"], "same_different": true})", {"S1"}), "study.json");
        QVERIFY(protocol.phases[0].questions[0].kind == AnswerKind(SameDifferent{}));
        QCOMPARE(faultsIn(protocolWith(R"({"questions": ["S1", "S2"], "same_different": true})", {"S1", "S2"})),
                 QStringList{"phases[0].questions: 2 questions with a right answer, expected one (and any number in free_text)"});
    }

    void faultsOfEveryStageStandInOneList()
    {
        const QStringList found = faultsIn(R"({"schema": "vis2hap.protocol/1", "participants": 0, "fabrics": 3, "planed": [],
 "conditions": ["v_grey", "velvet"], "equivalence_bounds": [1, -1],
 "phases": [{"questions": ["Q1"], "alternatives": 4}, {"questions": ["q1", "soft/hard"], "scale": {"min": 0, "max": "ten"}},
            {"questions": ["Q9"]}],
 "question_texts": {"Q7": "Is it warm?", "q1": "Is it soft?", "soft/hard": "Is it hard?"}})");
        const QStringList expected{
            "the protocol: unknown key 'planed'",
            "the protocol: 'name' is missing",
            "participants: 0, expected a whole number from 1 to 1000",
            "phases[1].questions[1]: \"soft/hard\", expected a question id: a letter, then letters, digits and underscores, at "
            "most "
            "40 characters",
            "phases[1].scale.max: \"ten\", expected a number in tenths",
            "phases[2]: has none of alternatives, scale and same_different, expected one of them",
            "question_texts: 'Q7' is asked in no phase, expected ids of the phases' questions",
            "conditions[1]: unknown condition 'velvet', expected one of v_grey, v_shape, f_g, h_g, h_g&f_g, t_grey, f, h, h&f, "
            "gradient",
            "phases[0].alternatives: 4 of 3 fabrics, expected no more alternatives than fabrics",
            "phases[2].questions[0]: 'Q9' has no text, expected one in question_texts",
            "equivalence_bounds: the lower is not below the upper, expected [lower, upper]",
            "phases[1].questions[0]: 'q1' differs from 'Q1' in case only, expected different ids"};
        for (const QString& fault : expected) QVERIFY2(found.contains(fault), qPrintable(fault + "\n" + found.join("\n")));
        QCOMPARE(found.size(), expected.size());
    }

    /// An unreadable value causes no faults of other rules: the file has no further faults.
    void anUnreadableValueHasNoConsequences_data()
    {
        QTest::addColumn<QString>("json");
        QTest::addColumn<int>("faults");
        const QString phases = R"("phases": [{"questions": ["Q1"], "alternatives": 9, "catch_trials": 30}])";
        const auto with = [&](const QString& fabrics, const QString& conditions, const QString& rest) {
            return QString(
                       R"({"schema": "vis2hap.protocol/1", "name": "a", "participants": 2, "fabrics": %1, "conditions": %2, %3})")
                .arg(fabrics, conditions, rest);
        };
        QTest::newRow("sound") << with("9", "[\"h\", \"f\", \"v_grey\", \"h&f\"]", phases) << 0;
        QTest::newRow("fabrics") << with("\"seven\"", "[\"h\", \"f\", \"v_grey\", \"h&f\"]", phases) << 1;
        QTest::newRow("conditions") << with("9", "7", R"("planned": [["h", "f"]], )" + phases) << 1;
        QTest::newRow("one condition") << with("9", "[\"h\", 5, \"f\"]", R"("planned": [["h", "f"]], "phases": [])") << 2;
        QTest::newRow("phases") << with("9", "[\"h\"]", R"("phases": {}, "question_texts": {"Q1": "Which?"})") << 1;
        QTest::newRow("a phase") << with("9", "[\"h\"]", R"("phases": ["Q1"], "question_texts": {"Q1": "Which?"})") << 1;
        QTest::newRow("a question")
            << with("9", "[\"h\"]", R"("phases": [{"questions": [5], "alternatives": 3}], "question_texts": {"Q5": "Which?"})")
            << 1;
        QTest::newRow("a text") << with("9", "[\"h\"]",
                                        R"("phases": [{"questions": ["X1"], "alternatives": 3}], "question_texts": {"X1": ""})")
                                << 1;
        QTest::newRow("alternatives") << with("2", "[\"h\"]", R"("phases": [{"questions": ["Q1"], "alternatives": "two"}])") << 1;
        QTest::newRow("scale") << with("2", "[\"h\"]",
                                       R"("phases": [{"questions": ["Q2"], "scale": {"min": 20, "max": "x", "step": 3}}])")
                               << 1;
        QTest::newRow("same_different") << with("2", "[\"h\"]", R"("phases": [{"questions": ["Q1"], "same_different": "yes"}])")
                                        << 1;
        QTest::newRow("a contrast")
            << with("2", "[\"h\", \"f\"]",
                    R"("planned": [["h"], [5, "f"]], "phases": [{"questions": ["Q1"], "alternatives": 2}])")
            << 2;
        QTest::newRow("bounds") << with("2", "[\"h\"]",
                                        R"("equivalence_bounds": ["a", 1], "phases": [{"questions": ["Q1"], "alternatives": 2}])")
                                << 1;
        QTest::newRow("a huge number") << with("99999999999999999999", "[\"h\"]",
                                               R"("phases": [{"questions": ["Q1"], "alternatives": 2}])")
                                       << 1;
        QTest::newRow("a huge tenth") << with("2", "[\"h\"]",
                                              R"("phases": [{"questions": ["Q2"], "scale": {"min": 0, "max": 1e300}}])")
                                      << 1;
        QTest::newRow("a list") << "[1, 2]" << 1;
    }

    void anUnreadableValueHasNoConsequences()
    {
        QFETCH(const QString, json);
        QFETCH(const int, faults);
        const QStringList found = faultsIn(json.toStdString());
        QVERIFY2(found.size() == faults, qPrintable(found.join("\n")));
    }

    /// Before, 4,000 equal fabrics took more than 12 s and gigabytes, and an id of 400,000 letters ended the program.
    void aSmallFileCannotTakeLong_data()
    {
        QTest::addColumn<QString>("part");
        QTest::addColumn<QString>("first");
        QTest::addColumn<int>("unlisted");
        const auto list = [](const QString& element, int count) { return "[" + QStringList(count, element).join(",") + "]"; };
        const QString notFabrics =
            "fabrics: a list of 2000, expected the number of fabrics to draw, 1 to 100, or a list of different fabric ids";
        QTest::newRow("equal fabrics") << "\"fabrics\": " + list("1", 2000) << notFabrics << 1901;
        QTest::newRow("equal ids") << "\"fabrics\": " + list("\"a\"", 2000) << notFabrics << 0;
        QTest::newRow("too many fabrics") << "\"fabrics\": " + list("1", 4000) << "fabrics: 4000 elements, expected at most 2000"
                                          << 0;
        QTest::newRow("equal readings") << "\"readings\": " + list("\"°C\"", 2)
                                        << "readings: a list of 2, expected a list of different quantities to measure" << 0;
        QTest::newRow("too many pairs") << "\"planned\": " + list(list("1", 1000), 200)
                                        << "the protocol: 200214 values, expected at most 20000" << 0;
        QTest::newRow("a long id") << "\"language\": \"en" + QString("-aaaaaaaa").repeated(50'000) + "\""
                                   << "language: \"en" + QString("-aaaaaaaa").repeated(10) +
                                          "-aaaaaa..., expected a language tag "
                                          "such as \"en\" or \"pt-BR\""
                                   << 0;
        QTest::newRow("equal contrasts") << "\"planned\": " + list("[\"h\",\"h\"]", 2000)
                                         << "planned[0]: compares 'h' with itself, expected two conditions" << 3899;
    }

    void aSmallFileCannotTakeLong()
    {
        QFETCH(const QString, part);
        QFETCH(const QString, first);
        QFETCH(const int, unlisted);
        const QString fabrics = part.startsWith("\"fabrics") ? "" : "\"fabrics\": 3, ";
        const std::string json = ("{" + fabrics + part + R"(, "schema": "vis2hap.protocol/1", "name": "a", "participants": 2,
 "conditions": ["h", "f"], "phases": [{"questions": ["Q1"], "alternatives": 3}]})")
                                     .toStdString();
        QElapsedTimer clock;
        clock.start();
        QStringList found = faultsIn(json);
        const CheckedProtocol checked = checkedProtocol(json, "study.json");
        QVERIFY2(clock.elapsed() < 3000, qPrintable(QString("%1 ms").arg(clock.elapsed())));
        QVERIFY2(found.contains(first), qPrintable(found.join("\n").left(2000)));
        QCOMPARE(checked.faults.size(), static_cast<std::size_t>(unlisted > 0 ? 101 : 1));
        if (unlisted == 0) return;
        QCOMPARE(found.last(), "without a place: and " + QString::number(unlisted) + " more");
        QCOMPARE(QString::fromStdString(checked.faults.back().text),
                 "the protocol: " + QString::number(unlisted) + " more faults are not listed, correct these first");
    }

    void aProtocolHasALargestSize()
    {
        const std::string large = ratingsOf({"Q1"}) + std::string(largestProtocol, ' ');
        QCOMPARE(checkedProtocol(large, "study.json").faults.size(), std::size_t{1});
        QVERIFY_EXCEPTION_THROWN(protocolFromJson(large, "study.json"), Error);
        QVERIFY(faultsIn(large.substr(0, largestProtocol)).empty());
    }

    void anEarlierStudyKeepsItsIdsAndTexts()
    {
        const std::string json = ratingsOf({"soft/hard", "Real", "real", "condition", "fühlt sich echt an"});
        QCOMPARE(faultsIn(json).size(), 4);
        QCOMPARE(keptProtocolFromJson(json, "a study", "0.5.0").phases[0].questions[0].id, QuestionId("soft/hard"));
        QVERIFY_EXCEPTION_THROWN(keptProtocolFromJson(json, "a study", "0.6.0"), Error);
        QVERIFY_EXCEPTION_THROWN(keptProtocolFromJson(ratingsOf({""}), "a study", "0.5.0"), Error);
        const std::string paper = R"({"schema": "vis2hap.protocol/1", "name": "a", "participants": 2, "fabrics": 4,
 "conditions": ["h"], "phases": [{"questions": ["Q1"], "alternatives": 4}]})";
        QCOMPARE(keptProtocolFromJson(paper, "a study", "0.5.0").phases[0].questions[0].text,
                 std::string("Which of the showed fabric pieces does the haptic rendering match with?"));
        QCOMPARE(keptProtocolFromJson(paper, "a study", "0.6.0").phases[0].questions[0].text,
                 std::string("Which of the four pieces of fabric feels like the screen: A, B, C or D?"));
    }

    void theNameOfANewStudyIsOneLine_data()
    {
        QTest::addColumn<QString>("name");
        QTest::addColumn<QString>("fault");
        QTest::newRow("German") << "Größe & Gefühl (Müller, 2026)" << QString();
        QTest::newRow("Chinese") << QString::fromUtf8("触觉研究：第一组") << QString();
        QTest::newRow("Arabic") << QString::fromUtf8("دراسة اللمس ١") << QString();
        QTest::newRow("Hebrew") << QString::fromUtf8("מחקר מישוש") << QString();
        QTest::newRow("Persian, with a joiner") << QString::fromUtf8("می\u200cخواهم") << QString();
        QTest::newRow("1000 bytes") << QString(1000, 'a') << QString();
        QTest::newRow("1001 bytes") << QString(1001, 'a') << "has 1001 bytes";
        QTest::newRow("two lines") << "a\\nLog head: 9:abc"
                                   << "holds a control character";
        QTest::newRow("escape") << "a\\u001b[2Jb"
                                << "holds a control character";
        QTest::newRow("turned") << "a\\u202egnuos"
                                << "holds an invisible character";
        QTest::newRow("blanks") << "  "
                                << "is empty";
    }

    /// The name stands in titles, certificates and on terminals. A study that has another one already can still be read.
    void theNameOfANewStudyIsOneLine()
    {
        QFETCH(const QString, name);
        QFETCH(const QString, fault);
        std::string json = ratingsOf({"Q1"});
        json.replace(json.find("hostile"), 7, name.toStdString());
        const QStringList expected =
            fault.isEmpty()
                ? QStringList()
                : QStringList{"name: " + fault +
                              ", expected one line of 1 to 1000 bytes of UTF-8 without control or invisible characters"};
        QCOMPARE(faultsIn(json), expected);
        QCOMPARE(checkedProtocol(json, "study.json").faults.size(), static_cast<std::size_t>(expected.size()));
        for (const char* version : {"0.5.0", "0.6.0"}) QVERIFY(!keptProtocolFromJson(json, "a study", version).name.empty());
    }

    /// A terminal obeys some characters, and a database drops others. A study that has them can still be read.
    void textsOfANewStudyAreKeptAsTheyAre_data()
    {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("fault");
        QTest::newRow("several lines") << "Rate it.\\n\\tTake your time.\\r\\n" << QString();
        QTest::newRow("Persian, with a joiner") << QString::fromUtf8("می\u200cخواهم") << QString();
        QTest::newRow("escape") << "a\\u001b[2Jb"
                                << "holds the character U+001B";
        QTest::newRow("C1") << "a\\u009bb"
                            << "holds the character U+009B";
        QTest::newRow("NUL") << "a\\u0000b"
                             << "holds the character U+0000";
        QTest::newRow("order mark") << "a\\ufeffb"
                                    << "holds the character U+FEFF";
    }
    void textsOfANewStudyAreKeptAsTheyAre()
    {
        QFETCH(const QString, text);
        QFETCH(const QString, fault);
        std::string json = ratingsOf({"Q1"});
        const std::string usual = "What about Q1?";
        json.replace(json.find(usual), usual.size(), text.toStdString());
        const QStringList expected = fault.isEmpty()
                                         ? QStringList()
                                         : QStringList{"question_texts.Q1: the text " + fault +
                                                       ", expected characters that a reader sees, line ends and tabs"};
        QCOMPARE(faultsIn(json), expected);
        QVERIFY(!keptProtocolFromJson(json, "a study", "1.0.0").name.empty());
        // An amendment follows the rule in the texts that it changes.
        requireGoodNewTexts(json, json, "study.json");
        if (!fault.isEmpty()) QVERIFY_EXCEPTION_THROWN(requireGoodNewTexts(json, ratingsOf({"Q1"}), "study.json"), Error);
    }

    /// The comment took the place of what the participant had given.
    void noFactHasTheNameOfTheCommentAtTheEnd()
    {
        std::string before = ratingsOf({"Q1"});
        before.insert(1, R"("facts": ["age"], )");
        QCOMPARE(faultsIn(before), QStringList());
        std::string json = before;
        json.replace(json.find("\"age\""), 5, R"("age", "debriefing")");
        QCOMPARE(faultsIn(json),
                 QStringList{"facts: the comment at the end is stored under the name \"debriefing\", expected another name"});
        QVERIFY(!keptProtocolFromJson(json, "a study", "1.0.0").name.empty());
        requireGoodNewTexts(json, json, "study.json");
        QVERIFY_EXCEPTION_THROWN(requireGoodNewTexts(json, before, "study.json"), Error);
    }

    /// A server refuses what is given of such a fact.
    void noFactHasANameThatNoServerTakes()
    {
        std::string longest = ratingsOf({"Q1"});
        longest.insert(1, "\"facts\": [\"age\", \"" + std::string(2000, 'x') + "\"], ");
        QCOMPARE(faultsIn(longest), QStringList());
        std::string json = longest;
        json.insert(json.find("xxx"), "x");
        QCOMPARE(faultsIn(json), QStringList{"facts: a name has 2001 bytes, expected at most 2000"});
        QCOMPARE(keptProtocolFromJson(json, "a study", "1.0.0").facts.back().size(), std::size_t{2001});
        requireGoodNewTexts(json, json, "study.json");
        QVERIFY_EXCEPTION_THROWN(requireGoodNewTexts(json, longest, "study.json"), Error);
    }

    void aTextThatNobodyReadsMayHoldAnything()
    {
        std::string json = ratingsOf({"Q1"});
        json.insert(1, R"("comment": "page\u000cbreak", )");
        QCOMPARE(faultsIn(json), QStringList());
    }

    void theEditionFollowsTheVersion_data()
    {
        QTest::addColumn<QString>("version");
        QTest::addColumn<bool>("earlier");
        QTest::newRow("0.4.1") << "0.4.1" << true;
        QTest::newRow("0.5.0") << "0.5.0" << true;
        QTest::newRow("0.6.0") << "0.6.0" << false;
        QTest::newRow("0.10.0") << "0.10.0" << false;
        QTest::newRow("1.2.3") << "1.2.3" << false;
        QTest::newRow("no version") << "test" << false;
    }

    void theEditionFollowsTheVersion()
    {
        QFETCH(const QString, version);
        QFETCH(const bool, earlier);
        QCOMPARE(editionOf(version.toStdString()), earlier ? ProtocolEdition::Before06 : ProtocolEdition::Current);
    }

    void theUsualTextOfQ1NamesThePieces_data()
    {
        QTest::addColumn<int>("pieces");
        QTest::addColumn<QString>("text");
        QTest::newRow("2") << 2 << "Which of the two pieces of fabric feels like the screen: A or B?";
        QTest::newRow("3") << 3 << "Which of the three pieces of fabric feels like the screen: A, B or C?";
        QTest::newRow("6") << 6 << "Which of the six pieces of fabric feels like the screen: A, B, C, D, E or F?";
        QTest::newRow("7") << 7 << "Which of the seven pieces of fabric feels like the screen: A to G?";
        QTest::newRow("13") << 13 << "Which of the 13 pieces of fabric feels like the screen: A to M?";
    }

    void theUsualTextOfQ1NamesThePieces()
    {
        QFETCH(const int, pieces);
        QFETCH(const QString, text);
        const QString json = QString(R"({"schema": "vis2hap.protocol/1", "name": "a", "participants": 2, "fabrics": 20,
 "conditions": ["h"], "phases": [{"questions": ["Q1"], "alternatives": %1}]})")
                                 .arg(pieces);
        QCOMPARE(QString::fromStdString(protocolFromJson(json.toStdString(), "a").phases[0].questions[0].text), text);
    }

    void everyQuestionHasItsColumns()
    {
        QCOMPARE(columnsOf(QuestionId("Q1")), (std::vector<std::string>{"Q1", "Q1_correct", "Q1_answer", "Q1_seconds"}));
    }
};

QTEST_GUILESS_MAIN(HostileProtocolTest)
#include "hostile_protocol_test.moc"
