// The slips of a tired hand, enumerated: every key of a presentation is left out, doubled, swapped with the next one, or replaced
// by its neighbours on the keyboard. Whatever follows, nothing wrong is stored: no presentation on an old or wrong tray, no
// withdrawal, no void, no other participant.
#include <QLineEdit>
#include <QTest>

#include "study/session/session_record.h"
#include "tests/support/typed_answers.h"

using namespace study::session;
using namespace tests::support;

namespace {

constexpr double deadTimeSeconds = 0.7;

/// A key, or a wait in which the operator changes the tray.
struct Stroke {
    char32_t key = 0;  ///< U'\r' is Enter; 0 is the wait
    bool operator==(const Stroke&) const = default;
};
using Strokes = std::vector<Stroke>;

void add(Strokes& strokes, const std::string& text)
{
    for (const char c : text) strokes.push_back({static_cast<char32_t>(c)});
}

/// The keys of one presentation, from its tray to its last answer.
Strokes strokesOf(const View& view, const std::vector<std::string>& answers)
{
    Strokes strokes;
    for (const std::string& piece : view.tray) add(strokes, piece + "\r");
    strokes.push_back({});
    add(strokes, "\r");
    for (const std::string& answer : answers) add(strokes, answer + "\r");
    return strokes;
}

/// Keys beside this one on a keyboard of the United States.
std::u32string neighboursOf(char32_t key)
{
    if (key == U'\r') return U"'\\\b";
    for (const std::u32string row : {U"1234567890", U"QWERTYUIOP", U"ASDFGHJKL", U"ZXCVBNM,."}) {
        const auto at = row.find(key);
        if (at == std::u32string::npos) continue;
        std::u32string beside;
        if (at > 0) beside += row[at - 1];
        if (at + 1 < row.size()) beside += row[at + 1];
        return beside;
    }
    return {};
}

struct Slip {
    QString name;
    Strokes strokes;
};

std::vector<Slip> slipsOf(const Strokes& meant)
{
    std::vector<Slip> slips{{"none", meant}};
    for (std::size_t at = 0; at < meant.size(); ++at) {
        const QString where = QString(" key %1").arg(at + 1);
        Strokes missing = meant, doubled = meant, swapped = meant;
        missing.erase(missing.begin() + static_cast<std::ptrdiff_t>(at));
        doubled.insert(doubled.begin() + static_cast<std::ptrdiff_t>(at), meant[at]);
        slips.push_back({"missing" + where, missing});
        slips.push_back({"doubled" + where, doubled});
        if (at + 1 < meant.size()) {
            std::swap(swapped[at], swapped[at + 1]);
            slips.push_back({"swapped" + where, swapped});
        }
        for (const char32_t beside : neighboursOf(meant[at].key)) {
            Strokes other = meant;
            other[at].key = beside;
            slips.push_back({QString("%1 for").arg(QString::fromUcs4(&beside, 1)) + where, other});
        }
    }
    return slips;
}

void press(OpenWindow& open, const Stroke& stroke)
{
    open.clock().advanceSeconds(stroke.key == 0 ? 2 : 0.05);
    if (stroke.key == U'\r')
        pressKey(open, Qt::Key_Return);
    else if (stroke.key == U'\b')
        pressKey(open, Qt::Key_Backspace);
    else if (stroke.key != 0)
        typeText(open, QString::fromUcs4(&stroke.key, 1));
}

/// What is wrong in the log; empty if every presentation began on its own tray, confirmed piece by piece after the dead time.
std::string faultIn(const database::StudyFolder& folder, int answersBefore, const std::vector<std::string>& meant, bool mayDiffer)
{
    const database::StudyStore store(folder, database::StudyStore::Access::Read);
    if (store.enrolments().size() != 1) return "another participant";
    const protocols::ParticipantId participant = store.enrolments().front().participant;
    const Plan plan = readPlan(store, participant);
    State state;
    for (const auto& record : store.events(participant)) {
        const EventBody body = eventFromRecord(record.kind, record.payloadJson);
        if (std::holds_alternative<WithdrawnEvent>(body)) return "a withdrawal";
        if (std::holds_alternative<Voided>(body)) return "a void";
        if (const auto* ready = std::get_if<TrayReady>(&body)) {
            const auto& tray = plan.trials[static_cast<std::size_t>(std::get<PlacingTray>(state.stage).index)].alternatives;
            std::vector<std::string> needed;
            for (const auto& fabric : tray) needed.push_back(nameIn(plan.fabricNames, fabric));
            if (ready->pieces != needed) return "a wrong tray";
            if (static_cast<double>(record.atNs - state.trayAskedAtNs) / 1e9 < deadTimeSeconds) return "armed on an old tray";
        }
        state = std::get<SessionStep>(apply(plan, state, {body, record.atNs})).next;
    }
    const int stored = state.answersStored - answersBefore;
    if (stored > static_cast<int>(meant.size())) return "more answers than were given";
    if (mayDiffer) return {};
    for (int i = 0; i < stored; ++i) {
        const StoredAnswer& answer = state.answers[static_cast<std::size_t>(answersBefore + i)];
        const auto* rating = std::get_if<protocols::Tenths>(&answer.response);
        if (rating && *rating != protocols::Tenths{10 * std::stoi(meant[static_cast<std::size_t>(i)])}) return "another answer";
    }
    return {};
}

}  // namespace

class AppSlipsTest : public tests::support::WindowTest {
    Q_OBJECT

private Q_SLOTS:
    void noSlipStoresAnythingWrong_data()
    {
        QTest::addColumn<QString>("question");
        QTest::addColumn<std::vector<std::string>>("answers");
        QTest::newRow("a choice") << "Q1" << std::vector<std::string>{"B"};
        QTest::newRow("three ratings") << "Q2" << std::vector<std::string>{"5", "2", "8"};
    }

    void noSlipStoresAnythingWrong()
    {
        QFETCH(QString, question);
        QFETCH(std::vector<std::string>, answers);
        const StudyRecipe recipe{.deadTimeSeconds = deadTimeSeconds, .confirmPieces = true, .hasSwatchCodes = true};
        std::size_t count = 1;
        int complete = 0;
        for (std::size_t which = 0; which < count; ++which) {
            const auto folder = newStudy(recipe);
            OpenWindow open(folder);
            open.enrolAndBegin();
            open.playTo("PlacingTray", question.toStdString());
            const int before = open.view().answersStored;
            const Strokes meant = strokesOf(open.view(), answers);
            const auto slips = slipsOf(meant);
            count = slips.size();
            const Slip& slip = slips[which];
            for (const Stroke& stroke : slip.strokes)
                if (open.window().session()) press(open, stroke);
            // A slip within an answer can store another answer; the operator reads every answer back before Enter.
            const std::size_t tray = meant.size() - 2 * answers.size();
            const bool isInAnswer =
                slip.strokes.size() != meant.size() || !std::equal(meant.begin() + static_cast<std::ptrdiff_t>(tray), meant.end(),
                                                                   slip.strokes.begin() + static_cast<std::ptrdiff_t>(tray));
            const std::string fault = faultIn(folder, before, answers, isInAnswer);
            QVERIFY2(fault.empty(), qPrintable(slip.name + ": " + QString::fromStdString(fault)));
            complete += open.window().session() && open.view().answersStored == before + static_cast<int>(answers.size());
        }
        QVERIFY2(count > 60, qPrintable(QString::number(count)));
        QVERIFY(complete > 0);  // without a slip the answers are stored
    }

    void goingOnNeedsTwoActsThatAgree()
    {
        const auto folder = newStudy({.participants = 4});
        OpenWindow open(folder);
        for (const char* participant : {"P02", "P03", "P12"}) {
            open.enrolAndBegin(participant);
            open.gui().pressKey(Qt::Key_Q);
            QTRY_COMPARE(open.window().currentPage()->objectName(), QString("studyPage"));
        }
        open.clock().advanceSeconds(1);  // just after a session the page takes no Enter
        // The list stands on P02. Slips of "P02" and Enter open nobody, or P02.
        for (const QString typed : {"", "P0", "P2", "0P2", "P022", "P03", "P12", "P20", "P01", "p02"}) {
            open.widget<QLineEdit>("resumeField").setFocus();
            open.gui().clear();
            open.gui().type(typed);
            open.gui().pressKey(Qt::Key_Return);
            QVERIFY2(!open.window().session(), qPrintable(typed));
            QVERIFY(!open.message("studyMessage").isEmpty());
        }
        open.gui().clear();
        open.gui().type("P02");
        open.gui().pressKey(Qt::Key_Return);
        QCOMPARE(open.view().participant, std::string("P02"));
    }
};

QTEST_MAIN(AppSlipsTest)
#include "app_slips_test.moc"
