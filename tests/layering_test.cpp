// Includes point downwards only. A table lists for each folder which files it may include.
#include <QDir>
#include <QDirIterator>
#include <QFile>
#include <QMap>
#include <QRegularExpression>
#include <QSet>
#include <QTest>

namespace {

/// A folder, its contents, and the prefixes of our own files that it may include.
struct Room {
    QString folder;
    QString contents;
    QStringList mayInclude;
    bool qt = false;
};

/// The permitted includes. The longest matching folder applies to a file. Files of one folder may include each other.
const QList<Room>& rooms()
{
    static const QList<Room> table{
        {"protocols/process/",
         "the whole process: who may open new files, how memory is kept, which files it opens, the name of its computer",
         {}},
        {"protocols/files/",
         "the ground floor: errors, whole files, CSV, strict and stored JSON, SHA-256",
         {"protocols/process/"}},
        {"protocols/files/foreign/", "tables of other programs: encoding, separator, decimal mark", {"protocols/files/"}},
        {"protocols/texts/", "the texts that are built into the program, the editions of protocols", {}},
        {"protocols/secrets/", "secrets and seals: derived keys, authenticated encryption, passphrases", {"protocols/files/"}},
        {"protocols/",
         "the words of a study: ids, conditions, protocols, the seeded generator",
         {"protocols/files/", "protocols/secrets/", "protocols/texts/"}},
        {"protocols/orders/",
         "what is drawn for a study: running orders, trays, additional trials, the allocation key",
         {"protocols/"}},
        {"protocols/records/", "what is kept of an allocation: the texts of the keys, the balance", {"protocols/"}},
        {"stats/kernels/", "sums, moments, ranks, tail probabilities, matrices; the value that may be undefined", {}},
        {"stats/metrics/", "measures of images and traces", {"stats/kernels/"}},
        {"stats/tests/", "tests and intervals, one result struct each", {"stats/kernels/"}},
        {"stats/models/", "mixed models, psychometric functions", {"stats/kernels/"}},
        {"stats/anova/", "analyses of variance of two factors", {"stats/kernels/", "stats/tests/", "stats/models/factor.h"}},
        {"stats/claims/",
         "what is claimed of conditions, for these fabrics and for fabrics like these",
         {"stats/kernels/", "stats/tests/", "stats/models/"}},
        {"stats/power/",
         "power, simulated studies, measured sizes",
         {"stats/kernels/", "stats/tests/", "stats/models/", "stats/claims/"}},
        {"rendering/images/", "image and height-map files", {"protocols/files/"}},
        {"rendering/cache/",
         "results that later runs use again, by the hash of their inputs",
         {"protocols/files/", "protocols/json_count.h"}},
        {"rendering/fabrics/", "data sets: reader, checker, splits", {"rendering/images/", "protocols/"}},
        {"rendering/fabrics/procedural/",
         "procedural fabrics, simulated sensor and friction rig",
         {"rendering/fabrics/", "rendering/images/", "protocols/", "stats/kernels/"}},
        {"rendering/fabrics/drawn/",
         "fabrics without end: constructions drawn from a seed, their photographs and friction",
         {"rendering/fabrics/procedural/", "rendering/fabrics/", "rendering/images/", "protocols/", "stats/kernels/"}},
        {"rendering/fabrics/recordings/",
         "importers of real recordings",
         {"rendering/fabrics/", "rendering/images/", "protocols/"}},
        {"rendering/signals/",
         "grey, integration, shape from shading, spectrogram, friction trace",
         {"rendering/signals/gaps/", "rendering/fabrics/dataset.h", "rendering/fabrics/friction_record.h", "rendering/images/",
          "stats/kernels/vector_clones.h", "protocols/"}},
        {"rendering/signals/gaps/", "the multigrid cycle of surfaces with gaps", {}},
        {"rendering/signals/tactile/",
         "calibration of a tactile sensor, photometric stereo",
         {"rendering/signals/", "rendering/fabrics/dataset.h", "rendering/images/", "protocols/"}},
        {"rendering/scans/",
         "importer of scanned materials: names, scale, normal maps, relighting, patches",
         {"rendering/signals/", "rendering/fabrics/", "rendering/images/", "protocols/"}},
        {"rendering/models/",
         "what asks for generated signals, without libtorch",
         {"rendering/models/process/", "rendering/models/tensors/", "rendering/cache/", "rendering/signals/",
          "rendering/fabrics/", "rendering/images/", "protocols/"}},
        {"rendering/models/cloth/",
         "whether a photograph shows cloth",
         {"rendering/models/model_card.h", "rendering/fabrics/", "stats/kernels/", "protocols/"}},
        {"rendering/models/process/", "child processes with limits: vis2hap-nn, and programs of a lab", {"protocols/"}},
        {"rendering/models/tensors/", "files of plain tensors: weights and checkpoints", {"protocols/files/"}},
        {"rendering/models/seeing/",
         "the networks that see any cloth, and what all networks need of libtorch",
         {"rendering/models/", "rendering/signals/", "rendering/fabrics/", "rendering/images/", "protocols/"}},
        {"rendering/models/lab/",
         "the adaptation of networks that see to a laboratory's own cloth",
         {"rendering/models/", "rendering/signals/", "rendering/fabrics/", "rendering/images/", "protocols/"}},
        {"rendering/models/networks/",
         "the networks of the paper, their training and use; besides `rendering/models/seeing/` and `rendering/models/lab/` the "
         "only place that includes libtorch",
         {"rendering/models/", "rendering/signals/", "rendering/fabrics/", "rendering/images/", "protocols/"}},
        {"rendering/response/",
         "the friction of a display by grey level: table, fit, file, levels",
         {"stats/kernels/", "protocols/"}},
        {"rendering/composition/",
         "conditions to signals to friction images",
         {"rendering/models/generation.h", "rendering/models/kept_generation.h", "rendering/models/preset.h",
          "rendering/models/preset_trade.h", "rendering/models/cloth/", "rendering/cache/", "rendering/response/",
          "rendering/signals/", "rendering/fabrics/", "rendering/images/", "protocols/"}},
        {"rendering/display/drivers/", "small drivers to copy, in C++ and Python; they use nothing but their language", {}},
        {"rendering/display/",
         "displays, their drivers, the stimulus bank, the simulated finger",
         {"rendering/composition/friction_image.h", "rendering/images/", "protocols/"}},
        {"database/disk/",
         "names of a study's files; the lock of its folder; whether open files are in place, and a copy of what they held; texts "
         "that may be altered; the station key; the note of a study on a server; how an upgrade is called",
         {"protocols/finger_sample.h", "protocols/files/", "protocols/process/", "protocols/secrets/"}},
        {"database/",
         "`study.db`, the append-only log, rescue files, keys and unblinding",
         {"database/disk/", "database/disk/server_note.h", "database/server/study_move.h", "protocols/"},
         true},
        {"database/upgrade/",
         "studies of earlier versions: their rows, and the steps that bring them to the present schema",
         {"database/", "protocols/"},
         true},
        {"database/server/",
         "a study on a PostgreSQL server that stations share: moves, roles, the store of a station and its queue",
         {"database/server/", "database/", "database/disk/", "database/evidence/", "protocols/"},
         true},
        {"database/evidence/",
         "the chain of exports, backups and reports; what evidence shows of the log",
         {"database/", "protocols/"},
         true},
        {"reports/text/", "numbers, words, labels and headings as text", {"stats/kernels/value.h", "protocols/"}},
        {"reports/data/", "what a report is made from", {"reports/text/", "stats/kernels/value.h", "protocols/"}},
        {"reports/cells/", "the answers sorted for every analysis", {"reports/data/", "reports/text/", "stats/", "protocols/"}},
        {"reports/analysis/",
         "everything that the report computes, as one value",
         {"reports/cells/", "reports/data/", "reports/text/", "stats/", "protocols/"}},
        {"reports/json/",
         "`results.json` and `statistics.json`; the only place of the report that knows JSON",
         {"reports/analysis/", "reports/data/", "reports/text/", "stats/", "protocols/"}},
        {"reports/charts/", "drawings and the frame of a plot", {"reports/text/", "stats/kernels/value.h", "protocols/"}},
        {"reports/formats/",
         "a table as a value, its cells, and its forms as text, CSV, HTML and TeX",
         {"reports/text/", "stats/kernels/value.h", "protocols/"}},
        {"reports/tables/",
         "the tables",
         {"reports/formats/", "reports/analysis/", "reports/data/", "reports/text/", "stats/", "protocols/"}},
        {"reports/figures/",
         "the figures",
         {"reports/charts/", "reports/analysis/", "reports/data/", "reports/text/", "stats/kernels/value.h", "protocols/"}},
        {"reports/scripts/",
         "the main tables for other programs: answers, numbers, codebook, scripts in R and Python",
         {"reports/analysis/", "reports/cells/", "reports/data/", "protocols/"}},
        {"reports/documents/",
         "further forms of a report: PDF, LaTeX, text document",
         {"reports/page/", "reports/formats/", "reports/tables/", "reports/figures/", "reports/text/", "reports/write_report.h",
          "protocols/"},
         true},
        {"reports/page/",
         "the page: sections, findings, methods",
         {"reports/formats/", "reports/tables/", "reports/figures/", "reports/analysis/", "reports/cells/", "reports/data/",
          "reports/text/", "stats/kernels/value.h", "protocols/"}},
        {"reports/", "the files of a report", {"reports/", "stats/", "protocols/"}, true},
        {"study/session/",
         "the session as a pure state machine, and its driver",
         {"database/session_store.h", "database/study_store.h", "database/disk/station_key.h", "database/server/station_store.h",
          "rendering/display/display.h", "rendering/display/stimulus_bank.h", "protocols/"},
         true},
        {"study/participant/", "what the participant sees on a screen of their own, and who may see it", {"protocols/"}},
        {"study/participant/session/",
         "the participant's part of a session: from view to instruction, from act to event",
         {"study/participant/", "study/session/", "protocols/"}},
        {"study/participant/programs/",
         "what the programs beside the app share: their input, and how they end",
         {"study/participant/page_lines.h", "protocols/files/"},
         true},
        {"study/participant/page/", "the program that serves it to a browser", {"study/participant/", "protocols/files/"}, true},
        {"study/participant/sound/",
         "the program that plays noise, recordings and speech",
         {"study/participant/programs/", "protocols/files/", "protocols/secrets/"},
         true},
        {"study/app/drafts/", "a protocol that is being written, as a value", {"protocols/"}},
        {"study/app/language/", "the language of the window: catalogues, fonts, sentences from below", {"protocols/"}, true},
        {"study/app/state/",
         "what the window holds: the open study, the running session, settings",
         {"study/app/language/", "study/app/drafts/", "study/session/", "database/study_store.h", "database/disk/study_folder.h",
          "database/server/", "database/evidence/operator_latency.h", "rendering/display/display.h",
          "rendering/display/stimulus_bank.h", "rendering/display/test_patterns.h", "protocols/"},
         true},
        {"study/app/monitoring/",
         "how the monitor reads a study: flags, and the progress of a study on a server, on threads of their own",
         {"study/app/language/", "study/app/state/", "study/session/", "database/study_store.h", "database/disk/server_note.h",
          "database/server/", "protocols/"},
         true},
        {"study/app/pieces/",
         "widgets that pages are made of",
         {"study/app/language/", "study/app/state/", "study/session/", "protocols/"},
         true},
        {"study/app/pages/tools/",
         "the page of the work around the sessions",
         {"study/app/language/", "study/app/pieces/", "study/app/state/"},
         true},
        {"study/app/pages/photographs/",
         "the page that makes a data set from photographs",
         {"study/app/language/", "study/app/pieces/", "study/app/state/", "protocols/"},
         true},
        {"study/app/pages/",
         "the pages",
         {"study/app/language/", "study/app/monitoring/", "study/app/pieces/", "study/app/state/", "study/participant/",
          "study/session/", "protocols/"},
         true},
        {"study/app/pages/editor/",
         "the page that makes and changes protocols",
         {"study/app/language/", "study/app/pages/stage_page.h", "study/app/pages/stage_stack.h", "study/app/participant/",
          "study/app/pieces/", "study/app/state/", "study/app/drafts/", "study/participant/", "study/session/", "protocols/"},
         true},
        {"study/app/pages/setup/",
         "pages that prepare the room before a session",
         {"study/app/language/", "study/app/pages/stage_page.h", "study/app/participant/", "study/app/pieces/",
          "study/app/state/", "study/session/", "protocols/"},
         true},
        {"study/app/participant/",
         "the participant's screen, as the console holds it",
         {"study/app/language/", "study/app/pieces/", "study/app/state/rating_text.h", "study/participant/", "protocols/"},
         true},
        {"study/app/",
         "the window, and the hands that drive it",
         {"study/app/", "study/participant/", "study/session/", "protocols/"},
         true},
        {"study/looking/",
         "signals as pictures",
         {"database/study_store.h", "rendering/", "protocols/", "study/app/state/data_look.h"},
         true},
        {"study/photographs/",
         "a data set made from photographs, step by step",
         {"study/looking/", "rendering/", "protocols/", "study/app/state/photograph_steps.h"},
         true},
        {"study/measuring/", "heights and calibrations from tactile frames", {"rendering/", "protocols/"}},
        {"study/evaluation/", "generated against measured signals", {"rendering/", "stats/", "protocols/"}},
        {"study/evaluation/left_out/",
         "models that did not see one fabric each, and what they reach on it",
         {"study/evaluation/", "rendering/", "stats/", "protocols/"}},
        {"study/analyse/",
         "the statistics by name, for scripts",
         {"rendering/images/", "rendering/signals/", "stats/", "protocols/"}},
        {"study/analyse/power/", "what a planned study can detect", {"study/analyse/", "stats/", "protocols/"}},
        {"study/shards/", "what one of several processes computed of a run", {"stats/kernels/share.h", "protocols/files/"}},
        {"study/leaks/", "attacks on a blinded study: what each role could learn", {"database/", "stats/", "protocols/"}, true},
        {"study/records/",
         "a stored study as reports, status and export see it",
         {"study/session/", "reports/", "database/", "rendering/display/stimulus_bank.h", "stats/", "protocols/"},
         true},
        {"study/records/evidence/",
         "what a study gives away as evidence: its log, the data of one person, the data sheet, signed heads",
         {"study/records/", "database/", "protocols/"},
         true},
        {"study/exports/",
         "the files of an export: tables, codebook, licence, citation",
         {"study/records/", "study/players/", "reports/", "database/", "protocols/"}},
        {"study/making/",
         "a new study from protocol and data set, and its registered plan",
         {"study/making/own/", "study/records/", "study/analyse/", "study/evaluation/", "study/participant/sound/",
          "study/players/percept.h", "study/session/clock.h", "reports/", "database/", "rendering/", "stats/", "protocols/"},
         true},
        {"study/making/own/",
         "images of conditions that a lab adds: ready ones, and those that its programs make",
         {"rendering/", "protocols/"}},
        {"study/players/",
         "scripted and simulated participants",
         {"study/records/", "study/session/", "database/", "rendering/", "protocols/"},
         true},
        {"study/simulation/",
         "studies of simulated participants, in memory or through the store",
         {"study/players/", "study/session/", "reports/", "database/", "rendering/", "stats/", "protocols/"},
         true},
        {"study/bench/",
         "speed beside error",
         {"study/app/", "study/session/", "study/simulation/", "study/looking/", "study/measuring/", "reports/", "database/",
          "rendering/", "stats/", "protocols/"},
         true},
        {"study/bench/extremes/",
         "extreme inputs beside their known results",
         {"study/bench/", "reports/", "database/", "rendering/", "stats/", "protocols/"}},
        {"study/commands/",
         "one file a command",
         {"study/", "reports/", "database/", "rendering/", "stats/", "protocols/"},
         true},
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
        if (isOurs(include) && !include.mid(room->folder.size()).contains('/') && include.startsWith(room->folder)) continue;
        if (isOurs(include) && std::none_of(room->mayInclude.begin(), room->mayInclude.end(), allows))
            faults << file + " includes " + include;
    }
    static const QRegularExpression system("^\\s*#\\s*include\\s*<([^>]+)>", QRegularExpression::MultilineOption);
    for (auto it = system.globalMatch(text); it.hasNext();) {
        const QString include = it.next().captured(1);
        static const QRegularExpression qtHeader("^Q[A-Z]|^Qt");
        if (!room->qt && include.contains(qtHeader)) faults << file + " includes Qt's " + include;
        const bool torch = include.startsWith("torch/") || include.startsWith("ATen/") || include.startsWith("c10/");
        const bool ofNetworks = file.startsWith("rendering/models/networks/") || file.startsWith("rendering/models/seeing/") ||
                                file.startsWith("rendering/models/lab/");
        if (torch && !ofNetworks) faults << file + " includes torch's " + include;
        const bool jsonInReports = include.startsWith("nlohmann/") && file.startsWith("reports/");
        if (jsonInReports && !file.startsWith("reports/json/")) faults << file + " includes " + include;
    }
    return faults;
}

/// The folders that include each other in a circle; empty if there is none. Folders that include no remaining folder are removed
/// until none is left.
QStringList foldersInCircles(const QMap<QString, QString>& sources)
{
    static const QRegularExpression quoted("^\\s*#\\s*include\\s*[\"]([^\"]+)/[^\"/]+[\"]", QRegularExpression::MultilineOption);
    QMap<QString, QSet<QString>> includes;
    for (auto it = sources.begin(); it != sources.end(); ++it) {
        const QString folder = it.key().section('/', 0, -2);
        auto& below = includes[folder];
        for (auto match = quoted.globalMatch(it.value()); match.hasNext();) below << match.next().captured(1);
        below.remove(folder);
    }
    for (bool goesOn = true; goesOn;) {
        goesOn = false;
        for (const QString& folder : includes.keys()) {
            const auto isLeft = [&](const QString& other) { return includes.contains(other); };
            if (std::any_of(includes[folder].begin(), includes[folder].end(), isLeft)) continue;
            includes.remove(folder);
            goesOn = true;
        }
    }
    return includes.keys();
}

/// Session, app and looking must not even name a type that reveals a condition.
QStringList blindingFaults(const QString& file, const QString& text)
{
    const bool isBlinded =
        file.startsWith("study/session/") || file.startsWith("study/app/") || file.startsWith("study/looking/");
    if (!isBlinded) return {};
    QStringList faults;
    static const QRegularExpression keys("\\b(AllocationKey|readAllocationKey\\w*|readKeyForAggregates|Unblinded)\\b");
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

/// A row of the table in CONTRIBUTING.md.
QString rowOf(const Room& room)
{
    QStringList below;
    for (const QString& prefix : room.mayInclude) below << '`' + prefix + '`';
    return QString("| `%1` | %2 | %3%4 |")
        .arg(room.folder, room.contents, below.isEmpty() ? QString("nothing of ours") : below.join(", "), room.qt ? ", Qt" : "");
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

    void noFoldersIncludeEachOther()
    {
        QCOMPARE(foldersInCircles(m_sources), QStringList());
        const QMap<QString, QString> circle{
            {"a/x.cpp", "#include \"b/y.h\"\n"}, {"b/y.h", "#include \"a/c/z.h\"\n"}, {"a/c/z.h", "#include \"a/x.h\"\n"}};
        QCOMPARE(foldersInCircles(circle), (QStringList{"a", "a/c", "b"}));
    }

    void contributingShowsThisTable()
    {
        QFile guide(QDir(VIS2HAP_SOURCE_DIR).filePath("CONTRIBUTING.md"));
        QVERIFY(guide.open(QIODevice::ReadOnly));
        const QString text = QString::fromUtf8(guide.readAll());
        for (const Room& room : rooms()) QVERIFY2(text.contains(rowOf(room) + '\n'), qPrintable("missing: " + rowOf(room)));
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
            if (path.startsWith("build") || path == "rendering/CMakeLists.txt") continue;
            QFile file(files.filePath());
            QVERIFY(file.open(QIODevice::ReadOnly));
            QVERIFY2(!file.readAll().contains("TORCH_LIBRARIES"), qPrintable(path));
        }
    }

    void forbiddenArrowsAreSeen_data()
    {
        QTest::addColumn<QString>("file");
        QTest::addColumn<QString>("text");
        QTest::newRow("stats knows nobody") << "stats/a.cpp"
                                            << "#include \"protocols/errors.h\"\n";
        QTest::newRow("protocols without Qt") << "protocols/a.cpp"
                                              << "#include <QString>\n";
        QTest::newRow("signals without Qt") << "rendering/signals/a.h"
                                            << "#pragma once\n#include <QtGlobal>\n";
        QTest::newRow("rendering below database") << "rendering/display/a.cpp"
                                                  << "#include \"database/study_store.h\"\n";
        QTest::newRow("reports without database") << "reports/a.cpp"
                                                  << "#include \"database/keys.h\"\n";
        QTest::newRow("session without widgets of the app") << "study/session/a.cpp"
                                                            << "#include \"study/app/page.h\"\n";
        QTest::newRow("session without keys") << "study/session/a.cpp"
                                              << "#include \"database/keys.h\"\n";
        QTest::newRow("app without keys") << "study/app/a.cpp"
                                          << "#include \"database/keys.h\"\n";
        QTest::newRow("looking without keys") << "study/looking/a.cpp"
                                              << "#include \"database/keys.h\"\n";
        QTest::newRow("evaluation without commands") << "study/evaluation/a.cpp"
                                                     << "#include \"study/commands/parts/progress.h\"\n";
        QTest::newRow("evaluation without Qt") << "study/evaluation/a.cpp"
                                               << "#include <QString>\n";
        QTest::newRow("app without signals") << "study/app/a.cpp"
                                             << "#include \"study/looking/sheet.h\"\n";
        QTest::newRow("app without friction images") << "study/app/a.cpp"
                                                     << "#include \"rendering/composition/friction_image.h\"\n";
        QTest::newRow("torch outside the models") << "rendering/models/a.cpp"
                                                  << "#include <torch/torch.h>\n";
        QTest::newRow("JSON of reports at its border only") << "reports/tables/a.cpp"
                                                            << "#include <nlohmann/json.hpp>\n";
        QTest::newRow("analysis without tables") << "reports/analysis/a.cpp"
                                                 << "#include \"reports/formats/report_table.h\"\n";
        QTest::newRow("room that is not in the table") << "extras/a.cpp"
                                                       << "";
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
        const QString remarks = QString("%1 no Unblinded here\nint x; %2* nor an\nAllocationKey *%2").arg("//", "/");
        QCOMPARE(blindingFaults("study/session/a.h", remarks).size(), 0);
        QCOMPARE(blindingFaults("study/commands/a.cpp", "protocols::AllocationKey key;").size(), 0);
    }

private:
    QMap<QString, QString> m_sources = sources();
};

QTEST_GUILESS_MAIN(LayeringTest)
#include "layering_test.moc"
