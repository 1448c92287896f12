#include "tests/fuzz/study_readers.h"

#include <exception>
#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "database/evidence/acts.h"
#include "database/evidence/finger_records.h"
#include "database/evidence/operator_latency.h"
#include "database/preregistrations.h"
#include "database/station_key.h"
#include "database/study_upgrade.h"
#include "protocols/files/errors.h"
#include "protocols/secrets/signing.h"
#include "study/commands/passphrase_option.h"
#include "study/leaks/seen_study.h"
#include "study/making/preregistration.h"
#include "study/records/blinded_report.h"
#include "study/records/evidence/signed_head.h"
#include "study/records/log_heads.h"
#include "study/records/stored_study.h"
#include "study/records/study_faults.h"
#include "study/records/study_status.h"
#include "tests/fuzz/damaged_rows.h"
#include "tests/support/played_session.h"
#include "tests/support/study_builder.h"

namespace fuzz {

namespace {

namespace fs = std::filesystem;
using database::StudyFolder;

constexpr std::size_t largestDatabase = 1 << 20, largestRow = 1 << 20;

std::string contentOf(const fs::path& file)
{
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void replace(const fs::path& file, const std::string& bytes) { std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes; }

std::optional<std::string> nobody() { return std::nullopt; }

study::making::PreregistrationCall callOfPlan() { return {{}, "a", "vis2hap", "2026-01-01T00:00:00.000Z"}; }

/// A study with every kind of entry: one participant has finished, one has withdrawn and was erased, one is in mid-session.
class SampleStudy {
public:
    explicit SampleStudy(const fs::path& folder) : m_sound{folder / "sound"}, m_tried{folder / "tried"}
    {
        tests::support::StudyRecipe recipe;
        recipe.fabrics = 2;
        recipe.alternatives = 2;
        recipe.participants = 3;
        recipe.hasSwatchCodes = true;
        recipe.familiarisationImages = 1;
        tests::support::buildStudy(m_sound.folder, recipe);
        m_unused = contentOf(m_sound.database());
        {
            database::StudyStore store(m_sound, database::StudyStore::Access::Write);
            study::making::preregister(store, callOfPlan());
        }
        playWithFinger("P01");
        play("P02", 3, study::session::WithdrawnEvent{"ill"});
        {
            database::StudyStore store(m_sound, database::StudyStore::Access::Write);
            store.erase({protocols::ParticipantId("P02"), true, "a", "asked", {}});
            const std::string protocol = store.facts().protocolJson + "\n";
            store.takeProtocol(protocol, "a", "b");
            replace(m_sound.protocol(), protocol);
        }
        m_earlier = contentOf(m_sound.database());
        play("P03", 5, study::session::Paused{});
        {
            const database::StudyStore store(m_sound, database::StudyStore::Access::Write);
            recordOperatorLatency(store, {"Ada", "tone", 60, 20, 1, 2, 310.5, 280.25, 350, {}, 0});
        }
        recordAct(m_sound, {"export", "a", "vis2hap", "host", "out", {}, ""});
        fs::remove(m_sound.folder / "preregistration.txt");
    }

    std::string bytes() const { return contentOf(m_sound.database()); }
    /// The database before the last participant began, and before all.
    const std::string& earlier() const { return m_earlier; }
    const std::string& unused() const { return m_unused; }
    const StudyFolder& sound() const { return m_sound; }

    /// A fresh copy of the study.
    const StudyFolder& copy() const
    {
        fs::remove_all(m_tried.folder);
        fs::copy(m_sound.folder, m_tried.folder, fs::copy_options::recursive);
        return m_tried;
    }

private:
    void playWithFinger(const char* participant) const
    {
        tests::support::OpenSession session(m_sound, participant);
        do {
            for (int sample = 0; sample < 5; ++sample) {
                session.clock.advanceSeconds(0.01);
                session.driver->addFinger({{}, 31.4 + 0.7 * sample, 20.5, 0.43});
            }
        } while (session.step());
    }

    void play(const char* participant, int answers, const study::session::EventBody& end) const
    {
        tests::support::OpenSession session(m_sound, participant);
        session.playUntilAnswers(answers);
        session.send(study::session::Noted{"cold", true});
        session.send(end);
    }

    StudyFolder m_sound, m_tried;
    std::string m_earlier, m_unused;
};

/// Runs every part, also where an earlier one refused the study. Throws the first refusal.
void runAllOf(const std::vector<std::function<void()>>& parts)
{
    std::exception_ptr first;
    for (const auto& part : parts) try {
            part();
        } catch (const protocols::Error&) {
            if (!first) first = std::current_exception();
        }
    if (first) std::rethrow_exception(first);
}

/// As verify, status, report and leak-check read a study.
void readStudy(const StudyFolder& folder)
{
    namespace records = study::records;
    const auto store = records::openStudy(folder.folder);
    runAllOf({[&] { records::findingsOf(store); }, [&] { records::textOf(records::statusOf(store, nobody)); },
              [&] { records::studyData(store, nobody); }, [&] { records::blindedReport(store); }, [&] { actsOf(store); },
              [&] { store.personalFacts(); }, [&] { store.erasures(); }, [&] { chainedActsOf(store); },
              [&] { operatorLatenciesOf(store); }, [&] { eachFingerRecord(store, {}, [](const database::FingerRecord&) {}); },
              [&] { study::leaks::seenStudy(study::leaks::tablesOfDatabase(folder.database())); }});
}

/// Made when the first reader needs it: it takes a second.
class LazyStudy {
public:
    explicit LazyStudy(fs::path folder) : m_folder(std::move(folder)) {}
    const SampleStudy& get()
    {
        if (!m_study) m_study.emplace(m_folder);
        return *m_study;
    }
    /// A copy of the study with these bytes as its database.
    const StudyFolder& withDatabase(const std::string& bytes)
    {
        const StudyFolder& folder = get().copy();
        replace(folder.database(), bytes);
        return folder;
    }
    const StudyFolder& withRows(const std::string& input)
    {
        const StudyFolder& folder = get().copy();
        changeRows(folder.database(), input);
        return folder;
    }

private:
    fs::path m_folder;
    std::optional<SampleStudy> m_study;
};
using Study = std::shared_ptr<LazyStudy>;

/// A study that version 0.1.0 made.
class OlderSample {
public:
    explicit OlderSample(const fs::path& folder) : m_kept{folder / "older"}, m_tried{folder / "older-tried"} {}

    const fs::path& database()
    {
        if (m_database.empty()) {
            fs::create_directory(m_kept.folder);
            m_database = m_kept.database();
            makeDatabase(m_database, contentOf(VIS2HAP_SOURCE_DIR "/tests/database/study_version_1.sql"));
        }
        return m_database;
    }

    /// Upgrades a study with the changed rows and reads what needs no key. Where it cannot be upgraded, no open copy may be left.
    void upgradeWith(const std::string& input)
    {
        fs::remove_all(m_tried.folder);
        fs::create_directory(m_tried.folder);
        fs::copy_file(database(), m_tried.database());
        changeRows(m_tried.database(), input);
        try {
            upgrade(m_tried);
        } catch (const protocols::Error&) {
            if (isOlder(m_tried) && fs::exists(m_tried.beforeUpgrade()))
                throw std::runtime_error("a refused upgrade left a copy of the study");
            throw;
        }
        const auto store = study::records::openStudy(m_tried.folder);
        runAllOf({[&] { study::records::findingsOf(store); }, [&] { store.answers(); }, [&] { preregistrationsOf(store); }});
    }

private:
    StudyFolder m_kept, m_tried;
    fs::path m_database;
};
using Inputs = std::vector<std::string>;

std::vector<Reader> databaseReaders(const fs::path& folder, const Study& study)
{
    const auto older = std::make_shared<OlderSample>(folder);
    const auto rows = [study] { return rowsOf(study->get().sound().database()); };
    return {{"study-db",
             {},
             [study](const std::string& bytes) { readStudy(study->withDatabase(bytes)); },
             [study] {
                 return Inputs{study->get().bytes(), study->get().unused()};
             },
             largestDatabase},
            {"study-rows", {}, [study](const std::string& input) { readStudy(study->withRows(input)); }, rows, largestRow},
            {"session-rows",
             {},
             [study](const std::string& input) {
                 tests::support::OpenSession session(study->withRows(input), "P03");
                 (void)session.driver->view();
             },
             rows,
             largestRow},
            {"older-rows",
             {},
             [older](const std::string& input) { older->upgradeWith(input); },
             [older] { return rowsOf(older->database()); },
             largestRow},
            {"rescue",
             {},
             [study](const std::string& bytes) {
                 const StudyFolder& folder = study->withDatabase(study->get().earlier());
                 replace(folder.folder / "rescue-1.db", bytes);
                 database::StudyStore::rescue(folder, folder.folder / "rescue-1.db");
                 readStudy(folder);
             },
             [study] {
                 return Inputs{study->get().bytes(), study->get().earlier()};
             },
             largestDatabase}};
}

/// Registers any text as the plan, then reads the plan and amends it.
void readPlan(const StudyFolder& folder, const std::string& bytes)
{
    database::StudyStore store(folder, database::StudyStore::Access::Write);
    const auto earlier = preregistrationsOf(store);
    auto record = earlier.front();
    record.number = static_cast<int>(earlier.size()) + 1;
    record.json = bytes;
    recordPreregistration(store, record);
    runAllOf({[&] { study::records::sealedStudyData(store); }, [&] { study::making::preregister(store, callOfPlan()); }});
}

std::vector<Reader> fileReaders(const fs::path& folder, const Study& study)
{
    const study::commands::PassphraseOption passphrase{(folder / "passphrase").string()};
    return {{"preregistration",
             {},
             [study](const std::string& bytes) { readPlan(study->get().copy(), bytes); },
             [study] {
                 return Inputs{contentOf(study->get().sound().folder / "preregistration.json"), deepJson()};
             }},
            {"station-key",
             {},
             [](const std::string& bytes) { database::stationKeyFromJson(bytes, "station-key.json"); },
             [study] { return Inputs{contentOf(study->get().sound().stationKey())}; }},
            {"heads",
             {},
             [study, folder](const std::string& bytes) {
                 replace(folder / "heads.txt", bytes);
                 const database::StudyStore store(study->get().sound(), database::StudyStore::Access::Read);
                 for (const auto& one : study::records::headsIn((folder / "heads.txt").string()).heads)
                     (void)study::records::faultAgainst(store, one);
             },
             [study] {
                 const auto head = database::StudyStore(study->get().sound(), database::StudyStore::Access::Read).head();
                 return Inputs{"head " + textOf(head) + "\n", R"({"head":")" + textOf(head) + "\"}",
                               shortTextOf(head) + " 99:abcdef0123456789"};
             }},
            {"signed-head",
             {},
             [study](const std::string& bytes) {
                 const database::StudyStore store(study->get().sound(), database::StudyStore::Access::Read);
                 if (const auto head = study::records::signedHeadIn(bytes, "head.txt"))
                     (void)faultOfSignature(*head, head->publicKey, store);
             },
             [study] {
                 const database::StudyStore store(study->get().sound(), database::StudyStore::Access::Read);
                 return Inputs{study::records::signedHeadText(store, protocols::SecretKey::ofSeed(3), "vis2hap")};
             }},
            {"signing-key",
             {study::records::signingKeyText(protocols::SecretKey::ofSeed(3), std::nullopt)},
             [](const std::string& bytes) { study::records::signingKeyOf(bytes, "lab.key", nobody); }},
            {"public-key",
             {protocols::pemOf(protocols::publicKeyOf(protocols::SecretKey::ofSeed(3)))},
             [](const std::string& bytes) { protocols::publicKeyOfPem(bytes, "lab.key.pub"); }},
            {"passphrase", {"four words of mine\n", "long enough\r\nsecond line\n"}, [passphrase](const std::string& bytes) {
                 replace(passphrase.file, bytes);
                 if (const auto given = givenPassphrase(passphrase)(); given && given->find('\n') != std::string::npos)
                     throw std::runtime_error("a passphrase of two lines was read");
                 (void)newPassphrase(passphrase);
             }}};
}

}  // namespace

std::vector<Reader> studyReaders(const fs::path& folder)
{
    const auto study = std::make_shared<LazyStudy>(folder);
    std::vector<Reader> readers = databaseReaders(folder, study);
    for (Reader& more : fileReaders(folder, study)) readers.push_back(std::move(more));
    return readers;
}

}  // namespace fuzz
