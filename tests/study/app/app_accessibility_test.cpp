// What a screen reader, or any program that reads the accessibility tree, can ask the window: every control has a name, and
// nothing tells the condition or the true piece of a trial. Neither do the settings and the clipboard.
#include <QAccessible>
#include <QClipboard>
#include <QDir>
#include <QFile>
#include <QGuiApplication>
#include <QLabel>
#include <QPushButton>
#include <QRegularExpression>
#include <QSettings>
#include <QTest>
#include <cstring>

#include "tests/support/typed_answers.h"
#include "tests/support/whole_protocol.h"

using namespace study::app;
using namespace study::session;
using namespace tests::support;

namespace {

quint64 bitsOf(const QAccessible::State& state)
{
    static_assert(sizeof(state) == sizeof(quint64));
    quint64 bits = 0;
    std::memcpy(&bits, &state, sizeof(bits));
    return bits;
}

/// Everything that the interface says about one control, besides its name.
QStringList detailsOf(QAccessibleInterface& node)
{
    QStringList said{QString::number(node.role()), QString::number(bitsOf(node.state()), 16)};
    for (const auto text : {QAccessible::Description, QAccessible::Value, QAccessible::Help, QAccessible::Accelerator})
        said << node.text(text);
    if (QAccessibleValueInterface* value = node.valueInterface())
        for (const QVariant& one : {value->currentValue(), value->minimumValue(), value->maximumValue()}) said << one.toString();
    if (QAccessibleActionInterface* action = node.actionInterface()) said << action->actionNames();
    return said;
}

void addTree(QStringList& lines, QAccessibleInterface& node)
{
    QStringList said = detailsOf(node);
    said << node.text(QAccessible::Name) << (node.object() ? node.object()->objectName() : QString());
    if (QAccessibleTextInterface* text = node.textInterface()) said << text->text(0, text->characterCount());
    lines << said.join(QStringLiteral(" | ")) + QStringLiteral(" { %1").arg(node.childCount());
    for (int place = 0; place < node.childCount(); ++place)
        if (QAccessibleInterface* child = node.child(place)) addTree(lines, *child);
}

/// The whole tree of the window, also of pages behind the one in front. Heads of the log and clocks of breaks differ by chance.
QStringList treeOf(QWidget& window)
{
    static const QRegularExpression head(QStringLiteral("[0-9]+:[0-9a-f]{16,64}|Break: [0-9]+:[0-9]+"));
    QStringList lines;
    addTree(lines, *QAccessible::queryAccessibleInterface(&window));
    for (QString& line : lines) line.replace(head, QStringLiteral("(differs)"));
    return lines;
}

struct SeenStudy {
    std::vector<QStringList> trees;  ///< of the presentations, in their order
    QByteArray settings, key;
};

QByteArray contentOf(const QString& path)
{
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

}  // namespace

class AppAccessibilityTest : public tests::support::WindowTest {
    Q_OBJECT

    /// Plays to the first presentations of every question. All studies lie at the same path, because the window shows it.
    SeenStudy look(const StudyRecipe& recipe)
    {
        const QString path = filePath("study"), ini = filePath("settings.ini");
        QDir(path).removeRecursively();
        QFile::remove(ini);
        const auto folder = buildStudy(path.toStdString(), recipe);
        AppOptions options;
        options.settings = std::make_shared<QSettings>(ini, QSettings::IniFormat);
        SeenStudy seen;
        OpenWindow open(folder, options);
        if (!QTest::qWaitForWindowActive(&open.window())) qFatal("the window does not become active");
        open.enrolAndBegin();
        for (const char* question : {"Q1", "S1", "Q2", "L1"})
            for (int trial = 0; trial < 3; ++trial) {
                open.playTo("Presenting", question);
                seen.trees.push_back(treeOf(open.window()));
                open.playTo("PlacingTray");
                seen.trees.push_back(treeOf(open.window()));
            }
        options.settings->sync();
        seen.settings = contentOf(ini);
        seen.key = contentOf(path + "/allocation-key.json");
        return seen;
    }

private Q_SLOTS:
    /// Two studies that differ only in the conditions behind the labels: each presentation has another condition in each.
    void theTreeTellsNoCondition()
    {
        StudyRecipe one = wholeStudy(), other = one;
        other.keyNames = {{"v_grey", "h&f"}, {"h&f", "v_grey"}};
        const SeenStudy first = look(one), second = look(other);
        QVERIFY(!first.key.isEmpty() && first.key != second.key);
        QCOMPARE(first.trees.size(), second.trees.size());
        for (std::size_t step = 0; step < first.trees.size(); ++step) {
            QVERIFY(first.trees[step].size() > 200);
            QCOMPARE(first.trees[step], second.trees[step]);
        }
        QCOMPARE(first.settings, second.settings);
        QVERIFY(QGuiApplication::clipboard()->text().isEmpty());
    }

    void theTreeNamesNoStimulus()
    {
        const SeenStudy seen = look(wholeStudy());
        const database::StudyStore store({filePath("study").toStdString()}, database::StudyStore::Access::Read);
        QStringList hidden{"v_grey", "h&f", "h+f"};
        for (const auto& [code, hash] : store.stimulusHashes()) hidden << QString::fromStdString(code.value);
        for (const QStringList& tree : seen.trees)
            for (const QString& line : tree)
                for (const QString& word : hidden)
                    QVERIFY2(!line.split(QRegularExpression("[^A-Za-z0-9_&+]+")).contains(word), qPrintable(line));
    }

    /// A screen reader gets the same of the true piece and of the foils, besides their names.
    void piecesOfAChoiceDifferInTheirNamesOnly()
    {
        OpenWindow open(newStudy({.fabrics = 5, .alternatives = 5, .hasSwatchCodes = true}));
        open.enrolAndBegin();
        open.playTo("Presenting", "Q1");
        QStringList first;
        for (const char letter : {'A', 'B', 'C', 'D', 'E'}) {
            auto& choice = open.widget<QPushButton>(qPrintable(QStringLiteral("answer%1").arg(letter)));
            QAccessibleInterface& node = *QAccessible::queryAccessibleInterface(&choice);
            QVERIFY(node.text(QAccessible::Name).startsWith(letter));
            if (first.isEmpty()) first = detailsOf(node);
            QCOMPARE(detailsOf(node), first);
        }
    }

    void everyControlThatTabReachesHasAName()
    {
        OpenWindow open(newStudy(wholeStudy()));
        const auto nameless = [&] {
            QStringList names;
            for (QWidget* widget : open.window().findChildren<QWidget*>()) {
                if (!widget->isVisible() || !(widget->focusPolicy() & Qt::TabFocus)) continue;
                const QAccessibleInterface* node = QAccessible::queryAccessibleInterface(widget);
                if (!node || node->text(QAccessible::Name).trimmed().isEmpty())
                    names << QString::fromLatin1(widget->metaObject()->className()) + " " + widget->objectName();
            }
            return names.join(", ");
        };
        QVERIFY2(nameless().isEmpty(), qPrintable(nameless()));
        open.enrolAndBegin();
        QVERIFY2(nameless().isEmpty(), qPrintable(nameless()));
        for (const char* question : {"Q1", "W1", "S1", "Q2", "L1", "C1"}) {
            open.playTo("Presenting", question);
            QVERIFY2(nameless().isEmpty(), qPrintable(nameless()));
        }
        for (const char* panel : {"voidButton", "noteButton", "correctButton", "withdrawButton"}) {
            open.gui().click(QString::fromLatin1(panel));
            QVERIFY2(nameless().isEmpty(), qPrintable(nameless()));
            open.gui().pressKey(Qt::Key_Escape);
        }
    }

    void aPieceIsNamedWithItsSlotAndItsState()
    {
        OpenWindow open(newStudy({.confirmPieces = true, .hasSwatchCodes = true}));
        open.enrolAndBegin();
        const auto& piece = open.widget<QLabel>("slotPiece");
        const QString code = QString::fromStdString(open.view().tray[0]);
        QCOMPARE(piece.accessibleName(), QStringLiteral("Slot A: %1, put here").arg(code));
        open.gui().type(code);
        pressKey(open, Qt::Key_Return);
        QCOMPARE(piece.accessibleName(), QStringLiteral("Slot A: %1, confirmed ✓").arg(code));
    }

    void aMessageThatIsGoneIsNotRead()
    {
        OpenWindow open(newStudy());
        open.enrolAndBegin();
        open.playTo("Presenting", "Q1");
        pressKey(open, Qt::Key_Return);
        auto* bar = open.window().findChild<QLabel*>("sessionMessage");
        const auto read = [&] { return QAccessible::queryAccessibleInterface(bar)->text(QAccessible::Name); };
        QVERIFY(!read().isEmpty());
        pressKey(open, Qt::Key_A);
        QVERIFY2(read().isEmpty(), qPrintable(read()));
    }
};

QTEST_MAIN(AppAccessibilityTest)
#include "app_accessibility_test.moc"
