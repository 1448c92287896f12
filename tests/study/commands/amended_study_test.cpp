// A protocol that is amended between two participants: what is printed, listed and played afterwards follows the new version.
#include <QDir>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <nlohmann/json.hpp>

#include "tests/support/played_session.h"
#include "tests/support/program.h"
#include "tests/support/study_builder.h"

using nlohmann::json;
using support::mustRun;
using support::runProgram;

namespace {

const std::string firstProtocol = R"({
  "schema": "vis2hap.protocol/1", "name": "Amended study", "participants": 2, "fabrics": ["F01", "F02", "F03"],
  "conditions": ["f", "h&f"],
  "phases": [{"questions": ["Q1"], "alternatives": 3, "instructions": [
               {"id": "slow", "aim": "accuracy"}, {"id": "quick", "aim": "speed", "text": "First words"}]}],
  "consent": "First consent", "facts": ["age"], "seconds_per_presentation": 10, "confirm_pieces": false
})";

QString bytesOf(const QString& file)
{
    QFile opened(file);
    return opened.open(QIODevice::ReadOnly) ? QString::fromUtf8(opened.readAll()) : QString();
}

void write(const QString& file, const std::string& text)
{
    QFile opened(file);
    QVERIFY(opened.open(QIODevice::WriteOnly) && opened.write(text.data(), qint64(text.size())) == qint64(text.size()));
}

std::string wholeScript(const char* participant)
{
    json answers = json::array();
    for (const char* instruction : {"slow", "quick"})
        for (const char* condition : {"f", "h&f"})
            for (const char* fabric : {"F01", "F02", "F03"})
                answers.push_back({{"question", "Q1"},
                                   {"condition", condition},
                                   {"fabric", fabric},
                                   {"instruction", instruction},
                                   {"answer", "correct"},
                                   {"seconds", 3}});
    return json{{"schema", "vis2hap.script/1"}, {"participant", participant}, {"answers", answers}}.dump();
}

}  // namespace

class AmendedStudyTest : public QObject {
    Q_OBJECT
    QTemporaryDir m_place;

    QString at(const QString& name) const { return m_place.filePath(name); }
    QString study() const { return at("study"); }
    json status() const { return json::parse(mustRun({"study", "status", study(), "--json"}).out.toStdString()); }

private Q_SLOTS:
    void initTestCase()
    {
        tests::support::buildStudy(study().toStdString(), {.protocol = firstProtocol});
        {
            tests::support::OpenSession session({study().toStdString()}, "P01");
            session.playUntilAnswers(1);
        }
        m_minutesBefore = status()["minutes_per_participant"].get<double>();
        json amended = json::parse(firstProtocol);
        amended["consent"] = "Later consent";
        amended["facts"] = {"handedness"};
        amended["seconds_per_presentation"] = 40;
        amended["confirm_pieces"] = true;
        amended["phases"][0]["instructions"][1]["text"] = "Later words";
        write(study() + "/protocol.json", amended.dump(1));
        mustRun({"study", "amend", study(), "--who", "M", "--why", "pilot"});
    }

    void sheetsHoldTheNewWords()
    {
        mustRun({"study", "sheets", study(), "--out", at("sheets")});
        const QString instructions = bytesOf(at("sheets/instructions.html"));
        QVERIFY(instructions.contains("Later words") && !instructions.contains("First words"));
    }

    void statusAndPlanHaveTheNewTimes()
    {
        QCOMPARE(status()["minutes_per_participant"].get<double>(), 4 * m_minutesBefore);
        mustRun({"study", "plan", study(), "--csv", at("plan.csv")});
        QVERIFY(bytesOf(at("plan.csv")).split('\n')[3].contains(",1.3333333333333333,"));  // 2 presentations of 40 s before it
    }

    void theDataSheetHasBothConsents()
    {
        const QString text = mustRun({"study", "data-sheet", study()}).out;
        QVERIFY2(text.contains("Later consent") && text.contains("First consent") && text.contains("age, handedness"),
                 qPrintable(text));
        QVERIFY(text.indexOf("Later consent") < text.indexOf("First consent"));
        const json sheet = json::parse(mustRun({"study", "data-sheet", study(), "--json"}).out.toStdString());
        QCOMPARE(sheet["consent"].get<std::string>(), std::string("Later consent"));
        QCOMPARE(sheet["consents_before"], json({{{"version", 1}, {"text", "First consent"}}}));
    }

    void aScriptPlaysByTheVersionOfItsParticipant()
    {
        write(at("P02.json"), wholeScript("P02"));
        const json places = status()["slots"];
        QVERIFY(QFile::rename(study() + "/station-key.json", at("key")));
        const auto refused = runProgram({"replay", study(), at("P02.json")}),
                   shown = runProgram({"replay", study(), at("P02.json"), "--gui"});
        QVERIFY2(refused.exitCode != 0 && refused.err.contains("station-key.json"), qPrintable(refused.err));
        QVERIFY2(shown.exitCode != 0 && shown.err.contains("station-key.json"), qPrintable(shown.err));
        QVERIFY(QFile::rename(at("key"), study() + "/station-key.json"));
        QCOMPARE(status()["slots"], places);  // a refused script takes no place
        const auto ended = runProgram({"replay", study(), at("P02.json")});
        QVERIFY2(ended.exitCode == 0 && ended.out.contains("12 answers stored, finished"), qPrintable(ended.err + ended.out));
        QVERIFY(mustRun({"verify", study()}).out.contains("sound"));
    }

    /// The headphones would go on with the old words, and the report would list the new ones.
    void aNewTextWithAnOldRecordingIsNoted()
    {
        json protocol = json::parse(firstProtocol);
        protocol["question_texts"] = {{"Q1", "Which one is it?"}};
        protocol["participant_texts"] = {{"wait_title", "Please wait"}};
        protocol["prompts"] = {{"question_Q1", "which.wav"}, {"wait", "wait.wav"}, {"number_5", "five.wav"}};
        tests::support::buildStudy(at("recorded").toStdString(), {.protocol = protocol.dump()});
        const auto notesAfter = [&](const json& amended) {
            write(at("recorded/protocol.json"), amended.dump());
            QStringList notes;
            for (const QString& line :
                 mustRun({"study", "amend", at("recorded"), "--who", "M", "--why", "pilot"}).out.split('\n'))
                if (line.startsWith("note: ")) notes << line;
            return notes;
        };
        protocol["consent"] = "Later consent";
        QCOMPARE(notesAfter(protocol), QStringList());
        protocol["question_texts"]["Q1"] = "Which piece is it?";
        QStringList notes = notesAfter(protocol);
        QVERIFY2(notes.size() == 1 && notes[0].startsWith("note: the text of Q1 changes, but not its recording which.wav"),
                 qPrintable(notes.join('\n')));
        protocol["participant_texts"]["wait_title"] = "Please wait a moment";
        notes = notesAfter(protocol);
        QVERIFY2(notes.size() == 1 && notes[0].contains("the prompt wait changes, but not its recording wait.wav"),
                 qPrintable(notes.join('\n')));
        protocol["language"] = "de";
        protocol["question_texts"]["Q1"] = "Welches Stück ist es?";
        notes = notesAfter(protocol);
        QVERIFY2(notes.size() == 2 &&
                     notes[0].contains("from en to de, but not that of the recordings five.wav, which.wav, wait.wav") &&
                     notes[1].contains("the text of Q1 changes"),
                 qPrintable(notes.join('\n')));
    }

private:
    double m_minutesBefore = 0;
};

QTEST_GUILESS_MAIN(AmendedStudyTest)
#include "amended_study_test.moc"
