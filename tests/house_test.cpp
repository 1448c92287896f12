// Rules of the source tree besides the permitted includes (layering_test): small folders, a header for each source, unique names.
#include <QDir>
#include <QDirIterator>
#include <QFile>
#include <QMap>
#include <QRegularExpression>
#include <QTest>

namespace {

const QStringList topFolders{"protocols", "stats", "rendering", "database", "reports", "study", "tests"};

QStringList filesBelow(const QString& folder, const QStringList& patterns)
{
    QStringList files;
    const QDir root(VIS2HAP_SOURCE_DIR);
    QDirIterator found(root.filePath(folder), patterns, QDir::Files, QDirIterator::Subdirectories);
    while (found.hasNext()) files << root.relativeFilePath(found.next());
    files.sort();
    return files;
}

QString textOf(const QString& file)
{
    QFile opened(QDir(VIS2HAP_SOURCE_DIR).filePath(file));
    return opened.open(QIODevice::ReadOnly) ? QString::fromUtf8(opened.readAll()) : QString();
}

QString folderOf(const QString& file) { return file.left(file.lastIndexOf('/')); }

/// Programs have a main() and no header; the commands share command_line.h, which lists them all.
bool mayLackHeader(const QString& file, const QString& text)
{
    return text.contains(QRegularExpression("\\bint main\\(")) || file.startsWith("study/commands/");
}

/// Types that a header declares at the outermost level of its namespace.
QStringList typesOf(const QString& header)
{
    static const QRegularExpression declaration(
        "^(?:class|struct|enum class) (\\w+)(?: final)?(?: :[^;{]*)?\\s*\\{|^using (\\w+) =",
        QRegularExpression::MultilineOption);
    QStringList names;
    for (auto it = declaration.globalMatch(header); it.hasNext();) {
        const auto match = it.next();
        names << (match.captured(1).isEmpty() ? match.captured(2) : match.captured(1));
    }
    return names;
}

}  // namespace

class HouseTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void noFolderHoldsMoreThanFortyFiles()
    {
        QMap<QString, int> counts;
        for (const QString& top : topFolders)
            for (const QString& file : filesBelow(top, {"*"})) ++counts[folderOf(file)];
        QVERIFY(counts.size() > 20);
        for (auto it = counts.begin(); it != counts.end(); ++it)
            QVERIFY2(it.value() <= 40, qPrintable(QString("%1 holds %2 files").arg(it.key()).arg(it.value())));
    }

    void everySourceHasItsHeader()
    {
        QStringList faults;
        for (const QString& top : topFolders) {
            if (top == "tests") continue;
            for (const QString& file : filesBelow(top, {"*.cpp"}))
                if (!mayLackHeader(file, textOf(file)) &&
                    !QFile::exists(QString(VIS2HAP_SOURCE_DIR "/") + file.chopped(4) + ".h"))
                    faults << file;
        }
        QVERIFY2(faults.isEmpty(), qPrintable(faults.join(", ")));
    }

    void noTypeNameMeansTwoThings()
    {
        QMap<QString, QStringList> headersByType;
        for (const QString& top : topFolders) {
            if (top == "tests") continue;
            for (const QString& file : filesBelow(top, {"*.h"}))
                for (const QString& type : typesOf(textOf(file))) headersByType[type] << file;
        }
        QVERIFY(headersByType.size() > 200);
        for (auto it = headersByType.begin(); it != headersByType.end(); ++it)
            QVERIFY2(it.value().size() == 1, qPrintable(it.key() + " in " + it.value().join(", ")));
    }

    void typesAreFound()
    {
        QCOMPARE(typesOf("struct A {\n    struct Inner {};\n};\nclass B final : public A {\nenum class C { X };\nusing D = int;\n"
                         "struct Forward;\n"),
                 QStringList({"A", "B", "C", "D"}));
    }

    void theBuildIsDescribedInFewLines()
    {
        int lines = textOf("CMakeLists.txt").count('\n');
        for (const QString& top : topFolders)
            for (const QString& file : filesBelow(top, {"CMakeLists.txt", "*.cmake"})) lines += textOf(file).count('\n');
        QVERIFY2(lines > 50 && lines <= 300, qPrintable(QString("%1 lines of CMake").arg(lines)));
    }

    /// Archives of objects can hold code, so weights and checkpoints are plain tensors (rendering/models/tensors).
    void torchReadsAndWritesNoFiles()
    {
        static const QRegularExpression archive(
            "torch(?:::|\\.)(?:load|save|jit|pickle|serialize)\\b|(?:Input|Output)Archive\\b|\\bunpickle|torch/script\\.h");
        for (const char* found :
             {"torch::load(x, f)", "torch.jit.load(f)", "torch::serialize::InputArchive a;", "torch::jit::load(f)"})
            QVERIFY2(archive.match(found).hasMatch(), found);
        QStringList faults;
        for (const QString& top : topFolders)
            for (const QString& file : filesBelow(top, {"*.cpp", "*.h", "*.py"}))
                if (file != "tests/house_test.cpp" && archive.match(textOf(file)).hasMatch()) faults << file;
        for (const QString& top : topFolders) faults << filesBelow(top, {"*.pt", "*.pth", "*.pkl"});
        QVERIFY2(faults.isEmpty(), qPrintable(faults.join(", ")));
    }

    void assertionsAreChecked()
    {
#ifdef NDEBUG
        QFAIL("this build leaves assertions out");
#endif
    }
};

QTEST_GUILESS_MAIN(HouseTest)
#include "house_test.moc"
