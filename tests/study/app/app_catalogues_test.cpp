// The catalogues of the window in study/app/translations: complete, without what the program no longer says, with the same
// places, keys and spaces as in English. lupdate reads the texts from the sources.
#include <QDir>
#include <QDirIterator>
#include <QElapsedTimer>
#include <QFile>
#include <QFileInfo>
#include <QLibraryInfo>
#include <QProcess>
#include <QRegularExpression>
#include <QSet>
#include <QTemporaryDir>
#include <QTest>
#include <QXmlStreamReader>

#include "study/app/language/below.h"
#include "study/app/language/language.h"

namespace {

const QString sources = QStringLiteral(VIS2HAP_SOURCE_DIR);

/// One message of a catalogue.
struct Message {
    QString context, source, comment, translation;
    bool isFinished = true;

    QString key() const { return context + QChar(4) + source + QChar(4) + comment; }
    QString shown() const
    {
        return QStringLiteral("%1: \"%2\"%3").arg(context, source, comment.isEmpty() ? QString() : " (" + comment + ")");
    }
};

QList<Message> messagesIn(const QByteArray& ts)
{
    QList<Message> messages;
    QString context;
    Message message;
    QXmlStreamReader xml(ts);
    while (!xml.atEnd()) {
        xml.readNext();
        if (xml.isEndElement() && xml.name() == QLatin1String("message")) messages << message;
        if (!xml.isStartElement()) continue;
        if (xml.name() == QLatin1String("name")) context = xml.readElementText();
        if (xml.name() == QLatin1String("message")) message = {context, {}, {}, {}, true};
        if (xml.name() == QLatin1String("source")) message.source = xml.readElementText();
        if (xml.name() == QLatin1String("comment")) message.comment = xml.readElementText();
        if (xml.name() == QLatin1String("translation")) {
            message.isFinished = !xml.attributes().hasAttribute("type");
            message.translation = xml.readElementText();
        }
    }
    return messages;
}

QByteArray contentOf(const QString& path)
{
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

/// %1, {name}, `command`, (Enter), (F5), (W): what a translation must keep.
QStringList keptPartsOf(const QString& text)
{
    static const QRegularExpression kept(
        QStringLiteral("%[1-9n]|\\{[a-z_]+\\}|--[a-z-]+|\\((?:[A-Z]|F[0-9]+|Enter|Esc)\\)|\\*\\.[a-z]+|;;"));
    QStringList parts;
    for (auto found = kept.globalMatch(text); found.hasNext();) parts << found.next().captured();
    parts.sort();
    return parts;
}

/// The reviewer's name is empty until there is one.
bool mayBeEmpty(const Message& message)
{
    return message.context == QLatin1String("study::app::Catalogue") && message.source == QLatin1String("reviewer");
}

QString faultOf(const Message& message)
{
    if (mayBeEmpty(message)) return {};
    if (message.translation.trimmed().isEmpty()) return QStringLiteral("is empty");
    if (!message.isFinished) return QStringLiteral("is marked as unfinished");
    if (const QStringList kept = keptPartsOf(message.source); kept != keptPartsOf(message.translation))
        return QStringLiteral("must keep %1, has %2").arg(kept.join(' '), keptPartsOf(message.translation).join(' '));
    if (message.source.startsWith(' ') != message.translation.startsWith(' '))
        return QStringLiteral("must begin with a space, too");
    return {};
}

/// One line a fault. `wanted`: what the sources say now.
QStringList faultsOf(const QList<Message>& catalogue, const QList<Message>& wanted)
{
    QStringList faults;
    QSet<QString> there, asked;
    for (const Message& message : catalogue) there << message.key();
    for (const Message& message : wanted) asked << message.key();
    for (const Message& message : wanted)
        if (!there.contains(message.key())) faults << "lacks " + message.shown();
    for (const Message& message : catalogue)
        if (!asked.contains(message.key()))
            faults << "holds a text that the program no longer has, " + message.shown();
        else if (const QString fault = faultOf(message); !fault.isEmpty())
            faults << QStringLiteral("%1, \"%2\" %3").arg(message.shown(), message.translation, fault);
    return faults;
}

QStringList catalogueFiles()
{
    QStringList files;
    for (QDirIterator it(sources + "/study/app/translations", {"*.ts"}); it.hasNext();) files << it.next();
    files.sort();
    return files;
}

/// The string literals of the rooms below the window, with adjacent ones joined.
QString literalsBelow()
{
    static const QRegularExpression literal(QStringLiteral("\"((?:[^\"\\\\\\n]|\\\\.)*)\""));
    QString all;
    for (const char* room : {"protocols", "database", "rendering", "reports", "study"})
        for (QDirIterator it(sources + "/" + room, {"*.cpp", "*.h"}, QDir::Files, QDirIterator::Subdirectories); it.hasNext();) {
            const QString path = it.next();
            if (path.contains("/study/app/language/")) continue;
            QString text = QString::fromUtf8(contentOf(path));
            text.replace(QRegularExpression("\"\\s*\\n\\s*\""), QString());
            for (auto found = literal.globalMatch(text); found.hasNext();)
                all += found.next().captured(1).replace("\\\"", "\"") + '\n';
        }
    return all;
}

/// Whether a literal holds the piece, or two literals hold its halves, which the room then joins.
bool isSaid(const QString& piece, const QString& literals)
{
    if (literals.contains(piece)) return true;
    for (qsizetype blank = piece.indexOf(' '); blank >= 0; blank = piece.indexOf(' ', blank + 1))
        if (literals.contains(piece.left(blank)) && literals.contains(piece.mid(blank + 1))) return true;
    return false;
}

}  // namespace

class AppCataloguesTest : public QObject {
    Q_OBJECT

private:
    QTemporaryDir m_folder;
    QList<Message> m_wanted;

private Q_SLOTS:
    void initTestCase()
    {
        const QString lupdate = QLibraryInfo::path(QLibraryInfo::BinariesPath) + "/lupdate";
        QVERIFY2(QFile::exists(lupdate), "lupdate is missing: install Debian's package qt6-l10n-tools");
        QProcess process;
        process.setWorkingDirectory(sources);
        const QString file = m_folder.filePath("sources.ts");
        process.start(lupdate, {"-silent", "-I", ".", "-locations", "none", "study/app", "study/making", "-ts", file});
        QVERIFY(process.waitForFinished(60000));
        QCOMPARE(process.exitCode(), 0);
        m_wanted = messagesIn(contentOf(file));
        QVERIFY2(m_wanted.size() > 600, qPrintable(QString::number(m_wanted.size())));
    }

    void lupdateKnowsTheContextOfEveryText()
    {
        for (const Message& message : m_wanted)
            QVERIFY2(message.context.startsWith("study::"),
                     qPrintable("lupdate mistakes the class of " + message.shown() + "; see CONTRIBUTING, \"A language\""));
    }

    void catalogueIsComplete_data()
    {
        QTest::addColumn<QString>("file");
        for (const QString& file : catalogueFiles()) QTest::newRow(qPrintable(QFileInfo(file).fileName())) << file;
        QVERIFY(!catalogueFiles().isEmpty());
    }
    void catalogueIsComplete()
    {
        QFETCH(const QString, file);
        const QList<Message> catalogue = messagesIn(contentOf(file));
        const QStringList faults = faultsOf(catalogue, m_wanted);
        QVERIFY2(faults.isEmpty(),
                 qPrintable(QFileInfo(file).fileName() + " (see CONTRIBUTING, \"A language\"):\n" + faults.join('\n')));
        QSet<QString> seen;
        for (const Message& message : catalogue) {
            QVERIFY2(!seen.contains(message.key()), qPrintable("twice: " + message.shown()));
            seen << message.key();
        }
    }

    void catalogueIsOfThisVersion_data() { catalogueIsComplete_data(); }
    void catalogueIsOfThisVersion()
    {
        QFETCH(const QString, file);
        static const QRegularExpression version(QStringLiteral("project\\(vis2hap VERSION ([0-9.]+)"));
        const QString now = version.match(QString::fromUtf8(contentOf(sources + "/CMakeLists.txt"))).captured(1);
        QVERIFY(!now.isEmpty());
        for (const Message& message : messagesIn(contentOf(file)))
            if (message.source == QLatin1String("version of the program")) QCOMPARE(message.translation, now);
    }

    void everyFaultIsFound_data()
    {
        QTest::addColumn<QString>("from");
        QTest::addColumn<QString>("to");
        QTest::addColumn<QString>("fault");
        QTest::newRow("missing") << "<source>B %1 (W)</source>"
                                 << "<source>other</source>"
                                 << "lacks study::app::A: \"B %1 (W)\"";
        QTest::newRow("empty") << "b %1 (W)"
                               << " "
                               << "is empty";
        QTest::newRow("unfinished") << "<translation>"
                                    << "<translation type=\"unfinished\">"
                                    << "is marked as unfinished";
        QTest::newRow("place lost") << "b %1 (W)"
                                    << "b (W)"
                                    << "must keep %1 (W), has (W)";
        QTest::newRow("place doubled") << "b %1 (W)"
                                       << "b %1 %1 (W)"
                                       << "must keep %1 (W), has %1 %1 (W)";
        QTest::newRow("key changed") << "b %1 (W)"
                                     << "b %1 (R)"
                                     << "must keep %1 (W), has %1 (R)";
        QTest::newRow("no longer said") << "<source>B %1 (W)</source>"
                                        << "<source>old</source>"
                                        << "no longer has, study::app::A: \"old\"";
    }
    void everyFaultIsFound()
    {
        QFETCH(const QString, from);
        QFETCH(const QString, to);
        QFETCH(const QString, fault);
        const QString sound =
            "<TS><context><name>study::app::A</name><message><source>B %1 (W)</source>"
            "<translation>b %1 (W)</translation></message></context></TS>";
        const QList<Message> wanted = messagesIn(sound.toUtf8());
        QVERIFY(faultsOf(wanted, wanted).isEmpty());
        QVERIFY(sound.contains(from));
        const QString faults = faultsOf(messagesIn(QString(sound).replace(from, to).toUtf8()), wanted).join('\n');
        QVERIFY2(faults.contains(fault), qPrintable(faults));
    }

    void sentencesFromBelowAreStillSaid()
    {
        const QString literals = literalsBelow();
        static const QRegularExpression place(QStringLiteral("%[1-9]"));
        QStringList gone;
        for (const QString& sentence : study::app::sentencesFromBelow())
            for (const QString& part : sentence.split(place, Qt::SkipEmptyParts))
                for (const QString& piece : part.split(QStringLiteral("; ")))
                    if (piece.trimmed().size() > 3 && !isSaid(piece.trimmed(), literals)) gone << sentence + "  (" + piece + ")";
        QVERIFY2(gone.isEmpty(), qPrintable("no room says this any more:\n" + gone.join('\n')));
    }

    /// A driver or a server may send any text.
    void longTextsStayAsTheyAreAndTakeNoTime()
    {
        study::app::LanguageInUse language("vis2hap 0.6.0");
        language.use("de");
        const QString known = "The session is finished.";
        QVERIFY(study::app::inOwnLanguage(known) != known);
        QElapsedTimer watch;
        watch.start();
        const QString nested =
            QString(": ").repeated(120) + QString(" was chosen in ").repeated(8) + QString(" of ").repeated(55);
        for (const QString& part : {QString("a: "), QString("Slot 1 holds "), QString("x"), nested + "; ", QString("; ")}) {
            const QString endless = part.repeated(200'000 / part.size());
            QCOMPARE(study::app::inOwnLanguage(endless).size(), endless.size());
            study::app::inOwnLanguage(endless.left(599));
        }
        QCOMPARE(study::app::inOwnLanguage((known + "; ").repeated(100)).count(known), 0);  // a list of faults has many
        QVERIFY2(watch.elapsed() < 20'000, qPrintable(QString::number(watch.elapsed())));
    }

    void aFileThatIsNoDatabaseIsRefusedInOneLanguage()
    {
        study::app::LanguageInUse language("vis2hap 0.6.0");
        for (const char* tongue : {"de", "zh_CN"}) {
            language.use(tongue);
            const QString own = study::app::inOwnLanguage(
                "/s/study.db: this is no SQLite database; expected the study.db of a study folder; check the path");
            for (const char* english : {"this is", "expected", "folder", "check"})
                QVERIFY2(!own.contains(english), qPrintable(own));
            QVERIFY2(own.startsWith("/s/study.db: "), qPrintable(own));
        }
    }

    void everyRefusalOfASessionIsTranslated()
    {
        study::app::LanguageInUse language("vis2hap 0.6.0");
        language.use("de");
        static const QRegularExpression refusal(QStringLiteral("(?:Refusal\\{|return )\"([A-Z][^\"]*\\.)\""));
        int count = 0;
        QStringList english;
        for (QDirIterator it(sources + "/study/session", {"*.cpp"}); it.hasNext();)
            for (auto found = refusal.globalMatch(QString::fromUtf8(contentOf(it.next()))); found.hasNext(); ++count) {
                const QString sentence = found.next().captured(1);
                if (study::app::inOwnLanguage(sentence) == sentence) english << sentence;
            }
        QVERIFY(count > 15);
        QVERIFY2(english.isEmpty(), qPrintable("add to study/app/language/below_table.cpp:\n" + english.join('\n')));
    }
};

QTEST_GUILESS_MAIN(AppCataloguesTest)
#include "app_catalogues_test.moc"
