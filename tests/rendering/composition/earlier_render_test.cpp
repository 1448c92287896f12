// Two renderings into one folder: changes are reported, and everything that is still valid is kept.
#include "rendering/composition/earlier_render.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTest>

using rendering::joined;

namespace {

std::string rendered(const char* condition, const char* over, const char* images, double max, const char* data = "wool",
                     const char* scale = "pixels")
{
    const auto list = [](const QString& names) { return "[\"" + names.split(' ').join("\",\"") + "\"]"; };
    return QString(R"({"schema":"vis2hap.render/1","dataset":"%1","conditions":{"%2":{"range":{"min":0,"max":%3},
        "range_over":%4,"mapping":{"scale":"%5"},"images":%6,"extension":{}}},"samples":{"%7":{}}})")
        .arg(data, condition)
        .arg(max)
        .arg(list(over), scale, list(images), QString(images).section(' ', 0, 0))
        .toStdString();
}

QJsonObject conditionOf(const std::string& json, const char* id)
{
    return QJsonDocument::fromJson(QByteArray::fromStdString(json))["conditions"].toObject()[id].toObject();
}

QString namesIn(const QJsonValue& array)
{
    QStringList names;
    for (const auto& name : array.toArray()) names << name.toString();
    return names.join(' ');
}

}  // namespace

class EarlierRenderTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void theSameRangeJoinsTheImages()
    {
        const auto result = joined(rendered("h", "F01 F02", "F02", 1), rendered("h", "F01 F02", "F01", 1), "render.json");
        QVERIFY(result.warnings.empty());
        QCOMPARE(namesIn(conditionOf(result.json, "h")["images"]), "F02 F01");
        QVERIFY(!conditionOf(result.json, "h").contains("mapped_otherwise"));
    }

    void otherConditionsAreKept()
    {
        const auto result = joined(rendered("h", "F01", "F01", 1), rendered("v_grey", "F01", "F01", 9), "render.json");
        QVERIFY(result.warnings.empty());
        QCOMPARE(conditionOf(result.json, "v_grey")["range"].toObject()["max"].toDouble(), 9.0);
        QCOMPARE(conditionOf(result.json, "h")["range"].toObject()["max"].toDouble(), 1.0);
    }

    void whatIsNestedDeeplyIsReplaced()
    {
        const std::string now = rendered("h", "F01", "F01", 1);
        std::string earlier = rendered("v_grey", "F01", "F01", 9);
        const std::string field = "\"extension\":{}";
        earlier.replace(earlier.find(field), field.size(),
                        "\"extension\":" + std::string(200'000, '[') + std::string(200'000, ']'));
        const auto result = joined(now, earlier, "render.json");
        QCOMPARE(result.json, now);
        QCOMPARE(result.warnings.size(), std::size_t(1));
        QVERIFY(result.warnings[0].find("cannot be read and is replaced") != std::string::npos);
    }

    void anAddedFabricIsWarnedAbout()
    {
        const auto result =
            joined(rendered("h", "F01 F02 F03", "F03", 2), rendered("h", "F01 F02", "F01 F02", 1), "out/render.json");
        QCOMPARE(result.warnings.size(), std::size_t(1));
        const auto warning = QString::fromStdString(result.warnings[0]);
        for (const char* part : {"out/render.json", "h: ", "now includes F03", "0 to 1", "0 to 2", "images of F01, F02"})
            QVERIFY2(warning.contains(part), qPrintable(warning));
        QCOMPARE(namesIn(conditionOf(result.json, "h")["mapped_otherwise"]), "F01 F02");
        QCOMPARE(namesIn(conditionOf(result.json, "h")["images"]), "F03");
        // After F01 and F02 are rendered again, all images have the same range.
        const auto again = joined(rendered("h", "F01 F02 F03", "F01 F02 F03", 2), result.json, "out/render.json");
        QVERIFY(again.warnings.empty());
        QVERIFY(!conditionOf(again.json, "h").contains("mapped_otherwise"));
    }

    void everyKindOfChangeIsNamed_data()
    {
        QTest::addColumn<QString>("now");
        QTest::addColumn<QString>("said");
        const auto row = [](const char* title, const std::string& now, const char* said) {
            QTest::newRow(title) << QString::fromStdString(now) << QString(said);
        };
        row("fabric gone", rendered("h", "F01", "F01", 1), "no longer includes F02");
        row("range", rendered("h", "F01 F02", "F01", 3), "was 0 to 1.0 and is now 0 to 3.0");
        row("scale", rendered("h", "F01 F02", "F01", 1, "wool", "physical"), "physical");
        row("data set", rendered("h", "F01 F02", "F01", 1, "silk"), "was wool and is now silk");
    }
    void everyKindOfChangeIsNamed()
    {
        QFETCH(QString, now);
        QFETCH(QString, said);
        const auto result = joined(now.toStdString(), rendered("h", "F01 F02", "F01 F02", 1), "render.json");
        QCOMPARE(result.warnings.size(), std::size_t(1));
        QString warning = QString::fromStdString(result.warnings[0]);
        QVERIFY2(warning.contains(said) || warning.contains(QString(said).remove(".0")), qPrintable(warning));
    }

    void aSpoiltFileIsReplacedWithAWarning_data()
    {
        QTest::addColumn<QString>("earlier");
        for (const char* text :
             {"", "{", "[]", "{}", "null", R"({"dataset":1,"conditions":{},"samples":{}})",
              R"({"dataset":"wool","conditions":{"h":{"range":3}},"samples":{}})",
              R"({"dataset":"wool","conditions":{"h":{"range":{},"range_over":[1],"images":7}},"samples":[]})"})
            QTest::newRow(text[0] == 0 ? "empty" : text) << QString(text);
    }
    void aSpoiltFileIsReplacedWithAWarning()
    {
        QFETCH(QString, earlier);
        const auto now = rendered("h", "F01", "F01", 1);
        const auto result = joined(now, earlier.toStdString(), "render.json");
        QCOMPARE(result.json, now);
        QVERIFY(QString::fromStdString(result.warnings.at(0)).contains("cannot be read"));
    }
};

QTEST_GUILESS_MAIN(EarlierRenderTest)
#include "earlier_render_test.moc"
