// What leaves a study as evidence: the data sheet, which must know every column of the schema, and signed heads of the log.
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "database/evidence/acts.h"
#include "protocols/files/errors.h"
#include "protocols/secrets/signing.h"
#include "study/records/evidence/data_sheet.h"
#include "study/records/evidence/data_sheet_text.h"
#include "study/records/evidence/data_words.h"
#include "study/records/evidence/signed_head.h"
#include "study/records/participants_sentence.h"
#include "tests/support/played_session.h"
#include "tests/support/raw_sqlite.h"
#include "tests/support/study_builder.h"

using namespace study::records;
using database::StudyFolder;
using database::StudyStore;
using protocols::SecretKey;
using tests::support::OpenSession;
using tests::support::RawSqlite;

namespace {

const std::string somePassphrase = "four words of wool";

std::string faultText(const std::function<void()>& call)
{
    try {
        call();
    } catch (const protocols::Error& error) {
        return error.what();
    }
    return {};
}

}  // namespace

class ProofTest : public QObject {
    Q_OBJECT
    QTemporaryDir m_place;
    int m_studies = 0;

    /// Two people, each with answers, a note, a void, facts.
    StudyFolder playedStudy()
    {
        const std::string path = m_place.filePath(QString("study%1").arg(++m_studies)).toStdString();
        const auto folder = tests::support::buildStudy(path);
        for (const char* participant : {"P1", "P2"}) {
            OpenSession session(folder, participant, database::ParticipantKind::Human, {"Ada", "test", "here"});
            session.playUntilAnswers(1);
            session.stepUntil("Presenting");
            session.send(study::session::Noted{"smells of glue", true});
            session.send(study::session::Voided{"wrong piece"});
            session.playToEnd();
        }
        return folder;
    }
    static StudyStore reading(const StudyFolder& folder) { return {folder, StudyStore::Access::Read}; }

private Q_SLOTS:
    /// The sheet cannot go stale: a column without words, or words without a column, fail here.
    void theDataSheetKnowsEveryColumn()
    {
        const auto folder = playedStudy();
        RawSqlite raw(folder.database());
        const auto rows = raw.rows(
            "SELECT m.name || '.' || c.name FROM sqlite_master m JOIN pragma_table_info(m.name) c WHERE m.type = 'table' AND "
            "m.name "
            "NOT LIKE 'sqlite%'");
        const std::set<std::string> schema(rows.begin(), rows.end());
        std::set<std::string> described, shown;
        for (const auto& words : columnWords()) described.insert(std::string(words.table) + "." + words.column);
        QCOMPARE(described.size(), columnWords().size());
        QVERIFY(schema.size() > 90);
        QVERIFY2(described == schema, "data_words.cpp and schema.cpp name different columns");
        std::set<std::string> tables;
        const auto sheet = dataSheetOf(reading(folder));
        for (const auto& table : sheet["tables"]) {
            tables.insert(table["table"]);
            QVERIFY2(!table["what"].get<std::string>().empty(), table["table"].dump().c_str());
            for (const auto& column : table["columns"]) {
                shown.insert(table["table"].get<std::string>() + "." + column["column"].get<std::string>());
                QVERIFY2(column["what"].is_string(), column.dump().c_str());
            }
        }
        QVERIFY(shown == schema);
        QCOMPARE(tableWords().size(), tables.size());
        const std::string text = textOfDataSheet(sheet);
        for (const std::string& name : schema)
            QVERIFY2(text.find("    " + name.substr(name.find('.') + 1) + ": ") != std::string::npos, name.c_str());
    }

    /// A column of a later version, or one that somebody added, is shown as unknown.
    void anUnknownColumnIsNamed()
    {
        const auto folder = playedStudy();
        RawSqlite(folder.database()).run("CREATE TABLE strange(thing TEXT)");
        const std::string text = textOfDataSheet(dataSheetOf(reading(folder)));
        QVERIFY2(text.find("thing: this program does not know the column") != std::string::npos, text.c_str());
    }

    /// What the sheet says of an erasure is what an erasure does: both kinds are done and every column is looked at.
    void theDataSheetIsRightAboutErasures_data()
    {
        QTest::addColumn<bool>("answersToo");
        QTest::newRow("facts") << false;
        QTest::newRow("answers") << true;
    }
    void theDataSheetIsRightAboutErasures()
    {
        QFETCH(const bool, answersToo);
        const auto folder = playedStudy();
        const auto head = reading(folder).head();
        QCOMPARE(recordAct(folder, {database::personExport, "Ada", "test", "here", "/out", head, {}, "P1"}), std::nullopt);
        // An empty text, NULL, {} and 0 count as no value.
        const auto valuesIn = [&](const ColumnWords& words) {
            const std::string table = words.table, column = words.column;
            const std::string ofP1 = table == "participants" ? "id = 'P1'"
                                     : table == "acts"       ? "details LIKE '%\"P1\"%'"
                                                             : "participant = 'P1'";
            RawSqlite raw(folder.database());
            return std::stoi(raw.rows("SELECT COUNT(*) FROM " + table + " WHERE " + ofP1 + " AND " + column +
                                      " IS NOT NULL AND " + column + " NOT IN ('', '{}', 0)")
                                 .front());
        };
        std::map<const ColumnWords*, int> before;
        for (const auto& words : columnWords())
            if (words.atErasure != AtErasure::NotPersonal) before[&words] = valuesIn(words);
        QVERIFY(before.size() > 40);
        int handOvers = 0;
        for (const auto& [words, count] : before)
            if (std::string(words->table) == "acts") handOvers += count;
        QCOMPARE(handOvers, 1);
        StudyStore({folder, StudyStore::Access::Write})
            .erase({protocols::ParticipantId("P1"), answersToo, "Ada", "on request", {}});
        for (const auto& [words, count] : before) {
            const std::string name = std::string(words->table) + "." + words->column;
            const bool goes =
                words->atErasure == AtErasure::WithFacts || (answersToo && words->atErasure == AtErasure::WithAnswers);
            if (goes)
                QVERIFY2(valuesIn(*words) == 0, (name + " was not erased").c_str());
            else if (std::string(words->table) != "erasures")
                QVERIFY2(valuesIn(*words) == count, (name + " was erased").c_str());
        }
    }

    void theDataSheetSaysHowTheStudyIs()
    {
        const std::string path = m_place.filePath("sealed").toStdString();
        const auto folder = tests::support::buildStudy(path, {.passphrase = somePassphrase});
        const auto sheet = dataSheetOf(reading(folder));
        QVERIFY(sheet["passphrase"].get<bool>() && sheet["blinded"].get<bool>());
        QVERIFY(sheet["contact"].is_null() && sheet["why"]["contact"].is_string());
        for (const auto& file : sheet["place"]["files"])
            QVERIFY2(file["what"] != "does not belong to the study", file.dump().c_str());
        const std::string text = textOfDataSheet(sheet);
        for (const char* word : {"A passphrase of the owner seals the key", "allocation-key.sealed", "Argon2id", "0 human",
                                 "None is on record.", "The study is blinded now."})
            QVERIFY2(text.find(word) != std::string::npos, word);
        for (const char* word : {"v_grey", "h&f", "K1"}) QVERIFY2(text.find(word) == std::string::npos, word);
        QVERIFY(textOfDataSheet(dataSheetOf(reading(playedStudy()))).find("The study has no passphrase") != std::string::npos);
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);)
            QVERIFY2(line.size() <= 100 || line.find(m_place.path().toStdString()) != std::string::npos, line.c_str());
    }

    void filesThatDoNotBelongAreNamed()
    {
        const auto folder = playedStudy();
        std::filesystem::copy_file(folder.database(), folder.folder / "copy.db");
        const std::string text = textOfDataSheet(dataSheetOf(reading(folder)));
        QVERIFY2(text.find("copy.db, mode 0") != std::string::npos && text.find("does not belong to") != std::string::npos,
                 text.c_str());
    }

    /// RFC 8032, section 7.1, tests 1 and 2.
    void signaturesAreThoseOfEd25519_data()
    {
        QTest::addColumn<QByteArray>("seed");
        QTest::addColumn<QByteArray>("key");
        QTest::addColumn<QByteArray>("message");
        QTest::addColumn<QByteArray>("signature");
        QTest::newRow("test 1") << QByteArray("9d61b19deffd5a60ba844af492ec2cc44449c5697b326919703bac031cae7f60")
                                << QByteArray("d75a980182b10ab7d54bfed3c964073a0ee172f3daa62325af021a68f707511a") << QByteArray()
                                << QByteArray(
                                       "e5564300c360ac729086e2cc806e828a84877f1eb8e5d974d873e065224901555fb8821590a33bacc61e3"
                                       "9701cf9b46bd25bf5f0595bbe24655141438e7a100b");
        QTest::newRow("test 2") << QByteArray("4ccd089b28ff96da9db6c346ec114e0f5b8a319f35aba624da8cf6ed4fb8a6fb")
                                << QByteArray("3d4017c3e843895a92b70aa74d1b7ebc9c982ccf2ec4968cc0cd55f12af4660c")
                                << QByteArray("\x72")
                                << QByteArray(
                                       "92a009a9f0d4cab8720e820b5f642540a2b27b5416503f8fb3762223ebdb69da085ac1e43e15996e458f3"
                                       "613d0f11d8c387b2eaeb4302aeeb00d291612bb0c00");
    }
    void signaturesAreThoseOfEd25519()
    {
        QFETCH(const QByteArray, seed);
        QFETCH(const QByteArray, key);
        QFETCH(const QByteArray, message);
        QFETCH(const QByteArray, signature);
        const auto secret = SecretKey::ofHex(seed.toStdString(), "here");
        const std::string bytes = message.toStdString(), open = key.toStdString(), mark = signature.toStdString();
        QCOMPARE(protocols::publicKeyOf(secret), open);
        QCOMPARE(protocols::signatureOf(secret, bytes), mark);
        QVERIFY(protocols::isSignedBy(open, bytes, mark));
        QVERIFY(!protocols::isSignedBy(open, bytes + "x", mark));
        QVERIFY(!protocols::isSignedBy(protocols::publicKeyOf(SecretKey::ofSeed(1)), bytes, mark));
        for (const std::string& bad : {std::string(), mark.substr(2), std::string(128, 'g'), std::string(128, '0')})
            QVERIFY(!protocols::isSignedBy(open, bytes, bad));
    }

    /// The key of test 1, as `openssl pkey -pubout` of OpenSSL 3.0 writes it.
    void publicKeysAreWrittenAsOthersReadThem()
    {
        const std::string key = "d75a980182b10ab7d54bfed3c964073a0ee172f3daa62325af021a68f707511a";
        const std::string pem = protocols::pemOf(key);
        QCOMPARE(pem,
                 std::string("-----BEGIN PUBLIC KEY-----\nMCowBQYDK2VwAyEA11qYAYKxCrfVS/7TyWQHOg7hcvPapiMlrwIaaPcHURo=\n-----END "
                             "PUBLIC KEY-----\n"));
        QCOMPARE(protocols::publicKeyOfPem(pem, "here"), key);
        for (const std::string& bad : {std::string(), std::string("-----BEGIN PUBLIC KEY-----"), pem.substr(0, 60), key,
                                       "-----END PUBLIC KEY-----" + pem.substr(0, 80)})
            QVERIFY2(
                faultText([&] { protocols::publicKeyOfPem(bad, "here"); }).find("no public key of Ed25519") != std::string::npos,
                bad.c_str());
    }

    /// Every byte of the statement and of the signature counts.
    void everyChangedByteOfAStatementIsFound()
    {
        const auto folder = playedStudy();
        const auto store = reading(folder);
        const auto seed = SecretKey::ofSeed(7);
        const std::string key = protocols::publicKeyOf(seed), text = signedHeadText(store, seed, "vis2hap test");
        const auto found = signedHeadIn(text, "here");
        QVERIFY(found.has_value());
        QCOMPARE(faultOfSignature(*found, key, store), std::string());
        QVERIFY(found->head == store.head());
        for (std::size_t at = 0; at < text.size(); ++at) {
            std::string changed = text;
            changed[at] = changed[at] == 'x' ? 'y' : 'x';
            std::optional<SignedHead> other;
            const std::string fault = faultText([&] { other = signedHeadIn(changed, "here"); });
            const bool isRefused = !fault.empty() || !other || !faultOfSignature(*other, key, store).empty();
            QVERIFY2(isRefused, ("byte " + std::to_string(at) + " may change").c_str());
        }
        QVERIFY(faultText([&] { signedHeadIn(text + "more\n", "here"); }).find("after its signature") != std::string::npos);
        QVERIFY(!signedHeadIn("a page with 12:0123456789abcdef", "here").has_value());
        // A mail program ends lines with carriage returns, and somebody writes a line before.
        const std::string mailed = QString::fromStdString("\xEF\xBB\xBF" + text).replace("\n", "\r\n").toStdString();
        QCOMPARE(signedHeadIn(mailed, "here")->statement, found->statement);
        QVERIFY(faultText([&] { signedHeadIn("Dear Ada,\n" + text, "here"); }).find("does not begin") != std::string::npos);
    }

    void otherKeysAndOtherStudiesAreRefused()
    {
        const auto folder = playedStudy();
        const auto store = reading(folder);
        const auto other = reading(playedStudy());
        const auto seed = SecretKey::ofSeed(7);
        const auto found = *signedHeadIn(signedHeadText(store, seed, "vis2hap test"), "here");
        QVERIFY(faultOfSignature(found, protocols::publicKeyOf(SecretKey::ofSeed(8)), store).find("another key") !=
                std::string::npos);
        QVERIFY(faultOfSignature(found, protocols::publicKeyOf(seed), other).find("another study") != std::string::npos);
    }

    void signingKeysAreSealed()
    {
        const auto seed = SecretKey::ofSeed(7);
        const std::string sealed = signingKeyText(seed, somePassphrase), open = signingKeyText(seed, std::nullopt);
        QVERIFY(sealed.find(seed.hex()) == std::string::npos && open.find(seed.hex()) != std::string::npos);
        const auto given = [](std::optional<std::string> word) { return [word] { return word; }; };
        QCOMPARE(signingKeyOf(sealed, "here", given(somePassphrase)).hex(), seed.hex());
        QCOMPARE(signingKeyOf(open, "here", given(std::nullopt)).hex(), seed.hex());
        const auto faultWith = [&](const std::string& text, std::optional<std::string> word) {
            return faultText([&] { (void)signingKeyOf(text, "here", given(word)); });
        };
        QVERIFY(faultWith(sealed, "another one").find("does not open the signing key") != std::string::npos);
        QVERIFY(faultWith(sealed, std::nullopt).find("has a passphrase") != std::string::npos);
        QVERIFY(faultWith("{}", std::nullopt).find("no signing key") != std::string::npos);
        QVERIFY(faultWith("[1]", std::nullopt).find("no signing key") != std::string::npos);
        QVERIFY(!faultWith(protocols::pemOf(protocols::publicKeyOf(seed)), std::nullopt).empty());
    }

    /// The 309 digits of 1e308 were cut to 63, which is another number.
    void anEnormousFactIsAWord_data()
    {
        QTest::addColumn<QString>("facts");
        QTest::addColumn<QString>("sentence");
        QTest::newRow("ages") << "('P1', 'age', '23'), ('P2', 'age', '25')"
                              << "2 participants (age mean 24.0, SD 1.4, 23.0 to 25.0).";
        QTest::newRow("enormous") << "('P1', 'income', '1e308'), ('P2', 'income', '1e308')"
                                  << "2 participants (income: 2 1e308).";
        QTest::newRow("below zero") << "('P1', 'income', '-1e16'), ('P2', 'income', '4')"
                                    << "2 participants (income: 1 -1e16, 1 4).";
    }
    void anEnormousFactIsAWord()
    {
        QFETCH(const QString, facts);
        QFETCH(const QString, sentence);
        const StudyFolder folder = playedStudy();
        QCOMPARE(RawSqlite(folder.database())
                     .run("DELETE FROM participant_facts; INSERT INTO participant_facts(participant, fact, value) VALUES " +
                          facts.toStdString()),
                 std::string());
        QCOMPARE(QString::fromStdString(participantsSentence(StudyStore(folder, StudyStore::Access::Read))), sentence);
    }
};

QTEST_GUILESS_MAIN(ProofTest)
#include "proof_test.moc"
