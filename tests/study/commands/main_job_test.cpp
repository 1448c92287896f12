// The main job through the program, as users run it: fabrics -> study -> scripted participants ->
// report; killed and resumed; through the window; and what happens on bad input.
#include <sqlite3.h>

#include <QDir>
#include <QDirIterator>
#include <QFile>
#include <QFileInfo>
#include <QImage>
#include <QProcess>
#include <QRandomGenerator>
#include <QSize>
#include <QTemporaryDir>
#include <QTest>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "protocols/files/foreign/foreign_table.h"
#include "tests/support/paper_totals.h"
#include "tests/support/program.h"

using support::mustRun;
using support::ProgramResult;
using support::runProgram;

namespace {

nlohmann::ordered_json readJson(const QString& file)
{
    std::ifstream in(file.toStdString());
    return nlohmann::ordered_json::parse(in);
}

void writeText(const QString& file, const std::string& text) { std::ofstream(file.toStdString()) << text; }

/// Rows of an exported answers.csv, header first, without the sitting and the instants: the clock starts anew when a session is
/// opened again.
QStringList rowsWithoutInstants(const QString& csv)
{
    const auto table = protocols::readForeignTable(csv.toStdString()).table;
    std::set<std::size_t> instants;
    for (const char* name :
         {"ready_at", "touched_at", "touch_ended_at", "answer_begun_at", "answered_at", "stored_at", "wall_time", "sitting"})
        instants.insert(table.column(name).value());
    const auto rowOf = [&](const std::vector<std::string>& cells) {
        std::vector<std::string> kept;
        for (std::size_t i = 0; i < cells.size(); ++i)
            if (!instants.contains(i)) kept.push_back(cells[i]);
        return QString::fromStdString(protocols::csvRow(kept)).trimmed();
    };
    QStringList rows{rowOf(table.columns)};
    for (const auto& cells : table.rows) rows << rowOf(cells);
    return rows;
}

/// Counted in the database while another process writes there; 0 while it opens the study.
int storedAnswers(const QString& study)
{
    sqlite3* reader = nullptr;
    sqlite3_stmt* count = nullptr;
    int answers = 0;
    if (sqlite3_open_v2((study + "/study.db").toUtf8().constData(), &reader, SQLITE_OPEN_READONLY, nullptr) == SQLITE_OK &&
        sqlite3_prepare_v2(reader, "SELECT COUNT(*) FROM responses", -1, &count, nullptr) == SQLITE_OK &&
        sqlite3_step(count) == SQLITE_ROW)
        answers = sqlite3_column_int(count, 0);
    sqlite3_finalize(count);
    sqlite3_close(reader);
    return answers;
}

}  // namespace

class MainJobTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase();
    void renderPutsEveryImageAtTheDisplaysSize();
    void theKeyIsPrivateAndStimuliLookAlike();
    void thePapersTotalsComeOutOfTheReport();
    void thePapersScriptsShip();
    void aFinishedParticipantIsReplayedAgainWithoutHarm();
    void theWindowStoresTheSameRows();
    void aKilledReplayGoesOnWhereItWas();
    void aScriptsOwnCrashIsSurvivedToo();
    void reportsStayBlindedUntilTheStudyIsUnblinded();
    void aSealedStudyShowsProgressOnly();
    void sessionsLoadNeitherTorchNorCodecs();
    void aStudyWithGeneratedSignalsNeedsTheSecondProgram();
    void badInputIsOneLineAndTheRightExitCode_data();
    void badInputIsOneLineAndTheRightExitCode();
    void anExportedSessionReplaysToTheSameRows();
    void theReportOfAnExportHasTheSameNumbers();
    void aPublicExportHasNoDaysNotesOrWords();

private:
    QString path(const QString& name) const { return m_folder.filePath(name); }
    QString newStudy(const QString& name);
    QStringList writeScripts(const QString& name, int participants);
    QStringList exportedRows(const QString& study);

    QTemporaryDir m_folder;
    QString m_fabrics, m_study;
    std::vector<std::string> m_studyFabrics;
};

/// All studies of this test have the same seeds, so they differ only in their answers.
QString MainJobTest::newStudy(const QString& name)
{
    mustRun({"study", "new", "--no-passphrase", path(name), "--dataset", m_fabrics, "--seed", "3", "--key-seed", "4", "--images",
             path("images")});
    return path(name);
}

QStringList MainJobTest::writeScripts(const QString& name, int participants)
{
    const auto scripts = support::paperScripts(m_studyFabrics);
    QStringList files;
    for (int p = 0; p < participants; ++p) {
        files << path(name + QString::number(p) + ".json");
        writeText(files.back(), scripts[p].dump());
    }
    return files;
}

QStringList MainJobTest::exportedRows(const QString& played)
{
    // Rows with fabrics and conditions exist after the unblinding only, so a copy is unblinded.
    const QString study = played + "-unblinded";
    QDir(study).removeRecursively();
    if (QProcess::execute("cp", {"-a", played, study}) != 0) qFatal("cannot copy");
    mustRun({"unblind", study, "--who", "test", "--why", "to compare rows"});
    mustRun({"export", study, "--out", study + "-export"});
    return rowsWithoutInstants(study + "-export/answers.csv");
}

void MainJobTest::initTestCase()
{
    m_fabrics = path("fabrics");
    mustRun({"fabrics", "make", m_fabrics, "--fabrics", "8", "--samples", "2", "--seed", "5"});
    mustRun({"fabrics", "check", m_fabrics});
    m_study = newStudy("study");
    const auto manifest = readJson(path("images/render.json"));
    for (const auto& entry : QDir(path("images")).entryList(QDir::Dirs | QDir::NoDotAndDotDot))
        m_studyFabrics.push_back(entry.toStdString());
    QCOMPARE(m_studyFabrics.size(), std::size_t(7));
}

void MainJobTest::renderPutsEveryImageAtTheDisplaysSize()
{
    const auto ended =
        mustRun({"render", m_fabrics, "--fabric", "F01", "--condition", "v_grey,h+f", "--out", path("rendered"), "--explain"});
    QVERIFY(ended.out.contains("photometric"));
    QVERIFY(!QFile::exists(path("rendered/F01/h_g.png")));
    for (const char* name : {"v_grey", "h+f"}) {
        const QImage image(path(QString("rendered/F01/%1.png").arg(name)));
        QCOMPARE(image.size(), QSize(1280, 800));
        QCOMPARE(image.format(), QImage::Format_Grayscale8);
    }
}

void MainJobTest::theKeyIsPrivateAndStimuliLookAlike()
{
    const QFileInfo key(m_study + "/allocation-key.json");
    QCOMPARE(key.permissions() & (QFile::ReadGroup | QFile::ReadOther), QFile::Permissions());
    std::set<qint64> sizes, times;
    const auto stimuli = QDir(m_study + "/stimuli").entryInfoList(QDir::Files);
    QCOMPARE(stimuli.size(), 63 + 1);  // one of the eight fabrics is for familiarisation
    for (const auto& file : stimuli) {
        sizes.insert(file.size());
        times.insert(file.lastModified().toMSecsSinceEpoch());
    }
    QCOMPARE(sizes.size(), std::size_t(1));
    QCOMPARE(times.size(), std::size_t(1));
    mustRun({"verify", m_study});
}

void MainJobTest::thePapersTotalsComeOutOfTheReport()
{
    mustRun(QStringList{"replay", m_study} + writeScripts("paper", 10));
    mustRun({"unblind", m_study, "--who", "test", "--why", "scripted participants"});
    mustRun({"report", m_study, "--out", path("report")});
    const auto results = readJson(path("report/results.json"));
    QCOMPARE(results["study"]["participants"].get<int>(), 10);
    for (const auto& total : support::paperTotals()) {
        const auto& match = results["questions"]["Q1"][total.condition];
        QCOMPARE(match["trials"].get<int>(), 70);
        QCOMPARE(match["correct"].get<int>(), total.correct);
        QCOMPARE(match["matches_per_rendering"].get<double>(), 10.0 * total.correct / 70);
        for (int q = 0; q < 3; ++q) {
            const auto& rating = results["questions"][q == 0 ? "Q2" : q == 1 ? "Q3" : "Q4"][total.condition];
            QCOMPARE(rating["n"].get<int>(), 70);
            QCOMPARE(rating["mean"].get<double>(), total.ratings[q]);
        }
    }
    // The numbers that the paper prints.
    QCOMPARE(QString::number(results["questions"]["Q1"]["v_grey"]["matches_per_rendering"].get<double>(), 'f', 1),
             QString("3.9"));
    QCOMPARE(QString::number(results["questions"]["Q1"]["f_g"]["matches_per_rendering"].get<double>(), 'f', 1), QString("5.6"));
    QCOMPARE(QString::number(results["questions"]["Q1"]["h&f"]["matches_per_rendering"].get<double>(), 'f', 1), QString("7.1"));
    QVERIFY(QFile::exists(path("report/index.html")));
    QVERIFY(QDir(path("report/figures")).entryList({"*.svg"}).size() >= 2);
}

/// The shipped scripts give the rows of those from which the paper's totals come out.
void MainJobTest::thePapersScriptsShip()
{
    const QString study = newStudy("paper-study");
    const auto ended = mustRun({"replay", "--paper", study});
    QCOMPARE(ended.out.count("252 answers stored, finished"), 10);
    QCOMPARE(exportedRows(study), exportedRows(m_study));
    QVERIFY(runProgram({"replay", "--paper", study, path("paper0.json")}).err.contains("--paper has its own scripts"));
    QVERIFY(runProgram({"replay", study}).err.contains("there is no script"));
}

void MainJobTest::aFinishedParticipantIsReplayedAgainWithoutHarm()
{
    const auto before = exportedRows(m_study);
    QCOMPARE(runProgram({"replay", m_study, path("paper0.json")}).exitCode, 0);
    QCOMPARE(exportedRows(m_study), before);
}

void MainJobTest::theWindowStoresTheSameRows()
{
    const auto direct = newStudy("direct"), window = newStudy("window");
    const auto scripts = writeScripts("both", 1);
    auto script = readJson(scripts[0]);
    script["events"] = {{{"before_answer", 10}, {"do", "pause"}},
                        {{"before_answer", 10}, {"do", "resume"}},
                        {{"after_answer", 20}, {"do", "void"}, {"why", "wrong swatch"}},
                        {{"after_answer", 80}, {"do", "correct"}, {"question", "Q2"}, {"answer", 4.0}, {"why", "misheard"}}};
    writeText(scripts[0], script.dump());
    mustRun({"replay", direct, scripts[0]});
    mustRun({"replay", window, scripts[0], "--gui"});
    const auto rows = exportedRows(direct);
    QCOMPARE(rows.size(), 1 + 252 + 1);  // header, answers, the voided one
    QCOMPARE(exportedRows(window), rows);
}

void MainJobTest::aKilledReplayGoesOnWhereItWas()
{
    const auto whole = newStudy("whole"), killed = newStudy("killed");
    const auto scripts = writeScripts("kill", 2);
    mustRun(QStringList{"replay", whole} + scripts);
    int killsBetweenAnswers = 0;
    for (int kills = 0; kills < 3; ++kills) {
        const int atLeast = storedAnswers(killed) + QRandomGenerator::global()->bounded(1, 150);
        QProcess process;
        support::startProgram(process, QStringList{"replay", killed} + scripts);
        while (storedAnswers(killed) < atLeast && process.state() == QProcess::Running) process.waitForFinished(1);
        ::kill(static_cast<pid_t>(process.processId()), SIGKILL);
        process.waitForFinished();
        killsBetweenAnswers += storedAnswers(killed) < 504;
    }
    QVERIFY(killsBetweenAnswers > 0);
    mustRun(QStringList{"replay", killed} + scripts);
    QCOMPARE(exportedRows(killed), exportedRows(whole));
    mustRun({"verify", killed});
}

void MainJobTest::aScriptsOwnCrashIsSurvivedToo()
{
    const auto study = newStudy("crash");
    const auto scripts = writeScripts("crash", 1);
    auto script = readJson(scripts[0]);
    script["events"] = {{{"after_answer", 15}, {"do", "crash"}}, {{"after_answer", 100}, {"do", "crash"}}};
    writeText(scripts[0], script.dump());
    QVERIFY(runProgram({"replay", study, scripts[0]}).exitCode != 0);
    QCOMPARE(exportedRows(study).size(), 1 + 15);
    QVERIFY(runProgram({"replay", study, scripts[0]}).exitCode != 0);
    QCOMPARE(exportedRows(study).size(), 1 + 100);
    mustRun({"replay", study, scripts[0]});
    QCOMPARE(exportedRows(study).size(), 1 + 252);
}

void MainJobTest::reportsStayBlindedUntilTheStudyIsUnblinded()
{
    const auto study = newStudy("blinded");
    mustRun(QStringList{"replay", study} + writeScripts("blinded", 2));
    mustRun({"report", study, "--out", path("blinded-report")});
    const auto results = readJson(path("blinded-report/results.json"));
    QCOMPARE(results["study"]["blinded"].get<bool>(), true);
    QCOMPARE(results["conditions"][0].get<std::string>(), std::string("K1"));
    QFile page(path("blinded-report/index.html"));
    QVERIFY(page.open(QIODevice::ReadOnly));
    const auto text = QString::fromUtf8(page.readAll());
    for (const char* id : {"v_grey", "v_shape", "t_grey", "h_g&amp;f_g", "h&amp;f"}) QVERIFY2(!text.contains(id), id);
    QVERIFY(results["questions"].is_null());
    QVERIFY2(text.contains("2 participants have finished, and at least 3 are needed"), "there are no means yet");
    mustRun({"export", study, "--out", path("blinded-export"), "--format", "json"});
    const auto exported = readJson(path("blinded-export/export.json"));
    QVERIFY(exported["conditions"].is_null());
    QCOMPARE(exported["why"]["conditions"].get<std::string>(), results["why"]["questions"].get<std::string>());
}

void MainJobTest::aSealedStudyShowsProgressOnly()
{
    const QStringList passphrase{"VIS2HAP_PASSPHRASE=four plain short words"};
    const auto study = path("sealed");
    const QStringList making{"study", "new", study, "--dataset", m_fabrics, "--seed", "3", "--images", path("images")};
    const auto refused = runProgram(making);
    QVERIFY2(refused.exitCode == 2 && refused.err.contains("--passphrase-file"), qPrintable(refused.err));
    mustRun(making, passphrase);
    QVERIFY(!QFile::exists(study + "/allocation-key.json"));
    QCOMPARE(runProgram({"replay", study, writeScripts("sealed", 1)[0]}).exitCode, 2);
    mustRun({"replay", study, path("sealed0.json")}, passphrase);
    mustRun({"verify", study});

    mustRun({"report", study, "--out", path("sealed-report")});
    const auto sealed = readJson(path("sealed-report/results.json"));
    QVERIFY(sealed["questions"].is_null() && sealed["study"]["blinded"] == true);
    QCOMPARE(sealed["progress"]["slots"][0]["answers"].get<int>(), 252);
    for (const char* format : {"csv", "json"}) mustRun({"export", study, "--out", path("sealed-export"), "--format", format});
    QVERIFY(!QFile::exists(path("sealed-export/answers.csv")) && !QFile::exists(path("sealed-export/conditions.csv")));
    for (const QString& folder : {path("sealed-report"), path("sealed-export")}) {
        QDirIterator files(folder, QDir::Files, QDirIterator::Subdirectories);
        while (files.hasNext()) {
            QFile file(files.next());
            QVERIFY(file.open(QIODevice::ReadOnly));
            const auto text = file.readAll();
            for (const char* word : {"v_grey", "t_grey", "h_g", "\"K1\"", "correct\":"})
                QVERIFY2(!text.contains(word), qPrintable(file.fileName() + ": " + word));
        }
    }

    mustRun({"report", study, "--out", path("masked-report"), "--quick"}, passphrase);
    QCOMPARE(readJson(path("masked-report/results.json"))["conditions"][0].get<std::string>(), std::string("K1"));
    QVERIFY(QDir().mkpath(path("masked-export")));
    QFile earlier(path("masked-export/conditions.csv"));  // an export that gave out means
    QVERIFY(earlier.open(QIODevice::WriteOnly));
    earlier.close();
    const auto masked = mustRun({"export", study, "--out", path("masked-export")}, passphrase);
    QVERIFY(QFile::exists(path("masked-export/progress.csv")) && !QFile::exists(path("masked-export/answers.csv")));
    const QString why = "There are no means under K-labels yet: 1 participant has finished, and at least 3 are needed.\n";
    QVERIFY2(masked.out.contains(why) && !QFile::exists(path("masked-export/conditions.csv")), qPrintable(masked.out));

    const QStringList unblinding{"unblind", study, "--who", "test", "--why", "the end"};
    QCOMPARE(runProgram(unblinding).exitCode, 2);
    QCOMPARE(runProgram(unblinding, {"VIS2HAP_PASSPHRASE=another one of words"}).exitCode, 2);
    mustRun(unblinding, passphrase);
    mustRun({"export", study, "--out", path("open-export")});
    QVERIFY(QFile::exists(path("open-export/answers.csv")));
    mustRun({"verify", study});
}

void MainJobTest::sessionsLoadNeitherTorchNorCodecs()
{
    const auto study = newStudy("lean");
    const auto scripts = writeScripts("lean", 1);
    const QList<QStringList> calls{
        {"replay", study, scripts[0]}, {"study", "status", study}, {"report", study, "--out", path("lean-report")}};
    for (const auto& call : calls) {
        const auto ended = mustRun(call, {"LD_DEBUG=files", "LD_DEBUG_OUTPUT=" + path("loaded")});
        const auto logs = QDir(m_folder.path()).entryInfoList({"loaded.*"});
        int ours = 0;
        for (const auto& log : logs) {
            QFile file(log.filePath());
            QVERIFY(file.open(QIODevice::ReadOnly));
            const auto text = file.readAll();
            ours += text.contains("libQt6Core");  // a report may start pandoc, which is another program
            for (const char* library : {"libtorch", "libc10", "opencv_imgcodecs", "opencv_highgui", "libgdal"})
                QVERIFY2(!text.contains(library), qPrintable(call.join(' ') + " loads " + library));
            QFile::remove(log.filePath());
        }
        QVERIFY(ours > 0);
    }
}

void MainJobTest::aStudyWithGeneratedSignalsNeedsTheSecondProgram()
{
    const auto ended = runProgram({"study", "new", "--no-passphrase", path("without"), "--dataset", m_fabrics},
                                  {"VIS2HAP_NN=/nowhere/vis2hap-nn"});
    QCOMPARE(ended.exitCode, 3);
    QCOMPARE(ended.messages().size(), 1);
    QVERIFY(!QFile::exists(path("without")));
    mustRun({"render", m_fabrics, "--condition", "v_grey,h", "--out", path("measured")}, {"VIS2HAP_NN=/nowhere/vis2hap-nn"});
}

void MainJobTest::badInputIsOneLineAndTheRightExitCode_data()
{
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<int>("exitCode");
    QTest::addColumn<QString>("named");

    auto protocol = nlohmann::ordered_json::parse(R"({"schema":"vis2hap.protocol/1","name":"x","participants":2,"fabrics":2,
        "conditions":["v_grey","w_grey"],"phases":[{"questions":["Q1"],"alternatives":2}]})");
    writeText(path("unknown.json"), protocol.dump());
    QTest::newRow("unknown condition in the protocol")
        << QStringList{"study",     "new",     "--no-passphrase", path("bad1"),
                       "--dataset", m_fabrics, "--protocol",      path("unknown.json")}
        << 2 << "w_grey";
    QTest::newRow("a study folder that exists")
        << QStringList{"study", "new", "--no-passphrase", m_study, "--dataset", m_fabrics} << 2 << "exists";
    QTest::newRow("unknown condition to render")
        << QStringList{"render", m_fabrics, "--condition", "h_x", "--out", path("bad2")} << 2 << "h_x";
    QTest::newRow("unknown fabric") << QStringList{"render",      m_fabrics, "--fabric", "F99",
                                                   "--condition", "h",       "--out",    path("bad3")}
                                    << 2 << "F99";
    auto script = support::paperScripts(m_studyFabrics)[0];
    script["answers"].push_back(script["answers"][0]);
    writeText(path("doubled.json"), script.dump());
    QTest::newRow("doubled answer") << QStringList{"replay", m_study, path("doubled.json")} << 2 << "doubled";
    QTest::newRow("no such study") << QStringList{"study", "status", path("nowhere")} << 2 << "nowhere";
    QTest::newRow("unknown command") << QStringList{"reprot", "x"} << 2 << "";
    QTest::newRow("mistyped command without a screen") << QStringList{"rendr"} << 2 << "neither a command";
    QTest::newRow("missing protocol before the passphrase")
        << QStringList{"study", "new", path("bad1"), "--dataset", m_fabrics, "--protocol", path("nope.json")} << 2 << "nope.json";
    QTest::newRow("unknown option") << QStringList{"study", "status", m_study, "--jsn"} << 2 << "--jsn";

    // A data set without photographs.
    const QString bare = path("no-photos");
    QProcess::execute("cp", {"-r", m_fabrics, bare});
    for (const auto& fabric : QDir(bare).entryList({"F*"}, QDir::Dirs)) QDir(bare + "/" + fabric + "/visual").removeRecursively();
    QTest::newRow("no photographs for v_grey")
        << QStringList{"render", bare, "--condition", "v_grey", "--out", path("bad4")} << 2 << "F01";

    // A missing stimulus.
    const QString robbed = newStudy("robbed");
    const auto stimuli = QDir(robbed + "/stimuli").entryList(QDir::Files);
    QFile::remove(robbed + "/stimuli/" + stimuli.front());
    QTest::newRow("a missing stimulus") << QStringList{"replay", robbed, writeScripts("robbed", 1)[0]} << 1
                                        << QFileInfo(stimuli.front()).baseName();
    QTest::newRow("verify names it") << QStringList{"verify", robbed} << 1 << "";
}

void MainJobTest::badInputIsOneLineAndTheRightExitCode()
{
    QFETCH(QStringList, arguments);
    QFETCH(int, exitCode);
    QFETCH(QString, named);
    const auto ended = runProgram(arguments);
    QVERIFY2(ended.exitCode == exitCode, qPrintable(QString::number(ended.exitCode) + ": " + ended.err));
    if (arguments.front() != "verify") QVERIFY2(ended.messages().size() == 1, qPrintable(ended.err));
    QVERIFY2((ended.err + ended.out).contains(named), qPrintable(ended.err));
    for (const char* out : {"bad1", "bad2", "bad3", "bad4"}) QVERIFY2(!QFile::exists(path(out)), out);
}

void MainJobTest::anExportedSessionReplaysToTheSameRows()
{
    const auto first = newStudy("first"), second = newStudy("second");
    mustRun(QStringList{"replay", first} + writeScripts("export", 1));
    mustRun({"export", first, "--out", path("scripts"), "--format", "script"});
    mustRun({"replay", second, path("scripts/S01.json")});
    QCOMPARE(exportedRows(second), exportedRows(first));
}

/// answers.csv, as it was exported and as a German spreadsheet saves it.
void MainJobTest::theReportOfAnExportHasTheSameNumbers()
{
    mustRun({"report", m_study, "--out", path("report-of-study"), "--page-only"});
    mustRun({"export", m_study, "--out", path("exported")});
    std::ifstream in(path("exported/answers.csv").toStdString());
    std::string german((std::istreambuf_iterator<char>(in)), {});
    // No cell of these answers holds a comma or a point but lists of alternatives, which are quoted, and numbers.
    bool inQuotes = false;
    for (char& c : german) {
        if (c == '"') inQuotes = !inQuotes;
        if (!inQuotes) c = c == ',' ? ';' : c == '.' ? ',' : c;
    }
    writeText(path("german.csv"), german);
    const auto expected = readJson(path("report-of-study/results.json"));
    for (const QString& file : {path("exported/answers.csv"), path("german.csv")}) {
        const auto said = mustRun(
            {"report", "--from", file, "--protocol", m_study + "/protocol.json", "--out", path("report-of-file"), "--page-only"});
        QVERIFY2(said.err.contains("not analysed"), qPrintable(said.err));
        const auto found = readJson(path("report-of-file/results.json"));
        for (const char* part : {"conditions", "questions", "comparisons", "equivalence", "claims", "speed_accuracy"})
            QCOMPARE(QString::fromStdString(found[part].dump(1)), QString::fromStdString(expected[part].dump(1)));
    }
}

/// Every column of the tables is explained, and what could name a person or a day is left out.
void MainJobTest::aPublicExportHasNoDaysNotesOrWords()
{
    QVERIFY(runProgram({"export", newStudy("unpublished"), "--public", "--out", path("blinded-public")})
                .err.contains("cannot be published"));
    const QString study = m_study;  // an earlier test unblinded it
    mustRun({"export", study, "--public", "--author", "A. \"B\" C", "--out", path("public")});
    mustRun({"export", study, "--out", path("exported")});
    const auto columnsOf = [&](const QString& file) {
        return protocols::readForeignTable(path(file).toStdString()).table.columns;
    };
    const auto open = columnsOf("public/answers.csv"), whole = columnsOf("exported/answers.csv");
    for (const std::string& column : whole) {
        const bool isPrivate = column == "wall_time" || column == "note";
        QCOMPARE(std::find(open.begin(), open.end(), column) == open.end(), isPrivate);
    }
    for (const QString& folder : {QString("public/"), QString("exported/")})
        for (const QString& file : {QString("answers.csv"), QString("participants.csv")}) {
            const auto codebook = protocols::readForeignTable(path(folder + "codebook.csv").toStdString()).table;
            std::vector<std::string> explained;
            for (const auto& row : codebook.rows)
                if (row[0] == file.toStdString()) explained.push_back(row[1]);
            QCOMPARE(explained, columnsOf(folder + file));
        }
    // The raw clock runs since the computer was started, so that it would tell days.
    const auto answers = protocols::readForeignTable(path("public/answers.csv").toStdString()).table;
    const auto cellOf = [&](const std::vector<std::string>& row, const char* name) {
        return row[static_cast<std::size_t>(std::ranges::find(answers.columns, name) - answers.columns.begin())];
    };
    std::map<std::string, long long> began;
    for (const auto& row : answers.rows) {
        const long long ready = std::stoll(cellOf(row, "ready_at"));
        QVERIFY(std::stoll(cellOf(row, "answered_at")) >= ready);
        const auto [first, isNew] = began.try_emplace(cellOf(row, "participant") + "/" + cellOf(row, "sitting"), ready);
        if (!isNew) first->second = std::min(first->second, ready);
    }
    QVERIFY(!began.empty());
    for (const auto& [sitting, first] : began) QCOMPARE(first, 0);
    std::ifstream citation(path("public/CITATION.cff").toStdString());
    const std::string text{std::istreambuf_iterator<char>(citation), {}};
    QVERIFY(text.find("  - name: \"A. \\\"B\\\" C\"\n") != std::string::npos);
    QVERIFY(QFile::exists(path("public/LICENSE.txt")) && !QFile::exists(path("exported/LICENSE.txt")));
    QVERIFY(runProgram({"export", study, "--public", "--out", path("exported")}).err.contains("a folder of its own"));
    QCOMPARE(runProgram({"export", study, "--public", "--licence", "my own", "--out", path("p2")}).exitCode, 2);
}

QTEST_MAIN(MainJobTest)
#include "main_job_test.moc"
