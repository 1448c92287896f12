// JSON with the line and column of every value.
#include "protocols/files/strict_json.h"

#include <QElapsedTimer>
#include <QTest>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/random.h"
#include "tests/support/error_text.h"
#include "tests/support/mutated_files.h"

using tests::support::errorOf;
using namespace protocols;

namespace {

using nlohmann::json;

const std::string protocol =
    "{\n"
    "  \"name\": \"Größe\", \"participants\" : 10,\n"
    "  \"phases\": [\n"
    "    {\"questions\": [\"Q1\",\"Q2\"], \"scale\": {\"min\": 0}},\n"
    "\t{ }, [ ], -1.5e3, true, null,\n"
    "    \"a \\\"quoted\\\" ] } text\"\n"
    "  ],\n"
    "  \"a/b~c\": {\"\": 1, \"\\u00e4\": 2}\n"
    "}\n";

/// Every value of a text by its pointer.
void addPointers(const json& value, const std::string& pointer, std::vector<std::pair<std::string, json>>& all)
{
    all.emplace_back(pointer, value);
    if (value.is_object())
        for (const auto& [key, member] : value.items()) addPointers(member, pointer + "/" + pointerStep(key), all);
    if (value.is_array())
        for (std::size_t i = 0; i < value.size(); ++i) addPointers(value[i], pointer + "/" + std::to_string(i), all);
}

/// The text from a place on, counted by this test itself.
std::string textFrom(const std::string& text, const std::string& place)
{
    std::size_t line = 0, column = 0;
    if (std::sscanf(place.c_str(), "line %zu, column %zu", &line, &column) != 2) return "no place";
    std::size_t at = 0;
    for (std::size_t i = 1; i < line; ++i) at = text.find('\n', at) + 1;
    for (std::size_t i = 1; i < column; ++i) {
        ++at;
        while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80) ++at;
    }
    return text.substr(at);
}

/// The first value of a text that continues after it.
json firstValueOf(const std::string& text)
{
    json first;
    int depth = 0;
    bool isString = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (isString && text[i] == '\\') {
            ++i;
            continue;
        }
        if (text[i] == '"') isString = !isString;
        if (isString) continue;
        if (text[i] == '{' || text[i] == '[') ++depth;
        if (text[i] == '}' || text[i] == ']') --depth;
        const bool isEnd =
            i + 1 == text.size() || (depth == 0 && std::string(",]} \n\t\r").find(text[i + 1]) != std::string::npos);
        if (isEnd && depth == 0) return json::parse(text.substr(0, i + 1), nullptr, false);
    }
    return json::parse("", nullptr, false);
}

}  // namespace

class StrictJsonTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void placesAreExact_data()
    {
        QTest::addColumn<QString>("pointer");
        QTest::addColumn<QString>("place");
        QTest::newRow("the whole") << ""
                                   << "line 1, column 1";
        QTest::newRow("a text") << "/name"
                                << "line 2, column 11";
        QTest::newRow("behind letters of two bytes") << "/participants"
                                                     << "line 2, column 37";
        QTest::newRow("a list") << "/phases"
                                << "line 3, column 13";
        QTest::newRow("an object in a list") << "/phases/0"
                                             << "line 4, column 5";
        QTest::newRow("second of a list") << "/phases/0/questions/1"
                                          << "line 4, column 25";
        QTest::newRow("deep") << "/phases/0/scale/min"
                              << "line 4, column 49";
        QTest::newRow("behind a tab") << "/phases/1"
                                      << "line 5, column 2";
        QTest::newRow("a number") << "/phases/3"
                                  << "line 5, column 12";
        QTest::newRow("null") << "/phases/5"
                              << "line 5, column 26";
        QTest::newRow("behind brackets in a text") << "/a~1b~0c"
                                                   << "line 8, column 12";
        QTest::newRow("the empty key") << "/a~1b~0c/"
                                       << "line 8, column 17";
        QTest::newRow("an escaped key") << "/a~1b~0c/\u00e4"
                                        << "line 8, column 30";
        QTest::newRow("missing member") << "/phases/0/scale/max"
                                        << "line 4, column 41";
        QTest::newRow("missing element") << "/phases/9"
                                         << "line 3, column 13";
        QTest::newRow("below a number") << "/participants/x"
                                        << "line 2, column 37";
    }
    void placesAreExact()
    {
        QFETCH(const QString, pointer);
        QFETCH(const QString, place);
        const JsonDocument document(protocol, "p.json");
        QCOMPARE(QString::fromStdString(document.placeOf(pointer.toStdString())), place);
    }

    void everyPlaceBeginsTheValueItself()
    {
        const JsonDocument document("\xEF\xBB\xBF" + protocol, "p.json");
        std::vector<std::pair<std::string, json>> all;
        addPointers(document.root(), "", all);
        QCOMPARE(all.size(), std::size_t{19});
        for (const auto& [pointer, value] : all)
            QVERIFY2(firstValueOf(textFrom(protocol, document.placeOf(pointer))) == value, pointer.c_str());
    }

    void pathsOfMessagesArePointers()
    {
        QCOMPARE(pointerOf("phases[0].scale.min"), std::string("/phases/0/scale/min"));
        QCOMPARE(pointerOf("planned[1][0]"), std::string("/planned/1/0"));
        QCOMPARE(pointerOf("a/b"), std::string("/a~1b"));
        QCOMPARE(pointerOf(""), std::string());
    }

    void faultOfAValueNamesFileAndPlace()
    {
        const JsonDocument document(protocol, "p.json");
        QCOMPARE(QString(document.faultAt("/participants", "10 participants", "1 to 9").what()),
                 QString("p.json, line 2, column 37: 10 participants; expected 1 to 9"));
        QCOMPARE(document.faultAt("", "", "").exitCode(), ExitCode::BadInput);
    }

    void malformedTextsAreRefusedWithTheirPlace_data()
    {
        QTest::addColumn<QByteArray>("text");
        QTest::addColumn<QString>("said");
        QTest::newRow("nothing") << QByteArray() << "2: p.json, line 1, column 1: malformed JSON";
        QTest::newRow("cut short") << QByteArray("{\n  \"a\": 1,\n") << "2: p.json, line 3, column 1: malformed JSON";
        QTest::newRow("comma too many") << QByteArray("{\n  \"ä\": [1,],\n}") << "2: p.json, line 2, column 11: malformed JSON";
        QTest::newRow("two values") << QByteArray("{}\n{}") << "2: p.json, line 2, column 1: malformed JSON";
        QTest::newRow("zero byte") << QByteArray("{\"a\": \0}", 8) << "2: p.json, line 1, column 7: the text holds a zero byte";
        QTest::newRow("too deep") << QByteArray(100'000, '[') << "2: p.json, line 1, column 101: the text nests too deeply";
        QTest::newRow("too deep, closed") << QByteArray(101, '[') + QByteArray(101, ']')
                                          << "2: p.json, line 1, column 101: the text nests too deeply; expected at most 100";
        QTest::newRow("no UTF-8") << QByteArray("{\"a\": \"\xE4\"}") << "2: p.json, line 1, column 8: the text is not UTF-8";
        QTest::newRow("too large") << QByteArray("{\"a\": 1e999}")
                                   << "2: p.json, line 1, column 7: malformed JSON (number overflow parsing '1e999')";
        QTest::newRow("doubled key") << QByteArray("{\"a\": {\"b\": 1,\n \"b\" : [{\"b\": 2}]}, \"c\": \"b\",\n \"\\u0061\": 2}")
                                     << "2: p.json: doubled key 'b' (line 2, column 2), 'a' (line 3, column 2); expected each "
                                        "key once in its object; remove "
                                        "one of the two";
    }
    void malformedTextsAreRefusedWithTheirPlace()
    {
        QFETCH(const QByteArray, text);
        QFETCH(const QString, said);
        const QString error = errorOf([&] { parseStrictJson(text.toStdString(), "p.json"); });
        QVERIFY2(error.startsWith(said), qPrintable(error));
        QVERIFY(!error.contains("json.exception") && !error.contains("parse error at"));
        QCOMPARE(errorOf([&] { parseStrictOrderedJson(text.toStdString(), "p.json"); }), error);
        QCOMPARE(errorOf([&] { JsonDocument(text.toStdString(), "p.json"); }), error);
    }

    /// Before, 20,000 doubled keys took 1.9 s and made a message of one megabyte.
    void manyDoubledKeysAreCountedAndTheFirstOnesNamed()
    {
        std::string text = "{\"a\":1";
        for (int i = 0; i < 100'000; ++i) text += ",\n\"a\":1";
        text += "}";
        QElapsedTimer clock;
        clock.start();
        const QString error = errorOf([&] { parseStrictJson(text, "p.json"); });
        QVERIFY2(clock.elapsed() < 5000, qPrintable(QString("%1 ms").arg(clock.elapsed())));
        QVERIFY2(error.startsWith("2: p.json: doubled key 'a' (line 2, column 1), 'a' (line 3, column 1), "), qPrintable(error));
        QVERIFY2(error.contains("'a' (line 11, column 1) and 99990 more; expected"), qPrintable(error));
        const std::string longKey = "\"" + std::string(99, 'x') + "ä" + std::string(5000, 'x') + "\":1";
        const QString brief = errorOf([&] { parseStrictJson("{" + longKey + "," + longKey + "}", "p.json"); });
        QVERIFY2(brief.contains("'" + QString(99, 'x') + "...' (line 1, column 5107)"), qPrintable(brief));
    }

    /// Before, the escaped keys of an object were lost when objects within it opened.
    void escapedKeysAroundOtherObjectsAreCompared()
    {
        const std::string before = R"({"\u0061":1,"\u0062":1,"c":)";
        std::string single = "0", doubled = "0";
        for (int depth = 1; depth <= 60; ++depth) {
            single = before + single + R"(,"d":2})";
            doubled = before + doubled + R"(,"\u0061":2})";
        }
        QCOMPARE(errorOf([&] { parseStrictJson(single, "p.json"); }), QString());
        const QString error = errorOf([&] { parseStrictJson(doubled, "p.json"); });
        QCOMPARE(error.count("'a'"), 10);
        QVERIFY2(error.contains(" and 50 more; expected"), qPrintable(error));
    }

    /// Before, each key was compared with all before it: 50,000 took 3.2 s.
    void manyDifferentKeysAreReadInTheirOrder()
    {
        std::string text = "{\"z\":[]";
        for (int i = 0; i < 100'000; ++i) text += ",\"" + std::to_string(i) + "\":[1,{\"b\":-2.5,\"a\":\"\\u00e4\"}]";
        text += "}";
        QElapsedTimer clock;
        clock.start();
        const auto root = parseStrictOrderedJson(text, "p.json");
        QVERIFY2(clock.elapsed() < 5000, qPrintable(QString("%1 ms").arg(clock.elapsed())));
        QCOMPARE(root.size(), std::size_t{100'001});
        QCOMPARE(root.begin().key(), std::string("z"));
        QCOMPARE(root.back().dump(), std::string("[1,{\"b\":-2.5,\"a\":\"ä\"}]"));
    }

    void orderOfKeysIsKeptWhereAskedFor()
    {
        QCOMPARE(parseStrictOrderedJson("{\"b\":1,\"a\":2}", "p.json").dump(), std::string("{\"b\":1,\"a\":2}"));
        QCOMPARE(parseStrictJson("{\"b\":1,\"a\":2}", "p.json").dump(), std::string("{\"a\":2,\"b\":1}"));
    }

    void theDeepestTextHasPlaces()
    {
        const std::size_t depth = deepestJson - 1;
        const JsonDocument document(std::string(depth, '[') + "{\"a\":7}" + std::string(depth, ']'), "deep.json");
        std::string pointer;
        for (std::size_t i = 0; i < depth; ++i) pointer += "/0";
        QCOMPARE(document.placeOf(pointer + "/a"), "line 1, column " + std::to_string(depth + 6));
    }

    void spoiltTextsAreRefusedOrFullOfExactPlaces()
    {
        auto random = Random::stream(11, "json");
        QElapsedTimer clock;
        clock.start();
        int taken = 0, refused = 0;
        do {
            const std::string spoilt = mutated_files::mutated(protocol, random);
            try {
                const JsonDocument document(spoilt, "spoilt.json");
                std::vector<std::pair<std::string, json>> all;
                addPointers(document.root(), "", all);
                const std::string text = spoilt.starts_with("\xEF\xBB\xBF") ? spoilt.substr(3) : spoilt;
                for (const auto& [pointer, value] : all)
                    QVERIFY2(firstValueOf(textFrom(text, document.placeOf(pointer))) == value, (pointer + " of " + text).c_str());
                ++taken;
            } catch (const Error&) {
                ++refused;
            }
        } while (clock.elapsed() < 1000 * mutated_files::fuzzSeconds(0.5));
        QVERIFY2(taken > 10 && refused > 10, qPrintable(QString("%1 taken, %2 refused").arg(taken).arg(refused)));
    }

    void storedJsonIsReadOrDiscardedAndNeverThrows()
    {
        for (const char* text : {R"({"a":[1,"x"]})", R"({"a":1,"a":2})", "7", "[]"})
            QVERIFY2(storedJson(text) == json::parse(text) && !storedOrderedJson(text).is_discarded(), text);
        QCOMPARE(storedOrderedJson(R"({"b":1,"a":2})").dump(), std::string(R"({"b":1,"a":2})"));
        const auto nested = [](std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
        QVERIFY(!storedJson(nested(deepestJson)).is_discarded());
        for (const std::string& text : {std::string(), std::string("{\"a\":"), std::string("1e999"), nested(deepestJson + 1),
                                        nested(200'000), std::string(largestJson + 1, ' ')})
            QVERIFY(storedJson(text).is_discarded() && storedOrderedJson(text).is_discarded());
    }

    /// The payload of one altered entry held an export up: 60,000 keys took 10 s.
    void manyStoredKeysAreReadInTheirOrder()
    {
        std::string text = "{\"z\":0";
        for (int i = 0; i < 100'000; ++i) text += ",\"" + std::to_string(i) + "\":" + std::to_string(i);
        QElapsedTimer clock;
        clock.start();
        const auto root = storedOrderedJson(text + ",\"z\":7}");
        QVERIFY2(clock.elapsed() < 5000, qPrintable(QString("%1 ms").arg(clock.elapsed())));
        QCOMPARE(root.size(), std::size_t{100'001});
        QVERIFY(root.begin().key() == "z" && *root.begin() == 7 && root.back() == 99'999);
    }

    /// As the library's own reader does it, which knows nothing of speed.
    void theLastValueOfADoubledKeyIsStoredInThePlaceOfTheFirst()
    {
        for (const char* text : {R"({"b":1,"a":2,"b":{"x":1,"x":[2]},"c":3,"a":4})", R"({"a":{"a":1,"b":2},"a":[{"k":1,"k":2}]})",
                                 R"([{"\u0061":1,"a":2},{}])", R"({"a":1,"a":2,"a":3})"})
            QCOMPARE(storedOrderedJson(text).dump(), nlohmann::ordered_json::parse(text).dump());
    }
};

QTEST_GUILESS_MAIN(StrictJsonTest)
#include "strict_json_test.moc"
