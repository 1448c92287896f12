// Blinding of a running session. No window, log, file name, running order or export names a condition. Two studies whose
// keys differ only in the conditions behind the labels give identical windows, logs and files.
#include <unistd.h>

#include <QApplication>
#include <QDir>
#include <QDirIterator>
#include <QFile>
#include <QLabel>
#include <QPlainTextEdit>
#include <QRegularExpression>
#include <QTemporaryFile>
#include <QTest>
#include <algorithm>
#include <cstdio>

#include "protocols/condition.h"
#include "tests/support/played_session.h"
#include "tests/support/program.h"
#include "tests/support/typed_answers.h"
#include "tests/support/whole_protocol.h"

using namespace study::session;
using namespace tests::support;
using protocols::ParticipantId;

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

WholeProtocol nineConditions()
{
    WholeProtocol wanted;
    wanted.conditions.clear();
    for (const auto& condition : protocols::allConditions()) wanted.conditions.emplace_back(condition.id);
    wanted.breakAfter = 9;
    return wanted;
}

/// Writes Qt's log to standard error, as outside a test.
void logToStandardError(QtMsgType, const QMessageLogContext&, const QString& text)
{
    std::fprintf(stderr, "%s\n", qPrintable(text));
}

/// Captures standard error, including Qt's log, during its lifetime.
class CapturedStandardError {
public:
    CapturedStandardError() : m_kept(::dup(STDERR_FILENO)), m_before(qInstallMessageHandler(logToStandardError))
    {
        m_file.open();
        ::fflush(stderr);
        ::dup2(m_file.handle(), STDERR_FILENO);
    }
    ~CapturedStandardError()
    {
        ::fflush(stderr);
        ::dup2(m_kept, STDERR_FILENO);
        ::close(m_kept);
        qInstallMessageHandler(m_before);
    }
    QString text()
    {
        ::fflush(stderr);
        QFile written(m_file.fileName());
        return written.open(QIODevice::ReadOnly) ? QString::fromUtf8(written.readAll()) : QString();
    }

private:
    QTemporaryFile m_file;
    int m_kept;
    QtMessageHandler m_before;
};

/// The texts of all windows in an order of their own: Qt lists windows by their addresses, which differ from run to run.
std::vector<QString> textsOfAllWindows()
{
    std::vector<std::vector<QString>> windows;
    for (const QWidget* window : QApplication::topLevelWidgets()) windows.push_back(textsIn(*window));
    std::sort(windows.begin(), windows.end());
    std::vector<QString> texts;
    for (const auto& window : windows) texts.insert(texts.end(), window.begin(), window.end());
    return texts;
}

QStringList namesOfFilesIn(const QString& folder)
{
    QStringList names;
    QDirIterator files(folder, QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot, QDirIterator::Subdirectories);
    while (files.hasNext()) names << QDir(folder).relativeFilePath(files.next());
    names.sort();
    return names;
}

QMap<QString, QByteArray> contentsOf(const QString& folder)
{
    QMap<QString, QByteArray> contents;
    for (const QString& name : namesOfFilesIn(folder)) {
        QFile file(QDir(folder).filePath(name));
        if (file.open(QIODevice::ReadOnly)) contents[name] = file.readAll();
    }
    return contents;
}

/// Everything that a session shows and writes: at each step the texts of all windows and a hash of the picture; at the end
/// the log and the written files.
struct SessionTraces {
    std::vector<std::vector<QString>> texts;
    std::vector<std::size_t> pictures;
    QString log;
    QMap<QString, QByteArray> files;
};

/// Heads of the log and times of exports differ in every study, because salts and clocks do.
QString withoutHeadsAndTimes(QString text)
{
    static const QRegularExpression head(QStringLiteral("[0-9]+:[0-9a-f]{16,64}"));
    static const QRegularExpression time(QStringLiteral("\"time\": \"[^\"]*\"|Break: [0-9]+:[0-9]+"));
    return text.replace(head, QStringLiteral("(head)")).replace(time, QStringLiteral("(time)"));
}

std::size_t fingerprintOf(QWidget& window)
{
    const QImage picture = window.grab().toImage().convertToFormat(QImage::Format_RGB32);
    return qHashBits(picture.constBits(), static_cast<std::size_t>(picture.sizeInBytes()));
}

}  // namespace

class AppBlindingTest : public tests::support::WindowTest {
    Q_OBJECT

private:
    SessionTraces playAndRecord(const StudyRecipe& recipe);
    void record(OpenWindow& open, SessionTraces& traces);
    void panelsAndPause(OpenWindow& open, SessionTraces& traces);
    QMap<QString, QByteArray> writtenOf(const QString& study);

private Q_SLOTS:
    void initTestCase() { QApplication::setCursorFlashTime(0); }  // a blinking cursor would change the pictures
    void wordsAreFoundAsWholeTokens_data();
    void wordsAreFoundAsWholeTokens();
    void nothingNamesACondition();
    void studiesWithPermutedConditionsLookTheSame();
};

void AppBlindingTest::wordsAreFoundAsWholeTokens_data()
{
    QTest::addColumn<QString>("text");
    QTest::addColumn<bool>("isFound");
    QTest::newRow("alone") << "h&f" << true;
    QTest::newRow("in a sentence") << "This is v_grey." << true;
    QTest::newRow("one letter") << "Condition h, trial 3" << true;
    QTest::newRow("spelled for files") << "stimuli/h_g+f_g.pgm" << true;
    QTest::newRow("in a row of a table") << "P01,3,F02,h_g&f_g,5.5" << true;
    QTest::newRow("part of a word") << "half of the fabric" << false;
    QTest::newRow("part of another id") << "f_gauze" << false;
}

void AppBlindingTest::wordsAreFoundAsWholeTokens()
{
    QFETCH(QString, text);
    QFETCH(bool, isFound);
    QLabel label(text);
    QCOMPARE(!textsNaming(conditionIds(), textsIn(label)).empty(), isFound);
    QPlainTextEdit words(text);
    QCOMPARE(!textsNaming(conditionIds(), textsIn(words)).empty(), isFound);
}

void AppBlindingTest::record(OpenWindow& open, SessionTraces& traces)
{
    QApplication::processEvents();
    traces.texts.push_back(textsOfAllWindows());
    traces.pictures.push_back(fingerprintOf(open.window()));
}

void AppBlindingTest::panelsAndPause(OpenWindow& open, SessionTraces& traces)
{
    for (const char* footerButton : {"voidButton", "noteButton", "flagButton", "correctButton", "withdrawButton"}) {
        if (!open.widget<QWidget>(footerButton).isEnabled()) continue;
        open.gui().click(QString::fromLatin1(footerButton));
        record(open, traces);
        open.gui().pressKey(Qt::Key_Escape);
    }
    if (open.view().state.paused || std::holds_alternative<Finished>(open.view().state.stage)) return;
    open.perform(Paused{});
    record(open, traces);
    open.perform(Resumed{});
}

SessionTraces AppBlindingTest::playAndRecord(const StudyRecipe& recipe)
{
    const QString path = filePath("study");  // the same path for all studies, because the study page shows it
    QDir(path).removeRecursively();
    const auto folder = buildStudy(path.toStdString(), recipe);
    SessionTraces traces;
    {
        CapturedStandardError log;
        OpenWindow open(folder);
        record(open, traces);
        open.window().startSession(ParticipantId("P01"));
        for (int steps = 1; !std::holds_alternative<Finished>(open.view().state.stage); ++steps) {
            record(open, traces);
            if (steps % 17 == 0) panelsAndPause(open, traces);
            if (steps == 60) open.perform(Voided{"a piece fell down"});
            open.perform(open.nextEvent());
        }
        record(open, traces);
        open.gui().pressKey(Qt::Key_Return);
        QApplication::processEvents();
        record(open, traces);
        open.window().startSession(ParticipantId("P02"));  // this session still runs while the files are written
        open.playTo("Presenting", "S1");
        record(open, traces);
        traces.files = writtenOf(path);
        traces.log = log.text();
    }
    return traces;
}

QMap<QString, QByteArray> AppBlindingTest::writtenOf(const QString& study)
{
    const QString out = filePath("written");
    QDir(out).removeRecursively();
    QDir().mkpath(out);
    QByteArray output;
    const auto run = [&](const QStringList& arguments) {
        const auto ended = support::mustRun(arguments);
        output += (ended.out + ended.err).toUtf8();
    };
    run({"study", "status", study});
    run({"study", "plan", study, "--csv", out + "/plan.csv"});
    for (const char* format : {"csv", "json", "script", "psych-ds"})
        run({"export", study, "--out", out + "/" + format, "--format", format});
    auto written = contentsOf(out);
    written["(output)"] = output;
    return written;
}

void AppBlindingTest::nothingNamesACondition()
{
    const auto ids = conditionIds();
    const SessionTraces traces = playAndRecord(wholeStudy(nineConditions()));
    QVERIFY(traces.texts.size() > 250);
    const auto require = [&](const std::vector<QString>& texts, const QString& where, const std::set<QString>& hidden) {
        const auto leaks = textsNaming(hidden, texts);
        QVERIFY2(leaks.empty(), leaks.empty() ? "" : qPrintable(where + ": " + leaks.front().left(300)));
    };
    std::set<QString> shown;
    for (const auto& texts : traces.texts) shown.insert(texts.begin(), texts.end());
    QVERIFY(shown.size() > 400);
    // Windows must hide the file codes of the stimuli and the labels of the conditions, too.
    std::set<QString> hiddenInWindows = ids;
    const database::StudyStore store({filePath("study").toStdString()}, database::StudyStore::Access::Read);
    for (const auto& [code, hash] : store.stimulusHashes()) hiddenInWindows.insert(QString::fromStdString(code.value));
    for (int label = 1; label <= 9; ++label) hiddenInWindows.insert(QStringLiteral("K%1").arg(label));
    require({shown.begin(), shown.end()}, "a window", hiddenInWindows);
    require({traces.log}, "the log", hiddenInWindows);
    for (const QString& name : namesOfFilesIn(filePath("study"))) require({name}, "a file's name", ids);
    QVERIFY(traces.files.size() > 4);
    for (auto file = traces.files.begin(); file != traces.files.end(); ++file)
        require({file.key(), QString::fromUtf8(file.value())}, file.key(), ids);
}

void AppBlindingTest::studiesWithPermutedConditionsLookTheSame()
{
    WholeProtocol wanted;
    wanted.conditions = {"v_grey", "h_g&f_g", "h&f"};
    StudyRecipe one = wholeStudy(wanted), other = one;
    for (std::size_t i = 0; i < wanted.conditions.size(); ++i)
        other.keyNames[wanted.conditions[i]] = wanted.conditions[(i + 1) % wanted.conditions.size()];
    const SessionTraces first = playAndRecord(one);
    const auto keyOf = [&] { return contentsOf(filePath("study"))["allocation-key.json"]; };
    const QByteArray firstKey = keyOf();
    const SessionTraces second = playAndRecord(other);
    QVERIFY(firstKey != keyOf());
    QCOMPARE(first.texts.size(), second.texts.size());
    for (std::size_t step = 0; step < first.texts.size(); ++step) {
        bool showsHead = false;
        QCOMPARE(first.texts[step].size(), second.texts[step].size());
        for (std::size_t i = 0; i < first.texts[step].size(); ++i) {
            const QString text = withoutHeadsAndTimes(first.texts[step][i]);
            QCOMPARE(text, withoutHeadsAndTimes(second.texts[step][i]));
            showsHead = showsHead || text != first.texts[step][i];
        }
        QVERIFY2(showsHead || first.pictures[step] == second.pictures[step], qPrintable(QStringLiteral("picture %1").arg(step)));
    }
    QCOMPARE(first.log, second.log);
    QCOMPARE(first.files.keys(), second.files.keys());
    for (const QString& file : first.files.keys())
        QCOMPARE(withoutHeadsAndTimes(QString::fromUtf8(first.files[file])),
                 withoutHeadsAndTimes(QString::fromUtf8(second.files[file])));
}

QTEST_MAIN(AppBlindingTest)
#include "app_blinding_test.moc"
