// The leak check finds nothing in studies of the paper's size, and finds every leak that is planted in them.
#include <sys/stat.h>

#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "database/keys.h"
#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"
#include "protocols/protocol_json.h"
#include "study/leaks/leak_text.h"
#include "study/leaks/seen_study.h"
#include "study/leaks/text_table.h"
#include "study/players/session_script.h"
#include "study/records/blinded_report.h"
#include "study/records/evidence/exported_log.h"
#include "study/records/evidence/participant_data.h"
#include "study/records/folder_audit.h"
#include "tests/support/error_text.h"
#include "tests/support/played_session.h"
#include "tests/support/program.h"
#include "tests/support/raw_sqlite.h"
#include "tests/support/study_builder.h"

using namespace study::leaks;
using namespace tests::support;

namespace {

namespace fs = std::filesystem;

/// A secret that nobody tries.
constexpr std::uint64_t secretSeeds[] = {0x51ab3e6f0c24d987, 0x7e0d92c4418fb365, 0x2f86a1d95be73c08, 0xc4907fe31d52ab6e,
                                         0x98d3016b7cfae542};

void closeToOthers(const fs::path& study)
{
    fs::permissions(study, fs::perms::owner_all);
    for (const auto& entry : fs::recursive_directory_iterator(study))
        fs::permissions(entry.path(),
                        entry.is_directory() ? fs::perms::owner_all : fs::perms::owner_read | fs::perms::owner_write);
}

/// A study of the paper with images of 16 x 10 pixels. Where no session is played, the key leaves the folder instead of being
/// sealed: a passphrase costs half a second.
struct PaperStudy {
    explicit PaperStudy(std::uint64_t designSeed, std::uint64_t keySeed, int sessions = 0)
    {
        StudyRecipe recipe;
        recipe.fabrics = 7;
        recipe.protocol = std::string(protocols::paperProtocolJson());
        recipe.designSeed = designSeed;
        recipe.keySeed = keySeed;
        recipe.hasSwatchCodes = true;
        if (sessions > 0) recipe.passphrase = "four words of wool";
        folder = buildStudy(fs::path(temporary.path().toStdString()) / "study", recipe);
        key = readAllocationKeyForTestDriver(store(), database::ParticipantKind::Scripted, [&] { return recipe.passphrase; });
        fs::remove(folder.allocationKey());
        for (int number = 1; number <= sessions; ++number) OpenSession(folder, "S" + std::to_string(number)).playToEnd();
        closeToOthers(folder.folder);
    }

    database::StudyStore store() const { return {folder, database::StudyStore::Access::Read}; }

    /// What the trial shows.
    const protocols::AllocationKey::Entry& shown(const protocols::BlindedTrial& trial) const { return key.entryOf(trial); }

    /// A new table with a text beside each trial.
    void plant(const std::function<std::string(const protocols::BlindedTrial&, protocols::Random&)>& textOf) const
    {
        RawSqlite sqlite(folder.database());
        QCOMPARE(sqlite.run("CREATE TABLE planted(slot INTEGER, number INTEGER, text TEXT); BEGIN"), "");
        protocols::Random random(3);
        const auto open = store();
        for (const auto& slot : open.slots())
            for (const auto& trial : open.trials(slot.number))
                QCOMPARE(sqlite.run("INSERT INTO planted VALUES(" + std::to_string(slot.number) + ", " +
                                    std::to_string(trial.number.value) + ", '" + textOf(trial, random) + "')"),
                         "");
        QCOMPARE(sqlite.run("COMMIT"), "");
    }

    LeakReport check(const std::vector<Exporter>& exporters = {}) const { return leakReport(store(), key, exporters); }

    QTemporaryDir temporary;
    database::StudyFolder folder;
    protocols::AllocationKey key;
};

std::vector<Exporter> exportersOf(const database::StudyStore& store)
{
    return {{"script", [&store](const auto& out) { study::players::writeScripts(store, nullptr, out); }},
            {"report",
             [&store](const auto& out) { reports::writeProgressReport(study::records::blindedReport(store), out / "report"); }},
            {"log", [&store](const auto& out) { study::records::writeExportedLog(store, out); }},
            {"people", [&store](const auto& out) { study::records::writeEveryParticipant(store, out); }}};
}

bool finds(const LeakReport& report, const std::string& attack, const std::string& target)
{
    const auto above = report.aboveChance();
    return std::ranges::any_of(
        above, [&](const Guess* guess) { return guess->attack.find(attack) != std::string::npos && guess->target == target; });
}

/// The attack on a new study, whose key the folder does not hold.
LeakReport reportOf(StudyRecipe recipe)
{
    const QTemporaryDir temporary;
    recipe.keySeed = secretSeeds[0];
    const auto folder = buildStudy(fs::path(temporary.path().toStdString()) / "study", recipe);
    const database::StudyStore store(folder, database::StudyStore::Access::Read);
    const auto key = readAllocationKeyForTestDriver(store, database::ParticipantKind::Scripted, {});
    fs::remove(folder.allocationKey());
    closeToOthers(folder.folder);
    return leakReport(store, key, {});
}

void show(const LeakReport& report) { std::printf("%s", textOf(report).c_str()); }

}  // namespace

class LeakCheckTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void studiesOfThePaperLeakNothing_data()
    {
        QTest::addColumn<int>("seed");
        for (int seed = 0; seed < 5; ++seed) QTest::addRow("seed %d", seed + 1) << seed;
    }

    /// 630 choice trials each. All sessions are played, so that the log and the times are full.
    void studiesOfThePaperLeakNothing()
    {
        QFETCH(const int, seed);
        const PaperStudy study(static_cast<std::uint64_t>(seed) + 1, secretSeeds[seed], 10);
        const auto store = study.store();
        const auto report = study.check(exportersOf(store));
        if (seed == 0 || !report.learnsNothing()) show(report);
        QCOMPARE(report.choices, std::size_t{630});
        QVERIFY(report.guesses.size() > 300);
        QVERIFY(report.aboveChance().empty());
        QCOMPARE(report.findings, std::vector<std::string>());
        QVERIFY(report.learnsNothing());
        // The station key names every piece, as the README says.
        QCOMPARE(report.stationKey.hits, std::size_t{630});
        QCOMPARE(report.stationKey.images, std::size_t{63});
    }

    /// A good participant names true pieces, and that is no leak. The log holds the answers, too, and times lead to it.
    void whatParticipantsAnsweredIsNoAttack()
    {
        const PaperStudy study(1, secretSeeds[0], 1);
        const auto tables = tablesOfDatabase(study.folder.database());
        const auto features = featuresOf(seenStudy(tables), tables, study.folder.database());
        QVERIFY(std::ranges::any_of(features, [](const Feature& one) { return one.name.ends_with("events.wall_time: kind"); }));
        for (const Feature& feature : features)
            for (const std::string& value : feature.values)
                QVERIFY2(!value.starts_with("{\"fabric\"") && !value.starts_with("{\"tenths\""), feature.name.c_str());
    }

    /// Each column of such a table would be a guesser, whose hits tell whether its guess was right.
    void tablesThatSomebodyMadeUpAreNotRead()
    {
        const PaperStudy study(1, secretSeeds[0]);
        std::ofstream(study.folder.folder / "sitting-7.csv") << "presentation_code,a\nX,1\n";
        const auto store = study.store();
        const auto unknownFiles = study::records::findingsInFolder(store).unknownFiles;
        QCOMPARE(unknownFiles, std::vector<std::filesystem::path>{"sitting-7.csv"});
        const auto report = leakReport(store, study.key, {}, {}, unknownFiles);
        QVERIFY(!report.learnsNothing() && report.findings.size() == 1);
        QVERIFY(report.findings.front().starts_with("sitting-7.csv does not belong to the study and was not read"));
        for (const Guess& guess : report.guesses) QVERIFY(guess.what.find("sitting-7") == std::string::npos);
        QVERIFY(jsonOf(report)["guessers"].size() < 60);
    }

    void equalCodesOfEqualRenderingsAreFound()
    {
        const PaperStudy study(1, secretSeeds[0]);
        const auto stationKey = stationKeyOf(study.key.secret);
        study.plant([&](const auto& trial, auto&) { return opened(trial.sealedCode, stationKey).value; });
        const auto report = study.check();
        QVERIFY(finds(report, "equal values: a rating trial", "true piece"));
        QVERIFY(std::ranges::any_of(report.guesses, [](const Guess& guess) {
            return guess.attack == "equal values: a rating trial" && guess.hits == 630;  // as in 0.5.0
        }));
        QVERIFY(finds(report, "learned condition", "condition"));
        QVERIFY(!report.learnsNothing());
    }

    void partsThatRenderingsShareAreFound()
    {
        const PaperStudy study(1, secretSeeds[0]);
        const auto stationKey = stationKeyOf(study.key.secret);
        study.plant([&](const auto& trial, auto& random) {
            const std::string code = opened(trial.sealedCode, stationKey).value;
            return std::to_string(random.below(100'000'000) + 100'000'000) + code.substr(0, 5) + std::to_string(random.below(9));
        });
        const auto report = study.check();
        QVERIFY(finds(report, "nearest by letters", "true piece"));
        QVERIFY(finds(report, "all letters together", "true piece"));
    }

    void timesOfTheImagesAreFound()
    {
        const PaperStudy study(1, secretSeeds[0]);
        const auto stationKey = stationKeyOf(study.key.secret);
        study.plant([&](const auto& trial, auto& random) {
            std::size_t time = 0;
            for (const char letter : opened(trial.sealedCode, stationKey).value)
                time = (time * 31 + static_cast<std::size_t>(letter)) % 1'000'003;
            return std::to_string(time * 100 + random.below(900));
        });
        QVERIFY(finds(study.check(), "nearest by order: a rating trial", "true piece"));
    }

    void aColumnOfUnknownLabelsIsFound()
    {
        const PaperStudy study(1, secretSeeds[0]);
        study.plant(
            [&](const auto& trial, auto&) { return "w" + std::to_string(study.shown(trial).label.value[1] * 7919 % 1013); });
        QVERIFY(finds(study.check(), "equal values: learned condition", "condition"));
    }

    void largeStudiesAreAttackedFromTheFirstToTheLastRunningOrder()
    {
        const PaperStudy study(1, secretSeeds[0]);
        const auto tables = tablesOfDatabase(study.folder.database());
        const auto slotsIn = [](const SeenStudy& seen) {
            std::set<int> slots;
            for (const auto& trial : seen.trials) slots.insert(trial.slot);
            return std::vector<int>(slots.begin(), slots.end());
        };
        const auto whole = seenStudy(tables), sample = seenStudy(tables, 600);
        QCOMPARE(whole.trials.size(), std::size_t{1260});
        QCOMPARE(slotsIn(sample), (std::vector<int>{1, 2, 9, 10}));
        QCOMPARE(sample.trials.size(), std::size_t{504});
        QCOMPARE(sample.trialsOfStudy, std::size_t{1260});
        QCOMPARE(sample.slotsOfStudy, std::size_t{10});
        QCOMPARE(slotsIn(seenStudy(tables, 800)), (std::vector<int>{1, 2, 5, 6, 9, 10}));
        QCOMPARE(slotsIn(seenStudy(tables, 1)), (std::vector<int>{1, 2}));
    }

    /// One third of the trials name their piece; the others hold a word drawn at random.
    void aColumnThatNamesSomePiecesIsFound()
    {
        const PaperStudy study(1, secretSeeds[0]);
        study.plant([&](const auto& trial, auto& random) {
            const auto& tray = trial.alternatives;
            return random.below(3) == 0 ? study.shown(trial).fabric.value : tray[random.below(tray.size())].value;
        });
        QVERIFY(finds(study.check(), "names a piece", "true piece"));
    }

    void theTrueSlotAsANumberIsFound()
    {
        const PaperStudy study(1, secretSeeds[0]);
        study.plant([&](const auto& trial, auto& random) {
            const auto slot = std::ranges::find(trial.alternatives, study.shown(trial).fabric) - trial.alternatives.begin();
            return std::to_string(random.below(1000) * trial.alternatives.size() + static_cast<std::size_t>(slot));
        });
        QVERIFY(finds(study.check(), "number modulo", "true piece"));
    }

    void filesOfOtherSizesAndContentsAreFound()
    {
        const PaperStudy study(1, secretSeeds[0]);
        for (const auto& [code, entry] : study.key.entries)
            if (entry.condition.value == "f")
                std::ofstream(study.folder.stimuli() / (code.value + ".sealed"), std::ios::app) << std::string(4000, 'a');
        const auto report = study.check();
        QVERIFY(std::ranges::find(report.findings, "the stimuli have 2 different sizes") != report.findings.end());
        QVERIFY(std::ranges::find(report.findings, "7 stimuli can be compressed: their content shows") != report.findings.end());
        QVERIFY(!report.learnsNothing());
    }

    /// The cache of signals is attacked like the study: signals by their hash are none of its secrets; finished images would be.
    void whatTheCacheOfSignalsTellsIsFound()
    {
        const PaperStudy study(1, secretSeeds[0]);
        const fs::path cache = study.folder.folder.parent_path() / "cache";
        fs::create_directory(cache);
        fs::permissions(cache, fs::perms::owner_all);
        const auto keep = [&](int place, std::size_t bytes, const std::string& name) {
            const auto file = cache / name;
            std::ofstream(file) << std::string(bytes, 'a');
            fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
            fs::last_write_time(file, fs::file_time_type::clock::now() + std::chrono::seconds(place));
        };
        const auto check = [&] { return leakReport(study.store(), study.key, {}, cache); };
        // Signals in the order of fabrics, as `study new` computes them.
        for (int place = 0; place < 70; ++place) keep(place, 1000 + 500 * (place % 5), std::to_string(1000 + place));
        QVERIFY(check().learnsNothing());
        // Finished images, compressed, in the order of the file codes.
        int place = 100;
        for (const auto& [code, entry] : study.key.entries) {
            keep(place, 1000 + 100 * std::hash<std::string>{}(entry.condition.value) % 5000, std::to_string(2000 + place));
            ++place;
        }
        QVERIFY(finds(check(), "nearest file", "condition of a file"));
        QVERIFY(!check().learnsNothing());
        fs::remove_all(cache);
        fs::create_directory(cache);
        fs::permissions(cache, fs::perms::all);
        keep(0, 10, "a");
        std::ofstream(cache / "a") << "{\"mean\":0.1" << study.store().trials(1).front().presentationCode.value << "7}";
        QVERIFY(check().findings.empty());  // digits of a longer number
        keep(0, 10, study.key.entries.begin()->first.value);
        const auto report = check();
        QCOMPARE(report.findings.size(), std::size_t{1});
        QVERIFY2(report.findings.front().starts_with("the cache of signals names a code"), report.findings.front().c_str());
        QCOMPARE(report.modes.size(), std::size_t{1});
    }

    void filesWrittenInTheOrderOfConditionsAreFound()
    {
        const PaperStudy study(1, secretSeeds[0]);
        std::vector<std::pair<std::string, fs::path>> files;
        for (const auto& [code, entry] : study.key.entries)
            files.emplace_back(entry.condition.value, study.folder.stimuli() / (code.value + ".sealed"));
        std::ranges::sort(files);
        for (const auto& [condition, file] : files) {
            QCOMPARE(::chmod(file.c_str(), 0600), 0);  // the time of the last change of its status is now
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        QVERIFY(finds(study.check(), "nearest file", "condition of a file"));
    }

    void exportsThatNameConditionsOrFabricsAreFound()
    {
        const PaperStudy study(1, secretSeeds[0], 1);
        const Exporter careless{"careless", [&](const fs::path& out) {
                                    std::ofstream csv(out / "answers.csv");
                                    csv << "participant,trial,fabric,condition,correct\n";
                                    const auto open = study.store();
                                    for (const auto& trial : open.trials(1))
                                        csv << "S1," << trial.number.value << ',' << study.shown(trial).fabric.value << ','
                                            << study.shown(trial).label.value << ",1\n";
                                }};
        const auto report = study.check({careless});
        QVERIFY(finds(report, "names a piece", "true piece"));
        QVERIFY(!report.findings.empty() && report.findings.front().starts_with("careless: answers.csv names correct, "));
    }

    void openFilesAndSmallSecretsAreFound()
    {
        const PaperStudy study(1, 2);
        fs::permissions(study.folder.protocol(), fs::perms::others_read, fs::perm_options::add);
        const auto report = study.check();
        QCOMPARE(report.modes, std::vector<std::string>{"protocol.json has mode 0604 (expected 0600)"});
        QCOMPARE(report.findings.size(), std::size_t{1});
        QVERIFY(report.findings.front().starts_with("the secret was drawn from the number 2 "));
        QVERIFY(!report.learnsNothing());
    }

    /// A file with thousands of different fields, and a view that never ends, must not stop the check.
    void filesAndViewsThatTakeForEverAreNotRead()
    {
        const PaperStudy study(1, secretSeeds[0]);
        std::string rows;
        for (int i = 0; i < 8000; ++i) rows += (i == 0 ? "" : ",") + ("{\"f" + std::to_string(i)) + "\":1}";
        protocols::writeWholeFile(study.folder.folder / "wide.json", "[" + rows + "]");
        protocols::writeWholeFile(study.folder.folder / "deep.json", std::string(200000, '[') + std::string(200000, ']'));
        QVERIFY(tablesOfFolder(study.folder.folder, {}, {"study.db", "stimuli"}).size() < 10);
        RawSqlite(study.folder.database())
            .run("CREATE VIEW endless AS WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT i FROM n");
        QVERIFY_THROWS_EXCEPTION(protocols::Error, tablesOfDatabase(study.folder.database()));
    }

    void missingFabricsAreNamed_data()
    {
        QTest::addColumn<QString>("sql");
        QTest::newRow("one") << "DELETE FROM fabrics WHERE position = 3";
        QTest::newRow("all") << "DELETE FROM fabrics";
    }
    void missingFabricsAreNamed()
    {
        QFETCH(const QString, sql);
        const PaperStudy study(1, secretSeeds[0]);
        RawSqlite raw(study.folder.database());
        raw.dropTriggers();
        QCOMPARE(raw.run("PRAGMA foreign_keys = 0; " + sql.toStdString()), "");
        const auto tables = tablesOfDatabase(study.folder.database());
        const QString said = errorOf([&] { featuresOf(seenStudy(tables), tables, study.folder.database()); });
        for (const char* part : {"1: ", "fabrics", "run vis2hap verify"}) QVERIFY2(said.contains(part), qPrintable(said));
    }

    void nothingIsCountedWithoutTheKey()
    {
        const PaperStudy study(1, secretSeeds[0]);
        const auto report = leakReport(study.store(), std::nullopt, {});
        QVERIFY(report.guesses.empty() && !report.learnsNothing());
        QVERIFY(jsonOf(report)["guessers"].is_null());
        QVERIFY(QString::fromStdString(textOf(report)).contains("hits cannot be counted"));
    }

    /// "Not above chance" is no news where even who knows everything would not stand out.
    void aVerdictOnFewTrialsSaysThatItSaysNothing()
    {
        StudyRecipe recipe;
        recipe.participants = 1;
        recipe.alternatives = 2;
        const auto report = reportOf(recipe);
        QVERIFY(report.power() && !report.power()->share);
        QVERIFY(report.findings.empty() && report.modes.empty() && report.aboveChance().empty());
        QVERIFY(report.isTooSmallToTell() && !report.learnsNothing());  // the exit code is not 0, either
        QVERIFY(QString::fromStdString(textOf(report)).contains("this verdict says nothing"));
        QCOMPARE(jsonOf(report)["why"]["least_share_found"], "too few trials");
    }

    void aVerdictOnFewRatingsSaysThatItSaysNothing()
    {
        StudyRecipe recipe;
        recipe.protocol =
            R"({"schema": "vis2hap.protocol/1", "name": "Ratings", "participants": 1, "fabrics": ["F01", "F02", "F03"],
 "conditions": ["f", "h&f"], "phases": [{"questions": ["Q2"], "scale": {"min": 0, "max": 10}}]})";
        const auto report = reportOf(recipe);
        QVERIFY(report.choices == 0 && report.findings.empty() && report.aboveChance().empty());
        QVERIFY(report.isTooSmallToTell() && !report.learnsNothing());
        QVERIFY(QString::fromStdString(textOf(report)).contains("this verdict says nothing"));
    }

    /// The program itself, with its own exports and a real passphrase.
    void theCommandPrintsTheVerdicts()
    {
        QTemporaryDir temporary;
        StudyRecipe recipe;
        recipe.fabrics = 7;
        recipe.protocol = std::string(protocols::paperProtocolJson());
        recipe.keySeed = secretSeeds[0];
        recipe.passphrase = "four words of wool";
        const auto folder = buildStudy(fs::path(temporary.path().toStdString()) / "study", recipe);
        closeToOthers(folder.folder);
        const auto word = fs::path(temporary.path().toStdString()) / "passphrase";
        protocols::writeWholeFile(word, "four words of wool\n");
        const auto run = support::runProgram({"leak-check", QString::fromStdString(folder.folder.string()), "--json",
                                              "--passphrase-file", QString::fromStdString(word.string())});
        const auto json = nlohmann::json::parse(run.out.toStdString());
        QVERIFY2(run.exitCode == 0, (json["verdicts"].dump() + json["findings"].dump()).c_str());
        QCOMPARE(json["schema"].get<std::string>(), "vis2hap.leak-check/1");
        QVERIFY(json["learns_nothing"].get<bool>());
        QVERIFY(json["guessers"].size() > 10 && json["guessers"][0]["guessers"] > 0);
        // Of 630 pieces a third is chance; some 2,500 guessers make the limit 5 standard errors higher.
        const double least = json["least_share_found"];
        QVERIFY2(least > 0.40 && least < 0.46, qPrintable(QString::number(least)));
        const auto text = support::runProgram({"leak-check", QString::fromStdString(folder.folder.string())});
        QCOMPARE(text.exitCode, 1);
        QVERIFY2(text.out.contains("hits cannot be counted"), qPrintable(text.out));
    }

    /// A date is no small number, and still a guess.
    void aSecretThatWasDrawnFromANumberIsAFinding()
    {
        const QTemporaryDir temporary;
        const QString cloth = temporary.filePath("cloth"), study = temporary.filePath("study");
        support::mustRun({"fabrics", "make", cloth, "--fabrics", "7", "--samples", "10"});
        support::mustRun({"study", "new", study, "--dataset", cloth, "--key-seed", "20260301", "--no-passphrase"});
        const auto run = support::runProgram({"leak-check", study});
        QVERIFY2(run.exitCode == 1 && run.out.contains("(--key-seed): whoever guesses it"), qPrintable(run.out));
    }
};

QTEST_GUILESS_MAIN(LeakCheckTest)
#include "leak_check_test.moc"
