#include "tests/fuzz/study_readers.h"

#include <exception>
#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "database/disk/station_key.h"
#include "database/disk/study_upgrade.h"
#include "database/evidence/acts.h"
#include "database/evidence/finger_records.h"
#include "database/evidence/operator_latency.h"
#include "database/keys.h"
#include "database/preregistrations.h"
#include "protocols/files/errors.h"
#include "protocols/secrets/sealing.h"
#include "protocols/secrets/signing.h"
#include "study/commands/passphrase_option.h"
#include "study/exports/exported_answers.h"
#include "study/leaks/seen_study.h"
#include "study/making/preregistration.h"
#include "study/making/study_sheets.h"
#include "study/players/session_script.h"
#include "study/records/blinded_report.h"
#include "study/records/evidence/data_sheet.h"
#include "study/records/evidence/data_sheet_text.h"
#include "study/records/evidence/participant_data.h"
#include "study/records/evidence/participant_page.h"
#include "study/records/evidence/signed_head.h"
#include "study/records/log_heads.h"
#include "study/records/running_orders_csv.h"
#include "study/records/stored_study.h"
#include "study/records/study_faults.h"
#include "study/records/study_status.h"
#include "tests/fuzz/damaged_rows.h"
#include "tests/fuzz/inputs.h"
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

constexpr const char* words = "four words of mine";

std::string sealedText(const std::string& text)
{
    return protocols::sealWithPassphrase(words, text, protocols::PassphraseCost::ForTests);
}

study::making::PreregistrationCall callOfPlan() { return {{}, "a", "vis2hap", "2026-01-01T00:00:00.000Z"}; }

/// A study with every kind of entry: one participant has finished, one has withdrawn and was erased, one is in mid-session.
class SampleStudy {
public:
    explicit SampleStudy(const fs::path& folder)
        : m_sound{folder / "sound"}, m_unblinded{folder / "unblinded"}, m_tried{folder / "tried"}
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
        fs::copy(m_sound.folder, m_unblinded.folder, fs::copy_options::recursive);
        database::StudyStore store(m_unblinded, database::StudyStore::Access::Write);
        unblind(store, {"a", "done", "2026-01-02T00:00:00.000Z"}, nobody);
    }

    std::string bytes() const { return contentOf(m_sound.database()); }
    /// The database before the last participant began, and before all.
    const std::string& earlier() const { return m_earlier; }
    const std::string& unused() const { return m_unused; }
    const StudyFolder& sound() const { return m_sound; }

    /// A fresh copy of the study.
    const StudyFolder& copy() const { return copyOf(m_sound); }
    /// The same after the unblinding.
    const StudyFolder& unblindedCopy() const { return copyOf(m_unblinded); }

private:
    const StudyFolder& copyOf(const StudyFolder& study) const
    {
        fs::remove_all(m_tried.folder);
        fs::copy(study.folder, m_tried.folder, fs::copy_options::recursive);
        return m_tried;
    }

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

    StudyFolder m_sound, m_unblinded, m_tried;
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

/// As the people of a study get their own data.
void readParticipants(const database::StudyStore& store)
{
    std::vector<std::function<void()>> parts;
    for (const auto& enrolment : store.enrolments())
        parts.push_back([&store, participant = enrolment.participant] {
            study::records::participantPage(study::records::participantData(store, participant));
        });
    runAllOf(parts);
}

/// As leak-check looks for values that tell a condition. It draws the orders again, which takes long for a damaged protocol with
/// very many places.
void attack(const StudyFolder& folder)
{
    constexpr int mostPlaces = 50;
    const auto tables = study::leaks::tablesOfDatabase(folder.database());
    const auto seen = study::leaks::seenStudy(tables);
    if (seen.protocol.participants <= mostPlaces && seen.slotsOfStudy <= std::size_t{mostPlaces})
        study::leaks::featuresOf(seen, tables, folder.database());
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
              [&] { records::textOfDataSheet(records::dataSheetOf(store)); }, [&] { readParticipants(store); },
              [&] { attack(folder); }});
}

/// As exports, printed running orders, scripts and sheets read it.
void writeStudy(const StudyFolder& folder)
{
    namespace records = study::records;
    const auto store = records::openStudy(folder.folder);
    const auto nowhere = [](std::string_view) {};
    const auto exported = [&](bool isPublic) {
        const auto protocol = records::protocolOf(store.facts());
        const auto naming = store.unblinding() ? records::namingOf(store, protocol, nobody) : std::nullopt;
        if (naming) study::exports::ExportedAnswers(store, protocol, *naming, isPublic).writeCsv(nowhere);
    };
    const fs::path scripts = folder.folder / "scripts-written", sheets = folder.folder / "sheets-written";
    for (const fs::path& out : {scripts, sheets}) fs::create_directory(out);
    runAllOf({[&] { records::runningOrdersCsv(store); }, [&] { exported(false); }, [&] { exported(true); },
              [&] { study::players::writeScripts(store, nullptr, scripts); },
              [&] { study::making::writeSheets(store, sheets); }});
}

/// Goes on with a session as an operator does. A damaged study may refuse a step, or have nothing to ask for.
void playOn(tests::support::OpenSession& session)
{
    using namespace study::session;
    constexpr int mostSteps = 8;
    for (int step = 0; step < mostSteps; ++step) {
        const auto* presenting = std::get_if<Presenting>(&session.driver->state().stage);
        const bool isAsking = presenting != nullptr && !session.driver->state().paused;
        session.clock.advanceSeconds(2.5);
        if (isAsking && presenting->question == 0 && !presenting->touchedAtNs && session.driver->send(Touched{})) return;
        session.clock.advanceSeconds(2.5);
        const View view = session.driver->view();
        if (isAsking && (!view.question || view.trayIds.empty())) return;
        const auto next = tests::support::nextEvent(view, session.driver->plan());
        if (!next || session.driver->send(*next)) return;
    }
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
    const StudyFolder& withRows(const std::string& input, bool isUnblinded = false)
    {
        const StudyFolder& folder = isUnblinded ? get().unblindedCopy() : get().copy();
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

/// The bytes are a rescue file beside an earlier state of its study. Behind a "+" they are rows of that state instead, beside a
/// sound rescue file.
void rescueWith(const Study& study, const std::string& bytes)
{
    const StudyFolder& folder = study->withDatabase(study->get().earlier());
    const bool isOfStudy = bytes.starts_with('+');
    if (isOfStudy) changeRows(folder.database(), bytes.substr(1));
    replace(folder.folder / "rescue-1.db", isOfStudy ? study->get().bytes() : bytes);
    database::StudyStore::rescue(folder, folder.folder / "rescue-1.db");
    readStudy(folder);
}

std::vector<Reader> databaseReaders(const fs::path& folder, const Study& study)
{
    const auto older = std::make_shared<OlderSample>(folder);
    const auto rows = [study] {
        Inputs inputs = rowsOf(study->get().sound().database());
        for (std::string& damage : knownDamages()) inputs.push_back(std::move(damage));
        return inputs;
    };
    return {{"study-db",
             {},
             [study](const std::string& bytes) {
                 const StudyFolder& folder = study->withDatabase(bytes);
                 runAllOf({[&] { readStudy(folder); }, [&] { writeStudy(folder); }});
             },
             [study] {
                 return Inputs{study->get().bytes(), study->get().unused()};
             },
             largestDatabase},
            {"study-rows",
             {},
             [study](const std::string& input) {
                 // Half of the inputs damage an unblinded study.
                 const StudyFolder& folder = study->withRows(input, input.size() % 2 == 1);
                 runAllOf({[&] { readStudy(folder); }, [&] { writeStudy(folder); }});
             },
             rows,
             largestRow},
            {"session-rows",
             {},
             [study](const std::string& input) {
                 tests::support::OpenSession session(study->withRows(input), "P03");
                 playOn(session);
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
             [study](const std::string& bytes) { rescueWith(study, bytes); },
             [study, folder] {
                 Inputs inputs{study->get().bytes(), study->get().earlier()};
                 replace(folder / "earlier.db", study->get().earlier());
                 for (const std::string& rows : rowsOf(folder / "earlier.db")) inputs.push_back("+" + rows);
                 return inputs;
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
    const std::string signingKey = study::records::signingKeyText(protocols::SecretKey::ofSeed(3), std::nullopt);
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
                               shortTextOf(head) + " 99:abcdef0123456789",
                               "98:abcdef0123456789\r\n98:abcdef0123456789\r\n0:" + head.hash + "\r\n\r\n"};
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
                 const std::string text = study::records::signedHeadText(store, protocols::SecretKey::ofSeed(3), "vis2hap");
                 std::string ofWindows;
                 for (const char c : text) ofWindows += c == '\n' ? std::string("\r\n") : std::string(1, c);
                 return Inputs{text, "\xEF\xBB\xBF" + ofWindows};
             }},
            {"signing-key",
             {signingKey, sealedText(signingKey), "+" + signingKey},
             [](const std::string& bytes) {
                 const auto content = contentToPack(bytes);
                 study::records::signingKeyOf(content ? sealedText(*content) : bytes, "lab.key",
                                              [] { return std::optional<std::string>(words); });
             }},
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
