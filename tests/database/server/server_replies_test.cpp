// Replies of a server that is damaged, of another version, or not to be trusted: each is refused in words, and none is half
// taken.
#include "database/server/server_replies.h"

#include <QTest>
#include <chrono>
#include <nlohmann/json.hpp>

#include "database/server/entry_json.h"
#include "tests/support/error_text.h"

using namespace database;
using tests::support::errorOf;

namespace {

const std::string where = "postgresql://a@b/lab?study=x";

nlohmann::json claim()
{
    auto reply = nlohmann::json::parse(
        R"({"slot": 2, "state": "started", "protocol_version": 1, "swatches": {"F01": "K7"}, "events": [],
            "trials": [{"number": 1, "phase": 0, "presentation_code": "A1", "alternatives": "", "sealed_code": "00ff"},
                       {"number": 2, "phase": 0, "presentation_code": "A2", "deadline_ms": 900}],
            "head": {"sequence": 4, "hash": "ab"}})");
    reply["trials"][0]["alternatives"] = "[\"F01\", \"F02\"]";
    return reply;
}

nlohmann::json progress()
{
    return nlohmann::json::parse(
        R"({"places": [{"slot": 1, "state": "started", "participant": "P01", "kind": "human", "answers": 3},
                       {"slot": 2, "state": "free", "participant": "", "kind": "", "answers": 0},
                       {"slot": 3, "state": "withdrawn", "participant": "P02", "kind": "human", "answers": 4}],
            "stations": [{"station": "left", "login": "hand", "participant": null, "live": true, "queue_length": 0,
                          "last_seen_seconds": 1}], "head": {"sequence": 4, "hash": "ab"}})");
}

/// The claim with one value in another one's place.
nlohmann::json changed(nlohmann::json reply, const char* place, const nlohmann::json& value)
{
    reply[nlohmann::json::json_pointer(place)] = value;
    return reply;
}

}  // namespace

class ServerRepliesTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    /// A station compares its log with the server's at each claim.
    void whatIsHeldOfFactsIsWhatIsSent()
    {
        SessionStore::Append entry;
        entry.event = {0, protocols::ParticipantId("P01"), 1, "facts_given", R"({"given":["hand"]})", 1, "2026-01-01T00:00:00Z"};
        entry.facts = {{"hand", "left-handed"}};
        const EntryToSend sent = entryToSend(entry, 3);
        QCOMPARE(nlohmann::json::parse(sent.json).at("event").at("payload").get<std::string>(), sent.payload);
        QVERIFY(sent.payload.find("facts_sha256") != std::string::npos);
        QVERIFY(sent.payload.find("left-handed") == std::string::npos);
        entry.facts.clear();
        QCOMPARE(entryToSend(entry, 3).payload, entry.event.payloadJson);
    }

    void soundRepliesAreTaken()
    {
        const ClaimReply place = claimReplyFrom(claim(), where, "P01");
        QCOMPARE(place.slot, 2);
        QCOMPARE(place.trials.size(), std::size_t{2});
        QCOMPARE(place.trials[0].alternatives.size(), std::size_t{2});
        QCOMPARE(place.trials[1].deadlineMs, 900);
        QVERIFY(place.trials[1].sealedCode.empty());
        QCOMPARE(place.swatches.size(), std::size_t{1});
        QCOMPARE(trialFrom(claim()["trials"][1], where, {2}).presentationCode, protocols::PresentationCode("A2"));
        const ServerProgress seen = progressFrom(progress(), where);
        QCOMPARE(std::vector<int>({seen.free, seen.started, seen.finished, seen.withdrawn, seen.answers}),
                 std::vector<int>({1, 1, 0, 1, 7}));
        QCOMPARE(seen.stations.at(0).participant, std::string());
        QVERIFY(seen.owed.empty());  // a study that an earlier version moved there
        const auto owed = nlohmann::json::parse(R"([{"station": "left", "participant": "P01", "queue_length": 3}])");
        QCOMPARE(progressFrom(changed(progress(), "/owed", owed), where).owed.at(0).waiting, 3);
        QCOMPARE(familiarisationPosition(familiarisationCode(12)), std::optional(12));
        QVERIFY(!familiarisationPosition(protocols::SealedCode("familiarisation:12x")));
        QVERIFY(!familiarisationPosition(protocols::SealedCode("00ff")));
    }

    /// Nanoseconds since 1970 end in 2262.
    void aClockOfAnotherAgeIsFarAheadOrBehind()
    {
        const std::chrono::system_clock::time_point now{std::chrono::seconds(1'800'000'000)};
        const auto ahead = [&](const char* time) { return clockAheadOf({{"now", time}}, now, now).count(); };
        QVERIFY(ahead("9999-12-31T23:59:59.000Z") < -7'000'000'000);
        QVERIFY(ahead("0001-01-01T00:00:00.000Z") >= 1'800'000'000);
        QVERIFY(ahead("2027-01-15T08:00:30.000Z") == -30);
    }

    void otherRepliesAreRefused_data()
    {
        QTest::addColumn<QString>("error");
        QTest::addColumn<QString>("said");
        const auto claimed = [](const char* place, const nlohmann::json& value) {
            return errorOf([&] { claimReplyFrom(changed(claim(), place, value), where, "P01"); });
        };
        const auto seen = [](const char* place, const nlohmann::json& value) {
            return errorOf([&] { progressFrom(changed(progress(), place, value), where); });
        };
        const QString unread = "the server's reply cannot be read: ";
        QTest::newRow("no JSON") << errorOf([&] { replyFrom("{\"slot\": ", where); }) << unread;
        QTest::newRow("too deep") << errorOf([&] { replyFrom(std::string(500, '['), where); }) << unread;
        QTest::newRow("a field twice") << errorOf([&] { replyFrom(R"({"slot": 1, "slot": 2})", where); }) << unread;
        QTest::newRow("another type") << claimed("/slot", "two") << unread;
        QTest::newRow("slot 0") << claimed("/slot", 0) << "the server gave slot 0";
        QTest::newRow("far slot") << claimed("/slot", 2000000) << "the server gave slot 2000000";
        QTest::newRow("trial 0") << claimed("/trials/0/number", 0) << unread + "trial 0 at place 1";
        QTest::newRow("a trial twice") << claimed("/trials/1/number", 1) << unread + "trial 1 at place 2";
        QTest::newRow("no trials") << claimed("/trials", 5) << unread;
        QTest::newRow("swatches") << claimed("/swatches", "K7") << unread;
        QTest::newRow("negative answers") << seen("/places/0/answers", -20) << unread + "impossible counts of answers";
        QTest::newRow("answers") << seen("/places/0/answers", 2147483647) << unread + "impossible counts of answers";
        QTest::newRow("another trial") << errorOf([&] { trialFrom(claim()["trials"][1], where, {1}); })
                                       << unread + "trial 2 in place of trial 1";
        QTest::newRow("state") << seen("/places/1/state", "lost") << "the database holds an unknown name";
        QTest::newRow("slot of 33 bits") << claimed("/slot", 4294967297) << unread + "slot is no whole number that fits";
        QTest::newRow("slot of 64 bits") << claimed("/slot", 18446744073709551615ULL)
                                         << unread + "slot is no whole number that fits";
        QTest::newRow("a fraction") << claimed("/protocol_version", 1.5) << unread + "protocol_version is no whole number";
        QTest::newRow("phase -1") << claimed("/trials/0/phase", -1) << unread + "phase is negative";
        QTest::newRow("phase of 64 bits") << claimed("/trials/0/phase", 18446744073709551615ULL) << unread + "phase is no whole";
        QTest::newRow("deadline") << claimed("/trials/1/deadline_ms", 4294967297) << unread + "deadline_ms is no whole number";
        QTest::newRow("last entry") << claimed("/head/sequence", 9223372036854775808ULL)
                                    << unread + "sequence is no whole number";
        QTest::newRow("head") << seen("/head", nullptr) << unread;
        QTest::newRow("what stations owe") << seen("/owed", 5) << unread;
    }
    void otherRepliesAreRefused()
    {
        QFETCH(const QString, error);
        QFETCH(const QString, said);
        QVERIFY2(error.contains(said), qPrintable(error));
        QVERIFY2(error.startsWith("1: ") || error.startsWith("3: ") || error.startsWith("4: "), qPrintable(error));
    }
};

QTEST_GUILESS_MAIN(ServerRepliesTest)
#include "server_replies_test.moc"
