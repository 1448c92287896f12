// What a command needs, as README promises it: every command that computes loads the libraries of its row and no others, and
// none but the second program loads libtorch.
#include <QDir>
#include <QMap>
#include <QRegularExpression>
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "protocols/files/whole_file.h"
#include "study/commands/parts/explanation.h"
#include "tests/support/paper_totals.h"
#include "tests/support/program.h"

using study::commands::commandNeeds;
using study::commands::CommandNeeds;
using support::mustRun;

namespace {

/// Beginnings of the names of the files that a group of libraries has.
QStringList filesOf(const QString& group)
{
    static const std::map<QString, QStringList> groups{{"SQLite", {"libqsqlite", "libsqlite3"}},
                                                       {"picture formats of Qt", {"libqgif", "libqico", "libqjpeg", "libjpeg"}}};
    QStringList files;
    for (const QString& one : group.split(", ", Qt::SkipEmptyParts)) files << groups.at(one);
    return files;
}

/// The libraries in "...; 2 were loaded while it ran: a, b".
QStringList loadedIn(const QString& out)
{
    const auto line = QRegularExpression("libraries: \\d+ are mapped into memory(; .* loaded while it ran: (.*))?\n").match(out);
    if (!line.hasMatch()) qFatal("no libraries in: %s", qPrintable(out));
    return line.captured(2).split(", ", Qt::SkipEmptyParts);
}

/// The row of the table in README.
std::string rowOf(const CommandNeeds& needs)
{
    using study::commands::Networks;
    const char* networks = needs.networks == Networks::None     ? "none"
                           : needs.networks == Networks::Always ? "always"
                                                                : "for generated signals that are not kept";
    return "| `" + std::string(needs.command) + "` | " + needs.reads + " | " + networks + " | " +
           (*needs.libraries == '\0' ? "none" : needs.libraries) + " |\n";
}

}  // namespace

class ExplainCommandTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    /// In the order of a study's life, since later commands read what earlier ones made.
    void initTestCase()
    {
        writeText("t.csv", "a,b\n1,2\n2,3\n4,4\n");
        writeText("q.json", R"({"cases": [{"id": "a", "analysis": "describe", "inputs": {"x": [1, 2, 3]}, "options": {}}]})");
        const QString data = at("F"), study = at("S");
        run("fabrics make", {data, "--fabrics", "8", "--samples", "3", "--seed", "5"});
        run("fabrics check", {data});
        run("import", {"photos", data + "/F01/visual/000.png", "--fabric", "F01", "--out", at("I")});
        run("calibrate", {data + "/F01/tactile/000.png", "--surface", data + "/F01/height/000.tiff", "--background",
                          data + "/tactile-reference.png", "--mm-per-pixel", "0.05", "--out", at("C.json")});
        run("height", {data + "/F01/tactile/001.png", "--calibration", data + "/tactile-calibration.json", "--background",
                       data + "/tactile-reference.png", "--out", at("H.tiff")});
        run("train", {data, "--steps", "1", "--channels", "4", "--crop", "64", "--batch", "2", "--validation-pairs", "4", "--out",
                      at("M.safetensors")});
        run("evaluate", {data, "--model", at("M.safetensors"), "--quality", "fast"});
        run("render", {data, "--fabric", "F01", "--condition", "h,v_grey", "--out", at("R")});
        run("stroke", {at("R/F01/h.png"), "--csv", at("s.csv")});
        run("view", {at("R/F01/h.png"), "--out", at("v.png")});
        run("metrics", {at("R/F01/h.png"), at("R/F01/v_grey.png")});
        run("study new",
            {study, "--no-passphrase", "--dataset", data, "--seed", "3", "--key-seed", "4", "--images", at("images")});
        std::vector<std::string> fabrics;
        for (const auto& entry : QDir(at("images")).entryList(QDir::Dirs | QDir::NoDotAndDotDot))
            fabrics.push_back(entry.toStdString());
        writeText("script.json", support::paperScripts(fabrics).front().dump());
        run("replay", {study, at("script.json")});
        run("simulate", {study, "--participants", "1"});
        run("report", {study, "--out", at("report")});
        run("export", {study, "--out", at("export")});
        run("verify", {study});
        run("leak-check", {study});
        run("power", {"--studies", "20"});
        run("describe", {at("t.csv"), "--column", "a"});
        run("compare", {at("t.csv"), "--a", "a", "--b", "b"});
        run("analyse", {at("q.json"), "--out", at("qa.json")});
    }

    void everyCommandLoadsWhatItsRowSays_data()
    {
        QTest::addColumn<QString>("libraries");
        for (const CommandNeeds& needs : commandNeeds()) QTest::newRow(needs.command) << needs.libraries;
    }
    void everyCommandLoadsWhatItsRowSays()
    {
        QFETCH(QString, libraries);
        const QString command = QTest::currentDataTag();
        QVERIFY2(m_out.contains(command), "a new command: run it above");
        QVERIFY(m_out[command].contains("planned for " + command + "\n"));
        QVERIFY(m_out[command].contains("found for the whole call\n"));
        const QStringList files = filesOf(libraries);
        const QStringList loaded = loadedIn(m_out[command]);
        for (const QString& one : loaded) {
            const auto isNamed = [&](const QString& name) { return one.startsWith(name); };
            QVERIFY2(std::any_of(files.begin(), files.end(), isNamed), qPrintable(one));
        }
        QCOMPARE(loaded.isEmpty(), files.isEmpty());
    }

    void theReadmeHasEveryRow()
    {
        const std::string readme = protocols::readWholeFile(VIS2HAP_SOURCE_DIR "/README.md");
        for (const CommandNeeds& needs : commandNeeds())
            QVERIFY2(readme.find(rowOf(needs)) != std::string::npos, rowOf(needs).c_str());
    }

    /// A blinded study's explanation has counts and times, and names no condition.
    void nothingOfAStudyIsExplainedBeyondCounts()
    {
        for (const char* command : {"simulate", "replay", "report", "export", "verify"})
            for (const char* word : {"h_g", "v_grey", "h&f", "t_grey"}) {
                QVERIFY2(!explanationOf(command).contains(word), command);
            }
    }

private:
    QString at(const QString& name) const { return m_folder.filePath(name); }
    void writeText(const QString& name, const std::string& text) const { std::ofstream(at(name).toStdString()) << text; }

    void run(const QString& command, const QStringList& arguments)
    {
        const auto ended = support::runProgram(command.split(' ') + arguments + QStringList{"--explain"});
        if (command != "leak-check" && ended.exitCode != 0)  // without the key, leak-check ends with 1
            qFatal("%s: %s", qPrintable(command), qPrintable(ended.err));
        m_out[command] = ended.out;
    }

    /// From "planned for" to the reading of files, and from "found for" to the end.
    QString explanationOf(const QString& command) const
    {
        const QString& out = m_out[command];
        const auto planned = out.indexOf("planned for"), found = out.indexOf("found for");
        return out.mid(planned, out.indexOf("  libraries:", planned) - planned) + out.mid(found);
    }

    QTemporaryDir m_folder;
    QMap<QString, QString> m_out;
};

QTEST_GUILESS_MAIN(ExplainCommandTest)
#include "explain_command_test.moc"
