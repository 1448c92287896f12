// Nothing that the window shows, or tells a screen reader, names a condition, its masked label or a file
// code: looked for in every widget at every step of a session with all nine conditions.
#include "database/study_store.h"
#include "protocols/condition.h"
#include "study/app/study_page.h"
#include "tests/support/open_window.h"

#include <QLabel>
#include <QTest>

using namespace study::session;
using tests::support::buildStudy;
using tests::support::OpenWindow;
using tests::support::textsIn;
using tests::support::textsNaming;

namespace {

std::set<QString> conditionIds()
{
    std::set<QString> words;
    for (const auto& condition : protocols::allConditions()) {
        words.insert(QString::fromStdString(std::string(condition.id)));
        words.insert(QString::fromStdString(protocols::fileNameOf(condition.conditionId())));
    }
    return words;
}

std::vector<std::string> idsOfAllConditions()
{
    std::vector<std::string> ids;
    for (const auto& condition : protocols::allConditions())
        ids.emplace_back(condition.id);
    return ids;
}

std::set<QString> hiddenWords(const database::StudyFolder& folder)
{
    std::set<QString> words = conditionIds();
    const database::StudyStore store(folder, database::StudyStore::Access::Read);
    for (const auto& [code, hash] : store.stimulusHashes())
        words.insert(QString::fromStdString(code.value));
    for (int label = 1; label <= 9; ++label)
        words.insert(QStringLiteral("K%1").arg(label));
    return words;
}

}  // namespace

class AppBlindingTest : public QObject {
    Q_OBJECT

private:
    void lookForLeaks(OpenWindow& open, const std::set<QString>& words)
    {
        const auto leaks = textsNaming(words, textsIn(open.window()));
        QVERIFY2(leaks.empty(), leaks.empty() ? "" : qPrintable(leaks.front()));
        ++m_looks;
    }
    int m_looks = 0;
    QTemporaryDir m_folder;

private Q_SLOTS:
    void wordsAreFoundAsWholeTokens_data();
    void wordsAreFoundAsWholeTokens();
    void noPageNamesWhatIsHidden();
};

void AppBlindingTest::wordsAreFoundAsWholeTokens_data()
{
    QTest::addColumn<QString>("text");
    QTest::addColumn<bool>("isFound");
    QTest::newRow("alone") << "h&f" << true;
    QTest::newRow("in a sentence") << "This is v_grey." << true;
    QTest::newRow("one letter") << "Condition h, trial 3" << true;
    QTest::newRow("spelled for files") << "stimuli/h_g+f_g.pgm" << true;
    QTest::newRow("part of a word") << "half of the fabric" << false;
    QTest::newRow("another id's part") << "f_gauze" << false;
}

void AppBlindingTest::wordsAreFoundAsWholeTokens()
{
    QFETCH(QString, text);
    QFETCH(bool, isFound);
    QLabel label(text);
    QCOMPARE(!textsNaming(conditionIds(), textsIn(label)).empty(), isFound);
}

void AppBlindingTest::noPageNamesWhatIsHidden()
{
    const auto folder = buildStudy(m_folder.path().toStdString() + "/study",
                                   {.conditions = idsOfAllConditions(), .breakAfter = 7});
    const auto words = hiddenWords(folder);
    OpenWindow open(folder);
    lookForLeaks(open, words);
    open.window().startSession(protocols::ParticipantId("P01"));
    int steps = 0;
    while (!std::holds_alternative<Finished>(open.view().state.stage)) {
        lookForLeaks(open, words);
        if (++steps % 11 == 0) {  // panels and the pause, from wherever the session just is
            for (const Qt::Key key : {Qt::Key_V, Qt::Key_N, Qt::Key_L, Qt::Key_W}) {
                open.hands().pressKey(key);
                lookForLeaks(open, words);
                open.hands().pressKey(Qt::Key_Escape);
            }
            if (!open.view().state.paused)
                open.perform(Paused{});
            lookForLeaks(open, words);
            open.perform(Resumed{});
        }
        open.perform(open.nextEvent());
    }
    lookForLeaks(open, words);
    open.hands().pressKey(Qt::Key_Return);
    QTRY_COMPARE(open.window().currentPage()->objectName(), QString("studyPage"));
    lookForLeaks(open, words);
    QVERIFY(m_looks > 200);
}

QTEST_MAIN(AppBlindingTest)
#include "app_blinding_test.moc"
