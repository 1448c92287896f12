// What the package holds, and where an installed program finds it.
#include "protocols/shipped_folder.h"

#include <QCoreApplication>
#include <QDir>
#include <QDirIterator>
#include <QProcess>
#include <QRegularExpression>
#include <QTemporaryDir>
#include <QTest>

#include "protocols/files/whole_file.h"

namespace {

QString textOfFile(const QString& file) { return QString::fromStdString(protocols::readWholeFile(file.toStdString())); }

}  // namespace

class ShippedFolderTest : public QObject {
    Q_OBJECT
    QTemporaryDir m_prefix;

    QString share(const QString& file) const { return m_prefix.filePath("share/" + file); }

private Q_SLOTS:
    void initTestCase()
    {
        QProcess laying;
        laying.setProcessChannelMode(QProcess::MergedChannels);
        laying.start(VIS2HAP_SOURCE_DIR "/.ci/shared-files", {m_prefix.filePath("share"), "7.8.9"});
        QVERIFY(laying.waitForFinished());
        QVERIFY2(laying.exitCode() == 0, qPrintable(QString::fromUtf8(laying.readAll())));
    }

    /// Beside the program comes first, then the prefix, then the sources.
    void programsFindTheirFolder()
    {
        const QDir programs(QCoreApplication::applicationDirPath());
        const QString name = QStringLiteral("shipped-folder-test-%1").arg(QCoreApplication::applicationPid());
        const auto found = [&] {
            return QString::fromStdString(protocols::shippedFolder(name.toStdString(), "/in/sources").string());
        };
        QCOMPARE(found(), QString("/in/sources"));
        const QString inPrefix = QDir::cleanPath(programs.filePath("../share/vis2hap/" + name));
        QVERIFY(QDir().mkpath(inPrefix));
        const QString fromPrefix = found();
        QVERIFY(programs.mkpath(name));
        const QString fromBeside = found();
        QVERIFY(programs.rmdir(name));
        QVERIFY(QDir().rmpath(inPrefix));
        QCOMPARE(fromPrefix, inPrefix);
        QCOMPARE(fromBeside, programs.filePath(name));
    }

    void whatTheProgramsReadIsThere()
    {
        const QList<QPair<QString, QString>> folders{
            {"weights", "rendering/models/weights"}, {"paper", "protocols/paper"}, {"peers", "tests/study/bench/peers"}};
        for (const auto& [installed, inSources] : folders) {
            const QDir sources(QString(VIS2HAP_SOURCE_DIR "/") + inSources);
            QVERIFY(!sources.entryList(QDir::Files).isEmpty());
            for (const QString& file : sources.entryList(QDir::Files))
                QCOMPARE(protocols::readWholeFile(share("vis2hap/" + installed + '/' + file).toStdString()),
                         protocols::readWholeFile(sources.filePath(file).toStdString()));
        }
    }

    void theMenuEntryHasItsIcon()
    {
        const QString entry = textOfFile(share("applications/vis2hap.desktop"));
        QVERIFY(entry.contains("\nExec=vis2hap\n") && entry.contains("\nIcon=vis2hap\n"));
        QVERIFY(textOfFile(share("icons/hicolor/scalable/apps/vis2hap.svg")).contains("<svg"));
        QVERIFY(protocols::readWholeFile(share("icons/hicolor/48x48/apps/vis2hap.png").toStdString()).starts_with("\x89PNG"));
    }

    void everyFileCanBeReadByEverybody()
    {
        int files = 0;
        for (QDirIterator found(share(""), QDir::AllEntries | QDir::NoDotAndDotDot, QDirIterator::Subdirectories);
             found.hasNext();) {
            const QFileInfo file(found.next());
            const auto everybody = QFile::ReadOther | (file.isDir() ? QFile::ExeOther : QFile::Permissions{});
            QVERIFY2((file.permissions() & everybody) == everybody && !(file.permissions() & QFile::WriteOther),
                     qPrintable(file.filePath()));
            ++files;
        }
        QVERIFY(files > 50);
    }

    /// The README names files; those of a user are in the folder of the documentation, under the same names.
    void theReadmeLeadsToFilesThatAreThere()
    {
        const QString readme = textOfFile(share("doc/vis2hap/README.md"));
        static const QRegularExpression named(
            "(?:\\]\\(|`)((?:protocols|rendering/display|study/app|reports/pictures)/[\\w/.]+\\.(?:png|json|md|py))[)`]");
        int files = 0;
        for (auto it = named.globalMatch(readme); it.hasNext(); ++files) {
            const QString file = it.next().captured(1);
            QVERIFY2(QFile::exists(share("doc/vis2hap/" + file)), qPrintable(file));
        }
        QVERIFY(files >= 8);
    }

    void theManualPageHasTheVersion()
    {
        QProcess unpacking;
        unpacking.start("gzip", {"-dc", share("man/man1/vis2hap.1.gz")});
        QVERIFY(unpacking.waitForFinished());
        const QString page = QString::fromUtf8(unpacking.readAll());
        QVERIFY(page.contains("Vis2Hap 7.8.9") && !page.contains('@'));
        QCOMPARE(QFileInfo(share("man/man1/vis2hap-nn.1.gz")).canonicalFilePath(),
                 QFileInfo(share("man/man1/vis2hap.1.gz")).canonicalFilePath());
    }
};

QTEST_GUILESS_MAIN(ShippedFolderTest)
#include "shipped_folder_test.moc"
