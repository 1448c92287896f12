// Nothing that a running session leaves anywhere names a condition: in windows, logs, file names, running orders and
// exports. And two studies whose keys differ only by which condition is which cannot be told apart by any of them.
#include <unistd.h>

#include <QApplication>
#include <QDir>
#include <QDirIterator>
#include <QFile>
#include <QLabel>
#include <QPlainTextEdit>
#include <QTemporaryFile>
#include <QTest>
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

/// As without a test, which keeps Qt's log for itself.
void logToStandardError(QtMsgType, const QMessageLogContext&, const QString& text)
{
    std::fprintf(stderr, "%s\n", qPrintable(text));
}

/// Everything that is written to standard error while it lives, by Qt's log or past it.
class StandardError {
public:
    StandardError() : m_kept(::dup(STDERR_FILENO)), m_before(qInstallMessageHandler(logToStandardError))
    {
        m_file.open();
        ::fflush(stderr);
        ::dup2(m_file.handle(), STDERR_FILENO);
    }
    ~StandardError()
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

std::vector<QString> textsOfAllWindows()
{
    std::vector<QString> texts;
    for (const QWidget* window : QApplication::topLevelWidgets())
        for (const QString& text : textsIn(*window)) texts.push_back(text);
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

/// What somebody saw and could take away from a session: at each step the texts of all windows and a fingerprint of
/// the picture; in the end the log and what the program wrote of the study.
struct Seen {
    std::vector<std::vector<QString>> texts;
    std::vector<std::size_t> pictures;
    QString log;
    QMap<QString, QByteArray> files;
};

std::size_t fingerprintOf(QWidget& window)
{
    const QImage picture = window.grab().toImage().convertToFormat(QImage::Format_RGB32);
    return qHashBits(picture.constBits(), static_cast<std::size_t>(picture.sizeInBytes()));
}

}  // namespace

class AppBlindingTest : public tests::support::WindowTest {
    Q_OBJECT

private:
    Seen playAndLook(const StudyRecipe& recipe);
    void look(OpenWindow& open, Seen& seen);
    void panelsAndPause(OpenWindow& open, Seen& seen);
    QMap<QString, QByteArray> writtenOf(const QString& study);

private Q_SLOTS:
    void initTestCase() { QApplication::setCursorFlashTime(0); }  // a cursor that blinks makes other pictures
    void wordsAreFoundAsWholeTokens_data();
    void wordsAreFoundAsWholeTokens();
    void nothingNamesACondition();
    void studiesWithOtherConditionsLookTheSame();
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
    QTest::newRow("another id's part") << "f_gauze" << false;
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

void AppBlindingTest::look(OpenWindow& open, Seen& seen)
{
    QApplication::processEvents();
    seen.texts.push_back(textsOfAllWindows());
    seen.pictures.push_back(fingerprintOf(open.window()));
}

void AppBlindingTest::panelsAndPause(OpenWindow& open, Seen& seen)
{
    for (const char* footerButton : {"voidButton", "noteButton", "flagButton", "correctButton", "withdrawButton"}) {
        if (!open.widget<QWidget>(footerButton).isEnabled()) continue;
        open.gui().click(QString::fromLatin1(footerButton));
        look(open, seen);
        open.gui().pressKey(Qt::Key_Escape);
    }
    if (open.view().state.paused || std::holds_alternative<Finished>(open.view().state.stage)) return;
    open.perform(Paused{});
    look(open, seen);
    open.perform(Resumed{});
}

Seen AppBlindingTest::playAndLook(const StudyRecipe& recipe)
{
    const QString path = filePath("study");  // the same for all, because the study page shows it
    QDir(path).removeRecursively();
    const auto folder = buildStudy(path.toStdString(), recipe);
    Seen seen;
    {
        StandardError log;
        OpenWindow open(folder);
        look(open, seen);
        open.window().startSession(ParticipantId("P01"));
        for (int steps = 1; !std::holds_alternative<Finished>(open.view().state.stage); ++steps) {
            look(open, seen);
            if (steps % 17 == 0) panelsAndPause(open, seen);
            if (steps == 60) open.perform(Voided{"a piece fell down"});
            open.perform(open.nextEvent());
        }
        look(open, seen);
        open.gui().pressKey(Qt::Key_Return);
        QApplication::processEvents();
        look(open, seen);
        open.window().startSession(ParticipantId("P02"));  // one that still runs while the files are written
        open.playTo("Presenting", "S1");
        look(open, seen);
        seen.files = writtenOf(path);
        seen.log = log.text();
    }
    return seen;
}

QMap<QString, QByteArray> AppBlindingTest::writtenOf(const QString& study)
{
    const QString out = filePath("written");
    QDir(out).removeRecursively();
    QDir().mkpath(out);
    QByteArray said;
    const auto run = [&](const QStringList& arguments) {
        const auto ended = support::mustRun(arguments);
        said += (ended.out + ended.err).toUtf8();
    };
    run({"study", "status", study});
    run({"study", "plan", study, "--csv", out + "/plan.csv"});
    for (const char* format : {"csv", "json", "script"}) run({"export", study, "--out", out + "/" + format, "--format", format});
    auto written = contentsOf(out);
    written["(said)"] = said;
    return written;
}

void AppBlindingTest::nothingNamesACondition()
{
    const auto ids = conditionIds();
    const Seen seen = playAndLook(wholeStudy(nineConditions()));
    QVERIFY(seen.texts.size() > 250);
    const auto require = [&](const std::vector<QString>& texts, const QString& where, const std::set<QString>& hidden) {
        const auto leaks = textsNaming(hidden, texts);
        QVERIFY2(leaks.empty(), leaks.empty() ? "" : qPrintable(where + ": " + leaks.front().left(300)));
    };
    std::set<QString> shown;
    for (const auto& texts : seen.texts) shown.insert(texts.begin(), texts.end());
    QVERIFY(shown.size() > 400);
    // In windows neither what the stimuli's files are called nor the labels of the masked key.
    std::set<QString> hiddenInWindows = ids;
    const database::StudyStore store({filePath("study").toStdString()}, database::StudyStore::Access::Read);
    for (const auto& [code, hash] : store.stimulusHashes()) hiddenInWindows.insert(QString::fromStdString(code.value));
    for (int label = 1; label <= 9; ++label) hiddenInWindows.insert(QStringLiteral("K%1").arg(label));
    require({shown.begin(), shown.end()}, "a window", hiddenInWindows);
    require({seen.log}, "the log", hiddenInWindows);
    for (const QString& name : namesOfFilesIn(filePath("study"))) require({name}, "a file's name", ids);
    QVERIFY(seen.files.size() > 4);
    for (auto file = seen.files.begin(); file != seen.files.end(); ++file)
        require({file.key(), QString::fromUtf8(file.value())}, file.key(), ids);
}

void AppBlindingTest::studiesWithOtherConditionsLookTheSame()
{
    WholeProtocol wanted;
    wanted.conditions = {"v_grey", "h_g&f_g", "h&f"};
    StudyRecipe one = wholeStudy(wanted), other = one;
    for (std::size_t i = 0; i < wanted.conditions.size(); ++i)
        other.keyNames[wanted.conditions[i]] = wanted.conditions[(i + 1) % wanted.conditions.size()];
    const Seen first = playAndLook(one);
    const auto keyOf = [&] { return contentsOf(filePath("study"))["allocation-key.json"]; };
    const QByteArray firstKey = keyOf();
    const Seen second = playAndLook(other);
    QVERIFY(firstKey != keyOf());
    QCOMPARE(first.texts.size(), second.texts.size());
    for (std::size_t step = 0; step < first.texts.size(); ++step) {
        QCOMPARE(first.texts[step], second.texts[step]);
        QVERIFY2(first.pictures[step] == second.pictures[step], qPrintable(QStringLiteral("picture %1").arg(step)));
    }
    QCOMPARE(first.log, second.log);
    QCOMPARE(first.files.keys(), second.files.keys());
    for (const QString& file : first.files.keys()) QVERIFY2(first.files[file] == second.files[file], qPrintable(file));
}

QTEST_MAIN(AppBlindingTest)
#include "app_blinding_test.moc"
