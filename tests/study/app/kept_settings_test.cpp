// The file of the window's settings, damaged or written by another program.
#include "study/app/kept_settings.h"

#include <QDir>
#include <QFile>
#include <QTest>
#include <stdexcept>

#include "tests/support/open_window.h"
#include "tests/support/program.h"

using namespace study::app;

class KeptSettingsTest : public tests::support::WindowTest {
    Q_OBJECT

    const QByteArray m_picture = "[General]\nlanguage=@Variant(\\0\\0\\0\\x49)\n";
    QString m_file;

    /// Writes settings that hold a picture, and returns what the program needs to read them.
    QStringList settingsWithAPicture()
    {
        m_file = filePath("config/vis2hap/vis2hap.ini");
        QFile written(m_file);
        if (!QDir().mkpath(filePath("config/vis2hap")) || !written.open(QIODevice::WriteOnly) ||
            written.write(m_picture) != m_picture.size())
            throw std::runtime_error("the settings could not be written");
        return {"XDG_CONFIG_HOME=" + filePath("config")};
    }

private Q_SLOTS:
    void settingsThatHoldObjectsAreKnown_data()
    {
        QTest::addColumn<QByteArray>("ini");
        QTest::addColumn<bool>("isUnreadable");
        const auto row = [](const char* name, const QByteArray& ini, bool isUnreadable) {
            QTest::newRow(name) << ini << isUnreadable;
        };
        row("picture", "[extraKeys]\nvoid=@Variant(\\0\\0\\0\\x49)\n", true);
        row("in a list", "recentStudies=/tmp/a, @Variant(\\0\\0\\0\\x49)\n", true);
        row("time", "a = \"@DateTime(\\0\\0)\"\n", true);
        row("numbered letters", "a=\\x40Va\\162iant(\\0)\n", true);
        row("number of 17 bits", "a=\\x10040Variant(\\0)\n", true);
        row("unknown escapes", "a=@V\\qariant\\x(\\0)\n", true);
        row("two lines", "a=@Var\\\r\niant(\\0)\n", true);
        row("own values", "recentStudies=@Invalid()\ndarkRoom=true\n\n[display]\nmmPerPixel=0.05\nspecification=@@Variant(a)\n",
            false);
        row("path", "recentStudies=/home/ann@lab/Variant(2), \"/home/@Variant(1)\"\n", false);
        row("empty", "", false);
    }
    void settingsThatHoldObjectsAreKnown()
    {
        QFETCH(const QByteArray, ini);
        QFETCH(const bool, isUnreadable);
        QCOMPARE(namesObjects(ini), isUnreadable);
    }

    void hugeSettingsAreSetAsideAndOwnOnesStay()
    {
        const QString file = filePath("some.ini");
        QVERIFY(setUnreadableAside(file).empty());  // there is none
        for (const qint64 size : {largestSettings, largestSettings + 1}) {
            QFile written(file);
            QVERIFY(written.open(QIODevice::WriteOnly) && written.write(QByteArray(size, '\n')) == size);
            written.close();
            QCOMPARE(setUnreadableAside(file).empty(), size == largestSettings);
            QCOMPARE(QFile::exists(file), size == largestSettings);
        }
        QCOMPARE(QFile(file + ".unreadable").size(), largestSettings + 1);
    }

    /// Outside of a window Qt ends the program where a setting holds a picture; a long list takes all memory.
    void aCommandRunsBesideSettingsThatHoldObjects()
    {
        const QStringList place = settingsWithAPicture();
        const QStringList call{"study", "sheets", QString::fromStdString(newStudy().folder.string()), "--out"};
        const auto ended = support::runProgram(call + QStringList{filePath("sheets")}, place);
        QVERIFY2(ended.exitCode == 0, qPrintable(ended.err));
        QVERIFY2(ended.err.contains("warning: the settings of the window were not read, because a value holds an object") &&
                     ended.err.contains(m_file + ".unreadable"),
                 qPrintable(ended.err));
        QFile aside(m_file + ".unreadable");
        QVERIFY(!QFile::exists(m_file) && aside.open(QIODevice::ReadOnly));
        QCOMPARE(aside.readAll(), m_picture);
        QCOMPARE(support::mustRun(call + QStringList{filePath("again")}, place).err, QString());
    }

    void aCommandRunsWhereTheyCannotBeRenamed()
    {
        const QStringList place = settingsWithAPicture();
        QFile::remove(m_file + ".unreadable");
        QVERIFY(QDir().mkpath(m_file + ".unreadable/full"));
        const auto ended = support::runProgram({"study", "sheets", QString::fromStdString(newStudy().folder.string()), "--out",
                                                filePath("sheets of the usual language")},
                                               place);
        QVERIFY2(ended.exitCode == 0, qPrintable(ended.err));
        QVERIFY2(ended.err.contains("warning: the settings of the window can be neither read nor renamed") &&
                     ended.err.contains(m_file),
                 qPrintable(ended.err));
        QVERIFY(QFile::exists(m_file));
    }
};

QTEST_MAIN(KeptSettingsTest)
#include "kept_settings_test.moc"
