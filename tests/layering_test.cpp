// Arrows run down only. The picture of the house as a table: a folder, and what its files may include.
#include <QDirIterator>
#include <QFile>
#include <QRegularExpression>
#include <QtTest>

namespace {

struct Room {
    QString folder;
    QStringList mayInclude;  ///< prefixes of our own includes
    bool qt = false;
};

/// The longest folder that a file lies in decides.
const QList<Room>& rooms()
{
    static const QList<Room> table{
        {"protocols/", {"protocols/"}},
        {"stats/", {"stats/"}},
        {"rendering/", {"rendering/", "protocols/"}},
        {"rendering/signals/", {"rendering/signals/", "rendering/fabrics/dataset.h", "protocols/"}},
        {"rendering/fabrics/", {"rendering/", "protocols/"}},
        {"rendering/models/", {"rendering/", "protocols/"}},
        {"database/", {"database/", "protocols/"}, true},
        {"reports/", {"reports/", "stats/", "protocols/"}, true},
        {"study/", {"study/", "reports/", "database/", "rendering/", "stats/", "protocols/"}, true},
        {"study/session/",
         {"study/session/", "database/study_store.h", "rendering/display.h", "rendering/stimulus_bank.h", "protocols/"},
         true},
        {"study/looking/", {"study/looking/", "database/study_store.h", "rendering/", "protocols/"}, true},
        {"study/evaluation/", {"study/evaluation/", "rendering/", "stats/", "protocols/"}},
        {"study/app/",
         {"study/app/", "study/session/", "database/study_store.h", "database/study_folder.h", "reports/",
          "rendering/display.h", "rendering/stimulus_bank.h", "protocols/"},
         true},
        {"study/commands/", {"study/", "reports/", "database/", "rendering/", "stats/", "protocols/"}, true},
    };
    return table;
}

const Room* roomOf(const QString& file)
{
    const Room* best = nullptr;
    for (const Room& room : rooms())
        if (file.startsWith(room.folder) && (best == nullptr || room.folder.size() > best->folder.size())) best = &room;
    return best;
}

/// A file beside the including one, or one that the build makes, has no folder in its name.
bool isOurs(const QString& include) { return include.contains('/'); }

QString withoutComments(QString text)
{
    // Slashes and stars as classes: moc takes them for a comment even inside a raw string.
    static const QRegularExpression comments("[/][*].*?[*][/]|[/]{2}[^\\n]*", QRegularExpression::DotMatchesEverythingOption);
    return text.remove(comments);
}

QStringList includeFaults(const QString& file, const QString& text)
{
    const Room* room = roomOf(file);
    if (room == nullptr) return {file + " lies in no room of the table"};
    QStringList faults;
    static const QRegularExpression quoted("^\\s*#\\s*include\\s*[\"]([^\"]+)[\"]", QRegularExpression::MultilineOption);
    for (auto it = quoted.globalMatch(text); it.hasNext();) {
        const QString include = it.next().captured(1);
        const auto allows = [&](const QString& prefix) { return include.startsWith(prefix); };
        if (isOurs(include) && std::none_of(room->mayInclude.begin(), room->mayInclude.end(), allows))
            faults << file + " includes " + include;
    }
    static const QRegularExpression system("^\\s*#\\s*include\\s*<([^>]+)>", QRegularExpression::MultilineOption);
    for (auto it = system.globalMatch(text); it.hasNext();) {
        const QString include = it.next().captured(1);
        static const QRegularExpression qtHeader("^Q[A-Z]|^Qt");
        if (!room->qt && include.contains(qtHeader)) faults << file + " includes Qt's " + include;
        const bool torch = include.startsWith("torch/") || include.startsWith("ATen/") || include.startsWith("c10/");
        if (torch && !file.startsWith("rendering/models/")) faults << file + " includes torch's " + include;
    }
    return faults;
}

/// Session and app may not even name what tells a condition.
QStringList blindingFaults(const QString& file, const QString& text)
{
    const bool isBlinded = file.startsWith("study/session/") || file.startsWith("study/app/") || file.startsWith("study/looking/");
    if (!isBlinded) return {};
    QStringList faults;
    static const QRegularExpression keys("\\b(AllocationKey|MaskedKey|readAllocationKey\\w*|readMaskedKey|Unblinded)\\b");
    const auto match = keys.match(withoutComments(text));
    if (match.hasMatch()) faults << file + " names " + match.captured(1);
    return faults;
}

/// Every source of the program with its text, path relative to the root.
QMap<QString, QString> sources()
{
    QMap<QString, QString> found;
    const QDir root(VIS2HAP_SOURCE_DIR);
    for (const char* folder : {"protocols", "stats", "rendering", "database", "reports", "study"}) {
        QDirIterator files(root.filePath(folder), {"*.h", "*.cpp"}, QDir::Files, QDirIterator::Subdirectories);
        while (files.hasNext()) {
            QFile file(files.next());
            if (file.open(QIODevice::ReadOnly)) found[root.relativeFilePath(file.fileName())] = QString::fromUtf8(file.readAll());
        }
    }
    return found;
}

}  // namespace

class LayeringTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void noArrowRunsUp()
    {
        QVERIFY2(m_sources.size() > 20, "the sources are not where they are looked for");
        QStringList faults;
        for (auto it = m_sources.begin(); it != m_sources.end(); ++it) faults << includeFaults(it.key(), it.value());
        QVERIFY2(faults.isEmpty(), qPrintable(faults.join("; ")));
    }

    void sessionAndAppKnowNoKey()
    {
        QStringList faults;
        for (auto it = m_sources.begin(); it != m_sources.end(); ++it) faults << blindingFaults(it.key(), it.value());
        QVERIFY2(faults.isEmpty(), qPrintable(faults.join("; ")));
    }

    void onlyTheModelsLinkTorch()
    {
        QDirIterator files(VIS2HAP_SOURCE_DIR, {"CMakeLists.txt"}, QDir::Files, QDirIterator::Subdirectories);
        while (files.hasNext()) {
            const QString path = QDir(VIS2HAP_SOURCE_DIR).relativeFilePath(files.next());
            if (path.startsWith("build") || path == "rendering/models/CMakeLists.txt") continue;
            QFile file(files.filePath());
            QVERIFY(file.open(QIODevice::ReadOnly));
            QVERIFY2(!file.readAll().contains("TORCH_LIBRARIES"), qPrintable(path));
        }
    }

    void forbiddenArrowsAreSeen_data()
    {
        QTest::addColumn<QString>("file");
        QTest::addColumn<QString>("text");
        QTest::newRow("stats knows nobody") << "stats/a.cpp" << "#include \"protocols/errors.h\"\n";
        QTest::newRow("protocols without Qt") << "protocols/a.cpp" << "#include <QString>\n";
        QTest::newRow("signals without Qt") << "rendering/signals/a.h" << "#pragma once\n#include <QtGlobal>\n";
        QTest::newRow("rendering below database") << "rendering/a.cpp" << "#include \"database/study_store.h\"\n";
        QTest::newRow("reports without database") << "reports/a.cpp" << "#include \"database/keys.h\"\n";
        QTest::newRow("session without widgets of the app") << "study/session/a.cpp" << "#include \"study/app/page.h\"\n";
        QTest::newRow("session without keys") << "study/session/a.cpp" << "#include \"database/keys.h\"\n";
        QTest::newRow("app without keys") << "study/app/a.cpp" << "#include \"database/keys.h\"\n";
        QTest::newRow("looking without keys") << "study/looking/a.cpp" << "#include \"database/keys.h\"\n";
        QTest::newRow("evaluation without commands") << "study/evaluation/a.cpp" << "#include \"study/commands/progress.h\"\n";
        QTest::newRow("evaluation without Qt") << "study/evaluation/a.cpp" << "#include <QString>\n";
        QTest::newRow("app without signals") << "study/app/a.cpp" << "#include \"study/looking/sheet.h\"\n";
        QTest::newRow("app without friction images") << "study/app/a.cpp" << "#include \"rendering/friction_image.h\"\n";
        QTest::newRow("torch outside the models") << "rendering/a.cpp" << "#include <torch/torch.h>\n";
        QTest::newRow("room that is not in the table") << "extras/a.cpp" << "";
    }

    void forbiddenArrowsAreSeen()
    {
        QFETCH(const QString, file);
        QFETCH(const QString, text);
        QCOMPARE(includeFaults(file, text).size(), 1);
    }

    void namedKeysAreSeen()
    {
        QCOMPARE(blindingFaults("study/app/a.cpp", "protocols::AllocationKey key;").size(), 1);
        const QString remarks = QString("%1 no MaskedKey here\nint x; %2* nor an\nAllocationKey *%2").arg("//", "/");
        QCOMPARE(blindingFaults("study/session/a.h", remarks).size(), 0);
        QCOMPARE(blindingFaults("study/commands/a.cpp", "protocols::AllocationKey key;").size(), 0);
    }

private:
    QMap<QString, QString> m_sources = sources();
};

QTEST_GUILESS_MAIN(LayeringTest)
#include "layering_test.moc"
