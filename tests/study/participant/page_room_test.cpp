// The participant's page without a network: who gets in, what each request is answered, what is refused.
#include "study/participant/page_room.h"

#include <QElapsedTimer>
#include <QTest>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/usual_texts.h"

using namespace study::participant;

namespace {

constexpr const char* host = "192.168.1.5:8577";
constexpr std::int64_t secondNs = 1'000'000'000;

Instruction consent()
{
    Instruction instruction;
    instruction.task = Task::Consent;
    instruction.title = "Consent";
    instruction.lines = {"Read this."};
    instruction.statement = "I take part.";
    return instruction;
}

Instruction scaleTraining()
{
    Instruction instruction;
    instruction.task = Task::Scale;
    instruction.scale = ScaleTask{};
    instruction.scale->asked = protocols::Tenths{35};
    return instruction;
}

/// A page with the code 482913, and a browser with its cookie.
struct Visit {
    PageRoom room{host, {"<html>", "css", "js"}, PageAccess([this] { return "secret" + std::to_string(++drawn); }, {})};
    std::int64_t nowNs = 0;
    int drawn = 0;
    PageRequest request{.method = "GET", .path = "/", .host = host, .from = "192.168.1.9"};

    Visit()
    {
        room.take(NewCode{"482913"}, 0);
        show(1, consent());
    }
    void show(int number, const Instruction& instruction) { room.take(NumberedInstruction{number, instruction}, nowNs); }
    PageReply get(const std::string& path)
    {
        request.method = "GET";
        request.path = path;
        request.body.clear();
        request.contentType.clear();
        return room.answer(request, nowNs);
    }
    PageReply post(const std::string& path, const std::string& body)
    {
        request.method = "POST";
        request.path = path;
        request.body = body;
        request.contentType = "application/json";
        return room.answer(request, nowNs);
    }
    PageReply enter(const std::string& code)
    {
        const PageReply reply = post("/enter", nlohmann::json{{"code", code}}.dump());
        if (reply.status == 204)
            request.cookie = headerOf(reply, "Set-Cookie").substr(0, headerOf(reply, "Set-Cookie").find(';'));
        return reply;
    }
    static std::string headerOf(const PageReply& reply, const std::string& name)
    {
        for (const auto& [key, value] : reply.headers)
            if (key == name) return value;
        return {};
    }
};

std::string why(const PageReply& reply) { return nlohmann::json::parse(reply.body).at("why").get<std::string>(); }

std::string usual(const char* key) { return protocols::usualParticipantTexts().find(key)->second; }

}  // namespace

class PageRoomTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void theFirstBrowserWithTheCodeSeesTheInstruction()
    {
        Visit visit;
        QCOMPARE(visit.get("/now").status, 401);
        const PageReply entered = visit.enter("482913");
        QCOMPARE(entered.status, 204);
        const std::string cookie = Visit::headerOf(entered, "Set-Cookie");
        QVERIFY(cookie.find("HttpOnly") != std::string::npos && cookie.find("SameSite=Strict") != std::string::npos);
        QCOMPARE(entered.lines.size(), std::size_t(1));
        const auto& device = std::get<DeviceEntered>(entered.lines.front());
        QCOMPARE(device.from, std::string("192.168.1.9"));
        QVERIFY(device.sessionHash.find("secret") == std::string::npos);
        const auto seen = nlohmann::json::parse(visit.get("/now").body);
        QCOMPARE(seen.at("number").get<int>(), 1);
        QVERIFY(instructionFromJson(seen.at("instruction").dump(), "reply") == consent());
    }

    void aSecondBrowserIsRefusedUntilANewCodeIsDrawn()
    {
        Visit visit;
        visit.enter("482913");
        const std::string first = visit.request.cookie;
        visit.request.cookie.clear();
        const PageReply refused = visit.enter("482913");
        QCOMPARE(refused.status, 409);
        QCOMPARE(why(refused), usual("code_taken"));
        QVERIFY(std::holds_alternative<DeviceRefused>(refused.lines.front()));
        QCOMPARE(why(visit.get("/now")), usual("code_taken"));
        visit.room.take(NewCode{"111222"}, 0);
        QCOMPARE(visit.enter("482913").status, 403);
        QCOMPARE(visit.enter("111222").status, 204);
        visit.request.cookie = first;  // the browser that was in is out
        QCOMPARE(visit.get("/now").status, 401);
    }

    void aRestartedProgramKnowsTheBrowser()
    {
        Visit before;
        const auto device = std::get<DeviceEntered>(before.enter("482913").lines.front());
        Visit after;
        after.room.take(KnownDevice{device.sessionHash}, 0);
        after.request.cookie = before.request.cookie;
        QCOMPARE(after.get("/now").status, 200);
        after.request.cookie = "vis2hap=guessed";
        QCOMPARE(after.get("/now").status, 401);
        QCOMPARE(after.enter("482913").status, 409);
    }

    void wrongCodesWaitAndThenVoidTheCode()
    {
        Visit visit;
        for (int tries = 1; tries <= 4; ++tries) {
            const PageReply wrong = visit.enter("000000");
            QCOMPARE(wrong.status, 403);
            QVERIFY(wrong.lines.front() == LineFromPage(WrongCodeEntered{"192.168.1.9", tries, false}));
        }
        const PageReply fifth = visit.enter("000000");
        QCOMPARE(fifth.status, 429);
        QCOMPARE(Visit::headerOf(fifth, "Retry-After"), std::string("30"));
        QVERIFY(why(fifth).find("30 seconds") != std::string::npos);
        visit.nowNs = 29 * secondNs;
        const PageReply waiting = visit.enter("482913");  // even the right code waits
        QCOMPARE(waiting.status, 429);
        QCOMPARE(Visit::headerOf(waiting, "Retry-After"), std::string("1"));
        QVERIFY(waiting.lines.empty());
        for (int tries = 6; tries <= 9; ++tries) {
            visit.nowNs += 31 * secondNs;
            QCOMPARE(visit.enter("000000").status, 429);
        }
        visit.nowNs += 31 * secondNs;
        const PageReply tenth = visit.enter("000000");
        QCOMPARE(why(tenth), usual("code_spent"));
        QVERIFY(tenth.lines.front() == LineFromPage(WrongCodeEntered{"192.168.1.9", 10, true}));
        visit.nowNs += 31 * secondNs;
        QCOMPARE(why(visit.enter("482913")), usual("code_spent"));
        visit.room.take(NewCode{"111222"}, 0);
        QCOMPARE(visit.enter("111222").status, 204);
    }

    void theRightCodeEntersAfterTheWait()
    {
        Visit visit;
        for (int tries = 1; tries <= 5; ++tries) visit.enter("000000");
        visit.nowNs = 30 * secondNs;
        QCOMPARE(visit.enter("482913").status, 204);
    }

    void withoutACodeNobodyEnters()
    {
        PageRoom room(host, {}, PageAccess([] { return "secret"; }, {}));
        PageRequest request{.method = "POST", .path = "/enter", .host = host, .contentType = "application/json"};
        request.body = R"({"code":""})";
        QCOMPARE(room.answer(request, 0).status, 403);
    }

    void anActGoesToTheAppOnlyWhileItIsAskedFor()
    {
        Visit visit;
        QCOMPARE(visit.post("/act", R"({"number":1,"agrees":true})").status, 401);
        visit.enter("482913");
        const PageReply agreed = visit.post("/act", R"({"number":1,"agrees":true})");
        QCOMPARE(agreed.status, 204);
        QVERIFY(agreed.lines.front() == LineFromPage(ParticipantAct{1, Agreement{true}}));
        QCOMPARE(visit.post("/act", R"({"number":1,"tapped":30})").status, 400);
        visit.show(2, scaleTraining());
        QCOMPARE(visit.post("/act", R"({"number":1,"agrees":true})").status, 409);
        QCOMPARE(visit.post("/act", R"({"number":2,"agrees":true})").status, 400);
        QVERIFY(visit.post("/act", R"({"number":2,"tapped":30})").lines.front() ==
                LineFromPage(ParticipantAct{2, PlaceTapped{{30}}}));
        QCOMPARE(visit.post("/act", R"({"number":2,"tapped":101})").status, 400);  // beyond the scale
    }

    void theClockOfABreakGoesOnForABrowserThatComesLater()
    {
        Visit visit;
        visit.enter("482913");
        Instruction onBreak;
        onBreak.breakSeconds = 20;
        visit.show(2, onBreak);
        visit.nowNs += 95 * secondNs;
        QCOMPARE(nlohmann::json::parse(visit.get("/now").body).at("instruction").at("break_seconds").get<int>(), 115);
    }

    void whatIsNotAskedForExactlyIsRefused_data()
    {
        QTest::addColumn<QString>("method");
        QTest::addColumn<QString>("path");
        QTest::addColumn<QString>("changed");
        QTest::addColumn<int>("status");
        QTest::newRow("the page") << "GET"
                                  << "/"
                                  << "" << 200;
        QTest::newRow("the words") << "GET"
                                   << "/words"
                                   << "" << 200;
        QTest::newRow("another host") << "GET"
                                      << "/"
                                      << "host=evil.example:8577" << 421;
        QTest::newRow("no host") << "GET"
                                 << "/"
                                 << "host=" << 421;
        QTest::newRow("the host without its port") << "GET"
                                                   << "/"
                                                   << "host=192.168.1.5" << 421;
        QTest::newRow("localhost is another name") << "GET"
                                                   << "/now"
                                                   << "host=localhost:8577" << 421;
        QTest::newRow("another page") << "POST"
                                      << "/act"
                                      << "origin=http://evil.example" << 403;
        QTest::newRow("this page") << "POST"
                                   << "/act"
                                   << "origin=http://192.168.1.5:8577" << 400;
        QTest::newRow("an unknown path") << "GET"
                                         << "/study.db"
                                         << "" << 404;
        QTest::newRow("a path above") << "GET"
                                      << "/../etc/passwd"
                                      << "" << 404;
        QTest::newRow("a path with a query") << "GET"
                                             << "/now?after=1"
                                             << "" << 404;
        QTest::newRow("a doubled slash") << "GET"
                                         << "//now"
                                         << "" << 404;
        QTest::newRow("a long path") << "GET"
                                     << "/" + QString(300, 'a') << "" << 414;
        QTest::newRow("a method for reading") << "GET"
                                              << "/act"
                                              << "" << 405;
        QTest::newRow("a method for writing") << "POST"
                                              << "/now"
                                              << "" << 405;
        QTest::newRow("an unknown method") << "DELETE"
                                           << "/now"
                                           << "" << 405;
        QTest::newRow("no method") << "UNKNOWN"
                                   << "/"
                                   << "" << 405;
        QTest::newRow("a form of another page") << "POST"
                                                << "/act"
                                                << "type=text/plain" << 415;
        QTest::newRow("a large body") << "POST"
                                      << "/act"
                                      << "large" << 413;
        QTest::newRow("a body where none belongs") << "GET"
                                                   << "/now"
                                                   << "body=x" << 413;
        QTest::newRow("no JSON") << "POST"
                                 << "/act"
                                 << "body={" << 400;
        QTest::newRow("a doubled key") << "POST"
                                       << "/act"
                                       << R"(body={"number":1,"number":1})" << 400;
        QTest::newRow("more than an act") << "POST"
                                          << "/act"
                                          << R"(body={"number":1,"agrees":true,"code":1})" << 400;
        QTest::newRow("a huge number") << "POST"
                                       << "/act"
                                       << R"(body={"number":1e300,"tapped":1})" << 400;
        QTest::newRow("a control character") << "POST"
                                             << "/act"
                                             << R"(body={"number":1,"facts":["a\u0007"]})" << 400;
        QTest::newRow("a code with a long body") << "POST"
                                                 << "/enter"
                                                 << "body={\"code\":\"" + QString(300, '1') + "\"}" << 413;
        QTest::newRow("a code that is no text") << "POST"
                                                << "/enter"
                                                << R"(body={"code":482913})" << 400;
    }
    void whatIsNotAskedForExactlyIsRefused()
    {
        QFETCH(QString, method);
        QFETCH(QString, path);
        QFETCH(QString, changed);
        Visit visit;
        visit.enter("482913");
        PageRequest request{
            .method = method.toStdString(), .path = path.toStdString(), .host = host, .cookie = visit.request.cookie};
        if (method == "POST") request.contentType = "application/json; charset=utf-8";
        const std::string value = changed.section('=', 1).toStdString();
        if (changed.startsWith("host")) request.host = value;
        if (changed.startsWith("origin")) request.origin = value;
        if (changed.startsWith("type")) request.contentType = value;
        if (changed.startsWith("body")) request.body = value;
        if (changed == "large") request.body.assign(longestBody + 1, 'x');
        const PageReply reply = visit.room.answer(request, 0);
        QTEST(reply.status, "status");
        QVERIFY(reply.lines.empty());
        QCOMPARE(Visit::headerOf(reply, "Cache-Control"), std::string("no-store"));
        const std::string policy = Visit::headerOf(reply, "Content-Security-Policy");
        QVERIFY(policy.find("default-src 'none'") != std::string::npos &&
                policy.find("frame-ancestors 'none'") != std::string::npos);
    }

    /// Before, one such body kept the page of everybody waiting for 1.6 s.
    void doubledKeysCannotHoldThePage()
    {
        std::string body = "{\"a\":1";
        while (body.size() + 10 < longestBody) body += ",\"a\":1";
        body += "}";
        Visit visit;
        QElapsedTimer clock;
        clock.start();
        QCOMPARE(visit.post("/enter", body).status, 413);
        visit.enter("482913");
        QCOMPARE(visit.post("/act", body).status, 400);
        QVERIFY2(clock.elapsed() < 500, qPrintable(QString("%1 ms").arg(clock.elapsed())));
    }

    void thePageSpeaksTheLanguageOfTheStudy()
    {
        Visit visit;
        visit.room.take(PageTexts{"pt-BR", {{"code_wrong", "Código errado."}}}, 0);
        QCOMPARE(why(visit.enter("1")), std::string("Código errado."));
        const auto words = nlohmann::json::parse(visit.get("/words").body);
        QCOMPARE(words.at("language").get<std::string>(), std::string("pt-BR"));
        QCOMPARE(words.at("texts").at("code_title").get<std::string>(), usual("code_title"));
    }

    /// A page that stands open fetches other words by their name, also after a restart of the program.
    void otherWordsHaveAnotherName()
    {
        Visit visit;
        const auto nameIn = [&](const char* path, const char* key) {
            return nlohmann::json::parse(visit.get(path).body).at(key).get<std::string>();
        };
        const std::string english = nameIn("/words", "name");
        QCOMPARE(nameIn("/now", "words"), english);  // a browser with no code
        QCOMPARE(Visit().get("/words").body, visit.get("/words").body);
        visit.enter("482913");
        QCOMPARE(nameIn("/now", "words"), english);
        visit.room.take(PageTexts{"en", {{"agree", "Yes"}}}, 0);
        QVERIFY(nameIn("/now", "words") != english);
        QCOMPARE(nameIn("/now", "words"), nameIn("/words", "name"));
        QVERIFY(english.find_first_of("0123456789") == std::string::npos);  // no code of a piece
    }

    /// A number that was copied from elsewhere often stands between two such marks.
    void aFactWithMarksOfDirectionIsTakenWithoutThem()
    {
        Visit visit;
        visit.enter("482913");
        Instruction facts;
        facts.task = Task::Facts;
        facts.questions = {"age", "phone"};
        visit.show(2, facts);
        const PageReply told = visit.post("/act", "{\"number\":2,\"facts\":[\"\u2067٣١\u2069\",\"\u202a+49 30\u202c\"]}");
        QCOMPARE(told.status, 204);
        QVERIFY(told.lines.front() == LineFromPage(ParticipantAct{2, FactsTold{{"٣١", "+49 30"}}}));
    }

    void cookiesAreFoundByTheirWholeName()
    {
        QCOMPARE(cookieIn("a=1; vis2hap=xyz; b=2", "vis2hap"), std::string("xyz"));
        QCOMPARE(cookieIn("xvis2hap=1;vis2hap2=2", "vis2hap"), std::string());
        QCOMPARE(cookieIn("vis2hap", "vis2hap"), std::string());
        QCOMPARE(cookieIn(";;; ", "vis2hap"), std::string());
    }

    void linesComeBackAsTheyWere()
    {
        Instruction facts;
        facts.task = Task::Facts;
        facts.title = "About you \"\n";
        facts.questions = {"age", "年齢"};
        Instruction scale = scaleTraining();
        scale.scale->scale.labels = {"a", "b"};
        scale.scale->last = ScaleFeedback{{35}, {30}, false, "no"};
        const LineToPage toPage[] = {NewCode{"482913"},
                                     KnownDevice{std::string(64, 'a')},
                                     PageTexts{"ja", {{"a", "はい"}}},
                                     NumberedInstruction{7, facts},
                                     NumberedInstruction{8, scale},
                                     NumberedInstruction{9, consent()}};
        for (const LineToPage& line : toPage) {
            QVERIFY(lineOf(line).find('\n') == std::string::npos);
            QVERIFY(lineToPage(lineOf(line)) == line);
        }
        const LineFromPage fromPage[] = {Listening{8577}, DeviceEntered{"::1", std::string(64, '0')},
                                         WrongCodeEntered{"10.0.0.2", 3, true}, DeviceRefused{"10.0.0.2"},
                                         ParticipantAct{4, FactsTold{{"31", ""}}}};
        for (const LineFromPage& line : fromPage) QVERIFY(lineFromPage(lineOf(line)) == line);
    }

    void linesThatNobodyWritesAreRefused_data()
    {
        QTest::addColumn<QString>("line");
        for (const char* line :
             {"", "{", "[]", "{}", R"({"code":""})", R"({"code":1})", R"({"session":"abc"})", R"({"texts":[]})",
              R"({"number":1})", R"({"number":-1,"instruction":{"task":"read","title":"","lines":[]}})",
              R"({"number":1,"instruction":{"task":"shout","title":"","lines":[]}})",
              R"({"number":1,"instruction":{"task":"scale","title":"","lines":[]}})",
              R"({"number":1,"instruction":{"task":"read","title":"","lines":[],"break_seconds":1e300}})",
              R"({"listening":70000})", R"({"listening":-1})", R"({"entered":"x","from":"1"})", R"({"refused":true})",
              R"({"wrong_codes":1,"from":"a"})", R"({"act":{}})"})
            QTest::newRow(line) << line;
    }
    void linesThatNobodyWritesAreRefused()
    {
        QFETCH(QString, line);
        QVERIFY_EXCEPTION_THROWN(lineToPage(line.toStdString()), protocols::Error);
        QVERIFY_EXCEPTION_THROWN(lineFromPage(line.toStdString()), protocols::Error);
    }

    void linesArriveInPieces()
    {
        LineBuffer lines;
        QVERIFY(lines.take("{\"a\"").empty());
        QVERIFY(lines.take(":1}\n{}\n{") == (std::vector<std::string>{"{\"a\":1}", "{}"}));
        QVERIFY(lines.take("\n") == std::vector<std::string>{"{"});
        QVERIFY_EXCEPTION_THROWN(lines.take(std::string(longestLine + 1, 'x')), protocols::Error);
        QVERIFY(lines.take("b\n") == std::vector<std::string>{"b"});  // begins anew
    }
};

QTEST_GUILESS_MAIN(PageRoomTest)
#include "page_room_test.moc"
